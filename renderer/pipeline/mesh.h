// Vertex and index data as the pipeline draws it: split into chunks with bounds, structure-of-
// arrays, immutable.
#ifndef DIP_RENDERER_PIPELINE_MESH_H
#define DIP_RENDERER_PIPELINE_MESH_H

#include "renderer/base/error.h"
#include "renderer/pipeline/shader.h"

#include <stdint.h>

typedef struct DipMesh DipMesh;

// attributes: vertex_count rows of attribute_count floats; the first three are a position and
// give the bounds. Copied.
typedef struct DipMeshData {
    const char *name;
    const float *attributes;
    int attribute_count; // 3..DIP_MAX_ATTRIBUTES
    uint32_t vertex_count;
    const uint32_t *indices;
    uint32_t index_count; // a multiple of 3, at most 2^30
} DipMeshData;

// Fails when an index or number is out of range, a position is not finite, or memory runs out.
DipMesh *dip_mesh_create(const DipMeshData *data, DipError *err);
void dip_mesh_destroy(DipMesh **mesh);

uint32_t dip_mesh_triangle_count(const DipMesh *mesh);
void dip_mesh_bounds(const DipMesh *mesh, float min[3], float max[3]);

#endif
