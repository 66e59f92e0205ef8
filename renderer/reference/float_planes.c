// Interpolates varyings in floats, as the fast renderer does: internal/differences.h.
#include "renderer/reference/internal/differences.h"

#include <math.h>

// A value that is affine over the screen: its value at an anchor, and its derivatives per pixel.
typedef struct Plane {
    float at;
    float dx;
    float dy;
} Plane;

// Computes a plane in doubles and rounds it to floats. value: of the three vertices.
static Plane round_plane(const DipRefTriangle *triangle, const double value[3],
                         const double anchor[2]) {
    const DipRefVertex *v = triangle->vertices;
    const double x10 = (v[1].x - v[0].x) / 256.0, y10 = (v[1].y - v[0].y) / 256.0;
    const double x20 = (v[2].x - v[0].x) / 256.0, y20 = (v[2].y - v[0].y) / 256.0;
    const double inverse_area = 1.0 / (x10 * y20 - x20 * y10);
    const double v10 = value[1] - value[0], v20 = value[2] - value[0];
    const double dx = (v10 * y20 - v20 * y10) * inverse_area;
    const double dy = (v20 * x10 - v10 * x20) * inverse_area;
    const double at =
        value[0] + dx * (anchor[0] - v[0].x / 256.0) + dy * (anchor[1] - v[0].y / 256.0);
    return (Plane){(float)at, (float)dx, (float)dy};
}

static float value_at(const Plane *plane, const float offset[2]) {
    return (plane->at + plane->dx * offset[0]) + plane->dy * offset[1];
}

// Finds the pixels that the triangle touches along one axis. The triangle's own range has one pixel
// more at either end and is cut to the frame.
static void find_box(double a, double b, double c, int first, int last, double box[2]) {
    box[0] = fmax(floor(fmin(a, fmin(b, c)) / 256.0), first);
    box[1] = fmin(floor(fmax(a, fmax(b, c)) / 256.0), last) + 1.0;
}

// Finds the corner of the triangle's pixel box at which 1/w is smallest.
static void find_anchor(const DipRefTriangle *triangle, const double inv_w[3], double anchor[2]) {
    const DipRefVertex *v = triangle->vertices;
    double box[2][2];
    find_box(v[0].x, v[1].x, v[2].x, triangle->min_x, triangle->max_x, box[0]);
    find_box(v[0].y, v[1].y, v[2].y, triangle->min_y, triangle->max_y, box[1]);
    float least = INFINITY;
    for (int corner = 0; corner < 4; corner++) {
        const double at[2] = {box[0][corner & 1], box[1][corner >> 1]};
        const float size = fabsf(round_plane(triangle, inv_w, at).at);
        if (size < least) {
            least = size;
            anchor[0] = at[0];
            anchor[1] = at[1];
        }
    }
}

// Returns the multiple of 64 nearest to a texture coordinate at the vertex nearest to the eye; 0
// for other varyings. Coordinates count from there, so that large ones keep their precision.
static double find_multiple(const DipRefTriangle *triangle, int varying) {
    const DipRefVertex *nearest = &triangle->vertices[0];
    for (int i = 1; i < 3; i++) {
        nearest = triangle->vertices[i].inv_w > nearest->inv_w ? &triangle->vertices[i] : nearest;
    }
    const bool counts = varying >= DIP_REF_U0 && varying <= DIP_REF_V1;
    return counts ? 64.0 * rint(nearest->varyings[varying] / 64.0) : 0.0;
}

void dip_reference_interpolate_floats(const DipRefPosition *place, int first, int count,
                                      bool derive, DipRefVaryings *out) {
    const DipRefTriangle *triangle = place->triangle;
    const DipRefVertex *v = triangle->vertices;
    const double inv_w[3] = {v[0].inv_w, v[1].inv_w, v[2].inv_w};
    double anchor[2] = {0.0, 0.0};
    find_anchor(triangle, inv_w, anchor);
    const float offset[2] = {(float)(place->x / 256.0 - anchor[0]),
                             (float)(place->y / 256.0 - anchor[1])};
    const Plane q = round_plane(triangle, inv_w, anchor);
    const float w = 1.0f / value_at(&q, offset);
    for (int k = first; k < first + count; k++) {
        if (k >= DIP_REF_X && k <= DIP_REF_Z) {
            continue; // The fast renderer finds positions from view rays.
        }
        const double multiple = find_multiple(triangle, k);
        double over_w[3];
        for (int i = 0; i < 3; i++) {
            over_w[i] = (v[i].varyings[k] - multiple) * inv_w[i];
        }
        const Plane plane = round_plane(triangle, over_w, anchor);
        const float value = value_at(&plane, offset) * w;
        out->value[k] = (double)value + multiple;
        if (derive && k < DIP_REF_DERIVED) {
            out->ddx[k] = (plane.dx - value * q.dx) * w;
            out->ddy[k] = (plane.dy - value * q.dy) * w;
        }
    }
}
