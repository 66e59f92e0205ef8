// Tests of results, tables, comparison and CSV. The expected numbers were computed by hand.
#include "app/bench/gap.h"
#include "app/bench/measure.h"
#include "app/bench/table.h"
#include "tests/app/bench/made_result.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static DipBenchPlan plan;

static bool print_times(void *context, FILE *out) {
    dip_bench_print_times(context, out);
    return true;
}

static bool print_work(void *context, FILE *out) {
    dip_bench_print_work(context, out);
    return true;
}

static bool print_gap(void *context, FILE *out) {
    dip_bench_print_gap(context, 0.5, out);
    return true;
}

static bool print_ratios(void *context, FILE *out) {
    const DipBenchResult *results = context;
    dip_bench_print_ratios(&results[0], &results[1], out);
    return true;
}

// Finds `name` in `text` and reads the numbers behind it on the same line. Returns how many there
// are.
static int numbers_after(const char *text, const char *name, double *numbers, int room) {
    const char *at = strstr(text, name);
    assert_non_null(at);
    at += strlen(name);
    int count = 0;
    while (count < room) {
        char *rest;
        const char *line_end = strchr(at, '\n');
        numbers[count] = strtod(at, &rest);
        if (rest == at || (line_end && rest > line_end)) {
            break;
        }
        at = rest;
        count++;
    }
    return count;
}

static void expect_near(double found, double expected) {
    if (!(found > expected - 0.00051 && found < expected + 0.00051)) {
        fail_msg("%g, expected %g", found, expected);
    }
}

// --- storage -----------------------------------------------------------------------------------

static void samples_are_found_where_they_were_put(void **state) {
    (void)state;
    DipBenchResult result;
    dip_made_plan(&plan, 3, 2);
    assert_true(dip_bench_result_init(&result, &plan, NULL));
    for (int c = 0; c < plan.count; c++) {
        for (int i = 0; i < 6; i++) {
            DipBenchSample sample = {.hash = ""};
            for (int stage = 0; stage < DIP_BENCH_STAGE_COUNT; stage++) {
                sample.ms[stage] = 1000.0 * c + 100.0 * stage + i;
            }
            DipTimed timed = {.round = i / 3, .frame = i % 3};
            dip_bench_sample_time(&sample, &timed);
            dip_bench_result_add(&result, c, &timed);
        }
    }
    for (int c = 0; c < plan.count; c++) {
        for (int stage = 0; stage < DIP_BENCH_STAGE_COUNT; stage++) {
            const double *ms = dip_bench_result_ms(&result, c, (DipBenchStage)stage);
            for (int i = 0; i < 6; i++) {
                assert_true(ms[i] == 1000.0 * c + 100.0 * stage + i);
            }
        }
    }
    dip_bench_result_free(&result);
}

// Frames fetch 10, 20 and 30 texels.
static void work_is_the_mean_over_frames(void **state) {
    (void)state;
    const double ms[3] = {1, 1, 1};
    double means[2];
    DipBenchResult result;
    dip_made_single_plan(&plan, 3, 1);
    dip_made_result(&result, &plan, ms);
    double work[DIP_COUNTER_COUNT];
    dip_bench_result_work(&result, 0, work);
    const double texels = work[DIP_COUNTER_texels_fetched];
    assert_true(texels > 19.999999 && texels < 20.000001);
    char *text = dip_printed(print_work, &result);
    assert_int_equal(numbers_after(text, "texels_fetched", means, 2), 1);
    expect_near(means[0], 20.0);
    free(text);
    dip_bench_result_free(&result);
}

// Frames of 4 and 12 ms in their fastest rounds, a quarter of each in every stage: 2 ms in the
// mean, which are 4 million cycles of 0.5 ns on one thread. The frames have 1000 and 3000
// triangles, so a triangle takes 2000 cycles; a probe takes 400 cycles. Work that was not counted
// has no gap.
static void gaps_are_cycles_per_unit_beside_the_floor(void **state) {
    (void)state;
    const double ms[4] = {40, 12, 4, 14};
    double numbers[2];
    DipBenchResult result;
    dip_made_single_plan(&plan, 2, 2);
    dip_made_result(&result, &plan, ms);
    for (int i = 0; i < 2; i++) {
        DipCounters *counters = &dip_bench_result_first(&result, 0, i)->counters;
        counters->triangles_in = 1000 + 2000 * (uint64_t)i;
        counters->texture_probes = 10000;
    }
    char *text = dip_printed(print_gap, &result);
    const char *row = strstr(text, "\n           1 ");
    assert_non_null(row);
    assert_int_equal(sscanf(row + 13, "%lf %lfx - - - - - -", &numbers[0], &numbers[1]), 2);
    expect_near(numbers[0], 2000.0);
    expect_near(numbers[1], 333.3); // the floor is 6 cycles
    const char *probe = strrchr(text, '-');
    assert_non_null(probe);
    assert_int_equal(sscanf(probe + 1, "%lf %lfx", &numbers[0], &numbers[1]), 2);
    expect_near(numbers[0], 400.0);
    expect_near(numbers[1], 60.4); // the floor is 106 / 16 cycles
    free(text);
    dip_bench_result_free(&result);
}

// --- tables ------------------------------------------------------------------------------------

// The times are 1, 2, 4, 5 and 10 ms. Their median is 4; the 95th percentile lies 0.8 of the way
// from 5 to 10.
static void quantiles_are_over_frames_and_rounds(void **state) {
    (void)state;
    const double ms[5] = {10, 1, 5, 2, 4};
    const struct {
        const char *name;
        double total;
    } lines[] = {{"median", 4.0}, {"p95", 9.0}, {"min", 1.0}};
    DipBenchResult result;
    dip_made_single_plan(&plan, 1, 5);
    dip_made_result(&result, &plan, ms);
    char *text = dip_printed(print_times, &result);
    for (int line = 0; line < 3; line++) {
        double numbers[DIP_BENCH_STAGE_COUNT + 1];
        // The ratio stands behind the median of the total.
        assert_int_equal(numbers_after(text, lines[line].name, numbers, DIP_BENCH_STAGE_COUNT + 1),
                         DIP_BENCH_STAGE_COUNT + (line == 0));
        expect_near(numbers[0], 0.25 * lines[line].total);
        expect_near(numbers[DIP_BENCH_STAGE_total], lines[line].total);
    }
    free(text);
    dip_bench_result_free(&result);
}

// There are two frames and three rounds. This program takes {2, 4}, {2, 4} and {3, 4} ms; the
// median is (3 + 4) / 2 = 3.5. The other program takes twice as long for each frame. Its fastest
// frames take 4 + 8 = 12 ms, those of this program 2 + 4 = 6 ms. The ratio is that of the result.
static void ratios_are_the_other_programs_time_over_this_ones(void **state) {
    (void)state;
    const double here_ms[6] = {2, 4, 2, 4, 3, 4};
    double other_ms[6];
    double numbers[10];
    DipBenchResult results[2];
    for (int i = 0; i < 6; i++) {
        other_ms[i] = 2.0 * here_ms[i];
    }
    dip_made_single_plan(&plan, 2, 3);
    dip_made_result(&results[0], &plan, here_ms);
    dip_made_result(&results[1], &plan, other_ms);
    results[1].ratios[0] = (DipEstimate){.value = 2.0, .low = 1.5, .high = 2.0};
    char *text = dip_printed(print_ratios, results);
    assert_int_equal(numbers_after(text, "aa=none", numbers, 4), 4);
    expect_near(numbers[0], 7.0);
    expect_near(numbers[1], 3.5);
    expect_near(numbers[2], 2.0);
    expect_near(numbers[3], 1.5);
    // The end of the interval, the ratio of the fastest frames, and the ratios of the four stages.
    assert_int_equal(numbers_after(text, " to ", numbers, 6), 6);
    for (int i = 0; i < 6; i++) {
        expect_near(numbers[i], 2.0);
    }
    assert_non_null(strstr(text, " same\n"));
    free(text);
    DipBenchSample changed = {.hash = "else"};
    *dip_bench_result_first(&results[1], 0, 1) = changed;
    text = dip_printed(print_ratios, results);
    assert_non_null(strstr(text, " 1 of 2 differ\n"));
    free(text);
    dip_bench_result_free(&results[0]);
    dip_bench_result_free(&results[1]);
}

// One slow round of three does not change the ratio of the fastest rounds. An interval that is not
// known is a dash.
static void the_fastest_rounds_ignore_noise(void **state) {
    (void)state;
    const double here_ms[3] = {1, 1, 1};
    const double other_ms[3] = {1, 50, 1};
    double fastest;
    DipBenchResult results[2];
    dip_made_single_plan(&plan, 1, 3);
    dip_made_result(&results[0], &plan, here_ms);
    dip_made_result(&results[1], &plan, other_ms);
    results[1].ratios[0] = dip_estimate_unknown(17.333);
    char *text = dip_printed(print_ratios, results);
    assert_int_equal(numbers_after(text, " 17.333                 - ", &fastest, 1), 1);
    expect_near(fastest, 1.0);
    free(text);
    dip_bench_result_free(&results[0]);
    dip_bench_result_free(&results[1]);
}

// --- CSV ---------------------------------------------------------------------------------------

static int count_lines(const char *text) {
    int count = 0;
    for (; (text = strchr(text, '\n')); text++) {
        count++;
    }
    return count;
}

static void csv_has_a_line_per_program_round_and_frame(void **state) {
    (void)state;
    static char text[65536];
    const double ms[4] = {1.5, 2.5, 3.5, 4.5};
    static const char file[] = "test_bench_results.csv";
    DipBenchResult results[2];
    dip_made_single_plan(&plan, 2, 2);
    dip_made_result(&results[0], &plan, ms);
    dip_made_result(&results[1], &plan, ms);
    for (int programs = 1; programs <= 2; programs++) {
        DipError err = {0};
        assert_true(dip_bench_write_csv(file, results, programs, &err));
        FILE *in = fopen(file, "rb");
        assert_non_null(in);
        text[fread(text, 1, sizeof text - 1, in)] = '\0';
        fclose(in);
        remove(file);
        assert_int_equal(count_lines(text), 1 + 4 * programs);
        assert_int_equal(strncmp(text, programs == 2 ? "program,settings," : "settings,", 9), 0);
        const char *line = "\"aa=none\",64,48,1,1,scalar,,1,0,0.8750,0.8750,0.8750,0.8750,3.5000,";
        const char *at = strstr(text, line);
        assert_non_null(at);
        if (programs == 2) {
            assert_int_equal(strncmp(at - 5, "this,", 5), 0);
            assert_non_null(strstr(text, "\nother,\"aa=none\",64,48,1,1,scalar,,1,1,"));
        }
    }
    dip_bench_result_free(&results[0]);
    dip_bench_result_free(&results[1]);
}

// --- measuring ---------------------------------------------------------------------------------

typedef struct FakeProgram {
    double factor;
    int hashed; // number of draws with a hash
    int drawn;  // number of all draws
    int other;  // the combination whose picture is another one in frame 2; 0: none
} FakeProgram;

static bool fake_draw(void *context, int combination, int frame, bool hash, DipBenchSample *sample,
                      DipError *err) {
    (void)err;
    FakeProgram *program = context;
    *sample = (DipBenchSample){.hash = ""};
    sample->ms[DIP_BENCH_STAGE_total] = program->factor * (10.0 * combination + frame + 1.0);
    sample->counters.texels_fetched = (uint64_t)(100 * combination + frame);
    if (hash) {
        // Combinations 2 i and 2 i + 1 differ in the number of threads only.
        snprintf(sample->hash, sizeof sample->hash, "%d/%d%s", combination / 2, frame,
                 program->other && combination == program->other && frame == 2 ? " other" : "");
        program->hashed++;
    }
    program->drawn++;
    return true;
}

static void each_program_fills_its_own_result(void **state) {
    (void)state;
    dip_made_plan(&plan, 3, 2);
    for (int count = 1; count <= 2; count++) {
        FakeProgram programs[2] = {{1.0, 0, 0, 0}, {3.0, 0, 0, 0}};
        const DipBenchSource sources[2] = {{fake_draw, &programs[0]}, {fake_draw, &programs[1]}};
        DipBenchResult results[2];
        for (int p = 0; p < count; p++) {
            assert_true(dip_bench_result_init(&results[p], &plan, NULL));
        }
        assert_true(dip_bench_measure(&plan, sources, count, results, NULL));
        for (int p = 0; p < count; p++) {
            assert_int_equal(programs[p].hashed, 8 * 3);
            // If one program is measured alone, each visit begins with one untimed frame, and the
            // base has a visit in both blocks of a round.
            assert_int_equal(programs[p].drawn, 8 * 3 + 2 * (count == 1 ? 9 * 4 : 8 * 3));
            for (int c = 0; c < plan.count; c++) {
                const double *ms = dip_bench_result_ms(&results[p], c, DIP_BENCH_STAGE_total);
                for (int i = 0; i < 6; i++) {
                    assert_true(ms[i] == programs[p].factor * (10.0 * c + i % 3 + 1.0));
                }
                const DipBenchSample *first = dip_bench_result_first(&results[p], c, 2);
                assert_int_equal(first->counters.texels_fetched, 100 * c + 2);
                assert_int_equal(first->hash[2], '2');
            }
            dip_bench_result_free(&results[p]);
        }
    }
}

// The mean times of combination c are 10 c + 2 ms.
static void rows_are_compared_with_the_base_and_with_the_fewest_threads(void **state) {
    (void)state;
    dip_made_plan(&plan, 3, 4);
    FakeProgram programs[2] = {{1.0, 0, 0, 0}, {3.0, 0, 0, 0}};
    const DipBenchSource sources[2] = {{fake_draw, &programs[0]}, {fake_draw, &programs[1]}};
    DipBenchResult results[2];
    assert_true(dip_bench_result_init(&results[0], &plan, NULL));
    assert_true(dip_bench_result_init(&results[1], &plan, NULL));
    assert_true(dip_bench_measure(&plan, sources, 1, results, NULL));
    for (int c = 0; c < plan.count; c++) {
        expect_near(results[0].ratios[c].value / (5.0 * c + 1.0), 1.0);
        const double fewest = c % 2 ? (10.0 * (c - 1) + 2.0) / (10.0 * c + 2.0) : 1.0;
        expect_near(results[0].speed_ups[c].value, fewest);
    }
    assert_true(isnan(results[0].ratios[0].low)); // The base itself.
    assert_true(results[0].ratios[3].low < results[0].ratios[3].value);
    double numbers[2];
    char *text = dip_printed(print_times, &results[0]);
    assert_int_equal(numbers_after(text, " 1.000              base    1.000", numbers, 1), 0);
    assert_int_equal(numbers_after(text, " to 6.", numbers, 2), 2);
    expect_near(numbers[1], 2.0 / 12.0);
    free(text);
    assert_true(dip_bench_measure(&plan, sources, 2, results, NULL));
    for (int c = 0; c < plan.count; c++) {
        expect_near(results[1].ratios[c].value, 3.0);
    }
    dip_bench_result_free(&results[0]);
    dip_bench_result_free(&results[1]);
}

static void other_pictures_end_the_measurement(void **state) {
    (void)state;
    dip_made_plan(&plan, 3, 2);
    for (int program = 0; program < 2; program++) {
        FakeProgram programs[2] = {{1.0, 0, 0, program == 0 ? 3 : 0},
                                   {1.0, 0, 0, program == 1 ? 3 : 0}};
        const DipBenchSource sources[2] = {{fake_draw, &programs[0]}, {fake_draw, &programs[1]}};
        DipBenchResult results[2];
        DipError err = {0};
        assert_true(dip_bench_result_init(&results[0], &plan, NULL));
        assert_true(dip_bench_result_init(&results[1], &plan, NULL));
        // The other program's pictures are not this program's fault.
        assert_int_equal(dip_bench_measure(&plan, sources, 2, results, &err), program == 1);
        if (program == 0) {
            assert_int_equal(err.code, DIP_ERROR_RUNTIME);
            assert_string_equal(err.message,
                                "the picture of frame 2 with 64x48, aa=4, 2 threads has the hash "
                                "1/2 other, but row 3 has 1/2; they must be the same");
        }
        dip_bench_result_free(&results[0]);
        dip_bench_result_free(&results[1]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_are_found_where_they_were_put),
        cmocka_unit_test(gaps_are_cycles_per_unit_beside_the_floor),
        cmocka_unit_test(work_is_the_mean_over_frames),
        cmocka_unit_test(quantiles_are_over_frames_and_rounds),
        cmocka_unit_test(ratios_are_the_other_programs_time_over_this_ones),
        cmocka_unit_test(the_fastest_rounds_ignore_noise),
        cmocka_unit_test(csv_has_a_line_per_program_round_and_frame),
        cmocka_unit_test(each_program_fills_its_own_result),
        cmocka_unit_test(rows_are_compared_with_the_base_and_with_the_fewest_threads),
        cmocka_unit_test(other_pictures_end_the_measurement),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
