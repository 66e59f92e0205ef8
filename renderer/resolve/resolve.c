// Storing and averaging fragments. All sums are integers, so their order cannot matter.
#include "renderer/resolve/resolve.h"

static uint32_t *pixel_at(const DipTileShading *shading, int pixel) {
    return shading->pixels + (size_t)(pixel / DIP_TILE) * shading->stride +
           (size_t)(pixel % DIP_TILE);
}

void dip_store_fragments(DipTileShading *shading, const DipFragmentList *list,
                         const DipEncodedBatch *encoded) {
    const unsigned all = (1u << shading->tile->pattern->count) - 1;
    for (int i = 0; i < list->count; i++) {
        const int pixel = list->pixel[i];
        if (list->samples[i] == all) {
            *pixel_at(shading, pixel) = encoded->rgba8[i];
            continue;
        }
        const int weight = __builtin_popcount(list->samples[i]);
        for (int c = 0; c < 3; c++) {
            shading->sum[pixel][c] += encoded->linear16[c][i] * weight;
        }
    }
}

void dip_resolve_mixed(DipTileShading *shading, const uint8_t *srgb_code) {
    const int count = shading->tile->pattern->count;
    for (int i = 0; i < shading->mixed_count; i++) {
        const int pixel = shading->mixed[i];
        uint32_t rgba8 = 0xff000000u;
        for (int c = 0; c < 3; c++) {
            rgba8 |= (uint32_t)srgb_code[(shading->sum[pixel][c] + count / 2) / count] << (8 * c);
        }
        *pixel_at(shading, pixel) = rgba8;
    }
}
