// Mip chains: the area-weighted box filter that halves a level, exact for odd sizes.
#ifndef DIP_RENDERER_TEXTURE_MIP_H
#define DIP_RENDERER_TEXTURE_MIP_H

// A level while it is being built: 4 floats per texel, linear light and alpha, rows packed.
typedef struct DipMipLevel {
    int width;
    int height;
    float *rgba;
} DipMipLevel;

// size / 2, at least 1.
int dip_mip_next_size(int size);

// to has the next sizes and room for width * height * 4 floats.
void dip_mip_halve(const DipMipLevel *from, DipMipLevel *to);

#endif
