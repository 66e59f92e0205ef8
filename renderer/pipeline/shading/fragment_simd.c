// Interpolates the varyings of fragment batches, and encodes the colours of shaded batches. This
// file is compiled once per instruction set.
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/pipeline/shading/tile_shading.h"
#include "renderer/simd/quads.h"
#include "renderer/simd/srgb.h"

// If the fragments of a vector lie on at most this many triangles, the planes are read triangle by
// triangle. Otherwise they are read lane by lane.
enum { FEW_TRIANGLES = 2 };

enum { MAX_ROWS = DIP_PLANES_VARYINGS + 3 * DIP_MAX_VARYINGS + 3 };

// The planes of a vector of fragments (triangle.h): those of a few triangles, each with the lanes
// that it has, or floats that were read for each lane. Lanes that no triangle from number 1 on has
// belong to number 0.
typedef struct VaryingPlanes {
    int count; // number of triangles; 0: the floats were read for each lane
    const float *triangle[FEW_TRIANGLES];
    Mask lanes[FEW_TRIANGLES];
    const Vf *rows; // if count is 0: rows[i] has float i of each lane's triangle
} VaryingPlanes;

// The value of a plane at the fragments' positions, and its derivatives along x and y.
typedef struct Plane {
    Vf at;
    Vf dx;
    Vf dy;
} Plane;

VEC_INLINE const float *planes_of(const DipShadingInput *input, uint32_t triangle) {
    return input->planes + (size_t)triangle * (size_t)input->plane_stride;
}

// Finds the triangles of a vector. If there are more than a few, sets their number to 0.
VEC_INLINE void find_triangles(const DipShadingInput *input, const uint32_t *triangle,
                               VaryingPlanes *planes) {
    const Vi ids = vi_load((const int32_t *)triangle);
    unsigned left = mask_bits(vi_eq(ids, vi_splat((int32_t)triangle[0]))) ^ VEC_ALL_LANES;
    planes->triangle[0] = planes_of(input, triangle[0]);
    planes->count = 1;
    while (left && planes->count < FEW_TRIANGLES) {
        const uint32_t id = triangle[__builtin_ctz(left)];
        const Mask lanes = vi_eq(ids, vi_splat((int32_t)id));
        planes->triangle[planes->count] = planes_of(input, id);
        planes->lanes[planes->count++] = lanes;
        left &= ~mask_bits(lanes);
    }
    planes->count = left ? 0 : planes->count;
}

// Loads `count` floats of the planes of each lane's triangle. Planes are padded, so the quads that
// hold these floats may be read whole.
VEC_INLINE void load_rows(const DipShadingInput *input, const uint32_t *triangle, int count,
                          Vf *rows) {
    const uint32_t *planes = (const uint32_t *)(const void *)input->planes;
    _Alignas(64) int32_t offset[DIP_LANES];
    vi_store(offset, vi_load((const int32_t *)triangle) * input->plane_stride);
    for (int f = 0; f < count; f += 4) {
        Vu quads[4];
        for (int k = 0; k < 4; k++) {
            quads[k] = vu_load_quads(planes + f, 1, offset, k);
        }
        vf_split_quads(quads, rows + f);
    }
}

// Returns float i of each lane's planes. count: planes->count, as a constant.
VEC_INLINE Vf value_of(const VaryingPlanes *planes, int count, int i) {
    if (count == 0) {
        return planes->rows[i];
    }
    Vf value = vf_splat(planes->triangle[0][i]);
    for (int n = 1; n < count; n++) {
        value = vf_select(planes->lanes[n], vf_splat(planes->triangle[n][i]), value);
    }
    return value;
}

VEC_INLINE Plane plane_at(const VaryingPlanes *planes, int count, int i, Vf x, Vf y) {
    const Vf dx = value_of(planes, count, i + 1);
    const Vf dy = value_of(planes, count, i + 2);
    return (Plane){(value_of(planes, count, i) + dx * x) + dy * y, dx, dy};
}

// Returns one coordinate of a fragment's position, in pixels of the target. pixel: the pixel in the
// tile; sub: 1/256 pixel within it.
VEC_INLINE Vf target_coordinate(Vi pixel, Vi sub, int tile_first) {
    return vf_from_int((pixel + tile_first) << 8 | sub) * (1.0f / 256.0f);
}

// Interpolates varyings: u = (u/w) / (1/w). By the quotient rule, du/dx = (d(u/w)/dx - u d(1/w)/dx)
// / (1/w) is the exact derivative. The last value_only_count varyings get no derivatives. count:
// planes->count, as a constant.
VEC_INLINE void interpolate(const VaryingPlanes *planes, int count, Vf x, Vf y, int varying_count,
                            int value_only_count, int i, DipFragmentBatch *batch) {
    const Vf from_x = x - value_of(planes, count, DIP_PLANES_ANCHOR);
    const Vf from_y = y - value_of(planes, count, DIP_PLANES_ANCHOR + 1);
    const Plane q = plane_at(planes, count, DIP_PLANES_RW, from_x, from_y);
    const Vf w = vf_splat(1.0f) / q.at;
    const int gradient_count = varying_count - value_only_count;
    for (int s = gradient_count; s < varying_count; s++) {
        const Plane over_w = plane_at(planes, count, DIP_PLANES_VARYINGS + 3 * s, from_x, from_y);
        vf_store(batch->varying[s] + i, over_w.at * w);
    }
    for (int s = 0; s < gradient_count; s++) {
        const Plane over_w = plane_at(planes, count, DIP_PLANES_VARYINGS + 3 * s, from_x, from_y);
        const Vf value = over_w.at * w;
        vf_store(batch->varying[s] + i, value);
        vf_store(batch->varying_dx[s] + i, (over_w.dx - value * q.dx) * w);
        vf_store(batch->varying_dy[s] + i, (over_w.dy - value * q.dy) * w);
    }
}

void DIP_KERNEL(dip_kernel_interpolate)(const DipShadingInput *input, const DipFragmentList *list,
                                        int varying_count, int value_only_count,
                                        DipFragmentBatch *batch) {
    batch->count = list->count < DIP_FRAGMENT_BATCH ? list->count : DIP_FRAGMENT_BATCH;
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        const Vi position = vi_load((const int32_t *)list->position + i);
        const Vf x = target_coordinate(position & (DIP_TILE - 1),
                                       position >> DIP_POSITION_SUB_X & 255, input->x0);
        const Vf y = target_coordinate(position >> DIP_POSITION_Y & (DIP_TILE - 1),
                                       position >> DIP_POSITION_SUB_Y & 255, input->y0);
        vf_store(batch->x + i, x);
        vf_store(batch->y + i, y);
        if (varying_count == 0) {
            continue;
        }
        VaryingPlanes planes;
        find_triangles(input, list->triangle + i, &planes);
        if (planes.count == 1) {
            interpolate(&planes, 1, x, y, varying_count, value_only_count, i, batch);
        } else if (planes.count == 2) {
            interpolate(&planes, 2, x, y, varying_count, value_only_count, i, batch);
        } else {
            Vf rows[MAX_ROWS];
            planes.rows = rows;
            load_rows(input, list->triangle + i, dip_plane_floats(varying_count), rows);
            interpolate(&planes, 0, x, y, varying_count, value_only_count, i, batch);
        }
    }
}

void DIP_KERNEL(dip_kernel_encode)(const DipFragmentBatch *batch, const DipSrgbEncodeTable *srgb,
                                   DipEncodedBatch *out) {
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        Vu rgba8 = vu_splat(0xff000000u);
        for (int c = 0; c < 3; c++) {
            // vf_max is called before vf_min, so that a NaN becomes 0.
            const Vf colour = vf_max(vf_load(batch->colour[c] + i), vf_splat(0.0f));
            const Vf scaled = vf_min(colour, vf_splat(1.0f)) * 65535.0f + 0.5f;
            const Vi linear16 = vi_from_float(scaled);
            vi_store(out->linear16[c] + i, linear16);
            if (srgb) {
                rgba8 |= vu_srgb_codes(srgb, linear16) << (8 * c);
            }
        }
        vu_store(out->rgba8 + i, rgba8);
    }
}
