// Tests normal maps and the sky's clouds. Compares light with formulas that this file computes.
// Tests that clouds repeat after exact periods, and that a scene without these effects takes no
// work or memory for them.
#include "renderer/scene/materials/sky.h"
#include "tests/renderer/scene/stage.h"
#include "tests/renderer/scene/vec.h"
#include "tests/support/srgb.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { SIZE = 64 };

static const int64_t second_ns = INT64_C(1000000000);

static DipTestScene scene;

static Stage open_stage(bool plain_surfaces) {
    DipRendererDef def = stage_def(SIZE, SIZE, "");
    def.plain_surfaces = plain_surfaces;
    return stage_open(&scene.def, def, 1);
}

static DipFrame draw(const Stage *stage, int64_t time_ns) {
    return stage_draw(stage, &scene.pose, time_ns);
}

// --- normal maps -------------------------------------------------------------------------------

// Makes a wall in front of the eye, seen straight on. All texels of its normal map have the same
// normal.
static void make_wall(const int code[3], const float uv0[8], bool from_behind) {
    dip_test_scene_begin(&scene);
    const int map = dip_test_scene_add_bumps(&scene, 4);
    uint8_t *texels = dip_test_scene_texels(&scene, map);
    for (int i = 0; i < 16; i++) {
        for (int c = 0; c < 3; c++) {
            texels[4 * i + c] = (uint8_t)code[c];
        }
    }
    const int material = dip_test_scene_add_material(&scene, DIP_NO_TEXTURE);
    DipMaterialDef *wall = &scene.materials[material];
    wall->normal_map = map;
    wall->lit = true;
    wall->roughness = 0.6f;
    wall->double_sided = true;
    wall->base_colour_lin[0] = wall->base_colour_lin[1] = wall->base_colour_lin[2] = 0.5f;
    const DipTestMesh mesh =
        dip_test_scene_add_mesh(&scene, 4, 6, DIP_TEST_UV0 | DIP_TEST_NORMALS, material);
    const float side = from_behind ? -9.0f : 9.0f;
    const float positions[12] = {-side, -9, -5, side, -9, -5, side, 9, -5, -side, 9, -5};
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    memcpy(mesh.positions, positions, sizeof positions);
    memcpy(mesh.uv0, uv0, 8 * sizeof *uv0);
    memcpy(mesh.indices, indices, sizeof indices);
    for (int v = 0; v < 4; v++) {
        mesh.normals[3 * v + 2] = 1.0f;
    }
}

// Returns the light that docs/picture.md defines for a wall that is perpendicular to the view and
// has the normal n.
static double expected_light(Vec n, double map_length) {
    Vec sun = {-0.42, 0.67, 0.61};
    Vec half = {0.0, 0.0, 1.0};
    unit(n);
    unit(sun);
    for (int i = 0; i < 3; i++) {
        half[i] += sun[i];
    }
    unit(half);
    const double met = fmax(0.0, dot(n, sun));
    const double a2 = fmin(1.0, pow(0.6, 4.0) + 2.0 * fmax(0.0, 1.0 / map_length - 1.0));
    const double d = pow(fmax(0.0, dot(n, half)), 2.0) * (a2 - 1.0) + 1.0;
    const double lobe = a2 / (d * d * fmax(0.1, pow(dot(sun, half), 2.0)) * (4.0 * sqrt(a2) + 2.0));
    return 0.5 * (0.35 + 0.15 * n[1] + 0.65 * met) + 0.04 * 0.65 * met * lobe;
}

static void check_wall(const int code[3], const float uv0[8], bool from_behind, double right,
                       double up) {
    make_wall(code, uv0, from_behind);
    Stage stage = open_stage(false);
    const DipFrame frame = draw(&stage, 0);
    const Vec m = {(code[0] - 128) / 127.0, (code[1] - 128) / 127.0, (code[2] - 128) / 127.0};
    Vec n = {m[0] * right, m[1] * up, m[2]};
    if (right == 0.0) { // a triangle without area in texture space: the map has no effect
        n[0] = n[1] = 0.0;
        n[2] = 1.0;
    }
    const double expected = expected_light(n, sqrt(dot(m, m)));
    assert_float_equal(srgb_light(dip_image_centre(&frame)[1]), expected, 0.006);
    assert_int_equal(frame.counters.fragments_normal_mapped, frame.counters.fragments_shaded);
    assert_true(frame.effects.normal_map.run);
    stage_close(&stage);
    dip_test_scene_free(&scene);
}

static const float upright[8] = {0, 2, 2, 2, 2, 0, 0, 0}; // v grows downwards

static void light_on_normal_maps_follows_the_definition(void **state) {
    (void)state;
    static const float mirrored[8] = {2, 2, 0, 2, 0, 0, 2, 0};
    static const float upside_down[8] = {0, 0, 2, 0, 2, 2, 0, 2};
    static const int flat[3] = {128, 128, 255};
    static const int leaning[3] = {204, 64, 214};
    static const int tilted[3] = {52, 128, 230};
    static const int short_one[3] = {110, 150,
                                     190}; // shortened by filtering, which widens the highlight
    check_wall(flat, upright, false, 1, 1);
    check_wall(leaning, upright, false, 1, 1);
    check_wall(leaning, mirrored, false, -1, 1);
    check_wall(leaning, upside_down, false, 1, -1);
    check_wall(tilted, upright, false, 1, 1);
    check_wall(short_one, upright, false, 1, 1);
}

// Where the normals of a footprint cancel out, the mesh's own normal remains, and the highlight is
// as wide as possible.
static void normals_that_cancel_out_leave_the_meshs_normal(void **state) {
    (void)state;
    make_wall((const int[]){128, 128, 128}, upright, false);
    Stage stage = open_stage(false);
    const DipFrame frame = draw(&stage, 0);
    const double expected = expected_light((Vec){0.0, 0.0, 1.0}, 0.125);
    assert_float_equal(srgb_light(dip_image_centre(&frame)[1]), expected, 0.006);
    stage_close(&stage);
    dip_test_scene_free(&scene);
}

static void coordinates_without_area_leave_the_meshs_normal(void **state) {
    (void)state;
    static const int leaning[3] = {204, 64, 214};
    static const float point[8] = {0.3f, 0.4f, 0.3f, 0.4f, 0.3f, 0.4f, 0.3f, 0.4f};
    static const float line[8] = {0, 0, 2, 0, 2, 0, 0, 0};
    check_wall(leaning, point, false, 0, 0);
    check_wall(leaning, line, false, 0, 0);
}

// The mesh's normal applies to both sides. Seen from behind, u grows to the left.
static void both_sides_of_a_surface_have_the_same_normal(void **state) {
    (void)state;
    static const int leaning[3] = {204, 64, 214};
    check_wall(leaning, upright, true, -1, 1);
}

// --- the sky -----------------------------------------------------------------------------------

static void cloud_phases_repeat_exactly_and_advance_evenly(void **state) {
    (void)state;
    static const double speeds[] = {0.3, -0.2, 1.0, 7.77, -600.0, 0.001};
    for (size_t i = 0; i < sizeof speeds / sizeof *speeds; i++) {
        const int64_t period_ns = (int64_t)floor(60e9 / fabs(speeds[i]) + 0.5);
        for (int64_t t = -7; t < 20; t++) {
            const int64_t at = t * INT64_C(123456789);
            assert_true(dip_sky_phase(speeds[i], at) == dip_sky_phase(speeds[i], at + period_ns));
            assert_true(dip_sky_phase(speeds[i], at) ==
                        dip_sky_phase(speeds[i], at + 1000 * period_ns));
        }
        // In equal intervals, clouds must move equally far (modulo one texture width) at time 0 and
        // after 32 years.
        const int64_t late = INT64_C(1000000000) * second_ns + 12345;
        for (int frame = 0; frame < 100; frame++) {
            const int64_t dt = frame * INT64_C(16666667);
            const double early_step = dip_sky_phase(speeds[i], dt) - dip_sky_phase(speeds[i], 0);
            const double late_step =
                dip_sky_phase(speeds[i], late + dt) - dip_sky_phase(speeds[i], late);
            const double apart = late_step - early_step;
            assert_true(fabs(apart - rint(apart)) < 1e-12);
        }
    }
    assert_true(dip_sky_phase(0.0, second_ns) == 0.0);
    assert_true(dip_sky_phase(1e-7, second_ns) == 0.0);
    // The slowest layer that moves, and the next slower one.
    const int64_t slowest_period_ns = INT64_C(60000000000) * 1000000;
    assert_true(dip_sky_phase(1e-6, slowest_period_ns / 4) == 0.25);
    assert_true(dip_sky_phase(-1e-6, slowest_period_ns / 4) == 0.75);
    assert_true(dip_sky_phase(nextafter(1e-6, 0.0), slowest_period_ns / 4) == 0.0);
    assert_true(dip_sky_phase(-nextafter(1e-6, 0.0), slowest_period_ns / 4) == 0.0);
}

static void hash_at(const Stage *stage, int64_t time_ns, char hex[33]) {
    const DipFrame frame = draw(stage, time_ns);
    dip_frame_hash(&frame, hex);
}

static void clouds_move_and_repeat_exactly_after_their_period(void **state) {
    (void)state;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_sky);
    scene.def.sky.layers[0].speed_per_min = 0.5;   // repeats after 120 s
    scene.def.sky.layers[1].speed_per_min = -0.75; // repeats after 80 s; both after 240 s
    Stage stage = open_stage(false);
    const int64_t period_ns = 240 * second_ns;
    const int64_t long_ns = INT64_C(4166667) * period_ns; // 1e9 s + 80 s
    char first[33], again[33];
    for (int64_t t = 0; t < period_ns; t += 37 * second_ns) {
        hash_at(&stage, t, first);
        hash_at(&stage, t + period_ns, again);
        assert_string_equal(first, again);
        hash_at(&stage, t + long_ns, again);
        assert_string_equal(first, again);
        hash_at(&stage, t + 120 * second_ns,
                again); // 120 s are 1.5 periods of the second layer
        assert_string_not_equal(first, again);
        hash_at(&stage, t + second_ns, again);
        assert_string_not_equal(first, again);
    }
    stage_close(&stage);
    dip_test_scene_free(&scene);
}

// --- cost only where needed ----------------------------------------------------------------------

static void scenes_without_effects_spend_nothing_on_them(void **state) {
    (void)state;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_light_map);
    Stage stage = open_stage(false);
    const uint64_t bytes = dip_scene_texture_bytes(stage.scene);
    DipFrame frame = draw(&stage, 0);
    assert_int_equal(frame.counters.fragments_normal_mapped, 0);
    assert_int_equal(frame.counters.fragments_sky, 0);
    assert_false(frame.effects.normal_map.run);
    assert_false(frame.effects.sky.run);
    assert_string_equal(frame.effects.sky.why, "the scene has no sky with clouds");
    char hash[33], other[33];
    dip_frame_hash(&frame, hash);
    stage_close(&stage);
    // If no light falls on a surface, its normal map is neither created nor drawn.
    scene.materials[0].lit = false;
    scene.materials[0].light_map = DIP_NO_TEXTURE;
    stage = open_stage(false);
    const uint64_t unlit_bytes = dip_scene_texture_bytes(stage.scene);
    stage_close(&stage);
    assert_true(unlit_bytes < bytes);
    scene.materials[0].normal_map = dip_test_scene_add_bumps(&scene, 64);
    stage = open_stage(false);
    assert_int_equal(dip_scene_texture_bytes(stage.scene), unlit_bytes);
    stage_close(&stage);
    dip_test_scene_free(&scene);
    // With def.plain_surfaces, a normal-mapped scene has the same bits as the scene without its
    // maps.
    dip_test_scene_make(&scene, DIP_TEST_SCENE_normal_map);
    stage = open_stage(true);
    hash_at(&stage, 0, hash);
    assert_false(draw(&stage, 0).effects.normal_map.run);
    stage_close(&stage);
    for (int i = 0; i < scene.def.material_count; i++) {
        scene.materials[i].normal_map = DIP_NO_TEXTURE;
    }
    stage = open_stage(false);
    hash_at(&stage, 0, other);
    assert_string_equal(hash, other);
    stage_close(&stage);
    dip_test_scene_free(&scene);
}

static void only_effects_that_the_scene_has_take_memory(void **state) {
    (void)state;
    for (int kind = 0; kind < DIP_TEST_SCENE_COUNT; kind++) {
        dip_test_scene_make(&scene, (DipTestSceneKind)kind);
        Stage stage = open_stage(false);
        const DipCounters counters = draw(&stage, 0).counters;
        const bool all = kind == DIP_TEST_SCENE_water_effects;
        const bool lit = kind == DIP_TEST_SCENE_lights || kind == DIP_TEST_SCENE_gouraud_lights;
        const bool bumpy = kind == DIP_TEST_SCENE_normal_map || kind == DIP_TEST_SCENE_metal_gloss;
        assert_int_equal(counters.normal_map_bytes > 0, all || lit || bumpy);
        assert_int_equal(counters.cloud_bytes > 0, all || kind == DIP_TEST_SCENE_sky);
        assert_int_equal(counters.clip_map_bytes > 0, all || lit || kind == DIP_TEST_SCENE_fence ||
                                                          kind == DIP_TEST_SCENE_blending);
        stage_close(&stage);
        // Alpha that clips nothing is not stored.
        for (int i = 0; i < scene.def.material_count; i++) {
            if (scene.materials[i].surface == DIP_SURFACE_CLIPPED ||
                scene.materials[i].surface == DIP_SURFACE_BLENDED) {
                scene.materials[i].surface = DIP_SURFACE_OPAQUE;
            }
        }
        stage = open_stage(false);
        assert_int_equal(draw(&stage, 0).counters.clip_map_bytes, 0);
        stage_close(&stage);
        dip_test_scene_free(&scene);
    }
}

static void effects_out_of_view_do_not_run(void **state) {
    (void)state;
    static const DipTestSceneKind kinds[] = {DIP_TEST_SCENE_normal_map, DIP_TEST_SCENE_sky};
    for (int i = 0; i < 2; i++) {
        dip_test_scene_make(&scene, kinds[i]);
        Stage stage = open_stage(false);
        DipFrame frame = draw(&stage, 0);
        assert_true((i ? frame.effects.sky : frame.effects.normal_map).run);
        for (int k = 0; k < 4; k++) { // look straight down, from far below the scene
            scene.pose.orientation[k] = k == 0 ? -sqrt(0.5) : k == 3 ? sqrt(0.5) : 0.0;
        }
        scene.pose.position_world[1] = -50.0;
        frame = draw(&stage, 0);
        assert_false((i ? frame.effects.sky : frame.effects.normal_map).run);
        assert_int_equal(frame.counters.fragments_shaded, 0);
        stage_close(&stage);
        dip_test_scene_free(&scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_on_normal_maps_follows_the_definition),
        cmocka_unit_test(normals_that_cancel_out_leave_the_meshs_normal),
        cmocka_unit_test(coordinates_without_area_leave_the_meshs_normal),
        cmocka_unit_test(both_sides_of_a_surface_have_the_same_normal),
        cmocka_unit_test(cloud_phases_repeat_exactly_and_advance_evenly),
        cmocka_unit_test(clouds_move_and_repeat_exactly_after_their_period),
        cmocka_unit_test(scenes_without_effects_spend_nothing_on_them),
        cmocka_unit_test(only_effects_that_the_scene_has_take_memory),
        cmocka_unit_test(effects_out_of_view_do_not_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
