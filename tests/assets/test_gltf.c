// Tests the reader of glTF scenes: one small model for each feature (make_gltf.py). The expected
// numbers follow by hand from those of the models and from the glTF 2.0 specification. assimp is a
// second opinion about plain files.
#include "assets/gltf/document.h"
#include "assets/importer.h"
#include "assets/model.h"
#include "tests/assets/fixture.h"
#include "tests/assets/same_scene.h"

#include <assimp/cimport.h>
#include <assimp/mesh.h>
#include <assimp/scene.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

static const char importer_word[] = "import";

static const char *gltf_path(const char *name) {
    char path[64];
    snprintf(path, sizeof path, "gltf/%s", name);
    return fixture_data(path);
}

static DipModel *load(const char *name, DipErrorList *warnings) {
    const DipModelOptions options = {.normal_maps = true};
    DipModel *model = fixture_load(gltf_path(name), &options, warnings);
    read_whole_scene(dip_model_scene_def(model));
    return model;
}

static const DipMeshDef *mesh_of(const DipSceneDef *def, const char *name) {
    return &def->meshes[fixture_object(def, name)->mesh];
}

static const DipMaterialDef *material_of(const DipSceneDef *def, const char *name) {
    return &def->materials[mesh_of(def, name)->material];
}

static void assert_near(double value, double expected) {
    if (!(fabs(value - expected) < 1e-5)) {
        fail_msg("%g, expected %g", value, expected);
    }
}

static void assert_near_3(const float *values, double x, double y, double z) {
    assert_near((double)values[0], x);
    assert_near((double)values[1], y);
    assert_near((double)values[2], z);
}

// Returns the values of a triangle's corner in an array of `width` floats per vertex.
static const float *corner(const DipMeshDef *mesh, const float *values, uint32_t index,
                           size_t width) {
    assert_non_null(values);
    assert_true(index < mesh->index_count);
    return values + width * mesh->indices[index];
}

// --- shapes --------------------------------------------------------------------------------------

// Checks the x and y of the corners of all triangles. z is 0, and the normals point to +z.
static void assert_flat_corners(const DipMeshDef *mesh, const double (*expected)[2], size_t count) {
    assert_int_equal(mesh->index_count, count);
    for (uint32_t i = 0; i < mesh->index_count; ++i) {
        assert_near_3(corner(mesh, mesh->positions, i, 3), expected[i][0], expected[i][1], 0.0);
        assert_near_3(corner(mesh, mesh->normals, i, 3), 0.0, 0.0, 1.0);
    }
}

static void strips_and_fans_become_triangles(void **state) {
    (void)state;
    static const double strip[9][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 0}, {1, 1},
                                       {0, 1}, {0, 1}, {1, 1}, {0, 2}};
    static const double fan[9][2] = {{2, 0}, {2, 1}, {0, 0}, {2, 1}, {1, 2},
                                     {0, 0}, {1, 2}, {0, 2}, {0, 0}};
    DipErrorList warnings = {0};
    DipModel *model = load("strips.gltf", &warnings);
    const DipSceneDef *def = dip_model_scene_def(model);
    assert_int_equal(def->object_count, 2);
    assert_flat_corners(mesh_of(def, "strip"), strip, 9);
    assert_flat_corners(mesh_of(def, "fan"), fan, 9);
    assert_int_equal(warnings.count, 1);
    assert_string_equal(warnings.items[0].message, "9 points and lines are not drawn");
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
}

// The cross products of the triangles are (0, -4, 4) and (0, 0, 8).
static void missing_normals_are_those_of_the_triangles(void **state) {
    (void)state;
    static const double positions[6][3] = {{0, 0, 0}, {4, 0, 0}, {0, 1, 1},
                                           {4, 0, 0}, {0, 0, 0}, {0, -2, 0}};
    const double half = sqrt(0.5);
    DipErrorList warnings = {0};
    DipModel *model = load("ridge.gltf", &warnings);
    const DipSceneDef *def = dip_model_scene_def(model);
    const DipMeshDef *mesh = mesh_of(def, "ridge");
    assert_int_equal(mesh->index_count, 6);
    for (uint32_t i = 0; i < 6; ++i) {
        const double *at = positions[i];
        assert_near_3(corner(mesh, mesh->positions, i, 3), at[0], at[1], at[2]);
        assert_near_3(corner(mesh, mesh->normals, i, 3), 0.0, i < 3 ? -half : 0.0,
                      i < 3 ? half : 1.0);
    }
    assert_int_equal(def->object_count, 1);
    assert_int_equal(warnings.count, 1);
    assert_string_equal(warnings.items[0].message, "1 points and lines are not drawn");
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
}

static void sparse_accessors_list_what_differs(void **state) {
    (void)state;
    DipModel *model = load("sparse.gltf", NULL);
    const DipSceneDef *def = dip_model_scene_def(model);
    const DipMeshDef *moved = mesh_of(def, "moved");
    assert_near_3(corner(moved, moved->positions, 1, 3), 1.0, 0.0, 0.0);
    assert_near_3(corner(moved, moved->positions, 2, 3), 5.0, 6.0, 7.0);
    const DipMeshDef *alone = mesh_of(def, "alone");
    assert_near_3(corner(alone, alone->positions, 0, 3), 0.0, 0.0, 0.0);
    assert_near_3(corner(alone, alone->positions, 1, 3), 0.0, 0.0, 0.0);
    assert_near_3(corner(alone, alone->positions, 2, 3), 5.0, 6.0, 7.0);
    dip_model_destroy(&model);
}

static void quantized_numbers_keep_their_meaning(void **state) {
    (void)state;
    DipErrorList warnings = {0};
    DipModel *model = load("quantized.gltf", &warnings);
    const DipSceneDef *def = dip_model_scene_def(model);
    const DipMeshDef *mesh = mesh_of(def, "small");
    assert_near_3(corner(mesh, mesh->positions, 1, 3), 1.0, 0.0, 0.0);
    assert_near_3(corner(mesh, mesh->positions, 2, 3), 0.0, -1.0, 0.0);
    assert_near_3(corner(mesh, mesh->normals, 2, 3), 0.0, 0.0, 1.0);
    assert_near((double)corner(mesh, mesh->uv0, 1, 2)[0], 3.0);
    assert_near((double)corner(mesh, mesh->uv0, 2, 2)[1], 2.0);
    assert_near((double)fixture_object(def, "small")->transform[0], 2.0);
    assert_int_equal(warnings.count, 0);
    dip_model_destroy(&model);
}

static void vertex_colours_are_linear_and_clamped(void **state) {
    (void)state;
    DipErrorList warnings = {0};
    DipModel *model = load("colours.gltf", &warnings);
    const DipSceneDef *def = dip_model_scene_def(model);
    const DipMeshDef *three = mesh_of(def, "three");
    assert_near_3(corner(three, three->colours_lin, 0, 3), 1.0, 0.5, 0.0);
    assert_near_3(corner(three, three->colours_lin, 1, 3), 0.0, 1.0, 0.0);
    assert_near_3(corner(three, three->colours_lin, 2, 3), 0.0, 0.0, 0.25);
    const DipMeshDef *four = mesh_of(def, "four");
    assert_near_3(corner(four, four->colours_lin, 0, 3), 1.0, 0.2, 0.0);
    assert_near_3(corner(four, four->colours_lin, 1, 3), 0.0, 0.0, 1.0);
    assert_int_equal(warnings.count, 0);
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
}

// The alpha of vertex colours is kept where it changes the surface: "whole" is opaque.
static void vertex_alphas_belong_to_surfaces_that_clip_or_blend(void **state) {
    (void)state;
    static const double expected[3] = {0.0, 0.4, 1.0};
    DipModel *model = load("colours.gltf", NULL);
    const DipSceneDef *def = dip_model_scene_def(model);
    const char *const names[] = {"four", "mixed"};
    for (int i = 0; i < 2; i++) {
        const DipMeshDef *mesh = mesh_of(def, names[i]);
        assert_int_equal(def->materials[mesh->material].surface,
                         i ? DIP_SURFACE_BLENDED : DIP_SURFACE_CLIPPED);
        for (uint32_t k = 0; k < 3; k++) {
            assert_near((double)*corner(mesh, mesh->alphas, k, 1), expected[k]);
        }
    }
    assert_null(mesh_of(def, "three")->alphas);
    const DipMeshDef *whole = mesh_of(def, "whole");
    assert_null(whole->alphas);
    assert_int_equal(def->materials[whole->material].surface, DIP_SURFACE_OPAQUE);
    // A part without alpha does not blend, although its material is that of "mixed".
    const DipMeshDef *solid = mesh_of(def, "solid");
    assert_null(solid->alphas);
    assert_int_equal(def->materials[solid->material].surface, DIP_SURFACE_OPAQUE);
    dip_model_destroy(&model);
}

static void instances_become_objects_of_one_mesh(void **state) {
    (void)state;
    DipErrorList warnings = {0};
    DipModel *model = load("instancing.gltf", &warnings);
    const DipSceneDef *def = dip_model_scene_def(model);
    static const float expected[3][12] = {{1, 0, 0, 11, 0, 1, 0, 0, 0, 0, 1, 0},
                                          {0, -1, 0, 10, 1, 0, 0, 2, 0, 0, 1, 0},
                                          {2, 0, 0, 10, 0, 2, 0, 0, 0, 0, 2, 3}};
    assert_int_equal(def->object_count, 3); // The node "hidden" is not visible.
    assert_int_equal(def->mesh_count, 1);
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 12; ++k) {
            assert_near((double)def->objects[i].transform[k], (double)expected[i][k]);
        }
    }
    assert_int_equal(warnings.count, 0);
    dip_model_destroy(&model);
}

// The joints are translated to (0, 0, 5) and, minus the bind pose, (0, 6, 5).
static void skins_and_morph_targets_have_their_shape_at_rest(void **state) {
    (void)state;
    DipModel *model = load("shapes.gltf", NULL);
    const DipSceneDef *def = dip_model_scene_def(model);
    const DipMeshDef *skinned = mesh_of(def, "skinned");
    assert_near_3(corner(skinned, skinned->positions, 0, 3), 0.0, 0.0, 5.0);
    assert_near_3(corner(skinned, skinned->positions, 1, 3), 1.0, 6.0, 5.0);
    assert_near_3(corner(skinned, skinned->positions, 2, 3), 0.0, 4.0, 5.0);
    assert_near((double)fixture_object(def, "skinned")->transform[3], 0.0);
    static const struct {
        const char *name;
        double weight;
    } faces[] = {{"half", 0.5}, {"whole", 1.0}, {"rest", 0.0}};
    for (size_t i = 0; i < 3; ++i) {
        const DipMeshDef *face = mesh_of(def, faces[i].name);
        assert_near_3(corner(face, face->positions, 0, 3), 0.0, 0.0, 0.0);
        assert_near_3(corner(face, face->positions, 1, 3), 1.0, 0.0, 2.0 * faces[i].weight);
        assert_near_3(corner(face, face->positions, 2, 3), 0.0, 1.0, 4.0 * faces[i].weight);
    }
    dip_model_destroy(&model);
}

// A skin may leave its matrices out: each is the identity. The joints are at (0, 0, 5) and
// (0, 10, 5).
static void a_skin_without_matrices_has_identities(void **state) {
    (void)state;
    static const char member[] = "\"inverseBindMatrices\"";
    size_t size_bytes = 0;
    uint8_t *bytes = fixture_read(fixture_data("gltf/shapes.gltf"), &size_bytes);
    bytes[size_bytes] = '\0';
    char *at = strstr((char *)bytes, member);
    assert_non_null(at);
    memcpy(at, "\"anotherMemberHere\"  ", sizeof member - 1); // spaces fill it up
    fixture_write_text("identities.gltf", (const char *)bytes);
    free(bytes);
    DipModel *model = fixture_load(fixture_path("identities.gltf"), NULL, NULL);
    const DipMeshDef *skinned = mesh_of(dip_model_scene_def(model), "skinned");
    assert_near_3(corner(skinned, skinned->positions, 0, 3), 0.0, 0.0, 5.0);
    assert_near_3(corner(skinned, skinned->positions, 1, 3), 1.0, 10.0, 5.0);
    assert_near_3(corner(skinned, skinned->positions, 2, 3), 0.0, 6.0, 5.0);
    dip_model_destroy(&model);
}

static void every_node_with_a_light_is_a_light(void **state) {
    (void)state;
    DipModel *model = load("lamps.gltf", NULL);
    const DipLightingDef *lighting = dip_model_scene_def(model)->lighting;
    assert_non_null(lighting);
    assert_int_equal(lighting->light_count, 2);
    assert_string_equal(lighting->lights[0].name, "left");
    assert_near_3(lighting->lights[0].position_world, -1.0, 0.0, 0.0);
    assert_near_3(lighting->lights[1].position_world, 1.0, 0.0, 0.0);
    dip_model_destroy(&model);
}

// --- materials -----------------------------------------------------------------------------------

static void assert_reflection(const DipSceneDef *def, const char *name, double metallic,
                              double roughness) {
    const DipMaterialDef *material = material_of(def, name);
    if (!material->pbr) {
        fail_msg("%s reflects nothing", name);
    }
    assert_true(material->lit);
    assert_near((double)material->pbr->metallic, metallic);
    assert_near((double)material->pbr->roughness, roughness);
    assert_near((double)material->roughness, roughness);
}

static void materials_have_their_factors(void **state) {
    (void)state;
    DipModel *model = load("materials.gltf", NULL);
    const DipSceneDef *def = dip_model_scene_def(model);
    assert_reflection(def, "none", 1.0, 1.0);
    assert_reflection(def, "empty", 1.0, 1.0);
    assert_reflection(def, "metal", 0.75, 0.25);
    assert_reflection(def, "glossy", 0.0, 0.25);
    const DipMaterialDef *none = material_of(def, "none");
    assert_near_3(none->pbr->f0_lin, 0.04, 0.04, 0.04);
    assert_near_3(none->pbr->emission_lin, 0.0, 0.0, 0.0);
    assert_near((double)none->pbr->normal_scale, 1.0);
    assert_near((double)none->pbr->occlusion_strength, 1.0);
    assert_near((double)none->pbr->coat, 0.0);
    assert_int_equal(none->pbr->metal_rough_map, DIP_NO_TEXTURE);
    assert_int_equal(none->pbr->occlusion_map, DIP_NO_TEXTURE);
    assert_int_equal(none->pbr->emission_map, DIP_NO_TEXTURE);
    assert_near((double)none->pbr->f90, 1.0);
    assert_near_3(material_of(def, "specular")->pbr->f0_lin, 0.04, 0.02, 0.5);
    assert_near((double)material_of(def, "specular")->pbr->f90, 0.5);
    assert_near_3(material_of(def, "ior")->pbr->f0_lin, 1.0 / 9, 1.0 / 9, 1.0 / 9);
    assert_near_3(material_of(def, "glossy")->pbr->f0_lin, 0.5, 0.25, 0.125);
    assert_near_3(material_of(def, "glossy")->base_colour_lin, 0.5, 0.25, 0.0);
    assert_near_3(material_of(def, "glow")->pbr->emission_lin, 4.0, 2.0, 0.0);
    assert_near((double)material_of(def, "rough normals")->pbr->normal_scale, 0.5);
    assert_near((double)material_of(def, "shaded")->pbr->occlusion_strength, 0.25);
    assert_near_3(material_of(def, "cloth")->pbr->sheen_lin, 0.5, 0.25, 1.0);
    assert_near((double)material_of(def, "cloth")->pbr->sheen_roughness, 0.75);
    assert_near_3(none->pbr->sheen_lin, 0.0, 0.0, 0.0);
    assert_near((double)material_of(def, "coat")->pbr->coat, 0.5);
    assert_near((double)material_of(def, "coat")->pbr->coat_roughness, 0.125);
    assert_false(material_of(def, "unlit")->lit);
    assert_null(material_of(def, "unlit")->pbr);
    dip_model_destroy(&model);
}

// Without factors, a surface of old files is white and a perfect mirror.
static void old_surfaces_have_default_factors(void **state) {
    (void)state;
    DipModel *model = load("ridge.gltf", NULL);
    const DipSceneDef *def = dip_model_scene_def(model);
    assert_reflection(def, "ridge", 0.0, 0.0);
    assert_near_3(material_of(def, "ridge")->base_colour_lin, 1.0, 1.0, 1.0);
    assert_near_3(material_of(def, "ridge")->pbr->f0_lin, 1.0, 1.0, 1.0);
    assert_near((double)material_of(def, "ridge")->pbr->f90, 1.0);
    dip_model_destroy(&model);
}

// The picture has the texels (1, 0, 1) with alpha 1 and (0, 0, 1) with alpha 0.2, of which the
// material takes the means. Without its picture, a material is a dielectric and no mirror.
static void specular_pictures_are_drawn_as_their_means(void **state) {
    (void)state;
    DipErrorList warnings = {0};
    DipModel *model = load("glossy.gltf", &warnings);
    const DipSceneDef *def = dip_model_scene_def(model);
    const DipPbrDef *alone = material_of(def, "alone")->pbr;
    assert_near_3(alone->f0_lin, 0.5, 0.0, 0.5);
    assert_near((double)alone->roughness, 1.0 - 0.5 * 0.6);
    assert_near((double)alone->metallic, 0.0);
    assert_near_3(material_of(def, "alone")->base_colour_lin, 0.5, 0.25, 0.0);
    const DipPbrDef *beside = material_of(def, "beside")->pbr;
    assert_near((double)beside->metallic, 0.25);
    assert_near_3(beside->f0_lin, 0.04, 0.04, 0.04);
    assert_near_3(material_of(def, "beside")->base_colour_lin, 1.0, 1.0, 1.0);
    assert_true(beside->metal_rough_map >= 0);
    const DipPbrDef *lost = material_of(def, "lost")->pbr;
    assert_near_3(lost->f0_lin, 0.04, 0.04, 0.04);
    assert_near((double)lost->roughness, 0.5);
    assert_int_equal(warnings.count, 2);
    assert_string_equal(warnings.items[0].message,
                        "only the mean of the picture specularGlossinessTexture is drawn");
    assert_string_equal(warnings.items[0].key, "alone");
    assert_non_null(strstr(warnings.items[1].message, "lost.png"));
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
}

static void assert_texture(const DipSceneDef *def, int index, DipEncoding encoding) {
    assert_true(index >= 0);
    assert_int_equal(def->textures[index].encoding, encoding);
    assert_int_equal(def->textures[index].rgba8[1], 20);
}

static void materials_have_their_pictures(void **state) {
    (void)state;
    DipModel *model = load("materials.gltf", NULL);
    const DipSceneDef *def = dip_model_scene_def(model);
    assert_texture(def, material_of(def, "metal")->pbr->metal_rough_map, DIP_ENCODING_LINEAR);
    assert_texture(def, material_of(def, "glow")->pbr->emission_map, DIP_ENCODING_SRGB);
    assert_texture(def, material_of(def, "shaded")->pbr->occlusion_map, DIP_ENCODING_LINEAR);
    assert_texture(def, material_of(def, "rough normals")->normal_map, DIP_ENCODING_LINEAR);
    const DipTextureDef *mirrored = &def->textures[material_of(def, "mirrored")->colour_texture];
    assert_int_equal(mirrored->wrap_u, DIP_WRAP_MIRROR);
    assert_int_equal(mirrored->wrap_v, DIP_WRAP_CLAMP);
    dip_model_destroy(&model);
}

static void transparent_surfaces_are_blended(void **state) {
    (void)state;
    DipErrorList warnings = {0};
    DipModel *model = load("materials.gltf", &warnings);
    const DipSceneDef *def = dip_model_scene_def(model);
    static const struct {
        const char *name;
        DipSurface surface;
        double opacity;
    } expected[] = {
        {"none", DIP_SURFACE_OPAQUE, 1.0},         {"pane", DIP_SURFACE_BLENDED, 1.0},
        {"blend", DIP_SURFACE_BLENDED, 0.5},       {"blend picture", DIP_SURFACE_BLENDED, 1.0},
        {"blend opaque", DIP_SURFACE_OPAQUE, 1.0},
    };
    for (size_t i = 0; i < sizeof expected / sizeof *expected; ++i) {
        const DipMaterialDef *material = material_of(def, expected[i].name);
        assert_int_equal(material->surface, expected[i].surface);
        assert_near((double)material->opacity, expected[i].opacity);
    }
    assert_true(material_of(def, "blend")->double_sided);
    assert_near((double)material_of(def, "pane")->pbr->transmission, 0.5);
    assert_near((double)material_of(def, "blend")->pbr->transmission, 0.0);
    assert_near((double)material_of(def, "pane")->pbr->scattering, 0.5);
    assert_near((double)material_of(def, "blend")->pbr->scattering, 0.0);
    assert_int_equal(warnings.count, 1);
    assert_non_null(strstr(warnings.items[0].message,
                           "KHR_materials_transmission is drawn without refraction"));
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
}

// The colour reads set 1, moved to (4 v + 0.5, -2 u + 0.25); the others read set 0.
static void textures_have_coordinates_of_their_own(void **state) {
    (void)state;
    DipErrorList warnings = {0};
    DipModel *model = load("coordinates.gltf", &warnings);
    const DipSceneDef *def = dip_model_scene_def(model);
    const DipMeshDef *mesh = mesh_of(def, "many");
    static const double uv0[3][2] = {{0.5, 0.25}, {0.5, -1.75}, {4.5, 0.25}};
    static const double uv1[3][2] = {{0.0, 0.0}, {0.5, 0.0}, {0.0, 0.5}};
    for (uint32_t i = 0; i < 3; ++i) {
        for (int k = 0; k < 2; ++k) {
            assert_near((double)corner(mesh, mesh->uv0, i, 2)[k], uv0[i][k]);
            assert_near((double)corner(mesh, mesh->uv1, i, 2)[k], uv1[i][k]);
        }
    }
    const DipMaterialDef *material = material_of(def, "many");
    assert_true(material->pbr->emission_at_uv1 && material->pbr->emission_map >= 0);
    assert_true(material->pbr->occlusion_at_uv1 && material->pbr->occlusion_map >= 0);
    assert_int_equal(material->normal_map, DIP_NO_TEXTURE);
    assert_int_equal(warnings.count, 1);
    assert_non_null(strstr(warnings.items[0].message, "pictures are left out"));
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
}

// --- warnings ------------------------------------------------------------------------------------

static void features_that_are_not_drawn_are_named_once(void **state) {
    (void)state;
    static const char *const expected[] = {
        "the effect of the glTF extension KHR_materials_anisotropy is not drawn",
        "the glTF extension KHR_materials_variants is not drawn",
        "the effect of the glTF extension ACME_smell is not drawn",
        "the effect of the glTF extension KHR_materials_iridescence is not drawn",
        "the effect of the glTF extension ACME_nested is not drawn",
        "the glTF extension KHR_animation_pointer is not played",
        "morph targets do not move texture coordinates",
        "the scale of a normal map is not drawn on surfaces with a light map",
        "a mesh with a skin is drawn once, without its other copies",
        "the picture clearcoatTexture is not drawn",
        "the picture sheenColorTexture is not drawn",
        "a vertex follows its first four joints only",
        "the file has 2 scenes",
    };
    DipErrorList warnings = {0};
    DipModel *model = load("losses.gltf", &warnings);
    for (size_t i = 0; i < sizeof expected / sizeof *expected; ++i) {
        int count = 0;
        for (size_t w = 0; w < warnings.count; ++w) {
            count += strstr(warnings.items[w].message, expected[i]) != NULL;
        }
        if (count != 1) {
            fail_msg("%d warnings say '%s'", count, expected[i]);
        }
    }
    assert_int_equal(warnings.count, sizeof expected / sizeof *expected);
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
}

// --- packed files --------------------------------------------------------------------------------

// Returns the distance of two vertices in position and texture coordinates.
static double distance(const DipMeshDef *a, uint32_t i, const DipMeshDef *b, uint32_t k) {
    double most = 0.0;
    for (size_t c = 0; c < 3; ++c) {
        most = fmax(most, fabs((double)a->positions[3 * (size_t)i + c] -
                               (double)b->positions[3 * (size_t)k + c]));
    }
    return most;
}

// Every vertex of the packed hill lies near one of the plain hill, and looks like it. Packing moves
// vertices by less than 1e-3 and reorders them.
static void assert_same_hill(const char *name, bool has_picture) {
    DipErrorList warnings = {0};
    DipModel *plain_model = load("plain.gltf", NULL);
    DipModel *packed_model = load(name, &warnings);
    const DipSceneDef *plain_def = dip_model_scene_def(plain_model);
    const DipSceneDef *packed_def = dip_model_scene_def(packed_model);
    const DipMeshDef *plain = mesh_of(plain_def, "hill");
    const DipMeshDef *packed = &packed_def->meshes[0];
    const float *place = packed_def->objects[0].transform;
    assert_int_equal(packed->index_count, plain->index_count);
    assert_int_equal(packed->vertex_count, plain->vertex_count);
    float *moved = malloc(3 * sizeof *moved * packed->vertex_count);
    for (size_t i = 0; i < packed->vertex_count; ++i) {
        for (size_t row = 0; row < 3; ++row) {
            const float *p = packed->positions + 3 * i;
            const float *m = place + 4 * row;
            moved[3 * i + row] = m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3];
        }
    }
    DipMeshDef there = *packed;
    there.positions = moved;
    for (uint32_t i = 0; i < there.vertex_count; ++i) {
        uint32_t best = 0;
        for (uint32_t k = 1; k < plain->vertex_count; ++k) {
            best = distance(&there, i, plain, k) < distance(&there, i, plain, best) ? k : best;
        }
        assert_true(distance(&there, i, plain, best) < 1e-3);
        for (size_t c = 0; c < 3; ++c) {
            const size_t a = 3 * (size_t)i + c;
            const size_t b = 3 * (size_t)best + c;
            assert_true(fabsf(there.normals[a] - plain->normals[b]) < 0.02f);
            assert_true(fabsf(there.colours_lin[a] - plain->colours_lin[b]) < 0.01f);
        }
        for (size_t c = 0; has_picture && c < 2; ++c) {
            assert_true(fabsf(there.uv0[2 * (size_t)i + c] - plain->uv0[2 * (size_t)best + c]) <
                        1e-3f);
        }
    }
    free(moved);
    if (has_picture) {
        const DipTextureDef *a =
            &plain_def->textures[plain_def->materials[plain->material].colour_texture];
        const DipTextureDef *b =
            &packed_def->textures[packed_def->materials[packed->material].colour_texture];
        assert_int_equal(a->width * a->height, b->width * b->height);
        assert_memory_equal(a->rgba8, b->rgba8, 4 * 8 * 8);
        assert_int_equal(warnings.count, 0);
    } else {
        assert_int_equal(warnings.count, 1);
        assert_non_null(strstr(warnings.items[0].message, "KTX-Software"));
    }
    dip_error_list_free(&warnings);
    dip_model_destroy(&plain_model);
    dip_model_destroy(&packed_model);
}

// Checks that a build without the library names the package.
static void assert_names_package(const char *name, const char *package) {
    const char *path = gltf_path(name);
    DipError err = {0};
    assert_null(dip_model_load(&path, 1, NULL, NULL, &err));
    assert_int_equal(err.code, DIP_ERROR_UNSUPPORTED);
    assert_non_null(strstr(err.message, package));
}

static void packed_files_look_like_the_plain_one(void **state) {
    (void)state;
    assert_same_hill("packed_quantized.glb", true);
#ifdef DIP_HAS_MESHOPTIMIZER
    assert_same_hill("packed_meshopt.glb", true);
#else
    assert_names_package("packed_meshopt.glb", "libmeshoptimizer-dev");
#endif
#ifdef DIP_HAS_DRACO
    assert_same_hill("packed_draco.glb", true);
#else
    assert_names_package("packed_draco.glb", "libdraco-dev");
#endif
#ifdef DIP_HAS_WEBP
    assert_same_hill("packed_webp.glb", true);
#endif
    assert_same_hill("packed_ktx2.glb", false);
    (void)assert_names_package;
}

// --- a second opinion ----------------------------------------------------------------------------

static bool is_near(double value, double expected) {
    return fabs(value - expected) < 1e-5;
}

// Compares corner by corner with a mesh of assimp, which turns v upside down.
static bool is_same_mesh(const DipMeshDef *mesh, const struct aiMesh *other) {
    bool same =
        strcmp(other->mName.data, mesh->name) == 0 && mesh->index_count == 3 * other->mNumFaces;
    for (uint32_t i = 0; same && i < mesh->index_count; ++i) {
        const unsigned v = other->mFaces[i / 3].mIndices[i % 3];
        const struct aiVector3D p = other->mVertices[v];
        const float *position = corner(mesh, mesh->positions, i, 3);
        same = position[0] == p.x && position[1] == p.y && position[2] == p.z;
        if (same && other->mNormals) {
            const struct aiVector3D n = other->mNormals[v];
            const float *normal = corner(mesh, mesh->normals, i, 3);
            const double length = sqrt((double)(n.x * n.x + n.y * n.y + n.z * n.z));
            same = is_near((double)normal[0] * length, (double)n.x) &&
                   is_near((double)normal[1] * length, (double)n.y) &&
                   is_near((double)normal[2] * length, (double)n.z);
        }
        if (same && mesh->uv0) {
            const struct aiVector3D uv = other->mTextureCoords[0][v];
            const float *own = corner(mesh, mesh->uv0, i, 2);
            same = is_near((double)own[0], (double)uv.x) &&
                   is_near((double)own[1], 1.0 - (double)uv.y);
        }
    }
    return same;
}

static void assert_as_assimp(const char *path) {
    const struct aiScene *scene = aiImportFile(path, 0);
    DipError err = {0};
    DipModel *model = dip_model_load(&path, 1, NULL, NULL, &err);
    if (!model || !scene) {
        fail_msg("%s: %s", path, model ? aiGetErrorString() : err.message);
    }
    const DipSceneDef *def = dip_model_scene_def(model);
    for (int m = 0; m < def->mesh_count; ++m) {
        bool found = false;
        for (unsigned i = 0; !found && i < scene->mNumMeshes; ++i) {
            found = is_same_mesh(&def->meshes[m], scene->mMeshes[i]);
        }
        if (!found) {
            fail_msg("%s: assimp has no mesh like %s", path, def->meshes[m].name);
        }
    }
    aiReleaseImport(scene);
    dip_model_destroy(&model);
}

static void plain_files_agree_with_assimp(void **state) {
    (void)state;
    assert_as_assimp(fixture_data("square.gltf"));
    assert_as_assimp(fixture_data("instances.gltf"));
    assert_as_assimp(fixture_data("lights.gltf"));
    assert_as_assimp(gltf_path("plain.gltf"));
    assert_as_assimp(gltf_path("materials.gltf"));
    assert_as_assimp(DIP_ASSETS_DIR "/courtyard/court.gltf");
}

// --- malformed files -----------------------------------------------------------------------------

static uint32_t next_random(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

// Changes some bytes. In text, most changes replace a digit, so that the JSON stays readable.
static void mutate(uint8_t *bytes, size_t size_bytes, bool is_text, uint32_t *random) {
    for (uint32_t i = next_random(random) % 4 + 1; i > 0; --i) {
        size_t at = next_random(random) % size_bytes;
        for (int tries = 0; is_text && tries < 200 && !strchr("0123456789", bytes[at]); ++tries) {
            at = next_random(random) % size_bytes;
        }
        bytes[at] = is_text && next_random(random) % 8 != 0
                        ? (uint8_t)('0' + next_random(random) % 10)
                        : (uint8_t)next_random(random);
    }
}

// Loads mutated copies of a file. Each is refused with one line, or gives a scene that is in order.
// A third of them is cut.
static void check_mutations(const char *name, int count, const DipImporter *importer) {
    size_t size_bytes;
    uint8_t *whole = fixture_read(gltf_path(name), &size_bytes);
    uint8_t *bytes = malloc(size_bytes + 1);
    const bool is_text = strstr(name, ".gltf") != NULL;
    const DipModelOptions options = {.normal_maps = true, .importer = importer};
    const char *file = is_text ? "mutated.gltf" : "mutated.glb";
    uint32_t random = 1;
    for (int i = 0; i < count; ++i) {
        memcpy(bytes, whole, size_bytes);
        size_t size = size_bytes;
        if (next_random(&random) % 3 == 0) {
            size = next_random(&random) % size_bytes + 1;
        }
        mutate(bytes, size, is_text, &random);
        fixture_write(file, bytes, size);
        const char *path = fixture_path(file);
        DipErrorList warnings = {0};
        DipError err = {0};
        DipModel *model = dip_model_load_with(&path, 1, &options, NULL, &warnings, &err);
        if (model) {
            read_whole_scene(dip_model_scene_def(model));
        } else {
            assert_true(err.code != DIP_ERROR_NONE && err.message[0]);
            assert_null(strchr(err.message, '\n'));
        }
        dip_model_destroy(&model);
        dip_error_list_free(&warnings);
    }
    free(bytes);
    free(whole);
}

static void mutated_files_do_no_harm(void **state) {
    (void)state;
    static const char *const names[] = {
        "strips.gltf",     "sparse.gltf",      "quantized.gltf",  "colours.gltf",
        "materials.gltf",  "coordinates.gltf", "instancing.gltf", "shapes.gltf",
        "lamps.gltf",      "losses.gltf",      "plain.gltf",      "packed_meshopt.glb",
        "packed_webp.glb",
    };
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
        check_mutations(names[i], 300, NULL);
    }
}

// The library Draco may crash on bad input; that ends only the importer.
static void mutated_draco_files_do_no_harm_in_the_importer(void **state) {
    (void)state;
    const DipImporter importer = {
        .program = "/proc/self/exe", .command = importer_word, .wall_s = 20};
    check_mutations("packed_draco.glb", 60, &importer);
}

static void cut_files_say_that_they_end_too_early(void **state) {
    (void)state;
    static const char *const names[] = {"plain.gltf", "packed_quantized.glb"};
    for (size_t n = 0; n < 2; ++n) {
        size_t size_bytes;
        uint8_t *bytes = fixture_read(gltf_path(names[n]), &size_bytes);
        const char *file = n == 0 ? "cut.gltf" : "cut.glb";
        for (size_t size = 20; size + 4 < size_bytes; size += size_bytes / 23) {
            fixture_write(file, bytes, size);
            const char *path = fixture_path(file);
            DipError err = {0};
            assert_null(dip_model_load(&path, 1, NULL, NULL, &err));
            if (err.code != DIP_ERROR_TRUNCATED || !strstr(err.message, "ends too early")) {
                fail_msg("%s, %zu bytes: %s", file, size, err.message);
            }
        }
        free(bytes);
    }
}

// In glTF, the least signed integer stands for -1, like the one after it.
static void the_least_integers_are_minus_one(void **state) {
    (void)state;
    static const uint8_t bytes[] = {0x80, 0x81, 0x7f, 0x00, 0x80, 0x01, 0x80, 0xff, 0x7f};
    DipGltfAccessor accessor = {.bytes = bytes,
                                .stride_bytes = 1,
                                .count = 3,
                                .component = DIP_GLTF_BYTE,
                                .width = 1,
                                .normalized = true};
    for (int shorts = 0; shorts < 2; shorts++) {
        assert_true(dip_gltf_number(&accessor, 0, 0) == -1.0);
        assert_true(dip_gltf_number(&accessor, 1, 0) == -1.0);
        assert_true(dip_gltf_number(&accessor, 2, 0) == 1.0);
        accessor.bytes = bytes + 3;
        accessor.stride_bytes = 2;
        accessor.component = DIP_GLTF_SHORT;
    }
}

int main(int argc, char **argv) {
    if (argc > 2 && strcmp(argv[1], importer_word) == 0) {
        return dip_importer_run(argc - 2, argv + 2);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(strips_and_fans_become_triangles),
        cmocka_unit_test(missing_normals_are_those_of_the_triangles),
        cmocka_unit_test(sparse_accessors_list_what_differs),
        cmocka_unit_test(quantized_numbers_keep_their_meaning),
        cmocka_unit_test(vertex_colours_are_linear_and_clamped),
        cmocka_unit_test(vertex_alphas_belong_to_surfaces_that_clip_or_blend),
        cmocka_unit_test(instances_become_objects_of_one_mesh),
        cmocka_unit_test(skins_and_morph_targets_have_their_shape_at_rest),
        cmocka_unit_test(a_skin_without_matrices_has_identities),
        cmocka_unit_test(every_node_with_a_light_is_a_light),
        cmocka_unit_test(materials_have_their_factors),
        cmocka_unit_test(old_surfaces_have_default_factors),
        cmocka_unit_test(specular_pictures_are_drawn_as_their_means),
        cmocka_unit_test(materials_have_their_pictures),
        cmocka_unit_test(transparent_surfaces_are_blended),
        cmocka_unit_test(textures_have_coordinates_of_their_own),
        cmocka_unit_test(features_that_are_not_drawn_are_named_once),
        cmocka_unit_test(packed_files_look_like_the_plain_one),
        cmocka_unit_test(plain_files_agree_with_assimp),
        cmocka_unit_test(the_least_integers_are_minus_one),
        cmocka_unit_test(mutated_files_do_no_harm),
        cmocka_unit_test(mutated_draco_files_do_no_harm_in_the_importer),
        cmocka_unit_test(cut_files_say_that_they_end_too_early),
    };
    return cmocka_run_group_tests(tests, fixture_open, fixture_close);
}
