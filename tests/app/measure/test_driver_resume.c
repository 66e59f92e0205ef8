// Measurements that the timing driver resumes from a journal.
#include "tests/app/measure/driver_machine.h"

#include <math.h>
#include <string.h>

// Resumes after each number of rounds. The log is that of the uninterrupted measurement.
static void check_resume(const DipDriverDef *def) {
    static DipTimed kept[MOST_TURNS], whole[MOST_TURNS];
    const Machine begin_with = made;
    work_until_done(def);
    const DipTimes times = dip_driver_times(driver);
    const int count = times.count, rounds = made.kept_rounds, kept_count = made.kept_count;
    const DipDriverMachine machine = dip_driver_machine(driver, 1);
    memcpy(whole, times.list, (size_t)count * sizeof *whole);
    memcpy(kept, made.kept, sizeof kept);
    int known = 0;
    for (int round = 0; round <= rounds; round++) {
        machine_tear_down(NULL);
        made = begin_with;
        made.kept_rounds = round;
        begin(def);
        assert_true(dip_driver_resume(driver, kept, known));
        const DipDriverProgress at_first = dip_driver_progress(driver);
        assert_int_equal(at_first.drawn, 0);
        assert_int_equal(at_first.rounds, round < ALL_ROUNDS ? round : ALL_ROUNDS);
        assert_int_equal(work(NULL), DIP_DRIVER_DONE);
        assert_true(round >= ALL_ROUNDS || dip_driver_progress(driver).drawn == at_first.total);
        const DipTimes again = dip_driver_times(driver);
        check_same(&again, whole, count);
        assert_true(dip_driver_machine(driver, 1).wait == machine.wait);
        assert_int_equal(dip_driver_machine(driver, 1).repeated, machine.repeated);
        for (int i = 1; i < again.count; i++) {
            assert_true(again.list[i].block >= SUBJECTS || again.list[i - 1].block >= SUBJECTS ||
                        again.list[i].begin_ns >= again.list[i - 1].begin_ns);
        }
        assert_int_equal(made.kept_count, kept_count - known);
        if (known == kept_count) {
            assert_int_equal(made.turn_count, 0); // Nothing is left to draw.
            break;
        }
        const DipTimed *first = &kept[known];
        const bool repeated = first->block >= SUBJECTS;
        while (known < kept_count && round_of(&kept[known]) == round_of(first) &&
               (kept[known].block >= SUBJECTS) == repeated) {
            known++;
        }
    }
    // One time more than a measurement can have is not used.
    machine_tear_down(NULL);
    made = begin_with;
    begin(def);
    kept[kept_count] = kept[kept_count - 1];
    assert_false(dip_driver_resume(driver, kept, kept_count + 1));
}

static void resumed_rounds_are_those_of_the_whole(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    check_resume(&def);
}

static void resumed_repetitions_are_those_of_the_whole(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    made.busy_at_first = true;
    check_resume(&def);
    machine_tear_down(NULL);
    machine_set_up(NULL);
    made.busy_always = true;
    check_resume(&def);
}

// A visit of a path with one frame has one timed frame, so each known frame began at another time.
// The first frame that the resumed measurement draws begins when the last known one began.
static void the_clock_continues_where_the_last_visit_began(void **state) {
    (void)state;
    static DipTimed kept[MOST_TURNS];
    const DipDriverDef def = {.subjects = 5,
                              .base_of = bases,
                              .block_subjects = 4,
                              .starts = 1,
                              .rounds = 8,
                              .frames = 1,
                              .seed = 3};
    work_until_done(&def);
    memcpy(kept, made.kept, sizeof kept);
    for (int known = def.subjects; known < def.rounds * def.subjects; known += def.subjects) {
        machine_tear_down(NULL);
        machine_set_up(NULL);
        begin(&def);
        assert_true(kept[known - 1].begin_ns > kept[known - 2].begin_ns);
        assert_true(dip_driver_resume(driver, kept, known));
        assert_int_equal(work(NULL), DIP_DRIVER_DONE);
        const DipTimes times = dip_driver_times(driver);
        assert_int_equal(times.count, def.rounds * def.subjects);
        assert_int_equal(times.list[known - 1].begin_ns, kept[known - 1].begin_ns);
        assert_int_equal(times.list[known].begin_ns, kept[known - 1].begin_ns);
        // From then on the clock runs as it did before.
        for (int i = known + 1; i < times.count; i++) {
            assert_int_equal(times.list[i].begin_ns - times.list[known].begin_ns,
                             kept[i].begin_ns - kept[known].begin_ns);
        }
    }
}

// A journal of another seed, cut short, or forged is used up to where it differs.
static void what_does_not_fit_is_drawn(void **state) {
    (void)state;
    static DipTimed kept[MOST_TURNS];
    DipDriverDef def = path_def();
    work_until_done(&def);
    memcpy(kept, made.kept, sizeof kept);
    const int count = made.kept_count;
    int round = 1;
    while (round_of(&kept[round]) == round_of(&kept[0])) {
        round++;
    }
    for (int change = 0; change < 9; change++) {
        machine_tear_down(NULL);
        machine_set_up(NULL);
        DipTimed saved = kept[round + 3];
        DipTimed *timed = &kept[round + 3];
        def.seed = change ? 7 : 8;
        begin(&def);
        timed->subject = change == 1 ? timed->subject + 1 : timed->subject;
        timed->frame = change == 2 ? -1 : timed->frame;
        timed->ms = change == 3 ? 0.0 : change == 4 ? NAN : change == 8 ? INFINITY : timed->ms;
        timed->wait = change == 5 ? -1.0 : timed->wait;
        timed->start = change == 6 ? 1 : timed->start;
        const int given = change == 7 ? round + 3 : count;
        assert_false(dip_driver_resume(driver, kept, given));
        assert_int_equal(dip_driver_progress(driver).rounds, change ? 1 : 0);
        *timed = saved;
        assert_int_equal(work(NULL), DIP_DRIVER_DONE);
    }
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, machine_set_up, machine_tear_down)
    const struct CMUnitTest tests[] = {
        TEST(resumed_rounds_are_those_of_the_whole),
        TEST(resumed_repetitions_are_those_of_the_whole),
        TEST(the_clock_continues_where_the_last_visit_began),
        TEST(what_does_not_fit_is_drawn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
