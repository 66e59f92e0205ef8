// Footprints: the areas of a texture that fragments cover. This file finds a footprint's level of
// detail and its probes (the bilinear reads along its long axis) for read_list_simd.h.
// docs/picture.md (Textures) has the definitions.
#ifndef DIP_RENDERER_PIPELINE_TEXTURE_FOOTPRINT_SIMD_H
#define DIP_RENDERER_PIPELINE_TEXTURE_FOOTPRINT_SIMD_H

#include "renderer/pipeline/shader.h"
#include "renderer/pipeline/texture/texture_layout.h"
#include "renderer/simd/powers.h"
#include "renderer/simd/vec.h"

// Bounds of derivatives and lengths, in texels per pixel. MAX_DERIVATIVE exceeds the size of every
// texture, and its fourth power is finite. The square of MIN_LENGTH is a normal number.
#define MAX_DERIVATIVE 1e9f
#define MIN_LENGTH     1e-18f

// The Jacobian of the texture coordinates, in texels of level 0 per pixel.
typedef struct Jacobian {
    Vf ux, vx; // dX: change along the screen's x
    Vf uy, vy; // dY: change along the screen's y
} Jacobian;

// Clamps to +-MAX_DERIVATIVE. NaN becomes MAX_DERIVATIVE, which selects the smallest mip level.
VEC_INLINE Vf bounded(Vf v) {
    return vf_max(vf_min(v, vf_splat(MAX_DERIVATIVE)), vf_splat(-MAX_DERIVATIVE));
}

VEC_INLINE Jacobian read_jacobian(const DipFragmentBatch *batch, const DipTexture *texture,
                                  int varying, int i) {
    const float width = (float)texture->width;
    const float height = (float)texture->height;
    return (Jacobian){vf_load(batch->varying_dx[varying] + i) * width,
                      vf_load(batch->varying_dx[varying + 1] + i) * height,
                      vf_load(batch->varying_dy[varying] + i) * width,
                      vf_load(batch->varying_dy[varying + 1] + i) * height};
}

VEC_INLINE Jacobian bounded_jacobian(Jacobian j) {
    return (Jacobian){bounded(j.ux), bounded(j.vx), bounded(j.uy), bounded(j.vy)};
}

// A footprint's major axis (u, v) in texels, the squared length of the major axis (length2), and
// the squared length of the minor axis (minor2). minor2 is at least length2 / max_anisotropy^2.
// Trilinear reads use only minor2.
typedef struct Axis {
    Vf u, v;
    Vf length2;
    Vf minor2;
} Axis;

// Plain anisotropic filtering (AF). It measures the footprint along the screen's axes and along
// axes turned by 45 degrees, and uses the pair of axes with the greater ratio of lengths. For the
// turned axes, the ratio is capped at half of max_anisotropy. A long footprint along a diagonal of
// the screen may therefore get a coarser level of detail than the same footprint along the screen's
// x or y. The turned derivatives are (dX + dY) / sqrt 2 and (dY - dX) / sqrt 2. Their squared
// lengths are (|dX|^2 + |dY|^2) / 2 plus and minus the dot product of dX and dY. Squared ratios are
// compared by cross multiplication, without division.
VEC_INLINE Axis two_frame_axis(Jacobian j, int max_anisotropy) {
    const float max = (float)max_anisotropy;
    const float half = max_anisotropy > 2 ? 0.5f * max : 1.0f;
    const Vf x2 = j.ux * j.ux + j.vx * j.vx;
    const Vf y2 = j.uy * j.uy + j.vy * j.vy;
    const Vf dot = j.ux * j.uy + j.vx * j.vy;
    const Vf mean = (x2 + y2) * 0.5f;
    const Vf screen_long = vf_max(x2, y2);
    const Vf screen_short = vf_min(x2, y2);
    const Vf turned_long = mean + vf_abs(dot);
    const Vf turned_short =
        vf_max(vf_max(mean - vf_abs(dot), vf_splat(0.0f)), turned_long * (1.0f / (half * half)));
    const Mask turn = vf_lt(screen_long * turned_short, turned_long * screen_short);
    const Mask y_longer = vf_lt(x2, y2);
    const Mask opposed = vf_lt(dot, vf_splat(0.0f));
    const float c = 0.70710678f;
    const Vf turned_u = (j.uy + vf_select(opposed, -j.ux, j.ux)) * c;
    const Vf turned_v = (j.vy + vf_select(opposed, -j.vx, j.vx)) * c;
    const Vf long2 = vf_select(turn, turned_long, screen_long);
    const Vf short2 = vf_select(turn, turned_short, screen_short);
    return (Axis){vf_select(turn, turned_u, vf_select(y_longer, j.uy, j.ux)),
                  vf_select(turn, turned_v, vf_select(y_longer, j.vy, j.vx)), long2,
                  vf_max(short2, long2 * (1.0f / (max * max)))};
}

// Advanced AF. The lengths M >= m of the exact ellipse's axes are the singular values of the
// Jacobian J. The closed form M = |(e, h)| + |(f, g)|, m = |det J| / M has no cancellation. The
// major axis points along the larger column of J J^T - m^2 I.
VEC_INLINE Axis ellipse_axis(Jacobian j, int max_anisotropy) {
    const Vf e = (j.ux + j.vy) * 0.5f;
    const Vf f = (j.ux - j.vy) * 0.5f;
    const Vf g = (j.vx + j.uy) * 0.5f;
    const Vf h = (j.vx - j.uy) * 0.5f;
    const Vf eh2 = e * e + h * h;
    const Vf fg2 = f * f + g * g;
    const Vf length2 =
        vf_max((eh2 + fg2) + 2.0f * vf_sqrt(eh2 * fg2), vf_splat(MIN_LENGTH * MIN_LENGTH));
    const Vf determinant = j.ux * j.vy - j.uy * j.vx;
    const Vf minor2 = determinant * determinant / length2;
    const Vf across = j.ux * j.vx + j.uy * j.vy;
    const Vf along_u = (j.ux * j.ux + j.uy * j.uy) - minor2;
    const Vf along_v = (j.vx * j.vx + j.vy * j.vy) - minor2;
    const Mask by_v = vf_lt(along_u, along_v);
    const Vf u = vf_select(by_v, across, along_u);
    const Vf v = vf_select(by_v, along_v, across);
    const Vf norm2 = vf_max(u * u + v * v, vf_splat(MIN_LENGTH * MIN_LENGTH));
    const Vf scale = vf_sqrt(length2 / norm2);
    const float max = (float)max_anisotropy;
    return (Axis){u * scale, v * scale, length2,
                  vf_max(vf_min(minor2, length2), length2 * (1.0f / (max * max)))};
}

// Returns ceil(ratio - 1e-4) for ratios of 1..16.
VEC_INLINE Vi probe_count(Vf ratio) {
    const Vf at = ratio - 1e-4f;
    const Vi whole = vi_from_float(at);
    return whole + vi_select(vf_lt(vf_from_int(whole), at), vi_splat(1), vi_splat(0));
}

// Returns 1 / probes for 1..16 probes.
VEC_INLINE Vf inverse_of(Vi probes) {
    static const float inverses[16] = {
        1.0f / 16, 1.0f,     1.0f / 2,  1.0f / 3,  1.0f / 4,  1.0f / 5,  1.0f / 6,  1.0f / 7,
        1.0f / 8,  1.0f / 9, 1.0f / 10, 1.0f / 11, 1.0f / 12, 1.0f / 13, 1.0f / 14, 1.0f / 15};
    return vf_lookup16(inverses, probes & 15);
}

// Returns the squared length of the longer derivative. Trilinear reads compute their level of
// detail from it.
VEC_INLINE Vf isotropic_minor2(Jacobian j) {
    // A length that is not finite becomes the bound, which selects the smallest mip level.
    const Vf most = vf_splat(MAX_DERIVATIVE * MAX_DERIVATIVE);
    const Vf dx2 = vf_min(j.ux * j.ux + j.vx * j.vx, most);
    const Vf dy2 = vf_min(j.uy * j.uy + j.vy * j.vy, most);
    return vf_max(dx2, dy2);
}

VEC_INLINE Axis anisotropic_axis(const DipSampler *sampler, Jacobian j) {
    const Jacobian bounds = bounded_jacobian(j);
    return sampler->exact_footprint ? ellipse_axis(bounds, sampler->max_anisotropy)
                                    : two_frame_axis(bounds, sampler->max_anisotropy);
}

// Narrows the blend between two levels to the middle quarter of the way from one level to the next.
// Before this quarter, only the finer level is read; after it, only the coarser level.
VEC_INLINE Vi narrow_blend(Vi lod8) {
    const Vi fraction = ((lod8 & 255) - 96) * 4;
    return (lod8 & ~255) + vi_min(vi_max(fraction, vi_splat(0)), vi_splat(256));
}

// Returns the level of detail in 1/256 level: log2 of the minor axis's length, rounded, biased and
// clamped. minor2 is the square of this length.
VEC_INLINE Vi find_level(const DipSampler *sampler, Vf minor2) {
    const Vf lambda = log2_of(vf_max(minor2, vf_splat(MIN_LENGTH * MIN_LENGTH))) * 0.5f;
    const Vi lod8 = vi_from_float(vf_floor(lambda * 256.0f + 0.5f)) + sampler->bias_lod8;
    const int32_t last = (sampler->texture->level_count - 1) * 256;
    return vi_min(vi_max(lod8, vi_splat(sampler->min_lod8)), vi_splat(last));
}

// Returns the number of probes of an anisotropic footprint in the finer of its two levels. The
// distance between probes is never less than a texel of the finest level that may be read, since
// more probes would read the same texels again.
// halve: 1 for half of this number, rounded up; 0 for the number itself.
VEC_INLINE Vi count_probes(const DipSampler *sampler, const Axis *axis, int halve) {
    const int last = sampler->texture->level_count - 1;
    const int min = sampler->min_lod8 >> 8 < last ? sampler->min_lod8 >> 8 : last;
    const float finest = 1.0f / (float)(1 << min);
    const Vf texels2 = axis->length2 * (finest * finest);
    const Vf ratio2 = axis->length2 / vf_max(axis->minor2, vf_splat(MIN_LENGTH * MIN_LENGTH));
    const Vi full = probe_count(vf_sqrt(vf_max(vf_min(ratio2, texels2), vf_splat(1.0f))));
    return (full + halve) >> halve;
}

// Returns the number of probes in the coarser level if the finer level has near_count probes.
// Texels of the coarser level are twice as large, so half of near_count is enough while the coarser
// level's weight is small. As this weight grows, the number rises to near_count. fraction: the
// coarser level's weight in 1/256.
VEC_INLINE Vi count_far_probes(Vi near_count, Vi fraction) {
    return (near_count * vi_max(fraction, vi_splat(128)) + 255) >> 8;
}

// Half of the step between neighbouring probes, in texture coordinates. The N probes have equal
// weight. The offset of probe k from the footprint's middle is ((k + 1/2) / N - 1/2) times the
// major axis. The first probe (k = 0) is therefore N - 1 half steps before the middle.
typedef struct HalfStep {
    Vf u, v;
} HalfStep;

VEC_INLINE HalfStep half_step(const DipTexture *texture, const Axis *axis, Vf inverse_count) {
    return (HalfStep){axis->u * (0.5f / (float)texture->width) * inverse_count,
                      axis->v * (0.5f / (float)texture->height) * inverse_count};
}

#endif
