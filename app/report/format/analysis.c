// Analyses a whole report.
#include "app/report/format/analysis.h"

#include <stdlib.h>

bool dip_cost_analyse(DipCostReport *report, DipError *err) {
    DipCostAnalysis *analysis = calloc(1, sizeof *analysis);
    free(report->analysis);
    report->analysis = analysis;
    if (!analysis) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
    }
    analysis->fit = dip_cost_fit(report);
    if (report->predicted.count == 0) {
        analysis->interaction_count = dip_cost_interactions(report, analysis->interactions);
    }
    return true;
}
