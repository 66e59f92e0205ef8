// Checks how the triangles of a shape fit together.
#ifndef DIP_TESTS_RENDERER_SHAPES_MANIFOLD_H
#define DIP_TESTS_RENDERER_SHAPES_MANIFOLD_H

#include <stddef.h>
#include <stdint.h>

// How the directed edges of triangles meet.
typedef struct EdgeCounts {
    size_t inner;     // edges that another triangle has in the opposite direction
    size_t border;    // edges that no triangle has in the opposite direction
    size_t repeated;  // edges that two triangles have in the same direction
    size_t collapsed; // edges whose ends are the same vertex
} EdgeCounts;

EdgeCounts count_edges(const uint32_t *indices, size_t index_count);

// Gives vertices with equal positions the same index. A vertex is a row of `stride` floats, which
// begins with its position. Writes the joined indices to joined[0..index_count-1] and returns the
// number of different positions.
uint32_t join_positions(const float *attributes, size_t stride, uint32_t vertex_count,
                        const uint32_t *indices, size_t index_count, uint32_t *joined);

// Returns the volume that closed triangles enclose, by the divergence theorem. It is positive if
// they wind counter-clockwise as seen from outside.
double enclosed_volume(const float *attributes, size_t stride, const uint32_t *indices,
                       size_t index_count);

#endif
