// Scales below 1: a frame is the smaller picture, enlarged. The filters are compared with models in
// double precision, and the smaller picture with a frame of its size.
#include "renderer/post/post.h"
#include "tests/renderer/post/post_model.h"
#include "tests/renderer/scene/stage.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static Stage open_stage(DipTestSceneKind kind, int width, int height, int threads, DipIsa isa,
                        bool forced) {
    DipRendererDef def = stage_def(width, height, "");
    def.isa = isa;
    def.force_all_effects = forced;
    return stage_open_kind(kind, def, threads);
}

// Returns a copy of a frame's pixels, without padding.
static uint8_t *pixels_of(const DipFrame *frame) {
    uint8_t *pixels = malloc((size_t)frame->width * (size_t)frame->height * 4);
    assert_non_null(pixels);
    dip_image_copy(frame, pixels);
    return pixels;
}

static ModelColour model_of(int upscale, const ModelPicture *picture, int width, int height, int x,
                            int y) {
    switch (upscale) {
    case DIP_UPSCALE_BILINEAR:
        return model_bilinear(picture, width, height, x, y);
    case DIP_UPSCALE_BICUBIC:
        return model_bicubic(picture, width, height, x, y);
    default:
        return model_easu(picture, width, height, x, y);
    }
}

// Sizes for which the smaller picture has exactly the frame's ratio of width and height, so that a
// renderer of its size draws it as well.
static const struct {
    const char *step;
    int width, height, drawn_width, drawn_height;
} sizes[] = {{"1/2", 90, 68, 45, 34},
             {"1/1.7", 85, 68, 50, 40},
             {"1/1.5", 96, 66, 64, 44},
             {"1/1.3", 91, 65, 70, 50}};
enum { SIZES = sizeof sizes / sizeof *sizes };
static const char *const filters[] = {"bilinear", "bicubic", "easu"};

// Counts the pixels of an enlarged picture that are not those of the model. A code may differ from
// the model's colour by its rounding.
static int count_other_pixels(const uint8_t *small, const uint8_t *enlarged, int size,
                              int upscale) {
    const ModelPicture picture = {small, sizes[size].drawn_width, sizes[size].drawn_height};
    int others = 0;
    for (int i = 0; i < sizes[size].width * sizes[size].height; i++) {
        const ModelColour wanted =
            model_of(upscale, &picture, sizes[size].width, sizes[size].height,
                     i % sizes[size].width, i / sizes[size].width);
        bool differs = enlarged[4 * i + 3] != 255;
        for (int c = 0; c < 3; c++) {
            differs = differs || fabs(enlarged[4 * i + c] - wanted.rgb[c]) > 0.53;
        }
        others += differs;
    }
    return others;
}

static void frames_are_the_models_of_the_smaller_picture(void **state) {
    (void)state;
    for (int i = 0; i < SIZES; i++) {
        Stage whole = open_stage(DIP_TEST_SCENE_lit_sphere, sizes[i].width, sizes[i].height, 1,
                                 dip_isa_best(), false);
        Stage small = open_stage(DIP_TEST_SCENE_lit_sphere, sizes[i].drawn_width,
                                 sizes[i].drawn_height, 1, dip_isa_best(), false);
        const DipFrame drawn = stage_draw_kind(&small, "aa=4");
        uint8_t *drawn_pixels = pixels_of(&drawn);
        for (int upscale = 0; upscale < 3; upscale++) {
            char settings[64];
            snprintf(settings, sizeof settings, "aa=4,scale=%s,upscale=%s", sizes[i].step,
                     filters[upscale]);
            const DipFrame frame = stage_draw_kind(&whole, settings);
            uint8_t *pixels = pixels_of(&frame);
            assert_int_equal(frame.width, sizes[i].width);
            assert_int_equal(frame.height, sizes[i].height);
            const int others = count_other_pixels(drawn_pixels, pixels, i, upscale);
            // The direction of an edge may hang by a rounding error.
            const int most = upscale == DIP_UPSCALE_EASU ? frame.width * frame.height / 1000 : 0;
            if (others > most) {
                fail_msg("%s: %d pixels are not those of the model", settings, others);
            }
            assert_int_equal(frame.counters.pixels_filtered, frame.width * frame.height);
            assert_int_equal(frame.counters.samples_shown, drawn.counters.samples_shown);
            assert_int_equal(frame.counters.fragments_shaded, drawn.counters.fragments_shaded);
            free(pixels);
        }
        free(drawn_pixels);
        stage_close(&small);
        stage_close(&whole);
    }
}

// The smaller picture is smoothed, then enlarged, then sharpened.
static void filters_are_applied_in_order(void **state) {
    (void)state;
    const int i = 2;
    Stage whole = open_stage(DIP_TEST_SCENE_lit_sphere, sizes[i].width, sizes[i].height, 1,
                             dip_isa_best(), false);
    Stage small = open_stage(DIP_TEST_SCENE_lit_sphere, sizes[i].drawn_width, sizes[i].drawn_height,
                             1, dip_isa_best(), false);
    const DipFrame smoothed = stage_draw_kind(&small, "post=smaa");
    const uint64_t edges = smoothed.counters.edges_found;
    const size_t row = (size_t)sizes[i].width * 4, bytes = row * (size_t)sizes[i].height;
    uint8_t *enlarged = malloc(bytes), *sharpened = malloc(bytes);
    DipPostDef def = {.filter = DIP_POST_EASU,
                      .from_width = sizes[i].drawn_width,
                      .from_height = sizes[i].drawn_height,
                      .to_width = sizes[i].width,
                      .to_height = sizes[i].height,
                      .isa = dip_isa_best()};
    DipPost *post = dip_post_create(&def, NULL);
    dip_post_run(post, smoothed.rgba8, smoothed.stride_bytes, enlarged, row);
    dip_post_destroy(&post);
    def = (DipPostDef){.filter = DIP_POST_SHARPEN,
                       .from_width = sizes[i].width,
                       .from_height = sizes[i].height,
                       .to_width = sizes[i].width,
                       .to_height = sizes[i].height,
                       .sharpness = 0.5f,
                       .isa = dip_isa_best()};
    post = dip_post_create(&def, NULL);
    dip_post_run(post, enlarged, row, sharpened, row);
    dip_post_destroy(&post);
    const DipFrame frame =
        stage_draw_kind(&whole, "scale=1/1.5,upscale=easu,post=smaa,sharpen=medium");
    uint8_t *pixels = pixels_of(&frame);
    assert_memory_equal(pixels, sharpened, bytes);
    assert_int_equal(frame.counters.edges_found, edges);
    assert_int_equal(frame.counters.pixels_filtered,
                     sizes[i].drawn_width * sizes[i].drawn_height + 2 * (int)(bytes / 4));
    free(pixels);
    free(enlarged);
    free(sharpened);
    stage_close(&small);
    stage_close(&whole);
}

static void plan_gives_the_reason(void **state) {
    (void)state;
    Stage stage = open_stage(DIP_TEST_SCENE_lit_sphere, 64, 48, 1, dip_isa_best(), false);
    DipFrame frame = stage_draw_kind(&stage, "upscale=easu");
    assert_false(frame.effects.upscale.run);
    assert_string_equal(frame.effects.upscale.why, "scale is not below 1");
    frame = stage_draw_kind(&stage, "scale=2,upscale=easu");
    assert_false(frame.effects.upscale.run);
    frame = stage_draw_kind(&stage, "scale=1/1.3");
    assert_true(frame.effects.upscale.run);
    assert_string_equal(frame.effects.upscale.why, "a smaller picture is drawn and enlarged");
    stage_close(&stage);
}

// The hash of a frame with all effects of the water's scene.
static void hash_of(const char *settings, int threads, DipIsa isa, bool forced, char hash[33]) {
    Stage stage = open_stage(DIP_TEST_SCENE_water_effects, 150, 99, threads, isa, forced);
    const DipFrame frame = stage_draw_kind(&stage, settings);
    dip_frame_hash(&frame, hash);
    stage_close(&stage);
}

static void threads_instruction_sets_and_the_plan_change_no_byte(void **state) {
    (void)state;
    static const char *const rows[] = {
        "scale=1/2,upscale=bilinear,aa=4", "scale=1/1.7,upscale=bicubic,aa=2,aaa=on",
        "scale=1/1.5,upscale=easu,aa=4,aaa=on,af=16,post=smaa",
        "scale=1/1.3,upscale=easu,aa=8,aaa=all,opt=advanced,sharpen=high"};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char expected[33], found[33];
        hash_of(rows[i], 1, DIP_ISA_SCALAR, false, expected);
        hash_of(rows[i], 1, DIP_ISA_SCALAR, true, found);
        assert_string_equal(found, expected);
        for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
            for (int threads = 1; threads <= 3 && dip_isa_available((DipIsa)isa); threads++) {
                hash_of(rows[i], threads, (DipIsa)isa, false, found);
                assert_string_equal(found, expected);
            }
        }
    }
}

// An upscaling filter without a scale below 1 changes nothing, and a scale that is turned off
// leaves nothing.
static void what_is_off_changes_no_byte(void **state) {
    (void)state;
    static const char *const rows[] = {"aa=2", "aa=2,upscale=easu", "aa=2,scale=1/1.5,upscale=easu",
                                       "aa=2,scale=1/1.5,upscale=bicubic", "aa=2,upscale=bicubic"};
    static const bool same[] = {true, true, false, false, true};
    char hashes[5][33];
    Stage stage = open_stage(DIP_TEST_SCENE_water, 160, 120, 1, dip_isa_best(), false);
    assert_true(dip_renderer_record_tiles(stage.renderer, true, NULL));
    for (int i = 0; i < 5; i++) {
        const DipFrame frame = stage_draw_kind(&stage, rows[i]);
        dip_frame_hash(&frame, hashes[i]);
        assert_int_equal(frame.tiles.records != NULL, same[i]);
        assert_int_equal(!strcmp(hashes[i], hashes[0]), same[i]);
    }
    assert_string_not_equal(hashes[2], hashes[3]);
    stage_close(&stage);
}

static void frames_of_a_few_pixels_are_drawn(void **state) {
    (void)state;
    static const int few[][2] = {{1, 1}, {2, 1}, {1, 3}, {3, 2}};
    for (int i = 0; i < 4; i++) {
        Stage stage =
            open_stage(DIP_TEST_SCENE_water, few[i][0], few[i][1], 1, dip_isa_best(), false);
        for (int s = 0; s < SIZES; s++) {
            for (int upscale = 0; upscale < 3; upscale++) {
                char settings[64];
                snprintf(settings, sizeof settings, "scale=%s,upscale=%s,post=fxaa", sizes[s].step,
                         filters[upscale]);
                const DipFrame frame = stage_draw_kind(&stage, settings);
                assert_int_equal(frame.width, few[i][0]);
                assert_int_equal(frame.height, few[i][1]);
                assert_int_equal(frame.rgba8[3], 255);
            }
        }
        stage_close(&stage);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_are_the_models_of_the_smaller_picture),
        cmocka_unit_test(filters_are_applied_in_order),
        cmocka_unit_test(plan_gives_the_reason),
        cmocka_unit_test(threads_instruction_sets_and_the_plan_change_no_byte),
        cmocka_unit_test(what_is_off_changes_no_byte),
        cmocka_unit_test(frames_of_a_few_pixels_are_drawn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
