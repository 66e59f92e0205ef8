// The times, errors and advice of a cost report (`diptych cost`), as text for the window.
#ifndef DIP_APP_PREVIEW_PRICES_COSTS_H
#define DIP_APP_PREVIEW_PRICES_COSTS_H

#include "app/report/report.h"
#include "app/preview/prices/prices.h"

#include <stdbool.h>

// One step (value) of a setting.
typedef struct DipCostsStep {
    DipQuality quality;
    char name[24];      // Name of the step: "4".
    char time[16];      // Time relative to the baseline, "1.56x"; "" if it is not known.
    char flip[16];      // Change of FLIP, "-.0107"; "" if it is not known.
    char figures[32];   // Both: "1.56x -.0107".
    double flip_change; // Change of FLIP as a number; 0 for the baseline, NAN if it is not known.
} DipCostsStep;

// One setting's steps. One step is the baseline that the other steps are compared with. The texts
// of the baseline are "1x" and its FLIP.
typedef struct DipCostsRow {
    char title[48]; // "Antialiasing".
    DipSetting setting;
    DipCostsStep steps[DIP_COST_MAX_SWEEP_ROWS];
    int step_count;
} DipCostsRow;

typedef struct DipCosts {
    char heading[256]; // Scene, size, threads and instruction set.
    int width;         // Size of the measured pictures, in pixels.
    int height;
    char path[16];   // Name of the camera path of the combinations: "DEFAULT".
    DipQuality base; // The settings that the report starts from.
    // What can be chosen: the combinations with times and errors. The list is owned.
    DipCandidates candidates;
    double budgets_ms[DIP_COST_MAX_BUDGETS]; // Those of the report.
    int budget_count;
    DipCostsRow rows[DIP_COST_MAX_SWEEPS];
    int row_count;
} DipCosts;

// Fails with MEMORY.
bool dip_costs_make(DipCosts *costs, const DipCostReport *report, DipError *err);
void dip_costs_free(DipCosts *costs);

// Reads a cost report from the JSON file that `diptych cost` wrote, and gives its prices to
// `prices`, unless that is NULL. Fails with CONFLICT if the
// report's scene is not `scene`. Free *costs even after a failure.
bool dip_costs_load(DipCosts *costs, DipPrices *prices, const char *file, const char *scene,
                    DipError *err);

// Returns whether a pane's settings include the given step of the row's setting.
bool dip_costs_is_at(const DipCostsRow *row, int step, const DipQuality *quality);

#endif
