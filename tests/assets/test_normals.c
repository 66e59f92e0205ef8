// Tests the normals of meshes that have none, against all pairs of faces. The vertices lie on a
// small grid of whole numbers, so that many faces meet at a point, and cross products are exact.
#include "renderer/catalogue/random.h"
#include "tests/assets/fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

enum { FACES = 400, MOST_FACES = 1025, TEXT_BYTES = 1 << 18 };

typedef struct Face {
    int corners[3][3]; // x, y and z of each
} Face;

static char text[TEXT_BYTES];

// Loads faces that share no vertices.
static DipModel *load(const Face *faces, int count) {
    size_t length = (size_t)snprintf(text, sizeof text,
                                     "ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\n"
                                     "property float y\nproperty float z\nelement face %d\n"
                                     "property list uchar int vertex_indices\nend_header\n",
                                     3 * count, count);
    for (int i = 0; i < 3 * count; ++i) {
        const int *at = faces[i / 3].corners[i % 3];
        length += (size_t)snprintf(text + length, sizeof text - length, "%d %d %d\n", at[0], at[1],
                                   at[2]);
    }
    for (int i = 0; i < count; ++i) {
        length += (size_t)snprintf(text + length, sizeof text - length, "3 %d %d %d\n", 3 * i,
                                   3 * i + 1, 3 * i + 2);
    }
    assert_true(length < sizeof text);
    fixture_write_text("faces.ply", text);
    return fixture_load(fixture_path("faces.ply"), NULL, NULL);
}

// Twice the area times the normal.
static void cross(const Face *face, int64_t normal[3]) {
    const int(*at)[3] = (const int(*)[3])face->corners;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        normal[i] = (int64_t)(at[1][j] - at[0][j]) * (at[2][k] - at[0][k]) -
                    (int64_t)(at[1][k] - at[0][k]) * (at[2][j] - at[0][j]);
    }
}

static int64_t dot(const int64_t a[3], const int64_t b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Whether the angle between two normals is less than 60 degrees, whose cosine is 1/2.
static bool is_smooth(const int64_t a[3], const int64_t b[3]) {
    const int64_t along = dot(a, b);
    return along > 0 && 4 * along * along > dot(a, a) * dot(b, b);
}

static bool touches(const Face *face, const int at[3]) {
    for (int c = 0; c < 3; ++c) {
        if (memcmp(face->corners[c], at, sizeof face->corners[c]) == 0) {
            return true;
        }
    }
    return false;
}

static void expected_normal(const Face *faces, int count, int face, int corner, double normal[3]) {
    int64_t own[3], sum[3];
    cross(&faces[face], own);
    memcpy(sum, own, sizeof sum);
    for (int other = 0; other < count; ++other) {
        int64_t there[3];
        cross(&faces[other], there);
        if (other != face && touches(&faces[other], faces[face].corners[corner]) &&
            is_smooth(own, there)) {
            for (int i = 0; i < 3; ++i) {
                sum[i] += there[i];
            }
        }
    }
    for (int i = 0; i < 3; ++i) {
        normal[i] = (double)sum[i] / sqrt((double)dot(sum, sum));
    }
}

static void faces_are_smooth_where_they_meet_at_less_than_60_degrees(void **state) {
    (void)state;
    static Face faces[FACES];
    Random random = {60};
    for (int i = 0; i < FACES; ++i) {
        int64_t normal[3] = {0};
        while (dot(normal, normal) == 0) {
            for (int c = 0; c < 9; ++c) {
                faces[i].corners[c / 3][c % 3] = random_int(&random, -1, 2);
            }
            cross(&faces[i], normal);
        }
    }
    DipModel *model = load(faces, FACES);
    const DipMeshDef *mesh = &dip_model_scene_def(model)->meshes[0];
    assert_int_equal(mesh->index_count, 3 * FACES);
    for (int i = 0; i < 3 * FACES; ++i) {
        const float *position = mesh->positions + 3 * (size_t)mesh->indices[i];
        const float *normal = mesh->normals + 3 * (size_t)mesh->indices[i];
        double expected[3];
        expected_normal(faces, FACES, i / 3, i % 3, expected);
        for (int axis = 0; axis < 3; ++axis) {
            assert_true(position[axis] == (float)faces[i / 3].corners[i % 3][axis]);
            if (fabs((double)normal[axis] - expected[axis]) > 1e-6) {
                fail_msg("corner %d, axis %d: %.9g, expected %.9g", i, axis, (double)normal[axis],
                         expected[axis]);
            }
        }
    }
    dip_model_destroy(&model);
}

// A flat cone of so many faces that meet at its tip. Returns how far a normal at the tip leans.
static double lean_at_tip(int count) {
    static Face faces[MOST_FACES];
    for (int i = 0; i < count; ++i) {
        const double turn = 2.0 * acos(-1.0) / count;
        const double ends[2] = {turn * i, turn * (i + 1)};
        for (int c = 0; c < 3; ++c) {
            faces[i].corners[c][0] = c ? (int)lround(1e6 * cos(ends[c - 1])) : 0;
            faces[i].corners[c][1] = c ? (int)lround(1e6 * sin(ends[c - 1])) : 0;
            faces[i].corners[c][2] = c ? 0 : 100000;
        }
    }
    DipModel *model = load(faces, count);
    const DipMeshDef *mesh = &dip_model_scene_def(model)->meshes[0];
    assert_int_equal(mesh->index_count, 3 * count);
    const float *normal = mesh->normals + 3 * (size_t)mesh->indices[0];
    const double lean = sqrt((double)normal[0] * normal[0] + (double)normal[1] * normal[1]);
    dip_model_destroy(&model);
    return lean;
}

// 1024 faces at a point are compared. More stay flat.
static void too_many_faces_at_a_point_stay_flat(void **state) {
    (void)state;
    assert_true(lean_at_tip(1024) < 1e-5);
    assert_float_equal(lean_at_tip(1025), 0.0995, 1e-4); // sin(atan(.1))
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(faces_are_smooth_where_they_meet_at_less_than_60_degrees),
        cmocka_unit_test(too_many_faces_at_a_point_stay_flat)};
    return cmocka_run_group_tests(tests, fixture_open, fixture_close);
}
