// The scene's own surfaces as clients of the pipeline: the uniforms of their shaders.
#ifndef DIP_RENDERER_SCENE_MATERIALS_SURFACE_H
#define DIP_RENDERER_SCENE_MATERIALS_SURFACE_H

#include <stdbool.h>

// What the materials' shaders count (DipShaderWork.counts).
enum {
    DIP_SHADER_COUNT_NORMAL_MAPPED,
    DIP_SHADER_COUNT_SKY,
    DIP_SHADER_COUNT_REFLECTING,
};

enum {
    DIP_SURFACE_SAMPLER_COLOUR,
    DIP_SURFACE_SAMPLER_LIGHT_MAP,
    DIP_SURFACE_SAMPLER_NORMAL_MAP,
    DIP_SURFACE_SAMPLER_COUNT,
    DIP_ABSENT = -1
};

// The view ray through a place of the target: origin + x * per_x + y * per_y with x and y in
// pixels, in the world; a point's place relative to the eye is its depth (clip w) times its ray.
typedef struct DipViewRays {
    float origin[3];
    float per_x[3];
    float per_y[3];
} DipViewRays;

// A sky at a time, see DipSkyDef.
typedef struct DipSkyUniforms {
    struct {
        float scale;
        float phase; // added to u
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

// Vertex attributes in order: position; then what passes through to the varyings of the same order
// (coordinates); then, where there is a light varying, normal (lit) and vertex colour. Of a
// normal-mapped surface the light varying is the vertex colour alone.
typedef struct DipSurfaceUniforms {
    float to_clip[16];        // row-major
    float normal_to_world[9]; // row-major; directions only, not normalised
    int copied_varying_count; // attributes 3.. that become varyings 0..
    int normal_attribute;     // DIP_ABSENT: not lit
    int colour_attribute;     // DIP_ABSENT: white
    int light_varying;        // three varyings: light times vertex colour; DIP_ABSENT: none
    int colour_varying;       // two varyings: coordinates of the colour texture; or DIP_ABSENT
    int light_map_varying;    // likewise
    float base_colour_lin[3];
    float light_map_scale;
    float alpha_cutoff;
    int normal_map_varying; // two varyings: coordinates of the normal map
    int normal_varying;     // three: unit normal of the vertex in the world
    int depth_varying;      // clip w
    float roughness;
    const DipViewRays *rays; // of normal-mapped surfaces and sky
    const DipSkyUniforms *sky;
} DipSurfaceUniforms;

#endif
