// Tests the vertices of moving meshes against sums in doubles: shapes that are mixed, and joints
// that turn, shear, scale and mirror. A normal must stand upright on what the surface becomes, on
// the side to which it pointed before, and have length 1.
#include "renderer/catalogue/random.h"
#include "renderer/scene/motion.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { VERTICES = 300, SHAPES = 3, JOINTS = 5, STRIDE = 7 };

typedef struct Made {
    DipRigNode nodes[JOINTS];
    int joint_nodes[JOINTS];
    double inverse_binds[12 * JOINTS];
    DipRigSkin skin;
    float rest_weights[SHAPES - 1];
    DipMotionRig rig;
    float positions[3 * VERTICES * SHAPES];
    float normals[3 * VERTICES * SHAPES];
    uint16_t joints[4 * VERTICES];
    float joint_weights[4 * VERTICES];
    DipMovingMesh mesh;
    DipMotionDef def;
} Made;

static Made made;
static Random random_state;

static double any(double least, double most) {
    return random_real(&random_state, least, most);
}

static double determinant(const double m[12]) {
    return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) +
           m[2] * (m[4] * m[9] - m[5] * m[8]);
}

// All numbers of a matrix are random. Some matrices mirror; none is nearly flat.
static void random_matrix(double m[12]) {
    do {
        for (int i = 0; i < 12; i++) {
            m[i] = any(-2.0, 2.0);
        }
    } while (fabs(determinant(m)) < 1.0);
}

// Begins a mesh with joints or without, and with normals or without.
static void make(bool skinned, bool with_normals) {
    memset(&made, 0, sizeof made);
    for (int n = 0; n < JOINTS; n++) {
        made.nodes[n] = (DipRigNode){.parent = n % 2 ? n - 1 : DIP_NO_NODE, .has_matrix = true};
        random_matrix(made.nodes[n].matrix);
        random_matrix(made.inverse_binds + 12 * n);
        made.joint_nodes[n] = JOINTS - 1 - n;
    }
    made.nodes[0].weight_count = SHAPES - 1;
    for (int s = 1; s < SHAPES; s++) {
        made.rest_weights[s - 1] = (float)any(-1.0, 1.0);
    }
    for (int i = 0; i < 3 * VERTICES * SHAPES; i++) {
        made.positions[i] = (float)any(-3.0, 3.0);
        made.normals[i] = (float)any(-1.0, 1.0);
    }
    for (int v = 0; v < VERTICES; v++) {
        const double share = any(0.0, 1.0);
        const double weights[4] = {v % 3 ? 1.0 : share, v % 3 ? 0.0 : 1.0 - share, 0.0, 0.0};
        for (int k = 0; k < 4; k++) {
            made.joints[4 * v + k] = (uint16_t)random_int(&random_state, 0, JOINTS - 1);
            made.joint_weights[4 * v + k] = (float)weights[k];
        }
    }
    made.skin = (DipRigSkin){JOINTS, made.joint_nodes, made.inverse_binds};
    made.rig = (DipMotionRig){.rig = {made.nodes, JOINTS, made.rest_weights, SHAPES - 1},
                              .skins = &made.skin,
                              .skin_count = 1};
    made.mesh = (DipMovingMesh){.skin = skinned ? 0 : DIP_NO_SKIN,
                                .vertex_count = VERTICES,
                                .shape_count = SHAPES,
                                .positions = made.positions,
                                .normals = with_normals ? made.normals : NULL,
                                .joints = skinned ? made.joints : NULL,
                                .joint_weights = skinned ? made.joint_weights : NULL};
    made.def =
        (DipMotionDef){.rigs = &made.rig, .meshes = &made.mesh, .rig_count = 1, .mesh_count = 1};
}

// to = a * b
static void multiply(const double a[12], const double b[12], double to[12]) {
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 4; c++) {
            to[4 * r + c] = c == 3 ? a[4 * r + 3] : 0.0;
            for (int k = 0; k < 3; k++) {
                to[4 * r + c] += a[4 * r + k] * b[4 * k + c];
            }
        }
    }
}

// The mean of the matrices of a vertex's joints, or the identity.
static void matrix_of(int vertex, double m[12]) {
    static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    memcpy(m, identity, sizeof identity);
    if (made.mesh.skin == DIP_NO_SKIN) {
        return;
    }
    memset(m, 0, sizeof identity);
    for (int k = 0; k < 4; k++) {
        const int joint = made.joints[4 * vertex + k];
        const DipRigNode *node = &made.nodes[made.joint_nodes[joint]];
        double world[12], joined[12];
        memcpy(world, node->matrix, sizeof world);
        if (node->parent != DIP_NO_NODE) {
            multiply(made.nodes[node->parent].matrix, node->matrix, world);
        }
        multiply(world, made.inverse_binds + 12 * joint, joined);
        for (int i = 0; i < 12; i++) {
            m[i] += (double)made.joint_weights[4 * vertex + k] * joined[i];
        }
    }
}

static void mixed(const float *shapes, int vertex, double to[3]) {
    for (int i = 0; i < 3; i++) {
        to[i] = (double)shapes[3 * vertex + i];
        for (int s = 1; s < SHAPES; s++) {
            to[i] += (double)made.rest_weights[s - 1] * shapes[3 * (s * VERTICES + vertex) + i];
        }
    }
}

static void transform(const double m[12], const double v[3], double w, double to[3]) {
    for (int r = 0; r < 3; r++) {
        to[r] = m[4 * r] * v[0] + m[4 * r + 1] * v[1] + m[4 * r + 2] * v[2] + m[4 * r + 3] * w;
    }
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double to[3]) {
    for (int i = 0; i < 3; i++) {
        to[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    }
}

static void position_of(int vertex, double to[3]) {
    double m[12], at_rest[3];
    matrix_of(vertex, m);
    mixed(made.positions, vertex, at_rest);
    transform(m, at_rest, 1.0, to);
}

// `normal` has length 1 and is perpendicular to two directions.
static void assert_upright(const double normal[3], const double a[3], const double b[3]) {
    assert_true(fabs(dot(normal, normal) - 1.0) < 1e-6);
    assert_true(fabs(dot(normal, a)) < 2e-5 * sqrt(dot(a, a)));
    assert_true(fabs(dot(normal, b)) < 2e-5 * sqrt(dot(b, b)));
}

// Two directions along the surface, and where a matrix takes them. Matrices that are nearly flat
// are left out. Returns whether the normal was checked.
static bool check_turned(int vertex, const double normal[3]) {
    double m[12], before[3], along[2][3], moved[2][3], outwards[3];
    matrix_of(vertex, m);
    mixed(made.normals, vertex, before);
    if (fabs(determinant(m)) < 0.1 || dot(before, before) < 0.01) {
        return false;
    }
    cross(before, fabs(before[0]) < 0.5 ? (double[]){1, 0, 0} : (double[]){0, 1, 0}, along[0]);
    cross(before, along[0], along[1]);
    for (int k = 0; k < 2; k++) {
        transform(m, along[k], 0.0, moved[k]);
    }
    assert_upright(normal, moved[0], moved[1]);
    transform(m, before, 0.0, outwards);
    assert_true(dot(normal, outwards) > 0.0);
    return true;
}

// The normal of the vertex's triangle.
static bool check_face(int vertex, const double normal[3]) {
    double corners[3][3], along[2][3], upwards[3];
    for (int c = 0; c < 3; c++) {
        position_of(vertex - vertex % 3 + c, corners[c]);
    }
    for (int i = 0; i < 3; i++) {
        along[0][i] = corners[1][i] - corners[0][i];
        along[1][i] = corners[2][i] - corners[0][i];
    }
    cross(along[0], along[1], upwards);
    if (sqrt(dot(upwards, upwards)) < 0.1) {
        return false;
    }
    assert_upright(normal, along[0], along[1]);
    assert_true(dot(normal, upwards) > 0.0);
    return true;
}

// Vertices from `first` to the last one.
static void check_vertices(int first) {
    static float out[2][STRIDE * VERTICES + 3], alone[STRIDE * VERTICES + 3];
    DipMotionPose *pose = dip_motion_pose_create(&made.def);
    int checked = 0;
    assert_non_null(pose);
    dip_motion_pose_set(pose, 0);
    memset(out, 0x7f, sizeof out);
    dip_motion_pose_vertices(pose, 0, (uint32_t)first, (uint32_t)(VERTICES - first), STRIDE, out[0],
                             out[1]);
    dip_motion_pose_vertices(pose, 0, (uint32_t)first, (uint32_t)(VERTICES - first), STRIDE, alone,
                             NULL);
    for (int i = 0; i < VERTICES - first; i++) {
        double position[3], normal[3];
        position_of(first + i, position);
        for (int axis = 0; axis < 3; axis++) {
            const float found = out[0][STRIDE * i + axis];
            assert_true(fabs((double)found - position[axis]) < 1e-4);
            assert_true(alone[STRIDE * i + axis] == found);
            normal[axis] = (double)out[1][STRIDE * i + axis];
        }
        checked +=
            made.mesh.normals ? check_turned(first + i, normal) : check_face(first + i, normal);
    }
    assert_true(checked > (VERTICES - first) / 2);
    dip_motion_pose_destroy(&pose);
}

static void vertices_move_as_their_shapes_and_joints(void **state) {
    (void)state;
    random_state = (Random){188};
    for (int kind = 0; kind < 4; kind++) {
        for (int round = 0; round < 10; round++) {
            make(kind & 1, kind & 2);
            check_vertices(0);
            check_vertices(147);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(vertices_move_as_their_shapes_and_joints)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
