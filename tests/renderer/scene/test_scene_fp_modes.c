// Tests that the caller's floating-point mode changes nothing: the functions of renderer/scene/
// give the same bits in every mode and leave the mode as it was. The rows A1 and N47 of the
// catalogue draw more scenes so, with every instruction set.
#include "renderer/catalogue/scenes.h"
#include "renderer/reference/reference.h"
#include "renderer/scene/finish.h"
#include "renderer/scene/mip_debug.h"
#include "renderer/scene/motion.h"
#include "renderer/scene/renderer.h"
#include "tests/support/fp_walk.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

enum { WIDTH = 56, HEIGHT = 40, NODES = 2, TRACKS = 4 };

static DipTestScene scene;  // with water, clouds and lights
static DipTestScene moving; // a quad that a clip moves
static DipScene *usual;     // `scene`, made in the usual mode

// --- a clip --------------------------------------------------------------------------------------

static const float key_times[3] = {0.0f, 0.7f, 1.3f};
static const float places[9] = {0.1f, 0.2f, 0.3f, 1.7f, -0.9f, 0.7f, 1e-39f, 3.3f, 0.1f};
static const float turns[12] = {0.0f, 0.1f, 0.0f, 0.9f, 0.3f, 0.2f,
                                0.1f, 0.7f, 0.9f, 0.1f, 0.3f, 0.2f};
static const float sizes[27] = {0.0f, 0.1f, 0.2f, 1.0f, 1.1f, 0.9f, 0.3f, 0.1f, 0.7f,
                                0.1f, 0.1f, 0.3f, 1.3f, 0.7f, 1.9f, 0.2f, 0.3f, 0.1f,
                                0.3f, 0.1f, 0.2f, 1.7f, 0.3f, 0.7f, 0.1f, 0.9f, 0.1f};
static const float shape_weights[3] = {0.1f, 0.9f, 0.3f};
static const DipTrack tracks[TRACKS] = {
    {DIP_TRACK_TRANSLATION, DIP_INTERPOLATION_LINEAR, 0, 3, 3, key_times, places},
    {DIP_TRACK_ROTATION, DIP_INTERPOLATION_LINEAR, 1, 4, 3, key_times, turns},
    {DIP_TRACK_SCALE, DIP_INTERPOLATION_CUBICSPLINE, 1, 3, 3, key_times, sizes},
    {DIP_TRACK_WEIGHTS, DIP_INTERPOLATION_LINEAR, 1, 1, 3, key_times, shape_weights}};
static const DipRigNode nodes[NODES] = {
    {.parent = DIP_NO_NODE, .rotation = {0.1, 0.3, 0.2, 0.7}, .scale = {1.1, 0.7, 1.3}},
    {.parent = 0,
     .translation = {0.3, 0.1, 3e-310},
     .rotation = {0.0, 0.3, 0.1, 0.9},
     .scale = {0.9, 1.7, 1.1},
     .weight_count = 1}};
static const float rest_weights[1] = {0.3f};
static const int joint_nodes[2] = {0, 1};
static const double binds[24] = {0.9, 0.1, 0.2, 0.3, 0.1, 1.1, 0.3, 0.7, 0.1, 0.2, 0.7, 0.1,
                                 1.3, 0.3, 0.1, 0.1, 0.2, 0.7, 0.1, 0.3, 0.3, 0.1, 1.7, 0.9};
static const DipRigSkin skin = {2, joint_nodes, binds};
static const DipRig rig = {nodes, NODES, rest_weights, 1};

static const float shape_positions[24] = {0.1f, 0.3f, 0.2f, 1.7f, 0.1f,   0.3f, 1.1f, 1.9f,
                                          0.7f, 0.1f, 1.3f, 0.9f, 0.3f,   0.1f, 0.1f, 0.2f,
                                          0.9f, 0.1f, 0.7f, 0.3f, 1e-39f, 0.1f, 0.1f, 0.3f};
static const float shape_normals[24] = {0.0f, 0.1f, 0.9f, 0.1f, 0.0f, 0.9f, 0.3f, 0.1f,
                                        0.9f, 0.1f, 0.1f, 0.9f, 0.1f, 0.0f, 0.1f, 0.1f,
                                        0.1f, 0.0f, 0.0f, 0.1f, 0.1f, 0.1f, 0.1f, 0.3f};
static const uint16_t joints[16] = {0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 1, 1, 0, 0};
static const float joint_weights[16] = {0.7f, 0.3f, 0.0f, 0.0f, 0.9f, 0.1f, 0.0f, 0.0f,
                                        0.3f, 0.3f, 0.4f, 0.0f, 0.1f, 0.2f, 0.7f, 0.0f};
static const DipMotionRig motion_rig = {.clip = "clip",
                                        .duration_s = 1.3,
                                        .root = {1.1, 0, 0, -6.7, 0, 0.9, 0, -3.1, 0, 0, 1.3, -8.7},
                                        .rig = {nodes, NODES, rest_weights, 1},
                                        .skins = &skin,
                                        .skin_count = 1,
                                        .tracks = tracks,
                                        .track_count = TRACKS};
static const DipMovingObject moving_object = {
    .node = 1, .offset = {0.7, 0.1, 0.2, 0.3, 0.3, 1.7, 0.1, 0.9, 0.2, 0.3, 1.1, 0.7}};
static const DipMovingMesh moving_mesh = {.node = 1,
                                          .vertex_count = 4,
                                          .shape_count = 2,
                                          .positions = shape_positions,
                                          .normals = shape_normals,
                                          .joints = joints,
                                          .joint_weights = joint_weights};
static const DipMotionDef motion = {&motion_rig, &moving_object, &moving_mesh, 1, 1, 1};

static const double times_s[] = {0.0, 0.1, 0.37, 0.7, 1.1, 1.29, 7.77, -3.1, 1e5 + 0.3};
enum { TIMES = sizeof times_s / sizeof *times_s };

static int make_inputs(void **state) {
    (void)state;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_water_effects);
    dip_test_scene_begin(&moving);
    const int texture = dip_test_scene_add_texture(&moving, DIP_TEST_NOISE, 32, 32);
    const int material = dip_test_scene_add_material(&moving, texture);
    const float corner[3] = {-1.0f, -1.0f, -3.0f}, a[3] = {2, 0, 0}, b[3] = {0, 2, 0};
    dip_test_scene_add_quad(&moving, material, corner, a, b, 1.0f, 1.0f);
    moving.def.motion = &motion;
    moving.def.lighting = dip_lighting_fixed();
    moving.materials[material].lit = true;
    moving.materials[material].double_sided = true;
    usual = dip_scene_create(&scene.def, NULL, NULL);
    return usual ? 0 : -1;
}

static int free_inputs(void **state) {
    (void)state;
    dip_scene_destroy(&usual);
    dip_test_scene_free(&scene);
    dip_test_scene_free(&moving);
    return 0;
}

// --- rigs ----------------------------------------------------------------------------------------

static void hash_doubles(DipHash *hash, const double *values, size_t count) {
    dip_hash_bytes(hash, values, count * sizeof *values);
}

static void call_matrices(DipHash *hash) {
    double local[2][12], product[12];
    for (int n = 0; n < NODES; n++) {
        dip_rig_local(&nodes[n], local[n]);
        hash_doubles(hash, local[n], 12);
    }
    dip_rig_multiply(binds, binds + 12, product);
    hash_doubles(hash, product, 12);
}

static void call_times(DipHash *hash) {
    for (int i = 0; i < TIMES; i++) {
        dip_hash_number(hash, dip_rig_wrap_time(times_s[i], 1.3));
        dip_hash_number(hash, dip_rig_wrap_time(times_s[i], 0.1));
    }
}

static void call_places(DipHash *hash) {
    for (int i = 0; i < TIMES; i++) {
        double world[12];
        dip_rig_place_node(&rig, tracks, TRACKS, 1, times_s[i], world);
        hash_doubles(hash, world, 12);
    }
}

static void hash_rig_pose(DipHash *hash, const DipRigPose *pose) {
    float matrices[24];
    dip_rig_pose_joints(pose, &skin, matrices);
    dip_hash_bytes(hash, matrices, sizeof matrices);
    for (int n = 0; n < NODES; n++) {
        hash_doubles(hash, dip_rig_pose_world(pose, n), 12);
    }
    hash_doubles(hash, dip_rig_pose_weights(pose, 1), 1);
}

static void call_rig_poses(DipHash *hash) {
    DipRigPose *pose = dip_rig_pose_create(&rig);
    assert_non_null(pose);
    hash_rig_pose(hash, pose);
    for (int i = 0; i < TIMES; i++) {
        dip_rig_pose_set(pose, tracks, TRACKS, times_s[i]);
        hash_rig_pose(hash, pose);
    }
    dip_rig_pose_destroy(&pose);
}

// --- motions -------------------------------------------------------------------------------------

static void hash_pose(DipHash *hash, const DipMotionPose *pose) {
    float transform[12], positions[12], normals[12];
    dip_motion_pose_transform(pose, 0, transform);
    dip_motion_pose_vertices(pose, 0, 0, 4, 3, positions, normals);
    dip_hash_bytes(hash, transform, sizeof transform);
    dip_hash_bytes(hash, positions, sizeof positions);
    dip_hash_bytes(hash, normals, sizeof normals);
}

static void call_poses(DipHash *hash) {
    DipMotionPose *pose = dip_motion_pose_create(&motion);
    assert_non_null(pose);
    hash_pose(hash, pose);
    for (int i = 0; i < TIMES; i++) {
        dip_motion_pose_set(pose, i * INT64_C(377777777) - 1000000000);
        hash_pose(hash, pose);
        dip_motion_pose_set_share(pose, i * 0.109375);
        hash_pose(hash, pose);
    }
    dip_motion_pose_destroy(&pose);
}

static void call_bounds(DipHash *hash) {
    float boxes[1][6];
    assert_true(dip_motion_bound_meshes(&motion, boxes));
    dip_hash_bytes(hash, boxes, sizeof boxes);
}

static void call_posed_defs(DipHash *hash) {
    DipPosedDef *posed = dip_posed_def_create(&moving.def, NULL);
    assert_non_null(posed);
    for (int i = 0; i < 3; i++) {
        const DipSceneDef *def = dip_posed_def(posed);
        dip_hash_bytes(hash, def->meshes[0].positions, 12 * sizeof(float));
        dip_hash_bytes(hash, def->objects[0].transform, 12 * sizeof(float));
        if (i == 0) {
            dip_posed_def_set(posed, INT64_C(377777777));
        } else {
            dip_posed_def_set_share(posed, 0.7);
        }
    }
    dip_posed_def_destroy(&posed);
}

// A motion whose keys and whose duration are so near to each other and to 0 that only the usual
// mode tells them apart.
static void call_checks(DipHash *hash) {
    static const float near_times[3] = {0.0f, 1e-40f, 2e-40f};
    const DipTrack near = {
        DIP_TRACK_TRANSLATION, DIP_INTERPOLATION_LINEAR, 0, 3, 3, near_times, places};
    DipMotionRig short_rig = motion_rig;
    short_rig.tracks = &near;
    short_rig.track_count = 1;
    short_rig.duration_s = 3e-310;
    const DipMotionDef brief = {&short_rig, &moving_object, &moving_mesh, 1, 1, 1};
    DipSceneDef def = moving.def;
    def.motion = &brief;
    dip_hash_integer(hash, dip_motion_check(&def, NULL));
    dip_hash_integer(hash, dip_motion_plays(&brief));
    dip_hash_integer(hash, dip_motion_plays(&motion));
}

// --- settings ------------------------------------------------------------------------------------

static void call_scales(DipHash *hash) {
    DipQuality quality = dip_quality_default();
    for (int step = 0; step < dip_setting_info(DIP_SETTING_SCALE)->step_count; step++) {
        quality.step[DIP_SETTING_SCALE] = (uint8_t)step;
        dip_hash_number(hash, dip_quality_scale(&quality));
    }
}

static void call_defaults(DipHash *hash) {
    const DipSkyDef sky = dip_sky_default();
    dip_hash_bytes(hash, &sky.perturbation_scale, sizeof sky.perturbation_scale);
    dip_hash_bytes(hash, sky.zenith_lin, sizeof sky.zenith_lin);
    DipTexture *texture = dip_mip_debug_create(NULL, NULL);
    uint8_t texel[4];
    assert_true(dip_texture_read(texture, 3, DIP_ENCODING_SRGB, texel, NULL));
    dip_hash_bytes(hash, texel, sizeof texel);
    dip_texture_destroy(&texture);
}

// --- pictures ------------------------------------------------------------------------------------

static void hash_frame(DipHash *hash, const DipFrame *frame) {
    char hex[33];
    dip_frame_hash(frame, hex);
    dip_hash_text(hash, hex);
}

static DipQuality quality_of(const char *settings) {
    DipQuality quality;
    assert_true(dip_quality_parse(settings, &quality, NULL));
    return quality;
}

static DipRenderer *make_renderer(const char *settings, const DipTestScene *of) {
    DipRendererDef def = dip_renderer_default_def();
    def.width = 40;
    def.height = 40;
    DipRenderer *renderer = dip_renderer_create(&def, NULL);
    const DipQuality quality = quality_of(settings);
    assert_non_null(renderer);
    assert_true(dip_renderer_set_quality(renderer, &quality, NULL));
    assert_true(dip_renderer_set_reflection(renderer, &of->reflection, NULL));
    assert_true(dip_renderer_resize(renderer, WIDTH, HEIGHT, NULL));
    return renderer;
}

static const char *const settings_of_test[] = {
    "aa=4,af=16,aaf=on,shadows=2048", "aa=none,taa=history,sharpen=low",
    "scale=1/1.5,upscale=easu",       "aa=2,post=smaa,mipdebug=on",
    "scale=2,opt=advanced",
};

// Draws a scene twice with each setting, at two times.
static void hash_pictures(DipHash *hash, const DipScene *drawn, const DipTestScene *of) {
    for (size_t i = 0; i < sizeof settings_of_test / sizeof *settings_of_test; i++) {
        DipRenderer *renderer = make_renderer(settings_of_test[i], of);
        for (int n = 0; n < 2; n++) {
            DipError err = {0};
            DipFrame frame;
            dip_renderer_set_frame_index(renderer, (uint64_t)n);
            if (!dip_renderer_draw(renderer, drawn, &of->pose, 123456789 + n * INT64_C(7777777),
                                   &frame, &err)) {
                fail_msg("%s: %s", settings_of_test[i], err.message);
            }
            hash_frame(hash, &frame);
        }
        dip_renderer_destroy(&renderer);
    }
}

static void hash_scene(DipHash *hash, const DipScene *made) {
    float bounds[2][3];
    double level = 0.0;
    dip_scene_bounds(made, bounds[0], bounds[1]);
    dip_hash_bytes(hash, bounds, sizeof bounds);
    dip_hash_integer(hash, dip_scene_water_level(made, &level));
    dip_hash_number(hash, level);
    dip_hash_integer(hash, dip_scene_moves(made));
}

static void call_scenes(DipHash *hash) {
    const DipTestScene *const list[2] = {&scene, &moving};
    for (int i = 0; i < 2; i++) {
        DipError err = {0};
        DipScene *made = dip_scene_create(&list[i]->def, NULL, &err);
        if (!made) {
            fail_msg("%s", err.message);
        }
        hash_scene(hash, made);
        assert_true(dip_scene_compress_textures(made, NULL, NULL));
        hash_pictures(hash, made, list[i]);
        dip_scene_destroy(&made);
    }
}

static void call_pictures(DipHash *hash) {
    hash_pictures(hash, usual, &scene);
}

static void call_frames_at_once(DipHash *hash) {
    DipRenderer *renderers[2] = {make_renderer("aa=4,af=8", &scene), make_renderer("", &scene)};
    DipFrame frames[2];
    DipFrame *const pointers[2] = {&frames[0], &frames[1]};
    assert_true(
        dip_renderer_draw_frames(renderers, 2, usual, &scene.pose, 123456789, pointers, NULL));
    static DipSampleValue samples[WIDTH * HEIGHT * DIP_READBACK_STRIDE];
    const DipSampleReadback readback = {{0, 0, WIDTH, HEIGHT}, samples};
    assert_true(
        dip_renderer_read_samples(renderers[0], usual, &scene.pose, 123456789, &readback, NULL));
    for (int i = 0; i < WIDTH * HEIGHT * DIP_READBACK_STRIDE; i++) {
        dip_hash_bytes(hash, samples[i].linear16, sizeof samples[i].linear16);
        dip_hash_bytes(hash, &samples[i].depth, sizeof samples[i].depth);
    }
    for (int i = 0; i < 2; i++) {
        hash_frame(hash, &frames[i]);
        dip_renderer_destroy(&renderers[i]);
    }
}

static void call_mip_pictures(DipHash *hash) {
    const DipTextureDef *pictures[DIP_MIP_DEBUG_LEVELS] = {NULL};
    pictures[4] = &scene.def.textures[0];
    DipRenderer *renderer = make_renderer("mipdebug=on", &scene);
    DipFrame frame;
    assert_true(dip_renderer_set_mip_pictures(renderer, pictures, NULL));
    assert_true(dip_renderer_draw(renderer, usual, &scene.pose, 0, &frame, NULL));
    hash_frame(hash, &frame);
    dip_renderer_destroy(&renderer);
}

// A mode that takes subnormal numbers for 0 must not take an orientation of them for 0.
static void call_pose_checks(DipHash *hash) {
    const DipPose pose = {.orientation = {1e-310, 0.0, 0.0, 1e-310}, .fov_y_deg = 60.0};
    dip_hash_integer(hash, dip_pose_check(&pose, NULL));
}

// The reference renderer's picture of a scene that has moved.
static void call_reference(DipHash *hash) {
    DipReference *reference = dip_reference_create(&moving.def, NULL);
    const DipQuality quality = quality_of("aa=2,af=4,shadows=2048");
    double rgb_lin[3 * 24 * 16];
    assert_non_null(reference);
    dip_reference_set_reflection(reference, &scene.reflection);
    dip_reference_set_time(reference, INT64_C(377777777));
    assert_true(dip_reference_draw(reference, &quality, &moving.pose, 24, 16, rgb_lin, NULL));
    hash_doubles(hash, rgb_lin, sizeof rgb_lin / sizeof *rgb_lin);
    int shown = 0;
    for (int i = 0; i < 24 * 16; i++) {
        shown += rgb_lin[3 * i] != (double)moving.def.background_lin[0];
    }
    assert_true(shown > 10);
    dip_reference_destroy(&reference);
}

static void call_finish(DipHash *hash) {
    static uint8_t drawn[WIDTH * HEIGHT * 4];
    for (int i = 0; i < WIDTH * HEIGHT * 4; i++) {
        drawn[i] = (uint8_t)(i * i % 251);
    }
    const DipQuality quality = quality_of("taa=history,post=fxaa,sharpen=medium");
    const DipFinishSize size = dip_finish_size(&quality, WIDTH, HEIGHT);
    DipFinish *finish = dip_finish_create(NULL, dip_isa_best(), NULL);
    assert_true(finish && dip_finish_follow(finish, &quality, &size, NULL));
    float *depths = dip_finish_depths(finish);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        depths[i] = 0.125f;
    }
    for (int n = 0; n < 4; n++) {
        const DipFinishMotion step = {.step = n ? DIP_HISTORY_MOVE : DIP_HISTORY_BEGIN,
                                      .to_before = {0.99f, 0.01f, 0.0f, 0.1f, -0.01f, 0.98f, 0.0f,
                                                    0.2f, 0.0f, 0.01f, 1.0f, 0.1f}};
        DipFrame frame = {
            .rgba8 = drawn, .stride_bytes = (size_t)WIDTH * 4, .width = WIDTH, .height = HEIGHT};
        dip_finish_frame(finish, &step, &frame);
        hash_frame(hash, &frame);
    }
    dip_finish_destroy(&finish);
}

// --- the test ------------------------------------------------------------------------------------

static const FpWalkEntry entries[] = {
    {"matrices of nodes", call_matrices},
    {"times of a clip", call_times},
    {"places of a node", call_places},
    {"poses of a rig", call_rig_poses},
    {"poses of a motion", call_poses},
    {"boxes of a motion", call_bounds},
    {"posed descriptions", call_posed_defs},
    {"checks of a motion", call_checks},
    {"checks of a pose", call_pose_checks},
    {"scales", call_scales},
    {"defaults", call_defaults},
    {"scenes", call_scenes},
    {"pictures", call_pictures},
    {"frames at once", call_frames_at_once},
    {"pictures of mip levels", call_mip_pictures},
    {"finishing a frame", call_finish},
    {"a picture of the reference", call_reference},
};

int main(void) {
    return fp_walk_main(entries, sizeof entries / sizeof *entries, make_inputs, free_inputs);
}
