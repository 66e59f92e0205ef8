// Comparing a drawn frame with the picture it should be.
#ifndef DIP_TESTS_RENDERER_SCENE_IMAGE_H
#define DIP_TESTS_RENDERER_SCENE_IMAGE_H

#include "renderer/scene/frame.h"

#include <stdbool.h>
#include <stddef.h>

// Errors are in linear light, 0..1; a pixel's error is the greatest of its channels.
typedef struct DipImageError {
    double rms_lin;
    double mean_lin; // of the absolute differences
    double max_lin;
    double psnr_db;    // on sRGB codes; infinite for equal pictures
    size_t over_count; // pixels with more than pixel_lin
    int first_x;       // of these, in reading order; -1 for none
    int first_y;
} DipImageError;

// rgb_lin: expected, width*height*3, not encoded. The frame's bytes are decoded.
DipImageError dip_image_compare(const double *rgb_lin, const DipFrame *frame, double pixel_lin);

// Of two pictures in linear light.
double dip_image_rms(const double *a, const double *b, size_t value_count);

typedef struct DipImageBounds {
    double rms_lin;
    double pixel_lin;    // a pixel may be off by this much,
    double over_share;   // and this share of the pixels by more,
    double over_max_lin; // but none by more than this
} DipImageBounds;

// Whether the frame keeps the bounds. If not, says how many pixels are over, the first of them and
// both its colours, and writes <name>_expected.png, _got.png and _difference.png (absolute
// difference in linear light, 16 times) to the working folder.
bool dip_image_check(const char *name, const double *rgb_lin, const DipFrame *frame,
                     const DipImageBounds *bounds);

#endif
