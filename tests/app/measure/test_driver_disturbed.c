// What the timing driver does with frames whose threads waited.
#include "tests/app/measure/driver_machine.h"

#include <math.h>
#include <string.h>

static void a_few_disturbed_frames_are_left(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    made.busy_round = 2; // 2 of 20 frames: more than three quarters are left.
    work_until_done(&def);
    const DipTimes times = dip_driver_times(driver);
    const DipDriverMachine machine = dip_driver_machine(driver, 1);
    assert_int_equal(machine.repeated, 0);
    assert_true(machine.wait > 0.05 && machine.wait < 0.1);
    for (int i = 0; i < times.count; i++) {
        const bool busy = round_of(&times.list[i]) == 2;
        assert_true(busy ? fabs(times.list[i].wait - 0.5) < 1e-6 && times.list[i].switches == 3.0
                         : times.list[i].wait == 0.0);
    }
    DipTimesFit *fit = dip_times_fit(&times, NULL);
    assert_non_null(fit);
    assert_int_equal(dip_times_along(fit, 3).kept, PATH - PER_ROUND);
    dip_times_fit_free(&fit);
}

static void many_disturbed_frames_are_drawn_again(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    made.busy_at_first = true;
    work_until_done(&def);
    // Eight rounds reach three quarters of ten; then no more are repeated.
    assert_int_equal(made.kept_rounds, ALL_ROUNDS + 8);
    assert_int_equal(made.start_count, STARTS);
    const DipTimes times = dip_driver_times(driver);
    assert_true(dip_driver_machine(driver, 1).repeated > 0);
    DipTimesFit *fit = dip_times_fit(&times, NULL);
    assert_non_null(fit);
    for (int s = 0; s < SUBJECTS; s++) {
        const DipAlong along = dip_times_along(fit, s);
        assert_true(bases[s] == s || (along.timed == PATH && along.kept == 16));
    }
    dip_times_fit_free(&fit);
    int again = 0;
    for (int i = 0; i < times.count; i++) {
        again += times.list[i].block >= SUBJECTS;
        assert_true(times.list[i].block < SUBJECTS || times.list[i].wait == 0.0);
    }
    assert_true(again > 0);
}

// Only the base waits, and so do the frames beside it.
static void frames_beside_a_disturbed_base_are_drawn_again(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    made.busy_at_first = true;
    made.busy_subject = 9;
    work_until_done(&def);
    assert_int_equal(made.kept_rounds, ALL_ROUNDS + 8);
    const DipTimes times = dip_driver_times(driver);
    for (int i = 0; i < times.count; i++) {
        assert_true(times.list[i].block < SUBJECTS || bases[times.list[i].subject] == 9);
    }
}

static void worse_repetitions_are_not_kept(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    made.busy_at_first = made.busy_again = true;
    work_until_done(&def);
    const DipTimes times = dip_driver_times(driver);
    int first = 0;
    for (int i = 0; i < times.count; i++) {
        assert_true(times.list[i].wait < 0.6);
        first += times.list[i].block >= SUBJECTS && round_of(&times.list[i]) == 0;
    }
    assert_int_equal(first, 0);
    assert_int_equal(made.kept_rounds, ALL_ROUNDS + 9);
}

// The first repetitions show that the machine is still busy, so there are no more.
static void a_machine_that_stays_busy_repeats_little(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    made.busy_always = true;
    work_until_done(&def);
    assert_int_equal(made.kept_rounds, ALL_ROUNDS + 2);
}

// A base is drawn first, last and between in about equally many of its blocks.
static void visits_of_a_block_have_no_fixed_order(void **state) {
    (void)state;
    const DipDriverDef def = {.subjects = 5,
                              .base_of = bases,
                              .block_subjects = 4,
                              .starts = 1,
                              .rounds = 100,
                              .frames = 1,
                              .seed = 5};
    int at[5] = {0};
    work_until_done(&def);
    for (int i = 0; i < made.turn_count; i++) {
        at[i / 2 % 5] += made.turns[i].subject == 0 && made.turns[i].phase == DIP_DRIVER_TIMED;
    }
    for (int i = 0; i < 5; i++) {
        assert_in_range(at[i], 8, 35); // About 20 are expected.
    }
    static DipDriverTurn first[MOST_TURNS];
    memcpy(first, made.turns, sizeof first);
    DipDriverDef other = def;
    other.seed = 6;
    machine_tear_down(NULL);
    machine_set_up(NULL);
    work_until_done(&other);
    assert_memory_not_equal(first, made.turns, sizeof first);
}

static void without_a_limit_nothing_is_disturbed(void **state) {
    (void)state;
    DipDriverDef def = path_def();
    def.most_wait = 0.0;
    made.busy_at_first = true;
    work_until_done(&def);
    assert_int_equal(made.kept_rounds, ALL_ROUNDS);
    made.use.has_wait = false;
    def = path_def();
    machine_tear_down(NULL);
    work_until_done(&def);
    assert_false(dip_driver_machine(driver, 1).has_wait);
    assert_true(dip_driver_machine(driver, 4).wait > 0.7); // One processor of four worked.
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, machine_set_up, machine_tear_down)
    const struct CMUnitTest tests[] = {
        TEST(a_few_disturbed_frames_are_left),
        TEST(many_disturbed_frames_are_drawn_again),
        TEST(frames_beside_a_disturbed_base_are_drawn_again),
        TEST(worse_repetitions_are_not_kept),
        TEST(a_machine_that_stays_busy_repeats_little),
        TEST(visits_of_a_block_have_no_fixed_order),
        TEST(without_a_limit_nothing_is_disturbed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
