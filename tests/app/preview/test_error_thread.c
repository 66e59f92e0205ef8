// Tests of the errors that are measured while the camera rests. The job's results are compared with
// the truth and the meter of the cost report, and the thread's results with those of the job.
#include "app/cost/plan.h"
#include "app/measure/metrics/difference.h"
#include "app/measure/metrics/meter.h"
#include "app/measure/metrics/truth.h"
#include "app/preview/live/error_thread.h"
#include "app/report/report.h"
#include "renderer/catalogue/scenes.h"
#include "tests/app/measure/map_sum.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

// The picture has several bands, and several blocks in each direction. The picture's size is not a
// multiple of the size of bands or blocks, so the last bands and blocks are cut off.
enum { WIDTH = 211, HEIGHT = 163, PIXELS = WIDTH * HEIGHT, STRIDE = 4 * WIDTH + 12 };

static DipTestScene scene;
static DipReference *reference;
static uint8_t pictures[DIP_PANE_COUNT][STRIDE * HEIGHT];

static double viewing = DIP_FLIP_PIXELS_PER_DEGREE;

static bool go_on(void *context, double done) {
    (void)context;
    (void)done;
    return true;
}

static DipTruth truth_of(const DipPose *pose, int samples) {
    const DipTruthDef def = {reference, "scene", *pose,   0,
                             WIDTH,     HEIGHT,  samples, DIP_FLIP_PIXELS_PER_DEGREE,
                             NULL,      NULL};
    DipTruth truth;
    assert_true(dip_truth_get(&truth, &def, NULL, NULL, go_on, NULL, NULL));
    return truth;
}

// Fills in the truth's 8-bit values plus noise of up to `noise`. The rows are not packed.
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

static DipStill make_still(bool copied) {
    return (DipStill){
        .pose = scene.pose,
        .width = WIDTH,
        .height = HEIGHT,
        .stride_bytes = STRIDE,
        .pixels_per_degree = DIP_FLIP_PIXELS_PER_DEGREE,
        .rgba8 = {pictures[0], copied ? NULL : pictures[1]},
    };
}

// Computes the metrics in the same way as the cost report.
static DipMetricSums judged(const DipTruth *truth, const uint8_t *picture) {
    DipMeter meter;
    DipMetricSums sums = {0};
    assert_true(dip_meter_init(&meter, DIP_METER_PICTURES, WIDTH, HEIGHT, viewing));
    const DipSrgbPicture test = {picture, STRIDE, WIDTH, HEIGHT};
    const DipMeterStandard standard = dip_truth_standard(truth);
    assert_true(dip_meter_add(&meter, &test, NULL, &standard, &sums));
    dip_meter_free(&meter);
    return sums;
}

static DipMetrics measured_whole(const DipTruth *truth, const uint8_t *picture) {
    const DipMetricSums sums = judged(truth, picture);
    return dip_metrics_of(&sums, 0);
}

// Returns the mean FLIP of a map.
static double mean_of(const float *flip) {
    return dip_map_mean(dip_map_sum(flip, PIXELS, (DipPixelMask){0}));
}

static void check_close(double value, double expected) {
    assert_true(value == expected ||
                fabs(value - expected) <= 1e-9 * expected); // PSNR may be infinite
}

static DipStep step_to_news(DipErrorJob *job, int *steps) {
    DipError err;
    DipStep step;
    *steps = 0;
    do {
        step = dip_error_job_step(job, &err);
        ++*steps;
    } while (step == DIP_STEP_WORKING);
    return step;
}

// At every level, the errors equal those of the cost report with the same number of samples.
static void errors_equal_those_of_the_cost_report(void **state) {
    (void)state;
    DipErrorJob *job = dip_error_job_create(reference, "scene", NULL, NULL);
    const DipStill still = make_still(false);
    int steps;
    assert_non_null(job);
    assert_true(dip_error_job_step(job, NULL) == DIP_STEP_DONE);
    assert_true(dip_error_job_begin(job, &still, NULL));
    assert_int_equal(dip_error_job_result(job)->samples, 0);
    for (int level = 0; level < DIP_TRUTH_LEVELS; level++) {
        assert_true(step_to_news(job, &steps) == DIP_STEP_RESULT);
        const DipErrorJobResult *result = dip_error_job_result(job);
        DipTruth truth = truth_of(&scene.pose, dip_truth_level_samples[level]);
        assert_int_equal(result->samples, 2 * dip_truth_level_samples[level]);
        assert_true(result->last == (level == DIP_TRUTH_LEVELS - 1));
        for (int p = 0; p < DIP_PANE_COUNT; p++) {
            const DipMetrics figures = measured_whole(&truth, pictures[p]);
            assert_true(result->panes[p].rmse_lin == figures.rmse_lin);
            assert_true(result->panes[p].psnr_db == figures.psnr_db);
            assert_true(result->panes[p].flip == figures.flip);
            const double floor_rmse = dip_metrics_of(&truth.floor, 0).rmse_lin / 2.0;
            assert_true(result->panes[p].at_floor == (figures.rmse_lin < 3.0 * floor_rmse));
            assert_true(result->floor_rmse == floor_rmse);
            check_close(mean_of(dip_error_job_flip(job, p)), figures.flip);
        }
        assert_memory_equal(dip_error_job_truth(job), truth.rgba8, 4 * PIXELS);
        dip_truth_free(&truth);
    }
    assert_true(dip_error_job_result(job)->panes[0].at_floor);
    assert_false(dip_error_job_result(job)->panes[1].at_floor);
    assert_true(step_to_news(job, &steps) == DIP_STEP_DONE && steps == 1);
    dip_error_job_destroy(&job);
}

// Other pictures from the same pose are compared with the truth that the job already has. Another
// pose needs a new truth.
static void a_truth_is_kept_until_the_pose_changes(void **state) {
    (void)state;
    DipErrorJob *job = dip_error_job_create(reference, "scene", NULL, NULL);
    DipStill still = make_still(true);
    int first, again;
    assert_true(dip_error_job_begin(job, &still, NULL));
    assert_true(step_to_news(job, &first) == DIP_STEP_RESULT);
    const DipPaneError of_first = dip_error_job_result(job)->panes[0];
    assert_memory_equal(&of_first, &dip_error_job_result(job)->panes[1], sizeof of_first);
    still.rgba8[0] = pictures[1];
    assert_true(dip_error_job_begin(job, &still, NULL));
    assert_true(step_to_news(job, &again) == DIP_STEP_RESULT);
    assert_true(again < first / 10);
    assert_int_equal(dip_error_job_result(job)->samples, 2 * dip_truth_level_samples[0]);
    assert_true(dip_error_job_result(job)->panes[0].flip > of_first.flip);
    still.pose.position_world[0] += 0.01;
    assert_true(dip_error_job_begin(job, &still, NULL));
    assert_true(step_to_news(job, &again) == DIP_STEP_RESULT);
    assert_int_equal(again, first);
    still.pixels_per_degree = 25.0; // FLIP and its floor are for another viewing distance.
    assert_true(dip_error_job_begin(job, &still, NULL));
    assert_true(step_to_news(job, &again) == DIP_STEP_RESULT);
    assert_int_equal(again, first);
    DipTruth truth = truth_of(&still.pose, dip_truth_level_samples[0]);
    viewing = still.pixels_per_degree;
    assert_true(dip_error_job_result(job)->panes[0].flip ==
                measured_whole(&truth, pictures[1]).flip);
    viewing = DIP_FLIP_PIXELS_PER_DEGREE;
    dip_truth_free(&truth);
    dip_error_job_destroy(&job);
}

// A pane with mip colours is not compared with the truth. The other pane and the truth are not
// affected.
static void an_unjudged_pane_has_no_error(void **state) {
    (void)state;
    DipErrorJob *job = dip_error_job_create(reference, "scene", NULL, NULL);
    DipStill still = make_still(false);
    int steps;
    assert_true(dip_error_job_begin(job, &still, NULL));
    assert_true(step_to_news(job, &steps) == DIP_STEP_RESULT);
    const DipErrorJobResult both = *dip_error_job_result(job);
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        still.unjudged[p] = true;
        still.unjudged[1 - p] = false;
        assert_true(dip_error_job_begin(job, &still, NULL));
        assert_true(step_to_news(job, &steps) == DIP_STEP_RESULT);
        const DipErrorJobResult *result = dip_error_job_result(job);
        assert_true(result->panes[p].unjudged && result->panes[p].flip == 0.0);
        assert_null(dip_error_job_flip(job, p));
        assert_false(result->panes[1 - p].unjudged);
        assert_true(result->panes[1 - p].flip == both.panes[1 - p].flip);
        assert_true(mean_of(dip_error_job_flip(job, 1 - p)) > 0.0);
    }
    still.unjudged[0] = still.unjudged[1] = true;
    assert_true(dip_error_job_begin(job, &still, NULL));
    assert_true(step_to_news(job, &steps) == DIP_STEP_RESULT && steps == 1);
    assert_int_equal(dip_error_job_result(job)->samples, 2 * dip_truth_level_samples[0]);
    dip_error_job_destroy(&job);
}

// Returns whether a report that holds this picture says that its error is at the floor.
static bool report_says_at_floor(const DipTruth *truth, const uint8_t *picture) {
    DipMetricSums sums = judged(truth, picture), floor = truth->floor;
    bool known = true;
    DipCostRow row = {.viewpoints = &sums, .judged = &known};
    const DipCostReport report = {.options = {.places = 1},
                                  .rows = &row,
                                  .row_count = 1,
                                  .path_count = 1,
                                  .floors = &floor,
                                  .has_floor = &known};
    return dip_cost_at_floor(&report, 0);
}

static void the_floor_is_that_of_a_report(void **state) {
    (void)state;
    static uint8_t noisy[STRIDE * HEIGHT];
    DipErrorJob *job = dip_error_job_create(reference, "scene", NULL, NULL);
    DipStill still = make_still(true);
    DipTruth truth = truth_of(&scene.pose, dip_truth_level_samples[0]);
    int steps, at_floor = 0;
    still.rgba8[0] = noisy;
    for (int noise = 0; noise < 20; noise++) {
        fill_picture(&truth, 6 * noise, noisy);
        assert_true(dip_error_job_begin(job, &still, NULL));
        assert_true(step_to_news(job, &steps) == DIP_STEP_RESULT);
        const bool found = dip_error_job_result(job)->panes[0].at_floor;
        assert_int_equal(found, report_says_at_floor(&truth, noisy));
        at_floor += found;
    }
    assert_in_range(at_floor, 2, 18);
    dip_truth_free(&truth);
    dip_error_job_destroy(&job);
}

static void wait_ms(int ms) {
    const struct timespec time = {0, ms * 1000000L};
    nanosleep(&time, NULL);
}

static DipErrorReading await(DipErrorThread *thread, DipErrorStatus status) {
    DipErrorReading reading;
    for (int i = 0; i < 30000; i++) {
        dip_error_thread_read(thread, &reading);
        if (reading.status == status) {
            return reading;
        }
        wait_ms(10);
    }
    fail_msg("never in status %d", (int)status);
    return reading;
}

static DipErrorThread *make_thread(void) {
    const DipReflectionDef none = {0};
    DipErrorThread *thread = dip_error_thread_create(&scene.def, &none, NULL, NULL);
    assert_non_null(thread);
    return thread;
}

static void the_thread_answers_once_per_still(void **state) {
    (void)state;
    DipErrorThread *thread = make_thread();
    DipErrorReading reading;
    const DipStill still = make_still(false);
    assert_false(dip_error_thread_read(thread, &reading));
    assert_true(reading.status == DIP_ERROR_STATUS_PAUSED);
    dip_error_thread_measure(thread, &still, 1);
    const DipErrorReading first = await(thread, DIP_ERROR_STATUS_DONE);
    assert_true(first.result.last);
    assert_true(first.result.panes[0].flip < first.result.panes[1].flip);
    dip_error_thread_measure(thread, &still, 1);
    assert_false(dip_error_thread_read(thread, &reading));
    dip_error_thread_pause(thread);
    assert_true(dip_error_thread_read(thread, &reading));
    assert_true(reading.status == DIP_ERROR_STATUS_PAUSED && reading.result.samples == 0);
    dip_error_thread_measure(thread, &still, 1);
    reading = await(thread, DIP_ERROR_STATUS_DONE);
    assert_true(reading.result.panes[0].flip == first.result.panes[0].flip);
    assert_true(reading.result.panes[1].flip == first.result.panes[1].flip);
    dip_error_thread_destroy(&thread);
    assert_null(thread);
}

static bool refuse(void *context, double done) {
    (void)context;
    (void)done;
    return false;
}

// The preview and `diptych cost` find each other's truths.
static void the_cache_is_that_of_a_report(void **state) {
    (void)state;
    char folder[] = "/tmp/test_error_thread.XXXXXX", file[100];
    const DipReflectionDef none = {0};
    const DipStill still = make_still(false);
    DipTruthDef def = {.reference = reference,
                       .pose = scene.pose,
                       .width = WIDTH,
                       .height = HEIGHT,
                       .samples = DIP_TRUTH_SAMPLES,
                       .pixels_per_degree = DIP_FLIP_PIXELS_PER_DEGREE};
    DipTruth truth;
    char hash[33];
    int steps;
    assert_non_null(mkdtemp(folder));
    dip_cost_scene_hash(&scene.def, &none, hash);
    def.scene_hash = hash;
    DipErrorThread *thread = dip_error_thread_create(&scene.def, &none, folder, NULL);
    dip_error_thread_measure(thread, &still, 1);
    await(thread, DIP_ERROR_STATUS_DONE);
    dip_error_thread_destroy(&thread);
    assert_true(dip_truth_get(&truth, &def, folder, NULL, refuse, NULL, NULL));
    snprintf(file, sizeof file, "%s/truth-%s.bin", folder, truth.key);
    assert_int_equal(remove(file), 0);
    dip_truth_free(&truth);
    assert_true(dip_truth_get(&truth, &def, folder, NULL, go_on, NULL, NULL));
    DipErrorJob *job = dip_error_job_create(reference, hash, folder, NULL);
    assert_true(dip_error_job_begin(job, &still, NULL));
    assert_true(step_to_news(job, &steps) == DIP_STEP_RESULT);
    assert_true(dip_error_job_result(job)->last);
    assert_memory_equal(dip_error_job_truth(job), truth.rgba8, 4 * PIXELS);
    dip_truth_free(&truth);
    dip_error_job_destroy(&job);
    assert_int_equal(remove(file) | rmdir(folder), 0);
}

static uint32_t sum_bins(const DipErrorSpread *spread) {
    uint32_t sum = 0;
    for (int i = 0; i < DIP_ERROR_BINS; i++) {
        sum += spread->bins[i];
    }
    return sum;
}

// The pictures belong to the last result. After a change of settings, the truth stays while the
// FLIP maps are measured anew; after a change of pose, nothing stays.
static void the_pictures_belong_to_the_last_still(void **state) {
    (void)state;
    DipErrorThread *thread = make_thread();
    DipStill still = make_still(false);
    assert_null(dip_error_thread_pictures(thread));
    dip_error_thread_measure(thread, &still, 1);
    const DipErrorReading reading = await(thread, DIP_ERROR_STATUS_DONE);
    const DipErrorPictures *found = dip_error_thread_pictures(thread);
    assert_non_null(found);
    assert_true(found->width == WIDTH && found->height == HEIGHT);
    assert_true(found->result.last);
    DipTruth truth = truth_of(&scene.pose, dip_truth_level_samples[DIP_TRUTH_LEVELS - 1]);
    assert_memory_equal(found->truth_rgba8, truth.rgba8, 4 * PIXELS);
    dip_truth_free(&truth);
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        check_close(mean_of(found->flip[p]), reading.result.panes[p].flip);
        assert_int_equal(sum_bins(&found->spread[p]), PIXELS);
        assert_true(found->spread[p].tail.p50 <= found->spread[p].tail.p99);
    }
    const uint64_t version = found->version;
    assert_true(dip_error_thread_pictures(thread)->version == version);
    still.rgba8[0] = still.rgba8[1]; // The picture of other settings.
    still.rgba8[1] = NULL;
    dip_error_thread_measure(thread, &still, 2);
    found = dip_error_thread_pictures(thread);
    assert_non_null(found);
    assert_true(found->version > version || (!found->flip[0] && !found->flip[1]));
    await(thread, DIP_ERROR_STATUS_DONE);
    found = dip_error_thread_pictures(thread);
    assert_true(found->version > version);
    assert_memory_equal(found->flip[0], found->flip[1], PIXELS * sizeof(float));
    check_close(mean_of(found->flip[0]), reading.result.panes[1].flip);
    still.pose.position_world[0] += 0.01;
    dip_error_thread_measure(thread, &still, 3);
    found = dip_error_thread_pictures(thread);
    assert_true(!found || found->version > version + 1);
    dip_error_thread_pause(thread);
    assert_null(dip_error_thread_pictures(thread));
    dip_error_thread_destroy(&thread);
}

// New stills arrive at every stage of the work. The thread still delivers the right result for the
// last still.
static void the_thread_drops_stills_that_are_replaced(void **state) {
    (void)state;
    DipErrorThread *thread = make_thread();
    DipStill still = make_still(false);
    DipErrorReading reading;
    for (unsigned i = 1; i <= 40; i++) {
        still.pose.position_world[0] = scene.pose.position_world[0] + 0.01 * (i % 3);
        still.width = WIDTH - (int)(i % 2);
        dip_error_thread_measure(thread, &still, i);
        wait_ms((int)(i % 7) * 3);
        if (i % 5 == 0) {
            dip_error_thread_pause(thread);
            dip_error_thread_read(thread, &reading);
            assert_true(reading.status == DIP_ERROR_STATUS_PAUSED);
            wait_ms(3);
            assert_false(dip_error_thread_read(thread, &reading));
        }
    }
    still = make_still(false);
    dip_error_thread_measure(thread, &still, 41);
    reading = await(thread, DIP_ERROR_STATUS_DONE);
    DipTruth truth = truth_of(&scene.pose, dip_truth_level_samples[DIP_TRUTH_LEVELS - 1]);
    check_close(reading.result.panes[1].flip, measured_whole(&truth, pictures[1]).flip);
    dip_truth_free(&truth);
    dip_error_thread_destroy(&thread);
}

// The thread is told to end before it starts, and while it prepares, draws or measures.
static void the_thread_ends_at_any_stage(void **state) {
    (void)state;
    const DipStill still = make_still(false);
    for (int i = 0; i < 24; i++) {
        DipErrorThread *thread = make_thread();
        if (i > 0) {
            dip_error_thread_measure(thread, &still, 1);
            wait_ms(i / 2);
        }
        dip_error_thread_destroy(&thread);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_equal_those_of_the_cost_report),
        cmocka_unit_test(a_truth_is_kept_until_the_pose_changes),
        cmocka_unit_test(an_unjudged_pane_has_no_error),
        cmocka_unit_test(the_floor_is_that_of_a_report),
        cmocka_unit_test(the_cache_is_that_of_a_report),
        cmocka_unit_test(the_thread_answers_once_per_still),
        cmocka_unit_test(the_pictures_belong_to_the_last_still),
        cmocka_unit_test(the_thread_drops_stills_that_are_replaced),
        cmocka_unit_test(the_thread_ends_at_any_stage),
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
