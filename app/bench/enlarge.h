// Enlarges a picture, bilinearly in linear light, as a display does with a picture that has fewer
// pixels than the display.
//
// The centre of pixel x of the result lies at (x + 1/2) * source width / result width - 1/2 in the
// source, counted in pixels from the centre of its first pixel. Its value is interpolated between
// the two nearest pixels, first along x, then along y; beyond the outermost centres the picture is
// constant. sRGB codes are decoded before the interpolation and encoded after it, rounded to the
// nearest code; alpha is interpolated as it is. The result is the same to the bit on every machine
// and with any number of threads.
#ifndef DIP_APP_BENCH_ENLARGE_H
#define DIP_APP_BENCH_ENLARGE_H

#include "renderer/base/error.h"
#include "renderer/base/pool.h"

#include <stddef.h>
#include <stdint.h>

// Writes the size at which a picture of width x height pixels is drawn if the render scale is
// `scale`, at most 1. This is the nearest size with exactly the same aspect ratio, so that
// enlarging does not stretch the picture. If its width is more than 2 % away from scale * width,
// the size is scale * width and scale * height, rounded.
void dip_enlarger_source_size(int width, int height, double scale, int *to_width, int *to_height);

typedef struct DipEnlarger DipEnlarger;

typedef struct DipEnlargerDef {
    int from_width; // Pixels, at least 1.
    int from_height;
    int to_width; // Pixels, at least from_width.
    int to_height;
    DipPool *pool; // Borrowed; must outlive the enlarger. NULL if the calling thread works alone.
} DipEnlargerDef;

// Makes an enlarger. Fails with DIP_ERROR_MEMORY.
DipEnlarger *dip_enlarger_create(const DipEnlargerDef *def, DipError *err);
// *enlarger may be NULL and becomes NULL.
void dip_enlarger_destroy(DipEnlarger **enlarger);

// Enlarges a picture of from_width x from_height 8-bit sRGB pixels with alpha, the top row first.
// Returns the enlarged picture, rows packed. The enlarger owns it, and the next call overwrites it.
const uint8_t *dip_enlarger_run(DipEnlarger *enlarger, const uint8_t *rgba8, size_t stride_bytes);

#endif
