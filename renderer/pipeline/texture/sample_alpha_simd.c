// Reads and filters the alpha of textures, and how fast it changes. docs/picture.md (Textures)
// defines the filter. This file is compiled once per instruction set.
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/pipeline/texture/read_list_simd.h"

// How alpha changes per texel of level 0, along u and v, in the unit of mean_alpha.
typedef struct AlphaChange {
    Vf u, v;
} AlphaChange;

// Returns the derivative of a read along an axis, as the marks of the read say. along: the change
// towards the next texel of the texture.
VEC_INLINE Vf change_along(Vf along, Vi marks, int flat, int backwards) {
    const Vf turned = vf_select(vi_lt(vi_splat(0), marks & backwards), -along, along);
    return vf_select(vi_lt(vi_splat(0), marks & flat), vf_splat(0.0f), turned);
}

// Returns the alpha of a listed read, in units of 1 / (255 * 65536). All numbers are whole and
// below 2^24, so they are exact. change: if not NULL, receives its derivative per texel of the
// level that is read.
VEC_INLINE Vf bilinear_alpha(const DipTexture *texture, const ReadList *list, int i,
                             AlphaChange *change) {
    const Vi between = vi_load(list->between[i]);
    const Vi x = between & 255;
    const Vi across = (256 - x) | x << 16;
    const Vf down = vf_from_int((Vi)((Vu)between >> 24));
    const uint8_t *alpha = (const uint8_t *)texture->alpha;
    const Vi quad = (Vi)vu_gather_bytes(alpha, vi_load(list->index[i]) * 2);
    const Vf upper = vf_from_int(vi_dot16(quad & 0x00ff00ff, across));
    const Vf lower = vf_from_int(vi_dot16(quad >> 8 & 0x00ff00ff, across));
    if (change) {
        const Vf a = vf_from_int(quad & 255), b = vf_from_int(quad >> 16 & 255);
        const Vf c = vf_from_int(quad >> 8 & 255), d = vf_from_int((Vi)((Vu)quad >> 24));
        const Vf right = vf_from_int(x);
        const Vf along_u = ((b - a) * (256.0f - down) + (d - c) * down) * 256.0f;
        const Vf along_v = ((c - a) * (256.0f - right) + (d - b) * right) * 256.0f;
        change->u = change_along(along_u, between, FLAT_X, BACKWARDS_X);
        change->v = change_along(along_v, between, FLAT_Y, BACKWARDS_Y);
    }
    return upper * (256.0f - down) + lower * down;
}

// Returns the width and height of a level relative to level 0.
VEC_INLINE AlphaChange size_of_level(const DipTexture *texture, ReadMode mode, const Level *level) {
    const Vi one = vi_splat(1);
    const Vf width = vf_from_int(mode.in_bits ? one << level->width : level->width);
    const Vf height = vf_from_int(mode.in_bits ? one << level->height : level->height);
    return (AlphaChange){width * (1.0f / (float)texture->width),
                         height * (1.0f / (float)texture->height)};
}

// The listed probes of a vector in a level.
typedef struct Probes {
    Vi level;
    int first;     // number of the first listed read
    int count;     // number of listed reads
    Vi lane_count; // number of probes of each lane
} Probes;

// Returns the mean alpha over a vector's probes in a level. The sum is divided by their number, so
// that a constant alpha stays exact. Lanes that have fewer probes than others read zeros in place
// of the rest. change: NULL, or receives the mean's derivative.
VEC_INLINE Vf mean_alpha(const DipTexture *texture, ReadMode mode, const ReadList *list,
                         const Probes *probes, AlphaChange *change) {
    Vf total = vf_splat(0.0f);
    AlphaChange changes = {vf_splat(0.0f), vf_splat(0.0f)};
    for (int i = probes->first; i < probes->first + probes->count; i++) {
        AlphaChange of_probe;
        total += bilinear_alpha(texture, list, i, change ? &of_probe : NULL);
        if (change && !mode.nearest) {
            changes.u += of_probe.u;
            changes.v += of_probe.v;
        }
    }
    const Vf count = vf_from_int(vi_max(probes->lane_count, vi_splat(1)));
    if (change) {
        const Level level = read_level(texture, mode, probes->level);
        const AlphaChange size = size_of_level(texture, mode, &level);
        change->u = mode.anisotropic ? changes.u * size.u / count : changes.u * size.u;
        change->v = mode.anisotropic ? changes.v * size.v / count : changes.v * size.v;
    }
    return mode.anisotropic ? total / count : total;
}

// Prefetches the alphas of every fourth lane of `count` listed reads. A cache line has 32 of them,
// so neighbouring fragments mostly read the same one.
VEC_INLINE void prefetch_alpha(const DipTexture *texture, const ReadList *list, int first,
                               int count) {
    for (int i = first; i < first + count; i++) {
        for (int lane = 0; lane < DIP_LANES; lane += 4) {
            __builtin_prefetch(texture->alpha + (uint32_t)list->index[i][lane]);
        }
    }
}

// Returns |d alpha / dx| + |d alpha / dy| of vector n's footprints.
VEC_INLINE Vf slope_of(const DipFragmentBatch *batch, const DipTexture *texture, int varying, int n,
                       AlphaChange change) {
    const Jacobian j = bounded_jacobian(read_jacobian(batch, texture, varying, n * DIP_LANES));
    const Vf dx = change.u * j.ux + change.v * j.vx;
    const Vf dy = change.u * j.uy + change.v * j.vy;
    return vf_abs(dx) + vf_abs(dy);
}

// slope: NULL, or receives how fast alpha changes from pixel to pixel (DipSampleAlphaSlope).
VEC_INLINE void sample_alpha(DipFragmentBatch *batch, const DipSampler *sampler, ReadMode mode,
                             int u_varying, float *out, float *slope) {
    mode.marks = slope != NULL;
    const DipTexture *texture = sampler->texture;
    const int vectors = (batch->count + DIP_LANES - 1) / DIP_LANES;
    Footprints footprints;
    ReadList list;
    find_footprints(batch, sampler, mode, u_varying, 1, &footprints);
    for (int n = 0, first = 0; n < vectors; n++) {
        const Vi near = near_level(footprints.lod8[n]);
        const Vi far = far_level(sampler, footprints.lod8[n]);
        const int count = list_vector(&list, first, texture, mode, near, far, &footprints, n);
        prefetch_alpha(texture, &list, first, count);
        first += count;
    }
    for (int n = 0, first = 0; n < vectors; n++) {
        const Vi lod8 = footprints.lod8[n];
        const Vf fraction = vf_from_int(lod8 & 255);
        const Probes near = {near_level(lod8), first, list.near[n], footprints.near.count[n]};
        const Probes far = {far_level(sampler, lod8), first + list.near[n], list.far[n],
                            footprints.far.count[n]};
        AlphaChange of_near = {vf_splat(0.0f), vf_splat(0.0f)};
        AlphaChange of_far = of_near;
        Vf alpha =
            mean_alpha(texture, mode, &list, &near, slope ? &of_near : NULL) * (256.0f - fraction);
        if (far.count > 0) {
            alpha += mean_alpha(texture, mode, &list, &far, slope ? &of_far : NULL) * fraction;
        }
        vf_store(out + n * DIP_LANES, alpha / 4278190080.0f);
        if (slope) {
            const AlphaChange blended = {of_near.u * (256.0f - fraction) + of_far.u * fraction,
                                         of_near.v * (256.0f - fraction) + of_far.v * fraction};
            vf_store(slope + n * DIP_LANES,
                     slope_of(batch, texture, u_varying, n, blended) / 4278190080.0f);
        }
        first = far.first + far.count;
    }
}

void DIP_KERNEL(dip_kernel_sample_alpha)(DipFragmentBatch *batch, const DipSampler *sampler,
                                         int u_varying, float *out) {
    if (!sampler->texture->alpha) {
        for (int i = 0; i < batch->count; i += DIP_LANES) {
            vf_store(out + i, vf_splat(1.0f));
        }
        return;
    }
    SAMPLE_BY_MODE(sample_alpha, sampler->texture, u_varying, out, NULL);
}

void DIP_KERNEL(dip_kernel_sample_alpha_slope)(DipFragmentBatch *batch, const DipSampler *sampler,
                                               int u_varying, float *out, float *slope) {
    if (!sampler->texture->alpha) {
        for (int i = 0; i < batch->count; i += DIP_LANES) {
            vf_store(out + i, vf_splat(1.0f));
            vf_store(slope + i, vf_splat(0.0f));
        }
        return;
    }
    SAMPLE_BY_MODE(sample_alpha, sampler->texture, u_varying, out, slope);
}
