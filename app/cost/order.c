// What theory says of each setting, and what the report says.
#include "app/cost/order.h"

#include "app/cost/formats.h"

#include <stdio.h>

// How a figure goes from one step to the next; steps are in the order of the settings' list, those
// of adaptive AA from few passes to many.
typedef enum Trend { FREE, FALLS, RISES, STAYS } Trend;

typedef struct Theory {
    DipSetting setting;
    Trend error;
    bool of_two_frames; // the error of the mean of two frames, not FLIP
    Trend work;         // never the other way; may stay
    int counter;
    const char *why; // where a step does not follow
} Theory;

#define FEW_PLACES                                                                                 \
    "differences this small may be of the few places looked at: ask for more --places"

static const Theory theories[] = {
    {DIP_SETTING_AA, FALLS, false, RISES, DIP_COST_COUNTER_samples_shown, FEW_PLACES},
    {DIP_SETTING_AAA, FALLS, false, RISES, DIP_COST_COUNTER_clip_sample_groups, FEW_PLACES},
    {DIP_SETTING_TAA, FALLS, true, FREE, 0,
     "on a path that moves far between two frames their mean is blurred"},
    {DIP_SETTING_AF, FALLS, false, RISES, DIP_COST_COUNTER_texture_probes, FEW_PLACES},
    {DIP_SETTING_AAF, FALLS, false, FREE, 0,
     "surfaces near multiples of 45 degrees have as many probes without it"},
    {DIP_SETTING_OPT, RISES, false, FALLS, DIP_COST_COUNTER_texels_fetched, FEW_PLACES},
    {DIP_SETTING_MIPLOD, FALLS, false, RISES, DIP_COST_COUNTER_texels_fetched,
     "a bias reads smaller levels, but as many texels; what was magnified, and read one level, now "
     "lies between two"},
    {DIP_SETTING_GI, STAYS, false, FALLS, DIP_COST_COUNTER_geometry_bytes, FEW_PLACES},
};

static const char *const trend_words[] = {[FALLS] = "falls", [RISES] = "rises", [STAYS] = "stays"};

static bool follows(Trend trend, double before, double after, bool strictly) {
    switch (trend) {
    case FALLS:
        return after < before || (!strictly && after == before);
    case RISES:
        return after > before || (!strictly && after == before);
    case STAYS:
        return after == before;
    default:
        return true;
    }
}

static double error_of(const DipCostReport *report, const Theory *theory, int row, bool *judged) {
    int viewpoints;
    const DipMetricSums sums = dip_cost_row_sums(report, row, &viewpoints);
    *judged = *judged && viewpoints > 0;
    return theory->of_two_frames ? dip_flicker_metrics_of(&sums).two_mean
                                 : dip_metrics_of(&sums, 0).flip;
}

// The first step that does not follow; sweep->row_count when all do.
static int first_stray(const DipCostReport *report, const DipCostSweep *sweep, const Theory *theory,
                       bool by_work, bool *judged) {
    for (int i = 1; i < sweep->row_count; i++) {
        const int before = sweep->rows[i - 1];
        const int after = sweep->rows[i];
        const bool right =
            by_work ? follows(theory->work, report->rows[before].counters[theory->counter],
                              report->rows[after].counters[theory->counter], false)
                    : follows(theory->error, error_of(report, theory, before, judged),
                              error_of(report, theory, after, judged), true);
        if (!right) {
            return i;
        }
    }
    return sweep->row_count;
}

static bool is_counted(const DipCostReport *report, const DipCostSweep *sweep) {
    bool timed = true; // counters are of timed frames
    for (int i = 0; i < sweep->row_count; i++) {
        timed = timed && dip_cost_is_timed(report, sweep->rows[i]);
    }
    return timed;
}

bool dip_cost_order_text(const DipCostReport *report, const DipCostSweep *sweep, char *text,
                         size_t size_bytes) {
    const Theory *theory = NULL;
    for (size_t i = 0; i < sizeof theories / sizeof *theories; i++) {
        theory = theories[i].setting == sweep->setting ? &theories[i] : theory;
    }
    bool judged = theory && sweep->row_count > 1;
    const int by_error = judged ? first_stray(report, sweep, theory, false, &judged) : 0;
    if (!judged) {
        return false;
    }
    const bool counted = theory->work != FREE && is_counted(report, sweep);
    const int by_work = counted ? first_stray(report, sweep, theory, true, &judged) : 0;
    const char *error = theory->of_two_frames ? "the error of the mean of two frames" : "FLIP";
    const char *work = counted ? dip_cost_counter_names[theory->counter] : "";
    const bool error_strays = by_error < sweep->row_count;
    const bool work_strays = counted && by_work < sweep->row_count;
    if (!error_strays && !work_strays) {
        snprintf(text, size_bytes, "In order: %s %s from step to step%s%s%s%s.", error,
                 trend_words[theory->error], counted ? ", " : "", work, counted ? " " : "",
                 counted ? trend_words[theory->work] : "");
        return true;
    }
    char step[DIP_COST_TEXT];
    dip_cost_step_text(report, sweep, sweep->rows[error_strays ? by_error : by_work], step);
    snprintf(text, size_bytes, "Not in order: %s should %s, and at \"%s\" does not; %s.",
             error_strays ? error : work,
             (error_strays ? theory->error : theory->work) == FALLS   ? "fall"
             : (error_strays ? theory->error : theory->work) == RISES ? "rise"
                                                                      : "stay",
             step, theory->why);
    return true;
}
