// The uniforms of the shaders of the scene's surfaces, which are clients of the pipeline.
#ifndef DIP_RENDERER_SCENE_MATERIALS_SURFACE_H
#define DIP_RENDERER_SCENE_MATERIALS_SURFACE_H

#include <stdbool.h>

// Indices of the counts of the materials' shaders (DipShaderWork.counts): fragments with a normal
// map, of sky with clouds, and of reflecting water.
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
    DIP_ABSENT = -1 // an attribute or varying that a mesh does not have
};

// The view ray through a position (x, y) in pixels of the target is origin + x * per_x + y * per_y,
// in world space. The position of a point relative to the eye is its depth (clip w) times its ray.
typedef struct DipViewRays {
    float origin[3];
    float per_x[3];
    float per_y[3];
} DipViewRays;

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

// A vertex has these attributes, in this order: the position; the texture coordinates, which are
// copied to the first varyings in the same order; the normal, if the surface is lit or
// normal-mapped; and the vertex colour, if the mesh has one. The light varying is the light of the
// vertex times its colour; on a normal-mapped surface it is the vertex colour alone.
typedef struct DipSurfaceUniforms {
    float to_clip[16];        // row-major
    float normal_to_world[9]; // row-major; the turned normals have the right direction, any length
    int copied_varying_count; // attributes from 3 on that are copied to varyings from 0 on
    int normal_attribute;     // first of three; DIP_ABSENT: the vertices are not lit
    int colour_attribute;     // first of three; DIP_ABSENT: white
    int light_varying;        // first of three; DIP_ABSENT: the light is 1
    int colour_varying;       // first of two, coordinates of the colour texture; or DIP_ABSENT
    int light_map_varying;    // first of two, coordinates of the light map; or DIP_ABSENT
    float base_colour_lin[3];
    float light_map_scale;
    float alpha_cutoff;
    int normal_map_varying; // first of two, coordinates of the normal map
    int normal_varying;     // first of three, unit normal of the vertex in world space
    int depth_varying;      // clip w
    float roughness;
    const DipViewRays *rays;   // for normal-mapped surfaces, sky and water
    const DipSkyUniforms *sky; // for sky
} DipSurfaceUniforms;

#endif
