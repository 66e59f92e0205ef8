// A meter computes every metric of a picture at once, by comparing it with another picture (the
// standard). Use one meter per thread.
#ifndef DIP_APP_MEASURE_METRICS_METER_H
#define DIP_APP_MEASURE_METRICS_METER_H

#include "app/measure/metrics/flicker.h"
#include "app/measure/metrics/flip.h"
#include "app/measure/metrics/flip_tail.h"
#include "app/measure/metrics/metrics.h"

#ifdef __cplusplus
extern "C" {
#endif

// Scratch memory for pictures of one size. Owns everything it points to.
typedef struct DipMeter {
    DipFlip flip;
    DipFlipAnalysis analysis; // Analysis of the picture being judged.
    DipFlicker flicker;
    DipFlipTailMeter tail; // The distribution of FLIP in the burst so far.
    float *map;            // One value per pixel.
    float *error_lin;      // Three values per pixel.
} DipMeter;

// Returns false when memory runs out; *meter then owns nothing.
bool dip_meter_init(DipMeter *meter, int width, int height, double pixels_per_degree);
void dip_meter_free(DipMeter *meter);

// The picture that others are compared with. Everything is borrowed and may be shared by threads.
typedef struct DipMeterStandard {
    DipSrgbPicture picture;
    const float *rgb_lin;            // The same picture in linear light, 3 values per pixel.
    const DipFlipAnalysis *analysis; // The same picture, analysed.
    const uint8_t *classes;          // What each pixel shows (DipSeen).
} DipMeterStandard;

// Begins a burst, a series of successive frames (flicker.h). A new meter has begun its first burst.
void dip_meter_begin_burst(DipMeter *meter);

// Judges the next picture of the burst and adds its sums to *sums. If the caller has more precise
// values than the 8-bit codes of `test`, test_lin is the picture in linear light. If test_lin is
// NULL, linear light is computed from the codes. Returns false when memory runs out.
bool dip_meter_add(DipMeter *meter, const DipSrgbPicture *test, const float *test_lin,
                   const DipMeterStandard *standard, DipMetricSums *sums);

// Ends the burst and adds its flicker to *sums. A single picture is a burst of one frame.
void dip_meter_end_burst(DipMeter *meter, DipMetricSums *sums);

#ifdef __cplusplus
}
#endif

#endif
