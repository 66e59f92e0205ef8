// Coverage and depth of one triangle of a plain draw (state.h) in one tile, compiled once per
// instruction set.
#include "renderer/pipeline/raster/in_tile_simd.h"

// Returns the lanes among `equal` that show a later draw than `draw`.
static unsigned lanes_of_later_draws(const DipTile *tile, const uint32_t *ids, unsigned equal,
                                     uint32_t draw) {
    unsigned later = 0;
    for (; equal; equal &= equal - 1) {
        const int lane = __builtin_ctz(equal);
        if (ids[lane] && tile->near_to_far[ids[lane] - 1].draw > draw) {
            later |= 1u << lane;
        }
    }
    return later;
}

// Returns the lanes in which a triangle of `draw` with these depths hides what the tile holds: it
// is nearer or, near to far, equally near and of an earlier draw. at: index of the vector in the
// tile's arrays. old: the depths there. No depth is negative, so equal depths have equal bits.
VEC_INLINE Mask hiding_lanes(const DipTile *tile, int at, Vf old, Vf depth, uint32_t draw,
                             bool near_to_far) {
    const Mask nearer = vf_lt(old, depth);
    if (near_to_far) {
        const unsigned equal = mask_bits(vi_eq((Vi)old, (Vi)depth));
        if (equal) {
            return nearer | mask_from_bits(lanes_of_later_draws(tile, tile->id + at, equal, draw));
        }
    }
    return nearer;
}

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

// --- alpha-clipped triangles -------------------------------------------------------------------

// Fills in the masks of a waiting sub-block, and finds where each fragment is shaded: at the centre
// of its pixel if the triangle covers all samples, otherwise at the first covered sample.
VEC_INLINE void test_sub_block(const InTile *in, const Region *region, int n, const DipTile *tile,
                               int sample_count, DipWaitingSubBlock *waiting,
                               Vi positions[VECTORS]) {
    const DipSamplePattern *pattern = tile->pattern;
    const bool near_to_far = tile->near_to_far != NULL;
    const float corner = waiting->depth;
    unsigned pixels = 0;
    for (int s = 0; s < sample_count; s++) {
        waiting->visible[s] = 0;
    }
    for (int v = 0; v < VECTORS; v++) {
        const PixelEdges edges = pixel_edges(in, region, n, v);
        unsigned whole = VEC_ALL_LANES;
        positions[v] = sub_position(128, 128);
        for (int s = sample_count - 1; s >= 0; s--) {
            const int at = waiting->first + s * DIP_BLOCK_PIXELS + v * DIP_LANES;
            const Mask covered = covered_lanes(in, &edges, s, sample_count);
            const Mask hiding =
                hiding_lanes(tile, at, vf_load(tile->depth + at),
                             depth_lanes(&in->depths, corner, v, s), in->draw, near_to_far);
            const unsigned visible = mask_bits(covered & hiding) << (v * DIP_LANES);
            waiting->visible[s] |= (uint16_t)visible;
            pixels |= visible;
            whole &= mask_bits(covered);
            positions[v] =
                vi_select(covered, sub_position(pattern->x[s], pattern->y[s]), positions[v]);
        }
        if (sample_count == 1) {
            positions[v] = sub_position(128, 128); // all samples of the pixel are covered
            continue;
        }
        const Mask centre = mask_from_bits(whole);
        positions[v] = vi_select(centre, sub_position(128, 128), positions[v]);
    }
    waiting->pixels = (uint16_t)pixels;
    waiting->samples = (uint16_t)((1u << sample_count) - 1);
}

// Fills in the masks of a waiting sub-block for the samples of one group. Each fragment is shaded
// at the centroid of the group's samples that the triangle covers.
VEC_INLINE void test_group(const InTile *in, const Region *region, int n, const DipTile *tile,
                           const DipSampleGroups *groups, int group, DipWaitingSubBlock *waiting,
                           Vi positions[VECTORS]) {
    const bool near_to_far = tile->near_to_far != NULL;
    const unsigned samples = groups->samples[group];
    unsigned pixels = 0;
    memset(waiting->visible, 0, sizeof waiting->visible);
    for (int v = 0; v < VECTORS; v++) {
        const PixelEdges edges = pixel_edges(in, region, n, v);
        Vi held = vi_splat(0);
        for (unsigned left = samples; left; left &= left - 1) {
            const int s = __builtin_ctz(left);
            const int at = waiting->first + s * DIP_BLOCK_PIXELS + v * DIP_LANES;
            const Mask covered = covered_lanes(in, &edges, s, DIP_MAX_SAMPLES);
            const Mask hiding =
                hiding_lanes(tile, at, vf_load(tile->depth + at),
                             depth_lanes(&in->depths, waiting->depth, v, s), in->draw, near_to_far);
            const unsigned visible = mask_bits(covered & hiding) << (v * DIP_LANES);
            waiting->visible[s] |= (uint16_t)visible;
            pixels |= visible;
            held |= vi_select(covered, vi_splat(1 << s), vi_splat(0));
        }
        positions[v] = vi_gather(groups->centroid, held) << DIP_POSITION_SUB_X;
    }
    waiting->pixels = (uint16_t)pixels;
    waiting->samples = (uint16_t)samples;
}

// Stores the visible samples of the pixels in `keep`. depths: those of the sub-block's triangle.
VEC_INLINE void keep_sub_block(const Depths *depths, DipTile *tile,
                               const DipWaitingSubBlock *waiting, unsigned keep) {
    for (unsigned left = waiting->samples; left; left &= left - 1) {
        const int s = __builtin_ctz(left);
        for (int v = 0; v < VECTORS; v++) {
            const int at = waiting->first + s * DIP_BLOCK_PIXELS + v * DIP_LANES;
            const unsigned bits = (waiting->visible[s] & keep) >> (v * DIP_LANES);
            const Mask mask = mask_from_bits(bits & VEC_ALL_LANES);
            vf_store_lanes(tile->depth + at, mask, depth_lanes(depths, waiting->depth, v, s),
                           vf_load(tile->depth + at));
            vi_store_lanes((int32_t *)tile->id + at, mask,
                           vi_splat((int32_t)waiting->triangle + 1));
        }
    }
}

static uint64_t block_bit(const DipTile *tile, const DipWaitingSubBlock *waiting) {
    return (uint64_t)1 << (waiting->first / (tile->pattern->count * DIP_BLOCK_PIXELS));
}

void DIP_KERNEL(dip_kernel_clip)(DipTile *tile, const DipClipTest *clip) {
    DipClipQueue *queue = clip->queue;
    DipFragmentList *list = clip->list;
    for (int i = list->count; i % DIP_BATCH_ALIGN; i++) {
        list->position[i] = list->position[list->count - 1];
        list->triangle[i] = list->triangle[list->count - 1];
    }
    const uint8_t *bytes = clip->test(clip->context, queue->draw);
    Kept kept;
    find_kept(bytes, list->count, &kept);
    const DipTriangle *triangle = NULL; // whose depths these are
    Depths depths;
    for (int i = 0; i < queue->count; i++) {
        DipWaitingSubBlock *waiting = &queue->waiting[i];
        const unsigned keep = take_kept(&kept, waiting->pixels);
        if (clip->order) {
            drop_samples(waiting->visible, waiting->pixels, bytes, clip->order,
                         tile->pattern->count);
            bytes += __builtin_popcount(waiting->pixels);
        }
        if (!keep) {
            continue;
        }
        if (triangle != &clip->triangles[waiting->triangle]) {
            triangle = &clip->triangles[waiting->triangle];
            set_depths(&depths, triangle, tile->pattern);
        }
        keep_sub_block(&depths, tile, waiting, keep);
        if (clip->groups) {
            tile->grouped |= block_bit(tile, waiting);
        }
    }
    list->count = 0;
    queue->count = 0;
    queue->blocks = 0;
    memset(queue->pixels, 0, sizeof queue->pixels);
}

// Where the current triangle is visible in a region.
typedef struct Visible {
    unsigned sub_blocks; // bit n: in sub-block n
    DipWaitingSubBlock waiting[REGION_SUB_BLOCKS];
    Vi positions[REGION_SUB_BLOCKS][VECTORS];
} Visible;

// Finds where a triangle is visible in a region. If there are sample groups, only the samples of
// `group` count. Returns whether earlier triangles wait for the clip test in some of these pixels.
VEC_INLINE bool find_visible(const DipClipTest *clip, const InTile *in, const Region *region,
                             int group, int sample_count, DipTile *tile, Visible *visible) {
    const uint16_t *pixels_that_wait = clip->queue->pixels;
    unsigned shared = 0;
    visible->sub_blocks = 0;
    for (unsigned left = region->reached; left; left &= left - 1) {
        const int n = __builtin_ctz(left);
        DipWaitingSubBlock *found = &visible->waiting[n];
        const unsigned number = number_of(region, (unsigned)n);
        found->first = touch_sub_block(tile, number, sample_count);
        found->depth = region->depth[n];
        if (sample_count > 1 && clip->groups) {
            test_group(in, region, n, tile, clip->groups, group, found, visible->positions[n]);
        } else {
            test_sub_block(in, region, n, tile, sample_count, found, visible->positions[n]);
        }
        visible->sub_blocks |= (unsigned)(found->pixels != 0) << n;
        shared |= found->pixels & pixels_that_wait[number];
    }
    return shared != 0;
}

// Adds sub-block n to the queue, and its fragments to the list.
VEC_INLINE void queue_sub_block(DipClipQueue *queue, DipFragmentList *list, const Visible *visible,
                                const Region *region, int n, int sample_count, uint32_t id) {
    const DipWaitingSubBlock *found = &visible->waiting[n];
    DipWaitingSubBlock *waiting = &queue->waiting[queue->count++];
    waiting->triangle = id - 1;
    waiting->first = found->first;
    waiting->depth = found->depth;
    waiting->pixels = found->pixels;
    waiting->samples = found->samples;
    for (int s = 0; s < sample_count; s++) {
        waiting->visible[s] = found->visible[s];
    }
    const int corner = (region->y + (int)((unsigned)n / REGION)) * DIP_SUB_BLOCK * DIP_TILE +
                       (region->x + (int)((unsigned)n % REGION)) * DIP_SUB_BLOCK;
    int count = list->count;
    for (int v = 0; v < VECTORS; v++) {
        const unsigned pixels = found->pixels >> (v * DIP_LANES) & VEC_ALL_LANES;
        const Vi pixel = (vi_load(lane_y + v * DIP_LANES) << DIP_POSITION_Y) +
                         (vi_load(lane_x + v * DIP_LANES) + corner);
        vu_store(list->triangle + count, vu_splat(id - 1));
        count +=
            vu_compress(list->position + count, pixels, (Vu)(visible->positions[n][v] | pixel));
    }
    list->count = count;
}

VEC_INLINE void clip_region(const DipClipTest *clip, const InTile *in, const Region *region,
                            int sample_count, DipTile *tile, uint32_t id) {
    const int group_count = sample_count > 1 && clip->groups ? clip->groups->count : 1;
    uint16_t queued[REGION_SUB_BLOCKS] = {0}; // pixels; groups share pixels, but no samples
    for (int group = 0; group < group_count; group++) {
        Visible visible;
        while (find_visible(clip, in, region, group, sample_count, tile, &visible)) {
            DIP_KERNEL(dip_kernel_clip)(tile, clip);
        }
        for (unsigned left = visible.sub_blocks; left; left &= left - 1) {
            const int n = __builtin_ctz(left);
            if (clip->list->count > DIP_FRAGMENT_BATCH - DIP_SUB_BLOCK_PIXELS) {
                DIP_KERNEL(dip_kernel_clip)(tile, clip);
            }
            queue_sub_block(clip->queue, clip->list, &visible, region, n, sample_count, id);
            queued[n] |= visible.waiting[n].pixels;
        }
    }
    for (unsigned left = region->reached; left; left &= left - 1) {
        const unsigned n = (unsigned)__builtin_ctz(left);
        const unsigned number = number_of(region, n);
        clip->queue->pixels[number] |= queued[n];
        clip->queue->blocks |= (uint64_t)(queued[n] != 0) << number / 4;
    }
}

// --- small opaque triangles ----------------------------------------------------------------------

// Most sub-blocks in the box of a small triangle. The set-up of a region costs more than testing
// the pixels of so few sub-blocks.
enum { SMALL_BOX = 10 };

// A small triangle in a tile with one sample per pixel. The edge values are those of InTile.
typedef struct SmallTriangle {
    uint32_t draw;
    Vi edge[3][VECTORS]; // at the pixels of the current sub-block
    Vi right[3];         // what a step of one sub-block to the right adds
    Vi down[3];          // what a step down and back to the box's first column adds
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
    const int64_t at_x = (int64_t)x * DIP_SUBPIXELS + pattern->x[0];
    const int64_t at_y = (int64_t)y * DIP_SUBPIXELS + pattern->y[0];
    for (int i = 0; i < 3; i++) {
        const int32_t a = triangle->a[i];
        const int32_t b = triangle->b[i];
        const int64_t value = triangle->c[i] + (a * at_x + b * at_y);
        const int32_t corner = (int32_t)(max_i64(min_i64(value, limit), -limit) >> 8);
        small->right[i] = vi_splat(a * DIP_SUB_BLOCK);
        small->down[i] = vi_splat((b - a * (box->x1 - box->x0 + 1)) * DIP_SUB_BLOCK);
        for (int v = 0; v < VECTORS; v++) {
            small->edge[i][v] = vi_splat(a) * vi_load(lane_x + v * DIP_LANES) +
                                (vi_splat(b) * vi_load(lane_y + v * DIP_LANES) + vi_splat(corner));
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

VEC_INLINE void step_small(SmallTriangle *small, const Vi by[3]) {
    for (int i = 0; i < 3; i++) {
        for (int v = 0; v < VECTORS; v++) {
            small->edge[i][v] += by[i];
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
