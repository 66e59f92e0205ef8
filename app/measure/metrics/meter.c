// Computes the metrics of each region of a picture: first the maps of FLIP and SSIM block by block,
// then all sums band by band (a band is a few rows). Sums are added up in pixel order, so their
// bits do not depend on blocks and bands.
#include "app/measure/metrics/meter.h"

#include "app/measure/metrics/ssim.h"
#include "renderer/base/fp_mode.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum { BAND_PIXELS = 1 << 15 };

static int band_rows(const DipMeter *meter) {
    const int rows = BAND_PIXELS / meter->width;
    return rows < 1 ? 1 : rows < meter->height ? rows : meter->height;
}

bool dip_meter_init(DipMeter *meter, DipMeterKind kind, int width, int height,
                    double pixels_per_degree) {
    const size_t count = (size_t)width * (size_t)height;
    *meter = (DipMeter){.kind = kind, .width = width, .height = height};
    meter->band = malloc(3 * (size_t)band_rows(meter) * (size_t)width * sizeof *meter->band);
    bool made = meter->band;
    if (made && kind >= DIP_METER_FLIP) {
        meter->flip_map = malloc(count * sizeof *meter->flip_map);
        made = meter->flip_map && dip_flip_init(&meter->flip, width, height, pixels_per_degree);
    }
    if (made && kind >= DIP_METER_PICTURES) {
        meter->ssim_map = malloc(count * sizeof *meter->ssim_map);
        made = meter->ssim_map && dip_flip_tail_init(&meter->tail) &&
               (kind == DIP_METER_PICTURES || dip_flicker_init(&meter->flicker, 3 * count));
    }
    if (!made) {
        dip_meter_free(meter);
    }
    return made;
}

void dip_meter_free(DipMeter *meter) {
    free(meter->band);
    free(meter->flip_map);
    free(meter->ssim_map);
    dip_flip_analysis_free(&meter->analysis);
    dip_flip_free(&meter->flip);
    dip_flicker_free(&meter->flicker);
    dip_flip_tail_free(&meter->tail);
    *meter = (DipMeter){0};
}

void dip_meter_begin_burst(DipMeter *meter) {
    if (meter->kind == DIP_METER_BURSTS) {
        dip_flicker_restart(&meter->flicker);
    }
    dip_flip_tail_restart(&meter->tail);
}

void dip_meter_set_standard(DipMeter *meter, const DipMeterStandard *standard) {
    meter->standard = *standard;
    meter->analysed = 0;
}

void dip_meter_begin(DipMeter *meter, const DipSrgbPicture *test, const float *test_lin) {
    meter->test = *test;
    meter->test_lin = test_lin;
    meter->steps = 0;
    meter->squared_static = 0.0;
    meter->sums = (DipMetricSums){.bursts = 0.0};
}

// --- blocks --------------------------------------------------------------------------------------

static bool measure_flip(DipMeter *meter, int block) {
    const DipFlipAnalysis *standard = meter->standard.analysis;
    if (!standard) {
        standard = &meter->analysis;
        if (!standard->memory && !dip_flip_analysis_init(&meter->flip, &meter->analysis)) {
            return false;
        }
        if (block == meter->analysed) {
            dip_flip_analyse_block(&meter->flip, &meter->standard.picture, block, &meter->analysis);
            meter->analysed++;
        }
    }
    dip_flip_compare_block(&meter->flip, &meter->test, block, standard, meter->flip_map);
    return true;
}

// Computes SSIM for a block. A margin of DIP_SSIM_RADIUS makes room for the windows around the
// block's outermost pixels.
static bool measure_ssim(DipMeter *meter, int block) {
    enum { SIDE = DIP_PICTURE_BLOCK + 2 * DIP_SSIM_RADIUS };
    float map[SIDE * SIDE];
    const DipPixelRect own = dip_picture_block(meter->width, meter->height, block);
    const DipPixelRect rect =
        dip_picture_block_with_margin(meter->width, meter->height, block, DIP_SSIM_RADIUS);
    const DipSrgbPicture test = dip_picture_part(&meter->test, &rect);
    const DipSrgbPicture standard = dip_picture_part(&meter->standard.picture, &rect);
    if (!dip_ssim_map(&test, &standard, map)) {
        return false;
    }
    for (int y = own.y; y < own.y + own.height; y++) {
        memcpy(meter->ssim_map + (size_t)y * (size_t)meter->width + own.x,
               map + (y - rect.y) * rect.width + (own.x - rect.x), (size_t)own.width * sizeof *map);
    }
    return true;
}

// --- bands ---------------------------------------------------------------------------------------

// Index of a sum among the doubles of DipMetricRegionSums.
#define SUM(name) (offsetof(DipMetricRegionSums, name) / sizeof(double))

// Adds `count` values to the sum with index `sum` of each region. map[0] is the value of pixel
// `first`. Adds the number of these pixels to the sum with index `pixels`, if `pixels` is not
// negative.
static void add_map(DipMeter *meter, const float *map, size_t first, size_t count, size_t sum,
                    int pixels) {
    const int regions = meter->kind >= DIP_METER_PICTURES ? DIP_METRIC_REGION_COUNT : 1;
    for (int r = 0; r < regions; r++) {
        double *sums = (double *)&meter->sums.regions[r];
        DipMapSum of_map = {.sum = sums[sum]};
        const DipPixelMask mask = {r > 0 ? meter->standard.classes + first : NULL,
                                   (uint8_t)(r - 1)};
        dip_map_sum_add(&of_map, map, count, mask);
        sums[sum] = of_map.sum;
        if (pixels >= 0) {
            sums[pixels] += of_map.pixel_count;
        }
    }
}

static void measure_light(DipMeter *meter, const DipSrgbPicture *test, size_t first, size_t count) {
    const float *standard_lin = meter->standard.rgb_lin + 3 * first;
    if (meter->test_lin) {
        for (size_t i = 0; i < 3 * count; i++) {
            meter->band[i] = meter->test_lin[3 * first + i] - standard_lin[i];
        }
    } else {
        dip_difference_lin(test, standard_lin, meter->band);
    }
    if (meter->kind == DIP_METER_BURSTS) {
        dip_flicker_add(&meter->flicker, meter->band, 3 * count);
    } else {
        const double values = 3.0 * meter->width * meter->height;
        for (size_t i = 0; i < 3 * count; i++) {
            meter->squared_static += (double)meter->band[i] * (double)meter->band[i] / values;
        }
    }
    dip_difference_squared_map(meter->band, count, meter->band);
    add_map(meter, meter->band, first, count, SUM(squared_lin), -1);
}

static void measure_band(DipMeter *meter, int y) {
    const int below = meter->height - y;
    const DipPixelRect rect = {0, y, meter->width,
                               below < band_rows(meter) ? below : band_rows(meter)};
    const DipSrgbPicture test = dip_picture_part(&meter->test, &rect);
    const DipSrgbPicture standard = dip_picture_part(&meter->standard.picture, &rect);
    const size_t first = (size_t)y * (size_t)meter->width;
    const size_t count = (size_t)rect.width * (size_t)rect.height;
    if (meter->standard.rgb_lin) {
        measure_light(meter, &test, first, count);
    }
    dip_difference_codes_map(&test, &standard, meter->band);
    add_map(meter, meter->band, first, count, SUM(squared_codes), SUM(pixels));
    if (meter->kind >= DIP_METER_FLIP) {
        add_map(meter, meter->flip_map + first, first, count, SUM(flip), -1);
    }
    if (meter->kind >= DIP_METER_PICTURES) {
        add_map(meter, meter->ssim_map + first, first, count, SUM(ssim), SUM(ssim_pixels));
    }
}

// --- the whole -----------------------------------------------------------------------------------

DipStep dip_meter_step(DipMeter *meter) {
    DIP_FP_MODE_SCOPE();
    const int blocks =
        meter->kind >= DIP_METER_FLIP ? dip_picture_block_count(meter->width, meter->height) : 0;
    const int rows = band_rows(meter);
    const int bands = (meter->height + rows - 1) / rows;
    if (meter->steps >= blocks) {
        measure_band(meter, (meter->steps - blocks) * rows);
    } else if (!measure_flip(meter, meter->steps) ||
               (meter->kind >= DIP_METER_PICTURES && !measure_ssim(meter, meter->steps))) {
        return DIP_STEP_FAILED;
    }
    if (++meter->steps < blocks + bands) {
        return DIP_STEP_WORKING;
    }
    if (meter->kind >= DIP_METER_PICTURES) {
        dip_flip_tail_add(&meter->tail, meter->flip_map, meter->width, meter->height);
    }
    return DIP_STEP_DONE;
}

bool dip_meter_add(DipMeter *meter, const DipSrgbPicture *test, const float *test_lin,
                   const DipMeterStandard *standard, DipMetricSums *sums) {
    DipStep step;
    dip_meter_set_standard(meter, standard);
    dip_meter_begin(meter, test, test_lin);
    do {
        step = dip_meter_step(meter);
    } while (step == DIP_STEP_WORKING);
    dip_metric_sums_add(sums, &meter->sums);
    return step == DIP_STEP_DONE;
}

void dip_meter_end_burst(DipMeter *meter, DipMetricSums *sums) {
    DIP_FP_MODE_SCOPE();
    const DipFlickerResult result =
        meter->kind == DIP_METER_BURSTS
            ? dip_flicker_result(&meter->flicker)
            : (DipFlickerResult){.squared_static = meter->squared_static};
    sums->bursts += 1.0;
    sums->squared_static += result.squared_static;
    sums->squared_flicker += result.squared_flicker;
    sums->squared_step += result.squared_step;
    sums->squared_two_mean += result.squared_two_mean;
}
