// The net of a patch: the locations of its points in the domain, and its triangles.
#ifndef DIP_RENDERER_SHAPES_PATCH_NET_H
#define DIP_RENDERER_SHAPES_PATCH_NET_H

#include "renderer/shapes/patch/divide.h"

#include <stdint.h>

enum {
    // Most points and triangles: those of a quadrilateral with all factors 64.
    DIP_NET_POINTS = (DIP_MAX_TESSELLATION + 1) * (DIP_MAX_TESSELLATION + 1),
    DIP_NET_TRIANGLES = 2 * DIP_MAX_TESSELLATION * DIP_MAX_TESSELLATION,
};

typedef struct DipPatchNet {
    uint32_t point_count;
    uint32_t index_count;
    float location[3][DIP_NET_POINTS]; // u, v, w
    uint32_t indices[3 * DIP_NET_TRIANGLES];
} DipPatchNet;

// Fills the net of a patch. The triangles wind in the direction of the control points.
void dip_net_fill(DipPatchNet *net, const DipPatchPlan *plan);

#endif
