// Lists the fields of cost.json, in the order in which they are written and read.
#include "app/report/format/cost_fields.h"

#include "app/measure/stats/estimate.h"
#include "app/report/choice.h"
#include "app/report/analysis.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- items ---------------------------------------------------------------------------------------

static DipCostReport *report_of(const DipFieldAt *at) {
    return at->context;
}

// Returns the index of the row that at->item points to.
static int row_of(const DipFieldAt *at) {
    return (int)((const DipCostRow *)at->item - report_of(at)->rows);
}

// Initialises a DipField that is an object in JSON but no struct in C: its fields are members of
// the struct that has this field.
#define PART .kind = DIP_FIELD_RECORD, .where = DIP_FIELD_JSON

static bool is_row(const DipCostReport *report, int row) {
    return row >= 0 && row < report->row_count;
}

#define SETTING_KEY(key, ...) #key,
static const char *const setting_keys[] = {DIP_SETTING_LIST(SETTING_KEY)};
#undef SETTING_KEY

static int count_set(const bool *flags, int count) {
    int set = 0;
    for (int i = 0; i < count; i++) {
        set += flags[i];
    }
    return set;
}

// Returns the index of the set flag that has `number` set flags before it.
static int find_set(const bool *flags, int number) {
    int i = 0;
    for (int left = number + !flags[0]; left > 0; left -= flags[i]) {
        i++;
    }
    return i;
}

// --- metrics -------------------------------------------------------------------------------------

static const DipField metrics_fields[] = {
    {"rmse_lin", "RMSE", "linear", "Root mean square error in linear light, 0 to 1.",
     DIP_FACT(NUMBER, DipMetrics, rmse_lin), .digits = 5},
    {"psnr_db", "PSNR", "dB", "Peak signal-to-noise ratio on 8-bit sRGB values; higher is better.",
     DIP_FACT(NUMBER, DipMetrics, psnr_db), .digits = 2},
    {"ssim", "SSIM", NULL,
     "Structural similarity of luma on 8-bit sRGB values, at most 1; higher is better.",
     DIP_FACT(NUMBER, DipMetrics, ssim), .digits = 4},
    {"flip", "FLIP", NULL,
     "How different two pictures look when one alternates between them, 0 to 1.",
     DIP_FACT(NUMBER, DipMetrics, flip), .digits = 4},
};
const DipRecord dip_cost_metrics_record = DIP_RECORD(
    "metrics", "Metrics of pictures against the truth.", metrics_fields, DipMetrics, NULL);

typedef struct Region {
    double pixels;
    DipMetrics metrics;
} Region;

// Derives the share that a class of pixels has in all pixels. The item is a region of a Figures
// (below), whose first region is the whole picture.
static const void *derive_share(const DipFieldAt *at, DipFieldScratch *scratch) {
    const Region *all = at->owner->item;
    scratch->numbers[0] = ((const Region *)at->item)->pixels / fmax(all->pixels, 1.0);
    return scratch->numbers[0] > 0.0 ? scratch : NULL;
}

static const DipField region_fields[] = {
    {"pixels", NULL, NULL, "Number of pixels of this class, over all judged pictures.",
     DIP_FACT(NUMBER, Region, pixels)},
    {"rmse_lin", "RMSE", "linear", "RMSE of the pixels of this class.",
     DIP_FACT(NUMBER, Region, metrics.rmse_lin), .digits = 5},
    {"psnr_db", "PSNR", "dB", "PSNR of the pixels of this class.",
     DIP_FACT(NUMBER, Region, metrics.psnr_db), .digits = 2},
    {"ssim", "SSIM", NULL, "SSIM of the pixels of this class.",
     DIP_FACT(NUMBER, Region, metrics.ssim), .digits = 4},
    {"flip", "FLIP", NULL, "Mean FLIP of the pixels of this class.",
     DIP_FACT(NUMBER, Region, metrics.flip), .digits = 4},
    {"share", "of all pixels", "%", "Share of all pixels that are of this class.",
     DIP_SHOWN(NUMBER, derive_share), .digits = 1, .scale = 100.0},
};
static const DipRecord region_record = DIP_RECORD(
    "class of pixels", "Metrics of the pixels of one class.", region_fields, Region, NULL);

typedef struct Figures {
    Region regions[DIP_METRIC_REGION_COUNT];
} Figures;

#define REGION_FIELD(INDEX, name, text)                                                            \
    {name,                                                                                         \
     NULL,                                                                                         \
     NULL,                                                                                         \
     "Metrics of the pixels of the class \"" name "\": " text ".",                                 \
     .kind = DIP_FIELD_RECORD,                                                                     \
     .where = DIP_FIELD_JSON,                                                                      \
     .record = &region_record,                                                                     \
     .offset = (INDEX) * sizeof(Region)},
#define SEEN_FIELD(NAME, name, text) REGION_FIELD(1 + DIP_SEEN_##NAME, name, text)
static const DipField figures_fields[] = {REGION_FIELD(0, "all", "the whole picture")
                                              DIP_SEEN_LIST(SEEN_FIELD)};
static const DipRecord figures_record =
    DIP_RECORD("figures", "Metrics of each class of pixels.", figures_fields, Figures, NULL);

// Adds up the errors of a row at all judged viewpoints. Returns false if none was judged.
static bool sums_of(const DipFieldAt *at, DipMetricSums *sums) {
    int viewpoints;
    *sums = dip_cost_row_sums(report_of(at), row_of(at), &viewpoints);
    return viewpoints > 0;
}

static bool is_judged(const DipFieldAt *at) {
    DipMetricSums sums;
    return sums_of(at, &sums);
}

static const void *derive_figures(const DipFieldAt *at, DipFieldScratch *scratch) {
    DipMetricSums sums;
    const bool judged = sums_of(at, &sums);
    Figures *figures = (Figures *)scratch;
    for (int r = 0; r < DIP_METRIC_REGION_COUNT; r++) {
        figures->regions[r] = (Region){sums.regions[r].pixels, {NAN, NAN, NAN, NAN}};
        if (sums.regions[r].pixels > 0.0) {
            figures->regions[r].metrics = dip_metrics_of(&sums, r);
        }
    }
    return judged ? figures : NULL;
}

static const DipField over_time_fields[] = {
    {"static_rms_lin", NULL, "linear", "Error that does not change from frame to frame.",
     DIP_FACT(NUMBER, DipFlickerMetrics, steady), .digits = 5},
    {"flicker_rms_lin", "flicker", "linear",
     "The part of the error that changes from frame to frame: root mean square of its deviation "
     "over time, in linear light.",
     DIP_FACT(NUMBER, DipFlickerMetrics, flicker), .digits = 5},
    {"step_rms_lin", NULL, "linear", "Change of the error from one frame to the next.",
     DIP_FACT(NUMBER, DipFlickerMetrics, step), .digits = 5},
    {"two_frame_mean_rms_lin", "two-frame mean", "linear",
     "Root mean square error of the mean of two successive frames.",
     DIP_FACT(NUMBER, DipFlickerMetrics, two_mean), .digits = 5},
};
static const DipRecord over_time_record =
    DIP_RECORD("over time", "How the error changes within a burst of successive frames.",
               over_time_fields, DipFlickerMetrics, NULL);

static const void *derive_over_time(const DipFieldAt *at, DipFieldScratch *scratch) {
    DipMetricSums sums;
    return sums_of(at, &sums) ? DIP_MADE(DipFlickerMetrics, dip_flicker_metrics_of(&sums)) : NULL;
}

// Returns the sweep of a step. All steps of a sweep have the sweep itself as their item.
static const DipCostSweep *sweep_of(const DipFieldAt *at) {
    return at->item;
}

// Calls X(METRIC, name, title, unit, digits) for each metric that has an interval.
#define METRIC_LIST(X)                                                                             \
    X(RMSE, "rmse_lin", "RMSE", "linear", 5)                                                       \
    X(PSNR, "psnr_db", "PSNR", "dB", 2)                                                            \
    X(SSIM, "ssim", "SSIM", NULL, 4)                                                               \
    X(FLIP, "flip", "FLIP", NULL, 4)                                                               \
    X(FLICKER, "flicker_rms_lin", "flicker", "linear", 5)

// Defines two functions for a metric. One derives a row's metric with its interval over the
// viewpoints. The other derives the change of the metric from the base of a sweep to a step.
#define METRIC_FUNCTIONS(METRIC, ...)                                                              \
    DIP_DERIVE(derive_##METRIC,                                                                    \
               is_judged(at) ? DIP_MADE(DipEstimate, dip_cost_metric(report_of(at), row_of(at),    \
                                                                     DIP_COST_##METRIC))           \
                             : NULL)                                                               \
    DIP_DERIVE(                                                                                    \
        derive_change_##METRIC,                                                                    \
        DIP_MADE(DipEstimate, dip_cost_metric_change(report_of(at), sweep_of(at)->rows[at->index], \
                                                     sweep_of(at)->base, DIP_COST_##METRIC)))
METRIC_LIST(METRIC_FUNCTIONS)

// --- viewpoints ----------------------------------------------------------------------------------

// A DipCostTail begins with its DipFlipTail, so the offsets in tail_fields also hold for a
// DipFlipTail alone.
#define TAIL_FIELD(name, MEMBER, MOST, title, means, DIGITS)                                       \
    {                                                                                              \
        name, title, NULL, means, DIP_FACT(NUMBER, DipCostTail, flip.MEMBER), .most = MOST,        \
                                                                              .digits = DIGITS     \
    }
static const void *derive_place(const DipFieldAt *at, DipFieldScratch *scratch) {
    const DipCostTail *tail = at->item;
    const DipFlipTail *flip = &tail->flip;
    snprintf(scratch->text, sizeof scratch->text,
             "viewpoint %d, frame %.0f, %.0f x %.0f px at (%.0f, %.0f)", tail->worst_viewpoint + 1,
             flip->worst_frame + 1.0, flip->worst_width, flip->worst_height, flip->worst_x,
             flip->worst_y);
    return scratch->text;
}

static const DipField tail_fields[] = {
    TAIL_FIELD("p50", p50, 1.0, "50 %", "Half of the pixels have at most this FLIP.", 4),
    TAIL_FIELD("p95", p95, 1.0, "95 %", "95 % of the pixels have at most this FLIP.", 4),
    TAIL_FIELD("p99", p99, 1.0, "99 %", "99 % of the pixels have at most this FLIP.", 4),
    TAIL_FIELD("worst", worst, 1.0, "worst block",
               "The greatest mean FLIP of a block of at most 32 x 32 pixels.", 4),
    TAIL_FIELD("worst_frame", worst_frame, 1e3, "its frame",
               "Index of the burst's frame with the block of the greatest mean FLIP, from 0 on.",
               0),
    TAIL_FIELD("worst_x", worst_x, 8192.0, NULL,
               "Left edge of the block with the greatest mean FLIP, in pixels.", 0),
    TAIL_FIELD("worst_y", worst_y, 8192.0, NULL,
               "Top edge of the block with the greatest mean FLIP, in pixels.", 0),
    TAIL_FIELD("worst_width", worst_width, 8192.0, NULL,
               "Width of the block with the greatest mean FLIP, in pixels.", 0),
    TAIL_FIELD("worst_height", worst_height, 8192.0, NULL,
               "Height of the block with the greatest mean FLIP, in pixels.", 0),
    {"worst_viewpoint", "its viewpoint", NULL,
     "Index of the row's viewpoint with the block of the greatest mean FLIP, from 0 on; only in "
     "the "
     "tail of a row.",
     DIP_COMPUTED(WHOLE, DipCostTail, worst_viewpoint)},
    {"place", "where", NULL,
     "Viewpoint, frame, size and position of the block with the greatest mean FLIP; only in the "
     "tail of a row.",
     DIP_SHOWN(TEXT, derive_place)},
};
static const DipRecord viewpoint_tail_record = {
    "distribution of FLIP",
    "How FLIP is distributed over the pixels of a viewpoint.",
    tail_fields,
    DIP_FIELD_COUNT_OF(tail_fields) - 2,
    sizeof(DipFlipTail),
    NULL};
static const DipRecord tail_record =
    DIP_RECORD("distribution of FLIP of a row",
               "The percentiles are means over the viewpoints; the worst block is that of the "
               "viewpoint with the worst one.",
               tail_fields, DipCostTail, NULL);

static const void *derive_tail(const DipFieldAt *at, DipFieldScratch *scratch) {
    DipCostTail *tail = (DipCostTail *)scratch;
    *tail = dip_cost_row_tail(report_of(at), row_of(at));
    return tail->viewpoints > 0 ? tail : NULL;
}

// A judged viewpoint of a row.
typedef struct Viewpoint {
    DipFlipTail tail;
    int place;
    char pictures[33];
    DipMetricSums sums;
} Viewpoint;

DIP_OF_ITEM(bool, has_tail, ((const Viewpoint *)at->item)->tail.worst_width > 0.0)

#define SUMS_FIELD(name, means, TYPE, MEMBER)                                                      \
    {                                                                                              \
        name, NULL, NULL, means, DIP_FACT(NUMBERS, TYPE, MEMBER),                                  \
            .least = -DIP_COST_MOST_MEAN * DIP_COST_MOST_COUNT,                                    \
            .most = DIP_COST_MOST_MEAN * DIP_COST_MOST_COUNT                                       \
    }
static const DipField viewpoint_fields[] = {
    {"place", "viewpoint", NULL, "Index of the viewpoint on its path.",
     DIP_FACT(WHOLE, Viewpoint, place), .most = DIP_COST_MAX_PLACES - 1},
    {"pictures", NULL, NULL, "Hash of the row's pictures and truths; \"\" if it is not known.",
     DIP_FACT(TEXT, Viewpoint, pictures)},
    SUMS_FIELD("sums",
               "Sums over the pixels, from which all metrics are computed (DipMetricSums in "
               "app/measure/metrics/metrics.h).",
               Viewpoint, sums),
    {"flip_tail", NULL, NULL, "How FLIP is distributed over the pixels.",
     DIP_FACT(RECORD, Viewpoint, tail), .record = &viewpoint_tail_record, .known = has_tail},
};

// Returns whether a sum over `count` pixels or bursts (series of successive frames) is possible:
// the count is 0 or at least 1, and the mean lies within its limit.
static bool is_sum(double sum, double count) {
    return (count == 0.0 || count >= 1.0) && fabs(sum) <= DIP_COST_MOST_MEAN * count;
}

static bool are_sums(const DipMetricSums *sums) {
    const double bursts = sums->bursts;
    bool ok = is_sum(sums->squared_static, bursts) && is_sum(sums->squared_flicker, bursts) &&
              is_sum(sums->squared_step, bursts) && is_sum(sums->squared_two_mean, bursts);
    for (int i = 0; i < DIP_METRIC_REGION_COUNT; i++) {
        const DipMetricRegionSums *region = &sums->regions[i];
        ok = ok && is_sum(region->squared_lin, region->pixels) &&
             is_sum(region->squared_codes, region->pixels) &&
             is_sum(region->flip, region->pixels) && is_sum(region->ssim, region->ssim_pixels);
    }
    return ok;
}

static const DipRecord viewpoint_record =
    DIP_RECORD("viewpoint of a row", "What was judged at one viewpoint of a row.", viewpoint_fields,
               Viewpoint, NULL);

DIP_OF_ITEM(int, count_viewpoints,
            count_set(((const DipCostRow *)at->item)->judged, report_of(at)->options.places))

static const void *get_viewpoint(const DipFieldAt *at, int index, DipFieldScratch *scratch) {
    const DipCostRow *row = at->item;
    const int place = find_set(row->judged, index);
    Viewpoint *to = (Viewpoint *)scratch;
    *to = (Viewpoint){.tail = row->tails[place], .place = place, .sums = row->viewpoints[place]};
    memcpy(to->pictures, row->pictures[place], sizeof to->pictures);
    return to;
}

static DipErrorCode open_places(const DipFieldAt *at, int count) {
    return count <= report_of(at)->options.places ? DIP_ERROR_NONE : DIP_ERROR_FORMAT;
}

static bool put_viewpoint(const DipFieldAt *at, int index, const void *item) {
    const Viewpoint *from = item;
    DipCostRow *row = (DipCostRow *)at->item;
    (void)index;
    if (from->place >= report_of(at)->options.places || !are_sums(&from->sums)) {
        return false;
    }
    row->judged[from->place] = true;
    row->viewpoints[from->place] = from->sums;
    row->tails[from->place] = from->tail;
    memcpy(row->pictures[from->place], from->pictures, sizeof from->pictures);
    return true;
}

// --- rows ----------------------------------------------------------------------------------------

DIP_OF_ITEM(bool, is_timed, dip_cost_is_timed(report_of(at), row_of(at)))

DIP_DERIVE(derive_text, DIP_WRITTEN(dip_cost_settings_text(&((const DipCostRow *)at->item)->quality,
                                                           scratch->text)))
DIP_DERIVE(derive_at_floor,
           is_judged(at) ? DIP_MADE(bool, dip_cost_at_floor(report_of(at), row_of(at))) : NULL)

#define TIME_FIELD(NAME, title, unit, means, MEMBER, DIGITS)                                       \
    {                                                                                              \
        NAME, title, unit, means, DIP_COMPUTED(ESTIMATE, DipCostRow, time.MEMBER),                 \
            .known = is_timed, .digits = DIGITS                                                    \
    }
#define STAGE_NAMES_FIELD(TYPE, KNOWN)                                                             \
    {                                                                                              \
        "stages_ms", NULL, "ms",                                                                   \
            "The parts of the mean time that each stage of the pipeline takes.",                   \
            DIP_FACT(NUMBERS, TYPE, stage_ms),                                                     \
            .names = dip_cost_stage_names, .most = DIP_COST_MOST_MS, .digits = 3, .known = KNOWN   \
    }
#define COUNTERS_FIELD(TYPE, KNOWN)                                                                \
    {                                                                                              \
        "counters", NULL, NULL, "Work of a frame, as means over the timed frames; it is exact.",   \
            DIP_FACT(NUMBERS, TYPE, counters),                                                     \
            .names = dip_cost_counter_names, .most = DIP_COST_MOST_COUNT, .known = KNOWN,          \
            .scale = 1e-3, .digits = 4, .show = DIP_SHOW_FIGURES                                   \
    }
#define OF_VIEWPOINTS(METRIC, NAME, title, unit, DIGITS)                                           \
    {NAME "_of_viewpoints",                                                                        \
     title,                                                                                        \
     unit,                                                                                         \
     title " over the judged viewpoints, with the interval of what all viewpoints of the path "    \
           "would have.",                                                                          \
     DIP_DERIVED(ESTIMATE, derive_##METRIC),                                                       \
     .digits = DIGITS},
static const DipField row_fields[] = {
    {"settings", NULL, NULL, "All quality settings of the combination.",
     DIP_FACT(SETTINGS, DipCostRow, quality)},
    {"text", "settings", NULL, "The settings that are off their defaults.",
     DIP_DERIVED(TEXT, derive_text)},
    {"path", "path", NULL, "Index of the camera path in `paths`.",
     DIP_FACT(WHOLE, DipCostRow, path), .most = DIP_COST_MAX_PATHS - 1},
    {"places", NULL, NULL, "What was judged at each viewpoint.",
     DIP_LIST(.record = &viewpoint_record, .count = count_viewpoints, .item = get_viewpoint,
              .open = open_places, .put = put_viewpoint)},
    {"figures", NULL, NULL, "Metrics of each class of pixels, over all judged viewpoints.",
     DIP_DERIVED(RECORD, derive_figures), .record = &figures_record},
    {"over_time", NULL, NULL, "How the error changes from frame to frame in the bursts.",
     DIP_DERIVED(RECORD, derive_over_time), .record = &over_time_record},
    METRIC_LIST(OF_VIEWPOINTS){"flip_tail", NULL, NULL, "How FLIP is distributed over the pixels.",
                               DIP_DERIVED(RECORD, derive_tail), .record = &tail_record},
    {"at_floor", "at floor", NULL,
     "Whether the RMSE is below three times the truth's noise floor, so that it cannot be told "
     "from the truth's own noise.",
     DIP_DERIVED(FLAG, derive_at_floor)},
    TIME_FIELD("ratio", "ratio", NULL,
               "The time for the whole path divided by the baseline's; each frame was timed beside "
               "the baseline's same frame.",
               ratio, 3),
    TIME_FIELD("ms", "mean", "ms", "Mean time of the frames along the path, in this run.", mean_ms,
               2),
    TIME_FIELD("p95_ms", "p95", "ms",
               "95th percentile of the times of the frames along the path, in this run.", p95_ms,
               2),
    TIME_FIELD("worst_ms", "worst", "ms", "Time of the slowest frame along the path, in this run.",
               worst_ms, 2),
    STAGE_NAMES_FIELD(DipCostRow, is_timed),
    COUNTERS_FIELD(DipCostRow, is_timed),
};

DIP_OF_ITEM(bool, check_row, ((const DipCostRow *)at->item)->path < report_of(at)->path_count)

const DipRecord dip_cost_row_record =
    DIP_RECORD("row", "One measured combination: quality settings on a camera path.", row_fields,
               DipCostRow, check_row);

static DipErrorCode open_rows(const DipFieldAt *at, int count) {
    DipCostReport *report = report_of(at);
    if (count < 1 || count > DIP_COST_MAX_ROWS) {
        return DIP_ERROR_FORMAT;
    }
    report->options.rounds = report->rounds;
    report->options.end_place = report->options.places;
    report->rows = calloc((size_t)count, sizeof *report->rows);
    report->row_count = report->rows ? count : 0;
    return report->rows && dip_cost_report_alloc(report, NULL) ? DIP_ERROR_NONE : DIP_ERROR_MEMORY;
}

// --- visits --------------------------------------------------------------------------------------

// The greatest number of measured times in a file, divided by the number of its rows and the number
// of frames of a path. Real reports have fewer. A frame has several measured times if its row was
// timed again for advice, or if the row is a baseline, whose frames are timed in every block
// (app/measure/timing/driver.h).
enum { MOST_TIMES = 64 };

// A visit (app/measure/timing/driver.h): successive frames of the log that have the same row,
// start, round and block.
typedef struct Visit {
    int row;
    int start;
    int round;
    int block;
    double begin_ms;
    DipTimed *frames; // Part of the log.
    int count;
} Visit;

static bool is_same_visit(const DipTimed *a, const DipTimed *b) {
    return a->subject == b->subject && a->start == b->start && a->round == b->round &&
           a->block == b->block;
}

static int count_visits(const DipFieldAt *at) {
    const DipCostReport *report = report_of(at);
    int count = 0;
    for (int i = 0; i < report->log_count; i++) {
        count += i == 0 || !is_same_visit(&report->log[i - 1], &report->log[i]);
    }
    return count;
}

// Makes a visit from the log. It begins where the previous visit ends, which *scratch still holds.
static const void *get_visit(const DipFieldAt *at, int index, DipFieldScratch *scratch) {
    const DipCostReport *report = report_of(at);
    Visit *visit = (Visit *)scratch;
    DipTimed *first = index > 0 ? visit->frames + visit->count : report->log;
    *visit = (Visit){.row = first->subject,
                     .start = first->start,
                     .round = first->round,
                     .block = first->block,
                     .begin_ms = (double)first->begin_ns / 1e6,
                     .frames = first};
    const int most = report->log_count - (int)(first - report->log);
    while (visit->count < most && is_same_visit(first, &first[visit->count])) {
        visit->count++;
    }
    return visit;
}

// Refuses visits if the number of starts is missing or does not divide the number of rounds.
// Accepts an empty list, since older files have pairs of times instead (cost_json.c).
static DipErrorCode open_visits(const DipFieldAt *at, int count) {
    const DipCostReport *report = report_of(at);
    return count == 0 || (report->starts > 0 && report->rounds % report->starts == 0)
               ? DIP_ERROR_NONE
               : DIP_ERROR_FORMAT;
}

static bool put_visit(const DipFieldAt *at, int index, const void *item) {
    const DipCostReport *report = report_of(at);
    const Visit *visit = item;
    (void)index;
    for (int i = 0; i < visit->count; i++) {
        DipTimed *timed = &visit->frames[i];
        timed->subject = visit->row;
        timed->start = visit->start;
        timed->round = visit->round;
        timed->block = visit->block;
        timed->begin_ns = llround(1e6 * visit->begin_ms);
        if (timed->frame >= dip_cost_frame_count(report)) {
            return false;
        }
    }
    return is_row(report, visit->row) && visit->start < report->starts &&
           visit->round < report->rounds / report->starts;
}

// Makes room for the frames of a visit at the end of the log.
static DipErrorCode open_frames(const DipFieldAt *at, int count) {
    DipCostReport *report = report_of(at);
    Visit *visit = (Visit *)at->item;
    const int64_t needed = (int64_t)report->log_count + count;
    if (count < 1 ||
        needed > (int64_t)MOST_TIMES * report->row_count * dip_cost_frame_count(report)) {
        return DIP_ERROR_FORMAT;
    }
    DipTimed *log = realloc(report->log, (size_t)needed * sizeof *log);
    if (!log) {
        return DIP_ERROR_MEMORY;
    }
    visit->frames = log + report->log_count;
    visit->count = count;
    memset(visit->frames, 0, (size_t)count * sizeof *log);
    report->log = log;
    report->log_count = (int)needed;
    return DIP_ERROR_NONE;
}

static DipErrorCode open_times(const DipFieldAt *at, int count) {
    return count == ((const Visit *)at->item)->count ? DIP_ERROR_NONE : DIP_ERROR_FORMAT;
}

DIP_OF_ITEM(bool, is_wait_known, isfinite(((const DipTimed *)at->item)[at->index].wait))

#define OF_FRAME(KIND, member) DIP_FACT(KIND, DipTimed, member), .stride = sizeof(DipTimed)
static const DipField frame_element = {OF_FRAME(WHOLE, frame), .most = INT_MAX};
static const DipField ms_element = {OF_FRAME(NUMBER, ms), .least = DIP_COST_LEAST_MS,
                                    .most = DIP_COST_MOST_MS};
static const DipField wait_element = {OF_FRAME(NUMBER, wait), .most = DIP_COST_MOST_MEAN,
                                      .known = is_wait_known};

#define OF_FRAMES(ELEMENT, OPEN)                                                                   \
    DIP_LIST(.element = &(ELEMENT), DIP_ARRAY(Visit, frames, count), .points = true, .open = OPEN)
static const DipField visit_fields[] = {
    {"row", NULL, NULL, "Index of the row whose frames were timed.", DIP_FACT(WHOLE, Visit, row),
     .most = DIP_COST_MAX_ROWS - 1},
    {"start", NULL, NULL,
     "Index of the start of the program in which the frames were timed, from 0 on.",
     DIP_FACT(WHOLE, Visit, start), .most = DIP_TIMED_MOST_STARTS - 1},
    {"round", NULL, NULL, "Index of the round within this start, from 0 on.",
     DIP_FACT(WHOLE, Visit, round), .most = INT_MAX},
    {"block", NULL, NULL,
     "Visits of one block are compared with each other; the blocks of a round have different "
     "numbers.",
     DIP_FACT(WHOLE, Visit, block), .most = INT_MAX - 1},
    {"begin_ms", NULL, "ms", "Time from the beginning of the measurement to that of the visit.",
     DIP_FACT(NUMBER, Visit, begin_ms), .most = DIP_COST_MOST_MS},
    {"frames", NULL, NULL, "Indices of the visit's frames along the path.",
     OF_FRAMES(frame_element, open_frames)},
    {"ms", NULL, NULL, "Time of each of the visit's frames, in milliseconds.",
     OF_FRAMES(ms_element, open_times)},
    {"wait", NULL, NULL,
     "Time that the frame's threads waited for a processor, as a share of its time; null if the "
     "machine does not tell.",
     OF_FRAMES(wait_element, open_times)},
};
static const DipRecord visit_record = DIP_RECORD(
    "visit", "A few frames of one row, timed one after another.", visit_fields, Visit, NULL);

// --- paths and their truths ----------------------------------------------------------------------

// Checks that the name of a path has only letters, digits, '_' and '-'.
static bool check_path(const DipFieldAt *at) {
    const char *name = report_of(at)->paths[at->index];
    return *name && strspn(name, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                                 "0123456789_-") == strlen(name);
}

#define OF_PATH(KIND, MEMBER)                                                                      \
    DIP_FACT(KIND, DipCostReport, MEMBER[0]), .stride = sizeof *((DipCostReport *)0)->MEMBER
DIP_DERIVE(derive_floor, DIP_MADE(DipMetrics, (dip_cost_floor_metrics(report_of(at), at->index))))
static const DipField path_fields[] = {
    {"name", "path", NULL, "\"DEFAULT\", \"AA\" and so on: the key of the path in the ini.",
     OF_PATH(TEXT, paths)},
    {"poses", NULL, NULL, "Hash of the poses that are drawn.", OF_PATH(TEXT, path_hashes)},
    {"base_row", NULL, NULL, "The row with which the others of the path are timed.",
     OF_PATH(WHOLE, base_rows), .most = DIP_COST_MAX_ROWS - 1},
    {"same_row", NULL, NULL, "The baseline once more, timed as if it were another setting (A/A).",
     OF_PATH(WHOLE, same_rows), .most = DIP_COST_MAX_ROWS - 1},
    {"floor", NULL, NULL,
     "Estimates of the metrics that a perfect picture has, because of the noise in the path's "
     "truths.",
     DIP_DERIVED(RECORD, derive_floor), .record = &dip_cost_metrics_record},
};
static const DipRecord path_record = DIP_RECORD_OF_ARRAYS(
    "path", "A camera path on which rows were measured.", path_fields, check_path);

typedef struct Floor {
    int path;
    int place;
    DipMetricSums halves;
} Floor;

static const DipField floor_fields[] = {
    {"path", NULL, NULL, "Index of the camera path.", DIP_FACT(WHOLE, Floor, path),
     .most = DIP_COST_MAX_PATHS - 1},
    {"place", NULL, NULL, "Index of the viewpoint on its path.", DIP_FACT(WHOLE, Floor, place),
     .most = DIP_COST_MAX_PLACES - 1},
    SUMS_FIELD("half_against_half", "Sums of one half of the truth against the other.", Floor,
               halves),
};
static const DipRecord floor_record =
    DIP_RECORD("noise floor", "The two halves of a viewpoint's truth (converged picture).",
               floor_fields, Floor, NULL);

static int all_floors(const DipCostReport *report) {
    return report->path_count * report->options.places;
}

DIP_OF_ITEM(int, count_floors, count_set(report_of(at)->has_floor, all_floors(report_of(at))))

static const void *get_floor(const DipFieldAt *at, int index, DipFieldScratch *scratch) {
    const DipCostReport *report = report_of(at);
    const int i = find_set(report->has_floor, index), places = report->options.places;
    return DIP_MADE(Floor, ((Floor){i / places, i % places, report->floors[i]}));
}

static DipErrorCode open_floors(const DipFieldAt *at, int count) {
    return count <= all_floors(report_of(at)) ? DIP_ERROR_NONE : DIP_ERROR_FORMAT;
}

static bool put_floor(const DipFieldAt *at, int index, const void *item) {
    DipCostReport *report = report_of(at);
    const Floor *from = item;
    (void)index;
    if (from->path >= report->path_count || from->place >= report->options.places ||
        !are_sums(&from->halves)) {
        return false;
    }
    report->floors[from->path * report->options.places + from->place] = from->halves;
    report->has_floor[from->path * report->options.places + from->place] = true;
    return true;
}

// --- sweeps --------------------------------------------------------------------------------------

DIP_OF_ITEM(bool, is_step_timed, dip_cost_is_timed(report_of(at), sweep_of(at)->rows[at->index]))

DIP_DERIVE(derive_row, &report_of(at)->rows[sweep_of(at)->rows[at->index]])
DIP_DERIVE(derive_step,
           DIP_WRITTEN(dip_cost_step_text(report_of(at), sweep_of(at),
                                          sweep_of(at)->rows[at->index], scratch->text)))

#define CHANGE_FIELD(METRIC, NAME, title, unit, DIGITS)                                            \
    {NAME "_change",                                                                               \
     title,                                                                                        \
     unit,                                                                                         \
     title " minus that of the sweep's base, over the viewpoints that both have.",                 \
     DIP_DERIVED(ESTIMATE, derive_change_##METRIC),                                                \
     .digits = DIGITS},
static const DipField step_fields[] = {
    {"row", NULL, NULL, "Index of the step's row.", DIP_FACT(WHOLE, DipCostSweep, rows[0]),
     .stride = sizeof(int), .most = DIP_COST_MAX_ROWS - 1},
    {"step", "step", NULL, "Name of the step.", DIP_DERIVED(TEXT, derive_step)},
    {"ratio", "ratio", NULL, "The step's time divided by that of the sweep's base.",
     DIP_COMPUTED(ESTIMATE, DipCostSweep, ratios[0]), .stride = sizeof(DipEstimate),
     .known = is_step_timed, .digits = 3},
    METRIC_LIST(CHANGE_FIELD){"measured", NULL, NULL, "The fields of the step's row.",
                              DIP_SHOWN(RECORD, derive_row), .record = &dip_cost_row_record},
};

DIP_OF_ITEM(bool, check_step, is_row(report_of(at), sweep_of(at)->rows[at->index]))

static const DipRecord step_record =
    DIP_RECORD_OF_ARRAYS("step", "A step of a sweep.", step_fields, check_step);

DIP_DERIVE(derive_title, DIP_WRITTEN(dip_cost_sweep_title(report_of(at), at->item, scratch->text)))
static const DipField sweep_fields[] = {
    {"title", NULL, NULL, "The setting, and the others that are off their defaults.",
     DIP_DERIVED(TEXT, derive_title)},
    {"setting", NULL, NULL, "Key of the setting.", DIP_FACT(NAMED, DipCostSweep, setting),
     .names = setting_keys, .name_count = DIP_SETTING_COUNT},
    {"path", NULL, NULL, "Index of the camera path.", DIP_FACT(WHOLE, DipCostSweep, path),
     .most = DIP_COST_MAX_PATHS - 1},
    {"base", NULL, NULL, "Index of the row with which the steps are compared.",
     DIP_FACT(WHOLE, DipCostSweep, base), .most = DIP_COST_MAX_ROWS - 1},
    {"steps", NULL, NULL, "The steps, in the order of the setting.",
     DIP_LIST(.record = &step_record, .counted = offsetof(DipCostSweep, row_count),
              .most = DIP_COST_MAX_SWEEP_ROWS)},
};

static bool check_sweep(const DipFieldAt *at) {
    const DipCostSweep *sweep = at->item;
    return sweep->path < report_of(at)->path_count && is_row(report_of(at), sweep->base);
}

static const DipRecord sweep_record =
    DIP_RECORD("sweep", "All steps of one setting on one path, all others held constant.",
               sweep_fields, DipCostSweep, check_sweep);

// --- same pictures, predictions, smaller pictures ------------------------------------------------

DIP_DERIVE(derive_same_as, &report_of(at)->rows[((const DipCostSame *)at->item)->row].quality)
static const DipField same_fields[] = {
    {"settings", NULL, NULL, "All quality settings of the combination.",
     DIP_FACT(SETTINGS, DipCostSame, quality)},
    {"row", NULL, NULL, "Index of the row that stands for the combination.",
     DIP_FACT(WHOLE, DipCostSame, row), .most = DIP_COST_MAX_ROWS - 1},
    {"same_as", "draws the same as", NULL,
     "Settings of the row that stands for the combination, as far as they are off their defaults.",
     DIP_SHOWN(SETTINGS, derive_same_as)},
};

DIP_OF_ITEM(bool, check_same, is_row(report_of(at), ((const DipCostSame *)at->item)->row))

const DipRecord dip_cost_same_record =
    DIP_RECORD("same pictures",
               "A combination that draws the same pictures as a row with fewer settings off their "
               "defaults.",
               same_fields, DipCostSame, check_same);

static const DipField misses_fields[] = {
    {"rows", NULL, NULL, "Number of combinations that were compared.",
     DIP_FACT(WHOLE, DipCostMisses, rows), .most = DIP_COST_MAX_ROWS},
    {"median", NULL, NULL, "Median of |predicted / measured - 1| over the compared combinations.",
     DIP_FACT(NUMBER, DipCostMisses, median), .most = DBL_MAX},
    {"p90", NULL, NULL, "90th percentile of |predicted / measured - 1|.",
     DIP_FACT(NUMBER, DipCostMisses, p90), .most = DBL_MAX},
    {"within_5_percent", NULL, NULL, "Share of the combinations that are missed by at most 5 %.",
     DIP_FACT(NUMBER, DipCostMisses, within_5), .most = 1.0},
    {"within_10_percent", NULL, NULL, "Share of the combinations that are missed by at most 10 %.",
     DIP_FACT(NUMBER, DipCostMisses, within_10), .most = 1.0},
};
const DipRecord dip_cost_misses_record = DIP_RECORD(
    "misses", "How far predictions lie from measurements.", misses_fields, DipCostMisses, NULL);

#define MISSES_FIELD(name, MEMBER, means)                                                          \
    {                                                                                              \
        name, NULL, NULL, means, DIP_FACT(RECORD, DipCostPredictions, MEMBER),                     \
            .record = &dip_cost_misses_record                                                      \
    }
static const DipField all_misses_fields[] = {
    MISSES_FIELD("times", times,
                 "Misses of the mean times of rows that were measured after the prediction."),
    MISSES_FIELD("flip", errors,
                 "Misses of the FLIP of rows that were measured after the prediction."),
    MISSES_FIELD("times_left_out", times_left_out,
                 "Misses of the mean times of the first rows, each predicted from the others."),
    MISSES_FIELD("flip_left_out", errors_left_out,
                 "Misses of the FLIP of the first rows, each predicted from the others."),
};
static const DipRecord all_misses_record =
    DIP_RECORD("misses of --predict", "How far the predictions of --predict lie from measurements.",
               all_misses_fields, DipCostPredictions, NULL);

static const DipField prediction_fields[] = {
    {"settings", NULL, NULL, "All quality settings of the combination.",
     DIP_FACT(SETTINGS, DipCostPrediction, quality)},
    {"ms", "predicted mean", "ms", "Predicted mean time of a frame.",
     DIP_FACT(NUMBER, DipCostPrediction, ms), .most = DIP_COST_MOST_MS, .digits = 2},
    {"p95_ms", "predicted p95", "ms", "Predicted 95th percentile of the frames along the path.",
     DIP_FACT(NUMBER, DipCostPrediction, p95_ms), .most = DIP_COST_MOST_MS, .digits = 2},
    {"flip", "predicted FLIP", NULL, "Predicted mean FLIP of a frame.",
     DIP_FACT(NUMBER, DipCostPrediction, flip), .most = DIP_COST_MOST_MEAN, .digits = 4},
    {"row", NULL, NULL, "Index of the row that measured the combination later, or -1.",
     DIP_FACT(WHOLE, DipCostPrediction, row), .least = -1, .most = DIP_COST_MAX_ROWS - 1},
};

DIP_OF_ITEM(bool, check_prediction,
            ((const DipCostPrediction *)at->item)->row < report_of(at)->row_count)

const DipRecord dip_cost_prediction_of_report_record = DIP_RECORD(
    "prediction", "A combination whose time and error were predicted from measured rows.",
    prediction_fields, DipCostPrediction, check_prediction);

static const DipField predictions_fields[] = {
    {"searched", NULL, NULL,
     "Number of all combinations that were predicted; 0 if it is not known. If there are more than "
     "`combinations` has, only those that were measured or looked best were kept.",
     DIP_FACT(WHOLE, DipCostPredictions, searched), .most = INT_MAX},
    {"trained", NULL, NULL, "Number of rows that were measured to predict all others.",
     DIP_FACT(WHOLE, DipCostPredictions, trained), .most = DIP_COST_MAX_ROWS},
    {"misses", NULL, NULL, "How far the predictions lie from measurements.", PART,
     .record = &all_misses_record},
    {"combinations", NULL, NULL, "The combinations whose time and error were predicted.",
     DIP_LIST(.record = &dip_cost_prediction_of_report_record,
              DIP_ARRAY(DipCostPredictions, list, count), .points = true,
              .most = DIP_COST_MAX_ROWS)},
};
static const DipRecord predictions_record =
    DIP_RECORD("predictions", "The combinations that --predict ranked.", predictions_fields,
               DipCostPredictions, NULL);

static const DipField elsewhere_fields[] = {
    {"settings", NULL, NULL, "All quality settings of the combination.",
     DIP_FACT(SETTINGS, DipCostElsewhere, quality)},
    {"ms", "mean", "ms", "Mean time of a frame with these settings at the smaller size.",
     DIP_FACT(ESTIMATE, DipCostElsewhere, ms), .least = DIP_COST_LEAST_MS, .most = DIP_COST_MOST_MS,
     .digits = 2},
    STAGE_NAMES_FIELD(DipCostElsewhere, NULL),
    COUNTERS_FIELD(DipCostElsewhere, NULL),
};

DIP_OF_ITEM(bool, check_elsewhere, isfinite(((const DipCostElsewhere *)at->item)->ms.value))

const DipRecord dip_cost_elsewhere_record =
    DIP_RECORD("combination elsewhere",
               "A combination that was timed at another size, on another path or with another "
               "number of threads.",
               elsewhere_fields, DipCostElsewhere, check_elsewhere);

enum { MOST_SIDE = 16384 }; // Greatest width and height of a picture, in pixels.

static const DipField smaller_fields[] = {
    {"width", NULL, "px", "Width of the smaller pictures.",
     DIP_FACT(WHOLE, DipCostReport, smaller_width), .least = 1, .most = MOST_SIDE},
    {"height", NULL, "px", "Height of the smaller pictures.",
     DIP_FACT(WHOLE, DipCostReport, smaller_height), .least = 1, .most = MOST_SIDE},
    {"combinations", NULL, NULL, "The combinations that were timed at the smaller size.",
     DIP_LIST(.record = &dip_cost_elsewhere_record,
              DIP_ARRAY(DipCostReport, smaller, smaller_count), .most = DIP_COST_MAX_SMALLER)},
};

DIP_OF_ITEM(bool, has_smaller, report_of(at)->smaller_count > 0)

static const DipRecord smaller_record =
    DIP_RECORD("smaller pictures",
               "A few combinations at about half the width and height, which tell work that grows "
               "with the picture from work that does not.",
               smaller_fields, DipCostReport, has_smaller);

// --- what is computed ----------------------------------------------------------------------------

static const DipField interaction_fields[] = {
    {"a", NULL, NULL, "Key of one setting.", DIP_FACT(NAMED, DipCostInteraction, a),
     .names = setting_keys},
    {"b", NULL, NULL, "Key of the other setting.", DIP_FACT(NAMED, DipCostInteraction, b),
     .names = setting_keys},
    {"combinations", "combinations", "of the others",
     "Number of combinations of the other settings over which the means are taken.",
     DIP_FACT(WHOLE, DipCostInteraction, contexts)},
    {"flip", "FLIP", "difference",
     "FLIP of both settings together, less that of each alone, plus that of neither. Above 0, both "
     "together lower FLIP by less than the sum of what each lowers it.",
     DIP_FACT(NUMBER, DipCostInteraction, flip), .digits = 5, .show = DIP_SHOW_SIGN},
    {"time", "time", "factor",
     "Time of both together times that of neither, divided by the times of each alone. Above 1, "
     "both together cost more than the product of their ratios; 0 without times.",
     DIP_FACT(NUMBER, DipCostInteraction, time), .digits = 3},
};
const DipRecord dip_cost_interaction_record =
    DIP_RECORD("interaction", "Two settings at their last steps together, against each alone.",
               interaction_fields, DipCostInteraction, NULL);

DIP_OF_ITEM(int, count_interactions,
            report_of(at)->analysis ? report_of(at)->analysis->interaction_count : 0)

DIP_GET_ITEM(get_interaction, &report_of(at)->analysis->interactions[index])

// Each price belongs to a term of the fit, which is a kind of work in a stage.
DIP_DERIVE(derive_stage, ((const DipCostFit *)at->item)->stages[at->index])
DIP_DERIVE(derive_work, ((const DipCostFit *)at->item)->names[at->index])
static const DipField price_fields[] = {
    {"stage", "stage", NULL, "Name of the stage of the pipeline that does the work.",
     DIP_DERIVED(TEXT, derive_stage)},
    {"work", "unit of work", NULL, "The kind of work; \"frame\" is what every frame takes.",
     DIP_DERIVED(TEXT, derive_work)},
    {"ns", "time", "ns", "Time that one unit of this work takes in its stage.",
     DIP_FACT(NUMBER, DipCostFit, ns[0]), .stride = sizeof(double), .digits = 3,
     .show = DIP_SHOW_FIGURES},
};
const DipRecord dip_cost_price_record = DIP_RECORD_OF_ARRAYS(
    "price of work", "The time that one unit of a kind of work takes.", price_fields, NULL);

static const DipField fit_fields[] = {
    {"prices", NULL, NULL, "The price of each kind of work.",
     DIP_LIST(.record = &dip_cost_price_record, .counted = offsetof(DipCostFit, count))},
    {"r2", NULL, NULL, "Share of the relative variance of the times that the fit explains.",
     DIP_FACT(NUMBER, DipCostFit, r2), .digits = 3},
    {"median_miss", NULL, NULL, "Median of |fitted / measured - 1| over the rows.",
     DIP_FACT(NUMBER, DipCostFit, median_miss), .digits = 3},
    {"median_miss_of_others", NULL, NULL,
     "Median of |predicted / measured - 1| if each row is predicted from all others.",
     DIP_FACT(NUMBER, DipCostFit, others.median), .digits = 3},
    {"within_10_percent_of_others", NULL, NULL,
     "Share of the rows that are predicted from all others within 10 %.",
     DIP_FACT(NUMBER, DipCostFit, others.within_10), .digits = 3},
};
static const DipRecord fit_record = DIP_RECORD(
    "fit", "A linear fit of the times of the stages to their work.", fit_fields, DipCostFit, NULL);

static const void *derive_fit(const DipFieldAt *at, DipFieldScratch *scratch) {
    const DipCostAnalysis *analysis = report_of(at)->analysis;
    (void)scratch;
    return analysis && analysis->fit.rows > 0 ? &analysis->fit : NULL;
}

// --- advice --------------------------------------------------------------------------------------

// Only the budgets are facts: advice is computed again from times and errors.
static const DipAdvice *advice_of(const DipFieldAt *at) {
    return &report_of(at)->choice.advice[at->index];
}

static const DipCandidate *candidate_of(const DipFieldAt *at, int index) {
    return &report_of(at)->choice.candidates.list[index];
}

DIP_OF_ITEM(bool, has_next, advice_of(at)->next >= 0)

DIP_DERIVE(derive_chosen,
           DIP_MADE(int,
                    advice_of(at)->chosen >= 0 ? candidate_of(at, advice_of(at)->chosen)->row : -1))
DIP_DERIVE(derive_next,
           DIP_MADE(int, has_next(at) ? candidate_of(at, advice_of(at)->next)->row : -1))

// Derives the time of the chosen candidate. Its interval includes the error that all candidates
// share.
static const void *derive_chosen_ms(const DipFieldAt *at, DipFieldScratch *scratch) {
    const DipCandidate *chosen = dip_cost_chosen(report_of(at), at->index);
    return chosen ? DIP_MADE(DipEstimate, dip_estimate_widen(&chosen->time, chosen->common_error))
                  : NULL;
}

static int count_ties(const DipFieldAt *at) {
    const int count = advice_of(at)->tie_count;
    return count < DIP_ADVICE_TIES ? count : DIP_ADVICE_TIES;
}

DIP_GET_ITEM(get_tie, &candidate_of(at, advice_of(at)->ties[index])->row)
static const DipField tie_element = {.kind = DIP_FIELD_WHOLE};

#define OF_ADVICE(KIND, member)                                                                    \
    DIP_COMPUTED(KIND, DipCostReport, choice.advice[0].member), .stride = sizeof(DipAdvice)
static const DipField advice_fields[] = {
    {"budget_ms", "budget", "ms", "The time that a frame may take.",
     DIP_FACT(NUMBER, DipCostReport, options.budgets_ms[0]), .stride = sizeof(double),
     .least = DIP_COST_LEAST_MS, .most = DIP_COST_MOST_MS},
    {"row", NULL, NULL, "Index of the chosen row, or -1 if none is surely within the budget.",
     DIP_DERIVED(WHOLE, derive_chosen)},
    {"ms", NULL, "ms", "The row's time, of the kind that the budget is meant for (`budget_of`).",
     DIP_DERIVED(ESTIMATE, derive_chosen_ms), .digits = 2},
    {"fits", "fits", NULL, "Probability that the time of the chosen row is within the budget.",
     OF_ADVICE(NUMBER, fits)},
    {"ties", NULL, NULL,
     "Up to eight other rows that are as good: they surely fit, too, and their FLIP is within 1 % "
     "of the least. The fastest comes first.",
     DIP_DERIVED_LIST(.element = &tie_element, .count = count_ties, .item = get_tie)},
    {"tie_count", NULL, NULL, "Number of all rows that are as good as the chosen one.",
     OF_ADVICE(WHOLE, tie_count)},
    {"next", NULL, NULL,
     "Index of the next better row, or of the fastest row if none is chosen; -1 if there is none.",
     DIP_DERIVED(WHOLE, derive_next)},
    {"next_ms", NULL, "ms",
     "How much longer the row `next` takes than the chosen one, or than the budget if none is "
     "chosen.",
     OF_ADVICE(NUMBER, next_ms), .known = has_next, .digits = 2},
    {"next_fits", NULL, NULL, "Probability that the time of the row `next` is within the budget.",
     OF_ADVICE(NUMBER, next_fits), .known = has_next},
};
static const DipRecord advice_record =
    DIP_RECORD_OF_ARRAYS("advice", "The row to choose for one time budget.", advice_fields, NULL);

DIP_OF_ITEM(int, count_advice, report_of(at)->choice.advice_count)

// --- the machine ---------------------------------------------------------------------------------

DIP_DERIVE(derive_reason, report_of(at)->verdict_reason)
static const DipField machine_fields[] = {
    {"verdict", "machine", NULL, "How quiet the machine was: green, amber or red.",
     DIP_COMPUTED(NAMED, DipCostReport, verdict), .names = dip_cost_verdict_names},
    {"reason", NULL, NULL, "The measured figures from which the verdict comes.",
     DIP_DERIVED(TEXT, derive_reason)},
    {"wait", NULL, NULL, "Waiting time of all timed frames divided by (their time x threads).",
     DIP_FACT(NUMBER, DipCostReport, machine.wait), .most = DIP_COST_MOST_MEAN},
    {"repeated", NULL, NULL, "Number of frames that were timed again.",
     DIP_FACT(WHOLE, DipCostReport, machine.repeated), .most = INT_MAX},
    {"has_wait", NULL, NULL, "Whether the machine tells how long threads wait.",
     DIP_FACT(FLAG, DipCostReport, machine.has_wait)},
    {"settled", NULL, NULL, "Whether the times of frames were steady before the first round began.",
     DIP_FACT(FLAG, DipCostReport, machine.settled)},
    {"doubt", NULL, NULL,
     "Standard error of the logarithm of a time by which an amber verdict widens the intervals "
     "of all times.",
     DIP_COMPUTED(NUMBER, DipCostReport, doubt), .digits = 3},
    {"starts", NULL, NULL,
     "Number of starts of the program, each with rounds / starts rounds; 0 without times.",
     DIP_FACT(WHOLE, DipCostReport, starts), .most = DIP_TIMED_MOST_STARTS},
};
static const DipRecord machine_record = DIP_RECORD(
    "machine", "What the timing tells about the machine.", machine_fields, DipCostReport, NULL);

// --- the report ----------------------------------------------------------------------------------

static const DipField left_out_element = {
    .kind = DIP_FIELD_TEXT, .size = DIP_COST_REASON, .stride = DIP_COST_REASON};

DIP_OF_ITEM(bool, has_times, report_of(at)->rounds > 0)
DIP_OF_ITEM(bool, has_predictions, report_of(at)->predicted.count > 0)

const void *dip_cost_derive_format(const DipFieldAt *at, DipFieldScratch *scratch) {
    (void)at;
    return DIP_MADE(int, DIP_COST_JSON_FORMAT);
}

#define HEADER_TEXT(member, means)                                                                 \
    { #member, NULL, NULL, means, DIP_FACT(TEXT, DipCostReport, member) }
#define HEADER_NUMBER(name, member, LEAST, MOST, means)                                            \
    {                                                                                              \
        name, NULL, NULL, means, DIP_FACT(WHOLE, DipCostReport, member), .least = LEAST,           \
                                                                         .most = MOST              \
    }
static const DipField report_fields[] = {
    {"format", NULL, NULL, "Number of the file's format.",
     DIP_DERIVED(WHOLE, dip_cost_derive_format)},
    HEADER_TEXT(version, "Version of the Diptych that measured the report."),
    HEADER_TEXT(build, "Hash of the file of the program that measured the report."),
    HEADER_TEXT(scene, "Name of the scene that was measured."),
    HEADER_TEXT(scene_hash, "Hash of the scene that was measured."),
    HEADER_TEXT(processor, "Name of the processor on which the report was measured."),
    HEADER_TEXT(isa, "Instruction set with which the frames were drawn."),
    HEADER_TEXT(date, "When the measurement ended, ISO 8601 in UTC; \"\" if it is not known."),
    HEADER_NUMBER("threads", threads, 1, 256, "Number of threads that drew the frames."),
    HEADER_NUMBER("width", width, 1, 8192, "Width of the pictures, in pixels."),
    HEADER_NUMBER("height", height, 1, 8192, "Height of the pictures, in pixels."),
    HEADER_NUMBER("rounds", rounds, 0, 10000,
                  "Number of rounds timed; 0 if the report has no times."),
    HEADER_NUMBER("combined_first", combined_first, 0, DIP_COST_MAX_ROWS,
                  "Rows from this index on are the combinations, on path 0."),
    HEADER_NUMBER("places", options.places, 1, DIP_COST_MAX_PLACES,
                  "Number of viewpoints on each path."),
    HEADER_NUMBER("burst", options.burst, 1, DIP_COST_MAX_BURST,
                  "Number of successive frames at each viewpoint."),
    HEADER_NUMBER("samples", options.samples, 0, 4096,
                  "Samples per pixel in each half of the truth."),
    HEADER_NUMBER("timed_frames", options.timed_frames, 1, 100,
                  "Number of frames per path in each round."),
    HEADER_NUMBER("budget_of", options.budget_of, 0, 2,
                  "The time that budgets are meant for: 0 p95, 1 mean, 2 worst."),
    HEADER_NUMBER("seed", options.seed, 0, INT_MAX, "Seed of the random order of the timing."),
    {"pixels_per_degree", NULL, NULL, "Pixels per degree of the field of view, for FLIP.",
     DIP_FACT(NUMBER, DipCostReport, options.pixels_per_degree), .most = DIP_COST_MOST_COUNT},
    {"baseline", NULL, NULL, "All settings of the baseline.",
     DIP_FACT(SETTINGS, DipCostReport, options.baseline)},
    {"paths", NULL, NULL, "The camera paths on which rows were measured.",
     DIP_LIST(.record = &path_record, .counted = offsetof(DipCostReport, path_count), .least = 1,
              .most = DIP_COST_MAX_PATHS)},
    {"machine", NULL, NULL, "What the timing tells about the machine; null without times.", PART,
     .record = &machine_record, .known = has_times},
    {"left_out", NULL, NULL, "Steps of settings that were left out, each with the reason.",
     DIP_LIST(.element = &left_out_element, DIP_ARRAY(DipCostReport, refused, refused_count),
              .most = DIP_COST_MAX_REFUSED)},
    {"rows", NULL, NULL, "The measured combinations, each on one camera path.",
     DIP_LIST(.record = &dip_cost_row_record, DIP_ARRAY(DipCostReport, rows, row_count),
              .points = true, .open = open_rows)},
    {"visits", NULL, NULL, "Every timed frame, from which all times are computed.",
     DIP_LIST(.record = &visit_record, .count = count_visits, .item = get_visit,
              .open = open_visits, .put = put_visit)},
    {"floors", NULL, NULL, "The noise of the truths themselves, for each path and viewpoint.",
     DIP_LIST(.record = &floor_record, .count = count_floors, .item = get_floor,
              .open = open_floors, .put = put_floor)},
    {"same_pictures", NULL, NULL,
     "Combinations that were not measured because they draw the same pictures as a row.",
     DIP_LIST(.record = &dip_cost_same_record, DIP_ARRAY(DipCostReport, same, same_count),
              .points = true, .most = DIP_COST_MAX_ROWS)},
    {"sweeps", NULL, NULL,
     "The sweeps: all steps of one setting on one path, with all other settings held constant.",
     DIP_LIST(.record = &sweep_record, DIP_ARRAY(DipCostReport, sweeps, sweep_count),
              .most = DIP_COST_MAX_SWEEPS)},
    {"interactions", NULL, NULL, "Pairs of settings, and how their effects add up.",
     DIP_DERIVED_LIST(.record = &dip_cost_interaction_record, .count = count_interactions,
                      .item = get_interaction)},
    {"fit", NULL, NULL, "How times follow from work; null with too few rows.",
     DIP_DERIVED(RECORD, derive_fit), .record = &fit_record},
    {"predicted", NULL, NULL, "The combinations that --predict ranked; null without --predict.",
     DIP_FACT(RECORD, DipCostReport, predicted), .record = &predictions_record,
     .known = has_predictions},
    {"smaller", NULL, NULL, "Combinations at a smaller size; null if there are none.", PART,
     .record = &smaller_record, .known = has_smaller},
    {"advice", NULL, NULL, "The row to choose for each time budget.",
     DIP_LIST(.record = &advice_record, .count = count_advice,
              .counted = offsetof(DipCostReport, options.budget_count),
              .most = DIP_COST_MAX_BUDGETS)},
};

static bool check_report(const DipFieldAt *at) {
    const DipCostReport *report = report_of(at);
    bool ok = report->combined_first <= report->row_count &&
              report->rounds != 1; // One round has no interval.
    for (int p = 0; p < report->path_count; p++) {
        ok = ok && is_row(report, report->base_rows[p]) && is_row(report, report->same_rows[p]) &&
             report->rows[report->base_rows[p]].path == p &&
             report->rows[report->same_rows[p]].path == p;
    }
    return ok;
}

const DipRecord dip_cost_report_record =
    DIP_RECORD("report", "What `diptych cost` writes to cost.json.", report_fields, DipCostReport,
               check_report);
