// Cuts triangles before the division by w (Sutherland and Hodgman, in homogeneous coordinates).
#include "renderer/reference/internal/clip.h"
#include "renderer/reference/internal/differences.h"

#include <math.h>
#include <string.h>

// The guard band reaches this many pixels from the picture's top left corner in every direction.
// - If positions are rounded, so are those of the corners that the band makes. The band therefore
//   lies so far out that it cuts few triangles. Positions in 1/256 pixel are at most 2^29, so that
//   twice the area of a triangle fits 64 bits.
// - If positions are not rounded, every band gives the same picture. A narrow one keeps the errors
//   of edge functions in double below 2^-36 pixel.
#define GUARD_ROUNDED_PX 0x1p21
#define GUARD_EXACT_PX   0x1p14

enum { PLANE_NEAR, PLANE_LEFT, PLANE_RIGHT, PLANE_TOP, PLANE_BOTTOM, PLANE_LEVEL, PLANE_COUNT };

DipRefClipPlanes dip_reference_clip_planes(const DipReference *reference, const DipRefShot *shot) {
    const double rounded_px = reference->differs ? DIP_REF_FAST_GUARD_PX : GUARD_ROUNDED_PX;
    const double guard_px = shot->rounded ? rounded_px : GUARD_EXACT_PX;
    const double x = 2.0 * guard_px / shot->width;
    const double y = 2.0 * guard_px / shot->height;
    return (DipRefClipPlanes){reference->def->near_m, x + 1.0, x - 1.0, y + 1.0, y - 1.0,
                              shot->mirrored};
}

// Returns the signed, scaled distance of a vertex from a plane. The vertex is inside if the
// distance is >= 0.
static DipWide find_distance(const DipRefClipPlanes *planes, int plane,
                             const DipRefClipVertex *vertex) {
    switch (plane) {
    case PLANE_NEAR:
        return dip_wide_add_double(vertex->w, -planes->near_m);
    case PLANE_LEFT:
        return dip_wide_add(dip_wide_scale(vertex->w, planes->left), vertex->x);
    case PLANE_RIGHT:
        return dip_wide_subtract(dip_wide_scale(vertex->w, planes->right), vertex->x);
    case PLANE_TOP:
        return dip_wide_subtract(dip_wide_scale(vertex->w, planes->top), vertex->y);
    case PLANE_BOTTOM:
        return dip_wide_add(dip_wide_scale(vertex->w, planes->bottom), vertex->y);
    default:
        return vertex->above;
    }
}

// Returns true if a vertex is inside all planes whatever the rounding of the test.
static bool is_clearly_inside(const DipRefClipPlanes *planes, const DipRefClipVertex *vertex) {
    const double w = vertex->w.high * (1.0 - 0x1p-40);
    return w > planes->near_m && fabs(vertex->x.high) < w * fmin(planes->left, planes->right) &&
           fabs(vertex->y.high) < w * fmin(planes->top, planes->bottom) &&
           (!planes->mirrored || vertex->above.high > 0.0);
}

static DipWide blend(DipWide inside, DipWide outside, DipWide t) {
    return dip_wide_add(inside, dip_wide_multiply(dip_wide_subtract(outside, inside), t));
}

// Interpolates the vertex where an edge crosses a plane. The edge always runs from its inside
// vertex to its outside vertex, so two triangles that share the edge get the same new vertex.
static DipRefClipVertex cut_edge(const DipRefClipVertex *inside, const DipRefClipVertex *outside,
                                 DipWide inside_distance, DipWide outside_distance) {
    const DipWide whole = dip_wide_subtract(inside_distance, outside_distance);
    DipWide t = dip_wide_divide(inside_distance, whole);
    if (!(t.high >= 0.0 && t.high <= 1.0)) {
        t = dip_wide(1.0); // mark_inside counted an inside vertex as outside
    }
    DipRefClipVertex cut = {.x = blend(inside->x, outside->x, t),
                            .y = blend(inside->y, outside->y, t),
                            .w = blend(inside->w, outside->w, t),
                            .above = blend(inside->above, outside->above, t)};
    for (int i = 0; i < DIP_REF_VARYINGS; i++) {
        cut.varyings[i] = blend(inside->varyings[i], outside->varyings[i], t);
    }
    return cut;
}

// Marks the vertices of a polygon that lie inside a plane. In exact arithmetic they follow one
// another. If rounding breaks them into several runs, only the run around the vertex that is
// farthest inside is marked, so that a plane adds at most one corner.
static void mark_inside(int count, const DipWide *distance, bool *inside) {
    int farthest = 0;
    for (int i = 0; i < count; i++) {
        inside[i] = false;
        farthest = distance[i].high > distance[farthest].high ? i : farthest;
    }
    for (int i = farthest; !inside[i] && distance[i].high >= 0.0; i = (i + 1) % count) {
        inside[i] = true;
    }
    for (int i = (farthest + count - 1) % count; !inside[i] && distance[i].high >= 0.0;
         i = (i + count - 1) % count) {
        inside[i] = true;
    }
}

static int clip_by(const DipRefClipPlanes *planes, int plane, int count,
                   DipRefClipVertex polygon[DIP_REF_MAX_CORNERS]) {
    DipWide distance[DIP_REF_MAX_CORNERS];
    bool inside[DIP_REF_MAX_CORNERS];
    bool all_inside = true;
    for (int i = 0; i < count; i++) {
        distance[i] = find_distance(planes, plane, &polygon[i]);
    }
    mark_inside(count, distance, inside);
    for (int i = 0; i < count; i++) {
        all_inside = all_inside && inside[i];
    }
    if (all_inside) {
        return count;
    }
    DipRefClipVertex from[DIP_REF_MAX_CORNERS];
    memcpy(from, polygon, (size_t)count * sizeof *from);
    int kept = 0;
    for (int i = 0; i < count; i++) {
        const int next = (i + 1) % count;
        if (inside[i]) {
            polygon[kept++] = from[i];
        }
        if (inside[i] != inside[next]) {
            const int a = inside[i] ? i : next;
            const int b = inside[i] ? next : i;
            polygon[kept] = cut_edge(&from[a], &from[b], distance[a], distance[b]);
            if (plane == PLANE_NEAR) {
                polygon[kept].w = dip_wide(planes->near_m);
            }
            kept++;
        }
    }
    return kept >= 3 ? kept : 0;
}

bool dip_reference_needs_clip(const DipRefClipPlanes *planes,
                              const DipRefClipVertex *const corners[3]) {
    return !is_clearly_inside(planes, corners[0]) || !is_clearly_inside(planes, corners[1]) ||
           !is_clearly_inside(planes, corners[2]);
}

int dip_reference_clip(const DipRefClipPlanes *planes, const DipRefClipVertex *const corners[3],
                       DipRefClipVertex polygon[DIP_REF_MAX_CORNERS]) {
    int count = 3;
    for (int i = 0; i < 3; i++) {
        polygon[i] = *corners[i];
    }
    const int plane_count = planes->mirrored ? PLANE_COUNT : PLANE_LEVEL;
    for (int plane = PLANE_NEAR; count > 0 && plane < plane_count; plane++) {
        count = clip_by(planes, plane, count, polygon);
    }
    return count;
}
