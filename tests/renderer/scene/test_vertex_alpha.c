// Tests the alpha of vertices: blended and clipped panes against closed forms, and scenes with
// textures, lights and shadows against the reference renderer.
#include "author_scenes.h"
#include "stage.h"

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
static float alphas[AUTHOR_PARTS][8192];

static Stage open_stage(const char *settings, DipIsa isa) {
    DipRendererDef def = stage_def(WIDTH, HEIGHT, settings);
    def.isa = isa;
    return stage_open(&scene.def, def, 2);
}

static DipFrame draw(const Stage *stage) {
    return stage_draw(stage, &scene.pose, 0);
}

// Gives a mesh the alpha (1 + first + slope . p) / 2 at each position p, within 0..1. The positions
// of a quad are relative to its corner, those of a sphere to its centre.
static void set_alphas(int mesh, float first, const float slope[3]) {
    DipMeshDef *def = &scene.meshes[mesh];
    assert_true(def->vertex_count <= sizeof alphas[0] / sizeof alphas[0][0]);
    for (uint32_t v = 0; v < def->vertex_count; v++) {
        float alpha = 1.0f + first;
        for (int i = 0; i < 3; i++) {
            alpha += slope[i] * def->positions[3 * (size_t)v + (size_t)i];
        }
        alphas[mesh][v] = fminf(fmaxf(0.5f * alpha, 0.0f), 1.0f);
    }
    def->alphas = alphas[mesh];
}

// --- closed forms --------------------------------------------------------------------------------

static const float colour[3] = {0.3f, 0.9f, 0.5f};
enum { TEXTURE_ALPHA = 153 };

// Makes an unlit pane that is parallel to the picture and as high as it. Its alpha runs from 0 at
// the left edge to 1 at the right one, times that of the texture if it has one.
static void make_pane(DipSurface surface, bool textured, float width) {
    author_begin(&scene);
    const int material = author_add_pbr(&scene, 0.0f, 1.0f);
    DipMaterialDef *pane = &scene.materials[material];
    pane->lit = false;
    pane->surface = surface;
    pane->opacity = 0.8f;
    pane->alpha_cutoff = 0.45f;
    memcpy(pane->base_colour_lin, colour, sizeof colour);
    if (textured) {
        pane->colour_texture = author_add_texture(&scene, 4, DIP_ENCODING_LINEAR);
        for (int i = 0; i < 16; i++) {
            memcpy(author_texels(&scene, pane->colour_texture) + (size_t)4 * (size_t)i,
                   (const uint8_t[]){255, 255, 255, TEXTURE_ALPHA}, 4);
        }
    }
    author_add_quad(&scene, material, (const float[]){-0.5f * width, -4.0f, 0.0f},
                    (const float[]){width, 0.0f, 0.0f}, (const float[]){0.0f, 8.0f, 0.0f});
    set_alphas(0, -1.0f, (const float[]){2.0f / width, 0.0f, 0.0f});
}

// Returns the alpha at a column of the picture, in pixels. The camera is 8 away from the pane.
static double alpha_at(double x, bool textured, double width) {
    const double half = 8.0 * tan(18.0 * acos(-1.0) / 180.0) * WIDTH / HEIGHT;
    const double alpha = (2.0 * x / WIDTH - 1.0) * half / width + 0.5;
    return alpha * (textured ? TEXTURE_ALPHA / 255.0 : 1.0);
}

static void the_alpha_of_the_vertices_blends(void **state) {
    (void)state;
    for (int textured = 0; textured < 2; textured++) {
        make_pane(DIP_SURFACE_BLENDED, textured, 8.0f);
        for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
            if (!dip_isa_available((DipIsa)isa)) {
                continue;
            }
            Stage stage = open_stage("aa=none", (DipIsa)isa);
            const DipFrame frame = draw(&stage);
            for (int x = 0; x < WIDTH; x++) {
                const uint8_t *pixel = dip_image_pixel(&frame, x, 37);
                for (int c = 0; c < 3; c++) {
                    const double expected =
                        alpha_at(x + 0.5, textured, 8.0) * 0.8 * (double)colour[c];
                    assert_true(abs(pixel[c] - srgb_code(expected)) <= 1);
                }
            }
            stage_close(&stage);
        }
        author_free(&scene);
    }
}

// Counts the samples of a pixel that are kept: all or none, or with alpha to coverage those that
// the distance to the edge asks for.
static double kept_share(int x, bool textured, double width, int samples) {
    const double over = alpha_at(x + 0.5, textured, width) - (double)0.45f;
    const double slope = alpha_at(x + 1.0, textured, width) - alpha_at(x, textured, width);
    if (samples == 1) {
        return over >= 0.0;
    }
    const double share = fmin(fmax(over / fmax(slope, 0.02) + 0.5, 0.0), 1.0);
    return floor(share * samples + 0.5) / samples;
}

static void the_alpha_of_the_vertices_clips(void **state) {
    (void)state;
    static const struct {
        const char *settings;
        int samples;
    } ways[] = {{"aa=none", 1}, {"aa=4", 1}, {"aa=8,aaa=coverage", 8}};
    for (int textured = 0; textured < 2; textured++) {
        const double width = 0.8; // narrow, so that alpha changes by more than 0.02 per pixel
        make_pane(DIP_SURFACE_CLIPPED, textured, (float)width);
        for (size_t w = 0; w < sizeof ways / sizeof *ways; w++) {
            Stage stage = open_stage(ways[w].settings, dip_isa_best());
            const DipFrame frame = draw(&stage);
            int partial = 0;
            int kept = 0;
            for (int x = 0; x < WIDTH; x++) {
                const double along = alpha_at(x + 0.5, false, width);
                if (along < 0.1 || along > 0.9) {
                    continue; // the pane's edge
                }
                const double share = kept_share(x, textured, width, ways[w].samples);
                const uint8_t *pixel = dip_image_pixel(&frame, x, 37);
                for (int c = 0; c < 3; c++) {
                    assert_true(abs(pixel[c] - srgb_code(share * (double)colour[c])) <= 1);
                }
                partial += share > 0.0 && share < 1.0;
                kept += share == 1.0;
            }
            assert_true(kept > 0 && kept < 12);
            assert_true(ways[w].samples == 1 || partial > 0);
            stage_close(&stage);
        }
        author_free(&scene);
    }
}

static void an_opaque_surface_ignores_it(void **state) {
    (void)state;
    make_pane(DIP_SURFACE_OPAQUE, false, 8.0f);
    Stage stage = open_stage("aa=none", dip_isa_best());
    const DipFrame frame = draw(&stage);
    for (int c = 0; c < 3; c++) {
        assert_int_equal(frame.rgba8[c], srgb_code((double)colour[c]));
    }
    stage_close(&stage);
    author_free(&scene);
}

static void numbers_out_of_range_are_refused(void **state) {
    (void)state;
    static const float bad[] = {-0.01f, 1.01f, NAN};
    for (int i = 0; i < 3; i++) {
        DipError err = {0};
        make_pane(DIP_SURFACE_BLENDED, false, 8.0f);
        alphas[0][2] = bad[i];
        assert_null(dip_scene_create(&scene.def, NULL, &err));
        assert_string_equal(err.key, "alphas");
        assert_int_equal(err.code, DIP_ERROR_RANGE);
        author_free(&scene);
    }
}

// --- against the reference -----------------------------------------------------------------------

// Where a map of 1024 texels shows shadows, their edges lie up to a texel beside those of rays.
static void compare(const char *name, const char *settings) {
    const bool shadows = strstr(settings, "shadows") != NULL;
    const DipImageBounds bounds = {.rms_lin = shadows ? 0.01 : 0.004,
                                   .pixel_lin = 0.02,
                                   .over_share = shadows ? 0.006 : 0.003,
                                   .over_max_lin = 0.6};
    Stage stage = open_stage(settings, dip_isa_best());
    stage_compare(&stage, &scene.pose, name, settings, &bounds);
    stage_close(&stage);
}

// The panes of author_make_panes with alphas, and clipped balls, one of them with a texture whose
// alpha varies. A wall receives their shadows if the scene has lights.
static void make_scene(bool lit, DipShading shading) {
    author_make_panes(&scene);
    const int spots = scene.materials[3].colour_texture;
    for (int i = 0; i < 2; i++) {
        const int material = author_add_pbr(&scene, 0.0f, 0.5f);
        scene.materials[material].surface = DIP_SURFACE_CLIPPED;
        scene.materials[material].alpha_cutoff = 0.4f;
        scene.materials[material].double_sided = true;
        scene.materials[material].colour_texture = i ? spots : DIP_NO_TEXTURE;
        scene.materials[material].pbr = i ? NULL : scene.materials[material].pbr;
        author_add_sphere(&scene, material, (const float[]){i ? 1.9f : -1.9f, 1.1f, 1.0f}, 0.8f);
    }
    for (int m = 0; m < scene.def.mesh_count; m++) {
        set_alphas(m, 0.0f, (const float[]){0.5f, 0.6f, 0.3f});
    }
    if (lit) {
        scene.lights[0] = (DipLightDef){.name = "sun",
                                        .kind = DIP_LIGHT_DIRECTIONAL,
                                        .colour_lin = {0.8f, 0.75f, 0.7f},
                                        .direction_world = {0.3f, -0.4f, -1.0f}};
        scene.lighting = (DipLightingDef){.ambient_lin = {0.15f, 0.15f, 0.2f},
                                          .lights = scene.lights,
                                          .light_count = 1,
                                          .shading = shading};
        scene.def.lighting = &scene.lighting;
    }
}

static void scenes_equal_the_reference(void **state) {
    (void)state;
    make_scene(false, DIP_SHADING_GOURAUD);
    compare("vertex_alpha", "aa=none");
    compare("vertex_alpha", "aa=4,af=8");
    compare("vertex_alpha", "aa=8,aaa=coverage");
    compare("vertex_alpha", "aa=8,aaa=all,asd=1");
    author_free(&scene);
    make_scene(true, DIP_SHADING_GOURAUD);
    compare("vertex_alpha_gouraud", "aa=4");
    compare("vertex_alpha_shadows", "aa=4,shadows=1024");
    author_free(&scene);
    make_scene(true, DIP_SHADING_PHONG);
    compare("vertex_alpha_phong", "aa=4,shadows=1024");
    author_free(&scene);
}

// A vertex with everything that a file can give it: both sets of texture coordinates, an alpha, a
// normal and a colour.
static void a_vertex_may_have_all_arrays(void **state) {
    (void)state;
    static float colours[3 * sizeof alphas[0] / sizeof alphas[0][0]];
    author_begin(&scene);
    const int material = author_add_pbr(&scene, 0.5f, 0.6f);
    scene.materials[material].surface = DIP_SURFACE_BLENDED;
    scene.materials[material].opacity = 0.9f;
    scene.materials[material].colour_texture = author_add_texture(&scene, 4, DIP_ENCODING_SRGB);
    scene.pbrs[material].occlusion_map = author_add_texture(&scene, 4, DIP_ENCODING_LINEAR);
    scene.pbrs[material].occlusion_at_uv1 = true;
    author_add_quad(&scene, material, (const float[]){-2.0f, -2.0f, 0.0f},
                    (const float[]){4.0f, 0.0f, 0.0f}, (const float[]){0.0f, 4.0f, 0.0f});
    set_alphas(0, 0.0f, (const float[]){0.2f, 0.1f, 0.0f});
    for (uint32_t i = 0; i < 3 * scene.meshes[0].vertex_count; i++) {
        colours[i] = 0.2f * (float)(i % 5 + 1);
    }
    scene.meshes[0].colours_lin = colours;
    compare("all_arrays", "aa=4");
    author_free(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_alpha_of_the_vertices_blends),
        cmocka_unit_test(the_alpha_of_the_vertices_clips),
        cmocka_unit_test(an_opaque_surface_ignores_it),
        cmocka_unit_test(numbers_out_of_range_are_refused),
        cmocka_unit_test(scenes_equal_the_reference),
        cmocka_unit_test(a_vertex_may_have_all_arrays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
