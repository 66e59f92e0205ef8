// Analyses a whole report: the interactions of its settings, and the fit of its times.
#include "app/report/analysis.h"

#include <math.h>
#include <stdlib.h>

static DipQuality with_step(const DipQuality *quality, DipSetting setting, int step) {
    DipQuality changed = *quality;
    changed.step[setting] = (uint8_t)step;
    return changed;
}

static int last_step(DipSetting setting) {
    return dip_setting_info(setting)->step_count - 1;
}

static double flip_of(const DipCostReport *report, int row) {
    return dip_cost_row_metrics(report, row, 0).flip;
}

// Adds the context of a combination in which both settings have their first steps. The settings of
// the combination with both may be refused or idle, and then there is no row to find.
static void add_context(const DipCostReport *report, const DipQuality *neither,
                        DipCostInteraction *to) {
    const DipQuality a = with_step(neither, to->a, last_step(to->a));
    const DipQuality b = with_step(neither, to->b, last_step(to->b));
    const DipQuality both = with_step(&a, to->b, last_step(to->b));
    const int rows[4] = {dip_report_find_same(report, neither, report->combined_first),
                         dip_report_find_same(report, &a, report->combined_first),
                         dip_report_find_same(report, &b, report->combined_first),
                         dip_report_find_same(report, &both, report->combined_first)};
    if (rows[0] < 0 || rows[1] < 0 || rows[2] < 0 || rows[3] < 0) {
        return;
    }
    to->contexts++;
    to->flip += flip_of(report, rows[3]) - flip_of(report, rows[1]) - flip_of(report, rows[2]) +
                flip_of(report, rows[0]);
    if (dip_cost_is_timed(report, rows[0])) {
        to->time += log(dip_cost_ms(report, rows[3]) * dip_cost_ms(report, rows[0]) /
                        (dip_cost_ms(report, rows[1]) * dip_cost_ms(report, rows[2])));
    }
}

static DipCostInteraction interaction(const DipCostReport *report, DipSetting a, DipSetting b) {
    DipCostInteraction sum = {.a = a, .b = b};
    for (int r = report->combined_first; r < report->row_count; r++) {
        const DipQuality *quality = &report->rows[r].quality;
        if (quality->step[a] == 0 && quality->step[b] == 0) {
            add_context(report, quality, &sum);
        }
    }
    if (sum.contexts > 0) {
        sum.flip /= sum.contexts;
        sum.time = report->rounds > 0 ? exp(sum.time / sum.contexts) : 0.0;
    }
    return sum;
}

int dip_cost_interactions(const DipCostReport *report,
                          DipCostInteraction list[DIP_COST_MAX_INTERACTIONS]) {
    int count = 0;
    for (int a = 0; a < DIP_SETTING_COUNT; a++) {
        for (int b = a + 1; b < DIP_SETTING_COUNT; b++) {
            const DipCostInteraction found = interaction(report, (DipSetting)a, (DipSetting)b);
            if (found.contexts > 0) {
                list[count++] = found;
            }
        }
    }
    return count;
}

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
