// Tests that the caller's floating-point mode changes nothing: every public function of assets/,
// campaths/ and config/ that computes with floats gives the same bits when the caller rounds
// otherwise, flushes subnormal numbers to zero or shortens the numbers of the x87 unit, and leaves
// the caller's mode as it was. tests/borders/check_fp_modes.sh checks that no function is missing.
#include "assets/animation.h"
#include "assets/cameras.h"
#include "assets/importer.h"
#include "assets/pack/scene_pack.h"
#include "campaths/camtrack.h"
#include "config/config.h"
#include "tests/assets/fixture.h"
#include "tests/support/fp_walk.h"

#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>

static const char importer_word[] = "import";
static const DipImporter importer = {.program = "/proc/self/exe", .command = importer_word};

static void hash_file(DipHash *hash, const char *path) {
    size_t size_bytes = 0;
    uint8_t *bytes = fixture_read(path, &size_bytes);
    dip_hash_bytes(hash, bytes, size_bytes);
    free(bytes);
}

// --- models --------------------------------------------------------------------------------------

// Hashes all that a description holds: its bytes in a pack.
static void hash_scene(DipHash *hash, const DipSceneDef *scene) {
    const DipScenePack pack = {.scene = *scene};
    const char *path = fixture_path("scene.pack");
    const int file = open(path, O_RDWR | O_CREAT | O_TRUNC, 0600);
    assert_true(dip_scene_pack_write(file, &pack));
    close(file);
    hash_file(hash, path);
}

static void hash_model(DipHash *hash, DipModel *model) {
    assert_non_null(model);
    hash_scene(hash, dip_model_scene_def(model));
    dip_model_destroy(&model);
}

static const char *const model_files[] = {"lights.gltf", "instances.gltf", "motion.gltf",
                                          "square.obj",  "square.ply",     "triangle.stl",
                                          "square.x",    "seam.gltf",      "tags.gltf"};

static void call_model_loads(DipHash *hash) {
    for (size_t i = 0; i < sizeof model_files / sizeof model_files[0]; ++i) {
        const char *path = fixture_data(model_files[i]);
        const float ambient_lin[3] = {0.1f, 0.2f, 0.3f};
        const DipModelOptions options = {.up = DIP_UP_z,
                                         .ambient_lin = ambient_lin,
                                         .has_light_scale = true,
                                         .light_scale = 0.7};
        hash_model(hash, dip_model_load(&path, 1, NULL, NULL, NULL));
        hash_model(hash, dip_model_load_with_normals(&path, 1, NULL, NULL, NULL));
        hash_model(hash, dip_model_load_with(&path, 1, &options, NULL, NULL, NULL));
    }
}

// Loads a model whose animation plays.
static void call_model_motion(DipHash *hash) {
    const char *path = fixture_data("motion.gltf");
    const DipModelOptions options = {.animation = DIP_MODEL_ANIMATION_FIRST};
    DipModel *model = dip_model_load_with(&path, 1, &options, NULL, NULL, NULL);
    int count = 0;
    assert_non_null(model);
    assert_non_null(dip_model_animations(model, &count));
    dip_hash_integer(hash, count);
    hash_model(hash, model);
}

static void call_model_import(DipHash *hash) {
    const char *path = fixture_data("lights.gltf");
    const DipModelOptions options = {.importer = &importer};
    hash_model(hash, dip_model_load_with(&path, 1, &options, NULL, NULL, NULL));
}

static void call_pack_reader(DipHash *hash) {
    const char *path = fixture_data("lights.gltf");
    DipModel *model = dip_model_load(&path, 1, NULL, NULL, NULL);
    assert_non_null(model);
    hash_scene(hash, dip_model_scene_def(model));
    dip_model_destroy(&model);
    size_t size_bytes = 0;
    uint8_t *bytes = fixture_read(fixture_path("scene.pack"), &size_bytes);
    DipScenePack pack;
    assert_true(dip_scene_pack_read(bytes, size_bytes, &pack, NULL));
    hash_scene(hash, &pack.scene);
    dip_scene_pack_free(&pack);
    free(bytes);
}

// A file whose camera moves below a turned and scaled node.
static const char camera_file[] =
    "{\"asset\":{\"version\":\"2.0\"},"
    "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.7,\"znear\":0.1}}],"
    "\"nodes\":[{\"rotation\":[0.1,0.2,0.3,0.9],\"scale\":[1.1,0.7,3.3],\"children\":[1]},"
    "{\"camera\":0,\"rotation\":[0.3,0.1,0.2,0.9]}],\"scenes\":[{\"nodes\":[0]}],"
    "\"buffers\":[{\"byteLength\":32,\"uri\":\"data:application/octet-stream;base64,"
    "AAAAAGZmpj/NzMw9zcxMPpqZmT6amdk/ZmZmvzMzMz8=\"}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":8},"
    "{\"buffer\":0,\"byteOffset\":8,\"byteLength\":24}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":2,\"type\":\"SCALAR\","
    "\"min\":[0],\"max\":[1.3]},"
    "{\"bufferView\":1,\"componentType\":5126,\"count\":2,\"type\":\"VEC3\"}],"
    "\"animations\":[{\"samplers\":[{\"input\":0,\"output\":1}],"
    "\"channels\":[{\"sampler\":0,\"target\":{\"node\":1,\"path\":\"translation\"}}]}]}";

static void call_cameras(DipHash *hash) {
    fixture_write_text("camera.gltf", camera_file);
    DipError err = {0};
    DipModelCameras *cameras =
        dip_model_cameras_load(fixture_path("camera.gltf"), DIP_UP_auto, NULL, &err);
    if (!cameras) {
        fail_msg("%s", err.message);
    }
    int count = 0;
    const DipModelCamera *list = dip_model_cameras_list(cameras, &count);
    assert_int_equal(count, 1);
    assert_true(list[0].key_count > 100);
    for (int i = 0; i < count; ++i) {
        dip_hash_number(hash, list[i].fov_y_deg);
        dip_hash_bytes(hash, list[i].keys, list[i].key_count * sizeof *list[i].keys);
    }
    dip_model_cameras_destroy(&cameras);
}

// --- models in motion ----------------------------------------------------------------------------

static void hash_animated(DipHash *hash, const DipAnimatedDef *def) {
    for (int i = 0; i < def->mesh_count; ++i) {
        const DipAnimatedMesh *mesh = &def->meshes[i];
        const size_t vertices = mesh->vertex_count;
        const size_t shapes = vertices * (size_t)mesh->shape_count;
        dip_hash_bytes(hash, mesh->indices, mesh->index_count * sizeof *mesh->indices);
        dip_hash_bytes(hash, mesh->positions, 3 * shapes * sizeof *mesh->positions);
        dip_hash_bytes(hash, mesh->normals, 3 * shapes * sizeof *mesh->normals);
        dip_hash_bytes(hash, mesh->uv0, mesh->uv0 ? 2 * vertices * sizeof *mesh->uv0 : 0);
        dip_hash_bytes(hash, mesh->joint_weights,
                       mesh->joint_weights ? 4 * vertices * sizeof *mesh->joint_weights : 0);
    }
    for (int i = 0; i < def->animation_count; ++i) {
        dip_hash_number(hash, def->animations[i].duration_s);
    }
    for (int i = 0; i < def->key_frame_count; ++i) {
        dip_hash_number(hash, def->key_frames[i].time_s);
    }
    for (int i = 0; i < def->material_count; ++i) {
        dip_hash_bytes(hash, def->materials[i].base_colour_lin,
                       sizeof def->materials[i].base_colour_lin);
        dip_hash_number(hash, def->materials[i].roughness);
    }
}

static void hash_pose(DipHash *hash, const DipAnimatedDef *def, const DipAnimatedPose *pose) {
    for (int i = 0; i < def->object_count; ++i) {
        const DipObjectPose *object = dip_animated_pose_object(pose, i);
        const DipAnimatedMesh *mesh = &def->meshes[def->objects[i].mesh];
        const size_t joint_floats = 12 * (size_t)def->objects[i].joint_count;
        const size_t floats = 3 * (size_t)mesh->vertex_count;
        float *vertices = malloc(2 * floats * sizeof *vertices);
        dip_hash_bytes(hash, object->transform, sizeof object->transform);
        dip_hash_bytes(hash, object->weights, (size_t)mesh->shape_count * sizeof(float));
        dip_hash_number(hash, object->blend);
        dip_hash_bytes(hash, object->joint_transforms, joint_floats * sizeof(float));
        dip_animated_pose_vertices(pose, i, vertices, vertices + floats);
        dip_hash_bytes(hash, vertices, 2 * floats * sizeof *vertices);
        free(vertices);
    }
}

static void call_animation(DipHash *hash) {
    static const char *const files[] = {DIP_TEST_DATA "/motion.gltf",
                                        DIP_ASSETS_DIR "/gallery/pump.glb",
                                        DIP_ASSETS_DIR "/gallery/crab.md2"};
    for (size_t f = 0; f < 2 * sizeof files / sizeof files[0]; ++f) {
        DipError err = {0};
        const char *file = files[f / 2];
        DipAnimatedModel *model = f % 2 ? dip_animated_model_load_shapes(file, NULL, &err)
                                        : dip_animated_model_load(file, NULL, NULL, &err);
        DipAnimatedPose *pose = model ? dip_animated_pose_create(model, &err) : NULL;
        if (!pose) {
            fail_msg("%s: %s", file, err.message);
        }
        const DipAnimatedDef *def = dip_animated_model_def(model);
        hash_animated(hash, def);
        hash_pose(hash, def, pose);
        for (int i = 0; i < 8 * def->animation_count; ++i) {
            static const double times_s[8] = {0.0, 0.1, 0.37, 0.5, 1.3, 7.77, -3.1, 1e5 + 0.3};
            dip_animated_pose_set(pose, i / 8, times_s[i % 8]);
            hash_pose(hash, def, pose);
        }
        dip_animated_pose_destroy(&pose);
        dip_animated_model_destroy(&model);
    }
}

// --- pictures ------------------------------------------------------------------------------------

static void hash_picture(DipHash *hash, DipPicture *picture) {
    dip_hash_bytes(hash, picture->rgba8, 4 * (size_t)picture->width * (size_t)picture->height);
    dip_picture_free(picture);
}

static void call_pictures(DipHash *hash) {
    static const char *const names[] = {"light.hdr",   "flat.hdr", "bc1.dds", "bc3.dds",
                                        "palette.pcx", "deep.ppm", "grey.pgm"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
        char name[FIXTURE_PATH];
        snprintf(name, sizeof name, "pictures/%s", names[i]);
        DipPicture picture;
        assert_true(dip_picture_read_file(fixture_data(name), &picture, NULL));
        hash_picture(hash, &picture);
        assert_true(dip_picture_import(fixture_data(name), NULL, &picture, NULL));
        hash_picture(hash, &picture);
    }
    DipPicture picture;
    assert_true(dip_picture_decode(fixture_png, sizeof fixture_png, "p", &picture, NULL));
    hash_picture(hash, &picture);
    assert_true(dip_picture_import(fixture_data("pictures/light.hdr"), &importer, &picture, NULL));
    hash_picture(hash, &picture);
}

static void hash_environment(DipHash *hash, DipEnvironmentDef *environment) {
    assert_non_null(environment);
    dip_hash_bytes(hash, environment->rgb_lin,
                   3 * (size_t)environment->width * (size_t)environment->height * sizeof(float));
    free(environment);
}

// The light of the file is small enough for a mode that loses small numbers.
static void call_environments(DipHash *hash) {
    static const char bytes[] = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x11\x90\x33\x03"
                                "\xa1\x22\xf3\x81";
    const size_t size_bytes = sizeof bytes - 1;
    hash_environment(hash, dip_environment_decode((const uint8_t *)bytes, size_bytes, "e", NULL));
    FILE *file = fopen(fixture_path("mode.hdr"), "wb");
    assert_true(file && fwrite(bytes, 1, size_bytes, file) == size_bytes && fclose(file) == 0);
    hash_environment(hash, dip_environment_read_file(fixture_path("mode.hdr"), NULL));
}

// --- camera paths --------------------------------------------------------------------------------

static const char path_text[] = "diptych-path 1\n"
                                "period 0.7\n"
                                "0.1 0.2 0.3 0 0 0 1\n"
                                "1.7 0.2 0.3 0.1 0.2 0.3 0.92736185\n"
                                "0.1 1e-310 3.3 0 0.6 0 0.8\n";

static void hash_path(DipHash *hash, const DipCamPath *path) {
    const DipCamPathInfo info = dip_campath_info(path);
    dip_hash_bytes(hash, &info, sizeof info);
    for (size_t i = 0; i < info.key_count; ++i) {
        const DipCamKey key = dip_campath_key(path, i);
        dip_hash_bytes(hash, &key, sizeof key);
    }
    for (int i = 0; i < 20; ++i) {
        DipPose pose = {.fov_y_deg = 45.0};
        dip_campath_sample(path, i * INT64_C(377777777), &pose);
        dip_hash_bytes(hash, pose.position_world, sizeof pose.position_world);
        dip_hash_bytes(hash, pose.orientation, sizeof pose.orientation);
    }
    assert_true(dip_campath_save_pth(path, fixture_path("mode.pth"), NULL));
    hash_file(hash, fixture_path("mode.pth"));
    assert_true(dip_campath_save_bth(path, fixture_path("mode.bth"), NULL));
    hash_file(hash, fixture_path("mode.bth"));
}

static void hash_track(DipHash *hash, const DipCamPath *path) {
    DipCamTrack track = dip_camtrack_make(true);
    dip_camtrack_set(&track, 0, path, 45.0);
    dip_camtrack_set_named(&track, 1, path, 33.3, "named");
    dip_camtrack_switch(&track, 1, INT64_C(123456789));
    for (int i = 0; i < 20; ++i) {
        DipPose pose = {.fov_y_deg = 45.0};
        assert_true(dip_camtrack_pose(&track, i * INT64_C(377777777), &pose));
        dip_hash_bytes(hash, pose.position_world, sizeof pose.position_world);
        dip_hash_bytes(hash, pose.orientation, sizeof pose.orientation);
        dip_hash_number(hash, pose.fov_y_deg);
    }
}

static void call_paths(DipHash *hash) {
    const DipCamOrbitDef orbit = dip_campath_default_orbit();
    DipCamPath *path = NULL;
    assert_true(dip_campath_orbit(&orbit, &path, NULL));
    hash_path(hash, path);
    hash_track(hash, path);
    dip_campath_destroy(&path);

    assert_true(dip_campath_parse(path_text, sizeof path_text - 1, "mode.pth", &path, NULL));
    hash_path(hash, path);
    DipCamKey keys[3];
    for (size_t i = 0; i < 3; ++i) {
        keys[i] = dip_campath_key(path, i);
        keys[i].orientation[0] *= 3.0;
    }
    dip_campath_destroy(&path);
    assert_true(dip_campath_load(fixture_path("mode.bth"), &path, NULL));
    hash_path(hash, path);
    dip_campath_destroy(&path);
    assert_true(dip_campath_create(keys, 3, INT64_C(700000000), &path, NULL));
    hash_path(hash, path);
    dip_campath_destroy(&path);
}

// --- configurations ------------------------------------------------------------------------------

static void hash_numbers(DipHash *hash, const DipConfig *config) {
#define HASH_NUMBER(field)   dip_hash_number(hash, config->field);
#define HASH_SCALE(field)    dip_hash_number(hash, config->field.factor);
#define HASH_SETTINGS(field) dip_hash_bytes(hash, config->field.step, sizeof config->field.step);
#define HASH_NONE(field)
#define HASH_SIZE                                                HASH_NONE
#define HASH_INTEGER                                             HASH_NONE
#define HASH_FLAG                                                HASH_NONE
#define HASH_FILE                                                HASH_NONE
#define HASH_FILES                                               HASH_NONE
#define HASH_COLOR                                               HASH_NONE
#define HASH_NAME                                                HASH_NONE
#define HASH_MATERIALS                                           HASH_NONE
#define HASH_LIGHTMAPS                                           HASH_NONE
#define HASH_SHADING                                             HASH_NONE
#define HASH_LIGHTS                                              HASH_NONE
#define HASH_ISA                                                 HASH_NONE
#define HASH_FIELD(NAME, field, TYPE, fallback, low, high, text) HASH_##TYPE(field)
    DIP_CONFIG_LIST(HASH_FIELD, DIP_CONFIG_NONE, DIP_CONFIG_NONE)
    for (int i = 0; i < DIP_CATEGORY_COUNT; ++i) {
        dip_hash_number(hash, config->camera[i].fov_y_deg);
    }
    for (size_t i = 0; i < config->light.count; ++i) {
        const DipLightDef *light = &config->light.items[i];
        assert_null(light->name);
        dip_hash_bytes(hash, light, sizeof *light);
    }
}

static void call_config(DipHash *hash) {
    fixture_write_text("mode.ini", "RES: 32x32\n"
                                   "XFILE: a.obj\n"
                                   "NEAR: 0.1234567890123456789\n"
                                   "SKY_OVERCAST: 0.3\n"
                                   "SKY_LAYER1_SPEED: -1.1e-1\n"
                                   "LIGHT_SCALE: 0.7\n"
                                   "CAMPATH_DEFAULT_FOV: 33.3\n"
                                   "LIGHT: directional to=-1,-2,0.3 colour=255,244,220 "
                                   "strength=0.7\n"
                                   "LIGHT: spot at=0,3.3,0 to=0,0,0.1 inner=15 outer=31.7\n");
    DipConfig config;
    DipErrorList faults = {0};
    if (!dip_config_load(fixture_path("mode.ini"), &config, &faults)) {
        char text[512];
        dip_error_format(&faults.items[0], text, sizeof text);
        fail_msg("%s", text);
    }
    hash_numbers(hash, &config);
    dip_config_free(&config);
    dip_error_list_free(&faults);
    for (int key = 0; key < DIP_KEY_COUNT; ++key) {
        char row[1024];
        dip_config_document_key((DipConfigKey)key, row, sizeof row);
        dip_hash_text(hash, row);
    }
}

// --- the test ------------------------------------------------------------------------------------

static const FpWalkEntry entries[] = {
    {"loading models", call_model_loads},
    {"importing a model", call_model_import},
    {"loading a model that moves", call_model_motion},
    {"reading a scene pack", call_pack_reader},
    {"reading cameras", call_cameras},
    {"loading and posing models in motion", call_animation},
    {"decoding pictures", call_pictures},
    {"decoding environments", call_environments},
    {"reading, sampling and writing camera paths", call_paths},
    {"reading a configuration", call_config},
};

int main(int argc, char **argv) {
    if (argc > 1 && strcmp(argv[1], importer_word) == 0) {
        return dip_importer_run(argc - 2, argv + 2);
    }
    return fp_walk_main(entries, sizeof entries / sizeof *entries, fixture_open, fixture_close);
}
