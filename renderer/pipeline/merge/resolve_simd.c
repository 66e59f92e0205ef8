// Averages the samples of a block's pixels, compiled once per instruction set.
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/pipeline/merge/ordered.h"
#include "renderer/simd/srgb.h"
#include "renderer/simd/vec.h"

// Returns 16-bit linear light, 0..65535, as dip_kernel_encode rounds it. v must lie within 0..1.
VEC_INLINE Vi to_linear16(Vf v) {
    return vi_from_float(v * 65535.0f + 0.5f);
}

// Returns the mean of a channel in 16-bit linear light. first: index of sample 0's vector.
VEC_INLINE Vi mean16(const float *channel, int first, int sample_count, bool split) {
    if (!split) {
        return to_linear16(vf_load(channel + first));
    }
    Vi sum = vi_splat(sample_count / 2);
    for (int s = 0; s < sample_count; s++) {
        sum += to_linear16(vf_load(channel + first + s * DIP_BLOCK_PIXELS));
    }
    // Sums are below 2^20, so the quotient of floats has the right whole part: it rounds up to no
    // whole number from at least 1/8 below it.
    return vi_from_float(vf_from_int(sum) / (float)sample_count);
}

// Returns round(255 / 65535 * v) for v in 0..65535.
VEC_INLINE Vi to_code(Vi v) {
    const Vi scaled = v * 255 + 32767;
    return (scaled + 1 + (scaled >> 16)) >> 16;
}

void DIP_KERNEL(dip_kernel_resolve_codes)(const DipTileColours *colours, int block,
                                          const DipSrgbEncodeTable *srgb, uint32_t *rgba8) {
    const int first = block * colours->sample_count * DIP_BLOCK_PIXELS;
    for (int i = 0; i < DIP_BLOCK_PIXELS; i += DIP_LANES) {
        const bool split = dip_is_split(colours, block * 4 + i / DIP_SUB_BLOCK_PIXELS);
        Vu packed = vu_splat(0);
        for (int c = 0; c < 4; c++) {
            const Vi mean = mean16(colours->channel[c], first + i, colours->sample_count, split);
            const Vu code = srgb && c < 3 ? vu_srgb_codes(srgb, mean) : (Vu)to_code(mean);
            packed |= code << (8 * c);
        }
        vu_store(rgba8 + i, packed);
    }
}

void DIP_KERNEL(dip_kernel_resolve_light16)(const DipTileColours *colours, int block,
                                            DipBlockLight16 *light16) {
    const int first = block * colours->sample_count * DIP_BLOCK_PIXELS;
    for (int i = 0; i < DIP_BLOCK_PIXELS; i += DIP_LANES) {
        const bool split = dip_is_split(colours, block * 4 + i / DIP_SUB_BLOCK_PIXELS);
        for (int c = 0; c < 3; c++) {
            vi_store(light16->channel[c] + i,
                     mean16(colours->channel[c], first + i, colours->sample_count, split));
        }
    }
}

void DIP_KERNEL(dip_kernel_resolve_light)(const DipTileColours *colours, int block,
                                          DipBlockLight *light) {
    const int sample_count = colours->sample_count;
    const int first = block * sample_count * DIP_BLOCK_PIXELS;
    for (int c = 0; c < 4; c++) {
        const float *channel = colours->channel[c] + first;
        for (int i = 0; i < DIP_BLOCK_PIXELS; i++) {
            // Sums in double precision, so that equal samples have their own value as mean.
            double sum = channel[i];
            if (dip_is_split(colours, block * 4 + i / DIP_SUB_BLOCK_PIXELS)) {
                for (int s = 1; s < sample_count; s++) {
                    sum += channel[i + s * DIP_BLOCK_PIXELS];
                }
                sum /= sample_count;
            }
            light->channel[c][i] = (float)sum;
        }
    }
}
