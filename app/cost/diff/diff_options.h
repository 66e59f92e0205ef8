// The command line of `diptych cost diff`.
#ifndef DIP_APP_COST_DIFF_DIFF_OPTIONS_H
#define DIP_APP_COST_DIFF_DIFF_OPTIONS_H

#include "app/cli/command.h"
#include "app/cli/measure_options.h"
#include "app/session/session_options.h"
#include "renderer/scene/quality.h"

#include <stdbool.h>

enum {
    DIP_COST_DIFF_MAX_SETS = 24,
    DIP_COST_DIFF_STARTS = 6,
    DIP_COST_DIFF_ROUNDS = 8,
    DIP_COST_DIFF_FRAMES = 6
};

// A combination of settings to compare.
typedef struct DipCostDiffSet {
    char text[80]; // As it was typed.
    DipQuality quality;
} DipCostDiffSet;

// The whole command line. Texts are borrowed from argv.
typedef struct DipCostDiffArguments {
    DipProgramOptions program;
    DipSessionOptions session; // What the programs draw.
    const char *sides[2];      // A and B.
    int side_count;
    DipCostDiffSet sets[DIP_COST_DIFF_MAX_SETS];
    int set_count;
    DipMeasureOptions measure; // Rounds 0: as the report or the program that is compared needs.
    int frames;                // 0: as the report or the program that is compared needs.
    double fail_over;          // 1.03 for --fail-over 3%; 0: never fail.
    const char *json;
} DipCostDiffArguments;

#endif
