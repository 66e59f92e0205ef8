// Tests of the measurement of rough prices, with a painter and a clock that are made up.
#include "app/preview/live/price_job.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static DipPrices *prices;
static DipPriceJob *job;
static int64_t now_ns;
static int frames;
static double drift;     // By how much the machine slows down with each frame.
static double noise;     // Greatest deviation of a frame's time, relative.
static unsigned random_; // State of the noise.
static double waits;     // Share of a frame that its threads wait.
static DipThreadUse use;
static double slow;        // By how much a frame takes longer.
static bool refuses;       // The painter fails.
static DipQuality last;    // Settings of the last frame.
static unsigned parities;  // Bit p: a timed frame had an index of parity p.
static bool last_was_cold; // The last frame was the first one with its settings.

// The time that a frame takes, without cold caches, drift or noise.
static double true_ms(const DipQuality *quality) {
    const uint8_t *step = quality->step;
    return 4.0 + 1.5 * step[DIP_SETTING_AA] + 0.5 * step[DIP_SETTING_AF] +
           0.25 * step[DIP_SETTING_AAF] - 0.125 * (3 - step[DIP_SETTING_MIPLOD]) +
           (step[DIP_SETTING_AAA] ? 1.0 - 0.125 * step[DIP_SETTING_ASD] : 0.0) +
           0.0625 * step[DIP_SETTING_AA] * step[DIP_SETTING_AF];
}

static bool draw(void *context, const DipQuality *quality, uint64_t frame_index, DipFrame *frame,
                 DipError *err) {
    (void)context;
    (void)frame;
    if (refuses) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "renderer", "no memory for samples");
    }
    const bool cold = frames == 0 || memcmp(&last, quality, sizeof last) != 0;
    if (!cold && last_was_cold) {
        parities |= 1u << frame_index % 2;
    }
    random_ = random_ * 1664525u + 1013904223u;
    const double deviation = noise * ((random_ >> 16) / 32768.0 - 1.0);
    const double ms =
        slow * true_ms(quality) * (cold ? 3.0 : 1.0) * (1.0 + drift * frames) * (1.0 + deviation);
    now_ns += (int64_t)llround(1e6 * ms);
    use.wait_ns += (int64_t)llround(1e6 * ms * waits);
    last = *quality;
    last_was_cold = cold;
    frames++;
    return true;
}

static DipThreadUse read_use(void *context) {
    (void)context;
    return use;
}

static int64_t read_clock(void *context) {
    (void)context;
    return now_ns;
}

static DipQuality settings(const char *text) {
    DipQuality quality;
    assert_true(dip_quality_parse(text, &quality, NULL));
    return quality;
}

static int set_up(void **state) {
    (void)state;
    now_ns = 1;
    frames = 0;
    drift = noise = 0.0;
    random_ = 1;
    refuses = false;
    parities = 0;
    prices = dip_prices_create(NULL);
    waits = 0.0;
    slow = 1.0;
    use = (DipThreadUse){.has_wait = true};
    const DipPriceJobCalls calls = {
        .draw = draw, .now_ns = read_clock, .thread_use = read_use, .threads = 1};
    job = dip_price_job_create(&calls, prices, NULL);
    assert_true(prices && job);
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    dip_price_job_destroy(&job);
    dip_prices_destroy(&prices);
    return 0;
}

static void follow(const char *current, const char *requested) {
    const DipQuality panes[2] = {settings(current), settings(requested)};
    dip_price_job_follow(job, &panes[0], &panes[1]);
}

static void work_until_done(void) {
    int steps = 0;
    while (dip_price_job_progress(job).working) {
        dip_price_job_step(job, 10.0);
        assert_true(++steps < 100000);
    }
}

static void check_near(double value, double expected, double tolerance) {
    if (!(fabs(value - expected) <= tolerance)) {
        fail_msg("%.9g is not %.9g", value, expected);
    }
}

// Checks the prices of all steps against the times that the painter makes up. Returns the number of
// prices whose interval does not hold the true one.
static int check_steps(const DipQuality *pane, double tolerance) {
    int outside = 0;
    const DipQuality base = dip_quality_default();
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        for (int step = 0; step < dip_setting_info((DipSetting)s)->step_count; step++) {
            if (s == DIP_SETTING_MIPDEBUG || s == DIP_SETTING_ASD || s == DIP_SETTING_AAA) {
                continue;
            }
            DipQuality without = base;
            if (s == DIP_SETTING_AAF) {
                without.step[DIP_SETTING_AF] = pane->step[DIP_SETTING_AF];
            }
            if (s == DIP_SETTING_TAA) {
                without.step[DIP_SETTING_AA] = pane->step[DIP_SETTING_AA];
            }
            if ((s == DIP_SETTING_AF || s == DIP_SETTING_AAF) && step > 0) {
                without.step[DIP_SETTING_AA] = pane->step[DIP_SETTING_AA];
                without.step[DIP_SETTING_AAA] = pane->step[DIP_SETTING_AAA];
                without.step[DIP_SETTING_ASD] = pane->step[DIP_SETTING_ASD];
            }
            DipQuality with = without;
            with.step[s] = (uint8_t)step;
            const DipPrice price = dip_prices_step(prices, (DipSetting)s, step, pane);
            const bool is_base = with.step[s] == without.step[s];
            assert_int_equal(price.state, is_base ? DIP_PRICE_BASE : DIP_PRICE_ROUGH);
            const double expected = true_ms(&with) - (is_base ? 0.0 : true_ms(&without));
            check_near(price.ms, expected, tolerance);
            outside +=
                !is_base && (price.ms_low > expected + 1e-6 || price.ms_high < expected - 1e-6);
        }
    }
    return outside;
}

// Cold frames take three times as long, and the machine slows down by half, but no price shows it.
static void prices_are_those_of_the_painter(void **state) {
    (void)state;
    const DipQuality pane = settings("aa=4,aaa=on,asd=2,af=8,aaf=on");
    follow("aa=2", "aa=4,aaa=on,asd=2,af=8,aaf=on");
    work_until_done();
    assert_int_equal(check_steps(&pane, 2e-5), 0);
    check_near(dip_prices_step(prices, DIP_SETTING_AAA, 1, &pane).ms, 0.875, 2e-5);
    check_near(dip_prices_step(prices, DIP_SETTING_ASD, 0, &pane).ms, 1.0, 2e-5);
    assert_int_equal(parities, 3); // Both patterns of temporal AA were timed.
    const DipPriceSum sum = dip_prices_sum(prices, &pane);
    check_near(sum.ms, true_ms(&pane), 2e-5);
    check_near(sum.together_ms, 0.0, 1e-4); // AF is priced beside AA, so the prices add up.
}

static void a_machine_that_slows_down_changes_no_ratio(void **state) {
    (void)state;
    const DipQuality pane = settings("aa=4,af=8,aaf=on");
    drift = 1e-4;
    follow("aa=none", "aa=4,af=8,aaf=on");
    work_until_done();
    const double base_ms = dip_prices_step(prices, DIP_SETTING_AA, 0, &pane).ms;
    assert_true(base_ms > 4.0);
    for (int step = 1; step < 5; step++) {
        const double ms = dip_prices_step(prices, DIP_SETTING_AA, step, &pane).ms;
        check_near(ms / base_ms, 1.5 * step / 4.0, 0.02);
    }
}

// Intervals of 95 % from eight frames each: of some twenty prices, few lie outside.
static void intervals_hold_the_true_price(void **state) {
    (void)state;
    const DipQuality pane = settings("aa=4,af=8,aaf=on");
    noise = 0.03;
    follow("aa=none", "aa=4,af=8,aaf=on");
    work_until_done();
    assert_true(check_steps(&pane, 1.0) <= 3);
}

static void a_step_draws_one_frame_at_least_and_keeps_its_budget(void **state) {
    (void)state;
    follow("aa=none", "aa=4");
    dip_price_job_step(job, 0.0);
    assert_int_equal(frames, 1);
    const int64_t before_ns = now_ns;
    dip_price_job_step(job, 50.0);
    assert_true(now_ns - before_ns >= 50000000);
    assert_true(now_ns - before_ns < 50000000 + 3 * 13000000); // One frame too many at most.
}

static void progress_counts_steps_and_seconds(void **state) {
    (void)state;
    char text[64];
    dip_price_job_describe(job, text, sizeof text);
    assert_string_equal(text, "");
    follow("aa=none", "aa=none");
    int left = dip_price_job_progress(job).combinations;
    dip_price_job_describe(job, text, sizeof text);
    assert_true(strstr(text, "steps left, 0 s") && strncmp(text, "times: ", 7) == 0);
    double seconds = 0.0, first_s = 0.0;
    const int64_t begin_ns = now_ns;
    while (dip_price_job_progress(job).working) {
        dip_price_job_step(job, 0.0);
        const DipPriceProgress progress = dip_price_job_progress(job);
        assert_in_range(progress.rounds, 0, DIP_PRICE_JOB_ROUNDS);
        if (frames == 30) {
            seconds = progress.seconds_left + 1e-9 * (double)(now_ns - begin_ns);
        }
        if (progress.first) {
            assert_true(progress.combinations <= left);
            left = progress.combinations;
            first_s = 1e-9 * (double)(now_ns - begin_ns);
        }
    }
    // The estimate after the first block was about right.
    check_near(seconds / first_s, 1.0, 0.4);
    dip_price_job_describe(job, text, sizeof text);
    assert_string_equal(text, "");
}

// Every step has a rough price long before the last one is timed in all rounds.
static void all_prices_are_soon_known_roughly(void **state) {
    (void)state;
    const DipQuality pane = settings("aa=4,af=8");
    noise = 0.03;
    follow("aa=none", "aa=4,af=8");
    while (dip_price_job_progress(job).first) {
        dip_price_job_step(job, 0.0);
    }
    const int first = frames;
    const DipPrice rough = dip_prices_step(prices, DIP_SETTING_AA, 4, &pane);
    check_steps(&pane, 1.0);
    work_until_done();
    assert_true(2 * first < frames);
    const DipPrice price = dip_prices_step(prices, DIP_SETTING_AA, 4, &pane);
    assert_true(price.ms_high - price.ms_low < rough.ms_high - rough.ms_low);
}

static void what_is_known_is_not_timed_again(void **state) {
    (void)state;
    follow("aa=none", "aa=4");
    work_until_done();
    const int first = frames;
    follow("aa=none", "aa=4");
    assert_false(dip_price_job_progress(job).working);
    follow("aa=4", "aa=4");
    assert_false(dip_price_job_progress(job).working);
    follow("aa=none", "aa=4,af=8");
    assert_true(dip_price_job_progress(job).working);
    work_until_done();
    assert_true(frames - first < first);
    const int second = frames;
    dip_price_job_forget(job);
    const DipQuality pane = settings("aa=4");
    assert_int_equal(dip_prices_step(prices, DIP_SETTING_AA, 2, &pane).state, DIP_PRICE_UNKNOWN);
    work_until_done();
    assert_true(frames - second >= first);
    assert_int_equal(dip_prices_step(prices, DIP_SETTING_AA, 2, &pane).state, DIP_PRICE_ROUGH);
}

static void the_nearest_steps_come_first(void **state) {
    (void)state;
    const DipQuality pane = settings("aa=4,af=8");
    follow("aa=none", "aa=4,af=8");
    while (!dip_price_job_step(job, 0.0)) {
    }
    assert_int_equal(dip_prices_sum(prices, &pane).state, DIP_PRICE_ROUGH);
    assert_true(dip_prices_find_live(prices, &pane) >= 0);
    assert_int_equal(dip_prices_step(prices, DIP_SETTING_AA, 2, &pane).state, DIP_PRICE_ROUGH);
    assert_int_equal(dip_prices_step(prices, DIP_SETTING_AF, 3, &pane).state, DIP_PRICE_ROUGH);
    assert_int_equal(dip_prices_step(prices, DIP_SETTING_AA, 4, &pane).state, DIP_PRICE_UNKNOWN);
}

static void an_interrupted_block_leaves_no_price(void **state) {
    (void)state;
    const DipQuality pane = settings("aa=4,af=8");
    follow("aa=none", "aa=4,af=8");
    for (int i = 0; i < 25; i++) {
        dip_price_job_step(job, 0.0);
    }
    dip_price_job_interrupt(job);
    assert_int_equal(dip_prices_step(prices, DIP_SETTING_AA, 2, &pane).state, DIP_PRICE_UNKNOWN);
    assert_int_equal(dip_price_job_progress(job).rounds, 2); // Of three; the third begins anew.
    work_until_done();
    check_steps(&pane, 2e-5);
}

// The rule is that of a report: red above a fifth.
static void prices_of_a_busy_machine_are_doubtful(void **state) {
    (void)state;
    const DipQuality pane = settings("aa=4");
    for (int busy = 0; busy < 3; busy++) {
        waits = busy == 1 ? 0.6 : 0.1;
        dip_price_job_forget(job);
        follow("aa=none", "aa=4");
        work_until_done();
        const DipPrice price = dip_prices_step(prices, DIP_SETTING_AA, 2, &pane);
        assert_int_equal(price.doubtful, busy == 1);
        assert_int_equal(dip_prices_sum(prices, &pane).doubtful, busy == 1);
        check_near(price.ms, 3.0, 2e-5);
    }
}

// A few frames wait. They are left out, or drawn again.
static void disturbed_frames_make_no_price(void **state) {
    (void)state;
    const DipQuality pane = settings("aa=4,af=8,aaf=on");
    follow("aa=none", "aa=4,af=8,aaf=on");
    while (dip_price_job_progress(job).working) {
        slow = frames % 7 == 3 ? 2.0 : 1.0;
        waits = slow > 1.0 ? 0.5 : 0.0;
        dip_price_job_step(job, 0.0);
    }
    check_steps(&pane, 1e-3);
}

static void a_painter_that_fails_ends_the_job_with_its_reason(void **state) {
    (void)state;
    char text[128];
    follow("aa=none", "aa=4");
    refuses = true;
    assert_false(dip_price_job_step(job, 10.0));
    assert_true(dip_price_job_progress(job).failed);
    assert_false(dip_price_job_progress(job).working);
    dip_price_job_describe(job, text, sizeof text);
    assert_string_equal(text, "prices cannot be measured: no memory for samples");
    refuses = false;
    assert_false(dip_price_job_step(job, 10.0));
    assert_int_equal(frames, 0);
    dip_price_job_forget(job);
    work_until_done();
    assert_true(frames > 0);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        TEST(prices_are_those_of_the_painter),
        TEST(a_machine_that_slows_down_changes_no_ratio),
        TEST(intervals_hold_the_true_price),
        TEST(a_step_draws_one_frame_at_least_and_keeps_its_budget),
        TEST(progress_counts_steps_and_seconds),
        TEST(all_prices_are_soon_known_roughly),
        TEST(what_is_known_is_not_timed_again),
        TEST(the_nearest_steps_come_first),
        TEST(an_interrupted_block_leaves_no_price),
        TEST(prices_of_a_busy_machine_are_doubtful),
        TEST(disturbed_frames_make_no_price),
        TEST(a_painter_that_fails_ends_the_job_with_its_reason),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
