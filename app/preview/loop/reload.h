// Opens a new session beside the one that the preview shows, after the user has dropped a file onto
// the window or has chosen another animation or, with --watch, after a file of the session has
// changed. The new session replaces the old one when it is completely open. If it cannot be opened,
// the old one stays.
//
// Sessions are opened on a thread, so that the preview keeps running. All functions that this file
// declares must be called on the thread of the preview.
#ifndef DIP_APP_PREVIEW_LOOP_RELOAD_H
#define DIP_APP_PREVIEW_LOOP_RELOAD_H

#include "app/preview/prices/costs.h"
#include "app/preview/state/state.h"
#include "app/session/session.h"

typedef struct DipReload DipReload;

// The session is borrowed and must outlive the reload. With `watch`, the session is opened again
// when one of its files changes. Returns NULL when memory runs out.
DipReload *dip_reload_create(DipSession *session, bool watch, DipError *err);

// Waits for a session that is being opened, and closes it. The session that the preview shows stays
// open. This session points again to the options that the session had before the first reload.
void dip_reload_destroy(DipReload **reload);

// Accepts a file that the user has dropped: a camera path (.pth, .bth), a cost report (.json), an
// ini (.ini), or a model (any other name). The session then shows what it would show if the command
// line named the file: an ini replaces everything, a model replaces models, scene and path, and a
// path replaces the path. Files are opened in the order in which they are dropped. Returns false if
// too many files wait or memory runs out.
bool dip_reload_drop(DipReload *reload, const char *file);

// Lets dip_reload_poll open the session again with an animation of the models, or with "none". Of
// animations that wait to be opened, only the last one counts. Returns false if memory runs out.
bool dip_reload_animate(DipReload *reload, const char *animation);

typedef enum DipReloadKind {
    DIP_RELOAD_NOTHING, // There is no news.
    DIP_RELOAD_BEGUN,   // A session is being opened.
    DIP_RELOAD_SESSION, // A new session is open. Call dip_reload_take.
    DIP_RELOAD_COSTS,   // A new cost report is loaded.
    DIP_RELOAD_FAULT // Something could not be opened. The notice says why; the log has all errors
                     // of files.
} DipReloadKind;

typedef struct DipReloadNews {
    DipReloadKind kind;
    bool dropped;                 // The news is about a file that the user dropped.
    bool animated;                // The news is about the animation that the user chose last.
    bool warns;                   // With SESSION: the notice names warnings about the new session.
    char notice[DIP_NOTICE_SIZE]; // What to tell the user.
    const DipCostReport *costs;   // With COSTS: the report. Valid until the next one is loaded.
} DipReloadNews;

// Looks for changed files, and begins or finishes the opening of a session. Call it in every turn
// of the preview. Returns whether there is news. If a cost report is opened, `prices` takes prices
// from it. now_ns: time on the preview's clock.
bool dip_reload_poll(DipReload *reload, DipPrices *prices, int64_t now_ns, DipReloadNews *news);

// Puts the new session in the place of the old one, which is closed: nothing may use the old one's
// scene, frames and painters any more. The panes' settings are those with which the new session
// begins.
void dip_reload_take(DipReload *reload);

#endif
