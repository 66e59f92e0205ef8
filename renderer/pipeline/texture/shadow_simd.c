// Compares depths with a shadow map (DipSampleShadow in shader.h), compiled once per instruction
// set.
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/pipeline/merge/depth_planes.h"
#include "renderer/simd/vec.h"

// One axis of a read: the two texels, and the weight of the second in 1/256.
typedef struct Axis {
    Vi near;
    Vi far;
    Vi share;
    Mask outside;
} Axis;

VEC_INLINE Axis axis_at(Vf fraction, int size, bool linear) {
    const float units = 256.0f * (float)size;
    // Texel i has its centre at i + 1/2.
    const Vf at = linear ? vf_floor(fraction * units - 127.5f) : vf_floor(fraction * units);
    const Vf bounded = vf_min(vf_max(at, vf_splat(-256.0f)), vf_splat(units));
    const Vi fixed = vi_from_float(bounded);
    const Vi texel = fixed >> 8;
    const Vi last = vi_splat(size - 1);
    const Vf inside = vf_min(fraction, 1.0f - fraction);
    return (Axis){.near = vi_min(vi_max(texel, vi_splat(0)), last),
                  .far = vi_min(vi_max(texel + 1, vi_splat(0)), last),
                  .share = linear ? fixed & 255 : vi_splat(0),
                  .outside = vf_lt(inside, vf_splat(0.0f))};
}

// Returns the depths to compare. Points behind the far plane are compared as if they lay on it.
VEC_INLINE Vf depths_at(const float *z) {
    return vf_max(vf_splat(0.0f), vf_load(z));
}

// Returns the weight where the stored depth is not nearer than z, and 0 elsewhere.
VEC_INLINE Vi lit(const float *depths, Vi index, Vf z, Vi weight) {
    return vi_select(vf_lt(z, vf_gather(depths, index)), vi_splat(0), weight);
}

// One axis of a wide read: the three texels, and their weights in 1/256, which sum up to 512.
typedef struct WideAxis {
    Vi texel[3];
    Vi weight[3];
    Mask outside;
} WideAxis;

VEC_INLINE WideAxis wide_axis_at(Vf fraction, int size) {
    const Axis middle = axis_at(fraction, size, false);
    const float units = 256.0f * (float)size;
    const Vf at = vf_min(vf_max(vf_floor(fraction * units), vf_splat(-256.0f)), vf_splat(units));
    const Vi share = vi_from_float(at) & 255;
    return (WideAxis){.texel = {vi_max(middle.near - 1, vi_splat(0)), middle.near, middle.far},
                      .weight = {256 - share, vi_splat(256), share},
                      .outside = middle.outside};
}

VEC_INLINE void sample_wide(DipFragmentBatch *batch, const DipDepth *depth, const float *u,
                            const float *v, const float *z, float *out) {
    const Vi all = vi_splat(512 * 512);
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        const WideAxis x = wide_axis_at(vf_load(u + i), depth->width);
        const WideAxis y = wide_axis_at(vf_load(v + i), depth->height);
        const Vf from = depths_at(z + i);
        Vi sum = vi_splat(0);
        for (int row = 0; row < 3; row++) {
            const Vi first = y.texel[row] * depth->width;
            for (int column = 0; column < 3; column++) {
                sum += lit(depth->depth, first + x.texel[column], from,
                           x.weight[column] * y.weight[row]);
            }
        }
        sum = vi_select(x.outside, all, vi_select(y.outside, all, sum));
        vf_store(out + i, vf_from_int(sum) * (1.0f / (512.0f * 512.0f)));
    }
    batch->work.probes += (uint64_t)batch->count;
    batch->work.texels += 9 * (uint64_t)batch->count;
}

void DIP_KERNEL(dip_kernel_sample_shadow)(DipFragmentBatch *batch, const DipShadowMap *map,
                                          const float *u, const float *v, const float *z,
                                          float *out) {
    const DipDepth *depth = map->depth;
    const bool linear = map->filter == DIP_SHADOW_LINEAR;
    if (map->filter == DIP_SHADOW_WIDE) {
        sample_wide(batch, depth, u, v, z, out);
        return;
    }
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        const Axis x = axis_at(vf_load(u + i), depth->width, linear);
        const Axis y = axis_at(vf_load(v + i), depth->height, linear);
        const Vf from = depths_at(z + i);
        const Vi near = y.near * depth->width;
        const Vi far = y.far * depth->width;
        Vi sum = lit(depth->depth, near + x.near, from, (256 - x.share) * (256 - y.share));
        if (linear) {
            sum += lit(depth->depth, near + x.far, from, x.share * (256 - y.share));
            sum += lit(depth->depth, far + x.near, from, (256 - x.share) * y.share);
            sum += lit(depth->depth, far + x.far, from, x.share * y.share);
        }
        sum = vi_select(x.outside, vi_splat(65536), vi_select(y.outside, vi_splat(65536), sum));
        vf_store(out + i, vf_from_int(sum) * (1.0f / 65536.0f));
    }
    batch->work.probes += (uint64_t)batch->count;
    batch->work.texels += (uint64_t)batch->count * (linear ? 4 : 1);
}
