// Inside of a mesh: chunks of up to 128 triangles that are culled and transformed as one.
#ifndef DIP_RENDERER_GEOMETRY_MESH_H
#define DIP_RENDERER_GEOMETRY_MESH_H

#include "renderer/mesh.h"

enum { DIP_CHUNK_TRIANGLES = 128 };

typedef struct DipChunk {
    float centre[3];       // of the bounding box
    float extent[3];       // half its size
    uint32_t first_vertex; // into each attribute's array; a multiple of DIP_BATCH_ALIGN
    uint32_t vertex_count; // 1..DIP_VERTEX_BATCH
    uint32_t first_triangle;
    uint32_t triangle_count; // 1..DIP_CHUNK_TRIANGLES
} DipChunk;

struct DipMesh {
    int attribute_count;
    uint32_t chunk_count;
    uint32_t triangle_count;
    uint32_t vertex_total; // of all chunks, padded; the length of each attribute's array
    DipChunk *chunks;
    float *attributes; // attribute a of vertex i: attributes[a * vertex_total + i]
    uint8_t *indices;  // three per triangle, within the chunk's vertices
    float min[3];
    float max[3];
};

#endif
