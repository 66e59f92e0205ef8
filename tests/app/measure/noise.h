// Simulated noise of frame times, for tests of estimators whose truth is then known.
//
// Noise is the logarithm of the factor by which a frame takes longer than usual. A run is a
// sequence of frames, one after another.
#ifndef DIP_TESTS_APP_MEASURE_NOISE_H
#define DIP_TESTS_APP_MEASURE_NOISE_H

#include <stdint.h>

typedef enum NoiseKind {
    NOISE_QUIET,  // Recorded on a quiet machine.
    NOISE_DRIFT,  // The level wanders by 8 % over a quarter of the run.
    NOISE_BURSTS, // Frames take 1.6 times as long, for a fifth of the time, about 200 at a stretch.
    NOISE_TAILS,  // One frame in ten takes up to several times as long.
    NOISE_ALL,    // Drift of 5 %, bursts, and tails of .3.
    NOISE_KIND_COUNT
} NoiseKind;

extern const char *const noise_names[NOISE_KIND_COUNT];

typedef struct NoiseRandom {
    uint64_t state;
} NoiseRandom;

double noise_uniform(NoiseRandom *random);              // 0 to 1, less than 1.
int noise_below(NoiseRandom *random, int count);        // 0 to count - 1.
double noise_normal(NoiseRandom *random);               // Mean 0, standard deviation 1.
double noise_student(NoiseRandom *random, int degrees); // Student's t.

// Fills log_noise[count] with a run.
void noise_run(NoiseKind kind, NoiseRandom *random, double *log_noise, int count);

#endif
