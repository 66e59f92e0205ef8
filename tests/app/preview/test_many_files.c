// Drops 24 good and bad files onto the preview on a fake display, and puts each in the place of a
// file that the preview watches. The preview must live on, say what came of the file, and draw.
// Usage: test_many_files SOURCE_FOLDER
#include "app/report/format/formats.h"
#include "app/cost/plan.h"
#include "tests/app/cost/made_report.h"
#include "tests/app/preview/wall_preview.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

enum { MAX_FILE_BYTES = 1 << 22 };

static const char *sources; // The root of the source tree.

// --- the files -----------------------------------------------------------------------------------

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
    dip_cost_scene_name(&wall.session, report.scene);
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
    dip_wall_write_file("good.obj", "v -1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    dip_wall_write_file("bad.obj", "v 0 0 0\nf 1 2 3\n");
    dip_wall_write_file("good.pth", dip_wall_still);
    dip_wall_write_file("bad.pth", "diptych-path 1\nperiod 1\n0 0 nan 0 0 0 1\n");
    write_bth("good.bth");
    dip_wall_write_file("bad.bth", "\x89 no path");
    write_reports();
    dip_wall_write_file("cut.json", "{\"header\":");
    dip_wall_write_file("good.ini", dip_wall_ini);
    dip_wall_write_file("bad.ini", "RES: 200x150\nXFILE: wall.obj\nNONSENSE\n");
    dip_wall_write_picture("picture.png", 40, 200, 40); // A PNM by its content.
    dip_wall_write_file("empty.obj", "");
    assert_int_equal(mkdir("folder.obj", 0700), 0);
    // The file is bad for a user who may read it all the same, too.
    dip_wall_write_file("locked.pth", "diptych-path 0\n");
    assert_int_equal(chmod("locked.pth", 0), 0);
    assert_int_equal(mkfifo("pipe.obj", 0600), 0);
    assert_int_equal(mkfifo("pipe.ini", 0600), 0);
    write_noise("noise.glb");
    dip_wall_write_file("text.txt", "Dear reader,\n");
    memset(long_name, 'n', 251);
    strcpy(long_name + 251, ".obj");
    dip_wall_write_file(long_name, "v -1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
}

static int set_up(void **state) {
    const int failed = dip_wall_set_up(state);
    write_many_files();
    return failed;
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
    const int before = dip_fake_display_present_count(wall.fake);
    dip_fake_display_press(wall.fake, 'x', 0);
    dip_wall_turn();
    dip_wall_turn();
    assert_true(dip_fake_display_present_count(wall.fake) > before);
}

static void assert_result(const struct File *file, bool good, const char *verb) {
    if (!dip_wall_notice()[0] || (strncmp(dip_wall_notice(), verb, strlen(verb)) == 0) != good) {
        fail_msg("'%s' %s '%s': the notice is '%s'", file->name, verb,
                 file->watched ? file->watched : "", dip_wall_notice());
    }
}

static void many_dropped_files_never_end_the_preview(void **state) {
    (void)state;
    dip_wall_turn();
    for (int i = 0; i < FILE_COUNT; ++i) {
        dip_wall_drop(files[i].name);
        dip_wall_wait_for_result();
        assert_result(&files[i], files[i].good, "Opened ");
        assert_draws();
        dip_wall_drop("scene.ini");
        dip_wall_wait_for("Opened scene.ini");
        dip_wall_assert_reddish(true);
        dip_wall_wait_seconds(4);
        assert_string_equal(dip_wall_notice(), "");
    }
}

// Waits until the error map covers the panes.
static void wait_for_errors(void) {
    int rgb[3];
    dip_wall_middle(rgb);
    for (int i = 0; i < DIP_WALL_MAX_TURNS && rgb[0] > 2 * rgb[1]; ++i) {
        dip_wall_wait_turn();
        dip_wall_middle(rgb);
    }
    dip_wall_assert_reddish(false);
}

// The free camera rests, so that errors are measured. A dropped file ends the thread that measures
// them, and the camera flies on, so that no thread follows. AddressSanitizer sees who reads on.
static void a_dropped_file_takes_the_error_map_away(void **state) {
    (void)state;
    dip_wall_turn();
    dip_wall_assert_reddish(true);
    dip_fake_display_press(wall.fake, 'c', 0);
    dip_wall_turn();
    dip_fake_display_press(wall.fake, 'n', 0);
    dip_fake_display_press(wall.fake, 'y', 0); // Folds the dock, which covers the current pane.
    dip_wall_turn();
    dip_wall_assert_reddish(true);
    assert_int_equal(dip_preview_state(wall.preview)->tools.map, DIP_MAP_FLIP);
    wait_for_errors();
    dip_wall_drop("good.obj");
    dip_wall_wait_for("Opened ");
    assert_false(dip_preview_state(wall.preview)->manual);
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
    dip_wall_write_files();
}

static void many_watched_files_never_end_the_preview(void **state) {
    (void)state;
    dip_wall_turn();
    for (int i = 0; i < FILE_COUNT; ++i) {
        if (!files[i].watched) {
            continue;
        }
        replace(&files[i]);
        while (!dip_wall_notice()[0]) {
            dip_wall_wait_seconds(1);
        }
        dip_wall_wait_for_result();
        assert_result(&files[i], files[i].good_there, "Reloaded ");
        assert_draws();
        dip_wall_wait_seconds(4);
        assert_string_equal(dip_wall_notice(), "");
        put_back(&files[i]);
        dip_wall_wait_for("Reloaded");
        dip_wall_wait_seconds(4);
        dip_wall_assert_reddish(true);
    }
}

int main(int argc, char **argv) {
#define FILES_TEST(name) cmocka_unit_test_setup_teardown(name, set_up, dip_wall_tear_down)
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
