// The lines of tables that are about rows of a report: what CSV, terminals and pages list. Each
// list is made by one function, so all forms have the same lines.
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
    int step;                            // Index in the sweep.
    const DipCostPrediction *prediction; // NULL: there is none.
    int number;                          // On the front, from 1 on; 0: elsewhere.
    const DipCandidate *candidate;       // NULL: none.
    const DipCandidate *before;          // On the front; NULL: the first.
} DipCostLine;

extern const DipRecord dip_cost_line_record;

// Each list returns the number of its lines. `lines` has room for as many as named: a line per
// path, per step of a sweep, per row of the report, or per prediction.
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

// Members of a DipTable of lines of the report, and an array of its columns.
#define DIP_COST_LINES(REPORT, LINES, COUNT, COLUMNS)                                              \
    .record = &dip_cost_line_record, .context = (void *)(REPORT), .row = dip_cost_line_row,        \
    .items = LINES, .count = COUNT, .columns = COLUMNS,                                            \
    .column_count = DIP_FIELD_COUNT_OF(COLUMNS)

// Row of the report that a line shows, or -1; for tables.
int dip_cost_line_row(const DipFieldAt *at);

#endif
