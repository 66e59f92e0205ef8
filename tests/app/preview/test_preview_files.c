// Tests of the preview's files on a fake display: screenshots, saved poses, dropped files and files
// that change. The session is opened from an ini, a model and a path in a folder of the test's own.
#include "tests/app/display/fake_display.h"
#include "app/files/pictures.h"
#include "app/preview/loop/loop.h"
#include "app/preview/state/poses.h"
#include "app/preview/loop/reload.h"
#include "app/preview/loop/view.h"
#include "renderer/scene/motion.h"
#include "tests/app/preview/png_parts.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

// Size of the panes with their gap; the window also has the dock's bar.
enum { WIDTH = 402, HEIGHT = 150, BAR_HEIGHT = 32, MAX_TURNS = 120000 };

static const char *sources; // The root of the source tree.
static char home[1024];     // The working folder before the tests.
static char folder[] = "/tmp/test_preview_files.XXXXXX";
static DipSessionOptions options;
static DipSession session;
static DipDisplay display;
static DipReload *reload;
static DipFakeDisplay *fake;
static DipPreview *preview;

// --- the files -----------------------------------------------------------------------------------

static void write_file(const char *name, const char *text) {
    FILE *out = fopen(name, "wb");
    assert_non_null(out);
    fputs(text, out);
    assert_int_equal(fclose(out), 0);
}

// Writes a picture of one colour.
static void write_picture(const char *name, int red, int green, int blue) {
    FILE *out = fopen(name, "wb");
    assert_non_null(out);
    fprintf(out, "P6\n4 4\n255\n");
    for (int i = 0; i < 16; ++i) {
        fputc(red, out);
        fputc(green, out);
        fputc(blue, out);
    }
    assert_int_equal(fclose(out), 0);
}

// A square of 4 m by 4 m that faces the camera at z = 3 m.
static const char wall[] = "mtllib wall.mtl\nv -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\n"
                           "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nusemtl paint\n"
                           "f 1/1/1 2/2/1 3/3/1 4/4/1\n";
static const char paint[] = "newmtl paint\nKd 1 1 1\nmap_Kd wall.ppm\n";
static const char triangle[] = "v -1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
static const char ini[] = "RES: 200x150\nXFILE: wall.obj\nCAMPATH_DEFAULT: still.pth\n"
                          "CAMPATH_DEFAULT_FOV: 60\nTHREADS: 1\n";
static const char still[] = "diptych-path 1\nperiod 1\n0 0 3 0 0 0 1\n";
static const char nearer[] = "diptych-path 1\nperiod 1\n0 0 2.5 0 0 0 1\n";

static void write_files(void) {
    write_file("scene.ini", ini);
    write_file("wall.obj", wall);
    write_file("wall.mtl", paint);
    write_file("still.pth", still);
    write_file("triangle.obj", triangle);
    write_picture("wall.ppm", 200, 40, 40);
}

// --- the fixture ---------------------------------------------------------------------------------

static int set_up(void **state) {
    (void)state;
    strcpy(strrchr(folder, '.') + 1, "XXXXXX");
    assert_true(getcwd(home, sizeof home) && mkdtemp(folder) && chdir(folder) == 0);
    write_files();
    DipErrorList faults = {0};
    DipError err = {0};
    options = (DipSessionOptions){.config = "scene.ini"};
    const DipSessionDef session_def = {.options = &options, .scene = true, .renderers = true};
    if (!dip_session_open(&session, &session_def, &faults)) {
        fail_msg("%s: %s", faults.items[0].file, faults.items[0].message);
    }
    dip_error_list_free(&faults);
    fake = dip_fake_display_open(&display, WIDTH, HEIGHT + BAR_HEIGHT);
    reload = dip_reload_create(&session, true, &err);
    assert_true(fake && reload);
    const DipPreviewDef def = {.session = &session,
                               .display = display,
                               .reload = reload,
                               .flying_speed_m_per_s = 1.0,
                               .load_scene_def = dip_session_keep_model};
    preview = dip_preview_create(&def, &err);
    assert_non_null(preview);
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    dip_preview_destroy(&preview);
    dip_reload_destroy(&reload);
    assert_ptr_equal(session.options, &options);
    display.close(display.context);
    dip_session_close(&session);
    char command[1200];
    assert_int_equal(chdir(home), 0);
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    return system(command);
}

// --- driving -------------------------------------------------------------------------------------

static void turn(void) {
    DipError err = {0};
    if (!dip_preview_turn(preview, &err)) {
        fail_msg("%s", err.message);
    }
    assert_false(dip_preview_has_quit(preview));
}

static void press(DipKeycode key, unsigned modifiers) {
    dip_fake_display_press(fake, key, modifiers);
    turn();
}

static const char *notice(void) {
    return dip_preview_state(preview)->notice;
}

static void assert_notice(const char *part) {
    if (!strstr(notice(), part)) {
        fail_msg("the notice is '%s', expected '%s'", notice(), part);
    }
}

// Lets the clock of the display run until the notice contains a text. The fake clock and the thread
// that opens a session have different speeds, so every turn also waits a millisecond.
static void wait_for(const char *part) {
    for (int i = 0; i < MAX_TURNS && !strstr(notice(), part); ++i) {
        const struct timespec millisecond = {0, 1000000};
        nanosleep(&millisecond, NULL);
        turn();
    }
    assert_notice(part);
}

// Waits until the notice tells what came of an opening.
static void wait_for_result(void) {
    for (int i = 0; i < MAX_TURNS && (!notice()[0] || strstr(notice(), "Opening ")); ++i) {
        const struct timespec millisecond = {0, 1000000};
        nanosleep(&millisecond, NULL);
        turn();
    }
    assert_null(strstr(notice(), "Opening "));
}

// Lets some seconds of the display's clock pass. At rest, a turn takes hardly any real time, which
// the thread that opens a session needs.
static void wait_seconds(int seconds) {
    for (int i = 0; i < 60 * seconds; ++i) {
        const struct timespec pause = {0, 500000};
        nanosleep(&pause, NULL);
        turn();
    }
}

static void drop(const char *file) {
    const DipEvent event = {.kind = DIP_EVENT_DROP, .file = file};
    dip_fake_display_push(fake, &event);
    turn();
}

// The colour in the middle of the current pane.
static void middle(int rgb[3]) {
    const DipPixels shown = dip_fake_display_picture(fake);
    const uint8_t *pixel =
        shown.rgba8 + (size_t)(HEIGHT / 2) * shown.stride_bytes + 4 * (size_t)(WIDTH / 4);
    for (int c = 0; c < 3; ++c) {
        rgb[c] = pixel[c];
    }
}

static void assert_reddish(bool red) {
    int rgb[3];
    middle(rgb);
    if ((rgb[0] > 2 * rgb[1]) != red) {
        fail_msg("the wall has the colour %d %d %d", rgb[0], rgb[1], rgb[2]);
    }
}

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
    press('x', 0);
    press(DIP_KEYCODE_F12, 0);
    snprintf(expected, sizeof expected, "Saved diptych-0001.png in %s", folder);
    assert_string_equal(notice(), expected);
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
    assert_true(dip_painter_draw(session.renderers[DIP_PANE_REQUESTED], session.scene, &pose, 0,
                                 &frame, NULL));
    dip_frame_hash(&frame, hash);
    assert_string_equal(text_of(png, size_bytes, "Requested hash"), hash);
    free(png);
}

static void a_plain_screenshot_has_no_overlay(void **state) {
    (void)state;
    unsigned char *png;
    unsigned char *expected;
    size_t size_bytes, expected_bytes;
    turn();
    press('c', 0);
    press(DIP_KEYCODE_F12, DIP_MODIFIER_SHIFT);
    assert_notice("Saved diptych-0001.png");
    png_read("diptych-0001.png", &png, &size_bytes);
    assert_string_equal(text_of(png, size_bytes, "Path"), "free camera");
    size_bytes = png_strip_texts(png, size_bytes);
    // Both panes show the wall, which fills them, so all pixels but the gap have its colour.
    const DipPose pose = {
        .position_world = {0, 0, 3}, .orientation = {0, 0, 0, 1}, .fov_y_deg = 60};
    DipFrame frame;
    assert_true(dip_painter_draw(session.renderers[DIP_PANE_CURRENT], session.scene, &pose, 0,
                                 &frame, NULL));
    static uint8_t both[HEIGHT][WIDTH][4];
    for (int y = 0; y < HEIGHT; ++y) {
        const uint8_t *row = frame.rgba8 + (size_t)y * frame.stride_bytes;
        memcpy(both[y][0], row, 800);
        memcpy(both[y][200], (const uint8_t[]){10, 11, 14, 255, 10, 11, 14, 255}, 8);
        memcpy(both[y][202], row, 800);
    }
    assert_true(
        dip_png_encode(both[0][0], sizeof both[0], WIDTH, HEIGHT, &expected, &expected_bytes));
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
    turn();
    press('s', DIP_MODIFIER_CTRL);
    snprintf(expected, sizeof expected, "Saved pose 1 to poses.pth in %s", folder);
    assert_string_equal(notice(), expected);
    press('s', DIP_MODIFIER_CTRL);
    assert_notice("Saved pose 2 to poses.pth");
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
    write_file("own.pth", "diptych-path 1\nperiod 2\n0 0 0 0.48 -0.6 0 0.64 # no line feed");
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
    write_file("poses.pth", "a shopping list\n");
    turn();
    press('s', DIP_MODIFIER_CTRL);
    assert_notice("(poses.pth:1)");
    FILE *in = fopen("poses.pth", "r");
    char line[64];
    assert_true(in && fgets(line, sizeof line, in));
    assert_string_equal(line, "a shopping list\n");
    fclose(in);
}

// --- files that change ---------------------------------------------------------------------------

static void a_changed_texture_shows(void **state) {
    (void)state;
    turn();
    press(DIP_KEYCODE_SPACE, 0);
    assert_reddish(true);
    write_picture("wall.ppm", 40, 200, 40);
    wait_for("Reloaded wall.ppm");
    assert_reddish(false);
    assert_true(dip_preview_state(preview)->paused);
}

// Nothing is read while the file changes at every look.
static void a_file_that_is_being_written_waits(void **state) {
    (void)state;
    turn();
    for (int i = 0; i < 8; ++i) {
        write_picture("wall.ppm", 40, 200 + i, 40);
        dip_fake_display_advance(fake, 260000000);
        turn();
        assert_null(strstr(notice(), "Opening"));
        assert_reddish(true);
    }
    wait_for("Reloaded wall.ppm");
    assert_reddish(false);
}

static void the_users_settings_survive_a_reload(void **state) {
    (void)state;
    press('x', 0);
    write_picture("wall.ppm", 40, 200, 40);
    wait_for("Reloaded wall.ppm");
    const DipQuality *quality = dip_preview_state(preview)->quality;
    assert_int_equal(quality[DIP_PANE_REQUESTED].step[DIP_SETTING_AA], 1);
    char text[sizeof ini + 64];
    snprintf(text, sizeof text, "%sREQUESTED: aa=8\n", ini);
    write_file("scene.ini", text);
    wait_for("Reloaded scene.ini");
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
    turn();
    for (size_t i = 0; i < sizeof files / sizeof files[0]; ++i) {
        write_file(files[i].name, files[i].bad);
        wait_for(files[i].part);
        wait_for_result();
        assert_notice(files[i].part);
        wait_seconds(11); // The notice goes away, and nothing is tried again.
        assert_string_equal(notice(), "");
        assert_reddish(true);
        write_files();
        wait_for("Reloaded");
        assert_reddish(true);
        wait_seconds(4); // The next file's notice is not taken for this one's, which names it, too.
    }
}

static void a_removed_file_leaves_what_is_shown(void **state) {
    (void)state;
    static const char *const names[] = {"wall.ppm", "wall.obj", "still.pth", "scene.ini"};
    turn();
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
        assert_int_equal(remove(names[i]), 0);
        wait_for(names[i]);
        wait_for_result();
        assert_notice(names[i]);
        assert_null(strstr(notice(), "Reloaded"));
        assert_reddish(true);
        write_files();
        wait_for("Reloaded");
        wait_seconds(4);
        assert_reddish(true);
    }
}

static void a_screenshot_does_not_reload(void **state) {
    (void)state;
    turn();
    press(DIP_KEYCODE_F12, 0);
    wait_seconds(4);
    assert_string_equal(notice(), "");
}

// --- dropped files -------------------------------------------------------------------------------

static void good_and_bad_drops_never_end_the_preview(void **state) {
    (void)state;
    write_file("near.pth", nearer);
    write_file("near.bth", "\x89 no path");
    write_file("cut.json", "{\"header\":");
    write_file("empty.ini", "");
    write_file("binary.obj", "\x01\x02\x03");
    write_file("text.glb", "text");
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
    turn();
    wait_for("Reloaded"); // The folder's new models, so that no drop waits for them.
    wait_seconds(4);
    for (size_t i = 0; i < sizeof drops / sizeof drops[0]; ++i) {
        drop(drops[i].file);
        wait_for_result();
        assert_notice(drops[i].part);
        if ((strstr(notice(), "Opened") != NULL) != drops[i].good) {
            fail_msg("dropping '%s' says '%s'", drops[i].file, notice());
        }
        wait_seconds(4);
    }
    assert_reddish(true);
}

// Several files dropped at once are opened one after the other; the last one stays.
static void drops_are_opened_in_their_order(void **state) {
    (void)state;
    turn();
    press('c', 0);
    assert_true(dip_preview_state(preview)->manual);
    drop("triangle.obj");
    drop("none.obj");
    drop("scene.ini");
    drop("still.pth");
    wait_for("Opened still.pth");
    assert_false(dip_preview_state(preview)->manual);
    assert_reddish(true);
    assert_string_equal(session.options->config, "scene.ini");
    assert_string_equal(session.options->path, "still.pth");
    assert_int_equal(session.options->model_count, 0);
}

// The preset "As at start" has the settings of the ini that was dropped last. A dropped path
// changes no settings.
static void as_at_start_follows_a_dropped_ini(void **state) {
    (void)state;
    static const char *const drops[] = {"other.ini", "still.pth"};
    char text[sizeof ini + 64];
    snprintf(text, sizeof text, "%sREQUESTED: aa=8,af=4\n", ini);
    write_file("other.ini", text);
    turn();
    for (size_t i = 0; i < sizeof drops / sizeof drops[0]; ++i) {
        DipQuality begun;
        drop(drops[i]);
        wait_for("Opened");
        press('x', 0);
        assert_true(dip_preview_preset(dip_preview_state(preview), DIP_PRESET_INI, &begun));
        assert_int_equal(dip_quality_sample_count(&begun), 8);
        assert_int_equal(dip_quality_max_anisotropy(&begun), 4);
    }
}

static void a_flood_of_drops_is_refused(void **state) {
    (void)state;
    turn();
    int accepted = 0;
    for (int i = 0; i < 200; ++i) {
        accepted += dip_reload_drop(reload, "none.obj");
    }
    assert_int_equal(accepted, 64);
    drop("none.obj");
    drop(NULL);
}

// The panel measures errors with the new scene after a reload.
static void errors_follow_the_new_scene(void **state) {
    (void)state;
    turn();
    press(DIP_KEYCODE_SPACE, 0);
    press('r', 0);
    wait_seconds(1);
    write_picture("wall.ppm", 40, 200, 40);
    wait_for("Reloaded wall.ppm");
    wait_seconds(1);
    assert_true(dip_preview_shows_times(dip_preview_state(preview)));
}

// --- animations ----------------------------------------------------------------------------------

static void choose_animation(int index) {
    DipPreviewState *state = (DipPreviewState *)dip_preview_state(preview);
    dip_preview_act(state, DIP_ACTION_ANIMATION, index, false, 0);
    turn();
}

static void assert_playing(int index, const char *clip) {
    const DipMotionDef *motion = session.model ? session.scene_def.motion : NULL;
    assert_int_equal(session.animations.playing, index);
    assert_int_equal(dip_scene_moves(session.scene), index >= 0);
    if (motion) {
        assert_string_equal(motion->rigs[0].clip, clip);
    }
}

static void the_user_chooses_an_animation_or_none(void **state) {
    (void)state;
    char crab[1200];
    turn();
    assert_int_equal(session.animations.count, 0);
    choose_animation(0);
    assert_notice("The models have no such animation");
    snprintf(crab, sizeof crab, "%s/assets/gallery/crab.md2", sources);
    drop(crab);
    wait_for("Opened crab.md2");
    assert_int_equal(session.animations.count, 3);
    assert_string_equal(session.animations.names[1], "walk");
    assert_playing(0, "stand");
    const int64_t before_ns = dip_preview_state(preview)->play_ns;
    choose_animation(1);
    assert_true(dip_preview_state(preview)->opens_animation);
    wait_for("Animation: walk");
    assert_playing(1, "walk");
    assert_true(dip_preview_state(preview)->play_ns >= before_ns);
    choose_animation(2);
    choose_animation(-1); // Of several choices the last one counts.
    for (int i = 0; i < MAX_TURNS && session.animations.playing != -1; ++i) {
        const struct timespec millisecond = {0, 1000000};
        nanosleep(&millisecond, NULL);
        turn();
    }
    assert_playing(-1, NULL);
    assert_false(dip_preview_state(preview)->opens_animation);
    assert_string_equal(session.options->animation, "none");
    // Another model has other animations, so the choice does not stay.
    drop("triangle.obj");
    wait_for("Opened triangle.obj");
    assert_int_equal(session.animations.count, 0);
    assert_null(session.options->animation);
}

// Returns a number that tells pictures of the current pane apart. Leaves out the upper part with
// the label.
static uint64_t pane_now(void) {
    const DipPixels shown = dip_fake_display_picture(fake);
    uint64_t sum = 0;
    for (int y = HEIGHT / 4; y < HEIGHT * 3 / 4; ++y) {
        const uint8_t *row = shown.rgba8 + (size_t)y * shown.stride_bytes;
        for (int i = 0; i < 4 * (WIDTH / 2 - 2); ++i) {
            sum = sum * 31 + row[i];
        }
    }
    return sum;
}

static bool pane_changes(void) {
    const uint64_t before = pane_now();
    bool changes = false;
    for (int i = 0; i < 60; ++i) {
        turn();
        changes |= pane_now() != before;
    }
    return changes;
}

// While the user's camera stands still, the model goes on moving until time is paused.
static void a_model_moves_before_the_free_camera(void **state) {
    (void)state;
    char crab[1200];
    snprintf(crab, sizeof crab, "%s/assets/gallery/crab.md2", sources);
    turn();
    drop(crab);
    wait_for("Opened crab.md2");
    choose_animation(1);
    wait_for("Animation: walk");
    press('c', 0);
    assert_true(dip_preview_state(preview)->manual);
    wait_seconds(4); // The notice goes away.
    assert_true(pane_changes());
    press(DIP_KEYCODE_SPACE, 0);
    wait_seconds(4);
    assert_false(pane_changes());
    press(DIP_KEYCODE_SPACE, 0);
    press('c', 0); // A still model and a camera that follows its orbit.
    choose_animation(-1);
    wait_seconds(4);
    press('c', 0);
    wait_seconds(4);
    assert_false(pane_changes());
}

// A notice counts the pictures that a model lacks, whatever the words of their warnings are.
static void a_notice_counts_missing_pictures(void **state) {
    (void)state;
    write_file("bare.mtl", "newmtl a\nKd 1 1 1\nmap_Kd none.ppm\nnewmtl b\nmap_Kd gone.png\n");
    write_file("bare.obj", "mtllib bare.mtl\nv -1 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
                           "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 3/1 2/2 1/3\n");
    turn();
    drop("bare.obj");
    wait_for("Opened bare.obj, 2 pictures missing");
}

int main(int argc, char **argv) {
    sources = argc > 1 ? argv[1] : ".";
#define FILES_TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
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
