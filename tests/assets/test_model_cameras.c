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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_camera_has_a_name_of_its_own),
        cmocka_unit_test(as_many_cameras_are_read_as_stated),
        cmocka_unit_test(a_camera_moves_evenly_between_keys),
        cmocka_unit_test(a_camera_steps_on_the_key_of_its_time),
    };
    return cmocka_run_group_tests(tests, fixture_open, fixture_close);
}
