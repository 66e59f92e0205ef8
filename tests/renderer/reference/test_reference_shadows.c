// Tests the edges of exact shadows: surfaces that share an edge let no light through it, in
// whichever order and direction their corners come.
#include "renderer/reference/reference.h"

#include "renderer/catalogue/scenes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 9, HEIGHT = 6, MIDDLE = WIDTH / 2 };

static double picture[HEIGHT][WIDTH][3];

// A wall in view, lit over the camera's shoulder through a roof that the camera does not see. Both
// are two triangles that meet where x = 0, as the rays from the picture's middle column do, without
// rounding. `order` has the corners of the roof's left triangle; the right one turns the same way.
static void make_room(DipTestScene *scene, const uint32_t order[3]) {
    static const float wall_corners[4][3] = {{0, -8, -4}, {0, 8, -4}, {-8, 0, -4}, {8, 0, -4}};
    static const float roof_corners[4][3] = {{0, 3, -3.75f}, {0, 3, 4}, {-5, 3, 0}, {5, 3, 0}};
    static const uint32_t other_side[3] = {1, 0, 3};
    static const uint32_t wall_indices[6] = {0, 1, 2, 0, 3, 1};
    dip_test_scene_begin(scene);
    scene->lighting =
        (DipLightingDef){.lights = scene->lights, .light_count = 1, .shading = DIP_SHADING_PHONG};
    scene->lights[0] = (DipLightDef){.kind = DIP_LIGHT_DIRECTIONAL,
                                     .colour_lin = {1.0f, 1.0f, 1.0f},
                                     .direction_world = {0.0f, -1.0f, -1.0f}};
    scene->def.lighting = &scene->lighting;
    const int paint = dip_test_scene_add_material(scene, DIP_NO_TEXTURE);
    scene->materials[paint].lit = true;
    const DipTestMesh wall = dip_test_scene_add_mesh(scene, 4, 6, DIP_TEST_NORMALS, paint);
    memcpy(wall.positions, wall_corners, sizeof wall_corners);
    memcpy(wall.indices, wall_indices, sizeof wall_indices);
    const DipTestMesh roof = dip_test_scene_add_mesh(scene, 4, 6, DIP_TEST_NORMALS, paint);
    memcpy(roof.positions, roof_corners, sizeof roof_corners);
    for (int v = 0; v < 4; v++) {
        wall.normals[3 * v + 2] = 1.0f;
        roof.normals[3 * v + 1] = 1.0f;
    }
    for (int i = 0; i < 3; i++) {
        roof.indices[i] = order[i];
        roof.indices[3 + i] = other_side[order[i]];
    }
}

static void draw(const DipTestScene *scene, const char *settings) {
    DipError err = {0};
    DipQuality quality;
    assert_true(dip_quality_parse(settings, &quality, &err));
    DipReference *reference = dip_reference_create(&scene->def, &err);
    assert_non_null(reference);
    assert_true(dip_reference_draw(reference, &quality, &scene->pose, WIDTH, HEIGHT,
                                   &picture[0][0][0], &err));
    dip_reference_destroy(&reference);
}

static void no_light_passes_a_shared_edge(void **state) {
    (void)state;
    static const uint32_t orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                          {1, 0, 2}, {0, 2, 1}, {2, 1, 0}};
    for (int i = 0; i < 6; i++) {
        DipTestScene scene;
        make_room(&scene, orders[i]);
        draw(&scene, "shadows=off");
        for (int y = 0; y < HEIGHT; y++) {
            assert_true(picture[y][MIDDLE][0] > 0.1);
        }
        draw(&scene, "shadows=512");
        for (int y = 0; y < HEIGHT; y++) {
            if (picture[y][MIDDLE][0] > 0.0) {
                fail_msg("order %d lets light through to row %d", i, y);
            }
        }
        dip_test_scene_free(&scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_light_passes_a_shared_edge)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
