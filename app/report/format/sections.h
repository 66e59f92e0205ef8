// Writes the sections of a report for people. A terminal and a page get the same sentences and
// tables, the answer first, then the front, then the rest. Pages add plots and pictures.
#ifndef DIP_APP_REPORT_FORMAT_SECTIONS_H
#define DIP_APP_REPORT_FORMAT_SECTIONS_H

#include "app/report/format/form.h"
#include "app/report/format/lines.h"

// Writes the best settings for each time budget, and four budgets as the tiers of a settings menu.
void dip_section_answer(DipForm *form, const DipCostReport *report);

// A tier of a settings menu.
typedef struct DipCostTier {
    double budget_ms;
    const DipQuality *quality; // NULL: nothing surely fits.
    int row;                   // Row of the report that has these settings, or -1.
} DipCostTier;

// Sorts tiers by their budgets and writes them. Writes nothing unless there are four.
enum { DIP_COST_TIER_COUNT = 4 };
void dip_section_tiers(DipForm *form, DipCostTier *tiers, int count);

// Writes facts about advice: the settings that are as good, if there are any, and the line for the
// ini.
void dip_section_ties(DipForm *form, const DipCandidates *candidates, const DipAdvice *advice);
void dip_section_ini(DipForm *form, const DipQuality *quality);

// Writes the Pareto front of time and error, and the combinations that draw the same pictures as
// others.
void dip_section_front(DipForm *form, const DipCostReport *report);
void dip_section_same(DipForm *form, const DipCostReport *report);

// Writes what was measured where, and the verdict on the machine.
void dip_section_measured(DipForm *form, const DipCostReport *report);

// Writes how well --predict did; nothing for a report without it.
void dip_section_predictions(DipForm *form, const DipCostReport *report);

// Writes misses as a fact: their median and 90th percentile.
void dip_section_misses(DipForm *form, const char *what, const DipCostMisses *misses);

// Write what two settings do together, the steps of a sweep, the prices of work, and the noise of
// the truth with the steps that were left out.
void dip_section_interactions(DipForm *form, const DipCostReport *report);
void dip_section_sweep(DipForm *form, const DipCostReport *report, int sweep);
void dip_section_fit(DipForm *form, const DipCostReport *report);
void dip_section_truth(DipForm *form, const DipCostReport *report);

#endif
