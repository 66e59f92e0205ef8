// One triangle in one tile: its edges and depths, and the regions and sub-blocks of the tile that
// it reaches. Only kernels (*_simd.c) include this header.
//
// Edge values E = a x + b y + c (x, y in 1/256 pixel) need 64 bits. Within a tile, a position is
// split into a pixel and a sample within the pixel: x = 256 px + sx, y = 256 py + sy. Let c' be E
// at the tile's corner. Then E = 256 (a px + b py) + c' + a sx + b sy. The first term is a multiple
// of 256, so E >= 0 if and only if a px + b py + floor((c' + a sx + b sy) / 256) >= 0. In this sum,
// |a px + b py| is below 2^30. If the edge crosses the tile, the magnitude of the floor is below
// 2^30 too. If |c' / 256| is larger, the sign of c' alone decides, so c' / 256 is clamped to
// +-2^30. The inner loops are therefore exact in 32 bits.
//
// A triangle is set up once per tile (InTile). Its pixel box is then drawn region by region
// (Region). A region has 4x4 sub-blocks, and a sub-block has 4x4 pixels. One vector operation per
// edge finds which of a region's sixteen sub-blocks may hold covered samples, and which lie wholly
// inside the triangle. Only the sub-blocks that may hold covered samples are drawn.
#ifndef DIP_RENDERER_PIPELINE_RASTER_IN_TILE_SIMD_H
#define DIP_RENDERER_PIPELINE_RASTER_IN_TILE_SIMD_H

#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/pipeline/raster/fragments.h"
#include "renderer/pipeline/raster/tile.h"
#include "renderer/pipeline/raster/triangle.h"
#include "renderer/simd/vec.h"

enum {
    VECTORS = DIP_SUB_BLOCK_PIXELS / DIP_LANES, // number of vectors per sub-block, and per region
    REGION = 4,                                 // number of sub-blocks along a region's side
    REGION_SUB_BLOCKS = REGION * REGION,
};

// Columns and rows of a 4x4 grid in lane order. The grid is the pixels of a sub-block or the
// sub-blocks of a region.
static const int32_t lane_x[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
static const int32_t lane_y[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};

// One edge within the tile. All values are edge values divided by 256.
typedef struct Edge {
    int32_t a;
    int32_t b;
    int32_t corner; // value at sample 0 of the tile's first pixel
    // Bounds of the values at a sub-block's samples, relative to the value at sample 0 of the
    // sub-block's first pixel.
    int32_t greatest;
    int32_t least;
    Vi lane[VECTORS];                // a px + b py at the pixels of a sub-block
    int32_t sample[DIP_SAMPLE_ROOM]; // value at each sample, relative to the value at sample 0
} Edge;

// The depths of one triangle.
typedef struct Depths {
    Vf lane[VECTORS]; // at the pixels of a sub-block, relative to its corner
    Vf min;
    Vf max;
    float sample[DIP_SAMPLE_ROOM]; // at each sample, relative to the pixel's corner
} Depths;

// One triangle within the tile.
typedef struct InTile {
    uint32_t draw; // the triangle's draw
    Edge edge[3];
    Depths depths;
} InTile;

// Sixteen sub-blocks of the tile. Arrays and bits are in lane order.
typedef struct Region {
    int x; // column and row of the first sub-block, counted in sub-blocks of the tile
    int y;
    unsigned reached;                   // sub-blocks that may hold covered samples
    unsigned inside;                    // sub-blocks that lie wholly inside the triangle
    int32_t edge[3][REGION_SUB_BLOCKS]; // edge values at sample 0 of the sub-blocks' first pixels
    float depth[REGION_SUB_BLOCKS];     // depths at the sub-blocks' corners
} Region;

VEC_INLINE int min_int(int a, int b) {
    return a < b ? a : b;
}

VEC_INLINE int max_int(int a, int b) {
    return a > b ? a : b;
}

VEC_INLINE int64_t min_i64(int64_t a, int64_t b) {
    return a < b ? a : b;
}

VEC_INLINE int64_t max_i64(int64_t a, int64_t b) {
    return a > b ? a : b;
}

// --- set-up ------------------------------------------------------------------------------------

// Sets edge->sample: floor((c + a sx + b sy) / 256) of every sample, relative to sample 0. Each
// factor is split at bit 8, so that 16-bit products are enough and nothing overflows.
VEC_INLINE void set_samples(Edge *edge, int64_t c, const DipSamplePattern *pattern) {
    const int32_t high =
        (int32_t)((uint32_t)(edge->a >> 8) & 0xffff) | (int32_t)((uint32_t)(edge->b >> 8) << 16);
    const int32_t low = (edge->a & 255) | (edge->b & 255) << 16;
    const int32_t rest = (int32_t)(c & 255);
    const int32_t whole = (int32_t)(c >> 8) - edge->corner;
    for (int s = 0; s < pattern->count; s += DIP_LANES) {
        const Vi at = vi_load_bytes(pattern->x + s) | vi_load_bytes(pattern->y + s) << 16;
        const Vi fraction = (vi_dot16(vi_splat(low), at) + vi_splat(rest)) >> 8;
        vi_store(edge->sample + s, vi_dot16(vi_splat(high), at) + vi_splat(whole) + fraction);
    }
}

VEC_INLINE void set_edge(InTile *in, int i, const DipTriangle *triangle, const DipTile *tile) {
    enum { SPAN = (DIP_SUB_BLOCK - 1) * DIP_SUBPIXELS };
    const int64_t limit = (int64_t)1 << 38;
    const DipSamplePattern *pattern = tile->pattern;
    const int64_t a = triangle->a[i];
    const int64_t b = triangle->b[i];
    const int64_t at_tile = triangle->c[i] + (a * tile->x0 + b * tile->y0) * DIP_SUBPIXELS;
    const int64_t c = max_i64(min_i64(at_tile, limit), -limit);
    Edge *edge = &in->edge[i];
    edge->a = triangle->a[i];
    edge->b = triangle->b[i];
    edge->corner = (int32_t)((c + a * pattern->x[0] + b * pattern->y[0]) >> 8);
    // The samples of a sub-block lie within first..last in x and in y.
    const int first = pattern->least;
    const int last = SPAN + pattern->greatest;
    const int64_t most = max_i64(a * first, a * last) + max_i64(b * first, b * last);
    const int64_t least = min_i64(a * first, a * last) + min_i64(b * first, b * last);
    edge->greatest = (int32_t)((c + most) >> 8) - edge->corner;
    edge->least = (int32_t)((c + least) >> 8) - edge->corner;
    const Vi lanes = vi_splat(edge->a) * vi_load(lane_x) + vi_splat(edge->b) * vi_load(lane_y);
    for (int v = 0; v < VECTORS; v++) {
        const int first_lane = v * DIP_LANES;
        edge->lane[v] =
            lanes + vi_splat(edge->a * lane_x[first_lane] + edge->b * lane_y[first_lane]);
    }
    if (pattern->count > 1) {
        set_samples(edge, c, pattern);
    }
}

VEC_INLINE void set_depths(Depths *depths, const DipTriangle *triangle,
                           const DipSamplePattern *pattern) {
    const float dx = (float)triangle->z_dx;
    const float dy = (float)triangle->z_dy;
    depths->min = vf_splat(triangle->z_min);
    depths->max = vf_splat(triangle->z_max);
    for (int v = 0; v < VECTORS; v++) {
        depths->lane[v] = vf_splat(dx) * vf_from_int(vi_load(lane_x + v * DIP_LANES)) +
                          vf_splat(dy) * vf_from_int(vi_load(lane_y + v * DIP_LANES));
    }
    for (int s = 0; s < pattern->count; s += DIP_LANES) {
        const Vf x = vf_from_int(vi_load_bytes(pattern->x + s)) * (1.0f / 256.0f);
        const Vf y = vf_from_int(vi_load_bytes(pattern->y + s)) * (1.0f / 256.0f);
        vf_store(depths->sample + s, vf_splat(dx) * x + vf_splat(dy) * y);
    }
}

// --- regions -----------------------------------------------------------------------------------

// The sub-blocks that the triangle's pixel box reaches in the drawn part of the tile: columns
// x0..x1 and rows y0..y1.
typedef struct Box {
    int x0, y0, x1, y1;
} Box;

// Returns the sub-block of a pixel along one axis. The pixel is not negative, which saves the
// rounding of negative quotients.
VEC_INLINE int sub_block_of(int pixel) {
    return (int)((unsigned)pixel / DIP_SUB_BLOCK);
}

VEC_INLINE Box box_of(const DipTriangle *triangle, const DipTile *tile) {
    return (Box){
        sub_block_of(max_int(triangle->x0 - tile->x0, tile->left)),
        sub_block_of(max_int(triangle->y0 - tile->y0, tile->top)),
        sub_block_of(min_int(triangle->x1 - tile->x0, DIP_TILE - 1 - tile->right)),
        sub_block_of(min_int(triangle->y1 - tile->y0, DIP_TILE - 1 - tile->bottom)),
    };
}

// Returns the bits of the region's sub-blocks in columns x0..x1 and rows y0..y1 of the tile.
VEC_INLINE unsigned box_bits(const Region *region, int x0, int y0, int x1, int y1) {
    const unsigned column = (2u << (x1 - region->x)) - (1u << (x0 - region->x));
    const unsigned rows = (16u << 4 * (y1 - region->y)) - (1u << 4 * (y0 - region->y));
    return column * 0x1111u & rows;
}

// Sets `edge`, `reached` and `inside` of a region. `reached` and `inside` consider only the edges;
// the caller restricts them to the triangle's pixel box.
VEC_INLINE void classify(const InTile *in, Region *region) {
    int32_t corner[3];
    for (int i = 0; i < 3; i++) {
        corner[i] = in->edge[i].a * (region->x * DIP_SUB_BLOCK) +
                    in->edge[i].b * (region->y * DIP_SUB_BLOCK) + in->edge[i].corner;
    }
    region->reached = 0;
    region->inside = 0;
    for (int v = 0; v < VECTORS; v++) {
        Vi greatest = vi_splat(0);
        Vi least = vi_splat(0);
        for (int i = 0; i < 3; i++) {
            const Vi at = in->edge[i].lane[v] * DIP_SUB_BLOCK + vi_splat(corner[i]);
            vi_store(region->edge[i] + v * DIP_LANES, at);
            greatest |= at + vi_splat(in->edge[i].greatest);
            least |= at + vi_splat(in->edge[i].least);
        }
        region->reached |= mask_bits(vi_not_negative(greatest)) << (v * DIP_LANES);
        region->inside |= mask_bits(vi_not_negative(least)) << (v * DIP_LANES);
    }
}

// Sets the depth at the corners of a region's sub-blocks. The depth is computed in double precision
// from positions in the target, so that it does not depend on the tile.
VEC_INLINE void set_corner_depths(Region *region, const DipTriangle *triangle,
                                  const DipTile *tile) {
    typedef double Row __attribute__((vector_size(REGION * sizeof(double))));
    typedef float RowDepth __attribute__((vector_size(REGION * sizeof(float))));
    const double x = tile->x0 + region->x * DIP_SUB_BLOCK;
    const double y = tile->y0 + region->y * DIP_SUB_BLOCK;
    const Row columns = {x, x + 4.0, x + 8.0, x + 12.0};
    const Row at_columns = triangle->z_origin + triangle->z_dx * columns;
    for (int row = 0; row < REGION; row++) {
        const Row at = at_columns + triangle->z_dy * (y + row * DIP_SUB_BLOCK);
        const RowDepth depth = __builtin_convertvector(at, RowDepth);
        memcpy(region->depth + row * REGION, &depth, sizeof depth);
    }
}

// --- sub-blocks --------------------------------------------------------------------------------

VEC_INLINE void clear_block(DipTile *tile, int block, int sample_count) {
    const int count = sample_count * DIP_BLOCK_PIXELS;
    float *const depth = tile->depth + block * count;
    int32_t *const id = (int32_t *)tile->id + block * count;
    for (int i = 0; i < count; i += DIP_LANES) {
        vf_store(depth + i, vf_splat(0.0f));
        vi_store(id + i, vi_splat(0));
    }
    tile->touched |= (uint64_t)1 << block;
}

// Returns the number of sub-block n of a region in the tile (dip_sub_block_number).
VEC_INLINE unsigned number_of(const Region *region, unsigned n) {
    const unsigned x = (unsigned)region->x + n % REGION;
    const unsigned y = (unsigned)region->y + n / REGION;
    return (y / 2 * DIP_TILE_BLOCKS + x / 2) * 4 + y % 2 * 2 + x % 2;
}

// Returns the index of a sub-block's first value in the tile's arrays. If this is the first use of
// the 8x8 block that the sub-block lies in, the function first clears the block.
VEC_INLINE int touch_sub_block(DipTile *tile, unsigned number, int sample_count) {
    const unsigned block = number / 4;
    if (!(tile->touched >> block & 1)) {
        clear_block(tile, (int)block, sample_count);
    }
    return (int)(block * (unsigned)sample_count * DIP_BLOCK_PIXELS +
                 number % 4 * DIP_SUB_BLOCK_PIXELS);
}

// One vector of edge values at sample 0 of DIP_LANES pixels of a sub-block.
typedef struct PixelEdges {
    Vi at[3];
} PixelEdges;

VEC_INLINE PixelEdges pixel_edges(const InTile *in, const Region *region, int n, int v) {
    PixelEdges edges;
    for (int i = 0; i < 3; i++) {
        edges.at[i] = in->edge[i].lane[v] + vi_splat(region->edge[i][n]);
    }
    return edges;
}

// Returns the lanes whose sample s the triangle covers.
VEC_INLINE Mask covered_lanes(const InTile *in, const PixelEdges *edges, int s, int sample_count) {
    if (sample_count == 1) {
        return vi_not_negative(edges->at[0] | edges->at[1] | edges->at[2]);
    }
    return vi_not_negative((edges->at[0] + vi_splat(in->edge[0].sample[s])) |
                           (edges->at[1] + vi_splat(in->edge[1].sample[s])) |
                           (edges->at[2] + vi_splat(in->edge[2].sample[s])));
}

// Returns the depth at sample s in each lane of vector v.
VEC_INLINE Vf depth_lanes(const Depths *depths, float corner, int v, int s) {
    const Vf depth = (vf_splat(corner) + depths->lane[v]) + vf_splat(depths->sample[s]);
    return vf_min(vf_max(depth, depths->min), depths->max);
}

// Encodes a point within a pixel as part of a fragment's position (tile_shading.h).
VEC_INLINE Vi sub_position(int sub_x, int sub_y) {
    return vi_splat(sub_x << DIP_POSITION_SUB_X | sub_y << DIP_POSITION_SUB_Y);
}

// Prepares a triangle for a tile.
VEC_INLINE void set_up_in_tile(InTile *in, const DipTriangle *triangle, const DipTile *tile) {
    in->draw = triangle->draw;
    for (int i = 0; i < 3; i++) {
        set_edge(in, i, triangle, tile);
    }
    set_depths(&in->depths, triangle, tile->pattern);
}

// Fills in the region of the tile whose first sub-block is (x, y), counted in sub-blocks, as far as
// the triangle's box reaches into it. Returns false if the triangle reaches none of its sub-blocks.
VEC_INLINE bool region_at(const InTile *in, const DipTriangle *triangle, const DipTile *tile,
                          const Box *box, int x, int y, Region *region) {
    region->x = min_int(x, DIP_TILE_SUB_BLOCKS - REGION);
    region->y = min_int(y, DIP_TILE_SUB_BLOCKS - REGION);
    classify(in, region);
    region->reached &=
        box_bits(region, x, y, min_int(x + REGION - 1, box->x1), min_int(y + REGION - 1, box->y1));
    region->inside &= region->reached;
    if (!region->reached) {
        return false;
    }
    set_corner_depths(region, triangle, tile);
    return true;
}

VEC_INLINE uint64_t sub_blocks_in(const Box *box) {
    return (uint64_t)((box->x1 - box->x0 + 1) * (box->y1 - box->y0 + 1));
}

#endif
