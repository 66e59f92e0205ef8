// Tests what a renderer refuses: poses, sizes, reflections, numbers of frames and regions that are
// out of range. The ends of each range are accepted.
#include "renderer/pipeline/pipeline.h"
#include "tests/renderer/scene/stage.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 24, HEIGHT = 16 };

static Stage stage;

static int set_up(void **state) {
    (void)state;
    stage = stage_open_kind(DIP_TEST_SCENE_vertex_colours, stage_def(WIDTH, HEIGHT, "aa=none"), 1);
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    stage_close(&stage);
    return 0;
}

// Draws from a pose and checks whether this succeeds. message: part of the reason, or NULL if the
// pose is good.
static void check_pose(const DipPose *pose, const char *message) {
    DipFrame frame;
    DipError err = {.line = 7};
    const bool drawn = dip_renderer_draw(stage.renderer, stage.scene, pose, 0, &frame, &err);
    assert_int_equal(drawn, message == NULL);
    if (message) {
        assert_int_equal(err.code, DIP_ERROR_RANGE);
        assert_int_equal(err.line, 0);
        assert_string_equal(err.key, "pose");
        assert_non_null(strstr(err.message, message));
    }
}

static void poses_must_be_finite(void **state) {
    (void)state;
    for (int i = 0; i < 8; i++) {
        for (int kind = 0; kind < 3; kind++) {
            DipPose pose = stage.made->pose;
            double *number = i < 3   ? &pose.position_world[i]
                             : i < 7 ? &pose.orientation[i - 3]
                                     : &pose.fov_y_deg;
            *number = kind == 0 ? (double)NAN : kind == 1 ? (double)INFINITY : (double)-INFINITY;
            check_pose(&pose, "a number is not finite");
        }
    }
}

static void orientations_may_have_any_length_but_0(void **state) {
    (void)state;
    for (int i = 0; i < 5; i++) {
        for (int sign = -1; sign <= 1; sign += 2) {
            DipPose pose = stage.made->pose;
            for (int k = 0; k < 4; k++) {
                pose.orientation[k] = k == i ? sign * 1e-300 : 0.0;
            }
            check_pose(&pose, i < 4 ? NULL : "the orientation is 0");
        }
    }
}

static void fields_of_view_are_1_to_170_degrees(void **state) {
    (void)state;
    static const double good[] = {1.0, 60.0, 170.0};
    const double bad[] = {nextafter(1.0, 0.0), nextafter(170.0, 180.0), 0.0, -60.0};
    DipPose pose = stage.made->pose;
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        pose.fov_y_deg = good[i];
        check_pose(&pose, NULL);
    }
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        pose.fov_y_deg = bad[i];
        check_pose(&pose, "a field of view of");
    }
}

static void one_to_four_frames_are_drawn_at_once(void **state) {
    (void)state;
    enum { ROOM = DIP_MAX_FRAMES_AT_ONCE + 1 };
    DipRenderer *renderers[ROOM];
    DipFrame frames[ROOM], *pointers[ROOM];
    DipRendererDef def = stage.def;
    def.pool = stage.pool;
    for (int i = 0; i < ROOM; i++) {
        renderers[i] = stage_make_renderer(&def);
        pointers[i] = &frames[i];
    }
    for (int count = -1; count <= ROOM; count++) {
        DipError err = {.line = 7};
        const bool drawn = dip_renderer_draw_frames(renderers, count, stage.scene,
                                                    &stage.made->pose, 0, pointers, &err);
        assert_int_equal(drawn, count >= 1 && count <= 4);
        if (!drawn) {
            assert_int_equal(err.code, DIP_ERROR_RANGE);
            assert_int_equal(err.line, 0);
            assert_string_equal(err.key, "count");
            assert_non_null(strstr(err.message, "accepted 1..4"));
        }
    }
    for (int i = 0; i < ROOM; i++) {
        dip_renderer_destroy(&renderers[i]);
    }
}

static void regions_of_samples_lie_within_the_frame(void **state) {
    (void)state;
    static DipSampleValue room[64 * 64 * DIP_READBACK_STRIDE];
    static const int ends[] = {-1, 0, 1, HEIGHT, HEIGHT + 1, WIDTH, WIDTH + 1};
    enum { ENDS = sizeof ends / sizeof *ends };
    stage_draw(&stage, &stage.made->pose, 0);
    for (int i = 0; i < ENDS * ENDS; i++) {
        for (int axis = 0; axis < 2; axis++) {
            const int from = ends[i % ENDS], to = ends[i / ENDS];
            const bool good = from >= 0 && from < to && to <= (axis ? HEIGHT : WIDTH);
            const DipTargetRegion region =
                axis ? (DipTargetRegion){2, from, 3, to} : (DipTargetRegion){from, 2, to, 3};
            const DipSampleReadback readback = {region, room};
            DipError err = {.line = 7};
            assert_int_equal(dip_renderer_read_samples(stage.renderer, stage.scene,
                                                       &stage.made->pose, 0, &readback, &err),
                             good);
            assert_true(good || err.code == DIP_ERROR_RANGE);
            assert_true(good || err.line == 0);
            assert_true(good || strcmp(err.key, "readback.region") == 0);
        }
    }
}

// The samples are those of the frame's pixels only if the picture that is drawn has its size. A
// frame of one pixel has the same size at 1/1.5.
static void samples_need_a_picture_of_the_frames_size(void **state) {
    (void)state;
    static DipSampleValue room[64 * DIP_READBACK_STRIDE];
    static const struct {
        const char *settings;
        int width, height;
        bool good;
    } rows[] = {{"scale=1/2", 4, 4, false},   {"scale=2", 4, 4, false},
                {"scale=1", 4, 4, true},      {"scale=1/1.5", 1, 1, true},
                {"scale=1/1.5", 4, 1, false}, {"scale=1/1.5", 1, 4, false}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        DipRendererDef def = stage_def(rows[i].width, rows[i].height, rows[i].settings);
        def.pool = stage.pool;
        DipRenderer *renderer = stage_make_renderer(&def);
        const DipSampleReadback readback = {{0, 0, 1, 1}, room};
        DipError err = {.line = 7};
        assert_int_equal(
            dip_renderer_read_samples(renderer, stage.scene, &stage.made->pose, 0, &readback, &err),
            rows[i].good);
        assert_true(rows[i].good || (err.code == DIP_ERROR_UNSUPPORTED && err.line == 0));
        dip_renderer_destroy(&renderer);
    }
}

// A reflection of width 0 is none, whatever else it says.
static void reflections_have_the_sizes_of_frames_and_a_finite_level(void **state) {
    (void)state;
    static const struct {
        int width, height;
        double level_m;
        bool good;
    } rows[] = {{1, 1, 0.0, true},
                {0, -5, (double)NAN, true},
                {DIP_MAX_FRAME_SIZE, 1, -1e300, true},
                {1, DIP_MAX_FRAME_SIZE, 1e300, true},
                {DIP_MAX_FRAME_SIZE + 1, 1, 0.0, false},
                {1, DIP_MAX_FRAME_SIZE + 1, 0.0, false},
                {-1, 1, 0.0, false},
                {1, 0, 0.0, false},
                {1, -1, 0.0, false},
                {1, 1, (double)NAN, false},
                {1, 1, (double)INFINITY, false},
                {1, 1, (double)-INFINITY, false}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const DipReflectionDef reflection = {
            .width = rows[i].width, .height = rows[i].height, .level_m = rows[i].level_m};
        DipRendererDef def = stage.def;
        DipError err = {.line = 7};
        def.pool = stage.pool;
        def.reflection = reflection;
        assert_int_equal(dip_renderer_set_reflection(stage.renderer, &reflection, &err),
                         rows[i].good);
        assert_true(rows[i].good || (err.code == DIP_ERROR_RANGE && err.line == 0 &&
                                     strcmp(err.key, "reflection") == 0));
        DipRenderer *renderer = dip_renderer_create(&def, NULL);
        assert_int_equal(renderer != NULL, rows[i].good);
        dip_renderer_destroy(&renderer);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(poses_must_be_finite),
        cmocka_unit_test(orientations_may_have_any_length_but_0),
        cmocka_unit_test(fields_of_view_are_1_to_170_degrees),
        cmocka_unit_test(one_to_four_frames_are_drawn_at_once),
        cmocka_unit_test(regions_of_samples_lie_within_the_frame),
        cmocka_unit_test(samples_need_a_picture_of_the_frames_size),
        cmocka_unit_test(reflections_have_the_sizes_of_frames_and_a_finite_level),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
