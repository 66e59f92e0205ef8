// Tests surfaces that are large and pass close by the eye: what is computed from their far corners
// keeps its precision near the eye.
#include "tests/renderer/scene/stage.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 160, HEIGHT = 120 };

static int red_of(uint32_t pixel) {
    return (int)(pixel & 255);
}

// Begins a black scene with one light of strength 1, which shines along `direction`.
static void begin_scene(DipTestScene *scene, DipLightingDef *lighting, const float direction[3]) {
    dip_test_scene_begin(scene);
    memset(scene->def.background_lin, 0, sizeof scene->def.background_lin);
    scene->lights[0] = (DipLightDef){.kind = DIP_LIGHT_DIRECTIONAL,
                                     .colour_lin = {1.0f, 1.0f, 1.0f},
                                     .direction_world = {direction[0], direction[1], direction[2]}};
    *lighting = (DipLightingDef){.lights = scene->lights, .light_count = 1};
    scene->def.lighting = lighting;
}

// --- the distance of new corners -----------------------------------------------------------------

// Makes a double-sided triangle that reaches 9 km and passes `height` below the eye. Only what
// faces up is lit.
static void make_close_floor(DipTestScene *scene, float height) {
    static const float corners[3][2] = {
        {-8123.7f, -6211.3f}, {9011.9f, -3077.1f}, {517.3f, 8917.7f}};
    begin_scene(scene, &scene->lighting, (const float[3]){0.0f, -1.0f, 0.0f});
    scene->def.near_m = 1e-6f;
    const int material = dip_test_scene_add_material(scene, DIP_NO_TEXTURE);
    dip_test_scene_add_pbr(scene, material, 0.0f, 1.0f);
    scene->materials[material].double_sided = true;
    const DipTestMesh mesh = dip_test_scene_add_mesh(scene, 3, 3, DIP_TEST_NORMALS, material);
    for (int v = 0; v < 3; v++) {
        mesh.positions[3 * v] = corners[v][0];
        mesh.positions[3 * v + 2] = corners[v][1];
        mesh.normals[3 * v + 1] = 1.0f;
        mesh.indices[v] = (uint32_t)v;
    }
    scene->objects[0].transform[7] = -height;
}

// Returns true if the view ray through a pixel clearly points below the horizon.
static bool sees_below(const DipPose *pose, int pixel) {
    const double half_height = tan(pose->fov_y_deg * acos(-1.0) / 360.0);
    const double x = ((pixel % WIDTH + 0.5) * 2.0 - WIDTH) / HEIGHT * half_height;
    const double y = (1.0 - (pixel / WIDTH + 0.5) * 2.0 / HEIGHT) * half_height;
    const double *q = pose->orientation;
    const double ray_y = 2.0 * x * (q[0] * q[1] + q[2] * q[3]) +
                         y * (1.0 - 2.0 * (q[0] * q[0] + q[2] * q[2])) -
                         2.0 * (q[1] * q[2] - q[0] * q[3]);
    return ray_y < -0.05 * sqrt(x * x + y * y + 1.0);
}

// Turns the camera by a quaternion of any length.
static void turn_camera(DipPose *pose, const double q[4]) {
    const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int k = 0; k < 4; k++) {
        pose->orientation[k] = q[k] / length;
    }
}

// The near plane cuts the floor at corners whose distance is tiny beside that of the floor's own
// corners. Where it was interpolated in floats, it had either sign, and the floor was lit from
// below.
static void a_floor_close_below_the_eye_is_seen_from_above(void **state) {
    (void)state;
    static const double turns[][4] = {{0.1, 0.69, -0.1, 0.59}, {0.0, 0.38, 0.0, 0.92},
                                      {-0.2, 0.6, 0.15, 0.7},  {0.2, -0.3, 0.1, 0.9},
                                      {-0.1, 0.9, -0.2, 0.3},  {0.3, 0.1, 0.2, 0.9}};
    static uint32_t pixels[WIDTH * HEIGHT];
    for (size_t i = 0; i < sizeof turns / sizeof turns[0]; i++) {
        for (float height = 1e-5f; height < 1.0f; height *= 10.0f) {
            DipTestScene scene;
            make_close_floor(&scene, height);
            turn_camera(&scene.pose, turns[i]);
            scene.pose.fov_y_deg = 120.0;
            stage_draw_scene(&scene, WIDTH, HEIGHT, "", pixels);
            int lit = 0, dark = 0;
            for (int p = 0; p < WIDTH * HEIGHT; p++) {
                lit += red_of(pixels[p]) > 128;
                dark += red_of(pixels[p]) <= 128 && sees_below(&scene.pose, p);
            }
            if (dark || !lit) {
                fail_msg("turn %zu, %g m above the floor: %d pixels are lit, %d are dark", i,
                         (double)height, lit, dark);
            }
            dip_test_scene_free(&scene);
        }
    }
}

// --- normals that nearly cancel out --------------------------------------------------------------

// The wall faces the eye and the light. Its normals point away from the eye at its left end, 3000
// km away, and towards it at its right end, so that their mean is shorter than 1e-6 in the whole
// picture.
static void make_wall(DipTestScene *scene) {
    begin_scene(scene, &scene->lighting, (const float[3]){0.0f, 0.0f, -1.0f});
    const int material = dip_test_scene_add_material(scene, DIP_NO_TEXTURE);
    scene->materials[material].lit = true;
    const DipTestMesh mesh = dip_test_scene_add_mesh(scene, 4, 6, DIP_TEST_NORMALS, material);
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    memcpy(mesh.indices, indices, sizeof indices);
    for (int v = 0; v < 4; v++) {
        const bool right = v == 1 || v == 2;
        mesh.positions[3 * v] = right ? 3e6f : -3e6f;
        mesh.positions[3 * v + 1] = v >= 2 ? 3e6f : -3e6f;
        mesh.positions[3 * v + 2] = -1.0f;
        mesh.normals[3 * v + 2] = right ? 1.0f : -1.0f;
    }
}

static void interpolated_normals_that_nearly_cancel_out_have_the_length_1(void **state) {
    (void)state;
    static uint32_t pixels[WIDTH * HEIGHT];
    DipTestScene scene;
    make_wall(&scene);
    stage_draw_scene(&scene, WIDTH, HEIGHT, "", pixels);
    for (int p = 0; p < WIDTH * HEIGHT; p++) {
        const int from_middle = p % WIDTH - WIDTH / 2;
        const int expected = from_middle > 0 ? 255 : 0;
        if (from_middle > 2 || from_middle < -2) {
            assert_int_equal(red_of(pixels[p]), expected);
        }
    }
    dip_test_scene_free(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_floor_close_below_the_eye_is_seen_from_above),
        cmocka_unit_test(interpolated_normals_that_nearly_cancel_out_have_the_length_1),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
