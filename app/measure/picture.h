// The pictures that metrics compare, and the pixels that a figure is taken over.
#ifndef DIP_APP_MEASURE_PICTURE_H
#define DIP_APP_MEASURE_PICTURE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// A view of 8-bit sRGB codes, four bytes per pixel: red, green, blue, and a fourth byte that no
// metric reads. The top row comes first, as in a DipFrame. The bytes are borrowed.
typedef struct DipSrgbPicture {
    const uint8_t *rgba8;
    size_t stride_bytes; // Bytes from one row to the next, at least 4 * width.
    int width;           // Pixels.
    int height;          // Pixels.
} DipSrgbPicture;

// A selection of pixels: those whose class equals `wanted`. If `classes` is NULL, all pixels are
// selected. `classes` holds one byte per pixel, rows packed, and is borrowed.
typedef struct DipPixelMask {
    const uint8_t *classes;
    uint8_t wanted;
} DipPixelMask;

#ifdef __cplusplus
}
#endif

#endif
