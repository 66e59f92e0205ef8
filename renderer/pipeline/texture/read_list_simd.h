// Lists the bilinear reads of a batch of fragments: which texels its footprints need, and with what
// weights. sample_colour_simd.c and sample_alpha_simd.c read and filter them. docs/picture.md
// (Textures) defines the probes.
//
// A footprint blends two mip levels: `near` is the finer level and `far` is the coarser level. All
// reads of a batch are listed before the first texel is read. While they are listed, their texels
// are prefetched, so that the processor waits for many texels at once.
#ifndef DIP_RENDERER_PIPELINE_TEXTURE_READ_LIST_SIMD_H
#define DIP_RENDERER_PIPELINE_TEXTURE_READ_LIST_SIMD_H

#include "renderer/base/pages.h"
#include "renderer/pipeline/shader.h"
#include "renderer/pipeline/texture/address_simd.h"
#include "renderer/pipeline/texture/footprint_simd.h"
#include "renderer/pipeline/texture/texture_layout.h"
#include "renderer/simd/vec.h"

enum { VECTORS = DIP_FRAGMENT_BATCH / DIP_LANES };

// How a texture is read. The fields are constants in each inlined copy of the loops below.
typedef struct ReadMode {
    bool anisotropic; // several probes per level
    // Coordinates are 32-bit fixed-point fractions of the texture's size, which wrap by overflow.
    bool in_bits;
    bool any_wrap; // all address modes, in floats; otherwise only repeat and clamp
    bool nearest;  // the nearest texel, in floats, with all address modes
    bool marks;    // mark what the derivatives of the read depend on (ReadList)
} ReadMode;

// The probes of a batch's footprints in one of their two levels. Only anisotropic reads use this.
// Coordinates are in units of 2^-32 if the mode is in_bits; otherwise they are floats, stored as
// their bits.
typedef struct Line {
    Vi count[VECTORS];  // number of probes; 0 if the level is not read
    Vf weight[VECTORS]; // weight of one probe in the footprint
    Vu u[VECTORS];      // coordinates of the first probe
    Vu v[VECTORS];
    Vu step_u[VECTORS];
    Vu step_v[VECTORS];
} Line;

// The footprints of a batch. All footprints are computed before any texel is read. Their long
// chains of dependent operations then overlap; reads in between would prevent this.
typedef struct Footprints {
    Vi lod8[VECTORS];
    Vu u[VECTORS]; // coordinates of the footprint's middle
    Vu v[VECTORS];
    Line near;
    Line far;
} Footprints;

// Returns the fractional part of a coordinate in units of 2^-32. Infinities and NaN give an
// arbitrary fraction.
VEC_INLINE Vu fraction32(Vf coordinate) {
    const Vf unit = coordinate - vf_floor(coordinate);
    const Vf bounded = vf_max(vf_min(unit, vf_splat(0.99999994f)), vf_splat(0.0f));
    return (Vu)vi_from_float((bounded - 0.5f) * 4294967296.0f) + 0x80000000u;
}

// Returns a step in units of 2^-32. The step is first reduced modulo 1 to -1/2 .. 1/2, so that
// small steps keep their precision.
VEC_INLINE Vu step32(Vf step) {
    const Vf near = step - vf_floor(step + 0.5f);
    const Vf bounded = vf_max(vf_min(near, vf_splat(0.49999997f)), vf_splat(-0.5f));
    return (Vu)vi_from_float(bounded * 4294967296.0f);
}

// Sets the first probe and the step of vector n as 32-bit fractions. The step is computed as twice
// the half step. The half step cannot be computed from the step, because half of a step that has
// wrapped could be off by 1/2.
VEC_INLINE void set_line32(const HalfStep *half, Vu u, Vu v, Line *line, int n) {
    const Vu gaps = (Vu)line->count[n] - 1u;
    const Vu half_u = step32(half->u);
    const Vu half_v = step32(half->v);
    line->u[n] = u - gaps * half_u;
    line->v[n] = v - gaps * half_v;
    line->step_u[n] = half_u + half_u;
    line->step_v[n] = half_v + half_v;
}

// Sets the probes of vector n in a level. level_weight: the level's weight in the blend of the two
// levels.
VEC_INLINE void set_line(Line *line, const DipTexture *texture, ReadMode mode, const Axis *axis,
                         const Footprints *footprints, Vf level_weight, int n) {
    const Vf inverse = inverse_of(line->count[n]);
    const HalfStep half = half_step(texture, axis, inverse);
    line->weight[n] = level_weight * inverse;
    if (mode.in_bits) {
        set_line32(&half, footprints->u[n], footprints->v[n], line, n);
        return;
    }
    const Vf gaps = vf_from_int(line->count[n] - 1);
    line->u[n] = (Vu)((Vf)footprints->u[n] - gaps * half.u);
    line->v[n] = (Vu)((Vf)footprints->v[n] - gaps * half.v);
    line->step_u[n] = (Vu)(half.u + half.u);
    line->step_v[n] = (Vu)(half.v + half.v);
}

// The work of a batch so far, summed per lane: probes in the finer level, and bilinear reads.
typedef struct LaneWork {
    Vi probes;
    Vi reads;
} LaneWork;

// Adds the work of the first `lanes` lanes. The other lanes are beyond the end of the batch.
VEC_INLINE void count_work(LaneWork *work, Vi near, Vi far, int lanes) {
    const Mask own = vi_lt(vi_iota(), vi_splat(lanes));
    work->probes += vi_select(own, near, vi_splat(0));
    work->reads += vi_select(own, near + far, vi_splat(0));
}

// Replaces levels of detail that lie between two levels by one level: the nearest one, where halves
// become the coarser level, or without mips the finest one that may be read.
VEC_INLINE void choose_single_levels(const DipSampler *sampler, Vi *lod8, int count) {
    const int32_t last = (sampler->texture->level_count - 1) * 256;
    const int32_t finest = (sampler->min_lod8 < last ? sampler->min_lod8 : last) & ~255;
    for (int n = 0; n < count; n++) {
        if (sampler->no_mips) {
            lod8[n] = vi_splat(finest);
        } else {
            lod8[n] = (lod8[n] + 128) & ~255;
        }
    }
}

// Computes the footprints of a batch. Short loops let the processor overlap long dependency chains.
// textures: the number of textures that share these footprints.
VEC_INLINE void find_footprints(DipFragmentBatch *batch, const DipSampler *sampler, ReadMode mode,
                                int varying, int textures, Footprints *out) {
    const int count = (batch->count + DIP_LANES - 1) / DIP_LANES;
    const DipTexture *texture = sampler->texture;
    Axis axes[VECTORS];
    for (int n = 0; n < count; n++) {
        const Jacobian jacobian = read_jacobian(batch, texture, varying, n * DIP_LANES);
        if (mode.anisotropic) {
            axes[n] = anisotropic_axis(sampler, jacobian);
        } else {
            axes[n].minor2 = isotropic_minor2(jacobian);
        }
    }
    for (int n = 0; n < count; n++) {
        out->lod8[n] = find_level(sampler, axes[n].minor2);
    }
    const int cheap = sampler->cheap;
    for (int n = 0; cheap && n < count; n++) {
        out->lod8[n] = narrow_blend(out->lod8[n]);
    }
    if (sampler->filter != DIP_FILTER_TRILINEAR || sampler->no_mips) {
        choose_single_levels(sampler, out->lod8, count);
    }
    LaneWork work = {vi_splat(0), vi_splat(0)};
    for (int n = 0; n < count; n++) {
        const Vi fraction = out->lod8[n] & 255;
        const Vi near = mode.anisotropic ? count_probes(sampler, &axes[n], cheap) : vi_splat(1);
        const Vi most = mode.anisotropic ? count_far_probes(near, fraction) : vi_splat(1);
        const Vi far = vi_select(vi_lt(vi_splat(0), fraction), most, vi_splat(0));
        if (mode.anisotropic) {
            out->near.count[n] = near;
            out->far.count[n] = far;
        }
        count_work(&work, near, far, batch->count - n * DIP_LANES);
    }
    for (int n = 0; n < count; n++) {
        const Vf u = vf_load(batch->varying[varying] + n * DIP_LANES);
        const Vf v = vf_load(batch->varying[varying + 1] + n * DIP_LANES);
        out->u[n] = mode.in_bits ? fraction32(u) : (Vu)u;
        out->v[n] = mode.in_bits ? fraction32(v) : (Vu)v;
        if (mode.anisotropic) {
            const Vf far = vf_from_int(out->lod8[n] & 255) * (1.0f / 256.0f);
            set_line(&out->near, texture, mode, &axes[n], out, 1.0f - far, n);
            set_line(&out->far, texture, mode, &axes[n], out, far, n);
        }
    }
    batch->work.probes += (uint64_t)vi_sum(work.probes) * (uint64_t)textures;
    batch->work.texels += (uint64_t)vi_sum(work.reads) * (uint64_t)textures * 4;
}

// --- a read --------------------------------------------------------------------------------------

// The layout of the level that each lane reads.
typedef struct Level {
    Vi offset;
    Vi stride; // not used if the mode is in_bits
    Vi width;  // width in texels, or log2 of the width if the mode is in_bits
    Vi height;
} Level;

// A bilinear read: the index of its quad, and its position within the level in 1/256 texel.
typedef struct Taps {
    Vi index;
    Vi x8;
    Vi y8;
    Vi marks; // as in ReadList.between; without meaning unless the mode marks positions
} Taps;

// Returns the distance between rows of a level of the given width.
VEC_INLINE Vi row_stride(const DipTexture *texture, ReadMode mode, Vi width) {
    return width + (mode.any_wrap || mode.nearest ? texture->padding : 1);
}

VEC_INLINE Level read_level(const DipTexture *texture, ReadMode mode, Vi level) {
    Level out;
    out.offset = vi_lookup16(texture->level_offset, level);
    if (mode.in_bits) {
        out.width = vi_lookup16(texture->level_log2_width, level);
        out.height = vi_lookup16(texture->level_log2_height, level);
        out.stride = vi_splat(0);
    } else {
        out.width = vi_lookup16(texture->level_width, level);
        out.height = vi_lookup16(texture->level_height, level);
        out.stride = row_stride(texture, mode, out.width);
    }
    return out;
}

// A walk along the probes of one vector in a level.
typedef struct Walk {
    Level level;
    Vu u, v; // if in_bits, minus half a texel: texel centres are at whole texels
    Vu step_u, step_v;
    int probe;
    int count; // largest number of probes of any lane
} Walk;

// Starts a walk along vector n's probes in a level. `line` is used only if the mode is anisotropic.
VEC_INLINE Walk begin_walk(const DipTexture *texture, ReadMode mode, Vi level,
                           const Footprints *footprints, const Line *line, int n) {
    Walk walk = {.level = read_level(texture, mode, level),
                 .u = mode.anisotropic ? line->u[n] : footprints->u[n],
                 .v = mode.anisotropic ? line->v[n] : footprints->v[n],
                 .count = 1};
    if (mode.in_bits) {
        walk.u -= vu_splat(0x80000000u) >> (Vu)walk.level.width;
        walk.v -= vu_splat(0x80000000u) >> (Vu)walk.level.height;
    }
    if (mode.anisotropic) {
        walk.step_u = line->step_u[n];
        walk.step_v = line->step_v[n];
        walk.count = vi_greatest(line->count[n]);
    }
    return walk;
}

VEC_INLINE void next_probe(Walk *walk, ReadMode mode) {
    walk->probe++;
    if (mode.in_bits && mode.anisotropic) {
        walk->u += walk->step_u;
        walk->v += walk->step_v;
    }
}

// Marks in the list of reads: along this axis, all positions around read the same texel, or the
// copy of the texture is mirrored.
enum { FLAT_X = 1 << 8, BACKWARDS_X = 1 << 9, FLAT_Y = 1 << 16, BACKWARDS_Y = 1 << 17 };

VEC_INLINE Vi mark(Mask lanes, int mark_of_lanes) {
    return vi_select(lanes, vi_splat(mark_of_lanes), vi_splat(0));
}

// Returns the bilinear read at the walk's current position.
VEC_INLINE Taps find_taps(const DipTexture *texture, ReadMode mode, const Walk *walk) {
    const Level *level = &walk->level;
    Taps taps;
    taps.marks = vi_splat(0);
    if (mode.in_bits) {
        taps.x8 = (Vi)(walk->u >> (Vu)(24 - level->width));
        taps.y8 = (Vi)(walk->v >> (Vu)(24 - level->height));
        const Vi y = taps.y8 >> 8;
        taps.index = (level->offset + (taps.x8 >> 8)) + ((y << level->width) + y);
    } else {
        const float probe = (float)walk->probe;
        const Vf u = mode.anisotropic ? (Vf)walk->u + (Vf)walk->step_u * probe : (Vf)walk->u;
        const Vf v = mode.anisotropic ? (Vf)walk->v + (Vf)walk->step_v * probe : (Vf)walk->v;
        if (mode.nearest) {
            taps.x8 = nearest_address(u, texture->wrap_u, level->width);
            taps.y8 = nearest_address(v, texture->wrap_v, level->height);
        } else if (mode.any_wrap) {
            taps.x8 = any_address(u, texture->wrap_u, level->width);
            taps.y8 = any_address(v, texture->wrap_v, level->height);
        } else {
            taps.x8 = address(u, texture->wrap_u, level->width);
            taps.y8 = address(v, texture->wrap_v, level->height);
        }
        taps.index = (level->offset + (taps.x8 >> 8)) + (taps.y8 >> 8) * level->stride;
        if (mode.marks) {
            taps.marks = mark(reads_first_alone(u, texture->wrap_u, level->width), FLAT_X) |
                         mark(reads_first_alone(v, texture->wrap_v, level->height), FLAT_Y);
            if (mode.any_wrap) {
                taps.marks |= mark(runs_backwards(u, texture->wrap_u), BACKWARDS_X) |
                              mark(runs_backwards(v, texture->wrap_v), BACKWARDS_Y);
            }
        }
    }
    return taps;
}

VEC_INLINE Vi near_level(Vi lod8) {
    return lod8 >> 8;
}

VEC_INLINE Vi far_level(const DipSampler *sampler, Vi lod8) {
    return vi_min((lod8 >> 8) + 1, vi_splat(sampler->texture->level_count - 1));
}

// --- the list ------------------------------------------------------------------------------------

// The most probes of a vector in a level (DipSampler), and the most reads in its two levels.
enum { MOST_PROBES = 16, MOST_READS = 2 * MOST_PROBES };

// The bilinear reads of a batch: for each vector those in the finer level, then those in the
// coarser one.
typedef struct ReadList {
    _Alignas(DIP_CACHE_LINE) int32_t index[VECTORS * MOST_READS][DIP_LANES]; // the quads
    // Positions between the texels in 1/256 texel: x in the lowest 8 bits, y in the highest 8 bits.
    // In between are marks like FLAT_X, if the mode marks positions.
    int32_t between[VECTORS * MOST_READS][DIP_LANES];
    int near[VECTORS]; // number of reads of each vector in the finer level
    int far[VECTORS];
} ReadList;

// Lists the reads of vector n in a level, from number `first` on, and returns how many these are.
// Lanes that have run out of probes read the quad of zeroes.
VEC_INLINE int list_level(ReadList *list, int first, const DipTexture *texture, ReadMode mode,
                          Vi level, const Footprints *footprints, const Line *line, int n) {
    const Vi zeroes = vi_splat((int32_t)texture->texel_count);
    Walk walk = begin_walk(texture, mode, level, footprints, line, n);
    // A sampler with a greater max_anisotropy than is allowed must not overrun the list.
    walk.count = walk.count < MOST_PROBES ? walk.count : MOST_PROBES;
    while (walk.probe < walk.count) {
        const Taps taps = find_taps(texture, mode, &walk);
        const int i = first + walk.probe;
        if (mode.anisotropic) {
            const Mask reads = vi_lt(vi_splat(walk.probe), line->count[n]);
            vi_store(list->index[i], vi_select(reads, taps.index, zeroes));
        } else {
            vi_store(list->index[i], taps.index);
        }
        const Vi between = (taps.x8 & 255) | (Vi)((Vu)taps.y8 << 24);
        vi_store(list->between[i], mode.marks ? between | taps.marks : between);
        next_probe(&walk, mode);
    }
    return walk.count;
}

// Lists the reads of vector n in the levels `near` and `far`, from number `first` on, and returns
// how many these are.
VEC_INLINE int list_vector(ReadList *list, int first, const DipTexture *texture, ReadMode mode,
                           Vi near, Vi far, const Footprints *footprints, int n) {
    list->near[n] = list_level(list, first, texture, mode, near, footprints, &footprints->near, n);
    list->far[n] = 0;
    if (mask_any(vi_lt(vi_splat(0), footprints->lod8[n] & 255))) {
        list->far[n] = list_level(list, first + list->near[n], texture, mode, far, footprints,
                                  &footprints->far, n);
    }
    return list->near[n] + list->far[n];
}

// Calls sample(batch, sampler, mode, ...) with a constant mode, so that each mode gets an inlined
// copy of its own. from: the texture that is read.
#define SAMPLE_BY_MODE(sample, from, ...)                                                          \
    do {                                                                                           \
        const bool anisotropic = sampler->max_anisotropy > 1;                                      \
        if (sampler->filter == DIP_FILTER_POINT) {                                                 \
            sample(batch, sampler, (ReadMode){.nearest = true}, __VA_ARGS__);                      \
        } else if ((from)->special_wrap && anisotropic) {                                          \
            sample(batch, sampler, (ReadMode){.anisotropic = true, .any_wrap = true},              \
                   __VA_ARGS__);                                                                   \
        } else if ((from)->special_wrap) {                                                         \
            sample(batch, sampler, (ReadMode){.any_wrap = true}, __VA_ARGS__);                     \
        } else if (anisotropic && (from)->wraps_in_bits) {                                         \
            sample(batch, sampler, (ReadMode){.anisotropic = true, .in_bits = true}, __VA_ARGS__); \
        } else if (anisotropic) {                                                                  \
            sample(batch, sampler, (ReadMode){.anisotropic = true}, __VA_ARGS__);                  \
        } else if ((from)->wraps_in_bits) {                                                        \
            sample(batch, sampler, (ReadMode){.in_bits = true}, __VA_ARGS__);                      \
        } else {                                                                                   \
            sample(batch, sampler, (ReadMode){.nearest = false}, __VA_ARGS__);                     \
        }                                                                                          \
    } while (false)

#endif
