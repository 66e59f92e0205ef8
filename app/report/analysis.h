// Analyses a whole report before it is written: how times follow from work, which settings do more
// or less together than alone, and whether error and work follow theory from step to step. The
// functions that write the report (app/report/format/, app/report/page/) only read the results.
#ifndef DIP_APP_REPORT_ANALYSIS_H
#define DIP_APP_REPORT_ANALYSIS_H

#include "app/report/fit.h"

#include <stddef.h>

enum { DIP_COST_MAX_INTERACTIONS = DIP_SETTING_COUNT * (DIP_SETTING_COUNT - 1) / 2 };

// How the last steps of two settings act together. Four rows that differ only in these settings
// show it: `neither` has both at their first step; `a` has only the first setting at its last step,
// and `b` only the second; `both` has both at their last step. `flip` and `time` are means over all
// combinations of the other settings for which these four rows were measured.
typedef struct DipCostInteraction {
    DipSetting a;
    DipSetting b;
    int contexts; // Number of combinations of the other settings.
    // Mean of FLIP(both) - FLIP(a) - FLIP(b) + FLIP(neither). A value above 0 means that together
    // they lower FLIP by less than the sum of what each lowers it alone.
    double flip;
    // Geometric mean of time(both) * time(neither) / (time(a) * time(b)). A value above 1 means
    // that together they cost more than the product of their ratios. 0 if the report has no times.
    double time;
} DipCostInteraction;

typedef struct DipCostAnalysis {
    DipCostFit fit;
    // The interactions of the pairs of settings for which the four rows were measured. If
    // combinations were predicted, there are none: only good combinations are then measured, and
    // means over them would mislead.
    DipCostInteraction interactions[DIP_COST_MAX_INTERACTIONS];
    int interaction_count;
} DipCostAnalysis;

// Fills in report->analysis. Call it after everything has been measured. Fails with
// DIP_ERROR_MEMORY.
bool dip_cost_analyse(DipCostReport *report, DipError *err);

// Writes a sentence about a sweep (all steps of one setting). If error and work follow theory, the
// sentence says what falls or rises from step to step. Otherwise it names the step that departs
// from theory and gives a likely reason. If all steps draw the same pictures although theory
// expects a difference, it says what the path lacks. Times are not checked, because they depend on
// the machine. Returns false if the sweep has one step, if the steps' errors are unknown, or if
// theory says nothing about the setting.
bool dip_cost_order_text(const DipCostReport *report, const DipCostSweep *sweep, char *text,
                         size_t size_bytes);

#endif
