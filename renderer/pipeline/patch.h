// Patches: small groups of a mesh's triangles that join smoothly. A pixel is shaded once per patch
// (docs/picture.md, Shading), so edges inside a patch cost no extra shading.
#ifndef DIP_RENDERER_PIPELINE_PATCH_H
#define DIP_RENDERER_PIPELINE_PATCH_H

#include "renderer/base/api.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    DIP_PATCH_TRIANGLES = 16, // most triangles of a patch
    // A patch does not grow across an edge if both its vertices have more triangles than this.
    DIP_PATCH_FAN = 64,
};

// Divides a mesh into patches. Triangle t has the vertices indices[3 t .. 3 t + 2] and belongs to
// patch patches[t], 0 <= patches[t] < *count. A patch starts with the first triangle that has no
// patch yet. It grows across shared edges (two common vertex indices), breadth first. It takes the
// triangles whose normals are within 20 degrees of its first triangle's normal. positions: x, y and
// z of vertex v start at positions[v * stride]. A triangle without area, or with a corner that is
// not finite, is a patch of its own. The patches are the same on every machine. Thread-safe.
// Returns false if memory runs out.
DIP_API bool dip_patches_find(const float *positions, size_t stride, uint32_t vertex_count,
                              const uint32_t *indices, uint32_t index_count, uint32_t *patches,
                              uint32_t *count);

#ifdef __cplusplus
}
#endif

#endif
