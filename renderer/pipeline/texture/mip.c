// Area-weighted box filtering from one mip level to the next.
#include "renderer/pipeline/texture/mip.h"

#include <stddef.h>

int dip_mip_next_size(int size) {
    return size > 1 ? size / 2 : 1;
}

// If the source's size n = 2m + 1 is odd, texel i of the next level spans [i n / m, (i + 1) n / m)
// of the source. This range contains the fraction 1 - i / m of source texel 2i, the whole of texel
// 2i + 1, and the fraction (i + 1) / m of texel 2i + 2.
DipMipTap dip_mip_tap(int i, int size, int next) {
    if (size == next) {
        return (DipMipTap){i, 1, {1.0f, 0.0f, 0.0f}};
    }
    if (size == 2 * next) {
        return (DipMipTap){2 * i, 2, {0.5f, 0.5f, 0.0f}};
    }
    const double n = size;
    return (DipMipTap){
        2 * i, 3, {(float)((next - i) / n), (float)(next / n), (float)((i + 1) / n)}};
}

// Computes a row of the next level in the usual case of even sizes. The additions have the same
// order as in `weigh`, so the results are the same to the bit.
static void halve_evenly(const float *upper, const float *lower, float *restrict to,
                         int next_width) {
    for (int x = 0; x < next_width; x++) {
        to[x] = ((0.25f * upper[2 * x] + 0.25f * upper[2 * x + 1]) + 0.25f * lower[2 * x]) +
                0.25f * lower[2 * x + 1];
    }
}

static float weigh(const DipMipTap *row, const DipMipTap *column,
                   const float *const rows[DIP_MIP_MAX_TAPS], int run) {
    float sum = 0.0f;
    for (int j = 0; j < row->count; j++) {
        const float *texel = rows[j] + run + column->first;
        for (int i = 0; i < column->count; i++) {
            sum += row->weight[j] * column->weight[i] * texel[i];
        }
    }
    return sum;
}

void dip_mip_halve_row(const DipMipTap *tap, const float *const rows[DIP_MIP_MAX_TAPS], int width,
                       float *to, int next_width) {
    if (tap->count == 2 && width == 2 * next_width) {
        for (int c = 0; c < DIP_MIP_CHANNELS; c++) {
            halve_evenly(rows[0] + c * width, rows[1] + c * width, to + c * next_width, next_width);
        }
        return;
    }
    for (int x = 0; x < next_width; x++) {
        const DipMipTap column = dip_mip_tap(x, width, next_width);
        for (int c = 0; c < DIP_MIP_CHANNELS; c++) {
            to[c * next_width + x] = weigh(tap, &column, rows, c * width);
        }
    }
}

void dip_mip_halve(const DipMipLevel *from, DipMipLevel *to) {
    const size_t from_floats = (size_t)DIP_MIP_CHANNELS * (size_t)from->width;
    const size_t to_floats = (size_t)DIP_MIP_CHANNELS * (size_t)to->width;
    for (int y = 0; y < to->height; y++) {
        const DipMipTap tap = dip_mip_tap(y, from->height, to->height);
        const float *rows[DIP_MIP_MAX_TAPS] = {0};
        for (int i = 0; i < tap.count; i++) {
            rows[i] = from->rows + (size_t)(tap.first + i) * from_floats;
        }
        dip_mip_halve_row(&tap, rows, from->width, to->rows + (size_t)y * to_floats, to->width);
    }
}
