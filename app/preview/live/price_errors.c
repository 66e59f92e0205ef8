// Keeps a copy of the picture that is measured, since the painter draws over its own.
#include "app/preview/live/price_errors.h"

#include "app/preview/live/error_blocks.h"

#include <stdlib.h>
#include <string.h>

bool dip_price_errors_begin(DipPriceErrors *errors, const DipSrgbPicture *picture) {
    const size_t row_bytes = 4 * (size_t)picture->width;
    if (picture->width != errors->width || picture->height != errors->height) {
        dip_price_errors_free(errors);
        errors->rgba8 = malloc(row_bytes * (size_t)picture->height);
        errors->scratch = malloc(dip_error_block_values() * sizeof *errors->scratch);
        if (!errors->rgba8 || !errors->scratch) {
            dip_price_errors_free(errors);
            return false;
        }
        errors->width = picture->width;
        errors->height = picture->height;
    }
    for (size_t y = 0; y < (size_t)picture->height; y++) {
        memcpy(errors->rgba8 + y * row_bytes, picture->rgba8 + y * picture->stride_bytes,
               row_bytes);
    }
    errors->block = 0;
    errors->sum = errors->pixels = 0.0;
    return true;
}

DipPriceErrorsStep dip_price_errors_step(DipPriceErrors *errors, const DipSrgbPicture *truth,
                                         double *flip) {
    const DipSrgbPicture picture = {errors->rgba8, 4 * (size_t)errors->width, errors->width,
                                    errors->height};
    DipMapSum sum = {0};
    if (!dip_error_block_add(&picture, truth, errors->block, errors->scratch, NULL, &sum)) {
        return DIP_PRICE_ERRORS_FAILED;
    }
    errors->sum += sum.sum;
    errors->pixels += (double)sum.pixel_count;
    if (++errors->block < dip_error_block_count(errors->width, errors->height)) {
        return DIP_PRICE_ERRORS_WORKING;
    }
    *flip = errors->sum / errors->pixels;
    return DIP_PRICE_ERRORS_DONE;
}

void dip_price_errors_free(DipPriceErrors *errors) {
    free(errors->rgba8);
    free(errors->scratch);
    *errors = (DipPriceErrors){0};
}
