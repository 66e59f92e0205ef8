// Area-weighted box filtering from one mip level to the next.
#include "renderer/texture/mip.h"

#include <stddef.h>

int dip_mip_next_size(int size) {
    return size > 1 ? size / 2 : 1;
}

// The source texels that target texel i covers along one axis, and their shares. Of an odd size
// n = 2m + 1, target texel i spans [i n / m, (i + 1) n / m): two whole texels and two ends, of
// which one may be empty, in all at most three texels.
typedef struct Tap {
    int first;
    int count;
    float weight[3];
} Tap;

static Tap tap_at(int i, int size, int next) {
    if (size == next) {
        return (Tap){i, 1, {1.0f, 0.0f, 0.0f}};
    }
    if (size == 2 * next) {
        return (Tap){2 * i, 2, {0.5f, 0.5f, 0.0f}};
    }
    const double n = size;
    return (Tap){2 * i, 3, {(float)((next - i) / n), (float)(next / n), (float)((i + 1) / n)}};
}

void dip_mip_halve(const DipMipLevel *from, DipMipLevel *to) {
    for (int y = 0; y < to->height; y++) {
        const Tap row = tap_at(y, from->height, to->height);
        for (int x = 0; x < to->width; x++) {
            const Tap column = tap_at(x, from->width, to->width);
            float sum[4] = {0};
            for (int j = 0; j < row.count; j++) {
                const float *texel =
                    from->rgba +
                    4 * ((size_t)(row.first + j) * (size_t)from->width + (size_t)column.first);
                for (int i = 0; i < column.count; i++) {
                    const float weight = row.weight[j] * column.weight[i];
                    for (int c = 0; c < 4; c++) {
                        sum[c] += weight * texel[4 * i + c];
                    }
                }
            }
            float *out = to->rgba + 4 * ((size_t)y * (size_t)to->width + (size_t)x);
            for (int c = 0; c < 4; c++) {
                out[c] = sum[c];
            }
        }
    }
}
