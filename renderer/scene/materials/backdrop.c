// Lays out the levels of a backdrop, and tells which of them a roughness reads.
#include "renderer/scene/materials/backdrop.h"

#include <stdbool.h>

// Returns log2 of a whole number from 1 on, exact to 2^-40, with + - * / alone: squaring a number
// of 1 to 2 doubles its logarithm, of which each step finds a binary digit.
static double log2_of(int number) {
    double rest = number;
    double sum = 0.0;
    double digit = 1.0;
    for (; rest >= 2.0; rest *= 0.5) {
        sum += 1.0;
    }
    for (int i = 0; i < 44; i++) {
        rest *= rest;
        digit *= 0.5;
        if (rest >= 2.0) {
            rest *= 0.5;
            sum += digit;
        }
    }
    return sum;
}

static double least_level(int width) {
    return log2_of(width) - log2_of(DIP_BACKDROP_WIDTH);
}

static int size_of(int size, int level) {
    return size >> level > 1 ? size >> level : 1;
}

void dip_backdrop_lay_out(DipBackdrop *levels, int width, int height) {
    int texels = 0;
    bool last = false;
    for (int k = 0; !last; k++) {
        levels->first[k] = texels;
        levels->width[k] = size_of(width, k);
        levels->height[k] = size_of(height, k);
        levels->across[k] = (float)levels->width[k] / (float)width;
        levels->down[k] = (float)levels->height[k] / (float)height;
        levels->count = k + 1;
        texels += levels->width[k] * levels->height[k];
        last = levels->width[k] == 1 && levels->height[k] == 1;
    }
    levels->least_level = (float)least_level(width);
    levels->level_range = (float)log2_of(DIP_BACKDROP_WIDTH);
}

size_t dip_backdrop_texels(const DipBackdrop *levels) {
    const int last = levels->count - 1;
    return levels->count ? (size_t)levels->first[last] + 1 : 0;
}

static int texel_size(int size, int level) {
    const int texels = size_of(size, level);
    return (size + texels - 1) / texels;
}

// A read uses two levels, and in the coarser one up to 2.5 texels on each side. Where sizes are
// odd, a texel also has a part of what lies beside it, over less than its own size. Two more pixels
// allow for rounding.
int dip_backdrop_margin(int width, int height, double roughness) {
    const double level = least_level(width) + log2_of(DIP_BACKDROP_WIDTH) * roughness;
    int coarser = 1;
    while (coarser < DIP_BACKDROP_LEVELS - 1 && level >= coarser) {
        coarser++;
    }
    const int across = texel_size(width, coarser);
    const int down = texel_size(height, coarser);
    return 4 * (across > down ? across : down) + 2;
}
