// Printing common advice (common_advice.h), and writing it as JSON.
#ifndef DIP_APP_COST_ADVISE_ADVISE_OUTPUT_H
#define DIP_APP_COST_ADVISE_ADVISE_OUTPUT_H

#include "app/cost/advise/common_advice.h"

#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

// The share by which the chosen combination's FLIP in one report is above the FLIP of the row that
// this report alone would choose. Both count at least as much as the floor of the report's truths.
// NAN if either is missing.
double dip_cost_common_share_lost(const DipCostCommon *common, const DipCostCommonAdvice *advice,
                                  int report);

// Prints the advice for `count` budgets as tables for a terminal. Four budgets are also printed as
// the tiers of a settings menu.
void dip_cost_common_print(const DipCostCommon *common, const DipCostCommonAdvice *advice,
                           int count, FILE *out);

// Writes the same to a file. Fails with DIP_ERROR_MEMORY, or DIP_ERROR_IO if the file cannot be
// written.
bool dip_cost_common_write_json(const DipCostCommon *common, const DipCostCommonAdvice *advice,
                                int count, const char *file, DipError *err);

#ifdef __cplusplus
}
#endif

#endif
