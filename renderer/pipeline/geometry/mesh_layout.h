// The private layout of a mesh. A mesh consists of chunks of up to 128 triangles. Each chunk is
// culled and transformed as a whole.
#ifndef DIP_RENDERER_PIPELINE_GEOMETRY_MESH_LAYOUT_H
#define DIP_RENDERER_PIPELINE_GEOMETRY_MESH_LAYOUT_H

#include "renderer/pipeline/mesh.h"
#include "renderer/pipeline/shader.h"

enum {
    DIP_CHUNK_TRIANGLES = 128,
    DIP_GROUP_CHUNKS = 32, // number of chunks in a group; each group has a bounding box
};

typedef struct DipChunk {
    DipBox box;
    uint32_t first_vertex;   // index into each attribute's array; a multiple of DIP_BATCH_ALIGN
    uint32_t vertex_count;   // 1..DIP_VERTEX_BATCH
    uint32_t first_index;    // index into `indices` of the mesh
    uint32_t first_triangle; // index into `patches` of the mesh
    uint32_t triangle_count; // 1..DIP_CHUNK_TRIANGLES
} DipChunk;

// Returns the distance between the three rows of a chunk's corners: corner k of triangle t is
// indices[first_index + k * dip_corner_stride(chunk) + t]. Each row is padded with valid indices.
static inline uint32_t dip_corner_stride(const DipChunk *chunk) {
    return (chunk->triangle_count + DIP_BATCH_ALIGN - 1) / DIP_BATCH_ALIGN * DIP_BATCH_ALIGN;
}

struct DipMesh {
    int attribute_count;
    uint32_t chunk_count;
    uint32_t triangle_count;
    // Number of vertices of all chunks, padding included: the length of each attribute's array.
    uint32_t vertex_total;
    DipChunk *chunks;
    DipBox *groups; // box i bounds the group that starts with chunk DIP_GROUP_CHUNKS * i
    DipBox box;
    float *attributes; // attribute a of vertex i: attributes[a * vertex_total + i]
    uint8_t *indices;  // the vertex of each corner, as an index into its chunk's vertices
    // patches[t] is the patch of triangle t of the mesh (patch.h). Reads may go DIP_BATCH_ALIGN
    // elements past the last triangle.
    uint32_t *patches;
    uint32_t patch_count;
    // Only meshes that can be updated have these fields: the caller's vertex from which each of the
    // vertex_total vertices is copied, and the number of the caller's vertices.
    uint32_t *source;
    uint32_t source_count;
    float min[3];
    float max[3];
};

#endif
