// Listing combinations and their Pareto front.
#include "app/report/front.h"

int dip_cost_list_plotted(const DipCostReport *report, int *rows) {
    int count = 0;
    for (int r = report->combined_first; r < report->row_count; r++) {
        int viewpoints;
        dip_cost_row_sums(report, r, &viewpoints);
        if (viewpoints > 0 && dip_cost_is_timed(report, r)) {
            rows[count++] = r;
        }
    }
    return count;
}

int dip_cost_list_front(const DipCostReport *report, int *rows) {
    int all[DIP_COST_MAX_ROWS];
    const int count = dip_cost_list_plotted(report, all);
    return dip_cost_pareto_front_thin(report, rows,
                                      dip_cost_pareto_front(report, all, count, rows));
}
