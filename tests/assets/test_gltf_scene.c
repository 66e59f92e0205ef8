// Tests lights, copies, light maps and materials of glTF scenes where Diptych leaves something out:
// what is drawn instead, and the warning. A small file is changed in a few places at a time.
#include "assets/gltf/reader.h"
#include "assets/animation.h"
#include "assets/model.h"
#include "tests/assets/fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

// The file, with ' for ". A triangle with two sets of texture coordinates. Accessors: 0 positions,
// 1 and 2 texture coordinates, 3 two translations, 4 two rotations, 5 three scales, 6 two times.
static const char base[] =
    "{'asset':{'version':'2.0'},'scene':0,'scenes':[{'nodes':[0,1]}],"
    "'nodes':[{'mesh':0,'name':'wall'},{'name':'stand','translation':[4,5,6]}],"
    "'meshes':[{'name':'bricks','primitives':[{'attributes':{'POSITION':0,'TEXCOORD_0':1,"
    "'TEXCOORD_1':2},'material':0}]}],"
    "'materials':[{'name':'Wall'}],"
    "'buffers':[{'uri':'scene.bin','byteLength':184}],"
    "'bufferViews':[{'buffer':0,'byteLength':36},"
    "{'buffer':0,'byteOffset':36,'byteLength':24},"
    "{'buffer':0,'byteOffset':60,'byteLength':24},"
    "{'buffer':0,'byteOffset':84,'byteLength':24},"
    "{'buffer':0,'byteOffset':108,'byteLength':32},"
    "{'buffer':0,'byteOffset':140,'byteLength':36},"
    "{'buffer':0,'byteOffset':176,'byteLength':8}],"
    "'accessors':[{'bufferView':0,'componentType':5126,'type':'VEC3','count':3},"
    "{'bufferView':1,'componentType':5126,'type':'VEC2','count':3},"
    "{'bufferView':2,'componentType':5126,'type':'VEC2','count':3},"
    "{'bufferView':3,'componentType':5126,'type':'VEC3','count':2},"
    "{'bufferView':4,'componentType':5126,'type':'VEC4','count':2},"
    "{'bufferView':5,'componentType':5126,'type':'VEC3','count':3},"
    "{'bufferView':6,'componentType':5126,'type':'SCALAR','count':2}]}";

static const float numbers[46] = {
    0,     0,      0,     1,      0,      0,    0,    1,    0, // positions
    0.25f, 0.5f,   0.75f, 0.5f,   0.25f,  1.0f,                // texture coordinates, set 0
    0.0f,  0.125f, 0.5f,  0.625f, 0.875f, 1.0f,                // set 1
    1,     2,      3,     -4,     5,      6,                   // translations
    0,     0,      0,     1,      0,      0,    0.6f, 0.8f,    // rotations
    1,     1,      1,     2,      2,      2,    3,    3,    3, // scales
    0,     1};                                                 // times

enum { TRANSLATIONS_AT = 21 };

static char text[4096];

// Replaces the first `from` of the text.
static void change(const char *from, const char *to) {
    char changed[sizeof text];
    const char *at = strstr(text, from);
    if (!at) {
        fail_msg("the file has no %s", from);
    }
    const int length = snprintf(changed, sizeof changed, "%.*s%s%s", (int)(at - text), text, to,
                                at + strlen(from));
    assert_true((size_t)length < sizeof text);
    memcpy(text, changed, (size_t)length + 1);
}

static void start(void) {
    memcpy(text, base, sizeof base);
    fixture_write("scene.bin", numbers, sizeof numbers);
    fixture_write("picture.png", fixture_png, sizeof fixture_png);
}

static const char *finish(void) {
    for (char *c = text; *c; ++c) {
        *c = *c == '\'' ? '"' : *c;
    }
    fixture_write_text("scene.gltf", text);
    return fixture_path("scene.gltf");
}

static void assert_refused(DipErrorCode code, const char *key, const char *reason) {
    const char *path = finish();
    DipError err = {0};
    assert_null(dip_model_load(&path, 1, NULL, NULL, &err));
    if (err.code != code || strcmp(err.key, key) != 0 || !strstr(err.message, reason)) {
        fail_msg("code %s, key \"%s\", message \"%s\"", dip_error_code_name(err.code), err.key,
                 err.message);
    }
}

// Expects one warning, or none if message is NULL. Empties the list.
static void assert_warned(DipErrorList *warnings, const char *key, const char *message) {
    if (warnings->count != (message ? 1 : 0)) {
        fail_msg("%zu warnings, the first is \"%s\"", warnings->count,
                 warnings->count ? warnings->items[0].message : "");
    }
    if (message) {
        assert_string_equal(warnings->items[0].key, key);
        assert_string_equal(warnings->items[0].message, message);
    }
    dip_error_list_free(warnings);
    *warnings = (DipErrorList){0};
}

// --- lights --------------------------------------------------------------------------------------

static void use_lights(const char *lights) {
    char extensions[300];
    snprintf(extensions, sizeof extensions,
             "'extensions':{'KHR_lights_punctual':{'lights':%s}},'asset'", lights);
    start();
    change("'asset'", extensions);
    change("'name':'stand'", "'name':'stand','extensions':{'KHR_lights_punctual':{'light':0}}");
}

static void lights_of_other_kinds_are_left_out(void **state) {
    (void)state;
    static const char *const types[] = {"'area'", "'Point'", "7", "null"};
    DipErrorList warnings = {0};
    for (size_t i = 0; i < sizeof types / sizeof *types; ++i) {
        char lights[100];
        snprintf(lights, sizeof lights, "[{'type':%s},{'type':'point'}]", types[i]);
        use_lights(lights);
        change("{'mesh':0,", "{'extensions':{'KHR_lights_punctual':{'light':1}},'mesh':0,");
        DipModel *model = fixture_load(finish(), NULL, &warnings);
        assert_warned(&warnings, "stand",
                      "the light is left out: lights of its kind are not drawn");
        const DipLightingDef *lighting = dip_model_scene_def(model)->lighting;
        assert_non_null(lighting);
        assert_int_equal(lighting->light_count, 1);
        assert_string_equal(lighting->lights[0].name, "wall");
        dip_model_destroy(&model);
    }
}

static void assert_light(const char *json, float range_m, double inner_deg, double outer_deg) {
    const DipModelOptions options = {.has_light_scale = true, .light_scale = 1.0};
    char lights[200];
    snprintf(lights, sizeof lights, "[{%s,'color':[0.5,1,0.25],'intensity':4}]", json);
    use_lights(lights);
    DipModel *model = fixture_load(finish(), &options, NULL);
    const DipLightDef *light = dip_model_scene_def(model)->lighting->lights;
    const bool fades = light->kind != DIP_LIGHT_DIRECTIONAL;
    if (light->range_m != range_m) {
        fail_msg("%s: %g", json, (double)light->range_m);
    }
    assert_float_equal(light->inner_deg, inner_deg, 1e-5);
    assert_float_equal(light->outer_deg, outer_deg, 1e-5);
    assert_true(light->attenuation[0] == (fades ? 0.0f : 1.0f) && light->attenuation[1] == 0.0f &&
                light->attenuation[2] == (fades ? 1.0f : 0.0f));
    assert_true(light->colour_lin[0] == 2.0f && light->colour_lin[1] == 4.0f &&
                light->colour_lin[2] == 1.0f);
    dip_model_destroy(&model);
}

// An outer angle of more than a quarter turn, and an inner one that is greater than the outer one,
// are limited. pi/4 and 0 are the defaults.
static void ranges_and_cones_are_limited(void **state) {
    (void)state;
    assert_light("'type':'point'", 0.0f, 0.0, 0.0);
    assert_light("'type':'point','range':12.5", 12.5f, 0.0, 0.0);
    assert_light("'type':'point','range':-1", 0.0f, 0.0, 0.0);
    assert_light("'type':'point','range':1e30", 0.0f, 0.0, 0.0);
    assert_light("'type':'directional','range':12.5", 0.0f, 0.0, 0.0);
    assert_light("'type':'spot','range':2", 2.0f, 0.0, 45.0);
    assert_light("'type':'spot','spot':{'outerConeAngle':2}", 0.0f, 0.0, 90.0);
    assert_light("'type':'spot','spot':{'innerConeAngle':1}", 0.0f, 45.0, 45.0);
    assert_light("'type':'spot','spot':{'innerConeAngle':-1}", 0.0f, 0.0, 45.0);
    assert_light("'type':'spot','spot':{'innerConeAngle':0.5235987756,'outerConeAngle':"
                 "1.0471975512}",
                 0.0f, 30.0, 60.0);
}

static void the_first_of_no_animations_is_none(void **state) {
    (void)state;
    const DipModelOptions options = {.animation = DIP_MODEL_ANIMATION_FIRST};
    DipErrorList warnings = {0};
    start();
    DipModel *model = fixture_load(finish(), &options, &warnings);
    assert_int_equal(warnings.count, 0);
    assert_null(dip_model_scene_def(model)->motion);
    dip_model_destroy(&model);
}

static void a_node_that_is_listed_twice_is_drawn_once(void **state) {
    (void)state;
    start();
    change("'nodes':[0,1]", "'nodes':[0,1,0]");
    DipModel *model = fixture_load(finish(), NULL, NULL);
    assert_int_equal(dip_model_scene_def(model)->object_count, 1);
    dip_model_destroy(&model);
}

static void malformed_lights_are_refused(void **state) {
    (void)state;
    use_lights("[]");
    assert_refused(DIP_ERROR_RANGE, "lights", "the file uses item 0 of 0");
    use_lights("{}");
    assert_refused(DIP_ERROR_FORMAT, "lights", "this is not an array");
    use_lights("[{'type':'point','color':[1,1]}]");
    assert_refused(DIP_ERROR_RANGE, "color", "array of 3 finite numbers");
    use_lights("[{'type':'point'}]");
    change("'light':0", "'light':0.5");
    assert_refused(DIP_ERROR_RANGE, "light", "this is not an integer");
}

// Lights stand where they are at rest. One warning says so, and only if the animation that plays
// moves the light or a node above it.
static void lights_that_an_animation_moves_stand_still(void **state) {
    (void)state;
    static const char moved[] = "lights stand still where the animation moves them";
    static const char animation[] =
        "'animations':[{'samplers':[{'input':6,'output':3}],'channels':[{'sampler':0,'target':{"
        "'node':1,'path':'translation'}}]}],'materials'";
    const DipModelOptions plays = {
        .has_light_scale = true, .light_scale = 1.0, .animation = DIP_MODEL_ANIMATION_FIRST};
    const DipModelOptions rests = {.has_light_scale = true, .light_scale = 1.0};
    DipErrorList warnings = {0};
    for (int i = 0; i < 4; ++i) {
        use_lights("[{'type':'point'}]");
        change("'materials'", animation);
        if (i == 1) { // The animation moves a node above two lights.
            change("'nodes':[0,1]", "'nodes':[0,2]");
            change("'translation':[4,5,6]}", "'translation':[4,5,6]},{'children':[1,3]},"
                                             "{'extensions':{'KHR_lights_punctual':{'light':0}}}");
            change("'target':{'node':1", "'target':{'node':2");
        } else if (i == 2) { // It moves another node.
            change("'target':{'node':1", "'target':{'node':0");
        }
        DipModel *model = fixture_load(finish(), i == 3 ? &rests : &plays, &warnings);
        assert_warned(&warnings, "stand", i < 2 ? moved : NULL);
        const DipLightingDef *lighting = dip_model_scene_def(model)->lighting;
        assert_int_equal(lighting->light_count, i == 1 ? 2 : 1);
        const float *place = lighting->lights[0].position_world;
        assert_true(place[0] == 4.0f && place[1] == 5.0f && place[2] == 6.0f);
        dip_model_destroy(&model);
    }
}

// --- copies --------------------------------------------------------------------------------------

static void instance(const char *attributes) {
    char extension[200];
    snprintf(extension, sizeof extension,
             "{'extensions':{'EXT_mesh_gpu_instancing':{'attributes':{%s}}},'mesh':0,", attributes);
    start();
    change("{'mesh':0,", extension);
}

static void copies_need_as_many_values_of_each_kind(void **state) {
    (void)state;
    static const char key[] = "EXT_mesh_gpu_instancing";
    instance("'TRANSLATION':3,'ROTATION':4");
    DipModel *model = fixture_load(finish(), NULL, NULL);
    const DipSceneDef *def = dip_model_scene_def(model);
    assert_int_equal(def->object_count, 2);
    assert_true(def->objects[0].transform[3] == 1.0f && def->objects[1].transform[3] == -4.0f);
    // The quaternion (0, 0, 0.6, 0.8) has the cosine 0.8^2 - 0.6^2 and the sine 2 * 0.8 * 0.6.
    assert_true(fabsf(def->objects[1].transform[0] - 0.28f) < 1e-6f);
    assert_true(fabsf(def->objects[1].transform[4] - 0.96f) < 1e-6f);
    dip_model_destroy(&model);
    instance("'TRANSLATION':3,'SCALE':5");
    assert_refused(DIP_ERROR_RANGE, key, "a node has 2 and 3 instances");
    instance("'SCALE':5,'ROTATION':4"); // Translation, rotation and scale are read in this order.
    assert_refused(DIP_ERROR_RANGE, key, "a node has 2 and 3 instances");
    instance("'ROTATION':5");
    assert_refused(DIP_ERROR_FORMAT, "accessors", "the accessor of ROTATION has another type");
}

static void copies_beyond_the_floats_are_refused(void **state) {
    (void)state;
    static const float bad[] = {NAN, INFINITY, 3e38f};
    for (size_t i = 0; i < 3; ++i) {
        float changed[sizeof numbers / sizeof *numbers];
        memcpy(changed, numbers, sizeof numbers);
        changed[TRANSLATIONS_AT + 4] = bad[i];
        instance("'TRANSLATION':3");
        change("'name':'wall'", "'scale':[1,2,1]"); // Twice 3e38 is more than a float holds.
        fixture_write("scene.bin", changed, sizeof changed);
        assert_refused(DIP_ERROR_RANGE, "EXT_mesh_gpu_instancing",
                       "the node's transform is not finite");
    }
    start();
    change("'translation':[4,5,6]", "'children':[2],'scale':[3e38,1,1]},{'scale':[2,1,1]");
    assert_refused(DIP_ERROR_RANGE, "", "the node's transform is not finite");
}

// --- light maps ----------------------------------------------------------------------------------

static const char occlusion[] = "'name':'Wall','occlusionTexture':{'index':0}";
static const char pictures[] = "'textures':[{'source':0}],'images':[{'uri':'picture.png'}],"
                               "'materials'";

static DipModel *load_marked(const char *light_map, DipErrorList *warnings) {
    const DipMaterialRule rule = {
        .mark = DIP_MARK_LIGHT_MAP, .pattern = "Wa*", .light_map = light_map};
    const DipModelOptions options = {.rules = &rule, .rule_count = 1};
    return fixture_load(finish(), &options, warnings);
}

// Checks that the light map stores half of the light, and that it is read at these coordinates of
// the file.
static void assert_light_mapped(const DipModel *model, const float *uv1) {
    const DipSceneDef *def = dip_model_scene_def(model);
    const DipMeshDef *mesh = &def->meshes[0];
    const DipMaterialDef *material = &def->materials[mesh->material];
    assert_true(material->light_map >= 0);
    assert_true(material->light_map_scale == 2.0f);
    assert_false(material->lit);
    assert_null(material->pbr);
    const DipTextureDef *texture = &def->textures[material->light_map];
    assert_non_null(strstr(texture->name, "picture.png"));
    assert_int_equal(texture->wrap_u, DIP_WRAP_REPEAT);
    assert_int_equal(texture->wrap_v, DIP_WRAP_REPEAT);
    assert_int_equal(mesh->index_count, 3);
    assert_non_null(mesh->uv1);
    for (uint32_t i = 0; i < 3; ++i) {
        assert_memory_equal(mesh->uv1 + 2 * (size_t)mesh->indices[i], uv1 + 2 * i, 2 * sizeof *uv1);
    }
}

// The picture that a rule names is read at the second set of coordinates, or at the first of a mesh
// that has only one.
static void the_picture_of_a_rule_is_a_light_map(void **state) {
    (void)state;
    DipErrorList warnings = {0};
    for (int i = 0; i < 3; ++i) {
        start();
        if (i > 0) {
            change(",'TEXCOORD_1':2", "");
        }
        if (i > 1) {
            change(",'TEXCOORD_0':1", "");
        }
        char picture[FIXTURE_PATH];
        snprintf(picture, sizeof picture, "%s", fixture_path("picture.png"));
        DipModel *model = load_marked(picture, &warnings);
        if (i < 2) {
            assert_warned(&warnings, NULL, NULL);
            assert_light_mapped(model, numbers + (i == 0 ? 15 : 9));
        } else {
            char message[FIXTURE_PATH + 100];
            snprintf(message, sizeof message,
                     "mesh \"bricks\" has no texture coordinates, so its light map %s is ignored",
                     picture);
            assert_warned(&warnings, "Wall", message);
            const DipSceneDef *def = dip_model_scene_def(model);
            assert_int_equal(def->materials[def->meshes[0].material].light_map, DIP_NO_TEXTURE);
            assert_null(def->meshes[0].uv1);
        }
        dip_model_destroy(&model);
    }
}

// A rule without a picture, and the key of a node, mean the occlusion picture. Its coordinates are
// those that the file names.
static void the_occlusion_picture_is_a_light_map(void **state) {
    (void)state;
    DipErrorList warnings = {0};
    for (int set = 0; set < 2; ++set) {
        for (int by_rule = 0; by_rule < 2; ++by_rule) {
            start();
            change("'name':'Wall'", occlusion);
            change("'index':0", set ? "'index':0,'texCoord':1" : "'index':0,'texCoord':0");
            change("'materials'", pictures);
            if (!by_rule) {
                change("'name':'wall'", "'extras':{'lightmapped':true}");
            }
            DipModel *model =
                by_rule ? load_marked(NULL, &warnings) : fixture_load(finish(), NULL, &warnings);
            assert_warned(&warnings, NULL, NULL);
            assert_light_mapped(model, numbers + (set ? 15 : 9));
            dip_model_destroy(&model);
        }
    }
}

static void a_light_map_that_is_not_there_gives_a_warning(void **state) {
    (void)state;
    static const char unmarked[] = "the material is marked as light-mapped, but has no light map";
    DipErrorList warnings = {0};
    start();
    DipModel *model = load_marked(NULL, &warnings);
    assert_warned(&warnings, "Wall", unmarked);
    dip_model_destroy(&model);
    start(); // The key of a node may stand above surfaces that have none.
    change("'name':'wall'", "'extras':{'lightmapped':1}");
    model = fixture_load(finish(), NULL, &warnings);
    assert_warned(&warnings, NULL, NULL);
    dip_model_destroy(&model);
    // Sets of coordinates from 8 on are not read.
    static const int sets[] = {2, DIP_GLTF_MAX_SETS, 1000};
    for (size_t i = 0; i < sizeof sets / sizeof *sets; ++i) {
        char index[64], warning[100];
        snprintf(index, sizeof index, "'index':0,'texCoord':%d", sets[i]);
        snprintf(warning, sizeof warning,
                 "mesh \"bricks\" has no texture coordinates %d, so the light map is ignored",
                 sets[i]);
        start();
        change("'name':'wall'", "'extras':{'lightmapped':1}");
        change("'name':'Wall'", occlusion);
        change("'index':0", index);
        change("'POSITION':0", "'POSITION':0,'COLOR_0':0");
        change("'materials'", pictures);
        model = fixture_load(finish(), NULL, &warnings);
        assert_warned(&warnings, "Wall", warning);
        dip_model_destroy(&model);
    }
    start();
    change("'name':'Wall'", occlusion);
    change("'materials'", "'textures':[{}],'materials'");
    model = fixture_load(finish(), NULL, &warnings);
    assert_warned(&warnings, "Wall", "texture 0 has no picture");
    dip_model_destroy(&model);
}

// A surface with a light map is lit by it alone. Each thing that is lost has the warning, but once
// for each file.
static void what_a_light_map_replaces_gives_a_warning(void **state) {
    (void)state;
    static const char lost[] = "emission, clear coat and sheen are not drawn on surfaces with a "
                               "light map, glass, water and sky";
    static const struct {
        const char *members;
        bool is_lost;
    } cases[] = {
        {"'emissiveFactor':[0,0,0.5]", true},
        {"'emissiveFactor':[0,0,0]", false},
        {"'extensions':{'KHR_materials_clearcoat':{'clearcoatFactor':0.5}}", true},
        {"'extensions':{'KHR_materials_clearcoat':{'clearcoatFactor':0}}", false},
        {"'extensions':{'KHR_materials_sheen':{'sheenColorFactor':[0,0.1,0]}}", true},
        {"'extensions':{'KHR_materials_sheen':{'sheenRoughnessFactor':1}}", false},
        {"'emissiveFactor':[1,0,0],'extensions':{'KHR_materials_unlit':{}}", false},
    };
    DipErrorList warnings = {0};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        for (int marked = 0; marked < 2; ++marked) {
            char material[200];
            snprintf(material, sizeof material, "{'name':'Wall',%s},{'name':'Wall 2',%s}",
                     cases[i].members, cases[i].members);
            start();
            change("{'name':'Wall'}", material);
            change("'material':0}", "'material':0},{'attributes':{'POSITION':0},'material':1}");
            if (marked) {
                change("'name':'wall'", "'extras':{'lightmapped':true}");
            }
            DipModel *model = fixture_load(finish(), NULL, &warnings);
            assert_warned(&warnings, "Wall", marked && cases[i].is_lost ? lost : NULL);
            dip_model_destroy(&model);
        }
    }
}

// Glass bends no light with a normal map, unless it has a light map. Here the light map is the
// first picture of the file, which another surface uses too.
static void the_scale_of_a_normal_map_beside_a_light_map_gives_a_warning(void **state) {
    (void)state;
    const DipMaterialRule rule = {.mark = DIP_MARK_LIGHT_MAP, .pattern = "Wall*"};
    const DipModelOptions options = {.normal_maps = true, .rules = &rule, .rule_count = 1};
    DipErrorList warnings = {0};
    for (int scaled = 0; scaled < 2; ++scaled) {
        start();
        change("{'name':'Wall'}",
               scaled ? "{'name':'Wall 2','occlusionTexture':{'index':0}},{'name':'Wall',"
                        "'occlusionTexture':{'index':0},"
                        "'normalTexture':{'index':1,'scale':0.5}}"
                      : "{'name':'Wall 2','occlusionTexture':{'index':0}},{'name':'Wall',"
                        "'occlusionTexture':{'index':0},"
                        "'normalTexture':{'index':1,'scale':1}}");
        change("'material':0}",
               "'material':0},{'attributes':{'POSITION':0,'TEXCOORD_0':1},'material':1}");
        change("'materials'", "'textures':[{'source':0},{'source':1}],'images':[{'uri':"
                              "'picture.png'},{'uri':'normal.png'}],'materials'");
        change("'name':'wall'", "'extras':{'surface':'glass'}");
        fixture_write("normal.png", fixture_png, sizeof fixture_png);
        DipModel *model = fixture_load(finish(), &options, &warnings);
        const DipSceneDef *def = dip_model_scene_def(model);
        assert_int_equal(def->material_count, 2);
        assert_int_equal(def->materials[0].light_map, def->materials[1].light_map);
        assert_true(def->materials[1].normal_map >= 0);
        assert_warned(&warnings, "Wall",
                      scaled ? "the scale of a normal map is not drawn on surfaces with a light "
                               "map or with the keys surface or lightmapped"
                             : NULL);
        dip_model_destroy(&model);
    }
}

// --- animated models -----------------------------------------------------------------------------

static DipAnimatedModel *load_animated(DipErrorList *warnings) {
    DipError err = {0};
    DipAnimatedModel *model = dip_animated_model_load(finish(), NULL, warnings, &err);
    if (!model) {
        fail_msg("%s", err.message);
    }
    return model;
}

static const char colour[] = "'name':'Wall','pbrMetallicRoughness':{'baseColorTexture':{"
                             "'index':0},'baseColorFactor':[1,1,1,0.5]}";

// The texel with alpha 0 makes a difference where the material clips or blends.
static void blended_surfaces_of_animated_models_are_clipped(void **state) {
    (void)state;
    static const char blending[] = "blending is not kept: the surface is clipped at an alpha of "
                                   "0.5";
    static const struct {
        const char *mode;
        const char *warning;
        DipSurface surface;
        float cutoff;
    } cases[] = {
        {"'OPAQUE'", NULL, DIP_SURFACE_OPAQUE, 0.5f},
        {"'BLEND'", blending, DIP_SURFACE_CLIPPED, 0.5f},
        {"'MASK'", NULL, DIP_SURFACE_CLIPPED, 1.0f}, // 0.5 of the factor 0.5
        {"'MASK','alphaCutoff':0.125", NULL, DIP_SURFACE_CLIPPED, 0.25f},
        {"'MASK','alphaCutoff':0", NULL, DIP_SURFACE_CLIPPED, 0.0f},
        {"'MASK','alphaCutoff':0.75",
         "the surface is drawn, although its base alpha of 0.5 is below its cutoff of 0.75",
         DIP_SURFACE_CLIPPED, 1.0f},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        DipErrorList warnings = {0};
        char material[300];
        snprintf(material, sizeof material, "%s,'alphaMode':%s", colour, cases[i].mode);
        start();
        change("'name':'Wall'", material);
        change("'materials'", pictures);
        DipAnimatedModel *model = load_animated(&warnings);
        const DipAnimatedDef *def = dip_animated_model_def(model);
        assert_warned(&warnings, "Wall", cases[i].warning);
        assert_int_equal(def->materials[0].surface, cases[i].surface);
        if (cases[i].surface == DIP_SURFACE_CLIPPED) {
            assert_true(def->materials[0].alpha_cutoff == cases[i].cutoff);
        }
        assert_int_equal(def->texture_count, 1);
        assert_int_equal(def->textures[0].width, 2);
        assert_memory_equal(def->textures[0].rgba8, "\377\0\0\377\0\377\0\377\0\0\377\377", 12);
        dip_animated_model_destroy(&model);
    }
}

static void a_missing_picture_of_an_animated_model_gives_a_warning(void **state) {
    (void)state;
    DipErrorList warnings = {0};
    start();
    change("'name':'Wall'", colour);
    change("'materials'", pictures);
    change("picture.png", "nowhere.png");
    DipAnimatedModel *model = load_animated(&warnings);
    const DipAnimatedDef *def = dip_animated_model_def(model);
    assert_int_equal(warnings.count, 1);
    assert_non_null(strstr(warnings.items[0].message, "nowhere.png"));
    assert_int_equal(def->materials[0].colour_texture, DIP_NO_TEXTURE);
    dip_error_list_free(&warnings);
    dip_animated_model_destroy(&model);
}

static void what_has_no_name_is_numbered(void **state) {
    (void)state;
    start();
    change("{'name':'Wall'}", "{}");
    change("'material':0}", "'material':0},{'attributes':{'POSITION':0}}");
    change("'name':'wall'", "'name':''");
    DipAnimatedModel *model = load_animated(NULL);
    const DipAnimatedDef *def = dip_animated_model_def(model);
    assert_int_equal(def->material_count, 2);
    assert_string_equal(def->materials[0].name, "material 0");
    assert_string_equal(def->materials[1].name, "default material");
    assert_string_equal(def->objects[0].name, "node 0");
    dip_animated_model_destroy(&model);
}

// --- small files that describe much --------------------------------------------------------------

// An accessor without a view has as many zeros as the file says. 2^30 bytes are the most.
static void values_that_the_file_does_not_hold_are_limited(void **state) {
    (void)state;
    static const char view[] = "{'bufferView':0,'componentType':5126,'type':'VEC3','count':3}";
    DipError err = {0};
    start();
    change(view, "{'componentType':5126,'type':'VEC3','count':89478486}");
    change("'TEXCOORD_0':1,'TEXCOORD_1':2", "'NORMAL':0");
    assert_null(dip_animated_model_load(finish(), NULL, NULL, &err));
    assert_int_equal(err.code, DIP_ERROR_OVERSIZED);
    assert_string_equal(err.message, "the model needs more memory than is accepted: 1024 MiB");
    start();
    change(view, "{'componentType':5126,'type':'VEC3','count':89478486,'sparse':{}}");
    change(",'TEXCOORD_0':1,'TEXCOORD_1':2", "");
    assert_refused(DIP_ERROR_OVERSIZED, "",
                   "the content of the model is larger than is accepted: 1024 MiB unpacked");
    start(); // 8 bytes less than 2^30 get as far as the list of the values that differ.
    change(view, "{'componentType':5126,'type':'VEC3','count':89478485,'sparse':{}}");
    change(",'TEXCOORD_0':1,'TEXCOORD_1':2", "");
    assert_refused(DIP_ERROR_FORMAT, "sparse",
                   "the sparse accessor of POSITION lists 0 of 89478485 values");
}

static void assert_values(const float *values, double x, double y, double z) {
    const double expected[3] = {x, y, z};
    for (int i = 0; i < 3; ++i) {
        assert_float_equal(values[i], expected[i], 1e-6);
    }
}

static void factors_out_of_range_are_limited(void **state) {
    (void)state;
    start();
    change("'name':'Wall'",
           "'pbrMetallicRoughness':{'baseColorFactor':[2,-1,3,5],'metallicFactor':7,"
           "'roughnessFactor':-2},'emissiveFactor':[-1,2,1e30],'extensions':{"
           "'KHR_materials_sheen':{'sheenColorFactor':[2,-1,3],'sheenRoughnessFactor':4},"
           "'KHR_materials_clearcoat':{'clearcoatFactor':9,'clearcoatRoughnessFactor':-1},"
           "'KHR_materials_specular':{'specularFactor':3,'specularColorFactor':[99,-1,0.5]}}");
    DipModel *model = fixture_load(finish(), NULL, NULL);
    const DipMaterialDef *material = dip_model_scene_def(model)->materials;
    const DipPbrDef *pbr = material->pbr;
    assert_values(material->base_colour_lin, 1.0, 0.0, 1.0);
    assert_values((const float[]){pbr->metallic, pbr->roughness, pbr->f90}, 1.0, 0.0, 1.0);
    assert_values(pbr->f0_lin, 1.0, 0.0, 0.02);
    assert_values(pbr->sheen_lin, 1.0, 0.0, 1.0);
    assert_values((const float[]){pbr->sheen_roughness, pbr->coat, pbr->coat_roughness}, 1.0, 1.0,
                  0.0);
    assert_values(pbr->emission_lin, 0.0, 2.0, 1e9);
    dip_model_destroy(&model);
    start();
    change("'name':'Wall'", "'extensions':{'KHR_materials_pbrSpecularGlossiness':{"
                            "'diffuseFactor':[2,-1,3,5],'specularFactor':[2,-1,0.5],"
                            "'glossinessFactor':5}}");
    model = fixture_load(finish(), NULL, NULL);
    material = dip_model_scene_def(model)->materials;
    assert_values(material->base_colour_lin, 1.0, 0.0, 1.0);
    assert_values(material->pbr->f0_lin, 1.0, 0.0, 0.5);
    assert_values(
        (const float[]){material->pbr->metallic, material->pbr->roughness, material->pbr->f90}, 0.0,
        0.0, 1.0);
    dip_model_destroy(&model);
}

// Writes a file with a mesh that lists `part` `parts` times, and nodes that all show the mesh.
static const char *write_many(const char *begin, const char *part, int parts, const char *end,
                              int nodes) {
    FILE *file = fopen(fixture_path("many.gltf"), "w");
    assert_non_null(file);
    fprintf(file,
            "{\"asset\":{\"version\":\"2.0\"},\"accessors\":[{\"componentType\":5126,"
            "\"type\":\"VEC3\",\"count\":3}],\"meshes\":[{\"primitives\":[%s",
            begin);
    for (int i = 0; i < parts; ++i) {
        fprintf(file, "%s%s", i > 0 ? "," : "", part);
    }
    fprintf(file, "%s]}],\"nodes\":[", end);
    for (int i = 0; i < nodes; ++i) {
        fprintf(file, "%s{\"mesh\":0}", i > 0 ? "," : "");
    }
    fprintf(file, "]}");
    fclose(file);
    return fixture_path("many.gltf");
}

// The limits are 2^20 objects and 2^24 weights of morph targets.
static void objects_and_weights_are_limited(void **state) {
    (void)state;
    static const char part[] = "{\"attributes\":{\"POSITION\":0}}";
    static const char begin[] = "{\"attributes\":{\"POSITION\":0},\"targets\":[";
    DipError err = {0};
    DipAnimatedModel *model =
        dip_animated_model_load(write_many("", part, 1024, "", 1024), NULL, NULL, &err);
    assert_non_null(model);
    assert_int_equal(dip_animated_model_def(model)->object_count, 1 << 20);
    dip_animated_model_destroy(&model);
    assert_null(dip_animated_model_load(write_many("", part, 1024, "", 1025), NULL, NULL, &err));
    assert_int_equal(err.code, DIP_ERROR_RANGE);
    assert_string_equal(err.key, "nodes");
    assert_string_equal(err.message, "the model has more than 1048576 objects");
    model = dip_animated_model_load(write_many(begin, "{}", 4096, "]}", 4096), NULL, NULL, &err);
    assert_non_null(model);
    dip_animated_model_destroy(&model);
    assert_null(
        dip_animated_model_load(write_many(begin, "{}", 4096, "]}", 4097), NULL, NULL, &err));
    assert_int_equal(err.code, DIP_ERROR_RANGE);
    assert_string_equal(err.key, "weights");
    assert_string_equal(err.message, "the nodes have more than 16777216 morph targets");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lights_of_other_kinds_are_left_out),
        cmocka_unit_test(ranges_and_cones_are_limited),
        cmocka_unit_test(the_first_of_no_animations_is_none),
        cmocka_unit_test(a_node_that_is_listed_twice_is_drawn_once),
        cmocka_unit_test(malformed_lights_are_refused),
        cmocka_unit_test(lights_that_an_animation_moves_stand_still),
        cmocka_unit_test(copies_need_as_many_values_of_each_kind),
        cmocka_unit_test(copies_beyond_the_floats_are_refused),
        cmocka_unit_test(the_picture_of_a_rule_is_a_light_map),
        cmocka_unit_test(the_occlusion_picture_is_a_light_map),
        cmocka_unit_test(a_light_map_that_is_not_there_gives_a_warning),
        cmocka_unit_test(the_scale_of_a_normal_map_beside_a_light_map_gives_a_warning),
        cmocka_unit_test(what_a_light_map_replaces_gives_a_warning),
        cmocka_unit_test(blended_surfaces_of_animated_models_are_clipped),
        cmocka_unit_test(a_missing_picture_of_an_animated_model_gives_a_warning),
        cmocka_unit_test(what_has_no_name_is_numbered),
        cmocka_unit_test(values_that_the_file_does_not_hold_are_limited),
        cmocka_unit_test(factors_out_of_range_are_limited),
        cmocka_unit_test(objects_and_weights_are_limited),
    };
    return cmocka_run_group_tests(tests, fixture_open, fixture_close);
}
