// Tests the names and the number of the cameras that a glTF file has, and the paths that its
// animations make of them.
#include "assets/cameras.h"
#include "fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// Writes a file with a camera at each of `count` nodes. Node i has the name names[i % name_count].
// Returns its path.
static const char *write_cameras(const char *const *names, int name_count, int count) {
    const size_t room = 128 * (size_t)count + 512;
    char *text = malloc(room);
    assert_non_null(text);
    size_t length =
        (size_t)snprintf(text, room,
                         "{\"asset\":{\"version\":\"2.0\"},\"cameras\":[{\"type\":\"perspective\","
                         "\"perspective\":{\"yfov\":0.8,\"znear\":0.1}}],\"nodes\":[");
    for (int i = 0; i < count; ++i) {
        length += (size_t)snprintf(text + length, room - length,
                                   "%s{\"camera\":0,\"name\":\"%s\",\"translation\":[%d,0,0]}",
                                   i > 0 ? "," : "", names[i % name_count], i);
    }
    length += (size_t)snprintf(text + length, room - length, "],\"scenes\":[{\"nodes\":[");
    for (int i = 0; i < count; ++i) {
        length += (size_t)snprintf(text + length, room - length, "%s%d", i > 0 ? "," : "", i);
    }
    snprintf(text + length, room - length, "]}],\"scene\":0}");
    fixture_write_text("cameras.gltf", text);
    free(text);
    return fixture_path("cameras.gltf");
}

static DipModelCameras *load(const char *path) {
    DipError err = {0};
    DipModelCameras *cameras = dip_model_cameras_load(path, DIP_UP_auto, NULL, &err);
    if (!cameras) {
        fail_msg("%s", err.message);
    }
    return cameras;
}

static void every_camera_has_a_name_of_its_own(void **state) {
    (void)state;
    static const char *const given[] = {"door", "eye", "door 2", "door", "door", "door 3", "eye"};
    static const char *const expected[] = {"door",   "eye",      "door 2", "door 3",
                                           "door 4", "door 3 2", "eye 2"};
    DipModelCameras *cameras = load(write_cameras(given, 7, 7));
    int count = 0;
    const DipModelCamera *list = dip_model_cameras_list(cameras, &count);
    assert_int_equal(count, 7);
    for (int i = 0; i < count; ++i) {
        assert_string_equal(list[i].name, expected[i]);
        assert_true(list[i].keys[0][0] == i); // NOLINT: small whole numbers are exact.
    }
    dip_model_cameras_destroy(&cameras);
}

// Reading 10,000 cameras of one name takes a fraction of a second. It took an hour when each one
// tried all numbers again.
static void as_many_cameras_are_read_as_stated(void **state) {
    (void)state;
    static const char *const given[] = {"eye"};
    DipModelCameras *cameras = load(write_cameras(given, 1, 10000));
    int count = 0;
    const DipModelCamera *list = dip_model_cameras_list(cameras, &count);
    assert_int_equal(count, 10000);
    assert_string_equal(list[9999].name, "eye 10000");
    dip_model_cameras_destroy(&cameras);
    DipError err = {0};
    assert_null(dip_model_cameras_load(write_cameras(given, 1, 10001), DIP_UP_auto, NULL, &err));
    assert_string_equal(err.key, "cameras");
    assert_non_null(strstr(err.message, "more than 10000 camera paths"));
}

// --- orientation ---------------------------------------------------------------------------------

// Writes a file with a camera at the nodes that the JSON lists. Node 0 is the only root.
static const char *write_nodes(const char *nodes) {
    char text[2000];
    const int length =
        snprintf(text, sizeof text,
                 "{\"asset\":{\"version\":\"2.0\"},\"cameras\":[{\"type\":\"perspective\","
                 "\"perspective\":{\"yfov\":0.8,\"znear\":0.1}}],\"nodes\":[%s],"
                 "\"scenes\":[{\"nodes\":[0]}],\"scene\":0}",
                 nodes);
    assert_true(length > 0 && (size_t)length < sizeof text);
    fixture_write_text("nodes.gltf", text);
    return fixture_path("nodes.gltf");
}

// Writes a node with a camera, whose matrix has these axes and this origin.
static const char *write_matrix(double axes[3][3], const double origin[3]) {
    char node[600] = "{\"camera\":0,\"name\":\"eye\",\"matrix\":[";
    for (int axis = 0; axis < 3; ++axis) { // The columns of the matrix follow each other.
        const size_t end = strlen(node);
        snprintf(node + end, sizeof node - end, "%.17g,%.17g,%.17g,0,", axes[axis][0],
                 axes[axis][1], axes[axis][2]);
    }
    const size_t end = strlen(node);
    snprintf(node + end, sizeof node - end, "%.17g,%.17g,%.17g,1]}", origin[0], origin[1],
             origin[2]);
    return write_nodes(node);
}

// Checks the pose of the only camera. A quaternion and its negative are the same rotation.
static void assert_pose(const char *path, DipUpAxis up, const double position[3],
                        const double q[4]) {
    DipError err = {0};
    DipErrorList warnings = {0};
    DipModelCameras *cameras = dip_model_cameras_load(path, up, &warnings, &err);
    int count = 0;
    assert_non_null(cameras);
    const DipModelCamera *list = dip_model_cameras_list(cameras, &count);
    assert_int_equal(count, 1);
    assert_int_equal(warnings.count, 0);
    assert_int_equal(list->key_count, 1);
    const double *key = list->keys[0];
    const double along = key[3] * q[0] + key[4] * q[1] + key[5] * q[2] + key[6] * q[3];
    for (int i = 0; i < 4; ++i) {
        const double expected = along < 0.0 ? -q[i] : q[i];
        if (!(fabs(key[3 + i] - expected) < 1e-9)) {
            fail_msg("quaternion %.9g %.9g %.9g %.9g, expected %.9g %.9g %.9g %.9g", key[3], key[4],
                     key[5], key[6], q[0], q[1], q[2], q[3]);
        }
        if (i < 3 && !(fabs(key[i] - position[i]) < 1e-9)) {
            fail_msg("%c is %.9g, expected %.9g", "xyz"[i], key[i], position[i]);
        }
    }
    dip_model_cameras_destroy(&cameras);
}

// Turns about many axes, by up to half a turn. The matrix is that of Rodrigues' formula; the
// quaternion has the sine of half the angle along the axis, and its cosine.
static void a_rotation_matrix_becomes_its_quaternion(void **state) {
    (void)state;
    static const double axes[][3] = {{1, 0, 0}, {0, 1, 0},  {0, 0, 1},   {1, 1, 1},  {9, 1, 2},
                                     {2, 9, 1}, {1, 2, 9},  {-9, 1, -2}, {2, -9, 1}, {-1, 2, -9},
                                     {5, 5, 1}, {-5, 1, 5}, {1, -5, 5},  {3, 2, -3}};
    static const double degrees[] = {0, 1, 60, 90, 119, 120, 121, 150, 179, 180, 240};
    const double origin[3] = {1, -2, 0.5};
    for (size_t a = 0; a < sizeof axes / sizeof *axes; ++a) {
        const double length =
            sqrt(axes[a][0] * axes[a][0] + axes[a][1] * axes[a][1] + axes[a][2] * axes[a][2]);
        for (size_t d = 0; d < sizeof degrees / sizeof *degrees; ++d) {
            const double angle = degrees[d] * 3.14159265358979323846 / 180.0;
            const double c = cos(angle);
            const double s = sin(angle);
            double columns[3][3];
            double q[4] = {0, 0, 0, cos(angle / 2)};
            for (int i = 0; i < 3; ++i) {
                const int j = (i + 1) % 3;
                const int k = (i + 2) % 3;
                const double u[3] = {axes[a][i] / length, axes[a][j] / length, axes[a][k] / length};
                columns[i][i] = c + (1 - c) * u[0] * u[0];
                columns[i][j] = (1 - c) * u[0] * u[1] + s * u[2];
                columns[i][k] = (1 - c) * u[0] * u[2] - s * u[1];
                q[i] = u[0] * sin(angle / 2);
            }
            assert_pose(write_matrix(columns, origin), DIP_UP_auto, origin, q);
        }
    }
}

// With z up in the file, its (x, y, z) is (x, z, -y): everything turns by -90 degrees about x.
static void the_up_axis_turns_cameras(void **state) {
    (void)state;
    const double half = sqrt(0.5);
    double axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const double origin[3] = {1, 2, 3};
    const double turned[3] = {1, 3, -2};
    const double same_q[4] = {0, 0, 0, 1};
    const double turned_q[4] = {-half, 0, 0, half};
    const char *path = write_matrix(axes, origin);
    assert_pose(path, DIP_UP_auto, origin, same_q); // In glTF, y is up.
    assert_pose(path, DIP_UP_y, origin, same_q);
    assert_pose(path, DIP_UP_z, turned, turned_q);
    // This camera stands upright where z is up: +Y is the file's z, and it looks along the file's
    // y, which is -z in the world.
    double upright[3][3] = {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
    assert_pose(write_matrix(upright, origin), DIP_UP_z, turned, same_q);
}

// Scales, mirrors and shears are left out: the camera looks along -Z, and +Y is up as far as it is
// perpendicular to that.
static void scales_mirrors_and_shears_are_left_out(void **state) {
    (void)state;
    static const double bases[][3][3] = {
        {{4, 0, 0}, {0, 0.5, 0}, {0, 0, 1e-3}}, // scaled
        {{1, 0, 0}, {0, 1, 0}, {0, 0, 1e-29}},  // very flat
        {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},     // mirrored
        {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}},      // flat in x, which Y and Z make again
        {{1, 0, 0}, {0, 1, 5}, {0, 0, 2}},      // sheared
        {{1, 0, 0}, {0, 1, -1e9}, {0, 0, 1}},   // Y is nearly along -Z
    };
    const double origin[3] = {0, 0, 0};
    const double q[4] = {0, 0, 0, 1};
    for (size_t i = 0; i < sizeof bases / sizeof *bases; ++i) {
        double axes[3][3];
        memcpy(axes, bases[i], sizeof axes);
        assert_pose(write_matrix(axes, origin), DIP_UP_auto, origin, q);
    }
}

// The node above turns by 90 degrees about y, the camera's own by 90 degrees about z. The product
// of the quaternions (0, h, 0, h) and (0, 0, h, h), where h is the root of 1/2, is that below.
static void a_camera_follows_the_nodes_above_it(void **state) {
    (void)state;
    const double position[3] = {10, 0, -6}; // twice (3, 0, 0), turned, and moved by (10, 0, 0)
    const double q[4] = {0.5, 0.5, 0.5, 0.5};
    const char *path = write_nodes(
        "{\"children\":[1],\"translation\":[10,0,0],\"rotation\":[0,0.70710678118654752,0,"
        "0.70710678118654752],\"scale\":[2,2,2]},"
        "{\"camera\":0,\"name\":\"eye\",\"translation\":[3,0,0],"
        "\"rotation\":[0,0,0.70710678118654752,0.70710678118654752]}");
    assert_pose(path, DIP_UP_auto, position, q);
}

// --- cameras that are skipped --------------------------------------------------------------------

// Expects no camera, and one warning about "eye" with this reason.
static void assert_skipped(const char *path, const char *reason) {
    DipError err = {0};
    DipErrorList warnings = {0};
    DipModelCameras *cameras = dip_model_cameras_load(path, DIP_UP_auto, &warnings, &err);
    int count = -1;
    if (!cameras) {
        fail_msg("%s", err.message);
    }
    dip_model_cameras_list(cameras, &count);
    assert_int_equal(count, 0);
    assert_int_equal(warnings.count, 1);
    assert_string_equal(warnings.items[0].key, "eye");
    if (!strstr(warnings.items[0].message, reason)) {
        fail_msg("\"%s\" does not contain \"%s\"", warnings.items[0].message, reason);
    }
    dip_error_list_free(&warnings);
    dip_model_cameras_destroy(&cameras);
}

static void cameras_without_a_pose_are_skipped(void **state) {
    (void)state;
    static const char *const nodes[] = {
        "{\"camera\":0,\"name\":\"eye\",\"scale\":[1,0,1]}", // Y is flat
        "{\"camera\":0,\"name\":\"eye\",\"scale\":[1,1,0]}", // Z is flat
        "{\"camera\":0,\"name\":\"eye\",\"scale\":[1,1e-31,1]}",
        // Y is along Z, or against it.
        "{\"camera\":0,\"name\":\"eye\",\"matrix\":[1,0,0,0,0,0,2,0,0,0,1,0,0,0,0,1]}",
        "{\"camera\":0,\"name\":\"eye\",\"matrix\":[1,0,0,0,0,-3,-3,0,0,1,1,0,0,0,0,1]}",
        // Beyond 1e9 m, and infinite by the nodes above.
        "{\"camera\":0,\"name\":\"eye\",\"translation\":[1000000001,0,0]}",
        "{\"camera\":0,\"name\":\"eye\",\"translation\":[0,-1000000001,0]}",
        "{\"scale\":[3e38,1,1],\"children\":[1]},{\"scale\":[3e38,1,1],\"children\":[2]},"
        "{\"scale\":[3e38,1,1],\"children\":[3]},{\"scale\":[3e38,1,1],\"children\":[4]},"
        "{\"scale\":[3e38,1,1],\"children\":[5]},{\"scale\":[3e38,1,1],\"children\":[6]},"
        "{\"scale\":[3e38,1,1],\"children\":[7]},{\"scale\":[3e38,1,1],\"children\":[8]},"
        "{\"scale\":[3e38,1,1],\"children\":[9]},"
        "{\"camera\":0,\"name\":\"eye\",\"rotation\":[0,0,0.6,0.8]}",
    };
    for (size_t i = 0; i < sizeof nodes / sizeof *nodes; ++i) {
        assert_skipped(write_nodes(nodes[i]), "its transform is too large, flat, or not finite");
    }
    static const double origin[3] = {1e9, -1e9, 0};
    static const double q[4] = {0, 0, 0, 1};
    double axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    assert_pose(write_matrix(axes, origin), DIP_UP_auto, origin, q);
}

static const char *write_lens(const char *camera) {
    char text[500];
    snprintf(text, sizeof text,
             "{\"asset\":{\"version\":\"2.0\"},\"cameras\":[%s],"
             "\"nodes\":[{\"camera\":0,\"name\":\"eye\"}],\"scenes\":[{\"nodes\":[0]}]}",
             camera);
    fixture_write_text("lens.gltf", text);
    return fixture_path("lens.gltf");
}

// The field of view is 1 to 170 degrees; the file has it in radians.
static void lenses_that_cannot_be_drawn_are_skipped(void **state) {
    (void)state;
    static const char fov[] = "no field of view (yfov) of 1 to 170 degrees";
    assert_skipped(write_lens("{\"type\":\"orthographic\",\"orthographic\":{\"xmag\":1,\"ymag\":1,"
                              "\"zfar\":9,\"znear\":1}}"),
                   "it is orthographic");
    assert_skipped(write_lens("{\"type\":\"perspective\"}"), fov);
    assert_skipped(write_lens("{\"type\":\"perspective\",\"perspective\":{\"yfov\":\"1\"}}"), fov);
    assert_skipped(write_lens("{\"perspective\":{\"yfov\":0.0174}}"), fov); // 0.997 degrees
    assert_skipped(write_lens("{\"perspective\":{\"yfov\":2.9671}}"), fov); // 170.003 degrees
    assert_skipped(write_lens("{\"perspective\":{\"yfov\":-0.5}}"), fov);
    static const struct {
        const char *camera;
        double fov_y_deg, aspect;
    } drawn[] = {{"{\"perspective\":{\"yfov\":0.01746}}", 1.000384, 0},
                 {"{\"perspective\":{\"yfov\":2.967}}", 169.996578, 0},
                 {"{\"perspective\":{\"yfov\":1.5,\"aspectRatio\":1.75}}", 85.943669, 1.75},
                 {"{\"perspective\":{\"yfov\":1.5,\"aspectRatio\":-2}}", 85.943669, 0}};
    for (size_t i = 0; i < sizeof drawn / sizeof *drawn; ++i) {
        DipModelCameras *cameras = load(write_lens(drawn[i].camera));
        int count = 0;
        const DipModelCamera *list = dip_model_cameras_list(cameras, &count);
        assert_int_equal(count, 1);
        assert_true(fabs(list->fov_y_deg - drawn[i].fov_y_deg) < 1e-5);
        assert_true(fabs(list->aspect - drawn[i].aspect) < 1e-12);
        dip_model_cameras_destroy(&cameras);
    }
}

// --- animations ---------------------------------------------------------------------------------

// Writes a file with a camera that an animation moves along x. The times and the values are little-
// endian floats. Returns its path.
static const char *write_moving_camera(const char *interpolation, const float *times_s,
                                       const float *x, int count) {
    enum { MOST = 8 };
    float numbers[4 * MOST] = {0};
    assert_true(count <= MOST);
    memcpy(numbers, times_s, (size_t)count * sizeof *times_s);
    for (int i = 0; i < count; ++i) {
        numbers[count + 3 * i] = x[i];
    }
    fixture_write("moving.bin", numbers, (size_t)count * 4 * sizeof *numbers);
    char text[1400];
    snprintf(text, sizeof text,
             "{\"asset\":{\"version\":\"2.0\"},\"cameras\":[{\"type\":\"perspective\","
             "\"perspective\":{\"yfov\":0.8,\"znear\":0.1}}],"
             "\"nodes\":[{\"camera\":0,\"name\":\"eye\"}],"
             "\"scenes\":[{\"nodes\":[0]}],\"scene\":0,"
             "\"buffers\":[{\"byteLength\":%d,\"uri\":\"moving.bin\"}],"
             "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%d},"
             "{\"buffer\":0,\"byteOffset\":%d,\"byteLength\":%d}],"
             "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"SCALAR\","
             "\"count\":%d,\"min\":[%.9g],\"max\":[%.9g]},"
             "{\"bufferView\":1,\"componentType\":5126,\"type\":\"VEC3\",\"count\":%d}],"
             "\"animations\":[{\"name\":\"go\",\"samplers\":[{\"input\":0,\"output\":1,"
             "\"interpolation\":\"%s\"}],\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,"
             "\"path\":\"translation\"}}]}]}",
             16 * count, 4 * count, 4 * count, 12 * count, count, (double)times_s[0],
             (double)times_s[count - 1], count, interpolation);
    fixture_write_text("moving.gltf", text);
    return fixture_path("moving.gltf");
}

// Loads the path of the animation, which must be the only one beside that of the camera at rest.
static const DipModelCamera *animated(const DipModelCameras *cameras) {
    int count = 0;
    const DipModelCamera *list = dip_model_cameras_list(cameras, &count);
    for (int i = 0; i < count; ++i) {
        if (list[i].key_count > 1) {
            return &list[i];
        }
    }
    fail_msg("no path has more than one key");
    return NULL;
}

// A path has 120 keys a second, on the straight line between the keys of the animation.
static void a_camera_moves_evenly_between_keys(void **state) {
    (void)state;
    static const float times_s[] = {0.0f, 1.0f, 3.0f};
    static const float x[] = {0.0f, 2.0f, -6.0f};
    DipModelCameras *cameras = load(write_moving_camera("LINEAR", times_s, x, 3));
    const DipModelCamera *camera = animated(cameras);
    assert_int_equal(camera->key_count, 361);
    assert_int_equal(camera->period_ns, 8333333);
    for (int i = 0; i < 361; ++i) {
        const double time_s = i / 120.0;
        const double expected = time_s <= 1.0 ? 2.0 * time_s : 2.0 - 4.0 * (time_s - 1.0);
        if (!(fabs(camera->keys[i][0] - expected) < 1e-5)) {
            fail_msg("key %d has x = %.9g, expected %.9g", i, camera->keys[i][0], expected);
        }
    }
    dip_model_cameras_destroy(&cameras);
}

// Steps at 1/3, 2/3 and 100/120 s. As floats, some of these times lie after the path's own keys
// 40, 80 and 100. The steps are on these keys all the same.
static void a_camera_steps_on_the_key_of_its_time(void **state) {
    (void)state;
    static const float times_s[] = {0.0f, 1.0f / 3, 2.0f / 3, 100.0f / 120, 1.0f};
    static const float x[] = {0.0f, 1.0f, 2.0f, 3.0f, 4.0f};
    DipModelCameras *cameras = load(write_moving_camera("STEP", times_s, x, 5));
    const DipModelCamera *camera = animated(cameras);
    assert_int_equal(camera->key_count, 121);
    for (int i = 0; i < 121; ++i) {
        const int expected = i < 40 ? 0 : i < 80 ? 1 : i < 100 ? 2 : i < 120 ? 3 : 4;
        if (!(fabs(camera->keys[i][0] - expected) < 1e-9)) {
            fail_msg("key %d has x = %.9g, expected %d", i, camera->keys[i][0], expected);
        }
    }
    dip_model_cameras_destroy(&cameras);
}

// Writes a file whose node 0 has two animations along x, by "in" to 2 within a second and by "out"
// to 8, and node 1 a third by 100. The JSON lists the nodes.
static const char *write_animated_nodes(const char *nodes, const char *roots) {
    static const float numbers[] = {0, 1, 0, 0, 0, 2, 0, 0, 0, 0, 0, 8, 0, 0, 0, 0, 0, 100, 0, 0};
    char text[2400];
    fixture_write("three.bin", numbers, sizeof numbers);
    const int length = snprintf(
        text, sizeof text,
        "{\"asset\":{\"version\":\"2.0\"},\"cameras\":[{\"perspective\":{\"yfov\":0.8}}],"
        "\"nodes\":[%s],\"scenes\":[{\"nodes\":%s}],"
        "\"buffers\":[{\"byteLength\":80,\"uri\":\"three.bin\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":8},"
        "{\"buffer\":0,\"byteOffset\":8,\"byteLength\":72}],"
        "\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"type\":\"SCALAR\",\"count\":2},"
        "{\"bufferView\":1,\"componentType\":5126,\"type\":\"VEC3\",\"count\":2},"
        "{\"bufferView\":1,\"byteOffset\":24,\"componentType\":5126,\"type\":\"VEC3\",\"count\":2},"
        "{\"bufferView\":1,\"byteOffset\":48,\"componentType\":5126,\"type\":\"VEC3\",\"count\":2}"
        "],\"animations\":["
        "{\"name\":\"in\",\"samplers\":[{\"input\":0,\"output\":1}],\"channels\":[{\"sampler\":0,"
        "\"target\":{\"node\":0,\"path\":\"translation\"}}]},"
        "{\"name\":\"out\",\"samplers\":[{\"input\":0,\"output\":2}],\"channels\":[{\"sampler\":0,"
        "\"target\":{\"node\":0,\"path\":\"translation\"}}]},"
        "{\"name\":\"other\",\"samplers\":[{\"input\":0,\"output\":3}],\"channels\":[{\"sampler\":"
        "0,\"target\":{\"node\":1,\"path\":\"translation\"}}]}]}",
        nodes, roots);
    assert_true(length > 0 && (size_t)length < sizeof text);
    fixture_write_text("three.gltf", text);
    return fixture_path("three.gltf");
}

// A camera moves with the nodes above it, but not with those beside it. It has a path for each
// animation that moves it, which has the animation's name if there are several.
static void a_camera_moves_with_the_nodes_above_it(void **state) {
    (void)state;
    DipModelCameras *cameras =
        load(write_animated_nodes("{\"children\":[2]},{\"camera\":0,\"name\":\"beside\"},"
                                  "{\"children\":[3],\"translation\":[0,5,0],\"scale\":[2,2,2]},"
                                  "{\"camera\":0,\"name\":\"below\",\"translation\":[0,0,1]},"
                                  "{\"camera\":0,\"name\":\"still\",\"translation\":[7,0,0]}",
                                  "[0,1,4]"));
    static const struct {
        const char *name;
        double first[3], last[3];
        size_t keys;
    } expected[] = {{"beside", {0, 0, 0}, {100, 0, 0}, 121},
                    {"below/in", {0, 5, 2}, {2, 5, 2}, 121},
                    {"below/out", {0, 5, 2}, {8, 5, 2}, 121},
                    {"still", {7, 0, 0}, {7, 0, 0}, 1}};
    int count = 0;
    const DipModelCamera *list = dip_model_cameras_list(cameras, &count);
    assert_int_equal(count, 4);
    for (int i = 0; i < count; ++i) {
        assert_string_equal(list[i].name, expected[i].name);
        assert_int_equal(list[i].key_count, expected[i].keys);
        for (int axis = 0; axis < 3; ++axis) {
            const double first = list[i].keys[0][axis];
            const double last = list[i].keys[list[i].key_count - 1][axis];
            assert_true(fabs(first - expected[i].first[axis]) < 1e-9);
            assert_true(fabs(last - expected[i].last[axis]) < 1e-9);
        }
    }
    dip_model_cameras_destroy(&cameras);
}

// The longest animation has as many keys as a path may have, at the longest period. 3.6e9 is a
// float; the next one is 256 more.
static void animations_may_last_as_long_as_a_path(void **state) {
    (void)state;
    static const float x[] = {1.0f, 3.0f};
    static const float longest_s[] = {0.0f, 3.6e9f};
    static const float too_long_s[] = {0.0f, 3600000256.0f};
    DipModelCameras *cameras = load(write_moving_camera("LINEAR", longest_s, x, 2));
    const DipModelCamera *camera = animated(cameras);
    assert_int_equal(camera->key_count, 1000000);
    assert_true(camera->period_ns == 3600003600004); // 3.6e18 / 999999
    assert_true(fabs(camera->keys[0][0] - 1.0) < 1e-9);
    assert_true(fabs(camera->keys[999999][0] - 3.0) < 1e-9);
    assert_true(fabs(camera->keys[249999][0] - (1.0 + 2.0 * 249999.0 / 999999.0)) < 1e-6);
    dip_model_cameras_destroy(&cameras);
    assert_skipped(write_moving_camera("LINEAR", too_long_s, x, 2),
                   "its animation lasts too long, accepted up to 3.6e9 s");
}

// --- files ---------------------------------------------------------------------------------------

static void put_u32(uint8_t *to, uint32_t value) {
    for (int i = 0; i < 4; ++i) {
        to[i] = (uint8_t)(value >> 8 * i);
    }
}

// Writes a glb file whose chunks are `json` and `binary`, with spaces up to a multiple of 4 bytes.
static const char *write_glb(const char *json, const char *binary) {
    uint8_t glb[1000];
    const size_t json_bytes = (strlen(json) + 3) / 4 * 4;
    const size_t binary_bytes = (strlen(binary) + 3) / 4 * 4;
    const size_t total = 28 + json_bytes + binary_bytes;
    assert_true(total <= sizeof glb);
    memset(glb, ' ', sizeof glb);
    memcpy(glb, "glTF\2\0\0", 8);
    put_u32(glb + 8, (uint32_t)total);
    put_u32(glb + 12, (uint32_t)json_bytes);
    memcpy(glb + 16, "JSON", 4);
    memcpy(glb + 20, json, strlen(json));
    put_u32(glb + 20 + json_bytes, (uint32_t)binary_bytes);
    memcpy(glb + 24 + json_bytes, "BIN", 4);
    memcpy(glb + 28 + json_bytes, binary, strlen(binary));
    fixture_write("cameras.glb", glb, total);
    return fixture_path("cameras.glb");
}

static int count_of(const char *path) {
    DipModelCameras *cameras = load(path);
    int count = -1;
    dip_model_cameras_list(cameras, &count);
    dip_model_cameras_destroy(&cameras);
    return count;
}

// The cameras of a glb file stand in its JSON. Its binary chunk may hold any bytes, those of the
// word, too: the JSON here is malformed, but without cameras nobody reads it.
static void glb_files_have_their_cameras_in_the_json(void **state) {
    (void)state;
    assert_int_equal(
        count_of(write_glb("{\"asset\":{\"version\":\"2.0\"},\"cameras\":[{\"perspective\":{"
                           "\"yfov\":0.8}}],\"nodes\":[{\"camera\":0}]}",
                           "1234")),
        1);
    assert_int_equal(count_of(write_glb("{\"asset\":]", "\"cameras\"")), 0);
    DipError err = {0};
    assert_null(
        dip_model_cameras_load(write_glb("{\"asset\":] \"cameras\"", ""), DIP_UP_auto, NULL, &err));
    assert_int_equal(err.code, DIP_ERROR_FORMAT);
}

// Diptych looks for the word in blocks of 64 KiB, and must not miss it between two of them. The
// camera is the last thing in the file.
static void cameras_are_found_wherever_they_stand(void **state) {
    (void)state;
    static const char head[] = "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"camera\":0}],";
    static const char tail[] = "\"cameras\":[{\"perspective\":{\"yfov\":0.8}}]}";
    const size_t block = 65536;
    const size_t room = 2 * block + 200;
    char *text = malloc(room);
    assert_non_null(text);
    for (size_t blocks = 1; blocks <= 2; ++blocks) {
        for (size_t at = blocks * block - 30; at < blocks * block + 60; ++at) {
            memset(text, ' ', room);
            memcpy(text, head, sizeof head - 1);
            memcpy(text + at, tail, sizeof tail);
            fixture_write_text("blocks.gltf", text);
            if (count_of(fixture_path("blocks.gltf")) != 1) {
                fail_msg("no camera was found at byte %zu", at);
            }
        }
    }
    free(text);
}

static void other_files_have_no_cameras(void **state) {
    (void)state;
    fixture_write_text("cameras.obj", "# \"cameras\"\n");
    assert_int_equal(count_of(fixture_path("cameras.obj")), 0);
    assert_int_equal(count_of(fixture_path("no_such.obj")), 0);
    fixture_write_text("none.gltf", "{ no JSON");
    assert_int_equal(count_of(fixture_path("none.gltf")), 0);
    // The word alone makes no camera, and a table may be empty.
    fixture_write_text("none.GLTF", "{\"asset\":{\"version\":\"2.0\"},\"extras\":[\"cameras\"]}");
    assert_int_equal(count_of(fixture_path("none.GLTF")), 0);
    DipError err = {0};
    assert_null(dip_model_cameras_load(fixture_path("no_such.gltf"), DIP_UP_auto, NULL, &err));
    assert_int_equal(err.code, DIP_ERROR_MISSING);
}

static void malformed_cameras_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *members;
        const char *key;
        const char *reason;
    } cases[] = {
        {"\"cameras\":[{}],\"nodes\":[{\"camera\":1}]", "cameras", "the file uses item 1 of 1"},
        {"\"cameras\":[{}],\"nodes\":[{\"camera\":-1}]", "camera", "not an integer"},
        {"\"cameras\":[7],\"nodes\":[{\"camera\":0}]", "cameras", "item 0 is not an object"},
        {"\"cameras\":[{}],\"nodes\":[{\"children\":[1]},{\"children\":[0]}]", "children",
         "own ancestor"},
        {"\"cameras\":[{}],\"nodes\":[null]", "nodes", "item 0 is not an object"},
        {"\"cameras\":[{}],\"nodes\":[{\"scale\":[1,2]}]", "scale", "array of 3 finite numbers"},
        {"\"cameras\":[{}],\"animations\":[{\"samplers\":0}]", "samplers", "not an array"},
        {"\"cameras\":[{}],\"extensionsRequired\":[\"ACME\"]", "", "\"ACME\""},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        char text[300];
        snprintf(text, sizeof text, "{\"asset\":{\"version\":\"2.0\"},%s}", cases[i].members);
        fixture_write_text("malformed.gltf", text);
        DipError err = {0};
        assert_null(
            dip_model_cameras_load(fixture_path("malformed.gltf"), DIP_UP_auto, NULL, &err));
        if (!strstr(err.message, cases[i].reason) ||
            (cases[i].key[0] && strcmp(err.key, cases[i].key) != 0)) {
            fail_msg("case %zu: key %s, message \"%s\"", i, err.key, err.message);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_camera_has_a_name_of_its_own),
        cmocka_unit_test(as_many_cameras_are_read_as_stated),
        cmocka_unit_test(a_rotation_matrix_becomes_its_quaternion),
        cmocka_unit_test(the_up_axis_turns_cameras),
        cmocka_unit_test(scales_mirrors_and_shears_are_left_out),
        cmocka_unit_test(a_camera_follows_the_nodes_above_it),
        cmocka_unit_test(cameras_without_a_pose_are_skipped),
        cmocka_unit_test(lenses_that_cannot_be_drawn_are_skipped),
        cmocka_unit_test(a_camera_moves_evenly_between_keys),
        cmocka_unit_test(a_camera_steps_on_the_key_of_its_time),
        cmocka_unit_test(a_camera_moves_with_the_nodes_above_it),
        cmocka_unit_test(animations_may_last_as_long_as_a_path),
        cmocka_unit_test(glb_files_have_their_cameras_in_the_json),
        cmocka_unit_test(cameras_are_found_wherever_they_stand),
        cmocka_unit_test(other_files_have_no_cameras),
        cmocka_unit_test(malformed_cameras_are_refused),
    };
    return cmocka_run_group_tests(tests, fixture_open, fixture_close);
}
