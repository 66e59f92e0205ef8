// The fragments of a tile: every pixel's distinct surfaces, pushed to the lists of their draws.
// A sub-block's pixels of one triangle are pushed together, as a mask of 16 bits.
#include "renderer/raster/kernels.h"
#include "renderer/simd/vec.h"

enum { VECTORS = 16 / DIP_LANES, ALL_PIXELS = 0xffff };

// Where a sub-block's pixels lie from its first one, as places (tile_shading.h).
static const int32_t pixel_place[16] = {
    0,   1,   2,   3,   64,  65,  66,  67, // DIP_TILE to the next row
    128, 129, 130, 131, 192, 193, 194, 195,
};

// A sub-block in hand.
typedef struct SubBlock {
    DipTileShading *shading;
    const uint32_t *ids; // of sample 0; DIP_BLOCK_PIXELS to the next sample's
    int sample_count;
    int x0, y0; // pixels in the tile
} SubBlock;

// Pixels, one bit each, whose sample holds the triangle of that id.
VEC_INLINE unsigned pixels_with(const uint32_t *ids, uint32_t id) {
    unsigned bits = 0;
    for (int v = 0; v < VECTORS; v++) {
        const Vi held = vi_load((const int32_t *)ids + v * DIP_LANES);
        bits |= mask_bits(vi_eq(held, vi_splat((int32_t)id))) << (v * DIP_LANES);
    }
    return bits;
}

// Pixels whose samples do not all hold the same triangle.
VEC_INLINE unsigned mixed_pixels(const SubBlock *sub) {
    unsigned same = 0;
    for (int v = 0; v < VECTORS; v++) {
        const int32_t *ids = (const int32_t *)sub->ids + v * DIP_LANES;
        const Vi first = vi_load(ids);
        Vi differ = vi_splat(0);
        for (int s = 1; s < sub->sample_count; s++) {
            differ |= first ^ vi_load(ids + s * DIP_BLOCK_PIXELS);
        }
        same |= mask_bits(vi_eq(differ, vi_splat(0))) << (v * DIP_LANES);
    }
    return ~same & ALL_PIXELS;
}

// The draw of a triangle, whose lists are then among the active ones.
static inline uint32_t draw_of(DipTileShading *shading, uint32_t triangle) {
    const uint32_t draw = shading->input.triangles[triangle].draw;
    if (!shading->is_active[draw]) {
        shading->is_active[draw] = 1;
        shading->active[shading->active_count++] = draw;
    }
    return draw;
}

VEC_INLINE int32_t place_of(const SubBlock *sub, int sub_x, int sub_y) {
    return (sub->y0 * DIP_TILE + sub->x0) | sub_x << DIP_PLACE_SUB_X | sub_y << DIP_PLACE_SUB_Y;
}

VEC_INLINE void set_triangles(DipFragmentList *list, uint32_t triangle) {
    for (int v = 0; v < VECTORS; v++) {
        vu_store(list->triangle + list->count + v * DIP_LANES, vu_splat(triangle));
    }
}

// A sub-block that one triangle fills: its 16 fragments stay together, in a list of their own kind.
static void push_whole(const SubBlock *sub, uint32_t triangle) {
    DipTileShading *shading = sub->shading;
    const uint32_t draw = draw_of(shading, triangle);
    DipFragmentList *list = &shading->whole_lists[draw];
    set_triangles(list, triangle);
    for (int v = 0; v < VECTORS; v++) {
        const Vi at = vi_load(pixel_place + v * DIP_LANES);
        vi_store((int32_t *)list->place + list->count + v * DIP_LANES,
                 at + place_of(sub, 128, 128));
    }
    list->count += 16;
    if (list->count == DIP_FRAGMENT_BATCH) {
        shading->flush_whole(shading, draw);
    }
}

// The triangle's pixels as fragments of its draw; samples and places per vector. uniform: all lanes
// have the same samples.
VEC_INLINE void push(const SubBlock *sub, uint32_t triangle, unsigned pixels, const Vu *samples,
                     const Vu *places, bool uniform) {
    DipTileShading *shading = sub->shading;
    const uint32_t draw = draw_of(shading, triangle);
    DipFragmentList *list = &shading->lists[draw];
    set_triangles(list, triangle);
    for (int v = 0; v < VECTORS; v++) {
        const unsigned bits = pixels >> (v * DIP_LANES) & VEC_ALL_LANES;
        if (uniform) {
            vu_store(list->samples + list->count, samples[v]);
        } else {
            vu_compress(list->samples + list->count, bits, samples[v]);
        }
        list->count += vu_compress(list->place + list->count, bits, places[v]);
    }
    if (list->count >= DIP_FRAGMENT_BATCH) {
        shading->flush(shading, draw);
    }
}

// Pixels that one triangle each holds with all samples, shaded at their centres.
VEC_INLINE void push_uniform(const SubBlock *sub, unsigned left) {
    Vu samples[VECTORS];
    Vu places[VECTORS];
    for (int v = 0; v < VECTORS; v++) {
        samples[v] = vu_splat((1u << sub->sample_count) - 1);
        places[v] = (Vu)(vi_load(pixel_place + v * DIP_LANES) + place_of(sub, 128, 128));
    }
    while (left) {
        const uint32_t id = sub->ids[__builtin_ctz(left)];
        const unsigned pixels = pixels_with(sub->ids, id) & left;
        left &= ~pixels;
        push(sub, id - 1, pixels, samples, places, true);
    }
}

// The passes of a triangle's draw, NULL where it has but one.
static inline const DipSamplePasses *passes_of(const DipTileShading *shading, uint32_t triangle) {
    const uint32_t draw = shading->input.triangles[triangle].draw;
    return shading->passes && shading->draws[draw].clip_shader ? shading->passes : NULL;
}

// Pixels whose samples differ, all those of the triangle that the first of `left` holds in sample
// `first`: shaded at their first sample of it. Of a triangle with passes only those of the sample's
// pass, shaded at the centroid of what they hold of it. Takes them out of `left`.
VEC_INLINE void push_mixed_triangle(const SubBlock *sub, unsigned *left, int first) {
    const DipSamplePattern *pattern = sub->shading->tile->pattern;
    const uint32_t id = sub->ids[first * DIP_BLOCK_PIXELS + __builtin_ctz(left[first])];
    const DipSamplePasses *passes = passes_of(sub->shading, id - 1);
    const unsigned shared = passes ? passes->sharing[first] : ~0u;
    Vu samples[VECTORS];
    Vu places[VECTORS];
    unsigned pixels = 0;
    for (int v = 0; v < VECTORS; v++) {
        samples[v] = places[v] = vu_splat(0);
    }
    for (int s = sub->sample_count - 1; s >= first; s--) {
        const unsigned held =
            shared >> s & 1 ? pixels_with(sub->ids + s * DIP_BLOCK_PIXELS, id) & left[s] : 0;
        left[s] &= ~held;
        pixels |= held;
        const Vi place = vi_splat(place_of(sub, pattern->x[s], pattern->y[s]));
        for (int v = 0; v < VECTORS; v++) {
            const Mask mask = mask_from_bits(held >> (v * DIP_LANES) & VEC_ALL_LANES);
            samples[v] |= (Vu)vi_select(mask, vi_splat(1 << s), vi_splat(0));
            places[v] = (Vu)vi_select(mask, place, (Vi)places[v]);
        }
    }
    for (int v = 0; v < VECTORS; v++) {
        if (passes) {
            const Vi centroid = vi_gather(passes->centroid, (Vi)samples[v]);
            places[v] = (Vu)((centroid << DIP_PLACE_SUB_X) + place_of(sub, 0, 0));
        }
        places[v] += (Vu)vi_load(pixel_place + v * DIP_LANES);
    }
    push(sub, id - 1, pixels, samples, places, false);
}

// Starts the sums of mixed pixels with their uncovered samples, of which there are mostly none.
VEC_INLINE void begin_sums(const SubBlock *sub, unsigned mixed,
                           const unsigned empty[DIP_MAX_SAMPLES], unsigned any_empty) {
    DipTileShading *shading = sub->shading;
    const int corner = sub->y0 * DIP_TILE + sub->x0;
    for (unsigned left = mixed; left; left &= left - 1) {
        const int pixel = __builtin_ctz(left);
        const int at = corner + pixel_place[pixel];
        shading->mixed[shading->mixed_count++] = (uint16_t)at;
        memset(shading->sum[at], 0, sizeof shading->sum[at]);
    }
    for (unsigned left = any_empty; left; left &= left - 1) {
        const int pixel = __builtin_ctz(left);
        for (int s = 0; s < sub->sample_count; s++) {
            const int32_t uncovered = (int32_t)(empty[s] >> pixel & 1);
            for (int c = 0; c < 3; c++) {
                shading->sum[corner + pixel_place[pixel]][c] +=
                    shading->clear_linear16[c] * uncovered;
            }
        }
    }
}

VEC_INLINE void push_mixed(const SubBlock *sub, unsigned mixed) {
    unsigned left[DIP_MAX_SAMPLES];
    unsigned empty[DIP_MAX_SAMPLES];
    unsigned any_empty = 0;
    for (int s = 0; s < sub->sample_count; s++) {
        empty[s] = pixels_with(sub->ids + s * DIP_BLOCK_PIXELS, 0) & mixed;
        left[s] = mixed & ~empty[s];
        sub->shading->samples += (unsigned)__builtin_popcount(left[s]);
        any_empty |= empty[s];
    }
    begin_sums(sub, mixed, empty, any_empty);
    for (int s = 0; s < sub->sample_count; s++) {
        while (left[s]) {
            push_mixed_triangle(sub, left, s);
        }
    }
}

static void clear_pixels(const SubBlock *sub, unsigned left) {
    const DipTileShading *shading = sub->shading;
    for (; left; left &= left - 1) {
        const int place = sub->y0 * DIP_TILE + sub->x0 + pixel_place[__builtin_ctz(left)];
        shading->pixels[(size_t)(place / DIP_TILE) * shading->stride + (size_t)(place % DIP_TILE)] =
            shading->clear_rgba8;
    }
}

// The sub-block's pixels that lie in the target.
static unsigned pixels_in_target(const SubBlock *sub) {
    unsigned inside = 0;
    for (int i = 0; i < 16; i++) {
        const bool in =
            sub->x0 + (i & 3) < sub->shading->width && sub->y0 + (i >> 2) < sub->shading->height;
        inside |= (unsigned)in << i;
    }
    return inside;
}

// Pixels among `left`, held by one triangle each, whose triangle has passes.
static unsigned pixels_in_passes(const SubBlock *sub, unsigned left) {
    unsigned found = 0;
    while (left) {
        const uint32_t id = sub->ids[__builtin_ctz(left)];
        const unsigned pixels = pixels_with(sub->ids, id) & left;
        left &= ~pixels;
        found |= id && passes_of(sub->shading, id - 1) ? pixels : 0;
    }
    return found;
}

// passed: may hold triangles with passes.
static void collect_sub_block(const SubBlock *sub, bool passed) {
    const bool within = sub->x0 + 4 <= sub->shading->width && sub->y0 + 4 <= sub->shading->height;
    unsigned mixed = sub->sample_count > 1 ? mixed_pixels(sub) : 0;
    if (passed) {
        mixed |= pixels_in_passes(sub, ~mixed & ALL_PIXELS);
    }
    if (within && !mixed && sub->ids[0] && pixels_with(sub->ids, sub->ids[0]) == ALL_PIXELS) {
        sub->shading->samples += 16 * (unsigned)sub->sample_count;
        push_whole(sub, sub->ids[0] - 1);
        return;
    }
    const unsigned inside = within ? ALL_PIXELS : pixels_in_target(sub);
    const unsigned uniform = inside & ~mixed;
    const unsigned empty = pixels_with(sub->ids, 0) & uniform;
    clear_pixels(sub, empty);
    sub->shading->samples +=
        (unsigned)__builtin_popcount(uniform & ~empty) * (unsigned)sub->sample_count;
    push_uniform(sub, uniform & ~empty);
    if (mixed & inside) {
        push_mixed(sub, mixed & inside);
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

VEC_INLINE bool is_drawn(const DipTile *tile, int block) {
    const int x = block % DIP_TILE_BLOCKS * DIP_BLOCK;
    const int y = block / DIP_TILE_BLOCKS * DIP_BLOCK;
    return x >= tile->left && y >= tile->top && x < DIP_TILE - tile->right &&
           y < DIP_TILE - tile->bottom;
}

void DIP_KERNEL(dip_kernel_collect)(DipTileShading *shading) {
    const DipTile *tile = shading->tile;
    for (int block = 0; block < DIP_BLOCKS; block++) {
        if (!is_drawn(tile, block)) {
            continue;
        }
        if (!(tile->touched >> block & 1)) {
            clear_block(shading, block);
            continue;
        }
        const uint32_t *ids = tile->id + dip_tile_index(tile, block, 0);
        for (int quarter = 0; quarter < 4; quarter++) {
            const SubBlock sub = {shading, ids + quarter * 16, tile->pattern->count,
                                  block % DIP_TILE_BLOCKS * DIP_BLOCK + (quarter & 1) * 4,
                                  block / DIP_TILE_BLOCKS * DIP_BLOCK + (quarter >> 1) * 4};
            collect_sub_block(&sub, tile->passed >> block & 1);
        }
    }
}
