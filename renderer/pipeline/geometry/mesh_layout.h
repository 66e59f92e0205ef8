// Inside of a mesh: chunks of up to 128 triangles that are culled and transformed as one.
#ifndef DIP_RENDERER_PIPELINE_GEOMETRY_MESH_LAYOUT_H
#define DIP_RENDERER_PIPELINE_GEOMETRY_MESH_LAYOUT_H

#include "renderer/pipeline/mesh.h"
#include "renderer/pipeline/shader.h"

enum {
    DIP_CHUNK_TRIANGLES = 128,
    DIP_GROUP_CHUNKS = 32, // a box holds so many chunks
};

typedef struct DipChunk {
    DipBox box;
    uint32_t first_vertex;   // into each attribute's array; a multiple of DIP_BATCH_ALIGN
    uint32_t vertex_count;   // 1..DIP_VERTEX_BATCH
    uint32_t first_index;    // into the indices
    uint32_t first_triangle; // into the patches
    uint32_t triangle_count; // 1..DIP_CHUNK_TRIANGLES
} DipChunk;

// Corner k of a chunk's triangle t is indices[first_index + k * dip_corner_stride(chunk) + t]; each
// row is padded with valid indices.
static inline uint32_t dip_corner_stride(const DipChunk *chunk) {
    return (chunk->triangle_count + DIP_BATCH_ALIGN - 1) / DIP_BATCH_ALIGN * DIP_BATCH_ALIGN;
}

struct DipMesh {
    int attribute_count;
    uint32_t chunk_count;
    uint32_t triangle_count;
    uint32_t vertex_total; // of all chunks, padded; the length of each attribute's array
    DipChunk *chunks;
    DipBox *groups; // of chunks DIP_GROUP_CHUNKS * i and on
    DipBox box;
    float *attributes; // attribute a of vertex i: attributes[a * vertex_total + i]
    uint8_t *indices;  // within the chunk's vertices
    uint32_t *patches; // of triangle t of the mesh, see patch.h; DIP_BATCH_ALIGN more may be read
    uint32_t patch_count;
    float min[3];
    float max[3];
};

#endif
