// Tests of RMSE, PSNR and SSIM against closed forms, and of the equation rms^2 = static^2 +
// flicker^2.
#include "app/measure/metrics/difference.h"
#include "app/measure/metrics/flicker.h"
#include "app/measure/metrics/ssim.h"
#include "renderer/base/srgb.h"
#include "tests/app/measure/map_sum.h"
#include "tests/app/measure/patterns.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>

enum { PIXELS = DIP_PATTERN_SIZE * DIP_PATTERN_SIZE };

static DipPattern test;
static DipPattern truth;
static float map[PIXELS];
static float error_lin[3 * PIXELS];
static float truth_lin[3 * PIXELS];

static void expect_near(const char *what, double found, double expected, double tolerance) {
    if (!(fabs(found - expected) <= tolerance)) {
        fail_msg("%s is %.9g, expected %.9g", what, found, expected);
    }
}

static double mean(int pixel_count) {
    return dip_map_mean(dip_map_sum(map, (size_t)pixel_count, (DipPixelMask){0}));
}

static int base;
static int fifty(int x, int y, int c) {
    (void)x;
    (void)y;
    (void)c;
    return base;
}

static int hundred(int x, int y, int c) {
    (void)x;
    (void)y;
    (void)c;
    return 100;
}

static int one_channel_more(int x, int y, int c) {
    return fifty(x, y, c) + (c == 1 ? 3 : 0);
}

// --- root mean square, signal to noise ---------------------------------------------------------

static double psnr(DipPatternCode *a, DipPatternCode *b) {
    dip_pattern_fill(&truth, 64, 48, a);
    dip_pattern_fill(&test, 64, 48, b);
    dip_difference_codes_map(&test.picture, &truth.picture, map);
    return dip_psnr_db(mean(64 * 48));
}

static void psnr_of_known_errors(void **state) {
    (void)state;
    base = 50;
    // The pictures differ by 50 codes in every channel, then by 3 codes in one of three channels.
    expect_near("psnr", psnr(fifty, hundred), 20.0 * log10(255.0 / 50.0), 1e-6);
    expect_near("psnr", psnr(fifty, one_channel_more), 10.0 * log10(255.0 * 255.0 / 3.0), 1e-6);
    // The expected values come from another program.
    expect_near("psnr", psnr(dip_pattern_gradient, dip_pattern_coarse_gradient), 38.1308036, 1e-4);
    expect_near("psnr", psnr(dip_pattern_hash, dip_pattern_other_hash), 7.6738610, 1e-4);
    assert_true(isinf(psnr(dip_pattern_hash, dip_pattern_hash)));
    assert_true(isnan(dip_psnr_db(NAN)));
    assert_true(isnan(dip_psnr_db(-1.0)));
}

static void fill_truth_lin(double value) {
    for (int i = 0; i < 3 * PIXELS; i++) {
        truth_lin[i] = (float)value;
    }
}

static void rms_in_linear_light(void **state) {
    (void)state;
    base = 188; // 0.50289 in linear light
    dip_pattern_fill(&test, 20, 10, fifty);
    fill_truth_lin(0.25);
    dip_difference_lin(&test.picture, truth_lin, error_lin);
    dip_difference_squared_map(error_lin, 200, map);
    expect_near("rms", sqrt(mean(200)), dip_srgb_decode(188 / 255.0) - 0.25, 1e-6);
    fill_truth_lin((double)(float)dip_srgb_decode(188 / 255.0));
    dip_difference_lin(&test.picture, truth_lin, error_lin);
    dip_difference_squared_map(error_lin, 200, map);
    expect_near("rms of the same", sqrt(mean(200)), 0.0, 1e-7);
}

// The sums over the regions add up to the sum over the whole picture.
static void region_sums_add_up_to_the_whole_picture(void **state) {
    (void)state;
    static uint8_t classes[64 * 48];
    DipMapSum parts = {0};
    psnr(dip_pattern_hash, dip_pattern_other_hash);
    for (int i = 0; i < 64 * 48; i++) {
        classes[i] = (uint8_t)(i % 7 % 3);
    }
    for (uint8_t c = 0; c < 3; c++) {
        const DipMapSum part = dip_map_sum(map, 64 * 48, (DipPixelMask){classes, c});
        parts.sum += part.sum;
        parts.pixel_count += part.pixel_count;
        double expected = 0.0;
        for (int i = 0; i < 64 * 48; i++) {
            expected += classes[i] == c ? (double)map[i] : 0.0;
        }
        expect_near("part", part.sum, expected, 1e-6);
    }
    const DipMapSum all = dip_map_sum(map, 64 * 48, (DipPixelMask){0});
    expect_near("sum", parts.sum, all.sum, 1e-3);
    assert_true(parts.pixel_count == 64 * 48);
    assert_true(dip_map_mean((DipMapSum){0.0, 0.0}) == 0.0);
}

// --- structural similarity ---------------------------------------------------------------------

static double ssim(DipPatternCode *a, DipPatternCode *b) {
    dip_pattern_fill(&truth, 64, 48, a);
    dip_pattern_fill(&test, 64, 48, b);
    assert_true(dip_ssim_map(&test.picture, &truth.picture, map));
    return mean(64 * 48);
}

static int inverse_hash(int x, int y, int c) {
    return 255 - dip_pattern_hash(x, y, c);
}

static void ssim_of_flat_pictures_follows_from_their_means(void **state) {
    (void)state;
    const double c1 = (0.01 * 255.0) * (0.01 * 255.0);
    for (base = 0; base < 256; base += 85) {
        expect_near("ssim", ssim(fifty, hundred),
                    (2.0 * base * 100.0 + c1) / (base * base + 100.0 * 100.0 + c1), 1e-5);
    }
}

// Columns alternate between 90 and 110; the other picture is flat 100. The covariance with a flat
// picture is 0. So SSIM is (2 m 100 + C1) / (m^2 + 100^2 + C1) times C2 / (variance + C2), where m
// and variance are those of the window.
static int stripes(int x, int y, int c) {
    (void)y;
    (void)c;
    return x & 1 ? 110 : 90;
}

static void ssim_of_stripes_and_their_mean(void **state) {
    (void)state;
    double odd = 0.0, all = 0.0;
    for (int i = -5; i <= 5; i++) {
        const double weight = exp(-i * i / 4.5);
        all += weight;
        odd += i & 1 ? weight : 0.0;
    }
    // If a share s of the window's weight is 110 and the rest 90, its mean is 90 + 20 s and its
    // variance 400 s (1 - s).
    const double c1 = 2.55 * 2.55, c2 = 7.65 * 7.65;
    const double s = odd / all;
    const double variance = 400.0 * s * (1.0 - s);
    double expected = 0.0;
    for (int side = 0; side < 2; side++) {
        const double m = 90.0 + 20.0 * (side ? s : 1.0 - s);
        expected += 0.5 * (2.0 * m * 100.0 + c1) / (m * m + 1e4 + c1) * c2 / (variance + c2);
    }
    expect_near("ssim", ssim(stripes, hundred), expected, 1e-5);
}

static void ssim_agrees_with_another_program(void **state) {
    (void)state;
    expect_near("ssim", ssim(dip_pattern_hash, dip_pattern_other_hash), 0.0076587, 1e-5);
    expect_near("ssim", ssim(dip_pattern_gradient, dip_pattern_coarse_gradient), 0.9814971, 1e-5);
    assert_true(ssim(dip_pattern_hash, inverse_hash) < -0.5);
}

static void identical_pictures_have_an_ssim_of_1(void **state) {
    (void)state;
    assert_true(ssim(dip_pattern_hash, dip_pattern_hash) == 1.0);
    base = 255;
    assert_true(ssim(fifty, fifty) == 1.0);
    int counted = 0;
    for (int i = 0; i < 64 * 48; i++) {
        counted += !isnan(map[i]);
    }
    assert_int_equal(counted, (64 - 10) * (48 - 10));
}

// --- flicker -----------------------------------------------------------------------------------

enum { VALUES = 60, FRAMES = 8 };

static float errors[FRAMES][VALUES];

static DipFlickerResult flicker_of(int frames) {
    DipFlicker flicker;
    assert_true(dip_flicker_init(&flicker, VALUES));
    dip_flicker_add(&flicker, errors[3], VALUES);
    dip_flicker_restart(&flicker);
    for (int t = 0; t < frames; t++) {
        dip_flicker_add(&flicker, errors[t], VALUES / 3); // A frame may come in parts.
        dip_flicker_add(&flicker, errors[t] + VALUES / 3, VALUES - VALUES / 3);
    }
    const DipFlickerResult result = dip_flicker_result(&flicker);
    dip_flicker_free(&flicker);
    return result;
}

static void static_error_and_flicker_add_up(void **state) {
    (void)state;
    for (int t = 0; t < FRAMES; t++) {
        for (int i = 0; i < VALUES; i++) {
            errors[t][i] = (float)dip_pattern_hash(i, t, 0) / 255.0f - 0.3f;
        }
    }
    double squares = 0.0;
    for (int frames = 1; frames <= FRAMES; frames++) {
        const DipFlickerResult result = flicker_of(frames);
        for (int i = 0; i < VALUES; i++) {
            squares += (double)errors[frames - 1][i] * (double)errors[frames - 1][i];
        }
        expect_near("the identity", result.squared_static + result.squared_flicker,
                    squares / (VALUES * frames), 1e-12);
    }
}

// Errors alternate between m + d and m - d. So the static error is m, the flicker is d, each step
// is 2d, and the mean of two frames is m.
static void static_error_and_flicker_of_alternating_errors(void **state) {
    (void)state;
    const double m = 0.25, d = 0.125;
    for (int t = 0; t < FRAMES; t++) {
        for (int i = 0; i < VALUES; i++) {
            errors[t][i] = (float)(t & 1 ? m - d : m + d);
        }
    }
    const DipFlickerResult result = flicker_of(FRAMES);
    expect_near("static", result.squared_static, m * m, 1e-12);
    expect_near("flicker", result.squared_flicker, d * d, 1e-12);
    expect_near("step", result.squared_step, 4.0 * d * d, 1e-12);
    expect_near("two frames", result.squared_two_mean, m * m, 1e-12);
    const DipFlickerResult single = flicker_of(1);
    assert_true(single.squared_flicker == 0.0 && single.squared_step == 0.0);
    const DipFlickerResult none = flicker_of(0);
    assert_true(none.squared_static == 0.0 && none.squared_flicker == 0.0);
    assert_true(none.squared_step == 0.0 && none.squared_two_mean == 0.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(psnr_of_known_errors),
        cmocka_unit_test(rms_in_linear_light),
        cmocka_unit_test(region_sums_add_up_to_the_whole_picture),
        cmocka_unit_test(ssim_of_flat_pictures_follows_from_their_means),
        cmocka_unit_test(ssim_of_stripes_and_their_mean),
        cmocka_unit_test(ssim_agrees_with_another_program),
        cmocka_unit_test(identical_pictures_have_an_ssim_of_1),
        cmocka_unit_test(static_error_and_flicker_add_up),
        cmocka_unit_test(static_error_and_flicker_of_alternating_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
