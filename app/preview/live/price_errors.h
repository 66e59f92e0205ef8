// Measures the FLIP of one picture against the truth, a block at a time.
#ifndef DIP_APP_PREVIEW_LIVE_PRICE_ERRORS_H
#define DIP_APP_PREVIEW_LIVE_PRICE_ERRORS_H

#include "app/measure/metrics/picture.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct DipPriceErrors {
    uint8_t *rgba8; // Copy of the picture, rows packed. Owned.
    float *scratch; // Owned.
    int width;
    int height;
    int block; // The next block.
    double sum;
    double pixels;
} DipPriceErrors;

// Copies a picture and begins with its first block. The structure is all zero before the first
// picture. Returns false if memory runs out.
bool dip_price_errors_begin(DipPriceErrors *errors, const DipSrgbPicture *picture);

typedef enum DipPriceErrorsStep {
    DIP_PRICE_ERRORS_WORKING,
    DIP_PRICE_ERRORS_DONE, // *flip is the picture's FLIP.
    DIP_PRICE_ERRORS_FAILED
} DipPriceErrorsStep;

// Measures one block. The truth has the size of the picture.
DipPriceErrorsStep dip_price_errors_step(DipPriceErrors *errors, const DipSrgbPicture *truth,
                                         double *flip);

void dip_price_errors_free(DipPriceErrors *errors);

#endif
