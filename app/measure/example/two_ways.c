// The smallest client of app/measure/. It compares the time and the error of two ways to fill a
// picture. It links only dip_measure and uses none of Diptych's commands.
#include "app/measure/metrics/flip.h"
#include "app/measure/metrics/metrics.h"
#include "app/measure/stats/paired.h"
#include "app/measure/stats/statistics.h"
#include "app/measure/timing/timing.h"

#include <math.h>
#include <stdio.h>

enum { WIDTH = 128, HEIGHT = 96, FRAMES = 2, ROUNDS = 12 };

// FULL_AGAIN is FULL under another index (A/A): the ratio of their times shows the machine's noise.
enum { FULL, FULL_AGAIN, EVERY_OTHER, SUBJECTS };

static uint8_t pictures[SUBJECTS][WIDTH * HEIGHT * 4];

static uint8_t shade(int x, int y, int frame) {
    return (uint8_t)(127.5 + 127.0 * sin(0.001 * x * y + 0.1 * frame));
}

// FULL computes every pixel. EVERY_OTHER computes every second pixel and repeats it.
static bool fill(void *context, const DipTimingTurn *turn, DipError *err) {
    (void)context;
    (void)err;
    const int step = turn->subject == EVERY_OTHER ? 2 : 1;
    uint8_t *to = pictures[turn->subject];
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++, to += 4) {
            if (x % step == 0) {
                to[0] = to[1] = to[2] = shade(x, y, turn->frame);
            } else {
                to[0] = to[1] = to[2] = to[-4];
            }
        }
    }
    return true;
}

static double flip_between(int test, int truth) {
    DipFlip flip = {0};
    DipFlipAnalysis analysis = {{0}, NULL};
    const DipSrgbPicture a = {pictures[test], (size_t)WIDTH * 4, WIDTH, HEIGHT};
    const DipSrgbPicture b = {pictures[truth], (size_t)WIDTH * 4, WIDTH, HEIGHT};
    static float map[WIDTH * HEIGHT];
    double mean = -1.0;
    if (dip_flip_init(&flip, WIDTH, HEIGHT, DIP_FLIP_PIXELS_PER_DEGREE) &&
        dip_flip_analysis_init(&flip, &analysis)) {
        dip_flip_analyse(&flip, &b, &analysis);
        dip_flip_compare(&flip, &a, &analysis, map);
        mean = 0.0;
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            mean += (double)map[i] / (WIDTH * HEIGHT);
        }
    }
    dip_flip_analysis_free(&analysis);
    dip_flip_free(&flip);
    return mean;
}

int main(void) {
    const DipTimingDef def = {.subject_count = SUBJECTS,
                              .frame_count = FRAMES,
                              .version_count = 1,
                              .round_count = ROUNDS,
                              .seed = 1,
                              .settle = true};
    const DipTimingCalls calls = {.run = fill};
    double ms[SUBJECTS * ROUNDS * FRAMES];
    DipError err = {0};
    if (!dip_timing_run(&def, &calls, ms, &err)) {
        fprintf(stderr, "%s\n", err.message);
        return 1;
    }
    const char *const names[SUBJECTS] = {"every pixel", "every pixel again", "every other pixel"};
    const double *base_ms = ms + dip_timing_index(&def, 0, FULL);
    printf("%-18s %8s %24s %8s\n", "", "ms", "ratio (95 % interval)", "FLIP");
    for (int s = 0; s < SUBJECTS; s++) {
        const double *subject_ms = ms + dip_timing_index(&def, 0, s);
        const DipPairedTimes times = {subject_ms, base_ms, ROUNDS, FRAMES};
        DipStatsEstimate ratio;
        if (!dip_paired_ratio(&times, &ratio, &err)) {
            fprintf(stderr, "%s\n", err.message);
            return 1;
        }
        double scratch[ROUNDS];
        printf("%-18s %8.3f    %.3f (%.3f to %.3f) %8.4f\n", names[s],
               dip_stats_time(subject_ms, FRAMES, ROUNDS, scratch), ratio.value, ratio.low,
               ratio.high, flip_between(s, FULL));
    }
    return 0;
}
