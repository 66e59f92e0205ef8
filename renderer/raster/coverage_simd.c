// Coverage and depth of one triangle in one tile, compiled once per instruction set.
//
// Edge values E = a x + b y + c (x, y in 1/256 pixel) need 64 bits. Within a tile they are split
// as x = 256 px + sx: E >= 0 if and only if a px + b py + floor((c' + a sx + b sy) / 256) >= 0,
// where c' is E at the tile's corner, because the first two terms are whole multiples of 256. An
// edge that crosses the tile keeps this within 2^30; an edge that does not is dropped. So the inner
// loops are exact in 32 bits.
#include "renderer/raster/kernels.h"
#include "renderer/simd/vec.h"

enum { VECTORS = 16 / DIP_LANES }; // per sub-block

// Pixels of a 4x4 sub-block in lane order.
static const int32_t lane_x[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
static const int32_t lane_y[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};

// One triangle within the tile. Edge values are in units of 256, at the tile's corner.
typedef struct InTile {
    int32_t a[3];
    int32_t b[3];
    int32_t k[3][DIP_MAX_SAMPLES]; // per sample
    int32_t k_min[3];              // over the samples
    int32_t k_max[3];
    Vi edge_lane[3][VECTORS]; // a px + b py of a sub-block's pixels
    Vf depth_lane[VECTORS];   // likewise for depth
    float depth_sample[DIP_MAX_SAMPLES];
} InTile;

static inline int32_t min_i32(int32_t a, int32_t b) {
    return a < b ? a : b;
}

static inline int32_t max_i32(int32_t a, int32_t b) {
    return a > b ? a : b;
}

// Prepares edge i for the pixels x0..x1, y0..y1 of the tile; false when none of them is inside.
static bool place_edge(InTile *in, int i, const DipTriangle *triangle, const DipTile *tile,
                       const int box[4]) {
    const int64_t a = triangle->a[i];
    const int64_t b = triangle->b[i];
    const int64_t c = triangle->c[i] + (a * tile->x0 + b * tile->y0) * DIP_SUBPIXELS;
    const DipSamplePattern *pattern = tile->pattern;
    int64_t low = INT64_MAX;
    int64_t high = INT64_MIN;
    int64_t value[DIP_MAX_SAMPLES];
    for (int s = 0; s < pattern->count; s++) {
        value[s] = c + a * pattern->x[s] + b * pattern->y[s];
        low = value[s] < low ? value[s] : low;
        high = value[s] > high ? value[s] : high;
    }
    const int64_t highest =
        high + DIP_SUBPIXELS * (a * box[a > 0 ? 2 : 0] + b * box[b > 0 ? 3 : 1]);
    if (highest < 0) {
        return false;
    }
    const int64_t lowest = low + DIP_SUBPIXELS * (a * box[a > 0 ? 0 : 2] + b * box[b > 0 ? 1 : 3]);
    const bool crosses = lowest < 0;
    in->a[i] = crosses ? (int32_t)a : 0;
    in->b[i] = crosses ? (int32_t)b : 0;
    for (int s = 0; s < pattern->count; s++) {
        in->k[i][s] = crosses ? (int32_t)(value[s] >> 8) : 0;
    }
    in->k_min[i] = crosses ? (int32_t)(low >> 8) : 0;
    in->k_max[i] = crosses ? (int32_t)(high >> 8) : 0;
    for (int v = 0; v < VECTORS; v++) {
        in->edge_lane[i][v] = vi_splat(in->a[i]) * vi_load(lane_x + v * DIP_LANES) +
                              vi_splat(in->b[i]) * vi_load(lane_y + v * DIP_LANES);
    }
    return true;
}

static void place_depth(InTile *in, const DipTriangle *triangle, const DipSamplePattern *pattern) {
    const float dx = (float)triangle->z_dx;
    const float dy = (float)triangle->z_dy;
    for (int v = 0; v < VECTORS; v++) {
        in->depth_lane[v] = vf_splat(dx) * vf_from_int(vi_load(lane_x + v * DIP_LANES)) +
                            vf_splat(dy) * vf_from_int(vi_load(lane_y + v * DIP_LANES));
    }
    for (int s = 0; s < pattern->count; s++) {
        in->depth_sample[s] =
            dx * ((float)pattern->x[s] / 256.0f) + dy * ((float)pattern->y[s] / 256.0f);
    }
}

// Depth at the corner of a sub-block, from absolute coordinates so that tiles do not matter.
static inline float depth_at(const DipTriangle *triangle, int x, int y) {
    return (float)(triangle->z_origin + triangle->z_dx * x + triangle->z_dy * y);
}

// One 4x4 sub-block at (x, y) of the tile: the samples inside the triangle and nearer than before.
// write: store them; else: report their bits, shifted to the sub-block's place.
typedef struct SubBlock {
    const DipTriangle *triangle;
    const InTile *in;
    DipTile *tile;
    int x, y;    // pixels in the tile
    int first;   // index of the sub-block's first sample-0 value in the tile's arrays
    bool inside; // wholly inside the triangle
} SubBlock;

VEC_INLINE Mask covered_lanes(const SubBlock *sub, const int32_t base[3], int v, int s) {
    const InTile *in = sub->in;
    const Vi e0 = in->edge_lane[0][v] + vi_splat(base[0] + in->k[0][s]);
    const Vi e1 = in->edge_lane[1][v] + vi_splat(base[1] + in->k[1][s]);
    const Vi e2 = in->edge_lane[2][v] + vi_splat(base[2] + in->k[2][s]);
    return vi_not_negative(e0 | e1 | e2);
}

VEC_INLINE Vf depth_lanes(const SubBlock *sub, float base, int v, int s) {
    const Vf depth = (vf_splat(base) + sub->in->depth_lane[v]) + vf_splat(sub->in->depth_sample[s]);
    return vf_min(vf_max(depth, vf_splat(sub->triangle->z_min)), vf_splat(sub->triangle->z_max));
}

VEC_INLINE void edge_bases(const SubBlock *sub, int32_t base[3]) {
    for (int i = 0; i < 3; i++) {
        base[i] = sub->in->a[i] * sub->x + sub->in->b[i] * sub->y;
    }
}

VEC_INLINE void write_sub_block(const SubBlock *sub, uint32_t id) {
    int32_t base[3];
    edge_bases(sub, base);
    const float depth_base =
        depth_at(sub->triangle, sub->tile->x0 + sub->x, sub->tile->y0 + sub->y);
    const int sample_count = sub->tile->pattern->count;
    for (int s = 0; s < sample_count; s++) {
        for (int v = 0; v < VECTORS; v++) {
            const int at = sub->first + s * DIP_BLOCK_PIXELS + v * DIP_LANES;
            const Vf old = vf_load(sub->tile->depth + at);
            const Vf depth = depth_lanes(sub, depth_base, v, s);
            Mask nearer = vf_lt(old, depth);
            if (!sub->inside) {
                nearer = nearer & covered_lanes(sub, base, v, s);
            }
            vf_store(sub->tile->depth + at, vf_select(nearer, depth, old));
            const Vi old_id = vi_load((const int32_t *)sub->tile->id + at);
            vi_store((int32_t *)sub->tile->id + at,
                     vi_select(nearer, vi_splat((int32_t)id), old_id));
        }
    }
}

// Fills the sub-block's 16 bits of every sample, shifted to their place in the block.
VEC_INLINE void test_sub_block(const SubBlock *sub, int shift, DipBlockCoverage *coverage) {
    int32_t base[3];
    edge_bases(sub, base);
    const float depth_base =
        depth_at(sub->triangle, sub->tile->x0 + sub->x, sub->tile->y0 + sub->y);
    for (int s = 0; s < sub->tile->pattern->count; s++) {
        for (int v = 0; v < VECTORS; v++) {
            const Vf old =
                vf_load(sub->tile->depth + sub->first + s * DIP_BLOCK_PIXELS + v * DIP_LANES);
            const Mask nearer = vf_lt(old, depth_lanes(sub, depth_base, v, s));
            const uint64_t covered =
                sub->inside ? VEC_ALL_LANES : mask_bits(covered_lanes(sub, base, v, s));
            coverage->covered[s] |= covered << (shift + v * DIP_LANES);
            coverage->visible[s] |= (covered & mask_bits(nearer)) << (shift + v * DIP_LANES);
        }
    }
}

// Stores the samples of `keep` pixels that the test found visible.
VEC_INLINE void keep_sub_block(const SubBlock *sub, int shift, const DipBlockCoverage *coverage,
                               uint64_t keep, uint32_t id) {
    const float depth_base =
        depth_at(sub->triangle, sub->tile->x0 + sub->x, sub->tile->y0 + sub->y);
    for (int s = 0; s < sub->tile->pattern->count; s++) {
        for (int v = 0; v < VECTORS; v++) {
            const int at = sub->first + s * DIP_BLOCK_PIXELS + v * DIP_LANES;
            const uint64_t bits = (coverage->visible[s] & keep) >> (shift + v * DIP_LANES);
            const Mask mask = mask_from_bits((unsigned)bits & VEC_ALL_LANES);
            const Vf old = vf_load(sub->tile->depth + at);
            vf_store(sub->tile->depth + at,
                     vf_select(mask, depth_lanes(sub, depth_base, v, s), old));
            const Vi old_id = vi_load((const int32_t *)sub->tile->id + at);
            vi_store((int32_t *)sub->tile->id + at, vi_select(mask, vi_splat((int32_t)id), old_id));
        }
    }
}

// A square of pixels at (x, y) against the edges: -1 outside, 1 inside, 0 in between. span: its
// side less one.
VEC_INLINE int classify(const InTile *in, int x, int y, int span) {
    int result = 1;
    for (int i = 0; i < 3; i++) {
        const int32_t at = in->a[i] * x + in->b[i] * y;
        const int32_t reach_x = in->a[i] * span;
        const int32_t reach_y = in->b[i] * span;
        if (at + in->k_max[i] + max_i32(reach_x, 0) + max_i32(reach_y, 0) < 0) {
            return -1;
        }
        if (at + in->k_min[i] + min_i32(reach_x, 0) + min_i32(reach_y, 0) < 0) {
            result = 0;
        }
    }
    return result;
}

static void touch_block(DipTile *tile, int block) {
    if (!(tile->touched >> block & 1)) {
        tile->touched |= (uint64_t)1 << block;
        const size_t count = (size_t)tile->pattern->count * DIP_BLOCK_PIXELS;
        memset(tile->depth + dip_tile_index(tile, block, 0), 0, count * sizeof *tile->depth);
        memset(tile->id + dip_tile_index(tile, block, 0), 0, count * sizeof *tile->id);
    }
}

// The quarter of a block at (x, y) of the tile.
VEC_INLINE SubBlock sub_block(const DipTriangle *triangle, const InTile *in, DipTile *tile,
                              int block, int quarter) {
    SubBlock sub = {.triangle = triangle, .in = in, .tile = tile};
    sub.x = block % DIP_TILE_BLOCKS * DIP_BLOCK + (quarter & 1) * 4;
    sub.y = block / DIP_TILE_BLOCKS * DIP_BLOCK + (quarter >> 1) * 4;
    sub.first = dip_tile_index(tile, block, 0) + quarter * 16;
    return sub;
}

// Whether the triangle's pixel box reaches into a quarter: most quarters that small triangles miss
// are found here, before their edges are looked at.
VEC_INLINE bool in_box(const SubBlock *sub) {
    const int x = sub->tile->x0 + sub->x;
    const int y = sub->tile->y0 + sub->y;
    return sub->triangle->x0 < x + 4 && sub->triangle->x1 >= x && sub->triangle->y0 < y + 4 &&
           sub->triangle->y1 >= y;
}

static void draw_block(const DipTriangle *triangle, const InTile *in, DipTile *tile, int block,
                       int state, uint32_t id) {
    for (int quarter = 0; quarter < 4; quarter++) {
        SubBlock sub = sub_block(triangle, in, tile, block, quarter);
        if (!in_box(&sub)) {
            continue;
        }
        const int inside = state > 0 ? 1 : classify(in, sub.x, sub.y, 3);
        if (inside >= 0) {
            sub.inside = inside > 0;
            write_sub_block(&sub, id);
        }
    }
}

static void draw_clipped_block(const DipTriangle *triangle, const InTile *in, DipTile *tile,
                               int block, int state, uint32_t id, DipClipTest *clip_test,
                               void *clip_context) {
    DipBlockCoverage coverage = {{0}, {0}};
    SubBlock subs[4];
    for (int quarter = 0; quarter < 4; quarter++) {
        subs[quarter] = sub_block(triangle, in, tile, block, quarter);
        const int inside = state > 0 ? 1 : classify(in, subs[quarter].x, subs[quarter].y, 3);
        subs[quarter].inside = inside > 0;
        if (inside >= 0 && in_box(&subs[quarter])) {
            test_sub_block(&subs[quarter], quarter * 16, &coverage);
        }
    }
    uint64_t visible = 0;
    for (int s = 0; s < tile->pattern->count; s++) {
        visible |= coverage.visible[s];
    }
    if (!visible) {
        return;
    }
    const uint64_t keep = clip_test(clip_context, tile, triangle, block, &coverage) & visible;
    for (int quarter = 0; quarter < 4; quarter++) {
        if (keep >> (quarter * 16) & 0xffff) {
            keep_sub_block(&subs[quarter], quarter * 16, &coverage, keep, id);
        }
    }
}

void DIP_KERNEL(dip_kernel_draw_triangle)(DipTile *tile, const DipTriangle *triangle, uint32_t id,
                                          DipClipTest *clip_test, void *clip_context) {
    const int first_x = max_i32(triangle->x0 - tile->x0, 0) / DIP_BLOCK;
    const int first_y = max_i32(triangle->y0 - tile->y0, 0) / DIP_BLOCK;
    const int last_x = min_i32(triangle->x1 - tile->x0, DIP_TILE - 1) / DIP_BLOCK;
    const int last_y = min_i32(triangle->y1 - tile->y0, DIP_TILE - 1) / DIP_BLOCK;
    const int box[4] = {first_x * DIP_BLOCK, first_y * DIP_BLOCK, last_x * DIP_BLOCK + 7,
                        last_y * DIP_BLOCK + 7};
    InTile in;
    for (int i = 0; i < 3; i++) {
        if (!place_edge(&in, i, triangle, tile, box)) {
            return;
        }
    }
    place_depth(&in, triangle, tile->pattern);
    for (int y = first_y; y <= last_y; y++) {
        for (int x = first_x; x <= last_x; x++) {
            const int state = classify(&in, x * DIP_BLOCK, y * DIP_BLOCK, DIP_BLOCK - 1);
            tile->blocks_tested++;
            if (state < 0) {
                continue;
            }
            tile->blocks_accepted += state > 0;
            const int block = y * DIP_TILE_BLOCKS + x;
            touch_block(tile, block);
            if (clip_test) {
                draw_clipped_block(triangle, &in, tile, block, state, id, clip_test, clip_context);
            } else {
                draw_block(triangle, &in, tile, block, state, id);
            }
        }
    }
}
