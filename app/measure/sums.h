// Sums that errors are made of: those of several pictures add up, and so do those of several
// machines.
#ifndef DIP_APP_MEASURE_SUMS_H
#define DIP_APP_MEASURE_SUMS_H

#include "renderer/reference/convergence.h"

// Region 0 is the whole picture, region 1 + c are the pixels of class c (DipSeen).
enum { DIP_COST_REGIONS = 1 + DIP_SEEN_COUNT };

extern const char *const dip_cost_region_names[DIP_COST_REGIONS];

typedef struct DipCostRegionSums {
    double pixels;
    double squared_lin;   // mean over the channels, linear light
    double squared_codes; // likewise of sRGB codes
    double ssim;
    double ssim_pixels; // those that have one
    double flip;
} DipCostRegionSums;

// Doubles only, so that they can be added, written and read as an array.
typedef struct DipCostSums {
    DipCostRegionSums regions[DIP_COST_REGIONS];
    double bursts; // what the following are sums over; means over a burst's values, linear light
    double squared_static;
    double squared_flicker;
    double squared_step;
    double squared_two_mean;
} DipCostSums;

enum { DIP_COST_SUM_COUNT = sizeof(DipCostSums) / sizeof(double) };

void dip_cost_sums_add(DipCostSums *to, const DipCostSums *sums);

typedef struct DipCostFigures {
    double rmse_lin;
    double psnr_db;
    double ssim;
    double flip;
} DipCostFigures;

// Of one region; all 0 but PSNR and SSIM where it has no pixel.
DipCostFigures dip_cost_figures(const DipCostSums *sums, int region);

typedef struct DipCostFlicker {
    double steady; // the error that stands still, root mean square, linear light
    double flicker;
    double step;
    double two_mean;
} DipCostFlicker;

DipCostFlicker dip_cost_flicker(const DipCostSums *sums);

#endif
