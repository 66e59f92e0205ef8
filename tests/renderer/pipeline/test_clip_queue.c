// The fragments of several alpha-clipped triangles wait for the clip test together. Tests that the
// samples that are drawn and the fragments that are tested are those of a plain model, which draws
// and tests each triangle before the next one, sample by sample.
#include "renderer/pipeline/raster/fragments.h"
#include "tests/renderer/pipeline/cover_tile.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { SEED = 4711, ROUNDS = 400, TRIANGLES = 24, PIXELS = DIP_TILE * DIP_TILE };

// Triangles of one draw in a tile.
typedef struct Case {
    const DipSamplePattern *pattern;
    const DipSampleGroups *groups; // NULL: one group
    bool alpha_to_coverage;
    bool near_to_far;
    DipOracleRegion region;
    DipOracleTriangle corners[TRIANGLES];
    float z[TRIANGLES];
} Case;

// What the model and the kernels draw and test.
typedef struct Result {
    uint32_t id[PIXELS][DIP_MAX_SAMPLES];
    uint8_t tested[TRIANGLES][PIXELS]; // number of fragments
} Result;

static Result expected;
static Result found;

// Returns how many samples of a triangle's fragment are kept, from 0 to 8; without alpha to
// coverage, 0 cuts the fragment away.
static int kept_samples(int triangle, int x, int y) {
    const unsigned mixed = ((unsigned)triangle * 64 + (unsigned)y) * 64 + (unsigned)x;
    return (int)((mixed * 2654435761u >> 28) % 9);
}

// --- the model -----------------------------------------------------------------------------------

// Returns which of a pixel's visible samples are kept.
static unsigned keep(const Case *c, unsigned visible, int count) {
    if (!c->alpha_to_coverage) {
        return count ? visible : 0;
    }
    unsigned kept = 0;
    for (int i = 0; i < count && i < c->pattern->count; i++) {
        kept |= 1u << c->pattern->order[i];
    }
    return visible & kept;
}

static int count_groups(const Case *c, unsigned samples) {
    int count = 0;
    for (int g = 0; c->groups && g < c->groups->count; g++) {
        count += (c->groups->samples[g] & samples) != 0;
    }
    return c->groups ? count : samples != 0;
}

static void draw_model(const Case *c) {
    static float depth[PIXELS][DIP_MAX_SAMPLES];
    static uint8_t masks[PIXELS];
    memset(depth, 0, sizeof depth);
    memset(&expected, 0, sizeof expected);
    for (int t = 0; t < TRIANGLES; t++) {
        dip_oracle_cover(&c->corners[t], c->pattern, &c->region, masks);
        for (int i = 0; i < c->region.width * c->region.height; i++) {
            const int x = i % c->region.width;
            const int y = i / c->region.width;
            const int pixel = y * DIP_TILE + x;
            unsigned visible = 0;
            for (int s = 0; s < c->pattern->count; s++) {
                visible |= (unsigned)((masks[i] >> s & 1) && c->z[t] > depth[pixel][s]) << s;
            }
            expected.tested[t][pixel] = (uint8_t)count_groups(c, visible);
            const unsigned kept = keep(c, visible, kept_samples(t, x, y));
            for (int s = 0; s < c->pattern->count; s++) {
                if (kept >> s & 1) {
                    depth[pixel][s] = c->z[t];
                    expected.id[pixel][s] = (uint32_t)t + 1;
                }
            }
        }
    }
}

// --- the kernels ---------------------------------------------------------------------------------

// The state of the clip test.
typedef struct Asked {
    DipFragmentList list;
    DipClipQueue queue;
    int calls;
    uint8_t keep[DIP_FRAGMENT_BATCH];
} Asked;

static const uint8_t *ask(void *context, uint32_t draw) {
    Asked *asked = context;
    assert_int_equal(draw, 0);
    assert_in_range(asked->list.count, 1, DIP_FRAGMENT_BATCH);
    asked->calls++;
    for (int i = 0; i < asked->list.count; i++) {
        const unsigned pixel = asked->list.position[i] & DIP_POSITION_PIXEL;
        const int triangle = (int)asked->list.triangle[i];
        assert_in_range(triangle, 0, TRIANGLES - 1);
        found.tested[triangle][pixel]++;
        asked->keep[i] =
            (uint8_t)kept_samples(triangle, (int)(pixel % DIP_TILE), (int)(pixel / DIP_TILE));
    }
    return asked->keep;
}

// Draws a case's triangles. together: fragments of several triangles may wait. Outputs the number
// of calls of the clip test. Returns the tile, for its counters.
static DipTile draw_kernels(const Case *c, DipIsa isa, bool together, int *calls) {
    static Asked asked;
    static DipTriangle triangles[TRIANGLES];
    const DipKernels *kernels = dip_kernels(isa);
    asked.calls = 0;
    memset(&found, 0, sizeof found);
    DipTile tile = cover_tile(c->pattern, &c->region);
    tile.near_to_far = c->near_to_far ? triangles : NULL;
    const DipClipTest clip = {.list = &asked.list,
                              .test = ask,
                              .context = &asked,
                              .groups = c->groups,
                              .order = c->alpha_to_coverage ? c->pattern->order : NULL,
                              .queue = &asked.queue,
                              .triangles = triangles};
    for (int t = 0; t < TRIANGLES; t++) {
        if (cover_set_up(kernels, c->pattern, &c->corners[t], c->z[t], &c->region, &triangles[t])) {
            kernels->dip_kernel_draw_triangle(&tile, &triangles[t], (uint32_t)t + 1, &clip);
        }
        if ((!together || t + 1 == TRIANGLES) && asked.queue.count) {
            kernels->dip_kernel_clip(&tile, &clip);
        }
    }
    *calls = asked.calls;
    for (int i = 0; i < PIXELS; i++) {
        const int block = i / DIP_TILE / DIP_BLOCK * DIP_TILE_BLOCKS + i % DIP_TILE / DIP_BLOCK;
        const int pixel = dip_block_pixel(i % DIP_BLOCK, i / DIP_TILE % DIP_BLOCK);
        for (int s = 0; s < c->pattern->count && tile.touched >> block & 1; s++) {
            found.id[i][s] = tile.id[dip_tile_index(&tile, block, s) + pixel];
        }
    }
    return tile;
}

static void assert_alike(const Case *c) {
    for (int i = 0; i < c->region.width * c->region.height; i++) {
        const int pixel = i / c->region.width * DIP_TILE + i % c->region.width;
        for (int t = 0; t < TRIANGLES; t++) {
            assert_int_equal(found.tested[t][pixel], expected.tested[t][pixel]);
        }
        for (int s = 0; s < c->pattern->count; s++) {
            assert_int_equal(found.id[pixel][s], expected.id[pixel][s]);
        }
    }
}

// --- tests ---------------------------------------------------------------------------------------

// Small triangles in a row, or triangles of all kinds, at random depths.
static Case random_case(Random *random, int number, DipSampleGroups *groups) {
    static const int sample_counts[] = {1, 2, 4, 6, 8};
    const int sample_count = sample_counts[number % 5];
    Case c = {.pattern = dip_sample_pattern(sample_count), .region = cover_random_tile(random)};
    if (number % 3 == 0 && dip_sample_groups_exist(sample_count, 2) && sample_count > 2) {
        dip_sample_groups_make(groups, c.pattern, 2);
        c.groups = groups;
    }
    c.alpha_to_coverage = !c.groups && number % 4 == 1;
    c.near_to_far = number % 2;
    for (int t = 0; t < TRIANGLES; t++) {
        const DipOracleKind kind =
            number % 7 < 4 ? DIP_ORACLE_small : (DipOracleKind)(t % DIP_ORACLE_KINDS);
        c.corners[t] = dip_oracle_make(kind, random, c.pattern, &c.region,
                                       DIP_GUARD_BAND_PX * DIP_SUBPIXELS - 1);
        c.z[t] = (float)random_int(random, 1, 1 << 20) * 0x1p-20f;
    }
    return c;
}

static void triangles_that_wait_together_are_drawn_one_after_the_other(void **state) {
    (void)state;
    Random random = {SEED};
    int fewest_calls = TRIANGLES;
    for (int number = 0; number < ROUNDS; number++) {
        DipSampleGroups groups;
        const Case c = random_case(&random, number, &groups);
        draw_model(&c);
        int calls;
        const DipTile alone = draw_kernels(&c, DIP_ISA_SCALAR, false, &calls);
        assert_alike(&c);
        for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
            if (dip_isa_available((DipIsa)isa)) {
                const DipTile tile = draw_kernels(&c, (DipIsa)isa, true, &calls);
                assert_alike(&c);
                assert_int_equal(tile.sub_blocks_tested, alone.sub_blocks_tested);
                assert_int_equal(tile.sub_blocks_accepted, alone.sub_blocks_accepted);
                assert_int_equal(tile.grouped, alone.grouped);
                fewest_calls = calls && calls < fewest_calls ? calls : fewest_calls;
            }
        }
    }
    assert_int_equal(fewest_calls, 1); // for small triangles that wait nowhere in the same pixel
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triangles_that_wait_together_are_drawn_one_after_the_other),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
