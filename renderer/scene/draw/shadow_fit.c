// Fits the shadow map to the receivers of shadows that a frame shows.
#include "renderer/scene/draw/shadow_fit.h"

#include "renderer/scene/resources/scene_layout.h"

#include <math.h>
#include <string.h>

// Texels between what must be in the map and its edges: a read takes up to two texels around a
// point, and one more is lost because the edges lie on multiples of the texel.
enum { MARGIN_TEXELS = 2, LOST_TEXELS = 2 * MARGIN_TEXELS + 1 };

typedef struct Bounds {
    double low[3];
    double high[3];
} Bounds;

static double dot(const double a[3], const double b[3]) {
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double product[3]) {
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        product[i] = a[j] * b[k] - a[k] * b[j];
    }
}

static Bounds no_bounds(void) {
    return (Bounds){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}

static void include(Bounds *bounds, const double point[3]) {
    for (int i = 0; i < 3; i++) {
        bounds->low[i] = fmin(bounds->low[i], point[i]);
        bounds->high[i] = fmax(bounds->high[i], point[i]);
    }
}

static void corner_of(const Bounds *box, int corner, double point[3]) {
    for (int i = 0; i < 3; i++) {
        point[i] = corner >> i & 1 ? box->high[i] : box->low[i];
    }
}

// --- the light -----------------------------------------------------------------------------------

// Sets the axes of the light. The first axis is level, so that a texel on level ground is a
// rectangle along the light, and both its sides can be fitted.
static void set_axes(const DipScene *scene, DipShadowFit *fit) {
    const DipSceneLighting *lighting = scene->lighting;
    double *to_light = fit->axis[2];
    dip_lighting_reverse(lighting->lights[lighting->shadow_light].direction_world, to_light);
    const bool is_steep = fabs(to_light[1]) > 0.9999;
    const double up[3] = {0.0, is_steep ? 0.0 : 1.0, is_steep ? -1.0 : 0.0};
    cross(up, to_light, fit->axis[0]);
    const double length = sqrt(dot(fit->axis[0], fit->axis[0]));
    for (int i = 0; i < 3; i++) {
        fit->axis[0][i] /= length;
    }
    cross(to_light, fit->axis[0], fit->axis[1]);
}

static void include_from_light(const DipShadowFit *fit, const double point[3], Bounds *bounds) {
    const double from_light[3] = {dot(fit->axis[0], point), dot(fit->axis[1], point),
                                  dot(fit->axis[2], point)};
    include(bounds, from_light);
}

// --- receivers in view ---------------------------------------------------------------------------

// Returns the box around all receivers of shadows that a view may show.
static Bounds receivers_in(const DipScene *scene, const DipCullPlanes *seen) {
    Bounds bounds = no_bounds();
    for (int i = 0; i < scene->object_count; i++) {
        const DipSceneMesh *mesh = &scene->meshes[scene->objects[i].mesh];
        const DipBox *box = &scene->objects[i].bounds;
        if (!mesh->lit_by_lights || !dip_mesh_triangle_count(mesh->mesh) ||
            dip_cull_outside(seen, box)) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            const double centre = box->centre[k];
            bounds.low[k] = fmin(bounds.low[k], centre - box->extent[k]);
            bounds.high[k] = fmax(bounds.high[k], centre + box->extent[k]);
        }
    }
    return bounds;
}

// The part of a straight line from `from` on that is left: from + t * way, begin <= t <= end.
typedef struct Segment {
    double from[3];
    double way[3];
    double begin;
    double end;
} Segment;

// Keeps the part of a segment where at + t * per is not negative.
static void cut(Segment *segment, double at, double per) {
    if (per > 0.0) {
        segment->begin = fmax(segment->begin, -at / per);
    } else if (per < 0.0) {
        segment->end = fmin(segment->end, -at / per);
    } else if (at < 0.0) {
        segment->end = -INFINITY;
    }
}

// Keeps the part of a segment that lies between the four sides of the view.
static void cut_by_view(Segment *segment, const DipView *view) {
    double from_eye[3];
    for (int i = 0; i < 3; i++) {
        from_eye[i] = segment->from[i] - view->eye[i];
    }
    const double at_w = -dot(view->axis[2], from_eye);
    const double per_w = -dot(view->axis[2], segment->way);
    for (int axis = 0; axis < 2; axis++) {
        const double at = view->scale[axis] * dot(view->axis[axis], from_eye);
        const double per = view->scale[axis] * dot(view->axis[axis], segment->way);
        cut(segment, at_w + at, per_w + per);
        cut(segment, at_w - at, per_w - per);
    }
}

static void cut_by_box(Segment *segment, const Bounds *box) {
    for (int i = 0; i < 3; i++) {
        cut(segment, segment->from[i] - box->low[i], segment->way[i]);
        cut(segment, box->high[i] - segment->from[i], -segment->way[i]);
    }
}

static void include_segment(const DipShadowFit *fit, const Segment *segment, Bounds *bounds) {
    const double ends[2] = {segment->begin, segment->end};
    for (int k = 0; k < 2 && segment->begin <= segment->end; k++) {
        double point[3];
        for (int i = 0; i < 3; i++) {
            point[i] = segment->from[i] + ends[k] * segment->way[i];
        }
        include_from_light(fit, point, bounds);
    }
}

// Adds the part of a box that a view shows. This part is convex: its corners lie on edges of the
// box or of the view.
static void include_shown(const DipShadowFit *fit, const Bounds *box, const DipView *view,
                          Bounds *bounds) {
    for (int edge = 0; edge < 12; edge++) {
        const int axis = edge / 4;
        const int low = (edge & 1) << (axis + 1) % 3 | (edge >> 1 & 1) << (axis + 2) % 3;
        Segment segment = {.begin = 0.0, .end = 1.0};
        corner_of(box, low, segment.from);
        segment.way[axis] = box->high[axis] - box->low[axis];
        cut_by_view(&segment, view);
        include_segment(fit, &segment, bounds);
    }
    for (int corner = 0; corner < 4; corner++) {
        Segment segment = {.begin = 0.0, .end = INFINITY};
        memcpy(segment.from, view->eye, sizeof segment.from);
        for (int i = 0; i < 3; i++) {
            const double right = view->axis[0][i] / view->scale[0];
            const double up = view->axis[1][i] / view->scale[1];
            segment.way[i] =
                (corner & 1 ? right : -right) + (corner & 2 ? up : -up) - view->axis[2][i];
        }
        cut_by_box(&segment, box);
        include_segment(fit, &segment, bounds);
    }
}

// --- the map -------------------------------------------------------------------------------------

// Returns the least number of the form m / 4 * 2^e with m = 4, 5, 6 or 7 that is not less than a
// positive value.
static double round_up(double value) {
    int exponent;
    const double fraction = frexp(value, &exponent); // 0.5 <= fraction < 1
    return ldexp(ceil(8.0 * fraction), exponent - 3);
}

DipShadowFit dip_shadow_fit(const DipScene *scene, const DipShadowView *views, int view_count,
                            int size) {
    DipShadowFit fit = {.size = size};
    Bounds whole = no_bounds();
    Bounds shown = no_bounds();
    Bounds all = no_bounds();
    set_axes(scene, &fit);
    for (int i = 0; i < 3; i++) {
        all.low[i] = scene->min_world[i];
        all.high[i] = scene->max_world[i];
    }
    for (int corner = 0; corner < 8; corner++) {
        double point[3];
        corner_of(&all, corner, point);
        include_from_light(&fit, point, &whole);
    }
    for (int v = 0; v < view_count; v++) {
        const Bounds box = receivers_in(scene, views[v].seen);
        if (box.low[0] <= box.high[0]) {
            include_shown(&fit, &box, views[v].view, &shown);
        }
    }
    if (!(shown.low[0] <= shown.high[0])) {
        shown = whole;
    }
    double greatest = 0.0;
    for (int i = 0; i < 3; i++) {
        greatest = fmax(greatest, whole.high[i] - whole.low[i]);
    }
    const double least = fmax(1e-6 * greatest, 1e-30);
    for (int i = 0; i < 2; i++) {
        const double width = fmax(shown.high[i] - shown.low[i], least);
        fit.texel[i] = round_up(width / (size - LOST_TEXELS));
        fit.low[i] = (floor(shown.low[i] / fit.texel[i]) - MARGIN_TEXELS) * fit.texel[i];
    }
    // Nothing lies at the depths 0 and 1 themselves, so rounding cuts nothing away.
    const double margin = fmax(1e-3 * (whole.high[2] - whole.low[2]), least);
    fit.low[2] = whole.low[2] - margin;
    fit.range = whole.high[2] + margin - fit.low[2];
    return fit;
}
