// Tests how the reference shades. Compares interpolation with ray casting. On a plane whose
// Jacobian is known, compares the level of detail with the value that follows from the Jacobian.
// Also tests light, light maps, alpha, and which input the reference refuses.
#include "renderer/pipeline/pattern.h"
#include "renderer/reference/convergence.h"
#include "tests/renderer/pipeline/screen.h"
#include "renderer/catalogue/random.h"

#include <limits.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "tests/renderer/pipeline/near.h"
#include "tests/support/srgb.h"

static DipScreenPicture picture;

static double determinant(const double a[3], const double b[3], const double c[3]) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// Finds where the ray through a screen position meets the triangle. Solves "sum of weighted corners
// = ray" for the weights of the corners by Cramer's rule and scales the weights so that they add up
// to 1. The ray hits the triangle if all three weights are positive.
static void cast_ray(const DipTestMesh *mesh, double x, double y, double weights[3]) {
    const double ray[3] = {x / 32.0 - 1.0, 1.0 - y / 32.0, -1.0};
    double v[3][3];
    for (int i = 0; i < 9; i++) {
        v[i / 3][i % 3] = mesh->positions[i];
    }
    const double whole = determinant(v[0], v[1], v[2]);
    weights[0] = determinant(ray, v[1], v[2]) / whole;
    weights[1] = determinant(v[0], ray, v[2]) / whole;
    weights[2] = determinant(v[0], v[1], ray) / whole;
    const double sum = weights[0] + weights[1] + weights[2];
    for (int i = 0; i < 3; i++) {
        weights[i] /= sum;
    }
}

static DipTestMesh add_random_triangle(DipTestScene *scene, Random *random) {
    DipScreenPoint p[3];
    for (int i = 0; i < 3; i++) {
        p[i] = dip_screen_snap(random_real(random, -30.0, 94.0), random_real(random, -30.0, 94.0),
                               random_int(random, 0, 1) ? 1.0 : 8.0);
    }
    const DipTestMesh mesh =
        dip_screen_add_polygon(scene, dip_screen_add_white(scene), p, 3, DIP_TEST_COLOURS);
    for (int i = 0; i < 9; i++) {
        mesh.colours_lin[i] = (float)random_real(random, 0.0, 1.0);
    }
    return mesh;
}

// Computes the expected colour of a pixel. Returns false if a sample lies too close to an edge for
// ray casting to decide.
static bool expect_pixel(const DipTestMesh *mesh, const DipSamplePattern *pattern, int x, int y,
                         double rgb[3]) {
    double weights[3];
    int first = -1;
    int covered = 0;
    for (int s = 0; s < pattern->count; s++) {
        cast_ray(mesh, x + pattern->x[s] / 256.0, y + pattern->y[s] / 256.0, weights);
        const double least = fmin(weights[0], fmin(weights[1], weights[2]));
        if (fabs(least) < 1e-9) {
            return false;
        }
        if (least > 0.0) {
            first = first < 0 ? s : first;
            covered++;
        }
    }
    rgb[0] = rgb[1] = rgb[2] = 0.0;
    if (covered == 0) {
        return true;
    }
    if (covered == pattern->count) {
        cast_ray(mesh, x + 0.5, y + 0.5, weights);
    } else {
        cast_ray(mesh, x + pattern->x[first] / 256.0, y + pattern->y[first] / 256.0, weights);
    }
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < 3; i++) {
            rgb[c] += weights[i] * mesh->colours_lin[3 * i + c] * covered / pattern->count;
        }
    }
    return true;
}

static void interpolation_agrees_with_ray_casting(void **state) {
    (void)state;
    static const int counts[] = {1, 2, 4, 6, 8};
    static const char *const settings[] = {"aa=none", "aa=2", "aa=4", "aa=6", "aa=8"};
    Random random = {21};
    int told = 0;
    for (int t = 0; t < 40; t++) {
        DipTestScene scene;
        dip_screen_begin(&scene);
        const DipTestMesh mesh = add_random_triangle(&scene, &random);
        dip_screen_draw(&scene, settings[t % 5], picture);
        for (int i = 0; i < DIP_SCREEN * DIP_SCREEN; i++) {
            const int x = i % DIP_SCREEN;
            const int y = i / DIP_SCREEN;
            double rgb[3];
            if (expect_pixel(&mesh, dip_sample_pattern(counts[t % 5]), x, y, rgb)) {
                for (int c = 0; c < 3; c++) {
                    assert_near(picture[y][x][c], rgb[c], 1e-8);
                }
                told++;
            }
        }
        dip_test_scene_free(&scene);
    }
    assert_true(told > 40 * DIP_SCREEN * DIP_SCREEN * 99 / 100);
}

// Makes a ground 1 m below the eye. Its coordinate x points to the right, and w points ahead and
// runs from 1 to 16. The texture coordinates are (x, w), with 256 texels per unit. On the screen, w
// = 1 / (y / 32 - 1) and x = (x_px / 32 - 1) w.
static void make_ground(DipTestScene *scene) {
    dip_screen_begin(scene);
    const int texture = dip_test_scene_add_texture(scene, DIP_TEST_CHECKER, 256, 256);
    const int material = dip_test_scene_add_material(scene, texture);
    const DipScreenPoint p[4] = {{-64, 64, 1}, {128, 64, 1}, {128, 34, 16}, {-64, 34, 16}};
    const DipTestMesh mesh = dip_screen_add_polygon(scene, material, p, 4, DIP_TEST_UV0);
    for (int i = 0; i < 4; i++) {
        mesh.uv0[2 * i] = mesh.positions[3 * i];
        mesh.uv0[2 * i + 1] = (float)p[i].w;
    }
}

static void ground_jacobian(double x, double y, double dx[2], double dy[2]) {
    const double w = 1.0 / (y / 32.0 - 1.0);
    dx[0] = 256.0 * w / 32.0;
    dx[1] = 0.0;
    dy[0] = 256.0 * (x / 32.0 - 1.0) * (-w * w / 32.0);
    dy[1] = 256.0 * (-w * w / 32.0);
}

// Returns the lambda of the advanced footprint. The greater eigenvalue of J J^T is M^2, and the
// determinant gives m.
static double advanced_lambda(const double dx[2], const double dy[2], double max) {
    const double a = dx[0] * dx[0] + dy[0] * dy[0];
    const double b = dx[0] * dx[1] + dy[0] * dy[1];
    const double c = dx[1] * dx[1] + dy[1] * dy[1];
    const double major = sqrt((a + c) * 0.5 + sqrt((a - c) * (a - c) * 0.25 + b * b));
    const double minor = fabs(dx[0] * dy[1] - dx[1] * dy[0]) / major;
    return log2(major / fmin(major / minor, max));
}

static void mip_colour_at(double lambda, double rgb[3]) {
    static const uint8_t codes[10][3] = {{255, 0, 0},   {255, 128, 0}, {255, 255, 0}, {0, 255, 0},
                                         {0, 0, 255},   {128, 0, 128}, {128, 0, 128}, {128, 0, 128},
                                         {128, 0, 128}, {128, 0, 128}};
    const double level = fmin(fmax(lambda, 0.0), 8.0);
    const int finer = (int)level;
    for (int c = 0; c < 3; c++) {
        const double near_one = srgb_light(codes[finer][c]);
        rgb[c] = near_one + (srgb_light(codes[finer + 1][c]) - near_one) * (level - finer);
    }
}

static void check_ground(const char *settings, double max_anisotropy, double bias) {
    DipTestScene scene;
    make_ground(&scene);
    dip_screen_draw(&scene, settings, picture);
    for (int y = 34; y < DIP_SCREEN; y++) {
        for (int x = 0; x < DIP_SCREEN; x++) {
            double dx[2], dy[2], rgb[3];
            ground_jacobian(x + 0.5, y + 0.5, dx, dy);
            const double lambda = max_anisotropy > 1.0
                                      ? advanced_lambda(dx, dy, max_anisotropy)
                                      : log2(fmax(hypot(dx[0], dx[1]), hypot(dy[0], dy[1])));
            mip_colour_at(lambda + bias, rgb);
            for (int c = 0; c < 3; c++) {
                assert_near(picture[y][x][c], rgb[c], 0.51 / 256.0); // half a step of lambda
            }
        }
    }
    dip_test_scene_free(&scene);
}

static void level_of_detail_on_the_ground_follows_the_jacobian(void **state) {
    (void)state;
    check_ground("mipdebug=on", 1.0, 0.0);
    check_ground("mipdebug=on,miplod=quality", 1.0, 0.5);
    check_ground("mipdebug=on,miplod=performance,aa=8", 1.0, 1.0);
    check_ground("mipdebug=on,af=2,aaf=on", 2.0, 0.0);
    check_ground("mipdebug=on,af=16,aaf=on", 16.0, 0.0);
}

static void light_follows_the_normal(void **state) {
    (void)state;
    const double sun[3] = {-0.42, 0.67, 0.61};
    const double length = sqrt(0.42 * 0.42 + 0.67 * 0.67 + 0.61 * 0.61);
    static const float normals[4][3] = {{0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {0.6f, 0, -0.8f}};
    for (int k = 0; k < 4; k++) {
        DipTestScene scene;
        dip_screen_begin(&scene);
        const int material = dip_screen_add_white(&scene);
        scene.materials[material].lit = true;
        scene.materials[material].base_colour_lin[1] = 0.5f;
        const DipScreenPoint p[3] = {{-100, 200, 1}, {32, -200, 1}, {200, 200, 1}};
        const DipTestMesh mesh = dip_screen_add_polygon(&scene, material, p, 3, DIP_TEST_NORMALS);
        double to_sun = 0.0;
        for (int i = 0; i < 3; i++) {
            memcpy(mesh.normals + 3 * i, normals[k], sizeof normals[k]);
            to_sun += normals[k][i] * sun[i] / length;
        }
        const double light = 0.35 + 0.15 * normals[k][1] + 0.65 * fmax(0.0, to_sun);
        dip_screen_draw(&scene, "aa=none", picture);
        assert_near(picture[32][32][0], fmin(light, 1.0), 1e-7);
        assert_near(picture[32][32][1], 0.5 * light, 1e-7);
        dip_test_scene_free(&scene);
    }
}

// Adds a texture with one row of grey texels.
static int add_grey(DipTestScene *scene, int width, const uint8_t *grey, DipEncoding encoding) {
    const int texture = dip_test_scene_add_texture(scene, DIP_TEST_NOISE, width, 1);
    uint8_t *texels = dip_test_scene_texels(scene, texture);
    for (int i = 0; i < width; i++) {
        memset(texels + 4 * i, grey[i], 4);
    }
    scene->textures[texture].encoding = encoding;
    scene->textures[texture].wrap_u = DIP_WRAP_CLAMP;
    return texture;
}

static void colour_is_base_times_texture_times_light_map(void **state) {
    (void)state;
    DipTestScene scene;
    dip_screen_begin(&scene);
    const int colour = add_grey(&scene, 1, (const uint8_t[]){188}, DIP_ENCODING_SRGB);
    const int light = add_grey(&scene, 1, (const uint8_t[]){100}, DIP_ENCODING_LINEAR);
    const int material = dip_test_scene_add_material(&scene, colour);
    scene.materials[material].light_map = light;
    scene.materials[material].light_map_scale = 2.0f;
    scene.materials[material].base_colour_lin[2] = 0.25f;
    dip_screen_add_cover(&scene, material, 1.0f, 1.0f);
    const double texel = srgb_light(188);
    // Without second texture coordinates, the light map has no effect.
    dip_screen_draw(&scene, "af=16", picture);
    assert_near(picture[9][5][0], texel, 1e-12);
    scene.meshes[0].uv1 = scene.meshes[0].uv0;
    dip_screen_draw(&scene, "af=16", picture);
    assert_near(picture[9][5][0], texel * 2.0 * 100.0 / 255.0, 1e-12);
    assert_near(picture[9][5][2], texel * 0.25 * 2.0 * 100.0 / 255.0, 1e-12);
    scene.materials[material].light_map_scale = 20.0f;
    dip_screen_draw(&scene, "aa=2", picture);
    assert_near(picture[9][5][0], 1.0, 0.0);
    dip_screen_converge(&scene, 4, 1, picture);
    assert_near(picture[9][5][0], 1.0, 1e-12);
    dip_test_scene_free(&scene);
}

static void make_clipped(DipTestScene *scene, int width, const uint8_t *alpha, float cutoff) {
    dip_screen_begin(scene);
    const int material =
        dip_test_scene_add_material(scene, add_grey(scene, width, alpha, DIP_ENCODING_LINEAR));
    scene->materials[material].surface = DIP_SURFACE_CLIPPED;
    scene->materials[material].alpha_cutoff = cutoff;
    dip_screen_add_cover(scene, material, 1.0f, 1.0f);
}

static void alpha_at_the_cutoff_keeps_the_sample(void **state) {
    (void)state;
    for (int code = 1; code < 256; code++) {
        const uint8_t alpha = (uint8_t)code;
        DipTestScene scene;
        make_clipped(&scene, 1, &alpha, (float)(code / 255.0));
        dip_screen_draw(&scene, "aa=2", picture);
        assert_near(picture[3][4][0], code / 255.0, 1e-12);
        scene.materials[0].alpha_cutoff = (float)((code + 0.01) / 255.0);
        dip_screen_draw(&scene, "aa=2", picture);
        assert_near(picture[3][4][0], 0.0, 0.0);
        dip_test_scene_free(&scene);
    }
}

// Alpha rises from 0 to 1 between u = 1/4 and u = 3/4, over 32 pixels. Alpha reaches the cutoff of
// 0.375 where column 28 begins, and the cutoff of 0.38 at x = 28.16. With every step of aa, fully
// covered pixels test alpha at their centre. In the converged picture, a pixel depends on the area
// that alpha keeps.
static void alpha_is_tested_at_centres_and_converges_to_area(void **state) {
    (void)state;
    static const float cutoffs[] = {0.375f, 0.38f, 0.395f};
    static const double area[] = {1.0, 0.84, 0.36};
    static const int centre_is_in[] = {1, 1, 0};
    for (int k = 0; k < 3; k++) {
        DipTestScene scene;
        make_clipped(&scene, 2, (const uint8_t[]){0, 255}, cutoffs[k]);
        // The texture's colour equals its alpha, so this only checks whether the pixel is drawn.
        dip_screen_draw(&scene, "aa=8", picture);
        assert_near(picture[7][27][0], 0.0, 0.0);
        assert_int_equal(picture[7][28][0] > 0.0, centre_is_in[k]);
        assert_true(picture[7][29][0] > 0.3);
        dip_screen_converge(&scene, 256, 3, picture);
        double column = 0.0;
        for (int y = 0; y < DIP_SCREEN; y++) {
            column += picture[y][28][0] / DIP_SCREEN;
        }
        // The mean of alpha over the kept area.
        const double mean = area[k] * (12.0 + 1.0 - area[k] * 0.5) / 32.0;
        assert_near(column, mean, 2e-3);
        dip_test_scene_free(&scene);
    }
}

static void invalid_input_is_refused(void **state) {
    (void)state;
    DipTestScene scene;
    dip_screen_begin(&scene);
    dip_screen_add_cover(&scene, dip_screen_add_white(&scene), 1.0f, 1.0f);
    DipError err;
    DipReference *reference = dip_reference_create(&scene.def, &err);
    assert_non_null(reference);
    static const int bad_counts[] = {0, -1, 2, 8, 255, INT_MAX};
    for (int i = 0; i < 6; i++) {
        assert_false(dip_reference_converge(reference, &scene.pose, 64, 64, bad_counts[i], 0,
                                            &picture[0][0][0], &err));
        assert_int_equal(err.code, DIP_ERROR_RANGE);
    }
    DipQuality quality = dip_quality_default();
    assert_false(
        dip_reference_draw(reference, &quality, &scene.pose, 0, 64, &picture[0][0][0], &err));
    assert_int_equal(err.code, DIP_ERROR_RANGE);
    quality.step[DIP_SETTING_AA] = 9;
    assert_false(
        dip_reference_draw(reference, &quality, &scene.pose, 64, 64, &picture[0][0][0], &err));
    dip_reference_destroy(&reference);
    dip_reference_destroy(&reference); // destroying it again is harmless
    scene.objects[0].mesh = 1;
    assert_null(dip_reference_create(&scene.def, &err));
    assert_int_equal(err.code, DIP_ERROR_RANGE);
    scene.objects[0].mesh = 0;
    scene.meshes[0].vertex_count = 3;
    assert_null(dip_reference_create(&scene.def, NULL));
    dip_test_scene_free(&scene);
}

static void poses_from_which_nothing_can_be_drawn_are_refused(void **state) {
    (void)state;
    DipTestScene scene;
    dip_screen_begin(&scene);
    dip_screen_add_cover(&scene, dip_screen_add_white(&scene), 1.0f, 1.0f);
    DipReference *reference = dip_reference_create(&scene.def, NULL);
    assert_non_null(reference);
    const DipQuality quality = dip_quality_default();
    for (int i = 0; i < 4; i++) {
        DipPose pose = scene.pose;
        if (i == 0) {
            pose.position_world[1] = NAN;
        } else if (i == 1) {
            memset(pose.orientation, 0, sizeof pose.orientation);
        } else {
            pose.fov_y_deg = i == 2 ? 0.0 : 180.0;
        }
        DipError errors[3] = {{0}};
        assert_false(dip_reference_draw(reference, &quality, &pose, DIP_SCREEN, DIP_SCREEN,
                                        &picture[0][0][0], &errors[0]));
        assert_false(dip_reference_converge(reference, &pose, DIP_SCREEN, DIP_SCREEN, 1, 0,
                                            &picture[0][0][0], &errors[1]));
        assert_null(dip_convergence_create(reference, &pose, DIP_SCREEN, DIP_SCREEN, &errors[2]));
        for (int k = 0; k < 3; k++) {
            assert_int_equal(errors[k].code, DIP_ERROR_RANGE);
            assert_string_equal(errors[k].key, "pose");
        }
    }
    dip_reference_destroy(&reference);
    dip_test_scene_free(&scene);
}

// A reference for truths has neither mip levels nor compressed textures.
static void a_reference_for_truths_draws_no_settings(void **state) {
    (void)state;
    DipTestScene scene;
    DipError err = {0};
    DipQuality quality;
    dip_screen_begin(&scene);
    const int texture = dip_test_scene_add_texture(&scene, DIP_TEST_NOISE, 8, 8);
    dip_screen_add_cover(&scene, dip_test_scene_add_material(&scene, texture), 1.0f, 1.0f);
    DipReference *reference = dip_reference_create_for_truth(&scene.def, NULL, NULL);
    assert_non_null(reference);
    assert_true(dip_quality_parse("opt=standard", &quality, NULL));
    assert_false(dip_reference_draw(reference, &quality, &scene.pose, DIP_SCREEN, DIP_SCREEN,
                                    &picture[0][0][0], &err));
    assert_int_equal(err.code, DIP_ERROR_UNSUPPORTED);
    dip_reference_destroy(&reference);
    dip_test_scene_free(&scene);
}

// Both renderers accept textures of 1 to 8192 texels in each direction, and no others.
static void textures_have_the_same_limits_in_both_renderers(void **state) {
    (void)state;
    static const int sizes[] = {-1, 0, 1, 8192, 8193};
    static uint8_t texels[4 * 8193];
    for (int i = 0; i < 5; i++) {
        for (int high = 0; high < 2; high++) {
            DipTestScene scene;
            DipError err;
            dip_screen_begin(&scene);
            const int material = dip_screen_add_white(&scene);
            scene.materials[material].colour_texture =
                dip_test_scene_add_texture(&scene, DIP_TEST_CHECKER, 1, 1);
            dip_screen_add_cover(&scene, material, 1.0f, 1.0f);
            scene.textures[0].width = high ? 1 : sizes[i];
            scene.textures[0].height = high ? sizes[i] : 1;
            scene.textures[0].rgba8 = texels;
            DipReference *reference = dip_reference_create(&scene.def, &err);
            DipScene *fast = dip_scene_create(&scene.def, NULL, &err);
            assert_int_equal(reference != NULL, sizes[i] >= 1 && sizes[i] <= 8192);
            assert_int_equal(fast != NULL, sizes[i] >= 1 && sizes[i] <= 8192);
            dip_reference_destroy(&reference);
            dip_scene_destroy(&fast);
            dip_test_scene_free(&scene);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(textures_have_the_same_limits_in_both_renderers),
        cmocka_unit_test(interpolation_agrees_with_ray_casting),
        cmocka_unit_test(level_of_detail_on_the_ground_follows_the_jacobian),
        cmocka_unit_test(light_follows_the_normal),
        cmocka_unit_test(colour_is_base_times_texture_times_light_map),
        cmocka_unit_test(alpha_at_the_cutoff_keeps_the_sample),
        cmocka_unit_test(alpha_is_tested_at_centres_and_converges_to_area),
        cmocka_unit_test(invalid_input_is_refused),
        cmocka_unit_test(poses_from_which_nothing_can_be_drawn_are_refused),
        cmocka_unit_test(a_reference_for_truths_draws_no_settings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
