// Makes scenes for tests: the functions that add parts (textures, materials, meshes), and the scene
// of a plane at a grazing angle.
#include "renderer/catalogue/scenes.h"

#include "renderer/base/trig.h"
#include "renderer/catalogue/random.h"
#include "renderer/catalogue/scenes_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

void *dip_test_scene_alloc(DipTestScene *scene, size_t count, size_t size) {
    void *block = scene->block_count < DIP_TEST_SCENE_BLOCKS ? calloc(count + 1, size) : NULL;
    if (!block) {
        fprintf(stderr, "a test scene needs more blocks or memory than there are\n");
        abort();
    }
    scene->blocks[scene->block_count++] = block;
    return block;
}

void dip_test_scene_free(DipTestScene *scene) {
    for (int i = 0; i < scene->block_count; i++) {
        free(scene->blocks[i]);
    }
    scene->block_count = 0;
}

void dip_test_scene_begin(DipTestScene *scene) {
    memset(scene, 0, sizeof *scene);
    scene->def = (DipSceneDef){
        .textures = scene->textures,
        .materials = scene->materials,
        .meshes = scene->meshes,
        .objects = scene->objects,
        .background_lin = {0.2f, 0.25f, 0.3f},
        .near_m = 0.1f,
    };
    scene->pose = (DipPose){.orientation = {0.0, 0.0, 0.0, 1.0}, .fov_y_deg = 60.0};
}

static uint8_t texel_of(DipTestTexture texture, Random *random, int x, int y, int channel) {
    if (texture == DIP_TEST_NOISE) {
        return (uint8_t)random_u64(random);
    }
    static const uint8_t light[3] = {250, 230, 190};
    static const uint8_t dark[3] = {20, 30, 60};
    return ((x / 8) ^ (y / 8)) & 1 ? light[channel] : dark[channel];
}

int dip_test_scene_add_texture(DipTestScene *scene, DipTestTexture texture, int width, int height) {
    const size_t count = (size_t)width * (size_t)height;
    uint8_t *rgba8 = dip_test_scene_alloc(scene, count, 4);
    Random random = {(uint64_t)width * 8192 + (uint64_t)height};
    for (size_t i = 0; i < count; i++) {
        for (int c = 0; c < 3; c++) {
            rgba8[4 * i + (size_t)c] =
                texel_of(texture, &random, (int)(i % (size_t)width), (int)(i / (size_t)width), c);
        }
        rgba8[4 * i + 3] = 255;
    }
    scene->textures[scene->def.texture_count] =
        (DipTextureDef){.name = "test", .width = width, .height = height, .rgba8 = rgba8};
    return scene->def.texture_count++;
}

uint8_t *dip_test_scene_texels(DipTestScene *scene, int texture) {
    for (int i = 0; i < scene->block_count; i++) {
        if (scene->blocks[i] == (const void *)scene->textures[texture].rgba8) {
            return scene->blocks[i];
        }
    }
    return NULL;
}

int dip_test_scene_add_material(DipTestScene *scene, int colour_texture) {
    scene->materials[scene->def.material_count] = (DipMaterialDef){
        .name = "test",
        .surface = DIP_SURFACE_OPAQUE,
        .base_colour_lin = {1.0f, 1.0f, 1.0f},
        .colour_texture = colour_texture,
        .light_map = DIP_NO_TEXTURE,
        .normal_map = DIP_NO_TEXTURE,
        .light_map_scale = 1.0f,
        .alpha_cutoff = 0.5f,
    };
    return scene->def.material_count++;
}

DipPbrDef *dip_test_scene_add_pbr(DipTestScene *scene, int material, float metallic,
                                  float roughness) {
    DipPbrDef *pbr = &scene->pbrs[material];
    *pbr = (DipPbrDef){.metallic = metallic,
                       .roughness = roughness,
                       .f0_lin = {0.04f, 0.04f, 0.04f},
                       .f90 = 1.0f,
                       .metal_rough_map = DIP_NO_TEXTURE,
                       .occlusion_map = DIP_NO_TEXTURE,
                       .occlusion_strength = 1.0f,
                       .emission_map = DIP_NO_TEXTURE,
                       .normal_scale = 1.0f};
    scene->materials[material].pbr = pbr;
    scene->materials[material].lit = true;
    return pbr;
}

// Adds a texture with linear encoding and size x size texels, all zero.
static uint8_t *add_data(DipTestScene *scene, int size) {
    uint8_t *rgba8 = dip_test_scene_alloc(scene, (size_t)size * (size_t)size, 4);
    scene->textures[scene->def.texture_count++] = (DipTextureDef){.name = "test",
                                                                  .width = size,
                                                                  .height = size,
                                                                  .rgba8 = rgba8,
                                                                  .encoding = DIP_ENCODING_LINEAR};
    return rgba8;
}

int dip_test_scene_add_bumps(DipTestScene *scene, int size) {
    uint8_t *rgba8 = add_data(scene, size);
    for (int i = 0; i < size * size; i++) {
        const double x = 0.5 * dip_sin(8.0 * pi * (i % size + 0.5) / size);
        const double y = 0.5 * dip_sin(6.0 * pi * (i / size + 0.5) / size);
        rgba8[4 * i] = (uint8_t)lround(128.0 + 127.0 * x);
        rgba8[4 * i + 1] = (uint8_t)lround(128.0 + 127.0 * y);
        rgba8[4 * i + 2] = (uint8_t)lround(128.0 + 127.0 * sqrt(1.0 - x * x - y * y));
        rgba8[4 * i + 3] = 255;
    }
    return scene->def.texture_count - 1;
}

int dip_test_scene_add_clouds(DipTestScene *scene, int size) {
    uint8_t *rgba8 = add_data(scene, size);
    for (int i = 0; i < size * size; i++) {
        const double x = 2.0 * pi * (i % size) / size;
        const double y = 2.0 * pi * (i / size) / size;
        for (int c = 0; c < 3; c++) {
            const double wave =
                dip_sin(x * (1 + c) + c) * dip_sin(y * 2 + 0.7 * c) + dip_sin(x * 3 - y * (c + 1));
            rgba8[4 * i + c] = (uint8_t)lround(127.5 + 60.0 * wave);
        }
        rgba8[4 * i + 3] = 255;
    }
    return scene->def.texture_count - 1;
}

static float *maybe_alloc(DipTestScene *scene, uint32_t count, size_t floats, int wanted) {
    return wanted ? dip_test_scene_alloc(scene, count, floats * sizeof(float)) : NULL;
}

DipTestMesh dip_test_scene_add_mesh(DipTestScene *scene, uint32_t vertex_count,
                                    uint32_t index_count, int arrays, int material) {
    const DipTestMesh mesh = {
        .positions = maybe_alloc(scene, vertex_count, 3, 1),
        .normals = maybe_alloc(scene, vertex_count, 3, arrays & DIP_TEST_NORMALS),
        .uv0 = maybe_alloc(scene, vertex_count, 2, arrays & DIP_TEST_UV0),
        .uv1 = maybe_alloc(scene, vertex_count, 2, arrays & DIP_TEST_UV1),
        .colours_lin = maybe_alloc(scene, vertex_count, 3, arrays & DIP_TEST_COLOURS),
        .indices = dip_test_scene_alloc(scene, index_count, sizeof(uint32_t)),
    };
    const int index = scene->def.mesh_count++;
    scene->meshes[index] = (DipMeshDef){
        .name = "test",
        .vertex_count = vertex_count,
        .positions = mesh.positions,
        .normals = mesh.normals,
        .uv0 = mesh.uv0,
        .uv1 = mesh.uv1,
        .colours_lin = mesh.colours_lin,
        .index_count = index_count,
        .indices = mesh.indices,
        .material = material,
    };
    scene->objects[scene->def.object_count++] =
        (DipObjectDef){"test", index, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};
    return mesh;
}

void dip_test_scene_add_quad(DipTestScene *scene, int material, const float p[3], const float a[3],
                             const float b[3], float u, float v) {
    const DipTestMesh mesh = dip_test_scene_add_mesh(scene, 4, 6, DIP_TEST_UV0, material);
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    memcpy(mesh.indices, indices, sizeof indices);
    for (int i = 0; i < 4; i++) {
        const float along_a = i == 1 || i == 2 ? 1.0f : 0.0f;
        const float along_b = i >= 2 ? 1.0f : 0.0f;
        for (int k = 0; k < 3; k++) {
            mesh.positions[3 * i + k] = p[k] + along_a * a[k] + along_b * b[k];
        }
        mesh.uv0[2 * i] = along_a * u;
        mesh.uv0[2 * i + 1] = along_b * v;
    }
}

void dip_test_scene_add_ground(DipTestScene *scene, int material) {
    dip_test_scene_add_quad(scene, material, (const float[]){-50, -1, 5},
                            (const float[]){100, 0, 0}, (const float[]){0, 0, -200}, 100, 200);
}

void dip_test_scene_make_grazing(DipTestScene *scene, DipTestTexture texture, int size,
                                 double roll_deg) {
    dip_test_scene_begin(scene);
    const int material =
        dip_test_scene_add_material(scene, dip_test_scene_add_texture(scene, texture, size, size));
    dip_test_scene_add_ground(scene, material);
    // Half the angles of two rotations: the camera first turns down by 6 degrees, then rolls about
    // its view axis.
    const double roll = roll_deg * pi / 360.0;
    const double down = -6.0 * pi / 360.0;
    scene->pose.orientation[0] = dip_sin(down) * dip_cos(roll);
    scene->pose.orientation[1] = -dip_sin(down) * dip_sin(roll);
    scene->pose.orientation[2] = dip_cos(down) * dip_sin(roll);
    scene->pose.orientation[3] = dip_cos(down) * dip_cos(roll);
}

const char *dip_test_scene_name(DipTestSceneKind kind) {
    static const char *const names[] = {
#define DIP_TEST_SCENE_NAME(name, text) #name,
        DIP_TEST_SCENE_LIST(DIP_TEST_SCENE_NAME)
#undef DIP_TEST_SCENE_NAME
    };
    return names[kind];
}

// --- changes that must not show ------------------------------------------------------------------

static void enlarge_lights(DipTestScene *scene, float factor) {
    for (int i = 0; i < scene->lighting.light_count; i++) {
        DipLightDef *light = &scene->lights[i];
        for (int axis = 0; axis < 3; axis++) {
            light->position_world[axis] = roundf(light->position_world[axis] * factor);
        }
        light->attenuation[1] /= factor;
        light->attenuation[2] /= factor * factor;
        light->range_m *= factor;
    }
}

static void move_lights(DipTestScene *scene, const double by[3]) {
    for (int i = 0; i < scene->lighting.light_count; i++) {
        for (int axis = 0; axis < 3; axis++) {
            scene->lights[i].position_world[axis] += (float)by[axis];
        }
    }
}

static bool is_placed(const DipObjectDef *object) {
    static const float identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    return memcmp(object->transform, identity, sizeof identity) != 0;
}

void dip_test_scene_enlarge(DipTestScene *scene, float factor) {
    for (int i = 0; i < scene->def.object_count; i++) {
        DipObjectDef *object = &scene->objects[i];
        if (is_placed(object)) {
            for (int k = 0; k < 12; k++) {
                object->transform[k] *= factor;
            }
            for (int axis = 0; axis < 3; axis++) {
                object->transform[4 * axis + 3] = roundf(object->transform[4 * axis + 3]);
            }
            continue;
        }
        const DipMeshDef *mesh = &scene->meshes[object->mesh];
        for (uint32_t k = 0; k < 3 * mesh->vertex_count; k++) {
            float *position = (float *)(uintptr_t)mesh->positions + k;
            *position = roundf(*position * factor);
        }
    }
    scene->def.near_m *= factor;
    enlarge_lights(scene, factor);
    scene->reflection.level_m = round(scene->reflection.level_m * (double)factor);
    for (int axis = 0; axis < 3; axis++) {
        scene->pose.position_world[axis] =
            round(scene->pose.position_world[axis] * (double)factor * 16.0) / 16.0;
    }
}

void dip_test_scene_move(DipTestScene *scene, const double by[3]) {
    for (int i = 0; i < scene->def.object_count; i++) {
        DipObjectDef *object = &scene->objects[i];
        const DipMeshDef *mesh = &scene->meshes[object->mesh];
        for (uint32_t v = 0; !is_placed(object) && v < mesh->vertex_count; v++) {
            for (int axis = 0; axis < 3; axis++) {
                ((float *)(uintptr_t)mesh->positions)[3 * v + (uint32_t)axis] += (float)by[axis];
            }
        }
        for (int axis = 0; is_placed(object) && axis < 3; axis++) {
            object->transform[4 * axis + 3] += (float)by[axis];
        }
    }
    move_lights(scene, by);
    scene->reflection.level_m += by[1];
    for (int axis = 0; axis < 3; axis++) {
        scene->pose.position_world[axis] += by[axis];
    }
}

static bool wraps(DipWrap wrap) {
    return wrap == DIP_WRAP_REPEAT || wrap == DIP_WRAP_MIRROR;
}

// Whether a texture, which may be DIP_NO_TEXTURE, repeats along an axis, mirrored or not.
static bool repeats(const DipTestScene *scene, int texture, int axis) {
    return texture == DIP_NO_TEXTURE ||
           wraps(axis ? scene->textures[texture].wrap_v : scene->textures[texture].wrap_u);
}

// Rounds coordinates to multiples of 1/8, which floats hold up to 2^21, and adds whole numbers
// along the axes that repeat. uv: may be NULL.
static void shift(float *uv, uint32_t vertex_count, const bool axes[2], const float by[2]) {
    for (uint32_t i = 0; uv && i < 2 * vertex_count; i++) {
        uv[i] = roundf(uv[i] * 8.0f) / 8.0f + (axes[i % 2] ? by[i % 2] : 0.0f);
    }
}

void dip_test_scene_shift_uv(DipTestScene *scene, const float by[2]) {
    for (int m = 0; m < scene->def.mesh_count; m++) {
        DipMeshDef *mesh = &scene->meshes[m];
        const DipMaterialDef *material = &scene->materials[mesh->material];
        bool axes[2][2];
        for (int axis = 0; axis < 2; axis++) {
            axes[0][axis] = material->surface != DIP_SURFACE_SKY &&
                            repeats(scene, material->colour_texture, axis) &&
                            repeats(scene, material->normal_map, axis);
            axes[1][axis] = repeats(scene, material->light_map, axis);
        }
        shift((float *)(uintptr_t)mesh->uv0, mesh->vertex_count, axes[0], by);
        shift((float *)(uintptr_t)mesh->uv1, mesh->vertex_count, axes[1], by);
    }
}
