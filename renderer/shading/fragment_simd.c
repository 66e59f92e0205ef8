// Fragment batches: varyings in, encoded colours out, compiled once per instruction set.
#include "renderer/raster/kernels.h"
#include "renderer/simd/vec.h"

// One plane of a surface at the fragments' places: value, d/dx, d/dy.
typedef struct Plane {
    Vf at;
    Vf dx;
    Vf dy;
} Plane;

// Surface floats of a vector of fragments: one triangle's, or one per lane.
typedef struct SurfaceReader {
    const float *uniform; // NULL when the lanes differ
    const float *base;
    Vi offset;
} SurfaceReader;

VEC_INLINE Vf read_surface(const SurfaceReader *reader, int i) {
    return reader->uniform ? vf_splat(reader->uniform[i])
                           : vf_gather(reader->base, reader->offset + i);
}

VEC_INLINE Plane read_plane(const SurfaceReader *reader, int i, Vf x, Vf y) {
    Plane plane;
    plane.dx = read_surface(reader, i + 1);
    plane.dy = read_surface(reader, i + 2);
    plane.at = (read_surface(reader, i) + plane.dx * x) + plane.dy * y;
    return plane;
}

VEC_INLINE SurfaceReader surface_reader(const DipShadingInput *input, const uint32_t *triangle) {
    SurfaceReader reader = {.base = input->surfaces};
    if (vi_uniform(vi_load((const int32_t *)triangle))) {
        reader.uniform = input->surfaces + input->triangles[triangle[0]].surface;
        return reader;
    }
    int32_t offset[DIP_LANES];
    for (int i = 0; i < DIP_LANES; i++) {
        offset[i] = (int32_t)input->triangles[triangle[i]].surface;
    }
    reader.offset = vi_load(offset);
    return reader;
}

// u = (u/w) / (1/w); du/dx = (d(u/w)/dx - u d(1/w)/dx) / (1/w): exact, by the quotient rule.
void DIP_KERNEL(dip_kernel_interpolate)(const DipShadingInput *input, const DipFragmentList *list,
                                        int slot_count, DipFragmentBatch *batch) {
    batch->count = list->count;
    for (int i = 0; i < list->count; i += DIP_LANES) {
        const SurfaceReader reader = surface_reader(input, list->triangle + i);
        const Vf x = vf_load(list->x + i);
        const Vf y = vf_load(list->y + i);
        const Vf from_x = x - read_surface(&reader, DIP_SURFACE_ANCHOR);
        const Vf from_y = y - read_surface(&reader, DIP_SURFACE_ANCHOR + 1);
        const Plane q = read_plane(&reader, DIP_SURFACE_RW, from_x, from_y);
        const Vf w = vf_splat(1.0f) / q.at;
        vf_store(batch->x + i, x);
        vf_store(batch->y + i, y);
        for (int s = 0; s < slot_count; s++) {
            const Plane over_w = read_plane(&reader, DIP_SURFACE_SLOTS + 3 * s, from_x, from_y);
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
