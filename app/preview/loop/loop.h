// Runs the preview on any display: handles events, lets time pass, draws and presents.
//
// The owner calls dip_preview_turn until dip_preview_state(preview)->quit is true. A turn handles
// the events that have arrived, and draws and presents at most one frame. If the turn presented a
// frame, it then waits for the display's next refresh. Otherwise it waits a short time for an
// event, or not at all while there are prices to measure.
#ifndef DIP_APP_PREVIEW_LOOP_LOOP_H
#define DIP_APP_PREVIEW_LOOP_LOOP_H

#include "app/display/display.h"
#include "app/preview/tools/layout.h"
#include "app/preview/live/figures.h"
#include "app/preview/prices/prices.h"
#include "app/preview/state/state.h"
#include "app/session/session.h"

typedef struct DipPreview DipPreview;

// The preview's state and pictures, as a program that controls the preview sees them in a call.
typedef struct DipPreviewMoment {
    DipPreviewState *state; // The program may change it, as keys do.
    DipSession *session;
    const DipDisplay *display;
    const DipPaneFigures *figures; // Array with the figures of each pane.
    const DipPrices *prices;
    const DipFrame *panes; // Both panes' newest frames; rgba8 is NULL before the first ones.
    DipPixels picture;     // The display's picture that was drawn last.
    DipLayout layout;      // Where the panes and the dock lie now.
    bool drawn;            // The frames and the picture show everything that the state asks for.
    int64_t now_ns;
} DipPreviewMoment;

// Functions through which another program controls the preview (app/preview/control/control.h).
// NULL functions are not called.
typedef struct DipPreviewControl {
    void *context;
    // Called once in each turn, before drawing. Returns whether the program may have changed the
    // state.
    bool (*turn)(void *context, const DipPreviewMoment *moment);
    // Called when the user presses a mouse button, before the preview acts on it.
    void (*press)(void *context, const DipPreviewMoment *moment, const DipEvent *event);
} DipPreviewControl;

typedef struct DipPreviewDef {
    DipSession *session;       // Borrowed.
    DipDisplay display;        // Borrowed; the owner closes it after dip_preview_destroy.
    DipCostReport *costs;      // Borrowed; NULL if there is no cost report.
    struct DipReload *reload;  // Borrowed; with NULL, no files or animations can be opened.
    DipPrices *prices;         // Borrowed; with NULL, the preview makes prices of its own.
    bool measures_prices;      // Rough prices (live_prices.h) are measured while nothing moves.
    const char *cache;         // Borrowed folder of cached truths (truth.h), or NULL.
    DipPreviewControl control; // control.context is borrowed.
    double ui_scale;    // Value of --ui-scale, which enlarges controls; 0 without the option.
    bool hides_panel;   // The window shows nothing but the panes at first.
    const char *notice; // Notice that shows at first; may be NULL. Copied.

    // Loads session->scene_def, which is needed to measure errors (dip_session_keep_model). Called
    // only when the window, another program or prices first need errors, since loading takes time
    // and memory.
    bool (*load_scene_def)(DipSession *session, DipError *err);
} DipPreviewDef;

// Creates a preview. Fails with MISSING if the display needs a font and there is none, or with
// MEMORY.
DipPreview *dip_preview_create(const DipPreviewDef *def, DipError *err);
void dip_preview_destroy(DipPreview **preview);

// Runs one turn. Fails if drawing or presenting fails.
bool dip_preview_turn(DipPreview *preview, DipError *err);

const DipPreviewState *dip_preview_state(const DipPreview *preview);

// Returns where the panes and the dock lie now.
DipLayout dip_preview_layout(DipPreview *preview);

// Returns the picture that was drawn last. It has the display's size.
DipPixels dip_preview_picture(const DipPreview *preview);

#endif
