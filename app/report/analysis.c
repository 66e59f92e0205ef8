// Analyses a whole report: the interactions of its settings, and the fit of its times.
#include "app/report/analysis.h"

#include <math.h>
#include <stdlib.h>

// Adds one combination of the other settings to the sums of an interaction. `neither` is the
// combination with the first steps of a and b; three more have the last step of a, of b, or of
// both. Adds nothing if one of the four has no row, for example because the renderer refuses it or
// a setting in it has no effect.
static void add_context(const DipCostReport *report, const DipQuality *neither,
                        DipCostInteraction *to) {
    enum { NEITHER, A, B, BOTH };
    double ms[4], flip[4];
    for (int i = NEITHER; i <= BOTH; i++) {
        DipQuality quality = *neither;
        if (i & A) {
            quality.step[to->a] = (uint8_t)(dip_setting_info(to->a)->step_count - 1);
        }
        if (i & B) {
            quality.step[to->b] = (uint8_t)(dip_setting_info(to->b)->step_count - 1);
        }
        const int row = dip_report_find_same(report, &quality, report->combined_first);
        if (row < 0) {
            return;
        }
        ms[i] = dip_cost_ms(report, row);
        flip[i] = dip_cost_row_metrics(report, row).flip;
    }
    to->contexts++;
    to->flip += flip[BOTH] - flip[A] - flip[B] + flip[NEITHER];
    if (report->rounds > 0) {
        to->time += log(ms[BOTH] * ms[NEITHER] / (ms[A] * ms[B]));
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

// Lists the interactions of all pairs of settings for which an interaction was measured
// (add_context). Returns their number.
static int list_interactions(const DipCostReport *report,
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
        return dip_cost_out_of_memory(err);
    }
    analysis->fit = dip_cost_fit(report);
    if (report->predicted.count == 0) {
        analysis->interaction_count = list_interactions(report, analysis->interactions);
    }
    return true;
}
