// Ratios and times along a path from simulated logs whose truth is known. The simulation draws the
// schedule that the tool runs: visits of four frames beside the base, in shuffled blocks, rounds
// and starts.
#include "app/measure/stats/rounds.h"
#include "app/measure/stats/estimate.h"
#include "renderer/base/assert.h"
#include "renderer/base/trig.h"
#include "tests/app/measure/noise.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- the simulated machine -----------------------------------------------------------------------

enum {
    FRAMES = 64,
    VISIT = 4, // Timed frames of a visit; an untimed one goes before them.
    ROUNDS = 16,
    COPIES = 3,
    SUBJECTS = 13, // Subject 0 is the base; subject 1 draws the same (A/A).
    BLOCK = 4,     // Subjects of a block, besides the base.
    BLOCKS = 3,
    OTHERS = 9, // Blocks of other paths between them, per round.
    BLOCK_SLOTS = (BLOCK + 1) * (VISIT + 1),
    ROUND_SLOTS = (BLOCKS + OTHERS) * BLOCK_SLOTS,
    SLOTS = ROUNDS * ROUND_SLOTS, // A slot is the time of a frame.
    MOST = ROUNDS * (BLOCKS * (BLOCK + 1) + COPIES) * VISIT,
    RUNS = 400
};

typedef enum Scenario {
    QUIET,
    CALIBRATED,
    BURSTS,
    DRIFT,
    STEPS,
    NEIGHBOUR,
    CROWDED,
    SCENARIOS
} Scenario;
static const char *const names[] = {"quiet", "calibrated", "bursts", "drift",
                                    "steps", "neighbour",  "crowded"};

typedef struct World {
    Scenario scenario;
    int starts;
    bool flat;     // All frames take equally long.
    double wobble; // Of each round.
    double crowd;  // How much more noise a crowded host makes than usual.
    NoiseRandom random;
    double slots[SLOTS];           // Logarithm of the machine's slowness.
    bool loaded[SLOTS];            // A neighbour runs.
    double luck[SUBJECTS][ROUNDS]; // Of a subject in a start.
    double base[FRAMES];           // Milliseconds.
    double log_ratio[SUBJECTS][FRAMES];
    DipTimed list[MOST];
    int count;
} World;

// Smoothed random walks; standard deviation 1, mean 0.
static void walk(NoiseRandom *random, double to[FRAMES]) {
    double at = 0.0, steps[FRAMES], mean = 0.0, squares = 0.0;
    for (int f = 0; f < FRAMES; f++) {
        at += noise_normal(random);
        steps[f] = at;
    }
    for (int f = 0; f < FRAMES; f++) {
        to[f] = 0.0;
        for (int d = -3; d <= 3; d++) {
            const int i = f + d < 0 ? 0 : f + d >= FRAMES ? FRAMES - 1 : f + d;
            to[f] += steps[i] / 7.0;
        }
        mean += to[f] / FRAMES;
    }
    for (int f = 0; f < FRAMES; f++) {
        squares += (to[f] - mean) * (to[f] - mean) / FRAMES;
    }
    for (int f = 0; f < FRAMES; f++) {
        to[f] = (to[f] - mean) / sqrt(squares);
    }
}

static void make_scene(World *w) {
    double curve[FRAMES];
    walk(&w->random, curve);
    for (int f = 0; f < FRAMES; f++) {
        w->base[f] = 7.0 * exp(w->flat ? 0.0 : 0.17 * curve[f]);
    }
    for (int s = 1; s < SUBJECTS; s++) {
        walk(&w->random, curve);
        const double ratio = s == 1 ? 1.0 : 1.0 + 0.1 * s;
        for (int f = 0; f < FRAMES; f++) {
            w->log_ratio[s][f] = log(ratio) + (s == 1 || w->flat ? 0.0 : 0.06 * curve[f]);
        }
    }
}

static void make_steps(World *w) {
    static const double levels[] = {0.0, 0.1, 0.22};
    double level = levels[noise_below(&w->random, 3)];
    for (int i = 0; i < SLOTS; i++) {
        if (noise_uniform(&w->random) < 1.0 / 600.0) {
            level = levels[noise_below(&w->random, 3)];
        }
        w->slots[i] = level + 0.02 * noise_normal(&w->random);
    }
}

static void make_neighbour(World *w) {
    bool on = noise_uniform(&w->random) < 0.5;
    for (int i = 0; i < SLOTS; i++) {
        on ^= noise_uniform(&w->random) < 1.0 / 300.0;
        w->loaded[i] = on;
        w->slots[i] = 0.02 * noise_normal(&w->random) +
                      (on ? 0.3 + 0.25 * fabs(noise_normal(&w->random)) : 0.0);
    }
}

static void make_machine(World *w) {
    memset(w->loaded, 0, sizeof w->loaded);
    memset(w->slots, 0, sizeof w->slots);
    switch (w->scenario) {
    case QUIET:
        noise_run(NOISE_QUIET, &w->random, w->slots, SLOTS);
        break;
    case CALIBRATED:
    case CROWDED:
        break;
    case BURSTS:
        noise_run(NOISE_BURSTS, &w->random, w->slots, SLOTS);
        break;
    case DRIFT:
        noise_run(NOISE_DRIFT, &w->random, w->slots, SLOTS);
        break;
    case STEPS:
        make_steps(w);
        break;
    default:
        make_neighbour(w);
    }
    // Of a single start, the luck belongs to the truth: nothing within the start shows it.
    const double spread = w->starts == 1 ? 0.0 : w->scenario == CALIBRATED ? 0.016 : 0.006;
    for (int s = 0; s < SUBJECTS; s++) {
        const double own = spread * exp(0.5 * noise_normal(&w->random));
        for (int start = 0; start < w->starts; start++) {
            w->luck[s][start] = own * noise_normal(&w->random);
        }
    }
    for (int r = 0; r < ROUNDS; r++) {
        const double wobble = w->wobble * noise_normal(&w->random);
        for (int i = 0; i < ROUND_SLOTS; i++) {
            w->slots[r * ROUND_SLOTS + i] += wobble;
        }
    }
}

static void visit(World *w, int subject, int round, int block, const int *frames, int slot) {
    // A crowded host: processors that share their cores with other virtual machines.
    const double shared = w->scenario == CALIBRATED ? 0.044 * noise_normal(&w->random)
                          : w->scenario == CROWDED  ? 0.09 * w->crowd * noise_normal(&w->random)
                                                    : 0.0;
    const double own = w->scenario == CALIBRATED ? 0.05
                       : w->scenario == CROWDED  ? 0.12 * w->crowd
                                                 : 0.004;
    for (int i = 0; i < VISIT; i++) {
        double noise = 0.0, wait = 1.0;
        for (int again = 0; wait > DIP_TIMED_MOST_WAIT && again < 2; again++) {
            const int at = slot + 1 + i + again < SLOTS ? slot + 1 + i + again : SLOTS - 1;
            wait = (w->loaded[at] ? 0.5 : 0.05) * noise_uniform(&w->random);
            noise = w->slots[at] + own * noise_normal(&w->random);
        }
        const int per_start = ROUNDS / w->starts;
        w->list[w->count++] = (DipTimed){
            .subject = subject,
            .start = round / per_start,
            .round = round % per_start,
            .block = block,
            .frame = frames[i],
            .ms = w->base[frames[i]] * exp(w->log_ratio[subject][frames[i]] + noise + shared +
                                           w->luck[subject][round / per_start]),
            .wait = wait,
        };
    }
}

static void shuffle(NoiseRandom *random, int *values, int count) {
    for (int i = count - 1; i > 0; i--) {
        const int other = noise_below(random, i + 1);
        const int swap = values[i];
        values[i] = values[other];
        values[other] = swap;
    }
}

static void list_frames(const int *round_of, int copy, int round, int frames[VISIT]) {
    int count = 0;
    for (int f = 0; f < FRAMES; f++) {
        if (round_of[copy * FRAMES + f] == round) {
            assert_true(count < VISIT);
            frames[count++] = f;
        }
    }
    assert_int_equal(count, VISIT);
}

static void run_round(World *w, const int *round_of, int round) {
    int places[BLOCKS + OTHERS], order[SUBJECTS - 1], frames[VISIT];
    for (int i = 0; i < BLOCKS + OTHERS; i++) {
        places[i] = i;
    }
    for (int i = 0; i < SUBJECTS - 1; i++) {
        order[i] = i + 1;
    }
    shuffle(&w->random, places, BLOCKS + OTHERS);
    shuffle(&w->random, order, SUBJECTS - 1);
    list_frames(round_of, 0, round, frames);
    for (int b = 0; b < BLOCKS; b++) {
        int visits[BLOCK + 1] = {0}, count = 1;
        for (int i = b * BLOCK; i < (b + 1) * BLOCK && i < SUBJECTS - 1; i++) {
            visits[count++] = order[i];
        }
        shuffle(&w->random, visits, count);
        const int slot = round * ROUND_SLOTS + places[b] * BLOCK_SLOTS;
        for (int i = 0; i < count; i++) {
            visit(w, visits[i], round, b, frames, slot + i * (VISIT + 1));
        }
    }
    for (int copy = 1; copy < COPIES; copy++) {
        list_frames(round_of, copy, round, frames);
        const int slot = round * ROUND_SLOTS + places[BLOCKS + copy] * BLOCK_SLOTS;
        visit(w, 0, round, BLOCKS + copy, frames, slot);
    }
}

static const int base_of[SUBJECTS] = {0};

static DipTimesFit *simulate(World *w) {
    int round_of[COPIES * FRAMES];
    w->count = 0;
    make_scene(w);
    make_machine(w);
    assert_true(dip_rounds_deal(FRAMES, ROUNDS, COPIES, w->random.state, round_of, NULL));
    for (int round = 0; round < ROUNDS; round++) {
        run_round(w, round_of, round);
    }
    const DipTimes times = {w->list, w->count, SUBJECTS, w->starts, ROUNDS / w->starts,
                            FRAMES,  base_of,  false};
    DipTimesFit *fit = dip_times_fit(&times, NULL);
    assert_non_null(fit);
    return fit;
}

typedef struct Truth {
    double mean, p95, worst; // Milliseconds.
} Truth;

static Truth truth_of(const World *w, int subject) {
    double ms[FRAMES];
    Truth truth = {0};
    for (int f = 0; f < FRAMES; f++) {
        ms[f] = w->base[f] * exp(w->log_ratio[subject][f]);
        truth.mean += ms[f] / FRAMES;
        truth.worst = fmax(truth.worst, ms[f]);
    }
    truth.p95 = dip_percentile(ms, FRAMES, 0.95);
    return truth;
}

// --- how well the estimates do -------------------------------------------------------------------

typedef struct Score {
    double covered;        // Share of the ratios' intervals that hold the truth.
    double steps_covered;  // The same of ratios of two subjects.
    double frames_covered; // The same of intervals that draw single frames.
    double half_width;     // Mean half width of the ratios' intervals, as a logarithm.
    double p95_bias;       // Of p95 / mean: mean of the logarithm's error,
    double p95_error;      // and its root mean square.
    double p95_held;       // Share of the upper ends of p95 that are not below the truth.
    double moved;          // Mean change of p95 / mean by the wobble.
} Score;

static bool holds(const DipEstimate *estimate, double truth) {
    return estimate->low <= truth && truth <= estimate->high;
}

// The interval of a subject's ratio as if the frames of a visit were independent of each other:
// Student's t of all the log ratios. The smooth change of the ratio along the path is taken off.
static DipEstimate draw_single_frames(const World *w, int subject) {
    const DipTimed *base[BLOCKS + COPIES][ROUNDS][VISIT] = {0};
    double logs[FRAMES], mean = 0.0, squares = 0.0;
    const int per_start = ROUNDS / w->starts;
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < w->count; i++) {
            const DipTimed *t = &w->list[i];
            const DipTimed **beside = base[t->block][t->start * per_start + t->round];
            if (pass == 0 && t->subject == 0) {
                beside[i % VISIT] = t;
            } else if (pass == 1 && t->subject == subject) {
                logs[t->frame] =
                    log(t->ms / beside[i % VISIT]->ms) - w->log_ratio[subject][t->frame];
            }
        }
    }
    for (int f = 0; f < FRAMES; f++) {
        mean += logs[f] / FRAMES;
    }
    for (int f = 0; f < FRAMES; f++) {
        squares += (logs[f] - mean) * (logs[f] - mean) / (FRAMES - 1);
    }
    return dip_estimate_make(exp(mean), sqrt(squares / FRAMES), FRAMES - 1);
}

static void add_score(Score *score, const World *w, const DipTimesFit *fit, int s, double usual,
                      double share) {
    const int next = s + 1 < SUBJECTS ? s + 1 : 1;
    const Truth base = truth_of(w, 0), truth = truth_of(w, s), other = truth_of(w, next);
    const DipEstimate ratio = dip_times_ratio(fit, s);
    const DipEstimate step = dip_times_ratio_of(fit, s, next);
    const DipEstimate single = draw_single_frames(w, s);
    const DipAlong along = dip_times_along(fit, s);
    const double shape = along.p95_ms.value / along.mean_ms.value;
    const double miss = log(shape * truth.mean / truth.p95);
    score->covered += share * holds(&ratio, truth.mean / base.mean);
    score->steps_covered += share * holds(&step, truth.mean / other.mean);
    score->frames_covered += share * holds(&single, 1.0);
    score->half_width += share * 0.5 * log(ratio.high / ratio.low);
    score->p95_bias += share * miss;
    score->p95_error += share * miss * miss;
    score->p95_held += share * (along.p95_ms.high >= usual * truth.p95);
}

static World world;

static void begin_world(Scenario scenario, int starts, bool flat) {
    world = (World){.scenario = scenario, .starts = starts, .flat = flat, .crowd = 1.0};
    world.random.state = 77 + (uint64_t)scenario * 1000 + (uint64_t)starts;
}

static Score score(Scenario scenario, int starts, bool flat, int runs) {
    static double sorted[SLOTS];
    Score score = {0};
    begin_world(scenario, starts, flat);
    for (int run = 0; run < runs; run++) {
        DipTimesFit *fit = simulate(&world);
        memcpy(sorted, world.slots, sizeof sorted);
        const double usual = exp(dip_median(sorted, SLOTS));
        for (int s = 1; s < SUBJECTS; s++) {
            add_score(&score, &world, fit, s, usual, 1.0 / (runs * (SUBJECTS - 1.0)));
        }
        dip_times_fit_free(&fit);
    }
    score.p95_error = sqrt(score.p95_error);
    print_message("%d start%s, %-10s %s: ratios covered %4.1f %%, of two steps %4.1f %%, by single "
                  "frames %4.1f %%; half width %.1f %%; p95 / mean: bias %+.1f %%, rms %.1f %%, "
                  "p95 held %5.1f %%\n",
                  starts, starts == 1 ? " " : "s", names[scenario], flat ? "flat" : "path",
                  100.0 * score.covered, 100.0 * score.steps_covered, 100.0 * score.frames_covered,
                  100.0 * score.half_width, 100.0 * score.p95_bias, 100.0 * score.p95_error,
                  100.0 * score.p95_held);
    return score;
}

static void intervals_over_starts_hold_the_truth(void **state) {
    (void)state;
    for (int i = 0; i < SCENARIOS; i++) {
        const Score got = score((Scenario)i, 4, false, 400);
        assert_true(got.covered >= 0.93 && got.covered <= 0.98);
        assert_true(got.steps_covered >= 0.93 && got.steps_covered <= 0.98);
        assert_true(fabs(got.p95_bias) < 0.02);
        assert_true(got.p95_error < (i == CROWDED ? 0.07 : 0.05));
        assert_true(got.p95_held >= 0.95);
    }
}

static void intervals_of_one_start_hold_its_truth(void **state) {
    (void)state;
    for (int i = 0; i < SCENARIOS; i++) {
        const Score got = score((Scenario)i, 1, false, 100);
        assert_true(got.covered >= 0.92 && got.covered <= 0.99);
        assert_true(fabs(got.p95_bias) < 0.02 && got.p95_error < (i == CROWDED ? 0.07 : 0.05));
    }
}

static void single_frames_hold_the_truth_too_rarely(void **state) {
    (void)state;
    assert_true(score(CALIBRATED, 4, false, 100).frames_covered < 0.85);
}

// Frames that cost alike must not be told apart by the moments in which they were timed.
static void a_moment_is_not_a_place(void **state) {
    (void)state;
    const Score drift = score(DRIFT, 4, true, 100);
    assert_true(fabs(drift.p95_bias) < 0.02 && drift.p95_error < 0.02 && drift.p95_held > 0.97);
}

// Noise as large as what changes along the path hides single frames, but their neighbours still
// show the path: its 95th percentile becomes neither the mean nor what noise makes of it.
static void noise_does_not_hide_the_path(void **state) {
    (void)state;
    double squares = 0.0;
    enum { TRIES = 100 };
    for (int run = 0; run < TRIES; run++) {
        begin_world(CROWDED, 4, false);
        world.random.state += (uint64_t)run;
        world.crowd = 1.5;
        DipTimesFit *fit = simulate(&world);
        const Truth truth = truth_of(&world, 0);
        const DipAlong along = dip_times_along(fit, 0);
        const double miss = log(along.p95_ms.value / along.mean_ms.value * truth.mean / truth.p95);
        squares += miss * miss / TRIES;
        dip_times_fit_free(&fit);
    }
    print_message("a crowded host: p95 / mean of the base has an rms error of %.1f %%\n",
                  100.0 * sqrt(squares));
    assert_true(sqrt(squares) < 0.048);
}

static void a_wobble_of_rounds_does_not_move_p95(void **state) {
    (void)state;
    double moved = 0.0;
    enum { WOBBLES = 20 };
    for (int run = 0; run < WOBBLES; run++) {
        double shape[2][SUBJECTS];
        for (int pass = 0; pass < 2; pass++) {
            begin_world(CALIBRATED, 4, false);
            world.random.state += (uint64_t)run;
            world.wobble = pass == 0 ? 0.0 : 0.1;
            DipTimesFit *fit = simulate(&world);
            for (int s = 0; s < SUBJECTS; s++) {
                const DipAlong along = dip_times_along(fit, s);
                shape[pass][s] = along.p95_ms.value / along.mean_ms.value;
            }
            dip_times_fit_free(&fit);
        }
        for (int s = 0; s < SUBJECTS; s++) {
            const double change = fabs(log(shape[1][s] / shape[0][s]));
            assert_true(change < 0.02);
            moved += change / (WOBBLES * SUBJECTS);
        }
    }
    print_message("a wobble of 10 %% moves p95 / mean by %.2g %%\n", 100.0 * moved);
}

// --- exact cases ---------------------------------------------------------------------------------

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
    static DipTimed list[COPIES * BLOCKS * FRAMES];
    NoiseRandom random = {5};
    int round_of[COPIES * FRAMES], count = 0;
    double curve[FRAMES];
    walk(&random, curve);
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
    enum { PATH = 70, DEALT = 16 };
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

// --- estimates -----------------------------------------------------------------------------------

// Published tables of the distribution (for example NIST's handbook, section 1.3.6.7.2).
static void student_has_the_published_quantiles(void **state) {
    (void)state;
    static const struct {
        double probability, degrees, value;
    } table[] = {{0.975, 1, 12.706}, {0.975, 2, 4.303},  {0.975, 3, 3.182},  {0.975, 6, 2.447},
                 {0.975, 13, 2.160}, {0.975, 15, 2.131}, {0.975, 30, 2.042}, {0.975, 100, 1.984},
                 {0.95, 5, 2.015},   {0.995, 10, 3.169}, {0.9, 7, 1.415},    {0.975, 1e9, 1.960},
                 {0.975, 3.5, 2.939}};
    for (size_t i = 0; i < DIP_ARRAY_COUNT(table); i++) {
        const double got = dip_student_quantile(table[i].probability, table[i].degrees);
        assert_true(fabs(got - table[i].value) < (table[i].degrees == 3.5 ? 0.05 : 6e-4));
    }
    assert_true(fabs(dip_student_quantile(0.5, 4)) < 1e-9);
    // Closed forms for 1 and 2 degrees of freedom, and the normal distribution, at the bounds of
    // the most rows that a report has.
    for (double beyond = 1e-6; beyond < 0.5; beyond *= 3.0) {
        const double p = 1.0 - beyond;
        const double cauchy = 1.0 / tan(DIP_PI * beyond);
        const double two = (2.0 * p - 1.0) / sqrt(2.0 * p * beyond);
        assert_true(fabs(dip_student_quantile(p, 1.0) / cauchy - 1.0) < 1e-8);
        assert_true(fabs(dip_student_quantile(p, 2.0) / two - 1.0) < 1e-8);
    }
    assert_true(fabs(dip_student_quantile(0.999999, INFINITY) - 4.753424) < 1e-6);
}

static void an_estimate_needs_a_finite_error_and_a_degree_of_freedom(void **state) {
    (void)state;
    static const double unknown[][2] = {{0.0, 5.0},      {-0.1, 5.0}, {NAN, 5.0}, {INFINITY, 5.0},
                                        {INFINITY, 0.0}, {0.1, 0.99}, {0.1, NAN}};
    for (size_t i = 0; i < sizeof unknown / sizeof *unknown; i++) {
        const DipEstimate e = dip_estimate_make(2.0, unknown[i][0], unknown[i][1]);
        assert_true(e.value == 2.0 && isnan(e.low) && isnan(e.high));
        assert_true(isnan(e.log_error) && isnan(e.degrees));
    }
    const DipEstimate known = dip_estimate_make(2.0, 0.1, 1.0);
    assert_true(known.low < 2.0 && known.high > 2.0);
}

static void an_estimate_says_how_likely_a_limit_holds(void **state) {
    (void)state;
    const DipEstimate known = dip_estimate_make(10.0, 0.05, INFINITY);
    assert_true(fabs(log(known.high / 10.0) - 1.95996 * 0.05) < 1e-4);
    assert_true(fabs(dip_estimate_chance_below(&known, known.high, 0.0) - 0.975) < 1e-4);
    assert_true(fabs(dip_estimate_chance_below(&known, 10.0, 0.0) - 0.5) < 1e-9);
    assert_true(dip_estimate_chance_below(&known, known.high, 0.05) < 0.93);
    const DipEstimate wider = dip_estimate_widen(&known, 0.05);
    assert_true(wider.low < known.low && wider.high > known.high);
    const DipEstimate unknown = dip_estimate_make(10.0, 0.0, 5.0);
    assert_true(unknown.value == 10.0 && isnan(unknown.low) && isnan(unknown.high));
    assert_true(isnan(dip_estimate_chance_below(&unknown, 12.0, 0.0)));
}

static void a_percentile_is_linear_between_neighbours(void **state) {
    (void)state;
    double values[20];
    for (int i = 0; i < 20; i++) {
        values[i] = 20.0 - i;
    }
    assert_true(fabs(dip_percentile(values, 20, 0.95) - 19.05) < 1e-12);
    assert_true(dip_percentile(values, 1, 0.95) == 1.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(intervals_over_starts_hold_the_truth),
        cmocka_unit_test(intervals_of_one_start_hold_its_truth),
        cmocka_unit_test(single_frames_hold_the_truth_too_rarely),
        cmocka_unit_test(a_moment_is_not_a_place),
        cmocka_unit_test(noise_does_not_hide_the_path),
        cmocka_unit_test(a_wobble_of_rounds_does_not_move_p95),
        cmocka_unit_test(a_log_without_noise_is_exact),
        cmocka_unit_test(visits_that_draw_other_frames_besides_are_told_apart),
        cmocka_unit_test(what_is_not_known_has_no_interval),
        cmocka_unit_test(disturbed_frames_take_no_part),
        cmocka_unit_test(frames_of_every_round_keep_their_ratio),
        cmocka_unit_test(ratios_of_many_visits_are_known),
        cmocka_unit_test(frames_are_dealt_evenly),
        cmocka_unit_test(student_has_the_published_quantiles),
        cmocka_unit_test(an_estimate_needs_a_finite_error_and_a_degree_of_freedom),
        cmocka_unit_test(an_estimate_says_how_likely_a_limit_holds),
        cmocka_unit_test(a_percentile_is_linear_between_neighbours),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
