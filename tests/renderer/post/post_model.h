// Plain models of the filters, in double precision, pixel by pixel and without tables. They follow
// the published descriptions and share no code with renderer/post/.
#ifndef TESTS_RENDERER_POST_POST_MODEL_H
#define TESTS_RENDERER_POST_POST_MODEL_H

#include <stdint.h>

// A picture of packed 8-bit RGBA pixels. Reading beyond a border gives the nearest pixel.
typedef struct ModelPicture {
    const uint8_t *rgba8;
    int width;
    int height;
} ModelPicture;

// The colour that a filter gives a pixel, in codes 0..255, not rounded.
typedef struct ModelColour {
    double rgb[3];
} ModelColour;

// Four decisions compare two sums, and where both are equal, rounding decides. `ties` says in its
// bits 0 to 3 how each decision is taken then, so that a test can try all sixteen ways.
ModelColour model_fxaa(const ModelPicture *picture, int ties, int x, int y);
ModelColour model_sharpen(const ModelPicture *picture, double sharpness, int x, int y);
// The result is to_width x to_height pixels large.
ModelColour model_bilinear(const ModelPicture *picture, int to_width, int to_height, int x, int y);
ModelColour model_bicubic(const ModelPicture *picture, int to_width, int to_height, int x, int y);
ModelColour model_easu(const ModelPicture *picture, int to_width, int to_height, int x, int y);

#endif
