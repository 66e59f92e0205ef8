// Figures from sums.
#include "app/measure/sums.h"

#include "app/measure/error.h"

#include <math.h>

const char *const dip_cost_region_names[DIP_COST_REGIONS] = {"all",
#define REGION_NAME(NAME, name, text) name,
                                                             DIP_SEEN_LIST(REGION_NAME)
#undef REGION_NAME
};

void dip_cost_sums_add(DipCostSums *to, const DipCostSums *sums) {
    double *values = (double *)to;
    const double *added = (const double *)sums;
    for (int i = 0; i < DIP_COST_SUM_COUNT; i++) {
        values[i] += added[i];
    }
}

static double share(double sum, double count) {
    return count > 0.0 ? sum / count : 0.0;
}

DipCostFigures dip_cost_figures(const DipCostSums *sums, int region) {
    const DipCostRegionSums *r = &sums->regions[region];
    return (DipCostFigures){
        .rmse_lin = sqrt(share(r->squared_lin, r->pixels)),
        .psnr_db = dip_error_psnr_db(share(r->squared_codes, r->pixels)),
        .ssim = r->ssim_pixels > 0.0 ? r->ssim / r->ssim_pixels : 1.0,
        .flip = share(r->flip, r->pixels),
    };
}

DipCostFlicker dip_cost_flicker(const DipCostSums *sums) {
    return (DipCostFlicker){
        .steady = sqrt(share(sums->squared_static, sums->bursts)),
        .flicker = sqrt(share(sums->squared_flicker, sums->bursts)),
        .step = sqrt(share(sums->squared_step, sums->bursts)),
        .two_mean = sqrt(share(sums->squared_two_mean, sums->bursts)),
    };
}
