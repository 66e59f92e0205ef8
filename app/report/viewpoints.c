// Computes metrics over the viewpoints of a path, with intervals.
#include "app/report/report.h"

#include "app/measure/metrics/difference.h"
#include "app/measure/metrics/truth.h"

#include <math.h>

// Returns whether the metric is computed from a mean of squares.
static bool is_of_squares(DipCostMetric metric) {
    return metric == DIP_COST_RMSE || metric == DIP_COST_PSNR || metric == DIP_COST_FLICKER;
}

// Returns the mean that a metric is computed from: a mean of squares, or the metric itself. Returns
// NAN for flicker that was not measured.
static double mean_of(const DipCostReport *report, const DipMetricSums *sums,
                      DipCostMetric metric) {
    const DipMetricRegionSums *all = &sums->regions[0];
    switch (metric) {
    case DIP_COST_RMSE:
        return all->pixels > 0.0 ? all->squared_lin / all->pixels : 0.0;
    case DIP_COST_PSNR:
        return all->pixels > 0.0 ? all->squared_codes / all->pixels : 0.0;
    case DIP_COST_FLICKER:
        return !dip_cost_has_flicker(report) ? NAN
               : sums->bursts > 0.0          ? sums->squared_flicker / sums->bursts
                                             : 0.0;
    case DIP_COST_SSIM:
        return dip_metrics_of(sums, 0).ssim;
    default:
        return dip_metrics_of(sums, 0).flip;
    }
}

// Computes a metric from its mean (mean_of).
static double metric_of(double mean, DipCostMetric metric) {
    if (metric == DIP_COST_PSNR) {
        return dip_psnr_db(mean);
    }
    return is_of_squares(metric) ? sqrt(mean) : mean;
}

// --- spread --------------------------------------------------------------------------------------

// The mean of the viewpoints' values, and half of the width of its 95 % interval.
typedef struct Spread {
    double mean; // NAN without values.
    double half; // NAN for fewer than two values.
} Spread;

static Spread spread_of(const double *values, int count) {
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < count; i++) {
        sum += values[i];
    }
    const double mean = count > 0 ? sum / count : NAN;
    if (count < 2) {
        return (Spread){mean, NAN};
    }
    for (int i = 0; i < count; i++) {
        squares += (values[i] - mean) * (values[i] - mean);
    }
    const double variance = squares / (count - 1);
    return (Spread){mean, dip_student_quantile(0.975, count - 1) * sqrt(variance / count)};
}

// --- estimates -----------------------------------------------------------------------------------

// Makes an estimate with this interval, unless its ends are NAN. An interval without width is left
// out, too: it only means that the viewpoints agree to the last bit.
static DipEstimate between(double value, double low, double high) {
    DipEstimate estimate = dip_estimate_unknown(value);
    if (low < high) {
        estimate.low = low;
        estimate.high = high;
    }
    return estimate;
}

DipEstimate dip_cost_metric(const DipCostReport *report, int row, DipCostMetric metric) {
    const DipCostRow *r = &report->rows[row];
    double means[DIP_COST_MAX_PLACES] = {0};
    int count = 0;
    for (int p = 0; p < report->options.places; p++) {
        if (r->judged[p]) {
            means[count++] = mean_of(report, &r->viewpoints[p], metric);
        }
    }
    const Spread s = spread_of(means, count);
    const double value = metric_of(s.mean, metric);
    if (isnan(s.half)) {
        return dip_estimate_unknown(value);
    }
    if (is_of_squares(metric)) {
        const double factor = s.mean > 0.0 ? exp(s.half / s.mean) : 1.0;
        const double less = metric_of(s.mean / factor, metric);
        const double more = metric_of(s.mean * factor, metric);
        return between(value, fmin(less, more), fmax(less, more));
    }
    const double most = metric == DIP_COST_SSIM ? 1.0 : INFINITY;
    return between(value, s.mean - s.half, fmin(s.mean + s.half, most));
}

DipEstimate dip_cost_metric_change(const DipCostReport *report, int row, int base,
                                   DipCostMetric metric) {
    const DipCostRow *r = &report->rows[row], *b = &report->rows[base];
    double changes[DIP_COST_MAX_PLACES];
    int count = 0;
    for (int p = 0; p < report->options.places; p++) {
        if (r->judged[p] && b->judged[p]) {
            changes[count++] = metric_of(mean_of(report, &r->viewpoints[p], metric), metric) -
                               metric_of(mean_of(report, &b->viewpoints[p], metric), metric);
        }
    }
    const Spread s = spread_of(changes, count);
    return between(s.mean, s.mean - s.half, s.mean + s.half);
}

DipMetrics dip_cost_floor_metrics(const DipCostReport *report, int path) {
    const DipMetricSums sums = dip_cost_floor(report, path);
    const DipMetrics halves = dip_metrics_of(&sums, 0);
    return (DipMetrics){
        .rmse_lin = dip_truth_floor_rmse(&sums, 0),
        .psnr_db = halves.psnr_db + 20.0 * log10(2.0),
        .ssim = 1.0 - (1.0 - halves.ssim) / 4.0,
        .flip = dip_cost_floor_flip(report, path),
    };
}
