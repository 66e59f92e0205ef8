// A meter judges pictures: it computes their metrics by comparing each with another picture (the
// standard). It works in steps of a few milliseconds, so that a caller can pause between two of
// them. Commands step to the end. Use one meter per thread.
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

// Says how far stepwise work has come.
typedef enum DipStep {
    DIP_STEP_WORKING,
    DIP_STEP_RESULT, // There is a result, and more work may follow.
    DIP_STEP_DONE,   // There is nothing left to do.
    DIP_STEP_FAILED
} DipStep;

// What is measured. Each kind measures what those before it do.
typedef enum DipMeterKind {
    DIP_METER_DIFFERENCES, // Squared differences of whole pictures.
    DIP_METER_FLIP,        // FLIP of whole pictures.
    DIP_METER_PICTURES,    // All metrics, by region, of bursts of one frame.
    DIP_METER_BURSTS       // All metrics, by region, of bursts of several frames (flicker.h).
} DipMeterKind;

// The picture that others are compared with. Everything is borrowed and may be shared by threads.
typedef struct DipMeterStandard {
    DipSrgbPicture picture;
    // The same picture in linear light, 3 values per pixel. NULL: squared differences in linear
    // light are not measured.
    const float *rgb_lin;
    const DipFlipAnalysis *analysis; // The same picture, analysed. NULL: the meter analyses it.
    const uint8_t *classes; // What each pixel shows (DipSeen). Kinds without regions ignore it.
} DipMeterStandard;

// Owns everything it points to but the pictures.
typedef struct DipMeter {
    DipMeterKind kind;
    int width;
    int height;
    DipFlip flip;
    DipFlipAnalysis analysis; // Analysis of the standard, if the meter makes it.
    int analysed;             // Blocks of the standard that the meter has analysed.
    DipFlicker flicker;       // Only for bursts of several frames.
    double squared_static;    // For bursts of one frame: the frame's squared static error.
    DipFlipTailMeter tail;    // The distribution of FLIP in the burst so far.
    float *flip_map;          // FLIP of each pixel of the last picture.
    float *ssim_map;
    float *band; // Three values for each pixel of a band, which is a few rows.
    DipSrgbPicture test;
    const float *test_lin;
    DipMeterStandard standard;
    int steps;          // Steps taken for the picture.
    DipMetricSums sums; // Of the picture. Complete once the picture is done; without its burst.
} DipMeter;

// Returns false when memory runs out; *meter then owns nothing.
DIP_API bool dip_meter_init(DipMeter *meter, DipMeterKind kind, int width, int height,
                            double pixels_per_degree);
DIP_API void dip_meter_free(DipMeter *meter);

// Begins a burst, a series of successive frames (flicker.h). A new meter has begun its first burst.
DIP_API void dip_meter_begin_burst(DipMeter *meter);

// Sets the standard of the next pictures. A standard that the meter has to analyse is analysed
// once, with the first of these pictures.
DIP_API void dip_meter_set_standard(DipMeter *meter, const DipMeterStandard *standard);

// Begins the next picture of the burst. Forgets a picture whose last step was not taken. If the
// caller has more precise values than the 8-bit codes of `test`, test_lin is the picture in linear
// light; otherwise it is NULL. Picture and standard are borrowed until the last step.
DIP_API void dip_meter_begin(DipMeter *meter, const DipSrgbPicture *test, const float *test_lin);

// Measures a block or a band of the picture. The values are to the bit those of the whole picture.
// Returns DONE after the last one, and FAILED when memory runs out.
DIP_API DipStep dip_meter_step(DipMeter *meter);

// Sets the standard, begins a picture, steps to its end and adds its sums to *sums. Returns false
// when memory runs out.
DIP_API bool dip_meter_add(DipMeter *meter, const DipSrgbPicture *test, const float *test_lin,
                           const DipMeterStandard *standard, DipMetricSums *sums);

// Ends the burst and adds its flicker to *sums. A single picture is a burst of one frame.
DIP_API void dip_meter_end_burst(DipMeter *meter, DipMetricSums *sums);

#ifdef __cplusplus
}
#endif

#endif
