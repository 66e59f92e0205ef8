// Private to the reference renderer and its tests: decoded mip chains, and how they are read.
#ifndef DIP_RENDERER_REFERENCE_INTERNAL_TEXTURE_H
#define DIP_RENDERER_REFERENCE_INTERNAL_TEXTURE_H

#include "renderer/base/error.h"
#include "renderer/scene/quality.h"
#include "renderer/scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

enum { DIP_REF_MAX_LEVELS = 14 }; // levels of 8192 texels down to 1

// A mip chain. Level 0 stays in the description's bytes and is decoded when it is read, unless the
// texels are rounded (differences.h). The other levels hold means of decoded texels.
typedef struct DipRefTexture {
    const DipTextureDef *def;            // borrowed
    double decode[256];                  // linear light of each colour byte
    double *levels[DIP_REF_MAX_LEVELS];  // r, g, b, a of each texel; levels[0] may be NULL
    uint8_t *blocks[DIP_REF_MAX_LEVELS]; // BC1 blocks, row by row; NULL if not compressed
    int widths[DIP_REF_MAX_LEVELS];      // in texels
    int heights[DIP_REF_MAX_LEVELS];
    int level_count;
    bool rounded;    // texels are rounded as the fast renderer's (differences.h)
    double shift[3]; // is added to the colour of every reading
} DipRefTexture;

// How a texture is filtered. docs/picture.md, "Textures", explains the settings.
typedef struct DipRefFilter {
    int max_anisotropy; // 1: trilinear
    bool exact_footprint;
    double bias;       // of miplod and of a scale below 1
    double scale_bias; // the part of it that comes from the scale
    bool drop_levels;  // leave out the largest levels, by the texture's size
    bool mip_colours;  // show each level in one colour instead of the texels' colours
    bool compressed;   // show the colours of the texture's BC1 blocks
    bool cheap;        // use a narrow blend of levels and half the probes
} DipRefFilter;

// Decodes sRGB: converts an encoded value, 0..1, to linear light, 0..1.
double dip_reference_decode_srgb(double code);
double dip_reference_encode_srgb(double linear);

// Builds the mip chain of *def, which is borrowed. The chain has at most most_levels levels.
bool dip_reference_texture_init(DipRefTexture *texture, const DipTextureDef *def, int most_levels,
                                DipError *err);
void dip_reference_texture_free(DipRefTexture *texture);

// Reads one texel at indices within the level: r, g, b in linear light, and alpha.
static inline void dip_reference_texel(const DipRefTexture *texture, int level, int x, int y,
                                       double rgba[4]) {
    const size_t index = 4 * ((size_t)y * (size_t)texture->widths[level] + (size_t)x);
    if (texture->levels[level]) {
        memcpy(rgba, texture->levels[level] + index, 4 * sizeof *rgba);
        return;
    }
    const uint8_t *bytes = texture->def->rgba8 + index;
    for (int c = 0; c < 3; c++) {
        rgba[c] = texture->decode[bytes[c]];
    }
    rgba[3] = bytes[3] / 255.0;
}

// Encodes the BC1 blocks of every level.
bool dip_reference_texture_compress(DipRefTexture *texture, DipError *err);

// Reads one texel with the colour that its BC1 block shows; alpha is the texture's own.
void dip_reference_compressed_texel(const DipRefTexture *texture, int level, int x, int y,
                                    double rgba[4]);

// Decodes the colour of one texel of a block to linear light. x and y are 0..3.
void dip_reference_block_colour(const uint8_t block[8], int x, int y, double rgb[3]);

DipRefFilter dip_reference_colour_filter(const DipQuality *quality);
DipRefFilter dip_reference_light_map_filter(void);

// Returns the filter of a texture that holds data instead of colours: the colour texture's filter
// without mip colours and without compression.
DipRefFilter dip_reference_data_filter(const DipRefFilter *colour);

// Reads a texture at uv with the given derivatives of uv per pixel in x and y.
void dip_reference_sample(const DipRefTexture *texture, const DipRefFilter *filter,
                          const double uv[2], const double duv_dx[2], const double duv_dy[2],
                          double rgba[4]);

// Reads a texture as dip_reference_sample does, and finds how fast its alpha changes: |d alpha /
// dx|
// + |d alpha / dy| per pixel, the derivative of the weighted mean of the texels.
void dip_reference_sample_slope(const DipRefTexture *texture, const DipRefFilter *filter,
                                const double uv[2], const double duv_dx[2], const double duv_dy[2],
                                double rgba[4], double *slope);

// Reads level 0 bilinearly at unrounded coordinates, as the converged picture does.
void dip_reference_sample_finest(const DipRefTexture *texture, const double uv[2], double rgba[4]);

#endif
