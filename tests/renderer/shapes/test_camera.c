// Tests matrices against formulas in long double.
#include "renderer/shapes/camera.h"
#include "renderer/catalogue/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "tests/renderer/pipeline/near.h"

static const long double pi = 3.14159265358979323846264338L;

static void random_vector(Random *random, double reach, double v[3]) {
    for (int i = 0; i < 3; i++) {
        v[i] = random_real(random, -reach, reach);
    }
}

static DipMatrix random_matrix(Random *random) {
    DipMatrix matrix;
    for (int i = 0; i < 16; i++) {
        matrix.m[i] = random_real(random, -2.0, 2.0);
    }
    return matrix;
}

static void apply_point(const DipMatrix *matrix, const double point[3], double out[4]) {
    const double homogeneous[4] = {point[0], point[1], point[2], 1.0};
    dip_matrix_apply(matrix, homogeneous, out);
}

// --- look-at -------------------------------------------------------------------------------------

static void look_at_turns_the_target_to_minus_z(void **context) {
    (void)context;
    Random random = {1};
    for (int i = 0; i < 5000; i++) {
        const double reach = i % 2 ? 10.0 : 1e5;
        double eye[3], target[3], up[3], out[4];
        random_vector(&random, reach, eye);
        random_vector(&random, reach, target);
        random_vector(&random, 3.0, up);
        DipMatrix view;
        assert_true(dip_camera_look_at(&view, eye, target, up, NULL));
        long double square = 0.0L;
        for (int k = 0; k < 3; k++) {
            square += ((long double)target[k] - eye[k]) * ((long double)target[k] - eye[k]);
        }
        apply_point(&view, eye, out);
        for (int k = 0; k < 3; k++) {
            assert_near(out[k], 0.0, 1e-14 * reach);
        }
        apply_point(&view, target, out);
        assert_near(out[0], 0.0, 1e-14 * reach);
        assert_near(out[1], 0.0, 1e-14 * reach);
        assert_near(out[2], (double)-sqrtl(square), 1e-14 * reach);
        assert_near(out[3], 1.0, 0.0);
        // A step upwards moves up in the picture and not sideways.
        const double direction[4] = {up[0], up[1], up[2], 0.0};
        dip_matrix_apply(&view, direction, out);
        assert_near(out[0], 0.0, 1e-11);
        assert_true(out[1] > 0.0);
        // The rows are of unit length and perpendicular, and form a right-handed frame.
        for (int r = 0; r < 3; r++) {
            const double *a = &view.m[4 * r];
            const double *b = &view.m[4 * ((r + 1) % 3)];
            const double *c = &view.m[4 * ((r + 2) % 3)];
            assert_near(a[0] * a[0] + a[1] * a[1] + a[2] * a[2], 1.0, 1e-15);
            assert_near(a[0] * b[0] + a[1] * b[1] + a[2] * b[2], 0.0, 1e-12);
            assert_near(a[1] * b[2] - a[2] * b[1], c[0], 1e-12);
        }
    }
}

// --- projections ---------------------------------------------------------------------------------

static void check_depth(const DipMatrix *projection, double distance, double expected) {
    double out[4];
    apply_point(projection, (double[3]){0.3, -0.2, -distance}, out);
    assert_near(out[2] / out[3], expected, 1e-12);
}

static void perspective_maps_its_pyramid(void **context) {
    (void)context;
    Random random = {2};
    for (int i = 0; i < 5000; i++) {
        DipPerspective lens = {.fov_deg = random_real(&random, 1.0, 179.0),
                               .aspect = random_real(&random, 0.2, 5.0),
                               .near_distance = random_real(&random, 0.001, 10.0)};
        if (i % 2) {
            lens.far_distance = lens.near_distance * random_real(&random, 1.5, 1e4);
        }
        DipMatrix projection;
        assert_true(dip_camera_perspective(&projection, &lens, NULL));
        const double d = lens.near_distance * random_real(&random, 1.0, 100.0);
        const long double top = tanl((long double)lens.fov_deg * pi / 360.0L) * d;
        double out[4];
        apply_point(&projection, (double[3]){(double)(top * lens.aspect), -(double)top, -d}, out);
        assert_near(out[3], d, 0.0);
        assert_near(out[0] / d, 1.0,
                    1e-13); // at 179 degrees, the angle's rounding counts 100 times
        assert_near(out[1] / d, -1.0, 1e-13);
        check_depth(&projection, lens.near_distance, 1.0);
        const long double n = lens.near_distance;
        const long double f = lens.far_distance;
        if (lens.far_distance != 0.0) {
            check_depth(&projection, lens.far_distance, 0.0);
            check_depth(&projection, d, (double)(n * (f - d) / (d * (f - n))));
        } else {
            check_depth(&projection, d, (double)(n / d));
        }
    }
}

static void orthographic_maps_its_box(void **context) {
    (void)context;
    Random random = {3};
    for (int i = 0; i < 5000; i++) {
        DipOrthographic box;
        box.left = random_real(&random, -10.0, 10.0);
        box.right = box.left + random_real(&random, 0.1, 20.0);
        box.bottom = random_real(&random, -10.0, 10.0);
        box.top = box.bottom + random_real(&random, 0.1, 20.0);
        box.near_distance = random_real(&random, -10.0, 10.0);
        box.far_distance = box.near_distance + random_real(&random, 0.1, 20.0);
        DipMatrix projection;
        assert_true(dip_camera_orthographic(&projection, &box, NULL));
        double out[4];
        apply_point(&projection, (double[3]){box.right, box.bottom, -box.near_distance}, out);
        assert_near(out[0], 1.0, 1e-12);
        assert_near(out[1], -1.0, 1e-12);
        assert_near(out[2], 1.0, 1e-12);
        assert_near(out[3], 1.0, 0.0);
        apply_point(&projection, (double[3]){box.left, box.top, -box.far_distance}, out);
        assert_near(out[0], -1.0, 1e-12);
        assert_near(out[1], 1.0, 1e-12);
        assert_near(out[2], 0.0, 1e-12);
    }
}

// --- matrices ------------------------------------------------------------------------------------

static void products_match_long_double(void **context) {
    (void)context;
    Random random = {4};
    for (int i = 0; i < 2000; i++) {
        const DipMatrix a = random_matrix(&random);
        const DipMatrix b = random_matrix(&random);
        const DipMatrix c = random_matrix(&random);
        const DipMatrix ab = dip_matrix_multiply(&a, &b);
        const DipMatrix abc = dip_matrix_multiply3(&a, &b, &c);
        const DipMatrix ab_c = dip_matrix_multiply(&ab, &c);
        assert_memory_equal(&abc, &ab_c, sizeof abc);
        for (int r = 0; r < 4; r++) {
            for (int k = 0; k < 4; k++) {
                long double sum = 0.0L;
                for (int j = 0; j < 4; j++) {
                    sum += (long double)a.m[4 * r + j] * b.m[4 * j + k];
                }
                assert_near(ab.m[4 * r + k], (double)sum, 1e-14);
            }
        }
        // The right factor is applied first.
        double point[4] = {1.0, -2.0, 0.5, 1.0}, first[4], both[4], at_once[4];
        dip_matrix_apply(&b, point, first);
        dip_matrix_apply(&a, first, both);
        dip_matrix_apply(&ab, point, at_once);
        for (int k = 0; k < 4; k++) {
            assert_near(at_once[k], both[k], 1e-13);
        }
        float floats[16];
        dip_matrix_floats(&ab, floats);
        for (int k = 0; k < 16; k++) {
            assert_true(floats[k] == (float)ab.m[k]);
        }
    }
}

static double largest(const DipMatrix *matrix) {
    double value = 0.0;
    for (int i = 0; i < 16; i++) {
        value = fmax(value, fabs(matrix->m[i]));
    }
    return value;
}

static void check_identity(const DipMatrix *a, const DipMatrix *b, double tolerance) {
    for (int r = 0; r < 4; r++) {
        for (int c = 0; c < 4; c++) {
            long double sum = 0.0L;
            for (int j = 0; j < 4; j++) {
                sum += (long double)a->m[4 * r + j] * b->m[4 * j + c];
            }
            assert_near((double)sum, r == c, tolerance);
        }
    }
}

static void inverses_invert(void **context) {
    (void)context;
    Random random = {5};
    for (int i = 0; i < 5000; i++) {
        DipMatrix matrix = random_matrix(&random);
        DipMatrix inverse;
        assert_true(dip_matrix_invert(&inverse, &matrix, NULL));
        const double tolerance = 1e-14 * largest(&inverse) * largest(&matrix);
        check_identity(&matrix, &inverse, tolerance);
        check_identity(&inverse, &matrix, tolerance);
        // Scaling a row by a power of two scales the inverse's column and changes no other bit.
        const int row = random_int(&random, 0, 3);
        const int exponent = random_int(&random, -200, 200);
        for (int k = 0; k < 4; k++) {
            matrix.m[4 * row + k] = ldexp(matrix.m[4 * row + k], exponent);
            inverse.m[4 * k + row] = ldexp(inverse.m[4 * k + row], -exponent);
        }
        assert_true(dip_matrix_invert(&matrix, &matrix, NULL));
        for (int k = 0; k < 16; k++) {
            assert_near(matrix.m[k], inverse.m[k], 1e-9 * fabs(inverse.m[k]));
        }
    }
}

static void cameras_invert_at_any_distance(void **context) {
    (void)context;
    const DipPerspective lens = {60.0, 1.5, 0.1, 0.0};
    for (double distance = 1.0; distance <= 1e9; distance *= 1e3) {
        const double eye[3] = {distance, 2.0, -distance};
        const double target[3] = {distance + 3.0, 1.0, -distance - 1.0};
        DipMatrix view, projection, inverse;
        assert_true(dip_camera_look_at(&view, eye, target, (double[3]){0.0, 1.0, 0.0}, NULL));
        assert_true(dip_camera_perspective(&projection, &lens, NULL));
        const DipMatrix to_clip = dip_matrix_multiply(&projection, &view);
        assert_true(dip_matrix_invert(&inverse, &to_clip, NULL));
        double clip[4], back[4];
        apply_point(&to_clip, target, clip);
        dip_matrix_apply(&inverse, clip, back);
        for (int k = 0; k < 3; k++) {
            assert_near(back[k] / back[3], target[k], 1e-12 * distance);
        }
    }
}

static void normals_stay_perpendicular(void **context) {
    (void)context;
    Random random = {6};
    for (int i = 0; i < 5000; i++) {
        DipMatrix model = random_matrix(&random);
        const double scale = ldexp(1.0, random_int(&random, -150, 150));
        for (int k = 0; k < 16; k++) {
            model.m[k] *= scale;
        }
        double a[3], b[3], n[3];
        random_vector(&random, 1.0, a);
        random_vector(&random, 1.0, b);
        for (int k = 0; k < 3; k++) {
            n[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
        }
        float normals[9];
        assert_true(dip_matrix_normals(normals, &model, NULL));
        float greatest = 0.0f;
        long double moved[2][3], turned[3], length = 0.0L;
        for (int r = 0; r < 3; r++) {
            const double *row = &model.m[4 * r];
            moved[0][r] = (row[0] * a[0] + row[1] * a[1] + row[2] * a[2]) / scale;
            moved[1][r] = (row[0] * b[0] + row[1] * b[1] + row[2] * b[2]) / scale;
            turned[r] =
                normals[3 * r] * n[0] + normals[3 * r + 1] * n[1] + normals[3 * r + 2] * n[2];
            length += turned[r] * turned[r];
            for (int c = 0; c < 3; c++) {
                greatest = fmaxf(greatest, fabsf(normals[3 * r + c]));
            }
        }
        assert_true(greatest >= 1.0f && greatest <= 2.0f);
        for (int k = 0; k < 2; k++) {
            const long double dot =
                turned[0] * moved[k][0] + turned[1] * moved[k][1] + turned[2] * moved[k][2];
            assert_near((double)dot, 0.0, 2e-5);
        }
        // The side on which the normal stands stays the same: a point beside the surface is on the
        // side of the turned normal after the model's transform.
        const double *m = model.m;
        long double side = 0.0L;
        for (int r = 0; r < 3; r++) {
            side +=
                turned[r] * ((m[4 * r] * n[0] + m[4 * r + 1] * n[1] + m[4 * r + 2] * n[2]) / scale);
        }
        assert_true(side > 0.0L || sqrtl(length) < 1e-6L);
    }
}

static void rotations_turn_counter_clockwise(void **context) {
    (void)context;
    Random random = {7};
    for (int i = 0; i < 1000; i++) {
        const int axis = i % 3;
        const double angle = random_real(&random, -100.0, 100.0);
        const DipMatrix matrix = dip_matrix_rotation(axis, angle);
        double point[3] = {0.0, 0.0, 0.0}, out[4];
        point[(axis + 1) % 3] = 1.0;
        apply_point(&matrix, point, out);
        assert_near(out[axis], 0.0, 0.0);
        assert_near(out[(axis + 1) % 3], (double)cosl(angle), 1e-15);
        assert_near(out[(axis + 2) % 3], (double)sinl(angle), 1e-15);
    }
    const DipMatrix identity = dip_matrix_identity();
    const DipMatrix none = dip_matrix_rotation(3, 1.0);
    assert_memory_equal(&none, &identity, sizeof identity);
}

static void reflections_mirror_at_their_plane(void **context) {
    (void)context;
    Random random = {8};
    for (int i = 0; i < 1000; i++) {
        double n[3], p[3], out[4], back[4];
        random_vector(&random, 1.0, n);
        random_vector(&random, 5.0, p);
        const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (int k = 0; k < 3; k++) {
            n[k] /= length;
        }
        const double distance = random_real(&random, -3.0, 3.0);
        const DipMatrix mirror = dip_matrix_reflection(n, distance);
        apply_point(&mirror, p, out);
        dip_matrix_apply(&mirror, out, back);
        const double before = n[0] * p[0] + n[1] * p[1] + n[2] * p[2] - distance;
        const double after = n[0] * out[0] + n[1] * out[1] + n[2] * out[2] - distance;
        assert_near(after, -before, 1e-14);
        for (int k = 0; k < 3; k++) {
            assert_near(back[k], p[k], 1e-14);
            assert_near(out[k] - p[k], -2.0 * before * n[k], 1e-14);
        }
    }
    const DipMatrix move = dip_matrix_translation(1.0, 2.0, 3.0);
    const DipMatrix stretch = dip_matrix_scaling(2.0, 3.0, -4.0);
    const DipMatrix both = dip_matrix_multiply(&move, &stretch);
    double out[4];
    apply_point(&both, (double[3]){10.0, 10.0, 10.0}, out);
    assert_true(out[0] == 21.0 && out[1] == 32.0 && out[2] == -37.0 && out[3] == 1.0);
}

// The corners of clip space become those of a target; depths and divisors stay.
static void maps_begin_at_their_top_left_corner(void **state) {
    (void)state;
    const DipMatrix to_map = dip_matrix_to_map();
    static const double clip[3][4] = {{-2, 2, 0.5, 2}, {3, -3, 1, 3}, {0.5, 0.25, 0.125, 1}};
    static const double map[3][4] = {{0, 0, 0.5, 2}, {3, 3, 1, 3}, {0.75, 0.375, 0.125, 1}};
    for (int i = 0; i < 3; i++) {
        double out[4];
        dip_matrix_apply(&to_map, clip[i], out);
        for (int k = 0; k < 4; k++) {
            assert_true(out[k] == map[i][k]);
        }
    }
}

// Returns plane . point, with the fourth element as it is.
static double beyond(const double plane[4], const double p[3]) {
    return plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3];
}

static double beyond_in_clip(const float plane[4], const DipMatrix *to_clip, const double p[3],
                             double *magnitude) {
    double clip[4], sum = 0.0;
    apply_point(to_clip, p, clip);
    *magnitude = 0.0;
    for (int k = 0; k < 4; k++) {
        sum += (double)plane[k] * clip[k];
        *magnitude += fabs((double)plane[k] * clip[k]);
    }
    return sum;
}

// A clip plane gives all points of the world what the plane of the world gives them, times one
// positive factor.
static void clip_planes_keep_what_their_planes_keep(void **context) {
    (void)context;
    Random random = {12};
    for (int i = 0; i < 2000; i++) {
        const DipPerspective lens = {random_real(&random, 20.0, 120.0), 1.5, 0.1,
                                     i % 2 ? 0.0 : 50.0};
        double eye[3], target[3], up[3], plane[4], scaled[4], magnitude;
        random_vector(&random, 10.0, eye);
        random_vector(&random, 10.0, target);
        random_vector(&random, 1.0, up);
        random_vector(&random, 1.0, plane);
        plane[3] = random_real(&random, -5.0, 5.0);
        for (int k = 0; k < 4; k++) {
            scaled[k] = plane[k] * (i % 3 ? 1.0 : 1e-200);
        }
        DipMatrix view, projection;
        assert_true(dip_camera_look_at(&view, eye, target, up, NULL));
        assert_true(dip_camera_perspective(&projection, &lens, NULL));
        const DipMatrix to_clip = dip_matrix_multiply(&projection, &view);
        float made[4];
        assert_true(dip_matrix_clip_plane(&to_clip, scaled, made, NULL));
        const double largest = fmax(fmax(fabs((double)made[0]), fabs((double)made[1])),
                                    fmax(fabs((double)made[2]), fabs((double)made[3])));
        assert_true(largest >= 1.0 && largest <= 2.0);
        // The factor, from a point at which the plane gives 5.
        const double along = (5.0 - plane[3]) / (beyond(plane, plane) - plane[3]);
        const double known[3] = {along * plane[0], along * plane[1], along * plane[2]};
        const double factor = beyond_in_clip(made, &to_clip, known, &magnitude) / 5.0;
        const double known_error = 1e-7 * magnitude / 5.0;
        assert_true(factor > 0.0);
        for (int n = 0; n < 20; n++) {
            double p[3];
            random_vector(&random, 10.0, p);
            const double expected = beyond(plane, p);
            const double found = beyond_in_clip(made, &to_clip, p, &magnitude);
            assert_near(found, factor * expected, 1e-7 * magnitude + known_error * fabs(expected));
        }
    }
}

// --- refusals ------------------------------------------------------------------------------------

static void check_error(bool made, const DipError *err, const char *key) {
    assert_false(made);
    assert_int_equal(err->code, DIP_ERROR_RANGE);
    assert_string_equal(err->key, key);
}

static void bad_cameras_are_refused_by_name(void **context) {
    (void)context;
    const double zero[3] = {0.0, 0.0, 0.0};
    const double one[3] = {1.0, 2.0, 3.0};
    const double two[3] = {2.0, 4.0, 6.0};
    const double bad[3] = {0.0, NAN, 0.0};
    const double huge[3] = {1e308, -1e308, 1e308};
    const double far[3] = {-1e308, 1e308, -1e308};
    DipMatrix matrix = dip_matrix_identity();
    const DipMatrix before = matrix;
    DipError err;
    check_error(dip_camera_look_at(&matrix, bad, one, two, &err), &err, "eye");
    check_error(dip_camera_look_at(&matrix, one, bad, two, &err), &err, "target");
    check_error(dip_camera_look_at(&matrix, zero, one, bad, &err), &err, "up");
    check_error(dip_camera_look_at(&matrix, one, one, two, &err), &err, "target");
    check_error(dip_camera_look_at(&matrix, huge, far, two, &err), &err, "target");
    check_error(dip_camera_look_at(&matrix, zero, one, zero, &err), &err, "up");
    check_error(dip_camera_look_at(&matrix, zero, one, two, &err), &err, "up");
    static const struct {
        DipPerspective lens;
        const char *key;
    } lenses[] = {
        {{0.0, 1.0, 0.1, 0.0}, "fov_deg"},        {{180.0, 1.0, 0.1, 0.0}, "fov_deg"},
        {{NAN, 1.0, 0.1, 0.0}, "fov_deg"},        {{1e-320, 1.0, 0.1, 0.0}, "fov_deg"},
        {{60.0, 0.0, 0.1, 0.0}, "aspect"},        {{60.0, INFINITY, 0.1, 0.0}, "aspect"},
        {{60.0, 1.0, 0.0, 0.0}, "near_distance"}, {{60.0, 1.0, NAN, 0.0}, "near_distance"},
        {{60.0, 1.0, 0.1, 0.1}, "far_distance"},  {{60.0, 1.0, 0.1, -1.0}, "far_distance"},
        {{60.0, 1.0, 0.1, NAN}, "far_distance"},
    };
    for (size_t i = 0; i < sizeof lenses / sizeof *lenses; i++) {
        check_error(dip_camera_perspective(&matrix, &lenses[i].lens, &err), &err, lenses[i].key);
    }
    static const struct {
        DipOrthographic box;
        const char *key;
    } boxes[] = {
        {{1.0, 1.0, 0.0, 1.0, 0.0, 1.0}, "right"},
        {{0.0, NAN, 0.0, 1.0, 0.0, 1.0}, "right"},
        {{0.0, 1.0, 2.0, 1.0, 0.0, 1.0}, "top"},
        {{0.0, 1.0, 0.0, 1.0, 1.0, 1.0}, "far_distance"},
        {{0.0, 1.0, 0.0, 1.0, 0.0, INFINITY}, "far_distance"},
    };
    for (size_t i = 0; i < sizeof boxes / sizeof *boxes; i++) {
        check_error(dip_camera_orthographic(&matrix, &boxes[i].box, &err), &err, boxes[i].key);
    }
    assert_memory_equal(&matrix, &before, sizeof matrix);
}

static void singular_matrices_are_refused(void **context) {
    (void)context;
    Random random = {9};
    DipError err;
    DipMatrix out;
    for (int i = 0; i < 2000; i++) {
        DipMatrix matrix = random_matrix(&random);
        const int row = random_int(&random, 0, 3);
        for (int c = 0; c < 4; c++) {
            // A row that is the sum of the two next ones.
            matrix.m[4 * row + c] =
                matrix.m[4 * ((row + 1) % 4) + c] + matrix.m[4 * ((row + 2) % 4) + c];
        }
        check_error(dip_matrix_invert(&out, &matrix, &err), &err, "matrix");
    }
    DipMatrix bad = dip_matrix_identity();
    bad.m[3] = INFINITY;
    check_error(dip_matrix_invert(&out, &bad, &err), &err, "matrix");
    const DipMatrix flat = dip_matrix_scaling(1.0, 0.0, 1.0);
    float normals[9];
    check_error(dip_matrix_normals(normals, &flat, &err), &err, "model");
    float clip_plane[4];
    const double good[4] = {0.0, 1.0, 0.0, 0.0}, nowhere[4] = {0.0, 0.0, 0.0, 1.0};
    const double undefined[4] = {0.0, 1.0, 0.0, NAN};
    check_error(dip_matrix_clip_plane(&flat, good, clip_plane, &err), &err, "to_clip");
    check_error(dip_matrix_clip_plane(&bad, good, clip_plane, &err), &err, "to_clip");
    const DipMatrix same = dip_matrix_identity();
    check_error(dip_matrix_clip_plane(&same, nowhere, clip_plane, &err), &err, "plane");
    check_error(dip_matrix_clip_plane(&same, undefined, clip_plane, &err), &err, "plane");
}

static void wide_and_near_lenses_keep_their_precision(void **state) {
    (void)state;
    for (int n = 3; n <= 44; n++) {
        const double fov = 180.0 - ldexp(180.0, -n);
        const DipPerspective lens = {.fov_deg = fov, .aspect = 1.0, .near_distance = 0.1};
        DipMatrix projection;
        assert_true(dip_camera_perspective(&projection, &lens, NULL));
        const long double focal = tanl((180.0L - (long double)fov) * pi / 360.0L);
        assert_near(projection.m[5] / (double)focal, 1.0, 1e-14);
    }
    const double distances[] = {1e-300, 1e-45, 1e-39, 1e39};
    for (int n = 0; n < 4; n++) {
        const DipPerspective lens = {.fov_deg = 60.0, .aspect = 1.0, .near_distance = distances[n]};
        DipMatrix projection;
        DipError err = {0};
        assert_false(dip_camera_perspective(&projection, &lens, &err));
        assert_string_equal(err.key, "near_distance");
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wide_and_near_lenses_keep_their_precision),
        cmocka_unit_test(look_at_turns_the_target_to_minus_z),
        cmocka_unit_test(perspective_maps_its_pyramid),
        cmocka_unit_test(orthographic_maps_its_box),
        cmocka_unit_test(products_match_long_double),
        cmocka_unit_test(inverses_invert),
        cmocka_unit_test(cameras_invert_at_any_distance),
        cmocka_unit_test(normals_stay_perpendicular),
        cmocka_unit_test(rotations_turn_counter_clockwise),
        cmocka_unit_test(reflections_mirror_at_their_plane),
        cmocka_unit_test(maps_begin_at_their_top_left_corner),
        cmocka_unit_test(clip_planes_keep_what_their_planes_keep),
        cmocka_unit_test(bad_cameras_are_refused_by_name),
        cmocka_unit_test(singular_matrices_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
