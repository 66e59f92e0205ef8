// A preview of a scene that is made in memory, for tests of the preview's loop. The preview runs on
// a fake display or on a display that the test opens. No function writes a file. All functions but
// dip_made_create_preview assert with cmocka that they succeed.
#ifndef DIP_TESTS_APP_PREVIEW_MADE_PREVIEW_H
#define DIP_TESTS_APP_PREVIEW_MADE_PREVIEW_H

#include "app/preview/loop/loop.h"
#include "renderer/catalogue/scenes.h"
#include "tests/app/display/fake_display.h"

typedef struct DipMadePreview {
    DipTestScene scene; // A plane to the horizon with a checker.
    DipSession session;
    DipCamPath *path; // The path of the category DEFAULT.
    DipDisplay display;
    DipFakeDisplay *fake; // Gives events to `display`; NULL if the test opens the display itself.
    DipPreview *preview;
    // The preview loads the scene again to measure errors, as if from a file scene.obj.
    bool scene_is_broken; // True if loading fails. A test may change it.
    int scene_reads;      // How often the preview has tried.
} DipMadePreview;

// The preview of the present test.
extern DipMadePreview made;

// --- opening and closing -------------------------------------------------------------------------

// Makes the session; display and preview do not exist yet. The pool has `threads` threads. The path
// has `key_count` keys that are 1 m apart (dip_made_path) and a field of view of 60 degrees.
// painters: how to make the painters of the panes, without their pool; NULL for the default
// settings.
void dip_made_open_session(int threads, int key_count,
                           const DipRendererDef painters[DIP_PANE_COUNT]);

// Returns a path that leads along the x axis from the scene's pose and back. It has one or two
// keys, `step_m` metres apart. Each way takes five seconds. The caller frees the path.
DipCamPath *dip_made_path(int key_count, double step_m);

// Opens the fake display with a size in pixels.
void dip_made_open_display(int width, int height);

// Creates the preview on made.display. The function fills in the session, the display, the speed
// and load_scene_def; all other fields are those of `def`, which may be NULL. Returns false and
// fills in *err if the preview cannot be created. err may be NULL.
bool dip_made_create_preview(const DipPreviewDef *def, DipError *err);

// Frees the preview, closes the display and frees the session, as tear-down of cmocka. There may be
// no preview and no display. Returns 0.
int dip_made_tear_down(void **unused);

// --- driving and looking -------------------------------------------------------------------------

// Runs a turn of the preview.
void dip_made_turn(void);

// Runs a turn. Then asserts that the fake display shows the whole picture that the preview drew, so
// that no damage was forgotten.
void dip_made_turn_shown(void);

// Presses a key on the fake display and calls dip_made_turn_shown.
void dip_made_press(DipKeycode key);

#endif
