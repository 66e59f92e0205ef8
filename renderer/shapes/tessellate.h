// Tessellation: divides patches (triangles or quadrilaterals) into small triangles, as the
// fixed-function tessellator of Direct3D 11 does, and calls the caller's function for each new
// vertex.
//
// A patch has a domain: locations u, v, w with u + v + w = 1 for a triangle, or u, v in 0..1 for a
// quadrilateral. Locations are multiples of 2^-16, and the points of an edge are the same from both
// of its ends. Two patches that share an edge therefore have no crack between them, provided that
// the edge has the same factor in both, and that the domain function computes a point of the edge
// from the edge's two control points alone, in a form that does not depend on their order.
// `A u + B v + C w`, evaluated in floats without fused operations, is such a form, because the
// third term is exactly 0 there.
//
// The term "patch" is Direct3D's here. It is not the patch of joined triangles in patch.h.
#ifndef DIP_RENDERER_SHAPES_TESSELLATE_H
#define DIP_RENDERER_SHAPES_TESSELLATE_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"
#include "renderer/shapes/shapes.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { DIP_MAX_TESSELLATION = 64 }; // greatest factor

typedef enum DipDomain {
    DIP_DOMAIN_TRIANGLE, // three control points, at (1,0,0), (0,1,0) and (0,0,1)
    DIP_DOMAIN_QUAD,     // four control points, at (0,0), (1,0), (1,1) and (0,1)
    DIP_DOMAIN_COUNT
} DipDomain;

// How a factor becomes parts of an edge.
typedef enum DipPartitioning {
    // The factor is clamped to 1..64 and rounded up; the parts have the same length.
    DIP_PARTITIONING_INTEGER,
    // The factor is clamped to 1..63. The number of parts is odd. Between two odd factors, two
    // parts grow from nothing, so that a changing factor moves points but makes none appear
    // suddenly.
    DIP_PARTITIONING_FRACTIONAL_ODD,
    DIP_PARTITIONING_COUNT
} DipPartitioning;

// The factors of a patch. Factors above the greatest one are clamped. A patch is left out if one of
// its edge factors is 0 or negative. No factor may be NaN.
typedef struct DipTessellationFactors {
    // Triangle: the edges u = 0, v = 0 and w = 0; edge[3] is not used. Edge i lies opposite control
    // point i. Quadrilateral: the edges u = 0, v = 0, u = 1 and v = 1.
    float edge[4];
    // Triangle: inside[0]. Quadrilateral: along u, along v.
    float inside[2];
} DipTessellationFactors;

// Points of one patch. Element i of an array belongs to point i.
typedef struct DipDomainBatch {
    int count; // at least 1
    uint32_t patch;
    const float *control[4]; // attributes of the patch's control points; three for a triangle
    const float *u;
    const float *v;
    const float *w; // triangles only, else NULL
    float *out;     // count rows of out_attribute_count floats
    int out_attribute_count;
    const void *uniforms; // uniforms of the tessellation
} DipDomainBatch;

// Computes the attributes of new vertices. It is called on the caller's thread, patch by patch, for
// all points of a patch at once.
typedef void DipDomainFunction(const DipDomainBatch *batch);

typedef struct DipTessellationDef {
    DipDomain domain;
    DipPartitioning partitioning;
    // Control points: vertex_count rows of attribute_count floats.
    const float *attributes;
    int attribute_count; // at least 1
    uint32_t vertex_count;
    // Control points of the patches: three for each triangle or four for each quadrilateral.
    const uint32_t *indices;
    uint32_t index_count;
    const DipTessellationFactors *factors; // one for each patch, or one for all of them
    bool same_factors;                     // factors[0] is that of every patch
    DipDomainFunction *function;
    int out_attribute_count; // floats per new vertex: 1..DIP_MAX_ATTRIBUTES (shader.h)
    const void *uniforms;
} DipTessellationDef;

// Tessellates patches. The new triangles wind in the direction of their patch's control points.
// Patches share no vertices. *shape is overwritten, so it must not own arrays; it has
// out_attribute_count attributes. The result may be empty. The function fails with RANGE (a factor
// is NaN, an index or a number is out of range), MISSING (a pointer is NULL), FORMAT (index_count
// is not a multiple of 3 or 4), OVERSIZED (the result has more than 2^30 indices) or MEMORY. The
// error's key is the field. Then *shape is all 0.
DIP_API bool dip_tessellate(DipShape *shape, const DipTessellationDef *def, DipError *err);

// Domain function for triangles and quadrilaterals whose attributes are interpolated linearly, or
// bilinearly: out attribute a is interpolated from attribute a of the control points.
// attribute_count must be at least out_attribute_count.
DIP_API void dip_domain_linear(const DipDomainBatch *batch);

#ifdef __cplusplus
}
#endif

#endif
