// Lists the combinations that are to be predicted. Counts their work, or composes it from the work
// of others (combinations.h).
#include "app/cost/steps.h"

#include "app/report/combinations.h"
#include "app/cli/progress.h"
#include "app/measure/stats/random.h"
#include "app/measure/timing/sample.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

// Number of combinations that add_pool chooses at random. Some of them are measured, to predict all
// others.
enum { POOL = 1024 };

// dip_cost_drop_slow_sample keeps combinations whose estimated time is at most this many times the
// baseline's, so that measuring the sample does not take too long.
static const double most_ratio = 4.0;

// --- which combinations there are ----------------------------------------------------------------

// Returns whether all steps of a sweep draw the same pictures.
static bool is_idle(const DipCostReport *report, const DipCostSweep *sweep) {
    bool same = true;
    for (int i = 0; same && i < sweep->row_count; i++) {
        same = dip_cost_same_pictures(report, sweep->base, sweep->rows[i]);
    }
    return same;
}

void dip_cost_drop_idle_settings(DipCostReport *report) {
    for (int s = 0; s < report->sweep_count; s++) {
        if (is_idle(report, &report->sweeps[s])) {
            const DipSetting setting = report->sweeps[s].setting;
            report->options.combined &= ~(1u << setting);
            if (setting == DIP_SETTING_AAA) {
                report->options.combined &= ~(1u << DIP_SETTING_ASD);
            }
        }
    }
}

static void add_prediction(DipCostReport *report, const DipQuality *quality) {
    DipCostPredictions *predicted = &report->predicted;
    if (dip_report_find_predicted(predicted, quality) < 0) {
        predicted->list[predicted->count++] =
            (DipCostPrediction){.quality = *quality,
                                .row = dip_report_find(report, quality, 0, report->combined_first)};
    }
}

// Lists the baseline, and the combinations that differ from it in one group of settings. Sets
// end[g] to the number of combinations that are listed once group g is done.
static void list_groups(DipCostReport *report, int end[DIP_WORK_GROUPS]) {
    const DipQuality *baseline = &report->options.baseline;
    DipQuality list[DIP_COST_MOST_COUNTED];
    add_prediction(report, baseline);
    for (int g = 0; g < DIP_WORK_GROUPS; g++) {
        const int count = dip_cost_list_combinations(
            baseline, report->options.combined & dip_work_group(g), list, DIP_COST_MOST_COUNTED);
        for (int i = 0; i < count; i++) {
            add_prediction(report, &list[i]);
        }
        end[g] = report->predicted.count;
    }
}

// Adds the corners (dip_work_is_corner) to the list.
static void add_corners(DipCostReport *report) {
    const DipQuality *baseline = &report->options.baseline;
    DipQuality list[DIP_COST_MOST_COUNTED];
    for (int p = 0; p < DIP_WORK_PAIRS; p++) {
        const int count = dip_cost_list_combinations(
            baseline, report->options.combined & dip_work_pair(p), list, DIP_COST_MOST_COUNTED);
        for (int i = 0; i < count; i++) {
            if (dip_work_is_corner(baseline, &list[i])) {
                add_prediction(report, &list[i]);
            }
        }
    }
}

// Adds random combinations, most of which differ from the baseline in several groups of settings.
// Each group that has combined settings has the baseline's settings in about half of these
// combinations.
static void add_pool(DipCostReport *report, const int end[DIP_WORK_GROUPS]) {
    uint64_t random = 1;
    for (int i = 0; i < POOL; i++) {
        DipQuality quality = report->options.baseline;
        for (int g = 0; g < DIP_WORK_GROUPS; g++) {
            const int first = g > 0 ? end[g - 1] : 1, count = end[g] - first;
            if (count > 0 && dip_random_below(&random, 2) == 0) {
                const int option = first + dip_random_below(&random, count);
                quality = dip_cost_take_settings(&quality, &report->predicted.list[option].quality,
                                                 dip_work_group(g));
            }
        }
        add_prediction(report, &quality);
    }
}

bool dip_cost_list_predictions(DipCostReport *report, DipError *err) {
    DipCostPredictions *predicted = &report->predicted;
    const DipCostOptions *options = &report->options;
    const int64_t all = dip_cost_count_combinations_of(&options->baseline, options->combined);
    free(predicted->list);
    predicted->list = calloc(DIP_COST_MAX_ROWS, sizeof *predicted->list);
    predicted->count = 0;
    predicted->searched = all < INT_MAX ? (int)all : INT_MAX;
    if (!predicted->list) {
        return dip_cost_out_of_memory(err);
    }
    int end[DIP_WORK_GROUPS];
    list_groups(report, end);
    if (all > DIP_COST_MAX_ROWS) {
        add_corners(report);
        add_pool(report, end);
        return true;
    }
    DipQuality *list = malloc((size_t)all * sizeof *list);
    if (!list) {
        return dip_cost_out_of_memory(err);
    }
    dip_cost_list_combinations(&options->baseline, options->combined, list, (int)all);
    for (int i = 0; i < all; i++) {
        add_prediction(report, &list[i]);
    }
    free(list);
    return true;
}

// --- counting work -------------------------------------------------------------------------------

bool dip_cost_count(DipCostContext *cost, const DipQuality *quality, int frames, double *counters,
                    DipError *err) {
    memset(counters, 0, DIP_COUNTER_COUNT * sizeof *counters);
    for (int k = 0; k < frames; k++) {
        DipFrame frame;
        // The path is divided into `frames` equal parts. This frame is the middle of part k.
        const int index = dip_cost_frame_count(cost->report) * (2 * k + 1) / (2 * frames);
        if (dip_cost_interrupted(cost, err) ||
            !dip_cost_prepare_timed(cost, quality, 0, index, err) ||
            !dip_cost_draw_timed(cost, quality, 0, index, &frame, err)) {
            return false;
        }
        dip_counters_add(&frame.counters, counters);
    }
    for (int c = 0; c < DIP_COUNTER_COUNT; c++) {
        counters[c] /= frames;
    }
    return true;
}

// Returns whether the work of other combinations may be composed of the work of this combination:
// whether it differs from the baseline in at most one group of settings, or is a corner.
static bool is_part(const DipCostReport *report, const DipQuality *quality) {
    const DipQuality *baseline = &report->options.baseline;
    return dip_work_count_groups(baseline, quality) <= 1 || dip_work_is_corner(baseline, quality);
}

// Returns whether the work of a combination is counted by drawing it. If there are many
// combinations, only those are drawn that others are composed of.
static bool is_counted(const DipCostReport *report, const DipQuality *quality) {
    return report->predicted.count <= DIP_COST_MOST_COUNTED || is_part(report, quality);
}

// Returns the counters of a combination that others are composed of, or NULL if no others are
// composed of it or if it is not listed. dip_work_compose calls this function.
static const double *find_counted(const void *context, const DipQuality *quality) {
    const DipCostReport *report = context;
    if (!is_part(report, quality)) {
        return NULL;
    }
    const int found = dip_report_find_predicted(&report->predicted, quality);
    return found >= 0 ? report->predicted.list[found].counters : NULL;
}

bool dip_cost_compose_counters(const DipCostReport *report, DipCostPrediction *prediction) {
    return dip_work_compose(find_counted, report, &report->options.baseline, &prediction->quality,
                            prediction->counters);
}

bool dip_cost_count_combinations(DipCostContext *cost, DipError *err) {
    DipCostReport *report = cost->report;
    DipCostPredictions *predicted = &report->predicted;
    bool counted = true;
    int drawn = 0;
    for (int i = 0; i < predicted->count; i++) {
        drawn += is_counted(report, &predicted->list[i].quality);
    }
    DipProgress progress = dip_progress_begin("combinations counted", drawn);
    int64_t done = 0;
    for (int i = 0; counted && i < predicted->count; i++) {
        DipCostPrediction *to = &predicted->list[i];
        counted = !is_counted(report, &to->quality) ||
                  dip_cost_count(cost, &to->quality, DIP_COST_COUNTED_FRAMES, to->counters, err);
        done += is_counted(report, &to->quality);
        dip_progress_show(&progress, done);
    }
    if (done > 0) {
        cost->forecast.row_ms =
            1e3 * dip_progress_elapsed_s(&progress) / (double)(done * DIP_COST_COUNTED_FRAMES);
    }
    // The counters of all other combinations are composed. A combination is drawn, too, if a
    // combination that it is composed of is not listed.
    for (int i = 0; counted && i < predicted->count; i++) {
        DipCostPrediction *to = &predicted->list[i];
        counted = is_counted(report, &to->quality) || dip_cost_compose_counters(report, to) ||
                  dip_cost_count(cost, &to->quality, DIP_COST_COUNTED_FRAMES, to->counters, err);
    }
    dip_progress_end(&progress, done);
    return counted;
}

void dip_cost_scale_counters(DipCostReport *report) {
    DipCostPredictions *predicted = &report->predicted;
    for (int c = 0; c < DIP_COUNTER_COUNT; c++) {
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

// --- the sample ----------------------------------------------------------------------------------

// Estimates the time of a frame in nanoseconds, from its main counters and usual prices of work.
static double usual_ns(const double counters[DIP_COUNTER_COUNT]) {
    static const struct {
        int counter;
        double ns;
    } prices[] = {
        {DIP_COUNTER_fragments_shaded, 12.0}, {DIP_COUNTER_texture_probes, 6.0},
        {DIP_COUNTER_samples_shown, 1.0},     {DIP_COUNTER_pixels_filtered, 10.0},
        {DIP_COUNTER_shadow_texels, 1.0},     {DIP_COUNTER_triangles_in, 30.0},
    };
    double ns = 1.0;
    for (size_t i = 0; i < sizeof prices / sizeof *prices; i++) {
        ns += counters[prices[i].counter] * prices[i].ns;
    }
    return ns;
}

void dip_cost_drop_slow_sample(DipCostReport *report) {
    DipCostPredictions *predicted = &report->predicted;
    const DipQuality *baseline = &report->options.baseline;
    const double most_ns = most_ratio * usual_ns(predicted->list[0].counters);
    int kept = 0;
    for (int i = 0; i < predicted->count; i++) {
        const DipCostPrediction *p = &predicted->list[i];
        if (predicted->searched <= DIP_COST_MAX_ROWS ||
            dip_work_count_groups(baseline, &p->quality) <= 1 || usual_ns(p->counters) <= most_ns) {
            predicted->list[kept++] = *p;
        }
    }
    predicted->count = kept;
}
