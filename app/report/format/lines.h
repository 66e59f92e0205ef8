// Lists rows of a report as lines of tables. CSV, terminals and pages take their lines from the
// same functions.
#ifndef DIP_APP_REPORT_FORMAT_LINES_H
#define DIP_APP_REPORT_FORMAT_LINES_H

#include "app/report/format/cost_fields.h"

// A line of a table. All members are borrowed. When fields of a line are wanted, the member
// `context` of the DipFieldAt (fields.h) must be the report.
typedef struct DipCostLine {
    const char *kind; // "a/a", "step", "combination", "predicted", "front" or "floor".
    int row;          // Row of the report; -1 if the combination was only predicted.
    int path;
    const DipQuality *quality;
    const DipCostSweep *sweep;           // NULL if the row is no step of a sweep.
    int step;                            // Index of the step in the sweep.
    const DipCostPrediction *prediction; // NULL if there is none.
    int number;                          // Number on the Pareto front, from 1 on; 0 if not on it.
    const DipCandidate *candidate;       // NULL if the line is not on the front.
    const DipCandidate *before;          // The previous candidate on the front, or NULL.
} DipCostLine;

extern const DipRecord dip_cost_line_record;

// These functions list rows or combinations, and return the number of lines.

// Lists the A/A row of each path (the baseline, timed as if it were another setting).
int dip_cost_same_lines(const DipCostReport *report, DipCostLine lines[DIP_COST_MAX_PATHS]);
// Lists the base row of each path, for a table of the noise floors of the paths' truths (converged
// pictures).
int dip_cost_floor_lines(const DipCostReport *report, DipCostLine lines[DIP_COST_MAX_PATHS]);
// Lists the steps of one sweep (all steps of one setting).
int dip_cost_step_lines(const DipCostReport *report, int sweep,
                        DipCostLine lines[DIP_COST_MAX_SWEEP_ROWS]);
// Lists the steps of all sweeps.
int dip_cost_all_step_lines(const DipCostReport *report,
                            DipCostLine lines[DIP_COST_MAX_SWEEPS * DIP_COST_MAX_SWEEP_ROWS]);
// Lists the combinations on the Pareto front of time and error.
int dip_cost_front_lines(const DipCostReport *report, DipCostLine lines[DIP_COST_MAX_ROWS]);
// Lists all measured combinations.
int dip_cost_combination_lines(const DipCostReport *report, DipCostLine lines[DIP_COST_MAX_ROWS]);

// Returns the line of a prediction.
DipCostLine dip_cost_prediction_line(const DipCostReport *report, int prediction);

// Initialisers of a DipTable whose items are lines.
#define DIP_COST_LINES(REPORT, LINES, COUNT)                                                       \
    .record = &dip_cost_line_record, .context = (void *)(REPORT),                                  \
    .limits = dip_cost_budgets(REPORT), .row = &(LINES)->row, .items = LINES, .count = COUNT

#endif
