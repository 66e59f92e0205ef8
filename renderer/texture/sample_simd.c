// Texture reads: probes and filtering, compiled once per instruction set. docs/picture.md defines
// them.
//
// Colours are filtered in 16-bit fixed point: a texel's codes are squared to linear light and
// weighted by 16-bit fractions, keeping the upper half of each product. Two texels beside each
// other are fetched at once and stay side by side ("pair order", simd/pairs.h) until their sum.
// Sums are whole numbers, so no order of lanes or probes matters.
#include "renderer/raster/kernels.h"
#include "renderer/simd/pairs.h"
#include "renderer/texture/footprint_simd.h"
#include "renderer/texture/texture.h"

enum { VECTORS = DIP_FRAGMENT_BATCH / DIP_LANES };

// A way to read a texture: constants of each inlined copy of the loops below.
typedef struct Way {
    bool anisotropic; // several probes
    bool in_bits;     // addresses are fractions of the texture in 32 bits, which wrap by themselves
} Way;

// The footprints of a batch, found before any texel is read: their long chains of dependent
// operations overlap, which they would not with the reads in between. Places are fractions in units
// of 2^-32, or the bits of floats where the way says so.
typedef struct Footprints {
    Vi lod8[VECTORS];
    Vu u[VECTORS]; // of the first probe
    Vu v[VECTORS];
    Vu step_u[VECTORS]; // the rest: anisotropic only
    Vu step_v[VECTORS];
    Vi probes[VECTORS];
    Vf inverse_probes[VECTORS];
} Footprints;

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

// The batch's work so far, a sum per lane: of probes, and of levels that they read.
typedef struct LaneWork {
    Vi probes;
    Vi levels;
} LaneWork;

// Adds the work of the lanes that are the batch's own.
VEC_INLINE void count_work(LaneWork *work, Vi probes, Vi lod8, int lanes) {
    const Vi own = vi_select(vi_lt(vi_iota(), vi_splat(lanes)), probes, vi_splat(0));
    const Mask blends = vi_lt(vi_splat(0), lod8 & 255);
    work->probes += own;
    work->levels += own + vi_select(blends, own, vi_splat(0));
}

// In short loops, for the same reason.
VEC_INLINE void find_footprints(DipFragmentBatch *batch, const DipSampler *sampler, Way way,
                                int slot, Footprints *out) {
    const int count = (batch->count + DIP_LANES - 1) / DIP_LANES;
    Axis axes[VECTORS];
    for (int n = 0; n < count; n++) {
        const Jacobian jacobian = read_jacobian(batch, sampler->texture, slot, n * DIP_LANES);
        if (way.anisotropic) {
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
    LaneWork work = {vi_splat(0), vi_splat(0)};
    for (int n = 0; n < count; n++) {
        Vf u = vf_load(batch->slot[slot] + n * DIP_LANES);
        Vf v = vf_load(batch->slot[slot + 1] + n * DIP_LANES);
        Vi probe_count = vi_splat(1);
        if (way.anisotropic) {
            const Probes probes = place_probes(sampler, &axes[n], cheap);
            u += probes.first_u;
            v += probes.first_v;
            out->step_u[n] = way.in_bits ? step32(probes.step_u) : (Vu)probes.step_u;
            out->step_v[n] = way.in_bits ? step32(probes.step_v) : (Vu)probes.step_v;
            out->probes[n] = probe_count = probes.count;
            out->inverse_probes[n] = probes.inverse_count;
        }
        out->u[n] = way.in_bits ? fraction32(u) : (Vu)u;
        out->v[n] = way.in_bits ? fraction32(v) : (Vu)v;
        count_work(&work, probe_count, out->lod8[n], batch->count - n * DIP_LANES);
    }
    batch->work.probes += (uint64_t)vi_sum(work.probes);
    batch->work.texels += (uint64_t)vi_sum(work.levels) * 4;
}

// --- addresses ---------------------------------------------------------------------------------

// Where a vector's probes are.
typedef struct Walk {
    Vu u, v;
    Vu step_u, step_v;
    int probe;
} Walk;

VEC_INLINE Walk begin_walk(const Footprints *footprints, Way way, int n) {
    Walk walk = {.u = footprints->u[n], .v = footprints->v[n]};
    if (way.anisotropic) {
        walk.step_u = footprints->step_u[n];
        walk.step_v = footprints->step_v[n];
    }
    return walk;
}

VEC_INLINE void next_probe(Walk *walk, Way way) {
    walk->probe++;
    if (way.in_bits) {
        walk->u += walk->step_u;
        walk->v += walk->step_v;
    }
}

// A level's table entries per lane.
typedef struct Level {
    Vi offset;
    Vi stride;
    Vi stride_pairs; // stride, in pair order
    Vi width;        // texels; in bits: their log2
    Vi height;
} Level;

// A bilinear read: the first texel's index and its place in 1/256 texel, the whole texels included.
typedef struct Taps {
    Vi index;
    Vi x8;
    Vi y8;
} Taps;

VEC_INLINE Level read_level(const DipTexture *texture, Way way, Vi level) {
    Level out;
    out.offset = vi_lookup16(texture->level_offset, level);
    if (way.in_bits) {
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

// The probe's read of a level.
VEC_INLINE Taps taps_at(const DipTexture *texture, Way way, const Walk *walk, const Level *level) {
    Taps taps;
    if (way.in_bits) {
        taps.x8 = address_in_bits(walk->u, level->width);
        taps.y8 = address_in_bits(walk->v, level->height);
        const Vi y = taps.y8 >> 8;
        taps.index = (level->offset + (taps.x8 >> 8)) + ((y << level->width) + y);
    } else {
        const float probe = (float)walk->probe;
        const Vf u = way.anisotropic ? (Vf)walk->u + (Vf)walk->step_u * probe : (Vf)walk->u;
        const Vf v = way.anisotropic ? (Vf)walk->v + (Vf)walk->step_v * probe : (Vf)walk->v;
        taps.x8 = address(u, texture->wrap_u, level->width);
        taps.y8 = address(v, texture->wrap_v, level->height);
        taps.index = (level->offset + (taps.x8 >> 8)) + (taps.y8 >> 8) * level->stride;
    }
    return taps;
}

// The levels that a footprint blends.
typedef struct Levels {
    Level near;
    Level far;
    Vi fraction; // of far, 1/256
} Levels;

VEC_INLINE Vi shown_level(const DipSampler *sampler, Vi level) {
    return sampler->shown ? vi_lookup16(sampler->shown_level, level) : level;
}

VEC_INLINE Levels read_levels(const DipSampler *sampler, const DipTexture *texture, Way way,
                              Vi lod8) {
    const Vi near = lod8 >> 8;
    const Vi far = vi_min(near + 1, vi_splat(sampler->texture->level_count - 1));
    const bool shown = texture != sampler->texture;
    return (Levels){read_level(texture, way, shown ? shown_level(sampler, near) : near),
                    read_level(texture, way, shown ? shown_level(sampler, far) : far), lod8 & 255};
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
    const Vu b = vu_dot16(texels & DIP_TEXEL_BLUE, DIP_TEXEL_BLUE_PLACES);
    *red_green += vu_mulhi16(vu_mulhi16(texels, texels), weight);
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

// A vector that is being read.
typedef struct Reader {
    Levels levels;
    Walk walk;
    Vi probes_left; // anisotropic only
    Colour total;
} Reader;

VEC_INLINE void begin_reader(Reader *reader, const DipSampler *sampler, const DipTexture *texture,
                             Way way, const Footprints *footprints, int n) {
    reader->levels = read_levels(sampler, texture, way, footprints->lod8[n]);
    reader->walk = begin_walk(footprints, way, n);
    if (way.anisotropic) {
        reader->probes_left = footprints->probes[n];
    }
    reader->total = (Colour){{vi_splat(0), vi_splat(0), vi_splat(0)}};
}

// Adds the next probe. Where the far level's fraction is 0 it adds nothing, so whether it is read
// for the sake of other lanes does not matter.
VEC_INLINE void read_probe(Reader *reader, const DipTexture *texture, Way way, bool blend) {
    const Levels *levels = &reader->levels;
    const VuPair far_weight = vu_pair_both(levels->fraction);
    const VuPair near_weight = {~far_weight.a, ~far_weight.b};
    PairSum sum = {{vu_splat(0), vu_splat(0)}, {vu_splat(0), vu_splat(0)}};
    const Taps near_taps = taps_at(texture, way, &reader->walk, &levels->near);
    add_level(&sum, texture, &levels->near, &near_taps, near_weight);
    if (blend) {
        const Taps far_taps = taps_at(texture, way, &reader->walk, &levels->far);
        add_level(&sum, texture, &levels->far, &far_taps, far_weight);
    }
    Vi red_green = (Vi)vu_pair_sum(sum.red_green);
    Vi blue = (Vi)vu_pair_sum(sum.blue);
    if (way.anisotropic) {
        const Mask has = vi_lt(vi_splat(0), reader->probes_left);
        red_green = vi_select(has, red_green, vi_splat(0));
        blue = vi_select(has, blue, vi_splat(0));
        reader->probes_left -= 1;
        next_probe(&reader->walk, way);
    }
    reader->total.c[0] += (Vi)((Vu)red_green >> 16);
    reader->total.c[1] += red_green & 0xffff;
    reader->total.c[2] += blue;
}

VEC_INLINE void store_light(float (*out)[DIP_FRAGMENT_BATCH], int n, const Colour *total,
                            Vf scale) {
    // What white comes to, within 6: the squares of its codes less what eight rounded products
    // lose.
    static const float white[3] = {65526.0f, 65526.0f, 65402.0f};
    for (int c = 0; c < 3; c++) {
        vf_store(out[c] + n * DIP_LANES, vf_from_int(total->c[c]) * (1.0f / white[c]) * scale);
    }
}

VEC_INLINE void read_vectors(const DipSampler *sampler, const DipTexture *texture, Way way,
                             const Footprints *footprints, int vectors,
                             float (*out)[DIP_FRAGMENT_BATCH]) {
    for (int n = 0; n < vectors; n++) {
        Reader reader;
        begin_reader(&reader, sampler, texture, way, footprints, n);
        const bool blend = mask_any(vi_lt(vi_splat(0), reader.levels.fraction));
        if (way.anisotropic) {
            for (int left = vi_greatest(reader.probes_left); left > 0; left--) {
                read_probe(&reader, texture, way, blend);
            }
            store_light(out, n, &reader.total, footprints->inverse_probes[n]);
        } else {
            read_probe(&reader, texture, way, blend);
            store_light(out, n, &reader.total, vf_splat(1.0f));
        }
    }
}

VEC_INLINE void sample_colour(DipFragmentBatch *batch, const DipSampler *sampler, Way way,
                              int u_slot, float (*out)[DIP_FRAGMENT_BATCH]) {
    const DipTexture *texture = sampler->shown ? sampler->shown : sampler->texture;
    const int vectors = (batch->count + DIP_LANES - 1) / DIP_LANES;
    Footprints footprints;
    find_footprints(batch, sampler, way, u_slot, &footprints);
    read_vectors(sampler, texture, way, &footprints, vectors, out);
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

// The sum over the probes of vector n, in units of 1 / (255 * 65536 * 256).
VEC_INLINE Vf filter_alpha(const DipSampler *sampler, Way way, const Footprints *footprints,
                           int n) {
    const DipTexture *texture = sampler->texture;
    const Levels levels = read_levels(sampler, texture, way, footprints->lod8[n]);
    const Vf far_weight = vf_from_int(levels.fraction);
    const Vf near_weight = 256.0f - far_weight;
    const Vi probes = way.anisotropic ? footprints->probes[n] : vi_splat(1);
    const int most_probes = way.anisotropic ? vi_greatest(probes) : 1;
    Vf total = vf_splat(0.0f);
    Walk walk = begin_walk(footprints, way, n);
    for (int k = 0; k < most_probes; k++) {
        const Taps near_taps = taps_at(texture, way, &walk, &levels.near);
        const Taps far_taps = taps_at(texture, way, &walk, &levels.far);
        const Vf mixed = bilinear_alpha(texture, &levels.near, &near_taps) * near_weight +
                         bilinear_alpha(texture, &levels.far, &far_taps) * far_weight;
        const Mask has = vi_lt(vi_splat(k), probes);
        total += vf_select(has, mixed, vf_splat(0.0f));
        next_probe(&walk, way);
    }
    return total;
}

VEC_INLINE void sample_alpha(DipFragmentBatch *batch, const DipSampler *sampler, Way way,
                             int u_slot, float *out) {
    Footprints footprints;
    find_footprints(batch, sampler, way, u_slot, &footprints);
    for (int i = 0, n = 0; i < batch->count; i += DIP_LANES, n++) {
        // Divided so that a constant alpha comes out exact.
        const Vf probes = way.anisotropic ? vf_from_int(footprints.probes[n]) : vf_splat(1.0f);
        vf_store(out + i, filter_alpha(sampler, way, &footprints, n) / (4278190080.0f * probes));
    }
}

// --- kernels -----------------------------------------------------------------------------------

// Calls sample(batch, sampler, way, ...) with a way of constants.
#define SAMPLE_BY_WAY(sample, in_bits, ...)                                                        \
    do {                                                                                           \
        if (sampler->max_anisotropy > 1 && (in_bits)) {                                            \
            sample(batch, sampler, (Way){true, true}, __VA_ARGS__);                                \
        } else if (sampler->max_anisotropy > 1) {                                                  \
            sample(batch, sampler, (Way){true, false}, __VA_ARGS__);                               \
        } else if (in_bits) {                                                                      \
            sample(batch, sampler, (Way){false, true}, __VA_ARGS__);                               \
        } else {                                                                                   \
            sample(batch, sampler, (Way){false, false}, __VA_ARGS__);                              \
        }                                                                                          \
    } while (false)

void DIP_KERNEL(dip_kernel_sample_colour)(DipFragmentBatch *batch, const DipSampler *sampler,
                                          int u_slot, float (*out)[DIP_FRAGMENT_BATCH]) {
    const DipTexture *texture = sampler->shown ? sampler->shown : sampler->texture;
    SAMPLE_BY_WAY(sample_colour, texture->wraps_in_bits, u_slot, out);
}

void DIP_KERNEL(dip_kernel_sample_alpha)(DipFragmentBatch *batch, const DipSampler *sampler,
                                         int u_slot, float *out) {
    if (!sampler->texture->alpha) {
        for (int i = 0; i < batch->count; i += DIP_LANES) {
            vf_store(out + i, vf_splat(1.0f));
        }
        return;
    }
    SAMPLE_BY_WAY(sample_alpha, sampler->texture->wraps_in_bits, u_slot, out);
}
