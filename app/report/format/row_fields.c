// Lists the fields of rows: their settings, metrics of pictures, viewpoints and times.
#include "app/report/format/cost_fields_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Returns the index of the row that at->item points to.
static int row_of(const DipFieldAt *at) {
    return (int)((const DipCostRow *)at->item - dip_cost_report_of(at)->rows);
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
    *sums = dip_cost_row_sums(dip_cost_report_of(at), row_of(at), &viewpoints);
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
    return dip_cost_has_flicker(dip_cost_report_of(at)) && sums_of(at, &sums)
               ? DIP_MADE(DipFlickerMetrics, dip_flicker_metrics_of(&sums))
               : NULL;
}

// Defines for each metric a function that derives a row's metric, with its interval over the
// viewpoints.
#define METRIC_FUNCTION(METRIC, ...)                                                               \
    DIP_DERIVE(derive_##METRIC,                                                                    \
               is_judged(at)                                                                       \
                   ? DIP_MADE(DipEstimate, dip_cost_metric(dip_cost_report_of(at), row_of(at),     \
                                                           DIP_COST_##METRIC))                     \
                   : NULL)
METRIC_LIST(METRIC_FUNCTION)

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
    *tail = dip_cost_row_tail(dip_cost_report_of(at), row_of(at));
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

static const DipRecord viewpoint_record =
    DIP_RECORD("viewpoint of a row", "What was judged at one viewpoint of a row.", viewpoint_fields,
               Viewpoint, NULL);

DIP_OF_ITEM(int, count_viewpoints,
            dip_cost_count_set(((const DipCostRow *)at->item)->judged,
                               dip_cost_report_of(at)->options.places))

static const void *get_viewpoint(const DipFieldAt *at, int index, DipFieldScratch *scratch) {
    const DipCostRow *row = at->item;
    const int place = dip_cost_find_set(row->judged, index);
    Viewpoint *to = (Viewpoint *)scratch;
    *to = (Viewpoint){.tail = row->tails[place], .place = place, .sums = row->viewpoints[place]};
    memcpy(to->pictures, row->pictures[place], sizeof to->pictures);
    return to;
}

static DipErrorCode open_places(const DipFieldAt *at, int count) {
    return count <= dip_cost_report_of(at)->options.places ? DIP_ERROR_NONE : DIP_ERROR_FORMAT;
}

static bool put_viewpoint(const DipFieldAt *at, int index, const void *item) {
    const Viewpoint *from = item;
    DipCostRow *row = (DipCostRow *)at->item;
    (void)index;
    if (from->place >= dip_cost_report_of(at)->options.places || !dip_cost_are_sums(&from->sums)) {
        return false;
    }
    row->judged[from->place] = true;
    row->viewpoints[from->place] = from->sums;
    row->tails[from->place] = from->tail;
    memcpy(row->pictures[from->place], from->pictures, sizeof from->pictures);
    return true;
}

// --- rows ----------------------------------------------------------------------------------------

DIP_OF_ITEM(bool, is_timed, dip_cost_is_timed(dip_cost_report_of(at), row_of(at)))

DIP_DERIVE(derive_text, DIP_WRITTEN(dip_cost_settings_text(&((const DipCostRow *)at->item)->quality,
                                                           scratch->text)))
DIP_DERIVE(derive_at_floor,
           is_judged(at) ? DIP_MADE(bool, dip_cost_at_floor(dip_cost_report_of(at), row_of(at)))
                         : NULL)

#define TIME_FIELD(NAME, title, unit, means, MEMBER, DIGITS, SHOW)                                 \
    {                                                                                              \
        NAME, title, unit, means, DIP_COMPUTED(ESTIMATE, DipCostRow, time.MEMBER),                 \
            .known = is_timed, .digits = DIGITS, .show = SHOW                                      \
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
    {"over_time", NULL, NULL,
     "How the error changes from frame to frame in the bursts; null for bursts of one frame.",
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
               ratio, 3, DIP_SHOW_OF_TIMES),
    TIME_FIELD("ms", "mean", "ms", "Mean time of the frames along the path, in this run.", mean_ms,
               2, 0),
    TIME_FIELD("p95_ms", "p95", "ms",
               "95th percentile of the times of the frames along the path, in this run.", p95_ms, 2,
               0),
    TIME_FIELD("worst_ms", "worst", "ms", "Time of the slowest frame along the path, in this run.",
               worst_ms, 2, 0),
    STAGE_NAMES_FIELD(DipCostRow, is_timed),
    COUNTERS_FIELD(DipCostRow, is_timed),
};

DIP_OF_ITEM(bool, check_row,
            ((const DipCostRow *)at->item)->path < dip_cost_report_of(at)->path_count)

const DipRecord dip_cost_row_record =
    DIP_RECORD("row", "One measured combination: quality settings on a camera path.", row_fields,
               DipCostRow, check_row);

static DipErrorCode open_rows(const DipFieldAt *at, int count) {
    DipCostReport *report = dip_cost_report_of(at);
    if (count < 1 || count > DIP_COST_MAX_ROWS) {
        return DIP_ERROR_FORMAT;
    }
    report->options.rounds = report->rounds;
    report->options.end_place = report->options.places;
    report->rows = calloc((size_t)count, sizeof *report->rows);
    report->row_count = report->rows ? count : 0;
    return report->rows && dip_cost_report_alloc(report, NULL) ? DIP_ERROR_NONE : DIP_ERROR_MEMORY;
}

const DipFieldList dip_cost_row_list = {.record = &dip_cost_row_record,
                                        DIP_ARRAY(DipCostReport, rows, row_count),
                                        .points = true,
                                        .open = open_rows};
