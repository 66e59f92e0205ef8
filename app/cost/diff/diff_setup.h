// The measurement that `cost diff` sets up: the settings that are drawn, and the command line of
// `bench` that asks the programs for them.
#ifndef DIP_APP_COST_DIFF_DIFF_SETUP_H
#define DIP_APP_COST_DIFF_DIFF_SETUP_H

#include "app/cost/diff/diff_duel.h"
#include "app/cost/diff/diff_options.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { DIP_COST_SETUP_ARGUMENTS = 40 + 2 * DIP_MAX_MODELS, DIP_COST_SETUP_NUMBER = 24 };

// Refers to itself, so it must not be copied. Zero-initialise it.
typedef struct DipCostSetup {
    DipCostDuelDef def;
    DipCostDuel duel;
    char sets[(DIP_COST_DIFF_MAX_SETS + 2) * DIP_COST_TEXT];
    char numbers[8][DIP_COST_SETUP_NUMBER]; // Texts of the numbers on the command line.
    int number_count;
    char *arguments[DIP_COST_SETUP_ARGUMENTS];
    int argument_count;
} DipCostSetup;

// Adds a combination of settings.
void dip_cost_setup_add_set(DipCostSetup *setup, const char *text);

// Completes the command line and the definition of the measurement, once all sets are there. The
// pairs and programs of setup->def are the caller's.
void dip_cost_setup_finish(DipCostSetup *setup, const DipCostDiffArguments *arguments, int frames,
                           int rounds);

// Frees the setup, which was allocated with malloc, and its duel. Accepts NULL.
void dip_cost_setup_free(DipCostSetup *setup);

// Returns the first drawing of a frame by a side of a pair, which has its counters and hash.
const DipBenchSample *dip_cost_setup_sample(const DipCostSetup *setup, int side, int pair,
                                            int frame);

// Adds up the counters of all frames and divides them by the number of frames. The counters have
// the order of DIP_COUNTER_LIST and must be 0.
void dip_cost_setup_count(const DipCostSetup *setup, int side, int pair, double *counters);

#ifdef __cplusplus
}
#endif

#endif
