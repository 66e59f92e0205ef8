// Declares the options of `diptych cost`, and options that other commands on reports share.
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
    bool quick;          // --quick: other options default to values for a fast, less exact report.
    DipCostOptions cost; // Its rounds, starts and seed are not set here: `measure` has them.
    DipMeasureOptions measure;
    bool serve; // True if another process has started this one to draw frames for it.
} DipCostArguments;

extern const DipOptionParts dip_cost_option_parts;
extern const DipOptionTable dip_out_option_table;         // --out; fills a `const char *`.
extern const DipOptionTable dip_picture_option_table;     // --pictures; fills a DipCostOptions.
extern const DipOptionTable dip_viewing_option_table;     // Pixels per degree; fills a double.
extern const DipOptionTable dip_cache_option_table;       // --cache; fills a `const char *`.
extern const DipOptionTable dip_cost_budget_option_table; // Budgets; fills a DipCostOptions.

// If the options have no budgets, adds the budgets of 60 and 30 frames a second.
void dip_cost_default_budgets(DipCostOptions *options);

// Fails if no folder was given with --out.
bool dip_cost_check_out(const char *out, DipError *err);

void dip_cost_options_default(void *arguments);
bool dip_cost_options_check(const void *arguments, DipError *err);

#endif
