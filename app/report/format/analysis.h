// What is computed from a whole report for its readers, once, before it is written: how times
// follow from work, and which settings do more or less together than alone.
#ifndef DIP_APP_REPORT_FORMAT_ANALYSIS_H
#define DIP_APP_REPORT_FORMAT_ANALYSIS_H

#include "app/report/fit.h"
#include "app/report/interaction.h"

typedef struct DipCostAnalysis {
    DipCostFit fit;
    // None if combinations were predicted: those that are measured are good ones, so means over
    // them mislead.
    DipCostInteraction interactions[DIP_COST_MAX_INTERACTIONS];
    int interaction_count;
} DipCostAnalysis;

// Fills in report->analysis. Call it once nothing is measured any more. Fails with
// DIP_ERROR_MEMORY.
bool dip_cost_analyse(DipCostReport *report, DipError *err);

#endif
