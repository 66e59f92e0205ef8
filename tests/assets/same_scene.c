// Compares and reads scene descriptions.
#include "tests/assets/same_scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

static void assert_same_array(const void *one, const void *other, size_t size_bytes) {
    assert_int_equal(one == NULL, other == NULL);
    if (one) {
        assert_memory_equal(one, other, size_bytes);
    }
}

static void assert_same_texture(const DipTextureDef *one, const DipTextureDef *other) {
    assert_string_equal(one->name, other->name);
    assert_int_equal(one->width, other->width);
    assert_int_equal(one->height, other->height);
    assert_int_equal(one->encoding, other->encoding);
    assert_int_equal(one->wrap_u, other->wrap_u);
    assert_int_equal(one->wrap_v, other->wrap_v);
    assert_same_array(one->rgba8, other->rgba8, 4 * (size_t)one->width * (size_t)one->height);
}

static void assert_same_pbr(const DipPbrDef *one, const DipPbrDef *other) {
    assert_int_equal(one == NULL, other == NULL);
    if (!one) {
        return;
    }
    assert_memory_equal(&one->metallic, &other->metallic, sizeof(float));
    assert_memory_equal(&one->roughness, &other->roughness, sizeof(float));
    assert_memory_equal(one->f0_lin, other->f0_lin, sizeof one->f0_lin);
    assert_memory_equal(&one->f90, &other->f90, sizeof(float));
    assert_int_equal(one->metal_rough_map, other->metal_rough_map);
    assert_int_equal(one->occlusion_map, other->occlusion_map);
    assert_int_equal(one->occlusion_at_uv1, other->occlusion_at_uv1);
    assert_memory_equal(&one->occlusion_strength, &other->occlusion_strength, sizeof(float));
    assert_int_equal(one->emission_map, other->emission_map);
    assert_int_equal(one->emission_at_uv1, other->emission_at_uv1);
    assert_memory_equal(one->emission_lin, other->emission_lin, sizeof one->emission_lin);
    assert_memory_equal(&one->normal_scale, &other->normal_scale, sizeof(float));
    assert_memory_equal(&one->coat, &other->coat, sizeof(float));
    assert_memory_equal(&one->coat_roughness, &other->coat_roughness, sizeof(float));
    assert_memory_equal(one->sheen_lin, other->sheen_lin, sizeof one->sheen_lin);
    assert_memory_equal(&one->sheen_roughness, &other->sheen_roughness, sizeof(float));
    assert_memory_equal(&one->transmission, &other->transmission, sizeof(float));
    assert_memory_equal(&one->scattering, &other->scattering, sizeof(float));
}

static void assert_same_material(const DipMaterialDef *one, const DipMaterialDef *other) {
    assert_string_equal(one->name, other->name);
    assert_int_equal(one->surface, other->surface);
    assert_memory_equal(one->base_colour_lin, other->base_colour_lin, sizeof one->base_colour_lin);
    assert_int_equal(one->colour_texture, other->colour_texture);
    assert_int_equal(one->light_map, other->light_map);
    assert_int_equal(one->normal_map, other->normal_map);
    assert_memory_equal(&one->light_map_scale, &other->light_map_scale, sizeof(float));
    assert_memory_equal(&one->roughness, &other->roughness, sizeof(float));
    assert_memory_equal(&one->alpha_cutoff, &other->alpha_cutoff, sizeof(float));
    assert_memory_equal(one->specular_lin, other->specular_lin, sizeof one->specular_lin);
    assert_memory_equal(&one->shininess, &other->shininess, sizeof(float));
    assert_int_equal(one->double_sided, other->double_sided);
    assert_int_equal(one->lit, other->lit);
    assert_memory_equal(&one->opacity, &other->opacity, sizeof(float));
    assert_memory_equal(&one->transmission, &other->transmission, sizeof(float));
    assert_same_pbr(one->pbr, other->pbr);
}

static void assert_same_mesh(const DipMeshDef *one, const DipMeshDef *other) {
    assert_string_equal(one->name, other->name);
    assert_int_equal(one->vertex_count, other->vertex_count);
    assert_int_equal(one->index_count, other->index_count);
    assert_int_equal(one->material, other->material);
    const size_t row = one->vertex_count * sizeof(float);
    assert_same_array(one->positions, other->positions, 3 * row);
    assert_same_array(one->normals, other->normals, 3 * row);
    assert_same_array(one->uv0, other->uv0, 2 * row);
    assert_same_array(one->uv1, other->uv1, 2 * row);
    assert_same_array(one->colours_lin, other->colours_lin, 3 * row);
    assert_same_array(one->alphas, other->alphas, row);
    assert_same_array(one->indices, other->indices, one->index_count * sizeof *one->indices);
}

static void assert_same_light(const DipLightDef *one, const DipLightDef *other) {
    assert_string_equal(one->name, other->name);
    assert_int_equal(one->kind, other->kind);
    assert_memory_equal(one->colour_lin, other->colour_lin, sizeof one->colour_lin);
    assert_memory_equal(one->position_world, other->position_world, sizeof one->position_world);
    assert_memory_equal(one->direction_world, other->direction_world, sizeof one->direction_world);
    assert_memory_equal(one->attenuation, other->attenuation, sizeof one->attenuation);
    assert_memory_equal(&one->range_m, &other->range_m, sizeof(float));
    assert_memory_equal(&one->inner_deg, &other->inner_deg, sizeof(float));
    assert_memory_equal(&one->outer_deg, &other->outer_deg, sizeof(float));
}

static void assert_same_lighting(const DipLightingDef *one, const DipLightingDef *other) {
    assert_int_equal(one == NULL, other == NULL);
    if (!one) {
        return;
    }
    assert_memory_equal(one->ambient_lin, other->ambient_lin, sizeof one->ambient_lin);
    assert_memory_equal(one->sky_lin, other->sky_lin, sizeof one->sky_lin);
    assert_int_equal(one->shading, other->shading);
    assert_int_equal(one->light_count, other->light_count);
    for (int i = 0; i < one->light_count; ++i) {
        assert_same_light(&one->lights[i], &other->lights[i]);
    }
}

void assert_same_scene(const DipSceneDef *one, const DipSceneDef *other) {
    assert_int_equal(one->texture_count, other->texture_count);
    assert_int_equal(one->material_count, other->material_count);
    assert_int_equal(one->mesh_count, other->mesh_count);
    assert_int_equal(one->object_count, other->object_count);
    assert_memory_equal(one->background_lin, other->background_lin, sizeof one->background_lin);
    assert_memory_equal(&one->near_m, &other->near_m, sizeof(float));
    assert_same_lighting(one->lighting, other->lighting);
    for (int i = 0; i < one->texture_count; ++i) {
        assert_same_texture(&one->textures[i], &other->textures[i]);
    }
    for (int i = 0; i < one->material_count; ++i) {
        assert_same_material(&one->materials[i], &other->materials[i]);
    }
    for (int i = 0; i < one->mesh_count; ++i) {
        assert_same_mesh(&one->meshes[i], &other->meshes[i]);
    }
    for (int i = 0; i < one->object_count; ++i) {
        assert_string_equal(one->objects[i].name, other->objects[i].name);
        assert_int_equal(one->objects[i].mesh, other->objects[i].mesh);
        assert_memory_equal(one->objects[i].transform, other->objects[i].transform,
                            sizeof one->objects[i].transform);
    }
}

static uint64_t sum_bytes(const void *array, size_t size_bytes) {
    const uint8_t *bytes = array;
    uint64_t sum = 0;
    for (size_t i = 0; bytes && i < size_bytes; ++i) {
        sum += bytes[i];
    }
    return sum;
}

static void assert_finite(const float *values, size_t count) {
    for (size_t i = 0; values && i < count; ++i) {
        assert_true(isfinite(values[i]));
    }
}

static void assert_in_unit(float value) {
    assert_true(value >= 0.0f && value <= 1.0f);
}

static void check_pbr(const DipPbrDef *pbr, int texture_count) {
    const int textures[] = {pbr->metal_rough_map, pbr->occlusion_map, pbr->emission_map};
    for (int i = 0; i < 3; ++i) {
        assert_true(textures[i] >= DIP_NO_TEXTURE && textures[i] < texture_count);
        assert_in_unit(pbr->f0_lin[i]);
        assert_in_unit(pbr->f90);
        assert_true(pbr->emission_lin[i] >= 0.0f && isfinite(pbr->emission_lin[i]));
    }
    assert_in_unit(pbr->metallic);
    assert_in_unit(pbr->roughness);
    assert_in_unit(pbr->occlusion_strength);
    assert_in_unit(pbr->coat);
    assert_in_unit(pbr->coat_roughness);
    for (int i = 0; i < 3; ++i) {
        assert_in_unit(pbr->sheen_lin[i]);
    }
    assert_in_unit(pbr->sheen_roughness);
    assert_in_unit(pbr->transmission);
    assert_in_unit(pbr->scattering);
    assert_true(isfinite(pbr->normal_scale));
}

static void check_material(const DipMaterialDef *material, int texture_count) {
    const int textures[] = {material->colour_texture, material->light_map, material->normal_map};
    for (int i = 0; i < 3; ++i) {
        assert_true(textures[i] >= DIP_NO_TEXTURE && textures[i] < texture_count);
        assert_in_unit(material->base_colour_lin[i]);
    }
    assert_in_range(material->surface, DIP_SURFACE_OPAQUE, DIP_SURFACE_SKY);
    assert_in_unit(material->roughness);
    assert_in_unit(material->alpha_cutoff);
    assert_true(isfinite(material->light_map_scale));
    assert_in_unit(material->opacity);
    assert_in_unit(material->transmission);
    if (material->pbr) {
        check_pbr(material->pbr, texture_count);
    }
    assert_true(material->shininess >= 0.0f && material->shininess <= DIP_MAX_SHININESS);
    for (int i = 0; i < 3; ++i) {
        assert_true(material->specular_lin[i] >= 0.0f && isfinite(material->specular_lin[i]));
    }
}

static void check_light(const DipLightDef *light) {
    assert_in_range(light->kind, DIP_LIGHT_DIRECTIONAL, DIP_LIGHT_SPOT);
    assert_finite(light->position_world, 3);
    assert_finite(light->direction_world, 3);
    float length = 0.0f;
    float fading = 0.0f;
    for (int i = 0; i < 3; ++i) {
        assert_true(light->colour_lin[i] >= 0.0f && isfinite(light->colour_lin[i]));
        assert_true(light->attenuation[i] >= 0.0f && isfinite(light->attenuation[i]));
        length += fabsf(light->direction_world[i]);
        fading += light->attenuation[i];
    }
    assert_true(length > 0.0f || light->kind == DIP_LIGHT_POINT);
    assert_true(fading > 0.0f || light->kind == DIP_LIGHT_DIRECTIONAL);
    assert_true(light->range_m >= 0.0f && isfinite(light->range_m));
    assert_true(light->kind != DIP_LIGHT_SPOT || light->outer_deg > 0.0f);
    assert_true(light->outer_deg <= 90.0f && light->inner_deg >= 0.0f);
    assert_true(light->inner_deg <= light->outer_deg);
}

static uint64_t sum_lighting(const DipLightingDef *lighting) {
    uint64_t sum = 0;
    assert_in_range(lighting->light_count, 0, DIP_MAX_LIGHTS);
    assert_in_range(lighting->shading, DIP_SHADING_PHONG, DIP_SHADING_GOURAUD);
    for (int i = 0; i < 3; ++i) {
        assert_true(lighting->sky_lin[i] >= 0.0f && isfinite(lighting->ambient_lin[i]));
        assert_true(lighting->sky_lin[i] <= lighting->ambient_lin[i]);
    }
    for (int i = 0; i < lighting->light_count; ++i) {
        check_light(&lighting->lights[i]);
        sum += strlen(lighting->lights[i].name);
    }
    return sum;
}

static uint64_t sum_mesh(const DipMeshDef *mesh) {
    const size_t row = mesh->vertex_count * sizeof(float);
    for (uint32_t i = 0; i < mesh->index_count; ++i) {
        assert_true(mesh->indices[i] < mesh->vertex_count);
    }
    assert_int_equal(mesh->index_count % 3, 0);
    assert_non_null(mesh->positions);
    assert_finite(mesh->positions, 3 * (size_t)mesh->vertex_count);
    assert_finite(mesh->normals, 3 * (size_t)mesh->vertex_count);
    assert_finite(mesh->uv0, 2 * (size_t)mesh->vertex_count);
    assert_finite(mesh->uv1, 2 * (size_t)mesh->vertex_count);
    assert_finite(mesh->colours_lin, 3 * (size_t)mesh->vertex_count);
    assert_finite(mesh->alphas, mesh->vertex_count);
    return strlen(mesh->name) + sum_bytes(mesh->positions, 3 * row) +
           sum_bytes(mesh->normals, 3 * row) + sum_bytes(mesh->uv0, 2 * row) +
           sum_bytes(mesh->uv1, 2 * row) + sum_bytes(mesh->colours_lin, 3 * row) +
           sum_bytes(mesh->alphas, row);
}

uint64_t read_whole_scene(const DipSceneDef *scene) {
    uint64_t sum = scene->lighting ? sum_lighting(scene->lighting) : 0;
    assert_true(isfinite(scene->near_m) || scene->object_count == 0);
    assert_finite(scene->background_lin, 3);
    for (int i = 0; i < scene->texture_count; ++i) {
        const DipTextureDef *texture = &scene->textures[i];
        assert_in_range(texture->width, 1, DIP_MAX_TEXTURE_SIZE);
        assert_in_range(texture->height, 1, DIP_MAX_TEXTURE_SIZE);
        assert_in_range(texture->encoding, DIP_ENCODING_SRGB, DIP_ENCODING_LINEAR);
        assert_in_range(texture->wrap_u, DIP_WRAP_REPEAT, DIP_WRAP_MIRROR);
        assert_in_range(texture->wrap_v, DIP_WRAP_REPEAT, DIP_WRAP_MIRROR);
        sum += strlen(texture->name) +
               sum_bytes(texture->rgba8, 4 * (size_t)texture->width * (size_t)texture->height);
    }
    for (int i = 0; i < scene->material_count; ++i) {
        sum += strlen(scene->materials[i].name);
        check_material(&scene->materials[i], scene->texture_count);
    }
    for (int i = 0; i < scene->mesh_count; ++i) {
        assert_in_range(scene->meshes[i].material, 0, scene->material_count - 1);
        sum += sum_mesh(&scene->meshes[i]);
    }
    for (int i = 0; i < scene->object_count; ++i) {
        assert_in_range(scene->objects[i].mesh, 0, scene->mesh_count - 1);
        assert_finite(scene->objects[i].transform, 12);
        sum += strlen(scene->objects[i].name);
    }
    return sum;
}
