// Mip chains: the area-weighted box filter that halves a level, exact for odd sizes.
//
// A row of a level that is being built is four runs of floats: red, green, blue in linear light,
// alpha; so that loops run along a row.
#ifndef DIP_RENDERER_PIPELINE_TEXTURE_MIP_H
#define DIP_RENDERER_PIPELINE_TEXTURE_MIP_H

enum { DIP_MIP_CHANNELS = 4, DIP_MIP_MAX_TAPS = 3 };

// size / 2, at least 1.
int dip_mip_next_size(int size);

// The source texels that texel i of the next level covers along one axis, and their shares.
typedef struct DipMipTap {
    int first;
    int count;
    float weight[DIP_MIP_MAX_TAPS];
} DipMipTap;

DipMipTap dip_mip_tap(int i, int size, int next);

// One row of the next level, next_width texels, from the rows that its tap names (of width texels
// each).
void dip_mip_halve_row(const DipMipTap *tap, const float *const rows[DIP_MIP_MAX_TAPS], int width,
                       float *to, int next_width);

// A level: rows as above, one after the other.
typedef struct DipMipLevel {
    int width;
    int height;
    float *rows;
} DipMipLevel;

// to has the next sizes and room for 4 * width * height floats.
void dip_mip_halve(const DipMipLevel *from, DipMipLevel *to);

#endif
