// Projecting boxes to the rectangle that they can touch.
#include "renderer/plan/extent.h"

enum { CORNERS = 8 };

// x, y and w of a box' corners in clip space, corner bit k: the far end of axis k.
typedef struct Corners {
    double clip[CORNERS][3];
} Corners;

static double corner_axis(const float transform[12], const DipBox *box, int corner, int axis) {
    double sum = transform[4 * axis + 3];
    for (int k = 0; k < 3; k++) {
        const double end = corner >> k & 1 ? box->extent[k] : -(double)box->extent[k];
        sum += (double)transform[4 * axis + k] * (box->centre[k] + end);
    }
    return sum;
}

static Corners project(const DipView *view, const float transform[12], const DipBox *box) {
    static const int rows[3] = {0, 1, 3};
    Corners corners;
    for (int corner = 0; corner < CORNERS; corner++) {
        double world[3];
        for (int axis = 0; axis < 3; axis++) {
            world[axis] = corner_axis(transform, box, corner, axis);
        }
        for (int r = 0; r < 3; r++) {
            const double *m = view->world_to_clip + 4 * rows[r];
            corners.clip[corner][r] =
                ((m[0] * world[0] + m[1] * world[1]) + m[2] * world[2]) + m[3];
        }
    }
    return corners;
}

static void take_in(DipExtent *extent, const double clip[3]) {
    for (int axis = 0; axis < 2; axis++) {
        const double at = clip[axis] / clip[2];
        extent->min[axis] = at < extent->min[axis] ? at : extent->min[axis];
        extent->max[axis] = at > extent->max[axis] ? at : extent->max[axis];
    }
}

DipExtent dip_extent_none(void) {
    return (DipExtent){{1e300, 1e300}, {-1e300, -1e300}};
}

double dip_extent_lowest(const float transform[12], const DipBox *box) {
    double lowest = 1e300;
    for (int corner = 0; corner < CORNERS; corner++) {
        const double y = corner_axis(transform, box, corner, 1);
        lowest = y < lowest ? y : lowest;
    }
    return lowest;
}

// The corners beyond the near plane, and where edges cross it.
void dip_extent_add(DipExtent *extent, const DipView *view, const float transform[12],
                    const DipBox *box) {
    const Corners corners = project(view, transform, box);
    for (int corner = 0; corner < CORNERS; corner++) {
        const double *from = corners.clip[corner];
        if (from[2] >= view->near_m) {
            take_in(extent, from);
        }
        for (int axis = 0; axis < 3; axis++) {
            const double *to = corners.clip[corner | 1 << axis];
            if ((from[2] < view->near_m) == (to[2] < view->near_m)) {
                continue;
            }
            const double t = (view->near_m - from[2]) / (to[2] - from[2]);
            const double cut[3] = {from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1]),
                                   view->near_m};
            take_in(extent, cut);
        }
    }
}

// A range of -1..1 to whole pixels 0..size; positive is towards greater pixels.
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
                       DipRegion *region) {
    return to_pixels(extent->min[0], extent->max[0], width, margin, &region->x0, &region->x1) &&
           to_pixels(-extent->max[1], -extent->min[1], height, margin, &region->y0, &region->y1);
}
