// Computes the metrics by which pictures are judged, from sums over their pixels.
//
// A burst is a series of successive frames (flicker.h). Sums of several pictures, bursts or
// machines can be added. The metrics of the total then follow from means over all pixels of all
// pictures (SSIM: all pixels that have a value; flicker: all bursts). All functions are
// thread-safe.
#ifndef DIP_APP_MEASURE_METRICS_METRICS_H
#define DIP_APP_MEASURE_METRICS_METRICS_H

#include "renderer/base/api.h"
#include "renderer/reference/seen.h"

#ifdef __cplusplus
extern "C" {
#endif

// Metrics are computed for several regions of a picture. Region 0 is the whole picture. Region
// 1 + c holds the pixels of class c; a class (DipSeen) is a kind of thing that a pixel shows.
enum { DIP_METRIC_REGION_COUNT = 1 + DIP_SEEN_COUNT };

// The regions by name: "all", "edges", ...
extern DIP_API const char *const dip_metric_region_names[DIP_METRIC_REGION_COUNT];

// Sums over the pixels of one region. A squared difference is a mean over the three channels.
typedef struct DipMetricRegionSums {
    double pixels;        // Number of pixels.
    double squared_lin;   // Sum of squared differences in linear light.
    double squared_codes; // Sum of squared differences of sRGB codes.
    double ssim;          // Sum of structural similarities.
    double ssim_pixels;   // Number of pixels that have an SSIM value.
    double flip;          // Sum of FLIP values.
} DipMetricRegionSums;

// The sums of all regions and bursts. Holds doubles only, so that it can be added, written and read
// as an array of DIP_METRIC_SUM_COUNT numbers.
typedef struct DipMetricSums {
    DipMetricRegionSums regions[DIP_METRIC_REGION_COUNT];
    // Number of bursts. Each field below is the sum, over the bursts, of the mean square with the
    // same name in DipFlickerResult.
    double bursts;
    double squared_static;
    double squared_flicker;
    double squared_step;
    double squared_two_mean;
} DipMetricSums;

enum { DIP_METRIC_SUM_COUNT = sizeof(DipMetricSums) / sizeof(double) };

// Adds each number of *sums to the same number of *to.
DIP_API void dip_metric_sums_add(DipMetricSums *to, const DipMetricSums *sums);

// Metrics of one region. A region without pixels has rmse_lin 0, flip 0, ssim 1 and an infinite
// psnr_db.
typedef struct DipMetrics {
    double rmse_lin; // Root mean square error in linear light, 0..1.
    double psnr_db;  // Peak signal-to-noise ratio on sRGB codes, decibels.
    double ssim;     // Mean structural similarity, at most 1.
    double flip;     // Mean FLIP, 0..1.
} DipMetrics;

DIP_API DipMetrics dip_metrics_of(const DipMetricSums *sums, int region);

// Flicker metrics: root mean squares in linear light over all bursts; see flicker.h.
typedef struct DipFlickerMetrics {
    double steady;   // Error that does not change within a burst.
    double flicker;  // Deviation of the error over time.
    double step;     // Change of the error from one frame to the next.
    double two_mean; // Error of the mean of two successive frames.
} DipFlickerMetrics;

DIP_API DipFlickerMetrics dip_flicker_metrics_of(const DipMetricSums *sums);

#ifdef __cplusplus
}
#endif

#endif
