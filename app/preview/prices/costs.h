// Reads a cost report (`diptych cost`), and turns its sweeps into texts for the window. A sweep has
// the measurements of all steps (values) of one setting.
#ifndef DIP_APP_PREVIEW_PRICES_COSTS_H
#define DIP_APP_PREVIEW_PRICES_COSTS_H

#include "app/preview/prices/prices.h"

// One step (value) of a setting.
typedef struct DipCostsStep {
    DipQuality quality;
    char name[24];      // Name of the step, such as "4".
    char time[16];      // Time relative to the baseline, "1.56x", or "2?x" if it is doubtful; ""
                        // if it is not known.
    char flip[16];      // Change of FLIP from the baseline, "−.0107"; "" if it is not known.
    char figures[32];   // `time` and `flip` with a blank between them: "1.56x −.0107".
    double flip_change; // Change of FLIP as a number; 0 for the baseline, NAN if it is not known.
} DipCostsStep;

// One setting's steps. One step is the baseline that the other steps are compared with. The texts
// of the baseline are "1x" and its FLIP.
typedef struct DipCostsRow {
    char title[48]; // Title of the setting, such as "Antialiasing".
    DipSetting setting;
    DipCostsStep steps[DIP_COST_MAX_SWEEP_ROWS];
    int step_count;
} DipCostsRow;

// Writes the scene, size, threads and instruction set of a report.
enum { DIP_COSTS_HEADING = 256 };
void dip_costs_heading(const DipCostReport *report, char text[DIP_COSTS_HEADING]);

DipCostsRow dip_costs_row(const DipCostReport *report, const DipCostSweep *sweep);

// Returns whether a pane's settings include the given step of the row's setting. In the rows of
// adaptive AA and of its group size, the settings must also have the step's number of samples and,
// while adaptive AA is on, the step's group size.
bool dip_costs_is_at(const DipCostsRow *row, int step, const DipQuality *quality);

// Reads a cost report that `diptych cost` wrote. `file` is the JSON file, or the folder that has it
// as cost.json. `prices`, unless it is NULL, borrows the report until it gets another one. The
// caller frees the report. Returns NULL on failure: with an error of dip_cost_read_report, with
// MEMORY, or with CONFLICT if the report's scene is not `scene`.
DipCostReport *dip_costs_load(DipPrices *prices, const char *file, const char *scene,
                              DipError *err);
void dip_costs_free(DipCostReport **report); // *report may be NULL.

#endif
