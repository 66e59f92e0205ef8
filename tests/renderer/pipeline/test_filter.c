// Tests the level of detail that the fast renderer chooses on a plane seen at a grazing angle.
// Compares it with the level that follows from a closed formula for the pixel's footprint (its
// image in the texture). The camera is rolled about its view axis. Tests every step of anisotropic
// filtering (AF), plain and advanced.
//
// The view axis points 6 degrees down at a plane 1 m below the eye. In the middle of the picture,
// the footprint is therefore an ellipse with known axes. Mip colours show which level was read.
#include "renderer/base/srgb.h"
#include "renderer/scene/renderer.h"
#include "renderer/catalogue/scenes.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

enum { WIDTH = 15, HEIGHT = 961, TEXELS = 256 };

static const double pi = 3.14159265358979323846;
static const double tolerance_lin =
    0.012; // per channel; allows for 8-bit pixels, rounded positions and lambda in float

typedef struct Bench {
    DipTestScene scene;
    DipScene *fast;
    DipPool *pool;
    DipRenderer *renderer;
} Bench;

static void open_bench(Bench *bench, double roll_deg) {
    dip_test_scene_make_grazing(&bench->scene, DIP_TEST_CHECKER, TEXELS, roll_deg);
    bench->fast = dip_scene_create(&bench->scene.def, NULL, NULL);
    bench->pool = dip_pool_create(1, NULL);
    DipRendererDef def = dip_renderer_default_def();
    def.pool = bench->pool;
    def.width = WIDTH;
    def.height = HEIGHT;
    bench->renderer = dip_renderer_create(&def, NULL);
    assert_non_null(bench->fast);
    assert_non_null(bench->renderer);
}

static void close_bench(Bench *bench) {
    dip_renderer_destroy(&bench->renderer);
    dip_pool_destroy(&bench->pool);
    dip_scene_destroy(&bench->fast);
    dip_test_scene_free(&bench->scene);
}

// Returns the colour in the middle of the picture, in linear light.
static void middle_colour(Bench *bench, int af_step, bool exact_footprint, double rgb_lin[3]) {
    DipQuality quality = dip_quality_default();
    quality.step[DIP_SETTING_AF] = (uint8_t)af_step;
    quality.step[DIP_SETTING_AAF] = exact_footprint;
    quality.step[DIP_SETTING_MIPDEBUG] = 1;
    DipFrame frame;
    assert_true(dip_renderer_set_quality(bench->renderer, &quality, NULL));
    assert_true(
        dip_renderer_draw(bench->renderer, bench->fast, &bench->scene.pose, 0, &frame, NULL));
    const uint8_t *pixel =
        frame.rgba8 + (size_t)(HEIGHT / 2) * frame.stride_bytes + (size_t)(WIDTH / 2) * 4;
    for (int c = 0; c < 3; c++) {
        rgb_lin[c] = dip_srgb_decode(pixel[c] / 255.0);
    }
}

// Blends the mip colours of docs/picture.md for levels of 256 texels and smaller. The table has
// 8-bit sRGB values.
static void colour_of_level(double lambda, double rgb_lin[3]) {
    static const double codes[][3] = {{255, 0, 0}, {255, 128, 0}, {255, 255, 0},
                                      {0, 255, 0}, {0, 0, 255},   {128, 0, 128}};
    const double last = 5.0;
    const double at = fmin(fmax(lambda, 0.0), last);
    const int level = (int)fmin(floor(at), last - 1.0);
    for (int c = 0; c < 3; c++) {
        const double near = dip_srgb_decode(codes[level][c] / 255.0);
        const double far = dip_srgb_decode(codes[level + 1][c] / 255.0);
        rgb_lin[c] = near + (at - level) * (far - near);
    }
}

// Computes the axes of the footprint in the middle of the picture, in texels.
static void closed_form_axes(double *major, double *minor) {
    const double down = 6.0 * pi / 180.0;
    const double pixel = 2.0 * tan(30.0 * pi / 180.0) / HEIGHT;
    const double distance = 1.0 / sin(down);
    *minor = distance * pixel * TEXELS;
    *major = *minor / sin(down);
}

static double ratio_of(double a, double b, double cap) {
    return fmax(fmin(fmax(a, b) / fmin(a, b), cap), 1.0);
}

// Returns the lambda that docs/picture.md defines for the ellipse if the camera is rolled by
// `roll`.
static double expected_lambda(double roll, int max, bool exact_footprint) {
    double major;
    double minor;
    closed_form_axes(&major, &minor);
    if (exact_footprint && max > 1) {
        return log2(major / fmin(major / minor, max));
    }
    // The lengths of the derivatives dX and dY along the screen's axes and along axes turned by 45
    // degrees.
    const double x = hypot(major * sin(roll), minor * cos(roll));
    const double y = hypot(major * cos(roll), minor * sin(roll));
    if (max == 1) {
        return log2(fmax(x, y));
    }
    const double turned = roll + pi / 4.0;
    const double x45 = hypot(major * sin(turned), minor * cos(turned));
    const double y45 = hypot(major * cos(turned), minor * sin(turned));
    const double screen_ratio = ratio_of(x, y, max);
    const double turned_ratio = ratio_of(x45, y45, fmax(max / 2.0, 1.0));
    return turned_ratio > screen_ratio ? log2(fmax(x45, y45) / turned_ratio)
                                       : log2(fmax(x, y) / screen_ratio);
}

static void levels_follow_the_closed_form(bool exact_footprint) {
    for (int degrees = -90; degrees <= 180; degrees += 15) {
        // Plain AF chooses between the screen's axes and axes turned by 45 degrees. The 2 degrees
        // keep the roll away from the angles at which both choices are equally good, and from 22.5
        // degrees, halfway between the two kinds of axes.
        const double roll_deg = degrees + 2.0;
        Bench bench;
        open_bench(&bench, roll_deg);
        for (int step = 0; step < 5; step++) {
            double found[3];
            double expected[3];
            const double lambda =
                expected_lambda(roll_deg * pi / 180.0, 1 << step, exact_footprint);
            middle_colour(&bench, step, exact_footprint, found);
            colour_of_level(lambda, expected);
            for (int c = 0; c < 3; c++) {
                if (fabs(found[c] - expected[c]) > tolerance_lin) {
                    fail_msg("roll %g, af %d, exact_footprint %d, lambda %.3f: channel %d is %.4f, "
                             "expected %.4f within %g",
                             roll_deg, 1 << step, exact_footprint, lambda, c, found[c], expected[c],
                             tolerance_lin);
                }
            }
        }
        close_bench(&bench);
    }
}

static void plain_af_reads_the_closed_form_level(void **state) {
    (void)state;
    levels_follow_the_closed_form(false);
}

static void advanced_af_reads_the_closed_form_level(void **state) {
    (void)state;
    levels_follow_the_closed_form(true);
}

// Returns the greatest change of the colour when the camera rolls from 0 to 22.5 degrees.
static double change_under_roll(int step, bool exact_footprint) {
    double colours[2][3];
    for (int i = 0; i < 2; i++) {
        Bench bench;
        open_bench(&bench, i * 22.5);
        middle_colour(&bench, step, exact_footprint, colours[i]);
        close_bench(&bench);
    }
    double greatest = 0.0;
    for (int c = 0; c < 3; c++) {
        greatest = fmax(greatest, fabs(colours[0][c] - colours[1][c]));
    }
    return greatest;
}

static void camera_roll_changes_plain_af_but_not_advanced_af(void **state) {
    (void)state;
    for (int step = 2; step < 5; step++) {
        assert_true(change_under_roll(step, true) <= tolerance_lin);
        assert_true(change_under_roll(step, false) >= 10.0 * tolerance_lin);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plain_af_reads_the_closed_form_level),
        cmocka_unit_test(advanced_af_reads_the_closed_form_level),
        cmocka_unit_test(camera_roll_changes_plain_af_but_not_advanced_af),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
