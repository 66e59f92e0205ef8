// Tests shapes: they are closed, wind outwards, enclose the volume of the closed form, and have
// normals and texture coordinates that fit their triangles.
#include "renderer/base/hash.h"
#include "renderer/shapes/shapes.h"
#include "tests/renderer/shapes/manifold.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/renderer/pipeline/near.h"

static const double pi = 3.14159265358979323846;

static void check_closed(const DipShape *shape) {
    uint32_t *joined = malloc((shape->index_count + 1) * sizeof *joined);
    join_positions(shape->attributes, DIP_SHAPE_ATTRIBUTES, shape->vertex_count, shape->indices,
                   shape->index_count, joined);
    const EdgeCounts counts = count_edges(joined, shape->index_count);
    assert_int_equal(counts.inner, shape->index_count);
    assert_int_equal(counts.border, 0);
    assert_int_equal(counts.repeated, 0);
    assert_int_equal(counts.collapsed, 0);
    free(joined);
}

static const float *row_of(const DipShape *shape, size_t corner) {
    return shape->attributes + (size_t)shape->indices[corner] * DIP_SHAPE_ATTRIBUTES;
}

// Checks that each triangle's winding agrees with its vertices' normals, which have unit length,
// and that a picture with v = 0 above is not mirrored on it.
static void check_triangles(const DipShape *shape) {
    for (size_t i = 0; i < shape->index_count; i += 3) {
        const float *corner[3] = {row_of(shape, i), row_of(shape, i + 1), row_of(shape, i + 2)};
        double normal[3];
        double length = 0.0;
        for (int a = 0; a < 3; a++) {
            const int y = (a + 1) % 3;
            const int z = (a + 2) % 3;
            normal[a] =
                ((double)corner[1][y] - corner[0][y]) * ((double)corner[2][z] - corner[0][z]) -
                ((double)corner[1][z] - corner[0][z]) * ((double)corner[2][y] - corner[0][y]);
            length += normal[a] * normal[a];
        }
        assert_true(length > 0.0);
        for (int k = 0; k < 3; k++) {
            const float *n = corner[k] + DIP_SHAPE_NORMAL;
            const double dot = normal[0] * n[0] + normal[1] * n[1] + normal[2] * n[2];
            assert_true(dot > 0.2 * sqrt(length));
            assert_near(sqrt((double)n[0] * n[0] + (double)n[1] * n[1] + (double)n[2] * n[2]), 1.0,
                        1e-6);
        }
        const float *t[3] = {corner[0] + DIP_SHAPE_TEXTURE, corner[1] + DIP_SHAPE_TEXTURE,
                             corner[2] + DIP_SHAPE_TEXTURE};
        assert_true(((double)t[1][0] - t[0][0]) * ((double)t[2][1] - t[0][1]) -
                        ((double)t[2][0] - t[0][0]) * ((double)t[1][1] - t[0][1]) <
                    0.0);
    }
    for (uint32_t v = 0; v < shape->vertex_count; v++) {
        const float *t = shape->attributes + (size_t)v * DIP_SHAPE_ATTRIBUTES + DIP_SHAPE_TEXTURE;
        assert_true(t[0] >= 0.0f && t[0] <= 1.0f && t[1] >= 0.0f && t[1] <= 1.0f);
    }
}

static double volume_of(const DipShape *shape) {
    return enclosed_volume(shape->attributes, DIP_SHAPE_ATTRIBUTES, shape->indices,
                           shape->index_count);
}

static double sphere_volume(float radius, int slices, int stacks) {
    DipShape shape;
    assert_true(dip_shape_sphere(&shape, radius, slices, stacks, NULL));
    assert_int_equal(shape.index_count, 6 * slices * (stacks - 1));
    assert_int_equal(shape.vertex_count, 2 * slices + (slices + 1) * (stacks - 1));
    check_closed(&shape);
    check_triangles(&shape);
    for (uint32_t v = 0; v < shape.vertex_count; v++) {
        const float *row = shape.attributes + (size_t)v * DIP_SHAPE_ATTRIBUTES;
        for (int i = 0; i < 3; i++) {
            assert_near(row[i], (double)radius * row[DIP_SHAPE_NORMAL + i], 1e-6 * radius);
        }
        const double u = row[DIP_SHAPE_TEXTURE];
        const double height = row[DIP_SHAPE_TEXTURE + 1];
        const bool pole = height == 0.0 || height == 1.0;
        assert_near(row[1], radius * cos(pi * height), 2e-6 * radius);
        assert_near(row[0], pole ? 0.0 : radius * sin(pi * height) * cos(2.0 * pi * u),
                    2e-6 * radius);
        assert_near(row[2], pole ? 0.0 : -radius * sin(pi * height) * sin(2.0 * pi * u),
                    2e-6 * radius);
    }
    const double volume = volume_of(&shape);
    dip_shape_free(&shape);
    assert_null(shape.attributes);
    return volume;
}

static void sphere_is_closed_and_its_volume_converges(void **context) {
    (void)context;
    sphere_volume(1.0f, 3, 2);
    sphere_volume(0.25f, 5, 3);
    sphere_volume(1e6f, 7, 8);
    const double expected = 4.0 / 3.0 * pi * 27.0;
    double error = expected - sphere_volume(3.0f, 16, 8);
    for (int n = 32; n <= 256; n *= 2) {
        const double finer = expected - sphere_volume(3.0f, n, n / 2);
        assert_near(error / finer, 4.0, 0.2); // an inscribed polyhedron errs by O(1 / n^2)
        error = finer;
    }
    assert_near(error / expected, 0.0, 5e-4);
}

static void box_has_the_faces_in_their_order(void **context) {
    (void)context;
    const float size[3] = {2.0f, 3.0f, 0.5f};
    static const int axis[6] = {0, 0, 1, 1, 2, 2};
    DipShape shape;
    assert_true(dip_shape_box(&shape, size, NULL));
    check_closed(&shape);
    check_triangles(&shape);
    assert_int_equal(shape.vertex_count, 24);
    assert_near(volume_of(&shape), 3.0, 1e-12);
    for (int v = 0; v < 24; v++) {
        const float *row = shape.attributes + (size_t)v * DIP_SHAPE_ATTRIBUTES;
        const int face = v / 4;
        const float sign = face % 2 ? -1.0f : 1.0f;
        for (int i = 0; i < 3; i++) {
            assert_true(fabsf(row[i]) == 0.5f * size[i]);
            assert_true(row[DIP_SHAPE_NORMAL + i] == (i == axis[face] ? sign : 0.0f));
        }
        assert_true(row[axis[face]] == sign * 0.5f * size[axis[face]]);
        // The corners begin at the lower left.
        assert_true(row[DIP_SHAPE_TEXTURE] == (v % 4 == 1 || v % 4 == 2 ? 1.0f : 0.0f));
        assert_true(row[DIP_SHAPE_TEXTURE + 1] == (v % 4 < 2 ? 1.0f : 0.0f));
        if (axis[face] != 1) {
            assert_true(row[1] == (v % 4 < 2 ? -0.5f : 0.5f) * size[1]);
        } else {
            assert_true(row[2] == (v % 4 < 2 ? 0.5f : -0.5f) * sign * size[2]);
        }
    }
    dip_shape_free(&shape);
}

static void prism_is_closed_and_has_the_volume_of_its_polygon(void **context) {
    (void)context;
    for (int sides = 3; sides <= 100; sides++) {
        for (int smooth = 0; smooth < 2; smooth++) {
            DipShape shape;
            assert_true(dip_shape_prism(&shape, 1.5f, 4.0f, sides, smooth, NULL));
            check_closed(&shape);
            check_triangles(&shape);
            const double base = 0.5 * sides * 1.5 * 1.5 * sin(2.0 * pi / sides);
            assert_near(volume_of(&shape), 4.0 * base, 1e-5);
            for (int side = 0; side < sides; side++) {
                for (int k = 0; k < 4; k++) {
                    const float *row = shape.attributes + (4 * side + k) * DIP_SHAPE_ATTRIBUTES;
                    const int corner = side + (k == 0 || k == 3);
                    const double angle = 2.0 * pi * corner / sides;
                    const double facing = smooth ? angle : 2.0 * pi * (side + 0.5) / sides;
                    assert_near(row[0], 1.5 * cos(angle), 1e-6);
                    assert_near(row[1], k < 2 ? -2.0 : 2.0, 0.0);
                    assert_near(row[2], 1.5 * sin(angle), 1e-6);
                    assert_near(row[DIP_SHAPE_NORMAL], cos(facing), 1e-6);
                    assert_near(row[DIP_SHAPE_NORMAL + 1], 0.0, 0.0);
                    assert_near(row[DIP_SHAPE_NORMAL + 2], sin(facing), 1e-6);
                    assert_near(row[DIP_SHAPE_TEXTURE], 1.0 - (double)corner / sides, 1e-6);
                }
            }
            dip_shape_free(&shape);
        }
    }
}

// Directions at quarter turns are exact, so that shapes which touch leave no gap.
static void quarter_turns_are_exact(void **context) {
    (void)context;
    DipShape shape;
    assert_true(dip_shape_prism(&shape, 2.0f, 1.0f, 12, true, NULL));
    const float *quarter = shape.attributes + (size_t)(4 * 3 + 1) * DIP_SHAPE_ATTRIBUTES;
    const float *half = shape.attributes + (size_t)(4 * 6 + 1) * DIP_SHAPE_ATTRIBUTES;
    assert_true(quarter[0] == 0.0f && quarter[2] == 2.0f && !signbit(quarter[0]));
    assert_true(half[0] == -2.0f && half[2] == 0.0f && !signbit(half[2]));
    dip_shape_free(&shape);
}

static void plane_and_quad_cover_their_rectangle(void **context) {
    (void)context;
    DipShape shape;
    assert_true(dip_shape_plane(&shape, 6.0f, 2.0f, 3, 5, NULL));
    check_triangles(&shape);
    assert_int_equal(shape.vertex_count, 4 * 6);
    assert_int_equal(shape.index_count, 6 * 3 * 5);
    for (int row = 0; row <= 5; row++) {
        for (int column = 0; column <= 3; column++) {
            const float *vertex = shape.attributes + (row * 4 + column) * DIP_SHAPE_ATTRIBUTES;
            assert_near(vertex[0], -3.0 + 6.0 * column / 3.0, 1e-6);
            assert_near(vertex[1], 0.0, 0.0);
            assert_near(vertex[2], -1.0 + 2.0 * row / 5.0, 1e-6);
            assert_near(vertex[DIP_SHAPE_NORMAL + 1], 1.0, 0.0);
            assert_near(vertex[DIP_SHAPE_TEXTURE], column / 3.0, 1e-6);
            assert_near(vertex[DIP_SHAPE_TEXTURE + 1], row / 5.0, 1e-6);
        }
    }
    const EdgeCounts counts = count_edges(shape.indices, shape.index_count);
    assert_int_equal(counts.border, 2 * (3 + 5));
    assert_int_equal(counts.repeated + counts.collapsed, 0);
    dip_shape_free(&shape);

    assert_true(dip_shape_quad(&shape, 4.0f, 2.0f, NULL));
    check_triangles(&shape);
    static const float corners[4][2] = {{-2, -1}, {2, -1}, {2, 1}, {-2, 1}};
    for (int v = 0; v < 4; v++) {
        const float *vertex = shape.attributes + v * DIP_SHAPE_ATTRIBUTES;
        assert_true(vertex[0] == corners[v][0] && vertex[1] == corners[v][1] && vertex[2] == 0.0f);
        assert_true(vertex[DIP_SHAPE_NORMAL + 2] == 1.0f);
    }
    dip_shape_free(&shape);
}

// The hash is that of x86-64 with gcc.
static void bits_are_the_same_everywhere(void **context) {
    (void)context;
    DipShape sphere;
    DipShape prism;
    assert_true(dip_shape_sphere(&sphere, 1.7f, 61, 37, NULL));
    assert_true(dip_shape_prism(&prism, 0.3f, 2.9f, 47, false, NULL));
    DipHash hash = dip_hash_begin(0);
    dip_hash_bytes(&hash, sphere.attributes,
                   (size_t)sphere.vertex_count * DIP_SHAPE_ATTRIBUTES * sizeof(float));
    dip_hash_bytes(&hash, prism.attributes,
                   (size_t)prism.vertex_count * DIP_SHAPE_ATTRIBUTES * sizeof(float));
    assert_int_equal(hash.lanes[0], UINT64_C(0x6b7d220ae8031e90));
    dip_shape_free(&sphere);
    dip_shape_free(&prism);
}

static void check_refused(bool made, const DipShape *shape, const DipError *err, const char *key) {
    assert_false(made);
    assert_int_equal(err->code, DIP_ERROR_RANGE);
    assert_string_equal(err->key, key);
    assert_null(shape->attributes);
    assert_null(shape->indices);
    assert_int_equal(shape->vertex_count, 0);
}

static void bad_numbers_are_refused_by_name(void **context) {
    (void)context;
    static const float bad[] = {0.0f, -1.0f, NAN, INFINITY};
    DipShape shape;
    DipError err;
#define REFUSED(key, call) check_refused(call, &shape, &err, key)
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        REFUSED("radius", dip_shape_sphere(&shape, bad[i], 8, 8, &err));
        REFUSED("size", dip_shape_box(&shape, (float[3]){1.0f, 1.0f, bad[i]}, &err));
        REFUSED("radius", dip_shape_prism(&shape, bad[i], 1.0f, 8, false, &err));
        REFUSED("height", dip_shape_prism(&shape, 1.0f, bad[i], 8, false, &err));
        REFUSED("size_x", dip_shape_plane(&shape, bad[i], 1.0f, 1, 1, &err));
        REFUSED("size_z", dip_shape_plane(&shape, 1.0f, bad[i], 1, 1, &err));
        REFUSED("width", dip_shape_quad(&shape, bad[i], 1.0f, &err));
        REFUSED("height", dip_shape_quad(&shape, 1.0f, bad[i], &err));
    }
    REFUSED("slices", dip_shape_sphere(&shape, 1.0f, 2, 8, &err));
    REFUSED("slices", dip_shape_sphere(&shape, 1.0f, DIP_MAX_SHAPE_STEPS + 1, 8, &err));
    REFUSED("stacks", dip_shape_sphere(&shape, 1.0f, 8, 1, &err));
    REFUSED("sides", dip_shape_prism(&shape, 1.0f, 1.0f, 2, false, &err));
    REFUSED("columns", dip_shape_plane(&shape, 1.0f, 1.0f, 0, 1, &err));
    REFUSED("rows", dip_shape_plane(&shape, 1.0f, 1.0f, 1, -5, &err));
#undef REFUSED
}

// A shape's data makes a mesh with the same triangles.
static void shapes_become_meshes(void **context) {
    (void)context;
    DipShape shape;
    assert_true(dip_shape_sphere(&shape, 2.0f, 40, 20, NULL));
    const DipMeshData data = dip_shape_data(&shape, "sphere");
    DipMesh *mesh = dip_mesh_create(&data, NULL);
    assert_non_null(mesh);
    assert_int_equal(dip_mesh_triangle_count(mesh), shape.index_count / 3);
    float min[3];
    float max[3];
    dip_mesh_bounds(mesh, min, max);
    for (int i = 0; i < 3; i++) {
        assert_true(min[i] == -2.0f && max[i] == 2.0f);
    }
    dip_mesh_destroy(&mesh);
    dip_shape_free(&shape);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sphere_is_closed_and_its_volume_converges),
        cmocka_unit_test(box_has_the_faces_in_their_order),
        cmocka_unit_test(prism_is_closed_and_has_the_volume_of_its_polygon),
        cmocka_unit_test(quarter_turns_are_exact),
        cmocka_unit_test(plane_and_quad_cover_their_rectangle),
        cmocka_unit_test(bits_are_the_same_everywhere),
        cmocka_unit_test(bad_numbers_are_refused_by_name),
        cmocka_unit_test(shapes_become_meshes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
