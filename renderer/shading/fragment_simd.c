// Fragment batches: varyings in, encoded colours out, compiled once per instruction set.
#include "renderer/raster/kernels.h"
#include "renderer/simd/vec.h"

// One plane of a surface at the fragments' places: value, d/dx, d/dy.
typedef struct Plane {
    Vf at;
    Vf dx;
    Vf dy;
} Plane;

// Up to this many triangles of a vector are read one by one; more are gathered lane by lane.
enum { FEW_TRIANGLES = 8 };

// The floats of a vector of fragments' surfaces, float i of each lane's at values[i].
typedef struct SurfaceRows {
    Vf values[DIP_SURFACE_SLOTS + 3 * DIP_MAX_SLOTS];
} SurfaceRows;

VEC_INLINE const float *surface_of(const DipShadingInput *input, uint32_t triangle) {
    return input->surfaces + input->triangles[triangle].surface;
}

// One triangle in all lanes: its floats are spread. A few: the lanes of each are blended in, which
// costs less than a gather per float.
VEC_INLINE void read_surfaces(const DipShadingInput *input, const uint32_t *triangle, int count,
                              SurfaceRows *rows) {
    const Vi ids = vi_load((const int32_t *)triangle);
    const float *first = surface_of(input, triangle[0]);
    unsigned left = mask_bits(vi_eq(ids, vi_splat(ids[0]))) ^ VEC_ALL_LANES;
    for (int f = 0; f < count; f++) {
        rows->values[f] = vf_splat(first[f]);
    }
    for (int n = 1; left && n < FEW_TRIANGLES; n++) {
        const uint32_t id = triangle[__builtin_ctz(left)];
        const Mask lanes = vi_eq(ids, vi_splat((int32_t)id));
        const float *surface = surface_of(input, id);
        for (int f = 0; f < count; f++) {
            rows->values[f] = vf_select(lanes, vf_splat(surface[f]), rows->values[f]);
        }
        left &= ~mask_bits(lanes);
    }
    if (left) {
        int32_t offset[DIP_LANES];
        for (int i = 0; i < DIP_LANES; i++) {
            offset[i] = (int32_t)input->triangles[triangle[i]].surface;
        }
        for (int f = 0; f < count; f++) {
            rows->values[f] = vf_gather(input->surfaces + f, vi_load(offset));
        }
    }
}

VEC_INLINE Plane plane_at(const SurfaceRows *rows, int i, Vf x, Vf y) {
    const Vf dx = rows->values[i + 1];
    const Vf dy = rows->values[i + 2];
    return (Plane){(rows->values[i] + dx * x) + dy * y, dx, dy};
}

// A place's pixel coordinate in 1/256 pixel of the tile, to pixels in the target.
VEC_INLINE Vf target_coordinate(Vi pixel, Vi sub, int tile_first) {
    return vf_from_int((pixel + tile_first) << 8 | sub) * (1.0f / 256.0f);
}

// u = (u/w) / (1/w); du/dx = (d(u/w)/dx - u d(1/w)/dx) / (1/w): exact, by the quotient rule.
void DIP_KERNEL(dip_kernel_interpolate)(const DipShadingInput *input, const DipFragmentList *list,
                                        int slot_count, DipFragmentBatch *batch) {
    batch->count = list->count < DIP_FRAGMENT_BATCH ? list->count : DIP_FRAGMENT_BATCH;
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        SurfaceRows rows;
        read_surfaces(input, list->triangle + i, dip_surface_floats(slot_count), &rows);
        const Vi place = vi_load((const int32_t *)list->place + i);
        const Vf x =
            target_coordinate(place & (DIP_TILE - 1), place >> DIP_PLACE_SUB_X & 255, input->x0);
        const Vf y = target_coordinate(place >> DIP_PLACE_Y & (DIP_TILE - 1),
                                       place >> DIP_PLACE_SUB_Y & 255, input->y0);
        const Vf from_x = x - rows.values[DIP_SURFACE_ANCHOR];
        const Vf from_y = y - rows.values[DIP_SURFACE_ANCHOR + 1];
        const Plane q = plane_at(&rows, DIP_SURFACE_RW, from_x, from_y);
        const Vf w = vf_splat(1.0f) / q.at;
        vf_store(batch->x + i, x);
        vf_store(batch->y + i, y);
        for (int s = 0; s < slot_count; s++) {
            const Plane over_w = plane_at(&rows, DIP_SURFACE_SLOTS + 3 * s, from_x, from_y);
            const Vf value = over_w.at * w;
            vf_store(batch->slot[s] + i, value);
            vf_store(batch->slot_dx[s] + i, (over_w.dx - value * q.dx) * w);
            vf_store(batch->slot_dy[s] + i, (over_w.dy - value * q.dy) * w);
        }
    }
}

void DIP_KERNEL(dip_kernel_encode)(const DipFragmentBatch *batch, const uint8_t *srgb_code,
                                   DipEncodedBatch *out) {
    for (int i = 0; i < batch->count; i += DIP_LANES) {
        Vu rgba8 = vu_splat(0xff000000u);
        for (int c = 0; c < 3; c++) {
            // max first: a NaN becomes 0.
            const Vf colour = vf_max(vf_load(batch->colour[c] + i), vf_splat(0.0f));
            const Vf scaled = vf_min(colour, vf_splat(1.0f)) * 65535.0f + 0.5f;
            const Vi linear16 = vi_from_float(scaled);
            vi_store(out->linear16[c] + i, linear16);
            rgba8 |= (vu_gather_bytes(srgb_code, linear16) & 0xffu) << (8 * c);
        }
        vu_store(out->rgba8 + i, rgba8);
    }
}
