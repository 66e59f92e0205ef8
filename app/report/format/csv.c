// Writes a report as comma-separated values. There is a line for each A/A row, for each step of
// each sweep (all steps of one setting), and for each combination, measured or only predicted.
#include "app/files/whole_file.h"
#include "app/report/format/formats.h"
#include "app/report/format/lines.h"

#define REGION(name)                                                                               \
    "row.figures." name ".pixels=" name "_pixels; row.figures." name ".rmse_lin=" name             \
    "_rmse_lin; row.figures." name ".psnr_db=" name "_psnr_db; row.figures." name ".ssim=" name    \
    "_ssim; row.figures." name ".flip=" name "_flip; "
#define SEEN(NAME, name, text) REGION(name)
#define REGIONS                REGION("all") DIP_SEEN_LIST(SEEN)
static const char columns[] =
    "kind; title; path; settings; ratio; row.ms=ms; row.p95_ms=p95_ms; row.worst_ms=worst_ms; "
    "report.scene=scene; report.width=width; report.height=height; report.processor=processor; "
    "report.threads=threads; report.isa=isa; report.version=version; report.date=date; "
    "report.machine.verdict=verdict; report.warning_count=warnings; " REGIONS
    "row.over_time.static_rms_lin=static_rms_lin; row.over_time.flicker_rms_lin=flicker_rms_lin; "
    "row.over_time.step_rms_lin=step_rms_lin; "
    "row.over_time.two_frame_mean_rms_lin=two_frame_mean_rms_lin; "
    "floor.rmse_lin; floor.psnr_db; floor.ssim; floor.flip; row.at_floor=at_floor; "
    "row.rmse_lin_of_viewpoints=rmse_lin_of_viewpoints; "
    "row.psnr_db_of_viewpoints=psnr_db_of_viewpoints; "
    "row.ssim_of_viewpoints=ssim_of_viewpoints; row.flip_of_viewpoints=flip_of_viewpoints; "
    "row.flicker_rms_lin_of_viewpoints=flicker_rms_lin_of_viewpoints; "
    "row.flip_tail.p50=flip_tail_p50; row.flip_tail.p95=flip_tail_p95; "
    "row.flip_tail.p99=flip_tail_p99; row.flip_tail.worst=flip_tail_worst; "
    "row.flip_tail.worst_viewpoint=flip_tail_worst_viewpoint; "
    "row.flip_tail.worst_frame=flip_tail_worst_frame; row.flip_tail.worst_x=flip_tail_worst_x; "
    "row.flip_tail.worst_y=flip_tail_worst_y; row.flip_tail.worst_width=flip_tail_worst_width; "
    "row.flip_tail.worst_height=flip_tail_worst_height; "
    "predicted.ms; predicted.p95_ms; predicted.flip; row.counters=";

static void print_lines(const DipCostReport *report, const DipCostLine *lines, int count,
                        FILE *out) {
    for (int i = 0; i < count; i++) {
        const DipFieldAt at = {(void *)report, lines ? &lines[i] : NULL, i, NULL};
        dip_fields_print_csv(&dip_cost_line_record, &at, columns, out);
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
