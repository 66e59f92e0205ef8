// Coverage, stencil test and depth test of one triangle of an ordered draw (pipeline/state.h) in
// one tile, compiled once per instruction set. The samples that pass take effect at once: their
// depths and stencil values are stored before the next triangle is tested. Their fragments are
// queued to be shaded and blended.
#include "renderer/pipeline/merge/ordered.h"
#include "renderer/pipeline/raster/in_tile_simd.h"

// A triangle of an ordered draw within the tile.
typedef struct OrderedTriangle {
    InTile in;
    uint32_t index;
    const DipStencilFace *face;
    bool biased;
    float bias;          // what the slope adds to the depth
    float relative_bias; // what is added for each unit of depth
    bool wireframe;
    int32_t reach[3]; // wireframe: greatest edge values of samples on the lines, -1 for none
} OrderedTriangle;

// The covered samples of a sub-block.
typedef struct Cover {
    int first;                         // index of the sub-block's first value in the tile's arrays
    float depth;                       // depth at the sub-block's corner
    uint16_t pixels;                   // pixels with a covered sample
    uint16_t samples[DIP_MAX_SAMPLES]; // pixels in which each sample is covered
    uint32_t positions[DIP_SUB_BLOCK_PIXELS]; // where each pixel's fragment is shaded
} Cover;

// The sub-blocks of the current triangle whose fragments wait for the clip test.
typedef struct ClipQueue {
    int count;
    Cover waiting[DIP_FRAGMENT_BATCH];
} ClipQueue;

// --- set-up --------------------------------------------------------------------------------------

// Edge values of a triangle are 1/65536 square pixel, and those in the tile are divided by 256. A
// sample lies within w/2 pixels of an edge of length L (in 1/256 pixel) if its value is at most
// w L / 2.
VEC_INLINE void set_lines(OrderedTriangle *tri, const DipTriangle *triangle, float width) {
    const unsigned flags = triangle->patch;
    const unsigned exchanged = (flags & 2) | (flags & 1) << 2 | (flags >> 2 & 1);
    const unsigned edges = flags & DIP_ORDERED_FRONT ? exchanged : flags & DIP_ORDERED_EDGES;
    for (int i = 0; i < 3; i++) {
        const double a = triangle->a[i];
        const double b = triangle->b[i];
        const double reach = 0.5 * (double)width * __builtin_sqrt(a * a + b * b);
        tri->reach[i] = edges >> i & 1 ? (int32_t)reach : -1;
    }
}

VEC_INLINE void set_up(OrderedTriangle *tri, const DipTile *tile, const DipTriangle *triangle,
                       uint32_t index, const DipDrawState *state) {
    set_up_in_tile(&tri->in, triangle, tile);
    tri->index = index;
    const bool front = triangle->patch & DIP_ORDERED_FRONT;
    tri->face = front ? &state->stencil.front : &state->stencil.back;
    const DipDepthBias *bias = &state->depth_bias;
    const double dx = __builtin_fabs(triangle->z_dx);
    const double dy = __builtin_fabs(triangle->z_dy);
    tri->biased = bias->slope != 0.0f || bias->relative != 0.0f;
    tri->bias = bias->slope * (float)(dx > dy ? dx : dy);
    tri->relative_bias = bias->relative * (1.0f / 8388608.0f);
    tri->wireframe = state->fill == DIP_FILL_WIREFRAME;
    if (tri->wireframe) {
        set_lines(tri, triangle, state->line_width > 0.0f ? state->line_width : 1.0f);
    }
}

// --- coverage ------------------------------------------------------------------------------------

// Returns the lanes whose sample s lies on a line of the wireframe.
VEC_INLINE Mask lines_lanes(const OrderedTriangle *tri, const PixelEdges *edges, int s,
                            int sample_count) {
    Vi near = vi_splat(-1);
    for (int i = 0; i < 3; i++) {
        const int32_t sample = sample_count > 1 ? tri->in.edge[i].sample[s] : 0;
        near &= vi_splat(tri->reach[i] - sample) - edges->at[i];
    }
    // The sign bit is set only where all three differences are negative.
    return vi_not_negative(near);
}

// Finds the covered samples of sub-block n. A fragment is shaded at the centre of its pixel if all
// samples are covered, and otherwise at the first covered sample.
VEC_INLINE void cover_sub_block(const OrderedTriangle *tri, const Region *region, int n,
                                const DipTile *tile, Cover *cover) {
    const DipSamplePattern *pattern = tile->pattern;
    const int sample_count = pattern->count;
    const int corner = (region->y + n / REGION) * DIP_SUB_BLOCK * DIP_TILE +
                       (region->x + n % REGION) * DIP_SUB_BLOCK;
    unsigned pixels = 0;
    for (int s = 0; s < sample_count; s++) {
        cover->samples[s] = 0;
    }
    for (int v = 0; v < VECTORS; v++) {
        const PixelEdges edges = pixel_edges(&tri->in, region, n, v);
        unsigned whole = VEC_ALL_LANES;
        Vi position = sub_position(128, 128);
        for (int s = sample_count - 1; s >= 0; s--) {
            Mask covered = covered_lanes(&tri->in, &edges, s, sample_count);
            if (tri->wireframe) {
                covered = covered & lines_lanes(tri, &edges, s, sample_count);
            }
            const unsigned bits = mask_bits(covered);
            cover->samples[s] |= (uint16_t)(bits << (v * DIP_LANES));
            pixels |= bits << (v * DIP_LANES);
            whole &= bits;
            position = vi_select(covered, sub_position(pattern->x[s], pattern->y[s]), position);
        }
        position = vi_select(mask_from_bits(whole), sub_position(128, 128), position);
        const Vi pixel = (vi_load(lane_y + v * DIP_LANES) << DIP_POSITION_Y) +
                         (vi_load(lane_x + v * DIP_LANES) + corner);
        vi_store((int32_t *)cover->positions + v * DIP_LANES, position | pixel);
    }
    cover->pixels = (uint16_t)pixels;
    cover->depth = region->depth[n];
}

// --- stencil and depth ---------------------------------------------------------------------------

static bool compares(DipCompare function, unsigned left, unsigned right) {
    switch (function) {
    case DIP_COMPARE_NEVER:
        return false;
    case DIP_COMPARE_LESS:
        return left < right;
    case DIP_COMPARE_LESS_OR_EQUAL:
        return left <= right;
    case DIP_COMPARE_EQUAL:
        return left == right;
    case DIP_COMPARE_NOT_EQUAL:
        return left != right;
    case DIP_COMPARE_GREATER_OR_EQUAL:
        return left >= right;
    case DIP_COMPARE_GREATER:
        return left > right;
    case DIP_COMPARE_ALWAYS:
        break;
    }
    return true;
}

static unsigned after_op(DipStencilOp op, unsigned stored, unsigned reference) {
    switch (op) {
    case DIP_STENCIL_ZERO:
        return 0;
    case DIP_STENCIL_REPLACE:
        return reference;
    case DIP_STENCIL_INCREMENT_CLAMP:
        return stored < 255 ? stored + 1 : 255;
    case DIP_STENCIL_DECREMENT_CLAMP:
        return stored > 0 ? stored - 1 : 0;
    case DIP_STENCIL_INVERT:
        return ~stored & 255;
    case DIP_STENCIL_INCREMENT_WRAP:
        return (stored + 1) & 255;
    case DIP_STENCIL_DECREMENT_WRAP:
        return (stored - 1) & 255;
    case DIP_STENCIL_KEEP:
    case DIP_STENCIL_OP_COUNT:
        break;
    }
    return stored;
}

// Tests the stencil values of one sample in the pixels `covered`, and changes them. nearest: the
// pixels that pass the depth test. Returns the pixels that pass the stencil test.
static unsigned test_stencil(const DipStencil *stencil, const DipStencilFace *face, uint8_t *values,
                             unsigned covered, unsigned nearest) {
    const unsigned reference = stencil->reference;
    unsigned passed = 0;
    for (unsigned left = covered; left; left &= left - 1) {
        const int pixel = __builtin_ctz(left);
        const unsigned stored = values[pixel];
        const bool passes =
            compares(face->function, reference & stencil->read_mask, stored & stencil->read_mask);
        const DipStencilOp op = !passes                ? face->stencil_failed
                                : nearest >> pixel & 1 ? face->passed
                                                       : face->depth_failed;
        const unsigned changed = after_op(op, stored, reference);
        values[pixel] =
            (uint8_t)((stored & ~(unsigned)stencil->write_mask) | (changed & stencil->write_mask));
        passed |= (unsigned)passes << pixel;
    }
    return passed;
}

// Returns the depth of sample s in each lane of vector v, with the draw's bias.
VEC_INLINE Vf ordered_depth(const OrderedTriangle *tri, float corner, int v, int s) {
    const Vf depth = depth_lanes(&tri->in, corner, v, s);
    if (!tri->biased) {
        return depth;
    }
    const Vf moved = (depth + tri->bias) + depth * tri->relative_bias;
    return vf_min(vf_max(moved, vf_splat(0.0f)), vf_splat(1.0f));
}

// Returns the pixels whose sample s passes the depth test.
VEC_INLINE unsigned test_depth(const OrderedTriangle *tri, DipDepthTest test, const float *depths,
                               float corner, int s) {
    if (test == DIP_DEPTH_ALWAYS) {
        return 0xffff;
    }
    unsigned nearer = 0;
    unsigned farther = 0;
    for (int v = 0; v < VECTORS; v++) {
        const Vf old = vf_load(depths + v * DIP_LANES);
        const Vf depth = ordered_depth(tri, corner, v, s);
        nearer |= mask_bits(vf_lt(old, depth)) << (v * DIP_LANES);
        farther |= mask_bits(vf_lt(depth, old)) << (v * DIP_LANES);
    }
    switch (test) {
    case DIP_DEPTH_NEARER:
        return nearer;
    case DIP_DEPTH_NEARER_OR_EQUAL:
        return ~farther;
    case DIP_DEPTH_EQUAL:
        return ~(nearer | farther);
    case DIP_DEPTH_NOT_EQUAL:
        return nearer | farther;
    case DIP_DEPTH_FARTHER:
        return farther;
    case DIP_DEPTH_FARTHER_OR_EQUAL:
        return ~nearer;
    default:
        return 0;
    }
}

VEC_INLINE void store_depth(const OrderedTriangle *tri, float *depths, float corner, int s,
                            unsigned pixels) {
    for (int v = 0; v < VECTORS; v++) {
        const Mask mask = mask_from_bits(pixels >> (v * DIP_LANES) & VEC_ALL_LANES);
        vf_store_lanes(depths + v * DIP_LANES, mask, ordered_depth(tri, corner, v, s),
                       vf_load(depths + v * DIP_LANES));
    }
}

// Tests the covered samples in the pixels `keep`, and stores the stencil values and depths of those
// that pass. Fills in visible[s] and returns the pixels with a sample that passed.
VEC_INLINE unsigned test_samples(const DipOrdered *ordered, const OrderedTriangle *tri,
                                 DipTile *tile, const Cover *cover, unsigned keep,
                                 uint16_t visible[DIP_MAX_SAMPLES]) {
    const DipDrawState *state = ordered->state;
    unsigned pixels = 0;
    for (int s = 0; s < tile->pattern->count; s++) {
        const int first = cover->first + s * DIP_BLOCK_PIXELS;
        const unsigned covered = cover->samples[s] & keep;
        unsigned passed = 0;
        if (covered) {
            float *depths = tile->depth + first;
            passed = covered & test_depth(tri, state->depth_test, depths, cover->depth, s);
            if (state->stencil.enabled) {
                passed &= test_stencil(&state->stencil, tri->face, ordered->stencil + first,
                                       covered, passed);
            }
            if (passed && !state->keep_depth) {
                store_depth(tri, depths, cover->depth, s, passed);
            }
        }
        visible[s] = (uint16_t)passed;
        pixels |= passed;
    }
    return pixels;
}

// --- queues --------------------------------------------------------------------------------------

// Adds the fragments of a sub-block's visible pixels to the draw's queue.
VEC_INLINE void queue_visible(DipOrdered *ordered, const OrderedTriangle *tri, const Cover *cover,
                              const DipOrderedSubBlock *sub_block) {
    DipFragmentList *list = &ordered->list;
    if (list->count > DIP_FRAGMENT_BATCH - DIP_SUB_BLOCK_PIXELS) {
        ordered->flush(ordered->context);
    }
    ordered->waiting[ordered->count++] = *sub_block;
    for (int v = 0; v < VECTORS; v++) {
        const unsigned bits = (unsigned)sub_block->pixels >> (v * DIP_LANES) & VEC_ALL_LANES;
        vi_store((int32_t *)list->triangle + list->count, vi_splat((int32_t)tri->index));
        const Vi position = vi_load((const int32_t *)cover->positions + v * DIP_LANES);
        list->count += vu_compress(list->position + list->count, bits, (Vu)position);
    }
}

// Tests a sub-block and queues what is visible in the pixels `keep`.
VEC_INLINE void merge_sub_block(DipOrdered *ordered, const OrderedTriangle *tri, DipTile *tile,
                                const Cover *cover, unsigned keep) {
    DipOrderedSubBlock sub_block = {.first = cover->first};
    sub_block.pixels = (uint16_t)test_samples(ordered, tri, tile, cover, keep, sub_block.visible);
    if (sub_block.pixels && ordered->shades) {
        queue_visible(ordered, tri, cover, &sub_block);
    }
}

// Runs the clip test on the fragments that wait for it, and merges those that it keeps.
static void flush_clip_queue(ClipQueue *queue, DipOrdered *ordered, const OrderedTriangle *tri,
                             const DipTriangle *triangle, DipTile *tile) {
    DipFragmentList *list = ordered->clip->list;
    for (int i = list->count; i % DIP_BATCH_ALIGN; i++) {
        list->position[i] = list->position[list->count - 1];
    }
    for (int i = 0; i < list->count; i += DIP_LANES) {
        vi_store((int32_t *)list->triangle + i, vi_splat((int32_t)tri->index));
    }
    const uint8_t *kept = ordered->clip->test(ordered->clip->context, triangle);
    for (int i = 0; i < queue->count; i++) {
        const Cover *cover = &queue->waiting[i];
        unsigned keep = 0;
        for (unsigned left = cover->pixels; left; left &= left - 1) {
            keep |= left & -left & (0u - (*kept++ != 0));
        }
        merge_sub_block(ordered, tri, tile, cover, keep);
    }
    list->count = 0;
    queue->count = 0;
}

VEC_INLINE void queue_for_clip_test(ClipQueue *queue, DipOrdered *ordered,
                                    const OrderedTriangle *tri, const DipTriangle *triangle,
                                    DipTile *tile, const Cover *cover) {
    DipFragmentList *list = ordered->clip->list;
    if (list->count > DIP_FRAGMENT_BATCH - DIP_SUB_BLOCK_PIXELS) {
        flush_clip_queue(queue, ordered, tri, triangle, tile);
    }
    queue->waiting[queue->count++] = *cover;
    for (int v = 0; v < VECTORS; v++) {
        const unsigned bits = (unsigned)cover->pixels >> (v * DIP_LANES) & VEC_ALL_LANES;
        const Vi position = vi_load((const int32_t *)cover->positions + v * DIP_LANES);
        list->count += vu_compress(list->position + list->count, bits, (Vu)position);
    }
}

// --- a triangle ----------------------------------------------------------------------------------

VEC_INLINE void merge_region(ClipQueue *queue, DipOrdered *ordered, const OrderedTriangle *tri,
                             const DipTriangle *triangle, const Region *region, DipTile *tile) {
    for (unsigned left = region->reached; left; left &= left - 1) {
        const int n = __builtin_ctz(left);
        Cover cover;
        cover.first = touch_sub_block(tile, region, n, tile->pattern->count);
        cover_sub_block(tri, region, n, tile, &cover);
        if (!cover.pixels) {
            continue;
        }
        if (ordered->clip) {
            queue_for_clip_test(queue, ordered, tri, triangle, tile, &cover);
        } else {
            merge_sub_block(ordered, tri, tile, &cover, 0xffff);
        }
    }
}

void DIP_KERNEL(dip_kernel_draw_ordered)(DipTile *tile, const DipTriangle *triangle, uint32_t index,
                                         DipOrdered *ordered) {
    const Box box = box_of(triangle, tile);
    OrderedTriangle tri;
    set_up(&tri, tile, triangle, index, ordered->state);
    ClipQueue queue;
    queue.count = 0;
    if (ordered->clip) {
        ordered->clip->list->count = 0;
    }
    for (int y = box.y0; y <= box.y1; y += REGION) {
        for (int x = box.x0; x <= box.x1; x += REGION) {
            Region region;
            if (region_at(&tri.in, triangle, tile, &box, x, y, &region)) {
                tile->sub_blocks_accepted += (uint64_t)__builtin_popcount(region.inside);
                merge_region(&queue, ordered, &tri, triangle, &region, tile);
            }
        }
    }
    if (ordered->clip && queue.count) {
        flush_clip_queue(&queue, ordered, &tri, triangle, tile);
    }
    tile->sub_blocks_tested += sub_blocks_in(&box);
}
