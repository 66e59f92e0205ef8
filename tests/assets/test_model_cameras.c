// Tests the names and the number of the cameras that a glTF file has.
#include "assets/cameras.h"
#include "fixture.h"

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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_camera_has_a_name_of_its_own),
        cmocka_unit_test(as_many_cameras_are_read_as_stated),
    };
    return cmocka_run_group_tests(tests, fixture_open, fixture_close);
}
