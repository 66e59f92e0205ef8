// Texture reads: level of detail, footprint, probes and filtering, compiled once per instruction
// set. docs/picture.md defines them; FIELD names follow the OpenGL and Direct3D specifications.
#include "renderer/raster/kernels.h"
#include "renderer/simd/vec.h"
#include "renderer/texture/texture.h"

#define MAX_DERIVATIVE 1e15f  // its square is finite
#define MIN_LENGTH     1e-18f // texels; its square is a normal number

// What a vector of fragments reads: probes along a line, all at one level of detail.
typedef struct Footprint {
    Vf u, v;           // middle of the line, texture coordinates
    Vf line_u, line_v; // its whole length
    Vi probes;         // per lane, at least 1
    int most_probes;   // of all lanes
    Vf inverse_probes;
    Vi level;
    Vi next_level;
    Vi fraction; // of next_level, 0..255
} Footprint;

// The Jacobian in texels of level 0 per pixel.
typedef struct Jacobian {
    Vf ux, vx; // dX
    Vf uy, vy; // dY
} Jacobian;

// log2 of positive normal numbers: exact at powers of two and monotone; error below 1e-5. On
// [1, 2), log2(1 + t) = t (1 + (1 - t) r(t)), r interpolated at Chebyshev points.
VEC_INLINE Vf log2_of(Vf x) {
    const Vi bits = vi_bits(x);
    const Vf exponent = vf_from_int((bits >> 23) - 127);
    const Vf t = vf_bits((bits & 0x7fffff) | 0x3f800000) - 1.0f;
    const Vf r = (((0.0256912634f * t - 0.0972018316f) * t + 0.184100822f) * t - 0.276569515f) * t +
                 0.442654073f;
    return exponent + t * (1.0f + (1.0f - t) * r);
}

// Bounded to +-MAX_DERIVATIVE; NaN becomes the bound, so that it leads to the smallest level.
VEC_INLINE Vf bounded(Vf v) {
    return vf_max(vf_min(v, vf_splat(MAX_DERIVATIVE)), vf_splat(-MAX_DERIVATIVE));
}

VEC_INLINE Jacobian read_jacobian(const DipFragmentBatch *batch, const DipTexture *texture,
                                  int slot, int i) {
    const float width = (float)texture->width;
    const float height = (float)texture->height;
    return (Jacobian){bounded(vf_load(batch->slot_dx[slot] + i) * width),
                      bounded(vf_load(batch->slot_dx[slot + 1] + i) * height),
                      bounded(vf_load(batch->slot_dy[slot] + i) * width),
                      bounded(vf_load(batch->slot_dy[slot + 1] + i) * height)};
}

// The major axis of a footprint, texels, and how many times longer than the minor it counts.
typedef struct Axis {
    Vf u, v;
    Vf length;
    Vf ratio;
} Axis;

// The longer of two derivatives (the first on a tie), with the ratio of their lengths.
VEC_INLINE Axis longer_of(Vf au, Vf av, Vf bu, Vf bv, float max_ratio) {
    const Vf a2 = au * au + av * av;
    const Vf b2 = bu * bu + bv * bv;
    const Mask second = vf_lt(a2, b2);
    const Vf long2 = vf_select(second, b2, a2);
    const Vf short2 = vf_max(vf_select(second, a2, b2), vf_splat(MIN_LENGTH * MIN_LENGTH));
    const Vf ratio = vf_sqrt(long2 / short2);
    return (Axis){vf_select(second, bu, au), vf_select(second, bv, av), vf_sqrt(long2),
                  vf_max(vf_min(ratio, vf_splat(max_ratio)), vf_splat(1.0f))};
}

// Plain AF: the better of the screen's frame and one turned by 45 degrees, the latter capped at
// half; hence a level of detail that depends on the angle.
VEC_INLINE Axis two_frame_axis(Jacobian j, int max_anisotropy) {
    const float max = (float)max_anisotropy;
    const float half = max_anisotropy > 2 ? 0.5f * max : 1.0f;
    const float c = 0.70710678f;
    const Axis screen = longer_of(j.ux, j.vx, j.uy, j.vy, max);
    const Axis turned =
        longer_of((j.ux + j.uy) * c, (j.vx + j.vy) * c, (j.uy - j.ux) * c, (j.vy - j.vx) * c, half);
    const Mask use = vf_lt(screen.ratio, turned.ratio);
    return (Axis){vf_select(use, turned.u, screen.u), vf_select(use, turned.v, screen.v),
                  vf_select(use, turned.length, screen.length),
                  vf_select(use, turned.ratio, screen.ratio)};
}

// Advanced AF: the ellipse's axes by the closed-form singular values of the Jacobian, which do
// not cancel; the major direction is the larger column of J J^T - m^2 I.
VEC_INLINE Axis ellipse_axis(Jacobian j, int max_anisotropy) {
    const Vf e = (j.ux + j.vy) * 0.5f;
    const Vf f = (j.ux - j.vy) * 0.5f;
    const Vf g = (j.vx + j.uy) * 0.5f;
    const Vf h = (j.vx - j.uy) * 0.5f;
    const Vf major = vf_sqrt(e * e + h * h) + vf_sqrt(f * f + g * g);
    const Vf longer = vf_max(major, vf_splat(MIN_LENGTH));
    const Vf minor = vf_abs(j.ux * j.vy - j.uy * j.vx) / longer;
    const Vf ratio = longer / vf_max(minor, vf_splat(MIN_LENGTH));
    // Scaled to M = 1, so that no square overflows.
    const Vf unit = vf_splat(1.0f) / longer;
    const Jacobian k = {j.ux * unit, j.vx * unit, j.uy * unit, j.vy * unit};
    const Vf minor2 = (minor * unit) * (minor * unit);
    const Vf across = k.ux * k.vx + k.uy * k.vy;
    const Vf along_u = (k.ux * k.ux + k.uy * k.uy) - minor2;
    const Vf along_v = (k.vx * k.vx + k.vy * k.vy) - minor2;
    const Mask by_v = vf_lt(along_u, along_v);
    const Vf u = vf_select(by_v, across, along_u);
    const Vf v = vf_select(by_v, along_v, across);
    const Vf norm = vf_sqrt(vf_max(u * u + v * v, vf_splat(1e-30f)));
    const Vf scale = longer / norm;
    return (Axis){u * scale, v * scale, longer,
                  vf_max(vf_min(ratio, vf_splat((float)max_anisotropy)), vf_splat(1.0f))};
}

// ceil(ratio - 1e-4) for ratios of 1..16.
VEC_INLINE Vi probe_count(Vf ratio) {
    const Vf at = ratio - 1e-4f;
    const Vi whole = vi_from_float(at);
    return whole + vi_select(vf_lt(vf_from_int(whole), at), vi_splat(1), vi_splat(0));
}

// lambda, given as log2(rho), rounded to 1/256, biased, clamped.
VEC_INLINE void set_level(Footprint *footprint, const DipSampler *sampler, Vf lambda) {
    const Vi lod8 = vi_from_float(vf_floor(lambda * 256.0f + 0.5f)) + sampler->bias_lod8;
    const int32_t last = (sampler->texture->level_count - 1) * 256;
    const int32_t min = sampler->min_lod8 < last ? sampler->min_lod8 : last;
    const Vi clamped = vi_min(vi_max(lod8, vi_splat(min)), vi_splat(last));
    footprint->level = clamped >> 8;
    footprint->fraction = clamped & 255;
    footprint->next_level = vi_min(footprint->level + 1, vi_splat(last >> 8));
}

// Trilinear: one probe, and lambda = log2 of the longer derivative, from its square.
VEC_INLINE void set_isotropic(Footprint *footprint, const DipSampler *sampler, Jacobian j) {
    const Vf dx2 = j.ux * j.ux + j.vx * j.vx;
    const Vf dy2 = j.uy * j.uy + j.vy * j.vy;
    const Vf rho2 = vf_max(vf_max(dx2, dy2), vf_splat(MIN_LENGTH * MIN_LENGTH));
    set_level(footprint, sampler, log2_of(rho2) * 0.5f);
    footprint->line_u = footprint->line_v = vf_splat(0.0f);
    footprint->probes = vi_splat(1);
    footprint->inverse_probes = vf_splat(1.0f);
    footprint->most_probes = 1;
}

VEC_INLINE void set_anisotropic(Footprint *footprint, const DipSampler *sampler, Jacobian j) {
    const Axis axis = sampler->advanced ? ellipse_axis(j, sampler->max_anisotropy)
                                        : two_frame_axis(j, sampler->max_anisotropy);
    set_level(footprint, sampler, log2_of(vf_max(axis.length, vf_splat(MIN_LENGTH)) / axis.ratio));
    footprint->line_u = axis.u * (1.0f / (float)sampler->texture->width);
    footprint->line_v = axis.v * (1.0f / (float)sampler->texture->height);
    footprint->probes = probe_count(axis.ratio);
    footprint->inverse_probes = vf_splat(1.0f) / vf_from_int(footprint->probes);
    footprint->most_probes = vi_greatest(footprint->probes);
}

VEC_INLINE Footprint footprint_at(const DipFragmentBatch *batch, const DipSampler *sampler,
                                  int slot, int i) {
    const Jacobian jacobian = read_jacobian(batch, sampler->texture, slot, i);
    Footprint footprint;
    footprint.u = vf_load(batch->slot[slot] + i);
    footprint.v = vf_load(batch->slot[slot + 1] + i);
    if (sampler->max_anisotropy == 1) {
        set_isotropic(&footprint, sampler, jacobian);
    } else {
        set_anisotropic(&footprint, sampler, jacobian);
    }
    return footprint;
}

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

// A level's table entries per lane.
typedef struct Level {
    Vi offset;
    Vi stride;
    Vf width256; // size * 256
    Vf height256;
    Vi width;
    Vi height;
} Level;

VEC_INLINE Level read_level(const DipTexture *texture, Vi level) {
    Level out;
    out.offset = vi_lookup16(texture->level_offset, level);
    out.width = vi_lookup16(texture->level_width, level);
    out.height = vi_lookup16(texture->level_height, level);
    out.stride = out.width + 1;
    out.width256 = vf_from_int(out.width << 8);
    out.height256 = vf_from_int(out.height << 8);
    return out;
}

// A coordinate within the texture, 0..1: the fraction (repeat) or clamped. Infinities and NaN
// become 0 or 1, so that no address leaves the texture.
VEC_INLINE Vf wrap_unit(Vf coordinate, DipWrap wrap) {
    const Vf unit = wrap == DIP_WRAP_REPEAT ? coordinate - vf_floor(coordinate) : coordinate;
    return vf_min(vf_max(unit, vf_splat(0.0f)), vf_splat(1.0f));
}

// A coordinate within 0..1 to 1/256 texel of a level, texel centres at whole numbers. Before the
// first centre comes the last texel (repeat) or the first itself (clamp).
VEC_INLINE Vi address(Vf unit, DipWrap wrap, Vf size256, Vi size) {
    const Vi at = vi_from_float(unit * size256) - 128;
    const Vi before = at >> 31; // all ones where negative
    return wrap == DIP_WRAP_REPEAT ? at + (before & (size << 8)) : at & ~before;
}

// A bilinear read: the first texel's index and the weights of the four, which sum to 65536.
typedef struct Taps {
    Vi index;
    Vi stride;
    Vf weight[4];
} Taps;

// u, v: within 0..1.
VEC_INLINE Taps taps_at(const DipTexture *texture, const Level *level, Vf u, Vf v) {
    const Vi x = address(u, texture->wrap_u, level->width256, level->width);
    const Vi y = address(v, texture->wrap_v, level->height256, level->height);
    const Vf fx = vf_from_int(x & 255);
    const Vf fy = vf_from_int(y & 255);
    const Vf gx = 256.0f - fx;
    const Vf gy = 256.0f - fy;
    return (Taps){level->offset + (y >> 8) * level->stride + (x >> 8),
                  level->stride,
                  {gx * gy, fx * gy, gx * fy, fx * fy}};
}

typedef struct Colour {
    Vf c[3];
} Colour;

// Adds weight * (texel's square roots squared): linear light in units of the squared maxima.
VEC_INLINE void add_texel(Colour *sum, Vu texel, Vf weight) {
    const Vf red = vf_from_int((Vi)(texel >> DIP_TEXEL_RED_SHIFT));
    const Vf green = vf_from_int((Vi)(texel >> DIP_TEXEL_GREEN_SHIFT) & DIP_TEXEL_GREEN_MAX);
    const Vf blue = vf_from_int((Vi)texel & DIP_TEXEL_BLUE_MAX);
    sum->c[0] += (red * red) * weight;
    sum->c[1] += (green * green) * weight;
    sum->c[2] += (blue * blue) * weight;
}

VEC_INLINE Colour bilinear_colour(const DipTexture *texture, const Level *level, Vf u, Vf v) {
    const Taps taps = taps_at(texture, level, u, v);
    Colour sum = {{vf_splat(0.0f), vf_splat(0.0f), vf_splat(0.0f)}};
    Vu texel[4];
    vu_gather_pairs(texture->texels, taps.index, &texel[0], &texel[1]);
    vu_gather_pairs(texture->texels, taps.index + taps.stride, &texel[2], &texel[3]);
    for (int i = 0; i < 4; i++) {
        add_texel(&sum, texel[i], taps.weight[i]);
    }
    return sum;
}

VEC_INLINE Vf bilinear_alpha(const DipTexture *texture, const Level *level, Vf u, Vf v) {
    const Taps taps = taps_at(texture, level, u, v);
    const Vi upper = (Vi)vu_gather_bytes(texture->alpha, taps.index);
    const Vi lower = (Vi)vu_gather_bytes(texture->alpha, taps.index + taps.stride);
    return (vf_from_int(upper & 255) * taps.weight[0] +
            vf_from_int(upper >> 8 & 255) * taps.weight[1]) +
           (vf_from_int(lower & 255) * taps.weight[2] +
            vf_from_int(lower >> 8 & 255) * taps.weight[3]);
}

// Where probe k of a lane's own count lies on the line: (k + 1/2) / N - 1/2.
VEC_INLINE Vf probe_place(const Footprint *footprint, int k) {
    return ((float)k + 0.5f) * footprint->inverse_probes - 0.5f;
}

VEC_INLINE Vi shown_level(const DipSampler *sampler, Vi level) {
    return sampler->shown ? vi_lookup16(sampler->shown_level, level) : level;
}

VEC_INLINE Colour filter_colour(const DipSampler *sampler, const Footprint *footprint) {
    const DipTexture *texture = sampler->shown ? sampler->shown : sampler->texture;
    const Level near = read_level(texture, shown_level(sampler, footprint->level));
    const Level far = read_level(texture, shown_level(sampler, footprint->next_level));
    const bool blend = mask_any(vi_lt(vi_splat(0), footprint->fraction));
    const Vf far_weight = vf_from_int(footprint->fraction);
    const Vf near_weight = 256.0f - far_weight;
    Colour total = {{vf_splat(0.0f), vf_splat(0.0f), vf_splat(0.0f)}};
    for (int k = 0; k < footprint->most_probes; k++) {
        const Vf place = probe_place(footprint, k);
        const Vf u = wrap_unit(footprint->u + footprint->line_u * place, texture->wrap_u);
        const Vf v = wrap_unit(footprint->v + footprint->line_v * place, texture->wrap_v);
        const Mask has = vi_lt(vi_splat(k), footprint->probes);
        const Colour a = bilinear_colour(texture, &near, u, v);
        Colour b = {{vf_splat(0.0f), vf_splat(0.0f), vf_splat(0.0f)}};
        if (blend) {
            b = bilinear_colour(texture, &far, u, v);
        }
        for (int c = 0; c < 3; c++) {
            const Vf mixed = a.c[c] * near_weight + b.c[c] * far_weight;
            total.c[c] += vf_select(has, mixed, vf_splat(0.0f));
        }
    }
    return total;
}

VEC_INLINE Vf filter_alpha(const DipSampler *sampler, const Footprint *footprint) {
    const DipTexture *texture = sampler->texture;
    const Level near = read_level(texture, footprint->level);
    const Level far = read_level(texture, footprint->next_level);
    const Vf far_weight = vf_from_int(footprint->fraction);
    const Vf near_weight = 256.0f - far_weight;
    Vf total = vf_splat(0.0f);
    for (int k = 0; k < footprint->most_probes; k++) {
        const Vf place = probe_place(footprint, k);
        const Vf u = wrap_unit(footprint->u + footprint->line_u * place, texture->wrap_u);
        const Vf v = wrap_unit(footprint->v + footprint->line_v * place, texture->wrap_v);
        const Vf mixed = bilinear_alpha(texture, &near, u, v) * near_weight +
                         bilinear_alpha(texture, &far, u, v) * far_weight;
        const Mask has = vi_lt(vi_splat(k), footprint->probes);
        total += vf_select(has, mixed, vf_splat(0.0f));
    }
    return total;
}

void DIP_KERNEL(dip_kernel_sample_colour)(DipFragmentBatch *batch, const DipSampler *sampler,
                                          int u_slot, float (*out)[DIP_FRAGMENT_BATCH]) {
    // Sums are in units of the texel maxima squared, times 65536 (bilinear) times 256 (trilinear).
    static const float unit[3] = {
        1.0f / ((float)(DIP_TEXEL_RED_MAX * DIP_TEXEL_RED_MAX) * 16777216.0f),
        1.0f / ((float)(DIP_TEXEL_GREEN_MAX * DIP_TEXEL_GREEN_MAX) * 16777216.0f),
        1.0f / ((float)(DIP_TEXEL_BLUE_MAX * DIP_TEXEL_BLUE_MAX) * 16777216.0f),
    };
    Footprint footprints[DIP_FRAGMENT_BATCH / DIP_LANES];
    find_footprints(batch, sampler, u_slot, footprints);
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        const Footprint *footprint = &footprints[i / DIP_LANES];
        const Colour sum = filter_colour(sampler, footprint);
        for (int c = 0; c < 3; c++) {
            vf_store(out[c] + i, (sum.c[c] * unit[c]) * footprint->inverse_probes);
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
