// All metrics over all regions.
#include "app/measure/meter.h"

#include "app/measure/error.h"
#include "app/measure/ssim.h"

#include <stdlib.h>

bool dip_cost_meter_init(DipCostMeter *meter, int width, int height, double pixels_per_degree) {
    const size_t count = (size_t)width * (size_t)height;
    *meter = (DipCostMeter){0};
    meter->map = malloc(count * sizeof *meter->map);
    meter->error_lin = malloc(3 * count * sizeof *meter->error_lin);
    const bool made = meter->map && meter->error_lin &&
                      dip_flip_init(&meter->flip, width, height, pixels_per_degree) &&
                      dip_flip_side_init(&meter->flip, &meter->side) &&
                      dip_flicker_init(&meter->flicker, 3 * count);
    if (!made) {
        dip_cost_meter_free(meter);
    }
    return made;
}

void dip_cost_meter_free(DipCostMeter *meter) {
    free(meter->map);
    free(meter->error_lin);
    dip_flip_side_free(&meter->side);
    dip_flip_free(&meter->flip);
    dip_flicker_free(&meter->flicker);
    *meter = (DipCostMeter){0};
}

static DipRegion region_of(const uint8_t *classes, int region) {
    return region == 0 ? (DipRegion){0} : (DipRegion){classes, (uint8_t)(region - 1)};
}

// Which field of the regions' sums a map adds to.
typedef void AddTo(DipCostRegionSums *region, DipErrorSum sum);

static void add_squared_lin(DipCostRegionSums *region, DipErrorSum sum) {
    region->pixels += sum.pixel_count;
    region->squared_lin += sum.sum;
}

static void add_squared_codes(DipCostRegionSums *region, DipErrorSum sum) {
    region->squared_codes += sum.sum;
}

static void add_ssim(DipCostRegionSums *region, DipErrorSum sum) {
    region->ssim += sum.sum;
    region->ssim_pixels += sum.pixel_count;
}

static void add_flip(DipCostRegionSums *region, DipErrorSum sum) {
    region->flip += sum.sum;
}

static void add_map(const DipCostMeter *meter, const uint8_t *classes, AddTo *add,
                    DipCostSums *sums) {
    const size_t count = (size_t)meter->flip.width * (size_t)meter->flip.height;
    for (int r = 0; r < DIP_COST_REGIONS; r++) {
        add(&sums->regions[r], dip_error_sum(meter->map, count, region_of(classes, r)));
    }
}

bool dip_cost_meter_add(DipCostMeter *meter, const DipPicture *test, const float *test_lin,
                        const DipCostStandard *standard, DipCostSums *sums) {
    const size_t count = (size_t)meter->flip.width * (size_t)meter->flip.height;
    if (test_lin) {
        for (size_t i = 0; i < 3 * count; i++) {
            meter->error_lin[i] = test_lin[i] - standard->rgb_lin[i];
        }
    } else {
        dip_error_lin(test, standard->rgb_lin, meter->error_lin);
    }
    dip_flicker_add(&meter->flicker, meter->error_lin);
    dip_error_squared_map(meter->error_lin, count, meter->map);
    add_map(meter, standard->classes, add_squared_lin, sums);
    dip_error_codes_map(test, &standard->picture, meter->map);
    add_map(meter, standard->classes, add_squared_codes, sums);
    if (!dip_ssim_map(test, &standard->picture, meter->map)) {
        return false;
    }
    add_map(meter, standard->classes, add_ssim, sums);
    dip_flip_take(&meter->flip, test, &meter->side);
    dip_flip_compare(&meter->flip, &meter->side, standard->side, meter->map);
    add_map(meter, standard->classes, add_flip, sums);
    return true;
}

void dip_cost_meter_end_burst(DipCostMeter *meter, DipCostSums *sums) {
    const DipFlickerResult result = dip_flicker_result(&meter->flicker);
    sums->bursts += 1.0;
    sums->squared_static += result.squared_static;
    sums->squared_flicker += result.squared_flicker;
    sums->squared_step += result.squared_step;
    sums->squared_two_mean += result.squared_two_mean;
}
