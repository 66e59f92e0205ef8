// Computes metrics from sums.
#include "app/measure/metrics/metrics.h"

#include "app/measure/metrics/difference.h"

#include <math.h>

const char *const dip_metric_region_names[DIP_METRIC_REGION_COUNT] = {"all",
#define REGION_NAME(NAME, name, text) name,
                                                                      DIP_SEEN_LIST(REGION_NAME)
#undef REGION_NAME
};

void dip_metric_sums_add(DipMetricSums *to, const DipMetricSums *sums) {
    double *values = (double *)to;
    const double *added = (const double *)sums;
    for (int i = 0; i < DIP_METRIC_SUM_COUNT; i++) {
        values[i] += added[i];
    }
}

static double mean(double sum, double count) {
    return count > 0.0 ? sum / count : 0.0;
}

DipMetrics dip_metrics_of(const DipMetricSums *sums, int region) {
    const DipMetricRegionSums *r = &sums->regions[region];
    return (DipMetrics){
        .rmse_lin = sqrt(mean(r->squared_lin, r->pixels)),
        .psnr_db = dip_psnr_db(mean(r->squared_codes, r->pixels)),
        .ssim = r->ssim_pixels > 0.0 ? r->ssim / r->ssim_pixels : 1.0,
        .flip = mean(r->flip, r->pixels),
    };
}

DipFlickerMetrics dip_flicker_metrics_of(const DipMetricSums *sums) {
    return (DipFlickerMetrics){
        .steady = sqrt(mean(sums->squared_static, sums->bursts)),
        .flicker = sqrt(mean(sums->squared_flicker, sums->bursts)),
        .step = sqrt(mean(sums->squared_step, sums->bursts)),
        .two_mean = sqrt(mean(sums->squared_two_mean, sums->bursts)),
    };
}
