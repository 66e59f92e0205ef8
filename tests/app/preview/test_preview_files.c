// Tests of the preview's files on a fake display: screenshots, saved poses, dropped files and files
// that change. The session is opened from an ini, a model and a path in a folder of the test's own.
#include "app/files/pictures.h"
#include "app/preview/state/poses.h"
#include "app/preview/loop/view.h"
#include "renderer/scene/motion.h"
#include "tests/app/preview/png_parts.h"
#include "tests/app/preview/wall_preview.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char *sources; // The root of the source tree.

// A text of the PNG file, which is valid until the next call.
static const char *text_of(const unsigned char *png, size_t size_bytes, const char *keyword) {
    static char text[1024];
    if (!png_text(png, size_bytes, keyword, text, sizeof text)) {
        fail_msg("the screenshot has no text '%s'", keyword);
    }
    return text;
}

// --- screenshots ---------------------------------------------------------------------------------

static void a_screenshot_tells_how_it_was_made(void **state) {
    (void)state;
    unsigned char *png;
    size_t size_bytes;
    char expected[1200];
    char hash[33];
    dip_wall_press('x', 0);
    dip_wall_press(DIP_KEYCODE_F12, 0);
    snprintf(expected, sizeof expected, "Saved diptych-0001.png in %s", wall.folder);
    assert_string_equal(dip_wall_notice(), expected);
    png_read("diptych-0001.png", &png, &size_bytes);
    assert_string_equal(text_of(png, size_bytes, "Software"), "Diptych " DIP_VERSION);
    assert_string_equal(text_of(png, size_bytes, "Scene"), "wall.obj");
    assert_string_equal(text_of(png, size_bytes, "Path"), "DEFAULT");
    assert_string_equal(text_of(png, size_bytes, "Pose"), "0 0 3 0 0 0 1");
    assert_string_equal(text_of(png, size_bytes, "Field of view"), "60");
    assert_string_equal(text_of(png, size_bytes, "Current size"), "200x150");
    assert_non_null(strstr(text_of(png, size_bytes, "Current settings"), "aa=none,"));
    assert_non_null(strstr(text_of(png, size_bytes, "Requested settings"), "aa=2,"));
    // The pose and the settings draw the frame with this hash.
    const DipPose pose = {
        .position_world = {0, 0, 3}, .orientation = {0, 0, 0, 1}, .fov_y_deg = 60};
    DipFrame frame;
    assert_true(dip_painter_draw(wall.session.renderers[DIP_PANE_REQUESTED], wall.session.scene,
                                 &pose, 0, &frame, NULL));
    dip_frame_hash(&frame, hash);
    assert_string_equal(text_of(png, size_bytes, "Requested hash"), hash);
    free(png);
}

static void a_plain_screenshot_has_no_overlay(void **state) {
    (void)state;
    unsigned char *png;
    unsigned char *expected;
    size_t size_bytes, expected_bytes;
    dip_wall_turn();
    dip_wall_press('c', 0);
    dip_wall_press(DIP_KEYCODE_F12, DIP_MODIFIER_SHIFT);
    dip_wall_assert_notice("Saved diptych-0001.png");
    png_read("diptych-0001.png", &png, &size_bytes);
    assert_string_equal(text_of(png, size_bytes, "Path"), "free camera");
    size_bytes = png_strip_texts(png, size_bytes);
    // Both panes show the wall, which fills them, so all pixels but the gap have its colour.
    const DipPose pose = {
        .position_world = {0, 0, 3}, .orientation = {0, 0, 0, 1}, .fov_y_deg = 60};
    DipFrame frame;
    assert_true(dip_painter_draw(wall.session.renderers[DIP_PANE_CURRENT], wall.session.scene,
                                 &pose, 0, &frame, NULL));
    static uint8_t both[DIP_WALL_HEIGHT][DIP_WALL_WIDTH][4];
    for (int y = 0; y < DIP_WALL_HEIGHT; ++y) {
        const uint8_t *row = frame.rgba8 + (size_t)y * frame.stride_bytes;
        memcpy(both[y][0], row, 800);
        memcpy(both[y][200], (const uint8_t[]){10, 11, 14, 255, 10, 11, 14, 255}, 8);
        memcpy(both[y][202], row, 800);
    }
    assert_true(dip_png_encode(both[0][0], sizeof both[0], DIP_WALL_WIDTH, DIP_WALL_HEIGHT,
                               &expected, &expected_bytes));
    assert_int_equal(size_bytes, expected_bytes);
    assert_memory_equal(png, expected, expected_bytes);
    free(png);
    free(expected);
}

// --- poses ---------------------------------------------------------------------------------------

static void saved_poses_make_a_path(void **state) {
    (void)state;
    DipCamPath *path;
    char expected[1200];
    dip_wall_turn();
    dip_wall_press('s', DIP_MODIFIER_CTRL);
    snprintf(expected, sizeof expected, "Saved pose 1 to poses.pth in %s", wall.folder);
    assert_string_equal(dip_wall_notice(), expected);
    dip_wall_press('s', DIP_MODIFIER_CTRL);
    dip_wall_assert_notice("Saved pose 2 to poses.pth");
    assert_true(dip_campath_load("poses.pth", &path, NULL));
    assert_int_equal(dip_campath_info(path).key_count, 2);
    const DipCamKey key = dip_campath_key(path, 1);
    assert_true(key.position_world[2] == 3.0 && key.orientation[3] == 1.0);
    dip_campath_destroy(&path);
}

// Numbers with all their digits come back as the same doubles, also after a last line without a
// line feed.
static void a_pose_is_saved_to_the_bit(void **state) {
    (void)state;
    const DipPose pose = {.position_world = {1.0 / 3.0, -1e-7, 12345.678901234567},
                          .orientation = {0.48, -0.6, 0.0, 0.64},
                          .fov_y_deg = 33.3};
    DipCamPath *path;
    DipError err = {0};
    size_t count = 0;
    dip_wall_write_file("own.pth",
                        "diptych-path 1\nperiod 2\n0 0 0 0.48 -0.6 0 0.64 # no line feed");
    assert_true(dip_poses_append("own.pth", &pose, &count, &err));
    assert_int_equal(count, 2);
    assert_true(dip_campath_load("own.pth", &path, &err));
    assert_int_equal(dip_campath_info(path).period_ns, INT64_C(2000000000));
    const DipCamKey key = dip_campath_key(path, 1);
    assert_memory_equal(key.position_world, pose.position_world, sizeof key.position_world);
    assert_memory_equal(key.orientation, pose.orientation, sizeof key.orientation);
    dip_campath_destroy(&path);
}

// A file that is no text path stays as it is.
static void other_files_are_not_touched(void **state) {
    (void)state;
    DipCamPath *path;
    DipError err = {0};
    size_t count = 0;
    const DipPose pose = {.orientation = {0, 0, 0, 1}, .fov_y_deg = 60};
    assert_true(dip_campath_load("still.pth", &path, &err));
    assert_true(dip_campath_save_bth(path, "binary.pth", &err));
    dip_campath_destroy(&path);
    assert_false(dip_poses_append("binary.pth", &pose, &count, &err));
    assert_true(dip_campath_load("binary.pth", &path, &err));
    dip_campath_destroy(&path);
    dip_wall_write_file("poses.pth", "a shopping list\n");
    dip_wall_turn();
    dip_wall_press('s', DIP_MODIFIER_CTRL);
    dip_wall_assert_notice("(poses.pth:1)");
    FILE *in = fopen("poses.pth", "r");
    char line[64];
    assert_true(in && fgets(line, sizeof line, in));
    assert_string_equal(line, "a shopping list\n");
    fclose(in);
}

// --- files that change ---------------------------------------------------------------------------

static void a_changed_texture_shows(void **state) {
    (void)state;
    dip_wall_turn();
    dip_wall_press(DIP_KEYCODE_SPACE, 0);
    dip_wall_assert_reddish(true);
    dip_wall_write_picture("wall.ppm", 40, 200, 40);
    dip_wall_wait_for("Reloaded wall.ppm");
    dip_wall_assert_reddish(false);
    assert_true(dip_preview_state(wall.preview)->paused);
}

// Nothing is read while the file changes at every look.
static void a_file_that_is_being_written_waits(void **state) {
    (void)state;
    dip_wall_turn();
    for (int i = 0; i < 8; ++i) {
        dip_wall_write_picture("wall.ppm", 40, 200 + i, 40);
        dip_fake_display_advance(wall.fake, 260000000);
        dip_wall_turn();
        assert_null(strstr(dip_wall_notice(), "Opening"));
        dip_wall_assert_reddish(true);
    }
    dip_wall_wait_for("Reloaded wall.ppm");
    dip_wall_assert_reddish(false);
}

static void the_users_settings_survive_a_reload(void **state) {
    (void)state;
    dip_wall_press('x', 0);
    dip_wall_write_picture("wall.ppm", 40, 200, 40);
    dip_wall_wait_for("Reloaded wall.ppm");
    const DipQuality *quality = dip_preview_state(wall.preview)->quality;
    assert_int_equal(quality[DIP_PANE_REQUESTED].step[DIP_SETTING_AA], 1);
    char text[512];
    snprintf(text, sizeof text, "%sREQUESTED: aa=8\n", dip_wall_ini);
    dip_wall_write_file("scene.ini", text);
    dip_wall_wait_for("Reloaded scene.ini");
    assert_int_equal(dip_quality_sample_count(&quality[DIP_PANE_REQUESTED]), 8);
    assert_int_equal(dip_quality_sample_count(&quality[DIP_PANE_CURRENT]), 1);
}

// A bad file is a notice; when it is mended, it shows.
static void bad_files_leave_what_is_shown(void **state) {
    (void)state;
    static const struct {
        const char *name;
        const char *bad;
        const char *part; // Of the notice.
    } files[] = {{"scene.ini", "RES: 200x150\nXFILE: wall.obj\nNONSENSE\n", "(scene.ini:3)"},
                 {"scene.ini", "RES: 200x150\nXFILE: none.obj\n", "none.obj"},
                 {"scene.ini", "", "scene.ini"},
                 {"still.pth", "diptych-path 1\nperiod 1\n0 0 nan 0 0 0 1\n", "(still.pth:3)"},
                 {"still.pth", "", "still.pth"},
                 {"wall.obj", "this is no model\n", "wall.obj"},
                 {"wall.obj", "v 0 0 0\nf 1 2 3\n", "wall.obj"},
                 {"wall.ppm", "P6 no picture", "wall.ppm"}};
    dip_wall_turn();
    for (size_t i = 0; i < sizeof files / sizeof files[0]; ++i) {
        dip_wall_write_file(files[i].name, files[i].bad);
        dip_wall_wait_for(files[i].part);
        dip_wall_wait_for_result();
        dip_wall_assert_notice(files[i].part);
        dip_wall_wait_seconds(11); // The notice goes away, and nothing is tried again.
        assert_string_equal(dip_wall_notice(), "");
        dip_wall_assert_reddish(true);
        dip_wall_write_files();
        dip_wall_wait_for("Reloaded");
        dip_wall_assert_reddish(true);
        dip_wall_wait_seconds(
            4); // The next file's notice is not taken for this one's, which names it, too.
    }
}

static void a_removed_file_leaves_what_is_shown(void **state) {
    (void)state;
    static const char *const names[] = {"wall.ppm", "wall.obj", "still.pth", "scene.ini"};
    dip_wall_turn();
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
        assert_int_equal(remove(names[i]), 0);
        dip_wall_wait_for(names[i]);
        dip_wall_wait_for_result();
        dip_wall_assert_notice(names[i]);
        assert_null(strstr(dip_wall_notice(), "Reloaded"));
        dip_wall_assert_reddish(true);
        dip_wall_write_files();
        dip_wall_wait_for("Reloaded");
        dip_wall_wait_seconds(4);
        dip_wall_assert_reddish(true);
    }
}

static void a_screenshot_does_not_reload(void **state) {
    (void)state;
    dip_wall_turn();
    dip_wall_press(DIP_KEYCODE_F12, 0);
    dip_wall_wait_seconds(4);
    assert_string_equal(dip_wall_notice(), "");
}

// --- dropped files -------------------------------------------------------------------------------

static void good_and_bad_drops_never_end_the_preview(void **state) {
    (void)state;
    dip_wall_write_file("near.pth", "diptych-path 1\nperiod 1\n0 0 2.5 0 0 0 1\n");
    dip_wall_write_file("near.bth", "\x89 no path");
    dip_wall_write_file("cut.json", "{\"header\":");
    dip_wall_write_file("empty.ini", "");
    dip_wall_write_file("binary.obj", "\x01\x02\x03");
    dip_wall_write_file("text.glb", "text");
    static const struct {
        const char *file;
        const char *part;
        bool good;
    } drops[] = {{"near.pth", "Opened near.pth", true},
                 {"near.bth", "near.bth", false},
                 {"none.pth", "none.pth", false},
                 {"triangle.obj", "Opened triangle.obj", true},
                 {"none.obj", "none.obj", false},
                 {"binary.obj", "binary.obj", false},
                 {"cut.json", "cut.json", false},
                 {"none.json", "none.json", false},
                 {"empty.ini", "empty.ini", false},
                 {"none.ini", "none.ini", false},
                 {"scene.ini", "Opened scene.ini", true},
                 {"text.glb", "text.glb", false},
                 {"still.pth", "Opened still.pth", true},
                 {"/", "/", false},
                 {"wall.mtl", "wall.mtl", false},
                 {"wall.obj", "Opened wall.obj", true},
                 {"scene.INI", "scene.INI", false},
                 {"wall.ppm", "wall.ppm", false},
                 {"", "", false},
                 {"scene.ini", "Opened scene.ini", true}};
    dip_wall_turn();
    dip_wall_wait_for("Reloaded"); // The folder's new models, so that no drop waits for them.
    dip_wall_wait_seconds(4);
    for (size_t i = 0; i < sizeof drops / sizeof drops[0]; ++i) {
        dip_wall_drop(drops[i].file);
        dip_wall_wait_for_result();
        dip_wall_assert_notice(drops[i].part);
        if ((strstr(dip_wall_notice(), "Opened") != NULL) != drops[i].good) {
            fail_msg("dropping '%s' says '%s'", drops[i].file, dip_wall_notice());
        }
        dip_wall_wait_seconds(4);
    }
    dip_wall_assert_reddish(true);
}

// Several files dropped at once are opened one after the other; the last one stays.
static void drops_are_opened_in_their_order(void **state) {
    (void)state;
    dip_wall_turn();
    dip_wall_press('c', 0);
    assert_true(dip_preview_state(wall.preview)->manual);
    dip_wall_drop("triangle.obj");
    dip_wall_drop("none.obj");
    dip_wall_drop("scene.ini");
    dip_wall_drop("still.pth");
    dip_wall_wait_for("Opened still.pth");
    assert_false(dip_preview_state(wall.preview)->manual);
    dip_wall_assert_reddish(true);
    assert_string_equal(wall.session.options->config, "scene.ini");
    assert_string_equal(wall.session.options->path, "still.pth");
    assert_int_equal(wall.session.options->model_count, 0);
}

// The preset "As at start" has the settings of the ini that was dropped last. A dropped path
// changes no settings.
static void as_at_start_follows_a_dropped_ini(void **state) {
    (void)state;
    static const char *const drops[] = {"other.ini", "still.pth"};
    char text[512];
    snprintf(text, sizeof text, "%sREQUESTED: aa=8,af=4\n", dip_wall_ini);
    dip_wall_write_file("other.ini", text);
    dip_wall_turn();
    for (size_t i = 0; i < sizeof drops / sizeof drops[0]; ++i) {
        DipQuality begun;
        dip_wall_drop(drops[i]);
        dip_wall_wait_for("Opened");
        dip_wall_press('x', 0);
        assert_true(dip_preview_preset(dip_preview_state(wall.preview), DIP_PRESET_INI, &begun));
        assert_int_equal(dip_quality_sample_count(&begun), 8);
        assert_int_equal(dip_quality_max_anisotropy(&begun), 4);
    }
}

static void a_flood_of_drops_is_refused(void **state) {
    (void)state;
    dip_wall_turn();
    int accepted = 0;
    for (int i = 0; i < 200; ++i) {
        accepted += dip_reload_drop(wall.reload, "none.obj");
    }
    assert_int_equal(accepted, 64);
    dip_wall_drop("none.obj");
    dip_wall_drop(NULL);
}

// The panel measures errors with the new scene after a reload.
static void errors_follow_the_new_scene(void **state) {
    (void)state;
    dip_wall_turn();
    dip_wall_press(DIP_KEYCODE_SPACE, 0);
    dip_wall_press('r', 0);
    dip_wall_wait_seconds(1);
    dip_wall_write_picture("wall.ppm", 40, 200, 40);
    dip_wall_wait_for("Reloaded wall.ppm");
    dip_wall_wait_seconds(1);
    assert_true(dip_preview_shows_times(dip_preview_state(wall.preview)));
}

// --- animations ----------------------------------------------------------------------------------

// Opens a model with three animations.
static void drop_crab(void) {
    char crab[1200];
    snprintf(crab, sizeof crab, "%s/assets/gallery/crab.md2", sources);
    dip_wall_drop(crab);
    dip_wall_wait_for("Opened crab.md2");
}

static void choose_animation(int index) {
    DipPreviewState *state = (DipPreviewState *)dip_preview_state(wall.preview);
    dip_preview_act(state, DIP_ACTION_ANIMATION, index, false, 0);
    dip_wall_turn();
}

static void assert_playing(int index, const char *clip) {
    const DipMotionDef *motion = wall.session.model ? wall.session.scene_def.motion : NULL;
    assert_int_equal(wall.session.animations.playing, index);
    assert_int_equal(dip_scene_moves(wall.session.scene), index >= 0);
    if (motion) {
        assert_string_equal(motion->rigs[0].clip, clip);
    }
}

static void the_user_chooses_an_animation_or_none(void **state) {
    (void)state;
    dip_wall_turn();
    assert_int_equal(wall.session.animations.count, 0);
    choose_animation(0);
    dip_wall_assert_notice("The models have no such animation");
    drop_crab();
    assert_int_equal(wall.session.animations.count, 3);
    assert_string_equal(wall.session.animations.names[1], "walk");
    assert_playing(0, "stand");
    const int64_t before_ns = dip_preview_state(wall.preview)->play_ns;
    choose_animation(1);
    assert_true(dip_preview_state(wall.preview)->opens_animation);
    dip_wall_wait_for("Animation: walk");
    assert_playing(1, "walk");
    assert_true(dip_preview_state(wall.preview)->play_ns >= before_ns);
    choose_animation(2);
    choose_animation(-1); // Of several choices the last one counts.
    for (int i = 0; i < DIP_WALL_MAX_TURNS && wall.session.animations.playing != -1; ++i) {
        dip_wall_wait_turn();
    }
    assert_playing(-1, NULL);
    assert_false(dip_preview_state(wall.preview)->opens_animation);
    assert_string_equal(wall.session.options->animation, "none");
    // Another model has other animations, so the choice does not stay.
    dip_wall_drop("triangle.obj");
    dip_wall_wait_for("Opened triangle.obj");
    assert_int_equal(wall.session.animations.count, 0);
    assert_null(wall.session.options->animation);
}

// Returns a number that tells pictures of the current pane apart. Leaves out the upper part with
// the label.
static uint64_t pane_now(void) {
    const DipPixels shown = dip_fake_display_picture(wall.fake);
    uint64_t sum = 0;
    for (int y = DIP_WALL_HEIGHT / 4; y < DIP_WALL_HEIGHT * 3 / 4; ++y) {
        const uint8_t *row = shown.rgba8 + (size_t)y * shown.stride_bytes;
        for (int i = 0; i < 4 * (DIP_WALL_WIDTH / 2 - 2); ++i) {
            sum = sum * 31 + row[i];
        }
    }
    return sum;
}

static bool pane_changes(void) {
    const uint64_t before = pane_now();
    bool changes = false;
    for (int i = 0; i < 60; ++i) {
        dip_wall_turn();
        changes |= pane_now() != before;
    }
    return changes;
}

// While the user's camera stands still, the model goes on moving until time is paused.
static void a_model_moves_before_the_free_camera(void **state) {
    (void)state;
    dip_wall_turn();
    drop_crab();
    choose_animation(1);
    dip_wall_wait_for("Animation: walk");
    dip_wall_press('c', 0);
    assert_true(dip_preview_state(wall.preview)->manual);
    dip_wall_wait_seconds(4); // The notice goes away.
    assert_true(pane_changes());
    dip_wall_press(DIP_KEYCODE_SPACE, 0);
    dip_wall_wait_seconds(4);
    assert_false(pane_changes());
    dip_wall_press(DIP_KEYCODE_SPACE, 0);
    dip_wall_press('c', 0); // A still model and a camera that follows its orbit.
    choose_animation(-1);
    dip_wall_wait_seconds(4);
    dip_wall_press('c', 0);
    dip_wall_wait_seconds(4);
    assert_false(pane_changes());
}

// A notice counts the pictures that a model lacks, whatever the words of their warnings are.
static void a_notice_counts_missing_pictures(void **state) {
    (void)state;
    dip_wall_write_file("bare.mtl",
                        "newmtl a\nKd 1 1 1\nmap_Kd none.ppm\nnewmtl b\nmap_Kd gone.png\n");
    dip_wall_write_file("bare.obj",
                        "mtllib bare.mtl\nv -1 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
                        "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 3/1 2/2 1/3\n");
    dip_wall_turn();
    dip_wall_drop("bare.obj");
    dip_wall_wait_for("Opened bare.obj, 2 pictures missing");
}

int main(int argc, char **argv) {
    sources = argc > 1 ? argv[1] : ".";
#define FILES_TEST(name) cmocka_unit_test_setup_teardown(name, dip_wall_set_up, dip_wall_tear_down)
    const struct CMUnitTest tests[] = {
        FILES_TEST(a_screenshot_tells_how_it_was_made),
        FILES_TEST(a_plain_screenshot_has_no_overlay),
        FILES_TEST(saved_poses_make_a_path),
        FILES_TEST(a_pose_is_saved_to_the_bit),
        FILES_TEST(other_files_are_not_touched),
        FILES_TEST(a_changed_texture_shows),
        FILES_TEST(a_file_that_is_being_written_waits),
        FILES_TEST(the_users_settings_survive_a_reload),
        FILES_TEST(bad_files_leave_what_is_shown),
        FILES_TEST(a_removed_file_leaves_what_is_shown),
        FILES_TEST(a_screenshot_does_not_reload),
        FILES_TEST(good_and_bad_drops_never_end_the_preview),
        FILES_TEST(drops_are_opened_in_their_order),
        FILES_TEST(as_at_start_follows_a_dropped_ini),
        FILES_TEST(a_flood_of_drops_is_refused),
        FILES_TEST(errors_follow_the_new_scene),
        FILES_TEST(the_user_chooses_an_animation_or_none),
        FILES_TEST(a_model_moves_before_the_free_camera),
        FILES_TEST(a_notice_counts_missing_pictures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
