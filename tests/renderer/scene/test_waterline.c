// Compares lakes, seen from eyes 0.01 mm to 1 cm above the water, with the reference. The near
// plane cuts the water and the shore there, and the plane of the mirrored scene passes close to the
// eye.
#include "renderer/catalogue/random.h"
#include "tests/renderer/scene/stage.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 160, HEIGHT = 120, GRID = 24 };

static const double level = 1.25;

// Adds ground that lies below the level in the middle, rises above it towards the edges, and waves.
static void add_shore(DipTestScene *scene, double size) {
    const int material = dip_test_scene_add_material(
        scene, dip_test_scene_add_texture(scene, DIP_TEST_NOISE, 64, 64));
    const DipTestMesh mesh = dip_test_scene_add_mesh(scene, (GRID + 1) * (GRID + 1),
                                                     6 * GRID * GRID, DIP_TEST_UV0, material);
    for (int v = 0; v < (GRID + 1) * (GRID + 1); v++) {
        const int column = v % (GRID + 1);
        const int row = v / (GRID + 1);
        const double x = (column / (double)GRID - 0.5) * 1.2 * size;
        const double z = (row / (double)GRID - 0.5) * 1.2 * size;
        const double wave = 0.03 * sin(1.7 * column) * cos(1.3 * row);
        mesh.positions[3 * v] = (float)x;
        mesh.positions[3 * v + 1] =
            (float)(level + (0.3 * (hypot(x, z) / size - 0.35) + wave) * size);
        mesh.positions[3 * v + 2] = (float)z;
        mesh.uv0[2 * v] = (float)(0.5 * x);
        mesh.uv0[2 * v + 1] = (float)(0.5 * z);
    }
    for (uint32_t i = 0; i < GRID * GRID; i++) {
        const uint32_t v = i / GRID * (GRID + 1) + i % GRID;
        const uint32_t quad[6] = {v, v + GRID + 1, v + 1, v + 1, v + GRID + 1, v + GRID + 2};
        memcpy(mesh.indices + 6 * i, quad, sizeof quad);
    }
}

static void make_lake(DipTestScene *scene, double size) {
    dip_test_scene_begin(scene);
    add_shore(scene, size);
    const int water = dip_test_scene_add_material(scene, DIP_NO_TEXTURE);
    scene->materials[water].surface = DIP_SURFACE_WATER;
    scene->materials[water].base_colour_lin[0] = 0.1f;
    const float side = (float)size;
    dip_test_scene_add_quad(scene, water, (const float[]){-side / 2, (float)level, side / 2},
                            (const float[]){side, 0, 0}, (const float[]){0, 0, -side}, 1, 1);
    scene->reflection = (DipReflectionDef){.width = 96, .height = 72, .level_m = level};
}

// Places a camera `above` metres above the lake and turns it by yaw, then pitch, then roll.
static void place(DipTestScene *scene, Random *random, double size, double above) {
    const double yaw = random_real(random, -1.6, 1.6); // half angles, in radians
    const double pitch = random_real(random, -0.2, 0.15);
    const double roll = random_real(random, -0.15, 0.15);
    const double a[4] = {cos(yaw) * sin(pitch), sin(yaw) * cos(pitch), -sin(yaw) * sin(pitch),
                         cos(yaw) * cos(pitch)};
    double *q = scene->pose.orientation;
    q[0] = a[0] * cos(roll) + a[1] * sin(roll);
    q[1] = a[1] * cos(roll) - a[0] * sin(roll);
    q[2] = a[2] * cos(roll) + a[3] * sin(roll);
    q[3] = a[3] * cos(roll) - a[2] * sin(roll);
    scene->pose.position_world[0] = random_real(random, -0.3, 0.3) * size;
    scene->pose.position_world[1] = level + above;
    scene->pose.position_world[2] = random_real(random, -0.3, 0.3) * size;
}

static DipImageError compare(const DipTestScene *scene, const char *settings) {
    DipRendererDef def = stage_def(WIDTH, HEIGHT, settings);
    def.reflection = scene->reflection;
    Stage stage = stage_open(&scene->def, def, 1);
    const DipFrame frame = stage_draw(&stage, &scene->pose, 0);
    double *expected = stage_draw_reference(&stage, &scene->pose);
    const DipImageError error = dip_image_compare(expected, &frame, 0.01);
    free(expected);
    stage_close(&stage);
    return error;
}

// Where rounding moves a vertex by 1/256 pixel, a sample on an outline may show the other surface.
// This happens to a few of the 19200 pixels.
static void lakes_of_any_size_match_the_reference_from_close_to_the_water(void **state) {
    (void)state;
    static const double sizes[] = {50.0, 3000.0};
    Random random = {2};
    int missed = 0;
    for (int i = 0; i < 48; i++) {
        DipTestScene scene;
        const double above = pow(10.0, random_real(&random, -5.0, -2.0));
        make_lake(&scene, sizes[i % 2]);
        place(&scene, &random, sizes[i % 2], above);
        const char *settings = i / 2 % 2 ? "aa=4,af=16" : "aa=none";
        const DipImageError error = compare(&scene, settings);
        if (error.over_count > 4 || error.rms_lin > 0.007) {
            printf("lake of %.0f m, %g m above, %s: RMS %.4f, %zu pixels\n", sizes[i % 2], above,
                   settings, error.rms_lin, error.over_count);
            missed++;
        }
        dip_test_scene_free(&scene);
    }
    assert_int_equal(missed, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lakes_of_any_size_match_the_reference_from_close_to_the_water),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
