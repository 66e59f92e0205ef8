// Tests which numbers a scene's description may have. Every number has a range in scene.h and
// lights.h: its ends are accepted, and the next floats beyond them are refused, with the number's
// name. This holds for every element of an array, and for every light, material and mesh.
#include "renderer/catalogue/scenes.h"
#include "renderer/scene/resources/scene_check.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

// The scene has two of everything, and the tests change the second one.
static DipTestScene made;
static DipMaterialDef *material;
static DipPbrDef *pbr;
static DipMeshDef *mesh;
static DipObjectDef *object;
static DipLightDef *light;

static int set_up(void **state) {
    (void)state;
    dip_test_scene_begin(&made);
    for (int i = 0; i < 2; i++) {
        dip_test_scene_add_texture(&made, DIP_TEST_CHECKER, 4, 4);
        const int index = dip_test_scene_add_material(&made, DIP_NO_TEXTURE);
        pbr = dip_test_scene_add_pbr(&made, index, 0.5f, 0.5f);
        const DipTestMesh arrays = dip_test_scene_add_mesh(
            &made, 3, 3, DIP_TEST_NORMALS | DIP_TEST_UV0 | DIP_TEST_UV1 | DIP_TEST_COLOURS, index);
        arrays.indices[1] = 1;
        arrays.indices[2] = 2;
        made.lights[i] = (DipLightDef){.name = "lamp",
                                       .kind = DIP_LIGHT_SPOT,
                                       .direction_world = {0.0f, -1.0f, 0.0f},
                                       .attenuation = {0.0f, 0.0f, 1.0f},
                                       .inner_deg = 20.0f,
                                       .outer_deg = 30.0f};
    }
    made.lighting = (DipLightingDef){.lights = made.lights, .light_count = 2};
    made.def.lighting = &made.lighting;
    material = &made.materials[1];
    mesh = &made.meshes[1];
    object = &made.objects[1];
    light = &made.lights[1];
    return dip_scene_check(&made.def, NULL) ? 0 : 1;
}

static int tear_down(void **state) {
    (void)state;
    dip_test_scene_free(&made);
    return 0;
}

static void assert_accepted(void) {
    DipError err = {0};
    if (!dip_scene_check(&made.def, &err)) {
        fail_msg("%s: %s", err.key, err.message);
    }
}

// owner: the name of the material, mesh, object or light, or NULL.
static void assert_refused(const char *owner, const char *key) {
    DipError err = {.line = 7};
    if (dip_scene_check(&made.def, &err)) {
        fail_msg("%s is accepted", key);
    }
    assert_int_equal(err.code, DIP_ERROR_RANGE);
    assert_string_equal(err.file, owner ? owner : "");
    assert_int_equal(err.line, 0);
    assert_string_equal(err.key, key);
}

// Checks that each of some numbers is accepted from `least` to `most` and refused elsewhere. The
// numbers get their values back.
static void check_range(float *numbers, int count, float least, float most, const char *owner,
                        const char *key) {
    for (int i = 0; i < count; i++) {
        const float before = numbers[i];
        const float good[2] = {least, most};
        const float bad[] = {nextafterf(least, -INFINITY), nextafterf(most, INFINITY), NAN,
                             INFINITY, -INFINITY};
        for (int k = 0; k < 2; k++) {
            numbers[i] = good[k];
            assert_accepted();
        }
        for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
            numbers[i] = bad[k];
            assert_refused(owner, key);
        }
        numbers[i] = before;
    }
}

static void check_finite(float *numbers, int count, const char *owner, const char *key) {
    check_range(numbers, count, -FLT_MAX, FLT_MAX, owner, key);
}

static void numbers_of_materials_have_their_ranges(void **state) {
    (void)state;
    const char *name = material->name;
    check_finite(material->base_colour_lin, 3, name, "base_colour_lin");
    check_finite(&material->light_map_scale, 1, name, "light_map_scale");
    check_finite(&material->roughness, 1, name, "roughness");
    check_range(material->specular_lin, 3, 0, DIP_MAX_LIGHT_LIN, name, "specular_lin");
    check_range(&material->shininess, 1, 0, DIP_MAX_SHININESS, name, "shininess");
    check_finite(&material->alpha_cutoff, 1, name, "alpha_cutoff");
    check_range(&material->opacity, 1, 0, 1, name, "opacity");
    check_range(&material->transmission, 1, 0, 1, name, "transmission");
    check_range(&pbr->metallic, 1, 0, 1, name, "metallic");
    check_range(&pbr->roughness, 1, 0, 1, name, "roughness");
    check_range(pbr->f0_lin, 3, 0, 1, name, "f0_lin");
    check_range(&pbr->f90, 1, 0, 1, name, "f90");
    check_range(&pbr->occlusion_strength, 1, 0, 1, name, "occlusion_strength");
    check_range(pbr->emission_lin, 3, 0, DIP_MAX_LIGHT_LIN, name, "emission_lin");
    check_finite(&pbr->normal_scale, 1, name, "normal_scale");
    check_range(&pbr->coat, 1, 0, 1, name, "coat");
    check_range(&pbr->coat_roughness, 1, 0, 1, name, "coat_roughness");
    check_range(&pbr->transmission, 1, 0, 1, name, "pbr.transmission");
    check_range(&pbr->scattering, 1, 0, 1, name, "scattering");
    check_range(pbr->sheen_lin, 3, 0, 1, name, "sheen_lin");
    check_range(&pbr->sheen_roughness, 1, 0, 1, name, "sheen_roughness");
}

static void check_index(int *index, int least, int count, const char *owner, const char *key) {
    const int before = *index;
    for (int i = least; i < count; i++) {
        *index = i;
        assert_accepted();
    }
    for (int i = 0; i < 2; i++) {
        *index = i ? count : least - 1;
        assert_refused(owner, key);
    }
    *index = before;
}

static void indices_are_those_of_the_scene(void **state) {
    (void)state;
    const char *name = material->name;
    check_index(&material->colour_texture, DIP_NO_TEXTURE, 2, name, "colour_texture");
    check_index(&material->light_map, DIP_NO_TEXTURE, 2, name, "light_map");
    check_index(&material->normal_map, DIP_NO_TEXTURE, 2, name, "normal_map");
    check_index(&pbr->metal_rough_map, DIP_NO_TEXTURE, 2, name, "metal_rough_map");
    check_index(&pbr->occlusion_map, DIP_NO_TEXTURE, 2, name, "occlusion_map");
    check_index(&pbr->emission_map, DIP_NO_TEXTURE, 2, name, "emission_map");
    check_index(&mesh->material, 0, 2, mesh->name, "material");
    check_index(&object->mesh, 0, 2, object->name, "mesh");
}

static void numbers_of_meshes_and_objects_have_their_ranges(void **state) {
    (void)state;
    float alphas[3] = {1.0f, 1.0f, 1.0f};
    check_finite((float *)mesh->normals, 9, mesh->name, "normals");
    check_finite((float *)mesh->uv0, 6, mesh->name, "uv0");
    check_finite((float *)mesh->uv1, 6, mesh->name, "uv1");
    check_finite((float *)mesh->colours_lin, 9, mesh->name, "colours_lin");
    mesh->alphas = alphas;
    check_range(alphas, 3, 0, 1, mesh->name, "alphas");
    mesh->alphas = NULL;
    check_finite(object->transform, 12, object->name, "transform");
}

static void messages_name_the_element_and_what_is_accepted(void **state) {
    (void)state;
    static const struct {
        size_t number; // of mesh->normals
        const char *message;
    } rows[] = {{0, "number 0 of element 0 is inf, accepted finite numbers"},
                {5, "number 2 of element 1 is inf, accepted finite numbers"},
                {7, "number 1 of element 2 is inf, accepted finite numbers"}};
    DipError err = {0};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        ((float *)mesh->normals)[rows[i].number] = INFINITY;
        assert_false(dip_scene_check(&made.def, &err));
        assert_non_null(strstr(err.message, rows[i].message));
        ((float *)mesh->normals)[rows[i].number] = 0.0f;
    }
    material->opacity = 1.5f;
    assert_false(dip_scene_check(&made.def, &err));
    assert_non_null(strstr(err.message, "1.5 is out of range, accepted 0..1"));
    material->opacity = 1.0f;
    material->light_map = 2;
    assert_false(dip_scene_check(&made.def, &err));
    assert_non_null(strstr(err.message, "texture 2 is out of range, accepted 0..1, or -1"));
    material->light_map = DIP_NO_TEXTURE;
    mesh->material = object->mesh = 2;
    assert_false(dip_scene_check(&made.def, &err));
    assert_non_null(strstr(err.message, "2 is out of range, accepted 0..1"));
    mesh->material = 1;
    assert_false(dip_scene_check(&made.def, &err));
    assert_non_null(strstr(err.message, "2 is out of range, accepted 0..1"));
    object->mesh = 1;
    assert_accepted();
}

// --- the light -----------------------------------------------------------------------------------

static void numbers_of_lights_have_their_ranges(void **state) {
    (void)state;
    static const float most = DIP_MAX_LIGHT_LIN;
    check_range(light->colour_lin, 3, 0, most, "lamp", "colour_lin");
    check_finite(light->position_world, 3, "lamp", "position_world");
    light->direction_world[0] = 1.0f;
    check_finite(light->direction_world + 1, 2, "lamp", "direction_world");
    light->direction_world[0] = 0.0f;
    check_finite(light->direction_world, 1, "lamp", "direction_world");
    light->attenuation[1] = 1.0f; // No attenuation of 0 alone is accepted.
    check_range(light->attenuation, 1, 0, most, "lamp", "attenuation");
    check_range(light->attenuation + 2, 1, 0, most, "lamp", "attenuation");
    light->attenuation[1] = 0.0f;
    check_range(light->attenuation + 1, 1, 0, most, "lamp", "attenuation");
    check_range(&light->range_m, 1, 0, most, "lamp", "range_m");
    check_range(made.lighting.ambient_lin, 3, 0, most, NULL, "ambient_lin");
    for (int c = 0; c < 3; c++) {
        made.lighting.ambient_lin[c] = 0.75f;
        check_range(&made.lighting.sky_lin[c], 1, 0, 0.75f, NULL, "sky_lin");
    }
}

// At least one number of a direction, and of an attenuation, must not be 0.
static void lights_need_a_direction_and_an_attenuation(void **state) {
    (void)state;
    const DipLightDef before = *light;
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 3; k++) {
            light->direction_world[k] = k == i ? -FLT_MIN : 0.0f;
            light->attenuation[k] = 1.0f;
        }
        i < 3 ? assert_accepted() : assert_refused("lamp", "direction_world");
        for (int k = 0; k < 3; k++) {
            light->direction_world[k] = 1.0f;
            light->attenuation[k] = k == i ? FLT_MIN : 0.0f;
        }
        i < 3 ? assert_accepted() : assert_refused("lamp", "attenuation");
    }
    *light = before;
}

// 0 <= inner <= outer <= 90, and outer > 0.
static void cones_are_no_wider_than_a_half_space(void **state) {
    (void)state;
    static const struct {
        float inner, outer;
        bool good;
    } rows[] = {{0, 90, true},      {90, 90, true},  {0, FLT_MIN, true}, {0, 0, false},
                {20, 19.9f, false}, {-1, 30, false}, {0, 90.1f, false},  {0, -1, false},
                {NAN, 30, false},   {20, NAN, false}};
    const DipLightDef before = *light;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        light->inner_deg = rows[i].inner;
        light->outer_deg = rows[i].outer;
        rows[i].good ? assert_accepted() : assert_refused("lamp", "outer_deg");
    }
    *light = before;
}

// A light is checked for what its kind uses, and for nothing else.
static void lights_may_have_anything_that_their_kind_does_not_use(void **state) {
    (void)state;
    static const struct {
        DipLightKind kind;
        bool fades, points, has_cone;
    } kinds[] = {{DIP_LIGHT_DIRECTIONAL, false, true, false},
                 {DIP_LIGHT_POINT, true, false, false},
                 {DIP_LIGHT_SPOT, true, true, true}};
    const DipLightDef before = *light;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        for (int bad = 0; bad < 4; bad++) {
            *light = before;
            light->kind = kinds[i].kind;
            if (bad == 1) {
                light->range_m = -1.0f;
                kinds[i].fades ? assert_refused("lamp", "range_m") : assert_accepted();
            } else if (bad == 2) {
                light->direction_world[1] = 0.0f;
                kinds[i].points ? assert_refused("lamp", "direction_world") : assert_accepted();
            } else if (bad == 3) {
                light->outer_deg = 100.0f;
                kinds[i].has_cone ? assert_refused("lamp", "outer_deg") : assert_accepted();
            } else {
                assert_accepted();
            }
        }
    }
    *light = before;
    light->kind = (DipLightKind)(DIP_LIGHT_SPOT + 1);
    assert_refused("lamp", "kind");
    *light = before;
}

static void lighting_has_up_to_64_lights(void **state) {
    (void)state;
    static DipLightDef lights[DIP_MAX_LIGHTS + 1];
    for (int i = 0; i <= DIP_MAX_LIGHTS; i++) {
        lights[i] = *light;
    }
    const DipLightingDef before = made.lighting;
    made.lighting.lights = lights;
    for (int count = -1; count <= DIP_MAX_LIGHTS + 1; count++) {
        made.lighting.light_count = count;
        count >= 0 && count <= 64 ? assert_accepted() : assert_refused(NULL, "lights");
    }
    made.lighting = before;
    made.lighting.shading = DIP_SHADING_GOURAUD;
    assert_accepted();
    made.lighting.shading = (DipShading)(DIP_SHADING_GOURAUD + 1);
    assert_refused(NULL, "shading");
    made.lighting = before;
}

static void each_of_several_is_checked(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        made.materials[i].opacity = -1.0f;
        assert_refused(made.materials[i].name, "opacity");
        made.materials[i].opacity = 1.0f;
        made.meshes[i].material = -1;
        assert_refused(made.meshes[i].name, "material");
        made.meshes[i].material = i;
        made.objects[i].mesh = -1;
        assert_refused(made.objects[i].name, "mesh");
        made.objects[i].mesh = i;
        made.lights[i].range_m = -1.0f;
        assert_refused("lamp", "range_m");
        made.lights[i].range_m = 0.0f;
    }
    assert_accepted();
}

static void nothing_behind_the_last_one_is_checked(void **state) {
    (void)state;
    made.objects[1].mesh = made.meshes[1].material = -1;
    made.materials[1].opacity = made.lights[1].range_m = -1.0f;
    made.lighting.light_count = made.def.object_count = 1;
    made.def.mesh_count = made.def.material_count = 1;
    assert_accepted();
    made.lighting.light_count = made.def.object_count = 2;
    made.def.mesh_count = made.def.material_count = 2;
    made.objects[1].mesh = made.meshes[1].material = 1;
    made.materials[1].opacity = 1.0f;
    made.lights[1].range_m = 0.0f;
    assert_accepted();
}

// --- the surroundings ----------------------------------------------------------------------------

static void environments_are_twice_as_wide_as_high(void **state) {
    (void)state;
    enum { W = 4096 };
    static float texels[3 * W * (W / 2)];
    static const struct {
        int width, height;
        bool good;
    } rows[] = {{2, 1, true},   {4, 2, true},  {W, W / 2, true},          {0, 0, false},
                {1, 0, false},  {4, 1, false}, {W + 2, W / 2 + 1, false}, {6, 2, false},
                {-2, -1, false}};
    DipEnvironmentDef environment = {.rgb_lin = texels};
    made.def.environment = &environment;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        environment.width = rows[i].width;
        environment.height = rows[i].height;
        rows[i].good ? assert_accepted() : assert_refused(NULL, "environment");
    }
    DipError err = {0};
    assert_false(dip_scene_check(&made.def, &err));
    assert_non_null(strstr(err.message, "-2x-1 texels, accepted 2x1..4096x2048"));
    environment.width = 4;
    environment.height = 2;
    check_range(texels, 4 * 2 * 3, 0, DIP_MAX_ENVIRONMENT_LIN, NULL, "environment");
    texels[4 * 2 * 3] = NAN; // behind the last texel
    assert_accepted();
    made.def.environment = NULL;
}

static void numbers_of_the_scene_have_their_ranges(void **state) {
    (void)state;
    check_range(&made.def.near_m, 1, DIP_MIN_NEAR_M, DIP_MAX_NEAR_M, NULL, "near_m");
    check_finite(made.def.background_lin, 3, NULL, "background_lin");
    for (int i = 0; i < 2; i++) {
        double *speed = &made.def.sky.layers[i].speed_per_min;
        for (int sign = -1; sign <= 1; sign += 2) {
            *speed = sign * 600.0;
            assert_accepted();
            *speed = sign * nextafter(600.0, INFINITY);
            assert_refused(NULL, "sky");
        }
        *speed = (double)NAN;
        assert_refused(NULL, "sky");
        *speed = 0.0;
    }
    DipSkyDef *sky = &made.def.sky;
    for (int i = 0; i < 2; i++) {
        check_finite(&sky->layers[i].scale, 1, NULL, "sky.scale");
        check_finite(&sky->layers[i].perturbation_widths, 1, NULL, "sky.perturbation_widths");
    }
    check_finite(&sky->perturbation_scale, 1, NULL, "sky.perturbation_scale");
    check_finite(&sky->blend, 1, NULL, "sky.blend");
    check_finite(&sky->clear, 1, NULL, "sky.clear");
    check_finite(&sky->dense, 1, NULL, "sky.dense");
    check_finite(&sky->overcast, 1, NULL, "sky.overcast");
    check_finite(sky->zenith_lin, 3, NULL, "sky.zenith_lin");
    check_finite(sky->horizon_lin, 3, NULL, "sky.horizon_lin");
    check_finite(sky->cloud_lin, 3, NULL, "sky.cloud_lin");
    check_finite(sky->glare_lin, 3, NULL, "sky.glare_lin");
    check_finite(sky->tint_lin, 3, NULL, "sky.tint_lin");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_of_materials_have_their_ranges),
        cmocka_unit_test(indices_are_those_of_the_scene),
        cmocka_unit_test(numbers_of_meshes_and_objects_have_their_ranges),
        cmocka_unit_test(messages_name_the_element_and_what_is_accepted),
        cmocka_unit_test(numbers_of_lights_have_their_ranges),
        cmocka_unit_test(lights_need_a_direction_and_an_attenuation),
        cmocka_unit_test(cones_are_no_wider_than_a_half_space),
        cmocka_unit_test(lights_may_have_anything_that_their_kind_does_not_use),
        cmocka_unit_test(lighting_has_up_to_64_lights),
        cmocka_unit_test(each_of_several_is_checked),
        cmocka_unit_test(nothing_behind_the_last_one_is_checked),
        cmocka_unit_test(environments_are_twice_as_wide_as_high),
        cmocka_unit_test(numbers_of_the_scene_have_their_ranges),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
