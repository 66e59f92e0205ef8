// LDR-FLIP 1.6 (Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild, "FLIP: A
// Difference Evaluator for Alternating Images", 2020): how different two pictures look when one
// alternates between them, 0..1 per pixel.
//
// Each picture is analysed on its own, so that a truth is filtered once and compared with many
// pictures. A DipFlip is not thread-safe; use one per thread.
#ifndef DIP_APP_MEASURE_FLIP_H
#define DIP_APP_MEASURE_FLIP_H

#include "app/measure/picture.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// The default is that of a screen 0.7 m wide with 3840 pixels, seen from 0.7 m.
#define DIP_FLIP_PIXELS_PER_DEGREE     67.0206451
#define DIP_FLIP_MIN_PIXELS_PER_DEGREE 5.0
#define DIP_FLIP_MAX_PIXELS_PER_DEGREE 500.0

// Filters and scratch memory for pictures of one size at one viewing distance.
typedef struct DipFlip {
    struct DipFlipKernels *kernels; // Owned.
    int width;
    int height;
    float *scratch;   // Owned.
    float light[256]; // Linear light of each sRGB code.
} DipFlip;

// What FLIP keeps of a picture. Planes have width * height values.
typedef struct DipFlipAnalysis {
    float *planes[7]; // L*, a*, b* as the eye resolves them, with Hunt's effect; edges in x and y;
                      // points in x and y.
    float *memory;    // Owned; holds all planes.
} DipFlipAnalysis;

// pixels_per_degree: DIP_FLIP_MIN_PIXELS_PER_DEGREE..DIP_FLIP_MAX_PIXELS_PER_DEGREE. Both functions
// return false when memory runs out. Free in either case.
bool dip_flip_init(DipFlip *flip, int width, int height, double pixels_per_degree);
bool dip_flip_analysis_init(const DipFlip *flip, DipFlipAnalysis *analysis);
void dip_flip_free(DipFlip *flip);
void dip_flip_analysis_free(DipFlipAnalysis *analysis);

// Analyses a picture of the size that the DipFlip was made for.
void dip_flip_analyse(DipFlip *flip, const DipSrgbPicture *picture, DipFlipAnalysis *analysis);

// Writes width * height values; 0 where the pictures look the same. FLIP is symmetric.
void dip_flip_compare(const DipFlip *flip, const DipFlipAnalysis *a, const DipFlipAnalysis *b,
                      float *map);

// The greatest distance in pixels, along x or y, at which a pixel influences FLIP's value.
int dip_flip_reach_px(double pixels_per_degree);

#ifdef __cplusplus
}
#endif

#endif
