// Checks whether error and work follow theory from one step of a sweep to the next. A table holds
// what theory says about each setting; it lacks the settings about which theory says nothing.
#include "app/report/analysis.h"

#include <stdio.h>

// How a value changes from one step of a setting to the next. FREE means that theory says nothing.
// The steps have the order of DIP_SETTING_LIST, except those of adaptive AA, which go from few
// sample groups to many.
typedef enum Trend { FREE, FALLS, RISES, STAYS } Trend;

typedef struct Theory {
    DipSetting setting;
    Trend error;
    bool of_two_frames; // True if the error is the RMSE of the mean of two frames; otherwise FLIP.
    Trend work;         // Trend of `counter`; a step with equal work also follows the trend.
    int counter;
    const char *why;  // The likely reason if a step does not follow the trend.
    const char *idle; // What the path lacks if all steps draw equal pictures; NULL if they always
                      // draw equal pictures.
} Theory;

#define FEW_VIEWPOINTS                                                                             \
    "So small a difference may be due to the small number of viewpoints; --places N measures at "  \
    "more of them"

#define TEXTURES "colour textures that are smaller than their largest mip level"

static const Theory theories[] = {
    {DIP_SETTING_AA, FALLS, false, RISES, DIP_COUNTER_samples_shown, FEW_VIEWPOINTS, "edges"},
    {DIP_SETTING_AAA, FALLS, false, RISES, DIP_COUNTER_clip_sample_groups, FEW_VIEWPOINTS,
     "alpha-clipped surfaces"},
    {DIP_SETTING_TAA, FALLS, true, FREE, 0,
     "Where the camera moves far between two frames, their mean is blurred", "edges"},
    {DIP_SETTING_AF, FALLS, false, RISES, DIP_COUNTER_texture_probes, FEW_VIEWPOINTS,
     "textures that are seen at an angle"},
    {DIP_SETTING_AAF, FALLS, false, FREE, 0,
     "Surfaces that tilt away at nearly a multiple of 45 degrees on the screen get as many probes "
     "without aaf as with it",
     "textures that are seen at an angle"},
    {DIP_SETTING_OPT, RISES, false, FALLS, DIP_COUNTER_texels_fetched, FEW_VIEWPOINTS, TEXTURES},
    {DIP_SETTING_MIPLOD, FALLS, false, RISES, DIP_COUNTER_texels_fetched,
     "With a bias, most reads take as many texels as without it, but from smaller mip levels; on a "
     "magnified surface, a read may even take two levels instead of one",
     TEXTURES},
    {DIP_SETTING_SCALE, FALLS, false, RISES, DIP_COUNTER_target_bytes, FEW_VIEWPOINTS,
     "edges and textures"},
    {DIP_SETTING_SHADOWS, FALLS, false, RISES, DIP_COUNTER_shadow_texels,
     "Where the texels of the shadow map are smaller than pixels, more of them make edges jagged "
     "instead of truer",
     "surfaces that a directional light of the scene lights"},
    {DIP_SETTING_GI, STAYS, false, FALLS, DIP_COUNTER_geometry_bytes, FEW_VIEWPOINTS, NULL},
};

static const char *const trend_words[] = {
    [FALLS] = "falls", [RISES] = "rises", [STAYS] = "stays the same"};

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
    *judged = *judged && viewpoints > 0 && (!theory->of_two_frames || dip_cost_has_flicker(report));
    return theory->of_two_frames ? dip_flicker_metrics_of(&sums).two_mean
                                 : dip_metrics_of(&sums, 0).flip;
}

// Returns the row with which step i of the sweep is compared: the row of the step before it. Theory
// does not say whether aaa=coverage or few sample groups are better, so the step after aaa=coverage
// is compared with the step before aaa=coverage.
static int row_before(const DipCostReport *report, const DipCostSweep *sweep, int i) {
    const int before = sweep->rows[i - 1];
    const bool covers = i > 1 && sweep->setting == DIP_SETTING_AAA &&
                        report->rows[before].quality.step[DIP_SETTING_AAA] == DIP_AAA_COVERAGE;
    return covers ? sweep->rows[i - 2] : before;
}

// Returns the index of the first step that does not follow theory, or sweep->row_count if all steps
// do. Checks the work if `by_work` is true, otherwise the error. If theory->idle is set, a step
// that draws the same pictures as the step with which it is compared also follows theory. Sets
// *judged to false if the errors of a step are not known.
static int first_departure(const DipCostReport *report, const DipCostSweep *sweep,
                           const Theory *theory, bool by_work, bool *judged) {
    for (int i = 1; i < sweep->row_count; i++) {
        const int before = row_before(report, sweep, i);
        const int after = sweep->rows[i];
        const bool right =
            (theory->idle && dip_cost_same_pictures(report, before, after)) ||
            (by_work ? follows(theory->work, report->rows[before].counters[theory->counter],
                               report->rows[after].counters[theory->counter], false)
                     : follows(theory->error, error_of(report, theory, before, judged),
                               error_of(report, theory, after, judged), true));
        if (!right) {
            return i;
        }
    }
    return sweep->row_count;
}

static bool all_same(const DipCostReport *report, const DipCostSweep *sweep) {
    for (int i = 1; i < sweep->row_count; i++) {
        if (!dip_cost_same_pictures(report, sweep->rows[0], sweep->rows[i])) {
            return false;
        }
    }
    return true;
}

bool dip_cost_order_text(const DipCostReport *report, const DipCostSweep *sweep, char *text,
                         size_t size_bytes) {
    const Theory *theory = NULL;
    for (size_t i = 0; i < sizeof theories / sizeof *theories; i++) {
        theory = theories[i].setting == sweep->setting ? &theories[i] : theory;
    }
    bool judged = theory && sweep->row_count > 1;
    const int by_error = judged ? first_departure(report, sweep, theory, false, &judged) : 0;
    if (!judged) {
        return false;
    }
    if (theory->idle && all_same(report, sweep)) {
        snprintf(text, size_bytes,
                 "All steps draw the same pictures: the viewpoints on this path show no %s.",
                 theory->idle);
        return true;
    }
    // A report without times has no counters.
    const bool counted = theory->work != FREE && report->rounds > 0;
    const int by_work =
        counted ? first_departure(report, sweep, theory, true, &judged) : sweep->row_count;
    const char *error = theory->of_two_frames ? "the error of the mean of two frames" : "FLIP";
    char work[DIP_COST_TEXT], step[DIP_COST_TEXT];
    snprintf(work, sizeof work, "the counter %s", dip_counter_names[theory->counter]);
    const bool error_departs = by_error < sweep->row_count;
    if (!error_departs && by_work == sweep->row_count) {
        snprintf(text, size_bytes, "As theory says: %s %s from step to step%s%s%s%s.", error,
                 trend_words[theory->error], counted ? ", and " : "", counted ? work : "",
                 counted ? " " : "", counted ? trend_words[theory->work] : "");
        return true;
    }
    const Trend expected = error_departs ? theory->error : theory->work;
    dip_cost_step_text(report, sweep, sweep->rows[error_departs ? by_error : by_work], step);
    snprintf(text, size_bytes, "Not as theory says: at step \"%s\", %s should %s but does not. %s.",
             step, error_departs ? error : work,
             expected == FALLS   ? "fall"
             : expected == RISES ? "rise"
                                 : "stay the same",
             theory->why);
    return true;
}
