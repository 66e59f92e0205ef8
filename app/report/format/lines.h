// Lists rows of a report as lines of the tables that CSV, terminals and pages have. One function
// makes each list, so all forms have the same lines.
#ifndef DIP_APP_REPORT_FORMAT_LINES_H
#define DIP_APP_REPORT_FORMAT_LINES_H

#include "app/report/format/cost_fields.h"

// All members are borrowed. The context of fields is the report.
typedef struct DipCostLine {
    const char *kind; // "a/a", "step", "combination", "predicted", "front" or "floor".
    int row;          // Row of the report; -1: the combination was only predicted.
    int path;
    const DipQuality *quality;
    const DipCostSweep *sweep;           // NULL: the row is no step of a sweep.
    int step;                            // Index of the step in the sweep.
    const DipCostPrediction *prediction; // NULL: there is none.
    int number;                          // Number on the Pareto front, from 1 on; 0: not on it.
    const DipCandidate *candidate;       // NULL: none.
    const DipCandidate *before;          // The one before on the front; NULL: there is none.
} DipCostLine;

extern const DipRecord dip_cost_line_record;

// These functions list the A/A row and the base row of each path, the steps of one sweep and of all
// sweeps, the Pareto front, and all combinations. They return the number of lines.
int dip_cost_same_lines(const DipCostReport *report, DipCostLine lines[DIP_COST_MAX_PATHS]);
int dip_cost_floor_lines(const DipCostReport *report, DipCostLine lines[DIP_COST_MAX_PATHS]);
int dip_cost_step_lines(const DipCostReport *report, int sweep,
                        DipCostLine lines[DIP_COST_MAX_SWEEP_ROWS]);
int dip_cost_all_step_lines(const DipCostReport *report,
                            DipCostLine lines[DIP_COST_MAX_SWEEPS * DIP_COST_MAX_SWEEP_ROWS]);
int dip_cost_front_lines(const DipCostReport *report, DipCostLine lines[DIP_COST_MAX_ROWS]);
int dip_cost_combination_lines(const DipCostReport *report, DipCostLine lines[DIP_COST_MAX_ROWS]);

// Returns the line of a prediction.
DipCostLine dip_cost_prediction_line(const DipCostReport *report, int prediction);

// Members of a DipTable that has lines of the report as items.
#define DIP_COST_LINES(REPORT, LINES, COUNT)                                                       \
    .record = &dip_cost_line_record, .context = (void *)(REPORT), .row = &(LINES)->row,            \
    .items = LINES, .count = COUNT

#endif
