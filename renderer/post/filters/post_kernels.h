// The kernels of the filters, one table per instruction set (renderer/simd/kernel_table.h).
//
// A row of pixels is 8-bit RGBA. A row of values is an array of floats with one value per pixel.
// Kernels may read up to DIP_POST_BORDER values before and after a row of values.
#ifndef DIP_RENDERER_POST_FILTERS_POST_KERNELS_H
#define DIP_RENDERER_POST_FILTERS_POST_KERNELS_H

#include "renderer/base/srgb.h"
#include "renderer/simd/kernel_table.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Values before and after each row, and rows before and after a plane. FXAA looks 21 pixels far,
// and a vector may reach 16 values beyond the end of a row.
enum { DIP_POST_BORDER = 24 };

// A row to which FXAA is applied.
typedef struct DipFxaaRow {
    const float *luma;    // luma of the row's first pixel, in a plane with borders
    int luma_stride;      // values from one row of the plane to the next
    const uint8_t *above; // pixels of the rows above and below, or of the row itself at a border
    const uint8_t *row;
    const uint8_t *below;
    uint8_t *to;
    int width;
    uint32_t *edges; // scratch for the places of edges, width + 16 numbers
} DipFxaaRow;

// A row in which SMAA blends pixels. A weight is a share of 255; the four weights of a pixel are
// those across its top edge, for itself and for the pixel above, and those across its left edge,
// for itself and for the pixel to the left, from the lowest byte on.
typedef struct DipSmaaRow {
    const uint32_t *weights;       // of the row's pixels, and of one more
    const uint32_t *weights_below; // of the row below
    const uint8_t *above;
    const uint8_t *row;
    const uint8_t *below;
    uint8_t *to;
    int width;
} DipSmaaRow;

// A row that is sharpened. Each row of values is a channel of the row above, the row or the row
// below.
typedef struct DipSharpenRow {
    const float *above[3];
    const float *row[3];
    const float *below[3];
    const uint8_t *from; // the pixels, for their alpha
    uint8_t *to;
    int width;
    float sharpness;
} DipSharpenRow;

// Where the pixels of an enlarged row or column lie in the source: pixel i lies between the source
// pixels first[i] and first[i] + 1, and `part[i]` of the way to the second.
typedef struct DipPostPlaces {
    int32_t *first;
    float *part;
} DipPostPlaces;

// A row whose values are spread along x: to[i] is the sum of weights[t][i] * row[first[i] + t].
typedef struct DipSpreadRow {
    const float *row;
    const int32_t *first;
    const float *weights[4];
    int taps; // 2 or 4
    float *to;
    int width;
} DipSpreadRow;

// A row that is the weighted sum of two or four spread rows of each channel, encoded to sRGB.
typedef struct DipBlendRow {
    const float *rows[4][3];
    float weights[4];
    int taps; // 2 or 4
    // With four taps, the result is clamped to the range of the four nearest pixels of the source:
    // those at first[i] and first[i] + 1 in these two rows of values.
    const float *nearest[2][3];
    const int32_t *first;
    const DipSrgbEncodeTable *srgb;
    uint8_t *to;
    int width;
} DipBlendRow;

// The shape of the source around its pixels, as EASU sees it: the differences of luma across a
// pixel along x and y, and how much of a single edge they are, 0..2.
typedef struct DipEasuShape {
    const float *luma; // luma of the row's first pixel, in a plane with borders
    int luma_stride;
    float *across_x;
    float *across_y;
    float *edge;
    int width;
} DipEasuShape;

typedef struct DipEasuRow {
    const float *rows[4][3];  // channels of the rows -1, 0, 1 and 2 of the source
    const float *shape[2][3]; // across_x, across_y and edge of the rows 0 and 1
    const int32_t *first;
    const float *part;
    float part_y;
    uint8_t *to;
    int width;
} DipEasuRow;

// A row that is added to a history (history.h). Colours are 16-bit linear light in YCoCg.
typedef struct DipHistoryRow {
    int y;
    int width; // of the picture
    int height;
    const float *colours[3][3]; // channels of the row above, the row and the row below
    const float *depths[3];     // depths of the same rows
    const uint8_t *from;        // the pixels, for their alpha
    uint8_t *to;                // NULL: the result is not shown
    const DipSrgbEncodeTable *srgb;
    float to_before[12];  // DipHistoryPicture.to_before
    bool begins;          // the picture has no past
    int summed;           // pictures whose sum the past is; 0: it is a picture
    float past_scale;     // 1 / summed, or 1
    float alpha;          // share of the new picture
    const float *past[3]; // channels of pixel (0, 0) of the last result, in planes
    int plane_stride;
    float *result[3]; // the row's channels
} DipHistoryRow;

// X(result, name, parameters)
#define DIP_POST_KERNEL_LIST(X)                                                                    \
    /* Codes of each channel, 0..1. */                                                             \
    X(void, dip_kernel_post_codes, (const uint8_t *rgba8, int width, float *const channels[3]))    \
    /* The values of a table of 256 floats at the codes of each channel. */                        \
    X(void, dip_kernel_post_decode,                                                                \
      (const uint8_t *rgba8, int width, const float *table, float *const channels[3]))             \
    /* Sums of the codes 0..1 of the channels with three weights. */                               \
    X(void, dip_kernel_post_luma,                                                                  \
      (const uint8_t *rgba8, int width, const float weights[3], float *luma))                      \
    /* Filters a row and returns the number of pixels at an edge. */                               \
    X(int, dip_kernel_fxaa_row, (const DipFxaaRow *row))                                           \
    /* Sets a bit for each pixel that has an edge at its left, and at its top. Bit 0 of word 0 is  \
       the first pixel. */                                                                         \
    X(void, dip_kernel_smaa_edges,                                                                 \
      (const float *luma, int luma_stride, int width, uint64_t *left, uint64_t *top))              \
    X(void, dip_kernel_smaa_row, (const DipSmaaRow *row))                                          \
    X(void, dip_kernel_sharpen_row, (const DipSharpenRow *row))                                    \
    X(void, dip_kernel_spread_row, (const DipSpreadRow *row))                                      \
    X(void, dip_kernel_blend_row, (const DipBlendRow *row))                                        \
    X(void, dip_kernel_easu_shape, (const DipEasuShape *shape))                                    \
    X(void, dip_kernel_easu_row, (const DipEasuRow *row))                                          \
    /* Channels of a row in 16-bit linear light and YCoCg, with a table of 256 floats. */          \
    X(void, dip_kernel_history_unpack,                                                             \
      (const uint8_t *rgba8, int width, const float *table, float *const channels[3]))             \
    /* Blends a row with its past, and returns the number of pixels that have one. */              \
    X(unsigned, dip_kernel_history_move, (const DipHistoryRow *row))                               \
    /* Adds a row to the sums of the row's result. */                                              \
    X(void, dip_kernel_history_rest, (const DipHistoryRow *row))

typedef struct DipPostKernels {
    DIP_POST_KERNEL_LIST(DIP_KERNEL_FIELD)
} DipPostKernels;

DIP_KERNELS_DECLARE(DIP_POST_KERNEL_LIST)

// Returns the kernels for an instruction set that this machine has (dip_isa_available). Static
// storage.
const DipPostKernels *dip_post_kernels(DipIsa isa);

#endif
