// Projects shapes and finds the rectangle of the picture that they can touch.
#include "renderer/scene/view/extent.h"

DipExtent dip_extent_none(void) {
    return (DipExtent){{1e300, 1e300}, {-1e300, -1e300}};
}

void dip_extent_project(const DipView *view, const double world[3], double clip[3]) {
    static const int rows[3] = {0, 1, 3};
    for (int r = 0; r < 3; r++) {
        const double *m = view->world_to_clip + 4 * rows[r];
        clip[r] = ((m[0] * world[0] + m[1] * world[1]) + m[2] * world[2]) + m[3];
    }
}

static void extend(DipExtent *extent, const double clip[3]) {
    for (int axis = 0; axis < 2; axis++) {
        const double at = clip[axis] / clip[2];
        extent->min[axis] = at < extent->min[axis] ? at : extent->min[axis];
        extent->max[axis] = at > extent->max[axis] ? at : extent->max[axis];
    }
}

// Adds the ends of an edge that lie beyond the near plane, and the point where the edge crosses
// that plane.
static void add_edge(DipExtent *extent, const DipView *view, const double a[3], const double b[3]) {
    double from[3];
    double to[3];
    dip_extent_project(view, a, from);
    dip_extent_project(view, b, to);
    if (from[2] >= view->near_m) {
        extend(extent, from);
    }
    if (to[2] >= view->near_m) {
        extend(extent, to);
    }
    if ((from[2] < view->near_m) != (to[2] < view->near_m)) {
        const double t = (view->near_m - from[2]) / (to[2] - from[2]);
        const double cut[3] = {from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1]),
                               view->near_m};
        extend(extent, cut);
    }
}

// Adds the part of a shape's extent that lies within the picture.
static void join(DipExtent *extent, const DipExtent *shape) {
    for (int axis = 0; axis < 2; axis++) {
        if (shape->min[axis] > 1.0 || shape->max[axis] < -1.0) {
            return;
        }
    }
    for (int axis = 0; axis < 2; axis++) {
        const double min = shape->min[axis] > -1.0 ? shape->min[axis] : -1.0;
        const double max = shape->max[axis] < 1.0 ? shape->max[axis] : 1.0;
        extent->min[axis] = min < extent->min[axis] ? min : extent->min[axis];
        extent->max[axis] = max > extent->max[axis] ? max : extent->max[axis];
    }
}

void dip_extent_add_box(DipExtent *extent, const DipView *view, const double corners[8][3]) {
    DipExtent shape = dip_extent_none();
    for (int corner = 0; corner < 8; corner++) {
        for (int axis = 0; axis < 3; axis++) {
            if (!(corner >> axis & 1)) {
                add_edge(&shape, view, corners[corner], corners[corner | 1 << axis]);
            }
        }
    }
    join(extent, &shape);
}

void dip_extent_add_triangle(DipExtent *extent, const DipView *view, const double corners[3][3]) {
    DipExtent shape = dip_extent_none();
    for (int i = 0; i < 3; i++) {
        add_edge(&shape, view, corners[i], corners[(i + 1) % 3]);
    }
    join(extent, &shape);
}

void dip_extent_box_corners(const float transform[12], const DipBox *box, double corners[8][3]) {
    for (int corner = 0; corner < 8; corner++) {
        for (int axis = 0; axis < 3; axis++) {
            const float *m = transform + 4 * axis;
            corners[corner][axis] = m[3];
            for (int k = 0; k < 3; k++) {
                const double end = corner >> k & 1 ? box->extent[k] : -(double)box->extent[k];
                corners[corner][axis] += (double)m[k] * (box->centre[k] + end);
            }
        }
    }
}

// Converts a range of device coordinates within -1..1 to whole pixels, *first to *end - 1. The
// range gets `margin` more pixels on each side, but stays within 0..size - 1. Coordinate -1 is the
// outer edge of pixel 0. Returns false if no pixel is in the range.
static bool to_pixels(double min, double max, int size, int margin, int *first, int *end) {
    const double from = (min + 1.0) * 0.5 * size - margin;
    const double to = (max + 1.0) * 0.5 * size + margin;
    if (min > max || to <= 0.0 || from >= size) {
        return false;
    }
    *first = from > 0.0 ? (int)from : 0;
    *end = to < size ? (int)to + 1 : size;
    *end = *end < size ? *end : size;
    return true;
}

bool dip_extent_region(const DipExtent *extent, int width, int height, int margin,
                       DipTargetRegion *region) {
    return to_pixels(extent->min[0], extent->max[0], width, margin, &region->x0, &region->x1) &&
           to_pixels(-extent->max[1], -extent->min[1], height, margin, &region->y0, &region->y1);
}
