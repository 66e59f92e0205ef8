// Tests what the reader of glTF files refuses in meshes, nodes, skins, animations and materials.
// One small file is changed in one place at a time. Each fault has the exact key, code and reason,
// and where there is a limit, the change on its other side is accepted. Each file goes to both
// readers of glTF: the one that makes scenes, and the one that makes animated models.
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

// The file, with ' for ". A triangle with two joints, a morph target and an animation. Accessors: 0
// positions, 1 joints, 2 weights, 3 matrices, 4 indices, 5 the target's positions, 6 times, 7
// translations, 8 anything for a fault.
static const char base[] =
    "{'asset':{'version':'2.0'},'scene':0,'scenes':[{'nodes':[0,1]}],"
    "'nodes':[{'mesh':0,'skin':0,'name':'body'},{'children':[2]},{'translation':[0,1,0]}],"
    "'skins':[{'joints':[1,2],'inverseBindMatrices':3}],"
    "'meshes':[{'name':'cloth','primitives':[{'attributes':{'POSITION':0,'JOINTS_0':1,"
    "'WEIGHTS_0':2},'indices':4,'material':0,'targets':[{'POSITION':5}]}]}],"
    "'materials':[{'doubleSided':true}],"
    "'animations':[{'samplers':[{'input':6,'output':7}],"
    "'channels':[{'sampler':0,'target':{'node':2,'path':'translation'}}]}],"
    "'buffers':[{'uri':'base.bin','byteLength':320}],"
    "'bufferViews':[{'buffer':0,'byteLength':36},"
    "{'buffer':0,'byteOffset':36,'byteLength':24},"
    "{'buffer':0,'byteOffset':60,'byteLength':48},"
    "{'buffer':0,'byteOffset':108,'byteLength':128},"
    "{'buffer':0,'byteOffset':236,'byteLength':12},"
    "{'buffer':0,'byteOffset':248,'byteLength':36},"
    "{'buffer':0,'byteOffset':284,'byteLength':8},"
    "{'buffer':0,'byteOffset':292,'byteLength':24}],"
    "'accessors':[{'bufferView':0,'componentType':5126,'type':'VEC3','count':3},"
    "{'bufferView':1,'componentType':5121,'type':'VEC4','count':3},"
    "{'bufferView':2,'componentType':5126,'type':'VEC4','count':3},"
    "{'bufferView':3,'componentType':5126,'type':'MAT4','count':2},"
    "{'bufferView':4,'componentType':5125,'type':'SCALAR','count':3},"
    "{'bufferView':5,'componentType':5126,'type':'VEC3','count':3},"
    "{'bufferView':6,'componentType':5126,'type':'SCALAR','count':2},"
    "{'bufferView':7,'componentType':5126,'type':'VEC3','count':2},"
    "{'componentType':5126,'type':'VEC2','count':3}]}";

enum {
    JOINTS_AT = 36,
    WEIGHTS_AT = 60,
    MATRICES_AT = 108,
    INDICES_AT = 236,
    TARGET_AT = 248,
    TIMES_AT = 284,
    TRANSLATIONS_AT = 292,
    BINARY_BYTES = 320
};

static uint8_t binary[BINARY_BYTES];

static void put_float(size_t at, float value) {
    memcpy(binary + at, &value, sizeof value); // The machine has glTF's order of bytes.
}

static void put_u32(size_t at, uint32_t value) {
    memcpy(binary + at, &value, sizeof value);
}

static void reset_binary(void) {
    memset(binary, 0, sizeof binary);
    put_float(12, 1.0f); // The corners are (0, 0, 0), (1, 0, 0) and (0, 1, 0).
    put_float(28, 1.0f);
    for (size_t i = 0; i < 3; ++i) {
        put_float(WEIGHTS_AT + 16 * i, 1.0f);
        put_u32(INDICES_AT + 4 * i, (uint32_t)i);
    }
    for (size_t i = 0; i < 8; ++i) {
        put_float(MATRICES_AT + 64 * (i / 4) + 20 * (i % 4), 1.0f);
    }
    put_float(TIMES_AT + 4, 1.0f);
}

// Writes the file, with the first `from` replaced by `to`.
static const char *write_changed(const char *from, const char *to) {
    const char *at = strstr(base, from);
    if (!at) {
        fail_msg("the file has no %s", from);
    }
    const size_t room = sizeof base + strlen(to);
    char *text = malloc(room);
    assert_non_null(text);
    snprintf(text, room, "%.*s%s%s", (int)(at - base), base, to, at + strlen(from));
    for (char *c = text; *c; ++c) {
        *c = *c == '\'' ? '"' : *c;
    }
    fixture_write_text("changed.gltf", text);
    fixture_write("base.bin", binary, sizeof binary);
    free(text);
    return fixture_path("changed.gltf");
}

// --- the two readers -----------------------------------------------------------------------------

enum { SCENE = 1, ANIMATED = 2, BOTH = 3 };

static bool read_with(int reader, const char *path, DipErrorList *warnings, DipError *err) {
    if (reader == SCENE) {
        const DipModelOptions options = {.animation = DIP_MODEL_ANIMATION_FIRST};
        DipModel *model = dip_model_load_with(&path, 1, &options, NULL, warnings, err);
        const bool ok = model != NULL;
        dip_model_destroy(&model);
        return ok;
    }
    DipAnimatedModel *model = dip_animated_model_load(path, NULL, warnings, err);
    const bool ok = model != NULL;
    dip_animated_model_destroy(&model);
    return ok;
}

// Expects the error, or none if the code is DIP_ERROR_NONE.
static void check(int readers, const char *path, const char *what, DipErrorCode code,
                  const char *key, const char *reason) {
    for (int reader = SCENE; reader <= ANIMATED; ++reader) {
        DipError err = {0};
        const bool ok = !(readers & reader) || read_with(reader, path, NULL, &err);
        const bool expected =
            err.code == code &&
            (code == DIP_ERROR_NONE || (strcmp(err.key, key) == 0 && strstr(err.message, reason)));
        if ((readers & reader) && (!expected || ok != (code == DIP_ERROR_NONE))) {
            fail_msg("%s, %s: %s, code %s, key \"%s\", message \"%s\"", what,
                     reader == SCENE ? "scene" : "animated model", ok ? "accepted" : "refused",
                     dip_error_code_name(err.code), err.key, err.message);
        }
        assert_null(strchr(err.message, '\n'));
    }
}

typedef struct Fault {
    const char *from, *to; // What the fault replaces, and by what.
    DipErrorCode code;
    const char *key, *reason;
    int readers;
    const char *kept; // Is accepted in the place of `to`, or NULL.
} Fault;

static void check_faults(const Fault *faults, size_t count) {
    reset_binary();
    check(BOTH, write_changed("'asset'", "'asset'"), "unchanged", DIP_ERROR_NONE, "", "");
    for (size_t i = 0; i < count; ++i) {
        const Fault *f = &faults[i];
        check(f->readers, write_changed(f->from, f->to), f->to, f->code, f->key, f->reason);
        if (f->kept) {
            check(f->readers, write_changed(f->from, f->kept), f->kept, DIP_ERROR_NONE, "", "");
        }
    }
}

// --- JSON ----------------------------------------------------------------------------------------

static void malformed_nodes_are_refused(void **state) {
    (void)state;
    static const char not_a_node[] = "node 1 has a child that is not a node";
    static const Fault faults[] = {
        {"[2]}", "[2,2]}", DIP_ERROR_FORMAT, "children", "node 2 has two parents", BOTH, "[]}"},
        {"'name':'body'", "'children':[2]", DIP_ERROR_FORMAT, "children", "node 2 has two parents",
         BOTH, "'children':[]"},
        {"[2]}", "[3]}", DIP_ERROR_RANGE, "children", not_a_node, BOTH, NULL},
        {"[2]}", "[1.5]}", DIP_ERROR_RANGE, "children", not_a_node, BOTH, NULL},
        {"[2]}", "['2']}", DIP_ERROR_RANGE, "children", not_a_node, BOTH, NULL},
        {"[2]}", "[0]}", DIP_ERROR_NONE, "", "", BOTH, NULL}, // A root may be a child, too.
        {"{'children':[2]}", "7", DIP_ERROR_FORMAT, "nodes", "item 1 is not an object", BOTH, NULL},
        {"[0,1,0]", "[0,1]", DIP_ERROR_RANGE, "translation", "array of 3 finite numbers", BOTH,
         NULL},
        {"[0,1,0]", "[0,1,0,0]", DIP_ERROR_RANGE, "translation", "array of 3 finite numbers", BOTH,
         NULL},
        {"[0,1,0]", "[0,1e39,0]", DIP_ERROR_RANGE, "translation", "array of 3 finite numbers", BOTH,
         "[0,1e38,0]"}, // A float holds up to 3.4e38.
        {"[0,1,0]", "'up'", DIP_ERROR_RANGE, "translation", "array of 3 finite numbers", BOTH,
         NULL},
        {"'mesh':0,", "'mesh':1,", DIP_ERROR_RANGE, "meshes", "the file uses item 1 of 1", BOTH,
         NULL},
        {"'mesh':0,", "'mesh':-1,", DIP_ERROR_RANGE, "mesh", "this is not an integer", BOTH, NULL},
        {"'skin':0,", "'skin':1,", DIP_ERROR_RANGE, "skin", "the node uses skin 1 of 1", BOTH,
         NULL},
        {"'skin':0,", "'skin':'0',", DIP_ERROR_RANGE, "skin", "this is not an integer", BOTH, NULL},
        {"'nodes':[0,1]", "'nodes':[0,3]", DIP_ERROR_RANGE, "scenes",
         "scene 0 has a node that does not exist", BOTH, "'nodes':[0,2]"},
        {"'nodes':[0,1]", "'nodes':[0,0.5]", DIP_ERROR_RANGE, "scenes",
         "scene 0 has a node that does not exist", BOTH, NULL},
        {"'scene':0", "'scene':1", DIP_ERROR_RANGE, "scenes", "the file uses item 1 of 1", BOTH,
         NULL},
        {"'scene':0", "'scene':true", DIP_ERROR_RANGE, "scene", "this is not an integer", BOTH,
         NULL},
    };
    check_faults(faults, sizeof faults / sizeof *faults);
}

static void malformed_skins_are_refused(void **state) {
    (void)state;
    static const Fault faults[] = {
        {"'type':'MAT4','count':2", "'type':'MAT4','count':1", DIP_ERROR_RANGE,
         "inverseBindMatrices", "there are 1 matrices for 2 joints", BOTH, NULL},
        {"'joints':[1,2]", "'joints':[1]", DIP_ERROR_NONE, "", "", BOTH, NULL}, // One to spare.
        {"'joints':[1,2]", "'joints':[1,2,2]", DIP_ERROR_RANGE, "inverseBindMatrices",
         "there are 2 matrices for 3 joints", BOTH, "'joints':[2,1]"},
        {"'type':'MAT4'", "'type':'VEC4'", DIP_ERROR_FORMAT, "accessors",
         "the accessor of inverseBindMatrices has another type", BOTH, NULL},
        {"'joints':[1,2]", "'joints':[1,3]", DIP_ERROR_RANGE, "joints", "joint 1 is not a node",
         BOTH, "'joints':[1,0]"},
        {"'joints':[1,2]", "'joints':{}", DIP_ERROR_FORMAT, "joints", "this is not an array", BOTH,
         NULL},
        {"{'joints':[1,2],'inverseBindMatrices':3}", "null", DIP_ERROR_FORMAT, "skins",
         "item 0 is not an object", BOTH, "{'joints':[1,2]}"},
        {"'joints':[1,2]", "'joints':[]", DIP_ERROR_RANGE, "JOINTS_0", "a vertex uses joint 0 of 0",
         BOTH, NULL},
    };
    check_faults(faults, sizeof faults / sizeof *faults);
}

static void malformed_meshes_are_refused(void **state) {
    (void)state;
    static const char joints[] = "the joints are not unsigned integers of 8 or 16 bits";
    static const Fault faults[] = {
        {"5121", "5120", DIP_ERROR_FORMAT, "JOINTS_0", joints, BOTH, "5123"},
        {"'bufferView':1,'componentType':5121", "'componentType':5126", DIP_ERROR_FORMAT,
         "JOINTS_0", joints, BOTH, "'componentType':5121"},
        {"'bufferView':1,'componentType':5121", "'componentType':5125", DIP_ERROR_FORMAT,
         "JOINTS_0", joints, BOTH, "'componentType':5123"},
        {"5121", "5121,'normalized':true", DIP_ERROR_FORMAT, "JOINTS_0", joints, BOTH,
         "5121,'normalized':false"},
        {"5121,'type':'VEC4'", "5121,'type':'VEC3'", DIP_ERROR_FORMAT, "accessors",
         "the accessor of JOINTS_0 has another type", BOTH, NULL},
        {"'WEIGHTS_0':2", "'WEIGHTS_0':0", DIP_ERROR_FORMAT, "accessors",
         "the accessor of WEIGHTS_0 has another type", BOTH, NULL},
        {"'bufferView':2,'componentType':5126,'type':'VEC4','count':3",
         "'bufferView':2,'componentType':5126,'type':'VEC4','count':2", DIP_ERROR_RANGE,
         "WEIGHTS_0", "the attribute has 2 values, expected one for each of 3 vertices", BOTH,
         NULL},
        {"5125", "5126", DIP_ERROR_FORMAT, "indices", "the indices are not integers", BOTH, "5123"},
        {"'indices':4", "'indices':0", DIP_ERROR_FORMAT, "accessors",
         "the accessor of indices has another type", BOTH, NULL},
        {"'indices':4", "'indices':9", DIP_ERROR_RANGE, "accessors", "the file uses item 9 of 9",
         BOTH, NULL},
        {"'indices':4", "'indices':4,'mode':7", DIP_ERROR_RANGE, "mode",
         "a part of the mesh \"cloth\" has the mode 7, accepted 0..6", BOTH,
         "'indices':4,'mode':6"},
        {"'primitives':[{", "'primitives':[{'attributes':{'POSITION':0},'mode':1,'indices':-1},{",
         DIP_ERROR_RANGE, "indices", "this is not an integer", BOTH,
         "'primitives':[{'attributes':{'POSITION':0},'mode':1,'indices':4},{"},
        {"'primitives':[{", "'primitives':[{'attributes':{'POSITION':9},'mode':0},{",
         DIP_ERROR_RANGE, "accessors", "the file uses item 9 of 9", BOTH,
         "'primitives':[{'attributes':{'POSITION':0},'mode':0},{"},
        {"'WEIGHTS_0':2", "'COLOR_0':8", DIP_ERROR_FORMAT, "COLOR_0",
         "the colours have 2 channels, accepted 3 or 4", SCENE, "'COLOR_0':2"},
        {"'WEIGHTS_0':2", "'COLOR_0':3", DIP_ERROR_RANGE, "COLOR_0",
         "the attribute has 2 values, expected one for each of 3 vertices", SCENE, "'COLOR_0':5"},
        {"'WEIGHTS_0':2", "'TEXCOORD_0':0", DIP_ERROR_FORMAT, "accessors",
         "the accessor of TEXCOORD_0 has another type", BOTH, "'TEXCOORD_0':8"},
        {"'WEIGHTS_0':2", "'NORMAL':2", DIP_ERROR_FORMAT, "accessors",
         "the accessor of NORMAL has another type", BOTH, "'NORMAL':5"},
        {"{'bufferView':0,'componentType':5126", "{'bufferView':0,'componentType':5124",
         DIP_ERROR_FORMAT, "accessors", "the accessor of POSITION has another type", BOTH, NULL},
        {"'type':'VEC3','count':3", "'type':'VEC3','count':0", DIP_ERROR_FORMAT, "accessors",
         "the accessor of POSITION has another type, or no values", BOTH, NULL},
        {"'material':0", "'material':1", DIP_ERROR_RANGE, "materials", "the file uses item 1 of 1",
         BOTH, NULL},
        {"[{'name':'cloth'", "[5,{'name':'cloth'", DIP_ERROR_FORMAT, "meshes",
         "item 0 is not an object", BOTH, NULL},
        {"'primitives':[{", "'primitives':['x',{", DIP_ERROR_FORMAT, "primitives",
         "item 0 is not an object", BOTH, NULL},
    };
    check_faults(faults, sizeof faults / sizeof *faults);
}

// The list of a sparse accessor: how many values differ, which ones, and their new values.
static void malformed_sparse_accessors_are_refused(void **state) {
    (void)state;
#define SPARSE(count, component, indices, values)                                                  \
    "{'sparse':{'count':" count ",'indices':{'bufferView':" indices ",'componentType':" component  \
    "},'values':{'bufferView':" values "}},'bufferView':0"
    static const char from[] = "{'bufferView':0";
    static const char whole[] = SPARSE("3", "5125", "4", "5");
    static const char too_short[] = "the accessor of POSITION ends beyond its view of 24 bytes";
    static const Fault faults[] = {
        {from, SPARSE("4", "5125", "4", "5"), DIP_ERROR_FORMAT, "sparse",
         "the sparse accessor of POSITION lists 4 of 3 values", BOTH, whole},
        {from, SPARSE("0", "5125", "4", "5"), DIP_ERROR_FORMAT, "sparse",
         "the sparse accessor of POSITION lists 0 of 3 values", BOTH,
         SPARSE("1", "5125", "4", "5")},
        {from, SPARSE("1.5", "5125", "4", "5"), DIP_ERROR_RANGE, "count", "this is not an integer",
         BOTH, NULL},
        {from, SPARSE("3", "'5125'", "4", "5"), DIP_ERROR_RANGE, "componentType",
         "this is not an integer", BOTH, NULL},
        {from, SPARSE("3", "5126", "4", "5"), DIP_ERROR_FORMAT, "sparse",
         "or its indices are not unsigned integers", BOTH, SPARSE("3", "5123", "4", "5")},
        {from, SPARSE("3", "5120", "4", "5"), DIP_ERROR_FORMAT, "sparse",
         "or its indices are not unsigned integers", BOTH, SPARSE("3", "5121", "4", "5")},
        {from, SPARSE("3", "5125", "6", "5"), DIP_ERROR_RANGE, "accessors",
         "ends beyond its view of 8 bytes", BOTH, SPARSE("1", "5125", "6", "5")},
        {from, SPARSE("3", "5125", "4", "7"), DIP_ERROR_RANGE, "accessors", too_short, BOTH,
         SPARSE("2", "5125", "4", "7")},
        {from, SPARSE("3", "5125", "8", "5"), DIP_ERROR_RANGE, "bufferViews",
         "the file uses item 8 of 8", BOTH, NULL},
    };
    reset_binary();
    put_u32(TIMES_AT + 4, 2); // The times pass for the indices 0 and 2 where two are read.
    check(ANIMATED, write_changed(from, SPARSE("2", "5125", "6", "5")), "sparse", DIP_ERROR_NONE,
          "", "");
    put_u32(TIMES_AT + 4, 3);
    check(ANIMATED, write_changed(from, SPARSE("2", "5125", "6", "5")), "sparse", DIP_ERROR_RANGE,
          "sparse", "the sparse accessor of POSITION lists value 3 of 3");
    check_faults(faults, sizeof faults / sizeof *faults);
#undef SPARSE
}

static void malformed_morph_targets_are_refused(void **state) {
    (void)state;
    static const char part[] = "'targets':[{'POSITION':5}]}]";
    static const Fault faults[] = {
        {"[{'POSITION':5}]", "[{'POSITION':7}]", DIP_ERROR_RANGE, "POSITION",
         "the attribute has 2 values, expected one for each of 3 vertices", BOTH,
         "[{'POSITION':0}]"},
        {"[{'POSITION':5}]", "[{'NORMAL':7}]", DIP_ERROR_RANGE, "NORMAL",
         "the attribute has 2 values, expected one for each of 3 vertices", BOTH, "[{'NORMAL':0}]"},
        {"[{'POSITION':5}]", "[5]", DIP_ERROR_FORMAT, "targets", "item 0 is not an object", BOTH,
         "[{}]"},
        {"[{'POSITION':5}]", "5", DIP_ERROR_FORMAT, "targets", "this is not an array", BOTH, "[]"},
        {part, "'targets':[{'POSITION':5}]},{'attributes':{'POSITION':0},'targets':[{},{}]}]",
         DIP_ERROR_FORMAT, "targets", "the parts of a mesh have 1 and 2 morph targets", BOTH,
         "'targets':[{'POSITION':5}]},{'attributes':{'POSITION':0},'targets':[{}]}]"},
        {part, "'targets':[{'POSITION':5}]},{'attributes':{'POSITION':0}}]", DIP_ERROR_FORMAT,
         "targets", "the parts of a mesh have 1 and 0 morph targets", BOTH, NULL},
        {"'name':'cloth'", "'weights':[1,2]", DIP_ERROR_RANGE, "weights",
         "this is not an array of 1 finite numbers", BOTH, "'weights':[1]"},
        {"'name':'body'", "'weights':[]", DIP_ERROR_RANGE, "weights",
         "this is not an array of 1 finite numbers", BOTH, "'weights':[2]"},
    };
    check_faults(faults, sizeof faults / sizeof *faults);
}

static void malformed_materials_are_refused(void **state) {
    (void)state;
    static const char from[] = "'materials':[{'doubleSided':true}],";
#define MATERIAL(text, tables) "'materials':[{" text "}]," tables
#define COLOUR(text)           "'pbrMetallicRoughness':{'baseColorTexture':{" text "}}"
    static const Fault faults[] = {
        {from, MATERIAL("'pbrMetallicRoughness':{'baseColorFactor':[1,1,1]}", ""), DIP_ERROR_RANGE,
         "baseColorFactor", "array of 4 finite numbers", BOTH,
         MATERIAL("'pbrMetallicRoughness':{'baseColorFactor':[1,1,1,1]}", "")},
        {from, MATERIAL("'emissiveFactor':[1,1]", ""), DIP_ERROR_RANGE, "emissiveFactor",
         "array of 3 finite numbers", BOTH, MATERIAL("'emissiveFactor':[1,1,1]", "")},
        {from, MATERIAL(COLOUR("'index':0"), ""), DIP_ERROR_RANGE, "textures",
         "the file uses item 0 of 0", BOTH, MATERIAL(COLOUR("'index':0"), "'textures':[{}],")},
        {from, MATERIAL(COLOUR("'index':0,'texCoord':-1"), "'textures':[{}],"), DIP_ERROR_RANGE,
         "texCoord", "this is not an integer", BOTH, NULL},
        {from,
         MATERIAL(COLOUR("'index':0,'extensions':{'KHR_texture_transform':{'scale':[1]}}"),
                  "'textures':[{}],"),
         DIP_ERROR_RANGE, "scale", "array of 2 finite numbers", BOTH,
         MATERIAL(COLOUR("'index':0,'extensions':{'KHR_texture_transform':{'scale':[1,2]}}"),
                  "'textures':[{}],")},
        {from,
         MATERIAL(COLOUR("'index':0,'extensions':{'KHR_texture_transform':{'texCoord':1.5}}"),
                  "'textures':[{}],"),
         DIP_ERROR_RANGE, "texCoord", "this is not an integer", BOTH, NULL},
        {from, MATERIAL(COLOUR("'index':0"), "'textures':[{'source':-1}],"), DIP_ERROR_RANGE,
         "source", "this is not an integer", BOTH, NULL},
        {from, MATERIAL(COLOUR("'index':0"), "'textures':[{'source':0}],"), DIP_ERROR_RANGE,
         "images", "the file uses item 0 of 0", BOTH, NULL},
        {from,
         MATERIAL(COLOUR("'index':0"),
                  "'textures':[{'extensions':{'EXT_texture_webp':{'source':'a'}}}],"),
         DIP_ERROR_RANGE, "source", "this is not an integer", BOTH,
         MATERIAL(COLOUR("'index':0"), "'textures':[{'extensions':{'EXT_texture_webp':{}}}],")},
        {from, MATERIAL(COLOUR("'index':0"), "'textures':[{'sampler':0}],"), DIP_ERROR_RANGE,
         "samplers", "the file uses item 0 of 0", BOTH,
         MATERIAL(COLOUR("'index':0"), "'textures':[{'sampler':0}],'samplers':[{}],")},
        {from,
         MATERIAL(COLOUR("'index':0"), "'textures':[{'sampler':0}],'samplers':[{'wrapT':-1}],"),
         DIP_ERROR_RANGE, "wrapT", "this is not an integer", BOTH, NULL},
        {from,
         MATERIAL("'extensions':{'KHR_materials_pbrSpecularGlossiness':{'diffuseFactor':[1]}}", ""),
         DIP_ERROR_RANGE, "diffuseFactor", "array of 4 finite numbers", BOTH, NULL},
        {from,
         MATERIAL("'extensions':{'KHR_materials_pbrSpecularGlossiness':{'specularFactor':1}}", ""),
         DIP_ERROR_RANGE, "specularFactor", "array of 3 finite numbers", BOTH, NULL},
    };
#undef COLOUR
#undef MATERIAL
    check_faults(faults, sizeof faults / sizeof *faults);
}

// --- numbers in the buffer -----------------------------------------------------------------------

// Puts a float into the buffer, and expects the error from both readers.
static void check_float(size_t at, float value, DipErrorCode code, const char *key,
                        const char *reason) {
    reset_binary();
    put_float(at, value);
    check(BOTH, write_changed("'asset'", "'asset'"), key, code, key, reason);
}

static void numbers_that_cannot_be_used_are_refused(void **state) {
    (void)state;
    static const float bad[] = {NAN, INFINITY, -INFINITY};
    for (size_t i = 0; i < 3; ++i) {
        check_float(16, bad[i], DIP_ERROR_RANGE, "POSITION", "value 1 is not finite");
        check_float(TARGET_AT + 24, bad[i], DIP_ERROR_RANGE, "POSITION", "value 2 is not finite");
        check_float(WEIGHTS_AT, bad[i], DIP_ERROR_RANGE, "WEIGHTS_0", "value 0 is not finite");
        check_float(MATRICES_AT, bad[i], DIP_ERROR_RANGE, "inverseBindMatrices",
                    "matrix 0 is not finite");
        check_float(MATRICES_AT + 64 + 56, bad[i], DIP_ERROR_RANGE, "inverseBindMatrices",
                    "matrix 1 is not finite");
    }
    check_float(WEIGHTS_AT + 4, -1e-6f, DIP_ERROR_RANGE, "WEIGHTS_0", "a weight is negative");
    check_float(WEIGHTS_AT + 44, -1e-6f, DIP_ERROR_RANGE, "WEIGHTS_0", "a weight is negative");
    check_float(WEIGHTS_AT + 4, 1e-6f, DIP_ERROR_NONE, "", "");
    check_float(WEIGHTS_AT + 4, -0.0f, DIP_ERROR_NONE, "", "");
}

static void indices_and_joints_stay_within_their_lists(void **state) {
    (void)state;
    for (size_t corner = 0; corner < 3; ++corner) {
        for (uint32_t index = 2; index < 4; ++index) {
            reset_binary();
            put_u32(INDICES_AT + 4 * corner, index);
            check(BOTH, write_changed("'asset'", "'asset'"), "an index",
                  index < 3 ? DIP_ERROR_NONE : DIP_ERROR_RANGE, "indices",
                  "an index is 3, but there are 3 vertices");
        }
    }
    reset_binary();
    put_u32(INDICES_AT, UINT32_MAX); // Nothing restarts a primitive.
    check(BOTH, write_changed("'asset'", "'asset'"), "an index", DIP_ERROR_RANGE, "indices",
          "an index is 4294967295, but there are 3 vertices");
    for (uint8_t joint = 1; joint < 3; ++joint) {
        reset_binary();
        binary[JOINTS_AT + 8] = joint; // of the last vertex
        check(BOTH, write_changed("'asset'", "'asset'"), "a joint",
              joint < 2 ? DIP_ERROR_NONE : DIP_ERROR_RANGE, "JOINTS_0",
              "a vertex uses joint 2 of 2");
    }
    reset_binary();
    binary[JOINTS_AT + 1] = 200; // has the weight 0
    check(BOTH, write_changed("'asset'", "'asset'"), "a joint", DIP_ERROR_NONE, "", "");
    put_float(WEIGHTS_AT + 4, 0.5f);
    check(BOTH, write_changed("'asset'", "'asset'"), "a joint", DIP_ERROR_RANGE, "JOINTS_0",
          "a vertex uses joint 200 of 2");
}

// The times of keys ascend from 0 at the earliest. A scene whose animation cannot be read stands
// still, and a warning says why.
static void times_of_keys_ascend(void **state) {
    (void)state;
    static const struct {
        float times_s[2];
        int bad_key; // or -1
    } cases[] = {{{0.0f, 1.0f}, -1}, {{1.0f, 1.0f}, 1},      {{1.0f, 0.5f}, 1},
                 {{-0.5f, 1.0f}, 0}, {{0.5f, 0.50001f}, -1}, {{-0.0f, 1e-9f}, -1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        reset_binary();
        put_float(TIMES_AT, cases[i].times_s[0]);
        put_float(TIMES_AT + 4, cases[i].times_s[1]);
        const char *path = write_changed("'asset'", "'asset'");
        const bool ok = cases[i].bad_key < 0;
        char reason[100];
        snprintf(reason, sizeof reason, "the times of an animation do not ascend from 0 at key %d",
                 cases[i].bad_key);
        check(ANIMATED, path, "times", ok ? DIP_ERROR_NONE : DIP_ERROR_RANGE, "input", reason);
        DipErrorList warnings = {0};
        DipError err = {0};
        assert_true(read_with(SCENE, path, &warnings, &err));
        assert_int_equal(warnings.count, ok ? 0 : 1);
        if (!ok) {
            assert_string_equal(warnings.items[0].key, "input");
            assert_non_null(
                strstr(warnings.items[0].message, "the animation \"animation 0\" is not played: "));
            assert_non_null(strstr(warnings.items[0].message, reason));
        }
        dip_error_list_free(&warnings);
    }
}

// A pose may be beyond the floats although all numbers of the file are finite.
static void poses_beyond_the_floats_are_refused(void **state) {
    (void)state;
    reset_binary();
    put_float(12, 1e20f);
    put_float(MATRICES_AT, 1e18f); // 1e38 fits in a float
    const char *path = write_changed("'asset'", "'asset'");
    check(SCENE, path, "a pose", DIP_ERROR_NONE, "", "");
    put_float(MATRICES_AT, 1e20f);
    path = write_changed("'asset'", "'asset'");
    check(SCENE, path, "a pose", DIP_ERROR_RANGE, "cloth",
          "the position of vertex 1 in its pose is not finite");
}

// --- Draco ---------------------------------------------------------------------------------------

#ifdef DIP_HAS_DRACO

// Writes packed_draco.glb with `from` replaced by `to`, which must be as long.
static const char *write_packed(const char *from, const char *to) {
    size_t size_bytes = 0;
    uint8_t *bytes = fixture_read(fixture_data("gltf/packed_draco.glb"), &size_bytes);
    const size_t length = strlen(from);
    size_t at = 0;
    assert_int_equal(length, strlen(to));
    while (at + length < size_bytes && memcmp(bytes + at, from, length) != 0) {
        ++at;
    }
    assert_true(at + length < size_bytes);
    memcpy(bytes + at, to, length);
    fixture_write("packed.glb", bytes, size_bytes);
    free(bytes);
    return fixture_path("packed.glb");
}

// The file describes the content again that Draco has packed: 25 vertices whose attributes have the
// numbers 0 positions, 1 normals, 2 texture coordinates and 3 colours.
static void packed_meshes_are_as_the_file_describes_them(void **state) {
    (void)state;
    static const Fault faults[] = {
        {"\"POSITION\":0", "\"POSITION\":9", DIP_ERROR_FORMAT, "KHR_draco_mesh_compression",
         "the packed mesh \"mesh 0\" has no POSITION of this type", SCENE, "\"POSITION\":1"},
        {"\"NORMAL\":1", "\"NORMAL\":2", DIP_ERROR_FORMAT, "KHR_draco_mesh_compression",
         "the packed mesh \"mesh 0\" has no NORMAL of this type", SCENE, "\"NORMAL\":0"},
        {"\"COLOR_0\":3", "\"COLOR_0\":1", DIP_ERROR_FORMAT, "KHR_draco_mesh_compression",
         "the packed mesh \"mesh 0\" has no COLOR_0 of this type", SCENE, NULL},
        {"\"NORMAL\":1", "\"NORMAL\":x", DIP_ERROR_FORMAT, "", "the JSON is malformed", SCENE,
         NULL},
        {"\"count\":25,\"max\"", "\"count\":24,\"max\"", DIP_ERROR_FORMAT,
         "KHR_draco_mesh_compression", "the packed mesh \"mesh 0\" has 25 vertices, expected 24",
         SCENE, "\"count\":25,\"max\""},
        {"\"count\":25,\"max\"", "\"count\":26,\"max\"", DIP_ERROR_FORMAT,
         "KHR_draco_mesh_compression", "the packed mesh \"mesh 0\" has 25 vertices, expected 26",
         SCENE, NULL},
        {"\"bufferView\":1,", "\"bufferView\":0,", DIP_ERROR_FORMAT, "KHR_draco_mesh_compression",
         "the packed mesh \"mesh 0\" is malformed", SCENE, NULL},
        {"\"bufferView\":1,", "\"bufferView\":2,", DIP_ERROR_RANGE, "bufferViews",
         "the file uses item 2 of 2", SCENE, NULL},
        {"\"POSITION\":0", "\"POSITION\":0", DIP_ERROR_UNSUPPORTED, "meshes",
         "which animated models may not be", ANIMATED, NULL},
    };
    for (size_t i = 0; i < sizeof faults / sizeof *faults; ++i) {
        const Fault *f = &faults[i];
        check(f->readers, write_packed(f->from, f->to), f->to, f->code, f->key, f->reason);
        if (f->kept) {
            check(f->readers, write_packed(f->from, f->kept), f->kept, DIP_ERROR_NONE, "", "");
        }
    }
}

#endif

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(malformed_nodes_are_refused),
        cmocka_unit_test(malformed_skins_are_refused),
        cmocka_unit_test(malformed_meshes_are_refused),
        cmocka_unit_test(malformed_sparse_accessors_are_refused),
        cmocka_unit_test(malformed_morph_targets_are_refused),
        cmocka_unit_test(malformed_materials_are_refused),
        cmocka_unit_test(numbers_that_cannot_be_used_are_refused),
        cmocka_unit_test(indices_and_joints_stay_within_their_lists),
        cmocka_unit_test(times_of_keys_ascend),
        cmocka_unit_test(poses_beyond_the_floats_are_refused),
#ifdef DIP_HAS_DRACO
        cmocka_unit_test(packed_meshes_are_as_the_file_describes_them),
#endif
    };
    return cmocka_run_group_tests(tests, fixture_open, fixture_close);
}
