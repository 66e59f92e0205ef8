// Render targets: pictures that render passes draw to, and rectangles of pixels in them.
#ifndef DIP_RENDERER_PIPELINE_TARGET_H
#define DIP_RENDERER_PIPELINE_TARGET_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { DIP_MAX_TARGET_SIZE = 8192 }; // largest width and height of a target, in pixels

// A colour picture in memory that the caller owns: sRGB bytes R, G, B, 255 per pixel; the first row
// is the top one. Once a pass has drawn a target, the fragment shaders of later passes may sample
// it (DipSampleTarget in shader.h).
typedef struct DipTarget {
    uint8_t *rgba8;      // aligned to 4 bytes
    size_t stride_bytes; // distance from one row to the next: a multiple of 4, at least 4 * width
    int width;           // pixels; must be the size of the pipeline
    int height;
} DipTarget;

// Pixels x0..x1-1 by y0..y1-1 of a target. All 0 means the whole target.
typedef struct DipTargetRegion {
    int x0, y0, x1, y1;
} DipTargetRegion;

enum { DIP_TARGET_TILE = 64 }; // targets are drawn in tiles of 64x64 pixels, row by row

// A rectangle within one tile: pixels x0..x1-1 by y0..y1-1, counted from the tile's top left
// corner. All four are multiples of 8. All 0 means that no pixel of the tile is needed.
typedef struct DipTileRegion {
    uint8_t x0, y0, x1, y1;
} DipTileRegion;

#ifdef __cplusplus
}
#endif

#endif
