// Options of `diptych cost advise`.
#ifndef DIP_APP_COST_ADVISE_ADVISE_OPTIONS_H
#define DIP_APP_COST_ADVISE_ADVISE_OPTIONS_H

#include "app/cost/options.h"
#include "app/cost/advise/common_advice.h"

// The whole command line. Texts are borrowed from argv.
typedef struct DipCostAdviseArguments {
    DipProgramOptions program;
    DipCostOptions cost; // Only the budgets and budget_of are used.
    const char *reports[DIP_COST_MAX_COMMON_REPORTS];
    int report_count;
    const char *json; // File for the advice, or NULL.
} DipCostAdviseArguments;

extern const DipOptionParts dip_cost_advise_option_parts;

bool dip_cost_advise_options_check(const void *arguments, DipError *err);

#endif
