// Address modes: from a texture coordinate along an axis to a position in 1/256 texel.
// docs/picture.md (Textures) defines them.
#ifndef DIP_RENDERER_PIPELINE_TEXTURE_ADDRESS_SIMD_H
#define DIP_RENDERER_PIPELINE_TEXTURE_ADDRESS_SIMD_H

#include "renderer/pipeline/texture.h"
#include "renderer/simd/vec.h"

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

// Returns how far a coordinate lies in the pair of copies that a mirrored axis repeats: 0..2.
VEC_INLINE Vf mirror_phase(Vf coordinate) {
    return coordinate - 2.0f * vf_floor(coordinate * 0.5f);
}

// Returns a coordinate within 0..1 at which an axis without a border has the same texels.
VEC_INLINE Vf fold(Vf coordinate, DipWrap wrap) {
    Vf folded = coordinate;
    if (wrap == DIP_WRAP_REPEAT) {
        folded = coordinate - vf_floor(coordinate);
    } else if (wrap == DIP_WRAP_MIRROR) {
        const Vf phase = mirror_phase(coordinate);
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

// Returns the lanes whose position lies before the centre of the first texel, on an axis that reads
// this texel alone there: one that neither repeats nor has a border. `address` returns the centre.
VEC_INLINE Mask reads_first_alone(Vf coordinate, DipWrap wrap, Vi size) {
    if (wrap == DIP_WRAP_REPEAT || wrap == DIP_WRAP_BORDER) {
        return mask_from_bits(0);
    }
    const Vf scale = vf_from_int(size << 8);
    return vi_lt(vi_from_float(fold(coordinate, wrap) * scale), vi_splat(128));
}

// Returns the lanes whose position moves towards the first texel as the coordinate grows: those in
// mirrored copies.
VEC_INLINE Mask runs_backwards(Vf coordinate, DipWrap wrap) {
    return wrap == DIP_WRAP_MIRROR ? vf_lt(vf_splat(1.0f), mirror_phase(coordinate))
                                   : mask_from_bits(0);
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

#endif
