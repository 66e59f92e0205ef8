// Times and errors of combinations in the segments of a path, and the choice of settings for each.
#include "app/report/segments.h"

#include "app/report/front.h"
#include "app/measure/stats/spend.h"

#include <math.h>
#include <stdlib.h>

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost advise", "out of memory");
}

// --- dividing ------------------------------------------------------------------------------------

// Returns the first of `frames` frames at or after this share of the path: viewpoint / viewpoints.
static int frame_at(int viewpoint, int viewpoints, int frames) {
    return (viewpoint * frames + viewpoints - 1) / viewpoints;
}

static bool divide(const DipCostReport *report, int count, DipCostSegments *segments,
                   DipError *err) {
    const int viewpoints = report->options.places;
    const int frames = dip_cost_frame_count(report);
    segments->count = count;
    for (int s = 0; s < count; s++) {
        const int first = s * viewpoints / count;
        const int end = (s + 1) * viewpoints / count;
        const DipCostSegment segment = {
            .from = (double)first / viewpoints,
            .end = (double)end / viewpoints,
            .first_frame = frame_at(first, viewpoints, frames),
            .end_frame = frame_at(end, viewpoints, frames),
            .first_viewpoint = first,
            .end_viewpoint = end,
        };
        if (first == end || segment.first_frame == segment.end_frame) {
            return dip_error_set(
                err, DIP_ERROR_RANGE, NULL, 0, "--segments",
                "%d is too many: each segment needs a viewpoint and a timed frame, "
                "and the report has %d viewpoint%s and %d frames",
                count, viewpoints, dip_cost_plural(viewpoints), frames);
        }
        segments->list[s] = segment;
    }
    return true;
}

// --- times and errors ----------------------------------------------------------------------------

static bool is_judged_everywhere(const DipCostReport *report, int row) {
    bool judged = true;
    for (int p = 0; p < report->options.places; p++) {
        judged = judged && report->rows[row].judged[p];
    }
    return judged;
}

int dip_cost_default_segments(const DipCostReport *report) {
    const int viewpoints = report->options.places;
    const int frames = dip_cost_frame_count(report);
    const int most = frames < 8 ? frames : 8;
    int rows[DIP_COST_MAX_ROWS];
    const int count = dip_cost_list_plotted(report, rows);
    for (int i = 0; i < count; i++) {
        if (is_judged_everywhere(report, rows[i])) {
            return viewpoints < most ? viewpoints : most;
        }
    }
    return 1;
}

static bool list_rows(const DipCostReport *report, DipCostSegments *segments, DipError *err) {
    int rows[DIP_COST_MAX_ROWS];
    const int count = dip_cost_list_plotted(report, rows);
    segments->rows = malloc(((size_t)count + 1) * sizeof *segments->rows);
    if (!segments->rows) {
        return out_of_memory(err);
    }
    for (int i = 0; i < count; i++) {
        if (is_judged_everywhere(report, rows[i])) {
            segments->rows[segments->row_count++] = rows[i];
        }
    }
    return segments->row_count > 0 ||
           dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "--segments",
                         "no combination of settings has times, and errors at every viewpoint");
}

// The time of frames, of the kind that budgets are meant for. `scratch` has room for the frames.
static double time_of(const DipCostReport *report, const double *ms, int frames, double *scratch) {
    double sum = 0.0, worst = 0.0;
    for (int f = 0; f < frames; f++) {
        sum += ms[f];
        worst = fmax(worst, ms[f]);
    }
    switch (report->options.budget_of) {
    case DIP_COST_BUDGET_MEAN:
        return sum / frames;
    case DIP_COST_BUDGET_WORST:
        return worst;
    default:
        return dip_stats_quantile(ms, frames, 0.95, scratch);
    }
}

static double flip_of(const DipCostReport *report, int row, const DipCostSegment *segment) {
    double sum = 0.0;
    for (int p = segment->first_viewpoint; p < segment->end_viewpoint; p++) {
        sum += dip_metrics_of(&report->rows[row].viewpoints[p], 0).flip;
    }
    return fmax(sum / (segment->end_viewpoint - segment->first_viewpoint),
                dip_cost_floor_flip(report, report->rows[row].path));
}

static void fill_values(const DipCostReport *report, const double *ms, double *scratch,
                        DipCostSegments *segments) {
    const int frames = dip_cost_frame_count(report);
    for (int s = 0; s < segments->count; s++) {
        const DipCostSegment *segment = &segments->list[s];
        for (int i = 0; i < segments->row_count; i++) {
            const int row = segments->rows[i];
            const DipEstimate whole = dip_cost_budget_time(report, row);
            DipCostSegmentValue *value = &segments->values[s * segments->row_count + i];
            value->ms = time_of(report, ms + (size_t)i * (size_t)frames + segment->first_frame,
                                segment->end_frame - segment->first_frame, scratch);
            value->bound = value->ms * whole.high / whole.value;
            value->flip = flip_of(report, row, segment);
        }
    }
}

bool dip_cost_segments_make(const DipCostReport *report, int count, DipCostSegments *segments,
                            DipError *err) {
    const size_t frames = (size_t)dip_cost_frame_count(report);
    *segments = (DipCostSegments){.count = 0};
    if (!divide(report, count, segments, err) || !list_rows(report, segments, err)) {
        return false;
    }
    const size_t rows = (size_t)segments->row_count;
    double *ms = malloc((rows + 1) * frames * sizeof *ms);
    segments->values = malloc(rows * (size_t)count * sizeof *segments->values);
    bool done = (ms && segments->values) || out_of_memory(err);
    if (done) {
        dip_cost_frame_times(report, segments->rows, segments->row_count, ms);
        fill_values(report, ms, ms + rows * frames, segments);
    }
    free(ms);
    return done;
}

void dip_cost_segments_free(DipCostSegments *segments) {
    free(segments->rows);
    free(segments->values);
    *segments = (DipCostSegments){.count = 0};
}

// --- choosing ------------------------------------------------------------------------------------

static const DipCostSegmentValue *value_of(const DipCostSegments *segments, int segment,
                                           int index) {
    return &segments->values[segment * segments->row_count + index];
}

// A segment's share of the viewpoints, and of the timed frames.
static double share_of(const DipCostSegments *segments, int segment) {
    return segments->list[segment].end - segments->list[segment].from;
}

static double frame_share(const DipCostSegments *segments, int segment) {
    const DipCostSegment *s = &segments->list[segment];
    return (double)(s->end_frame - s->first_frame) / segments->list[segments->count - 1].end_frame;
}

// Mean FLIP along the path with combination chosen[segment] in each segment.
static double mean_flip(const DipCostSegments *segments, const int *chosen) {
    double sum = 0.0;
    for (int s = 0; s < segments->count; s++) {
        sum += share_of(segments, s) * value_of(segments, s, chosen[s])->flip;
    }
    return sum;
}

// The same with one combination for the whole path.
static double fixed_flip(const DipCostSegments *segments, int index) {
    int chosen[DIP_COST_MAX_SEGMENTS];
    for (int s = 0; s < segments->count; s++) {
        chosen[s] = index;
    }
    return mean_flip(segments, chosen);
}

// Finds the single combination of least error within the budget.
static int find_fixed(const DipCostReport *report, const DipCostSegments *segments,
                      double budget_ms) {
    int best = -1;
    double least = INFINITY;
    for (int i = 0; i < segments->row_count; i++) {
        const double flip = fixed_flip(segments, i);
        if (dip_cost_budget_time(report, segments->rows[i]).high <= budget_ms && flip < least) {
            least = flip;
            best = i;
        }
    }
    return best;
}

// Chooses settings of equal slope. Returns false if nothing is within the budget.
static bool choose_by_slope(const DipCostSegments *segments, double budget_ms,
                            DipSpendOption *options, DipCostSegmentAdvice *advice) {
    for (int s = 0; s < segments->count; s++) {
        for (int i = 0; i < segments->row_count; i++) {
            const DipCostSegmentValue *value = value_of(segments, s, i);
            options[s * segments->row_count + i] = (DipSpendOption){
                frame_share(segments, s) * value->bound, share_of(segments, s) * value->flip};
        }
    }
    const DipSpendResult result =
        dip_spend(options, segments->count, segments->row_count, budget_ms, advice->chosen);
    advice->slope = result.slope;
    return result.fits;
}

// Chooses the least error in each segment by itself. Returns false if a segment has no combination
// within the budget.
static bool choose_each(const DipCostSegments *segments, double budget_ms,
                        DipCostSegmentAdvice *advice) {
    bool fits = true;
    for (int s = 0; s < segments->count; s++) {
        int best = -1;
        for (int i = 0; i < segments->row_count; i++) {
            const DipCostSegmentValue *value = value_of(segments, s, i);
            if (value->bound <= budget_ms &&
                (best < 0 || value->flip < value_of(segments, s, best)->flip)) {
                best = i;
            }
        }
        advice->chosen[s] = best;
        fits = fits && best >= 0;
    }
    return fits;
}

// Fills in the time with the chosen combinations, which are not all the same.
static void add_time(const DipCostReport *report, const DipCostSegments *segments,
                     DipCostSegmentAdvice *advice) {
    const bool of_mean = report->options.budget_of == DIP_COST_BUDGET_MEAN;
    for (int s = 0; s < segments->count; s++) {
        const DipCostSegmentValue *value = value_of(segments, s, advice->chosen[s]);
        if (of_mean) {
            advice->ms += frame_share(segments, s) * value->ms;
            advice->bound += frame_share(segments, s) * value->bound;
        } else {
            advice->ms = fmax(advice->ms, value->ms);
            advice->bound = fmax(advice->bound, value->bound);
        }
    }
}

// Takes the single combination, if there is one, in every segment.
static void take_fixed(const DipCostReport *report, const DipCostSegments *segments,
                       DipCostSegmentAdvice *advice) {
    for (int s = 0; s < segments->count; s++) {
        advice->chosen[s] = advice->fixed;
    }
    if (advice->fixed >= 0) {
        const DipEstimate time = dip_cost_budget_time(report, segments->rows[advice->fixed]);
        advice->flip = advice->fixed_flip;
        advice->ms = time.value;
        advice->bound = time.high;
    }
}

bool dip_cost_segments_advise(const DipCostReport *report, const DipCostSegments *segments,
                              double budget_ms, DipCostSegmentAdvice *advice, DipError *err) {
    const size_t count = (size_t)segments->count * (size_t)segments->row_count;
    DipSpendOption *options = malloc(count * sizeof *options);
    if (!options) {
        return out_of_memory(err);
    }
    *advice = (DipCostSegmentAdvice){.budget_ms = budget_ms};
    const bool fits = report->options.budget_of == DIP_COST_BUDGET_MEAN
                          ? choose_by_slope(segments, budget_ms, options, advice)
                          : choose_each(segments, budget_ms, advice);
    free(options);
    advice->fixed = find_fixed(report, segments, budget_ms);
    advice->fixed_flip = advice->fixed >= 0 ? fixed_flip(segments, advice->fixed) : 0.0;
    advice->flip = fits ? mean_flip(segments, advice->chosen) : 0.0;
    if (!fits || (advice->fixed >= 0 && advice->flip > 0.99 * advice->fixed_flip)) {
        take_fixed(report, segments, advice);
    } else {
        add_time(report, segments, advice);
    }
    return true;
}
