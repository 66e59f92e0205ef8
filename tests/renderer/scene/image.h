// Reads the pixels of a drawn frame, and compares them with the picture that is expected.
#ifndef DIP_TESTS_RENDERER_SCENE_IMAGE_H
#define DIP_TESTS_RENDERER_SCENE_IMAGE_H

#include "renderer/scene/frame.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Returns the four bytes of a pixel of a frame.
const uint8_t *dip_image_pixel(const DipFrame *frame, int x, int y);

// Returns the four bytes of the pixel whose top left corner is the middle of a frame of even size.
const uint8_t *dip_image_centre(const DipFrame *frame);

// Copies a frame's pixels without gaps between the rows: width * height * 4 bytes.
void dip_image_copy(const DipFrame *frame, void *rgba8);

// The error of a frame. Errors are in linear light, 0..1. The error of a pixel is the greatest
// error of its channels.
typedef struct DipImageError {
    double rms_lin;
    double mean_lin; // mean absolute difference
    double max_lin;
    double psnr_db;    // PSNR of the 8-bit sRGB values; infinite if the pictures are equal
    size_t over_count; // number of pixels whose error is greater than pixel_lin
    int first_x; // position of the first of these pixels in reading order; -1 if there is none
    int first_y;
} DipImageError;

// Compares a frame with the expected picture. The frame's bytes are decoded to linear light.
// rgb_lin has width * height * 3 values in linear light.
DipImageError dip_image_compare(const double *rgb_lin, const DipFrame *frame, double pixel_lin);

// Returns the RMS difference of two pictures in linear light.
double dip_image_rms(const double *a, const double *b, size_t value_count);

typedef struct DipImageBounds {
    double rms_lin;
    double pixel_lin;    // the bound for the error of a pixel
    double over_share;   // the share of pixels that may exceed pixel_lin
    double over_max_lin; // greatest allowed error of the pixels that exceed pixel_lin
} DipImageBounds;

// Returns true if the frame's errors stay within the bounds. Otherwise prints the number of pixels
// whose error exceeds pixel_lin, and the expected and the actual colour of the first of them. In
// this case, it also writes <name>_expected.png, <name>_got.png and <name>_difference.png (16 times
// the absolute difference in linear light) to the working folder.
bool dip_image_check(const char *name, const double *rgb_lin, const DipFrame *frame,
                     const DipImageBounds *bounds);

#endif
