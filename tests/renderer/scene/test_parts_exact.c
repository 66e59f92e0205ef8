// Tests that the parts of tiles hold no more blocks than shapes touch. The truth is found tile by
// tile, from the corners of the piece of a triangle that lies in the tile and its margin: corners
// of the triangle, corners of the tile, and crossings of their sides. test_parts.c tests that the
// parts hold enough.
#include "renderer/catalogue/random.h"
#include "renderer/scene/plan/parts.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { TILE = 64, BLOCK = 8, MAX_TILES = 16 };

// Clip x and y are the world's, clip w is the world's z, and the near plane is z = 1.
static const DipView simple_view = {
    .near_m = 1.0, .world_to_clip = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0}};

// A rectangle in pixels: min <= x <= max, and the same for y. It is empty if min > max.
typedef struct Range {
    double min[2];
    double max[2];
} Range;

static DipTileRegion tiles[MAX_TILES + 1];

static DipParts make_parts(int width, int height, int margin) {
    const DipParts parts = {tiles, width, height, margin};
    memset(tiles, 0xee, sizeof tiles);
    dip_parts_clear(&parts);
    return parts;
}

static int tiles_of(int size) {
    int count = 0;
    while (count * TILE < size) {
        count++;
    }
    return count;
}

// Sets a corner in world space that lies at a position in the picture, at the distance w.
static void set_corner(const DipParts *parts, double x, double y, double w, double corner[3]) {
    corner[0] = (2.0 * x / parts->width - 1.0) * w;
    corner[1] = (1.0 - 2.0 * y / parts->height) * w;
    corner[2] = w;
}

// Adds a triangle with corners at positions in the picture, at the distance w.
static void add_at(const DipParts *parts, const double at[3][2], double w) {
    double corners[3][3];
    for (int k = 0; k < 3; k++) {
        set_corner(parts, at[k][0], at[k][1], w, corners[k]);
    }
    dip_parts_add_triangle(parts, &simple_view, (const double(*)[3])corners);
}

// Checks the part of a tile. Blocks that the range touches by more than `slack` must be in it, and
// no others, unless the range comes within `slack` of them. A block has its left and upper border.
static void check_part(const DipTileRegion *part, const Range *range, const int corner[2],
                       double slack) {
    const int begin[2] = {part->x0, part->y0};
    const int end[2] = {part->x1, part->y1};
    bool least_touched = true, most_touched = true;
    int least[2][2], most[2][2];
    for (int axis = 0; axis < 2; axis++) {
        least[axis][0] = most[axis][0] = TILE;
        least[axis][1] = most[axis][1] = 0;
        for (int b = 0; b < TILE; b += BLOCK) {
            const double from = corner[axis] + b, to = from + BLOCK;
            if (range->min[axis] + slack < to && range->max[axis] - slack >= from) {
                least[axis][0] = b < least[axis][0] ? b : least[axis][0];
                least[axis][1] = b + BLOCK;
            }
            if (range->min[axis] - slack < to && range->max[axis] + slack >= from) {
                most[axis][0] = b < most[axis][0] ? b : most[axis][0];
                most[axis][1] = b + BLOCK;
            }
        }
        least_touched = least_touched && least[axis][0] < least[axis][1];
        most_touched = most_touched && most[axis][0] < most[axis][1];
    }
    if (!most_touched) {
        assert_true(begin[0] == end[0] || begin[1] == end[1]);
        return;
    }
    for (int axis = 0; axis < 2; axis++) {
        const bool empty = begin[axis] == end[axis];
        assert_true(empty || (begin[axis] >= most[axis][0] && end[axis] <= most[axis][1]));
        assert_true(!least_touched ||
                    (begin[axis] <= least[axis][0] && end[axis] >= least[axis][1]));
    }
}

static void include(Range *range, double x, double y) {
    range->min[0] = fmin(range->min[0], x);
    range->min[1] = fmin(range->min[1], y);
    range->max[0] = fmax(range->max[0], x);
    range->max[1] = fmax(range->max[1], y);
}

static bool holds(const Range *range, const double at[2]) {
    return at[0] >= range->min[0] && at[0] <= range->max[0] && at[1] >= range->min[1] &&
           at[1] <= range->max[1];
}

static bool in_triangle(const double at[3][2], double x, double y) {
    int left = 0, right = 0;
    for (int k = 0; k < 3; k++) {
        const double *a = at[k], *b = at[(k + 1) % 3];
        const double side = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
        left += side >= 0.0;
        right += side <= 0.0;
    }
    return left == 3 || right == 3;
}

// Finds the rectangle around the part of a triangle that lies in a window.
static Range piece_of(const double at[3][2], const Range *window) {
    Range piece = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (int k = 0; k < 3; k++) {
        const double *a = at[k], *b = at[(k + 1) % 3];
        if (holds(window, a)) {
            include(&piece, a[0], a[1]);
        }
        for (int side = 0; side < 4; side++) {
            const int axis = side / 2;
            const double line = side % 2 ? window->max[axis] : window->min[axis];
            const double t = (line - a[axis]) / (b[axis] - a[axis]);
            const double across = a[!axis] + t * (b[!axis] - a[!axis]);
            if (t >= 0.0 && t <= 1.0 && across >= window->min[!axis] &&
                across <= window->max[!axis]) {
                include(&piece, axis ? across : line, axis ? line : across);
            }
        }
    }
    for (int corner = 0; corner < 4; corner++) {
        const double x = corner & 1 ? window->max[0] : window->min[0];
        const double y = corner & 2 ? window->max[1] : window->min[1];
        if (in_triangle(at, x, y)) {
            include(&piece, x, y);
        }
    }
    return piece;
}

// A pixel of a tile is in the part if it is within the margin of a point of the triangle. This
// point then lies in the tile or its margin.
static void triangles_have_the_blocks_of_their_pieces(void **state) {
    (void)state;
    static const int sizes[3][2] = {{256, 192}, {193, 129}, {63, 65}};
    Random random = {7};
    for (int i = 0; i < 20000; i++) {
        const int *size = sizes[i % 3];
        const int margin = i / 3 % 4;
        const DipParts parts = make_parts(size[0], size[1], margin);
        const double spread = pow(10.0, random_real(&random, 0.0, 2.5));
        double at[3][2];
        for (int k = 0; k < 6; k++) {
            const double first = k < 2 ? 0.5 * size[k] : at[0][k % 2];
            at[k / 2][k % 2] = random_real(&random, fmax(first - spread, 0.0),
                                           fmin(first + spread, size[k % 2] - 0.5));
        }
        add_at(&parts, (const double(*)[2])at, random_real(&random, 1.0, 9.0));
        const int across = tiles_of(size[0]);
        for (int t = 0; t < across * tiles_of(size[1]); t++) {
            const int corner[2] = {t % across * TILE, t / across * TILE};
            const Range window = {{corner[0] - margin, corner[1] - margin},
                                  {corner[0] + TILE + margin, corner[1] + TILE + margin}};
            Range range = piece_of((const double(*)[2])at, &window);
            for (int axis = 0; axis < 2; axis++) {
                range.min[axis] -= margin;
                range.max[axis] += margin;
            }
            check_part(&tiles[t], &range, corner, 1e-6);
        }
    }
}

static int tile_at(double place) {
    return place < 0.0 ? 0 : (int)(place / TILE);
}

// Seen from the front, a box is a rectangle. Its sides lie at borders of pixels, blocks and tiles,
// in a picture whose size is a power of two, so every number is exact unless tiles divide the box.
static void boxes_have_the_blocks_that_they_touch(void **state) {
    (void)state;
    enum { W = 256, H = 128, PLACES = 13 };
    static const double place[PLACES] = {-40, -2, 0, 6, 8, 9.5, 62, 64, 66, 72, 126, 128, 254};
    for (int i = 0; i < PLACES * PLACES * PLACES * PLACES; i++) {
        const int margin = i % 3;
        const int index[4] = {i % PLACES, i / PLACES % PLACES, i / PLACES / PLACES % PLACES,
                              i / PLACES / PLACES / PLACES};
        if (index[0] > index[1] || index[2] > index[3]) {
            continue;
        }
        const DipParts parts = make_parts(W, H, margin);
        const double x[2] = {place[index[0]], place[index[1]]};
        const double y[2] = {place[index[2]], place[index[3]]};
        double corners[8][3];
        for (int k = 0; k < 8; k++) {
            set_corner(&parts, x[k & 1], y[k >> 1 & 1], 1.0, corners[k]);
        }
        dip_parts_add_box(&parts, &simple_view, (const double(*)[3])corners);
        // Only the part of a box that lies within the picture counts.
        const bool seen = x[1] >= 0.0 && x[0] <= W && y[1] >= 0.0 && y[0] <= H;
        const Range range = {{fmax(x[0], 0.0) - margin, fmax(y[0], 0.0) - margin},
                             {fmin(x[1], W) + margin, fmin(y[1], H) + margin}};
        const bool divided = tile_at(range.min[0]) != tile_at(range.max[0]) ||
                             tile_at(range.min[1]) != tile_at(range.max[1]);
        const Range nothing = {{1e9, 1e9}, {-1e9, -1e9}};
        for (int t = 0; t < W / TILE * (H / TILE); t++) {
            const int corner[2] = {t % (W / TILE) * TILE, t / (W / TILE) * TILE};
            check_part(&tiles[t], seen ? &range : &nothing, corner, divided ? 1e-9 : 0.0);
        }
    }
}

static void assert_part(int tile, int x0, int y0, int x1, int y1) {
    assert_int_equal(tiles[tile].x0, x0);
    assert_int_equal(tiles[tile].y0, y0);
    assert_int_equal(tiles[tile].x1, x1);
    assert_int_equal(tiles[tile].y1, y1);
}

static void clearing_empties_the_parts_of_the_picture_only(void **state) {
    (void)state;
    static const int sizes[4][3] = {{1, 1, 1}, {64, 64, 1}, {65, 64, 2}, {129, 65, 6}};
    for (int i = 0; i < 4; i++) {
        make_parts(sizes[i][0], sizes[i][1], 2);
        for (int t = 0; t < MAX_TILES; t++) {
            const int value = t < sizes[i][2] ? 0 : 0xee;
            assert_part(t, value, value, value, value);
        }
    }
}

// The part of a tile is the rectangle around the blocks of all shapes.
static void the_part_of_two_triangles_holds_both(void **state) {
    (void)state;
    static const double low[3][2] = {{9, 17}, {10, 17}, {9, 18}};
    static const double high[3][2] = {{50, 33}, {51, 33}, {50, 34}};
    for (int order = 0; order < 2; order++) {
        const DipParts parts = make_parts(128, 128, 0);
        add_at(&parts, order ? high : low, 1.0);
        assert_part(0, order ? 48 : 8, order ? 32 : 16, order ? 56 : 16, order ? 40 : 24);
        add_at(&parts, order ? low : high, 1.0);
        assert_part(0, 8, 16, 56, 40);
    }
}

// The margin of the first tile ends at (66, 66), which lies on the triangle's longest side. So no
// pixel of the tile is within the margin: the tile ends at 64, and pixel 64 is the next tile's.
static void a_triangle_that_touches_the_margin_in_a_point_adds_nothing(void **state) {
    (void)state;
    static const double beside[3][2] = {{34, 98}, {98, 34}, {98, 98}};
    static const double inside[3][2] = {{3, 3}, {4, 3}, {3, 4}};
    const DipParts parts = make_parts(128, 128, 2);
    add_at(&parts, beside, 1.0);
    assert_true(tiles[0].x0 == tiles[0].x1);
    add_at(&parts, inside, 1.0);
    assert_part(0, 0, 0, 8, 8);
}

// A triangle is in the parts at the distance of the near plane and beyond, and is not before it.
static void triangles_count_from_the_near_plane_on(void **state) {
    (void)state;
    static const double at[3][2] = {{9, 17}, {50, 17}, {9, 34}};
    static const double distances[] = {0.25, 0.5, 0.999, 1.0, 1.001, 1.5, 3.0};
    for (size_t i = 0; i < sizeof distances / sizeof *distances; i++) {
        const DipParts parts = make_parts(128, 128, 0);
        add_at(&parts, at, distances[i]);
        if (distances[i] < 1.0) {
            assert_part(0, 0, 0, 0, 0);
        } else {
            assert_part(0, 8, 16, 56, 40);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triangles_have_the_blocks_of_their_pieces),
        cmocka_unit_test(boxes_have_the_blocks_that_they_touch),
        cmocka_unit_test(clearing_empties_the_parts_of_the_picture_only),
        cmocka_unit_test(the_part_of_two_triangles_holds_both),
        cmocka_unit_test(a_triangle_that_touches_the_margin_in_a_point_adds_nothing),
        cmocka_unit_test(triangles_count_from_the_near_plane_on),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
