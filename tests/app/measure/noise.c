// Generators of the noise: recorded stretches, wandering levels, bursts and heavy tails.
#include "tests/app/measure/noise.h"

#include <math.h>
#include <stdbool.h>

const char *const noise_names[NOISE_KIND_COUNT] = {"quiet", "drift", "bursts", "tails", "all"};

static const double quiet[] = {
#include "tests/app/measure/quiet_noise.inc"
};

// SplitMix64 (Steele, Lea and Flood 2014).
static uint64_t next(NoiseRandom *random) {
    uint64_t z = random->state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return z ^ z >> 31;
}

double noise_uniform(NoiseRandom *random) {
    return (double)(next(random) >> 11) * 0x1p-53;
}

int noise_below(NoiseRandom *random, int count) {
    return (int)(noise_uniform(random) * count);
}

// Box and Muller 1958.
double noise_normal(NoiseRandom *random) {
    const double radius = sqrt(-2.0 * log(1.0 - noise_uniform(random)));
    return radius * cos(6.283185307179586 * noise_uniform(random));
}

double noise_student(NoiseRandom *random, int degrees) {
    const double value = noise_normal(random);
    double squares = 0.0;
    for (int i = 0; i < degrees; i++) {
        const double other = noise_normal(random);
        squares += other * other / degrees;
    }
    return value / sqrt(squares);
}

static double exponential(NoiseRandom *random, double mean) {
    return -mean * log(1.0 - noise_uniform(random));
}

// Stretches of 256 frames, each from a random part of the recording.
static void add_recorded(NoiseRandom *random, double *x, int count) {
    const int length = 256, recorded = (int)(sizeof quiet / sizeof *quiet);
    int from = 0;
    for (int i = 0; i < count; i++) {
        if (i % length == 0) {
            from = noise_below(random, recorded - length);
        }
        x[i] += 0.01 * quiet[from + i % length];
    }
}

// An Ornstein-Uhlenbeck process: standard deviation `spread`, correlation time `tau` frames.
static void add_drift(NoiseRandom *random, double *x, int count, double spread, double tau) {
    const int hold = 8; // Frames between two values.
    const double keep = exp(-hold / tau);
    double level = spread * noise_normal(random);
    for (int i = 0; i < count; i++) {
        if (i > 0 && i % hold == 0) {
            level = keep * level + spread * sqrt(1.0 - keep * keep) * noise_normal(random);
        }
        x[i] += level;
    }
}

static void add_bursts(NoiseRandom *random, double *x, int count) {
    const double share = 0.2, length = 200.0;
    bool on = noise_uniform(random) < share;
    for (int i = 0; i < count; i++) {
        const double change = on ? 1.0 / length : share / ((1.0 - share) * length);
        on ^= noise_uniform(random) < change;
        x[i] += on ? 0.47 : 0.0;
    }
}

static void add_tails(NoiseRandom *random, double *x, int count, double mean) {
    for (int i = 0; i < count; i++) {
        x[i] += noise_uniform(random) < 0.1 ? exponential(random, mean) : 0.0;
    }
}

void noise_run(NoiseKind kind, NoiseRandom *random, double *x, int count) {
    for (int i = 0; i < count; i++) {
        x[i] = kind == NOISE_QUIET ? 0.0 : 0.02 * noise_normal(random);
    }
    switch (kind) {
    case NOISE_QUIET:
        add_recorded(random, x, count);
        break;
    case NOISE_DRIFT:
        add_drift(random, x, count, 0.08, 0.25 * count);
        break;
    case NOISE_BURSTS:
        add_bursts(random, x, count);
        break;
    case NOISE_TAILS:
        add_tails(random, x, count, 0.5);
        break;
    default:
        add_drift(random, x, count, 0.05, 0.25 * count);
        add_bursts(random, x, count);
        add_tails(random, x, count, 0.3);
    }
}
