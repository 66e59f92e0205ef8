// Tests that the caller's floating-point mode changes nothing: the filters and the history of
// renderer/post/ give the same bits in every mode and leave the mode as it was.
#include "renderer/post/history.h"
#include "renderer/post/post.h"
#include "tests/support/fp_walk.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

enum { WIDTH = 66, HEIGHT = 41, PIXELS = WIDTH * HEIGHT, PICTURES = 8, TO_WIDTH = 99 };

static uint8_t pictures[PICTURES][PIXELS * 4];
static uint8_t result[TO_WIDTH * HEIGHT * 4];
static float depths[PIXELS];

// Makes noisy triangles.
static int make_inputs(void **state) {
    (void)state;
    uint32_t random = 1;
    for (int p = 0; p < PICTURES; p++) {
        for (int i = 0; i < PIXELS * 4; i++) {
            const int x = i / 4 % WIDTH, y = i / 4 / WIDTH;
            random = random * 1664525u + 1013904223u;
            pictures[p][i] = (uint8_t)((3 * x + (p + 2) * y) % 64 < 32 ? 40 + i % 4 : 200);
            pictures[p][i] = (uint8_t)(pictures[p][i] + (random >> 28));
        }
    }
    for (int i = 0; i < PIXELS; i++) {
        depths[i] = i % 50 ? 0.1f + (float)(i % WIDTH) / 700.0f : 1e-39f;
    }
    return 0;
}

static void run_filter(DipHash *hash, DipPost *post, int width) {
    const DipPostWork work =
        dip_post_run(post, pictures[0], (size_t)WIDTH * 4, result, (size_t)width * 4);
    dip_hash_bytes(hash, result, (size_t)width * HEIGHT * 4);
    dip_hash_integer(hash, (int64_t)work.edges_found);
}

static DipPost *make_filter(DipPostFilter filter, int width) {
    const DipPostDef def = {.filter = filter,
                            .from_width = WIDTH,
                            .from_height = HEIGHT,
                            .to_width = width,
                            .to_height = HEIGHT,
                            .sharpness = 0.4f,
                            .isa = dip_isa_best()};
    DipPost *post = dip_post_create(&def, NULL);
    assert_non_null(post);
    return post;
}

static void call_filters(DipHash *hash) {
    for (int f = 0; f < DIP_POST_COUNT; f++) {
        const int width = dip_post_enlarges((DipPostFilter)f) ? TO_WIDTH : WIDTH;
        DipPost *post = make_filter((DipPostFilter)f, width);
        run_filter(hash, post, width);
        dip_post_destroy(&post);
    }
}

// Filters that were made in the usual mode.
static DipPost *usual[DIP_POST_COUNT];

static void call_usual_filters(DipHash *hash) {
    for (int f = 0; f < DIP_POST_COUNT; f++) {
        run_filter(hash, usual[f], dip_post_enlarges((DipPostFilter)f) ? TO_WIDTH : WIDTH);
    }
}

// The second picture after the first has the weight 1/3 while the camera moves; at rest, weights
// are 1/2, 1/3, ...
static void call_history(DipHash *hash) {
    static const DipHistoryStep steps[] = {DIP_HISTORY_BEGIN, DIP_HISTORY_MOVE, DIP_HISTORY_MOVE,
                                           DIP_HISTORY_MOVE,  DIP_HISTORY_REST, DIP_HISTORY_REST,
                                           DIP_HISTORY_REST};
    const DipHistoryDef def = {WIDTH, HEIGHT, dip_isa_best(), NULL};
    DipHistory *history = dip_history_create(&def, NULL);
    int64_t reprojected = 0;
    assert_non_null(history);
    for (int i = 0; i < 7 * 20; i++) {
        const DipHistoryPicture picture = {.rgba8 = pictures[i % PICTURES],
                                           .stride_bytes = (size_t)WIDTH * 4,
                                           .depths = depths,
                                           .depths_width = WIDTH,
                                           .depths_height = HEIGHT,
                                           .to_before = {0.99f, 0.01f, 0.003f, 0.1f, -0.01f, 0.98f,
                                                         0.0f, 0.2f, 0.0f, 0.01f, 1.0f, 0.1f},
                                           .step = steps[i % 7]};
        const DipHistoryWork work = dip_history_add(history, &picture, result, (size_t)WIDTH * 4);
        reprojected += (int64_t)work.pixels_reprojected;
        dip_hash_bytes(hash, result, PIXELS * 4);
    }
    assert_true(reprojected > 20 * PIXELS);
    dip_hash_integer(hash, reprojected);
    dip_history_destroy(&history);
}

static const FpWalkEntry entries[] = {
    {"filters", call_filters},
    {"filters made in the usual mode", call_usual_filters},
    {"history", call_history},
};

static int make_filters(void **state) {
    make_inputs(state);
    for (int f = 0; f < DIP_POST_COUNT; f++) {
        const int width = dip_post_enlarges((DipPostFilter)f) ? TO_WIDTH : WIDTH;
        usual[f] = make_filter((DipPostFilter)f, width);
    }
    return 0;
}

static int free_filters(void **state) {
    (void)state;
    for (int f = 0; f < DIP_POST_COUNT; f++) {
        dip_post_destroy(&usual[f]);
    }
    return 0;
}

int main(void) {
    return fp_walk_main(entries, sizeof entries / sizeof *entries, make_filters, free_filters);
}
