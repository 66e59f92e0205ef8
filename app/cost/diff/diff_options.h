// Options of `diptych cost diff`.
#ifndef DIP_APP_COST_DIFF_DIFF_OPTIONS_H
#define DIP_APP_COST_DIFF_DIFF_OPTIONS_H

#include "app/bench/options.h"
#include "app/cli/command.h"
#include "app/cli/measure_options.h"
#include "app/session/session_options.h"

#include <stdbool.h>

enum {
    DIP_COST_DIFF_MAX_SETS = 24,
    DIP_COST_DIFF_STARTS = 6,
    DIP_COST_DIFF_ROUNDS = 8,
    DIP_COST_DIFF_FRAMES = 6
};

// The whole command line. Texts are borrowed from argv.
typedef struct DipCostDiffArguments {
    DipProgramOptions program;
    DipSessionOptions session; // What the programs draw.
    const char *sides[2];      // A and B.
    int side_count;
    DipBenchSet sets[DIP_COST_DIFF_MAX_SETS];
    int set_count;
    DipMeasureOptions measure; // Rounds are 0 if what is compared chooses them.
    int frames;                // 0: chosen by what is compared.
    double fail_over;          // 1.03 for --fail-over 3%; 0: never fail.
    const char *json;
} DipCostDiffArguments;

extern const DipOptionParts dip_cost_diff_option_parts;

void dip_cost_diff_options_default(void *arguments, int argc, char *const *argv);
bool dip_cost_diff_options_check(const void *arguments, DipError *err);

#endif
