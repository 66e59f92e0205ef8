// Uniforms of the shaders that draw the scene's surfaces. The pipeline treats these shaders as it
// treats any caller's shaders.
#ifndef DIP_RENDERER_SCENE_MATERIALS_SURFACE_H
#define DIP_RENDERER_SCENE_MATERIALS_SURFACE_H

#include "renderer/pipeline/shader.h"
#include "renderer/scene/lights.h"
#include "renderer/scene/materials/backdrop.h"
#include "renderer/scene/materials/pbr.h"
#include "renderer/scene/scene.h"

#include <stdbool.h>
#include <stdint.h>

// The materials' shaders count the fragments of each effect. These are the indices of the counts in
// DipShaderWork.counts.
enum {
    DIP_SHADER_COUNT_NORMAL_MAPPED,
    DIP_SHADER_COUNT_SKY,
    DIP_SHADER_COUNT_REFLECTING,
    DIP_SHADER_COUNT_LIT, // by the scene's own lights
    DIP_SHADER_COUNT_PBR,
    DIP_SHADER_COUNT_OCCLUDED,
    DIP_SHADER_COUNT_EMITTING,
    DIP_SHADER_COUNT_COATED,
    DIP_SHADER_COUNT_SURROUNDED, // by an environment
    DIP_SHADER_COUNT_SHADOWED,   // fragments that read the shadow map
    DIP_SHADER_COUNT_SHEEN,
    DIP_SHADER_COUNT_TRANSMITTING,
    DIP_SHADER_COUNT_SCATTERING,
};

enum {
    DIP_SURFACE_SAMPLER_COLOUR,
    DIP_SURFACE_SAMPLER_LIGHT_MAP,
    DIP_SURFACE_SAMPLER_NORMAL_MAP,
    DIP_SURFACE_SAMPLER_METAL_ROUGH,
    DIP_SURFACE_SAMPLER_OCCLUSION,
    DIP_SURFACE_SAMPLER_EMISSION,
    DIP_SURFACE_SAMPLER_COUNT,
    DIP_ABSENT = -1 // an attribute or varying that a mesh does not have
};

// The view ray through a position (x, y) in pixels of the target is origin + x * per_x + y * per_y,
// in world space. The position of a point relative to the eye is its depth (clip w) times its ray.
// It is also clip x * right + clip y * up + clip w * ahead.
typedef struct DipViewRays {
    float origin[3];
    float per_x[3];
    float per_y[3];
    float right[3];
    float up[3];
    float ahead[3];
} DipViewRays;

// Whether a surface is drawn as a solid one is: it may be lit by the scene's lights, and have
// normal maps and metallic-roughness materials. Water and sky are not.
static inline bool dip_surface_is_solid(DipSurface surface) {
    return surface == DIP_SURFACE_OPAQUE || surface == DIP_SURFACE_CLIPPED ||
           surface == DIP_SURFACE_BLENDED;
}

// A light of the scene as an eye sees it.
typedef struct DipLightUniforms {
    DipLightKind kind;
    float colour_lin[3];
    float from_eye[3]; // position relative to the eye; not of a directional light
    float to_light[3]; // unit; the opposite of the light's direction; not of a point light
    float attenuation[3];
    float inverse_range2; // 1 / range^2; 0: the light has no end
    // The part of a spot light that reaches a point is clamp01(cosine * cone_scale + cone_shift)
    // squared, where the cosine is that of the angle to the light's direction.
    float cone_scale;
    float cone_shift;
} DipLightUniforms;

// The lights of a scene as an eye sees them.
typedef struct DipLightingUniforms {
    float ambient_lin[3];
    float sky_lin[3];
    int count;
    DipLightUniforms lights[DIP_MAX_LIGHTS];
} DipLightingUniforms;

// The shadows of one directional light as an eye sees them.
typedef struct DipShadowUniforms {
    DipShadowMap map;
    int light; // index of the light in DipLightingUniforms
    // Takes a place relative to the eye to the map: u, v and depth.
    float to_map[3][4];
    // For a normal n, the depth of a surface changes by dot(n, rise[0]) / dot(n, rise[2]) over the
    // width of a texel, and by dot(n, rise[1]) / dot(n, rise[2]) over its height, but for the sign.
    float rise[3][3];
} DipShadowUniforms;

// The sky at the time of a frame; see DipSkyDef.
typedef struct DipSkyUniforms {
    struct {
        float scale;
        float phase; // added to u, 0..1
        float perturbation_widths;
    } layers[2];
    float perturbation_scale;
    float blend;
    float clear;
    float inverse_range; // 1 / (dense - clear)
    float overcast;
    float zenith_lin[3];
    float horizon_lin[3];
    float cloud_lin[3];
    float glare_lin[3];
    float tint_lin[3];
} DipSkyUniforms;

// A vertex has these attributes, in this order: the position; the texture coordinates and the
// alpha, which are copied to the first varyings in the same order; the normal, if the surface is
// lit or normal-mapped; and the vertex colour, if the mesh has one. The light varying is the light
// of the vertex times its colour; on a surface whose fragments are lit it is the vertex colour
// alone.
typedef struct DipSurfaceUniforms {
    float origin[3];          // subtracted from a vertex's position, see dip_view_object_origin
    float to_clip[16];        // row-major; takes the difference to clip space
    float normal_to_world[9]; // row-major; gives a normal the right direction, but any length
    int copied_varying_count; // number of attributes, from 3 on, copied to varyings, from 0 on
    // Each of the next five is the index of the first of several attributes or varyings, or
    // DIP_ABSENT.
    int normal_attribute;  // three attributes; DIP_ABSENT: the vertices are not lit
    int colour_attribute;  // three attributes; DIP_ABSENT: white
    int light_varying;     // three varyings; DIP_ABSENT: the light is 1
    int colour_varying;    // two varyings: coordinates of the colour texture
    int light_map_varying; // two varyings: coordinates of the light map
    int alpha_varying;     // index of one varying, the alpha of the vertices; DIP_ABSENT: 1
    float base_colour_lin[3];
    float light_map_scale;
    float alpha_cutoff;
    int sample_count; // samples per pixel, for alpha to coverage
    // The next four are set for surfaces whose fragments are lit: by the scene's lights, or with a
    // normal map. Without a normal map, normal_map_varying is DIP_ABSENT.
    int normal_map_varying; // index of the first of two: coordinates of the normal map
    // Bounds of the two coordinates in the sizes of their derivatives (docs/picture.md, Normal
    // maps): 1 along an axis along which all textures repeat, and FLT_MAX along others.
    float coordinate_bounds[2];
    int normal_varying; // index of the first of three: unit normal of the vertex in world space
    int depth_varying;  // index of one varying: clip w
    float roughness;
    const DipViewRays *rays;
    const DipSkyUniforms *sky; // only for sky
    // The next seven are set for surfaces that the scene's lights light.
    const DipLightingUniforms *lighting;
    uint64_t lights;                 // bit i is set if light i may reach the object
    const DipShadowUniforms *shadow; // NULL: nothing keeps the light of a light away
    // Index of the first of three: light of the vertex from the light that has shadows, times the
    // vertex's colour. The light varying then lacks it. DIP_ABSENT unless a surface that is lit at
    // its vertices receives shadows.
    int direct_varying;
    int highlight_varying; // index of the first of three: highlight of the vertex, or DIP_ABSENT
    float specular_lin[3];
    unsigned shininess; // 0..DIP_MAX_SHININESS
    // Of a metallic-roughness surface, which also has the four fields of surfaces whose fragments
    // are lit, `lighting` and `lights`; NULL for other surfaces.
    const DipPbrUniforms *pbr;
    // What lies behind a surface that scatters what it lets through; NULL for other surfaces.
    const DipBackdrop *backdrop;
    // The next three are set for blended surfaces.
    float opacity;
    bool has_alpha; // the alpha of the colour texture and the vertices multiplies the opacity
    DipFragmentShader *colour_shader; // computes the colour
} DipSurfaceUniforms;

// Returns how many of the first varyings the alpha of a clipped surface needs; 0: it has none.
static inline int dip_surface_alpha_varyings(const DipSurfaceUniforms *uniforms) {
    const int of_texture =
        uniforms->colour_varying == DIP_ABSENT ? 0 : uniforms->colour_varying + 2;
    return uniforms->alpha_varying == DIP_ABSENT ? of_texture : uniforms->alpha_varying + 1;
}

#endif
