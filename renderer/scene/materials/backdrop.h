// The picture of what lies behind rough glass, in the form that the shader of such surfaces reads.
// docs/picture.md, Transmission, defines the levels.
#ifndef DIP_RENDERER_SCENE_MATERIALS_BACKDROP_H
#define DIP_RENDERER_SCENE_MATERIALS_BACKDROP_H

#include <stddef.h>
#include <stdint.h>

enum { DIP_BACKDROP_LEVELS = 14 }; // a picture of DIP_MAX_TARGET_SIZE pixels has as many

// Level 0 is the picture, and level k has its width and height divided by 2^k, rounded down to 1 or
// more. A texel has three channels of 16-bit linear light in two words: red and green in the low
// and the high half of the first, and blue in the second.
typedef struct DipBackdrop {
    int32_t *texels;
    int count;                           // levels; the last one has 1x1 texels
    int32_t first[DIP_BACKDROP_LEVELS];  // index of the level's first texel
    int32_t width[DIP_BACKDROP_LEVELS];  // in texels
    int32_t height[DIP_BACKDROP_LEVELS]; // in texels
    float across[DIP_BACKDROP_LEVELS];   // texels of the level per pixel of the picture
    float down[DIP_BACKDROP_LEVELS];
    // A surface of roughness r reads the level least_level + r * level_range, bounded by the first
    // and the last level.
    float least_level;
    float level_range;
} DipBackdrop;

// The blur of rough glass is that of a picture of this width whose levels glass of roughness r
// reads at log2(width) * r. So it has the same share of every picture's width.
#define DIP_BACKDROP_WIDTH 5120

// Sets all members except `texels` for a picture of width x height pixels.
void dip_backdrop_lay_out(DipBackdrop *levels, int width, int height);

// Returns the number of texels of all levels.
size_t dip_backdrop_texels(const DipBackdrop *levels);

// Returns how many pixels around its own position a fragment of a surface of this roughness, 0..1,
// may read, in a picture of this size.
int dip_backdrop_margin(int width, int height, double roughness);

#endif
