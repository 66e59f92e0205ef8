// How sure a choice under a time budget is, if the times are uncertain.
#ifndef DIP_APP_MEASURE_STATS_CHOICE_H
#define DIP_APP_MEASURE_STATS_CHOICE_H

#include "renderer/base/error.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// A candidate: its time (more than 0), the standard error of the time's logarithm, and its loss,
// for example its FLIP.
typedef struct DipChoice {
    double time;
    double error;
    double loss;
} DipChoice;

typedef struct DipChoiceOdds {
    double best;           // Probability that the chosen candidate is the best.
    int runner_up;         // The candidate that is most often better, or -1 if none ever is.
    double runner_up_best; // Probability that the chosen one is not the best and this one is.
} DipChoiceOdds;

// Estimates how likely the chosen candidate is the best: that its true time is within the budget,
// and that no candidate within the budget has a loss of less than (1 - tolerance) times its own.
// Draws the logarithms of the true times 2000 times from normal distributions around the measured
// ones; `common_error` is the standard error that all candidates share, because they were measured
// beside the same base. Starts from a fixed seed, so equal input gives equal odds. Thread-safe.
// Fails with DIP_ERROR_MEMORY.
bool dip_choice_odds(const DipChoice *choices, int count, int chosen, double budget,
                     double common_error, double tolerance, DipChoiceOdds *odds, DipError *err);

#ifdef __cplusplus
}
#endif

#endif
