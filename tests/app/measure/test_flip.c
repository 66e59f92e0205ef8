// Tests FLIP against the values that its authors' implementation gives for the same pictures.
#include "app/measure/metrics/difference.h"
#include "app/measure/metrics/flip.h"
#include "app/measure/metrics/internal/filters.h"
#include "tests/app/measure/map_sum.h"
#include "tests/app/measure/patterns.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>

static DipPattern test;
static DipPattern truth;
static float map[DIP_PATTERN_SIZE * DIP_PATTERN_SIZE];

static void expect(const char *what, double found, double expected) {
    if (!(fabs(found - expected) <= 1e-4)) {
        fail_msg("%s is %.6f, expected %.6f", what, found, expected);
    }
}

// Compares two patterns with FLIP, fills `map` and returns its mean.
static double compare(int width, int height, double pixels_per_degree, DipPatternCode *a,
                      DipPatternCode *b) {
    DipFlip flip;
    DipFlipAnalysis analysis;
    dip_pattern_fill(&truth, width, height, a);
    dip_pattern_fill(&test, width, height, b);
    assert_true(dip_flip_init(&flip, width, height, pixels_per_degree));
    assert_true(dip_flip_analysis_init(&flip, &analysis));
    dip_flip_analyse(&flip, &truth.picture, &analysis);
    dip_flip_compare(&flip, &test.picture, &analysis, map);
    dip_flip_analysis_free(&analysis);
    dip_flip_free(&flip);
    return dip_map_mean(dip_map_sum(map, (size_t)(width * height), (DipPixelMask){0}));
}

static float least(int count) {
    float value = map[0];
    for (int i = 1; i < count; i++) {
        value = fminf(value, map[i]);
    }
    return value;
}

static float most(int count) {
    float value = map[0];
    for (int i = 1; i < count; i++) {
        value = fmaxf(value, map[i]);
    }
    return value;
}

// --- pictures ----------------------------------------------------------------------------------

static int constant;
static int channels; // bits; if bit c is set, channel c has the constant, otherwise 0

static int first_constant;
static int first_channels;

static int flat(int x, int y, int c) {
    (void)x;
    (void)y;
    return channels >> c & 1 ? constant : 0;
}

static int first_flat(int x, int y, int c) {
    (void)x;
    (void)y;
    return first_channels >> c & 1 ? first_constant : 0;
}

static double compare_flat(int a, int a_channels, int b, int b_channels) {
    first_constant = a;
    first_channels = a_channels;
    constant = b;
    channels = b_channels;
    return compare(32, 32, DIP_FLIP_PIXELS_PER_DEGREE, first_flat, flat);
}

static int checker(int x, int y, int c) {
    (void)c;
    return ((x >> 3) ^ (y >> 3)) & 1 ? 255 : 0;
}

static int shifted_checker(int x, int y, int c) {
    return checker(x + 1, y, c);
}

static int grey(int x, int y, int c) {
    (void)x;
    (void)y;
    (void)c;
    return 64;
}

static int dot(int x, int y, int c) {
    return x == 32 && y == 32 ? 255 : grey(x, y, c);
}

// --- tests -------------------------------------------------------------------------------------

static void flat_pictures(void **state) {
    (void)state;
    enum { RED = 1, GREEN = 2, BLUE = 4, ALL = 7 };
    expect("black and white", compare_flat(0, ALL, 255, ALL), 0.967388);
    expect("green and blue", compare_flat(255, GREEN, 255, BLUE), 1.0);
    expect("grey 128 and 129", compare_flat(128, ALL, 129, ALL), 0.029863);
    expect("grey 128 and 136", compare_flat(128, ALL, 136, ALL), 0.127591);
    expect("red 255 and 254", compare_flat(255, RED, 254, RED), 0.039603);
}

static void filter_weights(void **state) {
    (void)state;
    const DipFlipKernels k = dip_flip_kernels(DIP_FLIP_PIXELS_PER_DEGREE);
    assert_int_equal(k.luma.radius, 10);
    assert_int_equal(k.edge.radius, 9);
    expect("Y[0]", (double)k.luma.weights[10], 0.3857602);
    expect("Y[1]", (double)k.luma.weights[11], 0.2417037);
    expect("Cx[0]", (double)k.red_green.weights[10], 0.3632691);
    expect("Cx[1]", (double)k.red_green.weights[9], 0.2399823);
    expect("Cz1[0]", (double)k.blue[0].weights[10], 0.1154421);
    expect("Cz1[1]", (double)k.blue[0].weights[11], 0.1092716);
    expect("Cz2[0]", (double)k.blue[1].weights[10], 0.0816928);
    expect("Cz2[1]", (double)k.blue[1].weights[11], 0.0748193);
    expect("g[0]", (double)k.gauss.weights[9], 0.1452575);
    expect("edge[1]", (double)k.edge.weights[10], -0.1256490);
    expect("point[0]", (double)k.point.weights[9], -0.2989015);
    expect("point[r]", (double)k.point.weights[18], 0.0138062);
}

static void gradient(void **state) {
    (void)state;
    const double mean = compare(64, 64, DIP_FLIP_PIXELS_PER_DEGREE, dip_pattern_gradient,
                                dip_pattern_coarse_gradient);
    expect("mean", mean, 0.071117);
    expect("least", (double)least(64 * 64), 0.024640);
    expect("most", (double)most(64 * 64), 0.121008);
    expect("(31, 17)", (double)map[17 * 64 + 31], 0.071158);
    expect("(63, 63)", (double)map[63 * 64 + 63], 0.081008);
}

static void checkers(void **state) {
    (void)state;
    const double mean = compare(64, 64, DIP_FLIP_PIXELS_PER_DEGREE, checker, shifted_checker);
    expect("mean", mean, 0.325765);
    expect("most", (double)most(64 * 64), 0.993284);
    expect("(7, 7)", (double)map[7 * 64 + 7], 0.296420);
    expect("(32, 32)", (double)map[32 * 64 + 32], 0.398173);
    expect("mean at 20", compare(64, 64, 20.0, checker, shifted_checker), 0.226071);
    expect("(7, 7) at 20", (double)map[7 * 64 + 7], 0.963906);
    expect("(32, 32) at 20", (double)map[32 * 64 + 32], 0.362269);
}

static void a_dot(void **state) {
    (void)state;
    expect("mean", compare(65, 65, DIP_FLIP_PIXELS_PER_DEGREE, grey, dot), 0.001869);
    expect("(32, 32)", (double)map[32 * 65 + 32], 0.603224);
    expect("(33, 32)", (double)map[32 * 65 + 33], 0.495084);
    expect("(36, 32)", (double)map[32 * 65 + 36], 0.008445);
    assert_true(map[0] == 0.0f);
}

static void noise(void **state) {
    (void)state;
    const double mean =
        compare(64, 48, DIP_FLIP_PIXELS_PER_DEGREE, dip_pattern_hash, dip_pattern_other_hash);
    expect("mean", mean, 0.441497);
    expect("least", (double)least(64 * 48), 0.085943);
    expect("most", (double)most(64 * 48), 0.959696);
    expect("(0, 0)", (double)map[0], 0.701127);
    expect("(10, 20)", (double)map[20 * 64 + 10], 0.582126);
    expect("(63, 47)", (double)map[47 * 64 + 63], 0.644188);
}

static void identical_pictures_are_0(void **state) {
    (void)state;
    assert_true(compare(64, 48, DIP_FLIP_PIXELS_PER_DEGREE, dip_pattern_hash, dip_pattern_hash) ==
                0.0);
    assert_true(most(64 * 48) == 0.0f);
}

// Tests the lowest and the highest number of pixels per degree, on a picture smaller than the
// filters.
static void extreme_resolutions(void **state) {
    (void)state;
    const double limits[] = {DIP_FLIP_MIN_PIXELS_PER_DEGREE, DIP_FLIP_MAX_PIXELS_PER_DEGREE};
    for (int i = 0; i < 2; i++) {
        const double mean = compare(3, 2, limits[i], dip_pattern_hash, dip_pattern_other_hash);
        assert_true(mean > 0.0 && mean <= 1.0);
    }
}

// At other resolutions, the filters would be longer than there is room for, or have no width.
static void resolutions_out_of_range_are_refused(void **state) {
    (void)state;
    const double resolutions[] = {NAN,
                                  -67.0,
                                  0.0,
                                  nextafter(DIP_FLIP_MIN_PIXELS_PER_DEGREE, 0.0),
                                  nextafter(DIP_FLIP_MAX_PIXELS_PER_DEGREE, 1e9),
                                  1e9};
    for (size_t i = 0; i < sizeof resolutions / sizeof *resolutions; i++) {
        DipFlip flip;
        assert_false(dip_flip_init(&flip, 8, 8, resolutions[i]));
        dip_flip_free(&flip);
    }
    for (int i = 0; i < 2; i++) {
        DipFlip flip;
        assert_false(dip_flip_init(&flip, i, 1 - i, DIP_FLIP_PIXELS_PER_DEGREE));
        dip_flip_free(&flip);
    }
}

static void values_outside_the_palette_are_clamped(void **state) {
    (void)state;
    const float values[] = {-1.0f, -INFINITY, NAN, 2.0f, INFINITY};
    for (int i = 0; i < 5; i++) {
        uint8_t found[3], expected[3];
        dip_magma(values[i], found);
        dip_magma(i < 3 ? 0.0f : 1.0f, expected);
        assert_memory_equal(found, expected, 3);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(filter_weights),
        cmocka_unit_test(flat_pictures),
        cmocka_unit_test(gradient),
        cmocka_unit_test(checkers),
        cmocka_unit_test(a_dot),
        cmocka_unit_test(noise),
        cmocka_unit_test(identical_pictures_are_0),
        cmocka_unit_test(extreme_resolutions),
        cmocka_unit_test(resolutions_out_of_range_are_refused),
        cmocka_unit_test(values_outside_the_palette_are_clamped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
