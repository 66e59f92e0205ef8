// The queue of fragments that wait for the clip test (DipClipQueue): finds where an alpha-clipped
// triangle is visible, and adds these fragments. Only kernels (*_simd.c) include this header.
#ifndef DIP_RENDERER_PIPELINE_RASTER_CLIP_QUEUE_SIMD_H
#define DIP_RENDERER_PIPELINE_RASTER_CLIP_QUEUE_SIMD_H

#include "renderer/pipeline/raster/hiding_simd.h"
#include "renderer/pipeline/raster/in_tile_simd.h"

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

#endif
