// The times, errors and advice of a cost report (`diptych cost`), as text for the window.
#ifndef DIP_APP_PREVIEW_PRICES_COSTS_H
#define DIP_APP_PREVIEW_PRICES_COSTS_H

#include "app/report/report.h"
#include "app/preview/prices/prices.h"

#include <stdbool.h>

// One step (value) of a setting.
typedef struct DipCostsStep {
    DipQuality quality;
    char name[24];    // Name of the step: "4".
    char figures[32]; // Time relative to the baseline, and change of FLIP: "1.56x -.0107".
} DipCostsStep;

// One setting's steps. One step is the baseline that the other steps are compared with. The text of
// the baseline is "1x" and its FLIP.
typedef struct DipCostsRow {
    char title[48]; // "Antialiasing".
    DipSetting setting;
    DipCostsStep steps[DIP_COST_MAX_SWEEP_ROWS];
    int step_count;
} DipCostsRow;

// The settings with the least error among all measured settings within a time budget.
typedef struct DipCostsAdvice {
    double budget_ms;
    bool found; // True if a measured combination keeps within the budget.
    DipQuality quality;
    double ms;
    double flip;
} DipCostsAdvice;

// A measured combination of settings.
typedef struct DipCostsPoint {
    DipQuality quality;
    double ms;
    double flip;
    bool on_front; // No other combination is at least as good in both time and error.
} DipCostsPoint;

enum { DIP_COSTS_MAX_POINTS = 512 };

typedef struct DipCosts {
    char heading[256]; // Scene, size, threads and instruction set.
    int width;         // Size of the measured pictures, in pixels.
    int height;
    char path[16]; // Name of the camera path of the combinations: "DEFAULT".
    // The combinations by time. If there are more than fit, the last ones of the report are left
    // out.
    DipCostsPoint points[DIP_COSTS_MAX_POINTS];
    int point_count;
    int combination_count; // With those left out.
    DipCostsRow rows[DIP_COST_MAX_SWEEPS];
    int row_count;
    // One piece of advice for each budget of the report. If the report has no budget, there is
    // one piece of advice, for 16.6 ms.
    DipCostsAdvice advice[DIP_COST_MAX_BUDGETS];
    int advice_count;
    DipCostsAdvice baseline; // Time and FLIP of the baseline's settings; `found` is true only if
                             // the report has them as a combination.
} DipCosts;

void dip_costs_make(DipCosts *costs, const DipCostReport *report);

// Reads a cost report from the JSON file that `diptych cost` wrote, and gives its prices to
// `prices`, unless that is NULL. Fails with CONFLICT if the
// report's scene is not `scene`.
bool dip_costs_load(DipCosts *costs, DipPrices *prices, const char *file, const char *scene,
                    DipError *err);

// Formats one piece of advice as a line: "Within 16.6 ms: 11.2 ms, FLIP .0451; baseline 6.5 ms,
// .0773".
void dip_costs_describe(const DipCosts *costs, int advice, char *text, size_t size_bytes);

// Returns the index of the front's next point after (direction 1) or before (-1) a time, or -1.
int dip_costs_front_step(const DipCosts *costs, double ms, int direction);

// Returns whether a pane's settings include the given step of the row's setting.
bool dip_costs_is_at(const DipCostsRow *row, int step, const DipQuality *quality);

#endif
