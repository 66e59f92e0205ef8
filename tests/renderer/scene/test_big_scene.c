// Draws a million triangles. Any number of threads must give the same picture. The memory must
// depend on the triangles in view. Triangles out of view must cost almost nothing.
#include "renderer/scene/renderer.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include <cmocka.h>

enum { SIDE = 708, TRIANGLES = 2 * SIDE * SIDE, MOST_MIB = 600 };

// Makes a square with sides of 20 m in front of a camera at the origin, with waves in depth.
static DipScene *make_scene(void) {
    float *positions = malloc(sizeof(float) * 3 * (SIDE + 1) * (SIDE + 1));
    float *colours = malloc(sizeof(float) * 3 * (SIDE + 1) * (SIDE + 1));
    uint32_t *indices = malloc(sizeof(uint32_t) * 3 * TRIANGLES);
    assert_true(positions && colours && indices);
    uint32_t *index = indices;
    for (uint32_t j = 0; j <= SIDE; j++) {
        for (uint32_t i = 0; i <= SIDE; i++) {
            const uint32_t at = j * (SIDE + 1) + i;
            const float depth = -10.0f - 0.001f * (float)((i * i + 3 * j * j) % 997);
            const float position[3] = {20.0f * (float)i / SIDE - 10.0f,
                                       20.0f * (float)j / SIDE - 10.0f, depth};
            const float colour[3] = {(float)i / SIDE, (float)j / SIDE, 0.5f};
            memcpy(positions + 3 * (size_t)at, position, sizeof position);
            memcpy(colours + 3 * (size_t)at, colour, sizeof colour);
            if (i < SIDE && j < SIDE) {
                const uint32_t above = at + SIDE + 1;
                const uint32_t cell[6] = {at, at + 1, above + 1, at, above + 1, above};
                memcpy(index, cell, sizeof cell);
                index += 6;
            }
        }
    }
    const DipMaterialDef material = {.name = "plain",
                                     .base_colour_lin = {1.0f, 1.0f, 1.0f},
                                     .colour_texture = DIP_NO_TEXTURE,
                                     .light_map = DIP_NO_TEXTURE,
                                     .normal_map = DIP_NO_TEXTURE,
                                     .light_map_scale = 1.0f,
                                     .double_sided = true};
    const DipMeshDef mesh = {.name = "grid",
                             .vertex_count = (SIDE + 1) * (SIDE + 1),
                             .positions = positions,
                             .colours_lin = colours,
                             .index_count = 3 * TRIANGLES,
                             .indices = indices};
    const DipObjectDef object = {.name = "grid", .transform = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};
    const DipSceneDef def = {.materials = &material,
                             .meshes = &mesh,
                             .objects = &object,
                             .material_count = 1,
                             .mesh_count = 1,
                             .object_count = 1,
                             .near_m = 0.1f};
    DipScene *scene = dip_scene_create(&def, NULL, NULL);
    assert_non_null(scene);
    free(positions);
    free(colours);
    free(indices);
    return scene;
}

typedef enum View { AHEAD, ASIDE, BEHIND, VIEWS } View;

static const DipPose poses[VIEWS] = {
    {.orientation = {0, 0, 0, 1}, .fov_y_deg = 100.0},
    {.orientation = {0, 0.6, 0, 0.8}, .fov_y_deg = 60.0},
    {.orientation = {0, 1, 0, 0}, .fov_y_deg = 100.0},
};

typedef struct Drawn {
    char hash[VIEWS][33];
    DipCounters counters[VIEWS];
    double geometry_ms[VIEWS];
} Drawn;

static Drawn draw(const DipScene *scene, int threads) {
    Drawn drawn;
    DipPool *pool = dip_pool_create(threads, NULL);
    DipRendererDef def = dip_renderer_default_def();
    def.pool = pool;
    DipRenderer *renderer = dip_renderer_create(&def, NULL);
    assert_non_null(renderer);
    for (int view = 0; view < VIEWS; view++) {
        DipFrame frame;
        assert_true(dip_renderer_draw(renderer, scene, &poses[view], 0, &frame, NULL));
        dip_frame_hash(&frame, drawn.hash[view]);
        drawn.counters[view] = frame.counters;
        drawn.geometry_ms[view] = frame.stages.geometry_ms;
    }
    dip_renderer_destroy(&renderer);
    dip_pool_destroy(&pool);
    return drawn;
}

static void a_million_triangles_draw_alike_and_cost_little_out_of_view(void **state) {
    (void)state;
    DipScene *scene = make_scene();
    const Drawn one = draw(scene, 1);
    const Drawn three = draw(scene, 3);
    assert_memory_equal(one.hash, three.hash, sizeof one.hash);
    assert_memory_equal(one.counters, three.counters, sizeof one.counters);
    assert_int_equal(one.counters[AHEAD].triangles_in, TRIANGLES);
    assert_in_range(one.counters[ASIDE].triangles_in, TRIANGLES / 20, TRIANGLES / 2);
    assert_int_equal(one.counters[BEHIND].triangles_in, 0);
    assert_true(one.geometry_ms[BEHIND] < 0.05 * one.geometry_ms[AHEAD]);
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    assert_in_range(usage.ru_maxrss / 1024, 1, MOST_MIB);
    dip_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_million_triangles_draw_alike_and_cost_little_out_of_view)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
