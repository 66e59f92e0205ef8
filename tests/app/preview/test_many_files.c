// Drops 24 good and bad files onto the preview on a fake display, and puts each in the place of a
// file that the preview watches. The preview must live on, say what came of the file, and draw.
// Usage: test_many_files SOURCE_FOLDER
#include "app/report/format/formats.h"
#include "app/cost/plan.h"
#include "tests/app/display/fake_display.h"
#include "app/preview/loop/loop.h"
#include "app/preview/loop/reload.h"
#include "tests/app/cost/made_report.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

// Size of the panes with their gap; the window also has the dock's bar.
enum { WIDTH = 402, HEIGHT = 150, BAR_HEIGHT = 32, MAX_TURNS = 120000, MAX_FILE_BYTES = 1 << 22 };

static const char *sources;
static char home[1024]; // The working folder before the tests.
static char folder[] = "/tmp/test_many_files.XXXXXX";
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
static const char ini[] = "RES: 200x150\nXFILE: wall.obj\nCAMPATH_DEFAULT: still.pth\n"
                          "CAMPATH_DEFAULT_FOV: 60\nTHREADS: 1\n";
static const char still[] = "diptych-path 1\nperiod 1\n0 0 3 0 0 0 1\n";

static void write_files(void) {
    write_file("scene.ini", ini);
    write_file("wall.obj", wall);
    write_file("wall.mtl", paint);
    write_file("still.pth", still);
    write_picture("wall.ppm", 200, 40, 40);
}

// Copies a file. A name that does not begin with '/' belongs to the folder of the test.
static void copy_file(const char *from, const char *to) {
    static char bytes[MAX_FILE_BYTES];
    FILE *in = fopen(from, "rb");
    FILE *out = fopen(to, "wb");
    assert_true(in && out);
    const size_t size_bytes = fread(bytes, 1, sizeof bytes, in);
    assert_true(size_bytes < sizeof bytes);
    assert_int_equal(fwrite(bytes, 1, size_bytes, out), size_bytes);
    assert_true(fclose(in) == 0 && fclose(out) == 0);
}

static void copy_source(const char *source, const char *to) {
    char from[1200];
    snprintf(from, sizeof from, "%s/%s", sources, source);
    copy_file(from, to);
}

static void write_noise(const char *name) {
    FILE *out = fopen(name, "wb");
    uint32_t random = 1;
    assert_non_null(out);
    for (int i = 0; i < 65536; ++i) {
        random = random * 1664525u + 1013904223u;
        fputc((int)(random >> 24), out);
    }
    assert_int_equal(fclose(out), 0);
}

// Writes cost.json, a report of the scene that the session shows, and old.json, the same report of
// an unknown version.
static void write_reports(void) {
    DipCostReport report;
    dip_made_report(&report, 3);
    dip_cost_scene_name(&session, report.scene);
    assert_true(dip_cost_write_json(&report, "cost.json", NULL));
    dip_cost_report_free(&report);
    copy_file("cost.json", "old.json");
    assert_int_equal(system("sed -i 's/\"format\": *[0-9]*/\"format\": 999/' old.json"), 0);
}

// Writes the path of still.pth in binary form: its numbers are little-endian.
static void write_bth(const char *name) {
    static const unsigned char bytes[80] = {
        0x89,        'D',         'I',         'P',         'B', 'T', 'H', '\n', // The magic.
        1,           0,           0,           0,           1,   0,   0,   0, // Version 1, one key.
        0,           0xca,        0x9a,        0x3b,                          // 1 s
        [46] = 0x08, [47] = 0x40, [78] = 0xf0, [79] = 0x3f,                   // z is 3, qw is 1.
    };
    FILE *out = fopen(name, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(bytes, 1, sizeof bytes, out), sizeof bytes);
    assert_int_equal(fclose(out), 0);
}

static char long_name[300]; // The longest name that a file can have.

static void write_many_files(void) {
    copy_source("assets/gallery/pump.glb", "pump.glb");
    copy_source("assets/gallery/crab.md2", "crab.md2");
    copy_source("tests/assets/data/square.x", "square.x");
    copy_source("tests/assets/data/bad_truncated.x", "cut.x");
    write_file("good.obj", "v -1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write_file("bad.obj", "v 0 0 0\nf 1 2 3\n");
    write_file("good.pth", still);
    write_file("bad.pth", "diptych-path 1\nperiod 1\n0 0 nan 0 0 0 1\n");
    write_bth("good.bth");
    write_file("bad.bth", "\x89 no path");
    write_reports();
    write_file("cut.json", "{\"header\":");
    write_file("good.ini", ini);
    write_file("bad.ini", "RES: 200x150\nXFILE: wall.obj\nNONSENSE\n");
    write_picture("picture.png", 40, 200, 40); // A PNM by its content.
    write_file("empty.obj", "");
    assert_int_equal(mkdir("folder.obj", 0700), 0);
    write_file("locked.pth", "diptych-path 0\n"); // Bad for a user who may read it all the same.
    assert_int_equal(chmod("locked.pth", 0), 0);
    assert_int_equal(mkfifo("pipe.obj", 0600), 0);
    assert_int_equal(mkfifo("pipe.ini", 0600), 0);
    write_noise("noise.glb");
    write_file("text.txt", "Dear reader,\n");
    memset(long_name, 'n', 251);
    strcpy(long_name + 251, ".obj");
    write_file(long_name, "v -1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
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
    write_many_files();
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

// Lets some seconds of the display's clock pass.
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

// --- tests ---------------------------------------------------------------------------------------

// What the file is put in the place of, for --watch.
static const struct File {
    const char *name;
    bool good;           // Dropped, the file opens.
    const char *watched; // The watched file that it replaces; NULL: nothing of its kind is watched.
    bool good_there;     // In that place, the file loads.
} files[] = {
    {"pump.glb", true, "wall.obj", false},   {"crab.md2", true, "wall.obj", false},
    {"square.x", true, "wall.obj", false},   {"cut.x", false, "wall.obj", false},
    {"good.obj", true, "wall.obj", true},    {"bad.obj", false, "wall.obj", false},
    {"good.pth", true, "still.pth", true},   {"bad.pth", false, "still.pth", false},
    {"good.bth", true, "still.pth", true},   {"bad.bth", false, "still.pth", false},
    {"cost.json", true, NULL, false},        {"old.json", false, NULL, false},
    {"cut.json", false, NULL, false},        {"good.ini", true, "scene.ini", true},
    {"bad.ini", false, "scene.ini", false},  {"picture.png", false, "wall.ppm", true},
    {"empty.obj", false, "wall.obj", false}, {"folder.obj", false, "wall.obj", false},
    {"none.pth", false, "still.pth", false}, {"locked.pth", false, "still.pth", false},
    {long_name, true, "wall.obj", true},     {"pipe.obj", false, "wall.obj", false},
    {"pipe.ini", false, "scene.ini", false}, {"noise.glb", false, "wall.ppm", false},
    {"text.txt", false, "still.pth", false},
};

enum { FILE_COUNT = sizeof files / sizeof files[0] };

// Asserts that a key still changes what both panes show.
static void assert_draws(void) {
    const int before = dip_fake_display_present_count(fake);
    dip_fake_display_press(fake, 'x', 0);
    turn();
    turn();
    assert_true(dip_fake_display_present_count(fake) > before);
}

static void assert_result(const struct File *file, bool good, const char *verb) {
    if (!notice()[0] || (strncmp(notice(), verb, strlen(verb)) == 0) != good) {
        fail_msg("'%s' %s '%s': the notice is '%s'", file->name, verb,
                 file->watched ? file->watched : "", notice());
    }
}

static void many_dropped_files_never_end_the_preview(void **state) {
    (void)state;
    turn();
    for (int i = 0; i < FILE_COUNT; ++i) {
        drop(files[i].name);
        wait_for_result();
        assert_result(&files[i], files[i].good, "Opened ");
        assert_draws();
        drop("scene.ini");
        wait_for("Opened scene.ini");
        assert_reddish(true);
        wait_seconds(4);
        assert_string_equal(notice(), "");
    }
}

// Waits until the error map covers the panes.
static void wait_for_errors(void) {
    int rgb[3];
    middle(rgb);
    for (int i = 0; i < MAX_TURNS && rgb[0] > 2 * rgb[1]; ++i) {
        const struct timespec millisecond = {0, 1000000};
        nanosleep(&millisecond, NULL);
        turn();
        middle(rgb);
    }
    assert_reddish(false);
}

// The free camera rests, so that errors are measured. A dropped file ends the thread that measures
// them, and the camera flies on, so that no thread follows. AddressSanitizer sees who reads on.
static void a_dropped_file_takes_the_error_map_away(void **state) {
    (void)state;
    turn();
    assert_reddish(true);
    dip_fake_display_press(fake, 'c', 0);
    turn();
    dip_fake_display_press(fake, 'n', 0);
    dip_fake_display_press(fake, 'y', 0); // Folds the dock, which covers the current pane.
    turn();
    assert_reddish(true);
    assert_int_equal(dip_preview_state(preview)->tools.map, DIP_MAP_FLIP);
    wait_for_errors();
    drop("good.obj");
    wait_for("Opened ");
    assert_false(dip_preview_state(preview)->manual);
    assert_draws();
}

// Puts the file in the place of the watched one in a single step, as editors do. Without such a
// file, removes the watched one.
static void replace(const struct File *file) {
    struct stat status;
    char command[1200];
    if (stat(file->name, &status) != 0) {
        assert_int_equal(remove(file->watched), 0);
        return;
    }
    assert_int_equal(remove(file->watched), 0);
    snprintf(command, sizeof command, "cp -R '%s' new && mv new '%s'", file->name, file->watched);
    assert_int_equal(system(command), 0);
}

static void put_back(const struct File *file) {
    char command[1200];
    snprintf(command, sizeof command, "rm -rf '%s'", file->watched);
    assert_int_equal(system(command), 0);
    write_files();
}

static void many_watched_files_never_end_the_preview(void **state) {
    (void)state;
    turn();
    for (int i = 0; i < FILE_COUNT; ++i) {
        if (!files[i].watched) {
            continue;
        }
        replace(&files[i]);
        while (!notice()[0]) {
            wait_seconds(1);
        }
        wait_for_result();
        assert_result(&files[i], files[i].good_there, "Reloaded ");
        assert_draws();
        wait_seconds(4);
        assert_string_equal(notice(), "");
        put_back(&files[i]);
        wait_for("Reloaded");
        wait_seconds(4);
        assert_reddish(true);
    }
}

int main(int argc, char **argv) {
#define FILES_TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        FILES_TEST(a_dropped_file_takes_the_error_map_away),
        FILES_TEST(many_dropped_files_never_end_the_preview),
        FILES_TEST(many_watched_files_never_end_the_preview),
    };
    if (argc != 2) {
        return 2;
    }
    sources = argv[1];
    return cmocka_run_group_tests(tests, NULL, NULL);
}
