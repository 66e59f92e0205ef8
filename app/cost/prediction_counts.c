// Draws a few frames of many combinations, for their counters.
#include "app/cost/prediction_counts.h"

#include "app/report/combinations.h"
#include "app/report/work.h"
#include "app/cli/progress.h"

#include <string.h>

typedef struct Counting {
    DipCostContext *cost;
    DipCostPredictions *predicted;
    DipProgress progress;
    int64_t drawn;
} Counting;

// The timed frame that is the k-th counted frame: the middle of the k-th of equal parts.
static int counted_frame(const DipCostReport *report, int k) {
    return dip_cost_frame_count(report) * (2 * k + 1) / (2 * DIP_COST_COUNTED_FRAMES);
}

static bool count(Counting *c, const DipQuality *quality, double *counters, DipError *err) {
    memset(counters, 0, DIP_COST_COUNTER_COUNT * sizeof *counters);
    for (int k = 0; k < DIP_COST_COUNTED_FRAMES; k++) {
        DipFrame frame;
        const int index = counted_frame(c->cost->report, k);
        if (!dip_cost_draw_settings(c->cost, quality, 0, index, &frame, err)) {
            return false;
        }
        double *value = counters;
#define ADD_COUNTER(name, text) *value++ += (double)frame.counters.name / DIP_COST_COUNTED_FRAMES;
        DIP_COUNTER_LIST(ADD_COUNTER)
#undef ADD_COUNTER
        dip_progress_show(&c->progress, ++c->drawn);
        if (dip_cost_interrupted(c->cost, err)) {
            return false;
        }
    }
    return true;
}

// The counters of a listed combination; see DipWorkFind.
static const double *find(const void *context, const DipQuality *quality) {
    const DipCostPredictions *predicted = context;
    const int found = dip_report_find_predicted(predicted, quality);
    return found >= 0 ? predicted->list[found].counters : NULL;
}

// True if the combination is composed rather than drawn: of many combinations, those that have
// neither the baseline's antialiasing nor its filtering. A list from which combinations with the
// same pictures were joined can lack what a combination is composed of.
static bool is_composed(const DipCostReport *report, const DipCostPrediction *combination) {
    const DipQuality *baseline = &report->options.baseline;
    const unsigned settings = dip_cost_sampling_settings();
    const DipQuality sampling = dip_cost_take_settings(&combination->quality, baseline, ~settings);
    const DipQuality filtering = dip_cost_take_settings(&combination->quality, baseline, settings);
    return report->predicted.count > DIP_COST_MOST_COUNTED &&
           !dip_quality_equal(&sampling, &combination->quality) &&
           !dip_quality_equal(&filtering, &combination->quality) &&
           find(&report->predicted, baseline) && find(&report->predicted, &sampling) &&
           find(&report->predicted, &filtering);
}

bool dip_cost_count_combinations(DipCostContext *cost, DipError *err) {
    const DipCostReport *report = cost->report;
    DipCostPredictions *predicted = &cost->report->predicted;
    int64_t drawn = 0;
    for (int i = 0; i < predicted->count; i++) {
        drawn += !is_composed(report, &predicted->list[i]);
    }
    Counting c = {.cost = cost, .predicted = predicted};
    c.progress = dip_progress_begin("frames counted", drawn * DIP_COST_COUNTED_FRAMES);
    bool counted = true;
    for (int i = 0; counted && i < predicted->count; i++) {
        DipCostPrediction *to = &predicted->list[i];
        counted = is_composed(report, to) || count(&c, &to->quality, to->counters, err);
    }
    dip_progress_end(&c.progress, c.drawn);
    for (int i = 0; counted && i < predicted->count; i++) {
        DipCostPrediction *to = &predicted->list[i];
        if (is_composed(report, to)) {
            dip_work_compose(find, predicted, &report->options.baseline, &to->quality,
                             to->counters);
        }
    }
    return counted;
}

void dip_cost_scale_counters(DipCostReport *report) {
    DipCostPredictions *predicted = &report->predicted;
    for (int c = 0; c < DIP_COST_COUNTER_COUNT; c++) {
        double few = 0.0, all = 0.0;
        for (int i = 0; i < predicted->count; i++) {
            const DipCostPrediction *p = &predicted->list[i];
            if (p->row >= 0) {
                few += p->counters[c];
                all += report->rows[p->row].counters[c];
            }
        }
        for (int i = 0; i < predicted->count; i++) {
            DipCostPrediction *p = &predicted->list[i];
            p->counters[c] = p->row >= 0 ? report->rows[p->row].counters[c]
                             : few > 0.0 ? p->counters[c] * all / few
                                         : p->counters[c];
        }
    }
}
