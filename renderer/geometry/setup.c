// Edges, depth and shading planes from rounded screen positions. Planes are solved in double, so
// that slivers keep their precision, and stored as float about a chosen anchor.
#include "renderer/geometry/setup.h"

// A value that is affine over the screen: at(x, y) = value at vertex 0 + dx (x - x0) + dy (y - y0).
typedef struct Gradient {
    double dx; // per pixel
    double dy;
} Gradient;

// The triangle's two edges from vertex 0, in pixels, over twice its area.
typedef struct Frame {
    double x10, y10, x20, y20;
    double inverse_area; // 1 / (x10 y20 - x20 y10)
} Frame;

static Gradient gradient(const Frame *frame, double v0, double v1, double v2) {
    const double v10 = v1 - v0;
    const double v20 = v2 - v0;
    return (Gradient){(v10 * frame->y20 - v20 * frame->y10) * frame->inverse_area,
                      (v20 * frame->x10 - v10 * frame->x20) * frame->inverse_area};
}

static int32_t min3(int32_t a, int32_t b, int32_t c) {
    const int32_t m = a < b ? a : b;
    return m < c ? m : c;
}

static int32_t max3(int32_t a, int32_t b, int32_t c) {
    const int32_t m = a > b ? a : b;
    return m > c ? m : c;
}

// The first and last pixel of 0..limit-1 with a sample offset in [sample_min, sample_max] that
// falls within [low, high].
static bool pixel_range(int32_t low, int32_t high, int sample_min, int sample_max, int limit,
                        int16_t *first, int16_t *last) {
    int32_t from = (low - sample_max + DIP_SUBPIXELS - 1) >> 8;
    int32_t to = (high - sample_min) >> 8;
    from = from < 0 ? 0 : from;
    to = to > limit - 1 ? limit - 1 : to;
    *first = (int16_t)from;
    *last = (int16_t)to;
    return from <= to;
}

// E(p) = dx (py - y0) - dy (px - x0) with the top-left rule: on the edge counts only where the
// edge is the top (horizontal, going right) or a left one (going up).
static void set_edge(DipTriangle *triangle, int i, const DipScreenVertex *from,
                     const DipScreenVertex *to) {
    const int32_t dx = to->x - from->x;
    const int32_t dy = to->y - from->y;
    const bool top_left = dy < 0 || (dy == 0 && dx > 0);
    triangle->a[i] = -dy;
    triangle->b[i] = dx;
    triangle->c[i] = (int64_t)dy * from->x - (int64_t)dx * from->y - (top_left ? 0 : 1);
}

static void set_depth(DipTriangle *triangle, const Frame *frame, const DipScreenVertex *v0,
                      const DipScreenVertex *v1, const DipScreenVertex *v2) {
    const Gradient z = gradient(frame, v0->z, v1->z, v2->z);
    triangle->z_dx = z.dx;
    triangle->z_dy = z.dy;
    triangle->z_origin = v0->z - z.dx * (v0->x / 256.0) - z.dy * (v0->y / 256.0);
    const float low = v0->z < v1->z ? v0->z : v1->z;
    const float high = v0->z > v1->z ? v0->z : v1->z;
    triangle->z_min = low < v2->z ? low : v2->z;
    triangle->z_max = high > v2->z ? high : v2->z;
}

static void set_plane(float plane[3], double v0, Gradient g, double to_anchor_x,
                      double to_anchor_y) {
    plane[0] = (float)(v0 + g.dx * to_anchor_x + g.dy * to_anchor_y);
    plane[1] = (float)g.dx;
    plane[2] = (float)g.dy;
}

// 1/w and slot/w about the corner of the pixel box where 1/w is smallest in magnitude.
static void set_surface(float *surface, const DipSetupTarget *target, const DipTriangle *triangle,
                        const Frame *frame, const DipScreenVertex *const v[3]) {
    const double x0 = v[0]->x / 256.0;
    const double y0 = v[0]->y / 256.0;
    const double rw[3] = {v[0]->rw, v[1]->rw, v[2]->rw};
    const Gradient q = gradient(frame, rw[0], rw[1], rw[2]);
    double best = 1e300;
    double anchor_x = 0.0;
    double anchor_y = 0.0;
    for (int corner = 0; corner < 4; corner++) {
        const double x = corner & 1 ? triangle->x1 + 1.0 : triangle->x0;
        const double y = corner & 2 ? triangle->y1 + 1.0 : triangle->y0;
        const double at = rw[0] + q.dx * (x - x0) + q.dy * (y - y0);
        const double size = at < 0.0 ? -at : at;
        if (size < best) {
            best = size;
            anchor_x = x;
            anchor_y = y;
        }
    }
    surface[DIP_SURFACE_ANCHOR] = (float)anchor_x;
    surface[DIP_SURFACE_ANCHOR + 1] = (float)anchor_y;
    set_plane(surface + DIP_SURFACE_RW, rw[0], q, anchor_x - x0, anchor_y - y0);
    for (int s = 0; s < target->slot_count; s++) {
        const int at = s * target->slot_stride;
        const double value[3] = {v[0]->slot[at] * rw[0], v[1]->slot[at] * rw[1],
                                 v[2]->slot[at] * rw[2]};
        set_plane(surface + DIP_SURFACE_SLOTS + 3 * s, value[0],
                  gradient(frame, value[0], value[1], value[2]), anchor_x - x0, anchor_y - y0);
    }
}

bool dip_setup_triangle(const DipSetupTarget *target, const DipScreenVertex vertex[3],
                        DipTriangle *triangle, float *surface) {
    const DipScreenVertex *v[3] = {&vertex[0], &vertex[1], &vertex[2]};
    const int64_t area = (int64_t)(v[1]->x - v[0]->x) * (v[2]->y - v[0]->y) -
                         (int64_t)(v[2]->x - v[0]->x) * (v[1]->y - v[0]->y);
    // Counter-clockwise as seen, a front face, has a negative area, because y points down.
    if (area == 0 || (area > 0 && target->cull == DIP_CULL_BACK) ||
        (area < 0 && target->cull == DIP_CULL_FRONT)) {
        return false;
    }
    if (!pixel_range(min3(v[0]->x, v[1]->x, v[2]->x), max3(v[0]->x, v[1]->x, v[2]->x),
                     target->sample_min[0], target->sample_max[0], target->width, &triangle->x0,
                     &triangle->x1) ||
        !pixel_range(min3(v[0]->y, v[1]->y, v[2]->y), max3(v[0]->y, v[1]->y, v[2]->y),
                     target->sample_min[1], target->sample_max[1], target->height, &triangle->y0,
                     &triangle->y1)) {
        return false;
    }
    if (area < 0) {
        const DipScreenVertex *swap = v[1];
        v[1] = v[2];
        v[2] = swap;
    }
    for (int i = 0; i < 3; i++) {
        set_edge(triangle, i, v[i], v[(i + 1) % 3]);
    }
    const Frame frame = {(v[1]->x - v[0]->x) / 256.0, (v[1]->y - v[0]->y) / 256.0,
                         (v[2]->x - v[0]->x) / 256.0, (v[2]->y - v[0]->y) / 256.0,
                         65536.0 / (double)(area < 0 ? -area : area)};
    set_depth(triangle, &frame, v[0], v[1], v[2]);
    set_surface(surface, target, triangle, &frame, v);
    return true;
}
