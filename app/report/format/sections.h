// Writes the sections of a report for people, each for a terminal or for a page (form.h). Both get
// nearly the same sentences and tables. Pages add plots and pictures (app/report/page/).
#ifndef DIP_APP_REPORT_FORMAT_SECTIONS_H
#define DIP_APP_REPORT_FORMAT_SECTIONS_H

#include "app/report/format/form.h"
#include "app/report/format/lines.h"

// Writes the best settings for each time budget. If there are four budgets, also writes them as the
// tiers of a settings menu. If the machine was too busy, writes instead that nothing is advised.
void dip_section_answer(DipForm *form, const DipCostReport *report);

// A tier of a game's settings menu, such as "low" or "ultra".
typedef struct DipCostTier {
    double budget_ms;
    const DipQuality *quality; // The best settings; NULL if none surely fit the budget.
    int row;                   // Row of the report that has these settings; -1 if there is none.
} DipCostTier;

// Sorts tiers by their budgets and writes them. Writes nothing unless there are four.
enum { DIP_COST_TIER_COUNT = 4 };
void dip_section_tiers(DipForm *form, DipCostTier *tiers, int count);

// Writes as a fact (dip_form_fact) the settings that are as good as the chosen ones, if there are
// any. Names at most DIP_ADVICE_TIES of them.
void dip_section_ties(DipForm *form, const DipCandidates *candidates, const DipAdvice *advice);

// Writes as a fact the line that puts settings into an ini file.
void dip_section_ini(DipForm *form, const DipQuality *quality);

// Writes the Pareto front of time and error.
void dip_section_front(DipForm *form, const DipCostReport *report);

// Writes the combinations that draw the same pictures as others, or only their number for a
// terminal.
void dip_section_same(DipForm *form, const DipCostReport *report);

// Writes what was measured and how, and the verdict on the machine (app/report/verdict.h).
void dip_section_measured(DipForm *form, const DipCostReport *report);

// Writes how far the predictions of --predict lie from measurements. Writes nothing if nothing was
// predicted.
void dip_section_predictions(DipForm *form, const DipCostReport *report);

// Writes how far predictions were from measurements (the median and the 90th percentile) as a fact
// with the term `what`. Writes nothing if there are no misses.
void dip_section_misses(DipForm *form, const char *what, const DipCostMisses *misses);

// Writes for pairs of settings how the effect of both together compares with the effects of each
// alone (app/report/analysis.h).
void dip_section_interactions(DipForm *form, const DipCostReport *report);

// Writes the steps of one sweep (all steps of one setting).
void dip_section_sweep(DipForm *form, const DipCostReport *report, int sweep);

// Writes the prices of work: how long a unit of each kind of work takes, as fitted to the measured
// times (app/report/fit.h).
void dip_section_fit(DipForm *form, const DipCostReport *report);

// Writes the noise floors of the truths (converged pictures), and the steps that were left out of
// sweeps.
void dip_section_truth(DipForm *form, const DipCostReport *report);

#endif
