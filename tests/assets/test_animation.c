// Tests animated models. make_motion.py evaluates glTF files by the formulas of the specification;
// assimp reads the key frames of MD2 files one by one; closed forms say how key frames blend.
#include "assets/animation.h"
#include "assets/importer.h"
#include "tests/assets/fixture.h"

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/scene.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

static const char importer_word[] = "import";

static DipAnimatedModel *load(const char *path) {
    DipError err = {0};
    DipErrorList warnings = {0};
    DipAnimatedModel *model = dip_animated_model_load(path, NULL, &warnings, &err);
    if (!model || warnings.count > 0) {
        fail_msg("%s: %s", path, model ? warnings.items[0].message : err.message);
    }
    dip_error_list_free(&warnings);
    return model;
}

static DipAnimatedPose *pose_of(const DipAnimatedModel *model) {
    DipAnimatedPose *pose = dip_animated_pose_create(model, NULL);
    assert_non_null(pose);
    return pose;
}

static const char *gallery_path(const char *name) {
    static char path[FIXTURE_PATH];
    snprintf(path, sizeof path, "%s/gallery/%s", DIP_ASSETS_DIR, name);
    return path;
}

// --- glTF ----------------------------------------------------------------------------------------

// The vertices of one object at one time, placed in the world.
typedef struct Placed {
    float *positions;
    float *normals;
} Placed;

// Applies the rows of a 3x4 matrix. w: 1 for a position, 0 for a direction.
static void apply(const float m[12], float w, const float v[3], double to[3]) {
    for (int row = 0; row < 3; ++row) {
        const float *r = m + 4 * row;
        to[row] =
            (double)r[0] * v[0] + (double)r[1] * v[1] + (double)r[2] * v[2] + (double)r[3] * w;
    }
}

static Placed evaluate(const DipAnimatedModel *model, DipAnimatedPose *pose, int object) {
    const DipAnimatedDef *def = dip_animated_model_def(model);
    const size_t size_bytes =
        3 * sizeof(float) * def->meshes[def->objects[object].mesh].vertex_count;
    Placed placed = {malloc(size_bytes), malloc(size_bytes)};
    dip_animated_pose_vertices(pose, object, placed.positions, placed.normals);
    float *alone = malloc(size_bytes); // The positions are the same if no one asks for normals.
    assert_non_null(alone);
    dip_animated_pose_vertices(pose, object, alone, NULL);
    assert_memory_equal(alone, placed.positions, size_bytes);
    free(alone);
    return placed;
}

// Compares with each line of a file that make_motion.py has written.
static void check_against(const char *model_path, const char *expected_name) {
    DipAnimatedModel *model = load(model_path);
    DipAnimatedPose *pose = pose_of(model);
    FILE *file = fopen(fixture_data(expected_name), "r");
    double time_s;
    double e[6];
    int object;
    int vertex;
    int lines = 0;
    assert_non_null(file);
    while (fscanf(file, "%lf %d %d %lf %lf %lf %lf %lf %lf", &time_s, &object, &vertex, &e[0],
                  &e[1], &e[2], &e[3], &e[4], &e[5]) == 9) {
        dip_animated_pose_set(pose, 0, time_s);
        Placed placed = evaluate(model, pose, object);
        const float *transform = dip_animated_pose_object(pose, object)->transform;
        double p[3];
        double n[3];
        apply(transform, 1.0f, placed.positions + 3 * vertex, p);
        apply(transform, 0.0f, placed.normals + 3 * vertex, n);
        const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (int i = 0; i < 3; ++i) {
            if (fabs(p[i] - e[i]) > 1e-5 * (1 + fabs(e[i])) ||
                fabs(n[i] / length - e[3 + i]) > 1e-5) {
                fail_msg("%s at %g s, object %d, vertex %d, axis %d: position %.9g, expected %.9g; "
                         "normal %.9g, expected %.9g",
                         expected_name, time_s, object, vertex, i, p[i], e[i], n[i] / length,
                         e[3 + i]);
            }
        }
        free(placed.positions);
        free(placed.normals);
        ++lines;
    }
    assert_true(lines > 100);
    fclose(file);
    dip_animated_pose_destroy(&pose);
    dip_animated_model_destroy(&model);
}

// Vertices 0 and 1 belong to two triangles with the cross products (0, -4, 4) and (0, 0, 8), vertex
// 2 to the first one alone, and vertex 3 to the second one.
static void missing_normals_are_means_weighted_by_area(void **state) {
    (void)state;
    const double both = sqrt(1.0 / 10.0), half = sqrt(0.5);
    const double expected[4][3] = {
        {0.0, -both, 3.0 * both}, {0.0, -both, 3.0 * both}, {0.0, -half, half}, {0.0, 0.0, 1.0}};
    DipAnimatedModel *model =
        dip_animated_model_load(fixture_data("gltf/ridge.gltf"), NULL, NULL, NULL);
    const DipAnimatedMesh *mesh = dip_animated_model_def(model)->meshes;
    assert_int_equal(mesh->vertex_count, 4);
    for (int i = 0; i < 12; ++i) {
        assert_float_equal(mesh->normals[i], expected[i / 3][i % 3], 1e-6);
    }
    dip_animated_model_destroy(&model);
}

static void gltf_moves_as_the_specification_says(void **state) {
    (void)state;
    check_against(fixture_data("motion.gltf"), "motion.txt");
    check_against(gallery_path("pump.glb"), "pump.txt");
}

static void gltf_has_its_materials_and_names(void **state) {
    (void)state;
    DipAnimatedModel *model = load(fixture_data("motion.gltf"));
    const DipAnimatedDef *def = dip_animated_model_def(model);
    assert_int_equal(def->animation_count, 2);
    assert_string_equal(def->animations[0].name, "all");
    assert_float_equal(def->animations[0].duration_s, 2.0, 0.0);
    assert_float_equal(def->animations[1].duration_s, 0.0, 0.0);
    assert_int_equal(dip_animated_model_find(model, "still"), 1);
    assert_int_equal(dip_animated_model_find(model, "none"), -1);
    assert_int_equal(def->object_count, 5); // "not shown" is in no scene.
    assert_int_equal(def->key_frame_count, 0);
    assert_string_equal(def->objects[2].name, "morphed");
    assert_int_equal(def->objects[3].joint_count, 0);
    assert_int_equal(def->objects[4].joint_count, 3);
    assert_int_equal(def->meshes[def->objects[2].mesh].shape_count, 3);
    const DipAnimatedMesh *mesh = &def->meshes[def->objects[0].mesh];
    const DipMaterialDef *material = &def->materials[mesh->material];
    assert_string_equal(material->name, "checked");
    assert_int_equal(material->surface, DIP_SURFACE_CLIPPED);
    assert_float_equal(material->alpha_cutoff, 0.25, 0.0);
    assert_float_equal(material->base_colour_lin[1], 0.25, 0.0);
    assert_float_equal(material->roughness, 0.5, 0.0);
    assert_false(material->double_sided);
    const DipTextureDef *texture = &def->textures[material->colour_texture];
    assert_int_equal(texture->width, 2);
    assert_int_equal(texture->rgba8[4 * 2 + 2], 255);
    assert_int_equal(texture->wrap_u, DIP_WRAP_CLAMP);
    assert_int_equal(texture->wrap_v, DIP_WRAP_REPEAT);
    assert_float_equal(mesh->uv0[2 * 2], 1.0, 0.0);
    assert_float_equal(mesh->uv0[2 * 3], 0.0, 0.0);
    assert_true(def->materials[def->meshes[def->objects[4].mesh].material].double_sided);
    dip_animated_model_destroy(&model);
}

// With STEP, the value of a key holds up to the next key, which assimp forgets.
static void step_holds_its_value(void **state) {
    (void)state;
    DipAnimatedModel *model = load(fixture_data("motion.gltf"));
    DipAnimatedPose *pose = pose_of(model);
    float before[12];
    float after[12];
    dip_animated_pose_set(pose, 0, 0.5);
    memcpy(before, dip_animated_pose_object(pose, 0)->transform, sizeof before);
    dip_animated_pose_set(pose, 0, 0.999);
    assert_memory_equal(before, dip_animated_pose_object(pose, 0)->transform, sizeof before);
    dip_animated_pose_set(pose, 0, 1.0);
    memcpy(after, dip_animated_pose_object(pose, 0)->transform, sizeof after);
    assert_true(memcmp(before, after, sizeof before) != 0);
    dip_animated_pose_destroy(&pose);
    dip_animated_model_destroy(&model);
}

static void a_model_without_animations_rests(void **state) {
    (void)state;
    static const float identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    fixture_copy("square.gltf");
    fixture_write("red.png", fixture_png, sizeof fixture_png);
    DipAnimatedModel *model =
        dip_animated_model_load(fixture_path("square.gltf"), NULL, NULL, NULL);
    assert_non_null(model);
    DipAnimatedPose *pose = pose_of(model);
    assert_int_equal(dip_animated_model_def(model)->animation_count, 0);
    dip_animated_pose_set(pose, 17, 3.0);
    assert_memory_equal(dip_animated_pose_object(pose, 0)->transform, identity, sizeof identity);
    assert_float_equal(dip_animated_pose_object(pose, 0)->weights[0], 1.0, 0.0);
    dip_animated_pose_destroy(&pose);
    dip_animated_model_destroy(&model);
}

// --- MD2 -----------------------------------------------------------------------------------------

static const struct aiScene *import_frame(const char *path, int frame) {
    struct aiPropertyStore *properties = aiCreatePropertyStore();
    aiSetImportPropertyInteger(properties, AI_CONFIG_IMPORT_MD2_KEYFRAME, frame);
    const struct aiScene *scene = aiImportFileExWithProperties(path, 0, NULL, properties);
    aiReleasePropertyStore(properties);
    return scene;
}

static void check_vector(const float *ours, struct aiVector3D theirs, const struct aiMatrix4x4 *m,
                         float w, double tolerance) {
    const double expected[3] = {m->a1 * theirs.x + m->a2 * theirs.y + m->a3 * theirs.z + m->a4 * w,
                                m->b1 * theirs.x + m->b2 * theirs.y + m->b3 * theirs.z + m->b4 * w,
                                m->c1 * theirs.x + m->c2 * theirs.y + m->c3 * theirs.z + m->c4 * w};
    for (int i = 0; i < 3; ++i) {
        assert_true(fabs(ours[i] - expected[i]) <= tolerance);
    }
}

// assimp gives each corner of each triangle a vertex, in the order of the file.
static void check_frame(const DipAnimatedMesh *mesh, int frame, const struct aiScene *scene) {
    static const unsigned places[3] = {0, 2, 1};
    const struct aiMesh *theirs = scene->mMeshes[0];
    const struct aiMatrix4x4 *root = &scene->mRootNode->mTransformation;
    assert_int_equal(theirs->mNumFaces * 3, mesh->index_count);
    for (unsigned corner = 0; corner < mesh->index_count; ++corner) {
        const uint32_t vertex = mesh->indices[corner - corner % 3 + places[corner % 3]];
        const size_t row = 3 * ((size_t)frame * mesh->vertex_count + vertex);
        check_vector(mesh->positions + row, theirs->mVertices[corner], root, 1.0f, 1e-4);
        check_vector(mesh->normals + row, theirs->mNormals[corner], root, 0.0f, 2e-6);
        const struct aiVector3D uv = theirs->mTextureCoords[0][corner];
        assert_float_equal(mesh->uv0[2 * vertex], uv.x, 1e-6);
        assert_float_equal(mesh->uv0[2 * vertex + 1], 1 - uv.y, 1e-6);
    }
}

static void md2_frames_are_those_that_assimp_reads(void **state) {
    (void)state;
    DipAnimatedModel *model = load(gallery_path("crab.md2"));
    const DipAnimatedDef *def = dip_animated_model_def(model);
    for (int frame = 0; frame < def->key_frame_count; ++frame) {
        const struct aiScene *scene = import_frame(gallery_path("crab.md2"), frame);
        assert_non_null(scene);
        check_frame(&def->meshes[0], frame, scene);
        aiReleaseImport(scene);
    }
    dip_animated_model_destroy(&model);
}

// A file with all 162 normals, made from the numbers that MD2 gives them.
static void every_md2_normal_is_that_of_assimp(void **state) {
    (void)state;
    enum { POINTS = 162, TRIANGLES = 54, FRAME = 40 + 4 * POINTS };
    enum { COORDINATES_AT = 68, TRIANGLES_AT = 72, FRAMES_AT = TRIANGLES_AT + 12 * TRIANGLES };
    const int32_t header[17] = {0x32504449,
                                8,
                                1,
                                1,
                                FRAME,
                                0,
                                POINTS,
                                1,
                                TRIANGLES,
                                1,
                                1,
                                68,
                                COORDINATES_AT,
                                TRIANGLES_AT,
                                FRAMES_AT,
                                FRAMES_AT + FRAME,
                                FRAMES_AT + FRAME + 4};
    uint8_t file[FRAMES_AT + FRAME + 4] = {0}; // with an empty list of commands
    memcpy(file, header, sizeof header);
    for (uint16_t i = 0; i < POINTS; ++i) {
        memcpy(file + TRIANGLES_AT + 12 * (i / 3) + 2 * (i % 3), &i, 2);
        file[FRAMES_AT + 40 + 4 * i + 3] = (uint8_t)i;
    }
    fixture_write("normals.md2", file, sizeof file);
    DipAnimatedModel *model = load(fixture_path("normals.md2"));
    const struct aiScene *scene = import_frame(fixture_path("normals.md2"), 0);
    assert_non_null(scene);
    check_frame(&dip_animated_model_def(model)->meshes[0], 0, scene);
    aiReleaseImport(scene);
    dip_animated_model_destroy(&model);
}

static void key_frames_form_animations(void **state) {
    (void)state;
    static const struct {
        const char *name;
        int frames;
    } expected[] = {{"stand", 10}, {"walk", 12}, {"wave", 12}};
    DipAnimatedModel *model = load(gallery_path("crab.md2"));
    const DipAnimatedDef *def = dip_animated_model_def(model);
    int frame = 0;
    assert_int_equal(def->animation_count, 3);
    for (int a = 0; a < 3; ++a) {
        assert_string_equal(def->animations[a].name, expected[a].name);
        assert_float_equal(def->animations[a].duration_s, expected[a].frames / 10.0, 1e-12);
        for (int i = 0; i < expected[a].frames; ++i, ++frame) {
            char name[16];
            snprintf(name, sizeof name, "%s%d", expected[a].name, i + 1);
            assert_string_equal(def->key_frames[frame].name, name);
            assert_int_equal(def->key_frames[frame].animation, a);
            assert_float_equal(def->key_frames[frame].time_s, i / 10.0, 1e-12);
        }
    }
    assert_int_equal(frame, def->key_frame_count);
    assert_int_equal(frame, def->meshes[0].shape_count);
    assert_int_equal(def->textures[def->materials[0].colour_texture].width, 128);
    dip_animated_model_destroy(&model);
}

// Checks the key frames and the weight at a time of an animation with `count` frames from `first`.
static void check_blend(const DipAnimatedModel *model, DipAnimatedPose *pose, int animation,
                        int first, int count, double time_s) {
    const DipAnimatedMesh *mesh = &dip_animated_model_def(model)->meshes[0];
    dip_animated_pose_set(pose, animation, time_s);
    const DipObjectPose *object = dip_animated_pose_object(pose, 0);
    const double frames = fmod(fmod(10 * time_s, count) + count, count);
    const double found = object->key_frame - first + (double)object->blend;
    const double apart = fabs(found - frames);
    assert_true(fmin(apart, count - apart) < 1e-5);
    assert_true(object->blend >= 0.0f && object->blend < 1.0f);
    assert_int_equal(object->next_key_frame - first, (object->key_frame - first + 1) % count);
    float sum = 0.0f;
    for (int s = 0; s < mesh->shape_count; ++s) {
        sum += object->weights[s];
        if (s != object->key_frame && s != object->next_key_frame) {
            assert_true(object->weights[s] == 0.0f);
        }
    }
    assert_float_equal(sum, 1.0, 1e-6);
    const Placed placed = evaluate(model, pose, 0);
    const float *a = mesh->positions + 3 * (size_t)object->key_frame * mesh->vertex_count;
    const float *b = mesh->positions + 3 * (size_t)object->next_key_frame * mesh->vertex_count;
    for (uint32_t i = 0; i < 3 * mesh->vertex_count; ++i) {
        const double expected = a[i] + (double)object->blend * ((double)b[i] - a[i]);
        assert_true(fabs(placed.positions[i] - expected) < 1e-5);
    }
    for (uint32_t i = 0; i < mesh->vertex_count; ++i) {
        const float *n = placed.normals + 3 * (size_t)i;
        assert_float_equal(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1.0, 1e-5);
    }
    free(placed.positions);
    free(placed.normals);
}

// The shortest animation that moves: each of its two frames follows the other.
static void two_key_frames_blend_into_each_other(void **state) {
    (void)state;
    enum { FRAME = 40 + 4 * 3, FRAMES_AT = 68 + 4 + 12, END = FRAMES_AT + 2 * FRAME + 4 };
    static const int32_t header[17] = {0x32504449, 8, 1,  1,  FRAME, 0,         3,       1,  1,
                                       1,          2, 68, 68, 72,    FRAMES_AT, END - 4, END};
    static const uint16_t triangle[3] = {0, 1, 2};
    static const float scale[3] = {1.0f, 0.5f, 0.25f};
    static const uint8_t points[2][12] = {{0, 0, 0, 0, 8, 0, 0, 0, 0, 8, 0, 0},
                                          {0, 0, 40, 1, 8, 16, 0, 2, 80, 8, 0, 3}};
    uint8_t file[END] = {0}; // with an empty list of commands
    memcpy(file, header, sizeof header);
    memcpy(file + 72, triangle, sizeof triangle);
    for (int i = 0; i < 2; ++i) {
        uint8_t *frame = file + FRAMES_AT + FRAME * i;
        memcpy(frame, scale, sizeof scale);
        memcpy(frame + 24, i ? "walk2" : "walk1", 6);
        memcpy(frame + 40, points[i], sizeof points[i]);
    }
    fixture_write("two.md2", file, sizeof file);
    DipAnimatedModel *model = load(fixture_path("two.md2"));
    DipAnimatedPose *pose = pose_of(model);
    assert_int_equal(dip_animated_model_def(model)->animation_count, 1);
    for (int i = -5; i < 50; ++i) {
        check_blend(model, pose, 0, 0, 2, 0.0173 * i);
    }
    dip_animated_pose_destroy(&pose);
    dip_animated_model_destroy(&model);
}

static void key_frames_blend_and_repeat(void **state) {
    (void)state;
    static const double times_s[] = {0,   0.05, 0.1,  0.3333, 0.85,  0.95,   0.99999,
                                     1.0, 1.15, 1.25, 12.34,  -0.05, -1e-18, 123456.78};
    DipAnimatedModel *model = load(gallery_path("crab.md2"));
    DipAnimatedPose *pose = pose_of(model);
    for (size_t i = 0; i < sizeof times_s / sizeof *times_s; ++i) {
        check_blend(model, pose, 0, 0, 10, times_s[i]);
        check_blend(model, pose, 1, 10, 12, times_s[i]);
    }
    for (int i = 0; i < 4000; ++i) {
        const double time_s = i * 0.0009973;
        dip_animated_pose_set(pose, 2, time_s);
        const DipObjectPose *object = dip_animated_pose_object(pose, 0);
        assert_in_range(object->key_frame, 22, 33);
        assert_true(object->blend >= 0.0f && object->blend < 1.0f);
    }
    dip_animated_pose_set(pose, 2, NAN);
    assert_int_equal(dip_animated_pose_object(pose, 0)->key_frame, 22);
    dip_animated_pose_set(pose, 2, 1e300);
    assert_in_range(dip_animated_pose_object(pose, 0)->key_frame, 22, 33);
    dip_animated_pose_destroy(&pose);
    dip_animated_model_destroy(&model);
}

// --- bits ----------------------------------------------------------------------------------------

static uint64_t hash_of(const char *path) {
    DipAnimatedModel *model = load(path);
    DipAnimatedPose *pose = pose_of(model);
    const DipAnimatedDef *def = dip_animated_model_def(model);
    uint64_t hash = 14695981039346656037u; // FNV-1a
    for (int i = 0; i < 60; ++i) {
        dip_animated_pose_set(pose, i % def->animation_count, i * 0.0731);
        for (int object = 0; object < def->object_count; ++object) {
            const Placed placed = evaluate(model, pose, object);
            const size_t count = 3 * (size_t)def->meshes[def->objects[object].mesh].vertex_count;
            const uint8_t *bytes[3] = {
                (uint8_t *)placed.positions, (uint8_t *)placed.normals,
                (uint8_t *)dip_animated_pose_object(pose, object)->transform};
            const size_t sizes[3] = {4 * count, 4 * count, 48};
            for (int k = 0; k < 3; ++k) {
                for (size_t b = 0; b < sizes[k]; ++b) {
                    hash = (hash ^ bytes[k][b]) * 1099511628211u;
                }
            }
            free(placed.positions);
            free(placed.normals);
        }
    }
    dip_animated_pose_destroy(&pose);
    dip_animated_model_destroy(&model);
    return hash;
}

static void poses_have_the_same_bits_everywhere(void **state) {
    (void)state;
    const uint64_t found[3] = {hash_of(gallery_path("crab.md2")), hash_of(gallery_path("pump.glb")),
                               hash_of(fixture_data("motion.gltf"))};
    static const uint64_t expected[3] = {0x4be67ea9d7decfafu, 0x776551bf8b51e976u,
                                         0x6ca43002f0954fddu};
    for (int i = 0; i < 3; ++i) {
        if (found[i] != expected[i]) {
            fail_msg("hash %d is 0x%016llx", i, (unsigned long long)found[i]);
        }
    }
}

// --- malformed files -----------------------------------------------------------------------------

static void assert_refused(const char *path, DipErrorCode code, const char *reason) {
    DipError err = {0};
    DipAnimatedModel *model = dip_animated_model_load(path, NULL, NULL, &err);
    if (model || err.code != code || !strstr(err.message, reason)) {
        fail_msg("%s: %s, code %s, message \"%s\"", path, model ? "accepted" : "refused",
                 dip_error_code_name(err.code), err.message);
    }
    assert_non_null(strstr(err.file, strrchr(path, '/') + 1));
    assert_null(strchr(err.message, '\n'));
}

typedef struct Fault {
    size_t offset;
    int32_t value; // Replaces the 4 bytes at the offset.
    DipErrorCode code;
    const char *reason;
} Fault;

static void malformed_md2_files_are_refused(void **state) {
    (void)state;
    static const Fault faults[] = {
        {0, 0, DIP_ERROR_FORMAT, "does not begin like an MD2 file"},
        {4, 15, DIP_ERROR_FORMAT, "version 8"},
        {8, 0, DIP_ERROR_RANGE, "0 texels along a side"},
        {12, -4, DIP_ERROR_RANGE, "-4 texels along a side"},
        {16, 39, DIP_ERROR_RANGE, "39 bytes in a frame"},
        {20, -1, DIP_ERROR_RANGE, "-1 skins"},
        {20, 1 << 30, DIP_ERROR_TRUNCATED, "too short for 1073741824 skins"},
        {24, 0, DIP_ERROR_RANGE, "0 points"},
        {24, INT32_MAX, DIP_ERROR_RANGE, "bytes in a frame"},
        {24, 3, DIP_ERROR_RANGE, "of 3 and texture coordinates"},
        {28, -1, DIP_ERROR_RANGE, "-1 texture coordinates"},
        {28, 2, DIP_ERROR_RANGE, "of 2"},
        {32, 0, DIP_ERROR_MISSING, "0 triangles"},
        {32, INT32_MAX, DIP_ERROR_TRUNCATED, "triangles"},
        {40, 0, DIP_ERROR_MISSING, "0 frames"},
        {40, 100000, DIP_ERROR_TRUNCATED, "100000 frames"},
        {44, INT32_MAX, DIP_ERROR_TRUNCATED, "skins at byte 2147483647"},
        {48, 0, DIP_ERROR_TRUNCATED, "texture coordinates at byte 0"},
        {52, -8, DIP_ERROR_TRUNCATED, "triangles at byte -8"},
        {56, INT32_MIN, DIP_ERROR_TRUNCATED, "frames at byte -2147483648"},
    };
    size_t size_bytes = 0;
    uint8_t *bytes = fixture_read(gallery_path("crab.md2"), &size_bytes);
    for (size_t i = 0; i < sizeof faults / sizeof *faults; ++i) {
        uint8_t before[4];
        memcpy(before, bytes + faults[i].offset, 4);
        memcpy(bytes + faults[i].offset, &faults[i].value, 4);
        fixture_write("fault.md2", bytes, size_bytes);
        assert_refused(fixture_path("fault.md2"), faults[i].code, faults[i].reason);
        memcpy(bytes + faults[i].offset, before, 4);
    }
    int32_t frames_at;
    memcpy(&frames_at, bytes + 56, 4);
    bytes[frames_at + 40 + 3] = 162;
    fixture_write("normal.md2", bytes, size_bytes);
    assert_refused(fixture_path("normal.md2"), DIP_ERROR_RANGE, "162 as the number of a normal");
    bytes[frames_at + 40 + 3] = 0;
    memset(bytes + frames_at, 0xff, 4); // a scale that is not a number
    fixture_write("scale.md2", bytes, size_bytes);
    assert_refused(fixture_path("scale.md2"), DIP_ERROR_RANGE, "not finite");
    free(bytes);
}

// The last point and the last texture coordinates may be used, those after them may not.
static void md2_triangles_use_what_is_there(void **state) {
    (void)state;
    size_t size_bytes = 0;
    uint8_t *bytes = fixture_read(gallery_path("crab.md2"), &size_bytes);
    int32_t counts[2], triangles_at;
    memcpy(counts, bytes + 24, sizeof counts); // of points and of texture coordinates
    memcpy(&triangles_at, bytes + 52, sizeof triangles_at);
    for (int index = 0; index < 6; ++index) {
        uint16_t used = (uint16_t)counts[index / 3];
        uint8_t *at = bytes + triangles_at + 2 * index, before[2];
        memcpy(before, at, 2);
        memcpy(at, &used, 2);
        fixture_write("index.md2", bytes, size_bytes);
        assert_refused(fixture_path("index.md2"), DIP_ERROR_RANGE, "triangle 0 uses");
        used--;
        memcpy(at, &used, 2);
        fixture_write("index.md2", bytes, size_bytes);
        DipAnimatedModel *model =
            dip_animated_model_load(fixture_path("index.md2"), NULL, NULL, NULL);
        assert_non_null(model);
        dip_animated_model_destroy(&model);
        memcpy(at, before, 2);
    }
    free(bytes);
}

static void every_cut_is_refused(void **state) {
    (void)state;
    static const size_t md2_header_bytes = 68;
    static const char *const names[] = {"crab.md2", "pump.glb"};
    for (size_t f = 0; f < 2; ++f) {
        size_t size_bytes = 0;
        uint8_t *bytes = fixture_read(gallery_path(names[f]), &size_bytes);
        size_bytes -= f == 0 ? 4 : 0; // Nothing reads the list of commands at the end of the MD2.
        for (size_t cut = 0; cut < size_bytes; cut += cut < 300 ? 1 : size_bytes / 61) {
            char name[32];
            snprintf(name, sizeof name, "cut_%s", names[f]);
            fixture_write(name, bytes, cut);
            DipError err = {0};
            DipAnimatedModel *model = dip_animated_model_load(fixture_path(name), NULL, NULL, &err);
            if (model) {
                fail_msg("%s: accepted with %zu of %zu bytes", names[f], cut, size_bytes);
            }
            assert_true(err.code != DIP_ERROR_NONE && err.message[0]);
            if (f == 0 && cut > 0 && cut < md2_header_bytes) {
                assert_int_equal(err.code, DIP_ERROR_TRUNCATED);
                assert_string_equal(err.message, "the model file ends too early");
            }
        }
        free(bytes);
    }
}

typedef struct BadFile {
    const char *name;
    DipErrorCode code;
    const char *reason;
} BadFile;

static void malformed_gltf_files_are_refused(void **state) {
    (void)state;
    static const BadFile files[] = {
        {"no_such.gltf", DIP_ERROR_MISSING, ""},
        {"bad_format.txt", DIP_ERROR_FORMAT, "accepted .md2, .gltf and .glb"},
        {"bad_text.gltf", DIP_ERROR_FORMAT, "malformed at byte"},
        {"bad_json.gltf", DIP_ERROR_TRUNCATED, "ends too early"},
        {"bad_array.gltf", DIP_ERROR_FORMAT, ""},
        {"bad_types.gltf", DIP_ERROR_FORMAT, ""},
        {"bad_version.gltf", DIP_ERROR_FORMAT, "version 2"},
        {"bad_index.gltf", DIP_ERROR_RANGE, "vertices"},
        {"bad_index_type.gltf", DIP_ERROR_RANGE, ""},
        {"bad_nan.gltf", DIP_ERROR_RANGE, "not finite"},
        {"bad_infinite.gltf", DIP_ERROR_RANGE, "not finite"},
        {"bad_accessor_count.gltf", DIP_ERROR_RANGE, "beyond its view"},
        {"bad_accessor_huge.gltf", DIP_ERROR_RANGE, ""},
        {"bad_accessor_index.gltf", DIP_ERROR_RANGE, "item"},
        {"bad_component_type.gltf", DIP_ERROR_FORMAT, "another type"},
        {"bad_view_index.gltf", DIP_ERROR_RANGE, "item"},
        {"bad_view_length.gltf", DIP_ERROR_RANGE, "beyond its buffer"},
        {"bad_view_offset.gltf", DIP_ERROR_RANGE, "beyond its buffer"},
        {"bad_buffer_index.gltf", DIP_ERROR_RANGE, "item"},
        {"bad_buffer_length.gltf", DIP_ERROR_RANGE, "not an integer"},
        {"bad_mesh_index.gltf", DIP_ERROR_RANGE, "item"},
        {"bad_material_index.gltf", DIP_ERROR_RANGE, "item"},
        {"bad_texture_index.gltf", DIP_ERROR_RANGE, "item"},
        {"bad_image_index.gltf", DIP_ERROR_RANGE, "item"},
        {"bad_child_index.gltf", DIP_ERROR_RANGE, "child"},
        {"bad_scene_node.gltf", DIP_ERROR_RANGE, "node that does not exist"},
        {"bad_scene_index.gltf", DIP_ERROR_RANGE, "item"},
        {"bad_node_cycle.gltf", DIP_ERROR_FORMAT, "own ancestor"},
        {"bad_node_itself.gltf", DIP_ERROR_FORMAT, "own ancestor"},
        {"bad_draco.gltf", DIP_ERROR_UNSUPPORTED, "KHR_draco_mesh_compression"},
        {"bad_no_mesh.gltf", DIP_ERROR_MISSING, "no triangles"},
        {"bad_no_primitives.gltf", DIP_ERROR_MISSING, "no triangles"},
        {"bad_no_positions.gltf", DIP_ERROR_FORMAT, "no positions"},
        {"bad_uv_count.gltf", DIP_ERROR_RANGE, "one for each of"},
        {"bad_stride.gltf", DIP_ERROR_RANGE, ""},
        {"bad_accessor_type.gltf", DIP_ERROR_FORMAT, "another type"},
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
        assert_refused(fixture_data(files[i].name), files[i].code, files[i].reason);
    }
}

// Replaces the first `from` in motion.gltf by `to`, and expects the error.
static void expect_fault(const char *from, const char *to, DipErrorCode code, const char *reason) {
    size_t size_bytes = 0;
    uint8_t *bytes = fixture_read(fixture_data("motion.gltf"), &size_bytes);
    bytes[size_bytes] = '\0';
    char *text = (char *)bytes;
    char *at = strstr(text, from);
    assert_non_null(at);
    const size_t room = size_bytes + strlen(to) + 1;
    char *changed = malloc(room);
    snprintf(changed, room, "%.*s%s%s", (int)(at - text), text, to, at + strlen(from));
    fixture_write_text("fault.gltf", changed);
    assert_refused(fixture_path("fault.gltf"), code, reason);
    free(changed);
    free(bytes);
}

static void malformed_animations_are_refused(void **state) {
    (void)state;
    expect_fault("\"STEP\"", "\"JUMP\"", DIP_ERROR_UNKNOWN, "accepted STEP, LINEAR");
    expect_fault("\"STEP\"", "\"CUBICSPLINE\"", DIP_ERROR_RANGE, "3 values for 3 keys, expected 9");
    expect_fault("\"sampler\": 0,\n     \"target\"", "\"sampler\": 99,\n     \"target\"",
                 DIP_ERROR_RANGE, "item 99");
    expect_fault("\"path\": \"translation\"", "\"path\": \"rotation\"", DIP_ERROR_FORMAT,
                 "another type");
    expect_fault("\"node\": 4,", "\"node\": 0,", DIP_ERROR_FORMAT, "has a matrix");
    expect_fault("\"node\": 4,", "\"node\": 40,", DIP_ERROR_RANGE, "item 40");
    expect_fault("\"joints\": [\n    6,", "\"joints\": [\n    60,", DIP_ERROR_RANGE,
                 "joint 0 is not a node");
    expect_fault("\"joints\": [\n    6,\n    7,\n    8\n", "\"joints\": [\n    6\n",
                 DIP_ERROR_RANGE, "joint 2 of 1");
    expect_fault("\"skin\": 0", "\"skin\": 1", DIP_ERROR_RANGE, "skin 1 of 1");
    expect_fault("\"weights\": [\n    0.25,", "\"weights\": [\n    0, 0.25,", DIP_ERROR_RANGE,
                 "array of 2 finite numbers");
    expect_fault("\"normalized\": true", "\"sparse\": {}", DIP_ERROR_FORMAT,
                 "sparse accessor of TEXCOORD_0 lists 0 of 4 values");
}

// --- pictures ------------------------------------------------------------------------------------

static void pictures_can_be_read_in_the_importer(void **state) {
    (void)state;
    const DipImporter importer = {.program = "/proc/self/exe", .command = importer_word};
    DipError err = {0};
    DipAnimatedModel *here = load(gallery_path("crab.md2"));
    DipAnimatedModel *there =
        dip_animated_model_load(gallery_path("crab.md2"), &importer, NULL, &err);
    assert_non_null(there);
    const DipTextureDef *a = dip_animated_model_def(here)->textures;
    const DipTextureDef *b = dip_animated_model_def(there)->textures;
    assert_memory_equal(a->rgba8, b->rgba8, 4 * 128 * 128);
    dip_animated_model_destroy(&here);
    dip_animated_model_destroy(&there);
}

static void shapes_are_read_without_pictures(void **state) {
    (void)state;
    for (int f = 0; f < 2; ++f) {
        const char *file = gallery_path(f > 0 ? "pump.glb" : "crab.md2");
        DipErrorList warnings = {0};
        DipAnimatedModel *whole = load(file);
        DipAnimatedModel *shapes = dip_animated_model_load_shapes(file, &warnings, NULL);
        assert_non_null(shapes);
        const DipAnimatedDef *a = dip_animated_model_def(whole);
        const DipAnimatedDef *b = dip_animated_model_def(shapes);
        assert_true(f > 0 || a->texture_count > 0); // The skin of the crab.
        assert_true(b->texture_count == 0 && warnings.count == 0);
        assert_int_equal(a->material_count, b->material_count);
        for (int i = 0; i < b->material_count; ++i) {
            assert_int_equal(b->materials[i].colour_texture, DIP_NO_TEXTURE);
        }
        assert_int_equal(a->animation_count, b->animation_count);
        assert_int_equal(a->mesh_count, b->mesh_count);
        for (int i = 0; i < b->mesh_count; ++i) {
            const DipAnimatedMesh *x = &a->meshes[i], *y = &b->meshes[i];
            assert_int_equal(x->vertex_count, y->vertex_count);
            assert_memory_equal(x->positions, y->positions, 12 * (size_t)x->vertex_count);
        }
        dip_animated_model_destroy(&whole);
        dip_animated_model_destroy(&shapes);
    }
}

static void a_missing_skin_gives_a_warning(void **state) {
    (void)state;
    size_t size_bytes = 0;
    uint8_t *bytes = fixture_read(gallery_path("crab.md2"), &size_bytes);
    fixture_write("bare.md2", bytes, size_bytes);
    DipErrorList warnings = {0};
    DipAnimatedModel *model =
        dip_animated_model_load(fixture_path("bare.md2"), NULL, &warnings, NULL);
    assert_non_null(model);
    assert_int_equal(warnings.count, 1);
    assert_non_null(strstr(warnings.items[0].message, "crab.pcx"));
    assert_int_equal(dip_animated_model_def(model)->texture_count, 0);
    assert_int_equal(dip_animated_model_def(model)->materials[0].colour_texture, DIP_NO_TEXTURE);
    dip_animated_model_destroy(&model);
    dip_error_list_free(&warnings);
    free(bytes);
}

int main(int argc, char **argv) {
    if (argc > 1 && strcmp(argv[1], importer_word) == 0) {
        return dip_importer_run(argc - 2, argv + 2);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(missing_normals_are_means_weighted_by_area),
        cmocka_unit_test(gltf_moves_as_the_specification_says),
        cmocka_unit_test(gltf_has_its_materials_and_names),
        cmocka_unit_test(step_holds_its_value),
        cmocka_unit_test(a_model_without_animations_rests),
        cmocka_unit_test(md2_frames_are_those_that_assimp_reads),
        cmocka_unit_test(every_md2_normal_is_that_of_assimp),
        cmocka_unit_test(key_frames_form_animations),
        cmocka_unit_test(two_key_frames_blend_into_each_other),
        cmocka_unit_test(key_frames_blend_and_repeat),
        cmocka_unit_test(poses_have_the_same_bits_everywhere),
        cmocka_unit_test(malformed_md2_files_are_refused),
        cmocka_unit_test(md2_triangles_use_what_is_there),
        cmocka_unit_test(every_cut_is_refused),
        cmocka_unit_test(malformed_gltf_files_are_refused),
        cmocka_unit_test(malformed_animations_are_refused),
        cmocka_unit_test(pictures_can_be_read_in_the_importer),
        cmocka_unit_test(shapes_are_read_without_pictures),
        cmocka_unit_test(a_missing_skin_gives_a_warning),
    };
    return cmocka_run_group_tests(tests, fixture_open, fixture_close);
}
