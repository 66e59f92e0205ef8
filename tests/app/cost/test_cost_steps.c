// Tests of the steps that make a report: the truths, the errors of every row against them, and the
// times and the work of every row. Plain loops compute the same errors and the same work. No time
// is asserted, since the machine may be busy.
#include "app/cost/steps.h"
#include "app/files/whole_file.h"
#include "app/measure/metrics/meter.h"
#include "app/measure/timing/sample.h"
#include "renderer/catalogue/scenes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#define FOLDER "test_cost_steps.folder" // Holds the journal.
enum { SIDE = 64, PIXELS = SIDE * SIDE, PLACES = 2, BURST = 2, ROWS = 6, PATHS = 2, FRAMES = 4 };
// Rows of the report. Each path has the baseline twice, the second time for the A/A comparison.
enum { BASE, SAME, ANTIALIASED, OTHER_BASE, OTHER_SAME, FILTERED };

static DipTestScene scene;
static DipSession session;
static DipCamPath *camera_path;
static DipCostReport report;
static DipCostContext cost;

// --- the fixture ---------------------------------------------------------------------------------

static void set_row(int row, const char *settings, int path) {
    report.rows[row].path = path;
    assert_true(dip_quality_parse(settings, &report.rows[row].quality, NULL));
}

static void make_report(int side, int first_place) {
    report = (DipCostReport){.options = {.baseline = dip_quality_default(),
                                         .places = PLACES,
                                         .burst = BURST,
                                         .first_place = first_place,
                                         .end_place = PLACES,
                                         .samples = 4,
                                         .pixels_per_degree = 67.0,
                                         .rounds = 2,
                                         .starts = 1,
                                         .timed_frames = FRAMES / 2,
                                         .has_seed = true,
                                         .seed = 5},
                             .scene_hash = "a scene that is made in code",
                             .threads = 2,
                             .width = side,
                             .height = side,
                             .paths = {"DEFAULT", "AF"},
                             .path_count = PATHS,
                             .row_count = ROWS,
                             .combined_first = ROWS,
                             .base_rows = {BASE, OTHER_BASE},
                             .same_rows = {SAME, OTHER_SAME}};
    report.rows = calloc(DIP_COST_MAX_ROWS, sizeof *report.rows);
    assert_non_null(report.rows);
    set_row(BASE, "", 0);
    set_row(SAME, "", 0);
    set_row(ANTIALIASED, "aa=4", 0);
    set_row(OTHER_BASE, "", 1);
    set_row(OTHER_SAME, "", 1);
    set_row(FILTERED, "af=8", 1);
    assert_true(dip_cost_report_alloc(&report, NULL));
}

// Opens a report with a journal, which continues if it exists.
static void open_cost(int side, int first_place) {
    make_report(side, first_place);
    assert_true(dip_cost_context_open(&cost, &session, &report, true, NULL));
    cost.journal = dip_cost_journal_open(FOLDER, "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa", NULL);
    assert_non_null(cost.journal);
}

// Closes a report. If it is finished, its journal is removed.
static void close_cost(bool finished) {
    dip_cost_journal_close(&cost.journal, finished);
    dip_cost_context_close(&cost);
    dip_cost_report_free(&report);
}

static int set_up(void **state) {
    (void)state;
    assert_true(dip_folder_make(FOLDER, "--out", NULL));
    remove(FOLDER "/cost.state"); // What a run that failed has left.
    dip_test_scene_make(&scene, DIP_TEST_SCENE_fence);
    session = (DipSession){.pool = dip_pool_create(2, NULL),
                           .isa = dip_isa_best(),
                           .scene_def = scene.def,
                           .reflection = scene.reflection};
    session.scene = dip_scene_create(&scene.def, NULL, NULL);
    DipCamKey keys[2];
    for (int i = 0; i < 2; i++) {
        memcpy(keys[i].position_world, scene.pose.position_world, sizeof keys[i].position_world);
        memcpy(keys[i].orientation, scene.pose.orientation, sizeof keys[i].orientation);
        keys[i].position_world[0] += i;
    }
    assert_true(dip_campath_create(keys, 2, INT64_C(5000000000), &camera_path, NULL));
    session.track = dip_camtrack_make(true);
    dip_camtrack_set(&session.track, DIP_CATEGORY_DEFAULT, camera_path, 60.0);
    dip_camtrack_set(&session.track, DIP_CATEGORY_AF, camera_path, 30.0);
    return session.pool && session.scene ? 0 : -1;
}

static int tear_down(void **state) {
    (void)state;
    dip_campath_destroy(&camera_path);
    dip_scene_destroy(&session.scene);
    dip_pool_destroy(&session.pool);
    dip_test_scene_free(&scene);
    return rmdir(FOLDER);
}

// --- errors --------------------------------------------------------------------------------------

static DipTruth truth_of(int path, int place, int frame) {
    DipTruth truth;
    assert_true(dip_cost_context_truth(&cost, path, place, frame, NULL, NULL, &truth, NULL));
    return truth;
}

// Measures the errors of one row at one viewpoint, one frame of the burst after the other.
static DipCostBurstErrors errors_of(int row, int place) {
    static uint8_t picture[4 * PIXELS];
    DipCostBurstErrors errors = {.sums = {.bursts = 0.0}};
    DipMeter meter;
    assert_true(dip_meter_init(&meter, DIP_METER_BURSTS, SIDE, SIDE, 67.0));
    for (int f = 0; f < BURST; f++) {
        char hash[33];
        DipTruth truth = truth_of(report.rows[row].path, place, f);
        const DipMeterStandard standard = dip_truth_standard(&truth);
        const DipSrgbPicture test = {picture, 4 * SIDE, SIDE, SIDE};
        assert_true(dip_cost_draw_viewpoint(&cost, row, place, f, picture, hash, NULL));
        assert_true(dip_meter_add(&meter, &test, NULL, &standard, &errors.sums));
        dip_truth_free(&truth);
    }
    dip_meter_end_burst(&meter, &errors.sums);
    errors.tail = dip_flip_tail_result(&meter.tail);
    dip_meter_free(&meter);
    return errors;
}

static void rows_have_the_errors_of_their_own_pictures(void **state) {
    (void)state;
    open_cost(SIDE, 0);
    assert_true(dip_cost_make_truths(&cost, NULL));
    assert_true(dip_cost_judge(&cost, NULL));
    for (int row = 0; row < ROWS; row++) {
        for (int place = 0; place < PLACES; place++) {
            const DipCostBurstErrors expected = errors_of(row, place);
            assert_true(report.rows[row].judged[place]);
            assert_memory_equal(&report.rows[row].viewpoints[place], &expected.sums,
                                sizeof expected.sums);
            assert_memory_equal(&report.rows[row].tails[place], &expected.tail,
                                sizeof expected.tail);
        }
    }
    // Hashes tell which rows show the same pictures.
    assert_string_equal(report.rows[BASE].pictures[0], report.rows[SAME].pictures[0]);
    assert_string_not_equal(report.rows[BASE].pictures[0], report.rows[BASE].pictures[1]);
    assert_string_not_equal(report.rows[BASE].pictures[0], report.rows[ANTIALIASED].pictures[0]);
    assert_string_not_equal(report.rows[BASE].pictures[0], report.rows[OTHER_BASE].pictures[0]);
    close_cost(true);
}

// The same pictures have other errors against other truths, so their hash is another one.
static void hashes_of_errors_depend_on_the_truths(void **state) {
    (void)state;
    char hashes[2][33];
    for (int i = 0; i < 2; i++) {
        open_cost(SIDE, 0);
        report.options.samples = i ? 9 : 4;
        assert_true(dip_cost_judge(&cost, NULL));
        memcpy(hashes[i], report.rows[BASE].pictures[0], sizeof hashes[i]);
        close_cost(true);
    }
    assert_string_not_equal(hashes[0], hashes[1]);
}

static void floors_are_sums_over_the_bursts(void **state) {
    (void)state;
    open_cost(SIDE, 0);
    assert_true(dip_cost_make_truths(&cost, NULL));
    for (int i = 0; i < PATHS * PLACES; i++) {
        DipMetricSums expected = {.bursts = 0.0};
        for (int f = 0; f < BURST; f++) {
            DipTruth truth = truth_of(i / PLACES, i % PLACES, f);
            dip_metric_sums_add(&expected, &truth.floor);
            dip_truth_free(&truth);
        }
        assert_true(report.has_floor[i]);
        assert_memory_equal(&report.floors[i], &expected, sizeof expected);
    }
    close_cost(true);
}

// --part measures some viewpoints, and leaves the others to other machines.
static void a_part_judges_only_its_viewpoints(void **state) {
    (void)state;
    open_cost(SIDE, 1);
    assert_true(dip_cost_make_truths(&cost, NULL));
    assert_true(dip_cost_judge(&cost, NULL));
    for (int row = 0; row < ROWS; row++) {
        assert_false(report.rows[row].judged[0]);
        assert_true(report.rows[row].judged[1]);
    }
    for (int i = 0; i < PATHS * PLACES; i++) {
        assert_int_equal(report.has_floor[i], i % PLACES == 1);
    }
    close_cost(true);
}

static long journal_bytes(void) {
    FILE *file = fopen(FOLDER "/cost.state", "rb");
    assert_non_null(file);
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    const long bytes = ftell(file);
    fclose(file);
    return bytes;
}

static void measure(void) {
    open_cost(SIDE, 0);
    assert_true(dip_cost_judge(&cost, NULL));
    assert_true(dip_cost_time_rows(&cost, NULL));
}

// A second run finds all errors and times in the journal of the first, and measures nothing.
static void an_interrupted_report_goes_on_where_it_was(void **state) {
    (void)state;
    measure();
    const long bytes = journal_bytes();
    const DipMetricSums errors = report.rows[FILTERED].viewpoints[1];
    const int count = report.log_count;
    DipTimed *log = malloc((size_t)count * sizeof *log);
    assert_true(log && count > 0);
    memcpy(log, report.log, (size_t)count * sizeof *log);
    close_cost(false);
    measure();
    assert_int_equal(journal_bytes(), bytes);
    assert_memory_equal(&report.rows[FILTERED].viewpoints[1], &errors, sizeof errors);
    assert_int_equal(report.log_count, count);
    for (int i = 0; i < count; i++) {
        assert_int_equal(report.log[i].subject, log[i].subject);
        assert_int_equal(report.log[i].frame, log[i].frame);
        assert_true(report.log[i].ms == log[i].ms);
    }
    free(log);
    close_cost(true);
}

// --- times and work ------------------------------------------------------------------------------

// Asserts that counters are the means of those of all timed frames of a path.
static void assert_work(DipCostContext *context, const DipQuality *quality, int path,
                        const double *counters) {
    double expected[DIP_COUNTER_COUNT] = {0};
    for (int f = 0; f < FRAMES; f++) {
        DipFrame frame;
        assert_true(dip_cost_draw_timed(context, quality, path, f, &frame, NULL));
        dip_counters_add(&frame.counters, expected);
    }
    for (int c = 0; c < DIP_COUNTER_COUNT; c++) {
        assert_true(counters[c] == expected[c] / FRAMES);
    }
}

// Returns how many of a row's frames the log has.
static int timed_frames(int row) {
    int count = 0;
    for (int i = 0; i < report.log_count; i++) {
        count += report.log[i].subject == row;
    }
    return count;
}

static void every_row_is_timed_and_its_work_counted(void **state) {
    (void)state;
    open_cost(SIDE, 0);
    assert_true(dip_cost_time_rows(&cost, NULL));
    assert_int_equal(report.rounds, 2);
    assert_int_equal(report.starts, 1);
    for (int row = 0; row < ROWS; row++) {
        assert_work(&cost, &report.rows[row].quality, report.rows[row].path,
                    report.rows[row].counters);
        assert_true(report.rows[row].time.mean_ms.value > 0.0);
        assert_true(timed_frames(row) >= FRAMES);
    }
    // The other rows of a path are timed beside its base row, which is drawn more often than they.
    assert_true(timed_frames(BASE) > timed_frames(SAME));
    assert_true(timed_frames(OTHER_BASE) > timed_frames(OTHER_SAME));
    // More samples are more work; both rows of a path with the same settings have the same work.
    const double *base = report.rows[BASE].counters, *more = report.rows[ANTIALIASED].counters;
    assert_memory_equal(base, report.rows[SAME].counters, sizeof report.rows[SAME].counters);
    assert_memory_not_equal(base, more, sizeof report.rows[BASE].counters);
    close_cost(true);
}

// Rows that are new are timed beside the baseline, and their work is counted. Rows that are timed
// again keep their work, and get as many times once more.
static void further_times_join_those_of_the_report(void **state) {
    (void)state;
    open_cost(SIDE, 0);
    assert_true(dip_cost_time_rows(&cost, NULL));
    const long bytes = journal_bytes();
    DipQuality quality;
    assert_true(dip_quality_parse("aa=8", &quality, NULL));
    const int added = dip_cost_report_add_row(&report, &quality, 0, NULL);
    assert_int_equal(added, ROWS);
    assert_int_equal(timed_frames(added), 0);
    assert_true(dip_cost_time_more(&cost, &added, 1, 0, NULL));
    assert_true(timed_frames(added) >= FRAMES);
    assert_work(&cost, &quality, 0, report.rows[added].counters);
    const int again = ANTIALIASED, before = timed_frames(again);
    double counters[DIP_COUNTER_COUNT];
    memcpy(counters, report.rows[again].counters, sizeof counters);
    assert_true(dip_cost_time_more(&cost, &again, 1, 1, NULL));
    assert_true(timed_frames(again) >= before + FRAMES);
    assert_memory_equal(counters, report.rows[again].counters, sizeof counters);
    assert_int_equal(journal_bytes(), bytes); // The journal does not keep these times.
    assert_true(dip_cost_estimate_times(&report, NULL));
    assert_true(report.rows[added].time.mean_ms.value > 0.0);
    close_cost(true);
}

// The smaller pictures have half the width and height, and settings that add work at edges, in
// textures, and in both.
static void a_few_combinations_are_timed_at_half_the_size(void **state) {
    (void)state;
    static const char *const settings[] = {"", "aa=4", "af=16", "aa=8,aaa=on,asd=1,af=16"};
    open_cost(SIDE, 0);
    assert_true(dip_cost_time_rows(&cost, NULL));
    assert_true(dip_cost_time_smaller(&cost, NULL));
    assert_int_equal(report.smaller_count, 4);
    assert_int_equal(report.smaller_width, SIDE / 2);
    assert_int_equal(report.smaller_height, SIDE / 2);
    DipCostReport there;
    DipCostContext smaller;
    dip_cost_elsewhere_begin(&there, &report, SIDE / 2, SIDE / 2, report.paths[0]);
    assert_true(dip_cost_context_open(&smaller, &session, &there, false, NULL));
    for (int i = 0; i < 4; i++) {
        const DipQuality *quality = &report.smaller[i].quality;
        DipQuality expected;
        assert_true(dip_quality_parse(settings[i], &expected, NULL));
        if (memcmp(quality, &expected, sizeof expected) != 0) {
            char found[256];
            dip_quality_format(quality, found, sizeof found);
            fail_msg("combination %d is %s, expected %s", i, found, settings[i]);
        }
        assert_work(&smaller, quality, 0, report.smaller[i].counters);
        assert_true(report.smaller[i].ms.value > 0.0);
    }
    dip_cost_context_close(&smaller);
    close_cost(true);
    for (int side = 0; side < 2; side++) { // Small pictures are not halved.
        open_cost(SIDE, 0);
        *(side ? &report.width : &report.height) = SIDE - 1;
        assert_true(dip_cost_time_smaller(&cost, NULL));
        assert_int_equal(report.smaller_count, 0);
        close_cost(true);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_have_the_errors_of_their_own_pictures),
        cmocka_unit_test(hashes_of_errors_depend_on_the_truths),
        cmocka_unit_test(floors_are_sums_over_the_bursts),
        cmocka_unit_test(a_part_judges_only_its_viewpoints),
        cmocka_unit_test(an_interrupted_report_goes_on_where_it_was),
        cmocka_unit_test(every_row_is_timed_and_its_work_counted),
        cmocka_unit_test(further_times_join_those_of_the_report),
        cmocka_unit_test(a_few_combinations_are_timed_at_half_the_size),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
