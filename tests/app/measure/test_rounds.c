// Ratios and times along a path from logs whose exact answer is known, and how frames are dealt to
// rounds.
#include "app/measure/stats/rounds.h"
#include "tests/app/measure/noise.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

// All subjects have subject 0 as their base.
static const int base_of[3] = {0};

// A log without noise: two subjects of 2 and 3 times the base's time in `starts` starts.
static int list_exact(DipTimed *list, int starts, int rounds, int frames, const int *round_of) {
    int count = 0;
    for (int f = 0; f < frames; f++) {
        for (int s = 0; s < 3; s++) {
            list[count++] = (DipTimed){.subject = s,
                                       .start = round_of[f] / rounds,
                                       .round = round_of[f] % rounds,
                                       .frame = f,
                                       .ms = (s + 1.0) * (5.0 + f)};
        }
        list[count++] = (DipTimed){.start = round_of[frames + f] / rounds,
                                   .round = round_of[frames + f] % rounds,
                                   .block = 1,
                                   .frame = f,
                                   .ms = 5.0 + f};
    }
    (void)starts;
    return count;
}

static void a_log_without_noise_is_exact(void **state) {
    (void)state;
    enum { PATH = 16, STARTS = 2, PER_START = 4 };
    int round_of[2 * PATH];
    DipTimed list[4 * PATH];
    assert_true(dip_rounds_deal(PATH, STARTS * PER_START, 2, 5, round_of, NULL));
    const int count = list_exact(list, STARTS, PER_START, PATH, round_of);
    const DipTimes times = {list, count, 3, STARTS, PER_START, PATH, base_of, false};
    DipTimesFit *fit = dip_times_fit(&times, NULL);
    assert_non_null(fit);
    const DipEstimate ratio = dip_times_ratio(fit, 2), step = dip_times_ratio_of(fit, 2, 1);
    const DipAlong along = dip_times_along(fit, 1);
    assert_true(fabs(ratio.value - 3.0) < 1e-9 && fabs(step.value - 1.5) < 1e-9);
    assert_true(ratio.low < ratio.value && ratio.value < ratio.high);
    assert_true(fabs(along.mean_ms.value - 25.0) < 1e-6);
    assert_true(fabs(along.worst_ms.value - 40.0) < 1e-6);
    assert_true(fabs(along.p95_ms.value - 2.0 * (5.0 + 14.25)) < 1e-6);
    assert_true(fabs(dip_times_frames(fit, 2)[7] - 36.0) < 1e-6);
    assert_int_equal(along.timed, PATH);
    // A base is 1 exactly, so there is nothing that an interval could say.
    assert_true(dip_times_ratio(fit, 0).value == 1.0 && isnan(dip_times_ratio(fit, 0).low));
    dip_times_fit_free(&fit);
}

// The visits of a base in a round draw the same frames, and each draws other frames besides, as the
// driver (driver.h) deals them. Each visit has a speed of its own and single frames have no noise,
// so the times along the path are exact but for a common factor.
static void visits_that_draw_other_frames_besides_are_told_apart(void **state) {
    (void)state;
    enum { FRAMES = 64, ROUNDS = 16, COPIES = 3, BLOCKS = 3 };
    static DipTimed list[COPIES * BLOCKS * FRAMES];
    NoiseRandom random = {5};
    int round_of[COPIES * FRAMES], count = 0;
    double curve[FRAMES];
    for (int f = 0; f < FRAMES; f++) {
        curve[f] = sin(0.1 * f) + 0.3 * cos(0.37 * f);
    }
    assert_true(dip_rounds_deal(FRAMES, ROUNDS, COPIES, 7, round_of, NULL));
    for (int visit = 0; visit < ROUNDS * BLOCKS; visit++) {
        const double speed = 0.1 * noise_normal(&random);
        int others = 0;
        for (int i = 0; i < COPIES * FRAMES; i++) {
            const bool mine = i < FRAMES || others % BLOCKS == visit % BLOCKS;
            if (round_of[i] != visit / BLOCKS) {
                continue;
            }
            others += i >= FRAMES;
            if (mine) {
                list[count++] = (DipTimed){.start = visit / BLOCKS / 4,
                                           .round = visit / BLOCKS % 4,
                                           .block = visit % BLOCKS,
                                           .frame = i % FRAMES,
                                           .ms = exp(0.2 * curve[i % FRAMES] + speed)};
            }
        }
    }
    const DipTimes times = {list, count, 1, ROUNDS / 4, 4, FRAMES, base_of, false};
    DipTimesFit *fit = dip_times_fit(&times, NULL);
    assert_non_null(fit);
    double least = INFINITY, most = -INFINITY;
    for (int f = 0; f < FRAMES; f++) {
        const double off = log(dip_times_frames(fit, 0)[f]) - 0.2 * curve[f];
        least = fmin(least, off);
        most = fmax(most, off);
    }
    assert_true(most - least < 1e-3);
    dip_times_fit_free(&fit);
}

static void what_is_not_known_has_no_interval(void **state) {
    (void)state;
    DipTimed list[] = {{.subject = 0, .ms = 2.0}, {.subject = 1, .ms = 3.0}};
    const DipTimes once = {list, 2, 3, 1, 1, 1, base_of, false};
    DipTimesFit *fit = dip_times_fit(&once, NULL);
    const DipEstimate ratio = dip_times_ratio(fit, 1);
    const DipAlong along = dip_times_along(fit, 1);
    assert_true(fabs(ratio.value - 1.5) < 1e-12 && isnan(ratio.low) && isnan(ratio.high));
    assert_true(fabs(along.mean_ms.value - 3.0) < 1e-9 && isnan(along.mean_ms.high));
    assert_true(isnan(along.level_error));
    assert_true(isnan(dip_times_ratio(fit, 2).value)); // Never timed.
    dip_times_fit_free(&fit);
}

// A frame whose threads waited takes no part, unless most frames did.
static void disturbed_frames_take_no_part(void **state) {
    (void)state;
    DipTimed list[24];
    int count = 0;
    for (int r = 0; r < 6; r++) {
        for (int s = 0; s < 2; s++) {
            list[count++] = (DipTimed){.subject = s, .round = r, .frame = r, .ms = 1.0 + s};
        }
    }
    list[1].ms = 90.0;
    list[1].wait = 0.5;
    list[3].ms = 0.0; // Frames without a time take no part either, and here a base's.
    list[4].ms = NAN;
    const DipTimes times = {list, count, 2, 1, 6, 6, base_of, false};
    DipTimesFit *fit = dip_times_fit(&times, NULL);
    assert_true(fabs(dip_times_ratio(fit, 1).value - 2.0) < 1e-9);
    assert_int_equal(dip_times_along(fit, 1).kept, 3);
    dip_times_fit_free(&fit);
    for (int i = 0; i < count; i++) {
        list[i].wait = 0.5;
    }
    fit = dip_times_fit(&times, NULL);
    assert_true(dip_times_ratio(fit, 1).value >= 2.0);
    assert_int_equal(dip_times_along(fit, 1).kept, 0);
    dip_times_fit_free(&fit);
}

// Where every round draws all frames, a frame's ratio is its own, however much its neighbours'
// differ.
static void frames_of_every_round_keep_their_ratio(void **state) {
    (void)state;
    static const double ratios[] = {1.2, 2.3, 1.1, 2.2};
    DipTimed list[64];
    int count = 0;
    for (int r = 0; r < 5; r++) {
        for (int f = 0; f < 4; f++) {
            for (int s = 0; s < 2; s++) {
                list[count++] = (DipTimed){.subject = s,
                                           .round = r,
                                           .frame = f,
                                           .ms = (4.0 + f) * (s == 0 ? 1.0 : ratios[f])};
            }
        }
    }
    DipTimesFit *fit = dip_times_fit(&(DipTimes){list, count, 2, 1, 5, 4, base_of, true}, NULL);
    for (int f = 0; f < 4; f++) {
        assert_true(fabs(dip_times_frames(fit, 1)[f] - (4.0 + f) * ratios[f]) < 1e-9);
    }
    dip_times_fit_free(&fit);
}

// Of up to 512 visits, the ratio is Hodges and Lehmann's estimate: the median of the logarithms'
// means of all pairs. 262 visits have a ratio of 1 and 250 one of 3, so 26 % of the pairs have a
// mean ratio of 1, 50 % one of the root of 3, and 24 % one of 3. The ratio of more visits is their
// median.
static void ratios_of_many_visits_are_known(void **state) {
    (void)state;
    enum { FEW = 512, ONES = 262 };
    static DipTimed list[2 * (FEW + 1)];
    for (int visits = FEW; visits <= FEW + 1; visits++) {
        int count = 0;
        for (int r = 0; r < visits; r++) {
            for (int s = 0; s < 2; s++) {
                list[count++] = (DipTimed){
                    .subject = s, .round = r, .ms = 4.0 * (s == 1 && r >= ONES ? 3.0 : 1.0)};
            }
        }
        const DipTimes times = {list, count, 2, 1, visits, 1, base_of, true};
        DipTimesFit *fit = dip_times_fit(&times, NULL);
        assert_non_null(fit);
        const double expected = visits > FEW ? 1.0 : sqrt(3.0);
        assert_true(fabs(dip_times_ratio(fit, 1).value - expected) < 1e-9);
        dip_times_fit_free(&fit);
    }
}

static void frames_are_dealt_evenly(void **state) {
    (void)state;
    enum { PATH = 70, DEALT = 16, COPIES = 3 };
    int round_of[COPIES * PATH], other[COPIES * PATH];
    assert_true(dip_rounds_deal(PATH, DEALT, COPIES, 1, round_of, NULL));
    assert_true(dip_rounds_deal(PATH, DEALT, COPIES, 2, other, NULL));
    assert_memory_not_equal(round_of, other, sizeof round_of);
    assert_true(dip_rounds_deal(PATH, DEALT, COPIES, 1, other, NULL));
    assert_memory_equal(round_of, other, sizeof round_of);
    for (int copy = 0; copy < COPIES; copy++) {
        int in_round[DEALT] = {0};
        for (int f = 0; f < PATH; f++) {
            in_round[round_of[copy * PATH + f]]++;
            assert_true(copy == 0 || round_of[copy * PATH + f] != round_of[f]);
            assert_true(copy < 2 || round_of[copy * PATH + f] != round_of[PATH + f]);
        }
        for (int r = 0; r < DEALT; r++) {
            assert_true(in_round[r] == PATH / DEALT || in_round[r] == PATH / DEALT + 1);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_log_without_noise_is_exact),
        cmocka_unit_test(visits_that_draw_other_frames_besides_are_told_apart),
        cmocka_unit_test(what_is_not_known_has_no_interval),
        cmocka_unit_test(disturbed_frames_take_no_part),
        cmocka_unit_test(frames_of_every_round_keep_their_ratio),
        cmocka_unit_test(ratios_of_many_visits_are_known),
        cmocka_unit_test(frames_are_dealt_evenly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
