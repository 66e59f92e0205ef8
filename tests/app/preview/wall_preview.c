// Opens the preview of a red wall and drives it on a fake display.
#include "tests/app/preview/wall_preview.h"

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

enum { BAR_HEIGHT = 32 }; // of the dock

DipWallPreview wall;

static char home[1024]; // The working folder before the test.

// --- files ---------------------------------------------------------------------------------------

void dip_wall_write_file(const char *name, const char *text) {
    FILE *out = fopen(name, "wb");
    assert_non_null(out);
    fputs(text, out);
    assert_int_equal(fclose(out), 0);
}

void dip_wall_write_picture(const char *name, int red, int green, int blue) {
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

const char dip_wall_ini[] = "RES: 200x150\nXFILE: wall.obj\nCAMPATH_DEFAULT: still.pth\n"
                            "CAMPATH_DEFAULT_FOV: 60\nTHREADS: 1\n";
const char dip_wall_still[] = "diptych-path 1\nperiod 1\n0 0 3 0 0 0 1\n";

// A square of 4 m by 4 m that faces the camera at z = 3 m.
static const char model[] = "mtllib wall.mtl\nv -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\n"
                            "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nusemtl paint\n"
                            "f 1/1/1 2/2/1 3/3/1 4/4/1\n";
static const char paint[] = "newmtl paint\nKd 1 1 1\nmap_Kd wall.ppm\n";
static const char triangle[] = "v -1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

void dip_wall_write_files(void) {
    dip_wall_write_file("scene.ini", dip_wall_ini);
    dip_wall_write_file("wall.obj", model);
    dip_wall_write_file("wall.mtl", paint);
    dip_wall_write_file("still.pth", dip_wall_still);
    dip_wall_write_file("triangle.obj", triangle);
    dip_wall_write_picture("wall.ppm", 200, 40, 40);
}

// --- opening -------------------------------------------------------------------------------------

static void open_session(void) {
    DipErrorList faults = {0};
    wall.options = (DipSessionOptions){.config = "scene.ini"};
    const DipSessionDef def = {.options = &wall.options, .scene = true, .renderers = true};
    if (!dip_session_open(&wall.session, &def, &faults)) {
        fail_msg("%s: %s", faults.items[0].file, faults.items[0].message);
    }
    dip_error_list_free(&faults);
}

int dip_wall_set_up(void **unused) {
    (void)unused;
    strcpy(wall.folder, "/tmp/diptych_wall.XXXXXX");
    assert_true(getcwd(home, sizeof home) && mkdtemp(wall.folder) && chdir(wall.folder) == 0);
    dip_wall_write_files();
    open_session();
    DipError err = {0};
    wall.fake = dip_fake_display_open(&wall.display, DIP_WALL_WIDTH, DIP_WALL_HEIGHT + BAR_HEIGHT);
    wall.reload = dip_reload_create(&wall.session, true, &err);
    assert_true(wall.fake && wall.reload);
    const DipPreviewDef def = {.session = &wall.session,
                               .display = wall.display,
                               .reload = wall.reload,
                               .load_scene_def = dip_session_keep_model};
    wall.preview = dip_preview_create(&def, &err);
    assert_non_null(wall.preview);
    return 0;
}

int dip_wall_tear_down(void **unused) {
    (void)unused;
    dip_preview_destroy(&wall.preview);
    dip_reload_destroy(&wall.reload);
    assert_ptr_equal(wall.session.options, &wall.options);
    wall.display.close(wall.display.context);
    dip_session_close(&wall.session);
    char command[128];
    assert_int_equal(chdir(home), 0);
    snprintf(command, sizeof command, "rm -rf '%s'", wall.folder);
    return system(command);
}

// --- driving -------------------------------------------------------------------------------------

void dip_wall_turn(void) {
    DipError err = {0};
    if (!dip_preview_turn(wall.preview, &err)) {
        fail_msg("%s", err.message);
    }
    assert_false(dip_preview_state(wall.preview)->quit);
}

void dip_wall_wait_turn(void) {
    const struct timespec millisecond = {0, 1000000};
    nanosleep(&millisecond, NULL);
    dip_wall_turn();
}

void dip_wall_press(DipKeycode key, unsigned modifiers) {
    dip_fake_display_press(wall.fake, key, modifiers);
    dip_wall_turn();
}

void dip_wall_drop(const char *file) {
    const DipEvent event = {.kind = DIP_EVENT_DROP, .file = file};
    dip_fake_display_push(wall.fake, &event);
    dip_wall_turn();
}

void dip_wall_wait_for(const char *part) {
    for (int i = 0; i < DIP_WALL_MAX_TURNS && !strstr(dip_wall_notice(), part); ++i) {
        dip_wall_wait_turn();
    }
    dip_wall_assert_notice(part);
}

// Returns whether a session is being opened, or the notice about it has not come yet.
static bool opens(void) {
    return !dip_wall_notice()[0] || strstr(dip_wall_notice(), "Opening ");
}

void dip_wall_wait_for_result(void) {
    for (int i = 0; i < DIP_WALL_MAX_TURNS && opens(); ++i) {
        dip_wall_wait_turn();
    }
    assert_null(strstr(dip_wall_notice(), "Opening "));
}

void dip_wall_wait_seconds(int seconds) {
    for (int i = 0; i < 60 * seconds; ++i) {
        // At rest, a turn takes hardly any real time, which the thread that opens a session needs.
        const struct timespec pause = {0, 500000};
        nanosleep(&pause, NULL);
        dip_wall_turn();
    }
}

// --- looking -------------------------------------------------------------------------------------

const char *dip_wall_notice(void) {
    return dip_preview_state(wall.preview)->notice;
}

void dip_wall_assert_notice(const char *part) {
    if (!strstr(dip_wall_notice(), part)) {
        fail_msg("the notice is '%s', expected '%s'", dip_wall_notice(), part);
    }
}

void dip_wall_middle(int rgb[3]) {
    const DipPixels shown = dip_fake_display_picture(wall.fake);
    const uint8_t *pixel = shown.rgba8 + (size_t)(DIP_WALL_HEIGHT / 2) * shown.stride_bytes +
                           4 * (size_t)(DIP_WALL_WIDTH / 4);
    for (int c = 0; c < 3; ++c) {
        rgb[c] = pixel[c];
    }
}

void dip_wall_assert_reddish(bool red) {
    int rgb[3];
    dip_wall_middle(rgb);
    if ((rgb[0] > 2 * rgb[1]) != red) {
        fail_msg("the wall has the colour %d %d %d", rgb[0], rgb[1], rgb[2]);
    }
}
