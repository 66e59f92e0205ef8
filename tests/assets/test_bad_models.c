// Broken and hostile model files: each refused with its name, a reason and the right code.
#include "assets/model.h"
#include "tests/assets/fixture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

typedef struct BadFile {
    const char *name;
    DipErrorCode code;
    const char *reason; // part of the message
} BadFile;

static const BadFile bad_files[] = {
    {"no_such.gltf", DIP_ERROR_MISSING, "cannot open"},
    {"bad_empty.obj", DIP_ERROR_TRUNCATED, "empty"},
    {"bad_format.txt", DIP_ERROR_FORMAT, ".txt"},
    {".", DIP_ERROR_IO, "not a file"},
    {"bad_text.gltf", DIP_ERROR_FORMAT, "cannot be read"},
    {"bad_json.gltf", DIP_ERROR_FORMAT, "cannot be read"},
    {"bad_array.gltf", DIP_ERROR_FORMAT, "cannot be read"},
    {"bad_types.gltf", DIP_ERROR_FORMAT, "cannot be read"},
    {"bad_version.gltf", DIP_ERROR_FORMAT, "cannot be read"},
    {"bad_index.gltf", DIP_ERROR_RANGE, "vertex that is not there"},
    {"bad_index.obj", DIP_ERROR_FORMAT, "out of range"},
    {"bad_index_type.gltf", DIP_ERROR_FORMAT, "out of range"},
    {"bad_nan.gltf", DIP_ERROR_RANGE, "vertex 1 is not finite"},
    {"bad_nan.obj", DIP_ERROR_RANGE, "vertex 1 is not finite"},
    {"bad_infinite.gltf", DIP_ERROR_RANGE, "vertex 2 is not finite"},
    {"bad_transform.gltf", DIP_ERROR_RANGE, "not finite"},
    {"bad_accessor_count.gltf", DIP_ERROR_FORMAT, "out of range"},
    {"bad_accessor_huge.gltf", DIP_ERROR_FORMAT, "out of range"},
    {"bad_accessor_index.gltf", DIP_ERROR_FORMAT, "out of bounds"},
    {"bad_component_type.gltf", DIP_ERROR_FORMAT, "Component Type"},
    {"bad_view_index.gltf", DIP_ERROR_FORMAT, "out of bounds"},
    {"bad_view_length.gltf", DIP_ERROR_FORMAT, "out of range"},
    {"bad_view_offset.gltf", DIP_ERROR_FORMAT, "out of range"},
    {"bad_buffer_index.gltf", DIP_ERROR_FORMAT, "out of bounds"},
    {"bad_buffer_file.gltf", DIP_ERROR_FORMAT, "nowhere.bin"},
    {"bad_buffer_length.gltf", DIP_ERROR_FORMAT, "expected 1099511627776 bytes"},
    {"bad_mesh_index.gltf", DIP_ERROR_FORMAT, "out of bounds"},
    {"bad_material_index.gltf", DIP_ERROR_FORMAT, "out of bounds"},
    {"bad_texture_index.gltf", DIP_ERROR_FORMAT, "out of bounds"},
    {"bad_image_index.gltf", DIP_ERROR_FORMAT, "out of bounds"},
    {"bad_child_index.gltf", DIP_ERROR_FORMAT, "out of bounds"},
    {"bad_scene_node.gltf", DIP_ERROR_FORMAT, "out of bounds"},
    {"bad_scene_index.gltf", DIP_ERROR_FORMAT, "No scene"},
    {"bad_node_cycle.gltf", DIP_ERROR_FORMAT, "recursive"},
    {"bad_node_itself.gltf", DIP_ERROR_FORMAT, "recursive"},
    {"bad_draco.gltf", DIP_ERROR_FORMAT, "Draco"},
    {"bad_no_mesh.gltf", DIP_ERROR_MISSING, "no triangles"},
    {"bad_no_primitives.gltf", DIP_ERROR_MISSING, "no triangles"},
    {"bad_no_positions.gltf", DIP_ERROR_FORMAT, "no faces"},
    {"bad_only_lines.obj", DIP_ERROR_MISSING, "no triangles"},
    {"bad_picture_truncated.gltf", DIP_ERROR_TRUNCATED, "ends too early"},
    {"bad_picture_size.gltf", DIP_ERROR_RANGE, "9000 x 2"},
    {"bad_count.ply", DIP_ERROR_TRUNCATED, "99999999999"},
    {"bad_truncated.ply", DIP_ERROR_FORMAT, ""},
    {"bad_truncated.stl", DIP_ERROR_FORMAT, ""},
    {"bad_truncated.x", DIP_ERROR_FORMAT, ""},
};

static void assert_refused(const char *path, DipErrorCode code, const char *reason) {
    DipError err = {0};
    DipErrorList warnings = {0};
    DipModel *model = dip_model_load(&path, 1, NULL, &warnings, &err);
    if (model || err.code != code || !strstr(err.message, reason)) {
        fail_msg("%s: %s, code %s, message \"%s\"", path, model ? "accepted" : "refused",
                 dip_error_code_name(err.code), err.message);
    }
    const char *name = strrchr(path, '/') + 1;
    assert_non_null(strstr(err.file, name));
    assert_non_null(err.message[0] ? "" : NULL);
    assert_null(strchr(err.message, '\n'));
    dip_error_list_free(&warnings);
}

static void bad_files_are_refused(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof bad_files / sizeof bad_files[0]; ++i) {
        assert_refused(fixture_data(bad_files[i].name), bad_files[i].code, bad_files[i].reason);
    }
}

// A chain of nodes, each the child of the one before.
static void write_chain(const char *name, int depth) {
    FILE *file = fopen(fixture_path(name), "w");
    assert_non_null(file);
    fprintf(file, "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
                  "\"nodes\":[");
    for (int i = 0; i < depth; ++i) {
        fprintf(file, "{\"children\":[%d]},", i + 1);
    }
    fprintf(file, "{}]}");
    fclose(file);
}

static void deep_nesting_is_refused(void **state) {
    (void)state;
    write_chain("chain.gltf", 20000);
    assert_refused(fixture_path("chain.gltf"), DIP_ERROR_MISSING, "no triangles");
    write_chain("long_chain.gltf", 500000);
    assert_refused(fixture_path("long_chain.gltf"), DIP_ERROR_RANGE, "nested");
    char brackets[4000];
    memset(brackets, '[', sizeof brackets);
    fixture_write("brackets.gltf", brackets, sizeof brackets);
    assert_refused(fixture_path("brackets.gltf"), DIP_ERROR_RANGE, "nested 4000 deep");
}

static void cut_glb_is_refused(void **state) {
    (void)state;
    const uint8_t header[20] = {'g',  'l',  'T',  'F',  2,    0,    0,   0,   0xff, 0xff,
                                0xff, 0x7f, 0xff, 0xff, 0xff, 0x7f, 'J', 'S', 'O',  'N'};
    fixture_write("short.glb", header, 12);
    assert_refused(fixture_path("short.glb"), DIP_ERROR_TRUNCATED, "too early");
    fixture_write("cut.glb", header, sizeof header);
    assert_refused(fixture_path("cut.glb"), DIP_ERROR_FORMAT, "cannot be read");
}

static void off_counts_are_checked(void **state) {
    (void)state;
    fixture_write_text("many.off", "OFF\n# comment\n353535235358 6 0\n0 0 0\n");
    assert_refused(fixture_path("many.off"), DIP_ERROR_TRUNCATED, "353535235358");
    fixture_write_text("faces.off", "4nOFF 3\n3 4000000000 0\n0 0 0 0\n");
    assert_refused(fixture_path("faces.off"), DIP_ERROR_TRUNCATED, "4000000000");
}

static void assert_all_refused(const char *const *paths, int count, const char *culprit) {
    DipError err = {0};
    assert_null(dip_model_load(paths, count, NULL, NULL, &err));
    assert_non_null(strstr(err.file, culprit));
}

static void one_file_at_fault_fails_all(void **state) {
    (void)state;
    const char *files[2] = {fixture_data("square.gltf"), fixture_data("bad_nan.obj")};
    assert_all_refused(files, 2, "bad_nan.obj");
    assert_all_refused(files, 0, "");
    fixture_copy("square.obj");
    fixture_copy("square.mtl");
    fixture_write("colour.tga", "", 0);
    const char *obj = fixture_path("square.obj");
    assert_all_refused(&obj, 1, "colour.tga");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bad_files_are_refused),       cmocka_unit_test(deep_nesting_is_refused),
        cmocka_unit_test(cut_glb_is_refused),          cmocka_unit_test(off_counts_are_checked),
        cmocka_unit_test(one_file_at_fault_fails_all),
    };
    return cmocka_run_group_tests(tests, fixture_open, fixture_close);
}
