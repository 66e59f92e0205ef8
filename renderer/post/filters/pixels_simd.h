// Vectors of 8-bit RGBA pixels: reading and writing them, and their channels.
#ifndef DIP_RENDERER_POST_FILTERS_PIXELS_SIMD_H
#define DIP_RENDERER_POST_FILTERS_PIXELS_SIMD_H

#include "renderer/simd/vec.h"

// Returns the pixels from rgba8 on. Only the first `left` pixels are read; the others are 0.
VEC_INLINE Vu vu_load_pixels(const uint8_t *rgba8, int left) {
    Vu v = {0};
    if (left >= DIP_LANES) {
        memcpy(&v, rgba8, sizeof v);
    } else {
        memcpy(&v, rgba8, (size_t)left * 4);
    }
    return v;
}

// Writes the first `left` pixels of v, or all if there are fewer.
VEC_INLINE void vu_store_pixels(uint8_t *rgba8, int left, Vu v) {
    memcpy(rgba8, &v, left >= DIP_LANES ? sizeof v : (size_t)left * 4);
}

// Returns a channel of the pixels, 0..255: 0 is red.
VEC_INLINE Vi vi_channel(Vu pixels, int channel) {
    return (Vi)(pixels >> (uint32_t)(8 * channel) & 0xffu);
}

// Returns the pixels of red, green and blue, each 0..255, with the alpha of other pixels.
VEC_INLINE Vu vu_pixels(const Vi rgb[3], Vu alpha_of) {
    return (Vu)rgb[0] | (Vu)rgb[1] << 8 | (Vu)rgb[2] << 16 | (alpha_of & 0xff000000u);
}

// Returns the nearest whole numbers to values that are 0 or more; halves are rounded up.
VEC_INLINE Vi vi_nearest(Vf v) {
    return vi_from_float(v + 0.5f);
}

// Returns the nearest codes to values 0..1, which are clamped.
VEC_INLINE Vi vi_nearest_code(Vf v) {
    return vi_nearest(vf_min(vf_max(v, vf_splat(0.0f)), vf_splat(1.0f)) * 255.0f);
}

// Returns the bits of the lanes that lie within a row of which `left` pixels are left.
VEC_INLINE unsigned lanes_within(int left) {
    return left >= DIP_LANES ? VEC_ALL_LANES : (1u << left) - 1u;
}

#endif
