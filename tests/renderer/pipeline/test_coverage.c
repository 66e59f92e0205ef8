// Compares the samples that the fast renderer covers with the oracle's samples, which are computed
// in exact integers (oracle.h). Tests every sample pattern and every instruction set. No difference
// is allowed.
//
//   test_coverage [--triangles N]
#include "renderer/base/assert.h"
#include "renderer/pipeline/raster/fragments.h"
#include "tests/renderer/pipeline/cover_tile.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SEED = 90125 };

static const int sample_counts[] = {1, 2, 4, 6, 8};
static long triangle_count = 60000;

typedef struct Case {
    const DipSamplePattern *pattern;
    DipOracleRegion region; // the tile's pixels that lie in the target
    DipOracleTriangle triangle;
    DipOracleKind kind;
} Case;

// Draws the case's triangle. A triangle that is culled or does not reach the tile is not drawn.
static void draw_fast(const DipKernels *kernels, const Case *c, DipClipTest *clip, DipTile *tile) {
    DipTriangle triangle;
    *tile = cover_tile(c->pattern, &c->region);
    if (!cover_set_up(kernels, c->pattern, &c->triangle, 0.5f, &c->region, &triangle)) {
        return;
    }
    if (clip) {
        clip->triangles = &triangle;
    }
    kernels->dip_kernel_draw_triangle(tile, &triangle, 1, clip);
    if (clip && clip->queue->count) {
        kernels->dip_kernel_clip(tile, clip);
    }
}

// Reads the tile's covered samples into masks, in the format of dip_oracle_cover.
static void read_masks(const Case *c, const DipTile *tile, uint8_t *masks) {
    memset(masks, 0, (size_t)c->region.width * (size_t)c->region.height);
    for (int block = 0; block < DIP_BLOCKS; block++) {
        for (int i = 0; tile->touched >> block & 1 && i < DIP_BLOCK_PIXELS; i++) {
            const int x = block % DIP_TILE_BLOCKS * DIP_BLOCK + dip_block_x(i);
            const int y = block / DIP_TILE_BLOCKS * DIP_BLOCK + dip_block_y(i);
            for (int s = 0; s < c->pattern->count && x < c->region.width && y < c->region.height;
                 s++) {
                const uint32_t id = tile->id[dip_tile_index(tile, block, s) + i];
                uint8_t *mask = &masks[y * c->region.width + x];
                *mask = (uint8_t)(*mask | id << s);
            }
        }
    }
}

static void cover_fast(const DipKernels *kernels, const Case *c, uint8_t *masks) {
    DipTile tile;
    draw_fast(kernels, c, NULL, &tile);
    read_masks(c, &tile, masks);
}

static void fail_at(const Case *c, DipIsa isa, const uint8_t *expected, const uint8_t *found) {
    int at = 0;
    while (expected[at] == found[at]) {
        at++;
    }
    const DipOracleTriangle *t = &c->triangle;
    fail_msg(
        "%s, %s, %d samples: (%d %d) (%d %d) (%d %d) covers %02x of pixel (%d, %d), found %02x",
        dip_oracle_kind_name(c->kind), dip_isa_name(isa), c->pattern->count, t->x[0], t->y[0],
        t->x[1], t->y[1], t->x[2], t->y[2], expected[at], c->region.x0 + at % c->region.width,
        c->region.y0 + at / c->region.width, found[at]);
}

static void coverage_is_exact(void **state) {
    (void)state;
    static uint8_t expected[DIP_TILE * DIP_TILE];
    static uint8_t found[DIP_TILE * DIP_TILE];
    Random random = {SEED};
    uint64_t covered[DIP_ORACLE_KINDS] = {0};
    for (long t = 0; t < triangle_count; t++) {
        Case c = {.pattern = dip_sample_pattern(sample_counts[t % 5])};
        c.kind = (DipOracleKind)(t / 5 % DIP_ORACLE_KINDS);
        c.region = cover_random_tile(&random);
        c.triangle = dip_oracle_make(c.kind, &random, c.pattern, &c.region,
                                     DIP_GUARD_BAND_PX * DIP_SUBPIXELS - 1);
        covered[c.kind] += dip_oracle_cover(&c.triangle, c.pattern, &c.region, expected);
        for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
            if (!dip_isa_available((DipIsa)isa)) {
                continue;
            }
            cover_fast(dip_kernels((DipIsa)isa), &c, found);
            if (memcmp(expected, found, (size_t)c.region.width * (size_t)c.region.height) != 0) {
                fail_at(&c, (DipIsa)isa, expected, found);
            }
        }
    }
    printf("%ld triangles, samples covered:", triangle_count);
    for (int kind = 0; kind < DIP_ORACLE_KINDS; kind++) {
        printf(" %s %llu", dip_oracle_kind_name((DipOracleKind)kind),
               (unsigned long long)covered[kind]);
        // Triangles without area cover nothing. All other kinds must cover some samples.
        assert_true(kind == DIP_ORACLE_flat ? covered[kind] == 0 : covered[kind] > 0);
    }
    printf("\n");
}

// Draws large triangles that overlap the target in only one pixel, at the target's corner.
static void large_triangles_that_meet_one_pixel_are_exact(void **state) {
    (void)state;
    static uint8_t expected[DIP_TILE * DIP_TILE];
    static uint8_t found[DIP_TILE * DIP_TILE];
    Random random = {SEED + 2};
    uint64_t covered = 0;
    for (int t = 0; t < 20000; t++) {
        Case c = {.pattern = dip_sample_pattern(sample_counts[t % 5]),
                  .region = {0, 0, DIP_TILE, DIP_TILE}};
        for (int i = 0; i < 3; i++) {
            const bool far = i <= t % 2;
            const int low = far ? -DIP_GUARD_BAND_PX * DIP_SUBPIXELS + 1 : 0;
            const int high = far ? -600 : 270;
            c.triangle.x[i] = random_int(&random, low, high);
            c.triangle.y[i] = random_int(&random, low, high);
        }
        covered += dip_oracle_cover(&c.triangle, c.pattern, &c.region, expected);
        for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
            if (dip_isa_available((DipIsa)isa)) {
                cover_fast(dip_kernels((DipIsa)isa), &c, found);
                if (memcmp(expected, found, sizeof expected) != 0) {
                    fail_at(&c, (DipIsa)isa, expected, found);
                }
            }
        }
    }
    assert_true(covered > 10000);
}

// The triangles around a hub share edges with their neighbours. The oracle and the kernels must
// cover every sample around the hub exactly once.
static void fans_cover_every_sample_exactly_once(void **state) {
    (void)state;
    static uint8_t masks[DIP_TILE * DIP_TILE];
    static uint8_t hit[2][DIP_TILE * DIP_TILE];
    Random random = {SEED + 1};
    for (int t = 0; t < 400; t++) {
        Case c = {.pattern = dip_sample_pattern(sample_counts[t % 5])};
        c.region = cover_random_tile(&random);
        const size_t pixels = (size_t)c.region.width * (size_t)c.region.height;
        const uint8_t all = (uint8_t)((1u << c.pattern->count) - 1u);
        DipOracleTriangle fan[DIP_ORACLE_FAN];
        dip_oracle_make_fan(&random, c.pattern, &c.region, fan);
        memset(hit, 0, sizeof hit);
        for (int i = 0; i < DIP_ORACLE_FAN; i++) {
            c.triangle = fan[i];
            for (int path = 0; path < 2; path++) {
                if (path == 0) {
                    dip_oracle_cover(&c.triangle, c.pattern, &c.region, masks);
                } else {
                    cover_fast(dip_kernels(dip_isa_best()), &c, masks);
                }
                for (size_t p = 0; p < pixels; p++) {
                    assert_int_equal(hit[path][p] & masks[p], 0);
                    hit[path][p] |= masks[p];
                }
            }
        }
        for (size_t p = 0; p < pixels; p++) {
            assert_int_equal(hit[0][p], all);
            assert_int_equal(hit[1][p], all);
        }
    }
}

// The state of a clip test (a shader that decides whether a fragment is kept). This test keeps
// every second pixel, like a chequerboard, and checks the positions at which the pipeline calls it.
typedef struct Chequer {
    const Case *c;
    const uint8_t *covered; // the oracle's masks
    DipFragmentList list;
    uint8_t keep[DIP_FRAGMENT_BATCH];
    uint8_t asked[DIP_TILE * DIP_TILE]; // number of calls for each pixel of the region
} Chequer;

static bool chequer_keeps(int x, int y) {
    return ((x ^ y) & 1) != 0 || (x & 4) != 0;
}

static const uint8_t *ask_chequer(void *context, uint32_t draw) {
    (void)draw;
    Chequer *chequer = context;
    const DipOracleRegion *region = &chequer->c->region;
    const DipSamplePattern *pattern = chequer->c->pattern;
    assert_in_range(chequer->list.count, 1, DIP_FRAGMENT_BATCH);
    for (int i = 0; i < chequer->list.count; i++) {
        const uint32_t position = chequer->list.position[i];
        const int x = position & (DIP_TILE - 1);
        const int y = position >> DIP_POSITION_Y & (DIP_TILE - 1);
        if (x >= region->width || y >= region->height) {
            continue; // outside the target; the pipeline does not use the result there
        }
        const unsigned mask = chequer->covered[y * region->width + x];
        const bool whole = mask == (1u << pattern->count) - 1u;
        const int first = mask ? __builtin_ctz(mask) : 0;
        assert_int_equal(chequer->list.triangle[i], 0);
        assert_true(mask != 0);
        assert_int_equal(position >> DIP_POSITION_SUB_X & 255, whole ? 128 : pattern->x[first]);
        assert_int_equal(position >> DIP_POSITION_SUB_Y & 255, whole ? 128 : pattern->y[first]);
        chequer->asked[y * region->width + x]++;
        chequer->keep[i] = chequer_keeps(x, y);
    }
    return chequer->keep;
}

// The pipeline runs the clip test once for every covered pixel, at the pixel's centre or at its
// first covered sample. If the test keeps the pixel, the covered samples are drawn. The counters do
// not depend on the vector width.
static void the_clip_test_runs_once_per_pixel_and_decides_what_is_drawn(void **state) {
    (void)state;
    static uint8_t expected[DIP_TILE * DIP_TILE];
    static uint8_t found[DIP_TILE * DIP_TILE];
    static Chequer chequer;
    static DipClipQueue queue;
    Random random = {SEED + 2};
    for (int t = 0; t < 2000; t++) {
        Case c = {.pattern = dip_sample_pattern(sample_counts[t % 5])};
        c.kind = (DipOracleKind)(t / 5 % DIP_ORACLE_KINDS);
        c.region = cover_random_tile(&random);
        c.triangle = dip_oracle_make(c.kind, &random, c.pattern, &c.region,
                                     DIP_GUARD_BAND_PX * DIP_SUBPIXELS - 1);
        dip_oracle_cover(&c.triangle, c.pattern, &c.region, expected);
        DipTile first = {.x0 = 0};
        for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
            if (!dip_isa_available((DipIsa)isa)) {
                continue;
            }
            memset(&chequer, 0, sizeof chequer);
            chequer.c = &c;
            chequer.covered = expected;
            DipClipTest clip = {
                .list = &chequer.list, .test = ask_chequer, .context = &chequer, .queue = &queue};
            DipTile tile;
            draw_fast(dip_kernels((DipIsa)isa), &c, &clip, &tile);
            read_masks(&c, &tile, found);
            for (int p = 0; p < c.region.width * c.region.height; p++) {
                const bool keeps = chequer_keeps(p % c.region.width, p / c.region.width);
                assert_int_equal(chequer.asked[p], expected[p] != 0);
                assert_int_equal(found[p], keeps ? expected[p] : 0);
            }
            first = isa == DIP_ISA_SCALAR ? tile : first;
            assert_int_equal(tile.sub_blocks_tested, first.sub_blocks_tested);
            assert_int_equal(tile.sub_blocks_accepted, first.sub_blocks_accepted);
        }
    }
}

static void patterns_lie_within_their_bounds(void **state) {
    (void)state;
    for (int i = 0; i < 5; i++) {
        const DipSamplePattern *pattern = dip_sample_pattern(sample_counts[i]);
        int least = 255;
        int greatest = 0;
        for (int s = 0; s < pattern->count; s++) {
            for (int axis = 0; axis < 2; axis++) {
                const int at = axis ? pattern->y[s] : pattern->x[s];
                least = at < least ? at : least;
                greatest = at > greatest ? at : greatest;
            }
        }
        assert_int_equal(pattern->least, least);
        assert_int_equal(pattern->greatest, greatest);
    }
}

// Tests the oracle itself, on a square of 2x2 pixels that is cut along its diagonal. A sample on an
// edge belongs only to the triangle for which this edge is a left or an upper edge.
static void the_oracle_agrees_with_an_example_worked_by_hand(void **state) {
    (void)state;
    const DipSamplePattern *centre = dip_sample_pattern(1);
    const DipOracleRegion region = {0, 0, 4, 4};
    uint8_t masks[16];
    // The corners lie on the centres of the pixels (0,0), (2,0) and (0,2), with the right angle at
    // the top left.
    const DipOracleTriangle upper = {{128, 640, 128}, {128, 128, 640}};
    assert_int_equal(dip_oracle_cover(&upper, centre, &region, masks), 3);
    assert_int_equal(masks[0] & masks[1] & masks[4], 1);
    // The other half of the square. The diagonal is its left edge, so samples on the diagonal
    // belong to it. Samples on its right and lower edges do not.
    const DipOracleTriangle lower = {{640, 640, 128}, {128, 640, 640}};
    assert_int_equal(dip_oracle_cover(&lower, centre, &region, masks), 1);
    assert_int_equal(masks[5], 1);
}

int main(int argc, char **argv) {
    if (argc == 3 && strcmp(argv[1], "--triangles") == 0) {
        triangle_count = strtol(argv[2], NULL, 10);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_oracle_agrees_with_an_example_worked_by_hand),
        cmocka_unit_test(patterns_lie_within_their_bounds),
        cmocka_unit_test(coverage_is_exact),
        cmocka_unit_test(the_clip_test_runs_once_per_pixel_and_decides_what_is_drawn),
        cmocka_unit_test(large_triangles_that_meet_one_pixel_are_exact),
        cmocka_unit_test(fans_cover_every_sample_exactly_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
