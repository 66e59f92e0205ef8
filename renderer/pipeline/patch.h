// Patches: a mesh's triangles in small groups that join smoothly. Of a patch, a pixel is shaded
// once (docs/picture.md), so that the edges within a surface cost no shading.
#ifndef DIP_RENDERER_PIPELINE_GEOMETRY_PATCH_H
#define DIP_RENDERER_PIPELINE_GEOMETRY_PATCH_H

#include "renderer/base/api.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    DIP_PATCH_TRIANGLES = 16, // at most
    DIP_PATCH_FAN = 64,       // edges between vertices of more triangles are not crossed
};

// Puts triangle t = indices[3 t .. 3 t + 2] into patch patches[t], 0 <= patches[t] < *count. A
// patch grows from the first free triangle to its neighbours, nearest first, over shared edges (two
// common vertices, by index), while their normals stay within 20 degrees of the first one's.
// positions: x, y, z of vertex v from positions[v * stride] on. Triangles without an area, or with
// corners that are not finite, are patches of their own. The same patches on every machine; any
// thread. False when memory runs out.
DIP_API bool dip_patches_find(const float *positions, size_t stride, uint32_t vertex_count,
                              const uint32_t *indices, uint32_t index_count, uint32_t *patches,
                              uint32_t *count);

#ifdef __cplusplus
}
#endif

#endif
