// LDR-FLIP (Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild 2020): how different
// two pictures look when one flips between them, 0..1 per pixel.
//
// Each picture is taken in on its own, so that a truth that many pictures are compared with is
// filtered once. Not thread-safe on one DipFlip; several may be used side by side.
#ifndef DIP_APP_MEASURE_FLIP_H
#define DIP_APP_MEASURE_FLIP_H

#include "app/measure/convolve.h"
#include "app/measure/picture.h"

#include <stdbool.h>

// Of a screen 0.7 m wide with 3840 pixels, seen from 0.7 m.
#define DIP_FLIP_PIXELS_PER_DEGREE     67.0206451
#define DIP_FLIP_MIN_PIXELS_PER_DEGREE 5.0
#define DIP_FLIP_MAX_PIXELS_PER_DEGREE 500.0

// The filters of one number of pixels per degree.
typedef struct DipFlipKernels {
    DipKernel1D luma;      // contrast sensitivity: Y
    DipKernel1D red_green; // Cx
    DipKernel1D blue[2];   // Cz, whose two passes are added
    DipKernel1D gauss;     // of the features
    DipKernel1D edge;
    DipKernel1D point;
} DipFlipKernels;

DipFlipKernels dip_flip_kernels(double pixels_per_degree);

// What is kept of a picture: CIELab after the eye's filter, with Hunt's effect, and features.
typedef struct DipFlipSide {
    float *planes[7]; // L, a, b, edges in x and y, points in x and y
    float *memory;
} DipFlipSide;

typedef struct DipFlip {
    DipFlipKernels kernels;
    int width;
    int height;
    float *scratch;
    float light[256]; // linear light of the codes
} DipFlip;

// False when memory runs out.
bool dip_flip_init(DipFlip *flip, int width, int height, double pixels_per_degree);
void dip_flip_free(DipFlip *flip);
bool dip_flip_side_init(const DipFlip *flip, DipFlipSide *side);
void dip_flip_side_free(DipFlipSide *side);

// Takes in a picture of the size that the DipFlip was made for.
void dip_flip_take(DipFlip *flip, const DipPicture *picture, DipFlipSide *side);

// map: width * height values, 0 where the pictures look the same.
void dip_flip_compare(const DipFlip *flip, const DipFlipSide *a, const DipFlipSide *b, float *map);

#endif
