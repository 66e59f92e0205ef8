// The vertex shader of the Vulkan peer. It follows docs/picture.md, Shading.
#version 450
layout(push_constant) uniform Constants {
    mat4 to_clip;
    vec4 normal_to_world[3]; // rows; the first row's w is the alpha cutoff
    vec4 base_colour;        // w is the light map's scale
} constants;
layout(location = 0) in vec3 position;
#ifdef TEXTURED
layout(location = 1) in vec2 uv0;
layout(location = 0) out vec2 colour_uv;
#endif
#ifdef LIGHT_MAPPED
layout(location = 2) in vec2 uv1;
layout(location = 1) out vec2 light_uv;
#endif
#ifdef LIT
layout(location = 3) in vec3 normal;
#endif
#ifdef COLOURED
layout(location = 4) in vec3 colour_lin;
#endif
#if defined LIT || defined COLOURED
layout(location = 2) out vec3 vertex_light;
#endif

void main() {
    gl_Position = constants.to_clip * vec4(position, 1.0);
#ifdef TEXTURED
    colour_uv = uv0;
#endif
#ifdef LIGHT_MAPPED
    light_uv = uv1;
#endif
#if defined LIT || defined COLOURED
    vertex_light = vec3(1.0);
#endif
#ifdef LIT
    vec3 n = normalize(vec3(dot(constants.normal_to_world[0].xyz, normal),
                            dot(constants.normal_to_world[1].xyz, normal),
                            dot(constants.normal_to_world[2].xyz, normal)));
    vec3 sun = normalize(vec3(-0.42, 0.67, 0.61));
    vertex_light *= 0.35 + 0.15 * n.y + 0.65 * max(0.0, dot(n, sun));
#endif
#ifdef COLOURED
    vertex_light *= colour_lin;
#endif
}
