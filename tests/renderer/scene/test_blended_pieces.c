// Tests how blended meshes are cut into pieces. The truth colours triangles: a triangle takes the
// least colour of those that have a corner at the same position, until nothing changes.
#include "renderer/catalogue/random.h"
#include "renderer/scene/motion.h"
#include "renderer/scene/resources/blended_pieces.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { MESHES = 3, MOST_VERTICES = 960, MOST_TRIANGLES = 320, MOST_OBJECTS = 128 };

// One vertex of a mesh with all its attributes: 14 floats.
typedef struct Vertex {
    float position[3], normal[3], uv0[2], uv1[2], colour[3], alpha;
} Vertex;

static float positions[MESHES][3 * MOST_VERTICES], normals[MESHES][3 * MOST_VERTICES];
static float uv0[MESHES][2 * MOST_VERTICES], uv1[MESHES][2 * MOST_VERTICES];
static float colours[MESHES][3 * MOST_VERTICES], alphas[MESHES][MOST_VERTICES];
static uint32_t indices[MESHES][3 * MOST_TRIANGLES];
static DipMaterialDef materials[2];
static DipMeshDef meshes[MESHES];
static DipObjectDef objects[MOST_OBJECTS];
static DipSceneDef def;

// Begins a description whose material 0 is opaque, and material 1 blended.
static void begin(void) {
    memset(materials, 0, sizeof materials);
    materials[1].surface = DIP_SURFACE_BLENDED;
    def = (DipSceneDef){
        .materials = materials, .material_count = 2, .meshes = meshes, .objects = objects};
}

// Adds a mesh whose attributes are all different. Each bit of `arrays` stands
// for one of the arrays that a mesh may lack.
static DipMeshDef *add_mesh(uint32_t vertex_count, uint32_t triangle_count, int arrays) {
    const int m = def.mesh_count++;
    for (uint32_t i = 0; i < 3 * MOST_VERTICES; i++) {
        const float value = (float)(m * 100000) + (float)i;
        positions[m][i] = value;
        normals[m][i] = value + 0.125f;
        colours[m][i] = value + 0.25f;
        uv0[m][i % (2 * MOST_VERTICES)] = value + 0.375f;
        uv1[m][i % (2 * MOST_VERTICES)] = value + 0.5f;
        alphas[m][i % MOST_VERTICES] = value + 0.625f;
    }
    for (uint32_t i = 0; i < 3 * triangle_count; i++) {
        indices[m][i] = i % vertex_count;
    }
    meshes[m] = (DipMeshDef){.name = "glass",
                             .vertex_count = vertex_count,
                             .positions = positions[m],
                             .normals = arrays & 1 ? normals[m] : NULL,
                             .uv0 = arrays & 2 ? uv0[m] : NULL,
                             .uv1 = arrays & 4 ? uv1[m] : NULL,
                             .colours_lin = arrays & 8 ? colours[m] : NULL,
                             .alphas = arrays & 16 ? alphas[m] : NULL,
                             .index_count = 3 * triangle_count,
                             .indices = indices[m],
                             .material = 1};
    return &meshes[m];
}

static void add_objects(int mesh, int count) {
    for (int i = 0; i < count; i++) {
        DipObjectDef *object = &objects[def.object_count];
        *object = (DipObjectDef){.name = "pane", .mesh = mesh};
        object->transform[3] = (float)def.object_count++;
    }
}

static void copy_or_zero(float *to, const float *from, size_t index, size_t width) {
    for (size_t i = 0; i < width; i++) {
        to[i] = from ? from[width * index + i] : 0.0f;
    }
}

static Vertex corner_of(const DipMeshDef *mesh, uint32_t corner) {
    Vertex v;
    const size_t index = mesh->indices[corner];
    assert_true(index < mesh->vertex_count);
    copy_or_zero(v.position, mesh->positions, index, 3);
    copy_or_zero(v.normal, mesh->normals, index, 3);
    copy_or_zero(v.uv0, mesh->uv0, index, 2);
    copy_or_zero(v.uv1, mesh->uv1, index, 2);
    copy_or_zero(v.colour, mesh->colours_lin, index, 3);
    copy_or_zero(&v.alpha, mesh->alphas, index, 1);
    return v;
}

static bool touch(const DipMeshDef *mesh, uint32_t a, uint32_t b) {
    for (uint32_t i = 0; i < 9; i++) {
        const Vertex p = corner_of(mesh, 3 * a + i / 3), q = corner_of(mesh, 3 * b + i % 3);
        if (p.position[0] == q.position[0] && p.position[1] == q.position[1] &&
            p.position[2] == q.position[2]) {
            return true;
        }
    }
    return false;
}

// Finds the piece of each triangle, numbered by their first triangles. Returns how many there are.
static int colour_triangles(const DipMeshDef *mesh, int piece[MOST_TRIANGLES]) {
    const uint32_t count = mesh->index_count / 3;
    for (uint32_t t = 0; t < count; t++) {
        piece[t] = (int)t;
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (uint32_t a = 0; a < count; a++) {
            for (uint32_t b = 0; b < count; b++) {
                if (piece[b] < piece[a] && touch(mesh, a, b)) {
                    piece[a] = piece[b];
                    changed = true;
                }
            }
        }
    }
    int found = 0, number[MOST_TRIANGLES];
    for (uint32_t t = 0; t < count; t++) {
        number[t] = piece[t] == (int)t ? found++ : -1;
    }
    for (uint32_t t = 0; t < count; t++) {
        piece[t] = number[piece[t]];
    }
    return found;
}

// Checks that the pieces of mesh m have its triangles, in their order. `most`: the greatest number
// of pieces. added: the index of the second piece. Returns the number of pieces.
static int check_mesh(const DipSceneDef *cut, int m, int most, int added) {
    int piece[MOST_TRIANGLES];
    uint32_t used[MOST_TRIANGLES] = {0};
    const int found = colour_triangles(&meshes[m], piece);
    const int count = found < most ? found : most;
    for (uint32_t t = 0; t < meshes[m].index_count / 3; t++) {
        const int p = piece[t] * count / found;
        const DipMeshDef *out = &cut->meshes[p ? added + p - 1 : m];
        assert_true(3 * used[p] < out->index_count);
        for (uint32_t c = 0; c < 3; c++) {
            const Vertex a = corner_of(&meshes[m], 3 * t + c), b = corner_of(out, 3 * used[p] + c);
            assert_memory_equal(&a, &b, sizeof a);
        }
        used[p]++;
    }
    for (int p = 0; p < count; p++) {
        const DipMeshDef *out = &cut->meshes[p ? added + p - 1 : m];
        assert_int_equal(out->index_count, 3 * used[p]);
        assert_int_equal(out->material, meshes[m].material);
        assert_string_equal(out->name, "glass");
        assert_true(!out->normals == !meshes[m].normals && !out->uv0 == !meshes[m].uv0);
        assert_true(!out->uv1 == !meshes[m].uv1 && !out->alphas == !meshes[m].alphas);
        assert_true(!out->colours_lin == !meshes[m].colours_lin);
    }
    return count;
}

static bool is_moved(int object) {
    for (int i = 0; def.motion && i < def.motion->object_count; i++) {
        if (def.motion->objects[i].object == object) {
            return true;
        }
    }
    return false;
}

// Cuts the description and checks all that becomes of it. most[m]: the greatest number of pieces of
// mesh m. Returns the number of meshes.
static int check_cut(const int most[MESHES]) {
    DipCutScene *scene = NULL;
    int count[MESHES], first[MESHES];
    assert_true(dip_blended_cut(&def, &scene, NULL));
    if (!scene) {
        return def.mesh_count;
    }
    const DipSceneDef *cut = dip_cut_scene_def(scene);
    int mesh_count = def.mesh_count;
    for (int m = 0; m < def.mesh_count; m++) {
        first[m] = mesh_count;
        count[m] = check_mesh(cut, m, most[m], mesh_count);
        mesh_count += count[m] - 1;
    }
    assert_int_equal(cut->mesh_count, mesh_count);
    int added = def.object_count, moving = def.motion ? def.motion->object_count : 0;
    for (int i = 0; i < def.object_count; i++) {
        assert_memory_equal(&cut->objects[i], &objects[i], sizeof objects[i]);
        for (int p = 1; p < count[objects[i].mesh]; p++, added++) {
            assert_int_equal(cut->objects[added].mesh, first[objects[i].mesh] + p - 1);
            assert_true(cut->objects[added].transform[3] == (float)i);
            if (is_moved(i)) {
                assert_int_equal(cut->motion->objects[moving].object, added);
                assert_int_equal(cut->motion->objects[moving++].node, 100 + i);
            }
        }
    }
    assert_int_equal(cut->object_count, added);
    assert_true(!def.motion || cut->motion->object_count == moving);
    dip_cut_scene_destroy(&scene);
    assert_null(scene);
    return mesh_count;
}

// Corners on a coarse grid fall on one another, with equal vertices and with others at the same
// place.
static void pieces_are_what_hangs_together(void **state) {
    (void)state;
    static const int most[MESHES] = {256, 256, 256};
    Random random = {12};
    int cut = 0;
    for (int i = 0; i < 400; i++) {
        begin();
        for (int m = 0; m < MESHES; m++) {
            const uint32_t triangles = (uint32_t)random_int(&random, 2, 14);
            const uint32_t vertices = (uint32_t)random_int(&random, 3, 40);
            add_mesh(vertices, triangles, random_int(&random, 0, 31));
            for (uint32_t v = 0; v < 3 * vertices; v++) {
                positions[m][v] = (float)random_int(&random, -2, 2);
            }
            for (uint32_t k = 0; k < 3 * triangles; k++) {
                indices[m][k] = (uint32_t)random_int(&random, 0, (int)vertices - 1);
            }
        }
        add_objects(2, 2);
        add_objects(0, 1 + i % 3);
        add_objects(1, 1);
        add_objects(0, 1);
        cut += check_cut(most) > MESHES;
    }
    assert_true(cut > 100);
}

// 300 loose triangles become 256 pieces, in which neighbours stay together.
static void a_mesh_has_at_most_256_pieces(void **state) {
    (void)state;
    static const int most[MESHES] = {256, 256, 256};
    begin();
    add_mesh(3 * 300, 300, 31);
    add_mesh(3 * 256, 256, 0);
    add_objects(0, 1);
    add_objects(1, 1);
    assert_int_equal(check_cut(most), 2 + 255 + 255);
}

// Cutting adds at most 4096 objects. A mesh of 100 objects may have 41 pieces, for 4000 objects.
// The 96 that are left are enough for 13 pieces of a mesh of 8 objects, and none are left then.
static void cutting_adds_at_most_4096_objects(void **state) {
    (void)state;
    static const int most[MESHES] = {41, 13, 1};
    begin();
    for (int m = 0; m < MESHES; m++) {
        add_mesh(3 * 50, 50, 31);
        add_objects(m, m == 0 ? 100 : 8);
    }
    assert_int_equal(check_cut(most), MESHES + 40 + 12);
}

static void meshes_that_are_not_blended_stay_whole(void **state) {
    (void)state;
    begin();
    DipMeshDef *mesh = add_mesh(6, 2, 31);
    add_objects(0, 1);
    assert_int_equal(check_cut((const int[MESHES]){256}), 2);
    mesh->material = 0;
    assert_int_equal(check_cut((const int[MESHES]){256}), 1);
    mesh->material = 1;
    mesh->index_count = 3; // a single triangle
    assert_int_equal(check_cut((const int[MESHES]){256}), 1);
}

// Such a mesh cannot be made, and the fault is told when it is.
static void meshes_with_a_fault_stay_whole(void **state) {
    (void)state;
    static const int most[MESHES] = {256};
    begin();
    DipMeshDef *mesh = add_mesh(6, 2, 31);
    add_objects(0, 1);
    for (uint32_t i = 0; i < 6; i++) {
        indices[0][i] = 6;
        assert_int_equal(check_cut(most), 1);
        indices[0][i] = i;
    }
    for (int i = 0; i < 18; i++) {
        const float before = positions[0][i];
        positions[0][i] = i % 2 ? NAN : INFINITY;
        assert_int_equal(check_cut(most), 1);
        positions[0][i] = before;
    }
    positions[0][18] = NAN; // behind the last vertex
    assert_int_equal(check_cut(most), 2);
    mesh->index_count = 5;
    assert_int_equal(check_cut(most), 1);
}

// The objects of the pieces move as the objects do that are cut. A mesh that changes its shape is
// not cut.
static void pieces_move_with_their_objects(void **state) {
    (void)state;
    static const int most[MESHES] = {256, 256, 1};
    begin();
    for (int m = 0; m < MESHES; m++) {
        add_mesh(9, 3, 3);
    }
    for (int i = 0; i < 9; i++) {
        add_objects(i % MESHES, 1);
    }
    static const int moved[] = {0, 3, 4, 5, 8};
    enum { MOVED = sizeof moved / sizeof *moved };
    DipMovingObject moving[MOVED];
    const DipMovingMesh bent = {.mesh = 2};
    for (int i = 0; i < MOVED; i++) {
        moving[i] = (DipMovingObject){.object = moved[i], .node = 100 + moved[i]};
    }
    const DipMotionDef motion = {
        .objects = moving, .object_count = MOVED, .meshes = &bent, .mesh_count = 1};
    def.motion = &motion;
    DipCutScene *scene = NULL;
    assert_true(dip_blended_cut(&def, &scene, NULL));
    const DipSceneDef *cut = dip_cut_scene_def(scene);
    assert_memory_equal(&cut->meshes[2], &meshes[2], sizeof meshes[2]);
    assert_memory_equal(cut->motion->objects, moving, sizeof moving);
    assert_true(cut->motion->meshes == &bent && cut->motion->mesh_count == 1);
    dip_cut_scene_destroy(&scene);
    assert_int_equal(check_cut(most), MESHES + 2 + 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pieces_are_what_hangs_together),
        cmocka_unit_test(a_mesh_has_at_most_256_pieces),
        cmocka_unit_test(cutting_adds_at_most_4096_objects),
        cmocka_unit_test(meshes_that_are_not_blended_stay_whole),
        cmocka_unit_test(meshes_with_a_fault_stay_whole),
        cmocka_unit_test(pieces_move_with_their_objects),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
