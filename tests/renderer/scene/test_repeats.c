// Tests large texture coordinates: whole numbers added to the coordinates of repeating textures do
// not change a picture.
#include "renderer/reference/reference.h"
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

static int count_differences(const uint32_t *a, const uint32_t *b) {
    int count = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        count += a[i] != b[i];
    }
    return count;
}

static void whole_numbers_added_to_repeating_coordinates_change_no_bit(void **state) {
    (void)state;
    static const float shifts[][2] = {
        {0.0f, 0.0f}, {4096.0f, 0.0f}, {-65536.0f, 4096.0f}, {1048576.0f, -1048576.0f}};
    static const char *const settings[] = {"aa=none", "aa=4,af=16",
                                           "aa=8,aaa=on,asd=2,af=4,aaf=on"};
    static uint32_t pictures[2][WIDTH * HEIGHT];
    int missed = 0;
    for (int kind = 0; kind < DIP_TEST_SCENE_COUNT; kind++) {
        for (size_t s = 0; s < sizeof settings / sizeof settings[0]; s++) {
            for (size_t i = 0; i < sizeof shifts / sizeof shifts[0]; i++) {
                DipTestScene scene;
                dip_test_scene_make(&scene, (DipTestSceneKind)kind);
                dip_test_scene_shift_uv(&scene, shifts[i]);
                stage_draw_scene(&scene, WIDTH, HEIGHT, settings[s], pictures[i > 0]);
                dip_test_scene_free(&scene);
                const int count = i ? count_differences(pictures[0], pictures[1]) : 0;
                if (count) {
                    printf("%s, %s: %d pixels differ with (%.0f, %.0f) added\n",
                           dip_test_scene_name((DipTestSceneKind)kind), settings[s], count,
                           (double)shifts[i][0], (double)shifts[i][1]);
                    missed++;
                }
            }
        }
    }
    assert_int_equal(missed, 0);
}

// --- coordinates that do not repeat ------------------------------------------------------------

// A texture of a black and a white texel, clamped along u, on a quad that fills the picture. Its u
// runs from -100 to 100, so the left half is black and the right half is white.
static void clamped_coordinates_are_not_reduced(void **state) {
    (void)state;
    DipTestScene scene;
    dip_test_scene_begin(&scene);
    const int texture = dip_test_scene_add_texture(&scene, DIP_TEST_CHECKER, 2, 1);
    memset(dip_test_scene_texels(&scene, texture), 0, 3);
    memset(dip_test_scene_texels(&scene, texture) + 4, 255, 3);
    scene.textures[texture].wrap_u = DIP_WRAP_CLAMP;
    const int material = dip_test_scene_add_material(&scene, texture);
    dip_test_scene_add_quad(&scene, material, (const float[]){-2, -2, -1}, (const float[]){4, 0, 0},
                            (const float[]){0, 4, 0}, 200, 200);
    for (int v = 0; v < 4; v++) {
        ((float *)scene.meshes[0].uv0)[2 * v] -= 100.0f;
    }
    static uint32_t pixels[WIDTH * HEIGHT];
    stage_draw_scene(&scene, WIDTH, HEIGHT, "aa=none", pixels);
    dip_test_scene_free(&scene);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const int x = i % WIDTH - WIDTH / 2;
        if (x < -8 || x >= 8) {
            assert_int_equal(pixels[i], x < 0 ? 0xff000000u : 0xffffffffu);
        }
    }
}

// The layers of a sky multiply its coordinates by 1 and by 1.7.
static void the_coordinates_of_a_sky_are_not_reduced(void **state) {
    (void)state;
    DipTestScene scene;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_sky);
    for (uint32_t i = 0; i < 2 * scene.meshes[0].vertex_count; i++) {
        ((float *)scene.meshes[0].uv0)[i] += 40.0f;
    }
    DipReference *reference = dip_reference_create(&scene.def, NULL);
    static double expected[WIDTH * HEIGHT * 3];
    static uint32_t pixels[WIDTH * HEIGHT];
    const DipQuality quality = dip_quality_default();
    assert_non_null(reference);
    assert_true(
        dip_reference_draw(reference, &quality, &scene.pose, WIDTH, HEIGHT, expected, NULL));
    stage_draw_scene(&scene, WIDTH, HEIGHT, "", pixels);
    const DipFrame frame = {
        .rgba8 = (uint8_t *)pixels, .stride_bytes = 4 * WIDTH, .width = WIDTH, .height = HEIGHT};
    const double rms_lin = dip_image_compare(expected, &frame, 1.0).rms_lin;
    printf("RMS %.4f\n", rms_lin);
    assert_true(rms_lin < 0.003);
    dip_reference_destroy(&reference);
    dip_test_scene_free(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_numbers_added_to_repeating_coordinates_change_no_bit),
        cmocka_unit_test(clamped_coordinates_are_not_reduced),
        cmocka_unit_test(the_coordinates_of_a_sky_are_not_reduced),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
