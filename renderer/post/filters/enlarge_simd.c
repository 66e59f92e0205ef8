// Enlarging: separable sums in linear light, and EASU, the upscaling of FSR 1 (AMD, 2021).
#include "renderer/post/filters/pixels_simd.h"
#include "renderer/post/filters/post_kernels.h"
#include "renderer/simd/srgb.h"

// The result has at least as many pixels as the source, so the places of DIP_LANES successive
// pixels lie within DIP_LANES values from the first place on.
typedef struct Pick {
    int base;  // place of the first lane
    Vi offset; // places of all lanes, relative to it
} Pick;

// `first` may be read a vector's length from x on.
VEC_INLINE Pick pick_of(const int32_t *first, int x) {
    return (Pick){first[x], vi_load(first + x) - first[x]};
}

VEC_INLINE Vf pick(const float *row, Pick places, int tap) {
    const float *from = row + places.base + tap;
#if VEC_AVX512
    return (Vf)_mm512_permutexvar_ps((__m512i)places.offset, _mm512_loadu_ps(from));
#elif VEC_AVX2
    return (Vf)_mm256_permutevar8x32_ps(_mm256_loadu_ps(from), (__m256i)places.offset);
#else
    return vf_gather(from, places.offset);
#endif
}

void DIP_KERNEL(dip_kernel_spread_row)(const DipSpreadRow *row) {
    for (int x = 0; x < row->width; x += DIP_LANES) {
        const Pick places = pick_of(row->first, x);
        Vf sum = vf_splat(0.0f);
        for (int t = 0; t < row->taps; t++) {
            sum += vf_load(row->weights[t] + x) * pick(row->row, places, t);
        }
        vf_store(row->to + x, sum);
    }
}

// Clamps values to the range of the four nearest pixels of the source.
VEC_INLINE Vf within_nearest(Vf value, const float *upper, const float *lower, Pick places) {
    const Vf a = pick(upper, places, 0);
    const Vf b = pick(upper, places, 1);
    const Vf c = pick(lower, places, 0);
    const Vf d = pick(lower, places, 1);
    const Vf least = vf_min(vf_min(a, b), vf_min(c, d));
    const Vf greatest = vf_max(vf_max(a, b), vf_max(c, d));
    return vf_min(greatest, vf_max(least, value));
}

void DIP_KERNEL(dip_kernel_blend_row)(const DipBlendRow *row) {
    for (int x = 0; x < row->width; x += DIP_LANES) {
        Vi rgb[3];
        for (int c = 0; c < 3; c++) {
            Vf sum = vf_splat(0.0f);
            for (int t = 0; t < row->taps; t++) {
                sum += vf_load(row->rows[t][c] + x) * row->weights[t];
            }
            if (row->taps == 4) {
                const Pick places = pick_of(row->first, x);
                sum = within_nearest(sum, row->nearest[0][c], row->nearest[1][c], places);
            }
            const Vf light = vf_min(vf_max(sum, vf_splat(0.0f)), vf_splat(1.0f));
            rgb[c] = (Vi)vu_srgb_codes(row->srgb, vi_nearest(light * 65535.0f));
        }
        vu_store_pixels(row->to + 4 * x, row->width - x, vu_pixels(rgb, vu_splat(0xff000000u)));
    }
}

void DIP_KERNEL(dip_kernel_easu_shape)(const DipEasuShape *shape) {
    // A difference is compared with the greater one of its two halves.
    const Vf least = vf_splat(1e-9f);
    const Vf one = vf_splat(1.0f);
    for (int x = 0; x < shape->width; x += DIP_LANES) {
        const float *at = shape->luma + x;
        const Vf m = vf_load(at);
        const Vf w = vf_load(at - 1);
        const Vf e = vf_load(at + 1);
        const Vf n = vf_load(at - shape->luma_stride);
        const Vf s = vf_load(at + shape->luma_stride);
        const Vf across_x = e - w;
        const Vf across_y = s - n;
        const Vf half_x = vf_max(vf_abs(e - m), vf_abs(m - w));
        const Vf half_y = vf_max(vf_abs(s - m), vf_abs(m - n));
        const Vf edge_x = vf_min(vf_abs(across_x) / vf_max(half_x, least), one);
        const Vf edge_y = vf_min(vf_abs(across_y) / vf_max(half_y, least), one);
        vf_store(shape->across_x + x, across_x);
        vf_store(shape->across_y + x, across_y);
        vf_store(shape->edge + x, edge_x * edge_x + edge_y * edge_y);
    }
}

// The kernel of EASU at a pixel of the result: an ellipse along the edge.
typedef struct Ellipse {
    Vf along_x, along_y; // unit vector across the edge
    Vf scale_x, scale_y; // how much distances across and along the edge count
    Vf lobe, limit;      // strength of the negative lobe, and the squared distance where it ends
} Ellipse;

VEC_INLINE Vf bilinear(const float *upper, const float *lower, Pick places, const Vf weights[4]) {
    return pick(upper, places, 0) * weights[0] + pick(upper, places, 1) * weights[1] +
           pick(lower, places, 0) * weights[2] + pick(lower, places, 1) * weights[3];
}

VEC_INLINE Ellipse ellipse_at(const DipEasuRow *row, Pick places, Vf px, Vf py) {
    const Vf weights[4] = {(1.0f - px) * (1.0f - py), px * (1.0f - py), (1.0f - px) * py, px * py};
    const float *const(*shape)[3] = row->shape;
    Vf dx = bilinear(shape[0][0], shape[1][0], places, weights);
    Vf dy = bilinear(shape[0][1], shape[1][1], places, weights);
    Vf edge = bilinear(shape[0][2], shape[1][2], places, weights);
    const Vf square = dx * dx + dy * dy;
    const Mask flat = vf_lt(square, vf_splat(1.0f / 32768.0f));
    const Vf inverse = 1.0f / vf_sqrt(vf_select(flat, vf_splat(1.0f), square));
    dx = vf_select(flat, vf_splat(1.0f), dx * inverse);
    dy = vf_select(flat, dy, dy * inverse);
    edge *= 0.5f;
    edge *= edge;
    const Vf stretch = (dx * dx + dy * dy) / vf_max(vf_abs(dx), vf_abs(dy));
    const Vf lobe = 0.5f + (0.21f - 0.5f) * edge;
    return (Ellipse){dx, dy, 1.0f + (stretch - 1.0f) * edge, 1.0f - edge * 0.5f, lobe, 1.0f / lobe};
}

// Returns the weight of a pixel of the source at a distance from the pixel of the result.
VEC_INLINE Vf easu_weight(const Ellipse *ellipse, Vf x, Vf y) {
    const Vf across = (x * ellipse->along_x + y * ellipse->along_y) * ellipse->scale_x;
    const Vf along = (y * ellipse->along_x - x * ellipse->along_y) * ellipse->scale_y;
    const Vf square = vf_min(across * across + along * along, ellipse->limit);
    const Vf window = ellipse->lobe * square - 1.0f;
    const Vf base = square * 0.4f - 1.0f;
    return (base * base * (25.0f / 16.0f) - 9.0f / 16.0f) * (window * window);
}

void DIP_KERNEL(dip_kernel_easu_row)(const DipEasuRow *row) {
    static const int taps[12][2] = {{0, -1}, {1, -1}, {-1, 0}, {0, 0}, {1, 0}, {2, 0},
                                    {-1, 1}, {0, 1},  {1, 1},  {2, 1}, {0, 2}, {1, 2}};
    const Vf py = vf_splat(row->part_y);
    for (int x = 0; x < row->width; x += DIP_LANES) {
        const Pick places = pick_of(row->first, x);
        const Vf px = vf_load(row->part + x);
        const Ellipse ellipse = ellipse_at(row, places, px, py);
        Vf sums[3] = {vf_splat(0.0f), vf_splat(0.0f), vf_splat(0.0f)};
        Vf total = vf_splat(0.0f);
        for (int t = 0; t < 12; t++) {
            const Vf weight = easu_weight(&ellipse, (float)taps[t][0] - px, (float)taps[t][1] - py);
            const float *const *channels = row->rows[taps[t][1] + 1];
            for (int c = 0; c < 3; c++) {
                sums[c] += pick(channels[c], places, taps[t][0]) * weight;
            }
            total += weight;
        }
        const Vf scale = 1.0f / total;
        Vi rgb[3];
        for (int c = 0; c < 3; c++) {
            const Vf value =
                within_nearest(sums[c] * scale, row->rows[1][c], row->rows[2][c], places);
            rgb[c] = vi_nearest_code(value);
        }
        vu_store_pixels(row->to + 4 * x, row->width - x, vu_pixels(rgb, vu_splat(0xff000000u)));
    }
}
