// The figures and the advice of a cost report, as text for the window.
#ifndef DIP_APP_PREVIEW_COSTS_H
#define DIP_APP_PREVIEW_COSTS_H

#include "app/cost/report.h"

#include <stdbool.h>

typedef struct DipCostsStep {
    DipQuality quality;
    char name[24];    // "4".
    char figures[32]; // Ratio of its time to the baseline's, and change of FLIP: "1.56x -.0107".
} DipCostsStep;

// One setting's steps. The baseline's step reads "1x" with its own FLIP.
typedef struct DipCostsRow {
    char title[48]; // "Antialiasing".
    DipSetting setting;
    DipCostsStep steps[DIP_COST_MAX_SWEEP_ROWS];
    int step_count;
} DipCostsRow;

typedef struct DipCostsAdvice {
    double budget_ms;
    bool found; // Some measured combination is that fast.
    DipQuality quality;
    double ms;
    double flip;
} DipCostsAdvice;

typedef struct DipCosts {
    char heading[256]; // Scene, size, threads and instruction set.
    DipCostsRow rows[DIP_COST_MAX_SWEEPS];
    int row_count;
    DipCostsAdvice
        advice[DIP_COST_MAX_BUDGETS]; // For the report's budgets, or for 16.6 ms if it has none.
    int advice_count;
    DipCostsAdvice baseline; // Found only if the report measured it as a combination.
} DipCosts;

void dip_costs_make(DipCosts *costs, const DipCostReport *report);

// Reads a cost.json. Fails with CONFLICT if the report is of another scene than the one named.
bool dip_costs_load(DipCosts *costs, const char *file, const char *scene, DipError *err);

// Says one advice in a line: "Within 16.6 ms: 11.2 ms, FLIP .0451; baseline 6.5 ms, .0773".
void dip_costs_describe(const DipCosts *costs, int advice, char *text, size_t size_bytes);

// Returns whether a pane's settings are at a step of a row.
bool dip_costs_is_at(const DipCostsRow *row, int step, const DipQuality *quality);

#endif
