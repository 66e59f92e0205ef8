// Options of `diptych cost` and `diptych cost merge`.
#ifndef DIP_APP_COST_OPTIONS_H
#define DIP_APP_COST_OPTIONS_H

#include "app/cli/command.h"
#include "app/cli/measure_options.h"
#include "app/report/report_plan.h"
#include "app/session/session_options.h"

#include <stdbool.h>

// The whole command line of `diptych cost`.
typedef struct DipCostArguments {
    DipProgramOptions program;
    DipSessionOptions session;
    const char *out;     // Folder of the report.
    bool quick;          // Other options have the defaults of a quick answer.
    DipCostOptions cost; // Without what `measure` has.
    DipMeasureOptions measure;
    DipServeOptions serve; // A start of another process serves.
} DipCostArguments;

// The whole command line of `diptych cost merge`.
typedef struct DipCostMergeArguments {
    DipProgramOptions program;
    DipSessionOptions session; // The scene, from which the pictures of the page are drawn.
    const char *out;
    DipCostOptions cost; // Only the kind of pictures and the cache are used.
    const char *parts[DIP_COST_MAX_PARTS];
    int part_count;
} DipCostMergeArguments;

extern const DipOptionParts dip_cost_option_parts;
extern const DipOptionTable dip_viewing_option_table; // For the pixels per degree, a double.
extern const DipOptionTable dip_cache_option_table;   // For the folder's name, a text.
extern const DipOptionParts dip_cost_merge_option_parts;

// Options of budgets. The fields are those of DipCostOptions.
extern const DipOptionTable dip_cost_budget_option_table;

// Gives options without budgets those of 60 and 30 frames a second.
void dip_cost_default_budgets(DipCostOptions *options);

// Sets rounds, starts and seed.
void dip_cost_set_measure(DipCostOptions *cost, const DipMeasureOptions *measure);

void dip_cost_options_default(void *arguments, int argc, char *const *argv);
bool dip_cost_options_check(const void *arguments, DipError *err);
bool dip_cost_merge_options_check(const void *arguments, DipError *err);

#endif
