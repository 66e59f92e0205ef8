// The timing driver: which frames it draws, in which order, and what it tells of them.
#include "tests/app/measure/driver_machine.h"

#include <math.h>
#include <string.h>

// --- a path --------------------------------------------------------------------------------------

static void every_frame_is_timed_once_beside_its_base(void **state) {
    (void)state;
    static int timed_in[SUBJECTS * PATH][ALL_ROUNDS];
    const DipDriverDef def = path_def();
    memset(timed_in, 0, sizeof timed_in);
    work_until_done(&def);
    const DipTimes times = dip_driver_times(driver);
    assert_true(times.subjects == SUBJECTS && times.starts == STARTS && times.rounds == ROUNDS &&
                times.frames == PATH);
    assert_memory_equal(times.base_of, bases, sizeof bases);
    for (int i = 0; i < times.count; i++) {
        const DipTimed *timed = &times.list[i];
        assert_true(fabs(timed->ms - true_ms(timed->subject, timed->frame)) < 1e-5);
        assert_true(fabs(timed->parts_ms[1] - 0.25 * timed->ms) < 1e-5);
        timed_in[timed->subject * PATH + timed->frame][round_of(timed)]++;
    }
    for (int s = 0; s < SUBJECTS; s++) {
        for (int f = 0; f < PATH; f++) {
            int rounds = 0, all = 0;
            for (int r = 0; r < ALL_ROUNDS; r++) {
                rounds += timed_in[s * PATH + f][r] > 0;
                all += timed_in[s * PATH + f][r];
            }
            assert_int_equal(rounds, bases[s] == s ? COPIES : 1);
            assert_true(bases[s] == s || all == 1);
        }
    }
    DipTimesFit *fit = dip_times_fit(&times, NULL);
    assert_non_null(fit);
    for (int s = 0; s < SUBJECTS; s++) {
        const DipAlong along = dip_times_along(fit, s);
        assert_int_equal(along.timed, bases[s] == s ? 0 : PATH);
        assert_int_equal(along.kept, along.timed);
        assert_true(fabs(dip_times_shares(fit, s)[1] - 0.25) < 1e-6);
    }
    dip_times_fit_free(&fit);
    // In each round: 8 subjects in 3 blocks, 2 subjects in 1 block, and a base in each block; a
    // visit has an untimed frame; and each base draws each frame in two more rounds.
    assert_int_equal(made.turn_count, STARTS * SUBJECTS * WARM +
                                          ALL_ROUNDS * (8 + 3 + 2 + 1) * (PER_ROUND + 1) +
                                          2 * (COPIES - 1) * PATH);
    const DipDriverMachine machine = dip_driver_machine(driver, 1);
    assert_true(machine.settled && machine.has_wait && machine.wait == 0.0 && !machine.repeated);
}

// A coarse clock may show the same time before and after a frame.
static void a_clock_that_stands_still_gives_a_least_time(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    made.stands_still = true;
    work_until_done(&def);
    const DipTimes times = dip_driver_times(driver);
    assert_true(times.count > 0);
    for (int i = 0; i < times.count; i++) {
        assert_true(times.list[i].ms == 1e-6 && times.list[i].wait == 0.0);
    }
}

static void what_is_prepared_is_not_timed(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    calls.prepare = machine_prepare;
    work_until_done(&def);
    const DipTimes times = dip_driver_times(driver);
    assert_true(times.count > 0);
    for (int i = 0; i < times.count; i++) {
        const DipTimed *timed = &times.list[i];
        const double ms = true_ms(timed->subject, timed->frame);
        assert_true(fabs(timed->ms - ms) < 1e-5 && fabs(timed->cpu_ms - ms) < 1e-5);
        assert_true(timed->wait == 0.0);
    }
    assert_int_equal(made.prepared, made.turn_count);
}

// The frames of each block in the order in which they were drawn: whole visits, each with an
// untimed frame first, and the base's among them.
static void visits_begin_untimed_and_lie_beside_the_base(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    work_until_done(&def);
    int visit_of_base[2] = {0};
    for (int i = 0; i < made.turn_count; i++) {
        const DipDriverTurn *turn = &made.turns[i];
        if (turn->phase != DIP_DRIVER_UNTIMED) {
            continue;
        }
        int from = i, end = i;
        const DipDriverTurn *next = turn + 1;
        assert_true(next->phase == DIP_DRIVER_TIMED && next->subject == turn->subject &&
                    next->frame == turn->frame); // The same frame is timed at once.
        // At most 4 visits of a block: the base's is not farther than 3 visits away.
        bool found = false;
        const int most = 3 * (PER_ROUND + 1 + (COPIES - 1) * PER_ROUND);
        from = i > most ? i - most : 0;
        end = i + most < made.turn_count ? i + most : made.turn_count - 1;
        for (int j = from; j <= end; j++) {
            found |= made.turns[j].subject == bases[turn->subject] &&
                     made.turns[j].round == turn->round && made.turns[j].start == turn->start;
        }
        assert_true(found);
        visit_of_base[bases[turn->subject] == 9] += turn->subject == bases[turn->subject];
    }
    assert_int_equal(visit_of_base[0], 3 * ALL_ROUNDS);
    assert_int_equal(visit_of_base[1], ALL_ROUNDS);
}

static void visits_of_a_log_begin_in_order(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    work_until_done(&def);
    const DipTimes times = dip_driver_times(driver);
    assert_int_equal(times.list[0].begin_ns,
                     llround(1e6 * WARM * (12.0 * 4.0 + 33.0 * 4.0) + 1e6 * 0.1 * (12.0 + 33.0)));
    for (int i = 1; i < times.count; i++) {
        const DipTimed *a = &times.list[i - 1], *b = &times.list[i];
        const bool same =
            a->block == b->block && a->subject == b->subject && round_of(a) == round_of(b);
        assert_true(same ? a->begin_ns == b->begin_ns : a->begin_ns < b->begin_ns);
    }
}

static void order_follows_the_seed(void **state) {
    (void)state;
    static DipDriverTurn first[MOST_TURNS];
    DipDriverDef def = path_def();
    work_until_done(&def);
    memcpy(first, made.turns, sizeof first);
    const int count = made.turn_count;
    machine_tear_down(NULL);
    machine_set_up(NULL);
    work_until_done(&def);
    assert_int_equal(made.turn_count, count);
    assert_memory_equal(made.turns, first, sizeof first);
    machine_tear_down(NULL);
    machine_set_up(NULL);
    def.seed = 8;
    work_until_done(&def);
    assert_memory_not_equal(made.turns, first, sizeof first);
}

static void starts_begin_with_untimed_frames(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    work_until_done(&def);
    assert_int_equal(made.start_count, STARTS);
    for (int s = 0; s < STARTS; s++) {
        assert_int_equal(made.starts[s], s);
    }
    int begun = 0;
    for (int i = 0; i < made.turn_count; i++) {
        begun += made.turns[i].phase == DIP_DRIVER_WARM_UP && made.turns[i].subject == 0 &&
                 made.turns[i].frame == 0;
        assert_int_equal(made.turns[i].start, begun - 1);
    }
}

static void drift_cancels(void **state) {
    (void)state;
    const DipDriverDef def = path_def();
    made.slow_down = 0.005; // The last frames take several times as long as the first.
    work_until_done(&def);
    const DipTimes times = dip_driver_times(driver);
    DipTimesFit *fit = dip_times_fit(&times, NULL);
    assert_non_null(fit);
    assert_true(fabs(dip_times_ratio(fit, 5).value / 3.5 - 1.0) < 0.02);
    dip_times_fit_free(&fit);
}

// The medians of five are 90, 65, 40, 25 and 25 ms, so settling ends with the fifth.
static void settling_ends_when_two_medians_agree(void **state) {
    (void)state;
    DipDriverDef def = path_def();
    def.settle = true;
    work_until_done(&def);
    assert_int_equal(made.settling, 25);
    assert_int_equal(made.turns[SUBJECTS * WARM].phase, DIP_DRIVER_SETTLE);
    assert_true(dip_driver_machine(driver, 1).settled);
}

// --- the preview ---------------------------------------------------------------------------------

static DipDriverDef block_def(void) {
    return (DipDriverDef){.subjects = 5,
                          .base_of = bases,
                          .block_subjects = 4,
                          .starts = 1,
                          .rounds = 8,
                          .frames = 1,
                          .seed = 3,
                          .most_wait = DIP_TIMED_MOST_WAIT};
}

static void a_dropped_round_is_drawn_anew(void **state) {
    (void)state;
    static DipTimed whole[MOST_TURNS];
    const DipDriverDef def = block_def();
    work_until_done(&def);
    assert_int_equal(made.turn_count, 8 * 5 * 2);
    const int count = dip_driver_times(driver).count;
    memcpy(whole, dip_driver_times(driver).list, (size_t)count * sizeof *whole);
    machine_tear_down(NULL);
    machine_set_up(NULL);
    begin(&def);
    for (int i = 0; i < 2 * 10 + 7; i++) {
        dip_driver_step(driver, NULL);
    }
    DipDriverProgress progress = dip_driver_progress(driver);
    assert_true(progress.rounds == 2 && progress.drawn == 27 && progress.total == 80);
    dip_driver_drop_round(driver);
    progress = dip_driver_progress(driver);
    assert_true(progress.rounds == 2 && progress.drawn == 20 && progress.total == 80);
    assert_int_equal(dip_driver_times(driver).count, 2 * 5); // Complete rounds only.
    assert_int_equal(work(NULL), DIP_DRIVER_DONE);
    const DipTimes times = dip_driver_times(driver);
    check_same(&times, whole, count);
    assert_int_equal(made.turn_count, 80 + 7);
}

static void progress_counts_frames_and_rounds(void **state) {
    (void)state;
    DipDriverDef def = path_def();
    def.settle = true;
    begin(&def);
    const int64_t total = dip_driver_progress(driver).total;
    int rounds = 0;
    for (DipDriverStep step; (step = dip_driver_step(driver, NULL)) < DIP_DRIVER_DONE;) {
        rounds += step == DIP_DRIVER_ROUND;
        const DipDriverProgress progress = dip_driver_progress(driver);
        assert_int_equal(progress.total, total);
        assert_int_equal(progress.rounds, rounds);
    }
    const DipDriverProgress progress = dip_driver_progress(driver);
    assert_int_equal(progress.drawn, total);
    assert_int_equal(made.turn_count, total + 25); // Settling is not counted.
}

// --- two programs, and no base -------------------------------------------------------------------

static void subjects_in_turn_alternate_at_every_frame(void **state) {
    (void)state;
    enum { FRAMES = 3 };
    static const int pairs[4] = {0, 0, 2, 2};
    const DipDriverDef def = {.subjects = 4,
                              .base_of = pairs,
                              .block_subjects = 1,
                              .starts = 2,
                              .rounds = 20,
                              .frames = FRAMES,
                              .seed = 3,
                              .in_turn = true};
    made.is_elsewhere = true;
    work_until_done(&def);
    int first[2] = {0};
    for (int i = 0; i < made.turn_count; i += 2) {
        const DipDriverTurn *a = &made.turns[i], *b = &made.turns[i + 1];
        assert_true(a->phase == DIP_DRIVER_TIMED && b->phase == DIP_DRIVER_TIMED);
        assert_true(pairs[a->subject] == pairs[b->subject] && a->subject != b->subject &&
                    a->frame == b->frame && a->round == b->round);
        first[a->subject % 2]++;
    }
    assert_int_equal(made.turn_count, 2 * 20 * 4 * FRAMES);
    assert_in_range(first[0], 90, 150); // About 120 of 240 are expected.
    const DipTimes times = dip_driver_times(driver);
    for (int i = 0; i < times.count; i++) { // The times that the other process told.
        const DipTimed *timed = &times.list[i];
        assert_true(fabs(timed->ms - true_ms(timed->subject, timed->frame)) < 1e-9);
        assert_true(timed->wait == 0.125 && timed->cpu_ms == 2.0 * timed->ms);
    }
    assert_true(fabs(dip_driver_machine(driver, 1).wait - 0.125) < 1e-9);
}

static void a_machine_elsewhere_may_tell_no_waiting(void **state) {
    (void)state;
    const DipDriverDef def = block_def();
    made.is_elsewhere = made.tells_no_wait = true;
    work_until_done(&def);
    assert_false(dip_driver_machine(driver, 1).has_wait);
    assert_true(dip_driver_times(driver).list[0].wait == 0.0);
}

static void subjects_without_a_base_are_visited_in_seeded_order(void **state) {
    (void)state;
    enum { COUNT = 5, ROUND = COUNT * 3 };
    const DipDriverDef def = {.subjects = COUNT,
                              .block_subjects = 1,
                              .starts = 1,
                              .rounds = 40,
                              .frames = 2,
                              .warm_frames = 2,
                              .seed = 11};
    int first[COUNT] = {0};
    work_until_done(&def);
    assert_int_equal(made.turn_count, 2 * COUNT + 40 * ROUND);
    for (int round = 0; round < 40; round++) {
        unsigned seen = 0;
        const DipDriverTurn *turns = &made.turns[2 * COUNT + round * ROUND];
        for (int i = 0; i < ROUND; i++) {
            seen |= 1u << turns[i].subject;
            assert_int_equal(turns[i].frame, i % 3 == 2);
            assert_int_equal(turns[i].round, round);
        }
        assert_int_equal(seen, (1u << COUNT) - 1);
        first[turns[0].subject]++;
    }
    for (int s = 0; s < COUNT; s++) {
        assert_in_range(first[s], 2, 16); // About 8 of 40 are expected.
    }
}

// --- long starts ---------------------------------------------------------------------------------

// 6 starts of 4 rounds. A round takes about 1.1 s, so a tenth of a start's rounds is .44 s.
static void check_starts(double start_ms, int starts) {
    DipDriverDef def = path_def();
    def.starts = 6;
    def.rounds = 4;
    def.frames = 24;
    def.most_start = 0.1;
    machine_set_up(NULL);
    made.start_ms = start_ms;
    work_until_done(&def);
    DipTimes times = dip_driver_times(driver);
    assert_int_equal(times.starts, starts);
    assert_int_equal(times.rounds, 24 / starts);
    assert_int_equal(made.start_count, starts);
    for (int i = 0; i < times.count; i++) {
        assert_in_range(times.list[i].start, 0, starts - 1);
        assert_in_range(times.list[i].round, 0, 24 / starts - 1);
    }
    static DipTimed whole[MOST_TURNS];
    const int count = times.count;
    memcpy(whole, times.list, (size_t)count * sizeof *whole);
    // A journal with the rounds of several starts says how many there are.
    machine_tear_down(NULL);
    static DipTimed kept[MOST_TURNS];
    memcpy(kept, made.kept, sizeof kept);
    int known = 0;
    while (kept[known].start * times.rounds + kept[known].round < 6) {
        known++;
    }
    machine_set_up(NULL);
    made.start_ms = starts == 2 ? 0.0 : 1e6;
    begin(&def);
    assert_true(dip_driver_resume(driver, kept, known));
    assert_int_equal(work(NULL), DIP_DRIVER_DONE);
    times = dip_driver_times(driver);
    assert_int_equal(times.starts, starts);
    check_same(&times, whole, count);
    machine_tear_down(NULL);
}

static void long_starts_are_fewer(void **state) {
    (void)state;
    check_starts(20.0, 6);
    check_starts(2000.0, 2);
}

// --- failures ------------------------------------------------------------------------------------

static bool start_fails(void *context, int index, DipError *err) {
    (void)context;
    return index == 0 || dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "start", "failed");
}

static bool keep_fails(void *context, const DipTimed *timed, int count, DipError *err) {
    machine_keep(context, timed, count, err);
    return made.kept_rounds < 3 || dip_error_set(err, DIP_ERROR_IO, NULL, 0, "keep", "failed");
}

static void check_failure(const DipDriverCalls *failing, const char *key, int rounds) {
    const DipDriverDef def = path_def();
    DipError err = {0};
    machine_tear_down(NULL);
    driver = dip_driver_create(&def, failing, NULL);
    assert_int_equal(work(&err), DIP_DRIVER_FAILED);
    assert_string_equal(err.key, key);
    const int turns = made.turn_count;
    assert_int_equal(dip_driver_step(driver, NULL), DIP_DRIVER_FAILED);
    assert_int_equal(made.turn_count, turns);
    assert_int_equal(dip_driver_progress(driver).rounds, rounds < 0 ? made.kept_rounds : rounds);
}

static void a_failure_ends_the_measurement(void **state) {
    (void)state;
    for (int at = 0; at < 200; at += 13) {
        machine_set_up(NULL);
        made.fail_at = at;
        const int round = 14 * (PER_ROUND + 1);
        check_failure(&calls, "draw", -1);
        assert_int_equal(made.turn_count, at);
        assert_in_range(made.kept_rounds, (at - SUBJECTS * WARM) / (2 * round), at / round);
    }
    DipDriverCalls failing = calls;
    failing.start = start_fails;
    machine_set_up(NULL);
    check_failure(&failing, "start", ROUNDS);
    failing = calls;
    failing.keep = keep_fails;
    machine_set_up(NULL);
    check_failure(&failing, "keep", 3);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, machine_set_up, machine_tear_down)
    const struct CMUnitTest tests[] = {
        TEST(every_frame_is_timed_once_beside_its_base),
        TEST(a_clock_that_stands_still_gives_a_least_time),
        TEST(what_is_prepared_is_not_timed),
        TEST(visits_begin_untimed_and_lie_beside_the_base),
        TEST(visits_of_a_log_begin_in_order),
        TEST(order_follows_the_seed),
        TEST(starts_begin_with_untimed_frames),
        TEST(drift_cancels),
        TEST(settling_ends_when_two_medians_agree),
        TEST(a_dropped_round_is_drawn_anew),
        TEST(progress_counts_frames_and_rounds),
        TEST(subjects_in_turn_alternate_at_every_frame),
        TEST(a_machine_elsewhere_may_tell_no_waiting),
        TEST(subjects_without_a_base_are_visited_in_seeded_order),
        TEST(long_starts_are_fewer),
        TEST(a_failure_ends_the_measurement),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
