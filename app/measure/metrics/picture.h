// Describes the pictures that metrics compare, divides them into blocks, and selects the pixels
// that a metric covers.
#ifndef DIP_APP_MEASURE_METRICS_PICTURE_H
#define DIP_APP_MEASURE_METRICS_PICTURE_H

#include "renderer/base/api.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// A view of a picture in 8-bit sRGB. A code is the 8-bit value of one channel. A pixel has four
// bytes: the codes of red, green and blue, and a fourth byte that no metric reads. The top row
// comes first, as in a DipFrame. The bytes are borrowed.
typedef struct DipSrgbPicture {
    const uint8_t *rgba8;
    size_t stride_bytes; // Bytes from one row to the next, at least 4 * width.
    int width;           // Pixels.
    int height;          // Pixels.
} DipSrgbPicture;

// A rectangle of pixels.
typedef struct DipPixelRect {
    int x;
    int y;
    int width;
    int height;
} DipPixelRect;

// Pictures are judged in square blocks, so that the work can pause between two blocks. Blocks are
// numbered row by row from the top left. The last block of a row or of a column may be smaller,
// because it ends at the picture's border.
enum { DIP_PICTURE_BLOCK = 96 }; // Side of a block, in pixels.

DIP_API int dip_picture_block_count(int width, int height);
DIP_API DipPixelRect dip_picture_block(int width, int height, int block);

// Returns the block and the pixels around it up to a distance of margin_px, within the picture.
DIP_API DipPixelRect dip_picture_block_with_margin(int width, int height, int block, int margin_px);

// Returns a view of the part of a picture that lies within a rectangle. Copies no pixels.
DIP_API DipSrgbPicture dip_picture_part(const DipSrgbPicture *picture, const DipPixelRect *rect);

// Selects the pixels whose class (DipSeen: what a pixel shows) equals `wanted`, or all pixels if
// `classes` is NULL. `classes` holds one byte per pixel, rows packed, and is borrowed.
typedef struct DipPixelMask {
    const uint8_t *classes;
    uint8_t wanted;
} DipPixelMask;

#ifdef __cplusplus
}
#endif

#endif
