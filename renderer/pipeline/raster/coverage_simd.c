// Coverage and depth of one triangle of a plain draw (state.h) in one tile, compiled once per
// instruction set.
#include "renderer/pipeline/raster/clip_queue_simd.h"
#include "renderer/pipeline/raster/hiding_simd.h"
#include "renderer/pipeline/raster/in_tile_simd.h"

#include <stddef.h>

// Draws an opaque triangle in sub-block n: stores the covered samples in which it hides the stored
// depths. inside: the triangle covers all samples of the sub-block.
VEC_INLINE void draw_sub_block(const InTile *in, const Region *region, int n, bool inside,
                               int sample_count, bool near_to_far, DipTile *tile, uint32_t id) {
    const int first = touch_sub_block(tile, number_of(region, (unsigned)n), sample_count);
    float *const depths = tile->depth + first;
    int32_t *const ids = (int32_t *)tile->id + first;
    for (int v = 0; v < VECTORS; v++) {
        const PixelEdges edges = pixel_edges(in, region, n, v);
        for (int s = 0; s < sample_count; s++) {
            const int at = s * DIP_BLOCK_PIXELS + v * DIP_LANES;
            const Vf old = vf_load(depths + at);
            const Vf depth = depth_lanes(&in->depths, region->depth[n], v, s);
            Mask hiding = hiding_lanes(tile, first + at, old, depth, in->draw, near_to_far);
            if (!inside) {
                hiding = hiding & covered_lanes(in, &edges, s, sample_count);
            }
            vf_store_lanes(depths + at, hiding, depth, old);
            vi_store_lanes(ids + at, hiding, vi_splat((int32_t)id));
        }
    }
}

// Draws an opaque triangle in a region. The edge tests are left out only if the triangle covers
// every sub-block that it reaches in the region. If some are partly covered, a branch per sub-block
// costs more than the edge tests.
VEC_INLINE void draw_region(const InTile *in, const Region *region, int sample_count,
                            bool near_to_far, DipTile *tile, uint32_t id) {
    if (region->inside == region->reached) {
        for (unsigned left = region->reached; left; left &= left - 1) {
            draw_sub_block(in, region, __builtin_ctz(left), true, sample_count, near_to_far, tile,
                           id);
        }
    } else {
        for (unsigned left = region->reached; left; left &= left - 1) {
            draw_sub_block(in, region, __builtin_ctz(left), false, sample_count, near_to_far, tile,
                           id);
        }
    }
}

// --- small opaque triangles ----------------------------------------------------------------------

// Most sub-blocks in the box of a small triangle. The set-up of a region costs more than testing
// the pixels of so few sub-blocks.
enum { SMALL_BOX = 10 };

// Values of the three edges, and a fourth that is 0 or is not used.
typedef int32_t EdgeInts __attribute__((vector_size(4 * sizeof(int32_t))));
typedef int64_t EdgeLongs __attribute__((vector_size(4 * sizeof(int64_t))));

// A small triangle in a tile with one sample per pixel. The edge values are those of InTile.
typedef struct SmallTriangle {
    uint32_t draw;
    Vi edge[3][VECTORS]; // at the pixels of the current sub-block
    EdgeInts right;      // what a step of one sub-block to the right adds
    EdgeInts down;       // what a step down and back to the box's first column adds
    Vf depth_lane[VECTORS];
    Vf depth_sample;
    Vf depth_min;
    Vf depth_max;
} SmallTriangle;

// Sets the edge values at the box's first sub-block. x and y: the sub-block's first pixel in the
// target. An edge value that is clamped has the same sign in all sub-blocks of the box.
VEC_INLINE void set_small_edges(SmallTriangle *small, const DipTriangle *triangle, const Box *box,
                                const DipSamplePattern *pattern, int x, int y) {
    const int64_t limit = (int64_t)1 << 38;
    EdgeLongs value;
    EdgeInts a;
    EdgeInts b;
    memcpy(&value, (const char *)triangle + offsetof(DipTriangle, c), sizeof value);
    memcpy(&a, (const char *)triangle + offsetof(DipTriangle, a), sizeof a);
    memcpy(&b, (const char *)triangle + offsetof(DipTriangle, b), sizeof b);
    const EdgeInts edges = {-1, -1, -1, 0};
    a &= edges;
    b &= edges;
    value += __builtin_convertvector(a, EdgeLongs) * ((int64_t)x * DIP_SUBPIXELS + pattern->x[0]) +
             __builtin_convertvector(b, EdgeLongs) * ((int64_t)y * DIP_SUBPIXELS + pattern->y[0]);
    const EdgeLongs above = value > limit;
    const EdgeLongs below = value < -limit;
    value = (above & limit) | (below & -limit) | (value & ~(above | below));
    const EdgeInts corner = __builtin_convertvector(value >> 8, EdgeInts);
    small->right = a * DIP_SUB_BLOCK;
    small->down = (b - a * (box->x1 - box->x0 + 1)) * DIP_SUB_BLOCK;
    for (int i = 0; i < 3; i++) {
        for (int v = 0; v < VECTORS; v++) {
            small->edge[i][v] =
                vi_splat(a[i]) * vi_load(lane_x + v * DIP_LANES) +
                (vi_splat(b[i]) * vi_load(lane_y + v * DIP_LANES) + vi_splat(corner[i]));
        }
    }
}

VEC_INLINE void set_small_depths(SmallTriangle *small, const DipTriangle *triangle,
                                 const DipSamplePattern *pattern) {
    const float dx = (float)triangle->z_dx;
    const float dy = (float)triangle->z_dy;
    for (int v = 0; v < VECTORS; v++) {
        small->depth_lane[v] = vf_splat(dx) * vf_from_int(vi_load(lane_x + v * DIP_LANES)) +
                               vf_splat(dy) * vf_from_int(vi_load(lane_y + v * DIP_LANES));
    }
    small->depth_sample = vf_splat(dx * ((float)pattern->x[0] * (1.0f / 256.0f)) +
                                   dy * ((float)pattern->y[0] * (1.0f / 256.0f)));
    small->depth_min = vf_splat(triangle->z_min);
    small->depth_max = vf_splat(triangle->z_max);
}

VEC_INLINE void step_small(SmallTriangle *small, EdgeInts by) {
    for (int i = 0; i < 3; i++) {
        for (int v = 0; v < VECTORS; v++) {
            small->edge[i][v] += vi_splat(by[i]);
        }
    }
}

// Draws the current sub-block, which has the column x and the row y in the tile. corner: the depth
// at the sub-block's corner. Returns whether the triangle covers all pixels. The loop has no branch
// for sub-blocks without covered pixels, since nothing predicts which they are.
VEC_INLINE bool draw_small_sub_block(const SmallTriangle *small, unsigned x, unsigned y,
                                     float corner, bool near_to_far, DipTile *tile, uint32_t id) {
    const unsigned block = y / 2 * DIP_TILE_BLOCKS + x / 2;
    const unsigned quarter = y % 2 * 2 + x % 2;
    if (!(tile->touched >> block & 1)) {
        clear_block(tile, (int)block, 1);
    }
    const unsigned first = block * DIP_BLOCK_PIXELS + quarter * DIP_SUB_BLOCK_PIXELS;
    unsigned all = VEC_ALL_LANES;
    for (int v = 0; v < VECTORS; v++) {
        const Mask covered =
            vi_not_negative(small->edge[0][v] | small->edge[1][v] | small->edge[2][v]);
        float *const depths = tile->depth + first + v * DIP_LANES;
        const Vf old = vf_load(depths);
        const Vf unbounded = (vf_splat(corner) + small->depth_lane[v]) + small->depth_sample;
        const Vf depth = vf_min(vf_max(unbounded, small->depth_min), small->depth_max);
        const int at = (int)first + v * DIP_LANES;
        const Mask hiding = hiding_lanes(tile, at, old, depth, small->draw, near_to_far) & covered;
        all &= mask_bits(covered);
        vf_store_lanes(depths, hiding, depth, old);
        vi_store_lanes((int32_t *)tile->id + at, hiding, vi_splat((int32_t)id));
    }
    return all == VEC_ALL_LANES;
}

// Draws an opaque triangle whose box has at most SMALL_BOX sub-blocks, in a tile with one sample
// per pixel.
VEC_INLINE void draw_small(DipTile *tile, const DipTriangle *triangle, const Box *box,
                           bool near_to_far, uint32_t id) {
    SmallTriangle small;
    small.draw = triangle->draw;
    set_small_edges(&small, triangle, box, tile->pattern, tile->x0 + box->x0 * DIP_SUB_BLOCK,
                    tile->y0 + box->y0 * DIP_SUB_BLOCK);
    set_small_depths(&small, triangle, tile->pattern);
    unsigned accepted = 0;
    for (int y = box->y0; y <= box->y1; y++) {
        const double from_row = triangle->z_dy * (double)(tile->y0 + y * DIP_SUB_BLOCK);
        for (int x = box->x0; x <= box->x1; x++) {
            // As in set_corner_depths.
            const double at = triangle->z_dx * (double)(tile->x0 + x * DIP_SUB_BLOCK);
            const float corner = (float)((triangle->z_origin + at) + from_row);
            accepted += draw_small_sub_block(&small, (unsigned)x, (unsigned)y, corner, near_to_far,
                                             tile, id);
            step_small(&small, small.right);
        }
        step_small(&small, small.down);
    }
    tile->sub_blocks_accepted += accepted;
}

// --- the bounds of blocks ----------------------------------------------------------------------

// A bound is found anew only after this many opaque triangles have been drawn in its block. The
// fragments of clipped triangles cost more, so one triangle is enough for them.
enum { OPAQUE_WAIT = 6, CLIPPED_WAIT = 1 };

// Finds the smallest depth of a block's samples.
static void find_bound(DipTile *tile, int block, int sample_count) {
    const int count = sample_count * DIP_BLOCK_PIXELS;
    const float *depths = tile->depth + block * count;
    Vf least = vf_load(depths);
    for (int i = DIP_LANES; i < count; i += DIP_LANES) {
        least = vf_min(least, vf_load(depths + i));
    }
    float lanes[DIP_LANES];
    vf_store(lanes, least);
    float bound = lanes[0];
    for (int i = 1; i < DIP_LANES; i++) {
        bound = lanes[i] < bound ? lanes[i] : bound;
    }
    tile->bound[block] = bound;
    tile->drawn[block] = 0;
}

// Whether all samples of the blocks in a box are nearer than the depth z. Finds bounds anew if
// enough triangles have been drawn in their blocks.
VEC_INLINE bool hidden(DipTile *tile, const DipClipTest *clip, const Box *box, float z,
                       int sample_count) {
    const int wait = clip ? CLIPPED_WAIT : OPAQUE_WAIT;
    for (int y = box->y0 / 2; y <= box->y1 / 2; y++) {
        for (int x = box->x0 / 2; x <= box->x1 / 2; x++) {
            const int block = y * DIP_TILE_BLOCKS + x;
            if (z < tile->bound[block]) {
                continue;
            }
            if (tile->drawn[block] < wait || !(tile->touched >> block & 1)) {
                return false;
            }
            if (clip && clip->queue->blocks >> block & 1) {
                DIP_KERNEL(dip_kernel_clip)(tile, clip);
            }
            find_bound(tile, block, sample_count);
            if (z >= tile->bound[block]) {
                return false;
            }
        }
    }
    return true;
}

// Notes that a triangle is drawn in the blocks of a box.
VEC_INLINE void count_drawn(DipTile *tile, const Box *box) {
    for (int y = box->y0 / 2; y <= box->y1 / 2; y++) {
        for (int x = box->x0 / 2; x <= box->x1 / 2; x++) {
            uint8_t *drawn = &tile->drawn[y * DIP_TILE_BLOCKS + x];
            *drawn = (uint8_t)(*drawn + (*drawn < UINT8_MAX));
        }
    }
}

// --- a triangle --------------------------------------------------------------------------------

// Draws a triangle, region by region of its pixel box. Callers pass a constant sample_count and
// near_to_far where this makes the code faster.
VEC_INLINE void draw_in_tile(DipTile *tile, const DipTriangle *triangle, uint32_t id,
                             const DipClipTest *clip, int sample_count, bool near_to_far) {
    const Box box = box_of(triangle, tile);
    if (near_to_far) {
        if ((clip || sample_count > 1) && hidden(tile, clip, &box, triangle->z_max, sample_count)) {
            return;
        }
        count_drawn(tile, &box);
    }
    tile->sub_blocks_tested += sub_blocks_in(&box);
    if (sample_count == 1 && !clip && sub_blocks_in(&box) <= SMALL_BOX) {
        draw_small(tile, triangle, &box, near_to_far, id);
        return;
    }
    InTile in;
    set_up_in_tile(&in, triangle, tile);
    for (int y = box.y0; y <= box.y1; y += REGION) {
        for (int x = box.x0; x <= box.x1; x += REGION) {
            Region region;
            if (!region_at(&in, triangle, tile, &box, x, y, &region)) {
                continue;
            }
            tile->sub_blocks_accepted += (uint64_t)__builtin_popcount(region.inside);
            if (clip) {
                clip_region(clip, &in, &region, sample_count, tile, id);
            } else {
                draw_region(&in, &region, sample_count, near_to_far, tile, id);
            }
        }
    }
}

static void draw_clipped(DipTile *tile, const DipTriangle *triangle, uint32_t id,
                         const DipClipTest *clip) {
    clip->queue->draw = triangle->draw;
    if (tile->pattern->count == 1) {
        draw_in_tile(tile, triangle, id, clip, 1, tile->near_to_far != NULL);
    } else {
        draw_in_tile(tile, triangle, id, clip, tile->pattern->count, tile->near_to_far != NULL);
    }
}

// Two versions for each sample count, so that the compiler unrolls loops over samples, and passes
// in submission order pay nothing for the other order.
#define DRAW_SAMPLES(n)                                                                            \
    static void draw_##n(DipTile *tile, const DipTriangle *triangle, uint32_t id) {                \
        draw_in_tile(tile, triangle, id, NULL, n, false);                                          \
    }                                                                                              \
    static void draw_near_##n(DipTile *tile, const DipTriangle *triangle, uint32_t id) {           \
        draw_in_tile(tile, triangle, id, NULL, n, true);                                           \
    }
DRAW_SAMPLES(1)
DRAW_SAMPLES(2)
DRAW_SAMPLES(4)
DRAW_SAMPLES(6)
DRAW_SAMPLES(8)

void DIP_KERNEL(dip_kernel_draw_triangle)(DipTile *tile, const DipTriangle *triangle, uint32_t id,
                                          const DipClipTest *clip) {
    typedef void Draw(DipTile *, const DipTriangle *, uint32_t);
    static Draw *const draw[2][DIP_MAX_SAMPLES + 1] = {
        {[1] = draw_1, [2] = draw_2, [4] = draw_4, [6] = draw_6, [8] = draw_8},
        {[1] = draw_near_1,
         [2] = draw_near_2,
         [4] = draw_near_4,
         [6] = draw_near_6,
         [8] = draw_near_8}};
    if (clip) {
        draw_clipped(tile, triangle, id, clip);
    } else {
        draw[tile->near_to_far != NULL][tile->pattern->count](tile, triangle, id);
    }
}
