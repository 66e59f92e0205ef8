// The fragment shader of the Vulkan peer. It follows docs/picture.md, Shading.
#version 450
layout(push_constant) uniform Constants {
    mat4 to_clip;
    vec4 normal_to_world[3]; // rows; the first row's w is the alpha cutoff
    vec4 base_colour;        // w is the light map's scale
} constants;
#ifdef TEXTURED
layout(location = 0) in vec2 colour_uv;
layout(binding = 0) uniform sampler2D colour_texture;
#endif
#ifdef LIGHT_MAPPED
layout(location = 1) in vec2 light_uv;
layout(binding = 1) uniform sampler2D light_map;
#endif
#if defined LIT || defined COLOURED
layout(location = 2) in vec3 vertex_light;
#endif
layout(location = 0) out vec4 pixel;

// The alpha test comes after the last texture read, since derivatives are undefined after a discard.
void main() {
    vec3 colour = constants.base_colour.rgb;
#ifdef TEXTURED
    vec4 texel = texture(colour_texture, colour_uv);
    colour *= texel.rgb;
#endif
#ifdef LIGHT_MAPPED
    colour *= constants.base_colour.w * texture(light_map, light_uv).rgb;
#endif
#if defined LIT || defined COLOURED
    colour *= vertex_light;
#endif
#ifdef CLIPPED
    if (texel.a < constants.normal_to_world[0].w) {
        discard;
    }
#endif
    pixel = vec4(colour, 1.0);
}
