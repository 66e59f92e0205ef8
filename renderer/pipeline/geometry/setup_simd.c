// Triangle set-up, compiled once per instruction set. Set-up first rejects the triangles of a batch
// that are certainly not drawn. Then it computes the edges, the depth and the shading planes of the
// remaining triangles.
//
// Planes are computed in double precision, so that slivers keep their precision. They are stored as
// floats relative to an anchor (triangle.h). Counted in 1/256 pixel, rounded positions are below
// 2^22 in magnitude, and edges are below 2^23. Areas and edge constants are therefore whole numbers
// that doubles hold exactly.
#include "renderer/base/pages.h"
#include "renderer/pipeline/geometry/repeat.h"
#include "renderer/pipeline/geometry/setup.h"
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/simd/half.h"

#include <stddef.h>

enum { ROOM = DIP_SETUP_BATCH + DIP_BATCH_ALIGN };

// The triangles that rejection keeps. Their vertices are reordered so that the area is positive.
typedef struct Candidates {
    _Alignas(DIP_CACHE_LINE) int32_t corner[3][ROOM];
    int32_t x[3][ROOM];
    int32_t y[3][ROOM];
    int32_t patch[ROOM];
    int32_t first_pixel[ROOM]; // first pixel of the triangle's pixel box, x | y << 16
    int32_t last_pixel[ROOM];  // last pixel of the pixel box (inclusive), x | y << 16
} Candidates;

// --- rejection ---------------------------------------------------------------------------------

VEC_INLINE Hi least3(const Hi v[3]) {
    return hi_min(hi_min(v[0], v[1]), v[2]);
}

VEC_INLINE Hi greatest3(const Hi v[3]) {
    return hi_max(hi_max(v[0], v[1]), v[2]);
}

// Finds the range of pixels along one axis, within 0..limit-1, that may have a sample between the
// triangle's least and greatest corner. Within a pixel, samples lie in sample_min..sample_max.
VEC_INLINE void pixel_range(const Hi at[3], int sample_min, int sample_max, int limit, Hi *first,
                            Hi *last) {
    *first = hi_max((least3(at) + (DIP_SUBPIXELS - 1 - sample_max)) >> 8, hi_splat(0));
    *last = hi_min((greatest3(at) - sample_min) >> 8, hi_splat(limit - 1));
}

// Returns twice the area, in squares of 1/256 pixel. The area of a front face is negative: a front
// face winds counter-clockwise on the screen, and y points down.
VEC_INLINE Vd signed_area(const Hi x[3], const Hi y[3]) {
    return vd_from_int(x[1] - x[0]) * vd_from_int(y[2] - y[0]) -
           vd_from_int(x[2] - x[0]) * vd_from_int(y[1] - y[0]);
}

VEC_INLINE void swap_if(Hi m, Hi *a, Hi *b) {
    const Hi old = *a;
    *a = hi_select(m, *b, old);
    *b = hi_select(m, old, *b);
}

// Limit of a small triangle's width and height, in 1/256 pixel. Products of such distances, and
// differences of these products, fit into 32 bits.
enum { SMALL = 1 << 14 };

VEC_INLINE Hi is_small(const Hi at[3]) {
    return greatest3(at) - least3(at) < SMALL;
}

// Returns for each triangle whether it covers a sample of `pixel`, the only pixel of its pixel box.
// The triangles must be small (is_small) and have a positive area.
VEC_INLINE Hi covers_pixel(const DipSamplePositions *samples, const Hi x[3], const Hi y[3],
                           const Hi pixel[2]) {
    Hi covers = hi_splat(0);
    for (int s = 0; s < samples->count; s++) {
        const Hi at_x = pixel[0] * DIP_SUBPIXELS + samples->x[s];
        const Hi at_y = pixel[1] * DIP_SUBPIXELS + samples->y[s];
        Hi inside = hi_splat(-1);
        for (int i = 0; i < 3; i++) {
            const Hi dx = x[(i + 1) % 3] - x[i];
            const Hi dy = y[(i + 1) % 3] - y[i];
            const Hi edge = hi_cross(dx, at_y - y[i], dy, at_x - x[i]);
            const Hi top_left = (dy < 0) | ((dy == 0) & (dx > 0));
            inside &= (edge > 0) | ((edge == 0) & top_left);
        }
        covers |= inside;
    }
    return covers;
}

// Tests one vector of triangles, and appends the triangles that pass to the `count` candidates.
// Returns the new count.
VEC_INLINE int keep_candidates(const DipSetupTarget *target, const DipSetupBatch *batch, int at,
                               int count, Candidates *out) {
    Hi corner[3];
    Hi x[3];
    Hi y[3];
    for (int k = 0; k < 3; k++) {
        corner[k] = hi_load_bytes(batch->corner[k] + at);
        x[k] = hi_gather(batch->screen->x, corner[k]);
        y[k] = hi_gather(batch->screen->y, corner[k]);
    }
    const Vd area = signed_area(x, y);
    const Hi front = hi_condition(area < 0.0);
    const Hi back = hi_condition(area > 0.0);
    const Hi facing = (front & hi_splat(target->cull == DIP_CULL_FRONT ? 0 : -1)) |
                      (back & hi_splat(target->cull == DIP_CULL_BACK ? 0 : -1));
    if (!hi_mask_bits(facing)) {
        return count; // neighbouring triangles often face away together
    }
    Hi first[2];
    Hi last[2];
    pixel_range(x, target->sample_min[0], target->sample_max[0], target->width, &first[0],
                &last[0]);
    pixel_range(y, target->sample_min[1], target->sample_max[1], target->height, &first[1],
                &last[1]);
    Hi kept = facing & (first[0] <= last[0]) & (first[1] <= last[1]);
    for (int axis = 0; axis < 2; axis++) {
        kept &= (first[axis] <= hi_splat(target->region_last[axis])) &
                (last[axis] >= hi_splat(target->region_first[axis]));
    }
    unsigned bits = hi_mask_bits(kept);
    if (batch->count - at < DIP_HALF_LANES) {
        bits &= (1u << (batch->count - at)) - 1;
    }
    if (!bits) {
        return count;
    }
    swap_if(front, &corner[1], &corner[2]);
    swap_if(front, &x[1], &x[2]);
    swap_if(front, &y[1], &y[2]);
    const Hi one_pixel = (first[0] == last[0]) & (first[1] == last[1]) & is_small(x) & is_small(y);
    if (hi_mask_bits(one_pixel) & bits) {
        bits &= hi_mask_bits(~one_pixel | covers_pixel(target->samples, x, y, first));
    }
    for (int k = 0; k < 3; k++) {
        hi_store_packed(out->corner[k] + count, corner[k], bits);
        hi_store_packed(out->x[k] + count, x[k], bits);
        hi_store_packed(out->y[k] + count, y[k], bits);
    }
    const Hi patch = hi_load((const int32_t *)batch->patch + at);
    const Hi flag = front & (int32_t)target->front_flag;
    hi_store_packed(out->patch + count, patch + flag + (int32_t)target->first_patch, bits);
    hi_store_packed(out->first_pixel + count, first[0] | first[1] << 16, bits);
    hi_store_packed(out->last_pixel + count, last[0] | last[1] << 16, bits);
    return count + __builtin_popcount(bits);
}

// Fills up the last vector of candidates with copies of the last candidate.
static void pad(Candidates *candidates, int count) {
    const int last = count - 1;
    for (int i = count; i % DIP_HALF_LANES; i++) {
        for (int k = 0; k < 3; k++) {
            candidates->corner[k][i] = candidates->corner[k][last];
            candidates->x[k][i] = candidates->x[k][last];
            candidates->y[k][i] = candidates->y[k][last];
        }
        candidates->patch[i] = candidates->patch[last];
        candidates->first_pixel[i] = candidates->first_pixel[last];
        candidates->last_pixel[i] = candidates->last_pixel[last];
    }
}

// --- planes ------------------------------------------------------------------------------------

// One vector of triangles. All vertices are in 1/256 pixel; vertex 0 and the two edges that start
// at it are also in pixels.
typedef struct TriangleVector {
    Hi corner[3];
    Hi x[3];
    Hi y[3];
    Hi patch;
    Hi first_pixel;
    Hi last_pixel;
    Vd x0, y0;             // vertex 0, pixels
    Vd x10, y10, x20, y20; // edges from vertex 0 to vertices 1 and 2, pixels
    Vd inverse_area;       // 1 / (x10 y20 - x20 y10)
} TriangleVector;

// The gradient of a value that is affine over the screen. The value at (x, y) is the value at
// vertex 0, plus dx (x - x0) + dy (y - y0).
typedef struct Gradient {
    Vd dx; // change per pixel
    Vd dy;
} Gradient;

VEC_INLINE Gradient gradient(const TriangleVector *tri, const Vd value[3]) {
    const Vd v10 = value[1] - value[0];
    const Vd v20 = value[2] - value[0];
    return (Gradient){(v10 * tri->y20 - v20 * tri->y10) * tri->inverse_area,
                      (v20 * tri->x10 - v10 * tri->x20) * tri->inverse_area};
}

VEC_INLINE Vd to_pixels(Hi subpixels) {
    return vd_from_int(subpixels) * (1.0 / DIP_SUBPIXELS);
}

VEC_INLINE TriangleVector load_triangles(const Candidates *candidates, int at) {
    TriangleVector tri;
    for (int k = 0; k < 3; k++) {
        tri.corner[k] = hi_load(candidates->corner[k] + at);
        tri.x[k] = hi_load(candidates->x[k] + at);
        tri.y[k] = hi_load(candidates->y[k] + at);
    }
    tri.patch = hi_load(candidates->patch + at);
    tri.first_pixel = hi_load(candidates->first_pixel + at);
    tri.last_pixel = hi_load(candidates->last_pixel + at);
    tri.x0 = to_pixels(tri.x[0]);
    tri.y0 = to_pixels(tri.y[0]);
    tri.x10 = to_pixels(tri.x[1] - tri.x[0]);
    tri.y10 = to_pixels(tri.y[1] - tri.y[0]);
    tri.x20 = to_pixels(tri.x[2] - tri.x[0]);
    tri.y20 = to_pixels(tri.y[2] - tri.y[0]);
    tri.inverse_area = 1.0 / (tri.x10 * tri.y20 - tri.x20 * tri.y10);
    return tri;
}

VEC_INLINE void gather3(const float *values, const Hi corner[3], Hf out[3]) {
    for (int k = 0; k < 3; k++) {
        out[k] = hf_gather(values, corner[k]);
    }
}

// Computes edge i, from vertex i to the next: E(p) = dx (py - y) - dy (px - x), where (x, y) is any
// point on the edge and dx and dy are in pixels. By the top-left rule, a sample exactly on the edge
// is inside only if the edge is a top edge (horizontal, going right) or a left edge (going up).
VEC_INLINE void set_edge(const TriangleVector *tri, int i, Vd dx, Vd dy, Vd x, Vd y, Hi *a, Hi *b,
                         Vl *c) {
    const int next = (i + 1) % 3;
    const Hi subpixels_x = tri->x[next] - tri->x[i];
    const Hi subpixels_y = tri->y[next] - tri->y[i];
    const Hi top_left = (subpixels_y < 0) | ((subpixels_y == 0) & (subpixels_x > 0));
    *a = -subpixels_y;
    *b = subpixels_x;
    const double unit = DIP_SUBPIXELS * DIP_SUBPIXELS;
    *c = vl_from_whole((dy * x - dx * y) * unit) + ~vl_condition(top_left);
}

// Stores a vector of DipTriangles as 64-bit words, in the order of DipTriangle's fields.
VEC_INLINE void store_triangles(const TriangleVector *tri, const DipScreenBatch *screen,
                                uint32_t draw, DipTriangle *out) {
    Hi a[3];
    Hi b[3];
    Vl c[3];
    const Vd x0 = tri->x0;
    const Vd y0 = tri->y0;
    set_edge(tri, 0, tri->x10, tri->y10, x0, y0, &a[0], &b[0], &c[0]);
    set_edge(tri, 1, tri->x20 - tri->x10, tri->y20 - tri->y10, x0 + tri->x10, y0 + tri->y10, &a[1],
             &b[1], &c[1]);
    set_edge(tri, 2, -tri->x20, -tri->y20, x0, y0, &a[2], &b[2], &c[2]);
    Hf z[3];
    gather3(screen->z, tri->corner, z);
    const Vd depth[3] = {vd_from_float(z[0]), vd_from_float(z[1]), vd_from_float(z[2])};
    const Gradient slope = gradient(tri, depth);
    const Vd origin = depth[0] - slope.dx * tri->x0 - slope.dy * tri->y0;
    const Hf low = hf_select(z[0] < z[1], z[0], z[1]);
    const Hf high = hf_select(z[0] > z[1], z[0], z[1]);
    const Vl words[3][4] = {
        {c[0], c[1], c[2], vl_pair(a[0], a[1])},
        {vl_pair(a[2], b[0]), vl_pair(b[1], b[2]), vl_pair(tri->first_pixel, tri->last_pixel),
         vl_pair(hi_splat((int32_t)draw), tri->patch)},
        {(Vl)origin, (Vl)slope.dx, (Vl)slope.dy,
         vl_pair((Hi)hf_select(low < z[2], low, z[2]), (Hi)hf_select(high > z[2], high, z[2]))},
    };
    _Static_assert(sizeof(DipTriangle) == sizeof(int64_t[3][4]) && offsetof(DipTriangle, a) == 24 &&
                       offsetof(DipTriangle, b) == 36 && offsetof(DipTriangle, x0) == 48 &&
                       offsetof(DipTriangle, x1) == 52 && offsetof(DipTriangle, draw) == 56 &&
                       offsetof(DipTriangle, patch) == 60 &&
                       offsetof(DipTriangle, z_origin) == 64 && offsetof(DipTriangle, z_min) == 88,
                   "store_triangles writes DipTriangle word by word");
    for (int i = 0; i < 3; i++) {
        vl_store_rows((char *)out + 32 * i, sizeof *out, words[i]);
    }
}

// Finds the anchor of a triangle's planes. The function takes the box of target pixels that the
// triangle touches, and chooses the corner of the box at which 1/w is smallest in magnitude. The
// box does not depend on sample positions, so all passes with the same geometry have the same
// planes.
VEC_INLINE void find_anchor(const TriangleVector *tri, const DipSetupTarget *target, Vd rw0,
                            const Gradient *q, Vd anchor[2]) {
    Hi first[2];
    Hi last[2];
    pixel_range(tri->x, 0, DIP_SUBPIXELS - 1, target->width, &first[0], &last[0]);
    pixel_range(tri->y, 0, DIP_SUBPIXELS - 1, target->height, &first[1], &last[1]);
    Vd best = vd_splat(1e300);
    anchor[0] = anchor[1] = vd_splat(0.0);
    for (int corner = 0; corner < 4; corner++) {
        const Vd at_x = vd_from_int(corner & 1 ? last[0] + 1 : first[0]);
        const Vd at_y = vd_from_int(corner & 2 ? last[1] + 1 : first[1]);
        const Vd size = vd_abs(rw0 + q->dx * (at_x - tri->x0) + q->dy * (at_y - tri->y0));
        const Vl smaller = size < best;
        best = vd_select(smaller, size, best);
        anchor[0] = vd_select(smaller, at_x, anchor[0]);
        anchor[1] = vd_select(smaller, at_y, anchor[1]);
    }
}

// Fills in a plane: its value at the anchor, and its derivatives along x and y.
VEC_INLINE void set_plane(Hf plane[3], Vd value, const Gradient *g, const Vd to_anchor[2]) {
    plane[0] = hf_from_double(value + g->dx * to_anchor[0] + g->dy * to_anchor[1]);
    plane[1] = hf_from_double(g->dx);
    plane[2] = hf_from_double(g->dy);
}

// Reduces a repeating varying by its nearest multiple of DIP_REPEAT_STEP at the corner that is
// nearest to the eye. The difference is exact, unless a corner's value is tiny beside the multiple.
VEC_INLINE void reduce_repeat(const Vd rw[3], Vd value[3]) {
    const Vl second = rw[1] > rw[0];
    const Vd nearer = vd_select(second, rw[1], rw[0]);
    const Vd nearest = vd_select(rw[2] > nearer, value[2], vd_select(second, value[1], value[0]));
    const Vd steps = nearest * (1.0 / DIP_REPEAT_STEP);
    const Vd repeat = ((steps + DIP_REPEAT_ROUNDER) - DIP_REPEAT_ROUNDER) * DIP_REPEAT_STEP;
    for (int k = 0; k < 3; k++) {
        value[k] -= repeat;
    }
}

VEC_INLINE void store_planes(const TriangleVector *tri, const DipSetupTarget *target,
                             const DipSetupBatch *batch, float *out) {
    Hf values[(DIP_PLANES_VARYINGS + 3 * DIP_MAX_VARYINGS + DIP_PLANES_ALIGN - 1) /
              DIP_PLANES_ALIGN * DIP_PLANES_ALIGN];
    Hf corner[3];
    gather3(batch->screen->rw, tri->corner, corner);
    const Vd rw[3] = {vd_from_float(corner[0]), vd_from_float(corner[1]), vd_from_float(corner[2])};
    const Gradient q = gradient(tri, rw);
    Vd anchor[2];
    find_anchor(tri, target, rw[0], &q, anchor);
    const Vd to_anchor[2] = {anchor[0] - tri->x0, anchor[1] - tri->y0};
    values[DIP_PLANES_ANCHOR] = hf_from_double(anchor[0]);
    values[DIP_PLANES_ANCHOR + 1] = hf_from_double(anchor[1]);
    set_plane(values + DIP_PLANES_RW, rw[0], &q, to_anchor);
    for (int s = 0; s < target->varying_count; s++) {
        gather3(batch->varyings + s * batch->varying_stride, tri->corner, corner);
        Vd value[3] = {vd_from_float(corner[0]), vd_from_float(corner[1]),
                       vd_from_float(corner[2])};
        if (target->repeating_varyings >> s & 1) {
            reduce_repeat(rw, value);
        }
        for (int k = 0; k < 3; k++) {
            value[k] *= rw[k];
        }
        const Gradient g = gradient(tri, value);
        set_plane(values + DIP_PLANES_VARYINGS + 3 * s, value[0], &g, to_anchor);
    }
    const int used = dip_plane_floats(target->varying_count);
    for (int f = used; f % DIP_PLANES_ALIGN; f++) {
        values[f] = (Hf){0};
    }
    for (int f = 0; f < used; f += DIP_PLANES_ALIGN) {
        Vl words[4];
        for (int i = 0; i < 4; i++) {
            words[i] = vl_pair((Hi)values[f + 2 * i], (Hi)values[f + 2 * i + 1]);
        }
        vl_store_rows(out + f, (size_t)target->plane_stride * sizeof *out, words);
    }
}

// -----------------------------------------------------------------------------------------------

// Set-up prefetches the space of the triangles that it writes after this many others. This space
// was last touched in the frame before, so it is seldom in the caches, and stores to it would wait.
enum { PREFETCH_AHEAD = 16 };

VEC_INLINE void prefetch_to_write(uintptr_t first, size_t size_bytes) {
    for (size_t b = 0; b < size_bytes; b += DIP_CACHE_LINE) {
        __builtin_prefetch((const void *)(first + b), 1);
    }
}

// Prefetches the space of a vector of triangles and of their planes, PREFETCH_AHEAD triangles after
// those at `triangles` and `planes`. It may lie beyond the end of the arrays.
VEC_INLINE void prefetch_space(const DipTriangle *triangles, const float *planes,
                               int plane_stride) {
    const size_t plane_bytes = (size_t)plane_stride * sizeof *planes;
    prefetch_to_write((uintptr_t)triangles + PREFETCH_AHEAD * sizeof *triangles,
                      DIP_HALF_LANES * sizeof *triangles);
    prefetch_to_write((uintptr_t)planes + PREFETCH_AHEAD * plane_bytes,
                      DIP_HALF_LANES * plane_bytes);
}

int DIP_KERNEL(dip_kernel_setup)(const DipSetupTarget *target, const DipSetupBatch *batch,
                                 DipTriangle *triangles, float *planes) {
    Candidates candidates;
    int count = 0;
    for (int i = 0; i < batch->count; i += DIP_HALF_LANES) {
        count = keep_candidates(target, batch, i, count, &candidates);
    }
    if (!count) {
        return 0;
    }
    pad(&candidates, count);
    for (int i = 0; i < count; i += DIP_HALF_LANES) {
        float *const planes_of = planes + (size_t)i * (size_t)target->plane_stride;
        prefetch_space(triangles + i, planes_of, target->plane_stride);
        const TriangleVector tri = load_triangles(&candidates, i);
        store_triangles(&tri, batch->screen, target->draw, triangles + i);
        store_planes(&tri, target, batch, planes_of);
    }
    return count;
}
