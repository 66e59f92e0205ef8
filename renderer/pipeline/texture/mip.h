// Mip chains: the area-weighted box filter that computes each level from the level before. The
// filter is exact for odd sizes too.
//
// While a level is being built, each of its rows consists of four runs of floats: red, green and
// blue in linear light, then alpha. Loops therefore run along contiguous floats.
#ifndef DIP_RENDERER_PIPELINE_TEXTURE_MIP_H
#define DIP_RENDERER_PIPELINE_TEXTURE_MIP_H

enum { DIP_MIP_CHANNELS = 4, DIP_MIP_MAX_TAPS = 3 };

// Returns the next level's size along one axis: size / 2, but at least 1.
int dip_mip_next_size(int size);

// A tap: the source texels that one texel of the next level covers along one axis, and their
// weights.
typedef struct DipMipTap {
    int first;
    int count;
    float weight[DIP_MIP_MAX_TAPS];
} DipMipTap;

// Returns the tap of texel i of the next level. size: source size along the axis. next: the next
// level's size along the axis.
DipMipTap dip_mip_tap(int i, int size, int next);

// Computes one row of the next level, which has next_width texels. rows: the source rows of the
// tap, each with `width` texels.
void dip_mip_halve_row(const DipMipTap *tap, const float *const rows[DIP_MIP_MAX_TAPS], int width,
                       float *to, int next_width);

// A level that is being built. Its rows follow one another.
typedef struct DipMipLevel {
    int width;
    int height;
    float *rows;
} DipMipLevel;

// Computes the next level. Before the call, the caller sets the width and height of `to` to the
// next level's size, and allocates 4 * width * height floats for its rows.
void dip_mip_halve(const DipMipLevel *from, DipMipLevel *to);

#endif
