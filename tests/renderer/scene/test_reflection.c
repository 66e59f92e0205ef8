// Compares the reflection in water with the mirrored scene drawn directly, and tests hard cases of
// reflections. Also tests the plan, which decides per frame which effects are drawn: effects that
// it leaves out must not be visible, and a scene without water must not take work for reflections.
#include "renderer/reference/reference.h"
#include "renderer/catalogue/random.h"
#include "tests/renderer/scene/stage.h"
#include "tests/support/srgb.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 192, HEIGHT = 144, MIRRORED_WIDTH = 96, MIRRORED_HEIGHT = 72 };

static const double pi = 3.14159265358979323846;

static Stage open_stage(const DipSceneDef *scene, int width, int height,
                        const DipReflectionDef *reflection, bool force_all) {
    DipRendererDef def = stage_def(width, height, "");
    def.reflection = *reflection;
    def.force_all_effects = force_all;
    return stage_open(scene, def, 1);
}

static DipFrame draw(const Stage *stage, const DipPose *pose) {
    return stage_draw(stage, pose, 0);
}

// Turns the camera about the vertical axis, then down, by angles in degrees.
static void turn(DipPose *pose, double yaw_deg, double down_deg) {
    const double yaw = yaw_deg * pi / 360.0;
    const double pitch = -down_deg * pi / 360.0;
    pose->orientation[0] = cos(yaw) * sin(pitch);
    pose->orientation[1] = sin(yaw) * cos(pitch);
    pose->orientation[2] = -sin(yaw) * sin(pitch);
    pose->orientation[3] = cos(yaw) * cos(pitch);
}

static int add_water(DipTestScene *scene, const float corner[3], float size_x, float size_z) {
    const int material = dip_test_scene_add_material(scene, DIP_NO_TEXTURE);
    scene->materials[material].surface = DIP_SURFACE_WATER;
    dip_test_scene_add_quad(scene, material, corner, (const float[]){size_x, 0, 0},
                            (const float[]){0, 0, -size_z}, 1, 1);
    return material;
}

// Adds single-sided triangles with colours and a texture. The y coordinates of their corners lie
// between low and high.
static void add_soup(DipTestScene *scene, int texture, Random *random, double low, double high) {
    enum { TRIANGLES = 120 };
    const int material = dip_test_scene_add_material(scene, texture);
    const DipTestMesh mesh = dip_test_scene_add_mesh(scene, 3 * TRIANGLES, 3 * TRIANGLES,
                                                     DIP_TEST_UV0 | DIP_TEST_COLOURS, material);
    for (int t = 0; t < TRIANGLES; t++) {
        const double centre[3] = {random_real(random, -6.0, 6.0), 0.0,
                                  random_real(random, -6.0, 6.0)};
        for (int v = 3 * t; v < 3 * t + 3; v++) {
            mesh.positions[3 * v] = (float)(centre[0] + random_real(random, -1.2, 1.2));
            mesh.positions[3 * v + 1] = (float)random_real(random, low, high);
            mesh.positions[3 * v + 2] = (float)(centre[2] + random_real(random, -1.2, 1.2));
            mesh.uv0[2 * v] = (float)random_real(random, -1.0, 2.0);
            mesh.uv0[2 * v + 1] = (float)random_real(random, -1.0, 2.0);
            for (int c = 0; c < 3; c++) {
                mesh.colours_lin[3 * v + c] = (float)random_real(random, 0.0, 1.0);
            }
            mesh.indices[v] = (uint32_t)v;
        }
    }
}

static void decode_frame(const DipFrame *frame, double *rgb_lin) {
    for (int i = 0; i < frame->width * frame->height; i++) {
        const uint8_t *pixel = dip_image_pixel(frame, i % frame->width, i / frame->width);
        for (int c = 0; c < 3; c++) {
            rgb_lin[3 * i + c] = srgb_light(pixel[c]);
        }
    }
}

// The first renderer draws water at a random level, random triangles above the water and others
// below. The second renderer draws only the triangles above, mirrored by their object's transform.
// For this test, the first renderer also shows its mirrored picture in a corner of the frame. This
// corner must equal the second renderer's picture.
static bool mirrors_at(Random *random, int index, const char *settings) {
    static DipTestScene scene;
    static double expected[MIRRORED_WIDTH * MIRRORED_HEIGHT * 3];
    const double level = random_real(random, -3.0, 3.0);
    dip_test_scene_begin(&scene);
    const int texture = dip_test_scene_add_texture(&scene, DIP_TEST_NOISE, 32, 32);
    add_soup(&scene, texture, random, level + 0.01, level + 5.0);
    add_soup(&scene, texture, random, level - 4.0, level - 1.0);
    add_water(&scene, (const float[]){-6, (float)level, 6}, 12, 12);
    DipReflectionDef reflection = {MIRRORED_WIDTH, MIRRORED_HEIGHT, level, false, true};
    Stage stage = open_stage(&scene.def, WIDTH, HEIGHT, &reflection, false);

    scene.def.object_count = 1;
    scene.objects[0].transform[5] = -1.0f;
    scene.objects[0].transform[7] = (float)(2.0 * level);
    reflection.width = 0;
    Stage direct = open_stage(&scene.def, MIRRORED_WIDTH, MIRRORED_HEIGHT, &reflection, false);

    DipPose pose = scene.pose;
    pose.fov_y_deg = random_real(random, 20.0, 100.0);
    turn(&pose, random_real(random, -180.0, 180.0), random_real(random, -20.0, 90.0));
    for (int axis = 0; axis < 3; axis++) {
        pose.position_world[axis] = random_real(random, -4.0, 4.0);
    }
    pose.position_world[1] = level + random_real(random, 0.01, 4.0);
    DipQuality quality;
    assert_true(dip_quality_parse(settings, &quality, NULL));
    assert_true(dip_renderer_set_quality(stage.renderer, &quality, NULL));
    assert_true(dip_renderer_set_quality(direct.renderer, &quality, NULL));
    const DipFrame truth = draw(&direct, &pose);
    decode_frame(&truth, expected);
    DipFrame corner = draw(&stage, &pose);
    corner.width = MIRRORED_WIDTH;
    corner.height = MIRRORED_HEIGHT;
    // A vertex position halfway between two steps of 1/256 pixel may be rounded to either step.
    static const DipImageBounds bounds = {0.02, 0.02, 0.01, 1.0};
    char name[64];
    snprintf(name, sizeof name, "mirrored_%d", index);
    const bool same = dip_image_check(name, expected, &corner, &bounds);
    stage_close(&stage);
    stage_close(&direct);
    dip_test_scene_free(&scene);
    return same;
}

static void the_mirrored_picture_shows_the_mirrored_scene(void **state) {
    (void)state;
    static const char *const settings[] = {"aa=none", "aa=4,af=16,aaf=on", "mipdebug=on"};
    Random random = {5};
    int missed = 0;
    for (int i = 0; i < 60; i++) {
        missed += !mirrors_at(&random, i, settings[i % 3]);
    }
    assert_int_equal(missed, 0);
}

// --- hard cases --------------------------------------------------------------------------------

// Makes a closed grey room that is flooded up to 0.3 m. The background behind the room has another
// colour.
static void make_room(DipTestScene *scene) {
    static const float sides[6][9] = {
        {-4, -1, -4, 8, 0, 0, 0, 4, 0}, {4, -1, 4, -8, 0, 0, 0, 4, 0},
        {-4, -1, 4, 0, 0, -8, 0, 4, 0}, {4, -1, -4, 0, 0, 8, 0, 4, 0},
        {-4, 3, -4, 8, 0, 0, 0, 0, 8},  {-4, -1, 4, 8, 0, 0, 0, 0, -8},
    };
    dip_test_scene_begin(scene);
    const int grey = dip_test_scene_add_material(scene, DIP_NO_TEXTURE);
    const int water = add_water(scene, (const float[]){-4, 0.3f, 4}, 8, 8);
    scene->materials[water].double_sided = true;
    for (int i = 0; i < 6; i++) {
        dip_test_scene_add_quad(scene, grey, sides[i], sides[i] + 3, sides[i] + 6, 1, 1);
    }
    for (int c = 0; c < 3; c++) {
        scene->materials[grey].base_colour_lin[c] = 0.5f;
        scene->materials[water].base_colour_lin[c] = 0.5f;
        scene->def.background_lin[c] = c == 1 ? 0.0f : 1.0f;
    }
    scene->reflection = (DipReflectionDef){.width = 61, .height = 47, .level_m = 0.3};
}

static int other_than_grey(const DipFrame *frame) {
    int count = 0;
    for (int i = 0; i < frame->width * frame->height; i++) {
        const uint8_t *pixel = dip_image_pixel(frame, i % frame->width, i / frame->width);
        count += abs(pixel[0] - 188) > 1 || abs(pixel[1] - 188) > 1 || abs(pixel[2] - 188) > 1;
    }
    return count;
}

// Every surface is grey, and the water reflects only grey surfaces, so any other colour comes from
// the background. The eye moves from far above the water to its surface and below. The eye stays
// away from the walls: if it looked down along a wall, a pixel would cover much of the wall's
// height.
static void no_background_shows_at_the_waterline(void **state) {
    (void)state;
    static DipTestScene scene;
    static const double heights[] = {2.0,  0.5,   0.1, 1e-2,  1e-4, 1e-6,
                                     1e-9, 1e-14, 0.0, -1e-9, -1e-4};
    make_room(&scene);
    Stage stage = open_stage(&scene.def, WIDTH, HEIGHT, &scene.reflection, false);
    Random random = {9};
    int leaks = 0;
    for (int i = 0; i < 220; i++) {
        DipPose pose = scene.pose;
        pose.fov_y_deg = random_real(&random, 20.0, 70.0);
        turn(&pose, random_real(&random, -180.0, 180.0), random_real(&random, -30.0, 50.0));
        pose.position_world[0] = random_real(&random, -2.5, 2.5);
        pose.position_world[1] = scene.reflection.level_m + heights[i % 11];
        pose.position_world[2] = random_real(&random, -2.5, 2.5);
        const DipFrame frame = draw(&stage, &pose);
        leaks += other_than_grey(&frame);
        assert_true(frame.effects.reflection.run <= (heights[i % 11] > 0.0));
    }
    assert_int_equal(leaks, 0);
    stage_close(&stage);
    dip_test_scene_free(&scene);
}

// When the eye approaches the water's plane, the water covers less and less of the picture. From
// above and from below, the pictures must converge to the picture that an eye in the plane sees.
static void pictures_are_continuous_as_the_eye_crosses_the_water(void **state) {
    (void)state;
    static DipTestScene scene;
    static double in_plane[WIDTH * HEIGHT * 3];
    static double beside[WIDTH * HEIGHT * 3];
    static const double heights[] = {1e-5, 1e-7, 1e-12, -1e-12, -1e-7, -1e-5};
    dip_test_scene_make(&scene, DIP_TEST_SCENE_water_effects);
    Stage stage = open_stage(&scene.def, WIDTH, HEIGHT, &scene.reflection, false);
    Random random = {13};
    for (int i = 0; i < 40; i++) {
        DipPose pose = scene.pose;
        turn(&pose, random_real(&random, -180.0, 180.0), random_real(&random, -50.0, 50.0));
        pose.position_world[0] = random_real(&random, -3.0, 3.0);
        pose.position_world[2] = random_real(&random, -8.0, 1.0);
        pose.position_world[1] = scene.reflection.level_m;
        const DipFrame frame = draw(&stage, &pose);
        decode_frame(&frame, in_plane);
        for (size_t h = 0; h < sizeof heights / sizeof *heights; h++) {
            pose.position_world[1] = scene.reflection.level_m + heights[h];
            const DipFrame other = draw(&stage, &pose);
            decode_frame(&other, beside);
            const double rms = dip_image_rms(beside, in_plane, (size_t)WIDTH * HEIGHT * 3);
            assert_true(rms < (fabs(heights[h]) < 1e-6 ? 0.0005 : 0.005));
        }
    }
    stage_close(&stage);
    dip_test_scene_free(&scene);
}

// --- the plan ----------------------------------------------------------------------------------

static DipPose random_pose(Random *random, const DipPose *like, double level) {
    DipPose pose = *like;
    const double far = random_int(random, 0, 9) ? 1.0 : 1000.0;
    pose.fov_y_deg = random_real(random, 5.0, 120.0);
    turn(&pose, random_real(random, -180.0, 180.0), random_real(random, -60.0, 90.0));
    pose.position_world[0] = far * random_real(random, -5.0, 5.0);
    pose.position_world[1] = level + far * random_real(random, -0.3, 3.0);
    pose.position_world[2] = far * random_real(random, -8.0, 4.0);
    return pose;
}

static void force_all(DipTestSceneKind kind, const char *settings) {
    static DipTestScene scene;
    DipQuality quality;
    dip_test_scene_make(&scene, kind);
    assert_true(dip_quality_parse(settings, &quality, NULL));
    DipReflectionDef reflection = {333, 251, -0.8, false, false};
    Stage stages[2] = {open_stage(&scene.def, 320, 200, &reflection, false),
                       open_stage(&scene.def, 320, 200, &reflection, true)};
    for (int k = 0; k < 2; k++) {
        assert_true(dip_renderer_set_quality(stages[k].renderer, &quality, NULL));
    }
    Random random = {21};
    uint64_t spared = 0;
    int skipped = 0;
    int parts = 0;
    for (int i = 0; i < 150; i++) {
        if (i == 75) {
            reflection = (DipReflectionDef){640, 1000, -0.5, true, false};
            for (int k = 0; k < 2; k++) {
                assert_true(dip_renderer_set_reflection(stages[k].renderer, &reflection, NULL));
            }
        }
        const DipPose pose = random_pose(&random, &scene.pose, reflection.level_m);
        char hashes[2][33];
        DipFrame frames[2];
        for (int k = 0; k < 2; k++) {
            frames[k] = draw(&stages[k], &pose);
            dip_frame_hash(&frames[k], hashes[k]);
        }
        assert_string_equal(hashes[0], hashes[1]);
        assert_true(frames[0].counters.tiles_drawn + frames[0].counters.tiles_spared ==
                    frames[1].counters.tiles_drawn + frames[1].counters.tiles_spared);
        assert_true(frames[0].counters.fragments_shaded <= frames[1].counters.fragments_shaded);
        spared += frames[0].counters.tiles_spared - frames[1].counters.tiles_spared;
        skipped += frames[1].effects.reflection.run && !frames[0].effects.reflection.run;
        parts += frames[0].effects.reflection.run && frames[0].counters.tiles_spared > 0;
    }
    assert_true(spared > 1000);
    assert_in_range(skipped, 10, 140);
    assert_in_range(parts, 10, 140);
    stage_close(&stages[0]);
    stage_close(&stages[1]);
    dip_test_scene_free(&scene);
}

static void add_fence(DipTestScene *scene) {
    const int fence = dip_test_scene_add_material(scene, 0);
    scene->materials[fence].surface = DIP_SURFACE_CLIPPED;
    dip_test_scene_add_quad(scene, fence, (const float[]){-1, -0.5f, -4}, (const float[]){2, 0, 0},
                            (const float[]){0, 1, 0}, 1, 1);
}

static void forcing_all_effects_changes_nothing(void **state) {
    (void)state;
    force_all(DIP_TEST_SCENE_water, "aa=none");
    force_all(DIP_TEST_SCENE_water_effects, "aa=4,taa=on,aaa=on,af=4");
}

static void effects_report_why_they_run_or_not(void **state) {
    (void)state;
    static DipTestScene scene;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_water);
    add_fence(&scene);
    Stage stage = open_stage(&scene.def, WIDTH, HEIGHT, &scene.reflection, false);
    DipPose pose = scene.pose;
    assert_string_equal(draw(&stage, &pose).effects.reflection.why, "water is in view");
    assert_string_equal(draw(&stage, &pose).effects.alpha_clip.why,
                        "alpha-clipped surfaces are in view");
    turn(&pose, 180.0, 0.0);
    assert_string_equal(draw(&stage, &pose).effects.reflection.why, "no water is in view");
    assert_string_equal(draw(&stage, &pose).effects.alpha_clip.why,
                        "no alpha-clipped surface is in view");
    assert_int_equal(draw(&stage, &pose).counters.passes, 1);
    assert_int_equal(draw(&stage, &pose).counters.fragments_mirrored, 0);
    assert_int_equal(draw(&stage, &pose).counters.tiles_spared, 2 * 2);
    pose.position_world[1] = scene.reflection.level_m;
    assert_string_equal(draw(&stage, &pose).effects.reflection.why,
                        "the camera is not above the water");
    scene.reflection.width = 0;
    assert_true(dip_renderer_set_reflection(stage.renderer, &scene.reflection, NULL));
    assert_string_equal(draw(&stage, &pose).effects.reflection.why, "the reflection's size is 0");
    assert_int_equal(draw(&stage, &pose).counters.reflection_bytes, 0);
    DipError err;
    scene.reflection.width = 9000;
    assert_false(dip_renderer_set_reflection(stage.renderer, &scene.reflection, &err));
    assert_int_equal(err.code, DIP_ERROR_RANGE);
    scene.reflection = (DipReflectionDef){8, 8, NAN, false, false};
    assert_false(dip_renderer_set_reflection(stage.renderer, &scene.reflection, &err));
    stage_close(&stage);
    dip_test_scene_free(&scene);
}

// The camera looks down on one of two ponds that are one mesh, then between them, where their box
// has no water.
static void small_ponds_are_bounded_by_their_triangles(void **state) {
    (void)state;
    static DipTestScene scene;
    dip_test_scene_begin(&scene);
    const int material = dip_test_scene_add_material(&scene, DIP_NO_TEXTURE);
    scene.materials[material].surface = DIP_SURFACE_WATER;
    const DipTestMesh ponds = dip_test_scene_add_mesh(&scene, 6, 6, 0, material);
    for (uint32_t i = 0; i < 6; i++) {
        const float side = i < 3 ? -8.0f : 8.0f;
        ponds.positions[3 * i] = side + (float)(i % 3 == 2);
        ponds.positions[3 * i + 1] = 0.0f;
        ponds.positions[3 * i + 2] = side + (float)(i % 3 == 1);
        ponds.indices[i] = i;
    }
    const DipReflectionDef reflection = {MIRRORED_WIDTH, MIRRORED_HEIGHT, 0.0, false, false};
    Stage stage = open_stage(&scene.def, WIDTH, HEIGHT, &reflection, false);
    DipPose pose = scene.pose;
    pose.fov_y_deg = 40.0;
    turn(&pose, 0.0, 90.0);
    pose.position_world[1] = 3.0;
    pose.position_world[0] = pose.position_world[2] = -8.0;
    assert_string_equal(draw(&stage, &pose).effects.reflection.why, "water is in view");
    pose.position_world[0] = pose.position_world[2] = 0.0;
    assert_string_equal(draw(&stage, &pose).effects.reflection.why, "no water is in view");
    stage_close(&stage);
    dip_test_scene_free(&scene);
}

// A scene without water has no reflection to draw, even if all effects are forced.
static void a_scene_without_water_costs_nothing(void **state) {
    (void)state;
    static DipTestScene dry;
    static DipTestScene wet;
    dip_test_scene_make(&dry, DIP_TEST_SCENE_fence);
    dip_test_scene_make(&wet, DIP_TEST_SCENE_water);
    for (int force = 0; force < 2; force++) {
        Stage stage = open_stage(&dry.def, WIDTH, HEIGHT, &wet.reflection, force);
        DipScene *water = dip_scene_create(&wet.def, NULL, NULL);
        for (int i = 0; i < 3; i++) {
            DipFrame frame;
            assert_true(dip_renderer_draw(stage.renderer, i == 1 ? water : stage.scene, &dry.pose,
                                          0, &frame, NULL));
            assert_int_equal(frame.counters.passes, i == 1 ? 2 : 1);
            assert_int_equal(frame.counters.reflection_bytes, i == 1 ? 128 * 3 * 72 : 0);
            assert_int_equal(frame.effects.reflection.run, i == 1);
            if (i != 1) {
                assert_int_equal(frame.counters.tiles_spared, 0);
                assert_int_equal(frame.counters.fragments_mirrored, 0);
                assert_string_equal(frame.effects.reflection.why, "the scene has no water");
            }
        }
        dip_scene_destroy(&water);
        stage_close(&stage);
    }
    dip_test_scene_free(&dry);
    dip_test_scene_free(&wet);
}

// --- Fresnel -----------------------------------------------------------------------------------

// Black water lies under a white sky and is seen at an angle in the middle of the picture. The
// light there is therefore the share of light that the surface reflects. Fresnel's equations give
// this share from the angles on both sides of the surface. Clear water adds its part of the light
// of a grey floor, as far as the surface does not reflect it.
static void water_reflects_the_share_that_fresnel_gives(void **state) {
    (void)state;
    static DipTestScene scene;
    static const double transmissions[] = {0.0, 0.0, 0.6, 1.0};
    const double floor_light = 0.25;
    dip_test_scene_begin(&scene);
    const int water = add_water(&scene, (const float[]){-500, 0, 500}, 1000, 1000);
    const int floor = dip_test_scene_add_material(&scene, DIP_NO_TEXTURE);
    dip_test_scene_add_quad(&scene, floor, (const float[]){-9e3f, -1, 9e3f},
                            (const float[]){18e3f, 0, 0}, (const float[]){0, 0, -18e3f}, 1, 1);
    for (int c = 0; c < 3; c++) {
        scene.materials[water].base_colour_lin[c] = 0.0f;
        scene.materials[floor].base_colour_lin[c] = (float)floor_light;
        scene.def.background_lin[c] = 1.0f;
    }
    for (int i = 0; i < 4; i++) {
        const DipReflectionDef reflection = {32, 32, 0.0, i == 1, false};
        scene.materials[water].transmission = (float)transmissions[i];
        Stage stage = open_stage(&scene.def, 101, 101, &reflection, false);
        for (int down_deg = 1; down_deg <= 90; down_deg++) {
            DipPose pose = scene.pose;
            pose.position_world[1] = 1.0;
            pose.fov_y_deg = 1.0;
            turn(&pose, 30.0, down_deg);
            const DipFrame frame = draw(&stage, &pose);
            const uint8_t code = frame.rgba8[50 * frame.stride_bytes + 50 * 4];
            const double cos_in = sin(down_deg * pi / 180.0);
            const double r0 = pow(0.333 / 2.333, 2.0);
            const double out = asin(sqrt(1.0 - cos_in * cos_in) / 1.333);
            const double in = acos(fmin(cos_in, 1.0));
            const double exact = in < 1e-6 ? r0
                                           : 0.5 * (pow(sin(in - out) / sin(in + out), 2.0) +
                                                    pow(tan(in - out) / tan(in + out), 2.0));
            const double share = i == 1 ? r0 + (1.0 - r0) * pow(1.0 - cos_in, 5.0) : exact;
            const double light = share + (1.0 - share) * transmissions[i] * floor_light;
            assert_true(fabs(code - 255.0 * srgb_encode(light)) < 0.56);
            assert_int_equal(frame.effects.blend.run, transmissions[i] > 0.0);
        }
        stage_close(&stage);
    }
    dip_test_scene_free(&scene);
}

// --- the converged picture ---------------------------------------------------------------------

// The more pixels the mirrored picture has, the closer the drawn picture is to the converged one.
static void more_mirrored_pixels_approach_the_converged_picture(void **state) {
    (void)state;
    enum { W = 80, H = 60 };
    static DipTestScene scene;
    static double converged[W * H * 3];
    static double drawn[W * H * 3];
    dip_test_scene_make(&scene, DIP_TEST_SCENE_water);
    DipReference *reference = dip_reference_create(&scene.def, NULL);
    DipQuality quality;
    assert_non_null(reference);
    assert_true(dip_quality_parse("aa=8,af=16,aaf=on", &quality, NULL));
    double rms[4];
    for (int i = 0; i < 4; i++) {
        scene.reflection.width = i ? 20 << (i - 1) : 0;
        scene.reflection.height = 15 << (i ? i - 1 : 0);
        dip_reference_set_reflection(reference, &scene.reflection);
        if (i == 0) {
            assert_true(dip_reference_draw(reference, &quality, &scene.pose, W, H, drawn, NULL));
            scene.reflection.width = 20;
            dip_reference_set_reflection(reference, &scene.reflection);
            assert_true(
                dip_reference_converge(reference, &scene.pose, W, H, 64, 1, converged, NULL));
        } else {
            assert_true(dip_reference_draw(reference, &quality, &scene.pose, W, H, drawn, NULL));
        }
        rms[i] = dip_image_rms(drawn, converged, (size_t)W * H * 3);
        if (i) {
            assert_true(rms[i] < rms[i - 1]);
        }
    }
    dip_reference_destroy(&reference);
    dip_test_scene_free(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_mirrored_picture_shows_the_mirrored_scene),
        cmocka_unit_test(no_background_shows_at_the_waterline),
        cmocka_unit_test(pictures_are_continuous_as_the_eye_crosses_the_water),
        cmocka_unit_test(forcing_all_effects_changes_nothing),
        cmocka_unit_test(effects_report_why_they_run_or_not),
        cmocka_unit_test(small_ponds_are_bounded_by_their_triangles),
        cmocka_unit_test(a_scene_without_water_costs_nothing),
        cmocka_unit_test(water_reflects_the_share_that_fresnel_gives),
        cmocka_unit_test(more_mirrored_pixels_approach_the_converged_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
