// The parts of SMAA 1x (Jimenez et al., 2012) that touch every pixel: finding edges, and blending
// by weights.
#include "renderer/post/filters/pixels_simd.h"
#include "renderer/post/filters/post_kernels.h"

// Luma of two pixels differs by at least this much across an edge.
static const float edge_least = 0.1f;

void DIP_KERNEL(dip_kernel_smaa_edges)(const float *luma, int luma_stride, int width,
                                       uint64_t *left, uint64_t *top) {
    const Vf least = vf_splat(edge_least);
    for (int x = 0; x < width; x += DIP_LANES) {
        const float *at = luma + x;
        const Vf m = vf_load(at);
        const Vf w = vf_load(at - 1);
        const Vf n = vf_load(at - luma_stride);
        const Vf to_left = vf_abs(m - w);
        const Vf to_top = vf_abs(m - n);
        unsigned edges_left = ~mask_bits(vf_lt(to_left, least)) & lanes_within(width - x);
        unsigned edges_top = ~mask_bits(vf_lt(to_top, least)) & lanes_within(width - x);
        if (edges_left | edges_top) {
            // An edge beside one that is more than twice as strong does not show.
            const Vf to_right = vf_abs(m - vf_load(at + 1));
            const Vf to_bottom = vf_abs(m - vf_load(at + luma_stride));
            const Vf beyond_left = vf_abs(w - vf_load(at - 2));
            const Vf beyond_top = vf_abs(n - vf_load(at - 2 * (ptrdiff_t)luma_stride));
            const Vf strongest = vf_max(vf_max(vf_max(to_left, to_right), beyond_left),
                                        vf_max(vf_max(to_top, to_bottom), beyond_top));
            edges_left &= ~mask_bits(vf_lt(to_left * 2.0f, strongest));
            edges_top &= ~mask_bits(vf_lt(to_top * 2.0f, strongest));
        }
        if (x % 64 == 0) {
            left[x / 64] = top[x / 64] = 0;
        }
        left[x / 64] |= (uint64_t)edges_left << (x % 64);
        top[x / 64] |= (uint64_t)edges_top << (x % 64);
    }
}

// Blends the pixels of a vector, of which at least one has a weight.
VEC_INLINE Vu blend(const DipSmaaRow *row, int x, Vu self, Vu own, Vu beside, Vu below) {
    const Vi at = vi_iota() + x;
    const Vi last = vi_splat(row->width - 1);
    const Vu pixels[4] = {
        vu_gather_bytes(row->above, vi_min(at, last) * 4),
        vu_gather_bytes(row->below, vi_min(at, last) * 4),
        vu_gather_bytes(row->row, vi_max(vi_min(at - 1, last), vi_splat(0)) * 4),
        vu_gather_bytes(row->row, vi_min(at + 1, last) * 4),
    };
    const Vf up = vf_from_int((Vi)(own & 0xffu));
    const Vf down = vf_from_int((Vi)(below >> 8 & 0xffu));
    const Vf to_left = vf_from_int((Vi)(own >> 16 & 0xffu));
    const Vf to_right = vf_from_int((Vi)(beside >> 24));
    // Only the stronger axis is blended.
    const Mask across = vf_lt(vf_max(up, down), vf_max(to_left, to_right));
    const Vf first = vf_select(across, to_left, up);
    const Vf second = vf_select(across, to_right, down);
    const Vf sum = first + second;
    const Mask none = vf_lt(sum, vf_splat(0.5f));
    const Vf divisor = vf_select(none, vf_splat(1.0f), sum);
    const Vf share_first = first * (1.0f / 255.0f);
    const Vf share_second = second * (1.0f / 255.0f);
    const Vi before = vi_select(across, (Vi)pixels[2], (Vi)pixels[0]);
    const Vi after = vi_select(across, (Vi)pixels[3], (Vi)pixels[1]);
    Vi rgb[3];
    for (int c = 0; c < 3; c++) {
        const Vi code = vi_channel(self, c);
        const Vf m = vf_from_int(code);
        const Vf a = m + (vf_from_int(vi_channel((Vu)before, c)) - m) * share_first;
        const Vf b = m + (vf_from_int(vi_channel((Vu)after, c)) - m) * share_second;
        rgb[c] = vi_select(none, code, vi_nearest((a * first + b * second) / divisor));
    }
    return vu_pixels(rgb, self);
}

void DIP_KERNEL(dip_kernel_smaa_row)(const DipSmaaRow *row) {
    for (int x = 0; x < row->width; x += DIP_LANES) {
        const int left = row->width - x;
        const Vu self = vu_load_pixels(row->row + 4 * x, left);
        const Vu own = vu_load_pixels((const uint8_t *)(row->weights + x), left);
        const Vu beside = vu_load_pixels((const uint8_t *)(row->weights + x + 1), left);
        const Vu below = vu_load_pixels((const uint8_t *)(row->weights_below + x), left);
        const Vu any = (own & 0x00ff00ffu) | (beside & 0xff000000u) | (below & 0x0000ff00u);
        const bool blends = (~mask_bits(vi_eq((Vi)any, vi_splat(0))) & lanes_within(left)) != 0;
        vu_store_pixels(row->to + 4 * x, left,
                        blends ? blend(row, x, self, own, beside, below) : self);
    }
}
