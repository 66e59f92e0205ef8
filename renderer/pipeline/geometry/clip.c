// Sutherland-Hodgman clipping in homogeneous coordinates.
#include "renderer/pipeline/geometry/clip.h"

#include "renderer/pipeline/geometry/repeat.h"

#include <stdbool.h>
#include <string.h>

// Returns the signed, scaled distance of p from the plane of a clip code. p is inside if the
// distance is >= 0.
static double distance_to(int32_t code, const DipScreenMapping *map, const double p[4]) {
    const double x = p[0];
    const double y = p[1];
    const double z = p[2];
    const double w = p[3];
    switch (code) {
    case DIP_CLIP_NEAR:
        return w - z;
    case DIP_CLIP_FAR:
        return z;
    case DIP_CLIP_W:
        return w - DIP_MIN_W;
    case DIP_CLIP_GUARD_LEFT:
        return x + w * map->guard_left;
    case DIP_CLIP_GUARD_RIGHT:
        return w * map->guard_right - x;
    case DIP_CLIP_GUARD_TOP:
        return w * map->guard_top - y;
    case DIP_CLIP_GUARD_BOTTOM:
        return y + w * map->guard_bottom;
    default:
        break;
    }
    int plane = 0;
    while (code != DIP_CLIP_USER << plane) {
        plane++;
    }
    const float *n = map->clip_planes[plane];
    return x * n[0] + y * n[1] + z * n[2] + w * n[3];
}

// Whether a repeating varying will be reduced, so that more than the precision of a float counts.
static bool is_large(double value) {
    return dip_nearest_repeat(value) != 0.0;
}

static void intersect(const DipClipVertex *inside, const DipClipVertex *outside, double from,
                      double to, const DipClipVaryings *varyings, DipClipVertex *out) {
    const double t = from / (from - to); // In 0..1, since from >= 0 > to.
    out->far = inside->far || outside->far;
    for (int i = 0; i < 4; i++) {
        const double a = inside->position[i];
        const double at = a + t * (outside->position[i] - a);
        out->projected[i] = (float)at;
        out->position[i] = out->far ? at : (double)out->projected[i];
    }
    for (int i = 0; i < varyings->count; i++) {
        const double a = inside->varying[i];
        const double value = a + t * (outside->varying[i] - a);
        const bool repeats = varyings->repeating >> i & 1;
        out->varying[i] = repeats && is_large(value) ? value : (float)value;
    }
}

// In exact arithmetic, the vertices of a convex polygon that lie inside a plane follow one another:
// they are one run. Rounding can break the run if the plane nearly coincides with an earlier clip
// plane, because the vertices on both planes then scatter to either side. In this case, this
// function keeps only the run around the vertex that is farthest inside. So each plane adds at most
// one vertex to the polygon.
static void keep_one_run(int count, const double *side, bool *inside) {
    int changes = 0;
    int farthest = 0;
    for (int i = 0; i < count; i++) {
        inside[i] = side[i] >= 0.0;
        changes += i > 0 && inside[i] != inside[i - 1];
        farthest = side[i] > side[farthest] ? i : farthest;
    }
    if (changes + (inside[0] != inside[count - 1]) <= 2) {
        return;
    }
    bool kept[DIP_MAX_CLIP_VERTICES] = {false};
    for (int i = farthest; inside[i]; i = (i + 1) % count) {
        kept[i] = true;
    }
    for (int i = farthest; inside[i]; i = (i + count - 1) % count) {
        kept[i] = true;
    }
    memcpy(inside, kept, (size_t)count * sizeof *inside);
}

static void clip_by(DipClipPolygon *polygon, int32_t code, const DipScreenMapping *map,
                    const DipClipVaryings *varyings) {
    const DipClipPolygon in = *polygon;
    double side[DIP_MAX_CLIP_VERTICES];
    for (int i = 0; i < in.count; i++) {
        side[i] = distance_to(code, map, in.vertex[i].position);
    }
    bool inside[DIP_MAX_CLIP_VERTICES];
    keep_one_run(in.count, side, inside);
    polygon->count = 0;
    for (int i = 0; i < in.count; i++) {
        const int next = (i + 1) % in.count;
        if (inside[i]) {
            polygon->vertex[polygon->count++] = in.vertex[i];
        }
        if (inside[i] != inside[next]) {
            const int a = inside[i] ? i : next;
            const int b = inside[i] ? next : i;
            DipClipVertex *added = &polygon->vertex[polygon->count++];
            intersect(&in.vertex[a], &in.vertex[b], side[a], side[b], varyings, added);
            added->edge = inside[next] && in.vertex[i].edge;
        }
    }
    if (polygon->count < 3) {
        polygon->count = 0;
    }
}

void dip_clip_polygon(DipClipPolygon *polygon, int32_t codes, const DipScreenMapping *map,
                      const DipClipVaryings *varyings) {
    for (int32_t code = 1; code < DIP_CLIP_INVALID && polygon->count; code <<= 1) {
        if (codes & DIP_CLIP_NEEDED & code) {
            clip_by(polygon, code, map, varyings);
        }
    }
}
