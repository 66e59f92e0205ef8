// Collects the fragments of a tile. Each distinct patch (pipeline/patch.h) that a pixel shows
// becomes a fragment in the list of the patch's draw. The 16 pixels of a sub-block (4x4 pixels) are
// handled as a mask of 16 bits. Within a sub-block, pixels whose samples all show one patch are
// added draw by draw. Pixels that show several patches are added patch by patch.
#include "renderer/base/pages.h"
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/pipeline/shading/tile_shading.h"
#include "renderer/simd/vec.h"

#include <stddef.h>

enum { VECTORS = 16 / DIP_LANES, ALL_PIXELS = 0xffff };

// A sub-block with at most this many triangles is looked at triangle by triangle.
enum { FEW_TRIANGLES = 3 };

// Positions (tile_shading.h) of a sub-block's pixels, relative to the sub-block's first pixel.
static const int32_t pixel_position[16] = {
    0,   1,   2,   3,   64,  65,  66,  67, // one row adds DIP_TILE
    128, 129, 130, 131, 192, 193, 194, 195,
};

// The sub-block whose fragments are being collected.
typedef struct SubBlock {
    DipTileShading *shading;
    // Triangle ids at sample 0. The ids at sample s are DIP_BLOCK_PIXELS * s elements later.
    const uint32_t *ids;
    int sample_count;
    int block;   // the block that it lies in
    int quarter; // its number in the block
    int x0, y0;  // column and row, in the tile, of the sub-block's first pixel
    // The patches that the samples show, [sample][pixel]; 0 for none. This array is filled only if
    // samples of a pixel hold several triangles, or if there may be sample groups.
    uint32_t patches[DIP_MAX_SAMPLES * DIP_SUB_BLOCK_PIXELS];
} SubBlock;

// Returns the pixels, one bit each, for which the entry of `numbers` equals `number`.
VEC_INLINE unsigned pixels_with(const uint32_t *numbers, uint32_t number) {
    unsigned bits = 0;
    for (int v = 0; v < VECTORS; v++) {
        const Vi held = vi_load((const int32_t *)numbers + v * DIP_LANES);
        bits |= mask_bits(vi_eq(held, vi_splat((int32_t)number))) << (v * DIP_LANES);
    }
    return bits;
}

// Gathers one 32-bit field of DipTriangle for each triangle id. The id 0 means that there is no
// triangle; its lane gets the field of triangle 0.
VEC_INLINE Vi gather_words(const SubBlock *sub, Vi ids, size_t offset_bytes) {
    enum { WORDS = sizeof(DipTriangle) / sizeof(int32_t) };
    const char *triangles = (const char *)sub->shading->input.triangles;
    const Vi index = vi_max(ids - 1, vi_splat(0));
    return vi_gather((const int32_t *)(const void *)(triangles + offset_bytes), index * WORDS);
}

static void find_patches(SubBlock *sub) {
    for (int s = 0; s < sub->sample_count; s++) {
        for (int v = 0; v < VECTORS; v++) {
            const Vi ids =
                vi_load((const int32_t *)sub->ids + s * DIP_BLOCK_PIXELS + v * DIP_LANES);
            const Vi patches = gather_words(sub, ids, offsetof(DipTriangle, patch));
            vi_store((int32_t *)sub->patches + s * DIP_SUB_BLOCK_PIXELS + v * DIP_LANES,
                     vi_select(vi_eq(ids, vi_splat(0)), vi_splat(0), patches));
        }
    }
}

// Returns the pixels, one bit each, whose samples have different numbers. numbers: triangle ids or
// patches. stride: distance from the numbers of one sample to the numbers of the next.
VEC_INLINE unsigned multi_fragment_pixels(const uint32_t *numbers, int sample_count, int stride) {
    unsigned same = 0;
    for (int v = 0; v < VECTORS; v++) {
        const int32_t *held = (const int32_t *)numbers + v * DIP_LANES;
        const Vi first = vi_load(held);
        Vi differ = vi_splat(0);
        for (int s = 1; s < sample_count; s++) {
            differ |= first ^ vi_load(held + s * stride);
        }
        same |= mask_bits(vi_eq(differ, vi_splat(0))) << (v * DIP_LANES);
    }
    return ~same & ALL_PIXELS;
}

static inline uint32_t draw_of(const DipTileShading *shading, uint32_t triangle) {
    return shading->input.triangles[triangle].draw;
}

// Adds a draw to the active draws: the draws whose lists this tile uses.
static inline void activate(DipTileShading *shading, uint32_t draw) {
    if (!shading->is_active[draw]) {
        shading->is_active[draw] = 1;
        shading->active[shading->active_count++] = draw;
    }
}

VEC_INLINE int32_t position_of(const SubBlock *sub, int sub_x, int sub_y) {
    return (sub->y0 * DIP_TILE + sub->x0) | sub_x << DIP_POSITION_SUB_X |
           sub_y << DIP_POSITION_SUB_Y;
}

// Adds a sub-block in which all 16 pixels show the same draw, and each pixel shows one patch. Its
// 16 fragments stay together in the draw's list of whole sub-blocks. ids: those of the first
// samples of the sub-block's pixels; centre: position of the centre of its first pixel.
VEC_INLINE void push_whole(DipTileShading *shading, const uint32_t *ids, int32_t centre,
                           uint32_t draw) {
    activate(shading, draw);
    DipFragmentList *list = &shading->whole_lists[draw];
    for (int v = 0; v < VECTORS; v++) {
        vi_store((int32_t *)list->triangle + list->count + v * DIP_LANES,
                 vi_load((const int32_t *)ids + v * DIP_LANES) - 1);
        vi_store((int32_t *)list->position + list->count + v * DIP_LANES,
                 vi_load(pixel_position + v * DIP_LANES) + centre);
    }
    list->count += DIP_SUB_BLOCK_PIXELS;
    if (list->count == DIP_FRAGMENT_BATCH) {
        shading->flush_whole(shading, draw);
    }
}

// Adds pixels as fragments of a draw. Triangle ids, samples and positions are given as vectors.
// uniform: whether all fragments hold the same samples.
VEC_INLINE void push(const SubBlock *sub, uint32_t draw, unsigned pixels, const Vu *ids,
                     const Vu *samples, const Vu *positions, bool uniform) {
    DipTileShading *shading = sub->shading;
    activate(shading, draw);
    DipFragmentList *list = &shading->lists[draw];
    for (int v = 0; v < VECTORS; v++) {
        const unsigned bits = pixels >> (v * DIP_LANES) & VEC_ALL_LANES;
        if (uniform) {
            vu_store(list->samples + list->count, samples[v]);
        } else {
            vu_compress(list->samples + list->count, bits, samples[v]);
        }
        vu_compress(list->triangle + list->count, bits, ids[v] - 1u);
        list->count += vu_compress(list->position + list->count, bits, positions[v]);
    }
    if (list->count >= DIP_FRAGMENT_BATCH) {
        shading->flush(shading, draw);
    }
}

// Adds pixels whose samples all show one patch. Such a pixel is shaded at its centre, on the
// triangle of its first sample. draws: the draw of each pixel. left: the pixels to add, one bit
// each.
VEC_INLINE void push_uniform(const SubBlock *sub, const uint32_t *draws, unsigned left) {
    Vu ids[VECTORS];
    Vu samples[VECTORS];
    Vu positions[VECTORS];
    for (int v = 0; v < VECTORS; v++) {
        ids[v] = (Vu)vi_load((const int32_t *)sub->ids + v * DIP_LANES);
        samples[v] = vu_splat((1u << sub->sample_count) - 1);
        positions[v] = (Vu)(vi_load(pixel_position + v * DIP_LANES) + position_of(sub, 128, 128));
    }
    while (left) {
        const uint32_t draw = draws[__builtin_ctz(left)];
        const unsigned pixels = pixels_with(draws, draw) & left;
        left &= ~pixels;
        push(sub, draw, pixels, ids, samples, positions, true);
    }
}

// Returns the sample groups of a draw, or NULL if all its samples form one group.
static inline const DipSampleGroups *groups_of(const DipTileShading *shading, uint32_t draw) {
    const bool has_groups = shading->groups_shade_all || shading->draws[draw].clip_shader;
    return shading->groups && has_groups ? shading->groups : NULL;
}

// Adds the fragments of one patch: the patch that sample `first` shows in the first pixel of
// left[first]. left[s] holds the pixels whose sample s has not been added yet; the function removes
// the samples that it adds. A fragment is shaded at its first sample that shows the patch. If the
// draw has sample groups, the function adds only samples in the same group as `first`. The fragment
// is then shaded at the centroid of the samples that it holds.
VEC_INLINE void push_multi_fragment_patch(const SubBlock *sub, unsigned *left, int first) {
    const DipSamplePattern *pattern = sub->shading->tile->pattern;
    const int pixel = __builtin_ctz(left[first]);
    const uint32_t patch = sub->patches[first * DIP_SUB_BLOCK_PIXELS + pixel];
    const uint32_t draw = draw_of(sub->shading, sub->ids[first * DIP_BLOCK_PIXELS + pixel] - 1);
    const DipSampleGroups *groups = groups_of(sub->shading, draw);
    const unsigned shared = groups ? groups->sharing[first] : ~0u;
    Vu ids[VECTORS];
    Vu samples[VECTORS];
    Vu positions[VECTORS];
    unsigned pixels = 0;
    for (int v = 0; v < VECTORS; v++) {
        ids[v] = samples[v] = positions[v] = vu_splat(0);
    }
    for (int s = sub->sample_count - 1; s >= first; s--) {
        const unsigned held =
            shared >> s & 1 ? pixels_with(sub->patches + s * DIP_SUB_BLOCK_PIXELS, patch) & left[s]
                            : 0;
        left[s] &= ~held;
        pixels |= held;
        const Vi position = vi_splat(position_of(sub, pattern->x[s], pattern->y[s]));
        for (int v = 0; v < VECTORS; v++) {
            const Mask mask = mask_from_bits(held >> (v * DIP_LANES) & VEC_ALL_LANES);
            samples[v] |= (Vu)vi_select(mask, vi_splat(1 << s), vi_splat(0));
            positions[v] = (Vu)vi_select(mask, position, (Vi)positions[v]);
            const Vi sample_ids =
                vi_load((const int32_t *)sub->ids + s * DIP_BLOCK_PIXELS + v * DIP_LANES);
            ids[v] = (Vu)vi_select(mask, sample_ids, (Vi)ids[v]);
        }
    }
    for (int v = 0; v < VECTORS; v++) {
        if (groups) {
            const Vi centroid = vi_gather(groups->centroid, (Vi)samples[v]);
            positions[v] = (Vu)((centroid << DIP_POSITION_SUB_X) + position_of(sub, 0, 0));
        }
        positions[v] += (Vu)vi_load(pixel_position + v * DIP_LANES);
    }
    push(sub, draw, pixels, ids, samples, positions, false);
}

// Starts the sums of multi-fragment pixels (pixels with several fragments). Uncovered samples add
// the background; most pixels have no uncovered sample. empty[s]: the pixels whose sample s is
// uncovered. any_empty: the pixels that have an uncovered sample.
VEC_INLINE void begin_sums(const SubBlock *sub, unsigned multi_fragment,
                           const unsigned empty[DIP_MAX_SAMPLES], unsigned any_empty) {
    DipTileShading *shading = sub->shading;
    const int corner = sub->y0 * DIP_TILE + sub->x0;
    for (unsigned left = multi_fragment; left; left &= left - 1) {
        const int pixel = __builtin_ctz(left);
        const int at = corner + pixel_position[pixel];
        shading->multi_fragment[shading->multi_fragment_count++] = (uint16_t)at;
        memset(shading->sum[at], 0, sizeof shading->sum[at]);
    }
    for (unsigned left = any_empty; left; left &= left - 1) {
        const int pixel = __builtin_ctz(left);
        for (int s = 0; s < sub->sample_count; s++) {
            const int32_t uncovered = (int32_t)(empty[s] >> pixel & 1);
            for (int c = 0; c < 3; c++) {
                shading->sum[corner + pixel_position[pixel]][c] +=
                    shading->clear_linear16[c] * uncovered;
            }
        }
    }
}

VEC_INLINE void push_multi_fragment(const SubBlock *sub, unsigned multi_fragment) {
    unsigned left[DIP_MAX_SAMPLES];
    unsigned empty[DIP_MAX_SAMPLES];
    unsigned any_empty = 0;
    for (int s = 0; s < sub->sample_count; s++) {
        empty[s] = pixels_with(sub->patches + s * DIP_SUB_BLOCK_PIXELS, 0) & multi_fragment;
        left[s] = multi_fragment & ~empty[s];
        sub->shading->samples += (unsigned)__builtin_popcount(left[s]);
        any_empty |= empty[s];
    }
    begin_sums(sub, multi_fragment, empty, any_empty);
    for (int s = 0; s < sub->sample_count; s++) {
        while (left[s]) {
            push_multi_fragment_patch(sub, left, s);
        }
    }
}

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

// --- sharing with passes that are drawn at once --------------------------------------------------

// Returns the pixels among `left`, which show one draw each, whose draw has own_shading.
static unsigned pixels_of_own_shading(const SubBlock *sub, unsigned left) {
    unsigned found = 0;
    for (; left; left &= left - 1) {
        const int pixel = __builtin_ctz(left);
        const uint32_t draw = draw_of(sub->shading, sub->ids[pixel] - 1);
        found |= (unsigned)sub->shading->draws[draw].own_shading << pixel;
    }
    return found;
}

// Returns the pixels that the other pass offers and whose first samples show the same triangles in
// both passes.
VEC_INLINE unsigned pixels_to_copy(const SubBlock *sub) {
    const DipTileShading *from = sub->shading->share.from;
    const unsigned offered = from->share.offered[sub->block][sub->quarter];
    if (!offered) {
        return 0; // the other pass may not have touched the block
    }
    const uint32_t *ids = from->tile->id + dip_tile_index(from->tile, sub->block, 0) +
                          sub->quarter * DIP_SUB_BLOCK_PIXELS;
    unsigned same = 0;
    for (int v = 0; v < VECTORS; v++) {
        same |= mask_bits(vi_eq(vi_load((const int32_t *)ids + v * DIP_LANES),
                                vi_load((const int32_t *)sub->ids + v * DIP_LANES)))
                << (v * DIP_LANES);
    }
    return same & offered;
}

// Pixels that are not copied are not written, not even with what they hold: a sub-block at the
// target's edge reaches past the target's memory, or into a row that another thread draws.
static void copy_pixels(const SubBlock *sub, unsigned pixels) {
    DipTileShading *shading = sub->shading;
    const DipTileShading *other = shading->share.from;
    const uint32_t *from = other->pixels + (size_t)sub->y0 * other->stride + (size_t)sub->x0;
    uint32_t *to = shading->pixels + (size_t)sub->y0 * shading->stride + (size_t)sub->x0;
    for (int y = 0; y < DIP_SUB_BLOCK; y++, from += other->stride, to += shading->stride) {
        const unsigned row = pixels >> (y * DIP_SUB_BLOCK) & ((1u << DIP_SUB_BLOCK) - 1);
        if (row == (1u << DIP_SUB_BLOCK) - 1) {
            memcpy(to, from, DIP_SUB_BLOCK * sizeof *to);
            continue;
        }
        for (unsigned left = row; left; left &= left - 1) {
            const int x = __builtin_ctz(left);
            to[x] = from[x];
        }
    }
    shading->copied += (unsigned)__builtin_popcount(pixels);
}

// Whether the pass offers pixels to other passes or copies theirs.
static inline bool shares(const DipTileShading *shading) {
    return (shading->share.offers || shading->share.from) && !shading->share.paused;
}

// Offers pixels to other passes, or copies those that another pass offers. uniform: pixels that
// show one patch alone, of a draw without sample groups. Returns the pixels that are left to shade.
static unsigned share_pixels(const SubBlock *sub, unsigned uniform) {
    DipShadingShare *share = &sub->shading->share;
    unsigned pixels = share->offers ? uniform : pixels_to_copy(sub) & uniform;
    if (share->some_own) {
        pixels &= ~pixels_of_own_shading(sub, pixels);
    }
    if (share->offers) {
        share->offered[sub->block][sub->quarter] = (uint16_t)pixels;
        return uniform;
    }
    if (pixels) {
        copy_pixels(sub, pixels);
    }
    return uniform & ~pixels;
}

// --- a sub-block -------------------------------------------------------------------------------

static void find_draws(const SubBlock *sub, uint32_t draws[DIP_SUB_BLOCK_PIXELS]) {
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

// Returns whether the first samples of a sub-block's pixels show the same draw, in a few triangles,
// and sets *draw to it.
VEC_INLINE bool shows_one_draw(const DipTileShading *shading, const uint32_t *ids, uint32_t *draw) {
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

// Planes are prefetched for sub-blocks in which more neighbouring pixels than these have different
// triangles. Prefetching those of large triangles would cost more time than it saves.
enum { FEW_CHANGES = 6 };

// Prefetches the planes of the triangles that the first samples of the pixels show, if there are
// many. The planes of small triangles are read once per tile, so they are seldom in the caches. The
// fragments wait in their list until there is a batch, so the planes have time to come.
VEC_INLINE void prefetch_planes(const SubBlock *sub) {
    static const int32_t next[16] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 0};
    const int32_t *ids = (const int32_t *)sub->ids;
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
    const DipShadingInput *input = &sub->shading->input;
    const size_t size_bytes = (size_t)input->plane_stride * sizeof *input->planes;
    for (; changes; changes &= changes - 1) {
        const size_t triangle = (size_t)ids[__builtin_ctz(changes)] - 1;
        const char *planes = (const char *)input->planes + triangle * size_bytes;
        for (size_t b = 0; b < size_bytes; b += DIP_CACHE_LINE) {
            __builtin_prefetch(planes + b);
        }
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
    prefetch_planes(&sub);
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
        if (one_draw && !shares(shading)) {
            const int32_t centre =
                (y * DIP_TILE + x) | 128 << DIP_POSITION_SUB_X | 128 << DIP_POSITION_SUB_Y;
            push_whole(shading, ids, centre, draw);
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
