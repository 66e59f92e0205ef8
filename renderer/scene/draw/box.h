// Averages a picture to a smaller one: a box filter in linear light, exact to the last bit.
#ifndef DIP_RENDERER_SCENE_DRAW_BOX_H
#define DIP_RENDERER_SCENE_DRAW_BOX_H

#include "renderer/base/pool.h"
#include "renderer/pipeline/target.h"

#include <stddef.h>
#include <stdint.h>

enum { DIP_BOX_MAX_RATIO = 2 }; // most pixels of the larger picture per pixel, in each direction

// A picture in 16-bit linear light, and the smaller picture that it is averaged to. Along each
// axis, the ratio of the sizes is 1..DIP_BOX_MAX_RATIO; it need not be the same along both.
typedef struct DipBoxFilter {
    const uint16_t *light16; // red, green, blue and an unused number for each pixel
    size_t stride;           // distance from one row to the next, in numbers
    int from_width;          // size of the larger picture, in pixels
    int from_height;
    uint8_t *rgba8; // the smaller picture; each pixel's fourth byte becomes 255
    size_t stride_bytes;
    int width;
    int height;
    const uint8_t *srgb_code; // sRGB code of each 16-bit light (DipSrgbEncodeTable)
} DipBoxFilter;

// Fills in the light of a picture that has only sRGB codes, with the picture's width as the stride
// in pixels. The light is that of each code, rounded to 16 bits.
void dip_box_decode(const DipTarget *picture, uint16_t *light16, DipPool *pool);

// Fills in the smaller picture, on the pool or, if the pool is NULL, on the caller's thread. Pixel
// x of a row is the mean over the larger picture's pixels from x * ratio to (x + 1) * ratio, each
// weighted by the length that lies within; likewise for rows. The mean is rounded to 16-bit light,
// halves up, before it is encoded. Nothing else is rounded: overlaps are whole numbers.
void dip_box_filter(const DipBoxFilter *box, DipPool *pool);

#endif
