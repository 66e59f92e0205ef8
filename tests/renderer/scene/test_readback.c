// Tests that a renderer gives back the samples of its frame: their mean is the frame's pixel to the
// bit, their depths lie at the positions of the published sample patterns, and reading them changes
// no pixel of the frame.
#include "renderer/pipeline/pattern.h"
#include "tests/renderer/scene/stage.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 100, HEIGHT = 70, FRAME_BYTES = 4 * WIDTH * HEIGHT };

static Stage stage;

static void open_scene(DipTestSceneKind kind) {
    stage = stage_open_kind(kind, stage_def(WIDTH, HEIGHT, ""), 2);
}

static void set_quality(const char *text) {
    DipQuality quality;
    assert_true(dip_quality_parse(text, &quality, NULL));
    assert_true(dip_renderer_set_quality(stage.renderer, &quality, NULL));
}

static DipFrame draw(void) {
    return stage_draw(&stage, &stage.made->pose, 0);
}

// The caller frees the samples.
static DipSampleReadback read_region(DipTargetRegion region) {
    const DipSampleReadback readback = {region,
                                        calloc(dip_sample_room(&region), sizeof(DipSampleValue))};
    assert_non_null(readback.samples);
    assert_true(dip_renderer_read_samples(stage.renderer, stage.scene, &stage.made->pose, 0,
                                          &readback, NULL));
    return readback;
}

// The sRGB code of a mean of samples, from the formulas of IEC 61966-2-1.
static int code_of(long double linear) {
    const long double encoded =
        linear <= 0.0031308L ? 12.92L * linear : 1.055L * powl(linear, 1.0L / 2.4L) - 0.055L;
    return (int)floorl(255.0L * encoded + 0.5L);
}

static void assert_mean_is_pixel(const DipSampleValue *samples, int count, const uint8_t *pixel) {
    for (int c = 0; c < 3; c++) {
        int sum = 0;
        for (int s = 0; s < count; s++) {
            sum += samples[s].linear16[c];
        }
        const double mean = floor((double)sum / count + 0.5); // rounded to 16 bits, halves up
        assert_int_equal(code_of((long double)mean / 65535.0L), pixel[c]);
    }
}

// Reads a region, and compares the means of its samples with the frame. Returns the number of
// pixels whose samples differ.
static int check_region(DipTargetRegion region, int count, const uint8_t *before) {
    const DipSampleReadback readback = read_region(region);
    int mixed = 0;
    for (int y = region.y0; y < region.y1; y++) {
        for (int x = region.x0; x < region.x1; x++) {
            const DipSampleValue *samples = readback.samples + dip_sample_index(&region, x, y);
            assert_mean_is_pixel(samples, count, before + 4 * (WIDTH * y + x));
            bool differs = false;
            for (int s = 1; s < count; s++) {
                differs = differs || memcmp(samples[s].linear16, samples[0].linear16,
                                            sizeof samples[0].linear16) != 0;
            }
            mixed += differs;
        }
    }
    free(readback.samples);
    return mixed;
}

static void test_mean_of_samples_is_the_pixel(void **state) {
    (void)state;
    static const char *const qualities[] = {
        "aa=none",           "aa=2",        "aa=4,af=4",       "aa=6", "aa=8", "aa=4,taa=on",
        "aa=4,aaa=on,asd=2", "aa=8,aaa=on", "aa=4,mipdebug=on"};
    static const int counts[] = {1, 2, 4, 6, 8, 4, 4, 8, 4};
    static const DipTargetRegion regions[] = {{0, 0, WIDTH, HEIGHT},
                                              {60, 60, 68, 68},
                                              {37, 21, 38, 22},
                                              {0, 0, 1, 1},
                                              {WIDTH - 1, HEIGHT - 1, WIDTH, HEIGHT},
                                              {3, 5, 90, 7}};
    for (int kind = 0; kind < DIP_TEST_SCENE_COUNT; kind++) {
        if (kind == DIP_TEST_SCENE_blending || kind == DIP_TEST_SCENE_clear_water) {
            continue; // the samples do not show blended surfaces
        }
        open_scene((DipTestSceneKind)kind);
        for (size_t q = 0; q < sizeof counts / sizeof *counts; q++) {
            set_quality(qualities[q]);
            dip_renderer_set_frame_index(stage.renderer, 7);
            const DipFrame frame = draw();
            uint8_t before[FRAME_BYTES];
            uint8_t after[FRAME_BYTES];
            dip_image_copy(&frame, before);
            for (size_t r = 0; r < sizeof regions / sizeof *regions; r++) {
                const int mixed = check_region(regions[r], counts[q], before);
                if (counts[q] == 1) {
                    assert_int_equal(mixed, 0);
                }
                dip_image_copy(&frame, after);
                assert_memory_equal(before, after, sizeof before);
            }
        }
        stage_close(&stage);
    }
}

static void test_edges_have_samples_that_differ(void **state) {
    (void)state;
    open_scene(DIP_TEST_SCENE_fence);
    set_quality("aa=4,aaa=on");
    const DipFrame frame = draw();
    uint8_t before[FRAME_BYTES];
    dip_image_copy(&frame, before);
    assert_true(check_region((DipTargetRegion){0, 0, WIDTH, HEIGHT}, 4, before) > WIDTH);
    stage_close(&stage);
}

// --- positions -----------------------------------------------------------------------------------

// The standard sample patterns of Direct3D 11 (D3D11_STANDARD_MULTISAMPLE_PATTERN) and Vulkan, in
// 1/16 pixel from the pixel's centre.
typedef struct Published {
    const char *quality;
    int count;
    int offsets[8][2];
} Published;

static const Published published[] = {
    {"aa=none", 1, {{0, 0}}},
    {"aa=2", 2, {{4, 4}, {-4, -4}}},
    {"aa=4", 4, {{-2, -6}, {6, -2}, {-6, 2}, {2, 6}}},
    {"aa=8", 8, {{1, -3}, {-1, 3}, {5, 1}, {-3, -5}, {-5, 5}, {-7, -1}, {3, 7}, {7, -7}}},
};

// A screen-space plane of depth, z / w = at + dx * x + dy * y.
typedef struct DepthPlane {
    double at, dx, dy;
} DepthPlane;

// The plane through the depths of three distant pixels' centres.
static DepthPlane depth_plane(void) {
    set_quality("aa=none");
    const int y0 = HEIGHT - 20;
    const DipTargetRegion region = {0, 0, WIDTH, HEIGHT};
    const DipSampleReadback readback = read_region(region);
    const double a = (double)readback.samples[dip_sample_index(&region, 40, y0)].depth;
    const double b = (double)readback.samples[dip_sample_index(&region, 60, y0)].depth;
    const double c = (double)readback.samples[dip_sample_index(&region, 40, y0 + 16)].depth;
    free(readback.samples);
    DepthPlane plane = {.dx = (b - a) / 20.0, .dy = (c - a) / 16.0};
    plane.at = a - plane.dx * 40.5 - plane.dy * (y0 + 0.5);
    return plane;
}

// The scene is one plane that fills the lower part of the picture, so that depth grows evenly on
// the screen and tells where a sample lies.
static void test_samples_lie_at_published_positions(void **state) {
    (void)state;
    open_scene(DIP_TEST_SCENE_grazing_noise); // rolled, so that depth depends on x and y
    draw();
    const DepthPlane plane = depth_plane();
    assert_true(fabs(plane.dx) > 1e-5 && fabs(plane.dy) > 1e-5);
    for (size_t p = 0; p < sizeof published / sizeof *published; p++) {
        set_quality(published[p].quality);
        const DipTargetRegion region = {47, HEIGHT - 12, 52, HEIGHT - 8};
        const DipSampleReadback readback = read_region(region);
        for (int s = 0; s < published[p].count; s++) {
            const DipSampleValue *sample =
                readback.samples + dip_sample_index(&region, 50, HEIGHT - 10) + s;
            const double x = 50.5 + published[p].offsets[s][0] / 16.0;
            const double y = HEIGHT - 9.5 + published[p].offsets[s][1] / 16.0;
            const double expected = plane.at + plane.dx * x + plane.dy * y;
            const double step = (fabs(plane.dx) + fabs(plane.dy)) / 16.0;
            assert_true(fabs((double)sample->depth - expected) < 0.2 * step);
            assert_int_not_equal(sample->patch, 0);
        }
        free(readback.samples);
    }
    stage_close(&stage);
}

static void test_empty_samples_read_as_background(void **state) {
    (void)state;
    open_scene(DIP_TEST_SCENE_vertex_colours);
    set_quality("aa=4");
    draw();
    const DipTargetRegion whole = {0, 0, WIDTH, HEIGHT};
    const DipSampleReadback readback = read_region(whole);
    int background = 0;
    for (size_t i = 0; i < dip_sample_room(&whole); i += DIP_READBACK_STRIDE) {
        for (int s = 0; s < 4; s++) {
            const DipSampleValue *sample = &readback.samples[i + (size_t)s];
            assert_true((sample->patch == 0) == (sample->depth <= 0.0f));
            for (int c = 0; c < 3 && sample->patch == 0; c++) {
                const float light = stage.made->def.background_lin[c];
                assert_int_equal(sample->linear16[c], (int)(light * 65535.0f + 0.5f));
            }
            background += sample->patch == 0;
        }
    }
    assert_true(background > 0);
    free(readback.samples);
    stage_close(&stage);
}

static void test_bad_regions_are_refused(void **state) {
    (void)state;
    static const DipTargetRegion bad[] = {
        {0, 0, 0, 0}, {5, 5, 5, 6}, {-1, 0, 4, 4}, {0, 0, WIDTH + 1, 1}, {0, HEIGHT, 1, HEIGHT + 1},
        {9, 0, 8, 4}};
    open_scene(DIP_TEST_SCENE_cube_on_plane);
    draw();
    DipSampleValue room[8];
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        const DipSampleReadback readback = {bad[i], room};
        DipError err = {0};
        assert_false(dip_renderer_read_samples(stage.renderer, stage.scene, &stage.made->pose, 0,
                                               &readback, &err));
        assert_int_equal(err.code, DIP_ERROR_RANGE);
        assert_string_equal(err.key, "readback.region");
    }
    stage_close(&stage);
}

// Rows of the region follow each other without gaps, and each pixel has 8 entries.
static void the_index_counts_from_the_corner_of_the_region(void **state) {
    (void)state;
    const DipTargetRegion region = {3, 20, 8, 24};
    size_t expected = 0;
    for (int y = 20; y < 24; y++) {
        for (int x = 3; x < 8; x++, expected += 8) {
            assert_int_equal(dip_sample_index(&region, x, y), expected);
        }
    }
    assert_int_equal(dip_sample_room(&region), expected);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_index_counts_from_the_corner_of_the_region),
        cmocka_unit_test(test_mean_of_samples_is_the_pixel),
        cmocka_unit_test(test_edges_have_samples_that_differ),
        cmocka_unit_test(test_samples_lie_at_published_positions),
        cmocka_unit_test(test_empty_samples_read_as_background),
        cmocka_unit_test(test_bad_regions_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
