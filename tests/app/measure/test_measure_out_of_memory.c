// Tests what the metrics and the truths do when memory runs out: they say so and keep nothing, and
// a second attempt gives the right numbers.
#include "app/measure/metrics/meter.h"
#include "app/measure/metrics/ssim.h"
#include "app/measure/timing/driver.h"
#include "app/measure/metrics/truth.h"
#include "renderer/reference/reference.h"
#include "renderer/catalogue/scenes.h"
#include "tests/support/out_of_memory.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { WIDTH = 24, HEIGHT = 18, PIXELS = WIDTH * HEIGHT };

static uint8_t codes[2][4 * PIXELS];
static float light[3 * PIXELS];
static uint8_t classes[PIXELS];

static DipSrgbPicture picture(int index) {
    return (DipSrgbPicture){codes[index], 4 * (size_t)WIDTH, WIDTH, HEIGHT};
}

// The functions of metrics return false without an error, because they fail only without memory.
static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "metrics", "out of memory");
}

// --- metrics -------------------------------------------------------------------------------------

typedef struct Metering {
    DipMeter meter;
    DipMetricSums sums;
    DipMetricSums expected;
} Metering;

static bool init_meter(void *context, DipError *err) {
    Metering *m = context;
    return dip_meter_init(&m->meter, DIP_METER_BURSTS, WIDTH, HEIGHT, 67.0) || out_of_memory(err);
}

static bool judge(void *context, DipError *err) {
    Metering *m = context;
    const DipSrgbPicture test = picture(0);
    const DipMeterStandard standard = {picture(1), light, NULL, classes};
    m->sums = (DipMetricSums){0};
    dip_meter_begin_burst(&m->meter);
    const bool judged = dip_meter_add(&m->meter, &test, NULL, &standard, &m->sums);
    dip_meter_end_burst(&m->meter, &m->sums);
    return judged || out_of_memory(err);
}

static void must_init_meter(void *context) {
    assert_true(init_meter(context, NULL));
}

static void free_metering(void *context) {
    Metering *m = context;
    dip_meter_free(&m->meter);
}

static void check_sums(void *context, bool succeeded) {
    Metering *m = context;
    assert_true(succeeded || judge(context, NULL));
    assert_memory_equal(&m->sums, &m->expected, sizeof m->sums);
}

static void meter_says_that_memory_ran_out(void **state) {
    (void)state;
    static Metering m;
    dip_out_of_memory_check(&(DipOutOfMemory){.name = "a meter",
                                              .context = &m,
                                              .run = init_meter,
                                              .finish = free_metering,
                                              .needs_every_allocation = true});
    must_init_meter(&m);
    assert_true(judge(&m, NULL));
    m.expected = m.sums;
    free_metering(&m);
    dip_out_of_memory_check(&(DipOutOfMemory){.name = "all metrics of a picture",
                                              .context = &m,
                                              .prepare = must_init_meter,
                                              .run = judge,
                                              .check = check_sums,
                                              .finish = free_metering,
                                              .needs_every_allocation = true});
}

// --- truths --------------------------------------------------------------------------------------

typedef struct Fixture {
    DipTestScene scene;
    DipReference *reference;
    DipPool *pool;
    const char *cache;
    DipTruth truth;
    uint8_t expected[4 * PIXELS];
    char file[512]; // The cache's only file.
} Fixture;

static Fixture fixture;

static bool go_on(void *context, double done) {
    (void)context;
    (void)done;
    return true;
}

static DipTruthDef make_def(void) {
    return (DipTruthDef){
        .reference = fixture.reference,
        .scene_hash = "0123456789abcdef0123456789abcdef",
        .pose = fixture.scene.pose,
        .width = WIDTH,
        .height = HEIGHT,
        .samples = 4,
        .pixels_per_degree = 67.0,
    };
}

static bool get_truth(void *context, DipError *err) {
    (void)context;
    const DipTruthDef def = make_def();
    return dip_truth_get(&fixture.truth, &def, fixture.cache, fixture.pool, go_on, NULL, err);
}

// A live truth is complete even if it cannot be stored.
static bool get_live_truth(void *context, DipError *err) {
    (void)context;
    const DipTruthDef def = make_def();
    DipTruthJob *job = dip_truth_job_create(&def, fixture.cache, NULL, true, err);
    DipStep step = job ? DIP_STEP_WORKING : DIP_STEP_FAILED;
    while (step == DIP_STEP_WORKING || step == DIP_STEP_RESULT) {
        step = dip_truth_job_step(job, err);
    }
    const bool same =
        step == DIP_STEP_FAILED ||
        memcmp(dip_truth_job_truth(job)->rgba8, fixture.expected, sizeof fixture.expected) == 0;
    dip_truth_job_destroy(&job);
    assert_true(same);
    return step == DIP_STEP_DONE;
}

static void forget_file(void *context) {
    (void)context;
    remove(fixture.file);
}

static void free_truth(void *context) {
    (void)context;
    dip_truth_free(&fixture.truth);
}

static void check_truth(void *context, bool succeeded) {
    static const DipTruth empty;
    if (!succeeded) {
        assert_memory_equal(&fixture.truth, &empty, sizeof empty);
        assert_true(get_truth(context, NULL));
    }
    assert_memory_equal(fixture.truth.rgba8, fixture.expected, sizeof fixture.expected);
}

static void truth_is_drawn_whole_or_not_at_all(void **state) {
    (void)state;
    char folder[] = "/tmp/measure_out_of_memory.XXXXXX";
    assert_non_null(mkdtemp(folder));
    dip_test_scene_make(&fixture.scene, DIP_TEST_SCENE_cube_on_plane);
    fixture.reference = dip_reference_create(&fixture.scene.def, NULL);
    fixture.pool = dip_pool_create(1, NULL);
    assert_true(get_truth(NULL, NULL));
    memcpy(fixture.expected, fixture.truth.rgba8, sizeof fixture.expected);
    snprintf(fixture.file, sizeof fixture.file, "%s/truth-%s.bin", folder, fixture.truth.key);
    dip_truth_free(&fixture.truth);
    DipOutOfMemory operation = {.name = "a truth",
                                .run = get_truth,
                                .check = check_truth,
                                .finish = free_truth,
                                .needs_every_allocation = true};
    dip_out_of_memory_check(&operation);
    fixture.cache = folder;
    // The first allocation opens the file of the cache. Its failure counts as a missing file.
    operation.needs_every_allocation = false;
    operation.name = "a truth that is stored";
    operation.prepare = forget_file;
    dip_out_of_memory_check(&operation);
    // If the file cannot be read, the truth is drawn again.
    operation.name = "a truth from the cache";
    operation.prepare = NULL;
    dip_out_of_memory_check(&operation);
    dip_out_of_memory_check(
        &(DipOutOfMemory){.name = "a live truth", .prepare = forget_file, .run = get_live_truth});
    assert_true(get_truth(NULL, NULL)); // The file exists again.
    dip_truth_free(&fixture.truth);
    dip_pool_destroy(&fixture.pool);
    dip_reference_destroy(&fixture.reference);
    dip_test_scene_free(&fixture.scene);
    assert_int_equal(remove(fixture.file) | rmdir(folder), 0);
}

// --- timing --------------------------------------------------------------------------------------

static DipThreadUse no_use(void *context) {
    (void)context;
    return (DipThreadUse){.has_wait = true};
}

static bool draw_nothing(void *context, const DipDriverTurn *turn, DipTimed *timed, DipError *err) {
    (void)context;
    (void)turn;
    (void)err;
    timed->ms = 1.0;
    return true;
}

static bool time_subjects(void *context, DipError *err) {
    static const int bases[] = {0, 0};
    const DipDriverDef def = {.subjects = 2,
                              .base_of = bases,
                              .block_subjects = 1,
                              .starts = 1,
                              .rounds = 2,
                              .frames = 2,
                              .base_copies = 1};
    const DipDriverCalls calls = {.draw = draw_nothing, .thread_use = no_use};
    DipDriver *driver = dip_driver_create(&def, &calls, err);
    DipDriverStep step = DIP_DRIVER_FAILED;
    while (driver && (step = dip_driver_step(driver, err)) < DIP_DRIVER_DONE) {
    }
    DipTimesFit *fit = NULL;
    (void)context;
    if (step == DIP_DRIVER_DONE) {
        const DipTimes times = dip_driver_times(driver);
        fit = dip_times_fit(&times, err);
    }
    const bool done = fit != NULL;
    dip_times_fit_free(&fit);
    dip_driver_destroy(&driver);
    return done;
}

static void timing_says_that_memory_ran_out(void **state) {
    (void)state;
    dip_out_of_memory_check(
        &(DipOutOfMemory){.name = "timing", .run = time_subjects, .needs_every_allocation = true});
}

int main(int argc, char **argv) {
    dip_out_of_memory_read_options(argc, argv);
    for (int i = 0; i < 4 * PIXELS; i++) {
        codes[0][i] = i % 4 == 3 ? 255 : (uint8_t)(i * 7);
        codes[1][i] = i % 4 == 3 ? 255 : (uint8_t)(i * 5);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(meter_says_that_memory_ran_out),
        cmocka_unit_test(truth_is_drawn_whole_or_not_at_all),
        cmocka_unit_test(timing_says_that_memory_ran_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
