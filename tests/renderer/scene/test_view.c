// Tests the matrices of a camera at random points. The truth is where the point lies along the
// camera's axes, which rotate.h turns by another formula, and the sentences of view.h.
#include "renderer/scene/view/view.h"
#include "tests/renderer/scene/random_view.h"
#include "tests/renderer/scene/rotate.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { CASES = 2000 };

static double random_within(Random *random, double reach) {
    return random_real(random, -reach, reach);
}

static void random_point(Random *random, double reach, double point[3]) {
    for (int i = 0; i < 3; i++) {
        point[i] = random_within(random, reach);
    }
}

static void transform(const double m[16], const double point[3], double clip[4]) {
    for (int r = 0; r < 4; r++) {
        clip[r] = m[4 * r + 3];
        for (int k = 0; k < 3; k++) {
            clip[r] += m[4 * r + k] * point[k];
        }
    }
}

static void assert_near(const double *a, const double *b, int count, double tolerance) {
    for (int i = 0; i < count; i++) {
        if (!(fabs(a[i] - b[i]) <= tolerance * (1.0 + fabs(b[i])))) {
            fail_msg("number %d is %.17g, expected %.17g", i, a[i], b[i]);
        }
    }
}

static DipView shifted_view(Random *random) {
    DipView view = random_view(random, 1.5);
    const double shift[2] = {random_within(random, 0.5), random_within(random, 0.5)};
    dip_view_shift(&view, shift);
    return view;
}

// The orientation may have any length: its squares may even be too large or too small for doubles.
// Some of its numbers may be 0, but not all.
static void points_have_the_coordinates_of_the_cameras_axes(void **state) {
    (void)state;
    static const double lengths[] = {1.0, 1e-300, 1e300, 0.3, 5e-310};
    static const double units[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    Random random = {5};
    for (int i = 0; i < CASES; i++) {
        const double length = lengths[i % 5];
        DipPose pose = {.fov_y_deg = random_real(&random, 1.0, 170.0)};
        double q[4], norm = 0.0, along[3], point[3], clip[4];
        random_point(&random, 9.0, pose.position_world);
        random_point(&random, 5.0, along);
        for (int k = 0; k < 4; k++) {
            q[k] = i / 5 % 15 >> k & 1 ? 0.0 : random_within(&random, 1.0);
            norm += q[k] * q[k];
        }
        for (int k = 0; k < 4; k++) {
            q[k] /= sqrt(norm);
            pose.orientation[k] = q[k] * length;
        }
        memcpy(point, pose.position_world, sizeof point);
        for (int axis = 0; axis < 3; axis++) {
            double turned[3];
            rotate(q, units[axis], turned);
            for (int k = 0; k < 3; k++) {
                point[k] += along[axis] * turned[k];
            }
        }
        const double near_m = random_real(&random, 0.01, 3.0);
        const double aspect = random_real(&random, 0.5, 2.0);
        const double half = tan(pose.fov_y_deg * acos(-1.0) / 360.0);
        const DipView view = dip_view_make(&pose, near_m, aspect);
        const double expected[4] = {along[0] / (half * aspect), along[1] / half, near_m, -along[2]};
        transform(view.world_to_clip, point, clip);
        assert_near(clip, expected, 4, length < 1e-308 ? 1e-9 : 1e-11);
        assert_true(view.near_m == near_m && view.shift[0] == 0.0 && view.shift[1] == 0.0);
    }
}

// A shift of 2 is the whole picture: clip x and y grow by the shift times w.
static void a_shift_moves_what_is_seen_by_parts_of_the_picture(void **state) {
    (void)state;
    Random random = {6};
    for (int i = 0; i < CASES; i++) {
        const double shift[2] = {random_within(&random, 2.0), random_within(&random, 2.0)};
        DipView view = random_view(&random, 1.5);
        double point[3], before[4], after[4];
        random_point(&random, 20.0, point);
        transform(view.world_to_clip, point, before);
        dip_view_shift(&view, (const double[2]){0.25, 0.5}); // is replaced by the next one
        dip_view_shift(&view, shift);
        transform(view.world_to_clip, point, after);
        before[0] += shift[0] * before[3];
        before[1] += shift[1] * before[3];
        assert_near(after, before, 4, 1e-11);
    }
}

static void planes_keep_their_values_in_clip_space(void **state) {
    (void)state;
    Random random = {7};
    for (int i = 0; i < CASES; i++) {
        const DipView view = i % 2 ? shifted_view(&random) : random_view(&random, 1.5);
        double point[3], plane[4], in_clip[4], clip[4];
        random_point(&random, 20.0, point);
        random_point(&random, 1.0, plane);
        plane[3] = random_within(&random, 30.0);
        dip_view_plane(&view, plane, in_clip);
        transform(view.world_to_clip, point, clip);
        double value = 0.0;
        for (int k = 0; k < 4; k++) {
            value += in_clip[k] * clip[k];
        }
        const double expected =
            plane[0] * point[0] + plane[1] * point[1] + plane[2] * point[2] + plane[3];
        assert_near(&value, &expected, 1, 1e-9);
    }
}

static void the_mirrored_view_shows_points_where_their_mirror_images_are(void **state) {
    (void)state;
    Random random = {8};
    for (int i = 0; i < CASES; i++) {
        const DipView view = i % 2 ? shifted_view(&random) : random_view(&random, 1.5);
        const double level = random_within(&random, 10.0);
        const DipView mirrored = dip_view_mirror(&view, level);
        double point[3], in_mirror[4], of_image[4];
        random_point(&random, 20.0, point);
        transform(mirrored.world_to_clip, point, in_mirror);
        point[1] = 2.0 * level - point[1];
        transform(view.world_to_clip, point, of_image);
        assert_near(in_mirror, of_image, 4, 1e-11);
    }
}

// The depth of a point is the distance of the near plane over w.
static void motion_takes_places_to_those_of_the_frame_before(void **state) {
    (void)state;
    Random random = {9};
    for (int i = 0; i < CASES; i++) {
        DipView now = random_view(&random, 1.5);
        const DipView before = random_view(&random, 1.5);
        double point[3], clip[4], expected[4], found[3];
        float to_before[12];
        random_point(&random, 20.0, point);
        transform(now.world_to_clip, point, clip);
        transform(before.world_to_clip, point, expected);
        if (clip[3] < 1.0 || expected[3] < 1.0) {
            continue;
        }
        dip_view_shift(&now, (const double[2]){0.25, 0.5}); // does not matter
        dip_view_motion(&now, &before, to_before);
        const double place[4] = {clip[0] / clip[3], clip[1] / clip[3], 1.0, clip[2] / clip[3]};
        for (int r = 0; r < 3; r++) {
            found[r] = 0.0;
            for (int k = 0; k < 4; k++) {
                found[r] += (double)to_before[4 * r + k] * place[k];
            }
        }
        // The rows are those of clip x, y and w, divided by the w of now.
        const double scaled[3] = {expected[0] / clip[3], expected[1] / clip[3],
                                  expected[3] / clip[3]};
        assert_near(found, scaled, 3, 1e-4);
    }
}

// --- objects -------------------------------------------------------------------------------------

// A matrix whose inverse is known: its rows are an eighth of a cube's signed axes.
static const float turned[12] = {0, 0, 8, 100, -8, 0, 0, -200, 0, 8, 0, 300};
static const double turned_back[9] = {0, -0.125, 0, 0, 0, 0.125, 0.125, 0, 0};

static void an_objects_origin_is_the_multiple_nearest_to_the_eye(void **state) {
    (void)state;
    Random random = {10};
    for (int i = 0; i < CASES; i++) {
        double in_object[3], eye[3];
        float origin[3];
        random_point(&random, i % 2 ? 3000.0 : 1e7, in_object);
        for (int k = 0; k < 3; k++) {
            eye[k] = (double)turned[4 * k + 3];
            for (int c = 0; c < 3; c++) {
                eye[k] += (double)turned[4 * k + c] * in_object[c];
            }
        }
        dip_view_object_origin(eye, turned, turned_back, origin);
        for (int c = 0; c < 3; c++) {
            assert_true(fmod((double)origin[c], 1024.0) == 0.0);
            assert_true(fabs((double)origin[c] - in_object[c]) <= 512.0 + 1e-6);
        }
    }
}

static void an_objects_origin_is_0_where_there_is_none(void **state) {
    (void)state;
    static const double zero[9] = {0.0};
    static const double far[][3] = {{1e30, -1e30, 1e30}, {1e300, 1e300, -1e300}};
    float origin[3];
    for (int i = 0; i < 2; i++) {
        dip_view_object_origin(far[i], turned, turned_back, origin);
        assert_true(origin[0] == 0.0f && origin[1] == 0.0f && origin[2] == 0.0f);
        dip_view_object_origin(far[i], turned, zero, origin);
        assert_true(origin[0] == 0.0f && origin[1] == 0.0f && origin[2] == 0.0f);
    }
}

static void an_objects_matrix_is_the_product_from_its_origin_on(void **state) {
    (void)state;
    Random random = {11};
    for (int i = 0; i < CASES; i++) {
        const DipView view = i % 2 ? shifted_view(&random) : random_view(&random, 1.5);
        float matrix[12], origin[3];
        double point[3], world[3], product[16], clip[4], expected[4];
        for (int k = 0; k < 12; k++) {
            matrix[k] = (float)random_within(&random, 4.0);
        }
        random_point(&random, 10.0, point);
        for (int k = 0; k < 3; k++) {
            origin[k] = (float)random_within(&random, 8.0);
        }
        for (int r = 0; r < 3; r++) {
            world[r] = (double)matrix[4 * r + 3];
            for (int c = 0; c < 3; c++) {
                world[r] += (double)matrix[4 * r + c] * (point[c] + (double)origin[c]);
            }
        }
        dip_view_object_to_clip(&view, matrix, origin, product);
        transform(product, point, clip);
        transform(view.world_to_clip, world, expected);
        assert_near(clip, expected, 4, 1e-10);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_have_the_coordinates_of_the_cameras_axes),
        cmocka_unit_test(a_shift_moves_what_is_seen_by_parts_of_the_picture),
        cmocka_unit_test(planes_keep_their_values_in_clip_space),
        cmocka_unit_test(the_mirrored_view_shows_points_where_their_mirror_images_are),
        cmocka_unit_test(motion_takes_places_to_those_of_the_frame_before),
        cmocka_unit_test(an_objects_origin_is_the_multiple_nearest_to_the_eye),
        cmocka_unit_test(an_objects_origin_is_0_where_there_is_none),
        cmocka_unit_test(an_objects_matrix_is_the_product_from_its_origin_on),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
