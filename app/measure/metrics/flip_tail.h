// Computes the percentiles of the FLIP values of all pixels of a burst (a series of successive
// frames, flicker.h), and finds the part of the pictures where FLIP is worst. A mean over a picture
// hides small parts that look bad.
#ifndef DIP_APP_MEASURE_METRICS_FLIP_TAIL_H
#define DIP_APP_MEASURE_METRICS_FLIP_TAIL_H

#include "renderer/base/api.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Side of the blocks among which the worst one is found, in pixels.
enum { DIP_FLIP_TAIL_BLOCK = 32 };

// The result for a burst. Holds doubles only, so that it can be written and read as an array of
// DIP_FLIP_TAIL_COUNT numbers.
typedef struct DipFlipTail {
    // Percentiles: 50, 95 and 99 % of all pixels of all frames have at most this FLIP. The values
    // are exact to 1 / 65536.
    double p50;
    double p95;
    double p99;
    double worst;       // Mean FLIP of the worst block; 0 if no picture differs from the truth.
    double worst_frame; // Index of the frame with the worst block.
    double worst_x;     // Left edge of the worst block, in pixels.
    double worst_y;     // Top edge of the worst block, in pixels.
    double worst_width; // In pixels; 0 if nothing was measured.
    double worst_height;
} DipFlipTail;

enum { DIP_FLIP_TAIL_COUNT = sizeof(DipFlipTail) / sizeof(double) };

// Collects the FLIP values of a burst. Not thread-safe; use one per thread.
typedef struct DipFlipTailMeter {
    uint32_t *histogram; // Owned.
    int frames;
    DipFlipTail worst; // Only the fields of the worst block are valid.
} DipFlipTailMeter;

// Returns false when memory runs out. Even then, the caller must free the meter.
DIP_API bool dip_flip_tail_init(DipFlipTailMeter *meter);
DIP_API void dip_flip_tail_free(DipFlipTailMeter *meter);

// Begins a burst.
DIP_API void dip_flip_tail_restart(DipFlipTailMeter *meter);

// Adds a picture: width * height FLIP values in 0..1. The picture is divided into blocks of 32 x 32
// pixels from the top left on. The last block of a row or a column ends at the edge of the picture
// and has the full size, so it may overlap with the block before. If a picture is narrower or lower
// than 32 pixels, its blocks are, too.
DIP_API void dip_flip_tail_add(DipFlipTailMeter *meter, const float *map, int width, int height);

// Returns the percentiles of all values that were added since the burst began, and the worst block.
// If several blocks are equally bad, returns the first of them.
DIP_API DipFlipTail dip_flip_tail_result(const DipFlipTailMeter *meter);

#ifdef __cplusplus
}
#endif

#endif
