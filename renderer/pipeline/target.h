// Render targets: pictures that render passes draw to, and rectangles of pixels in them.
#ifndef DIP_RENDERER_PIPELINE_TARGET_H
#define DIP_RENDERER_PIPELINE_TARGET_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { DIP_MAX_TARGET_SIZE = 8192 }; // largest width and height of a target, in pixels

// How the pixels of a target are stored. The first format is the only one that a pass of plain
// draws can store without the extra memory traffic of merging (state.h).
typedef enum DipFormat {
    DIP_FORMAT_SRGB8,   // bytes R, G, B, A; R, G and B are sRGB codes, A is linear
    DIP_FORMAT_LINEAR8, // bytes R, G, B, A, all linear: round(255 * value)
    DIP_FORMAT_RGBA32F, // four floats; values are not clamped
    DIP_FORMAT_R32F,    // one float, the red channel; it is not clamped
    DIP_FORMAT_CALLER,  // the caller's functions store and load pixels
    DIP_FORMAT_COUNT
} DipFormat;

// Functions of a caller's format. Colours are in linear light and are not clamped; colour[0..3][i]
// are the red, green, blue and alpha of pixel x + i of row y. Worker threads call them for
// different pixels at once.
typedef void DipStorePixels(void *context, int x, int y, int count, const float *const colour[4]);
typedef void DipLoadPixels(void *context, int x, int y, int count, float *const colour[4]);

// A colour picture in memory that the caller owns; the first row is the top one. Once a pass has
// drawn a target of format DIP_FORMAT_SRGB8, the fragment shaders of later passes may sample it
// (DipSampleTarget in shader.h). Plain draws and cleared pixels have the alpha 1.
typedef struct DipTarget {
    union {
        uint8_t *rgba8; // DIP_FORMAT_SRGB8 and DIP_FORMAT_LINEAR8; aligned to 4 bytes
        float *floats;  // DIP_FORMAT_RGBA32F and DIP_FORMAT_R32F
    };
    // Distance from one row to the next: a multiple of 4, at least the size of a row. Unused with
    // DIP_FORMAT_CALLER.
    size_t stride_bytes;
    int width; // pixels; must be the size of the pipeline
    int height;
    DipFormat format;
    // For DIP_FORMAT_CALLER. `load` may be NULL if no pass keeps the target's colours.
    DipStorePixels *store;
    DipLoadPixels *load;
    void *context;
} DipTarget;

// Pixels x0..x1-1 by y0..y1-1 of a target. All 0 means the whole target.
typedef struct DipTargetRegion {
    int x0, y0, x1, y1;
} DipTargetRegion;

enum { DIP_TARGET_TILE = 64 }; // targets are drawn in tiles of 64x64 pixels, row by row

// A rectangle within one tile: pixels x0..x1-1 by y0..y1-1, counted from the tile's top left
// corner. All four are multiples of 8, 0..DIP_TARGET_TILE, with x0 < x1 and y0 < y1. All 0 means
// that no pixel of the tile is needed.
typedef struct DipTileRegion {
    uint8_t x0, y0, x1, y1;
} DipTileRegion;

#ifdef __cplusplus
}
#endif

#endif
