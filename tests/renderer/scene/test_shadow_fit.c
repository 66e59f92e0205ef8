// Tests that the shadow map holds all that a camera sees, for random cameras before a box. What a
// camera sees is found by trying points of the box, one by one.
#include "renderer/scene/draw/shadow_fit.h"

#include "renderer/catalogue/random.h"
#include "renderer/catalogue/scenes.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/lights.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "rotate.h"

enum { CAMERAS = 4000, MAP = 1024, SIZE = 64, POINTS = 24 };

static const double half_size[3] = {1.0, 0.7, 1.3};

// Sets `point` to a point of the box's surface: point i of POINTS along, and j across, a face.
static void point_of(int face, int i, int j, double point[3]) {
    const int axis = face / 2;
    const double at[2] = {2.0 * i / (POINTS - 1) - 1.0, 2.0 * j / (POINTS - 1) - 1.0};
    point[axis] = face % 2 ? half_size[axis] : -half_size[axis];
    point[(axis + 1) % 3] = at[0] * half_size[(axis + 1) % 3];
    point[(axis + 2) % 3] = at[1] * half_size[(axis + 2) % 3];
}

// Makes a scene of a box, with faces of two triangles each, around the origin. The sun lights it.
static void make_box(DipTestScene *scene) {
    dip_test_scene_begin(scene);
    scene->lighting = (DipLightingDef){.lights = scene->lights, .light_count = 1};
    scene->def.lighting = &scene->lighting;
    scene->lights[0] = (DipLightDef){.kind = DIP_LIGHT_DIRECTIONAL,
                                     .colour_lin = {1.0f, 1.0f, 1.0f},
                                     .direction_world = {1.1f, -1.5f, -0.8f}};
    const int paint = dip_test_scene_add_material(scene, DIP_NO_TEXTURE);
    scene->materials[paint].lit = true;
    const DipTestMesh mesh = dip_test_scene_add_mesh(scene, 24, 36, DIP_TEST_NORMALS, paint);
    for (int v = 0; v < 24; v++) {
        const int face = v / 4, corner = v % 4;
        double point[3];
        point_of(face, corner == 1 || corner == 2 ? POINTS - 1 : 0, corner >= 2 ? POINTS - 1 : 0,
                 point);
        for (int i = 0; i < 3; i++) {
            mesh.positions[3 * v + i] = (float)point[i];
        }
        mesh.normals[3 * v + face / 2] = face % 2 ? 1.0f : -1.0f;
    }
    for (int i = 0; i < 36; i++) {
        static const uint32_t quads[2][6] = {{0, 2, 1, 0, 3, 2}, {0, 1, 2, 0, 2, 3}};
        mesh.indices[i] = quads[i / 6 % 2][i % 6] + 4 * (uint32_t)(i / 6);
    }
}

// Returns a camera that looks at a point of the box, from any side and held at any angle.
static DipPose random_pose(Random *random) {
    DipPose pose = {.fov_y_deg = random_real(random, 5.0, 60.0)};
    double length2 = 0.0, at[3], ahead[3];
    while (length2 < 0.1 || length2 > 1.0) {
        length2 = 0.0;
        for (int i = 0; i < 4; i++) {
            pose.orientation[i] = random_real(random, -1.0, 1.0);
            length2 += pose.orientation[i] * pose.orientation[i];
        }
    }
    for (int i = 0; i < 4; i++) {
        pose.orientation[i] /= sqrt(length2);
    }
    point_of(random_int(random, 0, 5), random_int(random, 0, POINTS - 1),
             random_int(random, 0, POINTS - 1), at);
    rotate(pose.orientation, (const double[]){0.0, 0.0, -1.0}, ahead);
    const double distance = random_real(random, 0.5, 6.0);
    for (int i = 0; i < 3; i++) {
        pose.position_world[i] = at[i] - distance * ahead[i];
    }
    return pose;
}

// Returns whether a square picture of a pose shows a point, or would if nothing stood before it.
static bool shows(const DipPose *pose, double near_m, const double point[3]) {
    const double *q = pose->orientation;
    const double back[4] = {-q[0], -q[1], -q[2], q[3]};
    double from[3], seen[3];
    for (int i = 0; i < 3; i++) {
        from[i] = point[i] - pose->position_world[i];
    }
    rotate(back, from, seen);
    const double wide = tan(pose->fov_y_deg * acos(-1.0) / 360.0) * -seen[2];
    return -seen[2] > near_m && fabs(seen[0]) <= wide && fabs(seen[1]) <= wide;
}

static void the_map_holds_all_that_is_in_view(void **state) {
    (void)state;
    static DipTestScene made;
    DipError err = {0};
    Random random = {2026};
    int64_t checked = 0;
    double least = INFINITY, greatest = 0.0;
    make_box(&made);
    DipScene *scene = dip_scene_create(&made.def, NULL, &err);
    assert_non_null(scene);
    for (int c = 0; c < CAMERAS; c++) {
        const DipPose pose = random_pose(&random);
        const DipView view = dip_view_make(&pose, (double)made.def.near_m, 1.0);
        const DipPass pass = {.target = {.width = SIZE, .height = SIZE}};
        const DipCullPlanes planes = dip_cull_pass_planes(&pass, view.world_to_clip);
        const DipShadowFit fit = dip_shadow_fit(scene, &(DipShadowView){&view, &planes}, 1, MAP);
        least = fmin(least, fit.texel[0]);
        greatest = fmax(greatest, fit.texel[0]);
        for (int i = 0; i < 6 * POINTS * POINTS; i++) {
            double point[3];
            point_of(i / (POINTS * POINTS), i / POINTS % POINTS, i % POINTS, point);
            if (!shows(&pose, (double)made.def.near_m, point)) {
                continue;
            }
            checked++;
            for (int k = 0; k < 2; k++) {
                const double across = fit.axis[k][0] * point[0] + fit.axis[k][1] * point[1] +
                                      fit.axis[k][2] * point[2];
                const double texel = (across - fit.low[k]) / fit.texel[k];
                assert_true(texel >= 2.0 && texel <= MAP - 2.0); // A read reaches that far.
            }
        }
    }
    print_message("%lld points of %d cameras\n", (long long)checked, CAMERAS);
    assert_true(checked > 1000 * CAMERAS / 10);
    assert_true(least < 0.1 * greatest); // The map shrinks to what is in view.
    dip_scene_destroy(&scene);
    dip_test_scene_free(&made);
}

// A camera that looks away from the box sees no receiver.
static void the_map_holds_the_whole_scene_if_nothing_is_in_view(void **state) {
    (void)state;
    static DipTestScene made;
    DipError err = {0};
    make_box(&made);
    DipScene *scene = dip_scene_create(&made.def, NULL, &err);
    assert_non_null(scene);
    const DipPose pose = {
        .position_world = {0.0, 0.0, -5.0}, .orientation = {0.0, 0.0, 0.0, 1.0}, .fov_y_deg = 40.0};
    const DipView view = dip_view_make(&pose, (double)made.def.near_m, 1.0);
    const DipPass pass = {.target = {.width = SIZE, .height = SIZE}};
    const DipCullPlanes planes = dip_cull_pass_planes(&pass, view.world_to_clip);
    const DipShadowFit fit = dip_shadow_fit(scene, &(DipShadowView){&view, &planes}, 1, MAP);
    for (int corner = 0; corner < 8; corner++) {
        for (int k = 0; k < 3; k++) {
            double along = 0.0;
            for (int i = 0; i < 3; i++) {
                along += fit.axis[k][i] * (corner >> i & 1 ? half_size[i] : -half_size[i]);
            }
            const double at = along - fit.low[k];
            if (k < 2) {
                assert_true(at >= 2.0 * fit.texel[k] && at <= (MAP - 2.0) * fit.texel[k]);
            } else {
                assert_true(at > 0.0 && at < fit.range);
            }
        }
    }
    // The longest diagonal of the box is less than 4 m, and the map is not much larger.
    for (int k = 0; k < 2; k++) {
        assert_true(fit.texel[k] > 0.0 && fit.texel[k] * MAP < 2.0 * 4.0);
    }
    dip_scene_destroy(&scene);
    dip_test_scene_free(&made);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_map_holds_all_that_is_in_view),
        cmocka_unit_test(the_map_holds_the_whole_scene_if_nothing_is_in_view)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
