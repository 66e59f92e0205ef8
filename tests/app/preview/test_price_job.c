// Tests of the measurement of rough prices, with a painter and a clock that are made up.
#include "app/preview/live/price_job.h"
#include "app/report/combinations.h"

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
static uint64_t due; // Index of the frame that must follow a prepared one; 0 if none was prepared.
static int followed, histories; // Frames after such a frame, and all frames with a history.

// The time that a frame takes, without cold caches, drift or noise.
static double true_ms(const DipQuality *quality) {
    const uint8_t *step = quality->step;
    return 4.0 + 1.5 * step[DIP_SETTING_AA] + 0.5 * step[DIP_SETTING_AF] +
           0.25 * step[DIP_SETTING_AAF] - 0.125 * (3 - step[DIP_SETTING_MIPLOD]) +
           (step[DIP_SETTING_AAA] ? 1.0 - 0.125 * step[DIP_SETTING_ASD] : 0.0) +
           0.0625 * step[DIP_SETTING_AA] * step[DIP_SETTING_AF];
}

// Work and times of a frame in a made-up scene: fragments at edges grow with the samples, and
// probes with AF less than their number. The times follow from the work but for a share of it that
// the model of work does not know, and that differs from step to step of every setting. (If two
// steps had equal times, each would predict the other better than it predicts anything else.)
static bool works; // The painter tells its work, and its times follow from it.
static double unknown_share;

static double work_of(const DipQuality *quality, DipFrame *frame) {
    const double samples = dip_quality_sample_count(quality);
    const double groups = samples / dip_quality_samples_per_group(quality);
    const double probes = dip_quality_max_anisotropy(quality);
    const bool all = dip_quality_groups_shade_all(quality);
    const bool covers = dip_quality_covers_by_alpha(quality);
    const double fragments = 3e5 * (all ? groups : 1.0 + 0.2 * (1.0 - 1.0 / samples));
    const double bias = 1.0 - 0.1 * (DIP_MIPLOD_HIGH_QUALITY - quality->step[DIP_SETTING_MIPLOD]);
    const double detail = quality->step[DIP_SETTING_MIPLOD];
    const double step_of_aaa = all ? 1.0 : covers ? 2.0 : 0.0;
    DipCounters *c = &frame->counters;
    c->passes = 2;
    c->tiles_drawn = 80;
    c->triangles_in = 20000;
    c->triangles_drawn = 8000;
    c->tile_triangles = 15000;
    c->sub_blocks_tested = 100000;
    c->sub_blocks_accepted = 30000;
    c->fragments_shaded = (uint64_t)fragments;
    c->fragments_clip_tested = (uint64_t)(40000.0 * (quality->step[DIP_SETTING_AAA] ? groups : 1));
    c->clip_probes = c->fragments_clip_tested;
    c->samples_shown = (uint64_t)(3e5 * samples);
    c->pixels_resolved = samples > 1.0 ? 300000 : 0;
    c->texture_probes = (uint64_t)(fragments * bias *
                                   (1.0 + 0.6 * log2(probes) +
                                    (quality->step[DIP_SETTING_AAF] ? 0.1 * probes : 0.0)));
    c->texels_fetched = 6 * c->texture_probes;
    frame->stages.geometry_ms = 0.2 + 3e-5 * (double)c->triangles_in;
    frame->stages.raster_ms = 0.1 + 1e-6 * (double)c->samples_shown +
                              8e-6 * (double)c->fragments_clip_tested +
                              (covers ? 4e-6 : 0.0) * (double)c->clip_probes;
    frame->stages.shading_ms =
        (4e-6 * fragments + 5e-7 * (double)c->texels_fetched) *
        (1.0 +
         unknown_share *
             sin(7.0 * samples + 3.0 * probes + 2.0 * groups + 0.7 * detail + step_of_aaa +
                 0.9 * quality->step[DIP_SETTING_POST] + 0.6 * quality->step[DIP_SETTING_SHARPEN] +
                 1.1 * (quality->step[DIP_SETTING_SCALE] - DIP_SCALE_1) +
                 0.8 * quality->step[DIP_SETTING_UPSCALE] + 1.3 * quality->step[DIP_SETTING_TAA] +
                 0.5 * quality->step[DIP_SETTING_SHADOWS]));
    frame->stages.resolve_ms = 1e-6 * (double)c->pixels_resolved * samples;
    return frame->stages.geometry_ms + frame->stages.raster_ms + frame->stages.shading_ms +
           frame->stages.resolve_ms + 0.1;
}

static bool draw(void *context, const DipQuality *quality, uint64_t frame_index, DipFrame *frame,
                 DipError *err) {
    (void)context;
    if (refuses) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "renderer", "no memory for samples");
    }
    histories += dip_quality_has_history(quality);
    followed += due > 0;
    assert_true(due == 0 || (frame_index == due && dip_quality_has_history(quality)));
    due = 0;
    const bool cold = frames == 0 || memcmp(&last, quality, sizeof last) != 0;
    if (!cold && last_was_cold) {
        parities |= 1u << frame_index % 2;
    }
    random_ = random_ * 1664525u + 1013904223u;
    const double deviation = noise * ((random_ >> 16) / 32768.0 - 1.0);
    const double quiet_ms = works ? work_of(quality, frame) : true_ms(quality);
    const double ms =
        slow * quiet_ms * (cold ? 3.0 : 1.0) * (1.0 + drift * frames) * (1.0 + deviation);
    now_ns += (int64_t)llround(1e6 * ms);
    use.wait_ns += (int64_t)llround(1e6 * ms * waits);
    last = *quality;
    last_was_cold = cold;
    frames++;
    return true;
}

static bool prepare(void *context, const DipQuality *quality, uint64_t frame_index, DipError *err) {
    (void)context;
    (void)err;
    assert_true(due == 0 && dip_quality_has_history(quality));
    due = frame_index + 1;
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
    due = 0;
    followed = histories = 0;
    works = false;
    prices = dip_prices_create(NULL);
    waits = 0.0;
    slow = 1.0;
    use = (DipThreadUse){.has_wait = true};
    const DipPriceJobCalls calls = {
        .draw = draw,
        .prepare = prepare,
        .now_ns = read_clock,
        .thread_use = read_use,
        .threads = 1,
    };
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
    check_near(dip_prices_step(prices, DIP_SETTING_AAA, DIP_AAA_ON, &pane).ms, 0.875, 2e-5);
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

// Compares the predictions of all combinations that were not timed with the truth. Returns how many
// there are.
static int check_predictions(int *outside) {
    DipQuality list[4096];
    const unsigned settings_of = 1u << DIP_SETTING_AA | 1u << DIP_SETTING_AAA |
                                 1u << DIP_SETTING_AF | 1u << DIP_SETTING_AAF |
                                 1u << DIP_SETTING_MIPLOD;
    const DipQuality base = dip_quality_default();
    const int count = dip_cost_list_combinations(&base, settings_of, list, 4096);
    int predicted = 0;
    for (int i = 0; i < count; i++) {
        DipFrame frame = {0};
        const double ms = work_of(&list[i], &frame);
        const DipPriceSum sum = dip_prices_sum(prices, &list[i]);
        if (sum.state == DIP_PRICE_PREDICTED) {
            predicted++;
            assert_true(sum.ms_high < 1.3 * sum.ms);
            *outside += ms < sum.ms_low || ms > sum.ms_high;
        }
    }
    return predicted;
}

// Predictions from what was measured live miss by more than their interval of 95 % in about one of
// twenty combinations, however much of the times the work explains. A report that was read predicts
// the same.
static void predictions_miss_as_often_as_they_say(void **state) {
    static const char *const panes[] = {"aa=4,aaa=on,af=8,aaf=on", "aa=none", "aa=8,aaa=on,af=16",
                                        "aa=2,af=4", "aa=6,af=2,miplod=performance"};
    int predicted = 0, outside = 0;
    tear_down(state);
    for (int i = 0; i < 15; i++) {
        set_up(state);
        works = true;
        noise = 0.02;
        unknown_share = 0.04 * (i % 3);
        random_ = (unsigned)(1 + i);
        follow("aa=none", panes[i / 3]);
        work_until_done();
        predicted += check_predictions(&outside);
        DipPrices *read_prices = dip_prices_create(NULL);
        assert_true(dip_prices_set_report(read_prices, dip_prices_live(prices), NULL));
        const DipQuality other = settings("aa=2,af=2,miplod=quality");
        const DipPriceSum a = dip_prices_sum(prices, &other);
        const DipPriceSum b = dip_prices_sum(read_prices, &other);
        assert_true(a.state == b.state && a.ms == b.ms && a.ms_low == b.ms_low);
        dip_prices_destroy(&read_prices);
        tear_down(state);
    }
    set_up(state);
    assert_true(predicted > 1000);
    // The share depends much on the random numbers, since one pane's misses belong together.
    if (outside > 0.1 * predicted) {
        fail_msg("%d of %d predictions lie outside of their intervals", outside, predicted);
    }
}

// Of each two frames with a history, the second one is timed and follows a frame of its own.
static void timed_frames_with_a_history_follow_another_frame(void **state) {
    (void)state;
    follow("aa=none", "taa=history");
    work_until_done();
    assert_true(followed > 0);
    assert_int_equal(histories, 2 * followed);
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
        TEST(timed_frames_with_a_history_follow_another_frame),
        TEST(the_nearest_steps_come_first),
        TEST(an_interrupted_block_leaves_no_price),
        TEST(prices_of_a_busy_machine_are_doubtful),
        TEST(disturbed_frames_make_no_price),
        TEST(predictions_miss_as_often_as_they_say),
        TEST(a_painter_that_fails_ends_the_job_with_its_reason),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
