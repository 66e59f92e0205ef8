// Tests of truths (converged pictures): their cache, their noise floor, and errors of pictures
// against them.
#include "app/measure/metrics/meter.h"
#include "app/measure/metrics/truth.h"
#include "renderer/reference/reference.h"
#include "renderer/catalogue/scenes.h"
#include "renderer/scene/frame.h"

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include <limits.h>
#include <math.h>

enum { WIDTH = 48, HEIGHT = 40, PIXELS = WIDTH * HEIGHT };

static DipTestScene scene;
static DipReference *reference;
static DipPool *pool;
static int calls; // number of calls of the progress function
static int last_call = 1000000;

static bool count_call(void *context, double done) {
    (void)context;
    assert_true(done >= 0.0 && done <= 1.0);
    return ++calls < last_call;
}

static DipTruthDef make_def(int samples) {
    return (DipTruthDef){reference, "scene", scene.pose, 0,
                         WIDTH,     HEIGHT,  samples,    DIP_FLIP_PIXELS_PER_DEGREE,
                         NULL,      NULL};
}

static bool get(DipTruth *truth, const DipTruthDef *def, const char *cache) {
    DipError err = {0};
    calls = 0;
    return dip_truth_get(truth, def, cache, pool, count_call, NULL, &err);
}

static void check_same(const DipTruth *a, const DipTruth *b) {
    assert_memory_equal(a->rgb_lin, b->rgb_lin, PIXELS * 3 * sizeof(float));
    assert_memory_equal(a->rgba8, b->rgba8, PIXELS * 4);
    assert_memory_equal(a->classes, b->classes, PIXELS);
    assert_memory_equal(&a->floor, &b->floor, sizeof a->floor);
}

static DipTruthJob *begin_live(const DipTruthDef *def, const char *cache) {
    DipTruthJob *job = dip_truth_job_create(def, cache, NULL, true, NULL);
    assert_non_null(job);
    return job;
}

// Steps to the next truth. Returns the number of steps.
static int step_to_truth(DipTruthJob *job) {
    int steps = 0;
    DipStep step;
    do {
        step = dip_truth_job_step(job, NULL);
        steps++;
    } while (step == DIP_STEP_WORKING);
    assert_int_equal(step, DIP_STEP_RESULT);
    assert_non_null(dip_truth_job_truth(job));
    return steps;
}

static void empty_folder(bool corrupt) {
    DIR *folder = opendir(".");
    for (const struct dirent *entry; (entry = readdir(folder));) {
        if (strncmp(entry->d_name, "truth-", 6) != 0) {
            continue;
        }
        if (!corrupt) {
            remove(entry->d_name);
            continue;
        }
        FILE *file = fopen(entry->d_name, "r+b");
        fseek(file, 1000, SEEK_SET);
        const int byte = fgetc(file);
        fseek(file, 1000, SEEK_SET);
        fputc(byte ^ 1, file);
        fclose(file);
    }
    closedir(folder);
}

static void the_cache_returns_the_truth_that_was_drawn(void **state) {
    (void)state;
    const DipTruthDef def = make_def(4);
    DipTruth made, found, without;
    assert_true(get(&made, &def, "."));
    assert_true(calls > 0);
    assert_true(get(&found, &def, "."));
    assert_int_equal(calls, 0);
    check_same(&made, &found);
    assert_true(get(&without, &def, NULL));
    assert_true(calls > 0);
    check_same(&made, &without);
    dip_truth_free(&found);
    // If the file is damaged, its hash does not match, so the truth is drawn anew.
    empty_folder(true);
    assert_true(get(&found, &def, "."));
    assert_true(calls > 0);
    check_same(&made, &found);
    empty_folder(false);
    dip_truth_free(&made);
    dip_truth_free(&found);
    dip_truth_free(&without);
}

// If anything that the truth depends on changes, the truth's key changes.
static void different_truths_have_different_keys(void **state) {
    (void)state;
    DipTruthDef defs[6];
    char keys[6][33];
    for (int i = 0; i < 6; i++) {
        defs[i] = make_def(1);
    }
    defs[1].samples = 4;
    defs[2].time_ns = 1;
    defs[3].pose.position_world[1] += 1e-9;
    defs[4].scene_hash = "other";
    defs[5].pose.fov_y_deg += 1e-9;
    for (int i = 0; i < 6; i++) {
        DipTruth truth;
        assert_true(get(&truth, &defs[i], NULL));
        memcpy(keys[i], truth.key, sizeof keys[i]);
        dip_truth_free(&truth);
        for (int k = 0; k < i; k++) {
            assert_string_not_equal(keys[i], keys[k]);
        }
    }
}

// Half of the difference between a truth's two halves estimates the truth's error. The test
// compares this estimate with the difference from a much better truth.
static void the_floor_estimates_the_truths_own_error(void **state) {
    (void)state;
    const DipTruthDef def = make_def(16);
    const DipTruthDef better_def = make_def(1024);
    DipTruth truth, better;
    assert_true(get(&truth, &def, NULL) && get(&better, &better_def, NULL));
    double squares = 0.0;
    for (int i = 0; i < 3 * PIXELS; i++) {
        const double e = (double)truth.rgb_lin[i] - (double)better.rgb_lin[i];
        squares += e * e / (3 * PIXELS);
    }
    const double floor = dip_metrics_of(&truth.floor, 0).rmse_lin / 2.0;
    assert_true(floor > 0.001);
    assert_true(sqrt(squares) > 0.8 * floor && sqrt(squares) < 1.25 * floor);
    assert_true(dip_metrics_of(&better.floor, 0).rmse_lin < 0.3 * floor);
    dip_truth_free(&truth);
    dip_truth_free(&better);
}

static void an_interrupted_truth_is_empty_and_not_cached(void **state) {
    (void)state;
    const DipTruthDef def = make_def(4);
    DipTruth truth;
    last_call = 1;
    assert_false(get(&truth, &def, "."));
    last_call = 1000000;
    assert_null(truth.rgb_lin);
    DipTruth again;
    assert_true(get(&again, &def, "."));
    assert_true(calls > 0);
    dip_truth_free(&again);
    empty_folder(false);
}

// A live truth is refined. Each of its levels is the truth of that number of samples.
static void a_live_truth_is_refined(void **state) {
    (void)state;
    const DipTruthDef def = make_def(DIP_TRUTH_SAMPLES);
    DipTruthJob *job = begin_live(&def, NULL);
    int samples;
    assert_null(dip_truth_job_truth(job));
    for (int level = 0; level < DIP_TRUTH_LEVELS; level++) {
        const DipTruthDef level_def = make_def(dip_truth_level_samples[level]);
        DipTruth whole;
        dip_truth_job_drawn(job, &samples);
        assert_int_equal(samples, 2 * dip_truth_level_samples[level]);
        assert_true(step_to_truth(job) > 4);
        const DipTruth *truth = dip_truth_job_truth(job);
        assert_int_equal(truth->samples, samples);
        assert_true(get(&whole, &level_def, NULL));
        assert_memory_equal(truth->rgb_lin, whole.rgb_lin, PIXELS * 3 * sizeof(float));
        assert_memory_equal(truth->rgba8, whole.rgba8, PIXELS * 4);
        assert_true(dip_truth_floor_rmse(&truth->floor, 0) ==
                    dip_truth_floor_rmse(&whole.floor, 0));
        if (level == DIP_TRUTH_LEVELS - 1) {
            check_same(truth, &whole);
        }
        dip_truth_free(&whole);
    }
    dip_truth_job_drawn(job, &samples);
    assert_int_equal(samples, 0);
    assert_int_equal(dip_truth_job_step(job, NULL), DIP_STEP_DONE);
    dip_truth_job_destroy(&job);
    const DipTruthDef coarse = make_def(16);
    job = begin_live(&coarse, NULL);
    step_to_truth(job);
    step_to_truth(job);
    assert_int_equal(dip_truth_job_truth(job)->samples, 32);
    assert_int_equal(dip_truth_job_step(job, NULL), DIP_STEP_DONE);
    dip_truth_job_destroy(&job);
}

// A truth that a live job has drawn is found by others, and the other way round.
static void live_truths_share_the_cache(void **state) {
    (void)state;
    const DipTruthDef def = make_def(16);
    DipTruth found, made;
    DipTruthJob *job = begin_live(&def, ".");
    step_to_truth(job);
    step_to_truth(job);
    assert_int_equal(dip_truth_job_step(job, NULL), DIP_STEP_DONE);
    assert_true(get(&found, &def, "."));
    assert_int_equal(calls, 0);
    check_same(dip_truth_job_truth(job), &found);
    dip_truth_job_destroy(&job);
    empty_folder(false);
    assert_true(get(&made, &def, "."));
    assert_true(calls > 0);
    job = begin_live(&def, ".");
    assert_int_equal(step_to_truth(job), 1);
    check_same(dip_truth_job_truth(job), &made);
    assert_int_equal(dip_truth_job_truth(job)->samples, 32);
    assert_int_equal(dip_truth_job_step(job, NULL), DIP_STEP_DONE);
    dip_truth_job_destroy(&job);
    dip_truth_free(&made);
    dip_truth_free(&found);
    empty_folder(false);
}

// A live job that is dropped at any step leaves no file. It goes on if the folder is full or cannot
// be written; other jobs fail.
static void a_live_truth_does_without_the_cache(void **state) {
    (void)state;
    const DipTruthDef def = make_def(4);
    DipTruth truth;
    DipTruthJob *job = begin_live(&def, ".");
    const int steps = step_to_truth(job);
    dip_truth_job_destroy(&job);
    for (int i = 1; i < steps; i += 3) {
        job = begin_live(&def, ".");
        for (int k = 0; k < i; k++) {
            assert_int_equal(dip_truth_job_step(job, NULL), DIP_STEP_WORKING);
        }
        dip_truth_job_destroy(&job);
    }
    assert_true(get(&truth, &def, NULL));
    char name[64];
    snprintf(name, sizeof name, "truth-%s.bin", truth.key);
    assert_int_not_equal(access(name, F_OK), 0);
    FILE *large = fopen("truth-large.bin", "wb");
    assert_true(large && ftruncate(fileno(large), ((off_t)1 << 30) + 1) == 0);
    fclose(large);
    job = begin_live(&def, ".");
    step_to_truth(job);
    assert_int_equal(dip_truth_job_step(job, NULL), DIP_STEP_DONE);
    dip_truth_job_destroy(&job);
    assert_int_not_equal(access(name, F_OK), 0);
    job = begin_live(&def, "no/such/folder");
    step_to_truth(job);
    assert_int_equal(dip_truth_job_step(job, NULL), DIP_STEP_DONE);
    dip_truth_job_destroy(&job);
    dip_truth_free(&truth);
    assert_false(get(&truth, &def, "no/such/folder"));
    empty_folder(false);
}

// Light from -0.25 to 1.75, growing from pixel to pixel.
static double ramp(int i) {
    return -0.25 + 2.0 * i / (3 * PIXELS);
}

static bool draw_ramp(const DipTruthDef *def, int half, double *rgb_lin, DipError *err) {
    (void)def;
    (void)half;
    (void)err;
    for (int i = 0; i < 3 * PIXELS; i++) {
        rgb_lin[i] = ramp(i);
    }
    return true;
}

// A truth has its light in floats, unclamped, and as 8-bit sRGB, clamped to 0..1.
static void light_is_kept_in_floats_and_in_bytes(void **state) {
    (void)state;
    DipTruthDef def = make_def(4);
    DipTruth truth;
    def.reference = NULL;
    def.draw = draw_ramp;
    assert_true(get(&truth, &def, NULL));
    for (int i = 0; i < 3 * PIXELS; i++) {
        const double light = fmin(fmax(ramp(i), 0.0), 1.0);
        const double code =
            255.0 * (light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1.0 / 2.4) - 0.055);
        assert_true(truth.rgb_lin[i] == (float)ramp(i));
        // Near black, a step of 16-bit linear light is a twentieth of a code.
        assert_true(fabs(truth.rgba8[i / 3 * 4 + i % 3] - code) <= 0.56);
        assert_int_equal(truth.rgba8[i / 3 * 4 + 3], 255);
    }
    dip_truth_free(&truth);
}

// If a truth is compared with itself, the only error comes from rounding to 8-bit codes.
static void a_truth_compared_with_itself_has_no_error(void **state) {
    (void)state;
    const DipTruthDef def = make_def(16);
    DipTruth truth;
    DipMeter meter;
    DipMetricSums sums = {0};
    assert_true(dip_truth_get(&truth, &def, NULL, pool, NULL, NULL, NULL)); // Without progress.
    assert_true(dip_meter_init(&meter, DIP_METER_PICTURES, WIDTH, HEIGHT, def.pixels_per_degree));
    const DipSrgbPicture picture = {truth.rgba8, (size_t)WIDTH * 4, WIDTH, HEIGHT};
    const DipMeterStandard standard = dip_truth_standard(&truth);
    assert_true(dip_meter_add(&meter, &picture, NULL, &standard, &sums));
    dip_meter_end_burst(&meter, &sums);
    const DipMetrics f = dip_metrics_of(&sums, 0);
    assert_true(f.flip == 0.0 && f.ssim == 1.0 && isinf(f.psnr_db));
    assert_true(f.rmse_lin > 0.0 && f.rmse_lin < 1.0 / 255.0);
    assert_true(sums.regions[0].pixels == PIXELS);
    double parts = 0.0;
    for (int r = 1; r < DIP_METRIC_REGION_COUNT; r++) {
        parts += sums.regions[r].pixels;
    }
    assert_true(parts == PIXELS);
    assert_true(dip_flicker_metrics_of(&sums).flicker == 0.0);
    dip_meter_free(&meter);
    dip_truth_free(&truth);
}

// The XDG Base Directory Specification: without XDG_CACHE_HOME, or if it is empty, caches lie in
// $HOME/.cache; a path that is not absolute is ignored.
static void the_default_folder_follows_the_environment(void **state) {
    (void)state;
    static const struct {
        const char *cache, *home, *expected;
    } cases[] = {
        {"/var/c", "/home/a", "/var/c/diptych"},
        {"/var/c", NULL, "/var/c/diptych"},
        {NULL, "/home/a", "/home/a/.cache/diptych"},
        {"", "/home/a", "/home/a/.cache/diptych"},
        {"c/d", "/home/a", "/home/a/.cache/diptych"},
        {"c/d", NULL, NULL},
        {NULL, NULL, NULL},
        {"", "", NULL},
    };
    const char *given[2] = {getenv("XDG_CACHE_HOME"), getenv("HOME")};
    char *kept[2] = {given[0] ? strdup(given[0]) : NULL, given[1] ? strdup(given[1]) : NULL};
    static const char *const names[2] = {"XDG_CACHE_HOME", "HOME"};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *const values[2] = {cases[i].cache, cases[i].home};
        for (int v = 0; v < 2; v++) {
            assert_int_equal(values[v] ? setenv(names[v], values[v], 1) : unsetenv(names[v]), 0);
        }
        char folder[64] = "";
        const bool found = dip_truth_default_folder(folder, sizeof folder);
        if (found != (cases[i].expected != NULL)) {
            fail_msg("case %zu: %s", i, folder);
        }
        if (found) {
            assert_string_equal(folder, cases[i].expected);
            const size_t size = strlen(folder) + 1;
            assert_true(dip_truth_default_folder(folder, size));
            assert_false(dip_truth_default_folder(folder, size - 1));
        }
    }
    for (int v = 0; v < 2; v++) {
        assert_int_equal(kept[v] ? setenv(names[v], kept[v], 1) : unsetenv(names[v]), 0);
        free(kept[v]);
    }
}

static void a_cache_whose_name_is_too_long_is_refused(void **state) {
    (void)state;
    static char cache[PATH_MAX + 1];
    const DipTruthDef def = make_def(16);
    DipTruth truth;
    DipError err = {0};
    memset(cache, 'c', PATH_MAX);
    assert_false(dip_truth_get(&truth, &def, cache, pool, NULL, NULL, &err));
    assert_int_equal(err.code, DIP_ERROR_OVERSIZED);
    assert_string_equal(err.key, "--cache");
    assert_string_equal(err.message, "the name is too long");
}

static void truths_that_cannot_be_drawn_are_refused(void **state) {
    (void)state;
    enum { CASES = 9 };
    DipTruthDef defs[CASES];
    static const char *const keys[CASES] = {"size",
                                            "size",
                                            "size",
                                            "samples",
                                            "samples",
                                            "samples",
                                            "pixels_per_degree",
                                            "pixels_per_degree",
                                            "pixels_per_degree"};
    for (int i = 0; i < CASES; i++) {
        defs[i] = make_def(4);
    }
    defs[0].width = -1;
    defs[1].height = 0;
    defs[2].height = DIP_MAX_FRAME_SIZE + 1;
    defs[3].samples = 0;
    defs[4].samples = 5;
    defs[5].samples = 65 * 65;
    defs[6].pixels_per_degree = NAN;
    defs[7].pixels_per_degree = DIP_FLIP_MIN_PIXELS_PER_DEGREE * 0.999;
    defs[8].pixels_per_degree = DIP_FLIP_MAX_PIXELS_PER_DEGREE * 1.001;
    for (int i = 0; i < CASES; i++) {
        DipTruth truth;
        DipError err = {0};
        assert_false(dip_truth_get(&truth, &defs[i], NULL, pool, NULL, NULL, &err));
        assert_int_equal(err.code, DIP_ERROR_RANGE);
        assert_string_equal(err.key, keys[i]);
        assert_null(truth.rgb_lin);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_cache_returns_the_truth_that_was_drawn),
        cmocka_unit_test(different_truths_have_different_keys),
        cmocka_unit_test(the_floor_estimates_the_truths_own_error),
        cmocka_unit_test(an_interrupted_truth_is_empty_and_not_cached),
        cmocka_unit_test(a_live_truth_is_refined),
        cmocka_unit_test(live_truths_share_the_cache),
        cmocka_unit_test(a_live_truth_does_without_the_cache),
        cmocka_unit_test(light_is_kept_in_floats_and_in_bytes),
        cmocka_unit_test(a_truth_compared_with_itself_has_no_error),
        cmocka_unit_test(the_default_folder_follows_the_environment),
        cmocka_unit_test(a_cache_whose_name_is_too_long_is_refused),
        cmocka_unit_test(truths_that_cannot_be_drawn_are_refused),
    };
    char folder[] = "/tmp/test_truth.XXXXXX";
    DipError err = {0};
    dip_test_scene_make(&scene, DIP_TEST_SCENE_fence);
    reference = dip_reference_create(&scene.def, &err);
    pool = dip_pool_create(2, &err);
    if (!reference || !pool || !mkdtemp(folder) || chdir(folder) != 0) {
        return 1;
    }
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    dip_pool_destroy(&pool);
    dip_reference_destroy(&reference);
    dip_test_scene_free(&scene);
    return rmdir(folder) == 0 ? failed : 1;
}
