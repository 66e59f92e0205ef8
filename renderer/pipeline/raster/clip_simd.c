// The clip test of the fragments that wait for it, compiled once per instruction set.
#include "renderer/pipeline/raster/kept_simd.h"

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
