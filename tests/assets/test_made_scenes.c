// Tests what the loader makes of scenes that assimp gives it: the metadata of nodes, materials,
// rules, lights, and scenes that are refused. Each scene is made in memory (made_scene.h).
#include "assets/model_parts.h"
#include "tests/assets/fixture.h"
#include "tests/assets/made_scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

static DipErrorList warnings;

static DipModel *load_with(const MadeScene *made, const DipModelOptions *options) {
    dip_error_list_free(&warnings);
    return fixture_load(made_write(made), options, &warnings);
}

static const DipMaterialDef *material_of(const DipModel *model, const char *node) {
    const DipSceneDef *def = dip_model_scene_def(model);
    return &def->materials[def->meshes[fixture_object(def, node)->mesh].material];
}

// The only warning is this one, about this material, node or light.
static void assert_one_warning(const char *key, const char *message) {
    assert_int_equal(warnings.count, 1);
    assert_int_equal(warnings.items[0].severity, DIP_SEVERITY_WARNING);
    assert_string_equal(warnings.items[0].key, key);
    assert_string_equal(warnings.items[0].message, message);
}

static const char *made_path(void) {
    return fixture_path("made.assbin");
}

// The error names the file and line, and says exactly this.
static void assert_refused(const MadeScene *made, const DipModelOptions *options, DipErrorCode code,
                           const char *file, int line, const char *key, const char *message) {
    DipError err = {0};
    const char *path = made_write(made);
    assert_null(dip_model_load_with(&path, 1, options, NULL, NULL, &err));
    assert_string_equal(err.message, message);
    assert_string_equal(err.file, file);
    assert_int_equal(err.line, line);
    assert_string_equal(err.key, key);
    assert_int_equal(err.code, code);
}

// --- metadata ------------------------------------------------------------------------------------

// A number is true unless it is 0, whatever its type. A number of 64 bits must not be taken for one
// of 32 bits, and a double not for a float. What is no number is false.
static void light_mapped_is_true_for_any_number_but_zero(void **state) {
    (void)state;
    static const bool yes = true, no = false;
    static const int32_t one = 1, less = -1, none = 0;
    static const uint64_t high = UINT64_C(1) << 40, no_bits = 0;
    static const float half = 0.5f, minus_zero = -0.0f;
    static const double tiny = 1e-300, zero = 0.0;
    static struct aiString text;
    static const struct aiVector3D vector = {1.0f, 1.0f, 1.0f};
    const struct {
        enum aiMetadataType type;
        const void *data;
        bool expected;
    } cases[] = {
        {AI_BOOL, &yes, true},           {AI_BOOL, &no, false},     {AI_INT32, &one, true},
        {AI_INT32, &less, true},         {AI_INT32, &none, false},  {AI_UINT64, &high, true},
        {AI_UINT64, &no_bits, false},    {AI_FLOAT, &half, true},   {AI_FLOAT, &minus_zero, false},
        {AI_DOUBLE, &tiny, true},        {AI_DOUBLE, &zero, false}, {AI_AISTRING, &text, false},
        {AI_AIVECTOR3D, &vector, false},
    };
    enum { CASES = sizeof cases / sizeof *cases };
    made_string(&text, "1");
    for (int above = 0; above < 2; ++above) { // The node's own value outranks the root's.
        MadeScene *made = made_scene(CASES + 1);
        made_metadata(made, MADE_ROOT, "lightmapped", AI_BOOL, above ? &yes : &no);
        for (int i = 0; i < CASES; ++i) {
            made_metadata(made, i, "lightmapped", cases[i].type, cases[i].data);
        }
        for (int i = 0; i <= CASES; ++i) {
            made_texture(made, i, aiTextureType_LIGHTMAP, "light.tga");
        }
        fixture_write_tga("light.tga", 2, 2, 100);
        DipModel *model = load_with(made, NULL);
        for (int i = 0; i <= CASES; ++i) {
            char node[16];
            snprintf(node, sizeof node, "node%d", i);
            const bool expected = i < CASES ? cases[i].expected : above;
            const DipMaterialDef *material = material_of(model, node);
            assert_true(material->light_map >= 0);
            if (material->light_map_scale != (expected ? 2.0f : 1.0f)) {
                fail_msg("case %d: %g", i, (double)material->light_map_scale);
            }
        }
        assert_int_equal(warnings.count, 0);
        dip_model_destroy(&model);
    }
}

static void surface_names_the_kind_of_surface(void **state) {
    (void)state;
    static struct aiString names[6];
    static const char *const texts[6] = {"solid", "mask", "glass", "water", "sky", "lava"};
    static const int32_t number = 3;
    MadeScene *made = made_scene(8);
    for (int i = 0; i < 6; ++i) {
        made_string(&names[i], texts[i]);
        made_metadata(made, i, "surface", AI_AISTRING, &names[i]);
    }
    made_metadata(made, 6, "surface", AI_INT32, &number); // No name, so the root's value holds.
    made_metadata(made, MADE_ROOT, "surface", AI_AISTRING, &names[3]);
    for (int i = 0; i < 8; ++i) {
        made_texture(made, i, aiTextureType_DIFFUSE, "colour.png"); // One texel has the alpha 0.
    }
    fixture_write("colour.png", fixture_png, sizeof fixture_png);
    DipModel *model = load_with(made, NULL);
    static const DipSurface expected[8] = {
        DIP_SURFACE_OPAQUE, DIP_SURFACE_CLIPPED, DIP_SURFACE_OPAQUE, DIP_SURFACE_WATER,
        DIP_SURFACE_SKY,    DIP_SURFACE_WATER,   DIP_SURFACE_WATER,  DIP_SURFACE_WATER};
    for (int i = 0; i < 8; ++i) {
        char node[16];
        snprintf(node, sizeof node, "node%d", i);
        const DipMaterialDef *material = material_of(model, node);
        assert_int_equal(material->surface, expected[i]);
        assert_int_equal(material->lit, i < 2); // The scene's light falls on solid and mask only.
        // The texture of a sky is data.
        assert_int_equal(dip_model_scene_def(model)->textures[material->colour_texture].encoding,
                         i == 4 ? DIP_ENCODING_LINEAR : DIP_ENCODING_SRGB);
    }
    assert_one_warning("node5", "the surface \"lava\" is not known, accepted solid, mask, glass, "
                                "water or sky");
    dip_model_destroy(&model);
}

// --- meshes --------------------------------------------------------------------------------------

static void nodes_share_a_mesh_of_one_material(void **state) {
    (void)state;
    MadeScene *made = made_scene(3);
    made->mesh_numbers[2] = 0;
    DipModel *model = load_with(made, NULL);
    const DipSceneDef *def = dip_model_scene_def(model);
    assert_int_equal(def->object_count, 3);
    assert_int_equal(def->mesh_count, 2);
    assert_int_equal(fixture_object(def, "node2")->mesh, fixture_object(def, "node0")->mesh);
    assert_int_not_equal(fixture_object(def, "node1")->mesh, fixture_object(def, "node0")->mesh);
    dip_model_destroy(&model);
}

// --- alpha ---------------------------------------------------------------------------------------

// glTF draws a texel if the base alpha times its own alpha reaches the cutoff. So nothing is left
// of a surface whose base alpha is below the cutoff, and elsewhere the texel's alpha must reach the
// quotient of the two.
static void a_mask_compares_the_base_alpha_with_the_cutoff(void **state) {
    (void)state;
    static const struct {
        float base_alpha, cutoff, expected; // expected: cutoff of the texels, or -1 for no surface
    } cases[] = {
        {0.5f, 0.25f, 0.5f},    {0.25f, 0.25f, 1.0f},       {0.24999999f, 0.25f, -1.0f},
        {1.0f, 0.125f, 0.125f}, {1.0f, 1.0f, 1.0f},         {1.0f, 1.0000001f, -1.0f},
        {0.0f, 0.25f, -1.0f},   {0.5f, 0.0f, 0.0f},         {0.5f, -1.0f, 0.0f},
        {0.0f, 0.0f, 0.0f},     {0.75f, NAN, 0.5f / 0.75f}, {0.5f, NAN, 1.0f},
        {0.49f, NAN, -1.0f},
    };
    enum { CASES = sizeof cases / sizeof *cases };
    MadeScene *made = made_scene(CASES + 1);
    fixture_write("colour.png", fixture_png, sizeof fixture_png);
    for (int i = 0; i <= CASES; ++i) {
        const float alpha = i < CASES ? cases[i].base_alpha : 1.0f;
        const float colour[4] = {1.0f, 1.0f, 1.0f, alpha};
        made_texture(made, i, aiTextureType_DIFFUSE, "colour.png");
        made_text(made, i, "$mat.gltf.alphaMode", 0, "MASK");
        made_floats(made, i, "$clr.diffuse", 0, colour, 4);
        if (i < CASES) { // The last material has the cutoff 0.5, which holds without a number.
            made_floats(made, i, "$mat.gltf.alphaCutoff", 0, &cases[i].cutoff, 1);
        }
    }
    DipModel *model = load_with(made, NULL);
    const DipSceneDef *def = dip_model_scene_def(model);
    int objects = 1;
    for (int i = 0; i < CASES; ++i) {
        char node[16];
        snprintf(node, sizeof node, "node%d", i);
        if (cases[i].expected >= 0.0f) {
            const DipMaterialDef *material = material_of(model, node);
            assert_int_equal(material->surface, DIP_SURFACE_CLIPPED);
            if (material->alpha_cutoff != cases[i].expected) {
                fail_msg("case %d: %g", i, (double)material->alpha_cutoff);
            }
            ++objects;
        }
    }
    char last[16];
    snprintf(last, sizeof last, "node%d", CASES);
    assert_true(material_of(model, last)->alpha_cutoff == 0.5f);
    assert_int_equal(def->object_count, objects);
    assert_int_equal(warnings.count, 0);
    dip_model_destroy(&model);
}

static void blending_is_drawn_as_a_clip_map(void **state) {
    (void)state;
    MadeScene *made = made_scene(2);
    fixture_write("colour.png", fixture_png, sizeof fixture_png);
    for (int i = 0; i < 2; ++i) {
        made_texture(made, i, aiTextureType_DIFFUSE, "colour.png");
        made_text(made, i, "$mat.gltf.alphaMode", 0, i == 0 ? "BLEND" : "OPAQUE");
    }
    DipModel *model = load_with(made, NULL);
    assert_int_equal(material_of(model, "node0")->surface, DIP_SURFACE_CLIPPED);
    assert_true(material_of(model, "node0")->alpha_cutoff == 0.5f);
    assert_int_equal(material_of(model, "node1")->surface, DIP_SURFACE_OPAQUE);
    assert_one_warning("material0", "blending is not drawn: the surface is solid where its "
                                    "texture's alpha is 0.5 or more");
    dip_model_destroy(&model);
}

static void an_opacity_of_zero_is_drawn_solid(void **state) {
    (void)state;
    static const float opacities[] = {0.0f, 1e-6f, 0.999f, 1.0f, 1.5f};
    MadeScene *made = made_scene(5);
    for (int i = 0; i < 5; ++i) {
        made_floats(made, i, "$mat.opacity", 0, &opacities[i], 1);
    }
    DipModel *model = load_with(made, NULL);
    for (int i = 0; i < 5; ++i) {
        char node[16];
        snprintf(node, sizeof node, "node%d", i);
        const DipMaterialDef *material = material_of(model, node);
        const bool blends = i == 1 || i == 2;
        assert_int_equal(material->surface, blends ? DIP_SURFACE_BLENDED : DIP_SURFACE_OPAQUE);
        assert_true(material->opacity == (blends ? opacities[i] : 1.0f));
    }
    assert_one_warning("material0", "the opacity is 0 or less in the file: the surface is drawn "
                                    "solid");
    dip_model_destroy(&model);
}

// --- textures ------------------------------------------------------------------------------------

static void a_moved_texture_gives_a_warning(void **state) {
    (void)state;
    fixture_write_tga("colour.tga", 2, 2, 100);
    for (int moved = -1; moved < 5; ++moved) {
        float transform[5] = {0.0f, 0.0f, 1.0f, 1.0f, 0.0f}; // offset, scale, rotation
        if (moved >= 0) {
            transform[moved] += 0.5f;
        }
        MadeScene *made = made_scene(1);
        made_texture(made, 0, aiTextureType_DIFFUSE, "colour.tga");
        made_floats(made, 0, "$tex.uvtrafo", aiTextureType_DIFFUSE, transform, 5);
        DipModel *model = load_with(made, NULL);
        if (moved < 0) {
            assert_int_equal(warnings.count, 0);
        } else {
            assert_one_warning("material0",
                               "the texture's offset, scale and rotation are not drawn");
        }
        assert_int_equal(dip_model_scene_def(model)->texture_count, 1);
        dip_model_destroy(&model);
    }
}

static void a_texture_needs_the_coordinates_it_names(void **state) {
    (void)state;
    MadeScene *made = made_scene(3);
    fixture_write_tga("colour.tga", 2, 2, 100);
    fixture_write_tga("other.tga", 4, 4, 100);
    made_texture(made, 0, aiTextureType_DIFFUSE, "colour.tga");
    made->meshes[0].mTextureCoords[0] = NULL;
    made_texture(made, 1, aiTextureType_DIFFUSE, "colour.tga"); // has the set that it names
    made_integer(made, 1, "$tex.uvwsrc", aiTextureType_DIFFUSE, 1);
    made->meshes[1].mTextureCoords[1] = made->meshes[1].mTextureCoords[0];
    made->meshes[1].mNumUVComponents[1] = 2;
    made_texture(made, 2, aiTextureType_BASE_COLOR, "other.tga"); // has no second set
    made_integer(made, 2, "$tex.uvwsrc", aiTextureType_BASE_COLOR, 1);
    made_texture(made, 2, aiTextureType_DIFFUSE, "colour.tga");
    DipModel *model = load_with(made, NULL);
    const DipSceneDef *def = dip_model_scene_def(model);
    assert_int_equal(material_of(model, "node0")->colour_texture, DIP_NO_TEXTURE);
    assert_int_equal(material_of(model, "node1")->colour_texture, 0);
    assert_int_equal(material_of(model, "node2")->colour_texture, 0);
    assert_int_equal(def->texture_count, 1);
    assert_int_equal(def->textures[0].width, 2);
    assert_one_warning("material0", "mesh \"\" has no texture coordinates, so its texture "
                                    "colour.tga is ignored");
    dip_model_destroy(&model);
}

// --- light maps of rules -------------------------------------------------------------------------

static const DipMaterialRule *light_rule(const char *pattern, const char *picture) {
    static DipMaterialRule rule;
    static char path[FIXTURE_PATH];
    snprintf(path, sizeof path, "%s", picture ? fixture_path(picture) : "");
    rule = (DipMaterialRule){.mark = DIP_MARK_LIGHT_MAP,
                             .pattern = pattern,
                             .light_map = picture ? path : NULL,
                             .file = "rules.ini",
                             .line = 7,
                             .key = "light_map"};
    return &rule;
}

// The picture takes the second set of coordinates, or the first if there is only one.
static void a_rule_gives_a_light_map(void **state) {
    (void)state;
    static struct aiVector3D second[3] = {
        {0.25f, 0.0f, 0.0f}, {0.5f, 0.0f, 0.0f}, {0.75f, 0.0f, 0.0f}};
    MadeScene *made = made_scene(4);
    fixture_write_tga("light.tga", 8, 2, 100);
    made->meshes[1].mTextureCoords[1] = second;
    made->meshes[1].mNumUVComponents[1] = 2;
    made->meshes[2].mTextureCoords[0] = NULL;
    made->materials[3].mProperties[0] = &made->properties[3][1]; // another name
    made->materials[3].mNumProperties = 0;
    made_text(made, 3, "?mat.name", 0, "other");
    const DipModelOptions options = {.rules = light_rule("material*", "light.tga"),
                                     .rule_count = 1};
    DipModel *model = load_with(made, &options);
    const DipSceneDef *def = dip_model_scene_def(model);
    assert_int_equal(def->texture_count, 1);
    assert_int_equal(def->textures[0].width, 8);
    for (int i = 0; i < 4; ++i) {
        char node[16];
        snprintf(node, sizeof node, "node%d", i);
        const DipMaterialDef *material = material_of(model, node);
        assert_int_equal(material->light_map, i < 2 ? 0 : DIP_NO_TEXTURE);
        assert_true(material->light_map_scale == (i < 3 ? 2.0f : 1.0f));
        const DipMeshDef *mesh = &def->meshes[fixture_object(def, node)->mesh];
        for (int v = 0; i < 2 && v < 3; ++v) {
            const float expected = i == 1 ? second[v].x : made->meshes[0].mVertices[v].x;
            assert_true(mesh->uv1[2 * v] == expected);
        }
    }
    char message[FIXTURE_PATH + 80]; // The file keeps no names of meshes.
    snprintf(message, sizeof message,
             "mesh \"\" has no texture coordinates, so its light map %s is ignored",
             fixture_path("light.tga"));
    assert_one_warning("material2", message);
    dip_model_destroy(&model);
}

static void a_light_map_of_a_rule_must_be_readable(void **state) {
    (void)state;
    char message[FIXTURE_PATH + 64];
    MadeScene *made = made_scene(1);
    const DipModelOptions missing = {.rules = light_rule("*", "nowhere.tga"), .rule_count = 1};
    snprintf(message, sizeof message, "%s: cannot open picture: No such file or directory",
             fixture_path("nowhere.tga"));
    assert_refused(made, &missing, DIP_ERROR_MISSING, "rules.ini", 7, "light_map", message);
    fixture_write("empty.tga", "", 0);
    const DipModelOptions empty = {.rules = light_rule("*", "empty.tga"), .rule_count = 1};
    snprintf(message, sizeof message, "%s: the picture file is empty", fixture_path("empty.tga"));
    assert_refused(made, &empty, DIP_ERROR_TRUNCATED, "rules.ini", 7, "light_map", message);
    // The model's own picture may be missing.
    made_texture(made, 0, aiTextureType_DIFFUSE, "nowhere.tga");
    fixture_write_tga("light.tga", 2, 2, 100);
    const DipModelOptions good = {.rules = light_rule("*", "light.tga"), .rule_count = 1};
    DipModel *model = load_with(made, &good);
    assert_true(material_of(model, "node0")->light_map >= 0);
    assert_int_equal(warnings.count, 1);
    assert_int_equal(warnings.items[0].code, DIP_ERROR_MISSING);
    dip_model_destroy(&model);
}

static void a_rule_may_mean_the_models_own_light_map(void **state) {
    (void)state;
    MadeScene *made = made_scene(2);
    fixture_write_tga("light.tga", 2, 2, 100);
    made_texture(made, 0, aiTextureType_LIGHTMAP, "light.tga");
    const DipModelOptions options = {.rules = light_rule("*", NULL), .rule_count = 1};
    DipModel *model = load_with(made, &options);
    assert_int_equal(material_of(model, "node0")->light_map, 0);
    assert_int_equal(material_of(model, "node1")->light_map, DIP_NO_TEXTURE);
    assert_one_warning("material1", "the material is marked as light-mapped, but has no light map");
    dip_model_destroy(&model);
}

// A rule outranks the metadata of the nodes, and a later rule an earlier one. A light map and a
// kind of surface do not exclude each other.
static void rules_mark_surfaces(void **state) {
    (void)state;
    static struct aiString water;
    MadeScene *made = made_scene(7);
    made_string(&water, "water");
    made_metadata(made, MADE_ROOT, "surface", AI_AISTRING, &water);
    fixture_write("colour.png", fixture_png, sizeof fixture_png); // One texel has the alpha 0.
    fixture_write_tga("light.tga", 2, 2, 100);
    for (int i = 0; i < 7; ++i) {
        made_texture(made, i, aiTextureType_DIFFUSE, "colour.png");
    }
    char light[FIXTURE_PATH];
    snprintf(light, sizeof light, "%s", fixture_path("light.tga"));
    const DipMaterialRule rules[] = {
        {.mark = DIP_MARK_SOLID, .pattern = "material0"},
        {.mark = DIP_MARK_CLIP, .pattern = "material1"},
        {.mark = DIP_MARK_SKY, .pattern = "material2"},
        {.mark = DIP_MARK_WATER, .pattern = "*2"},
        {.mark = DIP_MARK_GLASS, .pattern = "material3"},
        {.mark = DIP_MARK_WATER, .pattern = "material4"},
        {.mark = DIP_MARK_SKY, .pattern = "material[4]"}, // Brackets have no meaning.
        {.mark = DIP_MARK_SKY, .pattern = "material4"},
        {.mark = DIP_MARK_LIGHT_MAP, .pattern = "material5", .light_map = light},
        {.mark = DIP_MARK_SOLID, .pattern = "m*5"},
    };
    const DipMaterialRule *bad = &rules[6];
    char message[200];
    snprintf(message, sizeof message,
             "'%s' fits no material of the models, accepted \"material0\", \"material1\", "
             "\"material2\", \"material3\", \"material4\", \"material5\", \"material6\"",
             bad->pattern);
    const DipModelOptions refused = {.rules = bad, .rule_count = 1};
    assert_refused(made, &refused, DIP_ERROR_UNKNOWN, "", 0, "", message);
    DipMaterialRule good[9];
    memcpy(good, rules, 6 * sizeof *rules);
    memcpy(good + 6, rules + 7, 3 * sizeof *rules);
    const DipModelOptions options = {.rules = good, .rule_count = 9};
    DipModel *model = load_with(made, &options);
    static const DipSurface expected[7] = {
        DIP_SURFACE_OPAQUE, DIP_SURFACE_CLIPPED, DIP_SURFACE_WATER, DIP_SURFACE_OPAQUE,
        DIP_SURFACE_SKY,    DIP_SURFACE_OPAQUE,  DIP_SURFACE_WATER};
    for (int i = 0; i < 7; ++i) {
        char node[16];
        snprintf(node, sizeof node, "node%d", i);
        const DipMaterialDef *material = material_of(model, node);
        assert_int_equal(material->surface, expected[i]);
        assert_int_equal(material->light_map >= 0, i == 5);
        assert_int_equal(material->lit, i < 2); // A surface with a light map has its light already.
    }
    assert_int_equal(warnings.count, 0);
    dip_model_destroy(&model);
}

// --- embedded pictures ---------------------------------------------------------------------------

// Loads a triangle with a texture of this path, and returns the texture, or NULL if a warning says
// that there is none.
static const DipTextureDef *texture_at(MadeScene *made, const char *path, DipModel **model) {
    made->materials[0].mNumProperties = 1; // its name
    made_texture(made, 0, aiTextureType_DIFFUSE, path);
    *model = load_with(made, NULL);
    const int texture = material_of(*model, "node0")->colour_texture;
    assert_int_equal(warnings.count, texture < 0);
    assert_true(texture >= 0 || warnings.items[0].code == DIP_ERROR_MISSING);
    return texture >= 0 ? &dip_model_scene_def(*model)->textures[texture] : NULL;
}

static void embedded_pictures_are_found_by_number(void **state) {
    (void)state;
    MadeScene *made = made_scene(1);
    struct aiTexel texels[6] = {{.b = 1, .g = 2, .r = 3, .a = 255},
                                {.b = 4, .g = 5, .r = 6, .a = 7}};
    struct aiTexture raw = {.mWidth = 3, .mHeight = 2, .pcData = texels};
    struct aiTexture png = {.mWidth = sizeof fixture_png,
                            .pcData = (struct aiTexel *)(void *)(uintptr_t)fixture_png};
    strcpy(png.achFormatHint, "png");
    made->textures[0] = &raw;
    made->textures[1] = &png;
    made->scene.mNumTextures = 2;
    DipModel *model;
    const DipTextureDef *texture = texture_at(made, "*0", &model);
    static const uint8_t expected[8] = {3, 2, 1, 255, 6, 5, 4, 7};
    assert_non_null(texture);
    assert_int_equal(texture->width, 3);
    assert_int_equal(texture->height, 2);
    assert_memory_equal(texture->rgba8, expected, sizeof expected);
    dip_model_destroy(&model);
    texture = texture_at(made, "*1", &model);
    static const uint8_t red_green[8] = {255, 0, 0, 255, 0, 255, 0, 255};
    assert_non_null(texture);
    assert_memory_equal(texture->rgba8, red_green, sizeof red_green);
    dip_model_destroy(&model);
    static const char *const none[] = {"*2", "*", "*-1", "*1x", "*99999999999999999999"};
    for (size_t i = 0; i < sizeof none / sizeof *none; ++i) {
        assert_null(texture_at(made, none[i], &model));
        dip_model_destroy(&model);
    }
}

// --- names of pictures ---------------------------------------------------------------------------

// RFC 3986: % and two hexadecimal digits stand for a byte. A file whose name is as written goes
// before. The byte 0 cannot be in a name.
static void percent_escapes_in_names_are_decoded(void **state) {
    (void)state;
    static const struct {
        const char *written, *file;
    } found[] = {{"a%20b.tga", "a b.tga"},       {"%41%2d%7e.tga", "A-~.tga"},
                 {"%c3%A9.tga", "\xc3\xa9.tga"}, {"50%zz.tga", "50%zz.tga"},
                 {"4%2.tga", "4%2.tga"},         {"%2541.tga", "%41.tga"},
                 {"%20%2%20.tga", " %2 .tga"},   {"x%ff.tga", "x\xff.tga"}};
    MadeScene *made = made_scene(1);
    DipModel *model;
    for (size_t i = 0; i < sizeof found / sizeof *found; ++i) {
        assert_null(texture_at(made, found[i].written, &model));
        dip_model_destroy(&model);
        fixture_write_tga(found[i].file, 2, 2, 100);
        if (!texture_at(made, found[i].written, &model)) {
            fail_msg("%s: not found", found[i].written);
        }
        dip_model_destroy(&model);
    }
    fixture_write_tga("a%20b.tga", 4, 4, 100);
    assert_int_equal(texture_at(made, "a%20b.tga", &model)->width, 4);
    dip_model_destroy(&model);
    fixture_write_tga("c", 2, 2, 100);
    assert_null(texture_at(made, "c%00.tga", &model));
    dip_model_destroy(&model);
}

// --- lights --------------------------------------------------------------------------------------

// glTF's range of a light comes as metadata of its node. Numbers that are no range mean none.
static void a_light_ends_at_the_range_of_its_node(void **state) {
    (void)state;
    static const float single[] = {12.5f, -1.0f, NAN};
    static const double wide[] = {0.1, 1e300, DIP_MAX_LIGHT_LIN};
    static const int32_t whole = 3;
    const struct {
        enum aiMetadataType type;
        const void *data;
        float expected;
    } cases[] = {{AI_FLOAT, &single[0], 12.5f}, {AI_FLOAT, &single[1], 0.0f},
                 {AI_FLOAT, &single[2], 0.0f},  {AI_DOUBLE, &wide[0], 0.1f},
                 {AI_DOUBLE, &wide[1], 0.0f},   {AI_DOUBLE, &wide[2], DIP_MAX_LIGHT_LIN},
                 {AI_INT32, &whole, 0.0f}};
    enum { CASES = sizeof cases / sizeof *cases };
    struct aiLight lights[CASES] = {0};
    MadeScene *made = made_scene(CASES);
    for (int i = 0; i < CASES; ++i) {
        lights[i].mName = made->nodes[i].mName;
        lights[i].mType = aiLightSource_POINT;
        lights[i].mColorDiffuse = (struct aiColor3D){1.0f, 1.0f, 1.0f};
        lights[i].mAttenuationConstant = 1.0f;
        made->lights[i] = &lights[i];
        made_metadata(made, i, "PBR_LightRange", cases[i].type, cases[i].data);
    }
    made->scene.mNumLights = CASES;
    DipModel *model = load_with(made, NULL);
    const DipLightingDef *lighting = dip_model_scene_def(model)->lighting;
    assert_non_null(lighting);
    assert_int_equal(lighting->light_count, CASES);
    for (int i = 0; i < CASES; ++i) {
        if (lighting->lights[i].range_m != cases[i].expected) {
            fail_msg("case %d: %g", i, (double)lighting->lights[i].range_m);
        }
    }
    assert_int_equal(warnings.count, 0);
    dip_model_destroy(&model);
}

static void lights_that_cannot_be_drawn_are_told(void **state) {
    (void)state;
    static const struct {
        enum aiLightSourceType type;
        float ambient;
        const char *message;
    } cases[] = {
        {aiLightSource_AREA, 0.0f, "the light is left out: area lights are not drawn"},
        {aiLightSource_UNDEFINED, 0.0f, "the light is left out: lights of its kind are not drawn"},
        {aiLightSource_AMBIENT, -0.5f,
         "the light is left out: its colour or strength is negative, too large or not a number"},
        {aiLightSource_AMBIENT, NAN,
         "the light is left out: its colour or strength is negative, too large or not a number"},
        {aiLightSource_AMBIENT, 2.0f * DIP_MAX_LIGHT_LIN,
         "the light is left out: its colour or strength is negative, too large or not a number"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        MadeScene *made = made_scene(1);
        struct aiLight light = {.mType = cases[i].type};
        made_string(&light.mName, "lamp");
        light.mColorDiffuse = (struct aiColor3D){1.0f, 1.0f, 1.0f};
        light.mColorAmbient = (struct aiColor3D){0.25f, cases[i].ambient, 0.25f};
        made->lights[0] = &light;
        made->scene.mNumLights = 1;
        DipModel *model = load_with(made, NULL);
        assert_one_warning("lamp", cases[i].message);
        assert_null(dip_model_scene_def(model)->lighting);
        dip_model_destroy(&model);
    }
}

// A point light beyond the greatest strength fades less instead; light from far away cannot.
static void a_light_that_becomes_too_strong_is_left_out(void **state) {
    (void)state;
    for (int i = 0; i < 3; ++i) {
        const DipModelOptions options = {.has_light_scale = true,
                                         .light_scale = i == 0 ? 1.0 : 2.0};
        const bool point = i == 2;
        MadeScene *made = made_scene(1);
        struct aiLight light = {.mType = point ? aiLightSource_POINT : aiLightSource_DIRECTIONAL,
                                .mDirection = {0.0f, -1.0f, 0.0f},
                                .mAttenuationConstant = 1.0f};
        made_string(&light.mName, "lamp");
        light.mColorDiffuse = (struct aiColor3D){DIP_MAX_LIGHT_LIN, 0.0f, 0.0f};
        made->lights[0] = &light;
        made->scene.mNumLights = 1;
        DipModel *model = load_with(made, &options);
        const DipLightingDef *lighting = dip_model_scene_def(model)->lighting;
        if (i == 1) {
            assert_one_warning("lamp", "the light is left out: it is too strong");
            assert_null(lighting);
        } else {
            assert_int_equal(warnings.count, 0);
            const double red = lighting->lights[0].colour_lin[0];
            const double strength = point ? red / lighting->lights[0].attenuation[0] : red;
            const double expected = options.light_scale * (double)DIP_MAX_LIGHT_LIN;
            assert_true(fabs(strength - expected) <= 1e-6 * expected);
        }
        dip_model_destroy(&model);
    }
}

// --- scenes that are refused ---------------------------------------------------------------------

static void a_transform_must_stay_finite(void **state) {
    (void)state;
    MadeScene *made = made_scene(1);
    made->root.mTransformation.a1 = 1e30f;
    made->nodes[0].mTransformation.a1 = 1e8f;
    DipModel *model = load_with(made, NULL);
    assert_true(fixture_object(dip_model_scene_def(model), "node0")->transform[0] == 1e38f);
    dip_model_destroy(&model);
    made->nodes[0].mTransformation.a1 = 1e9f;
    assert_refused(made, NULL, DIP_ERROR_RANGE, made_path(), 0, "node0",
                   "the node's transform is not finite");
}

static void a_mesh_must_have_what_it_claims(void **state) {
    (void)state;
    MadeScene *made = made_scene(1);
    made->meshes[0].mVertices = NULL;
    assert_refused(made, NULL, DIP_ERROR_FORMAT, made_path(), 0, "", "the mesh lacks its vertices");
    made = made_scene(1);
    made->meshes[0].mPrimitiveTypes = aiPrimitiveType_POLYGON;
    assert_refused(made, NULL, DIP_ERROR_FORMAT, made_path(), 0, "", "the mesh lacks its polygons");
    made = made_scene(1);
    made->scene.mFlags = AI_SCENE_FLAGS_INCOMPLETE;
    assert_refused(made, NULL, DIP_ERROR_FORMAT, made_path(), 0, "", "the file has no scene");
    made = made_scene(1);
    made->root.mNumMeshes = 0;
    made->scene.mNumMeshes = 0;
    made->nodes[0].mNumMeshes = 0;
    assert_refused(made, NULL, DIP_ERROR_MISSING, made_path(), 0, "", "the model has no triangles");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_mapped_is_true_for_any_number_but_zero),
        cmocka_unit_test(surface_names_the_kind_of_surface),
        cmocka_unit_test(nodes_share_a_mesh_of_one_material),
        cmocka_unit_test(a_mask_compares_the_base_alpha_with_the_cutoff),
        cmocka_unit_test(blending_is_drawn_as_a_clip_map),
        cmocka_unit_test(an_opacity_of_zero_is_drawn_solid),
        cmocka_unit_test(a_moved_texture_gives_a_warning),
        cmocka_unit_test(a_texture_needs_the_coordinates_it_names),
        cmocka_unit_test(a_rule_gives_a_light_map),
        cmocka_unit_test(a_light_map_of_a_rule_must_be_readable),
        cmocka_unit_test(a_rule_may_mean_the_models_own_light_map),
        cmocka_unit_test(rules_mark_surfaces),
        cmocka_unit_test(embedded_pictures_are_found_by_number),
        cmocka_unit_test(percent_escapes_in_names_are_decoded),
        cmocka_unit_test(a_light_ends_at_the_range_of_its_node),
        cmocka_unit_test(lights_that_cannot_be_drawn_are_told),
        cmocka_unit_test(a_light_that_becomes_too_strong_is_left_out),
        cmocka_unit_test(a_transform_must_stay_finite),
        cmocka_unit_test(a_mesh_must_have_what_it_claims),
    };
    const int failures = cmocka_run_group_tests(tests, fixture_open, fixture_close);
    dip_error_list_free(&warnings);
    return failures;
}
