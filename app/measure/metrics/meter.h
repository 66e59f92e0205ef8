// Computes the metrics of pictures by comparing each with another picture, which is called the
// standard and usually is the truth (truth.h). A meter works in steps of a few milliseconds, so
// that the preview can pause between two of them. `diptych cost` takes all steps of a picture
// without a pause (dip_meter_add). Use one meter per thread.
#ifndef DIP_APP_MEASURE_METRICS_METER_H
#define DIP_APP_MEASURE_METRICS_METER_H

#include "renderer/base/api.h"
#include "app/measure/metrics/difference.h"
#include "app/measure/metrics/flicker.h"
#include "app/measure/metrics/flip.h"
#include "app/measure/metrics/flip_tail.h"
#include "app/measure/metrics/metrics.h"

#ifdef __cplusplus
extern "C" {
#endif

// What a step of some work returns.
typedef enum DipStep {
    DIP_STEP_WORKING,
    DIP_STEP_RESULT, // There is a result, and more work may follow.
    DIP_STEP_DONE,   // There is nothing left to do.
    DIP_STEP_FAILED
} DipStep;

// What a meter measures. Each kind also measures all that the kinds before it do.
typedef enum DipMeterKind {
    DIP_METER_DIFFERENCES, // Squared differences of whole pictures.
    DIP_METER_FLIP,        // FLIP of whole pictures.
    DIP_METER_PICTURES,    // All metrics of each region (metrics.h); a burst is a single picture.
    DIP_METER_BURSTS       // The same metrics; a burst is a series of several frames (flicker.h).
} DipMeterKind;

// The picture with which other pictures are compared. All data is borrowed and may be shared by
// threads.
typedef struct DipMeterStandard {
    DipSrgbPicture picture;
    // The same picture in linear light, 3 values per pixel. If it is NULL, squared differences in
    // linear light and flicker are not measured.
    const float *rgb_lin;
    const DipFlipAnalysis *analysis; // FLIP's analysis of the picture; if NULL, the meter makes it.
    // What each pixel shows (DipSeen). Kinds with regions need it, and the others ignore it.
    const uint8_t *classes;
} DipMeterStandard;

// A meter and the picture that it measures. The fields are private. A meter borrows the data of
// the picture and of the standard, and owns all else that its fields point to.
typedef struct DipMeter {
    DipMeterKind kind;
    int width;
    int height;
    DipFlip flip;
    DipFlipAnalysis analysis; // Analysis of the standard, if the meter makes it.
    int analysed;             // Number of blocks of the standard that the meter has analysed.
    DipFlicker flicker;       // Used only for bursts of several frames.
    double squared_static;    // For bursts of one frame: the frame's squared static error.
    DipFlipTailMeter tail;    // The distribution of FLIP in the burst so far.
    float *flip_map;          // FLIP of each pixel of the last picture.
    float *ssim_map;
    float *band; // Scratch: three values for each pixel of a band, which is a few rows.
    DipSrgbPicture test;
    const float *test_lin;
    DipMeterStandard standard;
    int steps; // Number of steps taken for the current picture.
    // Sums of the current picture, complete after its last step. The fields about bursts stay 0,
    // because dip_meter_end_burst adds to the caller's sums.
    DipMetricSums sums;
} DipMeter;

// Returns false when memory runs out, or if dip_flip_init refuses the size or pixels_per_degree;
// *meter then owns nothing.
DIP_API bool dip_meter_init(DipMeter *meter, DipMeterKind kind, int width, int height,
                            double pixels_per_degree);
DIP_API void dip_meter_free(DipMeter *meter);

// Begins a burst, a series of successive frames (flicker.h). dip_meter_init begins the first one.
// The meter must have the kind PICTURES or BURSTS.
DIP_API void dip_meter_begin_burst(DipMeter *meter);

// Sets the standard with which the next pictures are compared. If the standard has no analysis, the
// meter analyses it while it measures the first of these pictures.
DIP_API void dip_meter_set_standard(DipMeter *meter, const DipMeterStandard *standard);

// Begins the next picture of the burst. If the previous picture is not complete, forgets that
// picture; in a burst of several frames (DIP_METER_BURSTS), the previous picture must be complete.
// test_lin is the picture in linear light, if the caller has values more precise than the 8-bit
// codes of `test`; otherwise it is NULL. Picture and standard are borrowed until the last step.
DIP_API void dip_meter_begin(DipMeter *meter, const DipSrgbPicture *test, const float *test_lin);

// Measures the next block or band of the picture. The results have the same bits as if the whole
// picture were measured at once. Returns DONE after the last step, and FAILED when memory runs out.
DIP_API DipStep dip_meter_step(DipMeter *meter);

// Sets the standard, begins a picture, takes all its steps and adds its sums to *sums. Returns
// false when memory runs out.
DIP_API bool dip_meter_add(DipMeter *meter, const DipSrgbPicture *test, const float *test_lin,
                           const DipMeterStandard *standard, DipMetricSums *sums);

// Ends the burst and adds its flicker to *sums. A single picture is a burst of one frame.
DIP_API void dip_meter_end_burst(DipMeter *meter, DipMetricSums *sums);

#ifdef __cplusplus
}
#endif

#endif
