// SMAA 1x with the preset "high": edges of luma, then the weights of the pixels at edges, then
// blending. Straight edges are searched 32 pixels far and diagonal ones 8; where an edge turns a
// corner, the corner keeps its shape.
#include "renderer/post/filters/filter.h"

#include <string.h>

static const float luma_weights[3] = {0.2126f, 0.7152f, 0.0722f};
static const float corner_rounding = 0.25f; // share of the blending that remains at corners

static DipPostBits take_bits(DipPostArena *arena, int width, int height) {
    DipPostBits bits = {.stride = (width + 63) / 64 + 3};
    const size_t rows = (size_t)height + 2 * DIP_POST_MARGIN;
    uint64_t *memory = dip_post_take(arena, rows * (size_t)bits.stride, sizeof(uint64_t));
    bits.at = memory ? memory + (size_t)DIP_POST_MARGIN * (size_t)bits.stride + 1 : NULL;
    return bits;
}

static void take(DipPost *post, DipPostArena *arena) {
    const int width = post->def.from_width;
    const int height = post->def.from_height;
    post->luma = dip_post_take_plane(arena, width, height);
    post->edges_found = dip_post_take(arena, (size_t)post->worker_count, sizeof *post->edges_found);
    post->edges_left = take_bits(arena, width, height);
    post->edges_top = take_bits(arena, width, height);
    post->edges_left_by_y = take_bits(arena, height, width);
    post->edges_top_by_y = take_bits(arena, height, width);
    post->weights =
        dip_post_take(arena, ((size_t)width + 1) * ((size_t)height + 1), sizeof *post->weights);
    post->areas = dip_post_take(arena, 1, sizeof *post->areas);
}

static void prepare(DipPost *post) {
    dip_smaa_areas_make(post->areas);
}

static void find_edges(void *context, int band, int worker) {
    (void)worker;
    DipPost *post = context;
    const int end = (band + 1) * DIP_POST_BAND;
    for (int y = band * DIP_POST_BAND; y < end && y < post->def.from_height; y++) {
        post->kernels->dip_kernel_smaa_edges(
            post->luma.at + (ptrdiff_t)y * post->luma.stride, post->luma.stride,
            post->def.from_width, post->edges_left.at + (ptrdiff_t)y * post->edges_left.stride,
            post->edges_top.at + (ptrdiff_t)y * post->edges_top.stride);
    }
}

// --- transposing the edges -----------------------------------------------------------------------

// Transposes a square of 64 x 64 bits: swaps its two off-diagonal quarters, then those of each
// quarter, and so on.
static void transpose_square(uint64_t rows[64]) {
    uint64_t mask = 0x00000000ffffffffu;
    for (int size = 32; size; size /= 2, mask ^= mask << size) {
        for (int i = 0; i < 64; i = (i + size + 1) & ~size) {
            const uint64_t swap = (rows[i] >> size ^ rows[i + size]) & mask;
            rows[i] ^= swap << size;
            rows[i + size] ^= swap;
        }
    }
}

// Writes 64 columns of a picture's bits as rows.
static void transpose_columns(const DipPostBits *from, const DipPostBits *to, int word, int width,
                              int height) {
    for (int y0 = 0; y0 < height; y0 += 64) {
        uint64_t rows[64] = {0};
        for (int i = 0; i < 64 && y0 + i < height; i++) {
            rows[i] = from->at[(ptrdiff_t)(y0 + i) * from->stride + word];
        }
        transpose_square(rows);
        for (int i = 0; i < 64 && 64 * word + i < width; i++) {
            to->at[(ptrdiff_t)(64 * word + i) * to->stride + y0 / 64] = rows[i];
        }
    }
}

static void transpose(void *context, int word, int worker) {
    (void)worker;
    DipPost *post = context;
    const int width = post->def.from_width;
    const int height = post->def.from_height;
    transpose_columns(&post->edges_left, &post->edges_left_by_y, word, width, height);
    transpose_columns(&post->edges_top, &post->edges_top_by_y, word, width, height);
}

// --- the edges around a pixel --------------------------------------------------------------------

// A pixel may lie up to 64 pixels before or after its row and DIP_POST_MARGIN rows above or below
// the picture. There are no edges outside the picture.
static int bit_at(const DipPostBits *bits, int x, int y) {
    const uint64_t word = bits->at[(ptrdiff_t)y * bits->stride + (x >> 6)];
    return (int)(word >> (x & 63) & 1);
}

// Returns 64 pixels from (x, y) on, the first in bit 0.
static uint64_t bits_from(const DipPostBits *bits, int x, int y) {
    const uint64_t *word = bits->at + (ptrdiff_t)y * bits->stride + (x >> 6);
    const int shift = x & 63;
    return shift ? word[0] >> shift | word[1] << (64 - shift) : word[0];
}

// Edges along one axis, so that edges along x and along y are searched by the same code: `line` are
// the edges that are followed, and `crossing` those that cross them. For edges along y, both are
// transposed. A place is a distance along the line and the number of the line.
typedef struct Axis {
    const DipPostBits *line;
    const DipPostBits *crossing;
} Axis;

static int crossing_at(const Axis *axis, int along, int number) {
    return bit_at(axis->crossing, along, number);
}

// Returns 64 places from `along` on: whether an edge crosses the line at the near side of the
// place, on either side of the line.
static uint64_t crossings_from(const Axis *axis, int along, int number) {
    return bits_from(axis->crossing, along, number) | bits_from(axis->crossing, along, number - 1);
}

// Returns how many places beyond `along` the line goes on before it ends or is crossed.
static int distance_right(const Axis *axis, int along, int number) {
    const uint64_t line = bits_from(axis->line, along + 1, number);
    const uint64_t ends = crossings_from(axis, along + 1, number) | ~line;
    const int distance = ends ? __builtin_ctzll(ends) : 64;
    return distance < DIP_SMAA_STRAIGHT ? distance : DIP_SMAA_STRAIGHT;
}

static int distance_left(const Axis *axis, int along, int number) {
    const uint64_t line = bits_from(axis->line, along - 64, number);
    const uint64_t ends = crossings_from(axis, along - 63, number) | ~line;
    const int distance = ends ? __builtin_clzll(ends) : 64;
    return distance < DIP_SMAA_STRAIGHT ? distance : DIP_SMAA_STRAIGHT;
}

// Writes the shares of the pixel below the line and of the pixel above it.
static void straight_shares(const DipSmaaAreas *areas, const Axis *axis, int along, int number,
                            float shares[2]) {
    const int left = distance_left(axis, along, number);
    const int right = distance_right(axis, along, number);
    const int start = along - left;
    const int end = along + right + 1;
    const int pattern = crossing_at(axis, start, number) * DIP_SMAA_LEFT_BELOW +
                        crossing_at(axis, end, number) * DIP_SMAA_RIGHT_BELOW +
                        crossing_at(axis, start, number - 1) * DIP_SMAA_LEFT_ABOVE +
                        crossing_at(axis, end, number - 1) * DIP_SMAA_RIGHT_ABOVE;
    // Where a crossing edge goes on beyond the next pixel, it is a corner and no stair. The nearer
    // end counts; if both are as near, each counts half.
    const float corner = (1.0f - corner_rounding) / (float)((left <= right) + (right <= left));
    const float at_start = left <= right ? corner : 0.0f;
    const float at_end = right <= left ? corner : 0.0f;
    for (int side = 0; side < 2; side++) {
        const int beyond = side == 0 ? number + 1 : number - 2;
        const float keep = 1.0f - at_start * (float)crossing_at(axis, start, beyond) -
                           at_end * (float)crossing_at(axis, end, beyond);
        shares[side] = areas->straight[pattern][left][right][side] * (keep > 0.0f ? keep : 0.0f);
    }
}

// --- diagonals -----------------------------------------------------------------------------------

// The end of a diagonal: how many pixels away it is, whether the diagonal goes on there, and
// whether the last pixel has an edge at its top.
typedef struct DiagonalEnd {
    int distance;
    bool open;
    int top;
} DiagonalEnd;

// Follows a diagonal whose pixels have an edge at the top and one at the left, or, if left_of is 1,
// one at the left of the next pixel.
static DiagonalEnd follow(const DipPost *post, int x, int y, int step_x, int step_y, int left_of) {
    DiagonalEnd end = {.distance = -1, .open = true};
    while (end.distance < DIP_SMAA_DIAGONAL - 1 && end.open) {
        x += step_x;
        y += step_y;
        end.distance++;
        end.top = bit_at(&post->edges_top, x, y);
        end.open = end.top && bit_at(&post->edges_left, x + left_of, y);
    }
    return end;
}

static int edges_at_end(const DipPost *post, int top_x, int top_y, int left_x, int left_y) {
    return 2 * bit_at(&post->edges_top, top_x, top_y) + bit_at(&post->edges_left, left_x, left_y);
}

// Adds the shares of the pixel below the edge at the top of (x, y) and of the pixel above it, for
// the diagonals that go up to the right and those that go down to the right.
static void diagonal_shares(const DipPost *post, int x, int y, float shares[2]) {
    DiagonalEnd left = {0};
    if (bit_at(&post->edges_left, x, y)) {
        left = follow(post, x, y, -1, 1, 0);
        left.distance += left.top;
    }
    DiagonalEnd right = follow(post, x, y, 1, -1, 0);
    int l = left.distance;
    int r = right.distance;
    if (l + r > 2) {
        const int at_left = left.open ? 0 : edges_at_end(post, x - l - 1, y + l, x - l, y + l);
        const int at_right =
            right.open ? 0 : edges_at_end(post, x + r + 1, y - r, x + r + 1, y - r - 1);
        shares[0] += post->areas->diagonal[at_left][at_right][l][r][0];
        shares[1] += post->areas->diagonal[at_left][at_right][l][r][1];
    }
    left = follow(post, x, y, -1, -1, 1);
    right = (DiagonalEnd){0};
    if (bit_at(&post->edges_left, x + 1, y)) {
        right = follow(post, x, y, 1, 1, 1);
        right.distance += right.top;
    }
    l = left.distance;
    r = right.distance;
    if (l + r > 2) {
        const int at_left = left.open ? 0 : edges_at_end(post, x - l - 1, y - l, x - l, y - l - 1);
        const int at_right =
            right.open ? 0 : edges_at_end(post, x + r + 1, y + r, x + r + 1, y + r);
        shares[0] += post->areas->diagonal[at_left][at_right][l][r][1];
        shares[1] += post->areas->diagonal[at_left][at_right][l][r][0];
    }
}

// --- weights -------------------------------------------------------------------------------------

static uint32_t byte_of(float share) {
    return (uint32_t)(share * 255.0f + 0.5f);
}

static uint32_t weights_at(const DipPost *post, int x, int y) {
    float across_top[2] = {0.0f, 0.0f};
    float across_left[2] = {0.0f, 0.0f};
    bool left = bit_at(&post->edges_left, x, y);
    if (bit_at(&post->edges_top, x, y)) {
        const Axis axis = {&post->edges_top, &post->edges_left};
        diagonal_shares(post, x, y, across_top);
        if (across_top[0] + across_top[1] == 0.0f) {
            straight_shares(post->areas, &axis, x, y, across_top);
        } else {
            left = false; // A diagonal accounts for both edges.
        }
    }
    if (left) {
        const Axis axis = {&post->edges_left_by_y, &post->edges_top_by_y};
        straight_shares(post->areas, &axis, y, x, across_left);
    }
    return byte_of(across_top[0]) | byte_of(across_top[1]) << 8 | byte_of(across_left[0]) << 16 |
           byte_of(across_left[1]) << 24;
}

static void find_weights(void *context, int band, int worker) {
    DipPost *post = context;
    const int width = post->def.from_width;
    const int end = (band + 1) * DIP_POST_BAND;
    for (int y = band * DIP_POST_BAND; y < end && y < post->def.from_height; y++) {
        uint32_t *weights = post->weights + (size_t)y * ((size_t)width + 1);
        const uint64_t *left = post->edges_left.at + (ptrdiff_t)y * post->edges_left.stride;
        const uint64_t *top = post->edges_top.at + (ptrdiff_t)y * post->edges_top.stride;
        memset(weights, 0, (size_t)width * sizeof *weights);
        for (int word = 0; word < (width + 63) / 64; word++) {
            for (uint64_t bits = left[word] | top[word]; bits; bits &= bits - 1) {
                const int x = 64 * word + __builtin_ctzll(bits);
                weights[x] = weights_at(post, x, y);
                post->edges_found[worker]++;
            }
        }
    }
}

// -------------------------------------------------------------------------------------------------

static void blend(void *context, int band, int worker) {
    (void)worker;
    DipPost *post = context;
    const size_t stride = (size_t)post->def.from_width + 1;
    const int end = (band + 1) * DIP_POST_BAND;
    for (int y = band * DIP_POST_BAND; y < end && y < post->def.to_height; y++) {
        const DipSmaaRow row = {
            .weights = post->weights + (size_t)y * stride,
            .weights_below = post->weights + (size_t)(y + 1) * stride,
            .above = dip_post_row(post, y - 1),
            .row = dip_post_row(post, y),
            .below = dip_post_row(post, y + 1),
            .to = post->to + (size_t)y * post->to_stride_bytes,
            .width = post->def.to_width,
        };
        post->kernels->dip_kernel_smaa_row(&row);
    }
}

static void run(DipPost *post) {
    dip_post_fill_luma(post, luma_weights);
    dip_post_run_bands(post, post->def.from_height, find_edges);
    dip_pool_run(post->def.pool, (post->def.from_width + 63) / 64, transpose, post);
    dip_post_run_bands(post, post->def.from_height, find_weights);
    dip_post_run_bands(post, post->def.to_height, blend);
}

const DipPostKind dip_post_smaa = {take, prepare, run};
