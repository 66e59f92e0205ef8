// Counts edges by sorting them.
#include "tests/renderer/shapes/manifold.h"

#include <stdlib.h>
#include <string.h>

static int compare_edges(const void *a, const void *b) {
    const uint64_t left = *(const uint64_t *)a;
    const uint64_t right = *(const uint64_t *)b;
    return (left > right) - (left < right);
}

EdgeCounts count_edges(const uint32_t *indices, size_t index_count) {
    EdgeCounts counts = {0, 0, 0, 0};
    uint64_t *edges = malloc((index_count + 1) * sizeof *edges);
    for (size_t i = 0; i < index_count; i++) {
        const uint64_t from = indices[i];
        const uint64_t to = indices[i % 3 == 2 ? i - 2 : i + 1];
        edges[i] = from << 32 | to;
        counts.collapsed += from == to;
    }
    qsort(edges, index_count, sizeof *edges, compare_edges);
    for (size_t i = 0; i < index_count; i++) {
        const uint64_t reversed = edges[i] << 32 | edges[i] >> 32;
        counts.repeated += i > 0 && edges[i] == edges[i - 1];
        if (bsearch(&reversed, edges, index_count, sizeof *edges, compare_edges)) {
            counts.inner++;
        } else {
            counts.border++;
        }
    }
    free(edges);
    return counts;
}

typedef struct Place {
    float position[3];
    uint32_t vertex;
} Place;

static int compare_places(const void *a, const void *b) {
    const Place *left = a;
    const Place *right = b;
    for (int i = 0; i < 3; i++) {
        if (left->position[i] != right->position[i]) {
            return left->position[i] < right->position[i] ? -1 : 1;
        }
    }
    return 0;
}

uint32_t join_positions(const float *attributes, size_t stride, uint32_t vertex_count,
                        const uint32_t *indices, size_t index_count, uint32_t *joined) {
    Place *places = malloc((vertex_count + 1) * sizeof *places);
    uint32_t *number = malloc((vertex_count + 1) * sizeof *number);
    for (uint32_t v = 0; v < vertex_count; v++) {
        memcpy(places[v].position, attributes + v * stride, sizeof places[v].position);
        places[v].vertex = v;
    }
    qsort(places, vertex_count, sizeof *places, compare_places);
    uint32_t count = 0;
    for (uint32_t i = 0; i < vertex_count; i++) {
        count += i == 0 || compare_places(&places[i - 1], &places[i]) != 0;
        number[places[i].vertex] = count - 1;
    }
    for (size_t i = 0; i < index_count; i++) {
        joined[i] = number[indices[i]];
    }
    free(places);
    free(number);
    return count;
}

double enclosed_volume(const float *attributes, size_t stride, const uint32_t *indices,
                       size_t index_count) {
    double sum = 0.0;
    for (size_t i = 0; i + 2 < index_count; i += 3) {
        const float *a = attributes + indices[i] * stride;
        const float *b = attributes + indices[i + 1] * stride;
        const float *c = attributes + indices[i + 2] * stride;
        for (int axis = 0; axis < 3; axis++) {
            const int y = (axis + 1) % 3;
            const int z = (axis + 2) % 3;
            sum += a[axis] * ((double)b[y] * c[z] - (double)b[z] * c[y]);
        }
    }
    return sum / 6.0;
}
