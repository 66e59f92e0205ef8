// A preview of a red wall, for tests of the files of a session. The session is opened from an ini,
// a model and a camera path in a temporary folder, which is the working folder during a test. The
// preview shows the wall on a fake display and opens files again when they change. All functions
// assert with cmocka that they succeed.
#ifndef DIP_TESTS_APP_PREVIEW_WALL_PREVIEW_H
#define DIP_TESTS_APP_PREVIEW_WALL_PREVIEW_H

#include "app/preview/loop/loop.h"
#include "app/preview/loop/reload.h"
#include "tests/app/display/fake_display.h"

enum {
    DIP_WALL_WIDTH = 402,  // Width of both panes with their gap, in pixels.
    DIP_WALL_HEIGHT = 150, // Height of the panes. The dock's bar lies below them.
    // The number of turns after which a test gives up waiting for another thread.
    DIP_WALL_MAX_TURNS = 120000
};

typedef struct DipWallPreview {
    char folder[64];           // The temporary folder.
    DipSessionOptions options; // They name scene.ini.
    DipSession session;
    DipDisplay display;
    DipFakeDisplay *fake; // Gives events to `display` and tells what it shows.
    DipReload *reload;
    DipPreview *preview;
} DipWallPreview;

// The preview of the present test.
extern DipWallPreview wall;

// The texts of scene.ini and still.pth.
extern const char dip_wall_ini[];
extern const char dip_wall_still[];

// Make and free the preview, as set-up and tear-down of cmocka. The set-up writes the session's
// files into a new folder; the tear-down removes the folder with everything in it.
int dip_wall_set_up(void **unused);
int dip_wall_tear_down(void **unused);

// --- files ---------------------------------------------------------------------------------------

// Writes a text to a file.
void dip_wall_write_file(const char *name, const char *text);

// Writes a picture (PPM) of 4x4 pixels of one colour. The components are 0..255.
void dip_wall_write_picture(const char *name, int red, int green, int blue);

// Writes the session's files as they are at first: scene.ini, wall.obj, wall.mtl, wall.ppm and
// still.pth. Also writes triangle.obj, a model that the session does not use.
void dip_wall_write_files(void);

// --- driving -------------------------------------------------------------------------------------

// Runs a turn of the preview, which must not end the preview.
void dip_wall_turn(void);

// Waits a millisecond and runs a turn. The fake clock and the thread that opens a session have
// different speeds, so a test that waits for the thread calls this function again and again.
void dip_wall_wait_turn(void);

// Presses a key and runs a turn.
void dip_wall_press(DipKeycode key, unsigned modifiers);

// Drops a file onto the window and runs a turn. The file may be NULL, for a drop without a name.
void dip_wall_drop(const char *file);

// Runs turns until the notice contains a text.
void dip_wall_wait_for(const char *part);

// Runs turns until the notice tells what came of an opening.
void dip_wall_wait_for_result(void);

// Lets some seconds of the display's clock pass.
void dip_wall_wait_seconds(int seconds);

// --- looking -------------------------------------------------------------------------------------

// Returns the preview's notice, "" if there is none.
const char *dip_wall_notice(void);

// Asserts that the notice contains a text.
void dip_wall_assert_notice(const char *part);

// Gives the colour in the middle of the current pane.
void dip_wall_middle(int rgb[3]);

// Asserts that the middle of the current pane is red, or that it is not.
void dip_wall_assert_reddish(bool red);

#endif
