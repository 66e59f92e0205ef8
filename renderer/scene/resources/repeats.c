// Finds large texture coordinates along which all textures of a surface repeat, mirrored or not.
#include "renderer/scene/resources/repeats.h"

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

uint32_t dip_scene_repeating_varyings(const DipSceneDef *def, const DipMeshDef *mesh,
                                      const DipSceneMesh *laid_out) {
    const DipMaterialDef *material = &def->materials[mesh->material];
    const DipSurfaceUniforms *layout = &laid_out->layout;
    const bool textured = layout->colour_varying != DIP_ABSENT;
    uint32_t varyings = 0;
    // The shader of a sky multiplies its coordinates by scales, so it does not repeat with them.
    for (int axis = 0; axis < 2 && !laid_out->sky; axis++) {
        // The colour texture and the normal map have the same coordinates, which come first.
        if ((textured || laid_out->normal_mapped) &&
            (!textured || repeats(def, material->colour_texture, axis)) &&
            (!laid_out->normal_mapped || repeats(def, material->normal_map, axis)) &&
            is_large(mesh->uv0, mesh->vertex_count, axis)) {
            varyings |= 1u << axis;
        }
        if (layout->light_map_varying != DIP_ABSENT && repeats(def, material->light_map, axis) &&
            is_large(mesh->uv1, mesh->vertex_count, axis)) {
            varyings |= 1u << (layout->light_map_varying + axis);
        }
    }
    return varyings;
}
