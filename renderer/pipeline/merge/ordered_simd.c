// Coverage, stencil test and depth test of one triangle of an ordered draw (pipeline/state.h) in
// one tile, compiled once per instruction set. The samples that pass take effect at once: their
// depths and stencil values are stored before the next triangle is tested. Their fragments are
// queued to be shaded and blended.
#include "renderer/pipeline/merge/ordered.h"
#include "renderer/pipeline/raster/in_tile_simd.h"
#include "renderer/pipeline/raster/kept_simd.h"

// The stencil test of a triangle: the values and operations of the face that it shows.
typedef struct StencilTest {
    const DipStencilFace *face;
    unsigned reference;
    unsigned read_mask;
    unsigned write_mask;
} StencilTest;

// A triangle of an ordered draw within the tile.
typedef struct OrderedTriangle {
    InTile in;
    uint32_t index;
    StencilTest stencil;
    bool biased;
    float bias;          // what the slope and the constant add to the depth
    float relative_bias; // what is added for each unit of depth
    bool wireframe;
    int32_t reach[3]; // wireframe: greatest edge values of samples on the lines, -1 for none
} OrderedTriangle;

// The covered samples of a sub-block.
typedef struct Cover {
    int first;                         // index of the sub-block's first value in the tile's arrays
    int number;                        // see dip_sub_block_number
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

// How much of the draw's state a loop has to look at. Each kind has a loop of its own, in which the
// compiler leaves out what the kind does not have.
typedef enum OrderedKind {
    KIND_SINGLE, // as KIND_SIMPLE, with one sample per pixel
    // Solid, no clip shader, no stencil test, no depth bias, no kept samples, nearer samples pass.
    KIND_SIMPLE,
    KIND_GENERAL, // any state
} OrderedKind;

// Pixels of a sub-block, relative to its first pixel, as a fragment's position counts them.
static const int32_t lane_pixel[DIP_SUB_BLOCK_PIXELS] = {
    0,   1,   2,   3,   64,  65,  66,  67, // one row adds DIP_TILE
    128, 129, 130, 131, 192, 193, 194, 195,
};

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

VEC_INLINE StencilTest stencil_test_of(const DipStencil *stencil, bool front) {
    const bool own = !front && stencil->back_has_values;
    return (StencilTest){
        .face = front ? &stencil->front : &stencil->back,
        .reference = own ? stencil->back_reference : stencil->reference,
        .read_mask = own ? stencil->back_read_mask : stencil->read_mask,
        .write_mask = own ? stencil->back_write_mask : stencil->write_mask,
    };
}

VEC_INLINE void set_up(OrderedTriangle *tri, const DipTile *tile, const DipTriangle *triangle,
                       uint32_t index, const DipDrawState *state) {
    set_up_in_tile(&tri->in, triangle, tile);
    tri->index = index;
    tri->stencil = stencil_test_of(&state->stencil, triangle->patch & DIP_ORDERED_FRONT);
    const DipDepthBias *bias = &state->depth_bias;
    const double dx = __builtin_fabs(triangle->z_dx);
    const double dy = __builtin_fabs(triangle->z_dy);
    tri->biased = bias->slope != 0.0f || bias->relative != 0.0f || bias->constant != 0.0f;
    tri->bias = bias->slope * (float)(dx > dy ? dx : dy) + bias->constant;
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

// Returns the index of a sub-block's first pixel in the tile, y * DIP_TILE + x.
VEC_INLINE int corner_of(const Region *region, int n) {
    return (region->y + n / REGION) * DIP_SUB_BLOCK * DIP_TILE +
           (region->x + n % REGION) * DIP_SUB_BLOCK;
}

// Fills in the cover of sub-block n, which lies wholly inside the triangle: every sample is
// covered, and every fragment is shaded at the centre of its pixel.
VEC_INLINE void cover_whole_sub_block(const Region *region, int n, int sample_count, Cover *cover) {
    for (int s = 0; s < sample_count; s++) {
        cover->samples[s] = 0xffff;
    }
    const Vi first = sub_position(128, 128) + vi_splat(corner_of(region, n));
    for (int v = 0; v < VECTORS; v++) {
        const Vi pixel =
            (vi_load(lane_y + v * DIP_LANES) << DIP_POSITION_Y) + vi_load(lane_x + v * DIP_LANES);
        vi_store((int32_t *)cover->positions + v * DIP_LANES, first + pixel);
    }
    cover->pixels = 0xffff;
    cover->depth = region->depth[n];
}

// Finds the covered samples of sub-block n. A fragment is shaded at the centre of its pixel if all
// samples are covered, and otherwise at the first covered sample.
VEC_INLINE void cover_sub_block(const OrderedTriangle *tri, const Region *region, int n,
                                const DipTile *tile, Cover *cover) {
    const DipSamplePattern *pattern = tile->pattern;
    const int sample_count = pattern->count;
    const int corner = corner_of(region, n);
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
static unsigned test_stencil(const StencilTest *test, uint8_t *values, unsigned covered,
                             unsigned nearest) {
    const DipStencilFace *face = test->face;
    const unsigned reference = test->reference;
    unsigned passed = 0;
    for (unsigned left = covered; left; left &= left - 1) {
        const int pixel = __builtin_ctz(left);
        const unsigned stored = values[pixel];
        const bool passes =
            compares(face->function, reference & test->read_mask, stored & test->read_mask);
        const DipStencilOp op = !passes                ? face->stencil_failed
                                : nearest >> pixel & 1 ? face->passed
                                                       : face->depth_failed;
        const unsigned changed = after_op(op, stored, reference);
        values[pixel] = (uint8_t)((stored & ~test->write_mask) | (changed & test->write_mask));
        passed |= (unsigned)passes << pixel;
    }
    return passed;
}

// Returns the depth of sample s in each lane of vector v, with the draw's bias.
VEC_INLINE Vf ordered_depth(const OrderedTriangle *tri, OrderedKind kind, float corner, int v,
                            int s) {
    const Vf depth = depth_lanes(&tri->in.depths, corner, v, s);
    if (kind != KIND_GENERAL || !tri->biased) {
        return depth;
    }
    const Vf moved = (depth + tri->bias) + depth * tri->relative_bias;
    return vf_min(vf_max(moved, vf_splat(0.0f)), vf_splat(1.0f));
}

// Returns the pixels in which the depth of sample s is nearer than the stored one, or farther.
VEC_INLINE unsigned compare_depths(const OrderedTriangle *tri, const float *depths, float corner,
                                   int s, bool nearer) {
    unsigned pixels = 0;
    for (int v = 0; v < VECTORS; v++) {
        const Vf old = vf_load(depths + v * DIP_LANES);
        const Vf depth = ordered_depth(tri, KIND_GENERAL, corner, v, s);
        const Mask mask = nearer ? vf_lt(old, depth) : vf_lt(depth, old);
        pixels |= mask_bits(mask) << (v * DIP_LANES);
    }
    return pixels;
}

// Returns the pixels whose sample s passes the depth test.
VEC_INLINE unsigned test_depth(const OrderedTriangle *tri, DipDepthTest test, const float *depths,
                               float corner, int s) {
    switch (test) {
    case DIP_DEPTH_NEARER:
        return compare_depths(tri, depths, corner, s, true);
    case DIP_DEPTH_NEARER_OR_EQUAL:
        return ~compare_depths(tri, depths, corner, s, false);
    case DIP_DEPTH_EQUAL:
        return ~(compare_depths(tri, depths, corner, s, true) |
                 compare_depths(tri, depths, corner, s, false));
    case DIP_DEPTH_NOT_EQUAL:
        return compare_depths(tri, depths, corner, s, true) |
               compare_depths(tri, depths, corner, s, false);
    case DIP_DEPTH_FARTHER:
        return compare_depths(tri, depths, corner, s, false);
    case DIP_DEPTH_FARTHER_OR_EQUAL:
        return ~compare_depths(tri, depths, corner, s, true);
    case DIP_DEPTH_ALWAYS:
        return 0xffff;
    default:
        return 0;
    }
}

VEC_INLINE void store_depth(const OrderedTriangle *tri, float *depths, float corner, int s,
                            unsigned pixels) {
    for (int v = 0; v < VECTORS; v++) {
        const Mask mask = mask_from_bits(pixels >> (v * DIP_LANES) & VEC_ALL_LANES);
        vf_store_lanes(depths + v * DIP_LANES, mask, ordered_depth(tri, KIND_GENERAL, corner, v, s),
                       vf_load(depths + v * DIP_LANES));
    }
}

// Tests sample s in the pixels `covered` for being nearer than what is stored, which is what most
// draws ask for, and stores the depths of those that are unless `keep_depth` is set. Returns the
// pixels that pass.
VEC_INLINE unsigned pass_nearer(const OrderedTriangle *tri, OrderedKind kind, float *depths,
                                float corner, int s, unsigned covered, bool keep_depth) {
    unsigned passed = 0;
    for (int v = 0; v < VECTORS; v++) {
        const Vf old = vf_load(depths + v * DIP_LANES);
        const Vf depth = ordered_depth(tri, kind, corner, v, s);
        const Mask nearer =
            vf_lt(old, depth) & mask_from_bits(covered >> (v * DIP_LANES) & VEC_ALL_LANES);
        passed |= mask_bits(nearer) << (v * DIP_LANES);
        if (!keep_depth) {
            vf_store_lanes(depths + v * DIP_LANES, nearer, depth, old);
        }
    }
    return passed;
}

// Tests sample s in the pixels `covered`, and stores the stencil values and depths of those that
// pass. first: index of the sub-block's first value of this sample. Returns the pixels that pass.
VEC_INLINE unsigned test_sample(const DipOrdered *ordered, const OrderedTriangle *tri,
                                OrderedKind kind, float *depths, int first, float corner, int s,
                                unsigned covered) {
    const DipDrawState *state = ordered->state;
    if (kind != KIND_GENERAL) {
        return pass_nearer(tri, kind, depths, corner, s, covered, state->keep_depth);
    }
    unsigned passed = covered & test_depth(tri, state->depth_test, depths, corner, s);
    if (state->stencil.enabled) {
        passed &= test_stencil(&tri->stencil, ordered->stencil + first, covered, passed);
    }
    if (passed && !state->keep_depth) {
        store_depth(tri, depths, corner, s, passed);
    }
    return passed;
}

// Tests the covered samples in the pixels `keep`. Fills in visible[s] and returns the pixels with a
// sample that passed.
VEC_INLINE unsigned test_samples(const DipOrdered *ordered, const OrderedTriangle *tri,
                                 OrderedKind kind, DipTile *tile, const Cover *cover, unsigned keep,
                                 uint16_t visible[DIP_MAX_SAMPLES]) {
    const int sample_count = kind == KIND_SINGLE ? 1 : tile->pattern->count;
    unsigned pixels = 0;
    for (int s = 0; s < sample_count; s++) {
        const int first = cover->first + s * DIP_BLOCK_PIXELS;
        const bool kept = kind == KIND_GENERAL && ordered->state->kept_samples >> s & 1;
        const unsigned covered = kept ? 0 : cover->samples[s] & keep;
        const unsigned passed = covered ? test_sample(ordered, tri, kind, tile->depth + first,
                                                      first, cover->depth, s, covered)
                                        : 0;
        visible[s] = (uint16_t)passed;
        pixels |= passed;
    }
    return pixels;
}

// --- queues --------------------------------------------------------------------------------------

// Adds the fragments of the batch's next sub-block to the batch's list.
VEC_INLINE void queue_sub_block(DipOrderedBatch *batch, const OrderedTriangle *tri,
                                const Cover *cover, unsigned pixels) {
    DipOrderedSubBlock *sub_block = &batch->waiting[batch->count++];
    DipFragmentList *list = &batch->list;
    sub_block->first = cover->first;
    sub_block->number = cover->number;
    sub_block->pixels = (uint16_t)pixels;
    for (int v = 0; v < VECTORS; v++) {
        const unsigned bits = pixels >> (v * DIP_LANES) & VEC_ALL_LANES;
        vi_store((int32_t *)list->triangle + list->count, vi_splat((int32_t)tri->index));
        const Vi position = vi_load((const int32_t *)cover->positions + v * DIP_LANES);
        list->count += vu_compress(list->position + list->count, bits, (Vu)position);
    }
}

// Tests a sub-block and queues what is visible in the pixels `keep`.
VEC_INLINE void merge_sub_block(DipOrdered *ordered, const OrderedTriangle *tri, OrderedKind kind,
                                DipTile *tile, const Cover *cover, unsigned keep) {
    if (!ordered->shades) {
        uint16_t visible[DIP_MAX_SAMPLES];
        test_samples(ordered, tri, kind, tile, cover, keep, visible);
        return;
    }
    DipOrderedBatch *batch = &ordered->batches[ordered->full];
    if (batch->list.count > DIP_FRAGMENT_BATCH - DIP_SUB_BLOCK_PIXELS) {
        batch = dip_ordered_next_batch(ordered);
    }
    const unsigned pixels =
        test_samples(ordered, tri, kind, tile, cover, keep, batch->waiting[batch->count].visible);
    if (pixels) {
        queue_sub_block(batch, tri, cover, pixels);
    }
}

// Merges sub-block n, which lies wholly inside a triangle of KIND_SINGLE, as cover_whole_sub_block
// and merge_sub_block do, but without a Cover. Most of these sub-blocks are visible in all pixels,
// so their fragments are stored as whole vectors.
VEC_INLINE void merge_whole_single(DipOrdered *ordered, const OrderedTriangle *tri,
                                   const Region *region, int n, DipTile *tile) {
    const int first = touch_sub_block(tile, number_of(region, (unsigned)n), 1);
    const unsigned visible = pass_nearer(tri, KIND_SINGLE, tile->depth + first, region->depth[n], 0,
                                         0xffff, ordered->state->keep_depth);
    if (!visible || !ordered->shades) {
        return;
    }
    DipOrderedBatch *batch = &ordered->batches[ordered->full];
    DipFragmentList *list = &batch->list;
    if (list->count > DIP_FRAGMENT_BATCH - DIP_SUB_BLOCK_PIXELS) {
        batch = dip_ordered_next_batch(ordered);
        list = &batch->list;
    }
    DipOrderedSubBlock *sub_block = &batch->waiting[batch->count++];
    sub_block->first = first;
    sub_block->number = (int)((unsigned)first / DIP_SUB_BLOCK_PIXELS);
    sub_block->pixels = sub_block->visible[0] = (uint16_t)visible;
    const Vi corner = sub_position(128, 128) + vi_splat(corner_of(region, n));
    for (int v = 0; v < VECTORS; v++) {
        const Vi pixel = vi_load(lane_pixel + v * DIP_LANES);
        vi_store((int32_t *)list->triangle + list->count, vi_splat((int32_t)tri->index));
        list->count +=
            vu_compress(list->position + list->count, visible >> (v * DIP_LANES) & VEC_ALL_LANES,
                        (Vu)(corner + pixel));
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
    const uint8_t *bytes = ordered->clip->test(ordered->clip->context, triangle->draw);
    Kept kept;
    find_kept(bytes, list->count, &kept);
    for (int i = 0; i < queue->count; i++) {
        Cover *cover = &queue->waiting[i];
        if (ordered->clip->order) {
            drop_samples(cover->samples, cover->pixels, bytes, ordered->clip->order,
                         tile->pattern->count);
            bytes += __builtin_popcount(cover->pixels);
        }
        merge_sub_block(ordered, tri, KIND_GENERAL, tile, cover, take_kept(&kept, cover->pixels));
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
                             OrderedKind kind, const DipTriangle *triangle, const Region *region,
                             DipTile *tile) {
    const int sample_count = kind == KIND_SINGLE ? 1 : tile->pattern->count;
    for (unsigned left = region->reached; left; left &= left - 1) {
        const int n = __builtin_ctz(left);
        if (kind == KIND_SINGLE && region->inside >> n & 1) {
            merge_whole_single(ordered, tri, region, n, tile);
            continue;
        }
        Cover cover;
        const unsigned number = number_of(region, (unsigned)n);
        cover.first = touch_sub_block(tile, number, sample_count);
        cover.number = (int)number;
        if (region->inside >> n & 1 && !(kind == KIND_GENERAL && tri->wireframe)) {
            cover_whole_sub_block(region, n, sample_count, &cover);
        } else {
            cover_sub_block(tri, region, n, tile, &cover);
        }
        if (!cover.pixels) {
            continue;
        }
        if (kind == KIND_GENERAL && ordered->clip) {
            queue_for_clip_test(queue, ordered, tri, triangle, tile, &cover);
        } else {
            merge_sub_block(ordered, tri, kind, tile, &cover, 0xffff);
        }
    }
}

static OrderedKind kind_of(const DipOrdered *ordered, const OrderedTriangle *tri,
                           const DipTile *tile) {
    const DipDrawState *state = ordered->state;
    const bool simple = !tri->biased && !tri->wireframe && !ordered->clip &&
                        !state->stencil.enabled && state->depth_test == DIP_DEPTH_NEARER &&
                        !state->kept_samples;
    return !simple ? KIND_GENERAL : tile->pattern->count == 1 ? KIND_SINGLE : KIND_SIMPLE;
}

void DIP_KERNEL(dip_kernel_draw_ordered)(DipTile *tile, const DipTriangle *triangle, uint32_t index,
                                         DipOrdered *ordered) {
    const Box box = box_of(triangle, tile);
    OrderedTriangle tri;
    set_up(&tri, tile, triangle, index, ordered->state);
    const OrderedKind kind = kind_of(ordered, &tri, tile);
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
                switch (kind) {
                case KIND_SINGLE:
                    merge_region(&queue, ordered, &tri, KIND_SINGLE, triangle, &region, tile);
                    break;
                case KIND_SIMPLE:
                    merge_region(&queue, ordered, &tri, KIND_SIMPLE, triangle, &region, tile);
                    break;
                case KIND_GENERAL:
                    merge_region(&queue, ordered, &tri, KIND_GENERAL, triangle, &region, tile);
                    break;
                }
            }
        }
    }
    if (ordered->clip && queue.count) {
        flush_clip_queue(&queue, ordered, &tri, triangle, tile);
    }
    tile->sub_blocks_tested += sub_blocks_in(&box);
}
