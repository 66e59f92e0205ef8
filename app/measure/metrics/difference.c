// Computes differences of pictures, sums of their squares, and the metrics that follow from sums.
#include "app/measure/metrics/difference.h"

#include "app/measure/metrics/metrics.h"
#include "renderer/base/fp_mode.h"
#include "renderer/base/srgb.h"

#include <math.h>
#include <stdbool.h>

void dip_difference_lin(const DipSrgbPicture *test, const float *truth_lin, float *error_lin) {
    DIP_FP_MODE_SCOPE();
    DipSrgbDecodeTable srgb;
    dip_srgb_decode_table(&srgb);
    for (int y = 0; y < test->height; y++) {
        const uint8_t *row = test->rgba8 + (size_t)y * test->stride_bytes;
        for (int x = 0; x < test->width; x++) {
            for (int c = 0; c < 3; c++) {
                *error_lin++ = (float)(srgb.linear[row[4 * x + c]] - (double)*truth_lin++);
            }
        }
    }
}

void dip_difference_squared_map(const float *error_lin, size_t pixel_count, float *map) {
    DIP_FP_MODE_SCOPE();
    for (size_t i = 0; i < pixel_count; i++, error_lin += 3) {
        map[i] = (error_lin[0] * error_lin[0] + error_lin[1] * error_lin[1] +
                  error_lin[2] * error_lin[2]) /
                 3.0f;
    }
}

void dip_difference_codes_map(const DipSrgbPicture *test, const DipSrgbPicture *truth, float *map) {
    DIP_FP_MODE_SCOPE();
    for (int y = 0; y < test->height; y++) {
        const uint8_t *a = test->rgba8 + (size_t)y * test->stride_bytes;
        const uint8_t *b = truth->rgba8 + (size_t)y * truth->stride_bytes;
        for (int x = 0; x < test->width; x++, a += 4, b += 4) {
            int sum = 0;
            for (int c = 0; c < 3; c++) {
                sum += (a[c] - b[c]) * (a[c] - b[c]);
            }
            *map++ = (float)sum / 3.0f;
        }
    }
}

void dip_map_sum_add(DipMapSum *sum, const float *map, size_t pixel_count, DipPixelMask mask) {
    DIP_FP_MODE_SCOPE();
    for (size_t i = 0; i < pixel_count; i++) {
        const bool counts = !mask.classes || mask.classes[i] == mask.wanted;
        if (counts && !isnan(map[i])) {
            sum->sum += (double)map[i];
            sum->pixel_count += 1.0;
        }
    }
}

double dip_psnr_db(double mean_squared_codes) {
    DIP_FP_MODE_SCOPE();
    DIP_FP_PIN(mean_squared_codes);
    double db =
        mean_squared_codes != 0.0 ? 10.0 * log10(255.0 * 255.0 / mean_squared_codes) : INFINITY;
    DIP_FP_PIN(db);
    return db;
}

// --- metrics from sums ---------------------------------------------------------------------------

const char *const dip_metric_region_names[DIP_METRIC_REGION_COUNT] = {"all",
#define REGION_NAME(NAME, name, text) name,
                                                                      DIP_SEEN_LIST(REGION_NAME)
#undef REGION_NAME
};

void dip_metric_sums_add(DipMetricSums *to, const DipMetricSums *sums) {
    DIP_FP_MODE_SCOPE();
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
    DIP_FP_MODE_SCOPE();
    const DipMetricRegionSums *r = &sums->regions[region];
    DipMetrics metrics = {
        .rmse_lin = sqrt(mean(r->squared_lin, r->pixels)),
        .psnr_db = dip_psnr_db(mean(r->squared_codes, r->pixels)),
        .ssim = r->ssim_pixels > 0.0 ? r->ssim / r->ssim_pixels : 1.0,
        .flip = mean(r->flip, r->pixels),
    };
    DIP_FP_PIN_STRUCT(metrics);
    return metrics;
}

DipFlickerMetrics dip_flicker_metrics_of(const DipMetricSums *sums) {
    DIP_FP_MODE_SCOPE();
    DipFlickerMetrics metrics = {
        .steady = sqrt(mean(sums->squared_static, sums->bursts)),
        .flicker = sqrt(mean(sums->squared_flicker, sums->bursts)),
        .step = sqrt(mean(sums->squared_step, sums->bursts)),
        .two_mean = sqrt(mean(sums->squared_two_mean, sums->bursts)),
    };
    DIP_FP_PIN_STRUCT(metrics);
    return metrics;
}
