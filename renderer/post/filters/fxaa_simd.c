// FXAA 3.11 "quality" (Lottes, 2011) on luma of codes, with the preset 12.
#include "renderer/post/filters/pixels_simd.h"
#include "renderer/post/filters/post_kernels.h"
#include "renderer/simd/pairs.h"

// A pixel is at an edge if the luma of its neighbourhood differs by this share of the greatest luma
// there, and by this much at least.
static const float edge_share = 0.125f;
static const float edge_least = 0.0312f;
static const float subpixel_share = 0.75f; // how much single pixels and thin lines are blurred

// Places of the search along an edge, in half pixels from the pixel.
enum { PLACE_COUNT = 5 };
static const int places[PLACE_COUNT] = {2, 5, 9, 17, 41};

// The neighbourhoods of several pixels in the plane of luma.
typedef struct Around {
    const float *luma;
    Vi at;           // places of the pixels
    Vi along;        // distance in the plane to the next pixel along the edge
    Vi step;         // distance in the plane to the pixel on the other side of the edge
    Mask horizontal; // lanes whose edge is horizontal
    // Four pixels, two along the edge and two across it, lie in two rows.
    Vi begin;  // where the first row begins, relative to the first pixel along the edge
    Vi second; // distance in the plane from the first row to the second
} Around;

// Luma of two neighbours in a row, which are gathered at once.
typedef struct Neighbours {
    Vf left;
    Vf right;
} Neighbours;

VEC_INLINE Neighbours gather_two(const float *luma, Vi at) {
    const VuPair pair = vu_gather_pairs((const uint32_t *)(const void *)luma, vi_pair_order(at));
    return (Neighbours){(Vf)vu_pair_left(pair), (Vf)vu_pair_right(pair)};
}

VEC_INLINE Vf greatest5(Vf a, Vf b, Vf c, Vf d, Vf e) {
    return vf_max(vf_max(vf_max(a, b), vf_max(c, d)), e);
}

VEC_INLINE Vf least5(Vf a, Vf b, Vf c, Vf d, Vf e) {
    return vf_min(vf_min(vf_min(a, b), vf_min(c, d)), e);
}

// Returns the luma on the edge between both sides, at a place along the edge.
VEC_INLINE Vf luma_between(const Around *around, int place) {
    const Vi whole = around->at + around->along * (place >> 1); // rounds down
    if (!(place & 1)) {
        return (vf_gather(around->luma, whole) + vf_gather(around->luma, whole + around->step)) *
               0.5f;
    }
    const Neighbours a = gather_two(around->luma, whole + around->begin);
    const Neighbours b = gather_two(around->luma, whole + around->begin + around->second);
    const Vf across = vf_select(around->horizontal, b.left, a.right);
    const Vf next = vf_select(around->horizontal, a.right, b.left);
    return ((a.left + across) + (next + b.right)) * 0.25f;
}

// Where the search along an edge ends in one direction.
typedef struct End {
    unsigned searching; // the lanes that have not ended, one bit each
    Vf distance;        // in half pixels
    Vf difference;      // how far the luma is from the edge's mean there
} End;

// Searches along the edge in both directions until the luma leaves the edge's mean.
VEC_INLINE void find_ends(const Around *around, Vf mean, Vf enough, End ends[2]) {
    for (int d = 0; d < 2; d++) {
        ends[d] = (End){VEC_ALL_LANES, vf_splat(0.0f), vf_splat(0.0f)};
    }
    for (int i = 0; i < PLACE_COUNT && (ends[0].searching | ends[1].searching); i++) {
        for (int d = 0; d < 2; d++) {
            End *end = &ends[d];
            const Mask lanes = mask_from_bits(end->searching);
            const Vf now = luma_between(around, d ? places[i] : -places[i]) - mean;
            end->distance = vf_select(lanes, vf_splat((float)places[i]), end->distance);
            end->difference = vf_select(lanes, now, end->difference);
            end->searching &= mask_bits(vf_lt(vf_abs(now), enough));
        }
    }
}

// Returns the share, 0..1/2 or more, of the pixel on the other side of the edge, and sets the
// fields of `around` that depend on the edge. The neighbours are gathered by rows.
VEC_INLINE Vf shift_of(Around *around, int stride, Mask *before) {
    const float *luma = around->luma;
    const Vi at = around->at;
    const Neighbours above = gather_two(luma, at - stride - 1);
    const Neighbours level = gather_two(luma, at - 1);
    const Neighbours below = gather_two(luma, at + stride - 1);
    const Vf nw = above.left, n = above.right, ne = vf_gather(luma, at - stride + 1);
    const Vf w = level.left, m = level.right, e = vf_gather(luma, at + 1);
    const Vf sw = below.left, s = below.right, se = vf_gather(luma, at + stride + 1);

    const Vf range = greatest5(n, s, w, e, m) - least5(n, s, w, e, m);
    Vf sub = ((n + s + w + e) * 2.0f + (nw + ne + sw + se)) * (1.0f / 12.0f) - m;
    sub = vf_min(vf_abs(sub) / range, vf_splat(1.0f));
    sub = (3.0f - sub * 2.0f) * sub * sub;
    sub = sub * sub * subpixel_share;

    const Vf across_rows =
        vf_abs(nw + sw - w * 2.0f) + vf_abs(n + s - m * 2.0f) * 2.0f + vf_abs(ne + se - e * 2.0f);
    const Vf across_columns =
        vf_abs(nw + ne - n * 2.0f) + vf_abs(w + e - m * 2.0f) * 2.0f + vf_abs(sw + se - s * 2.0f);
    const unsigned vertical = mask_bits(vf_lt(across_rows, across_columns));
    const Mask horizontal = mask_from_bits(~vertical & VEC_ALL_LANES);
    const Vf first = vf_select(horizontal, n, w);
    const Vf second = vf_select(horizontal, s, e);
    const Vf to_first = vf_abs(first - m);
    const Vf to_second = vf_abs(second - m);
    *before = mask_from_bits(~mask_bits(vf_lt(to_first, to_second)) & VEC_ALL_LANES);
    const Vi apart = vi_select(horizontal, vi_splat(stride), vi_splat(1));
    around->along = vi_select(horizontal, vi_splat(1), vi_splat(stride));
    around->step = vi_select(*before, -apart, apart);
    around->horizontal = horizontal;
    around->begin = vi_select(horizontal, vi_splat(0), vi_min(around->step, vi_splat(0)));
    around->second = vi_select(horizontal, around->step, around->along);

    const Vf mean = (vf_select(*before, first, second) + m) * 0.5f;
    const Vf enough = vf_max(to_first, to_second) * 0.25f;
    End ends[2];
    find_ends(around, mean, enough, ends);
    const Vf back = ends[0].distance;
    const Vf forth = ends[1].distance;
    const Vf nearest = vf_min(back, forth);
    const Vf luma_nearest = vf_select(vf_lt(back, forth), ends[0].difference, ends[1].difference);
    const Vf zero = vf_splat(0.0f);
    const unsigned good = mask_bits(vf_lt(luma_nearest, zero)) ^ mask_bits(vf_lt(m - mean, zero));
    const Vf move = vf_select(mask_from_bits(good), 0.5f - nearest / (back + forth), zero);
    return vf_max(move, sub);
}

// Filters the pixels at the places x[0..count-1] of a row.
static void filter_edges(const DipFxaaRow *row, const uint32_t *x, int count) {
    const int left = count < DIP_LANES ? count : DIP_LANES;
    uint32_t lanes[DIP_LANES];
    for (int i = 0; i < DIP_LANES; i++) {
        lanes[i] = x[i < left ? i : 0];
    }
    Vi at;
    memcpy(&at, lanes, sizeof at);
    Around around = {.luma = row->luma, .at = at};
    Mask before;
    const Vf move = shift_of(&around, row->luma_stride, &before);

    const Vi next = vi_select(before, at - 1, at + 1);
    const Vi beside = vi_min(vi_max(next, vi_splat(0)), vi_splat(row->width - 1));
    const Vu self = vu_gather_bytes(row->row, at * 4);
    const Vu vertical = vu_gather_bytes(row->row, beside * 4);
    const Vu above = vu_gather_bytes(row->above, at * 4);
    const Vu below = vu_gather_bytes(row->below, at * 4);
    const Vi other =
        vi_select(around.horizontal, vi_select(before, (Vi)above, (Vi)below), (Vi)vertical);
    Vi rgb[3];
    for (int c = 0; c < 3; c++) {
        const Vf from = vf_from_int(vi_channel(self, c));
        const Vf to = vf_from_int(vi_channel((Vu)other, c));
        rgb[c] = vi_nearest(from + (to - from) * move);
    }
    uint32_t pixels[DIP_LANES];
    vu_store(pixels, vu_pixels(rgb, self));
    for (int i = 0; i < left; i++) {
        memcpy(row->to + 4 * (size_t)lanes[i], &pixels[i], 4);
    }
}

int DIP_KERNEL(dip_kernel_fxaa_row)(const DipFxaaRow *row) {
    const float *luma = row->luma;
    const int stride = row->luma_stride;
    int count = 0;
    memcpy(row->to, row->row, (size_t)row->width * 4);
    for (int x = 0; x < row->width; x += DIP_LANES) {
        const Vf m = vf_load(luma + x);
        const Vf n = vf_load(luma + x - stride);
        const Vf s = vf_load(luma + x + stride);
        const Vf w = vf_load(luma + x - 1);
        const Vf e = vf_load(luma + x + 1);
        const Vf greatest = greatest5(n, s, w, e, m);
        const Vf range = greatest - least5(n, s, w, e, m);
        const Vf enough = vf_max(greatest * edge_share, vf_splat(edge_least));
        const unsigned edges = ~mask_bits(vf_lt(range, enough)) & lanes_within(row->width - x);
        if (edges) {
            count += vu_compress(row->edges + count, edges, (Vu)(vi_iota() + x));
        }
    }
    for (int i = 0; i < count; i += DIP_LANES) {
        filter_edges(row, row->edges + i, count - i);
    }
    return count;
}
