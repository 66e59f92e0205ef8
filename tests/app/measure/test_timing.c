// Tests of interleaved timing on a fake clock: when each subject runs, what is timed, and which
// times are kept.
#include "app/measure/stats/paired.h"
#include "app/measure/timing/timing.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

enum { MAX_TURNS = 4096, MAX_SUBJECTS = 8 };

// A machine whose clock stands still unless a subject runs.
typedef struct Fake {
    int64_t now_ns;
    DipTimingTurn turns[MAX_TURNS];
    double ms[MAX_TURNS]; // the times that after_run received
    int count;
    int fail_at; // index of the run that fails; -1 for none
    double slow; // factor by which odd rounds take longer
    int settle_runs;
    int rounds_seen;
    bool known[64];
    double last_round[64];
} Fake;

// Subject s takes (s + 1) * (frame + 1) milliseconds in version 0 and twice as long in version 1.
static double cost_ms(const DipTimingTurn *turn) {
    return (turn->subject + 1.0) * (turn->frame + 1.0) * (turn->version + 1.0);
}

static int64_t fake_clock(void *context) {
    return ((Fake *)context)->now_ns;
}

static bool fake_run(void *context, const DipTimingTurn *turn, DipError *err) {
    Fake *fake = context;
    if (fake->count == fake->fail_at) {
        return dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "fake", "stopped");
    }
    double ms = cost_ms(turn);
    if (turn->phase == DIP_TIMING_SETTLE) {
        // Each of the first fifteen runs is 5 ms faster than the one before; later ones are equal.
        ms = fake->settle_runs < 15 ? 100.0 - 5.0 * fake->settle_runs : 25.0;
        fake->settle_runs++;
    } else if (turn->round >= 0 && turn->round % 2 == 1) {
        ms *= fake->slow;
    }
    fake->now_ns += (int64_t)(ms * 1e6);
    return true;
}

static bool fake_after(void *context, const DipTimingTurn *turn, double ms, DipError *err) {
    (void)err;
    Fake *fake = context;
    fake->now_ns += 12345678; // time that passes between runs is not measured
    assert_true(fake->count < MAX_TURNS);
    fake->turns[fake->count] = *turn;
    fake->ms[fake->count++] = ms;
    return true;
}

static DipTimingCalls calls_of(Fake *fake) {
    return (DipTimingCalls){
        .run = fake_run, .after_run = fake_after, .clock_ns = fake_clock, .context = fake};
}

static Fake make_fake(void) {
    return (Fake){.fail_at = -1, .slow = 1.0};
}

// --- tests -------------------------------------------------------------------------------------

static void only_runs_are_timed(void **state) {
    (void)state;
    static Fake fake;
    double ms[3 * 2 * 4];
    const DipTimingDef def = {
        .subject_count = 3, .frame_count = 2, .version_count = 1, .round_count = 4, .seed = 7};
    fake = make_fake();
    const DipTimingCalls calls = calls_of(&fake);
    assert_true(dip_timing_run(&def, &calls, ms, NULL));
    for (int s = 0; s < 3; s++) {
        assert_int_equal(dip_timing_index(&def, 0, s), 8 * s);
        for (int i = 0; i < 8; i++) {
            assert_true(fabs(ms[8 * s + i] - (s + 1.0) * (i % 2 + 1.0)) < 1e-9);
        }
    }
    assert_int_equal(fake.count, dip_timing_run_count(&def, 0));
    assert_int_equal(fake.count, 3 * 2 + 4 * 3 * (1 + 2));
}

static void every_subject_is_warmed_up_in_order(void **state) {
    (void)state;
    static Fake fake;
    const DipTimingDef def = {
        .subject_count = 2, .frame_count = 3, .version_count = 1, .round_count = 1};
    fake = make_fake();
    const DipTimingCalls calls = calls_of(&fake);
    assert_true(dip_timing_run(&def, &calls, NULL, NULL));
    for (int i = 0; i < 6; i++) {
        const DipTimingTurn *turn = &fake.turns[i];
        assert_int_equal(turn->phase, DIP_TIMING_WARM_UP);
        assert_int_equal(turn->round, -1);
        assert_int_equal(turn->subject, i / 3);
        assert_int_equal(turn->frame, i % 3);
    }
    // A visit draws its first frame untimed, then all of its frames.
    assert_int_equal(fake.turns[6].phase, DIP_TIMING_REWARM);
    assert_int_equal(fake.turns[6].frame, 0);
    for (int i = 0; i < 3; i++) {
        assert_int_equal(fake.turns[7 + i].phase, DIP_TIMING_TIMED);
        assert_int_equal(fake.turns[7 + i].frame, i);
        assert_int_equal(fake.turns[7 + i].subject, fake.turns[6].subject);
    }
}

// Writes the subjects of all visits, in the order of the visits. Returns the number of visits.
static int list_visits(const Fake *fake, int *subjects) {
    int count = 0;
    for (int i = 0; i < fake->count; i++) {
        if (fake->turns[i].phase == DIP_TIMING_REWARM) {
            subjects[count++] = fake->turns[i].subject;
        }
    }
    return count;
}

static void every_round_visits_each_subject_in_seeded_order(void **state) {
    (void)state;
    static Fake fakes[3];
    enum { ROUNDS = 40, SUBJECTS = 5 };
    int orders[3][ROUNDS * SUBJECTS];
    int first[SUBJECTS] = {0};
    for (int i = 0; i < 3; i++) {
        const DipTimingDef def = {.subject_count = SUBJECTS,
                                  .frame_count = 1,
                                  .version_count = 1,
                                  .round_count = ROUNDS,
                                  .seed = i < 2 ? 11 : 12};
        fakes[i] = make_fake();
        const DipTimingCalls calls = calls_of(&fakes[i]);
        assert_true(dip_timing_run(&def, &calls, NULL, NULL));
        assert_int_equal(list_visits(&fakes[i], orders[i]), ROUNDS * SUBJECTS);
    }
    for (int round = 0; round < ROUNDS; round++) {
        unsigned seen = 0;
        for (int i = 0; i < SUBJECTS; i++) {
            seen |= 1u << orders[0][round * SUBJECTS + i];
        }
        assert_int_equal(seen, (1u << SUBJECTS) - 1);
        first[orders[0][round * SUBJECTS]]++;
    }
    for (int s = 0; s < SUBJECTS; s++) {
        assert_in_range(first[s], 2, 16); // about 8 of 40 are expected
    }
    assert_memory_equal(orders[0], orders[1], sizeof orders[0]);
    assert_memory_not_equal(orders[0], orders[2], sizeof orders[0]);
}

static void two_versions_alternate_at_every_frame(void **state) {
    (void)state;
    static Fake fake;
    enum { ROUNDS = 20, FRAMES = 3, SUBJECTS = 2 };
    double ms[2 * SUBJECTS * ROUNDS * FRAMES];
    const DipTimingDef def = {.subject_count = SUBJECTS,
                              .frame_count = FRAMES,
                              .version_count = 2,
                              .round_count = ROUNDS,
                              .seed = 3};
    fake = make_fake();
    const DipTimingCalls calls = calls_of(&fake);
    assert_true(dip_timing_run(&def, &calls, ms, NULL));
    assert_int_equal(fake.count, dip_timing_run_count(&def, 0));
    const int warm = 2 * SUBJECTS * FRAMES;
    int first[2] = {0};
    for (int i = warm; i < fake.count; i += 2) {
        const DipTimingTurn *a = &fake.turns[i];
        const DipTimingTurn *b = &fake.turns[i + 1];
        assert_int_equal(a->phase, DIP_TIMING_TIMED);
        assert_int_equal(a->version + b->version, 1);
        assert_true(a->subject == b->subject && a->frame == b->frame && a->round == b->round);
        first[a->version]++;
    }
    assert_in_range(first[0], 40, 80); // about 60 of 120 are expected
    const DipPairedTimes times = {ms + dip_timing_index(&def, 1, 1),
                                  ms + dip_timing_index(&def, 0, 1), ROUNDS, FRAMES};
    DipStatsEstimate ratio;
    assert_true(dip_paired_ratio(&times, &ratio, NULL));
    assert_true(fabs(ratio.value - 2.0) < 1e-9);
}

// The medians of five runs are 90, 65, 40, 25 and 25 ms, so settling ends with the fifth.
static void settling_ends_when_two_medians_agree(void **state) {
    (void)state;
    static Fake fake;
    const DipTimingDef def = {
        .subject_count = 2, .frame_count = 1, .version_count = 1, .round_count = 1, .settle = true};
    fake = make_fake();
    const DipTimingCalls calls = calls_of(&fake);
    assert_true(dip_timing_run(&def, &calls, NULL, NULL));
    assert_int_equal(fake.settle_runs, 25);
    assert_int_equal(fake.count, dip_timing_run_count(&def, 0) + 25);
    assert_int_equal(fake.turns[2].phase, DIP_TIMING_SETTLE);
    assert_int_equal(fake.turns[2].subject, 0);
}

// --- rounds that are known ---------------------------------------------------------------------

static const double *known_round(void *context, int round) {
    static const double kept[] = {101.0, 102.0, 103.0};
    (void)context;
    return round == 0 ? kept : NULL;
}

static bool after_round(void *context, int round, const double *ms, bool known, DipError *err) {
    (void)err;
    Fake *fake = context;
    assert_int_equal(round, fake->rounds_seen++);
    fake->known[round] = known;
    fake->last_round[round] = ms[2];
    return true;
}

static void known_rounds_are_skipped_without_changing_the_order(void **state) {
    (void)state;
    static Fake fresh, resumed;
    int fresh_order[9];
    int resumed_order[6];
    double ms[9];
    const DipTimingDef def = {
        .subject_count = 3, .frame_count = 1, .version_count = 1, .round_count = 3, .seed = 5};
    fresh = make_fake();
    resumed = make_fake();
    DipTimingCalls calls = calls_of(&fresh);
    assert_true(dip_timing_run(&def, &calls, NULL, NULL));
    calls = calls_of(&resumed);
    calls.known_round = known_round;
    calls.after_round = after_round;
    assert_true(dip_timing_run(&def, &calls, ms, NULL));
    assert_int_equal(resumed.count, dip_timing_run_count(&def, 1));
    assert_int_equal(list_visits(&fresh, fresh_order), 9);
    assert_int_equal(list_visits(&resumed, resumed_order), 6);
    assert_memory_equal(fresh_order + 3, resumed_order, sizeof resumed_order);
    assert_true(resumed.known[0] && !resumed.known[1] && !resumed.known[2]);
    assert_true(resumed.last_round[0] == 103.0 && fabs(resumed.last_round[1] - 3.0) < 1e-9);
    assert_true(ms[0] == 101.0 && ms[3] == 102.0 && ms[6] == 103.0);
    assert_true(fabs(ms[1] - 1.0) < 1e-9 && fabs(ms[8] - 3.0) < 1e-9);
}

// --- failures ----------------------------------------------------------------------------------

static void a_failure_ends_the_measurement(void **state) {
    (void)state;
    static Fake fake;
    const DipTimingDef def = {
        .subject_count = 2, .frame_count = 2, .version_count = 1, .round_count = 2};
    for (int at = 0; at < 4 + 2 * 2 * 3; at++) {
        DipError err = {0};
        fake = make_fake();
        fake.fail_at = at;
        const DipTimingCalls calls = calls_of(&fake);
        assert_false(dip_timing_run(&def, &calls, NULL, &err));
        assert_int_equal(fake.count, at);
        assert_string_equal(err.message, "stopped");
    }
}

// --- ratios ------------------------------------------------------------------------------------

// In every second round the machine is three times as slow. The ratio is still certain.
static void ratios_cancel_a_slowdown_of_all_subjects(void **state) {
    (void)state;
    static Fake fake;
    enum { ROUNDS = 16, FRAMES = 2 };
    double ms[2 * ROUNDS * FRAMES];
    const DipTimingDef def = {
        .subject_count = 2, .frame_count = FRAMES, .version_count = 1, .round_count = ROUNDS};
    fake = make_fake();
    fake.slow = 3.0;
    const DipTimingCalls calls = calls_of(&fake);
    assert_true(dip_timing_run(&def, &calls, ms, NULL));
    const DipPairedTimes times = {ms + dip_timing_index(&def, 0, 1),
                                  ms + dip_timing_index(&def, 0, 0), ROUNDS, FRAMES};
    DipStatsEstimate ratio;
    assert_true(dip_paired_ratio(&times, &ratio, NULL));
    assert_true(fabs(ratio.low - 2.0) < 1e-9 && fabs(ratio.high - 2.0) < 1e-9);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_runs_are_timed),
        cmocka_unit_test(every_subject_is_warmed_up_in_order),
        cmocka_unit_test(every_round_visits_each_subject_in_seeded_order),
        cmocka_unit_test(two_versions_alternate_at_every_frame),
        cmocka_unit_test(settling_ends_when_two_medians_agree),
        cmocka_unit_test(known_rounds_are_skipped_without_changing_the_order),
        cmocka_unit_test(a_failure_ends_the_measurement),
        cmocka_unit_test(ratios_cancel_a_slowdown_of_all_subjects),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
