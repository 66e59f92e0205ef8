// Tests meshes that can be updated: an update gives the same mesh as making a new one, and a failed
// update changes nothing.
#include "renderer/pipeline/geometry/mesh_layout.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/catalogue/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { ATTRIBUTES = 6, VERTICES = 700, TRIANGLES = 3000, WIDTH = 96, HEIGHT = 64 };

static float attributes[VERTICES][ATTRIBUTES];
static uint32_t indices[3 * TRIANGLES];

static void random_attributes(Random *random) {
    for (int v = 0; v < VERTICES; v++) {
        for (int a = 0; a < ATTRIBUTES; a++) {
            attributes[v][a] = (float)random_real(random, -1.0, 1.0);
        }
    }
}

// Triangles of vertices that are mostly near each other in the list, so that chunks share some.
static void random_indices(Random *random) {
    for (int t = 0; t < TRIANGLES; t++) {
        const int near = t * (VERTICES - 40) / TRIANGLES;
        for (int k = 0; k < 3; k++) {
            indices[3 * t + k] =
                (uint32_t)(random_int(random, 0, 9) ? near + random_int(random, 0, 39)
                                                    : random_int(random, 0, VERTICES - 1));
        }
    }
}

static DipMeshData data_of(void) {
    return (DipMeshData){"test", &attributes[0][0], ATTRIBUTES, VERTICES, indices, 3 * TRIANGLES};
}

static void check_same(const DipMesh *found, const DipMesh *expected) {
    assert_int_equal(found->chunk_count, expected->chunk_count);
    assert_int_equal(found->vertex_total, expected->vertex_total);
    assert_memory_equal(found->chunks, expected->chunks,
                        expected->chunk_count * sizeof *expected->chunks);
    assert_memory_equal(found->attributes, expected->attributes,
                        (size_t)expected->vertex_total * ATTRIBUTES * sizeof(float));
    assert_memory_equal(found->groups, expected->groups,
                        (expected->chunk_count + DIP_GROUP_CHUNKS - 1) / DIP_GROUP_CHUNKS *
                            sizeof *expected->groups);
    assert_memory_equal(found->min, expected->min, sizeof found->min);
    assert_memory_equal(found->max, expected->max, sizeof found->max);
    const DipBox box = dip_mesh_box(found);
    const DipBox other = dip_mesh_box(expected);
    assert_memory_equal(&box, &other, sizeof box);
}

// Checks the triangles, the bounds and the chunks' boxes against the caller's arrays.
static void check_triangles(const DipMesh *mesh) {
    uint32_t triangle = 0;
    for (uint32_t c = 0; c < dip_mesh_chunk_count(mesh); c++) {
        const DipBox box = dip_mesh_chunk_box(mesh, c);
        for (uint32_t t = 0; t < dip_mesh_chunk_triangle_count(mesh, c); t++, triangle++) {
            float corners[3][3];
            dip_mesh_chunk_triangle(mesh, c, t, corners);
            for (int k = 0; k < 3; k++) {
                const float *source = attributes[indices[3 * triangle + (uint32_t)k]];
                assert_memory_equal(corners[k], source, sizeof corners[k]);
                for (int a = 0; a < 3; a++) {
                    assert_true(fabsf(source[a] - box.centre[a]) <= box.extent[a]);
                }
            }
        }
    }
    assert_int_equal(triangle, TRIANGLES);
    for (int a = 0; a < 3; a++) {
        float low = INFINITY;
        float high = -INFINITY;
        for (int i = 0; i < 3 * TRIANGLES; i++) {
            low = fminf(low, attributes[indices[i]][a]);
            high = fmaxf(high, attributes[indices[i]][a]);
        }
        float min[3];
        float max[3];
        dip_mesh_bounds(mesh, min, max);
        assert_true(min[a] == low && max[a] == high);
    }
}

static void an_update_equals_a_new_mesh(void **state) {
    (void)state;
    Random random = {1};
    for (int round = 0; round < 20; round++) {
        random_indices(&random);
        random_attributes(&random);
        const DipMeshData data = data_of();
        DipMesh *mesh = dip_mesh_create_updatable(&data, NULL);
        assert_non_null(mesh);
        check_triangles(mesh);
        for (int update = 0; update < 3; update++) {
            random_attributes(&random);
            assert_true(dip_mesh_update(mesh, &attributes[0][0], NULL));
            check_triangles(mesh);
            DipMesh *fresh = dip_mesh_create_updatable(&data, NULL);
            check_same(mesh, fresh);
            dip_mesh_destroy(&fresh);
        }
        // The chunks are those of a mesh that cannot be updated.
        DipMesh *fixed = dip_mesh_create(&data, NULL);
        check_same(mesh, fixed);
        assert_null(fixed->source);
        assert_int_equal(dip_mesh_bytes(mesh), dip_mesh_bytes(fixed) + 4 * mesh->vertex_total);
        dip_mesh_destroy(&fixed);
        dip_mesh_destroy(&mesh);
    }
}

static void triangles_that_may_fold_are_not_joined(void **state) {
    (void)state;
    Random random = {2};
    random_indices(&random);
    // All triangles lie in a plane, where a fixed mesh joins them.
    random_attributes(&random);
    for (int v = 0; v < VERTICES; v++) {
        attributes[v][2] = 0.0f;
    }
    const DipMeshData data = data_of();
    DipMesh *fixed = dip_mesh_create(&data, NULL);
    DipMesh *mesh = dip_mesh_create_updatable(&data, NULL);
    assert_true(fixed->patch_count < TRIANGLES);
    assert_int_equal(mesh->patch_count, TRIANGLES);
    for (uint32_t t = 0; t < TRIANGLES; t++) {
        assert_int_equal(mesh->patches[t], t);
    }
    dip_mesh_destroy(&fixed);
    dip_mesh_destroy(&mesh);
}

static void a_copy_can_be_updated_by_itself(void **state) {
    (void)state;
    Random random = {3};
    random_indices(&random);
    random_attributes(&random);
    const DipMeshData data = data_of();
    DipMesh *mesh = dip_mesh_create_updatable(&data, NULL);
    DipMesh *kept = dip_mesh_create_updatable(&data, NULL);
    DipMesh *copy = dip_mesh_copy(mesh);
    assert_int_equal(dip_mesh_bytes(copy), dip_mesh_bytes(mesh));
    random_attributes(&random);
    assert_true(dip_mesh_update(copy, &attributes[0][0], NULL));
    check_triangles(copy);
    check_same(mesh, kept);
    dip_mesh_destroy(&copy);
    dip_mesh_destroy(&kept);
    dip_mesh_destroy(&mesh);
}

static void refused_updates_change_nothing(void **state) {
    (void)state;
    Random random = {4};
    random_indices(&random);
    random_attributes(&random);
    const DipMeshData data = data_of();
    DipMesh *mesh = dip_mesh_create_updatable(&data, NULL);
    DipMesh *fixed = dip_mesh_create(&data, NULL);
    DipError err;
    assert_false(dip_mesh_update(fixed, &attributes[0][0], &err));
    assert_int_equal(err.code, DIP_ERROR_CONFLICT);
    assert_string_equal(err.key, "mesh");
    random_attributes(&random);
    attributes[VERTICES - 1][1] = NAN;
    assert_false(dip_mesh_update(mesh, &attributes[0][0], &err));
    assert_int_equal(err.code, DIP_ERROR_RANGE);
    assert_string_equal(err.key, "vertices");
    check_same(mesh, fixed);
    dip_mesh_destroy(&fixed);
    dip_mesh_destroy(&mesh);
}

// --- pictures ------------------------------------------------------------------------------------

static void vertex_shader(const DipVertexBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        for (int c = 0; c < 3; c++) {
            batch->clip[c][i] = c < 2 ? batch->in[c][i] : 0.5f + 0.4f * batch->in[c][i];
            batch->varying[c][i] = 0.5f + 0.5f * batch->in[3 + c][i];
        }
        batch->clip[3][i] = 1.0f;
    }
}

static void fragment_shader(DipFragmentBatch *batch) {
    for (int c = 0; c < 3; c++) {
        memcpy(batch->colour[c], batch->varying[c], sizeof batch->colour[c]);
    }
}

static void draw(DipPipeline *pipeline, const DipMesh *mesh, uint8_t *picture) {
    const DipDraw of_mesh = {.mesh = mesh,
                             .vertex_shader = vertex_shader,
                             .fragment_shader = fragment_shader,
                             .varying_count = 3};
    const DipPass pass = {
        .draws = &of_mesh,
        .draw_count = 1,
        .sample_count = 4,
        .target = {
            .rgba8 = picture, .stride_bytes = (size_t)WIDTH * 4, .width = WIDTH, .height = HEIGHT}};
    DipPipelineCounters counters = {0};
    DipStageTimes times = {0};
    assert_true(dip_pipeline_draw(pipeline, &pass, &counters, &times, NULL));
}

static void an_updated_mesh_draws_the_picture_of_a_new_one(void **state) {
    (void)state;
    static uint8_t found[WIDTH * HEIGHT * 4];
    static uint8_t expected[WIDTH * HEIGHT * 4];
    static uint8_t before[WIDTH * HEIGHT * 4];
    Random random = {5};
    random_indices(&random);
    random_attributes(&random);
    DipPool *pool = dip_pool_create(2, NULL);
    DipPipeline *pipeline = dip_pipeline_create(pool, dip_isa_best(), WIDTH, HEIGHT, NULL);
    const DipMeshData data = data_of();
    DipMesh *mesh = dip_mesh_create_updatable(&data, NULL);
    draw(pipeline, mesh, before);
    for (int round = 0; round < 4; round++) {
        random_attributes(&random);
        assert_true(dip_mesh_update(mesh, &attributes[0][0], NULL));
        DipMesh *fresh = dip_mesh_create_updatable(&data, NULL);
        draw(pipeline, mesh, found);
        draw(pipeline, fresh, expected);
        assert_memory_equal(found, expected, sizeof found);
        assert_memory_not_equal(found, before, sizeof found);
        dip_mesh_destroy(&fresh);
    }
    dip_mesh_destroy(&mesh);
    dip_pipeline_destroy(&pipeline);
    dip_pool_destroy(&pool);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_update_equals_a_new_mesh),
        cmocka_unit_test(triangles_that_may_fold_are_not_joined),
        cmocka_unit_test(a_copy_can_be_updated_by_itself),
        cmocka_unit_test(refused_updates_change_nothing),
        cmocka_unit_test(an_updated_mesh_draws_the_picture_of_a_new_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
