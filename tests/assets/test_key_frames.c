// Tests that the key frames of MD2 models play in scenes. assimp, another reader, reads the frames
// one by one; between them, positions and normals are blended here in double precision.
#include "assets/model.h"
#include "renderer/scene/motion.h"
#include "tests/assets/fixture.h"
#include "tests/assets/stage.h"

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

static const char crab[] = DIP_ASSETS_DIR "/gallery/crab.md2";

// The animations of crab.md2.
static const struct {
    const char *name;
    int first;
    int count;
} clips[] = {{"stand", 0, 10}, {"walk", 10, 12}, {"wave", 22, 12}};
enum { CLIPS = sizeof clips / sizeof *clips };

static const DipPose pose = {
    .position_world = {0.0, 0.0, 90.0}, .orientation = {0.0, 0.0, 0.0, 1.0}, .fov_y_deg = 45.0};

static DipModel *load_clip(const char *name) {
    return fixture_load(
        crab, &(DipModelOptions){.animation = DIP_MODEL_ANIMATION_NAMED, .animation_name = name},
        NULL);
}

static DipPosedDef *posed_of(const DipModel *model) {
    assert_non_null(dip_model_scene_def(model)->motion);
    DipPosedDef *posed = dip_posed_def_create(dip_model_scene_def(model), NULL);
    assert_non_null(posed);
    return posed;
}

// --- shapes --------------------------------------------------------------------------------------

static const struct aiScene *import_frame(int frame) {
    struct aiPropertyStore *properties = aiCreatePropertyStore();
    aiSetImportPropertyInteger(properties, AI_CONFIG_IMPORT_MD2_KEYFRAME, frame);
    const struct aiScene *scene = aiImportFileExWithProperties(crab, 0, NULL, properties);
    aiReleasePropertyStore(properties);
    assert_non_null(scene);
    return scene;
}

// Blends a vector of two frames and turns it as the root of the file says.
static void blend(const struct aiMatrix4x4 *m, struct aiVector3D a, struct aiVector3D b, double t,
                  double to[3]) {
    const double v[3] = {a.x + t * ((double)b.x - (double)a.x),
                         a.y + t * ((double)b.y - (double)a.y),
                         a.z + t * ((double)b.z - (double)a.z)};
    const double rows[3][3] = {{(double)m->a1, (double)m->a2, (double)m->a3},
                               {(double)m->b1, (double)m->b2, (double)m->b3},
                               {(double)m->c1, (double)m->c2, (double)m->c3}};
    for (int i = 0; i < 3; ++i) {
        to[i] = rows[i][0] * v[0] + rows[i][1] * v[1] + rows[i][2] * v[2];
    }
}

// Checks each corner of each triangle at a time between two frames. assimp lists the corners in the
// order of the file, whose winding is the other way round.
static void check_frames(const DipSceneDef *def, const struct aiScene *a, const struct aiScene *b,
                         double t) {
    static const unsigned places[3] = {0, 2, 1};
    const DipMeshDef *mesh = &def->meshes[0];
    const struct aiMatrix4x4 *root = &a->mRootNode->mTransformation;
    assert_int_equal(mesh->index_count, 3 * a->mMeshes[0]->mNumFaces);
    for (unsigned corner = 0; corner < mesh->index_count; ++corner) {
        const uint32_t vertex = mesh->indices[corner - corner % 3 + places[corner % 3]];
        double p[3];
        double n[3];
        blend(root, a->mMeshes[0]->mVertices[corner], b->mMeshes[0]->mVertices[corner], t, p);
        blend(root, a->mMeshes[0]->mNormals[corner], b->mMeshes[0]->mNormals[corner], t, n);
        const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (size_t i = 0; i < 3; ++i) {
            const double position = (double)mesh->positions[3 * (size_t)vertex + i];
            const double normal = (double)mesh->normals[3 * (size_t)vertex + i];
            // Where opposite normals blend to nothing, any direction is right.
            if (!(fabs(position - p[i]) <= 2e-4) || !(fabs(normal * length - n[i]) <= 1e-5)) {
                fail_msg("corner %u, axis %zu: position %.9g, expected %.9g; normal %.9g times "
                         "%.9g, expected %.9g",
                         corner, i, position, p[i], normal, length, n[i]);
            }
        }
    }
}

static void key_frames_play_as_another_reader_reads_them(void **state) {
    (void)state;
    static const double times_s[] = {0.0,  0.03, 0.1,  0.37, 0.5,  0.86,
                                     0.95, 1.05, 1.17, 7.41, -0.32};
    for (int c = 0; c < CLIPS; ++c) {
        DipModel *model = load_clip(clips[c].name);
        DipPosedDef *posed = posed_of(model);
        for (size_t i = 0; i < sizeof times_s / sizeof *times_s; ++i) {
            const double frames =
                fmod(fmod(10.0 * times_s[i], clips[c].count) + clips[c].count, clips[c].count);
            const int whole = (int)frames;
            const struct aiScene *a = import_frame(clips[c].first + whole);
            const struct aiScene *b = import_frame(clips[c].first + (whole + 1) % clips[c].count);
            dip_posed_def_set(posed, llround(times_s[i] * 1e9));
            check_frames(dip_posed_def(posed), a, b, frames - whole);
            aiReleaseImport(a);
            aiReleaseImport(b);
        }
        dip_posed_def_destroy(&posed);
        dip_model_destroy(&model);
    }
}

// --- clips ---------------------------------------------------------------------------------------

static void the_runs_of_frames_are_the_clips(void **state) {
    (void)state;
    DipModel *model =
        fixture_load(crab, &(DipModelOptions){.animation = DIP_MODEL_ANIMATION_FIRST}, NULL);
    int count;
    const char *const *names = dip_model_animations(model, &count);
    assert_int_equal(count, CLIPS);
    for (int c = 0; c < CLIPS; ++c) {
        assert_string_equal(names[c], clips[c].name);
    }
    const DipMotionDef *motion = dip_model_scene_def(model)->motion;
    assert_int_equal(motion->rig_count, 1);
    assert_string_equal(motion->rigs[0].clip, "stand");
    assert_float_equal(motion->rigs[0].duration_s, 1.0, 1e-12);
    dip_model_destroy(&model);
    const char *path = crab;
    const DipModelOptions dance = {.animation = DIP_MODEL_ANIMATION_NAMED,
                                   .animation_name = "dance"};
    DipError err = {0};
    assert_null(dip_model_load_with(&path, 1, &dance, NULL, NULL, &err));
    assert_string_equal(err.message, "'dance' is not an animation of the models, accepted none, "
                                     "\"stand\", \"walk\", \"wave\"");
}

static void without_a_clip_the_first_frame_stands_still(void **state) {
    (void)state;
    DipModel *still =
        fixture_load(crab, &(DipModelOptions){.animation = DIP_MODEL_ANIMATION_NONE}, NULL);
    assert_null(dip_model_scene_def(still)->motion);
    dip_model_destroy(&still);
}

// Writes a copy of the crab whose frames have other names: a clip of one frame, and frames without
// a stem.
static void write_renamed(const char *name) {
    enum { FRAME_BYTES_AT = 16, FRAMES_AT = 56, NAME_AT = 24 };
    size_t size_bytes;
    int32_t frame_bytes;
    int32_t frames;
    uint8_t *bytes = fixture_read(crab, &size_bytes);
    memcpy(&frame_bytes, bytes + FRAME_BYTES_AT, sizeof frame_bytes);
    memcpy(&frames, bytes + FRAMES_AT, sizeof frames);
    for (int f = 0; f < 34; ++f) {
        char *text = (char *)bytes + frames + f * frame_bytes + NAME_AT;
        memset(text, 0, 16);
        snprintf(text, 16, f == 5 ? "jump%d" : "%03d", f);
    }
    fixture_write(name, bytes, size_bytes);
    free(bytes);
}

static void a_clip_of_one_frame_stands_still_and_one_without_a_name_gets_one(void **state) {
    (void)state;
    write_renamed("renamed.md2");
    const DipModelOptions jump = {.animation = DIP_MODEL_ANIMATION_NAMED, .animation_name = "jump"};
    DipModel *model = fixture_load(fixture_path("renamed.md2"), &jump, NULL);
    int count;
    const char *const *names = dip_model_animations(model, &count);
    assert_int_equal(count, 3);
    assert_string_equal(names[0], "animation 0");
    assert_string_equal(names[1], "jump");
    assert_string_equal(names[2], "animation 2");
    assert_null(dip_model_scene_def(model)->motion);
    const struct aiScene *frame = import_frame(5);
    check_frames(dip_model_scene_def(model), frame, frame, 0.0);
    aiReleaseImport(frame);
    dip_model_destroy(&model);
}

// assimp accepts a triangle that names a point too many, but the reader of key frames does not.
static void a_file_whose_frames_cannot_be_read_stands_still_with_a_warning(void **state) {
    (void)state;
    enum { TRIANGLES_AT = 52 };
    size_t size_bytes;
    int32_t triangles;
    uint8_t *bytes = fixture_read(crab, &size_bytes);
    memcpy(&triangles, bytes + TRIANGLES_AT, sizeof triangles);
    memset(bytes + triangles + 6, 0xff, 2); // the texture coordinates of the first corner
    fixture_write("coordinates.md2", bytes, size_bytes);
    free(bytes);
    DipErrorList warnings = {0};
    const DipModelOptions first = {.animation = DIP_MODEL_ANIMATION_FIRST};
    DipModel *model = fixture_load(fixture_path("coordinates.md2"), &first, &warnings);
    assert_null(dip_model_scene_def(model)->motion);
    bool told = false;
    for (size_t i = 0; i < warnings.count; ++i) {
        told =
            told || strstr(warnings.items[i].message, "the key frames are not played: triangle 0");
    }
    assert_true(told);
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
}

static void flat_shading_plays_too(void **state) {
    (void)state;
    const DipModelOptions flat = {.animation = DIP_MODEL_ANIMATION_FIRST,
                                  .shading = DIP_MODEL_SHADING_flat};
    DipModel *model = fixture_load(crab, &flat, NULL);
    DipPosedDef *posed = posed_of(model);
    dip_posed_def_set(posed, 450000000);
    const DipMeshDef *mesh = &dip_posed_def(posed)->meshes[0];
    assert_int_equal(mesh->vertex_count, mesh->index_count);
    for (size_t i = 0; i < mesh->vertex_count; i += 3) {
        assert_memory_equal(mesh->normals + 3 * i, mesh->normals + 3 * i + 6, 3 * sizeof(float));
    }
    dip_posed_def_destroy(&posed);
    dip_model_destroy(&model);
}

// --- pictures ------------------------------------------------------------------------------------

static void a_frame_depends_on_its_time_alone(void **state) {
    (void)state;
    static uint8_t start[STAGE_BYTES];
    static uint8_t after[STAGE_BYTES];
    static uint8_t alone[STAGE_BYTES];
    DipModel *model = load_clip("walk");
    const DipSceneDef *def = dip_model_scene_def(model);
    Stage stage = stage_open(def, 2, "aa=none");
    assert_int_equal(stage_draw(&stage, &pose, 0, start).counters.vertices_posed,
                     def->meshes[0].vertex_count);
    for (int i = 1; i <= 50; ++i) {
        stage_draw(&stage, &pose, i, after);
    }
    assert_int_not_equal(memcmp(start, after, STAGE_BYTES), 0);
    for (int threads = 1; threads <= 3; ++threads) {
        Stage fresh = stage_open(def, threads, "aa=none");
        stage_draw(&fresh, &pose, 50, alone);
        assert_memory_equal(alone, after, STAGE_BYTES);
        stage_close(&fresh);
    }
    stage_close(&stage);
    dip_model_destroy(&model);
}

static void the_reference_draws_the_same_moment(void **state) {
    (void)state;
    DipModel *model = load_clip("wave");
    stage_check_moments(dip_model_scene_def(model), &pose, 4, 36, 15);
    dip_model_destroy(&model);
}

// Linear blends of frames lie within the bounds of the frames.
static void bounds_hold_at_every_time(void **state) {
    (void)state;
    for (int c = 0; c < CLIPS; ++c) {
        DipModel *model = load_clip(clips[c].name);
        DipPosedDef *posed = posed_of(model);
        Stage stage = stage_open(dip_model_scene_def(model), 1, "aa=none");
        float low[3];
        float high[3];
        dip_scene_bounds(stage.scene, low, high);
        for (int k = 0; k < 100; ++k) {
            dip_posed_def_set_share(posed, k / 100.0);
            const DipMeshDef *mesh = &dip_posed_def(posed)->meshes[0];
            for (size_t i = 0; i < 3 * (size_t)mesh->vertex_count; ++i) {
                assert_true(mesh->positions[i] > low[i % 3] - 1e-3f);
                assert_true(mesh->positions[i] < high[i % 3] + 1e-3f);
            }
        }
        dip_posed_def_destroy(&posed);
        stage_close(&stage);
        dip_model_destroy(&model);
    }
}

// A program that describes a motion may leave the boxes of its meshes to the scene.
static void a_scene_computes_the_boxes_that_its_description_lacks(void **state) {
    (void)state;
    DipModel *model = load_clip("walk");
    DipSceneDef def = *dip_model_scene_def(model);
    DipMotionDef motion = *def.motion;
    DipMovingMesh mesh = motion.meshes[0];
    float boxes[1][6];
    float bounds[2][6];
    assert_non_null(mesh.box);
    assert_true(dip_motion_bound_meshes(&motion, boxes));
    assert_memory_equal(boxes[0], mesh.box, sizeof boxes[0]);
    for (int i = 0; i < 2; ++i) {
        Stage stage = stage_open(&def, 1, "aa=none");
        dip_scene_bounds(stage.scene, bounds[i], bounds[i] + 3);
        stage_close(&stage);
        mesh.box = NULL;
        motion.meshes = &mesh;
        def.motion = &motion;
    }
    assert_memory_equal(bounds[0], bounds[1], sizeof bounds[0]);
    dip_model_destroy(&model);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(key_frames_play_as_another_reader_reads_them),
        cmocka_unit_test(the_runs_of_frames_are_the_clips),
        cmocka_unit_test(without_a_clip_the_first_frame_stands_still),
        cmocka_unit_test(a_clip_of_one_frame_stands_still_and_one_without_a_name_gets_one),
        cmocka_unit_test(a_file_whose_frames_cannot_be_read_stands_still_with_a_warning),
        cmocka_unit_test(flat_shading_plays_too),
        cmocka_unit_test(a_frame_depends_on_its_time_alone),
        cmocka_unit_test(the_reference_draws_the_same_moment),
        cmocka_unit_test(bounds_hold_at_every_time),
        cmocka_unit_test(a_scene_computes_the_boxes_that_its_description_lacks),
    };
    return cmocka_run_group_tests(tests, fixture_open, fixture_close);
}
