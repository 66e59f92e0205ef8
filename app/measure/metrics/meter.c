// Computes every metric over every region of a picture.
#include "app/measure/metrics/meter.h"

#include "app/measure/metrics/difference.h"
#include "app/measure/metrics/ssim.h"

#include <stdlib.h>

bool dip_meter_init(DipMeter *meter, int width, int height, double pixels_per_degree) {
    const size_t count = (size_t)width * (size_t)height;
    *meter = (DipMeter){0};
    meter->map = malloc(count * sizeof *meter->map);
    meter->error_lin = malloc(3 * count * sizeof *meter->error_lin);
    const bool made = meter->map && meter->error_lin &&
                      dip_flip_init(&meter->flip, width, height, pixels_per_degree) &&
                      dip_flip_analysis_init(&meter->flip, &meter->analysis) &&
                      dip_flicker_init(&meter->flicker, 3 * count) &&
                      dip_flip_tail_init(&meter->tail);
    if (!made) {
        dip_meter_free(meter);
    }
    return made;
}

void dip_meter_free(DipMeter *meter) {
    free(meter->map);
    free(meter->error_lin);
    dip_flip_analysis_free(&meter->analysis);
    dip_flip_free(&meter->flip);
    dip_flicker_free(&meter->flicker);
    dip_flip_tail_free(&meter->tail);
    *meter = (DipMeter){0};
}

static DipPixelMask mask_of(const uint8_t *classes, int region) {
    return region == 0 ? (DipPixelMask){0} : (DipPixelMask){classes, (uint8_t)(region - 1)};
}

// Adds the sum of a map over one region to the field that the map belongs to.
typedef void AddTo(DipMetricRegionSums *region, DipMapSum sum);

static void add_squared_lin(DipMetricRegionSums *region, DipMapSum sum) {
    region->pixels += sum.pixel_count;
    region->squared_lin += sum.sum;
}

static void add_squared_codes(DipMetricRegionSums *region, DipMapSum sum) {
    region->squared_codes += sum.sum;
}

static void add_ssim(DipMetricRegionSums *region, DipMapSum sum) {
    region->ssim += sum.sum;
    region->ssim_pixels += sum.pixel_count;
}

static void add_flip(DipMetricRegionSums *region, DipMapSum sum) {
    region->flip += sum.sum;
}

static void add_map(const DipMeter *meter, const uint8_t *classes, AddTo *add,
                    DipMetricSums *sums) {
    const size_t count = (size_t)meter->flip.width * (size_t)meter->flip.height;
    for (int r = 0; r < DIP_METRIC_REGION_COUNT; r++) {
        add(&sums->regions[r], dip_map_sum(meter->map, count, mask_of(classes, r)));
    }
}

void dip_meter_begin_burst(DipMeter *meter) {
    dip_flicker_restart(&meter->flicker);
    dip_flip_tail_restart(&meter->tail);
}

bool dip_meter_add(DipMeter *meter, const DipSrgbPicture *test, const float *test_lin,
                   const DipMeterStandard *standard, DipMetricSums *sums) {
    const size_t count = (size_t)meter->flip.width * (size_t)meter->flip.height;
    if (test_lin) {
        for (size_t i = 0; i < 3 * count; i++) {
            meter->error_lin[i] = test_lin[i] - standard->rgb_lin[i];
        }
    } else {
        dip_difference_lin(test, standard->rgb_lin, meter->error_lin);
    }
    dip_flicker_add(&meter->flicker, meter->error_lin);
    dip_difference_squared_map(meter->error_lin, count, meter->map);
    add_map(meter, standard->classes, add_squared_lin, sums);
    dip_difference_codes_map(test, &standard->picture, meter->map);
    add_map(meter, standard->classes, add_squared_codes, sums);
    if (!dip_ssim_map(test, &standard->picture, meter->map)) {
        return false;
    }
    add_map(meter, standard->classes, add_ssim, sums);
    dip_flip_analyse(&meter->flip, test, &meter->analysis);
    dip_flip_compare(&meter->flip, &meter->analysis, standard->analysis, meter->map);
    add_map(meter, standard->classes, add_flip, sums);
    dip_flip_tail_add(&meter->tail, meter->map, meter->flip.width, meter->flip.height);
    return true;
}

void dip_meter_end_burst(DipMeter *meter, DipMetricSums *sums) {
    const DipFlickerResult result = dip_flicker_result(&meter->flicker);
    sums->bursts += 1.0;
    sums->squared_static += result.squared_static;
    sums->squared_flicker += result.squared_flicker;
    sums->squared_step += result.squared_step;
    sums->squared_two_mean += result.squared_two_mean;
}
