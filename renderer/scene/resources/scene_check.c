// Checks the description of a scene.
#include "renderer/scene/resources/scene_check.h"

#include "renderer/scene/motion.h"

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

// Checks that floats are in a range. The comparison is written so that NaN fails it.
static bool check_range(const float *values, size_t count, double least, double most,
                        const char *owner, const char *key, DipError *err) {
    for (size_t i = 0; i < count; i++) {
        if (!((double)values[i] >= least && (double)values[i] <= most)) {
            return dip_error_set(err, DIP_ERROR_RANGE, owner, 0, key,
                                 "%g is out of range, accepted %g..%g", (double)values[i], least,
                                 most);
        }
    }
    return true;
}

static bool check_pbr(const DipSceneDef *def, const DipMaterialDef *material, DipError *err) {
    const DipPbrDef *pbr = material->pbr;
    const char *name = material->name;
    const int textures = def->texture_count;
    return !pbr ||
           (check_range(&pbr->metallic, 1, 0.0, 1.0, name, "metallic", err) &&
            check_range(&pbr->roughness, 1, 0.0, 1.0, name, "roughness", err) &&
            check_range(pbr->f0_lin, 3, 0.0, 1.0, name, "f0_lin", err) &&
            check_range(&pbr->f90, 1, 0.0, 1.0, name, "f90", err) &&
            check_range(&pbr->occlusion_strength, 1, 0.0, 1.0, name, "occlusion_strength", err) &&
            check_range(pbr->emission_lin, 3, 0.0, (double)DIP_MAX_LIGHT_LIN, name, "emission_lin",
                        err) &&
            check_floats(&pbr->normal_scale, 1, 1, name, "normal_scale", err) &&
            check_range(&pbr->coat, 1, 0.0, 1.0, name, "coat", err) &&
            check_range(&pbr->coat_roughness, 1, 0.0, 1.0, name, "coat_roughness", err) &&
            check_range(&pbr->transmission, 1, 0.0, 1.0, name, "pbr.transmission", err) &&
            check_range(&pbr->scattering, 1, 0.0, 1.0, name, "scattering", err) &&
            check_range(pbr->sheen_lin, 3, 0.0, 1.0, name, "sheen_lin", err) &&
            check_range(&pbr->sheen_roughness, 1, 0.0, 1.0, name, "sheen_roughness", err) &&
            check_index(pbr->metal_rough_map, textures, name, "metal_rough_map", err) &&
            check_index(pbr->occlusion_map, textures, name, "occlusion_map", err) &&
            check_index(pbr->emission_map, textures, name, "emission_map", err));
}

static bool check_material(const DipSceneDef *def, const DipMaterialDef *material, DipError *err) {
    return check_floats(material->base_colour_lin, 3, 3, material->name, "base_colour_lin", err) &&
           check_floats(&material->light_map_scale, 1, 1, material->name, "light_map_scale", err) &&
           check_floats(&material->roughness, 1, 1, material->name, "roughness", err) &&
           check_range(material->specular_lin, 3, 0.0, (double)DIP_MAX_LIGHT_LIN, material->name,
                       "specular_lin", err) &&
           check_range(&material->shininess, 1, 0.0, DIP_MAX_SHININESS, material->name, "shininess",
                       err) &&
           check_floats(&material->alpha_cutoff, 1, 1, material->name, "alpha_cutoff", err) &&
           check_range(&material->opacity, 1, 0.0, 1.0, material->name, "opacity", err) &&
           check_range(&material->transmission, 1, 0.0, 1.0, material->name, "transmission", err) &&
           check_pbr(def, material, err) &&
           check_index(material->colour_texture, def->texture_count, material->name,
                       "colour_texture", err) &&
           check_index(material->light_map, def->texture_count, material->name, "light_map", err) &&
           check_index(material->normal_map, def->texture_count, material->name, "normal_map", err);
}

static bool check_direction(const DipLightDef *light, DipError *err) {
    const float *d = light->direction_world;
    return check_floats(d, 3, 3, light->name, "direction_world", err) &&
           (d[0] != 0.0f || d[1] != 0.0f || d[2] != 0.0f ||
            dip_error_set(err, DIP_ERROR_RANGE, light->name, 0, "direction_world",
                          "0,0,0, accepted a vector of any other length"));
}

// Checks how the light of a point or spot light fades.
static bool check_fading(const DipLightDef *light, DipError *err) {
    const float *a = light->attenuation;
    return check_floats(light->position_world, 3, 3, light->name, "position_world", err) &&
           check_range(a, 3, 0.0, (double)DIP_MAX_LIGHT_LIN, light->name, "attenuation", err) &&
           (a[0] > 0.0f || a[1] > 0.0f || a[2] > 0.0f ||
            dip_error_set(err, DIP_ERROR_RANGE, light->name, 0, "attenuation",
                          "0,0,0, accepted at least one number greater than 0")) &&
           check_range(&light->range_m, 1, 0.0, (double)DIP_MAX_LIGHT_LIN, light->name, "range_m",
                       err);
}

static bool check_cone(const DipLightDef *light, DipError *err) {
    return (light->outer_deg > 0.0f && light->outer_deg <= 90.0f && light->inner_deg >= 0.0f &&
            light->inner_deg <= light->outer_deg) ||
           dip_error_set(err, DIP_ERROR_RANGE, light->name, 0, "outer_deg",
                         "inner %g, outer %g, accepted 0 <= inner <= outer <= 90, outer above 0",
                         (double)light->inner_deg, (double)light->outer_deg);
}

static bool check_light(const DipLightDef *light, DipError *err) {
    if (light->kind != DIP_LIGHT_DIRECTIONAL && light->kind != DIP_LIGHT_POINT &&
        light->kind != DIP_LIGHT_SPOT) {
        return dip_error_set(err, DIP_ERROR_RANGE, light->name, 0, "kind",
                             "%d is unknown, accepted a DipLightKind", (int)light->kind);
    }
    return check_range(light->colour_lin, 3, 0.0, (double)DIP_MAX_LIGHT_LIN, light->name,
                       "colour_lin", err) &&
           (light->kind == DIP_LIGHT_DIRECTIONAL || check_fading(light, err)) &&
           (light->kind == DIP_LIGHT_POINT || check_direction(light, err)) &&
           (light->kind != DIP_LIGHT_SPOT || check_cone(light, err));
}

static bool check_lighting(const DipLightingDef *lighting, DipError *err) {
    if (lighting->light_count < 0 || lighting->light_count > DIP_MAX_LIGHTS) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "lights", "%d lights, accepted 0..%d",
                             lighting->light_count, DIP_MAX_LIGHTS);
    }
    if (lighting->shading != DIP_SHADING_PHONG && lighting->shading != DIP_SHADING_GOURAUD) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "shading",
                             "%d is unknown, accepted a DipShading", (int)lighting->shading);
    }
    bool good = check_range(lighting->ambient_lin, 3, 0.0, (double)DIP_MAX_LIGHT_LIN, NULL,
                            "ambient_lin", err);
    for (int c = 0; good && c < 3; c++) {
        good = check_range(&lighting->sky_lin[c], 1, 0.0, (double)lighting->ambient_lin[c], NULL,
                           "sky_lin", err);
    }
    for (int i = 0; good && i < lighting->light_count; i++) {
        good = check_light(&lighting->lights[i], err);
    }
    return good;
}

static bool check_environment(const DipEnvironmentDef *environment, DipError *err) {
    const int width = environment->width;
    const int height = environment->height;
    if (width < 2 || width > DIP_MAX_ENVIRONMENT_WIDTH || width != 2 * height) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "environment",
                             "%dx%d texels, accepted 2x1..%dx%d, twice as wide as high", width,
                             height, DIP_MAX_ENVIRONMENT_WIDTH, DIP_MAX_ENVIRONMENT_WIDTH / 2);
    }
    return check_range(environment->rgb_lin, 3 * (size_t)width * (size_t)height, 0.0,
                       (double)DIP_MAX_ENVIRONMENT_LIN, NULL, "environment", err);
}

static bool check_sky_layer(const DipSkyLayer *layer, DipError *err) {
    const double speed = layer->speed_per_min;
    if (!(speed >= -DIP_MAX_SKY_SPEED && speed <= DIP_MAX_SKY_SPEED)) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "sky",
                             "speed_per_min %g is out of range, accepted -%d..%d", speed,
                             DIP_MAX_SKY_SPEED, DIP_MAX_SKY_SPEED);
    }
    return check_floats(&layer->scale, 1, 1, NULL, "sky.scale", err) &&
           check_floats(&layer->perturbation_widths, 1, 1, NULL, "sky.perturbation_widths", err);
}

static bool check_sky(const DipSkyDef *sky, DipError *err) {
    return check_sky_layer(&sky->layers[0], err) && check_sky_layer(&sky->layers[1], err) &&
           check_floats(&sky->perturbation_scale, 1, 1, NULL, "sky.perturbation_scale", err) &&
           check_floats(&sky->blend, 1, 1, NULL, "sky.blend", err) &&
           check_floats(&sky->clear, 1, 1, NULL, "sky.clear", err) &&
           check_floats(&sky->dense, 1, 1, NULL, "sky.dense", err) &&
           check_floats(&sky->overcast, 1, 1, NULL, "sky.overcast", err) &&
           check_floats(sky->zenith_lin, 3, 3, NULL, "sky.zenith_lin", err) &&
           check_floats(sky->horizon_lin, 3, 3, NULL, "sky.horizon_lin", err) &&
           check_floats(sky->cloud_lin, 3, 3, NULL, "sky.cloud_lin", err) &&
           check_floats(sky->glare_lin, 3, 3, NULL, "sky.glare_lin", err) &&
           check_floats(sky->tint_lin, 3, 3, NULL, "sky.tint_lin", err);
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
           check_floats(mesh->colours_lin, 3 * count, 3, mesh->name, "colours_lin", err) &&
           (!mesh->alphas || check_range(mesh->alphas, count, 0.0, 1.0, mesh->name, "alphas", err));
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
                check_floats(def->background_lin, 3, 3, NULL, "background_lin", err) &&
                (!def->lighting || check_lighting(def->lighting, err)) &&
                (!def->environment || check_environment(def->environment, err));
    for (int i = 0; good && i < def->material_count; i++) {
        good = check_material(def, &def->materials[i], err);
    }
    for (int i = 0; good && i < def->mesh_count; i++) {
        good = check_mesh(def, &def->meshes[i], err);
    }
    for (int i = 0; good && i < def->object_count; i++) {
        good = check_object(def, &def->objects[i], err);
    }
    return good && (!def->motion || dip_motion_check(def, err));
}
