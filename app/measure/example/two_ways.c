// Shows how to use the library dip_measure (app/measure/). Compares the time and the error of two
// ways to fill a picture. The program links only dip_measure and uses none of Diptych's commands.
#include "app/measure/metrics/flip.h"
#include "app/measure/metrics/metrics.h"
#include "app/measure/timing/driver.h"

#include <math.h>
#include <stdio.h>

enum { WIDTH = 128, HEIGHT = 96, FRAMES = 2, ROUNDS = 12 };

// The subjects that are timed. FULL_AGAIN draws the same as FULL, so the ratio of their times shows
// the machine's noise.
enum { FULL, FULL_AGAIN, EVERY_OTHER, SUBJECTS };

static uint8_t pictures[SUBJECTS][WIDTH * HEIGHT * 4];

static uint8_t shade(int x, int y, int frame) {
    return (uint8_t)(127.5 + 127.0 * sin(0.001 * x * y + 0.1 * frame));
}

// Draws a frame. FULL and FULL_AGAIN compute every pixel. EVERY_OTHER computes every second pixel
// and repeats it.
static bool fill(void *context, const DipDriverTurn *turn, DipTimed *timed, DipError *err) {
    (void)context;
    (void)timed;
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
    static const int base_of[SUBJECTS] = {FULL, FULL, FULL};
    const DipDriverDef def = {.subjects = SUBJECTS,
                              .base_of = base_of,
                              .block_subjects = SUBJECTS - 1,
                              .starts = 1,
                              .rounds = ROUNDS,
                              .frames = FRAMES,
                              .warm_frames = FRAMES,
                              .seed = 1,
                              .settle = true};
    DipError err = {0};
    DipDriver *driver = dip_driver_create(&def, &(DipDriverCalls){.draw = fill}, &err);
    DipDriverStep step = DIP_DRIVER_FAILED;
    while (driver && (step = dip_driver_step(driver, &err)) < DIP_DRIVER_DONE) {
    }
    const DipTimes times = step == DIP_DRIVER_DONE ? dip_driver_times(driver) : (DipTimes){0};
    DipTimesFit *fit = step == DIP_DRIVER_DONE ? dip_times_fit(&times, &err) : NULL;
    dip_driver_destroy(&driver);
    if (!fit) {
        fprintf(stderr, "%s\n", err.message);
        return 1;
    }
    const char *const names[SUBJECTS] = {"every pixel", "every pixel again", "every other pixel"};
    printf("%-18s %8s %24s %8s\n", "", "ms", "ratio (95 % interval)", "FLIP");
    for (int s = 0; s < SUBJECTS; s++) {
        const DipEstimate ratio = dip_times_ratio(fit, s);
        printf("%-18s %8.3f    ", names[s], dip_times_along(fit, s).mean_ms.value);
        if (s == FULL) {
            printf("%-21s", "1");
        } else {
            printf("%.3f (%.3f to %.3f)", ratio.value, ratio.low, ratio.high);
        }
        printf(" %8.4f\n", flip_between(s, FULL));
    }
    dip_times_fit_free(&fit);
    return 0;
}
