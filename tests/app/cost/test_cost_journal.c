// Tests of the journal. This file stores the measurements of an unfinished cost report, so that
// they survive when the program is interrupted.
#include "app/cost/journal.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static const char plan[] = "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa";
static const char other_plan[] = "bbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbb";
static const char key[] = "0123456789abcdef0123456789abcdef";
static const char other_key[] = "1123456789abcdef0123456789abcdef";
static const DipTimed frames[2] = {
    {1, 2, 3, 4, 5, INT64_C(1) << 50, 1.0 / 3.0, 2e-9, 12345.678, 7.0, {0.1, 0.2, 0.3, 0.4}},
    {6, 0, 0, 0, 9, 12, 1e-5, 0.0, 0.25, 0.0, {0.0, 0.0, 0.0, 0.0}},
};
enum { SEED = 17 };

// Compares all members. The padding between them is not compared.
static void assert_same_timed(const DipTimed *a, const DipTimed *b) {
    assert_memory_equal(a, b, offsetof(DipTimed, frame) + sizeof a->frame);
    assert_memory_equal(&a->begin_ns, &b->begin_ns, sizeof *a - offsetof(DipTimed, begin_ns));
}

static DipCostBurstErrors make_errors(int seed) {
    DipCostBurstErrors errors;
    double *values = (double *)&errors;
    for (size_t i = 0; i < sizeof errors / sizeof *values; i++) {
        values[i] = ((double)i + seed) / 7.0;
    }
    return errors;
}

static DipCostJournal *open_journal(const char *name) {
    DipError err = {0};
    DipCostJournal *journal = dip_cost_journal_open(".", name, &err);
    assert_non_null(journal);
    return journal;
}

static void write_some(void) {
    DipCostJournal *journal = open_journal(plan);
    const DipCostBurstErrors errors = make_errors(1);
    assert_true(dip_cost_journal_add(journal, key, &errors, NULL));
    assert_true(dip_cost_journal_add_round(journal, SEED, frames, 2, NULL));
    dip_cost_journal_close(&journal, false);
}

static int remove_state(void **state) {
    (void)state;
    remove("cost.state");
    return 0;
}

static void stored_measurements_are_found_again(void **state) {
    (void)state;
    write_some();
    DipCostJournal *again = open_journal(plan);
    const DipCostBurstErrors expected = make_errors(1);
    DipCostBurstErrors errors;
    assert_true(dip_cost_journal_find(again, key, &errors));
    assert_memory_equal(&errors, &expected, sizeof errors);
    assert_false(dip_cost_journal_find(again, other_key, &errors));
    int count, seed = 0;
    assert_int_equal(dip_cost_journal_round_count(again, NULL), 1);
    DipTimed *timed = dip_cost_journal_round(again, 0, SEED, &count);
    assert_int_equal(count, 2);
    assert_same_timed(&timed[0], &frames[0]);
    assert_same_timed(&timed[1], &frames[1]);
    free(timed);
    timed = dip_cost_journal_round(again, 0, SEED + 1, &count); // The rounds of another seed.
    assert_int_equal(count, 0);
    free(timed);
    assert_int_equal(dip_cost_journal_round_count(again, &seed), 1);
    assert_int_equal(seed, SEED);
    dip_cost_journal_close(&again, false);
}

// The plan is a hash of everything that times depend on. A journal that is opened with another plan
// still finds the errors, which depend only on the pictures, but ignores the times.
static void times_of_another_plan_are_ignored(void **state) {
    (void)state;
    write_some();
    DipCostJournal *again = open_journal(other_plan);
    DipCostBurstErrors errors;
    assert_true(dip_cost_journal_find(again, key, &errors));
    int seed = 3;
    assert_int_equal(dip_cost_journal_round_count(again, &seed), 0);
    assert_int_equal(seed, 3);
    dip_cost_journal_close(&again, false);
}

static size_t file_size(void) {
    FILE *in = fopen("cost.state", "rb");
    assert_non_null(in);
    fseek(in, 0, SEEK_END);
    const size_t size = (size_t)ftell(in);
    fclose(in);
    return size;
}

// Cuts the file at many lengths in turn. Whole lines are read, an incomplete last line is removed,
// and new lines can be added.
static void an_incomplete_line_is_dropped(void **state) {
    (void)state;
    write_some();
    const size_t size = file_size();
    DipCostBurstErrors errors;
    for (size_t cut = 0; cut < size; cut += 31) {
        remove("cost.state");
        write_some();
        assert_int_equal(truncate("cost.state", (off_t)cut), 0);
        DipCostJournal *again = open_journal(plan);
        assert_int_equal(dip_cost_journal_round_count(again, NULL), 0);
        const bool had_errors = dip_cost_journal_find(again, key, &errors);
        const DipCostBurstErrors more = make_errors(9);
        assert_true(dip_cost_journal_add(again, other_key, &more, NULL));
        dip_cost_journal_close(&again, false);
        again = open_journal(plan);
        assert_true(dip_cost_journal_find(again, other_key, &errors));
        assert_memory_equal(&errors, &more, sizeof errors);
        assert_int_equal(dip_cost_journal_find(again, key, &errors), had_errors);
        dip_cost_journal_close(&again, false);
    }
}

static void a_changed_byte_drops_its_line(void **state) {
    (void)state;
    write_some();
    const size_t size = file_size();
    for (size_t at = 50; at < size - 1; at += 97) {
        remove("cost.state");
        write_some();
        FILE *change = fopen("cost.state", "r+b");
        assert_non_null(change);
        fseek(change, (long)at, SEEK_SET);
        const int byte = fgetc(change);
        fseek(change, (long)at, SEEK_SET);
        fputc(byte == '1' ? '2' : '1', change);
        fclose(change);
        DipCostJournal *again = open_journal(plan);
        DipCostBurstErrors errors;
        const bool has_errors = dip_cost_journal_find(again, key, &errors);
        const bool times = dip_cost_journal_round_count(again, NULL) > 0;
        assert_int_equal(has_errors + times, 1);
        dip_cost_journal_close(&again, false);
    }
}

static void a_finished_report_removes_the_journal(void **state) {
    (void)state;
    write_some();
    DipCostJournal *again = open_journal(plan);
    dip_cost_journal_close(&again, true);
    assert_int_not_equal(access("cost.state", F_OK), 0);
}

// Two runs that write into one folder would mix their measurements.
static void two_runs_into_one_folder_are_refused(void **state) {
    (void)state;
    DipError err = {0};
    DipCostJournal *first = open_journal(plan);
    assert_null(dip_cost_journal_open(".", plan, &err));
    assert_int_equal(err.code, DIP_ERROR_CONFLICT);
    assert_string_equal(err.key, "--out");
    const DipCostBurstErrors errors = make_errors(3);
    assert_true(dip_cost_journal_add(first, key, &errors, NULL));
    dip_cost_journal_close(&first, false);
    DipCostJournal *second = open_journal(plan); // It has what the first run wrote.
    DipCostBurstErrors found;
    assert_true(dip_cost_journal_find(second, key, &found));
    dip_cost_journal_close(&second, true);
    assert_int_not_equal(access("cost.state", F_OK), 0);
}

static void a_missing_folder_is_an_error(void **state) {
    (void)state;
    DipError err = {0};
    assert_null(dip_cost_journal_open("./none", plan, &err));
    assert_int_equal(err.code, DIP_ERROR_IO);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(stored_measurements_are_found_again, remove_state),
        cmocka_unit_test_teardown(times_of_another_plan_are_ignored, remove_state),
        cmocka_unit_test_teardown(an_incomplete_line_is_dropped, remove_state),
        cmocka_unit_test_teardown(a_changed_byte_drops_its_line, remove_state),
        cmocka_unit_test_teardown(a_finished_report_removes_the_journal, remove_state),
        cmocka_unit_test_teardown(two_runs_into_one_folder_are_refused, remove_state),
        cmocka_unit_test(a_missing_folder_is_an_error),
    };
    char folder[] = "/tmp/test_cost_state.XXXXXX";
    if (!mkdtemp(folder) || chdir(folder) != 0) {
        return 1;
    }
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return rmdir(folder) == 0 ? failed : 1;
}
