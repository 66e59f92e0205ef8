// Tests that the caller's floating-point mode changes nothing: the functions of renderer/shapes/
// give the same bits in every mode and leave the mode as it was.
#include "renderer/shapes/camera.h"
#include "renderer/shapes/shapes.h"
#include "renderer/shapes/tessellate.h"
#include "tests/support/fp_walk.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <cmocka.h>

static void hash_matrix(DipHash *hash, const DipMatrix *matrix) {
    float rounded[16];
    dip_matrix_floats(matrix, rounded);
    dip_hash_bytes(hash, matrix->m, sizeof matrix->m);
    dip_hash_bytes(hash, rounded, sizeof rounded);
}

// --- cameras -------------------------------------------------------------------------------------

static void call_look_at(DipHash *hash) {
    DipMatrix view;
    for (int i = 0; i < 8; i++) {
        const double eye[3] = {0.1, 3.7, -1e5 + i}, target[3] = {7.25 * i, -0.3, 11.1};
        const double up[3] = {0.1, 0.9, i % 2 ? 3e-310 : -0.7};
        assert_true(dip_camera_look_at(&view, eye, target, up, NULL));
        hash_matrix(hash, &view);
    }
}

static void call_projections(DipHash *hash) {
    DipMatrix projection;
    for (int i = 0; i < 8; i++) {
        const DipPerspective lens = {47.125 + i, 1.777, 0.1, i % 2 ? 1234.5 : 0.0};
        const DipOrthographic box = {-3.3, 7.75 + i, -1.1, 2.3, -0.7, 99.9};
        assert_true(dip_camera_perspective(&projection, &lens, NULL));
        hash_matrix(hash, &projection);
        assert_true(dip_camera_orthographic(&projection, &box, NULL));
        hash_matrix(hash, &projection);
    }
}

// --- matrices ------------------------------------------------------------------------------------

// Numbers without a pattern. Some products of the last row are subnormal.
static const DipMatrix some = {
    {0.7, 0.1, 0.2, 3.3, -0.3, 1.7, 0.1, -0.9, 0.2, 0.3, 1.1, 7.7, 1e-160, 3e-170, 0.1, 1.3}};
static const DipMatrix other = {
    {1.3, -0.2, 0.7, 0.1, 0.6, 0.9, 0.1, 12.7, -0.1, 0.3, 0.3, 0.77, 3e-155, 0.2, 7e-160, 0.9}};

static void call_matrices(DipHash *hash) {
    const DipMatrix parts[] = {dip_matrix_identity(), dip_matrix_translation(0.1, -3.7, 3e-310),
                               dip_matrix_scaling(0.3, 1.7, 1e-310), dip_matrix_to_map()};
    for (int i = 0; i < 4; i++) {
        hash_matrix(hash, &parts[i]);
    }
}

static void call_rotations(DipHash *hash) {
    for (int i = 0; i < 60; i++) {
        const DipMatrix matrix = dip_matrix_rotation(i % 3, 0.125 * i - 3.0);
        hash_matrix(hash, &matrix);
    }
}

static void call_reflection(DipHash *hash) {
    const double normal[3] = {0.48, 0.6, 0.64};
    const DipMatrix matrix = dip_matrix_reflection(normal, 0.7);
    hash_matrix(hash, &matrix);
}

static void call_products(DipHash *hash) {
    const double point[4] = {0.1, 3.7, -1e-155, 1.1};
    double out[4];
    const DipMatrix two = dip_matrix_multiply(&some, &other);
    const DipMatrix three = dip_matrix_multiply3(&some, &other, &some);
    hash_matrix(hash, &two);
    hash_matrix(hash, &three);
    dip_matrix_apply(&some, point, out);
    dip_hash_bytes(hash, out, sizeof out);
}

static void call_floats(DipHash *hash) {
    hash_matrix(hash, &some);
}

static void call_inverses(DipHash *hash) {
    DipMatrix inverse;
    float normals[9], plane[4];
    assert_true(dip_matrix_invert(&inverse, &some, NULL));
    hash_matrix(hash, &inverse);
    assert_true(dip_matrix_normals(normals, &some, NULL));
    dip_hash_bytes(hash, normals, sizeof normals);
    assert_true(dip_matrix_clip_plane(&some, (const double[4]){0.1, 0.7, -0.3, 1.9}, plane, NULL));
    dip_hash_bytes(hash, plane, sizeof plane);
}

// --- shapes --------------------------------------------------------------------------------------

static void hash_shape(DipHash *hash, bool made, DipShape *shape) {
    const size_t floats = (size_t)shape->vertex_count * (size_t)shape->attribute_count;
    assert_true(made);
    dip_hash_bytes(hash, shape->attributes, floats * sizeof(float));
    dip_hash_bytes(hash, shape->indices, shape->index_count * sizeof(uint32_t));
    dip_shape_free(shape);
}

static void call_sphere(DipHash *hash) {
    DipShape shape;
    hash_shape(hash, dip_shape_sphere(&shape, 1.3f, 13, 7, NULL), &shape);
    hash_shape(hash, dip_shape_sphere(&shape, 1e-39f, 13, 7, NULL), &shape);
}

static void call_box(DipHash *hash) {
    DipShape shape;
    hash_shape(hash, dip_shape_box(&shape, (const float[3]){0.1f, 3.7f, 1e-39f}, NULL), &shape);
}

static void call_flat_shapes(DipHash *hash) {
    DipShape shape;
    hash_shape(hash, dip_shape_quad(&shape, 1.3f, 1e-39f, NULL), &shape);
    hash_shape(hash, dip_shape_plane(&shape, 1.3f, 0.7f, 7, 3, NULL), &shape);
}

static void call_prism(DipHash *hash) {
    DipShape shape;
    hash_shape(hash, dip_shape_prism(&shape, 1.3f, 0.7f, 11, true, NULL), &shape);
}

static void call_mesh_data(DipHash *hash) {
    DipShape shape;
    assert_true(dip_shape_sphere(&shape, 1.3f, 13, 7, NULL));
    const DipMeshData data = dip_shape_data(&shape, "shape");
    dip_hash_integer(hash, data.attribute_count);
    dip_shape_free(&shape);
}

// --- tessellation --------------------------------------------------------------------------------

static void call_tessellate(DipHash *hash) {
    static const float corners[5][3] = {
        {0.1f, 0.2f, 0.3f}, {1.7f, 0.3f, 1e-39f}, {1.1f, 3.3f, 0.7f}, {0.3f, 1.9f, 0.1f}};
    static const uint32_t indices[4] = {0, 1, 2, 3};
    for (int i = 0; i < 100 * DIP_DOMAIN_COUNT * DIP_PARTITIONING_COUNT; i++) {
        const float f = 1.0f + (float)(i * 7919 % 1000003) / 65536.0f;
        const float g = 1.0f + (float)(i * 5003 % 1000003) / 65536.0f;
        const DipTessellationFactors factor = {{f, g, f, g}, {g, f}};
        const DipDomain domain = i / 100 % DIP_DOMAIN_COUNT;
        const DipTessellationDef def = {.domain = domain,
                                        .partitioning = i / 100 / DIP_DOMAIN_COUNT,
                                        .attributes = &corners[0][0],
                                        .attribute_count = 3,
                                        .vertex_count = 4,
                                        .indices = indices,
                                        .index_count = domain == DIP_DOMAIN_QUAD ? 4 : 3,
                                        .factors = &factor,
                                        .function = dip_domain_linear,
                                        .out_attribute_count = 3};
        DipShape shape;
        hash_shape(hash, dip_tessellate(&shape, &def, NULL), &shape);
    }
}

// The domain function alone, as a caller's function may call it.
static void call_domain(DipHash *hash) {
    static const float corners[4][3] = {
        {0.1f, 0.2f, 0.3f}, {1.7f, 0.3f, 1e-39f}, {1.1f, 3.3f, 0.7f}, {0.3f, 1.9f, 0.1f}};
    static const float u[3] = {0.1f, 0.7f, 0.9f}, v[3] = {0.3f, 0.1f, 0.05f};
    static const float w[3] = {0.6f, 0.2f, 0.05f};
    for (int i = 0; i < 2; i++) {
        float out[9];
        const DipDomainBatch batch = {
            .count = 3,
            .control = {corners[0], corners[1], corners[2], i ? corners[3] : NULL},
            .u = u,
            .v = v,
            .w = i ? NULL : w,
            .out = out,
            .out_attribute_count = 3};
        dip_domain_linear(&batch);
        dip_hash_bytes(hash, out, sizeof out);
    }
}

// --- the test ------------------------------------------------------------------------------------

static const FpWalkEntry entries[] = {
    {"views", call_look_at},
    {"projections", call_projections},
    {"matrices without arithmetic", call_matrices},
    {"rotations", call_rotations},
    {"reflection", call_reflection},
    {"products", call_products},
    {"rounding a matrix", call_floats},
    {"inverses", call_inverses},
    {"sphere", call_sphere},
    {"box", call_box},
    {"quad and plane", call_flat_shapes},
    {"prism", call_prism},
    {"data of a mesh", call_mesh_data},
    {"tessellation", call_tessellate},
    {"domain function", call_domain},
};

int main(void) {
    return fp_walk_main(entries, sizeof entries / sizeof *entries, NULL, NULL);
}
