// Tests the converged picture, which the reference draws with many jittered samples per pixel. Its
// mean must be right, and more samples must improve it.
#include "renderer/reference/convergence.h"
#include "tests/renderer/pipeline/screen.h"
#include "tests/renderer/scene/image.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "tests/renderer/pipeline/near.h"
#include "tests/support/srgb.h"

static DipScreenPicture picture;
static DipScreenPicture other;

enum { VALUES = DIP_SCREEN * DIP_SCREEN * 3 };

// A texture of 8x8 texels repeats once per pixel. Over a period, all texels have equal bilinear
// weight, so the mean over a pixel is the mean of the texels, in linear light.
static void textures_converge_to_their_mean(void **state) {
    (void)state;
    DipTestScene scene;
    dip_screen_begin(&scene);
    const int texture = dip_test_scene_add_texture(&scene, DIP_TEST_NOISE, 8, 8);
    dip_screen_add_cover(&scene, dip_test_scene_add_material(&scene, texture), 64.0f, 64.0f);
    dip_screen_converge(&scene, 64, 5, picture);
    for (int c = 0; c < 3; c++) {
        double expected = 0.0;
        for (int i = 0; i < 64; i++) {
            expected += srgb_light(scene.textures[texture].rgba8[4 * i + c]) / 64.0;
        }
        double mean = 0.0;
        for (int i = 0; i < DIP_SCREEN * DIP_SCREEN; i++) {
            const double value = picture[i / DIP_SCREEN][i % DIP_SCREEN][c];
            assert_near(value, expected, 0.12);
            mean += value / (DIP_SCREEN * DIP_SCREEN);
        }
        // `mean` has 4096 pixels of 64 jittered samples. The standard deviation of a sample is
        // below 0.3. The tolerance is four standard deviations of the mean.
        assert_near(mean, expected, 4.0 * 0.3 / sqrt(4096.0 * 64.0));
    }
    dip_test_scene_free(&scene);
}

// On a ramp that rises by 4/255 per pixel, the mean over a pixel is the value at the pixel's
// centre. Each jittered sample lies somewhere in its cell of the jitter grid.
static void a_ramp_converges_to_its_value_at_pixel_centres(void **state) {
    (void)state;
    DipTestScene scene;
    dip_screen_begin(&scene);
    const int texture = dip_test_scene_add_texture(&scene, DIP_TEST_NOISE, 256, 1);
    uint8_t *texels = dip_test_scene_texels(&scene, texture);
    for (int i = 0; i < 256; i++) {
        memset(texels + 4 * i, i, 4);
    }
    scene.textures[texture].encoding = DIP_ENCODING_LINEAR;
    scene.textures[texture].wrap_u = DIP_WRAP_CLAMP;
    dip_screen_add_cover(&scene, dip_test_scene_add_material(&scene, texture), 1.0f, 1.0f);
    dip_screen_converge(&scene, 64, 2, picture);
    double error = 0.0;
    for (int y = 0; y < DIP_SCREEN; y++) {
        for (int x = 1; x < DIP_SCREEN - 1; x++) {
            const double expected = (4.0 * (x + 0.5) - 0.5) / 255.0;
            assert_near(picture[y][x][0], expected, 4.0 / 255.0 / 8.0);
            error += picture[y][x][0] - expected;
        }
    }
    // The standard deviation of the mean is the standard deviation of a sample (a cell's width
    // divided by sqrt 12) divided by the square root of the number of all samples.
    assert_near(error / (64 * 62), 0.0, 4.0 * (4.0 / 255.0 / 8.0 / sqrt(12.0 * 64 * 62 * 64)));
    dip_test_scene_free(&scene);
}

// Over one period, the texture's value is u times v. Its mean is 1/4 if the jitter in u and in v is
// independent; it would be 1/3 if both were equal. Each pixel has a single sample.
static void jitter_is_independent_in_x_and_y(void **state) {
    (void)state;
    DipTestScene scene;
    dip_screen_begin(&scene);
    const int texture = dip_test_scene_add_texture(&scene, DIP_TEST_NOISE, 16, 16);
    uint8_t *texels = dip_test_scene_texels(&scene, texture);
    for (int i = 0; i < 256; i++) {
        memset(texels + 4 * i, (int)lround((i % 16 + 0.5) * (i / 16 + 0.5) * 255.0 / 256.0), 4);
    }
    scene.textures[texture].encoding = DIP_ENCODING_LINEAR;
    dip_screen_add_cover(&scene, dip_test_scene_add_material(&scene, texture), 64.0f, 64.0f);
    for (uint32_t seed = 0; seed < 8; seed++) {
        dip_screen_converge(&scene, 1, seed, picture);
        double mean = 0.0;
        for (int i = 0; i < DIP_SCREEN * DIP_SCREEN; i++) {
            mean += picture[i / DIP_SCREEN][i % DIP_SCREEN][0] / (DIP_SCREEN * DIP_SCREEN);
        }
        assert_near(mean, 0.25, 4.0 * 0.22 / 64.0); // the standard deviation of u v is 0.22
    }
    dip_test_scene_free(&scene);
}

static double rms_of_two_seeds(const DipTestScene *scene, int sample_count) {
    dip_screen_converge(scene, sample_count, 1, picture);
    dip_screen_converge(scene, sample_count, 2, other);
    return dip_image_rms(&picture[0][0][0], &other[0][0][0], VALUES);
}

// If the number of samples is four times as great, the error is 4^(3/4) times smaller at edges.
// Where the picture is smooth within a cell of the jitter grid, it is 4 times smaller. The scene
// has both kinds of pixels.
static void pictures_of_two_seeds_differ_less_with_more_samples(void **state) {
    (void)state;
    DipTestScene scene;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_soup);
    const double coarse = rms_of_two_seeds(&scene, 16);
    const double fine = rms_of_two_seeds(&scene, 64);
    const double finest = rms_of_two_seeds(&scene, 256);
    assert_true(coarse > 0.01 && coarse < 0.1);
    assert_true(coarse / fine > 2.2 && coarse / fine < 4.0);
    assert_true(fine / finest > 2.2 && fine / finest < 4.0);
    dip_test_scene_free(&scene);
}

static void the_same_seed_gives_the_same_picture(void **state) {
    (void)state;
    DipTestScene scene;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_soup);
    dip_screen_converge(&scene, 4, 77, picture);
    dip_screen_converge(&scene, 4, 77, other);
    assert_memory_equal(picture, other, sizeof picture);
    dip_test_scene_free(&scene);
}

// More samples must bring the drawn picture closer to the converged one.
static void antialiasing_approaches_the_converged_picture(void **state) {
    (void)state;
    static const char *const settings[] = {"aa=none", "aa=2", "aa=4", "aa=6", "aa=8"};
    DipTestScene scene;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_soup);
    dip_screen_converge(&scene, 256, 3, picture);
    double last = 1.0;
    for (int i = 0; i < 5; i++) {
        dip_screen_draw(&scene, settings[i], other);
        const double rms = dip_image_rms(&picture[0][0][0], &other[0][0][0], VALUES);
        assert_true(rms < last);
        last = rms;
    }
    dip_test_scene_free(&scene);
}

static uint8_t classes[DIP_SCREEN * DIP_SCREEN];

// Converges a picture and the classes of its pixels (such as edges) tile by tile, from the last
// tile to the first. The arrays' rows have no padding.
static void converge_tiles(const DipTestScene *scene, int width, int height, int sample_count,
                           DipScreenPicture rgb_lin) {
    DipError err = {0};
    DipReference *reference = dip_reference_create(&scene->def, &err);
    dip_reference_set_reflection(reference, &scene->reflection);
    DipConvergence *convergence =
        dip_convergence_create(reference, &scene->pose, width, height, &err);
    assert_non_null(convergence);
    memset(rgb_lin, 0, sizeof(DipScreenPicture));
    for (int tile = dip_convergence_tile_count(convergence) - 1; tile >= 0; tile--) {
        assert_true(dip_convergence_add_tile(convergence, tile, sample_count, 6, 1.0,
                                             &rgb_lin[0][0][0], classes, &err));
    }
    assert_false(dip_convergence_add_tile(convergence, 0, sample_count + 1, 6, 1.0,
                                          &rgb_lin[0][0][0], NULL, &err));
    assert_int_equal(err.code, DIP_ERROR_RANGE);
    const int outside[] = {-1, dip_convergence_tile_count(convergence)};
    for (int i = 0; i < 2; i++) {
        assert_false(dip_convergence_add_tile(convergence, outside[i], sample_count, 6, 1.0,
                                              &rgb_lin[0][0][0], NULL, &err));
        assert_int_equal(err.code, DIP_ERROR_RANGE);
        assert_string_equal(err.key, "tile");
    }
    dip_convergence_destroy(&convergence);
    dip_reference_destroy(&reference);
}

static void tiles_give_the_same_picture_as_the_whole(void **state) {
    (void)state;
    for (int kind = 0; kind < DIP_TEST_SCENE_COUNT; kind++) {
        DipTestScene scene;
        DipError err = {0};
        dip_test_scene_make(&scene, (DipTestSceneKind)kind);
        DipReference *reference = dip_reference_create(&scene.def, &err);
        dip_reference_set_reflection(reference, &scene.reflection);
        memset(picture, 0, sizeof picture);
        assert_true(
            dip_reference_converge(reference, &scene.pose, 61, 45, 9, 6, &picture[0][0][0], &err));
        dip_reference_destroy(&reference);
        converge_tiles(&scene, 61, 45, 9, other);
        assert_memory_equal(picture, other, sizeof picture);
        dip_test_scene_free(&scene);
    }
}

static int count_class(DipSeen seen) {
    int count = 0;
    for (int i = 0; i < DIP_SCREEN * DIP_SCREEN; i++) {
        count += classes[i] == seen;
    }
    return count;
}

// Makes a textured square of 32x32 pixels, at (10.5, 8), in front of a white square of 40x40 pixels
// at twice the distance. There is nothing behind them.
static void make_squares(DipTestScene *scene, DipSurface surface) {
    dip_screen_begin(scene);
    const int texture = dip_test_scene_add_texture(scene, DIP_TEST_NOISE, 8, 8);
    const DipScreenPoint far[4] = {{4, 4, 2}, {4, 44, 2}, {44, 44, 2}, {44, 4, 2}};
    const DipScreenPoint near[4] = {{10.5, 8, 1}, {10.5, 40, 1}, {42.5, 40, 1}, {42.5, 8, 1}};
    dip_screen_add_polygon(scene, dip_screen_add_white(scene), far, 4, 0);
    const int material = dip_test_scene_add_material(scene, texture);
    scene->materials[material].surface = surface;
    scene->materials[material].double_sided = true;
    scene->materials[material].alpha_cutoff = 0.5f;
    const DipTestMesh mesh = dip_screen_add_polygon(scene, material, near, 4, DIP_TEST_UV0);
    for (int i = 0; i < 8; i++) {
        mesh.uv0[i] = (float)(i / 4);
    }
}

static void pixels_are_classified_by_what_is_visible(void **state) {
    (void)state;
    DipTestScene scene;
    make_squares(&scene, DIP_SURFACE_OPAQUE);
    converge_tiles(&scene, DIP_SCREEN, DIP_SCREEN, 16, picture);
    // Only the upright sides of the near square cut pixels. The edge between the square's two
    // triangles does not count.
    assert_int_equal(count_class(DIP_SEEN_EDGE), 2 * 32);
    assert_int_equal(count_class(DIP_SEEN_TEXTURED), 31 * 32);
    assert_int_equal(count_class(DIP_SEEN_PLAIN), DIP_SCREEN * DIP_SCREEN - 33 * 32);
    dip_test_scene_free(&scene);

    make_squares(&scene, DIP_SURFACE_WATER);
    converge_tiles(&scene, DIP_SCREEN, DIP_SCREEN, 16, picture);
    assert_int_equal(count_class(DIP_SEEN_WATER), 33 * 32);
    dip_test_scene_free(&scene);

    // All pixels of the alpha-clipped square count, even where alpha removes the square. Half of
    // its texels are transparent.
    make_squares(&scene, DIP_SURFACE_CLIPPED);
    uint8_t *texels = dip_test_scene_texels(&scene, 0);
    for (int i = 0; i < 32; i++) {
        texels[4 * i + 3] = 0;
    }
    converge_tiles(&scene, DIP_SCREEN, DIP_SCREEN, 16, picture);
    assert_int_equal(count_class(DIP_SEEN_CLIPPED), 33 * 32);
    assert_int_equal(count_class(DIP_SEEN_EDGE), 0);
    dip_test_scene_free(&scene);
}

// A corner between two walls of one material is not an edge. A step in depth is an edge.
static void corners_of_one_surface_are_not_classified_as_edges(void **state) {
    (void)state;
    for (int step = 0; step < 2; step++) {
        DipTestScene scene;
        dip_screen_begin(&scene);
        const int white = dip_screen_add_white(&scene);
        const double at = step ? 0.9 : 1.0;
        const DipScreenPoint left[4] = {{-8, -8, 2}, {-8, 72, 2}, {30.25, 72, 1}, {30.25, -8, 1}};
        const DipScreenPoint right[4] = {
            {30.25, -8, at}, {30.25, 72, at}, {72, 72, 2}, {72, -8, 2}};
        dip_screen_add_polygon(&scene, white, left, 4, 0);
        dip_screen_add_polygon(&scene, white, right, 4, 0);
        converge_tiles(&scene, DIP_SCREEN, DIP_SCREEN, 16, picture);
        assert_int_equal(count_class(DIP_SEEN_EDGE), step ? DIP_SCREEN : 0);
        dip_test_scene_free(&scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(textures_converge_to_their_mean),
        cmocka_unit_test(a_ramp_converges_to_its_value_at_pixel_centres),
        cmocka_unit_test(jitter_is_independent_in_x_and_y),
        cmocka_unit_test(pictures_of_two_seeds_differ_less_with_more_samples),
        cmocka_unit_test(the_same_seed_gives_the_same_picture),
        cmocka_unit_test(antialiasing_approaches_the_converged_picture),
        cmocka_unit_test(tiles_give_the_same_picture_as_the_whole),
        cmocka_unit_test(pixels_are_classified_by_what_is_visible),
        cmocka_unit_test(corners_of_one_surface_are_not_classified_as_edges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
