// Reads and filters the colours of textures. docs/picture.md (Textures) defines the filter. This
// file is compiled once per instruction set.
//
// Colours are filtered in 16-bit fixed point. A texel holds square roots of linear light
// (texture_layout.h). The roots are squared and the squares are multiplied by 16-bit weights; each
// product keeps its upper 16 bits. The four texels of a bilinear read are loaded at once and stay
// side by side (simd/quads.h) until they are summed. Sums are integers, so the order of lanes and
// probes does not matter.
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/pipeline/texture/read_list_simd.h"
#include "renderer/simd/quads.h"

#include <string.h>

// The one or two textures that are read at the same footprints.
typedef struct Read {
    const DipTexture *texture[2];
    int count;
} Read;

// Sums of weighted texels, with 16 bits per channel. The texels of a quad are still side by side.
typedef struct QuadSum {
    Vu red_green[4]; // red in the upper half
    Vu blue[4];
} QuadSum;

// Sums of weighted texels per lane, with 32 bits per channel.
typedef struct LightSum {
    Vu red_green; // packed sums modulo 2^32; green is this minus red << 16
    Vu red;
    Vu blue;
} LightSum;

// 16-bit weights of the texels of a bilinear read. The weight of the upper texel of a column is in
// the lower half, the weight of the lower texel is in the upper half.
typedef struct Weights {
    Vu left;
    Vu right;
} Weights;

// Multiplies the weights of a read's rows (as those of a column in Weights) by those of its
// columns. The weights of a blend sum to 65535.
VEC_INLINE Weights join_weights(Vu down, Vi between) {
    const Vu x = (Vu)between << 24;
    const Vu right = x | x >> 16; // 256 times the position, in both halves
    return (Weights){vu_mulhi16(down, ~right), vu_mulhi16(down, right)};
}

// Returns the weights of a probe.
VEC_INLINE Weights weigh_probe(Vi between) {
    const Vu lower = (Vu)between & 0xff000000u;
    return join_weights(lower | (lower >> 16 ^ 0xffffu), between);
}

// Returns the weights of the single read of a level, multiplied by the weight of the level, which
// is in both halves of level_weight.
VEC_INLINE Weights weigh_level(Vi between, Vu level_weight) {
    const Vu lower = vu_mulhi16((Vu)between & 0xff000000u, level_weight);
    return join_weights(lower | ((level_weight & 0xffffu) - (lower >> 16)), between);
}

VEC_INLINE void clear_quads(QuadSum *sum) {
    for (int k = 0; k < 4; k++) {
        sum->red_green[k] = sum->blue[k] = vu_splat(0);
    }
}

// Adds the weighted texels of a listed read. The squares of a texel's roots are its linear light; a
// weight has 16 bits. The weights of all reads that are added must sum to less than 65536, so that
// red and green do not overflow their halves.
VEC_INLINE void add_quads(QuadSum *sum, const DipTexture *texture, const int32_t *index,
                          const Weights *weights) {
    const uint32_t *quads = (const uint32_t *)(const void *)texture->texels;
    for (int k = 0; k < 4; k++) {
        const Vu texels = vu_load_quads(quads, 2, index, k);
        const Vu weight = vu_quad_weights(weights->left, weights->right, k);
        const Vu blue = vu_dot16(texels & DIP_TEXEL_BLUE, DIP_TEXEL_BLUE_FACTORS);
        sum->red_green[k] += vu_mulhi16(vu_mulhi16(texels, texels), weight);
        sum->blue[k] += vu_mulhi16(vu_mulhi16(blue, blue), weight);
    }
}

VEC_INLINE void add_sums(LightSum *sum, const QuadSum *quads) {
    const Vu both = vu_quad_sum(quads->red_green);
    sum->red_green += both;
    sum->red += both >> 16;
    sum->blue += vu_quad_sum(quads->blue);
}

// Converts a sum to linear light, in which white is 1. The divisors are below 65535 because the
// products are rounded down. The sum of a white texel differs from the divisor by at most 6.
VEC_INLINE void sum_channels(const LightSum *sum, Vf light[3]) {
    light[0] = vf_from_int((Vi)sum->red) * (1.0f / 65526.0f);
    light[1] = vf_from_int((Vi)(sum->red_green - (sum->red << 16))) * (1.0f / 65526.0f);
    light[2] = vf_from_int((Vi)sum->blue) * (1.0f / 65402.0f);
}

#define NO_LIGHT ((LightSum){vu_splat(0), vu_splat(0), vu_splat(0)})

// Adds the light of `count` listed probes, each of which has this weight.
VEC_INLINE void add_probes(const Read *read, const ReadList *list, int first, int count, Vf weight,
                           Vf light[2][3]) {
    LightSum sum[2] = {NO_LIGHT, NO_LIGHT};
    for (int i = first; i < first + count; i++) {
        const Weights weights = weigh_probe(vi_load(list->between[i]));
        for (int t = 0; t < read->count; t++) {
            QuadSum quads;
            clear_quads(&quads);
            add_quads(&quads, read->texture[t], list->index[i], &weights);
            add_sums(&sum[t], &quads);
        }
    }
    for (int t = 0; t < read->count; t++) {
        Vf of_level[3];
        sum_channels(&sum[t], of_level);
        for (int c = 0; c < 3; c++) {
            light[t][c] += of_level[c] * weight;
        }
    }
}

// Adds the texels of a level's single read. level_weight: 256 times the level's weight, or the
// complement, in both halves.
VEC_INLINE void add_level(const Read *read, const ReadList *list, int i, Vu level_weight,
                          QuadSum quads[2]) {
    const Weights weights = weigh_level(vi_load(list->between[i]), level_weight);
    for (int t = 0; t < read->count; t++) {
        add_quads(&quads[t], read->texture[t], list->index[i], &weights);
    }
}

// Filters the listed reads of vector n, of which number `first` is the first one.
VEC_INLINE void filter_vector(const Read *read, ReadMode mode, const ReadList *list, int first,
                              const Footprints *footprints, int n, Vf light[2][3]) {
    const int far = first + list->near[n];
    if (mode.anisotropic) {
        for (int i = 0; i < 3 * read->count; i++) {
            light[i / 3][i % 3] = vf_splat(0.0f);
        }
        add_probes(read, list, first, list->near[n], footprints->near.weight[n], light);
        if (list->far[n] > 0) {
            add_probes(read, list, far, list->far[n], footprints->far.weight[n], light);
        }
        return;
    }
    const Vu fraction = (Vu)(footprints->lod8[n] & 255);
    const Vu weight = fraction << 8 | fraction << 24;
    QuadSum quads[2];
    for (int t = 0; t < read->count; t++) {
        clear_quads(&quads[t]);
    }
    // The weights of both levels sum to 65535, so both have one sum.
    add_level(read, list, first, ~weight, quads);
    if (list->far[n] > 0) {
        add_level(read, list, far, weight, quads);
    }
    for (int t = 0; t < read->count; t++) {
        LightSum sum = NO_LIGHT;
        add_sums(&sum, &quads[t]);
        sum_channels(&sum, light[t]);
    }
}

// Returns whether the quad of a lane is prefetched. Neighbouring fragments mostly read the same
// cache line, so that a part of the lanes is enough: in the coarser level one in four or, without
// anisotropy, one in eight; and without anisotropy in the finer level a chessboard, if the
// fragments are those of a sub-block.
VEC_INLINE bool prefetches_lane(ReadMode mode, bool far, int lane) {
    if (mode.anisotropic) {
        return !far || lane % 4 == 0;
    }
    return far ? lane % 8 == lane / 8 : (lane + lane / 4) % 2 == 0;
}

// Prefetches the texels that vector n reads, of whose listed reads number `first` is the first one.
// Each quad lies in one or two cache lines, mostly in one; only the first one is prefetched.
VEC_INLINE void prefetch_texels(const DipTexture *texture, ReadMode mode, const ReadList *list,
                                int first, int n) {
    const int far = first + list->near[n];
    for (int i = first; i < far + list->far[n]; i++) {
        for (int lane = 0; lane < DIP_LANES; lane++) {
            if (prefetches_lane(mode, i >= far, lane)) {
                __builtin_prefetch(texture->texels + (uint32_t)list->index[i][lane]);
            }
        }
    }
}

// Returns the level that mip debugging shows instead of `level`.
VEC_INLINE Vi shown_level(const DipSampler *sampler, Vi level) {
    return sampler->shown ? vi_lookup16(sampler->shown_level, level) : level;
}

VEC_INLINE void sample_read(DipFragmentBatch *batch, const DipSampler *sampler, ReadMode mode,
                            Read read, int u_varying, float (*const out[2])[DIP_FRAGMENT_BATCH]) {
    const int vectors = (batch->count + DIP_LANES - 1) / DIP_LANES;
    Footprints footprints;
    ReadList list;
    find_footprints(batch, sampler, mode, u_varying, read.count, &footprints);
    for (int n = 0, first = 0; n < vectors; n++) {
        const Vi near = shown_level(sampler, near_level(footprints.lod8[n]));
        const Vi far = shown_level(sampler, far_level(sampler, footprints.lod8[n]));
        const int count =
            list_vector(&list, first, read.texture[0], mode, near, far, &footprints, n);
        for (int t = 0; t < read.count; t++) {
            prefetch_texels(read.texture[t], mode, &list, first, n);
        }
        first += count;
    }
    for (int n = 0, first = 0; n < vectors; n++) {
        Vf light[2][3];
        filter_vector(&read, mode, &list, first, &footprints, n, light);
        for (int t = 0; t < read.count; t++) {
            for (int c = 0; c < 3; c++) {
                vf_store(out[t][c] + n * DIP_LANES, light[t][c]);
            }
        }
        first += list.near[n] + list.far[n];
    }
}

VEC_INLINE void sample_colour(DipFragmentBatch *batch, const DipSampler *sampler, ReadMode mode,
                              int u_varying, float (*out)[DIP_FRAGMENT_BATCH]) {
    const Read read = {{sampler->shown ? sampler->shown : sampler->texture, NULL}, 1};
    float(*const outs[2])[DIP_FRAGMENT_BATCH] = {out, NULL};
    sample_read(batch, sampler, mode, read, u_varying, outs);
}

void DIP_KERNEL(dip_kernel_sample_colour)(DipFragmentBatch *batch, const DipSampler *sampler,
                                          int u_varying, float (*out)[DIP_FRAGMENT_BATCH]) {
    const DipTexture *texture = sampler->shown ? sampler->shown : sampler->texture;
    SAMPLE_BY_MODE(sample_colour, texture, u_varying, out);
}

// Returns whether two samplers read textures of the same layout with the same footprints.
static bool reads_alike(const DipSampler *a, const DipSampler *b) {
    const DipTexture *s = a->texture;
    const DipTexture *t = b->texture;
    return !a->shown && !b->shown && a->max_anisotropy == b->max_anisotropy &&
           a->exact_footprint == b->exact_footprint && a->bias_lod8 == b->bias_lod8 &&
           a->min_lod8 == b->min_lod8 && a->cheap == b->cheap && a->filter == b->filter &&
           a->no_mips == b->no_mips && s->wrap_u == t->wrap_u && s->wrap_v == t->wrap_v &&
           s->level_count == t->level_count &&
           memcmp(s->level_width, t->level_width, sizeof s->level_width) == 0 &&
           memcmp(s->level_height, t->level_height, sizeof s->level_height) == 0;
}

void DIP_KERNEL(dip_kernel_sample_colours)(DipFragmentBatch *batch,
                                           const DipSampler *const samplers[2], int u_varying,
                                           float (*const out[2])[DIP_FRAGMENT_BATCH]) {
    if (!reads_alike(samplers[0], samplers[1])) {
        DIP_KERNEL(dip_kernel_sample_colour)(batch, samplers[0], u_varying, out[0]);
        DIP_KERNEL(dip_kernel_sample_colour)(batch, samplers[1], u_varying, out[1]);
        return;
    }
    const DipSampler *sampler = samplers[0];
    const Read read = {{sampler->texture, samplers[1]->texture}, 2};
    SAMPLE_BY_MODE(sample_read, sampler->texture, read, u_varying, out);
}
