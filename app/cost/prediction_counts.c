// Drawing a few frames of many combinations, for their counters.
#include "app/cost/prediction_counts.h"

#include "app/cost/combinations.h"
#include "app/progress.h"

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
        if (!dip_cost_draw_settings(c->cost, quality, index, &frame, err)) {
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

static bool is_same(const DipQuality *a, const DipQuality *b) {
    return memcmp(a, b, sizeof *a) == 0;
}

// Returns the combination with these settings, or NULL.
static const DipCostPrediction *find(const DipCostPredictions *predicted,
                                     const DipQuality *quality) {
    for (int i = 0; i < predicted->count; i++) {
        if (is_same(&predicted->list[i].quality, quality)) {
            return &predicted->list[i];
        }
    }
    return NULL;
}

// True if the combination has the baseline's antialiasing or the baseline's filtering.
static bool is_plain(const DipCostReport *report, const DipQuality *quality) {
    const DipQuality *baseline = &report->options.baseline;
    const unsigned sampling = dip_cost_sampling_settings();
    const DipQuality no_sampling = dip_cost_take_settings(quality, baseline, sampling);
    const DipQuality no_filtering = dip_cost_take_settings(quality, baseline, ~sampling);
    return is_same(&no_sampling, quality) || is_same(&no_filtering, quality);
}

// Composes the counters of a combination. The plain combinations that it needs are in the list,
// since the list has every combination of the steps.
static void compose(const DipCostReport *report, DipCostPrediction *to) {
    const DipCostPredictions *predicted = &report->predicted;
    const DipQuality *baseline = &report->options.baseline;
    const unsigned sampling = dip_cost_sampling_settings();
    const DipQuality a = dip_cost_take_settings(&to->quality, baseline, ~sampling);
    const DipQuality b = dip_cost_take_settings(&to->quality, baseline, sampling);
    const DipCostPrediction *with_sampling = find(predicted, &a);
    const DipCostPrediction *with_filtering = find(predicted, &b);
    const DipCostPrediction *neither = find(predicted, baseline);
    for (int c = 0; c < DIP_COST_COUNTER_COUNT; c++) {
        const double base = neither->counters[c];
        to->counters[c] = base > 0.0
                              ? with_sampling->counters[c] * with_filtering->counters[c] / base
                              : with_sampling->counters[c];
    }
}

bool dip_cost_count_combinations(DipCostContext *cost, DipError *err) {
    DipCostReport *report = cost->report;
    DipCostPredictions *predicted = &report->predicted;
    const bool all =
        predicted->count <= DIP_COST_MOST_COUNTED || !find(predicted, &report->options.baseline);
    int64_t drawn = 0;
    for (int i = 0; i < predicted->count; i++) {
        drawn += all || is_plain(report, &predicted->list[i].quality);
    }
    Counting c = {.cost = cost, .predicted = predicted};
    c.progress = dip_progress_begin("frames counted", drawn * DIP_COST_COUNTED_FRAMES);
    bool counted = true;
    for (int i = 0; counted && i < predicted->count; i++) {
        DipCostPrediction *to = &predicted->list[i];
        counted =
            !(all || is_plain(report, &to->quality)) || count(&c, &to->quality, to->counters, err);
    }
    dip_progress_end(&c.progress, c.drawn);
    for (int i = 0; counted && i < predicted->count; i++) {
        if (!all && !is_plain(report, &predicted->list[i].quality)) {
            compose(report, &predicted->list[i]);
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
