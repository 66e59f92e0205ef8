// Tests broken and hostile model files. Each file must be refused. The error must have the file's
// name, a reason and the right code.
#include "assets/model_parts.h"
#include "tests/assets/fixture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>
#include <cmocka.h>

typedef struct BadFile {
    const char *name;
    DipErrorCode code;
    const char *reason; // text that the message contains
} BadFile;

static const BadFile bad_files[] = {
    {"no_such.gltf", DIP_ERROR_MISSING, "cannot open"},
    {"bad_empty.obj", DIP_ERROR_TRUNCATED, "empty"},
    {"bad_format.txt", DIP_ERROR_FORMAT, "\".txt\" is not a supported model format"},
    {".", DIP_ERROR_IO, "give the model file inside the folder"},
    {"pictures/bc1.dds", DIP_ERROR_FORMAT, "open the model, and its pictures"},
    {"bad_text.gltf", DIP_ERROR_FORMAT, "malformed at byte"},
    {"bad_json.gltf", DIP_ERROR_TRUNCATED, "ends too early"},
    {"bad_array.gltf", DIP_ERROR_FORMAT, "cannot be read"},
    {"bad_types.gltf", DIP_ERROR_FORMAT, "this is not an array"},
    {"bad_version.gltf", DIP_ERROR_FORMAT, "not glTF of version 2"},
    {"bad_index.gltf", DIP_ERROR_RANGE, "there are 4 vertices"},
    {"bad_index.obj", DIP_ERROR_FORMAT, "out of range"},
    {"bad_index.ply", DIP_ERROR_RANGE, "face 0 uses vertex 3 of 3"},
    {"bad_index_type.gltf", DIP_ERROR_RANGE, ""},
    {"bad_nan.gltf", DIP_ERROR_RANGE, "value 1 is not finite"},
    {"bad_nan.obj", DIP_ERROR_RANGE, "vertex 1 is not finite"},
    {"bad_infinite.gltf", DIP_ERROR_RANGE, "value 2 is not finite"},
    {"bad_transform.gltf", DIP_ERROR_RANGE, "not finite"},
    {"bad_accessor_count.gltf", DIP_ERROR_RANGE, "beyond its view"},
    {"bad_accessor_huge.gltf", DIP_ERROR_RANGE, "not an integer"},
    {"bad_accessor_index.gltf", DIP_ERROR_RANGE, "the file uses item"},
    {"bad_component_type.gltf", DIP_ERROR_FORMAT, "another type"},
    {"bad_view_index.gltf", DIP_ERROR_RANGE, "the file uses item"},
    {"bad_view_length.gltf", DIP_ERROR_RANGE, "beyond its buffer"},
    {"bad_view_offset.gltf", DIP_ERROR_RANGE, "beyond its buffer"},
    {"bad_buffer_index.gltf", DIP_ERROR_RANGE, "the file uses item"},
    {"bad_buffer_file.gltf", DIP_ERROR_MISSING, "nowhere.bin"},
    {"bad_buffer_length.gltf", DIP_ERROR_RANGE, "not an integer"},
    {"bad_mesh_index.gltf", DIP_ERROR_RANGE, "the file uses item"},
    {"bad_material_index.gltf", DIP_ERROR_RANGE, "the file uses item"},
    {"bad_texture_index.gltf", DIP_ERROR_RANGE, "the file uses item"},
    {"bad_image_index.gltf", DIP_ERROR_RANGE, "the file uses item"},
    {"bad_child_index.gltf", DIP_ERROR_RANGE, "a child that is not a node"},
    {"bad_scene_node.gltf", DIP_ERROR_RANGE, "a node that does not exist"},
    {"bad_scene_index.gltf", DIP_ERROR_RANGE, "the file uses item"},
    {"bad_node_cycle.gltf", DIP_ERROR_FORMAT, "own ancestor"},
    {"bad_node_itself.gltf", DIP_ERROR_FORMAT, "own ancestor"},
    {"bad_uv_count.gltf", DIP_ERROR_RANGE, "one for each of"},
    {"bad_sparse.gltf", DIP_ERROR_RANGE, ""},
    {"bad_no_mesh.gltf", DIP_ERROR_MISSING, "no triangles"},
    {"bad_no_primitives.gltf", DIP_ERROR_MISSING, "no triangles"},
    {"bad_no_positions.gltf", DIP_ERROR_FORMAT, "no positions"},
    {"bad_only_lines.obj", DIP_ERROR_MISSING, "no triangles"},
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

// Writes a file whose nodes form a chain: each node is the child of the previous node.
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
    assert_refused(fixture_path("long_chain.gltf"), DIP_ERROR_MISSING, "no triangles");
    char brackets[4000];
    memset(brackets, '[', sizeof brackets);
    fixture_write("brackets.gltf", brackets, sizeof brackets);
    assert_refused(fixture_path("brackets.gltf"), DIP_ERROR_RANGE, "nested 4000 deep");
}

static void a_cut_glb_file_is_refused(void **state) {
    (void)state;
    const uint8_t header[20] = {'g',  'l',  'T',  'F',  2,    0,    0,   0,   0xff, 0xff,
                                0xff, 0x7f, 0xff, 0xff, 0xff, 0x7f, 'J', 'S', 'O',  'N'};
    fixture_write("short.glb", header, 12);
    assert_refused(fixture_path("short.glb"), DIP_ERROR_TRUNCATED, "too early");
    fixture_write("cut.glb", header, sizeof header);
    assert_refused(fixture_path("cut.glb"), DIP_ERROR_TRUNCATED, "too early");
}

// --- glTF 1, which assimp reads ------------------------------------------------------------------

// A triangle of glTF 1. Its JSON has three arrays. `more` follows the last member.
static const char *gltf_1(const char *more) {
    static const float numbers[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    static char text[4000];
    fixture_write("one.bin", numbers, sizeof numbers);
    snprintf(text, sizeof text,
             "{\"asset\":{\"version\":\"1.0\"},\"scene\":\"s\",\"scenes\":{\"s\":{\"nodes\":"
             "[\"n\"]}},\"nodes\":{\"n\":{\"meshes\":[\"m\"]}},\"buffers\":{\"b\":{\"byteLength\":"
             "36,\"type\":\"arraybuffer\",\"uri\":\"one.bin\"}},\"bufferViews\":{\"v\":{"
             "\"buffer\":\"b\",\"byteOffset\":0,\"byteLength\":36}},\"accessors\":{\"a\":{"
             "\"bufferView\":\"v\",\"byteOffset\":0,\"byteStride\":12,\"componentType\":5126,"
             "\"count\":3,\"type\":\"VEC3\"}},\"meshes\":{\"m\":{\"primitives\":[{\"attributes\":{"
             "\"POSITION\":\"a\"},\"mode\":4}]}}%s}",
             more);
    return text;
}

static void assert_loads(const char *path) {
    DipModel *model = fixture_load(path, NULL, NULL);
    assert_int_equal(dip_model_scene_def(model)->object_count, 1);
    dip_model_destroy(&model);
}

// Brackets in strings do not count, also behind a quotation mark that is escaped.
static void gltf_1_has_at_most_400000_arrays(void **state) {
    (void)state;
    enum { MOST = 400000, OWN = 3 };
    const char *text = gltf_1(",\"texts\":\"[\\\"[\\\\\",\"more\":[");
    const size_t begin_bytes = strlen(text) - 1;
    char *file = malloc(begin_bytes + 3 * MOST + 10);
    memcpy(file, text, begin_bytes);
    for (int over = 0; over < 2; ++over) {
        size_t at = begin_bytes;
        for (int i = OWN + 1; i < MOST + over; ++i) {
            memcpy(file + at, "[],", 3);
            at += 3;
        }
        memcpy(file + at - 1, "]}", 2); // instead of the last comma
        fixture_write("arrays.gltf", file, at + 1);
        if (over) {
            assert_refused(fixture_path("arrays.gltf"), DIP_ERROR_RANGE,
                           "JSON is nested 6 deep and has 400001 arrays, accepted 512 and 400000");
        } else {
            assert_loads(fixture_path("arrays.gltf"));
        }
    }
    free(file);
}

// Writes a binary file of glTF 1. It begins with the version, its own length, the length of the
// JSON and the kind 0.
static const char *write_glb_1(const char *text, uint32_t claimed, size_t size_bytes) {
    uint8_t bytes[4000];
    const uint32_t length = (uint32_t)strlen(text);
    const uint32_t header[5] = {0x46546c67, 1, 20 + length, claimed, 0};
    assert_true(size_bytes <= sizeof bytes);
    memcpy(bytes, header, 20); // little-endian, as the file
    memcpy(bytes + 20, text, length);
    fixture_write("one.glb", bytes, size_bytes);
    return fixture_path("one.glb");
}

// A file of less than 12 bytes is not known to be binary.
static void a_cut_glb_file_of_gltf_1_is_refused(void **state) {
    (void)state;
    const char *text = gltf_1("");
    const uint32_t length = (uint32_t)strlen(text);
    assert_loads(write_glb_1(text, length, 20 + length));
    assert_refused(write_glb_1(text, length + 1, 20 + length), DIP_ERROR_TRUNCATED,
                   "the model file ends too early");
    for (size_t cut = 12; cut < 20 + length; ++cut) {
        assert_refused(write_glb_1(text, length, cut), DIP_ERROR_TRUNCATED,
                       "the model file ends too early");
    }
}

// One array within another, besides the object around them.
static void a_glb_file_of_gltf_1_nests_at_most_512_deep(void **state) {
    (void)state;
    for (int over = 0; over < 2; ++over) {
        char more[1100] = ",\"deep\":";
        const size_t at = strlen(more);
        const size_t arrays = (size_t)(511 + over);
        memset(more + at, '[', arrays);
        memset(more + at + arrays, ']', arrays);
        const char *text = gltf_1(more);
        const char *path = write_glb_1(text, (uint32_t)strlen(text), 20 + strlen(text));
        if (over) {
            assert_refused(path, DIP_ERROR_RANGE,
                           "JSON is nested 513 deep and has 515 arrays, accepted 512 and 400000");
        } else {
            assert_true(dip_model_precheck(path, NULL)); // assimp has limits of its own.
        }
    }
}

// To open a named pipe would wait for a program that writes to it.
static void a_named_pipe_is_refused(void **state) {
    (void)state;
    assert_int_equal(mkfifo(fixture_path("pipe.obj"), 0600), 0);
    assert_refused(fixture_path("pipe.obj"), DIP_ERROR_IO, "the model is not a regular file");
    assert_int_equal(symlink("/dev/null", fixture_path("null.obj")), 0);
    assert_refused(fixture_path("null.obj"), DIP_ERROR_IO, "the model is not a regular file");
}

// The address of a socket is there, but no program can open it as a file.
static void a_file_that_cannot_be_opened_is_refused(void **state) {
    (void)state;
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    const char *path = fixture_path("socket.obj");
    assert_true(strlen(path) < sizeof address.sun_path);
    strcpy(address.sun_path, path);
    const int listener = socket(AF_UNIX, SOCK_STREAM, 0);
    assert_true(listener >= 0);
    assert_int_equal(bind(listener, (const struct sockaddr *)&address, sizeof address), 0);
    assert_refused(path, DIP_ERROR_IO, "cannot open the model: ");
    close(listener);
}

static void impossible_counts_in_off_files_are_refused(void **state) {
    (void)state;
    fixture_write_text("many.off", "OFF\n# comment\n353535235358 6 0\n0 0 0\n");
    assert_refused(fixture_path("many.off"), DIP_ERROR_TRUNCATED, "353535235358");
    fixture_write_text("faces.off", "4nOFF 3\n3 4000000000 0\n0 0 0 0\n");
    assert_refused(fixture_path("faces.off"), DIP_ERROR_TRUNCATED, "4000000000");
}

static const char *write_gltf(const char *name, const char *members) {
    char text[1000];
    snprintf(text, sizeof text, "{\"asset\":{\"version\":\"2.0\"},%s}", members);
    fixture_write_text(name, text);
    return fixture_path(name);
}

static void required_extensions_that_cannot_be_decoded_are_refused(void **state) {
    (void)state;
    static const char *const members[] = {
        "\"extensionsRequired\":[\"ACME_packing\"]",
        "\"extensionsUsed\":[\"A\"],\"extensionsRequired\" : [ \"KHR_materials_unlit\",\n"
        "\"ACME_packing\", \"B\"]",
        "\"asset2\":\"\\\"extensionsRequired\",\"extensionsRequired\":[\"ACME_packing\"],"
        "\"nodes\":[]",
    };
    for (size_t i = 0; i < sizeof members / sizeof members[0]; ++i) {
        assert_refused(write_gltf("required.gltf", members[i]), DIP_ERROR_UNSUPPORTED,
                       "needs the glTF extension \"ACME_packing\", which cannot be decoded, "
                       "accepted those of docs/models.md");
    }
    assert_refused(write_gltf("control.gltf", "\"extensionsRequired\":[\"a\\tb\"]"),
                   DIP_ERROR_UNSUPPORTED, "\"a?b\"");
}

// Every extension that these files require can be decoded. The files are refused only because they
// are empty.
static void other_mentions_of_extensions_are_ignored(void **state) {
    (void)state;
    static const char *const members[] = {
        "\"extensionsUsed\":[\"ACME_packing\"]",
        "\"extensionsRequired\":[]",
        "\"extensionsRequired\":[\"KHR_materials_unlit\",\"KHR_lights_punctual\"]",
        "\"extras\":{\"extensionsRequired\":[\"ACME_packing\"]}",
        "\"extensionsRequired\":[],\"extensionsUsed\":[\"ACME_packing\"]",
    };
    for (size_t i = 0; i < sizeof members / sizeof members[0]; ++i) {
        assert_refused(write_gltf("mentions.gltf", members[i]), DIP_ERROR_MISSING, "no triangles");
    }
}

static void required_extensions_in_glb_files_are_refused_too(void **state) {
    (void)state;
    static const char json[] =
        "{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"ACME_packing\"]}";
    uint8_t glb[200] = {'g', 'l', 'T', 'F', 2, [12] = sizeof json - 1, [16] = 'J', 'S', 'O', 'N'};
    glb[8] = (uint8_t)(20 + sizeof json - 1);
    memcpy(glb + 20, json, sizeof json - 1);
    fixture_write("required.glb", glb, 20 + sizeof json - 1);
    assert_refused(fixture_path("required.glb"), DIP_ERROR_UNSUPPORTED, "ACME_packing");
}

// A file of a later version may say that programs for version 2.0 can read it.
static void files_for_later_versions_are_refused(void **state) {
    (void)state;
    static const char head[] = "{\"asset\":{\"version\":\"2.%d\",\"minVersion\":\"2.%d\"}}";
    char text[80];
    snprintf(text, sizeof text, head, 1, 1);
    fixture_write_text("later.gltf", text);
    assert_refused(fixture_path("later.gltf"), DIP_ERROR_UNSUPPORTED, "newer version");
    snprintf(text, sizeof text, head, 1, 0);
    fixture_write_text("later.gltf", text);
    assert_refused(fixture_path("later.gltf"), DIP_ERROR_MISSING, "no triangles");
}

// The file says that Draco has packed its mesh, but holds something else. A build without Draco
// names the package instead.
static void malformed_draco_meshes_are_refused(void **state) {
    (void)state;
    const char *path = fixture_data("bad_draco.gltf");
    DipError err = {0};
    assert_null(dip_model_load(&path, 1, NULL, NULL, &err));
    assert_true(err.code == DIP_ERROR_FORMAT || err.code == DIP_ERROR_UNSUPPORTED);
    assert_true(strstr(err.message, "malformed") || strstr(err.message, "libdraco-dev"));
}

// Finds bytes in others. Fails the running test if they do not stand there.
static uint8_t *find_bytes(uint8_t *bytes, size_t size, const void *wanted, size_t wanted_size) {
    for (size_t i = 0; i + wanted_size <= size; ++i) {
        if (memcmp(bytes + i, wanted, wanted_size) == 0) {
            return bytes + i;
        }
    }
    fail_msg("the file has another layout");
    return NULL;
}

// assimp's own binary format holds the numbers of meshes, materials and vertices as assimp has
// them in memory, and assimp does not check them. The file, which assimp 5.2.4 exported, has one
// mesh, one material and three vertices. One number gets beyond its list by one. Chunk 0x1237 is
// the mesh. The number of the node's mesh stands before it, its own last number is that of the
// triangle's last vertex.
static void numbers_beyond_assimps_lists_are_refused(void **state) {
    (void)state;
    size_t size_bytes = 0;
    uint8_t *bytes = fixture_read(fixture_data("triangle.assbin"), &size_bytes);
    DipModel *model = fixture_load(fixture_data("triangle.assbin"), NULL, NULL);
    dip_model_destroy(&model);
    const uint32_t mesh_chunk = 0x1237;
    uint8_t *mesh = find_bytes(bytes, size_bytes, &mesh_chunk, sizeof mesh_chunk);
    uint32_t mesh_bytes;
    memcpy(&mesh_bytes, mesh + 4, sizeof mesh_bytes);
    // Kinds of primitives, then the numbers of vertices, faces and bones, then the material.
    const uint32_t counts[] = {4, 3, 1, 0, 0};
    const struct {
        uint8_t *number;
        uint8_t too_great;
        const char *reason;
    } cases[] = {
        {mesh - 4, 1, "the node uses mesh 1 of 1"},
        {find_bytes(mesh, mesh_bytes, counts, sizeof counts) + 4 * sizeof counts[0], 1,
         "uses material 1 of 1"},
        {mesh + 8 + mesh_bytes - 2, 3, "face 0 uses vertex 3 of 3"}, // two bytes, not four
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        assert_int_equal(*cases[i].number, cases[i].too_great - 1);
        ++*cases[i].number;
        fixture_write("beyond.assbin", bytes, size_bytes);
        assert_refused(fixture_path("beyond.assbin"), DIP_ERROR_RANGE, cases[i].reason);
        --*cases[i].number;
    }
    free(bytes);
}

static void assert_all_refused(const char *const *paths, int count, const char *culprit) {
    DipError err = {0};
    assert_null(dip_model_load(paths, count, NULL, NULL, &err));
    assert_non_null(strstr(err.file, culprit));
}

static void one_bad_file_fails_the_whole_load(void **state) {
    (void)state;
    const char *files[2] = {fixture_data("square.gltf"), fixture_data("bad_nan.obj")};
    assert_all_refused(files, 2, "bad_nan.obj");
    assert_all_refused(files, 0, "");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bad_files_are_refused),
        cmocka_unit_test(deep_nesting_is_refused),
        cmocka_unit_test(a_cut_glb_file_is_refused),
        cmocka_unit_test(gltf_1_has_at_most_400000_arrays),
        cmocka_unit_test(a_cut_glb_file_of_gltf_1_is_refused),
        cmocka_unit_test(a_glb_file_of_gltf_1_nests_at_most_512_deep),
        cmocka_unit_test(a_named_pipe_is_refused),
        cmocka_unit_test(a_file_that_cannot_be_opened_is_refused),
        cmocka_unit_test(impossible_counts_in_off_files_are_refused),
        cmocka_unit_test(required_extensions_that_cannot_be_decoded_are_refused),
        cmocka_unit_test(other_mentions_of_extensions_are_ignored),
        cmocka_unit_test(required_extensions_in_glb_files_are_refused_too),
        cmocka_unit_test(files_for_later_versions_are_refused),
        cmocka_unit_test(malformed_draco_meshes_are_refused),
        cmocka_unit_test(numbers_beyond_assimps_lists_are_refused),
        cmocka_unit_test(one_bad_file_fails_the_whole_load),
    };
    return cmocka_run_group_tests(tests, fixture_open, fixture_close);
}
