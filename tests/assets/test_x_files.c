// Tests of the materials of X files (DirectX) that meshes name by reference.
#include "assets/model.h"
#include "assets/x_references.h"
#include "tests/assets/fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#define HEADER                 "xof 0303txt 0032\n"
#define MATERIAL(name, colour) "Material " name " {\n" colour ";1;;\n0;\n0;0;0;;\n0;0;0;;\n}\n"
#define RED                    MATERIAL("RedM", "1;0;0")
#define GREEN                  MATERIAL("GreenM", "0;1;0")
#define BLUE                   MATERIAL("BlueM", "0;0;1")
// A triangle that begins at x.
#define MESH(x, list) "Mesh {\n3;\n" x ";0;0;,\n1;1;0;,\n0;1;1;;\n1;\n3;0,1,2;;\n" list "}\n"
// Two triangles, the first of which begins at x and the second at y.
#define TWO(x, y, list)                                                                            \
    "Mesh {\n6;\n" x ";0;0;,\n1;1;0;,\n0;1;1;,\n" y ";0;0;,\n1;1;0;,\n0;1;1;;\n2;\n3;0,1,2;,\n"    \
    "3;3,4,5;;\n" list "}\n"
#define LIST(entries)        "MeshMaterialList {\n1;\n1;\n0;;\n" entries "\n}\n"
#define LIST_OF_TWO(entries) "MeshMaterialList {\n2;\n2;\n0,\n1;;\n" entries "\n}\n"
#define FRAME(name, content)                                                                       \
    "Frame " name " {\nFrameTransformMatrix "                                                      \
    "{\n1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0;;\n}\n" content "}"        \
    "\n"

// --- helpers -------------------------------------------------------------------------------------

// Returns the material of the triangle that begins at x.
static const DipMaterialDef *material_at(const DipModel *model, float x) {
    const DipSceneDef *def = dip_model_scene_def(model);
    for (int i = 0; i < def->object_count; ++i) {
        const DipMeshDef *mesh = &def->meshes[def->objects[i].mesh];
        for (uint32_t v = 0; v < mesh->vertex_count; ++v) {
            if (mesh->positions[3 * v] == x) {
                return &def->materials[mesh->material];
            }
        }
    }
    fail_msg("no triangle begins at %g", (double)x);
    return NULL;
}

static void assert_colour(const DipModel *model, float x, const char *name, float r, float g,
                          float b) {
    const DipMaterialDef *material = material_at(model, x);
    assert_string_equal(material->name, name);
    assert_float_equal(material->base_colour_lin[0], r, 1e-6f);
    assert_float_equal(material->base_colour_lin[1], g, 1e-6f);
    assert_float_equal(material->base_colour_lin[2], b, 1e-6f);
}

static void assert_red(const DipModel *model, float x) {
    assert_colour(model, x, "RedM", 1.0f, 0.0f, 0.0f);
}

static void assert_green(const DipModel *model, float x) {
    assert_colour(model, x, "GreenM", 0.0f, 1.0f, 0.0f);
}

static void assert_blue(const DipModel *model, float x) {
    assert_colour(model, x, "BlueM", 0.0f, 0.0f, 1.0f);
}

static const DipModelOptions plain_options = {.normal_maps = false};

static DipModel *load(const char *text, DipErrorList *warnings) {
    fixture_write_text("materials.x", text);
    return fixture_load(fixture_path("materials.x"), &plain_options, warnings);
}

static DipModel *load_without_warnings(const char *text) {
    DipErrorList warnings = {0};
    DipModel *model = load(text, &warnings);
    if (warnings.count > 0) {
        fail_msg("%s", warnings.items[0].message);
    }
    return model;
}

// --- text ----------------------------------------------------------------------------------------

static void every_mesh_has_the_material_that_it_names(void **state) {
    (void)state;
    static const char *const texts[] = {
        HEADER RED BLUE MESH("5", LIST("{ BlueM }")) MESH("7", LIST("{ RedM }")),
        HEADER BLUE RED MESH("5", LIST("{BlueM}")) MESH("7", LIST("{RedM}")),
        HEADER MESH("5", LIST("{ BlueM }")) MESH("7", LIST("{ RedM }")) RED BLUE,
        HEADER RED MESH("5", LIST("{BlueM}")) BLUE MESH("7", LIST("{\tRedM\r\n}")),
        HEADER RED BLUE MESH("5", LIST("// { RedM }\n{ # no {\n BlueM // {\n}"))
            MESH("7", LIST("#\n{ RedM };")),
        HEADER TWO("5", "7", LIST_OF_TWO("{ BlueM }\n{ RedM }")) RED BLUE,
        HEADER RED BLUE TWO("5", "7", LIST_OF_TWO("{BlueM}{RedM}")),
        HEADER RED BLUE TWO("5", "7", LIST_OF_TWO("{BlueM}" RED)),
        HEADER BLUE TWO("5", "7", LIST_OF_TWO("{BlueM}" RED)) "\n}",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; ++i) {
        DipModel *model = load(texts[i], NULL);
        assert_blue(model, 5.0f);
        assert_red(model, 7.0f);
        dip_model_destroy(&model);
    }
}

static void meshes_of_one_name_share_a_material(void **state) {
    (void)state;
    DipModel *model = load_without_warnings(HEADER RED BLUE FRAME(
        "a", MESH("5", LIST("{ BlueM }")) FRAME("b", MESH("6", LIST("{ BlueM }"))))
                                                FRAME("c", MESH("7", LIST("{ RedM }"))));
    assert_blue(model, 5.0f);
    assert_blue(model, 6.0f);
    assert_red(model, 7.0f);
    assert_ptr_equal(material_at(model, 5.0f), material_at(model, 6.0f));
    assert_int_equal(dip_model_scene_def(model)->material_count, 2);
    dip_model_destroy(&model);
}

// assimp does not read materials inside frames.
static void materials_inside_frames_are_found(void **state) {
    (void)state;
    DipModel *model = load_without_warnings(HEADER RED FRAME(
        "a", FRAME("b", BLUE MESH("5", LIST("{ BlueM }"))) GREEN MESH("6", LIST("{ RedM }")))
                                                FRAME("c", MESH("7", LIST("{ GreenM }"))) "// end");
    assert_blue(model, 5.0f);
    assert_red(model, 6.0f);
    assert_green(model, 7.0f);
    dip_model_destroy(&model);
}

static void a_mesh_may_name_the_material_of_another(void **state) {
    (void)state;
    DipModel *model = load_without_warnings(HEADER GREEN MESH("4", LIST("{ BlueM }")) MESH(
        "5", LIST(BLUE)) MESH("6", LIST("{ BlueM }")) MESH("7", LIST("{ GreenM }")));
    for (float x = 4.0f; x < 7.0f; ++x) {
        assert_blue(model, x);
    }
    assert_green(model, 7.0f);
    dip_model_destroy(&model);
}

static void names_that_differ_in_case_are_different(void **state) {
    (void)state;
    DipModel *model = load_without_warnings(
        HEADER MATERIAL("paint", "1;0;0") MATERIAL("Paint", "0;1;0") MATERIAL("PAINT", "0;0;1")
            MESH("5", LIST("{ Paint }")) MESH("6", LIST("{ PAINT }")) MESH("7", LIST("{ paint }")));
    assert_colour(model, 5.0f, "Paint", 0.0f, 1.0f, 0.0f);
    assert_colour(model, 6.0f, "PAINT", 0.0f, 0.0f, 1.0f);
    assert_colour(model, 7.0f, "paint", 1.0f, 0.0f, 0.0f);
    dip_model_destroy(&model);
}

static void a_missing_material_gives_a_warning(void **state) {
    (void)state;
    DipErrorList warnings = {0};
    DipModel *model =
        load(HEADER RED BLUE MESH("4", LIST("{ GreenM }")) MESH("5", LIST("{ BlueM }"))
                 MESH("6", LIST("{ GreenM }")) MESH("7", LIST("{ redm }")),
             &warnings);
    const float grey = (float)pow((0.6 + 0.055) / 1.055, 2.4);
    assert_colour(model, 4.0f, "", grey, grey, grey);
    assert_blue(model, 5.0f);
    assert_colour(model, 6.0f, "", grey, grey, grey);
    assert_colour(model, 7.0f, "", grey, grey, grey);
    assert_int_equal(warnings.count, 2);
    assert_string_equal(warnings.items[0].message,
                        "a mesh names the material \"GreenM\", which the file does not have, so "
                        "its surface is grey");
    assert_non_null(strstr(warnings.items[1].message, "\"redm\""));
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
}

// A file may name very many missing materials. The warnings count those that they do not name.
static void many_missing_materials_are_counted(void **state) {
    (void)state;
    static char text[8000] = HEADER;
    for (int i = 0; i < 20; ++i) {
        char mesh[300];
        snprintf(mesh, sizeof mesh, MESH("%d", LIST("{ lost%d }")), i, i / 2);
        strcat(text, mesh);
    }
    DipErrorList warnings = {0};
    DipModel *model = load(text, &warnings);
    assert_int_equal(warnings.count, 9);
    assert_non_null(strstr(warnings.items[7].message, "\"lost7\""));
    assert_non_null(strstr(warnings.items[8].message, "4 more"));
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
}

static void rules_mark_the_mesh_that_names_the_material(void **state) {
    (void)state;
    fixture_write_text("rules.x", HEADER RED BLUE FRAME("a", GREEN) MESH("5", LIST("{ BlueM }"))
                                      MESH("6", LIST("{ GreenM }")) MESH("7", LIST("{ RedM }")));
    static const char *const names[] = {"BlueM", "GreenM", "RedM"};
    for (int i = 0; i < 3; ++i) {
        const DipMaterialRule rule = {.mark = DIP_MARK_WATER, .pattern = names[i]};
        const DipModelOptions options = {.rules = &rule, .rule_count = 1};
        DipModel *model = fixture_load(fixture_path("rules.x"), &options, NULL);
        for (int k = 0; k < 3; ++k) {
            const DipMaterialDef *material = material_at(model, (float)(5 + k));
            assert_int_equal(material->surface == DIP_SURFACE_WATER, i == k);
        }
        dip_model_destroy(&model);
    }
}

// Braces and comment signs inside a quoted text do not count.
static void textures_of_named_materials_are_found_beside_the_file(void **state) {
    (void)state;
    fixture_write_tga("a # }.tga", 2, 2, 100);
    DipModel *model = load_without_warnings(
        HEADER "Material Paint {\n1;1;1;1;;\n0;\n0;0;0;;\n0;0;0;;\nTextureFilename {\n"
               "\"a # }.tga\";\n}\n}\n" RED MESH("5", LIST("{ RedM }"))
                   MESH("7", "MeshTextureCoords {\n3;\n0;0;,\n1;0;,\n0;1;;\n}\n" LIST("{Paint}")));
    assert_red(model, 5.0f);
    assert_string_equal(material_at(model, 7.0f)->name, "Paint");
    assert_int_equal(material_at(model, 7.0f)->colour_texture, 0);
    assert_int_equal(dip_model_scene_def(model)->textures[0].rgba8[0], 100);
    dip_model_destroy(&model);
}

// The second file has the same lines, but no reference.
static void an_error_names_its_line_of_the_file(void **state) {
    (void)state;
    static const char *const texts[2] = {
        HEADER FRAME("a", BLUE MESH("5", LIST("{\nBlueM\n}"))) RED "Mesh {\nno number\n}\n",
        HEADER FRAME("a", BLUE MESH("5", LIST("\n\n"))) RED "Mesh {\nno number\n}\n"};
    DipError errors[2] = {0};
    for (int i = 0; i < 2; ++i) {
        fixture_write_text("line.x", texts[i]);
        const char *path = fixture_path("line.x");
        assert_null(dip_model_load(&path, 1, NULL, NULL, &errors[i]));
        assert_int_equal(errors[i].code, DIP_ERROR_FORMAT);
        assert_non_null(strstr(errors[i].file, "line.x"));
        assert_non_null(strstr(errors[i].message, "Line 3"));
    }
    assert_string_equal(errors[0].message, errors[1].message);
}

static DipXReferences read_references(const char *name) {
    DipXReferences references;
    DipError err = {0};
    if (!dip_x_references_read(fixture_path(name), &references, &err)) {
        fail_msg("%s", err.message);
    }
    return references;
}

static void a_file_without_references_is_read_as_it_is(void **state) {
    (void)state;
    static const char *const texts[] = {
        HEADER,
        "xof 0303txt 0032",
        "xof ",
        HEADER RED BLUE MESH("5", LIST(RED)),
        HEADER MESH("5", LIST("// { RedM }\n" RED)),
        HEADER "Frame {\n{ RedM }\n}\n" RED,
        HEADER MESH("5", LIST("{ RedM }")) RED "Frame {\n", // ends too early
        "solid " RED MESH("5", LIST("{ RedM }")),           // is no X file
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; ++i) {
        fixture_write_text("plain.x", texts[i]);
        DipXReferences references = read_references("plain.x");
        assert_null(references.text);
        dip_x_references_free(&references);
    }
}

// --- other kinds of files ------------------------------------------------------------------------

// Writes a binary file token by token.
typedef struct Bytes {
    uint8_t bytes[4000];
    size_t count;
} Bytes;

static void add(Bytes *to, const void *bytes, size_t size_bytes) {
    assert_true(to->count + size_bytes <= sizeof to->bytes);
    memcpy(to->bytes + to->count, bytes, size_bytes);
    to->count += size_bytes;
}

static void add_number(Bytes *to, uint32_t number, int bytes) {
    for (int i = 0; i < bytes; ++i) {
        const uint8_t byte = (uint8_t)(number >> (8 * i));
        add(to, &byte, 1);
    }
}

static void add_name(Bytes *to, const char *name) {
    add_number(to, 1, 2);
    add_number(to, (uint32_t)strlen(name), 4);
    add(to, name, strlen(name));
}

static void add_open(Bytes *to) {
    add_number(to, 0x0a, 2);
}

static void add_close(Bytes *to) {
    add_number(to, 0x0b, 2);
}

static void add_integers(Bytes *to, int count, const uint32_t *values) {
    add_number(to, 6, 2);
    add_number(to, (uint32_t)count, 4);
    for (int i = 0; i < count; ++i) {
        add_number(to, values[i], 4);
    }
}

static void add_floats(Bytes *to, bool doubles, int count, const float *values) {
    add_number(to, 7, 2);
    add_number(to, (uint32_t)count, 4);
    for (int i = 0; i < count; ++i) {
        const double wide = (double)values[i];
        add(to, doubles ? (const void *)&wide : &values[i], doubles ? 8 : 4);
    }
}

static void add_material(Bytes *to, bool doubles, const char *name, float red, float blue) {
    const float values[11] = {red, 0.0f, blue, 1.0f};
    add_name(to, "Material");
    add_name(to, name);
    add_open(to);
    add_floats(to, doubles, 11, values);
    add_close(to);
}

static void add_mesh(Bytes *to, bool doubles, float x, const char *material) {
    const uint32_t three = 3;
    const float corners[9] = {x, 0.0f, 0.0f, 1.0f, 1.0f, 0.0f, 0.0f, 1.0f, 1.0f};
    const uint32_t faces[5] = {1, 3, 0, 1, 2};
    const uint32_t list[3] = {1, 1, 0};
    add_name(to, "Mesh");
    add_open(to);
    add_integers(to, 1, &three);
    add_floats(to, doubles, 9, corners);
    add_integers(to, 5, faces);
    add_name(to, "MeshMaterialList");
    add_open(to);
    add_integers(to, 3, list);
    add_open(to);
    add_name(to, material);
    add_close(to);
    add_close(to);
    add_close(to);
}

static void binary_files_are_drawn_alike(void **state) {
    (void)state;
    for (int doubles = 0; doubles < 2; ++doubles) {
        Bytes file = {.count = 0};
        const char *header = doubles ? "xof 0303bin 0064" : "xof 0303bin 0032";
        const char *guid = "0123456789abcdef";
        add(&file, header, 16);
        add_number(&file, 0x1f, 2); // a template of the lists
        add_name(&file, "MeshMaterialList");
        add_open(&file);
        add_number(&file, 5, 2);
        add(&file, guid, 16);
        add_number(&file, 0x29, 2); // DWORD
        add_name(&file, "nMaterials");
        add_number(&file, 0x14, 2); // semicolon
        add_close(&file);
        add_name(&file, "Frame");
        add_open(&file);
        add_mesh(&file, doubles, 4.0f, "BlueM");
        add_close(&file);
        add_material(&file, doubles, "RedM", 1.0f, 0.0f);
        add_name(&file, "Frame");
        add_open(&file);
        add_material(&file, doubles, "BlueM", 0.0f, 1.0f);
        add_mesh(&file, doubles, 5.0f, "BlueM");
        add_close(&file);
        add_name(&file, "Frame");
        add_open(&file);
        add_mesh(&file, doubles, 7.0f, "RedM");
        add_close(&file);
        fixture_write("binary.x", file.bytes, file.count);
        DipErrorList warnings = {0};
        DipModel *model = fixture_load(fixture_path("binary.x"), &plain_options, &warnings);
        assert_int_equal(warnings.count, 0);
        assert_blue(model, 4.0f);
        assert_blue(model, 5.0f);
        assert_red(model, 7.0f);
        dip_model_destroy(&model);
    }
}

// A string is followed by the token that ends it. The material after it must be found all the same:
// the mesh names it, and it stands in a frame. In the string are the bytes of an opening brace.
static void strings_of_binary_files_are_skipped(void **state) {
    (void)state;
    static const char picture[] = "a\012\0b.png";
    const float values[11] = {1.0f, 1.0f, 0.0f, 1.0f};
    for (uint32_t length = 1; length < sizeof picture; ++length) {
        Bytes file = {.count = 0};
        add(&file, "xof 0303bin 0032", 16);
        add_name(&file, "Frame");
        add_open(&file);
        add_name(&file, "Material");
        add_name(&file, "Other");
        add_open(&file);
        add_floats(&file, false, 11, values);
        add_name(&file, "TextureFilename");
        add_open(&file);
        add_number(&file, 2, 2); // a string
        add_number(&file, length, 4);
        add(&file, picture, length);
        add_number(&file, 0x14, 2); // semicolon
        add_close(&file);
        add_close(&file);
        add_material(&file, false, "BlueM", 0.0f, 1.0f);
        add_close(&file);
        add_mesh(&file, false, 5.0f, "BlueM");
        fixture_write("string.x", file.bytes, file.count);
        DipModel *model = fixture_load(fixture_path("string.x"), &plain_options, NULL);
        assert_blue(model, 5.0f);
        dip_model_destroy(&model);
    }
}

// The compressed file has one block, which is stored and not deflated.
static void a_compressed_file_gives_a_warning(void **state) {
    (void)state;
    static const char text[] = RED BLUE MESH("5", LIST("{ BlueM }")) MESH("7", LIST("{ RedM }"));
    const uint32_t length = sizeof text - 1;
    Bytes file = {.count = 0};
    add(&file, "xof 0303tzip0032", 16);
    add_number(&file, 0, 4); // size of the file, which assimp skips
    add_number(&file, length, 2);
    add_number(&file, length + 7, 2);
    add(&file, "CK\1", 3); // magic; the last block of the stream, stored
    add_number(&file, length, 2);
    add_number(&file, ~length & 0xffff, 2);
    add(&file, text, length);
    fixture_write("compressed.x", file.bytes, file.count);
    DipErrorList warnings = {0};
    DipModel *model = fixture_load(fixture_path("compressed.x"), &plain_options, &warnings);
    if (warnings.count == 0) { // a version of assimp that finds materials by their names
        assert_blue(model, 5.0f);
        assert_red(model, 7.0f);
    } else {
        assert_int_equal(warnings.count, 1);
        assert_non_null(strstr(warnings.items[0].message, "the file is compressed"));
    }
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
}

// Each file is a part of a good one with some bytes exchanged. Nothing may be read beyond its end,
// which the address sanitizer checks.
static void broken_files_are_searched_safely(void **state) {
    (void)state;
    static const char text[] = HEADER RED FRAME("a", BLUE MESH("5", LIST("{ BlueM }")))
        TWO("6", "7", LIST_OF_TWO("{ RedM }\n{ \"a }")) "Material { } // \"";
    Bytes binary = {.count = 0};
    add(&binary, "xof 0303bin 0032", 16);
    add_material(&binary, false, "RedM", 1.0f, 0.0f);
    add_mesh(&binary, false, 5.0f, "RedM");
    static const uint8_t odd[] = "{}{}{}{}\";#/,\n \1\7\12\13\xff\x80";
    uint32_t random = 1;
    for (int i = 0; i < 600; ++i) {
        uint8_t bytes[4000];
        const bool is_binary = i % 2 == 1;
        const size_t whole = is_binary ? binary.count : sizeof text - 1;
        memcpy(bytes, is_binary ? (const void *)binary.bytes : text, whole);
        for (int k = 0; k < i % 7; ++k) {
            random = random * 1664525u + 1013904223u;
            bytes[16 + (random >> 8) % (whole - 16)] = odd[(random >> 24) % (sizeof odd - 1)];
        }
        random = random * 1664525u + 1013904223u;
        const size_t length = i % 3 == 0 ? (random >> 8) % whole + 1 : whole;
        fixture_write("broken.x", bytes, length);
        DipXReferences references = read_references("broken.x");
        // The text has every byte of the file but the names, or the file is read itself.
        assert_true(!references.text || references.text_bytes > length);
        dip_x_references_free(&references);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_mesh_has_the_material_that_it_names),
        cmocka_unit_test(meshes_of_one_name_share_a_material),
        cmocka_unit_test(materials_inside_frames_are_found),
        cmocka_unit_test(a_mesh_may_name_the_material_of_another),
        cmocka_unit_test(names_that_differ_in_case_are_different),
        cmocka_unit_test(a_missing_material_gives_a_warning),
        cmocka_unit_test(many_missing_materials_are_counted),
        cmocka_unit_test(rules_mark_the_mesh_that_names_the_material),
        cmocka_unit_test(textures_of_named_materials_are_found_beside_the_file),
        cmocka_unit_test(an_error_names_its_line_of_the_file),
        cmocka_unit_test(a_file_without_references_is_read_as_it_is),
        cmocka_unit_test(binary_files_are_drawn_alike),
        cmocka_unit_test(strings_of_binary_files_are_skipped),
        cmocka_unit_test(a_compressed_file_gives_a_warning),
        cmocka_unit_test(broken_files_are_searched_safely),
    };
    return cmocka_run_group_tests_name("x_files", tests, fixture_open, fixture_close);
}
