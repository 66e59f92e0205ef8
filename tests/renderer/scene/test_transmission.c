// Tests surfaces that transmit light: panes before a wall against closed forms, and scenes of glass
// against the reference renderer, which sorts each sample by itself.
#include "author_scenes.h"
#include "stage.h"

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

static Stage open_stage(const char *settings, bool plain) {
    DipRendererDef def = stage_def(WIDTH, HEIGHT, settings);
    def.plain_surfaces = plain;
    def.reflection = scene.reflection;
    return stage_open(&scene.def, def, 2);
}

static DipFrame draw(const Stage *stage) {
    return stage_draw(stage, &scene.pose, 0);
}

// --- closed forms --------------------------------------------------------------------------------

static const float wall_lin[3] = {0.9f, 0.5f, 0.2f};
static const float pane_lin[3] = {0.3f, 0.8f, 0.6f};

// Makes a pane that fills the picture, before an unlit wall. f0 and f90: what it reflects.
static DipMaterialDef *make_pane(float transmission, float f0, float f90) {
    author_begin(&scene);
    const int wall = author_add_pbr(&scene, 0.0f, 1.0f);
    scene.materials[wall].lit = false;
    memcpy(scene.materials[wall].base_colour_lin, wall_lin, sizeof wall_lin);
    const int glass = author_add_pbr(&scene, 0.0f, 0.0f);
    DipPbrDef *pbr = &scene.pbrs[glass];
    pbr->f0_lin[0] = pbr->f0_lin[1] = pbr->f0_lin[2] = f0;
    pbr->f90 = f90;
    pbr->transmission = transmission;
    DipMaterialDef *pane = &scene.materials[glass];
    pane->surface = DIP_SURFACE_BLENDED;
    memcpy(pane->base_colour_lin, pane_lin, sizeof pane_lin);
    for (int i = 0; i < 2; i++) {
        author_add_quad(&scene, i, (const float[]){-9.0f, -9.0f, (float)i - 1.0f},
                        (const float[]){18.0f, 0.0f, 0.0f}, (const float[]){0.0f, 18.0f, 0.0f});
    }
    return pane;
}

// Draws the scene and compares the middle of the picture.
static void expect(const double rgb[3], int codes) {
    static const char *const settings[] = {"aa=none", "aa=4"};
    for (int s = 0; s < 2; s++) {
        Stage stage = open_stage(settings[s], false);
        const DipFrame frame = draw(&stage);
        for (int c = 0; c < 3; c++) {
            assert_true(abs(dip_image_centre(&frame)[c] - srgb_code(rgb[c])) <= codes);
        }
        assert_int_equal(dip_image_centre(&frame)[3], 255);
        assert_true(frame.effects.transmission.run && frame.effects.blend.run);
        assert_true(frame.counters.fragments_transmitting >= WIDTH * HEIGHT);
        assert_int_equal(frame.counters.fragments_blended,
                         2 * frame.counters.fragments_transmitting);
        stage_close(&stage);
    }
}

// Without reflection, each channel of what lies behind is multiplied by the pane's colour, and the
// rest of the light is diffuse. The fixed light is that of a surface that faces +z.
static void a_pane_filters_each_channel(void **state) {
    (void)state;
    const double light = 0.35 + 0.65 * 0.61079455;
    static const float transmissions[] = {1.0f, 0.25f};
    static const float opacities[] = {1.0f, 0.6f};
    for (int i = 0; i < 4; i++) {
        const double t = (double)transmissions[i / 2];
        const double alpha = (double)opacities[i % 2];
        double expected[3];
        make_pane(transmissions[i / 2], 0.0f, 0.0f)->opacity = opacities[i % 2];
        for (int c = 0; c < 3; c++) {
            const double behind = (double)wall_lin[c];
            const double own = (double)pane_lin[c];
            expected[c] =
                alpha * (t * own * behind + (1.0 - t) * own * light) + (1.0 - alpha) * behind;
        }
        expect(expected, 1);
        author_free(&scene);
    }
}

// A pane that lets all light through still mirrors its surroundings at full strength: head on, it
// keeps f0 of what lies behind and sees the radiance 0.35 of the horizon. The sun's highlight, with
// a width of 0.1, adds 0.0016 for f0 = 0.04.
static void clear_glass_mirrors_its_surroundings(void **state) {
    (void)state;
    static const double shares[] = {0.04, 0.5};
    for (int i = 0; i < 2; i++) {
        const double f0 = shares[i];
        double expected[3];
        DipMaterialDef *pane = make_pane(1.0f, (float)f0, 1.0f);
        for (int c = 0; c < 3; c++) {
            pane->base_colour_lin[c] = 1.0f;
            expected[c] = (1.0 - f0) * (double)wall_lin[c] + f0 * (0.35 + 0.04);
        }
        expect(expected, 2);
        author_free(&scene);
    }
}

// A metal lets nothing through, and an opaque surface is not blended.
static void what_is_opaque_hides_the_wall(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        char hashes[2][33];
        for (int k = 0; k < 2; k++) {
            DipMaterialDef *pane = make_pane(1.0f, 0.0f, 0.0f);
            scene.pbrs[1].metallic = i ? 1.0f : 0.0f;
            pane->surface = i ? DIP_SURFACE_BLENDED : DIP_SURFACE_OPAQUE;
            scene.materials[0].base_colour_lin[1] = k ? 0.5f : 0.1f;
            Stage stage = open_stage("aa=none", false);
            const DipFrame frame = draw(&stage);
            dip_frame_hash(&frame, hashes[k]);
            assert_true(i || !frame.effects.transmission.run);
            assert_true(i || strcmp(frame.effects.transmission.why,
                                    "no metallic-roughness surface transmits light") == 0);
            stage_close(&stage);
            author_free(&scene);
        }
        assert_string_equal(hashes[0], hashes[1]);
    }
}

// Where metallic-roughness descriptions are not drawn, transmission is a lower opacity.
static void a_plain_pane_is_blended(void **state) {
    (void)state;
    make_pane(0.75f, 0.04f, 1.0f);
    Stage stage = open_stage("aa=none", true);
    const DipFrame frame = draw(&stage);
    const double light = 0.35 + 0.65 * 0.61079455;
    for (int c = 0; c < 3; c++) {
        const double expected = 0.25 * (double)pane_lin[c] * light + 0.75 * (double)wall_lin[c];
        assert_true(abs(dip_image_centre(&frame)[c] - srgb_code(expected)) <= 1);
    }
    stage_close(&stage);
    author_free(&scene);
}

// --- against the reference -----------------------------------------------------------------------

static void compare(const char *name, const char *settings) {
    static const DipImageBounds bounds = {
        .rms_lin = 0.004, .pixel_lin = 0.02, .over_share = 0.003, .over_max_lin = 0.6};
    Stage stage = open_stage(settings, false);
    stage_compare(&stage, &scene.pose, name, settings, &bounds);
    stage_close(&stage);
}

static void glass_equals_the_reference(void **state) {
    (void)state;
    author_make_glass(&scene);
    scene.pbrs[1].roughness = 0.5f; // which blurs nothing without scattering
    compare("glass", "aa=none");
    compare("glass", "aa=4,af=8");
    compare("glass", "aa=8,aaa=all,asd=1");
    author_add_water(&scene, WIDTH, HEIGHT);
    compare("glass_in_water", "aa=2");
    author_free(&scene);
}

// The converged picture of a pane is the closed form, too.
static void the_converged_picture_filters_each_channel(void **state) {
    (void)state;
    enum { SMALL = 8, SAMPLES = 16 };
    DipError err = {0};
    make_pane(1.0f, 0.0f, 0.0f);
    DipReference *reference = dip_reference_create(&scene.def, &err);
    double *rgb_lin = malloc(SMALL * SMALL * 3 * sizeof *rgb_lin);
    assert_true(reference && rgb_lin);
    assert_true(
        dip_reference_converge(reference, &scene.pose, SMALL, SMALL, SAMPLES, 1, rgb_lin, &err));
    for (int c = 0; c < 3; c++) {
        const double expected = (double)wall_lin[c] * (double)pane_lin[c];
        assert_true(fabs(rgb_lin[3 * (SMALL * SMALL / 2) + c] - expected) < 1e-6);
    }
    free(rgb_lin);
    dip_reference_destroy(&reference);
    author_free(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_pane_filters_each_channel),
        cmocka_unit_test(clear_glass_mirrors_its_surroundings),
        cmocka_unit_test(what_is_opaque_hides_the_wall),
        cmocka_unit_test(a_plain_pane_is_blended),
        cmocka_unit_test(glass_equals_the_reference),
        cmocka_unit_test(the_converged_picture_filters_each_channel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
