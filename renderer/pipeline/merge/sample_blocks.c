// Moves colours between the blocks of a tile and a DipSamples. A sub-block that is not split moves
// the values of one sample, so pictures without edges cost little memory traffic.
#include "renderer/pipeline/merge/sample_blocks.h"

#include <string.h>

enum { SUB_BLOCKS = DIP_BLOCK_PIXELS / DIP_SUB_BLOCK_PIXELS, ALL_PIXELS = 0xffff };

// A sub-block of a tile, and its place in a DipSamples.
typedef struct Place {
    int number;  // dip_sub_block_number
    int in_tile; // index of its first value of sample 0 in a channel of the tile
    size_t held; // its block in the DipSamples
    int quarter; // 0..3, within that block
} Place;

static inline Place place_of(const DipSamples *samples, const DipTile *tile, int block,
                             int quarter) {
    const int x = tile->x0 + block % DIP_TILE_BLOCKS * DIP_BLOCK;
    const int y = tile->y0 + block / DIP_TILE_BLOCKS * DIP_BLOCK;
    return (Place){.number = block * SUB_BLOCKS + quarter,
                   .in_tile = dip_tile_index(tile, block, 0) + quarter * DIP_SUB_BLOCK_PIXELS,
                   .held = dip_samples_block(samples, x, y),
                   .quarter = quarter};
}

// Returns the sub-block's 16 values of one channel and sample in the DipSamples.
static inline float *held_values(const DipSamples *samples, const Place *place, int channel,
                                 int sample) {
    return samples->light + dip_samples_index(samples, place->held, channel, sample) +
           place->quarter * DIP_SUB_BLOCK_PIXELS;
}

static inline void copy_sub_block(float *to, const float *from) {
    memcpy(to, from, DIP_SUB_BLOCK_PIXELS * sizeof *to);
}

void dip_samples_load_block(const DipSamples *samples, const DipTile *tile, int block,
                            DipTileColours *colours) {
    for (int quarter = 0; quarter < SUB_BLOCKS; quarter++) {
        const Place place = place_of(samples, tile, block, quarter);
        const uint64_t split = samples->split[place.held] >> quarter & 1;
        const int count = split ? samples->sample_count : 1;
        colours->split[place.number / 64] |= split << place.number % 64;
        for (int c = 0; c < DIP_SAMPLE_CHANNELS; c++) {
            for (int s = 0; s < count; s++) {
                copy_sub_block(colours->channel[c] + place.in_tile + s * DIP_BLOCK_PIXELS,
                               held_values(samples, &place, c, s));
            }
        }
    }
}

// Returns the pixels of a sub-block that lie within a rectangle. x, y: the sub-block's first pixel.
static unsigned pixels_within(const DipTargetRegion *rectangle, int x, int y) {
    if (x >= rectangle->x0 && y >= rectangle->y0 && x + DIP_SUB_BLOCK <= rectangle->x1 &&
        y + DIP_SUB_BLOCK <= rectangle->y1) {
        return ALL_PIXELS;
    }
    unsigned pixels = 0;
    for (int i = 0; i < DIP_SUB_BLOCK_PIXELS; i++) {
        const int column = x + i % DIP_SUB_BLOCK;
        const int row = y + i / DIP_SUB_BLOCK;
        const bool within = column >= rectangle->x0 && column < rectangle->x1 &&
                            row >= rectangle->y0 && row < rectangle->y1;
        pixels |= (unsigned)within << i;
    }
    return pixels;
}

static void store_whole(DipSamples *samples, const Place *place, const DipTileColours *colours) {
    const bool split = dip_is_split(colours, place->number);
    const int count = split ? samples->sample_count : 1;
    uint8_t *bits = &samples->split[place->held];
    *bits = (uint8_t)((*bits & ~(1u << place->quarter)) | (unsigned)split << place->quarter);
    for (int c = 0; c < DIP_SAMPLE_CHANNELS; c++) {
        for (int s = 0; s < count; s++) {
            copy_sub_block(held_values(samples, place, c, s),
                           colours->channel[c] + place->in_tile + s * DIP_BLOCK_PIXELS);
        }
    }
}

// Splits a sub-block of the DipSamples, if it is not split.
static void split_held(DipSamples *samples, const Place *place) {
    if (samples->split[place->held] >> place->quarter & 1) {
        return;
    }
    samples->split[place->held] |= (uint8_t)(1u << place->quarter);
    for (int c = 0; c < DIP_SAMPLE_CHANNELS; c++) {
        for (int s = 1; s < samples->sample_count; s++) {
            copy_sub_block(held_values(samples, place, c, s), held_values(samples, place, c, 0));
        }
    }
}

// Stores some pixels of a sub-block. The others may have different colours in each sample.
static void store_pixels(DipSamples *samples, const Place *place, unsigned pixels,
                         const DipTileColours *colours) {
    const bool split = dip_is_split(colours, place->number);
    split_held(samples, place);
    for (int c = 0; c < DIP_SAMPLE_CHANNELS; c++) {
        for (int s = 0; s < samples->sample_count; s++) {
            float *to = held_values(samples, place, c, s);
            const float *from =
                colours->channel[c] + place->in_tile + (split ? s : 0) * DIP_BLOCK_PIXELS;
            for (unsigned left = pixels; left; left &= left - 1) {
                const int pixel = __builtin_ctz(left);
                to[pixel] = from[pixel];
            }
        }
    }
}

void dip_samples_store_block(DipSamples *samples, const DipTargetRegion *stored,
                             const DipTile *tile, int block, const DipTileColours *colours) {
    for (int quarter = 0; quarter < SUB_BLOCKS; quarter++) {
        const Place place = place_of(samples, tile, block, quarter);
        const int x = tile->x0 + block % DIP_TILE_BLOCKS * DIP_BLOCK + quarter % 2 * DIP_SUB_BLOCK;
        const int y = tile->y0 + block / DIP_TILE_BLOCKS * DIP_BLOCK + quarter / 2 * DIP_SUB_BLOCK;
        const unsigned pixels = pixels_within(stored, x, y);
        if (pixels == ALL_PIXELS) {
            store_whole(samples, &place, colours);
        } else if (pixels) {
            store_pixels(samples, &place, pixels, colours);
        }
    }
}
