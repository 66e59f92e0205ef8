// Writes the samples of a tile to a readback. Each pixel belongs to one tile, so threads never
// write the same entry.
#include "renderer/pipeline/resolve/readback.h"

static bool holds(const DipTargetRegion *region, int x, int y) {
    return x >= region->x0 && x < region->x1 && y >= region->y0 && y < region->y1;
}

static int smaller(int a, int b) {
    return a < b ? a : b;
}

static int larger(int a, int b) {
    return a > b ? a : b;
}

void dip_readback_begin(const DipSampleReadback *readback, const DipTileShading *shading) {
    const DipTargetRegion *region = &readback->region;
    const DipTile *tile = shading->tile;
    DipSampleValue background = {.patch = 0};
    for (int c = 0; c < 3; c++) {
        background.linear16[c] = (uint16_t)shading->clear_linear16[c];
    }
    const int x1 = smaller(region->x1, tile->x0 + DIP_TILE);
    const int y1 = smaller(region->y1, tile->y0 + DIP_TILE);
    for (int y = larger(region->y0, tile->y0); y < y1; y++) {
        for (int x = larger(region->x0, tile->x0); x < x1; x++) {
            DipSampleValue *samples = readback->samples + dip_sample_index(region, x, y);
            for (int s = 0; s < tile->pattern->count; s++) {
                samples[s] = background;
            }
        }
    }
}

// Returns the index, in the tile's depths, of sample 0 of a pixel of the tile.
static int depth_index(const DipTile *tile, int x, int y) {
    const int block = y / DIP_BLOCK * DIP_TILE_BLOCKS + x / DIP_BLOCK;
    const int quarter = y % DIP_BLOCK / DIP_SUB_BLOCK * 2 + x % DIP_BLOCK / DIP_SUB_BLOCK;
    return dip_tile_index(tile, block, 0) + quarter * DIP_SUB_BLOCK_PIXELS +
           y % DIP_SUB_BLOCK * DIP_SUB_BLOCK + x % DIP_SUB_BLOCK;
}

void dip_readback_fragments(const DipSampleReadback *readback, const DipTileShading *shading,
                            const DipFragmentList *list, int count, bool whole,
                            const DipEncodedBatch *encoded) {
    const DipTile *tile = shading->tile;
    const unsigned all = (1u << tile->pattern->count) - 1;
    for (int i = 0; i < count; i++) {
        const int pixel = (int)(list->position[i] & DIP_POSITION_PIXEL);
        const int x = pixel % DIP_TILE;
        const int y = pixel / DIP_TILE;
        if (!holds(&readback->region, tile->x0 + x, tile->y0 + y)) {
            continue;
        }
        DipSampleValue *samples =
            readback->samples + dip_sample_index(&readback->region, tile->x0 + x, tile->y0 + y);
        const float *depth = tile->depth + depth_index(tile, x, y);
        for (unsigned left = whole ? all : list->samples[i]; left; left &= left - 1) {
            const int s = __builtin_ctz(left);
            samples[s].patch = shading->input.triangles[list->triangle[i]].patch;
            samples[s].depth = depth[s * DIP_BLOCK_PIXELS];
            for (int c = 0; c < 3; c++) {
                samples[s].linear16[c] = (uint16_t)encoded->linear16[c][i];
            }
        }
    }
}
