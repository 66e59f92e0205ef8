// What the viewpoints of a path say about each metric: intervals over the viewpoints, which are a
// sample of the path, and the noise floors of the truths.
#ifndef DIP_APP_REPORT_VIEWPOINTS_H
#define DIP_APP_REPORT_VIEWPOINTS_H

#include "app/report/report.h"

// Metrics of the whole picture.
typedef enum DipCostMetric {
    DIP_COST_RMSE,
    DIP_COST_PSNR,
    DIP_COST_SSIM,
    DIP_COST_FLIP,
    DIP_COST_FLICKER,
    DIP_COST_METRIC_COUNT
} DipCostMetric;

// Returns a row's metric over all judged viewpoints, with the 95 % interval of what all viewpoints
// of the path would have. For FLIP and SSIM it is Student's t of the viewpoints' own means. The
// other metrics come from a mean of squares, which is positive and skewed: Student's t of its
// logarithm, whose standard error is that of the mean over the mean. With a single viewpoint there
// is no interval, and low and high are NAN.
DipEstimate dip_cost_metric(const DipCostReport *report, int row, DipCostMetric metric);

// Returns the mean of a row's metric at the viewpoints minus that of another row of the same path,
// with Student's interval. Only viewpoints that both rows have count.
DipEstimate dip_cost_metric_change(const DipCostReport *report, int row, int base,
                                   DipCostMetric metric);

// Returns estimates of the metrics that a path's truths themselves have, from their halves, whose
// noise is independent. The mean of the halves has a quarter of the mean square that lies between
// them: half of the RMSE, 6.02 dB more PSNR, and a quarter of 1 - SSIM, since 1 - SSIM is
// proportional to the noise's variance as long as it is small. FLIP is dip_cost_floor_flip.
DipMetrics dip_cost_floor_metrics(const DipCostReport *report, int path);

#endif
