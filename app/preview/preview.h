// Shows both panes in a window or in a terminal, as the options of `diptych preview` say.
#ifndef DIP_APP_PREVIEW_PREVIEW_H
#define DIP_APP_PREVIEW_PREVIEW_H

#include "app/cli/command.h"
#include "app/display/terminal/terminal_display.h"
#include "app/session/session.h"

#include <stdbool.h>

// The display that the user asks for.
typedef enum DipDisplayChoice {
    DIP_DISPLAY_AUTO, // A window or, if there is no display for one, the terminal.
    DIP_DISPLAY_WINDOW,
    DIP_DISPLAY_TERMINAL
} DipDisplayChoice;

// The values of the options. Models that are given as arguments are added to those of --model, in
// session.models.
typedef struct DipPreviewOptions {
    DipProgramOptions program;
    DipSessionOptions session;
    const char *cost_report;  // The scene's cost.json or its folder; NULL without --cost. Borrowed.
    double pixels_per_degree; // Viewing distance for FLIP (a perceptual error); 0 if not given.
    const char *cache;        // Folder of cached truths (truth.h); NULL without --cache. Borrowed.
    const char *control;      // "-" or a socket's path; NULL without --control. Borrowed.
    unsigned long window_id;  // X11 window to open the preview in; 0 means a window of its own.
    bool watch;               // The scene is loaded again when one of its files changes.
    int hides_panel;          // 1 with --panel off, otherwise 0.
    double ui_scale;          // Factor by which controls are enlarged; 0 without the option.
    DipDisplayChoice display;
    DipTerminalColours terminal_colours;
} DipPreviewOptions;

// Shows the session until the user or another program ends the preview. Fails if no display can be
// opened (RUNTIME) or a window has no font (MISSING), if the cost report, the cache of --cache or
// the control channel cannot be opened, or if drawing fails.
bool dip_preview_run(DipSession *session, const DipPreviewOptions *options, DipError *err);

#endif
