// Tests the bias of miplod against the closed form of a footprint. A texture shows its level of
// detail: it is black but for four white texels in the middle. At the point where these texels
// meet, level l is the mean over a square of 2^(l+1) texels, of which 4 are white, so it is 4^-l.
// The value that is read there therefore tells the level of detail.
#include "renderer/reference/reference.h"
#include "renderer/base/srgb.h"
#include "tests/renderer/scene/stage.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { SIDE = 65, TEXELS = 256 };

static const double pi = 3.14159265358979323846;

static const struct {
    const char *settings;
    double bias;
} steps[] = {
    {"miplod=performance", 1.0}, {"miplod=quality", 0.5},  {"miplod=high-quality", 0.0},
    {"miplod=sharp", -0.5},      {"miplod=sharper", -1.0}, {"miplod=sharper,af=16,aaf=on", -1.0},
};
enum { STEPS = sizeof steps / sizeof *steps };

// The value at the middle of the texture: levels are blended by the fraction of the level of
// detail, which is rounded to 1/256 and has no value below 0.
static double value_at(double lambda) {
    const double rounded = floor(fmax(0.0, lambda) * 256.0 + 0.5) / 256.0;
    const double level = floor(rounded);
    const double finer = pow(4.0, -level);
    return finer + (finer / 4.0 - finer) * (rounded - level);
}

static int add_dot(DipTestScene *scene) {
    const int texture = dip_test_scene_add_texture(scene, DIP_TEST_CHECKER, TEXELS, TEXELS);
    uint8_t *texels = dip_test_scene_texels(scene, texture);
    for (int i = 0; i < TEXELS * TEXELS; i++) {
        const int x = i % TEXELS - TEXELS / 2, y = i / TEXELS - TEXELS / 2;
        memset(texels + 4 * i, x >= -1 && x < 1 && y >= -1 && y < 1 ? 255 : 0, 3);
    }
    return texture;
}

// Makes a square of 2 m whose middle lies in front of the camera, at the distance at which a pixel
// of the picture's middle covers 2^lambda texels in each direction.
static void make_square(DipTestScene *scene, bool as_light_map, double lambda) {
    dip_test_scene_begin(scene);
    const int texture = add_dot(scene);
    const int material =
        dip_test_scene_add_material(scene, as_light_map ? DIP_NO_TEXTURE : texture);
    const double pixel_m = exp2(lambda) * 2.0 / TEXELS;
    const float away = (float)(pixel_m * SIDE / 2.0 / tan(scene->pose.fov_y_deg * pi / 360.0));
    if (as_light_map) {
        scene->materials[material].light_map = texture;
        scene->materials[material].light_map_scale = 1.0f;
    }
    const DipTestMesh mesh =
        dip_test_scene_add_mesh(scene, 4, 6, as_light_map ? DIP_TEST_UV1 : DIP_TEST_UV0, material);
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    static const float corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    float *uv = as_light_map ? mesh.uv1 : mesh.uv0;
    memcpy(mesh.indices, indices, sizeof indices);
    for (int i = 0; i < 4; i++) {
        for (int axis = 0; axis < 2; axis++) {
            mesh.positions[3 * i + axis] = corners[i][axis];
            uv[2 * i + axis] = 0.5f + 0.5f * corners[i][axis];
        }
        mesh.positions[3 * i + 2] = -away;
    }
}

// Draws the scene and returns the linear light of the pixel in the middle.
static double draw_middle(const DipTestScene *scene, const char *settings, char hash[33]) {
    DipRendererDef def = stage_def(SIDE, SIDE, settings);
    def.reflection = scene->reflection;
    Stage stage = stage_open(&scene->def, def, 1);
    const DipFrame frame = stage_draw(&stage, &scene->pose, 0);
    const uint8_t code = dip_image_centre(&frame)[0];
    if (hash) {
        dip_frame_hash(&frame, hash);
    }
    stage_close(&stage);
    return dip_srgb_decode(code / 255.0);
}

static double reference_middle(const DipTestScene *scene, const char *settings) {
    static double rgb[SIDE * SIDE * 3];
    DipError err = {0};
    DipQuality quality;
    DipReference *reference = dip_reference_create(&scene->def, &err);
    assert_non_null(reference);
    assert_true(dip_quality_parse(settings, &quality, &err));
    assert_true(dip_reference_draw(reference, &quality, &scene->pose, SIDE, SIDE, rgb, &err));
    dip_reference_destroy(&reference);
    return rgb[3 * (SIDE / 2 * SIDE + SIDE / 2)];
}

static void each_step_reads_the_level_of_the_closed_form(void **state) {
    (void)state;
    for (int i = 0; i <= 24; i++) {
        const double lambda = i / 8.0 + 1.0 / 16.0;
        DipTestScene scene;
        make_square(&scene, false, lambda);
        for (int s = 0; s < STEPS; s++) {
            const double expected = value_at(lambda + steps[s].bias);
            // Texture coordinates and the level's last bit are rounded. A code is up to 1/110 of
            // light wide.
            assert_true(fabs(reference_middle(&scene, steps[s].settings) - expected) < 0.004);
            assert_true(fabs(draw_middle(&scene, steps[s].settings, NULL) - expected) < 0.011);
        }
        dip_test_scene_free(&scene);
    }
}

static void light_maps_have_no_bias(void **state) {
    (void)state;
    for (int i = 0; i <= 8; i++) {
        const double lambda = i / 4.0 + 1.0 / 8.0;
        DipTestScene scene;
        make_square(&scene, true, lambda);
        for (int s = 0; s < STEPS; s++) {
            const double expected = value_at(lambda);
            assert_true(fabs(reference_middle(&scene, steps[s].settings) - expected) < 0.004);
            assert_true(fabs(draw_middle(&scene, steps[s].settings, NULL) - expected) < 0.011);
        }
        dip_test_scene_free(&scene);
    }
}

static void mip_colours_show_the_levels_that_fit(void **state) {
    (void)state;
    static const char *const settings[] = {"mipdebug=on", "mipdebug=on,miplod=sharp",
                                           "mipdebug=on,miplod=sharper"};
    char hash[3][33];
    DipTestScene scene;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_grazing_checker);
    for (int s = 0; s < 3; s++) {
        draw_middle(&scene, settings[s], hash[s]);
    }
    char coarser[33];
    draw_middle(&scene, "mipdebug=on,miplod=quality", coarser);
    dip_test_scene_free(&scene);
    assert_string_equal(hash[0], hash[1]);
    assert_string_equal(hash[0], hash[2]);
    assert_string_not_equal(hash[0], coarser);
}

// Draws a picture of which the mirrored picture is the top left corner, and hashes this corner.
static void hash_mirrored(const char *settings, char corner[33], char whole[33]) {
    DipTestScene scene;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_water);
    DipRendererDef def = stage_def(320, 240, settings);
    def.reflection = scene.reflection;
    def.reflection.show = true;
    Stage stage = stage_open(&scene.def, def, 1);
    DipFrame frame = stage_draw(&stage, &scene.pose, 0);
    assert_true(frame.effects.reflection.run);
    dip_frame_hash(&frame, whole);
    frame.width = def.reflection.width < 64 ? def.reflection.width : 64;
    frame.height = def.reflection.height < 48 ? def.reflection.height : 48;
    dip_frame_hash(&frame, corner);
    stage_close(&stage);
    dip_test_scene_free(&scene);
}

static void the_mirrored_scene_is_never_sharper_than_its_textures(void **state) {
    (void)state;
    char corner[3][33], whole[3][33];
    hash_mirrored("miplod=high-quality", corner[0], whole[0]);
    hash_mirrored("miplod=sharper", corner[1], whole[1]);
    hash_mirrored("miplod=performance", corner[2], whole[2]);
    assert_string_equal(corner[0], corner[1]);
    assert_string_not_equal(whole[0], whole[1]);
    assert_string_not_equal(corner[0], corner[2]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_step_reads_the_level_of_the_closed_form),
        cmocka_unit_test(light_maps_have_no_bias),
        cmocka_unit_test(mip_colours_show_the_levels_that_fit),
        cmocka_unit_test(the_mirrored_scene_is_never_sharper_than_its_textures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
