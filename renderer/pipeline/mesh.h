// Meshes: the vertices and indices that the pipeline draws. A mesh is split into chunks of
// triangles, and each chunk has a bounding box, so that chunks out of view are left out early. The
// chunks keep the order of the indices, in which ordered draws (state.h) take effect. A mesh is
// immutable, unless it is made by dip_mesh_create_updatable.
#ifndef DIP_RENDERER_PIPELINE_MESH_H
#define DIP_RENDERER_PIPELINE_MESH_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct DipMesh DipMesh;

// The data of a mesh. attributes: vertex_count rows of attribute_count floats. The first three
// floats of a row are the vertex's position, from which the bounds are computed.
typedef struct DipMeshData {
    const char *name;
    const float *attributes;
    int attribute_count; // 3..DIP_MAX_ATTRIBUTES (shader.h)
    uint32_t vertex_count;
    const uint32_t *indices;
    uint32_t index_count; // a multiple of 3, at most 2^30
} DipMeshData;

// An axis-aligned box.
typedef struct DipBox {
    float centre[3];
    float extent[3]; // half of the box's size along each axis
} DipBox;

// Makes an immutable mesh from a copy of the data. Any thread may use the mesh. Fails with RANGE if
// an index or attribute_count is out of range or a position is not finite, with MISSING if data,
// attributes or indices are NULL, with FORMAT if
// index_count is not a multiple of 3, with OVERSIZED if index_count is above 2^30, and with MEMORY.
DIP_API DipMesh *dip_mesh_create(const DipMeshData *data, DipError *err);

// Makes a mesh that dip_mesh_update can change. It needs 4 more bytes for each vertex of its
// chunks. Its triangles are not joined to patches (patch.h), because they may fold when their
// vertices move: each triangle is shaded by itself, so pixels at edges between triangles are shaded
// more than once. Fails as dip_mesh_create does.
DIP_API DipMesh *dip_mesh_create_updatable(const DipMeshData *data, DipError *err);

// Gives a mesh new attributes for the vertices that it was made from: as many rows of as many
// floats as its data had. Triangles and their division into chunks stay; the chunks' boxes are
// computed again. Afterwards, the mesh draws the same pictures as a new updatable mesh with these
// attributes. The function allocates nothing. Its time is that of copying each attribute of each
// chunk's vertices, of which there are more than the caller's, because neighbouring chunks have
// copies of their common vertices. No draw and no other thread may use the mesh during the call.
// Fails with CONFLICT if the mesh was made by dip_mesh_create, and with RANGE if a position is not
// finite; the mesh is then unchanged.
DIP_API bool dip_mesh_update(DipMesh *mesh, const float *attributes, DipError *err);

// Returns a copy that shares no memory with the mesh, or NULL if memory runs out.
DIP_API DipMesh *dip_mesh_copy(const DipMesh *mesh);

// Frees a mesh that no draw uses any more. *mesh may be NULL and becomes NULL.
DIP_API void dip_mesh_destroy(DipMesh **mesh);

DIP_API uint32_t dip_mesh_triangle_count(const DipMesh *mesh);
DIP_API size_t dip_mesh_bytes(const DipMesh *mesh); // bytes of vertices, indices and bounds

// Writes the exact bounds of the positions. They are all 0 for a mesh without triangles.
DIP_API void dip_mesh_bounds(const DipMesh *mesh, float min[3], float max[3]);

// Returns the box by which the pipeline culls the mesh. The box contains the exact bounds.
DIP_API DipBox dip_mesh_box(const DipMesh *mesh);

// A mesh's triangles are divided into chunks of 1 to 128 triangles. Triangle t of a chunk has the
// positions corners[0], corners[1] and corners[2], in the winding order of the indices.
DIP_API uint32_t dip_mesh_chunk_count(const DipMesh *mesh);
DIP_API DipBox dip_mesh_chunk_box(const DipMesh *mesh, uint32_t chunk);
DIP_API uint32_t dip_mesh_chunk_triangle_count(const DipMesh *mesh, uint32_t chunk);
DIP_API void dip_mesh_chunk_triangle(const DipMesh *mesh, uint32_t chunk, uint32_t triangle,
                                     float corners[3][3]);

#ifdef __cplusplus
}
#endif

#endif
