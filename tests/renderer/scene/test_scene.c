// Tests the creation of scenes: computes bounds, and refuses inconsistent descriptions.
#include "renderer/scene/scene.h"
#include "renderer/catalogue/scenes.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static DipTestScene scene;

// Adds a quad with sides of 2 m around (x, 0, -5), with a material of the given surface.
static void add_quad_at(float x, DipSurface surface) {
    const int material = dip_test_scene_add_material(&scene, DIP_NO_TEXTURE);
    scene.materials[material].surface = surface;
    dip_test_scene_add_quad(&scene, material, (const float[]){x - 1, -1, -5},
                            (const float[]){2, 0, 0}, (const float[]){0, 2, 0}, 1, 1);
}

static void assert_bounds_x(float low, float high) {
    float min[3];
    float max[3];
    DipScene *made = dip_scene_create(&scene.def, NULL, NULL);
    assert_non_null(made);
    dip_scene_bounds(made, min, max);
    assert_true(fabsf(min[0] - low) < 1e-5f && fabsf(max[0] - high) < 1e-5f);
    dip_scene_destroy(&made);
    assert_null(made);
}

static void bounds_ignore_the_sky_if_there_are_other_surfaces(void **state) {
    (void)state;
    dip_test_scene_begin(&scene);
    assert_bounds_x(0, 0); // an empty scene
    add_quad_at(100, DIP_SURFACE_SKY);
    assert_bounds_x(99, 101);
    add_quad_at(5, DIP_SURFACE_WATER);
    assert_bounds_x(4, 6);
    add_quad_at(-3, DIP_SURFACE_OPAQUE);
    assert_bounds_x(-4, 6);
    dip_test_scene_free(&scene);
}

static void expect_refusal(DipErrorCode code, const char *key) {
    DipError err = {0};
    assert_null(dip_scene_create(&scene.def, NULL, &err));
    assert_int_equal(err.code, code);
    assert_string_equal(err.key, key);
    assert_true(strlen(err.message) > 0);
}

static void inconsistent_descriptions_are_refused(void **state) {
    (void)state;
    dip_test_scene_begin(&scene);
    add_quad_at(0, DIP_SURFACE_OPAQUE);
    const int bad_textures[] = {-2, 0, 99};
    for (int i = 0; i < 3; i++) {
        scene.materials[0].colour_texture = bad_textures[i];
        expect_refusal(DIP_ERROR_RANGE, "colour_texture");
    }
    scene.materials[0].colour_texture = DIP_NO_TEXTURE;
    scene.materials[0].light_map = 7;
    expect_refusal(DIP_ERROR_RANGE, "light_map");
    scene.materials[0].light_map = DIP_NO_TEXTURE;
    scene.meshes[0].material = 1;
    expect_refusal(DIP_ERROR_RANGE, "material");
    scene.meshes[0].material = 0;
    scene.objects[0].mesh = -1;
    expect_refusal(DIP_ERROR_RANGE, "mesh");
    scene.objects[0].mesh = 0;
    scene.objects[0].transform[7] = NAN;
    expect_refusal(DIP_ERROR_RANGE, "transform");
    scene.objects[0].transform[7] = 0;
    const float near_distances[] = {0.0f, -1.0f, INFINITY, NAN};
    for (int i = 0; i < 4; i++) {
        scene.def.near_m = near_distances[i];
        expect_refusal(DIP_ERROR_RANGE, "near_m");
    }
    scene.def.near_m = 0.1f;
    assert_bounds_x(-1, 1);
    dip_test_scene_free(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bounds_ignore_the_sky_if_there_are_other_surfaces),
        cmocka_unit_test(inconsistent_descriptions_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
