// The ground below models: where it is added, and its shade, against scenes whose result is known.
#include "app/session/ground.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { GRID = 256 };

// A box of 12 triangles, whose faces point outwards.
typedef struct Box {
    float positions[8][3];
} Box;

static const uint32_t box_indices[36] = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                                         2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};

static Box box_of(const float low[3], const float high[3]) {
    Box box;
    for (int corner = 0; corner < 8; corner++) {
        // Bit 0 is z, bit 1 is y and bit 2 is x.
        box.positions[corner][0] = corner & 4 ? high[0] : low[0];
        box.positions[corner][1] = corner & 2 ? high[1] : low[1];
        box.positions[corner][2] = corner & 1 ? high[2] : low[2];
    }
    return box;
}

// A scene of up to two boxes with one material.
typedef struct Scene {
    DipSceneDef def;
    DipMaterialDef material;
    Box boxes[2];
    DipMeshDef meshes[2];
    DipObjectDef objects[2];
} Scene;

static void add_box(Scene *scene, float x0, float y0, float z0, float x1, float y1, float z1) {
    const int index = scene->def.object_count;
    scene->boxes[index] = box_of((const float[]){x0, y0, z0}, (const float[]){x1, y1, z1});
    scene->meshes[index] = (DipMeshDef){.name = "box",
                                        .vertex_count = 8,
                                        .positions = scene->boxes[index].positions[0],
                                        .index_count = 36,
                                        .indices = box_indices};
    scene->objects[index] = (DipObjectDef){
        .name = "box", .mesh = index, .transform = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};
    scene->material = (DipMaterialDef){.name = "grey",
                                       .base_colour_lin = {0.2f, 0.2f, 0.2f},
                                       .colour_texture = DIP_NO_TEXTURE,
                                       .light_map = DIP_NO_TEXTURE,
                                       .normal_map = DIP_NO_TEXTURE};
    scene->def = (DipSceneDef){.materials = &scene->material,
                               .meshes = scene->meshes,
                               .objects = scene->objects,
                               .material_count = 1,
                               .mesh_count = index + 1,
                               .object_count = index + 1,
                               .background_lin = {0.4f, 0.5f, 0.6f},
                               .near_m = 0.1f};
}

static bool is_missing(const Scene *scene) {
    const DipExtent extent = dip_extent_of(&scene->def);
    return dip_ground_is_missing(&scene->def, &extent);
}

static void the_extent_follows_the_transform(void **state) {
    (void)state;
    static Scene scene;
    add_box(&scene, -1, -2, -3, 1, 2, 3);
    const float transform[12] = {0, 0, 2, 10, 0, 1, 0, 20, -1, 0, 0, 30};
    memcpy(scene.objects[0].transform, transform, sizeof transform);
    const DipExtent extent = dip_extent_of(&scene.def);
    const double low[3] = {4, 18, 29};
    const double high[3] = {16, 22, 31};
    for (int i = 0; i < 3; i++) {
        assert_float_equal(extent.low[i], low[i], 0.0);
        assert_float_equal(extent.high[i], high[i], 0.0);
    }
    // All corners lie in the lowest and the highest slice, as far from the axis as a corner.
    const DipSilhouette silhouette = dip_silhouette_of(&scene.def, &extent);
    for (int i = 0; i < DIP_SILHOUETTE_SLICES; i++) {
        const bool end = i == 0 || i == DIP_SILHOUETTE_SLICES - 1;
        assert_float_equal(silhouette.radius[i], end ? sqrt(6.0 * 6.0 + 1.0) : -1.0, 1e-12);
    }
}

static void objects_in_empty_space_need_a_ground(void **state) {
    (void)state;
    static Scene box, flat, floor, bench, water, far;
    add_box(&box, -1, 0, -1, 1, 2, 1);
    assert_true(is_missing(&box));
    add_box(&flat, -1, 0, -1, 1, 0.05f, 1);
    assert_false(is_missing(&flat));
    // A box on a floor that is three times as wide, and on one that is hardly wider.
    add_box(&floor, -3, -0.01f, -3, 3, 0, 3);
    add_box(&floor, -1, 0, -1, 1, 2, 1);
    assert_false(is_missing(&floor));
    add_box(&bench, -1, 1, -1, 1, 1.2f, 1);
    add_box(&bench, -0.9f, 0, -0.9f, -0.8f, 1, -0.8f);
    assert_true(is_missing(&bench));
    add_box(&water, -1, 0, -1, 1, 2, 1);
    water.material.surface = DIP_SURFACE_WATER;
    assert_false(is_missing(&water));
    add_box(&far, -1, 1e5f, -1, 1, 1e5f + 2, 1);
    assert_false(is_missing(&far));
    assert_false(is_missing(&(Scene){.def = {.near_m = 0.1f}}));
}

static int shade_at(const DipAddedSurface *ground, double x, double z) {
    const float *low = ground->positions + 9;
    const float *high = ground->positions + 3;
    const int column = (int)((x - low[0]) / (high[0] - low[0]) * GRID);
    const int row = (int)((z - low[2]) / (high[2] - low[2]) * GRID);
    return ground->rgba8[4 * (GRID * row + column)];
}

// The shade is darkest below the box, fades with the distance and is gone at the border. A box at
// the other side of the same ground leaves the mirrored shade.
static void the_shade_lies_below_the_model(void **state) {
    (void)state;
    static Scene scene;
    add_box(&scene, -1, 0, -0.5f, 1, 1, 0.5f);
    const DipExtent extent = dip_extent_of(&scene.def);
    DipAddedSurface *ground = dip_ground_create(&scene.def, &extent, NULL);
    assert_non_null(ground);
    int last = shade_at(ground, 0, 0);
    assert_true(last < 90);
    for (double x = 0.9; x < 2.2; x += 0.15) {
        const int shade = shade_at(ground, x, 0);
        assert_true(shade >= last);
        last = shade;
    }
    assert_true(shade_at(ground, 1.05, 0) < 190);
    for (int i = 0; i < GRID; i++) {
        const uint8_t *s = ground->rgba8;
        assert_int_equal(s[4 * i], 255);
        assert_int_equal(s[4 * (GRID * (GRID - 1) + i)], 255);
        assert_int_equal(s[4 * (GRID * i)], 255);
        assert_int_equal(s[4 * (GRID * i + GRID - 1)], 255);
    }
    for (int i = 0; i < GRID * GRID; i++) {
        const int mirrored = GRID * (i / GRID) + GRID - 1 - i % GRID;
        assert_in_range(ground->rgba8[4 * i] - ground->rgba8[4 * mirrored] + 2, 0, 4);
    }
    dip_added_surface_destroy(&ground);
    assert_null(ground);
}

// What hovers leaves a fainter shade than what stands.
static void height_makes_the_shade_faint(void **state) {
    (void)state;
    int last = -1;
    for (int step = 0; step < 4; step++) {
        static Scene scene;
        memset(&scene, 0, sizeof scene);
        add_box(&scene, -0.05f, 0, -0.05f, 0.05f, 1.5f, 0.05f);
        add_box(&scene, 0.2f, 0.2f * (float)step, -0.5f, 1.2f, 1.5f, 0.5f);
        const DipExtent extent = dip_extent_of(&scene.def);
        DipAddedSurface *ground = dip_ground_create(&scene.def, &extent, NULL);
        assert_non_null(ground);
        const int shade = shade_at(ground, 0.7, 0);
        assert_true(shade > last);
        last = shade;
        dip_added_surface_destroy(&ground);
    }
}

// The ground is added at the end and changes nothing before it. Its material has the colour of the
// background.
static void the_scene_keeps_its_parts(void **state) {
    (void)state;
    static Scene scene;
    add_box(&scene, -1, 3, -1, 1, 4, 1);
    const DipExtent extent = dip_extent_of(&scene.def);
    DipAddedSurface *ground = dip_ground_create(&scene.def, &extent, NULL);
    assert_non_null(ground);
    assert_int_equal(ground->def.object_count, 2);
    assert_memory_equal(ground->def.objects, scene.objects, sizeof *scene.objects);
    const DipMeshDef *mesh = &ground->def.meshes[ground->def.objects[1].mesh];
    const DipMaterialDef *material = &ground->def.materials[mesh->material];
    assert_memory_equal(material->base_colour_lin, scene.def.background_lin,
                        sizeof material->base_colour_lin);
    assert_false(material->lit);
    for (int i = 0; i < 4; i++) {
        assert_true(mesh->positions[3 * i + 1] < 3.0f && mesh->positions[3 * i + 1] > 2.99f);
    }
    DipError err = {0};
    DipScene *made = dip_scene_create(&ground->def, NULL, &err);
    assert_non_null(made);
    dip_scene_destroy(&made);
    dip_added_surface_destroy(&ground);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_extent_follows_the_transform),
        cmocka_unit_test(objects_in_empty_space_need_a_ground),
        cmocka_unit_test(the_shade_lies_below_the_model),
        cmocka_unit_test(height_makes_the_shade_faint),
        cmocka_unit_test(the_scene_keeps_its_parts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
