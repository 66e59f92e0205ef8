// Checks the description of a scene.
#include "renderer/scene/resources/scene_check.h"

#include <math.h>

// Checks that all floats of an array are finite. values may be NULL. per_element: floats of one
// element of the array, for example 3 floats of a normal.
static bool check_floats(const float *values, size_t count, size_t per_element, const char *owner,
                         const char *key, DipError *err) {
    for (size_t i = 0; values && i < count; i++) {
        if (!isfinite(values[i])) {
            return dip_error_set(err, DIP_ERROR_RANGE, owner, 0, key,
                                 "number %zu of element %zu is %g, accepted finite numbers",
                                 i % per_element, i / per_element, (double)values[i]);
        }
    }
    return true;
}

static bool check_index(int index, int count, const char *owner, const char *key, DipError *err) {
    return (index >= DIP_NO_TEXTURE && index < count) ||
           dip_error_set(err, DIP_ERROR_RANGE, owner, 0, key,
                         "texture %d is out of range, accepted 0..%d, or -1 for none", index,
                         count - 1);
}

static bool check_material(const DipSceneDef *def, const DipMaterialDef *material, DipError *err) {
    return check_floats(material->base_colour_lin, 3, 3, material->name, "base_colour_lin", err) &&
           check_floats(&material->light_map_scale, 1, 1, material->name, "light_map_scale", err) &&
           check_floats(&material->roughness, 1, 1, material->name, "roughness", err) &&
           check_floats(&material->alpha_cutoff, 1, 1, material->name, "alpha_cutoff", err) &&
           check_index(material->colour_texture, def->texture_count, material->name,
                       "colour_texture", err) &&
           check_index(material->light_map, def->texture_count, material->name, "light_map", err) &&
           check_index(material->normal_map, def->texture_count, material->name, "normal_map", err);
}

static bool check_sky(const DipSkyDef *sky, DipError *err) {
    for (int i = 0; i < 2; i++) {
        const double speed = sky->layers[i].speed_per_min;
        if (!(speed >= -DIP_MAX_SKY_SPEED && speed <= DIP_MAX_SKY_SPEED)) {
            return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "sky",
                                 "speed_per_min %g is out of range, accepted -%d..%d", speed,
                                 DIP_MAX_SKY_SPEED, DIP_MAX_SKY_SPEED);
        }
    }
    return true;
}

// Checks a mesh's material and its attributes, except for its positions.
static bool check_mesh(const DipSceneDef *def, const DipMeshDef *mesh, DipError *err) {
    if (mesh->material < 0 || mesh->material >= def->material_count) {
        return dip_error_set(err, DIP_ERROR_RANGE, mesh->name, 0, "material",
                             "%d is out of range, accepted 0..%d", mesh->material,
                             def->material_count - 1);
    }
    const size_t count = mesh->vertex_count;
    return check_floats(mesh->normals, 3 * count, 3, mesh->name, "normals", err) &&
           check_floats(mesh->uv0, 2 * count, 2, mesh->name, "uv0", err) &&
           check_floats(mesh->uv1, 2 * count, 2, mesh->name, "uv1", err) &&
           check_floats(mesh->colours_lin, 3 * count, 3, mesh->name, "colours_lin", err);
}

static bool check_object(const DipSceneDef *def, const DipObjectDef *object, DipError *err) {
    if (object->mesh < 0 || object->mesh >= def->mesh_count) {
        return dip_error_set(err, DIP_ERROR_RANGE, object->name, 0, "mesh",
                             "%d is out of range, accepted 0..%d", object->mesh,
                             def->mesh_count - 1);
    }
    return check_floats(object->transform, 12, 12, object->name, "transform", err);
}

bool dip_scene_check(const DipSceneDef *def, DipError *err) {
    // The comparisons are written so that NaN fails them.
    if (!(def->near_m >= DIP_MIN_NEAR_M && def->near_m <= DIP_MAX_NEAR_M)) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "near_m",
                             "%g is out of range, accepted %g..%g", (double)def->near_m,
                             (double)DIP_MIN_NEAR_M, (double)DIP_MAX_NEAR_M);
    }
    bool good = check_sky(&def->sky, err) &&
                check_floats(def->background_lin, 3, 3, NULL, "background_lin", err);
    for (int i = 0; good && i < def->material_count; i++) {
        good = check_material(def, &def->materials[i], err);
    }
    for (int i = 0; good && i < def->mesh_count; i++) {
        good = check_mesh(def, &def->meshes[i], err);
    }
    for (int i = 0; good && i < def->object_count; i++) {
        good = check_object(def, &def->objects[i], err);
    }
    return good;
}
