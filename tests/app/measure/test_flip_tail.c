// Tests of the distribution of FLIP: percentiles against sorted values, and the worst block against
// trying all.
#include "app/measure/metrics/flip_tail.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include <math.h>

enum { FRAMES = 2, MAX_SIDE = 150 };

static uint32_t random_state = 1;

static double random_share(void) {
    random_state = random_state * 1664525u + 1013904223u;
    return (random_state >> 8) * 0x1p-24;
}

static void expect_near(double found, double expected, double tolerance) {
    if (!(fabs(found - expected) <= tolerance)) {
        fail_msg("%.9g, expected %.9g", found, expected);
    }
}

static int compare_floats(const void *a, const void *b) {
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static float maps[FRAMES][MAX_SIDE * MAX_SIDE];

// Most values are small, as those of a good picture are.
static void fill_random(int width, int height) {
    for (int f = 0; f < FRAMES; f++) {
        for (int i = 0; i < width * height; i++) {
            const double share = random_share();
            maps[f][i] = (float)(share * share * share);
        }
    }
}

static DipFlipTail measure(int width, int height) {
    DipFlipTailMeter meter;
    assert_true(dip_flip_tail_init(&meter));
    for (int burst = 0; burst < 2; burst++) { // The second burst starts from nothing.
        dip_flip_tail_restart(&meter);
        for (int f = 0; f < FRAMES; f++) {
            dip_flip_tail_add(&meter, maps[f], width, height);
        }
    }
    const DipFlipTail tail = dip_flip_tail_result(&meter);
    dip_flip_tail_free(&meter);
    return tail;
}

// The least value that at least this share of the sorted values does not exceed.
static double sorted_percentile(const float *sorted, int count, double share) {
    const int index = (int)ceil(share * count) - 1;
    return sorted[index < 0 ? 0 : index];
}

static void percentiles_are_those_of_sorted_values(void **state) {
    (void)state;
    static float sorted[FRAMES * MAX_SIDE * MAX_SIDE];
    static const int sizes[][2] = {{150, 150}, {7, 3}, {1, 1}, {100, 41}};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        const int width = sizes[s][0], height = sizes[s][1];
        const int count = FRAMES * width * height;
        fill_random(width, height);
        for (int i = 0; i < count; i++) {
            sorted[i] = maps[i / (width * height)][i % (width * height)];
        }
        qsort(sorted, (size_t)count, sizeof *sorted, compare_floats);
        const DipFlipTail tail = measure(width, height);
        expect_near(tail.p50, sorted_percentile(sorted, count, 0.50), 0x1p-16);
        expect_near(tail.p95, sorted_percentile(sorted, count, 0.95), 0x1p-16);
        expect_near(tail.p99, sorted_percentile(sorted, count, 0.99), 0x1p-16);
    }
}

// Mean of a block, summed column by column.
static double mean_of(const float *map, int stride, int x, int y, int width, int height) {
    double sum = 0.0;
    for (int i = x; i < x + width; i++) {
        for (int j = y; j < y + height; j++) {
            sum += map[j * stride + i];
        }
    }
    return sum / (width * height);
}

// Tries every position; allowed are multiples of 32 and the last position along each axis.
static double try_all(int width, int height) {
    const int w = width < 32 ? width : 32, h = height < 32 ? height : 32;
    double most = -1.0;
    for (int f = 0; f < FRAMES; f++) {
        for (int y = 0; y + h <= height; y++) {
            for (int x = 0; x + w <= width; x++) {
                const bool allowed =
                    (x % w == 0 || x + w == width) && (y % h == 0 || y + h == height);
                most = allowed ? fmax(most, mean_of(maps[f], width, x, y, w, h)) : most;
            }
        }
    }
    return most;
}

static void the_worst_block_is_that_of_trying_all(void **state) {
    (void)state;
    static const int sizes[][2] = {{150, 150}, {64, 32}, {31, 100}, {33, 7}, {1, 1}};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        const int width = sizes[s][0], height = sizes[s][1];
        fill_random(width, height);
        const DipFlipTail tail = measure(width, height);
        const double most = try_all(width, height);
        expect_near(tail.worst, most, 1e-12);
        const int frame = (int)tail.worst_frame;
        expect_near(mean_of(maps[frame], width, (int)tail.worst_x, (int)tail.worst_y,
                            (int)tail.worst_width, (int)tail.worst_height),
                    most, 1e-12);
    }
}

// One bright patch in an otherwise perfect second frame.
static void a_small_patch_is_found(void **state) {
    (void)state;
    for (int f = 0; f < FRAMES; f++) {
        for (int i = 0; i < 100 * 100; i++) {
            const int x = i % 100, y = i / 100;
            maps[f][i] = f == 1 && x >= 70 && x < 80 && y >= 40 && y < 50 ? 0.5f : 0.0f;
        }
    }
    const DipFlipTail tail = measure(100, 100);
    assert_true(tail.p50 == 0.0 && tail.p95 == 0.0 && tail.p99 == 0.0); // 0.5 % of the pixels.
    expect_near(tail.worst, 0.5 * 100.0 / 1024.0, 1e-12);
    assert_true(tail.worst_frame == 1.0 && tail.worst_x == 64.0 && tail.worst_y == 32.0);
    assert_true(tail.worst_width == 32.0 && tail.worst_height == 32.0);
}

// The greatest FLIP that there is counts like any other.
static void pixels_without_any_likeness_count(void **state) {
    (void)state;
    for (int f = 0; f < FRAMES; f++) {
        for (int i = 0; i < 40 * 40; i++) {
            maps[f][i] = 1.0f;
        }
    }
    const DipFlipTail tail = measure(40, 40);
    expect_near(tail.p50, 1.0, 0x1p-16);
    expect_near(tail.p99, 1.0, 0x1p-16);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(percentiles_are_those_of_sorted_values),
        cmocka_unit_test(the_worst_block_is_that_of_trying_all),
        cmocka_unit_test(a_small_patch_is_found),
        cmocka_unit_test(pixels_without_any_likeness_count),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
