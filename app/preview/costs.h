// What a cost report says of settings, ready to be shown, and its advice.
#ifndef DIP_APP_PREVIEW_COSTS_H
#define DIP_APP_PREVIEW_COSTS_H

#include "app/cost/report.h"

#include <stdbool.h>

typedef struct DipCostsStep {
    DipQuality quality;
    char name[24];    // "4"
    char figures[32]; // time as a ratio to the baseline's, change of FLIP: "1.56x -.0107"
} DipCostsStep;

// A setting's steps. The baseline's own is "1x" with its FLIP.
typedef struct DipCostsRow {
    char title[48]; // "Antialiasing"
    DipSetting setting;
    DipCostsStep steps[DIP_COST_MAX_SWEEP_ROWS];
    int step_count;
} DipCostsRow;

typedef struct DipCostsAdvice {
    double budget_ms;
    bool found; // something measured is that fast
    DipQuality quality;
    double ms;
    double flip;
} DipCostsAdvice;

typedef struct DipCosts {
    char heading[256]; // of what, on what
    DipCostsRow rows[DIP_COST_MAX_SWEEPS];
    int row_count;
    DipCostsAdvice advice[DIP_COST_MAX_BUDGETS]; // the report's budgets, else 16.6 ms
    int advice_count;
    DipCostsAdvice baseline; // where it was measured among the combinations
} DipCosts;

void dip_costs_make(DipCosts *costs, const DipCostReport *report);

// From a cost.json. Fails when it is of another scene than the one named.
bool dip_costs_load(DipCosts *costs, const char *file, const char *scene, DipError *err);

// "Within 16.6 ms: 11.2 ms, FLIP .0451; baseline 6.5 ms, .0773".
void dip_costs_describe(const DipCosts *costs, int advice, char *text, size_t size_bytes);

// Whether a pane's settings are at a step of a row.
bool dip_costs_is_at(const DipCostsRow *row, int step, const DipQuality *quality);

#endif
