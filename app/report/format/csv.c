// Writing a report as comma-separated values: a line per step of each sweep, and one per
// combination.
#include "app/files/whole_file.h"
#include "app/report/format/cost_fields.h"
#include "app/report/format/formats.h"
#include "app/report/viewpoints.h"

typedef struct Line {
    const char *kind;
    char title[DIP_COST_TEXT];
    int path;
    const DipQuality *quality;
    int row;                  // -1: the combination was only predicted.
    const DipEstimate *ratio; // To the base of the sweep; NULL: to that of the path.
    const DipCostPrediction *prediction;
} Line;

static const DipCostReport *report_of(const DipFieldAt *at) {
    return at->context;
}

#define DERIVE(name, value)                                                                        \
    static const void *name(const DipFieldAt *at, DipFieldScratch *scratch) {                      \
        const Line *line = at->item;                                                               \
        (void)scratch;                                                                             \
        return value;                                                                              \
    }
DERIVE(derive_kind, line->kind)
DERIVE(derive_path, report_of(at)->paths[line->path])
DERIVE(derive_settings, line->quality)
DERIVE(derive_row, line->row >= 0 ? &report_of(at)->rows[line->row] : NULL)
DERIVE(derive_predicted, line->prediction)
DERIVE(derive_ratio, line->row < 0 || !dip_cost_is_timed(report_of(at), line->row) ? NULL
                     : line->ratio ? (const void *)line->ratio
                                   : &report_of(at)->rows[line->row].time.ratio)
DERIVE(derive_report, line ? report_of(at) : NULL)

static const void *derive_floor(const DipFieldAt *at, DipFieldScratch *scratch) {
    const Line *line = at->item;
    *(DipMetrics *)scratch = dip_cost_floor_metrics(report_of(at), line->path);
    return line->row >= 0 ? scratch : NULL;
}

#define RECORD(function, record_of)                                                                \
    .kind = DIP_FIELD_RECORD, .derive = function, .record = record_of
static const DipField line_fields[] = {
    {"kind", NULL, NULL, "\"a/a\", \"step\", \"combination\" or \"predicted\".",
     DIP_DERIVED(TEXT, derive_kind)},
    {"title", NULL, NULL, "The sweep of a step.", DIP_FACT(TEXT, Line, title)},
    {"path", NULL, NULL, "The camera path.", DIP_DERIVED(TEXT, derive_path)},
    {"settings", NULL, NULL, "All quality settings.", DIP_DERIVED(SETTINGS, derive_settings)},
    {"ratio", NULL, NULL, "The time divided by that of the sweep's base, or of the baseline.",
     DIP_DERIVED(ESTIMATE, derive_ratio)},
    {"row", NULL, NULL, "The row.", RECORD(derive_row, &dip_cost_row_record)},
    {"predicted", NULL, NULL, "The prediction.",
     RECORD(derive_predicted, &dip_cost_prediction_of_report_record)},
    {"floor", NULL, NULL, "The noise of the path's truths.",
     RECORD(derive_floor, &dip_cost_metrics_record)},
    {"report", NULL, NULL, "The report.", RECORD(derive_report, &dip_cost_report_record)},
};
static const DipRecord line_record =
    DIP_RECORD("line", "A line of cost.csv.", line_fields, Line, NULL);

#define REGION(name)                                                                               \
    {"row.figures." name ".pixels", name "_pixels"},                                               \
        {"row.figures." name ".rmse_lin", name "_rmse_lin"},                                       \
        {"row.figures." name ".psnr_db", name "_psnr_db"},                                         \
        {"row.figures." name ".ssim", name "_ssim"}, {"row.figures." name ".flip", name "_flip"},
#define SEEN(NAME, name, text) REGION(name)
#define FROM_ROW(name)                                                                             \
    { "row." name, name }
#define FROM_REPORT(name)                                                                          \
    { "report." name, name }
#define OVER_TIME(name)                                                                            \
    { "row.over_time." name, name }
#define TAIL(name)                                                                                 \
    { "row.flip_tail." name, "flip_tail_" name }
static const DipColumn columns[] = {
    {"kind", NULL},
    {"title", NULL},
    {"path", NULL},
    {"settings", NULL},
    {"ratio", NULL},
    FROM_ROW("ms"),
    FROM_ROW("p95_ms"),
    FROM_ROW("worst_ms"),
    FROM_REPORT("scene"),
    FROM_REPORT("width"),
    FROM_REPORT("height"),
    FROM_REPORT("processor"),
    FROM_REPORT("threads"),
    FROM_REPORT("isa"),
    FROM_REPORT("version"),
    FROM_REPORT("date"),
    {"report.machine.verdict", "verdict"},
    REGION("all") DIP_SEEN_LIST(SEEN) OVER_TIME("static_rms_lin"),
    OVER_TIME("flicker_rms_lin"),
    OVER_TIME("step_rms_lin"),
    OVER_TIME("two_frame_mean_rms_lin"),
    {"floor.rmse_lin", NULL},
    {"floor.psnr_db", NULL},
    {"floor.ssim", NULL},
    {"floor.flip", NULL},
    FROM_ROW("at_floor"),
    FROM_ROW("rmse_lin_of_viewpoints"),
    FROM_ROW("psnr_db_of_viewpoints"),
    FROM_ROW("ssim_of_viewpoints"),
    FROM_ROW("flip_of_viewpoints"),
    FROM_ROW("flicker_rms_lin_of_viewpoints"),
    TAIL("p50"),
    TAIL("p95"),
    TAIL("p99"),
    TAIL("worst"),
    TAIL("worst_viewpoint"),
    TAIL("worst_frame"),
    TAIL("worst_x"),
    TAIL("worst_y"),
    TAIL("worst_width"),
    TAIL("worst_height"),
    {"predicted.ms", NULL},
    {"predicted.p95_ms", NULL},
    {"predicted.flip", NULL},
    {"row.counters", ""},
};

static void print_line(const DipCostReport *report, const Line *line, FILE *out) {
    const DipFieldAt at = {(void *)report, line, 0, NULL};
    dip_fields_print_csv(&line_record, &at, columns, DIP_FIELD_COUNT_OF(columns), out);
}

static Line line_of(const DipCostReport *report, const char *kind, int row) {
    return (Line){.kind = kind,
                  .path = report->rows[row].path,
                  .quality = &report->rows[row].quality,
                  .row = row};
}

static bool print_lines(const void *context, FILE *out) {
    const DipCostReport *report = context;
    print_line(report, NULL, out);
    for (int p = 0; p < report->path_count; p++) {
        Line line = line_of(report, "a/a", report->same_rows[p]);
        snprintf(line.title, sizeof line.title, "the baseline twice");
        print_line(report, &line, out);
    }
    for (int s = 0; s < report->sweep_count; s++) {
        const DipCostSweep *sweep = &report->sweeps[s];
        for (int i = 0; i < sweep->row_count; i++) {
            Line line = line_of(report, "step", sweep->rows[i]);
            dip_cost_sweep_title(report, sweep, line.title);
            line.ratio = &sweep->ratios[i];
            print_line(report, &line, out);
        }
    }
    for (int r = report->combined_first; r < report->row_count; r++) {
        const Line line = line_of(report, "combination", r);
        print_line(report, &line, out);
    }
    for (int i = 0; i < report->predicted.count; i++) {
        const DipCostPrediction *prediction = &report->predicted.list[i];
        if (prediction->row < 0) {
            print_line(report,
                       &(Line){.kind = "predicted",
                               .quality = &prediction->quality,
                               .row = -1,
                               .prediction = prediction},
                       out);
        }
    }
    return true;
}

bool dip_cost_write_csv(const DipCostReport *report, const char *file, DipError *err) {
    return dip_whole_file_print(file, print_lines, report, err);
}
