// The fragments of a tile: every pixel's distinct surfaces, pushed to the lists of their draws.
#include "renderer/raster/kernels.h"
#include "renderer/simd/vec.h"

enum { VECTORS = 16 / DIP_LANES }; // per sub-block

// The draw of a triangle, whose list is then among the active ones.
static uint32_t draw_of(DipTileShading *shading, uint32_t triangle) {
    const uint32_t draw = shading->input.triangles[triangle].draw;
    if (!shading->is_active[draw]) {
        shading->is_active[draw] = 1;
        shading->active[shading->active_count++] = draw;
    }
    return draw;
}

// Adds a fragment that is shaded at (sub_x, sub_y) / 256 of its pixel.
static inline void push(DipTileShading *shading, uint32_t triangle, int x, int y, unsigned samples,
                        int sub_x, int sub_y) {
    const uint32_t draw = draw_of(shading, triangle);
    DipFragmentList *list = &shading->lists[draw];
    const int i = list->count++;
    list->triangle[i] = triangle;
    list->pixel[i] = (uint16_t)(y * DIP_TILE + x);
    list->samples[i] = (uint8_t)samples;
    list->x[i] = (float)(shading->tile->x0 + x) + (float)sub_x / 256.0f;
    list->y[i] = (float)(shading->tile->y0 + y) + (float)sub_y / 256.0f;
    if (list->count == DIP_FRAGMENT_BATCH) {
        shading->flush(shading, draw);
    }
}

// A sub-block that one triangle fills: its 16 fragments at once, in a list of its own kind, where
// they stay together as a vector. The list's room is a multiple of 16, so they always fit.
static void push_whole(DipTileShading *shading, uint32_t triangle, int x0, int y0,
                       unsigned samples) {
    const uint32_t draw = draw_of(shading, triangle);
    DipFragmentList *list = &shading->whole_lists[draw];
    const int first = list->count;
    for (int i = 0; i < 16; i++) {
        const int x = x0 + (i & 3);
        const int y = y0 + (i >> 2);
        list->triangle[first + i] = triangle;
        list->pixel[first + i] = (uint16_t)(y * DIP_TILE + x);
        list->samples[first + i] = (uint8_t)samples;
        list->x[first + i] = (float)(shading->tile->x0 + x) + 0.5f;
        list->y[first + i] = (float)(shading->tile->y0 + y) + 0.5f;
    }
    list->count += 16;
    if (list->count == DIP_FRAGMENT_BATCH) {
        shading->flush_whole(shading, draw);
    }
}

// A pixel whose samples differ: its uncovered samples start the sum, each surface is a fragment.
static void push_mixed(DipTileShading *shading, const uint32_t *ids, int x, int y) {
    const DipSamplePattern *pattern = shading->tile->pattern;
    const int pixel = y * DIP_TILE + x;
    int empty = 0;
    unsigned left = 0;
    for (int s = 0; s < pattern->count; s++) {
        const bool covered = ids[s * DIP_BLOCK_PIXELS] != 0;
        empty += !covered;
        left |= (unsigned)covered << s;
    }
    for (int c = 0; c < 3; c++) {
        shading->sum[pixel][c] = shading->clear_linear16[c] * empty;
    }
    shading->mixed[shading->mixed_count++] = (uint16_t)pixel;
    while (left) {
        const int first = __builtin_ctz(left);
        const uint32_t id = ids[first * DIP_BLOCK_PIXELS];
        unsigned samples = 0;
        for (int s = first; s < pattern->count; s++) {
            samples |= (unsigned)(ids[s * DIP_BLOCK_PIXELS] == id) << s;
        }
        left &= ~samples;
        push(shading, id - 1, x, y, samples, pattern->x[first], pattern->y[first]);
    }
}

// Pixels of a sub-block, one bit each, whose samples do not all hold the same triangle.
VEC_INLINE unsigned mixed_pixels(const DipTile *tile, const uint32_t *ids) {
    unsigned mixed = 0;
    for (int v = 0; v < VECTORS && tile->pattern->count > 1; v++) {
        const Vi first = vi_load((const int32_t *)ids + v * DIP_LANES);
        Vi differ = vi_splat(0);
        for (int s = 1; s < tile->pattern->count; s++) {
            differ |= first ^ vi_load((const int32_t *)ids + s * DIP_BLOCK_PIXELS + v * DIP_LANES);
        }
        mixed |= (mask_bits(vi_eq(differ, vi_splat(0))) ^ VEC_ALL_LANES) << (v * DIP_LANES);
    }
    return mixed;
}

// Whether the sub-block's pixels all hold one triangle at sample 0.
VEC_INLINE bool one_triangle(const uint32_t *ids) {
    const Vi id = vi_splat((int32_t)ids[0]);
    Vi differ = vi_splat(0);
    for (int v = 0; v < VECTORS; v++) {
        differ |= id ^ vi_load((const int32_t *)ids + v * DIP_LANES);
    }
    return mask_all(vi_eq(differ, vi_splat(0)));
}

static void collect_sub_block(DipTileShading *shading, const uint32_t *ids, int x0, int y0) {
    const unsigned all = (1u << shading->tile->pattern->count) - 1;
    const unsigned mixed = mixed_pixels(shading->tile, ids);
    if (!mixed && ids[0] && x0 + 4 <= shading->width && y0 + 4 <= shading->height &&
        one_triangle(ids)) {
        push_whole(shading, ids[0] - 1, x0, y0, all);
        return;
    }
    for (int i = 0; i < 16; i++) {
        const int x = x0 + (i & 3);
        const int y = y0 + (i >> 2);
        if (x >= shading->width || y >= shading->height) {
            continue;
        }
        if (mixed >> i & 1) {
            push_mixed(shading, ids + i, x, y);
        } else if (ids[i]) {
            push(shading, ids[i] - 1, x, y, all, 128, 128);
        } else {
            shading->pixels[(size_t)y * shading->stride + (size_t)x] = shading->clear_rgba8;
        }
    }
}

static void clear_block(DipTileShading *shading, int block) {
    const int x0 = block % DIP_TILE_BLOCKS * DIP_BLOCK;
    const int y0 = block / DIP_TILE_BLOCKS * DIP_BLOCK;
    for (int y = y0; y < y0 + DIP_BLOCK && y < shading->height; y++) {
        for (int x = x0; x < x0 + DIP_BLOCK && x < shading->width; x++) {
            shading->pixels[(size_t)y * shading->stride + (size_t)x] = shading->clear_rgba8;
        }
    }
}

void DIP_KERNEL(dip_kernel_collect)(DipTileShading *shading) {
    const DipTile *tile = shading->tile;
    for (int block = 0; block < DIP_BLOCKS; block++) {
        if (!(tile->touched >> block & 1)) {
            clear_block(shading, block);
            continue;
        }
        const uint32_t *ids = tile->id + dip_tile_index(tile, block, 0);
        for (int quarter = 0; quarter < 4; quarter++) {
            collect_sub_block(shading, ids + quarter * 16,
                              block % DIP_TILE_BLOCKS * DIP_BLOCK + (quarter & 1) * 4,
                              block / DIP_TILE_BLOCKS * DIP_BLOCK + (quarter >> 1) * 4);
        }
    }
}
