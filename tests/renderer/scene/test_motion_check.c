// Tests which motions a scene may have: each index, count and number of motion.h and rig.h is
// accepted up to its limits and refused beyond them, and the message names what it belongs to. Also
// tests the copy of a motion, and when a motion plays.
#include "renderer/scene/motion.h"
#include "renderer/scene/scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { NODES = 3, WEIGHTS = 3, JOINTS = 2, KEYS = 3, TRACKS = 4, VERTICES = 3, SHAPES = 3 };

// Two rigs, objects and meshes. Behind their last number, arrays have one that is not acceptable,
// so that a check must not read on.
typedef struct Motion {
    DipRigNode nodes[2][NODES];
    float rest_weights[2][WEIGHTS + 1];
    int joint_nodes[2][2][JOINTS];
    double inverse_binds[2][2][12 * JOINTS + 1];
    DipRigSkin skins[2][2];
    float times[2][TRACKS][KEYS + 1];
    float values[2][TRACKS][3 * 4 * KEYS + 1];
    DipTrack tracks[2][TRACKS];
    DipMotionRig rigs[2];
    DipMovingObject objects[2];
    float positions[2][3 * VERTICES * SHAPES + 1];
    float normals[2][3 * VERTICES * SHAPES + 1];
    uint16_t joints[2][4 * VERTICES + 1];
    float joint_weights[2][4 * VERTICES + 1];
    float boxes[2][6 + 1];
    DipMovingMesh meshes[2];
    DipMotionDef def;
    uint32_t indices[VERTICES];
    float still_normals[3 * VERTICES];
    DipMeshDef mesh_defs[2];
    DipObjectDef object_defs[2];
    DipSceneDef scene;
} Motion;

static Motion made;

static void fill(float *numbers, int count) {
    for (int i = 0; i < count; i++) {
        numbers[i] = (float)i + 0.5f;
    }
    numbers[count] = NAN;
}

static void fill_doubles(double *numbers, int count) {
    for (int i = 0; i < count; i++) {
        numbers[i] = i + 0.25;
    }
}

static void make_tracks(Motion *motion, int r) {
    static const DipTrack kinds[TRACKS] = {
        {.target = DIP_TRACK_TRANSLATION, .interpolation = DIP_INTERPOLATION_LINEAR, .width = 3},
        {.target = DIP_TRACK_ROTATION, .interpolation = DIP_INTERPOLATION_CUBICSPLINE, .width = 4},
        {.target = DIP_TRACK_SCALE, .interpolation = DIP_INTERPOLATION_STEP, .width = 3},
        {.target = DIP_TRACK_WEIGHTS, .interpolation = DIP_INTERPOLATION_LINEAR, .width = 2}};
    for (int t = 0; t < TRACKS; t++) {
        DipTrack *track = &motion->tracks[r][t];
        *track = kinds[t];
        track->key_count = KEYS;
        track->times = motion->times[r][t];
        track->values = motion->values[r][t];
        fill(motion->times[r][t], KEYS);
        fill(motion->values[r][t], (t == 1 ? 3 : 1) * track->width * KEYS);
    }
}

static void make_rig(Motion *motion, int r) {
    static const int first_weights[NODES] = {0, 2, 3}, weight_counts[NODES] = {2, 1, 0};
    for (int n = 0; n < NODES; n++) {
        DipRigNode *node = &motion->nodes[r][n];
        node->parent = n - 1;
        fill_doubles(node->matrix, 12);
        fill_doubles(node->translation, 3);
        fill_doubles(node->rotation, 4);
        fill_doubles(node->scale, 3);
        node->first_weight = first_weights[n];
        node->weight_count = weight_counts[n];
    }
    for (int s = 0; s < 2; s++) {
        motion->joint_nodes[r][s][0] = s;
        motion->joint_nodes[r][s][1] = 2;
        fill_doubles(motion->inverse_binds[r][s], 12 * JOINTS);
        motion->inverse_binds[r][s][12 * JOINTS] = (double)NAN;
        motion->skins[r][s] =
            (DipRigSkin){JOINTS, motion->joint_nodes[r][s], motion->inverse_binds[r][s]};
    }
    fill(motion->rest_weights[r], WEIGHTS);
    make_tracks(motion, r);
    motion->rigs[r] =
        (DipMotionRig){.clip = r ? "walk" : "a longer name",
                       .duration_s = 2.0,
                       .rig = {motion->nodes[r], NODES, motion->rest_weights[r], WEIGHTS},
                       .skins = motion->skins[r],
                       .skin_count = 2,
                       .tracks = motion->tracks[r],
                       .track_count = TRACKS};
    fill_doubles(motion->rigs[r].root, 12);
}

// Mesh 0 has the joints of a skin, mesh 1 has none; both have all shapes of their node.
static void make_mesh(Motion *motion, int m) {
    fill(motion->positions[m], 3 * VERTICES * SHAPES);
    fill(motion->normals[m], 3 * VERTICES * SHAPES);
    fill(motion->joint_weights[m], 4 * VERTICES);
    fill(motion->boxes[m], 6);
    for (int i = 0; i < 4 * VERTICES; i++) {
        motion->joints[m][i] = (uint16_t)(i % JOINTS);
    }
    motion->joints[m][4 * VERTICES] = UINT16_MAX;
    motion->meshes[m] = (DipMovingMesh){.mesh = m,
                                        .rig = m,
                                        .node = 0,
                                        .skin = m ? DIP_NO_SKIN : 1,
                                        .vertex_count = VERTICES,
                                        .shape_count = SHAPES,
                                        .positions = motion->positions[m],
                                        .normals = motion->normals[m],
                                        .joints = m ? NULL : motion->joints[m],
                                        .joint_weights = m ? NULL : motion->joint_weights[m],
                                        .box = motion->boxes[m]};
    motion->mesh_defs[m] = (DipMeshDef){.vertex_count = VERTICES,
                                        .normals = motion->still_normals,
                                        .index_count = VERTICES,
                                        .indices = motion->indices};
}

static void make(Motion *motion) {
    memset(motion, 0, sizeof *motion);
    for (int i = 0; i < 2; i++) {
        make_rig(motion, i);
        make_mesh(motion, i);
        motion->objects[i] = (DipMovingObject){.object = i, .rig = i, .node = 2};
        fill_doubles(motion->objects[i].offset, 12);
    }
    for (uint32_t i = 0; i < VERTICES; i++) {
        motion->indices[i] = i;
    }
    motion->def = (DipMotionDef){motion->rigs, motion->objects, motion->meshes, 2, 2, 2};
    motion->scene = (DipSceneDef){.meshes = motion->mesh_defs,
                                  .mesh_count = 2,
                                  .objects = motion->object_defs,
                                  .object_count = 2,
                                  .motion = &motion->def};
}

static int set_up(void **state) {
    (void)state;
    make(&made);
    return dip_motion_check(&made.scene, NULL) ? 0 : 1;
}

static void assert_accepted(void) {
    DipError err = {0};
    if (!dip_motion_check(&made.scene, &err)) {
        fail_msg("%s", err.message);
    }
}

static void assert_refused(const char *what, int index) {
    char expected[64];
    DipError err = {.line = 7};
    snprintf(expected, sizeof expected, "%s %d is out of range", what, index);
    assert_false(dip_motion_check(&made.scene, &err));
    assert_int_equal(err.code, DIP_ERROR_RANGE);
    assert_int_equal(err.line, 0);
    assert_string_equal(err.key, "motion");
    assert_non_null(strstr(err.message, expected));
}

// Each of the following functions changes numbers, and gives them their values back.

static void must_be_finite(float *numbers, int count, const char *what, int index) {
    for (int i = 0; i < 2 * count; i++) {
        const float before = numbers[i / 2];
        numbers[i / 2] = i % 2 ? NAN : -INFINITY;
        assert_refused(what, index);
        numbers[i / 2] = before;
    }
}

static void must_be_finite_doubles(double *numbers, int count, const char *what, int index) {
    for (int i = 0; i < 2 * count; i++) {
        const double before = numbers[i / 2];
        numbers[i / 2] = i % 2 ? (double)NAN : (double)INFINITY;
        assert_refused(what, index);
        numbers[i / 2] = before;
    }
}

// An index or count must be in least..most.
static void must_be_in(int *number, int least, int most, const char *what, int index) {
    const int before = *number;
    for (int value = least - 1; value <= most + 1; value++) {
        *number = value;
        value >= least &&value <= most ? assert_accepted() : assert_refused(what, index);
    }
    *number = before;
}

static void rigs_have_finite_numbers_and_durations(void **state) {
    (void)state;
    for (int r = 0; r < 2; r++) {
        DipMotionRig *rig = &made.rigs[r];
        rig->duration_s = 0.0;
        rig->held_s = -1e300;
        assert_accepted();
        rig->duration_s = -1e-300;
        assert_refused("rig", r);
        rig->duration_s = 2.0;
        must_be_finite_doubles(&rig->duration_s, 1, "rig", r);
        must_be_finite_doubles(&rig->held_s, 1, "rig", r);
        must_be_finite_doubles(rig->root, 12, "rig", r);
        must_be_finite(made.rest_weights[r], WEIGHTS, "rig", r);
    }
}

static void nodes_come_after_their_parents_and_have_weights_of_the_rig(void **state) {
    (void)state;
    for (int i = 0; i < 2 * NODES; i++) {
        const int r = i / NODES, n = i % NODES;
        DipRigNode *node = &made.nodes[r][n];
        must_be_in(&node->parent, DIP_NO_NODE, n - 1, "rig", r);
        must_be_finite_doubles(node->matrix, 12, "rig", r);
        must_be_finite_doubles(node->translation, 3, "rig", r);
        must_be_finite_doubles(node->rotation, 4, "rig", r);
        must_be_finite_doubles(node->scale, 3, "rig", r);
        must_be_in(&node->first_weight, 0, WEIGHTS - node->weight_count, "rig", r);
    }
    // Node 2 has no track or mesh that would need another number of weights.
    made.nodes[1][2].first_weight = 1;
    must_be_in(&made.nodes[1][2].weight_count, 0, WEIGHTS - 1, "rig", 1);
    made.nodes[1][2].first_weight = 0;
    must_be_in(&made.nodes[1][2].weight_count, 0, WEIGHTS, "rig", 1);
}

static void skins_have_nodes_of_the_rig(void **state) {
    (void)state;
    for (int i = 0; i < 4; i++) {
        const int r = i / 2, s = i % 2;
        for (int j = 0; j < JOINTS; j++) {
            must_be_in(&made.joint_nodes[r][s][j], 0, NODES - 1, "rig", r);
        }
        must_be_finite_doubles(made.inverse_binds[r][s], 12 * JOINTS, "rig", r);
    }
    made.skins[1][0].joint_count = 0;
    assert_accepted();
    made.skins[1][0].joint_count = -1;
    assert_refused("rig", 1);
}

static void tracks_have_ascending_keys_of_their_width(void **state) {
    (void)state;
    for (int i = 0; i < 2 * TRACKS; i++) {
        const int r = i / TRACKS, t = i % TRACKS;
        DipTrack *track = &made.tracks[r][t];
        const DipTrack before = *track;
        must_be_in(&track->width, track->width, track->width, "rig", r);
        must_be_finite(made.times[r][t], KEYS, "rig", r);
        must_be_finite(made.values[r][t], (int)dip_track_value_count(track), "rig", r);
        for (int k = 1; k < KEYS; k++) {
            const float time = made.times[r][t][k];
            made.times[r][t][k] = made.times[r][t][k - 1];
            assert_refused("rig", r);
            made.times[r][t][k] = nextafterf(made.times[r][t][k - 1], INFINITY);
            assert_accepted();
            made.times[r][t][k] = time;
        }
        for (uint32_t count = 0; count < KEYS; count++) {
            track->key_count = count;
            count ? assert_accepted() : assert_refused("rig", r);
        }
        *track = before;
        track->target = (DipTrackTarget)-1;
        assert_refused("rig", r);
        track->target = (DipTrackTarget)(DIP_TRACK_WEIGHTS + 1);
        assert_refused("rig", r);
        *track = before;
        for (int kind = -1; kind < 4; kind++) {
            track->interpolation = (DipInterpolation)kind;
            const bool fits = kind >= 0 && (kind < 2 || (kind == 2 && t == 1));
            fits ? assert_accepted() : assert_refused("rig", r); // A spline needs more values.
        }
        *track = before;
        for (int node = -1; node <= NODES; node++) {
            track->node = node;
            const bool fits = t == 3 ? node == 0 : node >= 0 && node < NODES;
            fits ? assert_accepted() : assert_refused("rig", r); // Node 0 has two weights.
        }
        *track = before;
    }
}

static void objects_ascend_and_have_nodes_of_their_rigs(void **state) {
    (void)state;
    made.def.object_count = 1;
    must_be_in(&made.objects[0].object, 0, 1, "moving object", 0);
    made.def.object_count = 2;
    made.objects[0].object = 1;
    assert_refused("moving object", 1);
    made.objects[0].object = 0;
    must_be_in(&made.objects[1].object, 1, 1, "moving object", 1);
    for (int i = 0; i < 2; i++) {
        must_be_in(&made.objects[i].rig, 0, 1, "moving object", i);
        must_be_in(&made.objects[i].node, 0, NODES - 1, "moving object", i);
        must_be_finite_doubles(made.objects[i].offset, 12, "moving object", i);
    }
}

static void meshes_ascend_and_have_the_shapes_of_their_nodes(void **state) {
    (void)state;
    made.def.mesh_count = 1;
    must_be_in(&made.meshes[0].mesh, 0, 1, "moving mesh", 0);
    made.def.mesh_count = 2;
    made.meshes[0].mesh = 1;
    assert_refused("moving mesh", 1);
    made.meshes[0].mesh = 0;
    must_be_in(&made.meshes[1].mesh, 1, 1, "moving mesh", 1);
    for (int m = 0; m < 2; m++) {
        DipMovingMesh *mesh = &made.meshes[m];
        must_be_in(&mesh->rig, 0, 1, "moving mesh", m);
        must_be_in(&mesh->node, 0, 0, "moving mesh", m); // The other nodes have other weights.
        must_be_in(&mesh->shape_count, SHAPES, SHAPES, "moving mesh", m);
        must_be_finite(made.positions[m], 3 * VERTICES * SHAPES, "moving mesh", m);
        must_be_finite(made.normals[m], 3 * VERTICES * SHAPES, "moving mesh", m);
        for (uint32_t count = VERTICES - 1; count <= VERTICES + 1; count++) {
            made.mesh_defs[m].vertex_count = count;
            count == VERTICES ? assert_accepted() : assert_refused("moving mesh", m);
        }
        made.mesh_defs[m].vertex_count = VERTICES;
    }
    for (int node = 1; node <= NODES; node++) { // a mesh with the shapes of another node
        made.meshes[1].node = node;
        made.meshes[1].shape_count = node == 1 ? 2 : 1;
        node < NODES ? assert_accepted() : assert_refused("moving mesh", 1);
    }
    made.meshes[1].node = -1;
    made.meshes[1].shape_count = 0;
    assert_refused("moving mesh", 1);
}

// A mesh whose shapes have no normals gets those of its triangles, which then share no vertices. A
// mesh that never had normals may share them.
static void meshes_without_normals_share_no_vertices(void **state) {
    (void)state;
    made.meshes[1].normals = NULL;
    assert_accepted();
    for (int i = 0; i < VERTICES; i++) {
        made.indices[i] = (uint32_t)(i + 1) % VERTICES;
        assert_refused("moving mesh", 1);
        made.mesh_defs[1].normals = NULL;
        assert_accepted();
        made.mesh_defs[1].normals = made.still_normals;
        made.indices[i] = (uint32_t)i;
    }
    made.mesh_defs[1].index_count = 0;
    assert_refused("moving mesh", 1);
}

static void joints_are_those_of_the_skin(void **state) {
    (void)state;
    DipMovingMesh *mesh = &made.meshes[0];
    must_be_in(&mesh->skin, DIP_NO_SKIN, 1, "moving mesh", 0);
    must_be_finite(made.joint_weights[0], 4 * VERTICES, "moving mesh", 0);
    for (int i = 0; i < 4 * VERTICES; i++) {
        made.joints[0][i] = JOINTS;
        assert_refused("moving mesh", 0);
        made.joints[0][i] = JOINTS - 1;
        assert_accepted();
    }
    mesh->joints = NULL;
    assert_refused("moving mesh", 0);
    mesh->joints = made.joints[0];
    mesh->joint_weights = NULL;
    assert_refused("moving mesh", 0);
}

static void boxes_are_finite_and_not_inside_out(void **state) {
    (void)state;
    must_be_finite(made.boxes[1], 6, "moving mesh", 1);
    for (int axis = 0; axis < 3; axis++) {
        made.boxes[1][axis] = made.boxes[1][3 + axis];
        assert_accepted();
        made.boxes[1][axis] = nextafterf(made.boxes[1][3 + axis], INFINITY);
        assert_refused("moving mesh", 1);
        made.boxes[1][axis] = -1.0f;
    }
    made.meshes[1].box = NULL;
    assert_accepted();
}

static void a_motion_plays_if_a_clip_lasts_and_is_not_held(void **state) {
    (void)state;
    for (int i = 0; i < 16; i++) {
        for (int r = 0; r < 2; r++) {
            made.rigs[r].is_held = i >> r & 1;
            made.rigs[r].duration_s = i >> (2 + r) & 1 ? 1e-300 : 0.0;
        }
        const bool first = !(i & 1) && (i & 4), second = !(i & 2) && (i & 8);
        assert_int_equal(dip_motion_plays(&made.def), first || second);
    }
    made.def.rig_count = 0;
    assert_false(dip_motion_plays(&made.def));
}

// --- the copy ------------------------------------------------------------------------------------

static void assert_same(const void *copy, const void *original, size_t size_bytes) {
    assert_ptr_not_equal(copy, original);
    assert_memory_equal(copy, original, size_bytes);
}

// Checks a copy whose original is gone, beside a motion that was made in the same way.
static void a_copy_has_all_arrays_of_its_own(void **state) {
    (void)state;
    static Motion same;
    DipMotionDef *copy = dip_motion_copy(&made.scene);
    assert_non_null(copy);
    make(&same);
    memset(&made, 0xee, sizeof made);
    assert_true(copy->rig_count == 2 && copy->object_count == 2 && copy->mesh_count == 2);
    assert_same(copy->objects, same.objects, sizeof same.objects);
    for (int r = 0; r < 2; r++) {
        const DipMotionRig *rig = &copy->rigs[r];
        assert_string_equal(rig->clip, same.rigs[r].clip);
        assert_same(rig->rig.nodes, same.nodes[r], sizeof same.nodes[r]);
        assert_same(rig->rig.rest_weights, same.rest_weights[r], WEIGHTS * sizeof(float));
        assert_memory_equal(rig->root, same.rigs[r].root, sizeof rig->root);
        for (int s = 0; s < 2; s++) {
            assert_same(rig->skins[s].nodes, same.joint_nodes[r][s], JOINTS * sizeof(int));
            assert_same(rig->skins[s].inverse_binds, same.inverse_binds[r][s],
                        12 * JOINTS * sizeof(double));
        }
        for (int t = 0; t < TRACKS; t++) {
            const DipTrack *track = &same.tracks[r][t];
            assert_same(rig->tracks[t].times, track->times, KEYS * sizeof(float));
            assert_same(rig->tracks[t].values, track->values,
                        dip_track_value_count(track) * sizeof(float));
        }
    }
    for (int m = 0; m < 2; m++) {
        const DipMovingMesh *mesh = &copy->meshes[m];
        assert_same(mesh->positions, same.positions[m], 3 * VERTICES * SHAPES * sizeof(float));
        assert_same(mesh->normals, same.normals[m], 3 * VERTICES * SHAPES * sizeof(float));
        assert_same(mesh->box, same.boxes[m], 6 * sizeof(float));
    }
    assert_same(copy->meshes[0].joints, same.joints[0], 4 * VERTICES * sizeof(uint16_t));
    assert_same(copy->meshes[0].joint_weights, same.joint_weights[0], 4 * VERTICES * sizeof(float));
    assert_true(!copy->meshes[1].joints && !copy->meshes[1].joint_weights);
    dip_motion_free(&copy);
    assert_null(copy);
    dip_motion_free(&copy);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(rigs_have_finite_numbers_and_durations, set_up),
        cmocka_unit_test_setup(nodes_come_after_their_parents_and_have_weights_of_the_rig, set_up),
        cmocka_unit_test_setup(skins_have_nodes_of_the_rig, set_up),
        cmocka_unit_test_setup(tracks_have_ascending_keys_of_their_width, set_up),
        cmocka_unit_test_setup(objects_ascend_and_have_nodes_of_their_rigs, set_up),
        cmocka_unit_test_setup(meshes_ascend_and_have_the_shapes_of_their_nodes, set_up),
        cmocka_unit_test_setup(meshes_without_normals_share_no_vertices, set_up),
        cmocka_unit_test_setup(joints_are_those_of_the_skin, set_up),
        cmocka_unit_test_setup(boxes_are_finite_and_not_inside_out, set_up),
        cmocka_unit_test_setup(a_motion_plays_if_a_clip_lasts_and_is_not_held, set_up),
        cmocka_unit_test_setup(a_copy_has_all_arrays_of_its_own, set_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
