// The reference's scene: checks the description and decodes the textures that surfaces show.
#include "renderer/reference/internal/internal.h"

#include "renderer/base/fp_mode.h"
#include "renderer/pipeline/patch.h"
#include "renderer/scene/renderer.h"

#include <stdlib.h>

static bool check_index(const char *name, const char *what, int index, int count, int least,
                        DipError *err) {
    return (index >= least && index < count) ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, name,
                         "%s %d is out of range, accepted %d..%d", what, index, least, count - 1);
}

static bool check_pbr(const DipSceneDef *def, const DipMaterialDef *material, DipError *err) {
    const DipPbrDef *pbr = material->pbr;
    const int count = def->texture_count;
    return !pbr || (check_index(material->name, "metal-rough map", pbr->metal_rough_map, count,
                                DIP_NO_TEXTURE, err) &&
                    check_index(material->name, "occlusion map", pbr->occlusion_map, count,
                                DIP_NO_TEXTURE, err) &&
                    check_index(material->name, "emission map", pbr->emission_map, count,
                                DIP_NO_TEXTURE, err));
}

static bool check_mesh(const DipMeshDef *mesh, int material_count, DipError *err) {
    if (!check_index(mesh->name, "material", mesh->material, material_count, 0, err)) {
        return false;
    }
    if (mesh->index_count % 3 != 0) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, mesh->name,
                             "%u indices are not a multiple of 3", mesh->index_count);
    }
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        if (mesh->indices[i] >= mesh->vertex_count) {
            return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, mesh->name,
                                 "index %u is out of range: the mesh has %u vertices",
                                 mesh->indices[i], mesh->vertex_count);
        }
    }
    return true;
}

static bool check_scene(const DipSceneDef *def, DipError *err) {
    for (int m = 0; m < def->material_count; m++) {
        const DipMaterialDef *material = &def->materials[m];
        if (!check_index(material->name, "colour texture", material->colour_texture,
                         def->texture_count, DIP_NO_TEXTURE, err) ||
            !check_index(material->name, "light map", material->light_map, def->texture_count,
                         DIP_NO_TEXTURE, err) ||
            !check_index(material->name, "normal map", material->normal_map, def->texture_count,
                         DIP_NO_TEXTURE, err) ||
            !check_pbr(def, material, err)) {
            return false;
        }
    }
    for (int m = 0; m < def->mesh_count; m++) {
        if (!check_mesh(&def->meshes[m], def->material_count, err)) {
            return false;
        }
    }
    for (int o = 0; o < def->object_count; o++) {
        if (!check_index(def->objects[o].name, "mesh", def->objects[o].mesh, def->mesh_count, 0,
                         err)) {
            return false;
        }
    }
    return def->near_m > 0.0f ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "near",
                         "%g m is out of range, accepted > 0", (double)def->near_m);
}

static bool load_texture(DipReference *reference, int index, DipError *err) {
    return index == DIP_NO_TEXTURE || reference->textures[index].level_count > 0 ||
           dip_reference_texture_init(&reference->textures[index], &reference->def->textures[index],
                                      reference->for_truth ? 1 : DIP_REF_MAX_LEVELS, err);
}

// A mesh that moves has no patches, because its triangles may fold: each is a patch by itself.
static bool find_patches_of(const DipReference *reference, int m, uint32_t *patches) {
    const DipMeshDef *mesh = &reference->def->meshes[m];
    const DipMotionDef *motion = reference->motion;
    uint32_t count;
    for (int i = 0; motion && i < motion->mesh_count; i++) {
        if (motion->meshes[i].mesh == m) {
            for (uint32_t t = 0; t < mesh->index_count / 3; t++) {
                patches[t] = t;
            }
            return true;
        }
    }
    return dip_patches_find(mesh->positions, 3, mesh->vertex_count, mesh->indices,
                            mesh->index_count, patches, &count);
}

// Compresses the material's colour texture. The texture of a sky is not compressed.
static bool compress_texture(DipReference *reference, const DipMaterialDef *material,
                             DipError *err) {
    if (material->surface == DIP_SURFACE_SKY || material->colour_texture == DIP_NO_TEXTURE) {
        return true;
    }
    DipRefTexture *texture = &reference->textures[material->colour_texture];
    return texture->blocks[0] || dip_reference_texture_compress(texture, err);
}

bool dip_reference_stopped(const DipReference *reference, DipError *err) {
    return reference->stop && atomic_load_explicit(reference->stop, memory_order_relaxed) &&
           !dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, NULL, "stopped");
}

static bool load_pbr(DipReference *reference, const DipPbrDef *pbr, DipError *err) {
    dip_reference_pbr_prepare();
    const DipEnvironmentDef *surroundings = reference->def->environment;
    if (surroundings && !reference->environment) {
        reference->environment = dip_reference_environment_create(surroundings);
    }
    if (surroundings && !reference->environment) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, NULL, "no memory for the reference");
    }
    return load_texture(reference, pbr->metal_rough_map, err) &&
           load_texture(reference, pbr->occlusion_map, err) &&
           load_texture(reference, pbr->emission_map, err);
}

static bool load_material(DipReference *reference, const DipMaterialDef *material, DipError *err) {
    return !dip_reference_stopped(reference, err) &&
           load_texture(reference, material->colour_texture, err) &&
           load_texture(reference, material->light_map, err) &&
           (!material->pbr || load_pbr(reference, material->pbr, err)) &&
           (!dip_reference_is_bumpy(material) ||
            load_texture(reference, material->normal_map, err));
}

static bool find_patches(DipReference *reference, DipError *err) {
    const DipSceneDef *def = reference->def;
    reference->patches = calloc((size_t)def->mesh_count + 1, sizeof *reference->patches);
    bool found = reference->patches != NULL;
    for (int m = 0; found && m < def->mesh_count; m++) {
        const DipMeshDef *mesh = &def->meshes[m];
        uint32_t *patches = malloc((mesh->index_count / 3 + 1) * sizeof *patches);
        reference->patches[m] = patches;
        found = patches && find_patches_of(reference, m, patches);
    }
    return found ||
           dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, NULL, "no memory for the reference");
}

static DipReference *create(const DipSceneDef *def, const atomic_bool *stop, bool for_truth,
                            DipError *err) {
    if (!check_scene(def, err) || (def->motion && !dip_motion_check(def, err))) {
        return NULL;
    }
    DipReference *reference = calloc(1, sizeof *reference);
    if (!reference) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, NULL, "no memory for the reference");
        return NULL;
    }
    reference->def = def;
    reference->motion = def->motion;
    if (def->motion) {
        reference->posed = dip_posed_def_create(def, err);
        if (!reference->posed) {
            free(reference);
            return NULL;
        }
        reference->def = dip_posed_def(reference->posed);
    }
    reference->stop = stop;
    reference->for_truth = for_truth;
    reference->textures = calloc((size_t)def->texture_count + 1, sizeof *reference->textures);
    bool loaded = reference->textures != NULL;
    if (!loaded) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, NULL, "no memory for the reference");
    }
    loaded = loaded && (for_truth || find_patches(reference, err));
    for (int m = 0; loaded && m < def->material_count; m++) {
        loaded = load_material(reference, &def->materials[m], err) &&
                 (for_truth || compress_texture(reference, &def->materials[m], err));
    }
    loaded = loaded && dip_reference_shadows_create(reference, &reference->shadows, err);
    if (!loaded) {
        dip_reference_destroy(&reference);
    }
    return reference;
}

DipReference *dip_reference_create(const DipSceneDef *def, DipError *err) {
    DIP_FP_MODE_SCOPE();
    return create(def, NULL, false, err);
}

DipReference *dip_reference_create_for_truth(const DipSceneDef *def, const atomic_bool *stop,
                                             DipError *err) {
    DIP_FP_MODE_SCOPE();
    return create(def, stop, true, err);
}

void dip_reference_set_reflection(DipReference *reference, const DipReflectionDef *reflection) {
    reference->reflection = *reflection;
}

void dip_reference_destroy(DipReference **reference) {
    if (!*reference) {
        return;
    }
    for (int t = 0; (*reference)->textures && t < (*reference)->def->texture_count; t++) {
        dip_reference_texture_free(&(*reference)->textures[t]);
    }
    for (int m = 0; (*reference)->patches && m < (*reference)->def->mesh_count; m++) {
        free((*reference)->patches[m]);
    }
    free((*reference)->patches);
    free((*reference)->textures);
    dip_reference_environment_destroy(&(*reference)->environment);
    dip_reference_shadows_destroy(&(*reference)->shadows);
    dip_posed_def_destroy(&(*reference)->posed);
    free(*reference);
    *reference = NULL;
}

void dip_reference_set_frame_index(DipReference *reference, uint64_t frame_index) {
    reference->frame_index = frame_index;
}

void dip_reference_set_time(DipReference *reference, int64_t time_ns) {
    DIP_FP_MODE_SCOPE();
    reference->time_ns = time_ns;
    if (reference->posed) {
        dip_posed_def_set(reference->posed, time_ns);
        dip_reference_shadows_destroy(&reference->shadows);
        reference->lacks_shadows =
            !dip_reference_shadows_create(reference, &reference->shadows, NULL);
    }
}

bool dip_reference_check_frame(const DipReference *reference, const DipPose *pose, int width,
                               int height, DipError *err) {
    if (!dip_pose_check(pose, err)) {
        return false;
    }
    if (reference->lacks_shadows) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, NULL, "no memory for shadows");
    }
    return (width >= 1 && width <= DIP_MAX_FRAME_SIZE && height >= 1 &&
            height <= DIP_MAX_FRAME_SIZE) ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "size",
                         "%dx%d is out of range, accepted 1..%d each", width, height,
                         DIP_MAX_FRAME_SIZE);
}
