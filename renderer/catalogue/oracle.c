// Computes with exact integers which samples a triangle covers, and creates triangles whose
// coverage is hard to compute correctly.
#include "renderer/catalogue/oracle.h"

#include "renderer/base/trig.h"

#include <math.h>

// --- coverage ----------------------------------------------------------------------------------

typedef struct Edge {
    int64_t x, y;   // start of the edge
    int64_t dx, dy; // vector from the start of the edge to its end
    bool owns;      // true if samples on the edge belong to the triangle
} Edge;

// Returns twice the signed area of the triangle that the edge and the point form. Coordinates lie
// within +-2^22 (DIP_ORACLE_LIMIT), so the area is below 2^48. The sign is
// positive if the point lies to the right of the edge as seen on the screen.
static int64_t side_of(const Edge *edge, int64_t x, int64_t y) {
    return (int64_t)edge->dx * (y - edge->y) - (int64_t)edge->dy * (x - edge->x);
}

// Makes the edges in clockwise order, so that the inside lies to their right. Returns false if the
// triangle has no area.
static bool make_edges(const DipOracleTriangle *t, Edge edges[3]) {
    const Edge base = {t->x[0], t->y[0], (int64_t)t->x[1] - t->x[0], (int64_t)t->y[1] - t->y[0],
                       false};
    const int64_t area = side_of(&base, t->x[2], t->y[2]);
    const int order[4] = {0, area > 0 ? 1 : 2, area > 0 ? 2 : 1, 0};
    for (int i = 0; i < 3; i++) {
        const int from = order[i];
        const int to = order[i + 1];
        Edge *edge = &edges[i];
        *edge = (Edge){t->x[from], t->y[from], (int64_t)t->x[to] - t->x[from],
                       (int64_t)t->y[to] - t->y[from], false};
        // In clockwise order, left edges run upwards, and the upper horizontal edge runs to the
        // right.
        edge->owns = edge->dy < 0 || (edge->dy == 0 && edge->dx > 0);
    }
    return area != 0;
}

static bool is_inside(const Edge edges[3], int64_t x, int64_t y) {
    for (int i = 0; i < 3; i++) {
        const int64_t side = side_of(&edges[i], x, y);
        if (side < 0 || (side == 0 && !edges[i].owns)) {
            return false;
        }
    }
    return true;
}

static int32_t least(const int32_t v[3]) {
    const int32_t m = v[0] < v[1] ? v[0] : v[1];
    return m < v[2] ? m : v[2];
}

static int32_t greatest(const int32_t v[3]) {
    const int32_t m = v[0] > v[1] ? v[0] : v[1];
    return m > v[2] ? m : v[2];
}

uint64_t dip_oracle_cover(const DipOracleTriangle *triangle, const DipSamplePattern *pattern,
                          const DipOracleRegion *region, uint8_t *masks) {
    Edge edges[3];
    const bool has_area = make_edges(triangle, edges);
    // Only samples in the bounding box of the triangle's corners, extended to whole pixels, can be
    // inside.
    const int low_x = least(triangle->x) >> 8, high_x = greatest(triangle->x) >> 8;
    const int low_y = least(triangle->y) >> 8, high_y = greatest(triangle->y) >> 8;
    uint64_t count = 0;
    for (int j = 0; j < region->height; j++) {
        const int y = region->y0 + j;
        for (int i = 0; i < region->width; i++) {
            const int x = region->x0 + i;
            uint8_t mask = 0;
            const bool near_enough =
                has_area && x >= low_x && x <= high_x && y >= low_y && y <= high_y;
            for (int s = 0; near_enough && s < pattern->count; s++) {
                if (is_inside(edges, (int64_t)x * 256 + pattern->x[s],
                              (int64_t)y * 256 + pattern->y[s])) {
                    mask = (uint8_t)(mask | 1u << s);
                    count++;
                }
            }
            masks[j * region->width + i] = mask;
        }
    }
    return count;
}

// --- triangles ---------------------------------------------------------------------------------

typedef struct Point {
    int64_t x;
    int64_t y;
} Point;

typedef struct Maker {
    Random *random;
    const DipSamplePattern *pattern;
    const DipOracleRegion *region;
    int32_t limit;
} Maker;

// Returns a random point in the region or up to `margin` pixels around it.
static Point any_point(const Maker *maker, int margin) {
    const DipOracleRegion *r = maker->region;
    Point p;
    p.x = random_int(maker->random, (r->x0 - margin) * 256, (r->x0 + r->width + margin) * 256);
    p.y = random_int(maker->random, (r->y0 - margin) * 256, (r->y0 + r->height + margin) * 256);
    return p;
}

static Point sample_point(const Maker *maker) {
    const DipOracleRegion *r = maker->region;
    const int s = random_int(maker->random, 0, maker->pattern->count - 1);
    Point p;
    p.x = random_int(maker->random, r->x0, r->x0 + r->width - 1) * 256 + maker->pattern->x[s];
    p.y = random_int(maker->random, r->y0, r->y0 + r->height - 1) * 256 + maker->pattern->y[s];
    return p;
}

static Point near_point(const Maker *maker, Point p, int reach) {
    p.x += random_int(maker->random, -reach, reach);
    p.y += random_int(maker->random, -reach, reach);
    return p;
}

static Point far_point(const Maker *maker) {
    const int32_t limit = maker->limit;
    Point p;
    p.x = random_int(maker->random, -limit, limit);
    p.y = random_int(maker->random, -limit, limit);
    switch (random_int(maker->random, 0, 3)) {
    case 0:
        p.x = random_int(maker->random, 0, 1) ? limit : -limit;
        break;
    case 1:
        p.y = random_int(maker->random, 0, 1) ? limit : -limit;
        break;
    default:
        break;
    }
    return p;
}

// Returns a point on the line through p and q. Its distance from p is a random whole multiple of
// the distance from p to q.
static Point beyond(const Maker *maker, Point p, Point q, int least_step, int most_step) {
    const int step = random_int(maker->random, least_step, most_step);
    return (Point){p.x + step * (q.x - p.x), p.y + step * (q.y - p.y)};
}

static void make_small(const Maker *maker, Point v[3]) {
    v[0] = any_point(maker, 2);
    v[1] = near_point(maker, v[0], 256 * 4);
    v[2] = near_point(maker, v[0], 256 * 4);
}

static void make_large(const Maker *maker, Point v[3]) {
    for (int i = 0; i < 3; i++) {
        v[i] = any_point(maker, 20);
    }
}

static void make_sliver(const Maker *maker, Point v[3]) {
    v[0] = random_int(maker->random, 0, 1) ? sample_point(maker) : any_point(maker, 10);
    v[1] = any_point(maker, 10);
    const double t = random_real(maker->random, -0.2, 1.2);
    const Point on = {v[0].x + llrint(t * (double)(v[1].x - v[0].x)),
                      v[0].y + llrint(t * (double)(v[1].y - v[0].y))};
    v[2] = near_point(maker, on, 2);
}

static void make_on_samples(const Maker *maker, Point v[3]) {
    for (int i = 0; i < 3; i++) {
        v[i] = sample_point(maker);
    }
}

static void make_through_samples(const Maker *maker, Point v[3]) {
    const Point p = sample_point(maker);
    const Point q = sample_point(maker);
    v[0] = beyond(maker, p, q, -8, 0);
    v[1] = beyond(maker, p, q, 1, 8);
    v[2] = random_int(maker->random, 0, 1) ? beyond(maker, v[0], sample_point(maker), 1, 4)
                                           : any_point(maker, 30);
}

static void make_guard(const Maker *maker, Point v[3]) {
    v[0] = far_point(maker);
    v[1] = far_point(maker);
    v[2] = random_int(maker->random, 0, 1) ? far_point(maker) : sample_point(maker);
}

static void make_flat(const Maker *maker, Point v[3]) {
    const Point p = sample_point(maker);
    const Point q = random_int(maker->random, 0, 1) ? sample_point(maker) : any_point(maker, 5);
    v[0] = p;
    v[1] = beyond(maker, p, q, -3, 3);
    v[2] = beyond(maker, p, q, -3, 3);
}

static void make_axis_aligned(const Maker *maker, Point v[3]) {
    const Point p = sample_point(maker);
    const Point q = random_int(maker->random, 0, 1) ? sample_point(maker) : any_point(maker, 5);
    v[0] = p;
    v[1] = (Point){q.x, p.y};
    v[2] = random_int(maker->random, 0, 1) ? (Point){p.x, q.y} : any_point(maker, 5);
}

static int32_t clamp(int64_t v, int32_t limit) {
    return (int32_t)(v < -limit ? -limit : v > limit ? limit : v);
}

DipOracleTriangle dip_oracle_make(DipOracleKind kind, Random *random,
                                  const DipSamplePattern *pattern, const DipOracleRegion *region,
                                  int32_t limit) {
    static void (*const makers[])(const Maker *, Point[3]) = {
#define DIP_ORACLE_MAKER(name, text) make_##name,
        DIP_ORACLE_LIST(DIP_ORACLE_MAKER)
#undef DIP_ORACLE_MAKER
    };
    const Maker maker = {random, pattern, region, limit};
    Point v[3];
    makers[kind](&maker, v);
    DipOracleTriangle triangle;
    const int first = random_int(random, 0, 2);
    const int turn = random_int(random, 1, 2); // chooses the first corner and the winding at random
    for (int i = 0; i < 3; i++) {
        triangle.x[i] = clamp(v[(first + i * turn) % 3].x, limit);
        triangle.y[i] = clamp(v[(first + i * turn) % 3].y, limit);
    }
    return triangle;
}

void dip_oracle_make_fan(Random *random, const DipSamplePattern *pattern,
                         const DipOracleRegion *region, DipOracleTriangle fan[DIP_ORACLE_FAN]) {
    const Maker maker = {random, pattern, region, 0};
    const Point hub = random_int(random, 0, 1) ? sample_point(&maker) : any_point(&maker, 0);
    // The rim has one corner in each of DIP_ORACLE_FAN equal sectors around the hub. Neighbouring
    // corners are less than 90 degrees apart. The corners lie so far away that the sides between
    // them stay outside the region.
    const double radius = 256.0 * 4.0 * (region->width + region->height);
    Point rim[DIP_ORACLE_FAN];
    for (int i = 0; i < DIP_ORACLE_FAN; i++) {
        const double angle =
            (i + random_real(random, 0.0, 0.9)) * (6.283185307179586 / DIP_ORACLE_FAN);
        const double far = radius * random_real(random, 1.0, 3.0);
        rim[i] =
            (Point){hub.x + llrint(far * dip_cos(angle)), hub.y + llrint(far * dip_sin(angle))};
        if (random_int(random, 0, 3) == 0) { // edges run along samples if the hub lies on one
            rim[i].x = i == 2 || i == 6 ? hub.x : rim[i].x;
            rim[i].y = i == 0 || i == 4 ? hub.y : rim[i].y;
        }
    }
    for (int i = 0; i < DIP_ORACLE_FAN; i++) {
        const Point a = rim[i];
        const Point b = rim[(i + 1) % DIP_ORACLE_FAN];
        fan[i] = (DipOracleTriangle){{(int32_t)hub.x, (int32_t)a.x, (int32_t)b.x},
                                     {(int32_t)hub.y, (int32_t)a.y, (int32_t)b.y}};
    }
}

const char *dip_oracle_kind_name(DipOracleKind kind) {
    static const char *const names[] = {
#define DIP_ORACLE_NAME(name, text) #name,
        DIP_ORACLE_LIST(DIP_ORACLE_NAME)
#undef DIP_ORACLE_NAME
    };
    return names[kind];
}
