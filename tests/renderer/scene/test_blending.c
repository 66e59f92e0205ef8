// Tests blended surfaces: colours against closed forms, the order from far to near, and scenes of
// panes against the reference renderer, which sorts each sample by itself.
#include "author_scenes.h"
#include "stage.h"

#include "renderer/reference/reference.h"
#include "renderer/scene/draw/blend_order.h"
#include "renderer/scene/motion.h"
#include "renderer/scene/renderer.h"
#include "renderer/scene/resources/blended_pieces.h"
#include "tests/support/srgb.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 160, HEIGHT = 120 };

static AuthorScene scene;

static Stage open_stage(const char *settings) {
    DipRendererDef def = stage_def(WIDTH, HEIGHT, settings);
    def.reflection = scene.reflection;
    return stage_open(&scene.def, def, 2);
}

static DipFrame draw(const Stage *stage) {
    return stage_draw(stage, &scene.pose, 0);
}

// --- closed forms --------------------------------------------------------------------------------

// Adds an unlit pane of one colour that fills the picture, at a distance from the origin towards
// the eye.
static int add_pane(DipSurface surface, const float colour[3], float opacity, float z) {
    const int material = author_add_pbr(&scene, 0.0f, 1.0f);
    DipMaterialDef *pane = &scene.materials[material];
    pane->lit = false;
    pane->surface = surface;
    pane->opacity = opacity;
    memcpy(pane->base_colour_lin, colour, 3 * sizeof *colour);
    return author_add_quad(&scene, material, (const float[]){-9.0f, -9.0f, z},
                           (const float[]){18.0f, 0.0f, 0.0f}, (const float[]){0.0f, 18.0f, 0.0f});
}

static const float red[3] = {1.0f, 0.1f, 0.0f};
static const float green[3] = {0.0f, 0.8f, 0.2f};
static const float blue[3] = {0.1f, 0.2f, 0.9f};

// Three panes before a wall, whichever of them the scene names first.
static void panes_blend_from_far_to_near_in_linear_light(void **state) {
    (void)state;
    const float *const colours[3] = {red, green, blue};
    static const float opacities[3] = {0.5f, 0.3f, 0.6f};
    static const int orders[4][3] = {{0, 1, 2}, {2, 1, 0}, {1, 2, 0}, {2, 0, 1}};
    for (int o = 0; o < 4; o++) {
        author_begin(&scene);
        for (int i = 0; i < 3; i++) {
            const int pane = orders[o][i];
            add_pane(DIP_SURFACE_BLENDED, colours[pane], opacities[pane], (float)pane);
        }
        add_pane(DIP_SURFACE_OPAQUE, (const float[]){0.5f, 0.5f, 0.5f}, 1.0f, -1.0f);
        Stage stage = open_stage(o % 2 ? "aa=none" : "aa=4");
        const DipFrame frame = draw(&stage);
        for (int c = 0; c < 3; c++) {
            double expected = 0.5;
            for (int pane = 0; pane < 3; pane++) {
                expected = (double)colours[pane][c] * (double)opacities[pane] +
                           expected * (1.0 - (double)opacities[pane]);
            }
            assert_true(abs(dip_image_centre(&frame)[c] - srgb_code(expected)) <= 1);
        }
        assert_int_equal(dip_image_centre(&frame)[3], 255);
        assert_true(frame.effects.blend.run);
        // Where two triangles meet in a pixel, each has a fragment.
        assert_true(frame.counters.fragments_blended >= 3 * WIDTH * HEIGHT);
        assert_true(o % 2 == 0 || frame.counters.fragments_blended == 3 * WIDTH * HEIGHT);
        stage_close(&stage);
        author_free(&scene);
    }
}

static void what_is_behind_a_wall_is_hidden(void **state) {
    (void)state;
    author_begin(&scene);
    add_pane(DIP_SURFACE_BLENDED, red, 0.5f, -1.0f);
    add_pane(DIP_SURFACE_OPAQUE, green, 1.0f, 0.0f);
    Stage stage = open_stage("aa=2");
    const DipFrame frame = draw(&stage);
    for (int c = 0; c < 3; c++) {
        assert_int_equal(dip_image_centre(&frame)[c], srgb_code((double)green[c]));
    }
    assert_false(frame.effects.blend.run);
    assert_string_equal(frame.effects.blend.why, "no fragment of it is visible");
    stage_close(&stage);
    author_free(&scene);
}

// The alpha of the texture multiplies the opacity.
static void the_texture_has_alpha(void **state) {
    (void)state;
    author_begin(&scene);
    const int texture = author_add_texture(&scene, 4, DIP_ENCODING_LINEAR);
    for (int i = 0; i < 16; i++) {
        memcpy(author_texels(&scene, texture) + (size_t)4 * (size_t)i,
               (const uint8_t[]){255, 255, 255, 102}, 4);
    }
    add_pane(DIP_SURFACE_BLENDED, blue, 0.5f, 0.0f);
    scene.materials[0].colour_texture = texture;
    Stage stage = open_stage("aa=none");
    const DipFrame frame = draw(&stage);
    for (int c = 0; c < 3; c++) {
        const int expected = srgb_code((double)blue[c] * 0.5 * 102.0 / 255.0);
        assert_true(abs(dip_image_centre(&frame)[c] - expected) <= 1);
    }
    stage_close(&stage);
    author_free(&scene);
}

// A double-sided pane is one surface, and its back shows too; a single-sided one has no back.
static void both_sides_of_a_double_sided_pane_are_seen(void **state) {
    (void)state;
    for (int two_sided = 0; two_sided < 2; two_sided++) {
        author_begin(&scene);
        const int object = add_pane(DIP_SURFACE_BLENDED, green, 0.5f, 0.0f);
        scene.objects[object].transform[0] = -1.0f; // turned about the vertical axis
        scene.objects[object].transform[10] = -1.0f;
        scene.objects[object].transform[3] = 9.0f;
        scene.materials[0].double_sided = two_sided;
        Stage stage = open_stage("aa=none");
        const DipFrame frame = draw(&stage);
        assert_int_equal(dip_image_centre(&frame)[1], two_sided ? srgb_code(0.4) : 0);
        stage_close(&stage);
        author_free(&scene);
    }
}

// Reading samples draws a part of the frame again: its pixels stay, and the samples show what is
// not blended.
static void reading_samples_leaves_the_frame_as_it_is(void **state) {
    (void)state;
    static DipSampleValue samples[8 * 8 * DIP_READBACK_STRIDE];
    const DipSampleReadback readback = {.region = {70, 50, 78, 58}, .samples = samples};
    author_begin(&scene);
    add_pane(DIP_SURFACE_BLENDED, red, 0.5f, 1.0f);
    add_pane(DIP_SURFACE_OPAQUE, green, 1.0f, 0.0f);
    Stage stage = open_stage("aa=4");
    const DipFrame frame = draw(&stage);
    char hashes[2][33];
    dip_frame_hash(&frame, hashes[0]);
    assert_true(
        dip_renderer_read_samples(stage.renderer, stage.scene, &scene.pose, 0, &readback, NULL));
    dip_frame_hash(&frame, hashes[1]);
    assert_string_equal(hashes[0], hashes[1]);
    assert_int_equal(samples[0].linear16[1], lround(0.8 * 65535.0));
    stage_close(&stage);
    author_free(&scene);
}

// --- the order -----------------------------------------------------------------------------------

static void the_order_is_from_far_to_near(void **state) {
    (void)state;
    enum { COUNT = 500 };
    static DipBlendedObject objects[COUNT];
    uint32_t random = 1;
    for (int i = 0; i < COUNT; i++) {
        random = random * 1664525u + 1013904223u;
        objects[i] = (DipBlendedObject){0, (int64_t)(random >> 26), i};
    }
    dip_blend_sort(objects, COUNT);
    for (int i = 1; i < COUNT; i++) {
        assert_true(objects[i - 1].depth >= objects[i].depth);
        assert_true(objects[i - 1].depth > objects[i].depth ||
                    objects[i - 1].object < objects[i].object);
    }
    dip_blend_sort(objects, 0);
    dip_blend_sort(objects, 1);
}

static void water_separates_what_lies_above_and_below_it(void **state) {
    (void)state;
    static const float levels[2] = {2.0f, -1.0f};
    static const struct {
        double eye;
        double centre;
        bool is_water;
        int layer;
    } expected[] = {{5.0, 3.0, false, 0},  {5.0, 2.0, true, 1},   {5.0, 0.0, false, 2},
                    {5.0, -1.0, true, 3},  {5.0, -4.0, false, 4}, {0.0, 0.5, false, 0},
                    {0.0, 2.0, true, 1},   {0.0, -1.0, true, 1},  {0.0, 3.0, false, 2},
                    {0.0, -2.0, false, 2}, {-3.0, 2.0, true, 3}};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        assert_int_equal(
            dip_blend_layer(levels, 2, expected[i].eye, expected[i].centre, expected[i].is_water),
            expected[i].layer);
    }
    DipBlendedObject objects[3] = {{0, 9, 0}, {2, 1, 1}, {2, 5, 2}};
    dip_blend_sort(objects, 3);
    assert_int_equal(objects[0].object, 2);
    assert_int_equal(objects[1].object, 1);
}

static void depths_are_measured_along_the_view_axis(void **state) {
    (void)state;
    const DipPose pose = {
        .position_world = {1.0, 2.0, 3.0}, .orientation = {0.0, 0.0, 0.0, 1.0}, .fov_y_deg = 50.0};
    const DipView view = dip_view_make(&pose, 0.25, 1.0);
    const DipBox near = {.centre = {90.0f, -70.0f, 2.0f}};
    const DipBox behind = {.centre = {0.0f, 0.0f, 5.0f}};
    const DipBox far = {.centre = {0.0f, 0.0f, -3e38f}};
    assert_int_equal(dip_blend_depth(&view, &near), 4 * 65536);
    assert_int_equal(dip_blend_depth(&view, &behind), -8 * 65536);
    assert_int_equal(dip_blend_depth(&view, &far), (int64_t)1 << 62);
}

// --- against the reference -----------------------------------------------------------------------

static void compare(const char *name, const char *settings) {
    static const DipImageBounds bounds = {
        .rms_lin = 0.004, .pixel_lin = 0.02, .over_share = 0.003, .over_max_lin = 0.6};
    Stage stage = open_stage(settings);
    stage_compare(&stage, &scene.pose, name, settings, &bounds);
    stage_close(&stage);
}

static void panes_equal_the_reference(void **state) {
    (void)state;
    author_make_panes(&scene);
    compare("panes", "aa=none");
    compare("panes", "aa=4,af=8");
    compare("panes", "aa=8,aaa=on,asd=1");
    author_free(&scene);
}

// --- pieces --------------------------------------------------------------------------------------

enum { SHELLS = 5 };

// Makes one mesh of glass balls that stand before each other, the nearest first.
static void make_shells(bool linked) {
    author_begin(&scene);
    const int glass = author_add_pbr(&scene, 0.0f, 0.3f);
    scene.materials[glass].surface = DIP_SURFACE_BLENDED;
    scene.materials[glass].opacity = 0.5f;
    for (int i = 0; i < SHELLS; i++) {
        const float along = (float)i;
        author_add_sphere(&scene, glass,
                          (const float[]){along * 0.5f - 1.0f, along * 0.3f - 0.6f, 2.0f - along},
                          0.7f);
    }
    DipMeshDef *shells =
        &scene.meshes[scene.objects[author_join(&scene, 0, SHELLS - 1, linked)].mesh];
    float *colours = calloc(3 * (size_t)shells->vertex_count, sizeof *colours);
    assert_non_null(colours);
    const uint32_t shell = shells->vertex_count / SHELLS;
    for (uint32_t v = 0; v < shells->vertex_count; v++) {
        memcpy(colours + 3 * (size_t)v,
               v / shell % 3 == 0   ? red
               : v / shell % 3 == 1 ? green
                                    : blue,
               sizeof red);
    }
    shells->colours_lin = colours;
}

static void free_shells(void) {
    free((void *)(uintptr_t)scene.meshes[scene.objects[0].mesh].colours_lin);
    author_free(&scene);
}

// Returns the error of a picture of the shells against the reference, which sorts each sample.
static double error_of_shells(bool linked, const char *settings) {
    make_shells(linked);
    Stage stage = open_stage(settings);
    const DipFrame frame = draw(&stage);
    double *rgb_lin = stage_draw_reference(&stage, &scene.pose);
    const DipImageError error = dip_image_compare(rgb_lin, &frame, 0.02);
    printf("shells %s, %s: rms %.5f, %zu pixels over 0.02\n", linked ? "linked" : "apart", settings,
           error.rms_lin, error.over_count);
    assert_int_equal(dip_scene_triangle_count(stage.scene),
                     scene.meshes[scene.objects[0].mesh].index_count / 3);
    free(rgb_lin);
    stage_close(&stage);
    free_shells();
    return error.rms_lin;
}

// A mesh that is connected cannot be sorted, so the linked shells show the error of a mesh that is
// not cut.
static void the_pieces_of_a_mesh_are_sorted(void **state) {
    (void)state;
    static const char *const settings[] = {"aa=none", "aa=4,gi=off"};
    for (int i = 0; i < 2; i++) {
        const double linked = error_of_shells(true, settings[i]);
        const double apart = error_of_shells(false, settings[i]);
        assert_true(apart < 0.004);
        assert_true(apart * 10.0 < linked);
    }
}

// Makes one mesh of `count` triangles. Each has corners of its own, and shares a place with the
// next one if they are `joined`.
static void make_triangles(uint32_t count, bool joined) {
    author_begin(&scene);
    const int glass = author_add_pbr(&scene, 0.0f, 1.0f);
    scene.materials[glass].surface = DIP_SURFACE_BLENDED;
    float *positions = calloc((size_t)count * 9, sizeof *positions);
    uint32_t *indices = calloc((size_t)count * 3, sizeof *indices);
    assert_true(positions && indices);
    for (uint32_t t = 0; t < count; t++) {
        for (uint32_t i = 0; i < 3; i++) {
            positions[9 * t + 3 * i] = (float)t + (i == 1 ? (joined ? 1.0f : 0.5f) : 0.0f);
            positions[9 * t + 3 * i + 1] = i == 2 ? 1.0f : 0.0f;
            indices[3 * t + i] = 3 * t + i;
        }
    }
    scene.meshes[0] = (DipMeshDef){.name = "triangles",
                                   .vertex_count = 3 * count,
                                   .positions = positions,
                                   .index_count = 3 * count,
                                   .indices = indices,
                                   .material = glass};
    scene.objects[0] = (DipObjectDef){.transform = {[0] = 1.0f, [5] = 1.0f, [10] = 1.0f}};
    scene.def.mesh_count = scene.def.object_count = 1;
}

static void free_triangles(void) {
    free((void *)(uintptr_t)scene.meshes[0].positions);
    free((void *)(uintptr_t)scene.meshes[0].indices);
    author_free(&scene);
}

// All triangles stay, in their order, and each belongs to one piece.
static void check_pieces(const DipSceneDef *cut, int pieces) {
    float next = 0.0f;
    assert_int_equal(cut->mesh_count, pieces);
    for (int m = 0; m < cut->mesh_count; m++) {
        const DipMeshDef *mesh = &cut->meshes[m];
        assert_int_equal(mesh->vertex_count, mesh->index_count);
        for (uint32_t i = 0; i < mesh->index_count; i += 3) {
            assert_true(mesh->positions[3 * mesh->indices[i]] == next);
            next += 1.0f;
        }
    }
    assert_true(next == (float)(scene.meshes[0].index_count / 3));
}

static void the_number_of_pieces_is_bounded(void **state) {
    (void)state;
    static const struct {
        uint32_t triangles;
        int objects;
        int pieces;
    } cases[] = {{2, 1, 2},
                 {256, 1, 256},
                 {1000, 1, DIP_MOST_BLENDED_PIECES},
                 {1000, 50, DIP_MOST_BLENDED_PIECE_OBJECTS / 50 + 1}};
    static DipObjectDef objects[50];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        make_triangles(cases[i].triangles, false);
        for (int o = 0; o < cases[i].objects; o++) {
            objects[o] = scene.objects[0];
        }
        scene.def.objects = objects;
        scene.def.object_count = cases[i].objects;
        DipCutScene *cut;
        assert_true(dip_blended_cut(&scene.def, &cut, NULL));
        assert_non_null(cut);
        check_pieces(dip_cut_scene_def(cut), cases[i].pieces);
        assert_int_equal(dip_cut_scene_def(cut)->object_count, cases[i].objects * cases[i].pieces);
        dip_cut_scene_destroy(&cut);
        free_triangles();
    }
}

static void what_is_connected_or_not_blended_or_broken_is_not_cut(void **state) {
    (void)state;
    DipCutScene *cut;
    make_triangles(100, true);
    assert_true(dip_blended_cut(&scene.def, &cut, NULL));
    assert_null(cut);
    free_triangles();
    make_triangles(100, false);
    scene.materials[0].surface = DIP_SURFACE_OPAQUE;
    assert_true(dip_blended_cut(&scene.def, &cut, NULL));
    assert_null(cut);
    scene.materials[0].surface = DIP_SURFACE_BLENDED;
    ((uint32_t *)(uintptr_t)scene.meshes[0].indices)[5] = 300;
    assert_true(dip_blended_cut(&scene.def, &cut, NULL));
    assert_null(cut);
    free_triangles();
}

// A piece moves as the object does that it was cut from.
static void pieces_move_with_their_object(void **state) {
    (void)state;
    make_triangles(3, false);
    scene.objects[1] = scene.objects[0];
    scene.def.object_count = 2;
    const DipMovingObject moving = {.object = 1, .node = 7, .offset = {[3] = 2.0}};
    const DipMotionDef motion = {.objects = &moving, .object_count = 1};
    scene.def.motion = &motion;
    DipCutScene *cut;
    assert_true(dip_blended_cut(&scene.def, &cut, NULL));
    const DipMotionDef *moved = dip_cut_scene_def(cut)->motion;
    assert_int_equal(moved->object_count, 3);
    static const int expected[3] = {1, 4, 5};
    for (int i = 0; i < 3; i++) {
        assert_int_equal(moved->objects[i].object, expected[i]);
        assert_int_equal(moved->objects[i].node, 7);
        assert_true(moved->objects[i].offset[3] == 2.0);
    }
    dip_cut_scene_destroy(&cut);
    scene.def.motion = NULL;
    free_triangles();
}

// The mirrored scene has its own order: what is far above the water is near below it.
static void water_mirrors_panes(void **state) {
    (void)state;
    author_make_panes(&scene);
    author_add_water(&scene, WIDTH, HEIGHT);
    compare("panes_in_water", "aa=2");
    author_free(&scene);
}

// Water covers what lies behind it by the share that it reflects and by its own colour. One pane
// lies below it, the others stand above it, although some are farther away than its middle.
static void water_is_seen_through(void **state) {
    (void)state;
    author_make_panes(&scene);
    scene.objects[0].transform[7] = 0.6f; // two panes would stand in the water
    scene.objects[3].transform[7] = 1.1f;
    const int sunk = author_add_pbr(&scene, 0.0f, 1.0f);
    scene.materials[sunk].surface = DIP_SURFACE_BLENDED;
    scene.materials[sunk].opacity = 0.7f;
    scene.materials[sunk].pbr = NULL;
    scene.materials[sunk].base_colour_lin[1] = 0.05f;
    author_add_quad(&scene, sunk, (const float[]){-0.8f, -1.5f, 3.5f}, (const float[]){1.6f, 0, 0},
                    (const float[]){0, 0, -3});
    scene.materials[author_add_water(&scene, WIDTH, HEIGHT)].transmission = 0.8f;
    compare("panes_under_water", "aa=none");
    compare("panes_under_water", "aa=4,aaa=all,asd=1");
    compare("panes_under_water", "aa=8,taa=on,aaa=coverage");
    scene.reflection.width = 0;
    compare("panes_under_plain_water", "aa=2");
    author_free(&scene);
}

// The converged picture is the mean of many samples that are sorted by themselves. A pane that
// stands in another has no right order of objects, so only the reference is right there.
static void the_converged_picture_sorts_each_sample(void **state) {
    (void)state;
    enum { SMALL = 24, SAMPLES = 64 };
    DipError err = {0};
    author_begin(&scene);
    add_pane(DIP_SURFACE_BLENDED, red, 0.5f, 0.0f);
    add_pane(DIP_SURFACE_BLENDED, green, 0.5f, 0.0f);
    scene.objects[1].transform[8] = 0.5f; // its right half stands before the other pane
    scene.objects[1].transform[11] = -4.5f;
    DipReference *reference = dip_reference_create(&scene.def, &err);
    double *rgb_lin = malloc(SMALL * SMALL * 3 * sizeof *rgb_lin);
    assert_true(reference && rgb_lin);
    assert_true(
        dip_reference_converge(reference, &scene.pose, SMALL, SMALL, SAMPLES, 1, rgb_lin, &err));
    const double *left = rgb_lin + 3 * (SMALL * SMALL / 2 + 3);
    const double *right = rgb_lin + 3 * (SMALL * SMALL / 2 + SMALL - 4);
    for (int c = 0; c < 3; c++) {
        const double r = (double)red[c], g = (double)green[c];
        assert_true(fabs(left[c] - (0.5 * r + 0.25 * g)) < 1e-6);
        assert_true(fabs(right[c] - (0.5 * g + 0.25 * r)) < 1e-6);
    }
    free(rgb_lin);
    dip_reference_destroy(&reference);
    author_free(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(panes_blend_from_far_to_near_in_linear_light),
        cmocka_unit_test(what_is_behind_a_wall_is_hidden),
        cmocka_unit_test(the_texture_has_alpha),
        cmocka_unit_test(both_sides_of_a_double_sided_pane_are_seen),
        cmocka_unit_test(reading_samples_leaves_the_frame_as_it_is),
        cmocka_unit_test(the_order_is_from_far_to_near),
        cmocka_unit_test(water_separates_what_lies_above_and_below_it),
        cmocka_unit_test(depths_are_measured_along_the_view_axis),
        cmocka_unit_test(panes_equal_the_reference),
        cmocka_unit_test(the_pieces_of_a_mesh_are_sorted),
        cmocka_unit_test(the_number_of_pieces_is_bounded),
        cmocka_unit_test(what_is_connected_or_not_blended_or_broken_is_not_cut),
        cmocka_unit_test(pieces_move_with_their_object),
        cmocka_unit_test(water_mirrors_panes),
        cmocka_unit_test(water_is_seen_through),
        cmocka_unit_test(the_converged_picture_sorts_each_sample),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
