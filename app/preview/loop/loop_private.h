// Defines the struct of a running preview, and declares the functions that one of the loop's files
// defines for the others.
//
// loop.c runs the turns (loop.h). The functions of the other files each do one part of a turn. All
// run on the thread that owns the preview. Unless a comment names errors, a function fails with the
// error of a function that it calls.
#ifndef DIP_APP_PREVIEW_LOOP_LOOP_PRIVATE_H
#define DIP_APP_PREVIEW_LOOP_LOOP_PRIVATE_H

#include "app/preview/state/controller.h"
#include "app/preview/live/error_thread.h"
#include "app/preview/live/figures.h"
#include "app/preview/state/keys.h"
#include "app/preview/live/live_prices.h"
#include "app/preview/loop/loop.h"
#include "app/preview/state/pilot.h"
#include "app/preview/loop/view.h"
#include "app/session/session.h"

#include <pthread.h>

// The settings opt=standard and opt=advanced need compressed textures. A thread makes these
// textures after the first picture shows, while further frames are drawn, so that a change to these
// settings delays no frame. A frame that needs the textures earlier waits for them.
typedef struct DipPrefetch {
    const DipScene *scene; // Borrowed; NULL before the thread is started.
    pthread_t thread;
    bool running;
} DipPrefetch;

// Everything that decides what the panes' pictures show, except what temporal antialiasing takes
// from the frame's number and from earlier frames.
typedef struct Drawn {
    DipPose pose;
    int64_t play_ns;
    DipQuality quality[DIP_PANE_COUNT];
    int width;
    int height;
    int look;
    const void *gallery;
} Drawn;

struct DipPreview {
    DipPreviewDef def;
    DipPreviewState state;
    DipView *view;
    DipPrices *prices;       // def.prices or, if that is NULL, prices that the preview owns.
    DipPreviewChoice choice; // The settings that can be chosen with the present prices (choice.h).
    DipLivePrices *live_prices;
    DipTools *tools;
    DipTextView text; // Used if the display shows characters.
    DipFigures figures;
    DipPrefetch prefetch;
    DipErrorThread *errors; // NULL until errors are first wanted.
    bool no_truth;          // `errors` could not be created, so prices have no errors.
    DipHeldKeys held;
    DipControllers controllers;
    int64_t turn_ns; // When the last turn began.
    int64_t refresh_ns;
    int64_t due_ns; // When the next frame is due.
    DipTaaPace taa_pace;
    bool full_screen;
    bool resized;   // The panes' size may have changed.
    int pane_width; // Size that the layout gave to the panes' frames in the last turn.
    int pane_height;
    int tried_width; // Size that the renderers got last, or could not get because memory ran out.
    int tried_height;
    int64_t blinks_ns; // When a blinking comparison next switches panes, or INT64_MAX.
    bool redraw;     // What shows over or beside the panes may have changed, so the window must be
                     // drawn.
    bool exposed;    // The display has lost its picture, so the whole picture must be presented.
    char title[128]; // The window's title.
    const void *judged_path;  // The path that played when state.stands was set.
    const void *judged_scene; // The scene that showed when state.stands was set.
    bool flying;              // The user or the path editor moved the camera in this turn.
    DipPose pose;             // Pose of the next frame.
    DipSessionFrame frame;    // The frame that was drawn last.
    uint64_t frame_index;
    unsigned drawn_changes;       // Value of state.scene_changes at the last frame.
    const DipCamPath *drawn_path; // The path that played in the last frame.
    int settling;                 // Frames to draw at rest until the panes' histories are complete.
    Drawn drawn;
    unsigned picture_number; // Number by which the error thread knows the panes' pictures; grows
                             // when `drawn` changes.
};

// After a stall, time moves on by at most this much, so that the camera does not jump.
enum { DIP_LOOP_LONGEST_STEP_NS = 250000000 };

// --- loop_draw.c ---------------------------------------------------------------------------------

// Draws the frames of both panes. If memory runs out for a new size or for new settings, a notice
// says so, and the panes keep the old size or settings. Fails with MISSING if there is no camera
// path and the user does not fly the camera.
bool dip_loop_draw_panes(DipPreview *preview, DipError *err);
// Returns whether a pane's sample patterns alternate (taa=alternate), so that its picture changes
// from frame to frame even at rest.
bool dip_loop_alternates(const DipPreview *preview);
// Returns whether frames at rest must still be added to a pane's history.
bool dip_loop_settles(const DipPreview *preview);
// Adds the pose of the last frame to the file of saved poses.
void dip_loop_save_pose(DipPreview *preview, int64_t now_ns);
// Draws the window and presents it. Saves a screenshot if the user asked for one.
bool dip_loop_show(DipPreview *preview, int64_t now_ns, DipError *err);
// Waits until the thread that prepares textures has ended.
void dip_prefetch_end(DipPrefetch *prefetch);

// --- loop_scene.c --------------------------------------------------------------------------------

// Tells the prices which scene the session shows now. Does nothing if the preview measures no
// prices.
void dip_loop_enter_scene(DipPreview *preview);
// Shows the scene, or the variant of the scene, that the user has asked for. If a scene cannot be
// opened, a notice says why and the old scene stays.
void dip_loop_follow_scene(DipPreview *preview, int64_t now_ns);
// Lets the reload (reload.h) work. A session or a cost report that the reload has opened replaces
// the old one.
void dip_loop_follow_reload(DipPreview *preview, int64_t now_ns);

// --- loop_measure.c ------------------------------------------------------------------------------

// Measures errors while the window, another program or the prices need them, and camera and scene
// rest. Returns whether the errors or their status are new.
bool dip_loop_measure_errors(DipPreview *preview, int64_t now_ns);
// Measures rough prices (live_prices.h) while camera and scene rest, and the dock (the panel with
// the controls) is open or another program has subscribed to prices. Returns whether the dock must
// be drawn again.
bool dip_loop_measure_prices(DipPreview *preview);

// --- loop.c --------------------------------------------------------------------------------------

int64_t dip_loop_clock_ns(const DipPreview *preview);
// Returns what the view (view.h) needs to draw the window now.
DipViewInput dip_loop_view_input(DipPreview *preview, int64_t now_ns);
// Shows a notice about an error that does not end the preview.
void dip_loop_report(DipPreview *preview, const DipError *err, int64_t now_ns);

#endif
