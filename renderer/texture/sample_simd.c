// Texture reads: probes and filtering, compiled once per instruction set. docs/picture.md defines
// them.
//
// Colours are filtered in 16-bit fixed point: a texel's codes are widened to 16 bits, squared to
// linear light, and weighted by 16-bit fractions, keeping the upper half of each product. Two
// texels beside each other are fetched at once and stay side by side ("pair order", simd/vec.h)
// until their sum. Sums are whole numbers, so no order of lanes or probes matters.
#include "renderer/raster/kernels.h"
#include "renderer/simd/vec.h"
#include "renderer/texture/footprint_simd.h"
#include "renderer/texture/texture.h"

// The batch's work so far, a sum per lane: of probes, and of levels that they read.
typedef struct LaneWork {
    Vi probes;
    Vi levels;
} LaneWork;

VEC_INLINE LaneWork no_work(void) {
    return (LaneWork){vi_splat(0), vi_splat(0)};
}

// Adds the work of the lanes that are the batch's own.
VEC_INLINE void count_work(LaneWork *work, const Footprint *footprint, int lanes) {
    const Vi own = vi_select(vi_lt(vi_iota(), vi_splat(lanes)), footprint->probes, vi_splat(0));
    const Mask blends = vi_lt(vi_splat(0), footprint->fraction);
    work->probes += own;
    work->levels += own + vi_select(blends, own, vi_splat(0));
}

VEC_INLINE void add_work(DipSampleWork *total, const LaneWork *work) {
    total->probes += (uint64_t)vi_sum(work->probes);
    total->texels += (uint64_t)vi_sum(work->levels) * 4;
}

// All footprints of a batch before any texel is read: their long chains of dependent operations
// overlap, which they would not with the reads in between.
VEC_INLINE void find_footprints(DipFragmentBatch *batch, const DipSampler *sampler, int slot,
                                Footprint *footprints) {
    LaneWork work = no_work();
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        footprints[i / DIP_LANES] = footprint_at(batch, sampler, slot, i);
        count_work(&work, &footprints[i / DIP_LANES], batch->count - i);
    }
    add_work(&batch->work, &work);
}

// --- addresses ---------------------------------------------------------------------------------

// Where a vector's probes lie: as fractions of the texture in 32 bits, which wrap by themselves, or
// as floats, for textures of other sizes and address modes.
typedef struct Walk {
    bool in_bits;
    Vu u, v;
    Vu step_u, step_v;
    const Footprint *footprint;
} Walk;

// A level's table entries per lane.
typedef struct Level {
    Vi offset;
    Vi stride;
    Vi stride_pairs; // stride, in pair order
    Vi width;        // texels; in_bits: their log2
    Vi height;
} Level;

// A bilinear read: the first texel's index and its place in 1/256 texel, the whole texels included.
typedef struct Taps {
    Vi index;
    Vi x8;
    Vi y8;
} Taps;

// The fraction of a coordinate in units of 2^-32. Infinities and NaN become some fraction.
VEC_INLINE Vu fraction32(Vf coordinate) {
    const Vf unit = coordinate - vf_floor(coordinate);
    const Vf bounded = vf_max(vf_min(unit, vf_splat(0.99999994f)), vf_splat(0.0f));
    return (Vu)vi_from_float((bounded - 0.5f) * 4294967296.0f) + 0x80000000u;
}

// A step likewise, modulo 1: the nearest of its values, in -1/2 .. 1/2, so that small steps keep
// their precision.
VEC_INLINE Vu step32(Vf step) {
    const Vf near = step - vf_floor(step + 0.5f);
    const Vf bounded = vf_max(vf_min(near, vf_splat(0.49999997f)), vf_splat(-0.5f));
    return (Vu)vi_from_float(bounded * 4294967296.0f);
}

VEC_INLINE Walk begin_walk(const DipTexture *texture, const Footprint *footprint) {
    Walk walk = {.in_bits = texture->wraps_in_bits, .footprint = footprint};
    walk.step_u = walk.step_v = vu_splat(0);
    if (walk.in_bits) {
        walk.u = fraction32(footprint->u);
        walk.v = fraction32(footprint->v);
        if (footprint->most_probes > 1) {
            walk.step_u = step32(footprint->step_u);
            walk.step_v = step32(footprint->step_v);
        }
    }
    return walk;
}

VEC_INLINE Level read_level(const DipTexture *texture, Vi level) {
    Level out;
    out.offset = vi_lookup16(texture->level_offset, level);
    if (texture->wraps_in_bits) {
        out.width = vi_lookup16(texture->level_log2_width, level);
        out.height = vi_lookup16(texture->level_log2_height, level);
        out.stride = (vi_splat(1) << out.width) + 1;
    } else {
        out.width = vi_lookup16(texture->level_width, level);
        out.height = vi_lookup16(texture->level_height, level);
        out.stride = out.width + 1;
    }
    out.stride_pairs = vi_pair_order(out.stride);
    return out;
}

// A fraction to 1/256 texel of a level with 2^log2_size texels, texel centres at whole numbers.
// Before the first centre comes the last texel.
VEC_INLINE Vi address_in_bits(Vu fraction, Vi log2_size) {
    const Vu half_texel = vu_splat(0x80000000u) >> (Vu)log2_size;
    return (Vi)((fraction - half_texel) >> (Vu)(24 - log2_size));
}

// A coordinate likewise on a level of any size. Infinities and NaN become 0 or 1, so that no
// address leaves the texture.
VEC_INLINE Vi address(Vf coordinate, DipWrap wrap, Vi size) {
    const Vf unwrapped = wrap == DIP_WRAP_REPEAT ? coordinate - vf_floor(coordinate) : coordinate;
    const Vf unit = vf_min(vf_max(unwrapped, vf_splat(0.0f)), vf_splat(1.0f));
    const Vi at = vi_from_float(unit * vf_from_int(size << 8)) - 128;
    const Vi before = at >> 31; // all ones where negative
    return wrap == DIP_WRAP_REPEAT ? at + (before & (size << 8)) : at & ~before;
}

// Probe k's read of a level.
VEC_INLINE Taps taps_at(const DipTexture *texture, const Walk *walk, int k, const Level *level) {
    Taps taps;
    if (walk->in_bits) {
        taps.x8 = address_in_bits(walk->u, level->width);
        taps.y8 = address_in_bits(walk->v, level->height);
        const Vi y = taps.y8 >> 8;
        taps.index = (level->offset + (taps.x8 >> 8)) + ((y << level->width) + y);
    } else {
        const Footprint *footprint = walk->footprint;
        const Vf u = footprint->u + footprint->step_u * (float)k;
        const Vf v = footprint->v + footprint->step_v * (float)k;
        taps.x8 = address(u, texture->wrap_u, level->width);
        taps.y8 = address(v, texture->wrap_v, level->height);
        taps.index = (level->offset + (taps.x8 >> 8)) + (taps.y8 >> 8) * level->stride;
    }
    return taps;
}

VEC_INLINE void next_probe(Walk *walk) {
    if (walk->in_bits) {
        walk->u += walk->step_u;
        walk->v += walk->step_v;
    }
}

// --- colour ------------------------------------------------------------------------------------

// Sums of texels in pair order, 16 bits per channel: red and green, and blue.
typedef struct PairSum {
    VuPair red_green;
    VuPair blue;
} PairSum;

// Sums over the probes.
typedef struct Colour {
    Vi c[3];
} Colour;

// Adds half of the pairs: linear light, the square of the codes, times a 16-bit weight.
VEC_INLINE void add_texels(Vu *red_green, Vu *blue, Vu texels, Vu weight) {
    const Vu rg = texels & DIP_TEXEL_RED_GREEN;
    const Vu b = vu_dot16(texels & DIP_TEXEL_BLUE, DIP_TEXEL_BLUE_PLACES);
    *red_green += vu_mulhi16(vu_mulhi16(rg, rg), weight);
    *blue += vu_mulhi16(vu_mulhi16(b, b), weight);
}

VEC_INLINE void add_row(PairSum *sum, const DipTexture *texture, Vi index_pairs, VuPair across,
                        VuPair row_weight) {
    const VuPair texels = vu_gather_pairs(texture->texels, index_pairs);
    add_texels(&sum->red_green.a, &sum->blue.a, texels.a, vu_mulhi16(across.a, row_weight.a));
    add_texels(&sum->red_green.b, &sum->blue.b, texels.b, vu_mulhi16(across.b, row_weight.b));
}

// Adds a bilinear read times the level's weight.
VEC_INLINE void add_level(PairSum *sum, const DipTexture *texture, const Level *level,
                          const Taps *taps, VuPair weight) {
    const VuPair across = vu_pair_ramp(taps->x8);
    const VuPair down = vu_pair_both(taps->y8);
    const VuPair lower = {vu_mulhi16(down.a, weight.a), vu_mulhi16(down.b, weight.b)};
    const VuPair upper = {weight.a - lower.a, weight.b - lower.b};
    const Vi index = vi_pair_order(taps->index);
    add_row(sum, texture, index, across, upper);
    add_row(sum, texture, index + level->stride_pairs, across, lower);
}

VEC_INLINE Vi shown_level(const DipSampler *sampler, Vi level) {
    return sampler->shown ? vi_lookup16(sampler->shown_level, level) : level;
}

VEC_INLINE Colour filter_colour(const DipSampler *sampler, const Footprint *footprint) {
    const DipTexture *texture = sampler->shown ? sampler->shown : sampler->texture;
    const Level near = read_level(texture, shown_level(sampler, footprint->level));
    const Level far = read_level(texture, shown_level(sampler, footprint->next_level));
    const bool blend = mask_any(vi_lt(vi_splat(0), footprint->fraction));
    const VuPair far_weight = vu_pair_both(footprint->fraction);
    const VuPair near_weight = {~far_weight.a, ~far_weight.b};
    Colour total = {{vi_splat(0), vi_splat(0), vi_splat(0)}};
    Walk walk = begin_walk(texture, footprint);
    for (int k = 0; k < footprint->most_probes; k++) {
        PairSum sum = {{{0}, {0}}, {{0}, {0}}};
        const Taps near_taps = taps_at(texture, &walk, k, &near);
        add_level(&sum, texture, &near, &near_taps, near_weight);
        if (blend) { // where the fraction is 0 it adds nothing, so lanes do not matter
            const Taps far_taps = taps_at(texture, &walk, k, &far);
            add_level(&sum, texture, &far, &far_taps, far_weight);
        }
        const Mask has = vi_lt(vi_splat(k), footprint->probes);
        const Vi red_green = vi_select(has, (Vi)vu_pair_sum(sum.red_green), vi_splat(0));
        const Vi blue = vi_select(has, (Vi)vu_pair_sum(sum.blue), vi_splat(0));
        total.c[0] += (Vi)((Vu)red_green >> 16);
        total.c[1] += red_green & 0xffff;
        total.c[2] += blue;
        next_probe(&walk);
    }
    return total;
}

// --- alpha -------------------------------------------------------------------------------------

VEC_INLINE Vf bilinear_alpha(const DipTexture *texture, const Level *level, const Taps *taps) {
    const Vf fx = vf_from_int(taps->x8 & 255);
    const Vf fy = vf_from_int(taps->y8 & 255);
    const Vf gx = 256.0f - fx;
    const Vf gy = 256.0f - fy;
    const Vi upper = (Vi)vu_gather_bytes(texture->alpha, taps->index);
    const Vi lower = (Vi)vu_gather_bytes(texture->alpha, taps->index + level->stride);
    return (vf_from_int(upper & 255) * (gx * gy) + vf_from_int(upper >> 8 & 255) * (fx * gy)) +
           (vf_from_int(lower & 255) * (gx * fy) + vf_from_int(lower >> 8 & 255) * (fx * fy));
}

VEC_INLINE Vf filter_alpha(const DipSampler *sampler, const Footprint *footprint) {
    const DipTexture *texture = sampler->texture;
    const Level near = read_level(texture, footprint->level);
    const Level far = read_level(texture, footprint->next_level);
    const Vf far_weight = vf_from_int(footprint->fraction);
    const Vf near_weight = 256.0f - far_weight;
    Vf total = vf_splat(0.0f);
    Walk walk = begin_walk(texture, footprint);
    for (int k = 0; k < footprint->most_probes; k++) {
        const Taps near_taps = taps_at(texture, &walk, k, &near);
        const Taps far_taps = taps_at(texture, &walk, k, &far);
        const Vf mixed = bilinear_alpha(texture, &near, &near_taps) * near_weight +
                         bilinear_alpha(texture, &far, &far_taps) * far_weight;
        const Mask has = vi_lt(vi_splat(k), footprint->probes);
        total += vf_select(has, mixed, vf_splat(0.0f));
        next_probe(&walk);
    }
    return total;
}

// --- kernels -----------------------------------------------------------------------------------

void DIP_KERNEL(dip_kernel_sample_colour)(DipFragmentBatch *batch, const DipSampler *sampler,
                                          int u_slot, float (*out)[DIP_FRAGMENT_BATCH]) {
    // What white comes to, within 6: the squares of its codes less what eight rounded products
    // lose.
    static const float white[3] = {65464.0f, 65464.0f, 65400.0f};
    Footprint footprints[DIP_FRAGMENT_BATCH / DIP_LANES];
    find_footprints(batch, sampler, u_slot, footprints);
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        const Footprint *footprint = &footprints[i / DIP_LANES];
        const Colour sum = filter_colour(sampler, footprint);
        for (int c = 0; c < 3; c++) {
            const Vf mean = vf_from_int(sum.c[c]) * footprint->inverse_probes;
            vf_store(out[c] + i, mean * (1.0f / white[c]));
        }
    }
}

void DIP_KERNEL(dip_kernel_sample_alpha)(DipFragmentBatch *batch, const DipSampler *sampler,
                                         int u_slot, float *out) {
    if (!sampler->texture->alpha) {
        for (int i = 0; i < batch->count; i += DIP_LANES) {
            vf_store(out + i, vf_splat(1.0f));
        }
        return;
    }
    Footprint footprints[DIP_FRAGMENT_BATCH / DIP_LANES];
    find_footprints(batch, sampler, u_slot, footprints);
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        const Footprint *footprint = &footprints[i / DIP_LANES];
        // 255 * 65536 * 256 per probe, divided so that a constant alpha comes out exact.
        const Vf scale = vf_splat(4278190080.0f) * vf_from_int(footprint->probes);
        vf_store(out + i, filter_alpha(sampler, footprint) / scale);
    }
}
