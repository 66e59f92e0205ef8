// Reads rows of pixels into rows of values.
#include "renderer/post/filters/pixels_simd.h"
#include "renderer/post/filters/post_kernels.h"

// The rows of values have a border, so the last vector may be written whole.
void DIP_KERNEL(dip_kernel_post_codes)(const uint8_t *rgba8, int width, float *const channels[3]) {
    for (int x = 0; x < width; x += DIP_LANES) {
        const Vu pixels = vu_load_pixels(rgba8 + 4 * x, width - x);
        for (int c = 0; c < 3; c++) {
            vf_store(channels[c] + x, vf_from_int(vi_channel(pixels, c)) * (1.0f / 255.0f));
        }
    }
}

void DIP_KERNEL(dip_kernel_post_decode)(const uint8_t *rgba8, int width, const float *table,
                                        float *const channels[3]) {
    for (int x = 0; x < width; x += DIP_LANES) {
        const Vu pixels = vu_load_pixels(rgba8 + 4 * x, width - x);
        for (int c = 0; c < 3; c++) {
            vf_store(channels[c] + x, vf_gather(table, vi_channel(pixels, c)));
        }
    }
}

void DIP_KERNEL(dip_kernel_post_luma)(const uint8_t *rgba8, int width, const float weights[3],
                                      float *luma) {
    for (int x = 0; x < width; x += DIP_LANES) {
        const Vu pixels = vu_load_pixels(rgba8 + 4 * x, width - x);
        Vf sum = vf_from_int(vi_channel(pixels, 0)) * weights[0];
        sum += vf_from_int(vi_channel(pixels, 1)) * weights[1];
        sum += vf_from_int(vi_channel(pixels, 2)) * weights[2];
        vf_store(luma + x, sum * (1.0f / 255.0f));
    }
}
