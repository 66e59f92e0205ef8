// Writing a report as comma-separated values.
#include "app/report/format/formats.h"

#include "app/report/viewpoints.h"
#include "app/files/whole_file.h"
#include "app/files/put.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Numbers of columns: those from the flicker to the mark of the floor, the intervals over the
// viewpoints, and the distribution of FLIP.
enum { FLICKER_FIELDS = 9, INTERVAL_FIELDS = 2 * DIP_COST_METRIC_COUNT, TAIL_FIELDS = 10 };

static void write_head(FILE *out) {
    fprintf(out,
            "kind,title,path,settings,ratio,ratio_low,ratio_high,ms,ms_low,ms_high,"
            "p95_ms,p95_ms_high,worst_ms,worst_ms_high,scene,width,height,processor,threads,isa,"
            "version,date,verdict");
    for (int r = 0; r < DIP_METRIC_REGION_COUNT; r++) {
        const char *name = dip_metric_region_names[r];
        fprintf(out, ",%s_pixels,%s_rmse_lin,%s_psnr_db,%s_ssim,%s_flip", name, name, name, name,
                name);
    }
    fprintf(out, ",static_rms_lin,flicker_rms_lin,step_rms_lin,two_frame_mean_rms_lin,"
                 "floor_rmse_lin,floor_psnr_db,floor_ssim,floor_flip,at_floor");
    for (int m = 0; m < DIP_COST_METRIC_COUNT; m++) {
        fprintf(out, ",%s_low,%s_high", dip_cost_metric_names[m], dip_cost_metric_names[m]);
    }
    fprintf(out, ",flip_p50,flip_p95,flip_p99,worst_flip,worst_viewpoint,"
                 "worst_frame,worst_x,worst_y,worst_width,worst_height");
    for (int c = 0; c < DIP_COST_COUNTER_COUNT; c++) {
        fprintf(out, ",%s", dip_cost_counter_names[c]);
    }
    fputc('\n', out);
}

static void write_empty(int fields, FILE *out) {
    for (int i = 0; i < fields; i++) {
        fputc(',', out);
    }
}

// Writes the intervals over the viewpoints, which a single viewpoint does not have.
static void write_intervals(const DipCostReport *report, int row, FILE *out) {
    for (int m = 0; m < DIP_COST_METRIC_COUNT; m++) {
        const DipStatsEstimate estimate = dip_cost_metric(report, row, (DipCostMetric)m);
        if (isfinite(estimate.low) && isfinite(estimate.high)) {
            fprintf(out, ",%.8g,%.8g", estimate.low, estimate.high);
        } else {
            write_empty(2, out);
        }
    }
}

// Viewpoints and frames count from 0.
static void write_tail(const DipCostReport *report, int row, FILE *out) {
    const DipCostTail tail = dip_cost_row_tail(report, row);
    const DipFlipTail *flip = &tail.flip;
    if (tail.viewpoints == 0) {
        write_empty(TAIL_FIELDS, out);
        return;
    }
    fprintf(out, ",%.6g,%.6g,%.6g,%.6g,%d", flip->p50, flip->p95, flip->p99, flip->worst,
            tail.worst_viewpoint);
    fprintf(out, ",%.0f,%.0f,%.0f,%.0f,%.0f", flip->worst_frame, flip->worst_x, flip->worst_y,
            flip->worst_width, flip->worst_height);
}

static void write_errors(const DipCostReport *report, int row, FILE *out) {
    int viewpoints;
    const DipMetricSums sums = dip_cost_row_sums(report, row, &viewpoints);
    const DipFlickerMetrics flicker = dip_flicker_metrics_of(&sums);
    for (int r = 0; r < DIP_METRIC_REGION_COUNT; r++) {
        const DipMetrics f = dip_metrics_of(&sums, r);
        if (sums.regions[r].pixels > 0.0) {
            fprintf(out, ",%.0f,%.8g,%.6g,%.8g,%.8g", sums.regions[r].pixels, f.rmse_lin, f.psnr_db,
                    f.ssim, f.flip);
        } else {
            fprintf(out, ",0,,,,");
        }
    }
    const DipMetrics noise = dip_cost_floor_metrics(report, report->rows[row].path);
    fprintf(out, ",%.8g,%.8g,%.8g,%.8g", flicker.steady, flicker.flicker, flicker.step,
            flicker.two_mean);
    fprintf(out, ",%.8g,%.6g,%.8g,%.8g,%s", noise.rmse_lin, noise.psnr_db, noise.ssim, noise.flip,
            dip_cost_floor_mark(report, row));
    write_intervals(report, row, out);
    write_tail(report, row, out);
}

static void write_text(const char *text, FILE *out) {
    fputc(',', out);
    dip_put_csv_text(out, text);
}

// What all lines of a report have in common.
static void write_report(const DipCostReport *report, FILE *out) {
    write_text(report->scene, out);
    fprintf(out, ",%d,%d", report->width, report->height);
    write_text(report->processor, out);
    fprintf(out, ",%d", report->threads);
    write_text(report->isa, out);
    write_text(report->version, out);
    write_text(report->date, out);
    write_text(report->rounds > 0 ? dip_cost_verdict_names[report->verdict] : "", out);
}

// Writes one line.
static void write_row(const DipCostReport *report, const char *kind, const char *title, int row,
                      const DipStatsEstimate *ratio, FILE *out) {
    char settings[256];
    dip_quality_format(&report->rows[row].quality, settings, sizeof settings);
    fputs(kind, out);
    write_text(title, out);
    write_text(report->paths[report->rows[row].path], out);
    write_text(settings, out);
    if (dip_cost_is_timed(report, row)) {
        const DipPathEstimate *time = &report->rows[row].time;
        fprintf(out, ",%.6g,%.6g,%.6g,%.6g,%.6g,%.6g", ratio->value, ratio->low, ratio->high,
                time->mean_ms.value, time->mean_ms.low, time->mean_ms.high);
        fprintf(out, ",%.6g,%.6g,%.6g,%.6g", time->p95_ms.value, time->p95_ms.high,
                time->worst_ms.value, time->worst_ms.high);
    } else {
        fprintf(out, ",,,,,,,,,,");
    }
    write_report(report, out);
    write_errors(report, row, out);
    for (int c = 0; c < DIP_COST_COUNTER_COUNT; c++) {
        fprintf(out, ",%.10g", report->rows[row].counters[c]);
    }
    fputc('\n', out);
}

// Writes the line of a combination that was only predicted: its mean time, its 95th percentile and
// its FLIP.
static void write_prediction(const DipCostReport *report, const DipCostPrediction *prediction,
                             FILE *out) {
    char settings[256];
    dip_quality_format(&prediction->quality, settings, sizeof settings);
    fputs("predicted,\"\"", out);
    write_text(report->paths[0], out);
    write_text(settings, out);
    fprintf(out, ",,,,%.6g,,,%.6g,,,", prediction->ms, prediction->p95_ms);
    write_report(report, out);
    fprintf(out, ",,,,,%.8g", prediction->flip);
    write_empty(5 * (DIP_METRIC_REGION_COUNT - 1) + FLICKER_FIELDS + INTERVAL_FIELDS + TAIL_FIELDS +
                    DIP_COST_COUNTER_COUNT,
                out);
    fputc('\n', out);
}

bool dip_cost_write_csv(const DipCostReport *report, const char *file, DipError *err) {
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out) {
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    }
    write_head(out);
    for (int p = 0; p < report->path_count; p++) {
        const int row = report->same_rows[p];
        write_row(report, "a/a", "the baseline twice", row, &report->rows[row].time.ratio, out);
    }
    for (int s = 0; s < report->sweep_count; s++) {
        const DipCostSweep *sweep = &report->sweeps[s];
        char title[DIP_COST_TEXT];
        dip_cost_sweep_title(report, sweep, title);
        for (int i = 0; i < sweep->row_count; i++) {
            write_row(report, "step", title, sweep->rows[i], &sweep->ratios[i], out);
        }
    }
    for (int r = report->combined_first; r < report->row_count; r++) {
        write_row(report, "combination", "", r, &report->rows[r].time.ratio, out);
    }
    for (int i = 0; i < report->predicted.count; i++) {
        if (report->predicted.list[i].row < 0) {
            write_prediction(report, &report->predicted.list[i], out);
        }
    }
    bool made = !ferror(out);
    made = fclose(out) == 0 && made && text; // glibc sets it to NULL if memory runs out here.
    const bool written = made
                             ? dip_whole_file_write(file, text, size, err)
                             : dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    free(text);
    return written;
}
