// Keeps what metallic-roughness surfaces need for a scene, and the numbers of each surface.
#include "renderer/scene/resources/pbr.h"

#include "renderer/scene/materials/surface.h"

#include <stdlib.h>
#include <string.h>

static bool may_have_pbr(const DipMaterialDef *material) {
    return material->pbr && material->lit && dip_surface_is_solid(material->surface);
}

bool dip_mesh_has_pbr(const DipSceneDef *def, const DipMeshDef *mesh) {
    const DipMaterialDef *material = &def->materials[mesh->material];
    const bool light_mapped = material->light_map != DIP_NO_TEXTURE && mesh->uv1;
    return may_have_pbr(material) && mesh->normals && !light_mapped;
}

static bool has_sheen(const DipPbrDef *pbr) {
    return pbr->sheen_lin[0] > 0.0f || pbr->sheen_lin[1] > 0.0f || pbr->sheen_lin[2] > 0.0f;
}

// Finds out whether some mesh has a metallic-roughness surface, and one with a sheen.
static void find_parts(const DipSceneDef *def, bool *any, bool *sheen) {
    *any = *sheen = false;
    for (int i = 0; i < def->mesh_count; i++) {
        const DipMeshDef *mesh = &def->meshes[i];
        if (dip_mesh_has_pbr(def, mesh)) {
            *any = true;
            *sheen = *sheen || has_sheen(def->materials[mesh->material].pbr);
        }
    }
}

bool dip_scene_pbr_create(const DipSceneDef *def, DipPool *pool, DipScenePbr **out, DipError *err) {
    // An environment lights surfaces by itself.
    static const DipLightingDef nothing = {.light_count = 0};
    bool any;
    bool sheen;
    *out = NULL;
    find_parts(def, &any, &sheen);
    if (!any) {
        return true;
    }
    DipScenePbr *pbr = calloc(1, sizeof *pbr + (size_t)def->mesh_count * sizeof *pbr->surfaces);
    if (pbr && !def->lighting) {
        pbr->fixed = dip_scene_lighting_create(def->environment ? &nothing : dip_lighting_fixed());
    }
    if (pbr && def->environment) {
        pbr->environment = dip_environment_map_create(def->environment, pool);
    }
    if (pbr && sheen) {
        pbr->sheens = calloc((size_t)def->mesh_count, sizeof *pbr->sheens);
    }
    if (!pbr || (!def->lighting && !pbr->fixed) || (def->environment && !pbr->environment) ||
        (sheen && !pbr->sheens)) {
        dip_scene_pbr_destroy(&pbr);
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "scene", "out of memory");
    }
    *out = pbr;
    return true;
}

void dip_scene_pbr_destroy(DipScenePbr **pbr) {
    if (*pbr) {
        free((*pbr)->fixed);
        free((*pbr)->environment);
        free((*pbr)->sheens);
    }
    free(*pbr);
    *pbr = NULL;
}

static bool emits(const DipPbrDef *pbr) {
    return pbr->emission_lin[0] > 0.0f || pbr->emission_lin[1] > 0.0f ||
           pbr->emission_lin[2] > 0.0f;
}

static bool occludes(const DipPbrDef *pbr) {
    return pbr->occlusion_map != DIP_NO_TEXTURE && pbr->occlusion_strength > 0.0f;
}

static bool shows_emission(const DipPbrDef *pbr) {
    return pbr->emission_map != DIP_NO_TEXTURE && emits(pbr);
}

DipPbrMaps dip_pbr_maps(const DipMaterialDef *material) {
    const DipPbrDef *pbr = material->pbr;
    DipPbrMaps maps = {DIP_NO_TEXTURE, DIP_NO_TEXTURE, DIP_NO_TEXTURE};
    if (may_have_pbr(material)) {
        maps.metal_rough = pbr->metal_rough_map;
        maps.occlusion = occludes(pbr) ? pbr->occlusion_map : DIP_NO_TEXTURE;
        maps.emission = shows_emission(pbr) ? pbr->emission_map : DIP_NO_TEXTURE;
    }
    return maps;
}

bool dip_pbr_uses_set(const DipMaterialDef *material, int set) {
    const DipPbrDef *pbr = material->pbr;
    return (set == 0 && pbr->metal_rough_map != DIP_NO_TEXTURE) ||
           (occludes(pbr) && pbr->occlusion_at_uv1 == (set == 1)) ||
           (shows_emission(pbr) && pbr->emission_at_uv1 == (set == 1));
}

DipPbrUniforms dip_pbr_surface(const DipSceneDef *def, const DipMeshDef *mesh, int uv0, int uv1) {
    const DipMaterialDef *material = &def->materials[mesh->material];
    const DipPbrDef *pbr = material->pbr;
    DipPbrUniforms surface = {
        .tables = dip_pbr_tables(),
        .metallic = pbr->metallic,
        .roughness = pbr->roughness,
        .f90 = pbr->f90,
        .normal_scale = pbr->normal_scale,
        .metal_rough_varying = pbr->metal_rough_map != DIP_NO_TEXTURE ? uv0 : DIP_ABSENT,
        .occlusion_varying = DIP_ABSENT,
        .emission_varying = DIP_ABSENT,
        .emits = emits(pbr),
        .two_sided = material->double_sided,
        .own_lights = def->lighting != NULL,
        .occlusion_strength = pbr->occlusion_strength,
        .coat = pbr->coat,
        .coat_roughness = pbr->coat_roughness,
        .transmission = dip_pbr_transmission(material),
        .scattering = dip_pbr_scattering(material),
    };
    if (occludes(pbr)) {
        surface.occlusion_varying = pbr->occlusion_at_uv1 ? uv1 : uv0;
    }
    if (shows_emission(pbr)) {
        surface.emission_varying = pbr->emission_at_uv1 ? uv1 : uv0;
    }
    surface.occlusion_in_metal_rough = surface.metal_rough_varying != DIP_ABSENT &&
                                       surface.occlusion_varying == surface.metal_rough_varying &&
                                       pbr->occlusion_map == pbr->metal_rough_map;
    memcpy(surface.f0_lin, pbr->f0_lin, sizeof surface.f0_lin);
    memcpy(surface.emission_lin, pbr->emission_lin, sizeof surface.emission_lin);
    for (int c = 0; c < 3; c++) {
        surface.f0_greatest =
            pbr->f0_lin[c] > surface.f0_greatest ? pbr->f0_lin[c] : surface.f0_greatest;
    }
    return surface;
}

void dip_pbr_add_sheen(const DipPbrDef *def, DipSheen *sheen, DipPbrUniforms *surface) {
    if (sheen && has_sheen(def)) {
        *sheen = dip_sheen_make(def->sheen_lin, (double)def->sheen_roughness);
        surface->sheen = sheen;
    }
}
