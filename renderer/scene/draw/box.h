// Averages a picture to a smaller one: a box filter in linear light, exact to the last bit.
#ifndef DIP_RENDERER_SCENE_DRAW_BOX_H
#define DIP_RENDERER_SCENE_DRAW_BOX_H

#include "renderer/base/pool.h"
#include "renderer/base/srgb.h"
#include "renderer/pipeline/target.h"

#include <stddef.h>
#include <stdint.h>

enum { DIP_BOX_MAX_RATIO = 2 }; // most pixels of the larger picture per pixel, in each direction

// A larger picture and the smaller one that it is averaged to. Along each axis, the ratio of the
// sizes is 1..DIP_BOX_MAX_RATIO; it need not be the same along both. Pixel x of a row becomes the
// mean over the larger picture from x * ratio to (x + 1) * ratio, in which a pixel counts by the
// part of its width that lies there. Rows are averaged in the same way. The mean of 16-bit linear
// light is rounded to 16 bits, halves up, before it is encoded. Nothing else is rounded: overlaps
// are whole numbers.
typedef struct DipBoxFilter {
    int from_width; // of the larger picture
    int from_height;
    DipTarget to; // the smaller picture; each pixel's fourth byte becomes 255
    // The larger picture's light: planes of red, green and blue, in rows without gaps. NULL if both
    // ratios are 2: each tile is then averaged at once, and dip_box_filter has nothing left to do.
    uint16_t *light16;
    const DipSrgbEncodeTable *srgb;
} DipBoxFilter;

// Returns the memory in bytes that `light16` takes for a picture of this size; 0 if it is NULL.
size_t dip_box_light_bytes(int from_width, int from_height, int width, int height);

// Takes a tile of the larger picture, as a DipTileDone whose context is the DipBoxFilter. light16
// is not NULL.
void dip_box_take_tile(void *box, const DipTargetRegion *pixels, const uint16_t *light16);

// Fills in what is left of the smaller picture once all tiles are taken, on the pool or, if the
// pool is NULL, on the caller's thread.
void dip_box_filter(const DipBoxFilter *box, DipPool *pool);

#endif
