// Tests the animations of loaded glTF models: their shape at any time beside motion.txt, which
// make_motion.py computes in double precision from the glTF specification, and their pictures.
#include "assets/importer.h"
#include "assets/model.h"
#include "renderer/reference/reference.h"
#include "renderer/scene/motion.h"
#include "tests/assets/fixture.h"
#include "tests/assets/same_scene.h"
#include "tests/assets/stage.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

static const char importer_word[] = "import";

// It sees all of motion.gltf.
static const DipPose pose = {
    .position_world = {1.0, 2.0, 18.0}, .orientation = {0.0, 0.0, 0.0, 1.0}, .fov_y_deg = 45.0};

static const DipModelOptions first = {.animation = DIP_MODEL_ANIMATION_FIRST};

static DipModel *load_motion(const DipModelOptions *options) {
    return fixture_load(fixture_data("motion.gltf"), options, NULL);
}

static DipPosedDef *posed_of(const DipModel *model) {
    const DipSceneDef *def = dip_model_scene_def(model);
    assert_non_null(def->motion);
    DipPosedDef *posed = dip_posed_def_create(def, NULL);
    assert_non_null(posed);
    return posed;
}

// --- shapes --------------------------------------------------------------------------------------

static void apply(const float transform[12], float w, const float from[3], double to[3]) {
    for (int row = 0; row < 3; ++row) {
        to[row] = (double)(transform[4 * row + 3] * w);
        for (int k = 0; k < 3; ++k) {
            to[row] += (double)transform[4 * row + k] * (double)from[k];
        }
    }
}

// Checks one vertex: its position, and its normal unless a skin has bent it. For bent normals, the
// truth has the mean matrix itself, but the model its inverse transpose.
static void check_vertex(const DipSceneDef *def, double time_s, int object, int vertex,
                         const double e[6]) {
    static const char *const names[] = {"stepping", "spline", "morphed", "spinning", "bent"};
    static const uint32_t corners[] = {0, 1, 2, 5}; // the file's triangles are 0 1 2 and 0 2 3
    const DipObjectDef *placed = fixture_object(def, names[object]);
    const DipMeshDef *mesh = &def->meshes[placed->mesh];
    const size_t at = 3 * (size_t)mesh->indices[corners[vertex]];
    double p[3];
    double n[3];
    apply(placed->transform, 1.0f, mesh->positions + at, p);
    apply(placed->transform, 0.0f, mesh->normals + at, n);
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    const double turned = object == 4 ? 2.0 : 1e-5;
    for (int i = 0; i < 3; ++i) {
        if (!(fabs(p[i] - e[i]) <= 1e-5 * (1.0 + fabs(e[i]))) ||
            !(fabs(n[i] / length - e[3 + i]) <= turned)) {
            fail_msg("%s at %g s, vertex %d, axis %d: position %.9g, expected %.9g; normal %.9g, "
                     "expected %.9g",
                     names[object], time_s, vertex, i, p[i], e[i], n[i] / length, e[3 + i]);
        }
    }
}

// Checks all lines of motion.txt.
static void check_motion(const DipModel *model) {
    DipPosedDef *posed = posed_of(model);
    FILE *file = fopen(fixture_data("motion.txt"), "r");
    assert_non_null(file);
    int lines = 0;
    int object;
    int vertex;
    double time_s;
    double e[6];
    while (fscanf(file, "%lf %d %d %lf %lf %lf %lf %lf %lf", &time_s, &object, &vertex, &e[0],
                  &e[1], &e[2], &e[3], &e[4], &e[5]) == 9) {
        dip_posed_def_set(posed, llround(time_s * 1e9));
        check_vertex(dip_posed_def(posed), time_s, object, vertex, e);
        ++lines;
    }
    assert_int_equal(lines, 360);
    fclose(file);
    dip_posed_def_destroy(&posed);
}

static void nodes_skins_and_morph_targets_move_as_the_specification_says(void **state) {
    (void)state;
    DipModel *model = load_motion(&first);
    check_motion(model);
    dip_model_destroy(&model);
}

static void an_imported_model_moves_as_one_that_is_loaded_here(void **state) {
    (void)state;
    const DipImporter importer = {.program = "/proc/self/exe", .command = importer_word};
    DipModelOptions options = first;
    options.importer = &importer;
    DipModel *model = load_motion(&options);
    DipModel *here = load_motion(&first);
    check_motion(model);
    assert_same_scene(dip_model_scene_def(model), dip_model_scene_def(here));
    int count;
    const char *const *names = dip_model_animations(model, &count);
    assert_int_equal(count, 2);
    assert_string_equal(names[0], "all");
    assert_string_equal(names[1], "still");
    dip_model_destroy(&model);
    dip_model_destroy(&here);
}

static void moved_normals_have_length_one(void **state) {
    (void)state;
    DipModel *model = fixture_load(DIP_ASSETS_DIR "/gallery/pump.glb", &first, NULL);
    DipPosedDef *posed = posed_of(model);
    const DipSceneDef *def = dip_posed_def(posed);
    for (int k = 0; k < 8; ++k) {
        dip_posed_def_set_share(posed, k / 8.0);
        for (int m = 0; m < def->mesh_count; ++m) {
            for (size_t i = 0; i < 3 * (size_t)def->meshes[m].vertex_count; i += 3) {
                const float *n = def->meshes[m].normals + i;
                const double square = (double)(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
                assert_true(fabs(square - 1.0) < 1e-4);
            }
        }
    }
    dip_posed_def_destroy(&posed);
    dip_model_destroy(&model);
}

// --- which animation plays -----------------------------------------------------------------------

static void the_named_animation_plays(void **state) {
    (void)state;
    DipModelOptions named = {.animation = DIP_MODEL_ANIMATION_NAMED, .animation_name = "all"};
    DipModel *model = load_motion(&named);
    check_motion(model);
    dip_model_destroy(&model);
    named.animation_name = "still"; // It has no channels.
    model = load_motion(&named);
    assert_null(dip_model_scene_def(model)->motion);
    dip_model_destroy(&model);
    named.animation_name = "dance";
    const char *path = fixture_data("motion.gltf");
    DipError err = {0};
    assert_null(dip_model_load_with(&path, 1, &named, NULL, NULL, &err));
    assert_int_equal(err.code, DIP_ERROR_UNKNOWN);
    assert_string_equal(err.key, DIP_MODEL_ANIMATION_KEY);
    assert_string_equal(err.message, "'dance' is not an animation of the models, accepted none, "
                                     "\"all\", \"still\"");
}

static void without_an_animation_the_model_has_its_shape_at_rest(void **state) {
    (void)state;
    DipModel *still = load_motion(&(DipModelOptions){.animation = DIP_MODEL_ANIMATION_NONE});
    const DipSceneDef *def = dip_model_scene_def(still);
    assert_null(def->motion);
    assert_true(fabs((double)fixture_object(def, "spinning")->transform[3] - 9.0) < 1e-5);
    dip_model_destroy(&still);
}

static void a_held_animation_stands_still(void **state) {
    (void)state;
    DipModelOptions held = first;
    held.animation_is_held = true;
    held.animation_held_s = 0.77;
    DipModel *model = load_motion(&held);
    DipModel *playing = load_motion(&first);
    DipPosedDef *posed = posed_of(model);
    DipPosedDef *expected = posed_of(playing);
    assert_false(dip_motion_plays(dip_model_scene_def(model)->motion));
    assert_true(dip_motion_plays(dip_model_scene_def(playing)->motion));
    dip_posed_def_set(expected, 770000000);
    for (int64_t time_ns = 0; time_ns < 3000000000; time_ns += 700000000) {
        dip_posed_def_set(posed, time_ns);
        for (int m = 0; m < dip_posed_def(posed)->mesh_count; ++m) {
            const DipMeshDef *one = &dip_posed_def(posed)->meshes[m];
            const DipMeshDef *other = &dip_posed_def(expected)->meshes[m];
            assert_memory_equal(one->positions, other->positions,
                                3 * sizeof(float) * one->vertex_count);
        }
    }
    dip_posed_def_destroy(&posed);
    dip_posed_def_destroy(&expected);
    dip_model_destroy(&model);
    dip_model_destroy(&playing);
}

// --- pictures ------------------------------------------------------------------------------------

static void a_frame_does_not_depend_on_the_frames_before_it(void **state) {
    (void)state;
    static uint8_t after[STAGE_BYTES];
    static uint8_t alone[STAGE_BYTES];
    static uint8_t start[STAGE_BYTES];
    DipModel *model = load_motion(&first);
    const DipSceneDef *def = dip_model_scene_def(model);
    Stage stage = stage_open(def, 2, "aa=4");
    stage_draw(&stage, &pose, 0, start);
    for (int i = 1; i <= 311; ++i) {
        stage_draw(&stage, &pose, i, after);
    }
    assert_int_not_equal(memcmp(start, after, STAGE_BYTES), 0);
    for (int threads = 1; threads <= 3; threads += 2) {
        Stage fresh = stage_open(def, threads, "aa=4");
        stage_draw(&fresh, &pose, 311, alone);
        assert_memory_equal(alone, after, STAGE_BYTES);
        stage_close(&fresh);
    }
    stage_close(&stage);
    dip_model_destroy(&model);
}

// A scene that has the shape of the moment from the start is drawn as the moving scene.
static void a_moment_is_drawn_as_a_still_scene(void **state) {
    (void)state;
    static uint8_t moving[STAGE_BYTES];
    static uint8_t still[STAGE_BYTES];
    DipModel *model = load_motion(&first);
    DipPosedDef *posed = posed_of(model);
    Stage stage = stage_open(dip_model_scene_def(model), 2, "aa=none");
    for (int number = 0; number < 60; number += 7) {
        dip_posed_def_set(posed, (int64_t)number * 1000000000 / 30);
        Stage of_moment = stage_open(dip_posed_def(posed), 1, "aa=none");
        const DipFrame frame = stage_draw(&stage, &pose, number, moving);
        const DipFrame plain = stage_draw(&of_moment, &pose, 0, still);
        assert_memory_equal(moving, still, STAGE_BYTES);
        assert_int_equal(frame.counters.vertices_posed, 8); // those of "morphed" and "bent"
        assert_int_equal(plain.counters.vertices_posed, 0);
        stage_close(&of_moment);
    }
    stage_close(&stage);
    dip_posed_def_destroy(&posed);
    dip_model_destroy(&model);
}

static void the_reference_draws_the_same_moment(void **state) {
    (void)state;
    DipModel *model = load_motion(&first);
    stage_check_moments(dip_model_scene_def(model), &pose, 5, 60, 18);
    dip_model_destroy(&model);
}

// Draws a moment with a reference in which a directional light casts shadows.
static void draw_shadows(const DipSceneDef *def, int64_t time_ns, bool after_others,
                         double *rgb_lin) {
    DipReference *reference = dip_reference_create(def, NULL);
    DipQuality quality;
    assert_non_null(reference);
    assert_true(dip_quality_parse("aa=none,shadows=1024", &quality, NULL));
    if (after_others) {
        dip_reference_set_time(reference, time_ns / 2);
        assert_true(dip_reference_draw(reference, &quality, &pose, STAGE_WIDTH, STAGE_HEIGHT,
                                       rgb_lin, NULL));
    }
    dip_reference_set_time(reference, time_ns);
    assert_true(
        dip_reference_draw(reference, &quality, &pose, STAGE_WIDTH, STAGE_HEIGHT, rgb_lin, NULL));
    dip_reference_destroy(&reference);
}

static void the_shadows_of_the_reference_follow_the_model(void **state) {
    (void)state;
    static double moving[STAGE_PIXELS * 3];
    static double still[STAGE_PIXELS * 3];
    static const DipLightDef sun = {.kind = DIP_LIGHT_DIRECTIONAL,
                                    .colour_lin = {0.8f, 0.8f, 0.8f},
                                    .direction_world = {-0.6f, -0.64f, -0.48f}};
    DipLightingDef lighting = {.lights = &sun, .light_count = 1, .shading = DIP_SHADING_PHONG};
    DipModel *model = load_motion(&first);
    DipSceneDef def = *dip_model_scene_def(model);
    def.lighting = &lighting;
    DipPosedDef *posed = dip_posed_def_create(&def, NULL);
    assert_non_null(posed);
    for (int64_t time_ns = 300000000; time_ns < 2000000000; time_ns += 500000000) {
        dip_posed_def_set(posed, time_ns);
        draw_shadows(&def, time_ns, true, moving);
        draw_shadows(dip_posed_def(posed), 0, false, still);
        assert_memory_equal(moving, still, sizeof moving);
    }
    dip_posed_def_destroy(&posed);
    dip_model_destroy(&model);
}

// Every vertex at any time lies in the scene's bounds, up to what a vertex moves between two of the
// moments at which bounds are taken.
static void bounds_hold_over_the_clip(void **state) {
    (void)state;
    DipModel *model = load_motion(&first);
    DipPosedDef *posed = posed_of(model);
    Stage stage = stage_open(dip_model_scene_def(model), 1, "aa=none");
    float low[3];
    float high[3];
    dip_scene_bounds(stage.scene, low, high);
    const DipSceneDef *def = dip_posed_def(posed);
    for (int k = 0; k < DIP_MOTION_MOMENTS; ++k) {
        dip_posed_def_set_share(posed, (double)k / DIP_MOTION_MOMENTS);
        for (int o = 0; o < def->object_count; ++o) {
            const DipMeshDef *mesh = &def->meshes[def->objects[o].mesh];
            for (size_t v = 0; v < mesh->vertex_count; ++v) {
                double p[3];
                apply(def->objects[o].transform, 1.0f, mesh->positions + 3 * v, p);
                for (int axis = 0; axis < 3; ++axis) {
                    assert_true(p[axis] > (double)low[axis] - 1e-4);
                    assert_true(p[axis] < (double)high[axis] + 1e-4);
                }
            }
        }
    }
    assert_true(dip_scene_moves(stage.scene));
    dip_posed_def_destroy(&posed);
    stage_close(&stage);
    dip_model_destroy(&model);
}

int main(int argc, char **argv) {
    if (argc > 2 && strcmp(argv[1], importer_word) == 0) {
        return dip_importer_run(argc - 2, argv + 2);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nodes_skins_and_morph_targets_move_as_the_specification_says),
        cmocka_unit_test(an_imported_model_moves_as_one_that_is_loaded_here),
        cmocka_unit_test(moved_normals_have_length_one),
        cmocka_unit_test(the_named_animation_plays),
        cmocka_unit_test(without_an_animation_the_model_has_its_shape_at_rest),
        cmocka_unit_test(a_held_animation_stands_still),
        cmocka_unit_test(a_frame_does_not_depend_on_the_frames_before_it),
        cmocka_unit_test(a_moment_is_drawn_as_a_still_scene),
        cmocka_unit_test(the_reference_draws_the_same_moment),
        cmocka_unit_test(the_shadows_of_the_reference_follow_the_model),
        cmocka_unit_test(bounds_hold_over_the_clip),
    };
    return cmocka_run_group_tests(tests, fixture_open, fixture_close);
}
