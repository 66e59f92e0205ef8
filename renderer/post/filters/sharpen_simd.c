// RCAS, the sharpening of FSR 1 (AMD, 2021), on codes: a weighted sum of a pixel and its four
// neighbours, whose weight is as strong as it can be without leaving 0..1.
#include "renderer/post/filters/pixels_simd.h"
#include "renderer/post/filters/post_kernels.h"

static const float strongest = -0.1875f; // weight of a neighbour
static const float least_divisor = 1.0f / 65536.0f;

typedef struct Cross {
    Vf n, w, m, e, s;
} Cross;

VEC_INLINE Cross cross_of(const DipSharpenRow *row, int channel, int x) {
    return (Cross){vf_load(row->above[channel] + x), vf_load(row->row[channel] + x - 1),
                   vf_load(row->row[channel] + x), vf_load(row->row[channel] + x + 1),
                   vf_load(row->below[channel] + x)};
}

// Returns the strongest weight, 0 or less, with which the channel stays within 0..1.
VEC_INLINE Vf limit_of(Cross c) {
    const Vf least = vf_min(vf_min(c.n, c.w), vf_min(c.e, c.s));
    const Vf greatest = vf_max(vf_max(c.n, c.w), vf_max(c.e, c.s));
    const Vf dark = -(least / vf_max(greatest * 4.0f, vf_splat(least_divisor)));
    const Vf light = (1.0f - greatest) / vf_min(least * 4.0f - 4.0f, vf_splat(-least_divisor));
    return vf_max(dark, light);
}

void DIP_KERNEL(dip_kernel_sharpen_row)(const DipSharpenRow *row) {
    for (int x = 0; x < row->width; x += DIP_LANES) {
        const Cross channels[3] = {cross_of(row, 0, x), cross_of(row, 1, x), cross_of(row, 2, x)};
        Vf weight =
            vf_max(vf_max(limit_of(channels[0]), limit_of(channels[1])), limit_of(channels[2]));
        weight = vf_max(vf_splat(strongest), vf_min(weight, vf_splat(0.0f))) * row->sharpness;
        const Vf scale = 1.0f / (weight * 4.0f + 1.0f);
        Vi rgb[3];
        for (int c = 0; c < 3; c++) {
            const Cross at = channels[c];
            rgb[c] = vi_nearest_code((weight * ((at.n + at.w) + (at.e + at.s)) + at.m) * scale);
        }
        const Vu from = vu_load_pixels(row->from + 4 * x, row->width - x);
        vu_store_pixels(row->to + 4 * x, row->width - x, vu_pixels(rgb, from));
    }
}
