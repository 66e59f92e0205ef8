// Texture reads: probes and filtering. docs/picture.md (Textures) defines both. This file is
// compiled once per instruction set.
//
// Colours are filtered in 16-bit fixed point. A texel holds square roots of linear light
// (texture_layout.h). The roots are squared and the squares are multiplied by 16-bit weights; each
// product keeps its upper 16 bits. The four texels of a bilinear read are loaded at once and stay
// side by side (simd/quads.h) until they are summed. Sums are integers, so the order of lanes and
// probes does not matter. A footprint blends two mip levels: `near` is the finer level and `far` is
// the coarser level.
//
// All bilinear reads of a batch are listed before the first texel is read. While they are listed,
// their texels are prefetched, so that the processor waits for many texels at once.
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/pipeline/texture/footprint_simd.h"
#include "renderer/pipeline/texture/texture_layout.h"
#include "renderer/simd/quads.h"

#include <string.h>

enum { VECTORS = DIP_FRAGMENT_BATCH / DIP_LANES };

// How a texture is read. The fields are constants in each inlined copy of the loops below.
typedef struct ReadMode {
    bool anisotropic; // several probes per level
    // Coordinates are 32-bit fixed-point fractions of the texture's size, which wrap by overflow.
    bool in_bits;
    bool any_wrap; // all address modes, in floats; otherwise only repeat and clamp
    bool nearest;  // the nearest texel, in floats, with all address modes
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

// --- addresses ---------------------------------------------------------------------------------

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

// Converts a coordinate to a position in 1/256 texel, in a level of any size. Texel centres are at
// whole numbers of texels. If the axis repeats, positions before the first centre continue from the
// last texel. Infinities and NaN become coordinate 0 or 1, so that no address leaves the texture.
VEC_INLINE Vi address(Vf coordinate, DipWrap wrap, Vi size) {
    const Vf unwrapped = wrap == DIP_WRAP_REPEAT ? coordinate - vf_floor(coordinate) : coordinate;
    const Vf unit = vf_min(vf_max(unwrapped, vf_splat(0.0f)), vf_splat(1.0f));
    const Vi at = vi_from_float(unit * vf_from_int(size << 8)) - 128;
    const Vi before = at >> 31; // all bits set where negative
    return wrap == DIP_WRAP_REPEAT ? at + (before & (size << 8)) : at & ~before;
}

// Limits the coordinates of an axis with a border: beyond a texture's size before and behind the
// texture, everything has the border's colour. NaN becomes the upper limit.
VEC_INLINE Vf near_texture(Vf coordinate) {
    return vf_max(vf_min(coordinate, vf_splat(2.0f)), vf_splat(-1.0f));
}

// Returns a coordinate within 0..1 at which an axis without a border has the same texels.
VEC_INLINE Vf fold(Vf coordinate, DipWrap wrap) {
    Vf folded = coordinate;
    if (wrap == DIP_WRAP_REPEAT) {
        folded = coordinate - vf_floor(coordinate);
    } else if (wrap == DIP_WRAP_MIRROR) {
        const Vf phase = coordinate - 2.0f * vf_floor(coordinate * 0.5f); // 0..2
        folded = vf_min(phase, 2.0f - phase);
    }
    return vf_min(vf_max(folded, vf_splat(0.0f)), vf_splat(1.0f));
}

// Does what `address` does, for all address modes. Beyond a border's texel, positions stay at the
// texel -1 or `size`, which the padding holds. A mirrored texel next to the edge is the texel at
// the edge, so a mirrored axis continues like a clamped one.
VEC_INLINE Vi any_address(Vf coordinate, DipWrap wrap, Vi size) {
    const Vf scale = vf_from_int(size << 8);
    if (wrap == DIP_WRAP_BORDER) {
        const Vi at = vi_from_float(vf_floor(near_texture(coordinate) * scale)) - 128;
        return vi_min(vi_max(at, vi_splat(-256)), size << 8);
    }
    const Vi at = vi_from_float(fold(coordinate, wrap) * scale) - 128;
    const Vi before = at >> 31; // all bits set where negative
    return wrap == DIP_WRAP_REPEAT ? at + (before & (size << 8)) : at & ~before;
}

// Returns the position of the nearest texel. Without a border, texel `size` has no row below it.
VEC_INLINE Vi nearest_address(Vf coordinate, DipWrap wrap, Vi size) {
    const Vf scale = vf_from_int(size << 8);
    if (wrap == DIP_WRAP_BORDER) {
        const Vi texel = vi_from_float(vf_floor(near_texture(coordinate) * scale)) >> 8;
        return vi_min(vi_max(texel, vi_splat(-1)), size) << 8;
    }
    return vi_min(vi_from_float(fold(coordinate, wrap) * scale) >> 8, size - 1) << 8;
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

// Returns the bilinear read at the walk's current position.
VEC_INLINE Taps find_taps(const DipTexture *texture, ReadMode mode, const Walk *walk) {
    const Level *level = &walk->level;
    Taps taps;
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
    }
    return taps;
}

VEC_INLINE Vi near_level(Vi lod8) {
    return lod8 >> 8;
}

VEC_INLINE Vi far_level(const DipSampler *sampler, Vi lod8) {
    return vi_min((lod8 >> 8) + 1, vi_splat(sampler->texture->level_count - 1));
}

// Returns the level that mip debugging shows instead of `level`.
VEC_INLINE Vi shown_level(const DipSampler *sampler, Vi level) {
    return sampler->shown ? vi_lookup16(sampler->shown_level, level) : level;
}

// --- the list of reads ---------------------------------------------------------------------------

// The most probes of a vector in a level (DipSampler), and the most reads in its two levels.
enum { MOST_PROBES = 16, MOST_READS = 2 * MOST_PROBES };

// The bilinear reads of a batch: for each vector those in the finer level, then those in the
// coarser one.
typedef struct ReadList {
    int near[VECTORS]; // number of reads of each vector in the finer level
    int far[VECTORS];
    int32_t index[VECTORS * MOST_READS][DIP_LANES]; // the quads
    // Positions between the texels in 1/256 texel: x in the lowest 8 bits, y in the highest 8 bits.
    int32_t between[VECTORS * MOST_READS][DIP_LANES];
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
        vi_store(list->between[i], (taps.x8 & 255) | (Vi)((Vu)taps.y8 << 24));
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

// --- colour ------------------------------------------------------------------------------------

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

// Prefetches the texels of `count` listed reads. Each quad lies in one or two cache lines, mostly
// in one; only the first one is prefetched.
VEC_INLINE void prefetch_texels(const DipTexture *texture, const ReadList *list, int first,
                                int count) {
    const int32_t *index = list->index[first];
    for (int i = 0; i < count * DIP_LANES; i++) {
        __builtin_prefetch(texture->texels + (uint32_t)index[i]);
    }
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
            prefetch_texels(read.texture[t], &list, first, count);
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

// --- alpha -------------------------------------------------------------------------------------

// How alpha changes per texel of level 0, along u and v, in the unit of mean_alpha.
typedef struct AlphaChange {
    Vf u, v;
} AlphaChange;

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
        change->u = ((b - a) * (256.0f - down) + (d - c) * down) * 256.0f;
        change->v = ((c - a) * (256.0f - right) + (d - b) * right) * 256.0f;
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

VEC_INLINE void prefetch_alpha(const DipTexture *texture, const ReadList *list, int first,
                               int count) {
    const int32_t *index = list->index[first];
    for (int i = 0; i < count * DIP_LANES; i++) {
        __builtin_prefetch(texture->alpha + (uint32_t)index[i]);
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

// --- kernels -----------------------------------------------------------------------------------

// Calls sample(batch, sampler, mode, ...) with a constant mode, so that each mode gets an inlined
// copy of its own. from: the texture that is read.
#define SAMPLE_BY_MODE(sample, from, ...)                                                          \
    do {                                                                                           \
        const bool anisotropic = sampler->max_anisotropy > 1;                                      \
        if (sampler->filter == DIP_FILTER_POINT) {                                                 \
            sample(batch, sampler, (ReadMode){false, false, false, true}, __VA_ARGS__);            \
        } else if ((from)->special_wrap && anisotropic) {                                          \
            sample(batch, sampler, (ReadMode){true, false, true, false}, __VA_ARGS__);             \
        } else if ((from)->special_wrap) {                                                         \
            sample(batch, sampler, (ReadMode){false, false, true, false}, __VA_ARGS__);            \
        } else if (anisotropic && (from)->wraps_in_bits) {                                         \
            sample(batch, sampler, (ReadMode){true, true, false, false}, __VA_ARGS__);             \
        } else if (anisotropic) {                                                                  \
            sample(batch, sampler, (ReadMode){true, false, false, false}, __VA_ARGS__);            \
        } else if ((from)->wraps_in_bits) {                                                        \
            sample(batch, sampler, (ReadMode){false, true, false, false}, __VA_ARGS__);            \
        } else {                                                                                   \
            sample(batch, sampler, (ReadMode){false, false, false, false}, __VA_ARGS__);           \
        }                                                                                          \
    } while (false)

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
