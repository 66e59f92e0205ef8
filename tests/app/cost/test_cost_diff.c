// Comparing two made-up reports that differ in one thing, and finding the cause of a slowdown whose
// prices are known.
#include "app/cost/diff/diff.h"
#include "tests/app/cost/made_report.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cjson/cJSON.h>
#include <cmocka.h>

#include <math.h>

enum { ROUNDS = 16 };

static DipCostReport a, b;
static DipCostDiff diff;

// Makes two equal reports. A test then changes b.
static void make(void) {
    dip_made_report(&a, ROUNDS);
    dip_made_report(&b, ROUNDS);
    diff = (DipCostDiff){.names = {"A", "B"}, .limit = 1.01, .fail_over = 1.03};
}

static void compare(void) {
    assert_true(dip_cost_estimate_times(&b, NULL));
    assert_true(dip_cost_diff_reports(&a, &b, &diff, NULL));
}

static void done(void) {
    dip_cost_diff_free(&diff);
    dip_cost_report_free(&a);
    dip_cost_report_free(&b);
}

static int group(DipCostDiffGroup groups[DIP_COST_DIFF_QUANTITY_COUNT]) {
    return dip_cost_diff_group(&diff, groups);
}

static bool has_note(const char *part) {
    for (int i = 0; i < diff.note_count; i++) {
        if (strstr(diff.notes[i], part)) {
            return true;
        }
    }
    return false;
}

static DipCostDiffGroup groups[DIP_COST_DIFF_QUANTITY_COUNT];

// --- a report and a program ----------------------------------------------------------------------

// Measures the report again with a program that only records its arguments. Writes these and the
// error.
static void measure(const DipCostDiffArguments *arguments, char recorded[4096], DipError *err) {
    char folder[] = "/tmp/test_cost_diff.XXXXXX", program[64], file[64];
    DipCostReport measured;
    assert_non_null(mkdtemp(folder));
    snprintf(program, sizeof program, "%s/program", folder);
    snprintf(file, sizeof file, "%s/arguments", folder);
    FILE *out = fopen(program, "w");
    assert_non_null(out);
    fprintf(out, "#!/bin/sh\necho \"$@\" >%s\nexit 2\n", file);
    assert_true(fclose(out) == 0 && chmod(program, 0700) == 0);
    assert_false(dip_cost_diff_measure_report(arguments, program, &a, &measured, err));
    FILE *in = fopen(file, "r");
    assert_non_null(in);
    recorded[fread(recorded, 1, 4095, in)] = '\0';
    fclose(in);
    assert_true(unlink(file) == 0 && unlink(program) == 0 && rmdir(folder) == 0);
}

// Every option that says what the programs draw reaches them: all options of the tables of which
// the command line consists.
static void every_option_of_the_scene_reaches_the_program(void **state) {
    (void)state;
    static const DipOptionTable *const tables[] = {
        &dip_scene_option_table, &dip_path_option_table, &dip_category_option_table,
        &dip_size_option_table, &dip_threads_option_table};
    DipCostDiffArguments arguments = {.set_count = 1, .measure.starts = 2};
    DipError err = {0};
    char recorded[4096], expected[512], name[64];
    arguments.session = (DipSessionOptions){.config = "c.ini",
                                            .models = {"a.glb", "b.glb"},
                                            .model_count = 2,
                                            .scene = "s",
                                            .look = 1,
                                            .up = (DipUpAxis)1,
                                            .has_shading = true,
                                            .import_seconds = 5,
                                            .force_all_effects = true,
                                            .no_ground = true,
                                            .animation = "walk",
                                            .has_animation_time = true,
                                            .animation_time_s = 1.5,
                                            .path = "p.pth",
                                            .category = "AF",
                                            .has_size = true,
                                            .size = {8, 6},
                                            .has_threads = true,
                                            .threads = 2,
                                            .has_isa = true};
    assert_true(dip_quality_parse("aa=4", &arguments.sets[0].quality, NULL));
    make();
    measure(&arguments, recorded, &err);
    snprintf(expected, sizeof expected,
             " --config c.ini --model a.glb --model b.glb --scene s --look 2 --up %s --shading %s "
             "--import-seconds 5 --force-all-effects --no-ground --animation walk "
             "--animation-time 1.5 --path p.pth --category AF --size 8x6 --threads 2 --isa %s ",
             dip_up_axis_names[1], dip_model_shading_names[0], dip_isa_name((DipIsa)0));
    if (!strstr(recorded, expected)) {
        fail_msg("the program got%s, expected%s", recorded, expected);
    }
    for (size_t t = 0; t < sizeof tables / sizeof *tables; t++) {
        for (size_t i = 0; i < tables[t]->count; i++) {
            snprintf(name, sizeof name, " %s ", tables[t]->rows[i].name);
            if (!strstr(recorded, name)) {
                fail_msg("the program did not get%s", name);
            }
        }
    }
    done();
}

// The report knows only the name of a path that --path gave. The program gets this name, with a
// model, too. If it does not start, the error says what the user may have to add.
static void a_path_of_the_report_is_asked_for(void **state) {
    (void)state;
    char recorded[4096];
    for (int models = 0; models < 2; models++) {
        for (int given = 0; given < 3; given++) {
            DipCostDiffArguments arguments = {
                .session = {.models = {"m.glb"}, .model_count = models}, .set_count = 1};
            DipError err = {0};
            arguments.measure.starts = 2;
            assert_true(dip_quality_parse("aa=4", &arguments.sets[0].quality, NULL));
            make();
            strcpy(a.paths[0], given == 2 ? "AF" : "tour");
            arguments.session.path = given == 1 ? "far/tour.pth" : NULL;
            measure(&arguments, recorded, &err);
            assert_true((strstr(recorded, " --path tour ") != NULL) == (given == 0));
            assert_true((strstr(recorded, " --path far/tour.pth ") != NULL) == (given == 1));
            assert_true((strstr(recorded, " --category AF ") != NULL) == (given == 2 && !models));
            assert_true((strstr(err.message, "\"tour\" of the report, give the path's file or "
                                             "camera with --path") != NULL) == (given == 0));
            done();
        }
    }
}

// --- what differs --------------------------------------------------------------------------------

static void equal_reports_do_not_differ(void **state) {
    (void)state;
    make();
    // Two reports may add up the same whole numbers in another order.
    b.rows[2].counters[3] = nextafter(b.rows[2].counters[3], INFINITY);
    compare();
    assert_int_equal(diff.row_count, 4); // The A/A rows are left out.
    assert_int_equal(diff.note_count, 0);
    assert_int_equal(group(groups), 0);
    assert_int_equal(diff.slower + diff.faster + diff.failed_times + diff.failed_errors, 0);
    for (int r = 0; r < 4; r++) {
        assert_true(diff.rows[r].timed && diff.rows[r].change.value == 1.0);
    }
    done();
}

static void one_error_is_named(void **state) {
    (void)state;
    make();
    // Only viewpoint 0 and 2 are judged, with 10 pixels each. aa=4 is row 3.
    a.rows[3].viewpoints[0].regions[0].flip = 1.0;
    a.rows[3].viewpoints[2].regions[0].flip = 1.0;
    b.rows[3].viewpoints[0].regions[0].flip = 1.0;
    b.rows[3].viewpoints[2].regions[0].flip = 1.1;
    compare();
    assert_int_equal(group(groups), 1);
    assert_string_equal(groups[0].which, "1 of 4 rows: aa=4 on path DEFAULT");
    assert_int_equal(groups[0].change_count, 1);
    const DipCostDiffChange *change = &groups[0].changes[0];
    assert_int_equal(change->quantity, DIP_COST_DIFF_flip);
    assert_true(fabs(change->most - 0.05) < 1e-12);
    assert_true(fabs(diff.rows[change->greatest].values[1][DIP_COST_DIFF_flip] - 0.105) < 1e-12);
    assert_int_equal(diff.failed_errors, 1);
    diff.fail_over = 1.06;
    dip_cost_diff_mark(&diff);
    assert_int_equal(diff.failed_errors, 0);
    done();
}

static void one_counter_is_named_with_its_rows(void **state) {
    (void)state;
    make();
    const int frames = dip_cost_frame_count(&b);
    b.rows[2].counters[4] += 1.0 / frames; // One triangle in one frame.
    b.rows[3].counters[4] *= 1.5;
    a.rows[1].counters[4] += 7.0; // An A/A row does not count.
    compare();
    assert_int_equal(group(groups), 1);
    assert_string_equal(groups[0].which, "all 2 rows with aa other than none");
    assert_int_equal(groups[0].changes[0].quantity, DIP_COST_DIFF_FIRST_COUNTER + 4);
    assert_int_equal(groups[0].changes[0].rows, 2);
    assert_true(fabs(groups[0].changes[0].most - 0.5) < 1e-12);
    assert_int_equal(diff.failed_errors + diff.failed_times, 0);
    done();
}

static void counters_that_one_side_lacks_are_left_out(void **state) {
    (void)state;
    make();
    for (int r = 0; r < b.row_count; r++) {
        a.rows[r].counters[7] = 5.0;
        b.rows[r].counters[7] = 0.0;
        b.rows[r].counters[8] = 0.0;
        a.rows[r].counters[8] = r == 2 ? 3.0 : 0.0; // Counted, but rarely used.
    }
    compare();
    assert_true(has_note("counters that are 0 in all rows of B only"));
    assert_int_equal(group(groups), 1);
    assert_int_equal(groups[0].change_count, 1);
    assert_int_equal(groups[0].changes[0].quantity, DIP_COST_DIFF_FIRST_COUNTER + 8);
    done();
}

static void counters_of_one_path_are_one_group(void **state) {
    (void)state;
    make();
    for (int r = 0; r < 4; r++) {
        b.rows[r].counters[2] += 1.0;
        b.rows[r].counters[5] += 1.0;
    }
    b.rows[4].counters[3] += 1.0;
    compare();
    assert_int_equal(group(groups), 2);
    assert_string_equal(groups[0].which, "all 3 rows on path DEFAULT");
    assert_int_equal(groups[0].change_count, 2);
    assert_string_equal(groups[1].which, "1 of 4 rows: defaults on path AA");
    done();
}

static void a_ratio_is_slower_beyond_the_luck_of_a_start(void **state) {
    (void)state;
    make();
    dip_made_times(&b, 3, 4.0 * 1.08);
    dip_made_times(&b, 2, 3.0 * 1.02); // Within the luck of a start and the limit.
    compare();
    assert_int_equal(diff.slower, 1);
    assert_int_equal(diff.failed_times, 1);
    const DipCostDiffRow *row = &diff.rows[2];
    assert_int_equal(row->mark, DIP_COST_DIFF_SLOWER);
    assert_true(fabs(row->change.value - 1.08) < 1e-12);
    // Each report's error is .001, and the luck is .006, with t of 15 degrees of
    // freedom: 2.13144955 (Abramowitz and Stegun, table 26.10).
    const double half = 2.13144955 * sqrt(0.001 * 0.001 * 2.0 + 0.006 * 0.006);
    assert_true(fabs(log(row->change.high / row->change.value) - half) < 1e-8);
    assert_true(row->surely_above < row->change.low); // All rows are judged together.
    done();
    make();
    dip_made_times(&b, 3, 4.0 / 1.08);
    compare();
    assert_int_equal(diff.faster, 1);
    assert_int_equal(diff.failed_times, 0);
    done();
}

static void rows_and_paths_that_do_not_match_are_named(void **state) {
    (void)state;
    make();
    strcpy(b.path_hashes[0], "00000000000000000000000000000001");
    strcpy(a.path_hashes[0], "00000000000000000000000000000002");
    b.rows[3].quality.step[DIP_SETTING_AA] = 4;
    b.rows[2].counters[1] += 5.0;
    compare();
    assert_true(has_note("poses differ on path DEFAULT"));
    assert_true(has_note("settings only in A: aa=4 on DEFAULT"));
    assert_true(has_note("settings only in B: aa=8 on DEFAULT"));
    assert_int_equal(group(groups), 0); // The rows of the path are not compared.
    done();
    make();
    strcpy(b.paths[1], "AF");
    compare();
    assert_true(has_note("path only in A: AA") && has_note("path only in B: AF"));
    done();
}

// Notes name settings whole, however long their texts are. Settings that do not fit are counted.
static void notes_do_not_cut_settings(void **state) {
    (void)state;
    static const char *const texts[] = {
        "aa=4,aaa=coverage,af=16,miplod=sharper,shadows=2048",
        "taa=alternate,opt=standard,miplod=high-performance,scale=1/1.7,upscale=bicubic,post=fxaa,"
        "sharpen=medium,shadows=1024,gi=off,mipdebug=on"};
    char wanted[2 * DIP_COST_TEXT];
    make();
    for (int i = 0; i < 2; i++) {
        assert_true(dip_quality_parse(texts[i], &b.rows[2 + i].quality, NULL));
    }
    compare();
    snprintf(wanted, sizeof wanted, "settings only in B: %s on DEFAULT; %s on DEFAULT", texts[0],
             texts[1]);
    assert_true(has_note(wanted));
    done();
    make();
    for (int i = 0; i < 6; i++) { // Two of these texts take 250 bytes, and all six do not fit.
        DipQuality quality;
        assert_true(dip_quality_parse(texts[1], &quality, NULL));
        quality.step[DIP_SETTING_AF] = (uint8_t)(i % 5);
        quality.step[DIP_SETTING_AA] = (uint8_t)(i / 5);
        dip_made_combination(&b, &quality, 2.0, 0.01);
    }
    compare();
    assert_true(has_note("settings only in B: 6 rows: ") && has_note("on DEFAULT; ..."));
    done();
}

static void other_scenes_and_sizes_are_not_compared(void **state) {
    (void)state;
    for (int which = 0; which < 3; which++) {
        make();
        strcpy(which == 0 ? b.scene_hash : b.version, "ffff");
        b.width += which == 1;
        b.options.samples += which == 2 ? 17 : 0;
        dip_made_times(&b, 3, 8.0);
        b.rows[2].viewpoints[0].regions[0].flip *= 2.0;
        compare();
        assert_true(has_note(which == 0   ? "scene differs: A has made up"
                             : which == 1 ? "size differs: A has 64x48 pixels, B has 65x48"
                                          : "errors are not compared: A has 3 viewpoints"));
        assert_int_equal(group(groups), 0);
        assert_int_equal(diff.slower, which == 2); // Times do not depend on the truth.
        done();
    }
}

static void other_machines_are_shown_but_not_judged(void **state) {
    (void)state;
    make();
    strcpy(b.isa, "avx2");
    dip_made_times(&b, 3, 8.0);
    compare();
    assert_false(diff.same_machine);
    assert_int_equal(diff.slower + diff.failed_times, 0);
    assert_true(fabs(diff.rows[2].change.value - 2.0) < 1e-12);
    done();
}

static void a_red_machine_gives_no_verdict(void **state) {
    (void)state;
    make();
    b.machine.wait = 0.5;
    dip_made_times(&b, 3, 8.0);
    compare();
    assert_true(dip_cost_diff_is_busy(&diff));
    assert_int_equal(diff.slower + diff.failed_times, 0);
    done();
}

static void psnr_and_ssim_grow_like_errors(void **state) {
    (void)state;
    DipCostDiffRow row = {.values = {{0}}};
    row.values[0][DIP_COST_DIFF_psnr] = 40.0;
    row.values[1][DIP_COST_DIFF_psnr] = 20.0; // Ten times the difference.
    row.values[0][DIP_COST_DIFF_ssim] = 0.75;
    row.values[1][DIP_COST_DIFF_ssim] = 0.5;
    assert_true(fabs(dip_cost_diff_growth(&row, DIP_COST_DIFF_psnr) - 9.0) < 1e-12);
    assert_true(fabs(dip_cost_diff_growth(&row, DIP_COST_DIFF_ssim) - 1.0) < 1e-12);
    row.values[1][DIP_COST_DIFF_flip] = NAN;
    assert_true(dip_cost_diff_growth(&row, DIP_COST_DIFF_flip) == 0.0);
}

// --- output --------------------------------------------------------------------------------------

static void read_back(const char *file, char *text, size_t size) {
    FILE *in = fopen(file, "rb");
    assert_non_null(in);
    text[fread(text, 1, size - 1, in)] = '\0';
    fclose(in);
}

static void table_and_json_say_the_same(void **state) {
    (void)state;
    static char text[1 << 16];
    make();
    dip_made_times(&b, 3, 5.0);
    b.rows[2].counters[1] += 5.0;
    compare();
    FILE *out = fopen("test_cost_diff.txt", "wb");
    assert_non_null(out);
    assert_true(dip_cost_diff_print(&diff, out, NULL));
    fclose(out);
    read_back("test_cost_diff.txt", text, sizeof text);
    assert_non_null(strstr(text, "1 of 4 rows: aa=2 on path DEFAULT:\n"));
    assert_non_null(strstr(text, "1 of 4 rows are slower in B and 0 are faster"));
    assert_true(dip_cost_diff_write_json(&diff, "test_cost_diff.json", NULL));
    read_back("test_cost_diff.json", text, sizeof text);
    cJSON *root = cJSON_Parse(text);
    const cJSON *rows = cJSON_GetObjectItem(root, "rows");
    assert_int_equal(cJSON_GetArraySize(rows), 4);
    const cJSON *row = cJSON_GetArrayItem(rows, 2);
    assert_string_equal(cJSON_GetObjectItem(row, "mark")->valuestring, "slower");
    assert_true(fabs(cJSON_GetObjectItem(row, "change")->valuedouble - 1.25) < 1e-12);
    assert_int_equal(
        cJSON_GetArraySize(cJSON_GetObjectItem(cJSON_GetArrayItem(rows, 1), "differences")), 1);
    assert_int_equal(cJSON_GetObjectItem(root, "slower")->valueint, 1);
    cJSON_Delete(root);
    remove("test_cost_diff.txt");
    remove("test_cost_diff.json");
    done();
}

// --- causes --------------------------------------------------------------------------------------

enum { CAUSE_ROWS = 8, STARTS = 6, KINDS = 4 };

// Kinds: one per frame, texels, probes in proportion to texels, samples. The texels and samples are
// those of the courtyard with the default sets of `cost diff`.
static const double work[KINDS * CAUSE_ROWS] = {
    1.0,  1.0,  1.0,  1.0,  1.0,  1.0,  1.0,  1.0,  // per frame
    4.89, 5.45, 5.59, 9.32, 10.9, 6.82, 3.59, 15.0, // texels
    0.49, 0.55, 0.56, 0.93, 1.09, 0.68, 0.36, 1.5,  // probes
    0.31, 1.25, 2.50, 0.31, 2.50, 2.50, 0.31, 2.5,  // samples
};

static uint32_t random_state = 1;

// Roughly normal, with standard deviation 1: the sum of 12 uniform shares.
static double random_normal(void) {
    double sum = -6.0;
    for (int i = 0; i < 12; i++) {
        random_state = random_state * 1664525u + 1013904223u;
        sum += (random_state >> 8) * 0x1p-24;
    }
    return sum;
}

static DipCause find(const double prices[KINDS], double noise) {
    double per_start[CAUSE_ROWS * STARTS];
    for (int r = 0; r < CAUSE_ROWS; r++) {
        double time = 0.0;
        for (int k = 0; k < KINDS; k++) {
            time += prices[k] * work[k * CAUSE_ROWS + r];
        }
        for (int s = 0; s < STARTS; s++) {
            per_start[r * STARTS + s] = time + noise * random_normal();
        }
    }
    DipCause cause;
    const DipCauseData data = {CAUSE_ROWS, STARTS, KINDS, per_start, work};
    assert_true(dip_cause_find(&data, &cause, NULL));
    return cause;
}

static void the_work_that_costs_more_is_the_cause(void **state) {
    (void)state;
    DipCause cause = find((const double[KINDS]){0.0, 0.03, 0.0, 0.0}, 0.02);
    assert_int_equal(cause.kind, 1);
    assert_true(fabs(cause.price - 0.03) < 0.003 && cause.share > 0.9);
    cause = find((const double[KINDS]){0.0, 0.0, 0.3, 0.0}, 0.02);
    assert_int_equal(cause.kind, 1); // Probes are proportional to texels and cannot be told apart.
    cause = find((const double[KINDS]){0.0, 0.0, 0.0, 0.1}, 0.02);
    assert_int_equal(cause.kind, 3);
    cause = find((const double[KINDS]){0.2, 0.0, 0.0, 0.0}, 0.02);
    assert_int_equal(cause.kind, 0);
}

static void noise_and_mixtures_have_no_sure_cause(void **state) {
    (void)state;
    int sure = 0;
    for (int i = 0; i < 200; i++) {
        sure += find((const double[KINDS]){0}, 0.05).kind >= 0;
    }
    assert_true(sure <= 4);
    const DipCause cause = find((const double[KINDS]){0.0, 0.01, 0.0, -0.1}, 0.02);
    assert_int_equal(cause.kind, -1);
}

// Two kinds of work that are nearly proportional (the cosine of their angle is .998): the
// additional time grows with the first, but the noise is as large as what tells them apart. The
// wrong kind wins about every third time; it is rarely called sure.
static void doubtful_causes_are_not_sure(void **state) {
    (void)state;
    double pair[2 * CAUSE_ROWS], per_start[CAUSE_ROWS * STARTS];
    int wrong = 0;
    for (int r = 0; r < CAUSE_ROWS; r++) {
        pair[r] = work[CAUSE_ROWS + r];
        pair[CAUSE_ROWS + r] = pair[r] * (r % 2 ? 1.06 : 0.94);
    }
    const DipCauseData data = {CAUSE_ROWS, STARTS, 2, per_start, pair};
    for (int i = 0; i < 200; i++) {
        DipCause cause;
        for (int j = 0; j < CAUSE_ROWS * STARTS; j++) {
            per_start[j] = 0.03 * pair[j / STARTS] + 0.1 * random_normal();
        }
        assert_true(dip_cause_find(&data, &cause, NULL));
        wrong += cause.kind == 1;
    }
    assert_in_range(wrong, 0, 30);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_option_of_the_scene_reaches_the_program),
        cmocka_unit_test(a_path_of_the_report_is_asked_for),
        cmocka_unit_test(equal_reports_do_not_differ),
        cmocka_unit_test(one_error_is_named),
        cmocka_unit_test(one_counter_is_named_with_its_rows),
        cmocka_unit_test(counters_that_one_side_lacks_are_left_out),
        cmocka_unit_test(counters_of_one_path_are_one_group),
        cmocka_unit_test(a_ratio_is_slower_beyond_the_luck_of_a_start),
        cmocka_unit_test(rows_and_paths_that_do_not_match_are_named),
        cmocka_unit_test(notes_do_not_cut_settings),
        cmocka_unit_test(other_scenes_and_sizes_are_not_compared),
        cmocka_unit_test(other_machines_are_shown_but_not_judged),
        cmocka_unit_test(a_red_machine_gives_no_verdict),
        cmocka_unit_test(psnr_and_ssim_grow_like_errors),
        cmocka_unit_test(table_and_json_say_the_same),
        cmocka_unit_test(the_work_that_costs_more_is_the_cause),
        cmocka_unit_test(doubtful_causes_are_not_sure),
        cmocka_unit_test(noise_and_mixtures_have_no_sure_cause),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
