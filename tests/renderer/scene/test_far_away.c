// Tests scenes far from the origin of the world: a scene and its camera that move together show the
// same picture, and projected vertices keep their precision.
#include "renderer/scene/draw/draws.h"
#include "renderer/scene/resources/scene_layout.h"
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

enum { WIDTH = 160, HEIGHT = 120 };

// --- scenes that move together with the camera -------------------------------------------------

// Floats hold the positions of scenes that are enlarged by this factor even 10,000 km from the
// origin.
#define ENLARGED 64.0f

static double squared_difference(uint32_t a, uint32_t b) {
    double sum = 0.0;
    for (int c = 0; c < 24; c += 8) {
        const double d = ((a >> c & 255) - (double)(b >> c & 255)) / 255.0;
        sum += d * d;
    }
    return sum;
}

// The difference of two pictures.
typedef struct Difference {
    int pixels; // number of pixels that differ
    double rms; // of the 8-bit values, as fractions of 255
} Difference;

// Draws a kind of scene at its own position and moved by `by`, and compares the pictures.
static Difference difference_of(DipTestSceneKind kind, const char *settings, const double by[3]) {
    static uint32_t pictures[2][WIDTH * HEIGHT];
    for (int moved = 0; moved < 2; moved++) {
        DipTestScene scene;
        dip_test_scene_make(&scene, kind);
        dip_test_scene_enlarge(&scene, ENLARGED);
        if (moved) {
            dip_test_scene_move(&scene, by);
        }
        stage_draw_scene(&scene, WIDTH, HEIGHT, settings, pictures[moved]);
        dip_test_scene_free(&scene);
    }
    Difference difference = {0, 0.0};
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        difference.pixels += pictures[0][i] != pictures[1][i];
        difference.rms += squared_difference(pictures[0][i], pictures[1][i]);
    }
    difference.rms = sqrt(difference.rms / (3.0 * WIDTH * HEIGHT));
    return difference;
}

static const double moves[][3] = {
    {1024.0, 0.0, 0.0},           {-65536.0, 1024.0, 65536.0}, {131072.0, -131072.0, 2048.0},
    {0.0, 1000448.0, -1000448.0}, {10000384.0, 0.0, 10000384}, {-10000384.0, 10000384.0, 1024.0},
};

static void a_scene_moved_by_whole_cells_with_its_camera_shows_the_same_bits(void **state) {
    (void)state;
    int missed = 0;
    for (int kind = 0; kind < DIP_TEST_SCENE_COUNT; kind++) {
        for (size_t i = 0; i < sizeof moves / sizeof moves[0]; i++) {
            const Difference got =
                difference_of((DipTestSceneKind)kind, "aa=4,af=4,gi=off", moves[i]);
            if (got.pixels) {
                printf("%s moved by (%.0f, %.0f, %.0f): %d pixels differ, RMS %.4f\n",
                       dip_test_scene_name((DipTestSceneKind)kind), moves[i][0], moves[i][1],
                       moves[i][2], got.pixels, got.rms);
                missed++;
            }
        }
    }
    assert_int_equal(missed, 0);
}

// Moves by other distances change the cells in which origins lie, so vertices are rounded
// differently.
static void a_scene_moved_by_any_distance_shows_nearly_the_same_picture(void **state) {
    (void)state;
    static const double any_moves[][3] = {
        {1.0, 0.0, 500.0}, {65000.0, 0.0, 131000.0}, {1e6, 0.0, -1e6}, {0.0, 1e7, 1e7}};
    int missed = 0;
    for (int kind = 0; kind < DIP_TEST_SCENE_COUNT; kind++) {
        for (size_t i = 0; i < sizeof any_moves / sizeof any_moves[0]; i++) {
            const Difference got = difference_of((DipTestSceneKind)kind, "aa=4,af=4", any_moves[i]);
            if (got.pixels > WIDTH * HEIGHT / 20 || got.rms > 0.004) {
                printf("%s moved by (%.0f, %.0f, %.0f): %d pixels differ, RMS %.4f\n",
                       dip_test_scene_name((DipTestSceneKind)kind), any_moves[i][0],
                       any_moves[i][1], any_moves[i][2], got.pixels, got.rms);
                missed++;
            }
        }
    }
    assert_int_equal(missed, 0);
}

// --- projected vertices ------------------------------------------------------------------------

enum { VERTICES = 240 };

// An object near the eye, and the distances at which it lies.
typedef struct Case {
    DipPose pose;
    float transform[12];
    float positions[3 * VERTICES];
} Case;

static void random_rotation(Random *random, double q[4]) {
    double length2 = 0.0;
    for (int k = 0; k < 4; k++) {
        q[k] = random_real(random, -1.0, 1.0);
        length2 += q[k] * q[k];
    }
    for (int k = 0; k < 4; k++) {
        q[k] /= sqrt(length2);
    }
}

// Computes the rows of the rotation from the world to the camera.
static void rotation_rows(const double q[4], long double rows[3][3]) {
    const long double x = q[0], y = q[1], z = q[2], w = q[3];
    const long double turned[3][3] = {
        {1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
        {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
        {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
    memcpy(rows, turned, sizeof turned);
}

// Makes a camera `reach` metres from the world's origin on each axis, and an object around it whose
// own coordinates are as large if `by_vertices` is true, and small otherwise.
static void make_case(Case *test, Random *random, double reach, bool by_vertices) {
    double q[4];
    long double turn[3][3];
    random_rotation(random, test->pose.orientation);
    test->pose.fov_y_deg = 90.0;
    random_rotation(random, q);
    rotation_rows(q, turn);
    const double scale = pow(10.0, random_real(random, -1.0, 1.0));
    for (int axis = 0; axis < 3; axis++) {
        test->pose.position_world[axis] = reach * random_real(random, -1.0, 1.0);
        for (int c = 0; c < 3; c++) {
            test->transform[4 * axis + c] = (float)(scale * (double)turn[axis][c]);
        }
        test->transform[4 * axis + 3] = by_vertices ? (float)random_real(random, -5.0, 5.0)
                                                    : (float)test->pose.position_world[axis];
    }
    for (int v = 0; v < VERTICES; v++) {
        const double distance = pow(10.0, random_real(random, -1.0, 4.0));
        for (int c = 0; c < 3; c++) {
            double centre = 0.0; // the eye in the object's coordinates
            for (int axis = 0; axis < 3; axis++) {
                centre += (double)turn[axis][c] / scale *
                          (test->pose.position_world[axis] - (double)test->transform[4 * axis + 3]);
            }
            test->positions[3 * v + c] =
                (float)(centre + distance / scale * random_real(random, -1.0, 1.0));
        }
    }
}

// Returns the exact position of vertex v relative to the eye, along the camera's axes.
static void exact_position(const Case *test, int v, long double position[3]) {
    long double rows[3][3];
    rotation_rows(test->pose.orientation, rows);
    const float *p = test->positions + 3 * v;
    long double world[3];
    for (int axis = 0; axis < 3; axis++) {
        const float *t = test->transform + 4 * axis;
        world[axis] = (long double)t[0] * p[0] + (long double)t[1] * p[1] +
                      (long double)t[2] * p[2] + t[3] - test->pose.position_world[axis];
    }
    for (int axis = 0; axis < 3; axis++) {
        position[axis] =
            rows[axis][0] * world[0] + rows[axis][1] * world[1] + rows[axis][2] * world[2];
    }
}

// Runs the vertex shader of the case's draw. clip[0..3][v] is the clip position of vertex v.
static void run_shader(const Case *test, float clip[4][DIP_VERTEX_BATCH]) {
    static const uint32_t indices[3] = {0, 1, 2};
    const DipMaterialDef material = {.colour_texture = DIP_NO_TEXTURE,
                                     .light_map = DIP_NO_TEXTURE,
                                     .normal_map = DIP_NO_TEXTURE};
    const DipMeshDef mesh = {.vertex_count = VERTICES,
                             .positions = test->positions,
                             .index_count = 3,
                             .indices = indices};
    DipObjectDef object = {.mesh = 0};
    memcpy(object.transform, test->transform, sizeof object.transform);
    const DipSceneDef def = {.materials = &material,
                             .material_count = 1,
                             .meshes = &mesh,
                             .mesh_count = 1,
                             .objects = &object,
                             .object_count = 1,
                             .near_m = 0.1f};
    DipScene *scene = dip_scene_create(&def, NULL, NULL);
    assert_non_null(scene);
    const DipQuality quality = dip_quality_default();
    const DipView view = dip_view_make(&test->pose, 0.1, 1.0);
    static const DipMaterialSamplers no_samplers[1];
    const DipDrawInput input = {.scene = scene,
                                .kernels = dip_material_kernels(dip_isa_best()),
                                .quality = &quality,
                                .samplers = no_samplers};
    const DipDrawView pass = {.view = &view, .width = 1, .height = 1};
    DipDrawSet set = {.count = 0};
    assert_true(dip_draw_set_make(&set, scene, false, NULL));
    dip_draw_set_fill(&set, &input, &pass);
    float in[3][DIP_VERTEX_BATCH] = {{0}};
    for (int i = 0; i < 3 * VERTICES; i++) {
        in[i % 3][i / 3] = test->positions[i];
    }
    const float *const in_rows[3] = {in[0], in[1], in[2]};
    float *const clip_rows[4] = {clip[0], clip[1], clip[2], clip[3]};
    set.draws[0].vertex_shader(
        &(DipVertexBatch){VERTICES, in_rows, clip_rows, NULL, set.draws[0].uniforms});
    dip_draw_set_free(&set);
    dip_scene_destroy(&scene);
}

// Returns the worst error of a vertex in a case, in units of 2^-24 * (distance from the eye + reach
// of a cell).
static double worst_error(const Case *test) {
    float clip[4][DIP_VERTEX_BATCH];
    run_shader(test, clip);
    double scale2 = 0.0;
    for (int c = 0; c < 3; c++) {
        scale2 += (double)test->transform[4 * c] * (double)test->transform[4 * c];
    }
    double worst = 0.0;
    for (int v = 0; v < VERTICES; v++) {
        long double exact[3];
        exact_position(test, v, exact);
        const double error[3] = {(double)(clip[0][v] - exact[0]), (double)(clip[1][v] - exact[1]),
                                 (double)(clip[3][v] + exact[2])};
        const double distance =
            (double)sqrtl(exact[0] * exact[0] + exact[1] * exact[1] + exact[2] * exact[2]);
        const double size = sqrt(error[0] * error[0] + error[1] * error[1] + error[2] * error[2]);
        worst = fmax(worst, size / (0x1p-24 * (distance + 1024.0 * sqrt(scale2))));
    }
    return worst;
}

// Errors are measured against long double, which is exact here to 1e-12 m.
static void projected_vertices_are_as_precise_as_near_the_origin(void **state) {
    (void)state;
    static const double reaches[] = {0.0, 1e3, 65e3, 1e5, 1e6, 1e7};
    Random random = {77};
    double worst = 0.0;
    for (size_t i = 0; i < sizeof reaches / sizeof reaches[0]; i++) {
        double worst_here = 0.0;
        for (int n = 0; n < 200; n++) {
            Case test;
            make_case(&test, &random, reaches[i], n % 2);
            worst_here = fmax(worst_here, worst_error(&test));
        }
        printf("%9.0f m from the origin: worst error %.2f\n", reaches[i], worst_here);
        worst = fmax(worst, worst_here);
    }
    assert_true(worst < 8.0);
}

// The eye has coordinates of 3e6 in this object, although both lie within 10 m.
static void a_nearly_singular_transform_keeps_its_own_origin(void **state) {
    (void)state;
    Random random = {5};
    Case test = {.pose = {.position_world = {1e5, 1e5, 1e5}, .fov_y_deg = 90.0},
                 .transform = {1, 1, 0, 1e5f, 0, 1e-6f, 0, 1e5f - 3.0f, 0, 0, 1, 1e5f}};
    random_rotation(&random, test.pose.orientation);
    for (int i = 0; i < 3 * VERTICES; i++) {
        test.positions[i] = (float)random_real(&random, -5.0, 5.0);
    }
    assert_true(worst_error(&test) < 8.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scene_moved_by_whole_cells_with_its_camera_shows_the_same_bits),
        cmocka_unit_test(a_scene_moved_by_any_distance_shows_nearly_the_same_picture),
        cmocka_unit_test(projected_vertices_are_as_precise_as_near_the_origin),
        cmocka_unit_test(a_nearly_singular_transform_keeps_its_own_origin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
