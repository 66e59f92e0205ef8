// Bilinear reads of a target that an earlier pass drew, compiled once per instruction set.
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/simd/vec.h"

// One axis of a bilinear read: the indices of the two texels, and the weight of the second.
typedef struct Axis {
    Vi near;
    Vi far;
    Vf share;
} Axis;

// Computes the read along one axis. A NaN coordinate reads the first texel.
VEC_INLINE Axis axis_at(Vf fraction, int size) {
    const Vf at = fraction * (float)size - 0.5f;
    const Vf bounded = vf_min(vf_max(at, vf_splat(0.0f)), vf_splat((float)(size - 1)));
    const Vf floor = vf_floor(bounded);
    Axis axis = {.near = vi_from_float(floor), .share = bounded - floor};
    axis.far = vi_min(axis.near + 1, vi_splat(size - 1));
    return axis;
}

VEC_INLINE Vf mix(Vf a, Vf b, Vf share) {
    return a + (b - a) * share;
}

void DIP_KERNEL(dip_kernel_sample_target)(DipFragmentBatch *batch, const DipTarget *target,
                                          const float *u, const float *v,
                                          float (*out)[DIP_FRAGMENT_BATCH]) {
    const int32_t *pixels = (const int32_t *)(const void *)target->rgba8;
    const int32_t stride = (int32_t)(target->stride_bytes / 4);
    const float *light = batch->srgb_light;
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        const Axis x = axis_at(vf_load(u + i), target->width);
        const Axis y = axis_at(vf_load(v + i), target->height);
        const Vi near = y.near * stride;
        const Vi far = y.far * stride;
        const Vi texel[4] = {vi_gather(pixels, near + x.near), vi_gather(pixels, near + x.far),
                             vi_gather(pixels, far + x.near), vi_gather(pixels, far + x.far)};
        for (int c = 0; c < 3; c++) {
            Vf corner[4];
            for (int k = 0; k < 4; k++) {
                corner[k] = vf_gather(light, (texel[k] >> (8 * c)) & 255);
            }
            vf_store(out[c] + i, mix(mix(corner[0], corner[1], x.share),
                                     mix(corner[2], corner[3], x.share), y.share));
        }
    }
    batch->work.probes += (uint64_t)batch->count;
    batch->work.texels += (uint64_t)batch->count * 4;
}
