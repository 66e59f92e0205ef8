// Writing a report as comma-separated values: a line per step of each sweep, and one per
// combination.
#include "app/files/whole_file.h"
#include "app/report/format/formats.h"
#include "app/report/format/lines.h"

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

static void print_lines(const DipCostReport *report, const DipCostLine *lines, int count,
                        FILE *out) {
    for (int i = 0; i < count; i++) {
        const DipFieldAt at = {(void *)report, lines ? &lines[i] : NULL, i, NULL};
        dip_fields_print_csv(&dip_cost_line_record, &at, columns, DIP_FIELD_COUNT_OF(columns), out);
    }
}

static bool print_all(const void *context, FILE *out) {
    const DipCostReport *report = context;
    DipCostLine lines[DIP_COST_MAX_ROWS];
    print_lines(report, NULL, 1, out);
    print_lines(report, lines, dip_cost_same_lines(report, lines), out);
    print_lines(report, lines, dip_cost_all_step_lines(report, lines), out);
    print_lines(report, lines, dip_cost_combination_lines(report, lines), out);
    for (int i = 0; i < report->predicted.count; i++) {
        const DipCostLine line = dip_cost_prediction_line(report, i);
        print_lines(report, &line, line.row < 0, out);
    }
    return true;
}

bool dip_cost_write_csv(const DipCostReport *report, const char *file, DipError *err) {
    return dip_whole_file_print(file, print_all, report, err);
}
