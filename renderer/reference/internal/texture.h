// Private to the reference path (and its tests): decoded mip chains and how they are read.
#ifndef DIP_RENDERER_REFERENCE_INTERNAL_TEXTURE_H
#define DIP_RENDERER_REFERENCE_INTERNAL_TEXTURE_H

#include "renderer/base/error.h"
#include "renderer/scene/quality.h"
#include "renderer/scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

enum { DIP_REF_MAX_LEVELS = 14 }; // 8192 down to 1

// Level 0 stays in the description's bytes and is decoded when read; the others are decoded means.
typedef struct DipRefTexture {
    const DipTextureDef *def;            // borrowed
    double decode[256];                  // a colour byte to linear light
    double *levels[DIP_REF_MAX_LEVELS];  // r, g, b, a per texel; levels[0] is NULL
    uint8_t *blocks[DIP_REF_MAX_LEVELS]; // BC1, row by row; NULL where it is not compressed
    int widths[DIP_REF_MAX_LEVELS];      // texels
    int heights[DIP_REF_MAX_LEVELS];
    int level_count;
} DipRefTexture;

// How textures are read.
typedef struct DipRefFilter {
    int max_anisotropy; // 1: trilinear
    bool exact_footprint;
    double bias;
    bool drop_levels; // the largest levels are left out, by size
    bool mip_colours; // colour by level instead of the texels' own
    bool compressed;  // colours of the texture's blocks
    bool cheap;       // a narrow blend of levels, half the probes
} DipRefFilter;

// Inverse of the sRGB encoding: code 0..1 to linear light 0..1.
double dip_reference_decode_srgb(double code);
double dip_reference_encode_srgb(double linear);

// most_levels: the smaller ones are left out.
bool dip_reference_texture_init(DipRefTexture *texture, const DipTextureDef *def, int most_levels,
                                DipError *err);
void dip_reference_texture_free(DipRefTexture *texture);

// One texel, indices within the level; r, g, b in linear light, a.
static inline void dip_reference_texel(const DipRefTexture *texture, int level, int x, int y,
                                       double rgba[4]) {
    const size_t index = 4 * ((size_t)y * (size_t)texture->widths[level] + (size_t)x);
    if (level > 0) {
        memcpy(rgba, texture->levels[level] + index, 4 * sizeof *rgba);
        return;
    }
    const uint8_t *bytes = texture->def->rgba8 + index;
    for (int c = 0; c < 3; c++) {
        rgba[c] = texture->decode[bytes[c]];
    }
    rgba[3] = bytes[3] / 255.0;
}

// Makes the blocks of every level.
bool dip_reference_texture_compress(DipRefTexture *texture, DipError *err);

// The same texel as its block shows it; alpha is the texture's own.
void dip_reference_compressed_texel(const DipRefTexture *texture, int level, int x, int y,
                                    double rgba[4]);

// The colour of a block's texel, x and y 0..3, linear light.
void dip_reference_block_colour(const uint8_t block[8], int x, int y, double rgb[3]);

DipRefFilter dip_reference_colour_filter(const DipQuality *quality);
DipRefFilter dip_reference_light_map_filter(void);

// Of what is read as the colour texture is but holds no colours: no mip colours, no compression.
DipRefFilter dip_reference_data_filter(const DipRefFilter *colour);

// Reads at (u, v) with the derivatives of (u, v) per pixel in x and y.
void dip_reference_sample(const DipRefTexture *texture, const DipRefFilter *filter,
                          const double uv[2], const double duv_dx[2], const double duv_dy[2],
                          double rgba[4]);

// Bilinearly from level 0, the place not rounded: what the converged picture reads.
void dip_reference_sample_finest(const DipRefTexture *texture, const double uv[2], double rgba[4]);

#endif
