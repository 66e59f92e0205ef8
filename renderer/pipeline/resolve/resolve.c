// Stores the fragment of each pixel that has only one fragment, and averages the fragments of the
// other pixels. All sums are integers, so the order of fragments does not matter.
#include "renderer/pipeline/resolve/resolve.h"

#include <string.h>

static uint32_t *pixel_at(const DipTileShading *shading, uint32_t pixel) {
    return shading->pixels + (size_t)(pixel / DIP_TILE) * shading->stride +
           (size_t)(pixel % DIP_TILE);
}

// Stores the light of a list of whole sub-blocks.
static void store_whole_light16(const DipTileShading *shading, const DipFragmentList *list,
                                const DipEncodedBatch *encoded) {
    for (int i = 0; i < list->count; i += 16) {
        for (int c = 0; c < 3; c++) {
            const int32_t *from = encoded->linear16[c] + i;
            uint16_t *to =
                shading->light16 + c * DIP_TILE_PIXELS + (list->position[i] & DIP_POSITION_PIXEL);
            uint16_t light[16];
            for (int k = 0; k < 16; k++) {
                light[k] = (uint16_t)from[k];
            }
            for (int y = 0; y < 4; y++) {
                memcpy(to + y * DIP_TILE, light + 4 * y, 4 * sizeof *to);
            }
        }
    }
}

void dip_store_whole(DipTileShading *shading, const DipFragmentList *list,
                     const DipEncodedBatch *encoded) {
    if (shading->light16) {
        store_whole_light16(shading, list, encoded);
        return;
    }
    for (int i = 0; i < list->count; i += 16) {
        uint32_t *row = pixel_at(shading, list->position[i] & DIP_POSITION_PIXEL);
        for (int y = 0; y < 4; y++, row += shading->stride) {
            memcpy(row, encoded->rgba8 + i + 4 * y, 4 * sizeof *row);
        }
    }
}

void dip_store_fragments(DipTileShading *shading, const DipFragmentList *list, int count,
                         const DipEncodedBatch *encoded) {
    static const int bits_of[16] = {0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};
    const unsigned all = (1u << shading->tile->pattern->count) - 1;
    for (int i = 0; i < count; i++) {
        const uint32_t pixel = list->position[i] & DIP_POSITION_PIXEL;
        if (list->samples[i] == all && shading->light16) {
            dip_store_light16(shading, pixel, encoded->linear16[0][i], encoded->linear16[1][i],
                              encoded->linear16[2][i]);
            continue;
        }
        if (list->samples[i] == all) {
            *pixel_at(shading, pixel) = encoded->rgba8[i];
            continue;
        }
        const int weight = bits_of[list->samples[i] & 15] + bits_of[list->samples[i] >> 4];
        for (int c = 0; c < 3; c++) {
            shading->sum[pixel][c] += encoded->linear16[c][i] * weight;
        }
    }
}

void dip_resolve_multi_fragment(DipTileShading *shading, const DipSrgbEncodeTable *srgb) {
    const int count = shading->tile->pattern->count;
    for (int i = 0; i < shading->multi_fragment_count; i++) {
        const uint32_t pixel = shading->multi_fragment[i];
        int32_t mean[3];
        for (int c = 0; c < 3; c++) {
            mean[c] = (shading->sum[pixel][c] + count / 2) / count;
        }
        if (shading->light16) {
            dip_store_light16(shading, pixel, mean[0], mean[1], mean[2]);
            continue;
        }
        uint32_t rgba8 = 0xff000000u;
        for (int c = 0; c < 3; c++) {
            rgba8 |= (uint32_t)dip_srgb_code(srgb, mean[c]) << (8 * c);
        }
        *pixel_at(shading, pixel) = rgba8;
    }
}
