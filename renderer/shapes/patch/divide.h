// Plans of patches: into how many parts the edges and the inside of a patch are divided, and where
// the points between the parts lie.
//
// The rules are those of the fixed-function tessellator of Direct3D 11 (D3D11.3 functional
// specification, section 11.7). Positions on an edge are fixed-point numbers, 0..DIP_PLACE_ONE.
#ifndef DIP_RENDERER_SHAPES_PATCH_DIVIDE_H
#define DIP_RENDERER_SHAPES_PATCH_DIVIDE_H

#include "renderer/shapes/tessellate.h"

#include <stdbool.h>
#include <stdint.h>

enum { DIP_PLACE_ONE = 1 << 16 };

// The points 0..parts that divide an edge. Between two whole numbers of parts, each point slides
// from its position on the coarser division to that on the finer one.
typedef struct DipDivision {
    int parts;            // number of parts
    int split;            // points after this one have a lower number on the coarser division
    uint32_t coarse_step; // length of a part of the coarser division
    uint32_t fine_step;   // length of a part of the finer division
    uint32_t fraction;    // 0..65535: how far points have slid to the finer division
} DipDivision;

// Returns the position of point p, 0..parts. Point parts - p is at the mirrored position.
uint32_t dip_division_place(const DipDivision *division, int p);

// How a patch is divided.
typedef struct DipPatchPlan {
    bool left_out;  // the patch has no points
    bool undivided; // the patch has its control points only
    int edge_count; // 3 or 4
    DipDivision edge[4];
    DipDivision inside[2]; // a triangle has one
} DipPatchPlan;

// Plans a patch. The factors must not be NaN.
DipPatchPlan dip_patch_plan(const DipTessellationFactors *factors, DipDomain domain,
                            DipPartitioning partitioning);

typedef struct DipPatchCounts {
    uint64_t points;
    uint64_t triangles;
} DipPatchCounts;

// Counts the points and triangles of a patch.
DipPatchCounts dip_patch_count(const DipPatchPlan *plan);

#endif
