// Tests the parts of tiles: the rectangle of each tile that a triangle or box may touch. Random
// points of the shapes, projected here in double precision, must lie in them.
#include "renderer/scene/plan/parts.h"
#include "tests/renderer/scene/random_view.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

enum {
    WIDTH = 320,
    HEIGHT = 256,
    TILE = 64,
    TILES_X = WIDTH / TILE,
    PARTS = TILES_X * (HEIGHT / TILE),
    MARGIN = 2
};

// Returns true if a point, in world space, is in the picture. Also computes its position in the
// picture, in pixels.
static bool project_point(const DipView *view, const double world[3], double at[2]) {
    double clip[4];
    for (int r = 0; r < 4; r++) {
        const double *m = view->world_to_clip + 4 * r;
        clip[r] = m[0] * world[0] + m[1] * world[1] + m[2] * world[2] + m[3];
    }
    at[0] = (clip[0] / clip[3] + 1.0) * 0.5 * WIDTH;
    at[1] = (1.0 - clip[1] / clip[3]) * 0.5 * HEIGHT;
    return clip[3] >= clip[2] && at[0] >= 0.0 && at[0] <= WIDTH && at[1] >= 0.0 && at[1] <= HEIGHT;
}

// Checks that all pixels within MARGIN of a position in the picture lie in the drawn part of their
// tile.
static void assert_in_parts(const DipTileRegion *parts, const double at[2]) {
    for (int dy = -MARGIN; dy <= MARGIN; dy++) {
        for (int dx = -MARGIN; dx <= MARGIN; dx++) {
            const int x = (int)floor(at[0]) + dx;
            const int y = (int)floor(at[1]) + dy;
            if (x >= 0 && x < WIDTH && y >= 0 && y < HEIGHT) {
                const DipTileRegion *part = &parts[y / TILE * TILES_X + x / TILE];
                assert_true(x % TILE >= part->x0 && x % TILE < part->x1);
                assert_true(y % TILE >= part->y0 && y % TILE < part->y1);
            }
        }
    }
}

static uint64_t area_of(const DipTileRegion *parts) {
    uint64_t area = 0;
    for (int t = 0; t < PARTS; t++) {
        assert_true(parts[t].x1 <= TILE && parts[t].y1 <= TILE);
        area += (uint64_t)(parts[t].x1 - parts[t].x0) * (uint64_t)(parts[t].y1 - parts[t].y0);
    }
    return area;
}

// Makes the corners of a random triangle or of a random upright cube.
static void random_shape(Random *random, int count, double (*corners)[3]) {
    const double size = pow(10.0, random_real(random, -0.5, 2.0));
    double low[3];
    for (int c = 0; c < 3; c++) {
        low[c] = random_real(random, -20.0, 20.0);
    }
    for (int i = 0; i < count; i++) {
        for (int c = 0; c < 3; c++) {
            const double along = count == 8 ? i >> c & 1 : random_real(random, 0.0, 1.0);
            corners[i][c] = low[c] + size * along;
        }
    }
}

// Picks a point in the convex hull of the shape: a mean of its corners with random weights. A few
// corners have most of the weight.
static void mean_of(Random *random, int count, double (*corners)[3], double world[3]) {
    double sum = 0.0;
    world[0] = world[1] = world[2] = 0.0;
    for (int i = 0; i < count; i++) {
        const double weight = pow(random_real(random, 0.0, 1.0), 4.0);
        sum += weight;
        for (int c = 0; c < 3; c++) {
            world[c] += weight * corners[i][c];
        }
    }
    for (int c = 0; c < 3; c++) {
        world[c] /= sum;
    }
}

// Checks random points of a shape that has been added to the parts. Returns how many are in the
// picture.
static int check_parts(Random *random, const DipView *view, int count, double (*corners)[3],
                       const DipTileRegion *tiles) {
    enum { MEANS = 300 };
    int seen = 0;
    for (int k = 0; k < MEANS; k++) {
        double world[3];
        double at[2];
        mean_of(random, count, corners, world);
        if (project_point(view, world, at)) {
            assert_in_parts(tiles, at);
            seen++;
        }
    }
    return seen;
}

static void tile_parts_contain_everything_visible(void **state) {
    (void)state;
    enum { SHAPES = 6000 };
    Random random = {99};
    DipTileRegion tiles[PARTS];
    const DipParts parts = {tiles, WIDTH, HEIGHT, MARGIN};
    int seen = 0;
    uint64_t area = 0;
    for (int i = 0; i < SHAPES; i++) {
        const DipView view = random_view(&random, (double)WIDTH / HEIGHT);
        const int count = i % 2 ? 3 : 8;
        double corners[8][3];
        random_shape(&random, count, corners);
        dip_parts_clear(&parts);
        if (count == 3) {
            dip_parts_add_triangle(&parts, &view, (const double(*)[3])corners);
        } else {
            dip_parts_add_box(&parts, &view, (const double(*)[3])corners);
        }
        area += count == 3 ? area_of(tiles) : 0;
        seen += check_parts(&random, &view, count, corners, tiles);
    }
    printf("%d points seen, the triangles' parts hold %.1f %% of the picture\n", seen,
           100.0 * (double)area / ((double)SHAPES / 2 * WIDTH * HEIGHT));
    assert_true(seen > 100000);
    assert_true(area < (uint64_t)SHAPES / 2 * WIDTH * HEIGHT / 10);
}

// With a near plane next to the eye, the corners that it cuts lie up to 2^60 pixels away.
static void tile_parts_of_huge_triangles_contain_everything_visible(void **state) {
    (void)state;
    enum { TRIANGLES = 3000 };
    Random random = {77};
    DipTileRegion tiles[PARTS];
    const DipParts parts = {tiles, WIDTH, HEIGHT, MARGIN};
    int seen = 0;
    for (int i = 0; i < TRIANGLES; i++) {
        DipView view = random_view(&random, (double)WIDTH / HEIGHT);
        view.near_m = 1e-12;
        double corners[3][3];
        double passed[3]; // a point of the triangle, which is put within a metre of the eye
        const double size = pow(10.0, random_real(&random, 3.0, 6.0));
        for (int k = 0; k < 9; k++) {
            corners[k / 3][k % 3] = random_real(&random, -size, size);
        }
        mean_of(&random, 3, corners, passed);
        for (int c = 0; c < 3; c++) {
            const double move = view.eye[c] + random_real(&random, -1.0, 1.0) - passed[c];
            for (int k = 0; k < 3; k++) {
                corners[k][c] += move;
            }
        }
        dip_parts_clear(&parts);
        dip_parts_add_triangle(&parts, &view, (const double(*)[3])corners);
        seen += check_parts(&random, &view, 3, corners, tiles);
    }
    assert_true(seen > 50000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tile_parts_contain_everything_visible),
        cmocka_unit_test(tile_parts_of_huge_triangles_contain_everything_visible),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
