// Judging render scales: the errors of the enlarged pictures against the truth (converged picture),
// as a report judges its rows (errors.c).
#include "app/cost/axes/axes_drawing.h"
#include "app/cost/context.h"
#include "app/cli/interrupt.h"
#include "app/measure/metrics/meter.h"
#include "app/cli/progress.h"

enum { STEPS_PER_TRUTH = 1000 };

typedef struct Judge {
    DipCostAxesDrawing *drawing;
    DipCostContext truths; // Draws the truths.
    DipMeter meter;
    DipProgress progress;
    int64_t before; // Steps of the truths that are complete.
} Judge;

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost axes", "out of memory");
}

static bool is_judged(const DipCostAxes *axes, int row) {
    return row == 0 || axes->rows[row].axis == DIP_COST_AXIS_SCALE;
}

static bool show_truth(void *context, double done) {
    Judge *j = context;
    dip_progress_show(&j->progress, j->before + (int64_t)(done * STEPS_PER_TRUTH));
    return !dip_interrupted();
}

static bool judge_row(Judge *j, int row, int viewpoint, const DipTruth *truth, DipError *err) {
    DipCostReport *report = &j->drawing->axes->report;
    const int64_t time_ns =
        dip_cost_viewpoint_time_ns(report, j->drawing->session, 0, viewpoint, 0);
    const DipMeterStandard standard = dip_truth_standard(truth);
    DipMetricSums *sums = &report->rows[row].viewpoints[viewpoint];
    DipFrame frame;
    if (dip_cost_axes_interrupted(err) ||
        !dip_cost_axes_draw(j->drawing, row, time_ns, 0, &frame, err)) {
        return false;
    }
    const DipSrgbPicture picture = {frame.rgba8, frame.stride_bytes, frame.width, frame.height};
    dip_meter_begin_burst(&j->meter);
    if (!dip_meter_add(&j->meter, &picture, NULL, &standard, sums)) {
        return out_of_memory(err);
    }
    dip_meter_end_burst(&j->meter, sums);
    report->rows[row].tails[viewpoint] = dip_flip_tail_result(&j->meter.tail);
    report->rows[row].judged[viewpoint] = true;
    return true;
}

static bool judge_viewpoint(Judge *j, int viewpoint, DipError *err) {
    DipCostReport *report = &j->drawing->axes->report;
    DipTruth truth;
    if (!dip_cost_context_truth(&j->truths, 0, viewpoint, 0, show_truth, j, &truth, err)) {
        dip_cost_axes_interrupted(err);
        return false;
    }
    report->floors[viewpoint] = truth.floor;
    report->has_floor[viewpoint] = true;
    bool judged = true;
    for (int row = 0; judged && row < report->row_count; row++) {
        judged = !is_judged(j->drawing->axes, row) || judge_row(j, row, viewpoint, &truth, err);
    }
    dip_truth_free(&truth);
    j->before += STEPS_PER_TRUTH;
    return judged;
}

static void close_judge(Judge *j) {
    dip_meter_free(&j->meter);
    dip_cost_context_close(&j->truths);
}

static bool open_judge(Judge *j, DipCostAxesDrawing *drawing, const char *cache, DipError *err) {
    DipCostReport *report = &drawing->axes->report;
    *j = (Judge){.drawing = drawing};
    if (!dip_cost_context_open(&j->truths, drawing->session, report, NULL, cache, true, err)) {
        return false;
    }
    return dip_meter_init(&j->meter, DIP_METER_PICTURES, report->width, report->height,
                          report->options.pixels_per_degree) ||
           out_of_memory(err);
}

bool dip_cost_axes_judge(DipCostAxesDrawing *drawing, const char *cache, DipError *err) {
    const int viewpoints = drawing->axes->report.options.end_place;
    bool has_scales = false;
    for (int row = 0; row < drawing->axes->report.row_count; row++) {
        has_scales |= drawing->axes->rows[row].axis == DIP_COST_AXIS_SCALE;
    }
    if (!has_scales || viewpoints == 0) {
        return true;
    }
    Judge j;
    bool judged = open_judge(&j, drawing, cache, err);
    j.progress = dip_progress_begin("steps (1000 per converged picture)",
                                    (int64_t)viewpoints * STEPS_PER_TRUTH);
    for (int v = 0; judged && v < viewpoints; v++) {
        judged = judge_viewpoint(&j, v, err);
    }
    dip_progress_end(&j.progress, j.before);
    close_judge(&j);
    return judged;
}
