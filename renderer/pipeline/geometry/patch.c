// Grows patches of triangles that join smoothly.
#include "renderer/pipeline/patch.h"

#include "renderer/base/fp_mode.h"

#include <stdlib.h>
#include <string.h>

// The squared cosine of 20 degrees: the greatest angle between a triangle's normal and the normal
// of the patch's first triangle.
static const double least_cosine2 = 0.883;

#define FREE UINT32_MAX // the triangle has no patch yet

typedef struct Grower {
    const float *positions;
    size_t stride;
    const uint32_t *indices;
    uint32_t *patches;
    uint32_t *first; // vertex v has triangles[first[v]] .. triangles[first[v + 1] - 1]
    uint32_t *triangles;
    uint32_t queue[DIP_PATCH_TRIANGLES]; // triangles of the patch that is growing
    uint32_t queued;
    // Normal of the patch's first triangle. Its length is twice the triangle's area.
    double normal[3];
} Grower;

// Computes a triangle's normal, whose length is twice the triangle's area.
static void find_normal(const Grower *grower, uint32_t triangle, double normal[3]) {
    const float *corner[3];
    for (int k = 0; k < 3; k++) {
        corner[k] = grower->positions + grower->stride * grower->indices[3 * (size_t)triangle + k];
    }
    double edge[2][3];
    for (int axis = 0; axis < 3; axis++) {
        edge[0][axis] = (double)corner[1][axis] - corner[0][axis];
        edge[1][axis] = (double)corner[2][axis] - corner[0][axis];
    }
    for (int axis = 0; axis < 3; axis++) {
        const int b = (axis + 1) % 3;
        const int c = (axis + 2) % 3;
        normal[axis] = edge[0][b] * edge[1][c] - edge[0][c] * edge[1][b];
    }
}

static double dot3(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static bool is_smooth(const Grower *grower, uint32_t triangle) {
    double normal[3];
    find_normal(grower, triangle, normal);
    const double cosine = dot3(normal, grower->normal);
    return cosine > 0.0 && cosine * cosine >= least_cosine2 * dot3(normal, normal) *
                                                  dot3(grower->normal, grower->normal);
}

static bool has_vertex(const uint32_t corners[3], uint32_t vertex) {
    return corners[0] == vertex || corners[1] == vertex || corners[2] == vertex;
}

static void add_triangle(Grower *grower, uint32_t triangle, uint32_t patch) {
    grower->patches[triangle] = patch;
    grower->queue[grower->queued++] = triangle;
}

static uint32_t fan_size(const Grower *grower, uint32_t vertex) {
    return grower->first[vertex + 1] - grower->first[vertex];
}

// Adds the free triangles across edge a-b to the patch, as long as the patch has space. The
// function searches the triangles of vertex a or b, whichever has fewer. If both vertices have more
// than DIP_PATCH_FAN triangles, it searches none. This limits the time for any mesh.
static void add_neighbours(Grower *grower, uint32_t a, uint32_t b, uint32_t patch) {
    const uint32_t end = fan_size(grower, b) < fan_size(grower, a) ? b : a;
    if (fan_size(grower, end) > DIP_PATCH_FAN) {
        return;
    }
    for (uint32_t i = grower->first[end]; i < grower->first[end + 1]; i++) {
        const uint32_t other = grower->triangles[i];
        const uint32_t *corners = grower->indices + 3 * (size_t)other;
        if (grower->queued < DIP_PATCH_TRIANGLES && grower->patches[other] == FREE &&
            has_vertex(corners, a) && has_vertex(corners, b) && is_smooth(grower, other)) {
            add_triangle(grower, other, patch);
        }
    }
}

static void grow(Grower *grower, uint32_t triangle, uint32_t patch) {
    grower->queued = 0;
    find_normal(grower, triangle, grower->normal);
    add_triangle(grower, triangle, patch);
    for (uint32_t i = 0; i < grower->queued; i++) {
        const uint32_t *corners = grower->indices + 3 * (size_t)grower->queue[i];
        for (int k = 0; k < 3; k++) {
            add_neighbours(grower, corners[k], corners[(k + 1) % 3], patch);
        }
    }
}

// Lists the triangles of each vertex.
static void list_triangles(Grower *grower, uint32_t vertex_count, uint32_t index_count) {
    uint32_t *first = grower->first;
    memset(first, 0, ((size_t)vertex_count + 2) * sizeof *first);
    for (uint32_t i = 0; i < index_count; i++) {
        first[grower->indices[i] + 2]++;
    }
    for (uint32_t v = 0; v < vertex_count; v++) {
        first[v + 2] += first[v + 1];
    }
    for (uint32_t i = 0; i < index_count; i++) {
        grower->triangles[first[grower->indices[i] + 1]++] = i / 3;
    }
}

bool dip_patches_find(const float *positions, size_t stride, uint32_t vertex_count,
                      const uint32_t *indices, uint32_t index_count, uint32_t *patches,
                      uint32_t *count) {
    DIP_FP_MODE_SCOPE();
    Grower grower = {.positions = positions,
                     .stride = stride,
                     .indices = indices,
                     .patches = patches,
                     .first = malloc(((size_t)vertex_count + 2) * sizeof *grower.first),
                     .triangles = malloc(((size_t)index_count + 1) * sizeof *grower.triangles)};
    const bool made = grower.first && grower.triangles;
    *count = 0;
    if (made) {
        list_triangles(&grower, vertex_count, index_count);
        memset(patches, 0xff, index_count / 3 * sizeof *patches);
        for (uint32_t t = 0; t < index_count / 3; t++) {
            if (patches[t] == FREE) {
                grow(&grower, t, (*count)++);
            }
        }
    }
    free(grower.first);
    free(grower.triangles);
    return made;
}
