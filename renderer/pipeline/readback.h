// Sample readback: what each sample of some pixels shows, for programs that explain a picture.
//
// A pass with a readback (pipeline.h) writes the samples of the readback's pixels into the caller's
// memory while it draws. The picture is the same to the bit. Passes without a readback do no work
// for it.
#ifndef DIP_RENDERER_PIPELINE_READBACK_H
#define DIP_RENDERER_PIPELINE_READBACK_H

#include "renderer/pipeline/target.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// One sample. A pixel's colour is the mean of its samples, rounded to 16-bit linear light with
// halves rounded up, and then encoded to sRGB (DipSrgbEncodeTable in base/srgb.h).
typedef struct DipSampleValue {
    // Red, green and blue in 16-bit linear light. Samples that share a fragment have one colour.
    uint16_t linear16[3];
    // Number of the patch (patch.h) that the sample shows, or 0 for the background. Equal numbers
    // in one frame mean the same patch.
    uint32_t patch;
    float depth; // z / w of the surface; 1 is the near plane, 0 is infinitely far
} DipSampleValue;

typedef struct DipSampleReadback {
    DipTargetRegion region; // pixels to read; a rectangle of at least one pixel within the target
    // Sample s of the region's pixel in column x and row y has the index
    // dip_sample_index(&region, x, y) + s. Entries beyond the pass's samples are left untouched.
    // Owned by the caller; dip_sample_room(&region) entries.
    DipSampleValue *samples;
} DipSampleReadback;

enum { DIP_READBACK_STRIDE = 8 }; // entries per pixel, DIP_MAX_SAMPLES of pattern.h

// Returns the number of entries that a region takes.
static inline size_t dip_sample_room(const DipTargetRegion *region) {
    return (size_t)(region->x1 - region->x0) * (size_t)(region->y1 - region->y0) *
           DIP_READBACK_STRIDE;
}

// Returns the index of the first sample of pixel (x, y) of the target, which must lie in the
// region.
static inline size_t dip_sample_index(const DipTargetRegion *region, int x, int y) {
    const size_t width = (size_t)(region->x1 - region->x0);
    return ((size_t)(y - region->y0) * width + (size_t)(x - region->x0)) * DIP_READBACK_STRIDE;
}

#ifdef __cplusplus
}
#endif

#endif
