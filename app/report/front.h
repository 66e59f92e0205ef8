// The combinations with a time and an error, and their Pareto front, as the table and the page show
// them.
#ifndef DIP_APP_REPORT_FRONT_H
#define DIP_APP_REPORT_FRONT_H

#include "app/report/report.h"

// Lists the combinations that have both a time and an error. `rows` has room for
// DIP_COST_MAX_ROWS. Returns their number.
int dip_cost_list_plotted(const DipCostReport *report, int *rows);

// Lists the thinned Pareto front of these combinations (dip_cost_pareto_front_thin) in order of
// time. `rows` has room for DIP_COST_MAX_ROWS. Returns the number of rows.
int dip_cost_list_front(const DipCostReport *report, int *rows);

#endif
