// Finds large texture coordinates along which all textures of a surface repeat, mirrored or not.
#include "renderer/scene/resources/repeats.h"

#include <float.h>

// Coordinates within +- this number are not reduced: set-up subtracts multiples of 64, and the
// multiple nearest to these coordinates is 0.
#define LARGE 32.0f

static bool repeats(const DipSceneDef *def, int texture, int axis) {
    const DipTextureDef *picture = &def->textures[texture];
    const DipWrap wrap = axis ? picture->wrap_v : picture->wrap_u;
    return wrap == DIP_WRAP_REPEAT || wrap == DIP_WRAP_MIRROR;
}

static bool is_large(const float *uv, uint32_t vertex_count, int axis) {
    for (uint32_t v = 0; v < vertex_count; v++) {
        const float at = uv[2 * (size_t)v + (size_t)axis];
        if (!(at > -LARGE && at < LARGE)) {
            return true;
        }
    }
    return false;
}

// The textures of a mesh that are read at one set of texture coordinates.
typedef struct Readers {
    int textures[5];
    int count;
} Readers;

static void add_reader(Readers *readers, bool reads, int texture) {
    if (reads) {
        readers->textures[readers->count++] = texture;
    }
}

// Finds the textures that a mesh reads at uv0 (set 0) or uv1 (set 1).
static Readers find_readers(const DipMaterialDef *material, const DipSceneMesh *mesh, int set) {
    const DipSurfaceUniforms *layout = &mesh->layout;
    Readers readers = {.count = 0};
    add_reader(&readers, set == 0 && layout->colour_varying != DIP_ABSENT,
               material->colour_texture);
    add_reader(&readers, set == 0 && mesh->normal_mapped, material->normal_map);
    add_reader(&readers, set == 1 && layout->light_map_varying != DIP_ABSENT, material->light_map);
    if (mesh->pbr && mesh->uv_varyings[set] != DIP_ABSENT) {
        const DipPbrMaps maps = dip_pbr_maps(material);
        add_reader(&readers, set == 0 && maps.metal_rough != DIP_NO_TEXTURE, maps.metal_rough);
        add_reader(&readers,
                   maps.occlusion != DIP_NO_TEXTURE && material->pbr->occlusion_at_uv1 == set,
                   maps.occlusion);
        add_reader(&readers,
                   maps.emission != DIP_NO_TEXTURE && material->pbr->emission_at_uv1 == set,
                   maps.emission);
    }
    return readers;
}

static bool all_repeat(const DipSceneDef *def, const Readers *readers, int axis) {
    bool all = readers->count > 0;
    for (int i = 0; i < readers->count; i++) {
        all = all && repeats(def, readers->textures[i], axis);
    }
    return all;
}

uint32_t dip_scene_repeating_varyings(const DipSceneDef *def, const DipMeshDef *mesh,
                                      const DipSceneMesh *laid_out) {
    const DipMaterialDef *material = &def->materials[mesh->material];
    const float *const sets[2] = {mesh->uv0, mesh->uv1};
    uint32_t varyings = 0;
    // The shader of a sky multiplies its coordinates by scales, so it does not repeat with them.
    for (int set = laid_out->sky ? 1 : 0; set < 2; set++) {
        const Readers readers = find_readers(material, laid_out, set);
        for (int axis = 0; axis < 2 && readers.count; axis++) {
            if (all_repeat(def, &readers, axis) && is_large(sets[set], mesh->vertex_count, axis)) {
                varyings |= 1u << (laid_out->uv_varyings[set] + axis);
            }
        }
    }
    return varyings;
}

void dip_scene_bound_coordinates(const DipSceneDef *def, const DipMeshDef *mesh,
                                 DipSceneMesh *laid_out) {
    const Readers readers = find_readers(&def->materials[mesh->material], laid_out, 0);
    for (int axis = 0; axis < 2; axis++) {
        laid_out->full_layout.coordinate_bounds[axis] =
            all_repeat(def, &readers, axis) ? 1.0f : FLT_MAX;
    }
}
