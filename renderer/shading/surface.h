// The scene's own surfaces as clients of the pipeline: the uniforms of their shaders.
#ifndef DIP_RENDERER_SHADING_SURFACE_H
#define DIP_RENDERER_SHADING_SURFACE_H

#include <stdbool.h>

enum {
    DIP_SURFACE_SAMPLER_COLOUR,
    DIP_SURFACE_SAMPLER_LIGHT_MAP,
    DIP_SURFACE_SAMPLER_COUNT,
    DIP_NO_SLOT = -1
};

// Vertex attributes in order: position; then what passes through to the slots of the same order
// (coordinates); then, where there is a light slot, normal (lit) and vertex colour.
typedef struct DipSurfaceUniforms {
    float to_clip[16];        // row-major
    float normal_to_world[9]; // row-major; directions only, not normalised
    int pass_count;           // attributes 3.. that become slots 0..
    int normal_attribute;     // DIP_NO_SLOT: not lit
    int colour_attribute;     // DIP_NO_SLOT: white
    int light_slot;           // three slots: light times vertex colour; DIP_NO_SLOT: none
    int colour_slot;          // two slots: coordinates of the colour texture; or DIP_NO_SLOT
    int light_map_slot;       // likewise
    float base_colour_lin[3];
    float light_map_scale;
    float alpha_cutoff;
} DipSurfaceUniforms;

#endif
