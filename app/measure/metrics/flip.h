// Computes FLIP: how different two pictures look to a viewer who alternates between them, as a
// value in 0..1 for each pixel. This is LDR-FLIP 1.6 (Andersson, Nilsson, Akenine-Moller,
// Oskarsson, Astrom, Fairchild, "FLIP: A Difference Evaluator for Alternating Images", 2020).
//
// Each picture is analysed on its own, so that a picture is filtered once and can be compared with
// many others. The work is done in blocks (picture.h). Each block is filtered with a margin as
// wide as the filters reach, so its pixels get the same bits as if the whole picture were
// filtered at once. A DipFlip is not thread-safe; use one per thread.
#ifndef DIP_APP_MEASURE_METRICS_FLIP_H
#define DIP_APP_MEASURE_METRICS_FLIP_H

#include "renderer/base/api.h"
#include "app/measure/metrics/picture.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// Resolutions at which a picture is seen: the usual value and the limits. The usual value belongs
// to a screen 0.7 m and 3840 pixels wide, seen from a distance of 0.7 m.
#define DIP_FLIP_PIXELS_PER_DEGREE     67.0206451
#define DIP_FLIP_MIN_PIXELS_PER_DEGREE 5.0
#define DIP_FLIP_MAX_PIXELS_PER_DEGREE 500.0

// Filters and scratch memory for pictures of one size at one viewing distance.
typedef struct DipFlip {
    struct DipFlipKernels *kernels; // Owned.
    int width;
    int height;
    int reach_px;     // Greatest distance, along x or y, at which a pixel influences another pixel.
    float *scratch;   // Owned; memory for filtering one block with its margin.
    float light[256]; // Linear light of each 8-bit sRGB value.
} DipFlip;

// The result of analysing a picture. Each plane has width * height values.
typedef struct DipFlipAnalysis {
    // L*, a* and b* as the eye resolves them, with Hunt's effect; then edges in x and y; then
    // points in x and y.
    float *planes[7];
    float *memory; // Owned; holds all planes.
} DipFlipAnalysis;

// Create a DipFlip and an analysis. Both functions return false when memory runs out, and
// dip_flip_init also if width or height is below 1 or pixels_per_degree lies outside
// DIP_FLIP_MIN_PIXELS_PER_DEGREE..DIP_FLIP_MAX_PIXELS_PER_DEGREE. Even then, the caller must free
// the object.
DIP_API bool dip_flip_init(DipFlip *flip, int width, int height, double pixels_per_degree);
DIP_API bool dip_flip_analysis_init(const DipFlip *flip, DipFlipAnalysis *analysis);
DIP_API void dip_flip_free(DipFlip *flip);
DIP_API void dip_flip_analysis_free(DipFlipAnalysis *analysis);

// Analyses a picture, which must have the size that dip_flip_init received, or a block of it.
DIP_API void dip_flip_analyse(DipFlip *flip, const DipSrgbPicture *picture,
                              DipFlipAnalysis *analysis);
DIP_API void dip_flip_analyse_block(DipFlip *flip, const DipSrgbPicture *picture, int block,
                                    DipFlipAnalysis *analysis);

// Compares a picture, or a block of it, with the analysed picture `with`. Writes the FLIP value of
// each pixel to `map`, which has width * height values. The value is 0 where the pictures look the
// same. Exchanging the two pictures does not change the values.
DIP_API void dip_flip_compare(DipFlip *flip, const DipSrgbPicture *picture,
                              const DipFlipAnalysis *with, float *map);
DIP_API void dip_flip_compare_block(DipFlip *flip, const DipSrgbPicture *picture, int block,
                                    const DipFlipAnalysis *with, float *map);

// Writes the sRGB colour in which maps show a FLIP value in 0..1: from black over purple and orange
// to light yellow. Values outside 0..1 are clamped; NaN is shown as 0. Thread-safe.
DIP_API void dip_magma(float error, uint8_t rgb[3]);

#ifdef __cplusplus
}
#endif

#endif
