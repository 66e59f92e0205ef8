// Collects the fragments of a tile. Each distinct patch (pipeline/patch.h) that a pixel shows
// becomes a fragment in the list of the patch's draw.
#include "renderer/base/pages.h"
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/pipeline/shading/push_simd.h"
#include "renderer/pipeline/shading/share_simd.h"

// A sub-block with at most this many triangles is looked at triangle by triangle.
enum { FEW_TRIANGLES = 3 };

// Gives `count` pixels of a row, from column x, the background's colour.
static inline void clear_row(const DipTileShading *shading, int x, int y, int count) {
    if (shading->light16) {
        const int32_t *light = shading->clear_linear16;
        for (int i = 0; i < count; i++) {
            dip_store_light16(shading, (uint32_t)(y * DIP_TILE + x + i), light[0], light[1],
                              light[2]);
        }
        return;
    }
    const uint32_t rgba8 = shading->clear_rgba8;
    uint32_t *pixels = shading->pixels + (size_t)y * shading->stride + (size_t)x;
    for (int i = 0; i < count; i++) {
        pixels[i] = rgba8;
    }
}

static void clear_pixels(const SubBlock *sub, unsigned left) {
    for (; left; left &= left - 1) {
        const int position = pixel_position[__builtin_ctz(left)];
        clear_row(sub->shading, sub->x0 + position % DIP_TILE, sub->y0 + position / DIP_TILE, 1);
    }
}

// Returns the sub-block's pixels that lie in the target.
static unsigned pixels_in_target(const SubBlock *sub) {
    unsigned inside = 0;
    for (int i = 0; i < 16; i++) {
        const bool in =
            sub->x0 + (i & 3) < sub->shading->width && sub->y0 + (i >> 2) < sub->shading->height;
        inside |= (unsigned)in << i;
    }
    return inside;
}

// Returns the pixels among `left` whose draw has sample groups. Each pixel of `left` must show only
// one draw.
static unsigned pixels_in_groups(const SubBlock *sub, const uint32_t *draws, unsigned left) {
    unsigned found = 0;
    while (left) {
        const uint32_t draw = draws[__builtin_ctz(left)];
        const unsigned pixels = pixels_with(draws, draw) & left;
        left &= ~pixels;
        found |= groups_of(sub->shading, draw) ? pixels : 0;
    }
    return found;
}

static void find_draws(const SubBlock *sub, uint32_t draws[DIP_SUB_BLOCK_PIXELS]) {
    if (sub->shading->single_draw) {
        memset(draws, 0, DIP_SUB_BLOCK_PIXELS * sizeof *draws);
        return;
    }
    for (int v = 0; v < VECTORS; v++) {
        const Vi ids = vi_load((const int32_t *)sub->ids + v * DIP_LANES);
        vi_store((int32_t *)draws + v * DIP_LANES,
                 gather_words(sub, ids, offsetof(DipTriangle, draw)));
    }
}

// Collects a sub-block in the general case: its pixels may show several triangles, or draws with
// sample groups. several: whether the samples of some pixel hold different triangles. grouped:
// whether the sub-block may hold triangles that were drawn in sample groups. inside: the pixels
// that lie in the target.
static void collect_shared(SubBlock *sub, bool several, bool grouped, unsigned inside) {
    uint32_t draws[DIP_SUB_BLOCK_PIXELS]; // the draw that sample 0 of each pixel shows
    find_draws(sub, draws);
    unsigned multi_fragment = 0;
    if (several || grouped) {
        find_patches(sub);
        multi_fragment =
            multi_fragment_pixels(sub->patches, sub->sample_count, DIP_SUB_BLOCK_PIXELS) & inside;
    }
    const unsigned empty = pixels_with(sub->ids, 0) & inside & ~multi_fragment;
    unsigned uniform = inside & ~multi_fragment & ~empty;
    if (grouped) {
        const unsigned in_groups = pixels_in_groups(sub, draws, uniform);
        multi_fragment |= in_groups;
        uniform &= ~in_groups;
    }
    sub->shading->samples += (unsigned)__builtin_popcount(uniform) * (unsigned)sub->sample_count;
    if (shares(sub->shading)) {
        uniform = share_pixels(sub, uniform);
    }
    if (uniform == ALL_PIXELS && pixels_with(draws, draws[0]) == ALL_PIXELS) {
        push_whole(sub->shading, sub->ids, position_of(sub, 128, 128), draws[0]);
        return;
    }
    clear_pixels(sub, empty);
    push_uniform(sub, draws, uniform);
    if (multi_fragment) {
        push_multi_fragment(sub, multi_fragment);
    }
}

// Planes are prefetched for sub-blocks in which more neighbouring pixels than these have different
// triangles. Prefetching those of large triangles would cost more time than it saves.
enum { FEW_CHANGES = 6 };

// Prefetches the planes of the triangles that the first samples of the pixels show, if there are
// many. The planes of small triangles are read once per tile, so they are seldom in the caches. The
// fragments wait in their list until there is a batch, so the planes have time to come.
VEC_INLINE void prefetch_planes(const DipShadingInput *input, const uint32_t *sub_block_ids) {
    static const int32_t next[16] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 0};
    const int32_t *ids = (const int32_t *)sub_block_ids;
    unsigned stay = 0; // the pixels that show no triangle or that of the next pixel
    for (int v = 0; v < VECTORS; v++) {
        const Vi held = vi_load(ids + v * DIP_LANES);
        const Mask same = vi_eq(held, vi_lookup16(ids, vi_load(next + v * DIP_LANES)));
        stay |= mask_bits(same | vi_eq(held, vi_splat(0))) << (v * DIP_LANES);
    }
    unsigned changes = ~stay & ALL_PIXELS;
    if (__builtin_popcount(changes) <= FEW_CHANGES) {
        return;
    }
    const size_t size_bytes = (size_t)input->plane_stride * sizeof *input->planes;
    for (; changes; changes &= changes - 1) {
        const size_t triangle = (size_t)ids[__builtin_ctz(changes)] - 1;
        const char *planes = (const char *)input->planes + triangle * size_bytes;
        for (size_t b = 0; b < size_bytes; b += DIP_CACHE_LINE) {
            __builtin_prefetch(planes + b);
        }
    }
}

// Returns whether the first samples of a sub-block's pixels show the same draw, and sets *draw to
// it. If the pass has several draws, the function finds this out only if they show a few triangles.
VEC_INLINE bool shows_one_draw(const DipTileShading *shading, const uint32_t *ids, uint32_t *draw) {
    if (shading->single_draw) {
        *draw = 0;
        return !pixels_with(ids, 0);
    }
    if (!ids[0]) {
        return false;
    }
    *draw = draw_of(shading, ids[0] - 1);
    unsigned left = ALL_PIXELS & ~pixels_with(ids, ids[0]);
    for (int n = 1; n < FEW_TRIANGLES && left; n++) {
        const uint32_t id = ids[__builtin_ctz(left)];
        if (!id || draw_of(shading, id - 1) != *draw) {
            return false;
        }
        left &= ~pixels_with(ids, id);
    }
    return !left;
}

// Collects the pixels `left` of a sub-block that shows one draw alone.
static void push_one_draw(const SubBlock *sub, unsigned left, uint32_t draw) {
    if (left == ALL_PIXELS) {
        push_whole(sub->shading, sub->ids, position_of(sub, 128, 128), draw);
    } else if (left) {
        uint32_t draws[DIP_SUB_BLOCK_PIXELS];
        for (int i = 0; i < DIP_SUB_BLOCK_PIXELS; i++) {
            draws[i] = draw;
        }
        push_uniform(sub, draws, left);
    }
}

// Collects sub-block number `quarter` of a block. grouped: it may hold triangles that were drawn in
// sample groups. one_draw: all its pixels lie in the target and show `draw` alone. This is a
// function of its own so that the loop over sub-blocks keeps its values in registers.
static __attribute__((noinline)) void collect_sub_block(DipTileShading *shading,
                                                        const uint32_t *ids, int block, int quarter,
                                                        bool grouped, bool one_draw,
                                                        uint32_t draw) {
    SubBlock sub; // `patches` is filled only if it is needed
    sub.shading = shading;
    sub.ids = ids;
    sub.sample_count = shading->tile->pattern->count;
    sub.block = block;
    sub.quarter = quarter;
    sub.x0 = block % DIP_TILE_BLOCKS * DIP_BLOCK + (quarter & 1) * DIP_SUB_BLOCK;
    sub.y0 = block / DIP_TILE_BLOCKS * DIP_BLOCK + (quarter >> 1) * DIP_SUB_BLOCK;
    if (one_draw) {
        push_one_draw(&sub, share_pixels(&sub, ALL_PIXELS), draw);
        return;
    }
    const bool several =
        sub.sample_count > 1 && multi_fragment_pixels(ids, sub.sample_count, DIP_BLOCK_PIXELS);
    const bool within = sub.x0 + 4 <= shading->width && sub.y0 + 4 <= shading->height;
    collect_shared(&sub, several, grouped, within ? ALL_PIXELS : pixels_in_target(&sub));
}

// Collects a block. The loop itself collects the sub-blocks that show one draw alone. They are the
// most where triangles are large.
VEC_INLINE void collect_block(DipTileShading *shading, int block, bool grouped) {
    const int sample_count = shading->tile->pattern->count;
    const uint32_t *ids = shading->tile->id + dip_tile_index(shading->tile, block, 0);
    const int x0 = block % DIP_TILE_BLOCKS * DIP_BLOCK;
    const int y0 = block / DIP_TILE_BLOCKS * DIP_BLOCK;
    for (int quarter = 0; quarter < 4; quarter++, ids += DIP_SUB_BLOCK_PIXELS) {
        const int x = x0 + (quarter & 1) * DIP_SUB_BLOCK;
        const int y = y0 + (quarter >> 1) * DIP_SUB_BLOCK;
        uint32_t draw = 0;
        const bool one_draw =
            !grouped && x + DIP_SUB_BLOCK <= shading->width &&
            y + DIP_SUB_BLOCK <= shading->height &&
            !(sample_count > 1 && multi_fragment_pixels(ids, sample_count, DIP_BLOCK_PIXELS)) &&
            shows_one_draw(shading, ids, &draw);
        shading->samples += one_draw ? DIP_SUB_BLOCK_PIXELS * (unsigned)sample_count : 0;
        if (!one_draw || shading->single_draw) {
            prefetch_planes(&shading->input, ids);
        }
        if (one_draw && !shares(shading)) {
            push_whole(shading, ids, position_at(x, y, 128, 128), draw);
        } else {
            collect_sub_block(shading, ids, block, quarter, grouped, one_draw, draw);
        }
    }
}

static void clear_block(DipTileShading *shading, int block) {
    const int x0 = block % DIP_TILE_BLOCKS * DIP_BLOCK;
    const int y0 = block / DIP_TILE_BLOCKS * DIP_BLOCK;
    const int width = shading->width - x0 < DIP_BLOCK ? shading->width - x0 : DIP_BLOCK;
    for (int y = y0; y < y0 + DIP_BLOCK && y < shading->height; y++) {
        clear_row(shading, x0, y, width);
    }
}

VEC_INLINE bool is_drawn(const DipTile *tile, int block) {
    const int x = block % DIP_TILE_BLOCKS * DIP_BLOCK;
    const int y = block / DIP_TILE_BLOCKS * DIP_BLOCK;
    return x >= tile->left && y >= tile->top && x < DIP_TILE - tile->right &&
           y < DIP_TILE - tile->bottom;
}

// Prefetches the target's pixels of a block and of the next one, which share cache lines. Their
// colours are stored when there is a batch of fragments, and these stores would wait.
static void prefetch_pixels(const DipTileShading *shading, int block) {
    const int x = block % DIP_TILE_BLOCKS * DIP_BLOCK;
    const int y0 = block / DIP_TILE_BLOCKS * DIP_BLOCK;
    for (int y = y0; y < y0 + DIP_BLOCK && y < shading->height; y++) {
        __builtin_prefetch(shading->pixels + (size_t)y * shading->stride + x, 1);
    }
}

void DIP_KERNEL(dip_kernel_collect)(DipTileShading *shading) {
    const DipTile *tile = shading->tile;
    const bool all_grouped = shading->groups && shading->groups_shade_all;
    if (shading->share.offers) {
        memset(shading->share.offered, 0, sizeof shading->share.offered);
    }
    for (int block = 0; block < DIP_BLOCKS; block++) {
        if (!is_drawn(tile, block)) {
            continue;
        }
        if (!(tile->touched >> block & 1)) {
            clear_block(shading, block);
            continue;
        }
        if (block % 2 == 0 && !shading->light16) {
            prefetch_pixels(shading, block);
        }
        collect_block(shading, block, all_grouped || tile->grouped >> block & 1);
    }
}
