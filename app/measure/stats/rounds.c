// Deals frames to rounds, and computes the estimates that rounds.h declares from a fit. A unit is a
// start of the program, or a round if there is one start (rounds_fit_private.h).
#include "app/measure/stats/rounds_fit_private.h"

#include "app/measure/stats/random.h"
#include "renderer/base/assert.h"
#include "renderer/base/fp_mode.h"

#include <stdlib.h>

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "timing", "out of memory");
}

// --- which frames a round draws ------------------------------------------------------------------

// Cuts the path into stretches of as many frames as there are rounds. In each stretch, copy 0 deals
// the frames to the rounds in shuffled order. Each other copy uses the same order, shifted by a
// random distance that no other copy has.
bool dip_rounds_deal(int frames, int rounds, int copies, uint64_t seed, int *round_of,
                     DipError *err) {
    DIP_ASSERT(frames > 0 && rounds > 0 && copies > 0 && copies <= rounds);
    int *order = malloc(2 * (size_t)rounds * sizeof *order);
    if (!order) {
        return out_of_memory(err);
    }
    int *steps = order + rounds;
    uint64_t random = seed * UINT64_C(0x9e3779b97f4a7c15) + UINT64_C(0x632be59bd9b4e019);
    for (int first = 0; first < frames; first += rounds) {
        for (int i = 0; i < rounds; i++) {
            order[i] = i;
            steps[i] = i;
        }
        dip_random_shuffle(&random, order, rounds);
        dip_random_shuffle(&random, steps + 1, rounds - 1); // Copy 0 is not shifted.
        for (int copy = 0; copy < copies; copy++) {
            for (int i = 0; i < rounds && first + i < frames; i++) {
                round_of[copy * frames + first + i] = order[(i + steps[copy]) % rounds];
            }
        }
    }
    free(order);
    return true;
}

// --- estimates -----------------------------------------------------------------------------------

// A variance with its degrees of freedom.
typedef struct Variance {
    double value, degrees;
} Variance;

// Returns the variance of a sum. Its degrees of freedom are those of Satterthwaite 1946.
static Variance add_variance(Variance a, Variance b) {
    const double sum = a.value + b.value;
    const double parts = a.value * a.value / a.degrees + b.value * b.value / b.degrees;
    return (Variance){sum, parts > 0.0 ? sum * sum / parts : INFINITY};
}

// Returns the variance between units that a subject contributes. This is the weighted mean of
// `own`, which comes from the subject alone, and `pooled`, which comes from all subjects of the
// base. The weights are their degrees of freedom.
static Variance own_variance(const DipTimesFit *fit, const DipTimesBase *base, double own,
                             double pooled) {
    const double degrees = fit->units - 1 + base->pooled_degrees;
    return (Variance){
        ((fit->units - 1) * own + base->pooled_degrees * pooled) / degrees,
        degrees,
    };
}

static Variance base_variance(const DipTimesFit *fit, const DipTimesBase *base, DipTimesValue v) {
    return (Variance){base->variance[v], fit->units - 1 + DIP_TIMES_BASE_DEGREES};
}

// Returns the estimate of exp(log_value). `of_unit` is the variance of log_value between units.
static DipEstimate estimate_of(const DipTimesFit *fit, double log_value, Variance of_unit) {
    if (fit->units < 2) {
        return dip_estimate_unknown(exp(log_value));
    }
    const Variance rest = {DIP_TIMES_LEAST_ERROR * DIP_TIMES_LEAST_ERROR, INFINITY};
    of_unit.value /= fit->excess * fit->units;
    const Variance all = add_variance(of_unit, rest);
    return dip_estimate_make(exp(log_value), sqrt(all.value), all.degrees);
}

static Variance variance_of(const DipTimesFit *fit, int subject, DipTimesValue v) {
    const DipTimesSubject *s = &fit->subjects[subject];
    const DipTimesBase *base = &fit->bases[s->base];
    if (subject == s->base) {
        return (Variance){s->variance[v], fit->units - 1};
    }
    const Variance own = own_variance(fit, base, s->variance[v], base->pooled[v]);
    return base->variance[v] > 0.0 ? add_variance(own, base_variance(fit, base, v)) : own;
}

DipEstimate dip_times_ratio_of(const DipTimesFit *fit, int subject, int other) {
    DIP_FP_MODE_SCOPE();
    const DipTimesSubject *a = &fit->subjects[subject], *b = &fit->subjects[other];
    const DipTimesBase *base = &fit->bases[a->base];
    DIP_ASSERT(a->base == b->base);
    if (subject == other) {
        return dip_estimate_unknown(1.0);
    }
    Variance variance;
    if (subject == a->base || other == a->base) {
        variance = variance_of(fit, subject == a->base ? other : subject, DIP_TIMES_RATIO);
    } else { // The base's contribution to the two ratios is the same, so it cancels.
        double squares = 0.0;
        for (int unit = 0; unit < fit->units; unit++) {
            const double move = dip_times_moves(fit, subject, unit)[DIP_TIMES_RATIO] -
                                dip_times_moves(fit, other, unit)[DIP_TIMES_RATIO];
            squares += move * move / fmax(fit->units - 1, 1);
        }
        variance = own_variance(fit, base, squares, 2.0 * base->pooled[DIP_TIMES_RATIO]);
    }
    DipEstimate ratio =
        estimate_of(fit, a->logs[DIP_TIMES_RATIO] - b->logs[DIP_TIMES_RATIO], variance);
    DIP_FP_PIN_STRUCT(ratio);
    return ratio;
}

DipEstimate dip_times_ratio(const DipTimesFit *fit, int subject) {
    return dip_times_ratio_of(fit, subject, fit->subjects[subject].base);
}

double dip_times_spread(const DipTimesFit *fit, int subject) {
    return fit->subjects[subject].spread;
}

// Returns a value of the subject in milliseconds. Its error includes that of the base's mean time.
static DipEstimate in_ms(const DipTimesFit *fit, int subject, DipTimesValue v) {
    const DipTimesSubject *s = &fit->subjects[subject];
    const DipTimesBase *base = &fit->bases[s->base];
    const Variance variance = variance_of(fit, subject, v);
    if (!(base->level_error > 0.0) || isnan(variance.value)) {
        return dip_estimate_unknown(base->level_ms * exp(s->logs[v]));
    }
    const Variance level = {fit->excess * fit->units * base->level_error * base->level_error,
                            base->level_degrees};
    // The slowest frames lie side by side, so the errors that smoothing makes at them do not cancel
    // out, as they do in the mean of all frames.
    const double doubt = v == DIP_TIMES_RATIO ? 0.0 : s->doubt;
    const Variance smoothed = {fit->excess * fit->units * doubt, INFINITY};
    const Variance all = variance.value > 0.0 ? add_variance(variance, level) : level;
    return estimate_of(fit, log(base->level_ms) + s->logs[v], add_variance(all, smoothed));
}

DipAlong dip_times_along(const DipTimesFit *fit, int subject) {
    DIP_FP_MODE_SCOPE();
    const DipTimesSubject *s = &fit->subjects[subject];
    const DipTimesBase *base = &fit->bases[s->base];
    DipAlong along = {
        .mean_ms = in_ms(fit, subject, DIP_TIMES_RATIO),
        .p95_ms = in_ms(fit, subject, DIP_TIMES_P95),
        .worst_ms = in_ms(fit, subject, DIP_TIMES_WORST),
        .level_error = base->level_error,
        .kept = s->kept,
        .timed = s->timed,
    };
    DIP_FP_PIN_STRUCT(along);
    return along;
}

const double *dip_times_frames(const DipTimesFit *fit, int subject) {
    return fit->frame_ms + (size_t)subject * (size_t)fit->frames;
}

const double *dip_times_shares(const DipTimesFit *fit, int subject) {
    return fit->subjects[subject].shares;
}
