// The lobes of light that metallic-roughness surfaces reflect: their widths, the tables that they
// read, and what a light gives to them. docs/picture.md, Metal and gloss, defines the formulas.
#ifndef DIP_RENDERER_SCENE_MATERIALS_PBR_LOBE_SIMD_H
#define DIP_RENDERER_SCENE_MATERIALS_PBR_LOBE_SIMD_H

#include "renderer/scene/materials/pbr.h"
#include "renderer/scene/materials/surface_simd.h"

// Least width (GGX alpha) of the highlights of lights.
#define LEAST_ALPHA 0.1f

// A position between two entries of a table: the first of them, and the share of the second.
typedef struct Entry {
    Vi index;
    Vf share;
} Entry;

// How wide a lobe is. All of it follows from the roughness.
typedef struct Width {
    Vf roughness;
    Vf alpha2;    // squared width for lights
    Vf lean;      // how far the direction in which the lobe sees the surroundings leans from the
                  // normal (0) towards the mirrored direction (1)
    Vf blur;      // share of the surroundings' difference in height that blurring leaves
    Entry row;    // in the table of lobes
    int only_row; // row.index if it is the same in all lanes, else DIP_ABSENT
} Width;

// One lobe of reflected light. The surface has one, and its clear coat has another.
typedef struct Lobe {
    Vf3 normal; // unit
    Vf facing;  // n.v
    Vf n_v;     // n.v, 0..1
    Width width;
    Vf a, b;    // shares of f0 and f90 that uniform light gives
    Vf grazing; // mean of (1 - v.h)^5 over diffuse light
} Lobe;

// --- tables --------------------------------------------------------------------------------------

VEC_INLINE Entry find_entry(Vf value) {
    const float last = (float)(DIP_PBR_TABLE - 1);
    const Vf at =
        vf_min(vf_max(value * (float)DIP_PBR_TABLE - 0.5f, vf_splat(0.0f)), vf_splat(last));
    const Vi index = vi_min(vi_from_float(at), vi_splat(DIP_PBR_TABLE - 2));
    return (Entry){index, at - vf_from_int(index)};
}

VEC_INLINE Vf low_half(Vi pair) {
    return vf_from_int(pair & 0xffff);
}

VEC_INLINE Vf high_half(Vi pair) {
    return vf_from_int((Vi)((Vu)pair >> 16));
}

VEC_INLINE Vf mix(Vf a, Vf b, Vf share) {
    return a + (b - a) * share;
}

// The entries of the table of lobes around a roughness (near, far) and an angle (v after it).
typedef struct LobeEntries {
    Vi near, near_v;
    Vi far, far_v;
} LobeEntries;

VEC_INLINE LobeEntries find_lobe(const DipPbrTables *tables, const Width *width, Vi v) {
    if (width->only_row != DIP_ABSENT) {
        const int32_t *near = tables->lobe + width->only_row * DIP_PBR_TABLE;
        const int32_t *far = near + DIP_PBR_TABLE;
        return (LobeEntries){vi_lookup32(near, v), vi_lookup32(near, v + 1), vi_lookup32(far, v),
                             vi_lookup32(far, v + 1)};
    }
    const Vi first = width->row.index * DIP_PBR_TABLE + v;
    const Vi second = first + DIP_PBR_TABLE;
    return (LobeEntries){vi_gather(tables->lobe, first), vi_gather(tables->lobe, first + 1),
                         vi_gather(tables->lobe, second), vi_gather(tables->lobe, second + 1)};
}

// Reads the tables for a lobe of known width and angle.
VEC_INLINE void read_tables(const DipPbrTables *tables, Lobe *lobe) {
    const float unit = 1.0f / 65535.0f;
    const Vf share = lobe->width.row.share;
    const Entry v = find_entry(lobe->n_v);
    const LobeEntries at = find_lobe(tables, &lobe->width, v.index);
    lobe->a = unit * mix(mix(low_half(at.near), low_half(at.near_v), v.share),
                         mix(low_half(at.far), low_half(at.far_v), v.share), share);
    lobe->b = unit * mix(mix(high_half(at.near), high_half(at.near_v), v.share),
                         mix(high_half(at.far), high_half(at.far_v), v.share), share);
    const Vi grazing = vi_lookup32(tables->grazing, v.index);
    lobe->grazing = unit * mix(low_half(grazing), high_half(grazing), v.share);
}

// --- lobes ---------------------------------------------------------------------------------------

VEC_INLINE Width width_of(Vf roughness) {
    const Vf alpha = roughness * roughness;
    const Vf least = vf_max(alpha, vf_splat(LEAST_ALPHA));
    const Vf smooth = 1.0f - alpha;
    const Vf blur = ((alpha * 0.0316f + 0.2566f) * alpha - 0.6222f) * alpha + 1.0083f;
    return (Width){.roughness = roughness,
                   .alpha2 = least * least,
                   .lean = smooth * (vf_sqrt(smooth) + alpha),
                   .blur = vf_min(blur, vf_splat(1.0f)),
                   .row = find_entry(roughness),
                   .only_row = DIP_ABSENT};
}

// Returns the width for a roughness that is the same in all lanes.
VEC_INLINE Width width_of_all(float roughness) {
    Width width = width_of(vf_splat(roughness));
    int32_t rows[DIP_LANES];
    vi_store(rows, width.row.index);
    width.only_row = rows[0];
    return width;
}

VEC_INLINE Lobe make_lobe(const DipPbrTables *tables, Vf3 normal, Vf3 to_eye, const Width *width) {
    Lobe lobe = {.normal = normal, .facing = vf3_dot(normal, to_eye), .width = *width};
    lobe.n_v = clamp01(lobe.facing);
    read_tables(tables, &lobe);
    return lobe;
}

// Returns the height (y) of the direction in which a lobe sees the surroundings, times the share
// that blurring leaves of it.
VEC_INLINE Vf reflected_height(const Lobe *lobe, Vf3 to_eye) {
    const Vf s = lobe->width.lean;
    const Vf rest = 1.0f - s;
    const Vf mirrored = lobe->n_v * lobe->normal.y * 2.0f - to_eye.y;
    const Vf cosine = lobe->n_v * 2.0f - lobe->facing; // between the normal and the mirrored eye
    const Vf length2 = (rest * rest + s * s) + (s * rest) * cosine * 2.0f;
    return (lobe->normal.y * rest + mirrored * s) * inverse_length(length2) * lobe->width.blur;
}

// What a light gives to a lobe, as shares of the light on a white surface that faces it.
typedef struct LightShares {
    Vf facing;    // n.l, at least 0
    Vf highlight; // of the lobe, without its colour
    Vf fresnel;   // (1 - v.h)^5
} LightShares;

// Let c be v.l, and h the half vector of v and l. Then (v + l)^2 = 2 (1 + c), and v.h is half the
// root of that. GGX's denominator is computed times 2 (1 + c).
VEC_INLINE LightShares meet_light(const Lobe *lobe, Vf3 to_eye, Vf3 to_light) {
    const Vf n_l = vf3_dot(lobe->normal, to_light);
    const Vf sum2 = vf_max(vf3_dot(to_eye, to_light) * 2.0f + 2.0f, vf_splat(1e-6f));
    const Vf along = vf_max(n_l + lobe->facing, vf_splat(0.0f));
    const Vf alpha2 = lobe->width.alpha2;
    const Vf d = along * along * (alpha2 - 1.0f) + sum2;
    const Vf narrow = 1.0f - alpha2;
    LightShares shares = {.facing = vf_max(n_l, vf_splat(0.0f))};
    const Vf n_v = vf_max(lobe->n_v, vf_splat(1e-4f));
    const Vf met = vf_min(shares.facing, vf_splat(1.0f));
    const Vf shadows =
        met * vf_sqrt(n_v * n_v * narrow + alpha2) + n_v * vf_sqrt(met * met * narrow + alpha2);
    shares.highlight = (met * alpha2 * 0.5f) * (sum2 * sum2) / (d * d * shadows);
    const Vf rest = clamp01(1.0f - vf_sqrt(sum2) * 0.5f);
    shares.fresnel = (rest * rest) * (rest * rest) * rest;
    return shares;
}

// Returns 1 / (A + B) - 1: what a white lobe loses, relative to what it keeps.
VEC_INLINE Vf lost_light(const Lobe *lobe) {
    return vf_splat(1.0f) / vf_max(lobe->a + lobe->b, vf_splat(1e-3f)) - 1.0f;
}

#endif
