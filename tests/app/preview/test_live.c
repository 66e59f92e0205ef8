// Errors found while the camera rests: against the cost report's truth and meter, step by step, and
// on the thread.
#include "app/measure/meter.h"
#include "app/measure/truth.h"
#include "app/preview/live.h"
#include "tests/renderer/scene/scenes.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

// More than one block and band each way, the last ones cut off.
enum { WIDTH = 211, HEIGHT = 163, PIXELS = WIDTH * HEIGHT, STRIDE = 4 * WIDTH + 12 };

static DipTestScene scene;
static DipReference *reference;
static uint8_t pictures[DIP_PANE_COUNT][STRIDE * HEIGHT];

static bool go_on(void *context, double done) {
    (void)context;
    (void)done;
    return true;
}

static DipTruth truth_of(const DipPose *pose, int samples) {
    const DipTruthDef def = {reference, "scene", *pose,   0,
                             WIDTH,     HEIGHT,  samples, DIP_FLIP_PIXELS_PER_DEGREE};
    DipTruth truth;
    assert_true(dip_truth_get(&truth, &def, NULL, NULL, go_on, NULL, NULL));
    return truth;
}

// The truth's codes with noise of so many codes, in rows that are not packed.
static void fill_picture(const DipTruth *truth, int noise, uint8_t *picture) {
    uint32_t random = 1;
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < 4 * WIDTH; x++) {
            random = random * 1664525u + 1013904223u;
            const int code =
                truth->rgba8[4 * WIDTH * y + x] + (int)(random >> 16) % (2 * noise + 1) - noise;
            picture[STRIDE * y + x] = (uint8_t)(code < 0 ? 0 : code > 255 ? 255 : code);
        }
    }
}

static DipJudgeShot make_shot(bool copied) {
    return (DipJudgeShot){
        .pose = scene.pose,
        .width = WIDTH,
        .height = HEIGHT,
        .stride_bytes = STRIDE,
        .rgba8 = {pictures[0], copied ? NULL : pictures[1]},
    };
}

// What the cost report would say.
static DipMetrics judged_whole(const DipTruth *truth, const uint8_t *picture) {
    DipMeter meter;
    DipFlipAnalysis side;
    DipMetricSums sums = {0};
    assert_true(dip_meter_init(&meter, WIDTH, HEIGHT, DIP_FLIP_PIXELS_PER_DEGREE));
    assert_true(dip_flip_analysis_init(&meter.flip, &side));
    const DipSrgbPicture standing = {truth->rgba8, 4 * WIDTH, WIDTH, HEIGHT};
    const DipSrgbPicture test = {picture, STRIDE, WIDTH, HEIGHT};
    dip_flip_analyse(&meter.flip, &standing, &side);
    const DipMeterStandard standard = {standing, truth->rgb_lin, &side, truth->classes};
    assert_true(dip_meter_add(&meter, &test, NULL, &standard, &sums));
    dip_flip_analysis_free(&side);
    dip_meter_free(&meter);
    return dip_metrics_of(&sums, 0);
}

static void check_close(double value, double expected) {
    assert_true(value == expected ||
                fabs(value - expected) <= 1e-9 * expected); // PSNR may be infinite
}

static DipJudgeStep step_to_news(DipJudge *judge, int *steps) {
    DipError err;
    DipJudgeStep step;
    *steps = 0;
    do {
        step = dip_judge_step(judge, &err);
        ++*steps;
    } while (step == DIP_JUDGE_WORKING);
    return step;
}

// At every level the figures are those of the cost report with as many samples.
static void errors_are_the_cost_reports(void **state) {
    (void)state;
    DipJudge *judge = dip_judge_create(reference, NULL);
    const DipJudgeShot shot = make_shot(false);
    int steps;
    assert_non_null(judge);
    assert_true(dip_judge_step(judge, NULL) == DIP_JUDGE_IDLE);
    assert_true(dip_judge_begin(judge, &shot, NULL));
    assert_int_equal(dip_judge_result(judge)->samples, 0);
    for (int level = 0; level < DIP_JUDGE_LEVELS; level++) {
        assert_true(step_to_news(judge, &steps) == DIP_JUDGE_NEWS);
        const DipJudgeResult *result = dip_judge_result(judge);
        DipTruth truth = truth_of(&scene.pose, dip_judge_samples[level]);
        assert_int_equal(result->samples, 2 * dip_judge_samples[level]);
        assert_true(result->last == (level == DIP_JUDGE_LEVELS - 1));
        for (int p = 0; p < DIP_PANE_COUNT; p++) {
            const DipMetrics figures = judged_whole(&truth, pictures[p]);
            check_close(result->panes[p].rmse_lin, figures.rmse_lin);
            check_close(result->panes[p].psnr_db, figures.psnr_db);
            check_close(result->panes[p].flip, figures.flip);
            const double floor_rmse = dip_metrics_of(&truth.floor, 0).rmse_lin / 2.0;
            assert_true(result->panes[p].at_floor == (figures.rmse_lin < 3.0 * floor_rmse));
        }
        dip_truth_free(&truth);
    }
    assert_true(dip_judge_result(judge)->panes[0].at_floor);
    assert_false(dip_judge_result(judge)->panes[1].at_floor);
    assert_true(step_to_news(judge, &steps) == DIP_JUDGE_IDLE && steps == 1);
    dip_judge_destroy(&judge);
}

// Other pictures of the same pose are held against the truth that is there; another pose is not.
static void a_truth_is_kept_while_its_pose_is(void **state) {
    (void)state;
    DipJudge *judge = dip_judge_create(reference, NULL);
    DipJudgeShot shot = make_shot(true);
    int first, again;
    assert_true(dip_judge_begin(judge, &shot, NULL));
    assert_true(step_to_news(judge, &first) == DIP_JUDGE_NEWS);
    const DipPaneError of_first = dip_judge_result(judge)->panes[0];
    assert_memory_equal(&of_first, &dip_judge_result(judge)->panes[1], sizeof of_first);
    shot.rgba8[0] = pictures[1];
    assert_true(dip_judge_begin(judge, &shot, NULL));
    assert_true(step_to_news(judge, &again) == DIP_JUDGE_NEWS);
    assert_true(again < first / 10);
    assert_int_equal(dip_judge_result(judge)->samples, 2 * dip_judge_samples[0]);
    assert_true(dip_judge_result(judge)->panes[0].flip > of_first.flip);
    shot.pose.position_world[0] += 0.01;
    assert_true(dip_judge_begin(judge, &shot, NULL));
    assert_true(step_to_news(judge, &again) == DIP_JUDGE_NEWS);
    assert_int_equal(again, first);
    dip_judge_destroy(&judge);
}

static void wait_ms(int ms) {
    const struct timespec time = {0, ms * 1000000L};
    nanosleep(&time, NULL);
}

static DipLiveReading await(DipLive *live, DipLiveStatus status) {
    DipLiveReading reading;
    for (int i = 0; i < 6000; i++) {
        dip_live_read(live, &reading);
        if (reading.status == status) {
            return reading;
        }
        wait_ms(10);
    }
    fail_msg("never in status %d", (int)status);
    return reading;
}

static DipLive *make_live(void) {
    const DipReflectionDef none = {0};
    DipLive *live = dip_live_create(&scene.def, &none, NULL);
    assert_non_null(live);
    return live;
}

static void the_thread_answers_once_per_shot(void **state) {
    (void)state;
    DipLive *live = make_live();
    DipLiveReading reading;
    const DipJudgeShot shot = make_shot(false);
    assert_false(dip_live_read(live, &reading));
    assert_true(reading.status == DIP_LIVE_RESTING);
    dip_live_show(live, &shot, 1);
    const DipLiveReading first = await(live, DIP_LIVE_DONE);
    assert_true(first.result.last);
    assert_true(first.result.panes[0].flip < first.result.panes[1].flip);
    dip_live_show(live, &shot, 1);
    assert_false(dip_live_read(live, &reading));
    dip_live_rest(live);
    assert_true(dip_live_read(live, &reading));
    assert_true(reading.status == DIP_LIVE_RESTING && reading.result.samples == 0);
    dip_live_show(live, &shot, 1);
    reading = await(live, DIP_LIVE_DONE);
    assert_true(reading.result.panes[0].flip == first.result.panes[0].flip);
    assert_true(reading.result.panes[1].flip == first.result.panes[1].flip);
    dip_live_destroy(&live);
    assert_null(live);
}

// Shots that follow each other at every stage of the work; the last one's answer is right.
static void the_thread_drops_what_is_no_longer_asked(void **state) {
    (void)state;
    DipLive *live = make_live();
    DipJudgeShot shot = make_shot(false);
    DipLiveReading reading;
    for (unsigned i = 1; i <= 40; i++) {
        shot.pose.position_world[0] = scene.pose.position_world[0] + 0.01 * (i % 3);
        shot.width = WIDTH - (int)(i % 2);
        dip_live_show(live, &shot, i);
        wait_ms((int)(i % 7) * 3);
        if (i % 5 == 0) {
            dip_live_rest(live);
            dip_live_read(live, &reading);
            assert_true(reading.status == DIP_LIVE_RESTING);
            wait_ms(3);
            assert_false(dip_live_read(live, &reading));
        }
    }
    shot = make_shot(false);
    dip_live_show(live, &shot, 41);
    reading = await(live, DIP_LIVE_DONE);
    DipTruth truth = truth_of(&scene.pose, dip_judge_samples[DIP_JUDGE_LEVELS - 1]);
    check_close(reading.result.panes[1].flip, judged_whole(&truth, pictures[1]).flip);
    dip_truth_free(&truth);
    dip_live_destroy(&live);
}

// At any point: before it starts, while it prepares, draws or judges.
static void the_thread_ends_when_told(void **state) {
    (void)state;
    const DipJudgeShot shot = make_shot(false);
    for (int i = 0; i < 24; i++) {
        DipLive *live = make_live();
        if (i > 0) {
            dip_live_show(live, &shot, 1);
            wait_ms(i / 2);
        }
        dip_live_destroy(&live);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_are_the_cost_reports),
        cmocka_unit_test(a_truth_is_kept_while_its_pose_is),
        cmocka_unit_test(the_thread_answers_once_per_shot),
        cmocka_unit_test(the_thread_drops_what_is_no_longer_asked),
        cmocka_unit_test(the_thread_ends_when_told),
    };
    atomic_bool never = false;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_fence);
    reference = dip_reference_create_for_truth(&scene.def, &never, NULL);
    if (!reference) {
        return 1;
    }
    DipTruth truth = truth_of(&scene.pose, 64);
    fill_picture(&truth, 0, pictures[0]);
    fill_picture(&truth, 40, pictures[1]);
    dip_truth_free(&truth);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    dip_reference_destroy(&reference);
    dip_test_scene_free(&scene);
    return failed;
}
