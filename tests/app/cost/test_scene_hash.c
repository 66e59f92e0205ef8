// The scene's hash, which decides whether a kept truth may be used again, depends on every number
// of materials, lights, textures, objects and reflections, and on which parts a scene has.
#include "app/cost/plan.h"

#include "renderer/base/assert.h"
#include "renderer/scene/motion.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

// A field of a structure, in the order of its declaration.
typedef struct Field {
    size_t offset, size_bytes;
    size_t element_bytes; // 0: the field is a pointer or a name, which is not changed
} Field;

#define NUMBERS(type, field, element)                                                              \
    { offsetof(type, field), sizeof(((type *)0)->field), sizeof(element) }
#define KEPT(type, field)                                                                          \
    { offsetof(type, field), sizeof(((type *)0)->field), 0 }

static const float triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
static const uint32_t corners[3] = {0, 1, 2};
static const uint8_t texel[4] = {1, 2, 3, 4};
static const float surroundings[6] = {1, 2, 3, 4, 5, 6};

// The scene: one of everything.
static DipTextureDef texture;
static DipPbrDef pbr;
static DipMaterialDef material;
static DipMeshDef mesh;
static DipObjectDef object;
static DipLightDef light;
static DipLightingDef lighting;
static DipEnvironmentDef environment;
static DipSceneDef scene;
static DipReflectionDef reflection;

static void make_scene(void) {
    texture = (DipTextureDef){.name = "a", .width = 1, .height = 1, .rgba8 = texel};
    pbr = (DipPbrDef){.metallic = 0.5f};
    material = (DipMaterialDef){.name = "b", .pbr = &pbr, .opacity = 0.5f};
    mesh = (DipMeshDef){.name = "c",
                        .vertex_count = 3,
                        .positions = triangle,
                        .index_count = 3,
                        .indices = corners};
    object = (DipObjectDef){.name = "d", .transform = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};
    light = (DipLightDef){.name = "e", .colour_lin = {1, 1, 1}};
    lighting = (DipLightingDef){.lights = &light, .light_count = 1};
    environment = (DipEnvironmentDef){surroundings, 2, 1};
    scene = (DipSceneDef){.textures = &texture,
                          .materials = &material,
                          .meshes = &mesh,
                          .objects = &object,
                          .texture_count = 1,
                          .material_count = 1,
                          .mesh_count = 1,
                          .object_count = 1,
                          .near_m = 0.1f,
                          .lighting = &lighting,
                          .environment = &environment};
    reflection = (DipReflectionDef){.width = 4, .height = 4};
}

static void hash_scene(char hex[33]) {
    dip_cost_scene_hash(&scene, &reflection, hex);
}

// Changes one element of the structure at a time, in its lowest bit, and expects another hash each
// time. The fields must be all of the structure's: a gap as large as the alignment that follows
// could hold a field that the list lacks.
static void expect_all_hashed(const char *name, void *structure, size_t size_bytes,
                              size_t structure_alignment, const Field *fields, int count) {
    uint8_t *bytes = structure;
    char before[33];
    hash_scene(before);
    size_t end = 0;
    for (int f = 0; f < count; f++) {
        const Field *field = &fields[f];
        const size_t alignment = field->element_bytes ? field->element_bytes : field->size_bytes;
        if (field->offset - end >= alignment) {
            fail_msg("%s has a field before its byte %zu that this test lacks", name,
                     field->offset);
        }
        end = field->offset + field->size_bytes;
        for (size_t at = field->offset; field->element_bytes && at < end;
             at += field->element_bytes) {
            bytes[at] ^= 1;
            char after[33];
            hash_scene(after);
            bytes[at] ^= 1;
            if (strcmp(before, after) == 0) {
                fail_msg("the hash does not depend on byte %zu of %s", at, name);
            }
        }
    }
    if (size_bytes - end >= structure_alignment) {
        fail_msg("%s has a field after its byte %zu that this test lacks", name, end);
    }
}

#define EXPECT_ALL_HASHED(structure, type, fields)                                                 \
    expect_all_hashed(#structure, &(structure), sizeof(type), _Alignof(type), fields,              \
                      DIP_ARRAY_COUNT(fields))

static void a_material_is_hashed(void **state) {
    (void)state;
    make_scene();
    static const Field fields[] = {
        KEPT(DipMaterialDef, name),
        NUMBERS(DipMaterialDef, surface, int),
        NUMBERS(DipMaterialDef, base_colour_lin, float),
        NUMBERS(DipMaterialDef, colour_texture, int),
        NUMBERS(DipMaterialDef, light_map, int),
        NUMBERS(DipMaterialDef, normal_map, int),
        NUMBERS(DipMaterialDef, light_map_scale, float),
        NUMBERS(DipMaterialDef, roughness, float),
        NUMBERS(DipMaterialDef, specular_lin, float),
        NUMBERS(DipMaterialDef, shininess, float),
        NUMBERS(DipMaterialDef, alpha_cutoff, float),
        NUMBERS(DipMaterialDef, double_sided, bool),
        NUMBERS(DipMaterialDef, lit, bool),
        NUMBERS(DipMaterialDef, opacity, float),
        NUMBERS(DipMaterialDef, transmission, float),
        KEPT(DipMaterialDef, pbr),
    };
    EXPECT_ALL_HASHED(material, DipMaterialDef, fields);
    static const Field pbr_fields[] = {
        NUMBERS(DipPbrDef, metallic, float),
        NUMBERS(DipPbrDef, roughness, float),
        NUMBERS(DipPbrDef, f0_lin, float),
        NUMBERS(DipPbrDef, f90, float),
        NUMBERS(DipPbrDef, metal_rough_map, int),
        NUMBERS(DipPbrDef, occlusion_map, int),
        NUMBERS(DipPbrDef, occlusion_at_uv1, bool),
        NUMBERS(DipPbrDef, occlusion_strength, float),
        NUMBERS(DipPbrDef, emission_map, int),
        NUMBERS(DipPbrDef, emission_at_uv1, bool),
        NUMBERS(DipPbrDef, emission_lin, float),
        NUMBERS(DipPbrDef, normal_scale, float),
        NUMBERS(DipPbrDef, coat, float),
        NUMBERS(DipPbrDef, coat_roughness, float),
        NUMBERS(DipPbrDef, sheen_lin, float),
        NUMBERS(DipPbrDef, sheen_roughness, float),
        NUMBERS(DipPbrDef, transmission, float),
        NUMBERS(DipPbrDef, scattering, float),
    };
    EXPECT_ALL_HASHED(pbr, DipPbrDef, pbr_fields);
}

static void lights_are_hashed(void **state) {
    (void)state;
    make_scene();
    static const Field fields[] = {
        KEPT(DipLightDef, name),
        NUMBERS(DipLightDef, kind, int),
        NUMBERS(DipLightDef, colour_lin, float),
        NUMBERS(DipLightDef, position_world, float),
        NUMBERS(DipLightDef, direction_world, float),
        NUMBERS(DipLightDef, attenuation, float),
        NUMBERS(DipLightDef, range_m, float),
        NUMBERS(DipLightDef, inner_deg, float),
        NUMBERS(DipLightDef, outer_deg, float),
    };
    EXPECT_ALL_HASHED(light, DipLightDef, fields);
    static const Field all_fields[] = {
        NUMBERS(DipLightingDef, ambient_lin, float),
        NUMBERS(DipLightingDef, sky_lin, float),
        KEPT(DipLightingDef, lights),
        KEPT(DipLightingDef, light_count),
        NUMBERS(DipLightingDef, shading, int),
    };
    EXPECT_ALL_HASHED(lighting, DipLightingDef, all_fields);
}

static void textures_and_places_are_hashed(void **state) {
    (void)state;
    make_scene();
    static const Field texture_fields[] = {
        KEPT(DipTextureDef, name),
        KEPT(DipTextureDef, width),
        KEPT(DipTextureDef, height),
        KEPT(DipTextureDef, rgba8),
        NUMBERS(DipTextureDef, encoding, int),
        NUMBERS(DipTextureDef, wrap_u, int),
        NUMBERS(DipTextureDef, wrap_v, int),
        NUMBERS(DipTextureDef, border_rgba8, uint8_t),
    };
    EXPECT_ALL_HASHED(texture, DipTextureDef, texture_fields);
    static const Field object_fields[] = {
        KEPT(DipObjectDef, name),
        NUMBERS(DipObjectDef, mesh, int),
        NUMBERS(DipObjectDef, transform, float),
    };
    EXPECT_ALL_HASHED(object, DipObjectDef, object_fields);
    static const Field reflection_fields[] = {
        NUMBERS(DipReflectionDef, width, int),
        NUMBERS(DipReflectionDef, height, int),
        NUMBERS(DipReflectionDef, level_m, double),
        NUMBERS(DipReflectionDef, schlick, bool),
    };
    EXPECT_ALL_HASHED(reflection, DipReflectionDef, reflection_fields);
}

static void a_part_that_is_there_is_not_a_part_that_is_missing(void **state) {
    (void)state;
    char hashes[7][33];
    for (int i = 0; i < 7; i++) {
        make_scene();
        material.pbr = i == 1 ? NULL : material.pbr;
        scene.lighting = i == 2 ? NULL : scene.lighting;
        scene.environment = i == 3 ? NULL : scene.environment;
        lighting.light_count = i == 4 ? 0 : lighting.light_count;
        mesh.uv0 = i == 5 ? triangle : NULL;
        mesh.alphas = i == 6 ? triangle : NULL;
        hash_scene(hashes[i]);
        for (int before = 0; before < i; before++) {
            assert_string_not_equal(hashes[before], hashes[i]);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_material_is_hashed),
        cmocka_unit_test(lights_are_hashed),
        cmocka_unit_test(textures_and_places_are_hashed),
        cmocka_unit_test(a_part_that_is_there_is_not_a_part_that_is_missing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
