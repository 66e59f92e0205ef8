// Tests of what the loader mends or decides where model files are broken, incomplete or ambiguous:
// broken pictures, generated texture coordinates, colours that are none, and the up axis.
#include "assets/model.h"
#include "tests/assets/fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cmocka.h>

static DipModel *load_up(const char *path, DipUpAxis up, DipErrorList *warnings) {
    const DipModelOptions options = {.normal_maps = true, .up = up};
    DipError err = {0};
    DipModel *model = dip_model_load_with(&path, 1, &options, NULL, warnings, &err);
    if (!model) {
        fail_msg("%s: %s", path, err.message);
    }
    return model;
}

static DipModel *load(const char *path, DipErrorList *warnings) {
    return load_up(path, DIP_UP_auto, warnings);
}

static DipModel *load_text(const char *name, const char *text) {
    fixture_write_text(name, text);
    return load(fixture_path(name), NULL);
}

// --- broken pictures -----------------------------------------------------------------------------

// The model is drawn in its base colour, and one line names the picture and the cause.
static void assert_drawn_without_picture(const char *path, const char *picture, const char *cause) {
    DipErrorList warnings = {0};
    DipModel *model = load(path, &warnings);
    const DipSceneDef *def = dip_model_scene_def(model);
    assert_true(def->object_count > 0);
    assert_int_equal(def->texture_count, 0);
    assert_int_equal(def->materials[0].colour_texture, DIP_NO_TEXTURE);
    bool found = false;
    for (size_t i = 0; i < warnings.count; ++i) {
        const DipError *warning = &warnings.items[i];
        assert_int_equal(warning->severity, DIP_SEVERITY_WARNING);
        found = found || (strstr(warning->file, picture) && strstr(warning->message, cause) &&
                          strstr(warning->message, "drawn in their base colour"));
    }
    assert_true(found);
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
}

static void a_broken_picture_gives_a_warning(void **state) {
    (void)state;
    assert_drawn_without_picture(fixture_data("bad_picture_truncated.gltf"),
                                 "bad_picture_truncated.gltf", "ends too early");
    assert_drawn_without_picture(fixture_data("bad_picture_size.gltf"), "bad_picture_size.gltf",
                                 "9000 x 2");
    fixture_copy("square.obj");
    fixture_write_text("square.mtl", "newmtl painted\nKd 0 0 0\nmap_Kd colour.tga\n");
    fixture_write("colour.tga", "", 0);
    assert_drawn_without_picture(fixture_path("square.obj"), "colour.tga", "empty");
    fixture_write_text("colour.tga", "no picture at all");
    assert_drawn_without_picture(fixture_path("square.obj"), "colour.tga",
                                 "not a supported picture");
}

// --- pictures elsewhere --------------------------------------------------------------------------

// Writes a square with a picture of this path.
static const char *square_with(const char *picture) {
    char text[300];
    fixture_copy("square.obj");
    snprintf(text, sizeof text, "newmtl painted\nKd 1 1 1\nmap_Kd %s\n", picture);
    fixture_write_text("square.mtl", text);
    return fixture_path("square.obj");
}

static void paths_of_other_machines_are_looked_for_beside(void **state) {
    (void)state;
    const char *path = square_with("D:\\projects\\wood\\bark.tga");
    DipErrorList warnings = {0};
    DipModel *model = load(path, &warnings);
    assert_int_equal(warnings.count, 1);
    assert_int_equal(warnings.items[0].code, DIP_ERROR_MISSING);
    assert_string_equal(
        warnings.items[0].message,
        "the picture bark.tga is missing beside the model, so its surfaces are drawn "
        "in their base colour");
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
    assert_int_equal(mkdir(fixture_path("textures"), 0777), 0);
    fixture_write_tga("textures/bark.tga", 2, 2, 100);
    model = load(fixture_path("square.obj"), NULL);
    assert_int_equal(dip_model_scene_def(model)->texture_count, 1);
    dip_model_destroy(&model);
    assert_int_equal(unlink(fixture_path("textures/bark.tga")), 0);
    assert_int_equal(rmdir(fixture_path("textures")), 0);
}

static void a_skin_may_be_called_like_its_model(void **state) {
    (void)state;
    size_t size_bytes;
    uint8_t *bytes = fixture_read(fixture_data("../../../assets/gallery/crab.md2"), &size_bytes);
    fixture_write("crab.md2", bytes, size_bytes);
    free(bytes);
    DipErrorList warnings = {0};
    DipModel *model = load(fixture_path("crab.md2"), &warnings);
    assert_int_equal(warnings.count, 1);
    assert_int_equal(warnings.items[0].code, DIP_ERROR_MISSING);
    assert_non_null(
        strstr(warnings.items[0].message,
               "its skin crab.pcx is not beside the model, and there is no crab with the ending"));
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
    fixture_write_tga("crab.tga", 2, 2, 100);
    model = load(fixture_path("crab.md2"), NULL);
    assert_int_equal(dip_model_scene_def(model)->texture_count, 1);
    dip_model_destroy(&model);
}

// --- transparency and missing materials ----------------------------------------------------------

static void a_constant_opacity_blends(void **state) {
    (void)state;
    fixture_copy("square.obj");
    fixture_write_text("square.mtl", "newmtl painted\nKd 1 1 1\nd 0.25\n");
    DipModel *model = load(fixture_path("square.obj"), NULL);
    const DipMaterialDef *material = &dip_model_scene_def(model)->materials[0];
    assert_int_equal(material->surface, DIP_SURFACE_BLENDED);
    assert_true(material->opacity == 0.25f);
    dip_model_destroy(&model);
}

static void one_line_says_that_no_mtl_is_named(void **state) {
    (void)state;
    DipErrorList warnings = {0};
    fixture_write_text("grey.obj", "o leaf\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl Wood\nf 1 2 3\n"
                                   "usemtl Steel\nf 1 3 2\n");
    DipModel *model = load(fixture_path("grey.obj"), &warnings);
    assert_int_equal(warnings.count, 1);
    assert_string_equal(warnings.items[0].message, "the file names no .mtl file with its "
                                                   "materials, so its surfaces are grey");
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
}

// --- glTF ----------------------------------------------------------------------------------------

// Writes a glTF file of one triangle for each material. The materials are JSON. The texture 0 is
// the picture, whose texels have hard edges.
static const char *gltf_with(const char *materials, int count, const char *picture) {
    static const float numbers[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1};
    char text[4000];
    int at = snprintf(text, sizeof text,
                      "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":60,"
                      "\"uri\":\"numbers.bin\"}],\"bufferViews\":[{\"buffer\":0,"
                      "\"byteLength\":36},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":24}],"
                      "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,"
                      "\"type\":\"VEC3\"},{\"bufferView\":1,\"componentType\":5126,\"count\":3,"
                      "\"type\":\"VEC2\"}],\"images\":[{\"uri\":\"%s\"}],"
                      "\"samplers\":[{\"magFilter\":9728}],"
                      "\"textures\":[{\"source\":0,\"sampler\":0}],\"materials\":[%s],"
                      "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0,\"name\":\"all\"}],"
                      "\"meshes\":[{\"primitives\":[",
                      picture, materials);
    for (int i = 0; i < count; ++i) {
        at += snprintf(text + at, sizeof text - (size_t)at,
                       "%s{\"material\":%d,\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1}}",
                       i ? "," : "", i);
    }
    snprintf(text + at, sizeof text - (size_t)at, "]}]}");
    fixture_write("numbers.bin", numbers, sizeof numbers);
    fixture_write_text("made.gltf", text);
    return fixture_path("made.gltf");
}

// A texel is drawn if the base alpha times its own alpha reaches the cutoff.
static void a_mask_compares_the_base_alpha_with_the_cutoff(void **state) {
    (void)state;
    static const struct {
        const char *base_alpha, *cutoff;
        float expected; // cutoff of the texels, or -1 for no surface
    } cases[] = {{"0.5", "0.25", 0.5f}, {"0.25", "0.25", 1.0f}, {"0.2499", "0.25", -1.0f},
                 {"1", "1", 1.0f},      {"1", "1.0001", -1.0f}, {"0", "0.25", -1.0f},
                 {"0.5", "0", 0.0f},    {"0", "0", 0.0f}};
    enum { CASES = sizeof cases / sizeof *cases };
    char materials[2000] = "";
    for (int i = 0; i < CASES; ++i) {
        const size_t at = strlen(materials);
        snprintf(materials + at, sizeof materials - at,
                 "%s{\"name\":\"m%d\",\"alphaMode\":\"MASK\",\"alphaCutoff\":%s,"
                 "\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,1,1,%s],"
                 "\"baseColorTexture\":{\"index\":0}}}",
                 i ? "," : "", i, cases[i].cutoff, cases[i].base_alpha);
    }
    fixture_write("colour.png", fixture_png, sizeof fixture_png); // One texel has the alpha 0.
    DipModel *model = load(gltf_with(materials, CASES, "colour.png"), NULL);
    const DipSceneDef *def = dip_model_scene_def(model);
    int drawn = 0;
    for (int i = 0; i < CASES; ++i) {
        float found = -1.0f;
        for (int k = 0; k < def->object_count; ++k) {
            const DipMaterialDef *material =
                &def->materials[def->meshes[def->objects[k].mesh].material];
            if (material->name[1] == '0' + i) {
                assert_int_equal(material->surface, DIP_SURFACE_CLIPPED);
                found = material->alpha_cutoff;
            }
        }
        if (found != cases[i].expected) {
            fail_msg("alpha %s, cutoff %s: %g", cases[i].base_alpha, cases[i].cutoff,
                     (double)found);
        }
        drawn += cases[i].expected >= 0.0f;
    }
    assert_int_equal(def->object_count, drawn);
    dip_model_destroy(&model);
}

// The texels of a picture with hard edges become blocks of 8x8 texels, but of fewer where a row or
// column would have more than 1024 texels.
static void hard_texels_become_blocks(void **state) {
    (void)state;
    static const struct {
        int side, factor;
    } cases[] = {{1, 8}, {128, 8}, {129, 4}, {256, 4}, {257, 2}, {512, 2}, {513, 1}};
    static const char material[] =
        "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}";
    for (size_t i = 0; i < 2 * sizeof cases / sizeof *cases; ++i) {
        const int side = cases[i / 2].side;
        const int factor = cases[i / 2].factor;
        uint8_t bytes[64 + 3 * 513];
        const bool wide = i % 2 == 0;
        const int head =
            snprintf((char *)bytes, 64, "P6\n%d %d\n255\n", wide ? side : 1, wide ? 1 : side);
        for (int k = 0; k < 3 * side; ++k) {
            bytes[head + k] = (uint8_t)(k / 3);
        }
        fixture_write("hard.ppm", bytes, (size_t)head + 3 * (size_t)side);
        DipErrorList warnings = {0};
        DipModel *model = load(gltf_with(material, 1, "hard.ppm"), &warnings);
        const DipTextureDef *texture = &dip_model_scene_def(model)->textures[0];
        assert_int_equal(texture->width, factor * (wide ? side : 1));
        assert_int_equal(texture->height, factor * (wide ? 1 : side));
        for (int y = 0; y < texture->height; ++y) {
            for (int x = 0; x < texture->width; ++x) {
                assert_int_equal(texture->rgba8[4 * (y * texture->width + x)],
                                 (uint8_t)((wide ? x : y) / factor));
            }
        }
        assert_int_equal(warnings.count, factor == 1);
        if (factor == 1) {
            assert_string_equal(warnings.items[0].key, "magFilter");
            assert_non_null(strstr(warnings.items[0].message, "larger than 512x512"));
        }
        dip_error_list_free(&warnings);
        dip_model_destroy(&model);
    }
}

// Files of glTF 1 are read by assimp. Their colours are linear, and a surface without a roughness
// has 0.6: a = 0.36, n = 2 / a^2 - 2, and a dielectric mirrors 0.04 (n + 8) / 8.
static void colours_of_gltf_1_are_linear(void **state) {
    (void)state;
    static const float numbers[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    fixture_write("one.bin", numbers, sizeof numbers);
    DipModel *model = load_text(
        "one.gltf",
        "{\"asset\":{\"version\":\"1.0\"},\"scene\":\"s\",\"scenes\":{\"s\":{\"nodes\":[\"n\"]}},"
        "\"nodes\":{\"n\":{\"meshes\":[\"m\"]}},\"buffers\":{\"b\":{\"byteLength\":36,"
        "\"type\":\"arraybuffer\",\"uri\":\"one.bin\"}},\"bufferViews\":{\"v\":{\"buffer\":\"b\","
        "\"byteOffset\":0,\"byteLength\":36}},\"accessors\":{\"a\":{\"bufferView\":\"v\","
        "\"byteOffset\":0,\"byteStride\":12,\"componentType\":5126,\"count\":3,"
        "\"type\":\"VEC3\"}},\"materials\":{\"w\":{\"values\":{\"diffuse\":[0.5,0.25,0.75,1]}}},"
        "\"meshes\":{\"m\":{\"primitives\":[{\"attributes\":{\"POSITION\":\"a\"},"
        "\"material\":\"w\",\"mode\":4}]}}}");
    const DipMaterialDef *material = &dip_model_scene_def(model)->materials[0];
    assert_true(material->base_colour_lin[0] == 0.5f && material->base_colour_lin[1] == 0.25f &&
                material->base_colour_lin[2] == 0.75f);
    const double exponent = 2.0 / (0.36 * 0.36) - 2.0;
    assert_true(fabs((double)material->shininess - exponent) < 1e-4);
    for (int c = 0; c < 3; ++c) {
        assert_true(fabs((double)material->specular_lin[c] - 0.04 * (exponent + 8.0) / 8.0) < 1e-6);
    }
    assert_false(material->double_sided);
    dip_model_destroy(&model);
}

// --- texture coordinates -------------------------------------------------------------------------

// An NFF file's sphere has no texture coordinates; the reader asks for a mapping around it.
static void generated_texture_coordinates_are_kept(void **state) {
    (void)state;
    fixture_write_tga("earth.tga", 2, 2, 100);
    DipModel *model = load_text("sphere.nff", "f 1 1 1 0.5 0.5 8 0 1 earth.tga\ns 0 0 0 2\n");
    const DipSceneDef *def = dip_model_scene_def(model);
    const DipMeshDef *mesh = &def->meshes[0];
    assert_int_equal(def->texture_count, 1);
    assert_non_null(mesh->uv0);
    float low[2] = {1.0f, 1.0f};
    float high[2] = {0.0f, 0.0f};
    for (uint32_t i = 0; i < mesh->vertex_count; ++i) {
        for (int k = 0; k < 2; ++k) {
            low[k] = fminf(low[k], mesh->uv0[2 * (size_t)i + (size_t)k]);
            high[k] = fmaxf(high[k], mesh->uv0[2 * (size_t)i + (size_t)k]);
        }
    }
    for (int k = 0; k < 2; ++k) { // The texture goes around the whole sphere.
        assert_true(low[k] >= -0.01f && low[k] < 0.1f && high[k] > 0.9f && high[k] <= 1.01f);
    }
    dip_model_destroy(&model);
}

// --- normals -------------------------------------------------------------------------------------

// Many programs write facets with the normal 0 0 0. The first facet lies in the plane z = 0 and
// runs counter-clockwise as seen from +z. The second one keeps the normal that the file gives it.
static void normals_of_length_zero_are_made(void **state) {
    (void)state;
    DipModel *model = load_text(
        "zero.stl", "solid s\n"
                    "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 0 3 0\n"
                    "endloop\nendfacet\n"
                    "facet normal 0 1 0\nouter loop\nvertex 0 0 9\nvertex 2 0 9\nvertex 0 3 9\n"
                    "endloop\nendfacet\nendsolid s\n");
    const DipMeshDef *mesh = &dip_model_scene_def(model)->meshes[0];
    assert_int_equal(mesh->index_count, 6);
    for (size_t i = 0; i < 6; ++i) {
        const float *normal = mesh->normals + 3 * (size_t)mesh->indices[i];
        assert_true(normal[0] == 0.0f);
        assert_true(normal[1] == (i < 3 ? 0.0f : 1.0f));
        assert_true(normal[2] == (i < 3 ? 1.0f : 0.0f));
    }
    dip_model_destroy(&model);
}

// --- colours -------------------------------------------------------------------------------------

static const char *amf(const char *vertex_colour) {
    static char text[2000];
    snprintf(text, sizeof text,
             "<?xml version=\"1.0\"?><amf><object id=\"1\"><mesh><vertices>"
             "<vertex>%s<coordinates><x>0</x><y>0</y><z>0</z></coordinates></vertex>"
             "<vertex><coordinates><x>1</x><y>0</y><z>0</z></coordinates></vertex>"
             "<vertex><coordinates><x>0</x><y>1</y><z>0</z></coordinates></vertex>"
             "</vertices><volume><triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle></volume>"
             "</mesh></object></amf>\n",
             vertex_colour);
    return text;
}

static void vertices_without_a_colour_are_not_black(void **state) {
    (void)state;
    DipModel *model = load_text("plain.amf", amf(""));
    assert_null(dip_model_scene_def(model)->meshes[0].colours_lin);
    dip_model_destroy(&model);
    model = load_text("one.amf", amf("<color><r>0</r><g>1</g><b>0</b><a>1</a></color>"));
    const DipMeshDef *mesh = &dip_model_scene_def(model)->meshes[0];
    assert_non_null(mesh->colours_lin);
    float sum[3] = {0};
    for (uint32_t i = 0; i < mesh->vertex_count; ++i) {
        for (int k = 0; k < 3; ++k) {
            sum[k] += mesh->colours_lin[3 * (size_t)i + (size_t)k];
        }
    }
    assert_true(sum[0] == 2.0f && sum[1] == 3.0f && sum[2] == 2.0f); // green, white, white
    dip_model_destroy(&model);
}

static void black_vertices_stay_black(void **state) {
    (void)state;
    DipModel *model =
        load_text("black.amf", amf("<color><r>0</r><g>0</g><b>0</b><a>1</a></color>"));
    const DipMeshDef *mesh = &dip_model_scene_def(model)->meshes[0];
    float least = 1.0f;
    for (uint32_t i = 0; mesh->colours_lin && i < 3 * mesh->vertex_count; ++i) {
        least = fminf(least, mesh->colours_lin[i]);
    }
    assert_true(least == 0.0f);
    dip_model_destroy(&model);
}

// assimp's reader of BLEND files gives -1 for the byte 255 and 100 for the byte 100. A PLY file
// with colours in floats gives the same numbers.
static void colours_of_signed_bytes_are_read_as_bytes(void **state) {
    (void)state;
    DipModel *model =
        load_text("signed.ply",
                  "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                  "property float z\nproperty float red\nproperty float green\n"
                  "property float blue\nelement face 1\n"
                  "property list uchar int vertex_indices\nend_header\n"
                  "0 0 0 -1 100 0\n1 0 0 -1 100 0\n0 1 0 -1 100 0\n3 0 1 2\n");
    const DipMeshDef *mesh = &dip_model_scene_def(model)->meshes[0];
    assert_non_null(mesh->colours_lin);
    const double green = pow((100.0 / 255.0 + 0.055) / 1.055, 2.4);
    for (uint32_t i = 0; i < mesh->vertex_count; ++i) {
        const float *colour = mesh->colours_lin + 3 * (size_t)i;
        assert_true(colour[0] == 1.0f && fabs(colour[1] - green) < 1e-6 && colour[2] == 0.0f);
    }
    dip_model_destroy(&model);
}

// Some readers give black with an alpha of 0 to materials that the file leaves empty.
static void a_material_that_is_left_empty_is_grey(void **state) {
    (void)state;
    static const char x_file[] =
        "xof 0303txt 0032\nMesh a {\n3;\n0;0;0;,\n1;0;0;,\n0;1;0;;\n1;\n3;0,1,2;;\n"
        "MeshMaterialList {\n1;\n1;\n0;;\nMaterial m {\n0.0;0.0;0.0;%s;;\n0.0;\n"
        "0.0;0.0;0.0;;\n0.0;0.0;0.0;;\n}\n}\n}\n";
    char text[1000];
    snprintf(text, sizeof text, x_file, "0.0");
    DipModel *model = load_text("empty.x", text);
    const double grey = pow((0.6 + 0.055) / 1.055, 2.4);
    assert_true(fabs(dip_model_scene_def(model)->materials[0].base_colour_lin[1] - grey) < 1e-6);
    dip_model_destroy(&model);
    snprintf(text, sizeof text, x_file, "1.0");
    model = load_text("black.x", text);
    assert_true(dip_model_scene_def(model)->materials[0].base_colour_lin[1] == 0.0f);
    dip_model_destroy(&model);
}

// A metal's material may have a black base colour and all its colour in the specular texture.
static void a_specular_texture_shows_where_nothing_else_does(void **state) {
    (void)state;
    fixture_copy("square.obj");
    fixture_write_text("square.mtl", "newmtl painted\nKd 0 0 0\nKs 1 1 1\nmap_Ks shine.tga\n");
    fixture_write_tga("shine.tga", 2, 2, 100);
    DipModel *model = load(fixture_path("square.obj"), NULL);
    const DipSceneDef *def = dip_model_scene_def(model);
    assert_int_equal(def->texture_count, 1);
    assert_true(def->materials[0].base_colour_lin[0] == 1.0f);
    dip_model_destroy(&model);
    fixture_write_text("square.mtl", "newmtl painted\nKd .5 0 0\nKs 1 1 1\nmap_Ks shine.tga\n");
    model = load(fixture_path("square.obj"), NULL);
    assert_int_equal(dip_model_scene_def(model)->texture_count, 0);
    dip_model_destroy(&model);
}

// --- up axis -------------------------------------------------------------------------------------

// Returns the height (world y) of the object's highest vertex.
static double height(const char *path, DipUpAxis up) {
    DipModel *model = load_up(path, up, NULL);
    const DipSceneDef *def = dip_model_scene_def(model);
    double highest = -INFINITY;
    for (int i = 0; i < def->object_count; ++i) {
        const DipMeshDef *mesh = &def->meshes[def->objects[i].mesh];
        const float *m = def->objects[i].transform;
        for (uint32_t v = 0; v < mesh->vertex_count; ++v) {
            const float *p = mesh->positions + 3 * (size_t)v;
            highest = fmax(highest,
                           (double)m[4] * p[0] + (double)m[5] * p[1] + (double)m[6] * p[2] + m[7]);
        }
    }
    dip_model_destroy(&model);
    return highest;
}

// A triangle that is 2 long in x, 3 in y and 5 in z.
static const char stl[] = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 2 0 0\nvertex 0 3 0\n"
                          "vertex 0 0 5\nendloop\nendfacet\nendsolid a\n";
static const char off[] = "OFF\n3 1 0\n2 0 0\n0 3 0\n0 0 5\n3 0 1 2\n";
static const char nff[] = "v\nfrom 9 9 9\nat 0 0 0\nup %s\nangle 45\nhither 1\nresolution 9 9\n"
                          "f 1 1 1 1 0 0 0 0\np 3\n2 0 0\n0 3 0\n0 0 5\n";
static const char ogex[] =
    "%s\nGeometryNode $node {Name {string {\"a\"}}\nObjectRef {ref {$geo}}}\n"
    "GeometryObject $geo {Mesh (primitive = \"triangles\") {\n"
    "VertexArray (attrib = \"position\") {float[3] {{2, 0, 0}, {0, 3, 0}, {0, 0, 5}}}\n"
    "IndexArray {unsigned_int32[3] {{0, 1, 2}}}}}\n";

static void the_format_or_the_file_says_which_way_is_up(void **state) {
    (void)state;
    char text[1000];
    fixture_write_text("a.stl", stl);
    assert_true(height(fixture_path("a.stl"), DIP_UP_auto) == 5.0);
    fixture_write_text("a.off", off);
    assert_true(height(fixture_path("a.off"), DIP_UP_auto) == 3.0);
    snprintf(text, sizeof text, nff, "0 0 1");
    fixture_write_text("z.nff", text);
    assert_true(height(fixture_path("z.nff"), DIP_UP_auto) == 5.0);
    snprintf(text, sizeof text, nff, "0 1 0");
    fixture_write_text("y.nff", text);
    assert_true(height(fixture_path("y.nff"), DIP_UP_auto) == 3.0);
    fixture_write_text("none.nff", strstr(nff, "f 1"));
    assert_true(height(fixture_path("none.nff"), DIP_UP_auto) == 5.0);
    snprintf(text, sizeof text, ogex, "Metric (key = \"up\") {string {\"z\"}}");
    fixture_write_text("z.ogex", text);
    assert_true(height(fixture_path("z.ogex"), DIP_UP_auto) == 5.0);
    snprintf(text, sizeof text, ogex, "Metric (key = \"up\") {string {\"y\"}}");
    fixture_write_text("y.ogex", text);
    assert_true(height(fixture_path("y.ogex"), DIP_UP_auto) == 3.0);
}

static void the_caller_can_say_which_way_is_up(void **state) {
    (void)state;
    fixture_write_text("a.stl", stl);
    assert_true(height(fixture_path("a.stl"), DIP_UP_y) == 3.0);
    assert_true(height(fixture_path("a.stl"), DIP_UP_z) == 5.0);
    fixture_write_text("a.off", off);
    assert_true(height(fixture_path("a.off"), DIP_UP_y) == 3.0);
    assert_true(height(fixture_path("a.off"), DIP_UP_z) == 5.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_broken_picture_gives_a_warning),
        cmocka_unit_test(paths_of_other_machines_are_looked_for_beside),
        cmocka_unit_test(a_skin_may_be_called_like_its_model),
        cmocka_unit_test(a_constant_opacity_blends),
        cmocka_unit_test(one_line_says_that_no_mtl_is_named),
        cmocka_unit_test(a_mask_compares_the_base_alpha_with_the_cutoff),
        cmocka_unit_test(hard_texels_become_blocks),
        cmocka_unit_test(colours_of_gltf_1_are_linear),
        cmocka_unit_test(generated_texture_coordinates_are_kept),
        cmocka_unit_test(normals_of_length_zero_are_made),
        cmocka_unit_test(vertices_without_a_colour_are_not_black),
        cmocka_unit_test(black_vertices_stay_black),
        cmocka_unit_test(colours_of_signed_bytes_are_read_as_bytes),
        cmocka_unit_test(a_material_that_is_left_empty_is_grey),
        cmocka_unit_test(a_specular_texture_shows_where_nothing_else_does),
        cmocka_unit_test(the_format_or_the_file_says_which_way_is_up),
        cmocka_unit_test(the_caller_can_say_which_way_is_up),
    };
    return cmocka_run_group_tests_name("mends", tests, fixture_open, fixture_close);
}
