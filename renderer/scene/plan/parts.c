// Finds each tile's part: the rectangle of the tile that must be drawn. Projected shapes are cut at
// the borders of tiles, and the part must contain the piece of each shape in the tile.
#include "renderer/scene/plan/parts.h"

#include "renderer/scene/view/extent.h"

#include <string.h>

enum {
    BLOCK = 8,                             // width and height of a block, in pixels
    TILE_BLOCKS = DIP_TARGET_TILE / BLOCK, // blocks per row of a tile
    MAX_CORNERS = 3 + 1 + 4 // corners of a triangle cut by the near plane and a tile's four sides
};

// A convex polygon of points in clip space: x, y and w.
typedef struct Polygon {
    int count;
    double at[MAX_CORNERS][3];
} Polygon;

// Keeps the part of a polygon where dot(side, at) >= least. Where an edge is cut, both of its ends
// are weighted, so that a cut near one end is rounded no more than the coordinates of that end.
static void cut(Polygon *polygon, const double side[3], double least) {
    Polygon kept = {.count = 0};
    for (int i = 0; i < polygon->count; i++) {
        const double *from = polygon->at[i];
        const double *to = polygon->at[(i + 1) % polygon->count];
        const double a = side[0] * from[0] + side[1] * from[1] + side[2] * from[2] - least;
        const double b = side[0] * to[0] + side[1] * to[1] + side[2] * to[2] - least;
        if (a >= 0.0) {
            memcpy(kept.at[kept.count++], from, sizeof kept.at[0]);
        }
        if ((a >= 0.0) != (b >= 0.0) && kept.count < MAX_CORNERS) {
            double *between = kept.at[kept.count++];
            for (int c = 0; c < 3; c++) {
                between[c] = a / (a - b) * to[c] - b / (a - b) * from[c];
            }
        }
    }
    *polygon = kept;
}

typedef struct Bounds {
    double min[2];
    double max[2];
} Bounds;

// Returns the pixels that a polygon touches, with the margin.
static Bounds bounds_of(const DipParts *parts, const Polygon *polygon) {
    Bounds bounds = {{1e300, 1e300}, {-1e300, -1e300}};
    for (int i = 0; i < polygon->count; i++) {
        const double *clip = polygon->at[i];
        const double at[2] = {(clip[0] / clip[2] + 1.0) * 0.5 * parts->width,
                              (1.0 - clip[1] / clip[2]) * 0.5 * parts->height};
        for (int axis = 0; axis < 2; axis++) {
            const double min = at[axis] - parts->margin;
            const double max = at[axis] + parts->margin;
            bounds.min[axis] = min < bounds.min[axis] ? min : bounds.min[axis];
            bounds.max[axis] = max > bounds.max[axis] ? max : bounds.max[axis];
        }
    }
    return bounds;
}

static double within(double value, double low, double high) {
    return value < low ? low : value > high ? high : value;
}

// Finds the first and the last of `count` cells of `size` pixels that a range touches. If the range
// touches no cell, *last is less than *first.
static void cells(double min, double max, int size, int count, int *first, int *last) {
    *first = (int)within(min / size, 0.0, count);
    *last = max < 0.0 ? -1 : (int)within(max / size, 0.0, count - 1);
}

static int least(int a, int b) {
    return a < b ? a : b;
}

static int greatest(int a, int b) {
    return a > b ? a : b;
}

// Extends a tile's part until it contains all blocks that the bounds touch. (x, y) is the tile's
// corner in pixels.
static void join(DipTileRegion *part, const Bounds *bounds, int x, int y) {
    const int corner[2] = {x, y};
    int first[2];
    int last[2];
    for (int axis = 0; axis < 2; axis++) {
        cells(bounds->min[axis] - corner[axis], bounds->max[axis] - corner[axis], BLOCK,
              TILE_BLOCKS, &first[axis], &last[axis]);
        if (last[axis] < first[axis]) {
            return;
        }
    }
    const bool empty = part->x0 == part->x1;
    part->x0 = (uint8_t)least(empty ? DIP_TARGET_TILE : part->x0, first[0] * BLOCK);
    part->y0 = (uint8_t)least(empty ? DIP_TARGET_TILE : part->y0, first[1] * BLOCK);
    part->x1 = (uint8_t)greatest(part->x1, (last[0] + 1) * BLOCK);
    part->y1 = (uint8_t)greatest(part->y1, (last[1] + 1) * BLOCK);
}

// Extends a tile's part until it contains a polygon's piece in the tile. The polygon is cut in clip
// space. In pixels, a corner at a near plane that is very near the eye would be so far away that
// doubles round the cut by whole pixels.
static void add_piece(const DipParts *parts, Polygon polygon, int x, int y, DipTileRegion *part) {
    const double reach = DIP_TARGET_TILE + parts->margin;
    const double half[2] = {0.5 * parts->width, 0.5 * parts->height};
    const double sides[4][3] = {{half[0], 0.0, half[0] + parts->margin - x},
                                {-half[0], 0.0, x + reach - half[0]},
                                {0.0, -half[1], half[1] + parts->margin - y},
                                {0.0, half[1], y + reach - half[1]}};
    for (int i = 0; i < 4 && polygon.count; i++) {
        cut(&polygon, sides[i], 0.0);
    }
    if (polygon.count) {
        const Bounds bounds = bounds_of(parts, &polygon);
        join(part, &bounds, x, y);
    }
}

static int tiles_in(int size) {
    return (size + DIP_TARGET_TILE - 1) / DIP_TARGET_TILE;
}

// Extends the parts of all tiles that a polygon touches.
static void add_polygon(const DipParts *parts, const Polygon *polygon) {
    const Bounds bounds = bounds_of(parts, polygon);
    const int across = tiles_in(parts->width);
    int x0, x1, y0, y1;
    cells(bounds.min[0], bounds.max[0], DIP_TARGET_TILE, across, &x0, &x1);
    cells(bounds.min[1], bounds.max[1], DIP_TARGET_TILE, tiles_in(parts->height), &y0, &y1);
    for (int y = y0; y <= y1; y++) {
        for (int x = x0; x <= x1; x++) {
            DipTileRegion *part = &parts->tiles[y * across + x];
            if (x0 == x1 && y0 == y1) {
                join(part, &bounds, x * DIP_TARGET_TILE, y * DIP_TARGET_TILE);
            } else {
                add_piece(parts, *polygon, x * DIP_TARGET_TILE, y * DIP_TARGET_TILE, part);
            }
        }
    }
}

void dip_parts_clear(const DipParts *parts) {
    const size_t count = (size_t)tiles_in(parts->width) * (size_t)tiles_in(parts->height);
    memset(parts->tiles, 0, count * sizeof *parts->tiles);
}

void dip_parts_add_triangle(const DipParts *parts, const DipView *view,
                            const double corners[3][3]) {
    static const double depth[3] = {0.0, 0.0, 1.0};
    Polygon polygon = {.count = 3};
    for (int i = 0; i < 3; i++) {
        dip_extent_project(view, corners[i], polygon.at[i]);
    }
    cut(&polygon, depth, view->near_m);
    for (int i = 0; i < polygon.count; i++) {
        double *w = &polygon.at[i][2];
        *w = *w > view->near_m ? *w : view->near_m; // A cut far away rounds w to about 0.
    }
    add_polygon(parts, &polygon);
}

void dip_parts_add_box(const DipParts *parts, const DipView *view, const double corners[8][3]) {
    DipExtent extent = dip_extent_none();
    dip_extent_add_box(&extent, view, corners);
    Polygon polygon = {.count = extent.min[0] > extent.max[0] ? 0 : 4};
    for (int i = 0; i < polygon.count; i++) {
        const bool right = i == 1 || i == 2;
        polygon.at[i][0] = right ? extent.max[0] : extent.min[0];
        polygon.at[i][1] = i < 2 ? extent.min[1] : extent.max[1];
        polygon.at[i][2] = 1.0;
    }
    add_polygon(parts, &polygon);
}
