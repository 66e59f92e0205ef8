// Measures the FLIP of a picture against the truth in blocks, a few milliseconds each.
//
// Each block is cut out with a margin as wide as FLIP's filters, so its pixels get the same values
// as in the whole picture.
#ifndef DIP_APP_PREVIEW_LIVE_ERROR_BLOCKS_H
#define DIP_APP_PREVIEW_LIVE_ERROR_BLOCKS_H

#include "app/measure/metrics/difference.h"
#include "app/measure/metrics/picture.h"

#include <stdbool.h>
#include <stddef.h>

// Returns the number of blocks of a picture.
int dip_error_block_count(int width, int height);

// Returns the number of values that the scratch memory of dip_error_block_add must have.
size_t dip_error_block_values(void);

// Adds the FLIP of the pixels of block `block` to *sum, and stores it at the pixels' places in
// `map`, which has one value for each pixel of the picture, unless it is NULL. Both pictures have
// the same size. Returns false if memory runs out.
bool dip_error_block_add(const DipSrgbPicture *test, const DipSrgbPicture *truth, int block,
                         float *scratch, float *map, DipMapSum *sum);

#endif
