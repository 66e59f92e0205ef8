// Tests rough glass, which blurs what is seen through it: panes before walls against closed forms,
// whole scenes against the reference renderer, and that nothing depends on the plan, the threads
// and the instruction set.
#include "author_scenes.h"
#include "stage.h"

#include "renderer/reference/convergence.h"
#include "renderer/reference/reference.h"
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

// How a picture is drawn. All 0: with the best instruction set on two threads.
typedef struct Way {
    const char *settings; // NULL: aa=none
    int size;             // times WIDTH x HEIGHT; 0 means 1
    int threads;
    bool forced;
    bool other_isa;
    DipIsa isa;
} Way;

static Stage open_stage(const Way *way) {
    const int size = way->size ? way->size : 1;
    DipRendererDef def =
        stage_def(WIDTH * size, HEIGHT * size, way->settings ? way->settings : "aa=none");
    def.force_all_effects = way->forced;
    def.reflection = scene.reflection;
    if (way->other_isa) {
        def.isa = way->isa;
    }
    return stage_open(&scene.def, def, way->threads ? way->threads : 2);
}

static DipFrame draw(const Stage *stage) {
    return stage_draw(stage, &scene.pose, 0);
}

// Adds an unlit wall at z = -1 from x = left to x = right.
static void add_wall(float left, float right, const float colour[3]) {
    const int wall = author_add_pbr(&scene, 0.0f, 1.0f);
    scene.materials[wall].lit = false;
    memcpy(scene.materials[wall].base_colour_lin, colour, 3 * sizeof *colour);
    author_add_quad(&scene, wall, (const float[]){left, -9.0f, -1.0f},
                    (const float[]){right - left, 0.0f, 0.0f}, (const float[]){0.0f, 18.0f, 0.0f});
}

// Adds a pane at z = 0 that reflects nothing and lets all light through. Returns its material.
static int add_pane(float left, float right, float roughness) {
    const int glass = author_add_pbr(&scene, 0.0f, roughness);
    DipPbrDef *pbr = &scene.pbrs[glass];
    pbr->f0_lin[0] = pbr->f0_lin[1] = pbr->f0_lin[2] = pbr->f90 = 0.0f;
    pbr->transmission = 1.0f;
    pbr->scattering = 1.0f;
    scene.materials[glass].surface = DIP_SURFACE_BLENDED;
    author_add_quad(&scene, glass, (const float[]){left, -9.0f, 0.0f},
                    (const float[]){right - left, 0.0f, 0.0f}, (const float[]){0.0f, 18.0f, 0.0f});
    return glass;
}

// --- closed forms --------------------------------------------------------------------------------

static const float wall_lin[3] = {0.9f, 0.5f, 0.2f};
static const float pane_lin[3] = {0.3f, 0.8f, 0.6f};
static const float white[3] = {1.0f, 1.0f, 1.0f};
static const float black[3] = {0.0f, 0.0f, 0.0f};

// The blur of a wall of one colour is that colour, whatever the roughness.
static void a_wall_of_one_colour_stays_as_it_is(void **state) {
    (void)state;
    static const float roughnesses[] = {0.15f, 0.5f, 1.0f};
    for (int i = 0; i < 6; i++) {
        const float opacity = i % 2 ? 0.6f : 1.0f;
        author_begin(&scene);
        add_wall(-9.0f, 9.0f, wall_lin);
        DipMaterialDef *pane = &scene.materials[add_pane(-9.0f, 9.0f, roughnesses[i / 2])];
        memcpy(pane->base_colour_lin, pane_lin, sizeof pane_lin);
        pane->opacity = opacity;
        Stage stage = open_stage(&(Way){.settings = "aa=4"});
        const DipFrame frame = draw(&stage);
        for (int c = 0; c < 3; c++) {
            const double behind = (double)wall_lin[c];
            const double seen = (double)opacity * (double)pane_lin[c] + 1.0 - (double)opacity;
            assert_true(abs(dip_image_centre(&frame)[c] - srgb_code(seen * behind)) <= 1);
        }
        assert_true(frame.effects.scattering.run && frame.effects.transmission.run);
        assert_int_equal(frame.counters.fragments_scattering, frame.counters.fragments_blended);
        assert_true(frame.counters.fragments_scattering >= WIDTH * HEIGHT);
        assert_int_equal(frame.counters.fragments_behind, WIDTH * HEIGHT);
        assert_true(frame.counters.backdrop_texels > WIDTH * HEIGHT);
        assert_true(frame.counters.backdrop_bytes > WIDTH * HEIGHT * 12);
        stage_close(&stage);
        author_free(&scene);
    }
}

// Returns how many pixels of the middle row lie between the two walls' colours: the number of rows
// by which a straight line from one to the other would be as long as the sum of all differences.
static double width_of_step(const DipFrame *frame) {
    const uint8_t *row = dip_image_pixel(frame, 0, frame->height / 2);
    double moment = 0.0;
    for (int x = 0; x < frame->width; x++) {
        const double light = srgb_light(row[4 * x]);
        const double step = x + 0.5 < 0.5 * frame->width ? 0.0 : 1.0;
        moment += fabs(light - step);
    }
    return moment;
}

// The blur is a share of the picture's width, so a picture of twice the size has the same look, and
// so has one that a render scale draws. Clear glass shows the step sharp.
static void the_blur_does_not_depend_on_the_size(void **state) {
    (void)state;
    double widths[4];
    static const char *const settings[4] = {"aa=8", "aa=8", "aa=8,scale=2", "aa=8"};
    for (int i = 0; i < 4; i++) {
        author_begin(&scene);
        add_wall(-9.0f, 0.0f, black);
        add_wall(0.0f, 9.0f, white);
        scene.pbrs[add_pane(-9.0f, 9.0f, 0.75f)].scattering = i == 3 ? 0.0f : 1.0f;
        Stage stage = open_stage(&(Way){.settings = settings[i], .size = i == 1 ? 2 : 1});
        const DipFrame frame = draw(&stage);
        widths[i] = width_of_step(&frame);
        assert_true(frame.effects.scattering.run == (i != 3));
        assert_true((frame.counters.backdrop_bytes > 0) == (i != 3));
        stage_close(&stage);
        author_free(&scene);
    }
    printf("step: %.3f pixels, %.3f at twice the size, %.3f with scale=2, %.3f clear\n", widths[0],
           widths[1], widths[2], widths[3]);
    // A texel of the level has 5120^-0.25 of the width, 19 pixels; the mean difference of a step
    // that is blurred with a standard deviation s is s sqrt(2 / pi), and the spline's is about 0.65
    // of a texel.
    assert_true(fabs(widths[0] - 19.0 * 0.65 * 0.8) < 2.0);
    assert_true(fabs(widths[1] / widths[0] - 2.0) < 0.1);
    assert_true(fabs(widths[2] / widths[0] - 1.0) < 0.05);
    assert_true(widths[3] < 0.1);
}

// --- the plan ------------------------------------------------------------------------------------

static void hash_of(const Way *way, char hash[33], DipFrame *frame) {
    Stage stage = open_stage(way);
    *frame = draw(&stage); // After this function, only its counters and effects stay valid.
    dip_frame_hash(frame, hash);
    stage_close(&stage);
}

// Panes of several roughnesses before walls, in a part of the picture.
static void make_panes(void) {
    author_begin(&scene);
    for (int i = 0; i < 6; i++) {
        add_wall((float)i - 3.0f, (float)i - 2.0f, i % 2 ? wall_lin : pane_lin);
    }
    add_pane(-2.5f, -1.9f, 0.35f);
    add_pane(-1.2f, -0.8f, 0.6f);
}

static void planned_and_forced_pictures_are_equal(void **state) {
    (void)state;
    static const char *const settings[] = {"aa=none", "aa=6", "aa=4,scale=2", "aa=2,scale=1/2"};
    make_panes();
    for (int i = 0; i < 4; i++) {
        char planned[33];
        char forced[33];
        DipFrame frames[2];
        hash_of(&(Way){.settings = settings[i]}, planned, &frames[0]);
        hash_of(&(Way){.settings = settings[i], .forced = true}, forced, &frames[1]);
        assert_string_equal(planned, forced);
        assert_true(frames[0].counters.fragments_behind < frames[1].counters.fragments_behind);
        assert_true(frames[0].counters.backdrop_texels < frames[1].counters.backdrop_texels);
        assert_string_equal(frames[0].effects.scattering.why,
                            "surfaces that blur what is seen through them are in view");
    }
    author_free(&scene);
}

static void glass_out_of_view_costs_nothing(void **state) {
    (void)state;
    DipFrame frame;
    char hash[33];
    author_begin(&scene);
    add_wall(-9.0f, 9.0f, wall_lin);
    const int clear = add_pane(-0.5f, 0.5f, 0.1f);
    scene.pbrs[clear].scattering = 0.99f;
    hash_of(&(Way){0}, hash, &frame);
    assert_true(frame.effects.transmission.run);
    assert_string_equal(frame.effects.scattering.why, "no surface blurs what is seen through it");
    assert_int_equal(frame.counters.backdrop_bytes, 0);
    scene.pbrs[clear].scattering = 0.0f;
    add_pane(7.0f, 8.0f, 0.5f);
    hash_of(&(Way){0}, hash, &frame);
    assert_false(frame.effects.scattering.run);
    assert_string_equal(frame.effects.scattering.why,
                        "no surface that blurs what is seen through it is in view");
    assert_int_equal(frame.counters.fragments_behind, 0);
    assert_int_equal(frame.counters.backdrop_texels, 0);
    author_free(&scene);
}

static void pictures_do_not_depend_on_threads_and_instruction_sets(void **state) {
    (void)state;
    char expected[33];
    DipFrame frame;
    make_panes();
    hash_of(&(Way){.settings = "aa=4", .other_isa = true, .isa = DIP_ISA_SCALAR, .threads = 1},
            expected, &frame);
    for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
        for (int threads = 1; threads <= 3 && dip_isa_available((DipIsa)isa); threads++) {
            char found[33];
            hash_of(
                &(Way){
                    .settings = "aa=4", .other_isa = true, .isa = (DipIsa)isa, .threads = threads},
                found, &frame);
            assert_string_equal(found, expected);
        }
    }
    author_free(&scene);
}

// --- against the reference -----------------------------------------------------------------------

static void compare(const char *name, const char *settings) {
    static const DipImageBounds bounds = {
        .rms_lin = 0.004, .pixel_lin = 0.02, .over_share = 0.003, .over_max_lin = 0.6};
    Stage stage = open_stage(&(Way){.settings = settings});
    const DipFrame frame = stage_compare(&stage, &scene.pose, name, settings, &bounds);
    assert_true(frame.effects.scattering.run);
    stage_close(&stage);
}

// Makes rough glass, some of it with a map of the roughness.
static void make_glass(void) {
    author_make_glass(&scene);
    for (int m = 0; m < 4; m++) {
        scene.pbrs[m].roughness = 0.4f + 0.15f * (float)m;
        scene.pbrs[m].scattering = m == 2 ? 0.7f : 1.0f;
    }
    const int map = author_add_texture(&scene, 64, DIP_ENCODING_LINEAR);
    uint8_t *texels = author_texels(&scene, map);
    for (int i = 0; i < 64 * 64; i++) {
        texels[4 * i + 1] = (uint8_t)(90 + 2 * (i % 64));
        texels[4 * i + 2] = 255;
    }
    scene.pbrs[0].roughness = 1.0f;
    scene.pbrs[0].metal_rough_map = map;
}

static void rough_glass_equals_the_reference(void **state) {
    (void)state;
    make_glass();
    compare("rough_glass", "aa=none");
    compare("rough_glass", "aa=4,af=8");
    compare("rough_glass", "aa=8,aaa=all,asd=1");
    compare("rough_glass", "aa=2,scale=1.5");
    author_add_water(&scene, WIDTH, HEIGHT);
    compare("rough_glass_in_water", "aa=2");
    author_free(&scene);
}

// Both ways to a converged picture give the same bits, and its blur is that of a drawn picture.
static void the_converged_picture_blurs_alike(void **state) {
    (void)state;
    enum { SAMPLES = 16 };
    DipError err = {0};
    make_glass();
    DipReference *reference = dip_reference_create(&scene.def, &err);
    const size_t values = (size_t)WIDTH * HEIGHT * 3;
    double *whole = malloc(values * sizeof *whole);
    double *tiles = calloc(values, sizeof *tiles);
    assert_true(reference && whole && tiles);
    assert_true(
        dip_reference_converge(reference, &scene.pose, WIDTH, HEIGHT, SAMPLES, 1, whole, &err));
    DipConvergence *convergence =
        dip_convergence_create(reference, &scene.pose, WIDTH, HEIGHT, &err);
    assert_non_null(convergence);
    for (int t = 0; t < dip_convergence_tile_count(convergence); t++) {
        assert_true(dip_convergence_add_tile(convergence, t, SAMPLES, 1, 1.0, tiles, NULL, &err));
    }
    assert_memory_equal(whole, tiles, values * sizeof *whole);
    Stage stage = open_stage(&(Way){.settings = "aa=8,scale=2"});
    const DipFrame frame = draw(&stage);
    const DipImageError error = dip_image_compare(whole, &frame, 0.02);
    printf("converged: rms %.5f, %.1f dB\n", error.rms_lin, error.psnr_db);
    assert_true(error.rms_lin < 0.02);
    stage_close(&stage);
    dip_convergence_destroy(&convergence);
    free(whole);
    free(tiles);
    dip_reference_destroy(&reference);
    author_free(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_wall_of_one_colour_stays_as_it_is),
        cmocka_unit_test(the_blur_does_not_depend_on_the_size),
        cmocka_unit_test(planned_and_forced_pictures_are_equal),
        cmocka_unit_test(glass_out_of_view_costs_nothing),
        cmocka_unit_test(pictures_do_not_depend_on_threads_and_instruction_sets),
        cmocka_unit_test(rough_glass_equals_the_reference),
        cmocka_unit_test(the_converged_picture_blurs_alike),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
