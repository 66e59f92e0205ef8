// A pane's figures, and the lines of text that show them.
#ifndef DIP_APP_PREVIEW_LIVE_PANEL_H
#define DIP_APP_PREVIEW_LIVE_PANEL_H

#include "app/preview/live/error_thread.h"
#include "app/preview/live/taa_pace.h"
#include "app/preview/live/timing.h"
#include "renderer/scene/frame.h"

#include <stdbool.h>

enum {
#define DIP_STAGE_INDEX(name, text) DIP_STAGE_##name,
    DIP_STAGE_LIST(DIP_STAGE_INDEX)
#undef DIP_STAGE_INDEX
        DIP_STAGE_COUNT
};

// The figures of a pane as the window shows them.
typedef struct DipPaneFigures {
    double ms;  // Median frame time of the last second in which frames were drawn.
    int frames; // Number of these frames. 1: the time is that of a single frame.
    double stage_ms[DIP_STAGE_COUNT];
    int fps; // Pictures shown in the last second; 0 if no rate is shown.
    DipEffects effects;
    DipCounters counters;
    bool copied; // The pane shows the other pane's picture, since the settings are the same.
    DipErrorReading errors;
    const DipTiming *times; // The newest frames' times; NULL if there are none. Borrowed.
    int dropped;            // Refreshes of the last 5 seconds of movement without a new picture.
    double budget_ms;       // Time between two refreshes of the display; 0 if it is not known.
    DipTaaSpeed taa_speed;  // Too slow only if the pane uses temporal antialiasing.
    bool mip_colours;       // The pane shows mip colours, which have no error.
    bool no_errors;         // The scene has no reference pictures, so the panel leaves errors out.
} DipPaneFigures;

typedef struct DipPanelLine {
    bool head; // The line begins a group of lines.
    char name[32];
    char value[40];
} DipPanelLine;

enum { DIP_PANEL_MAX_LINES = 24 };

// Fills in the panel's lines, the most important first, so that a caller with little room can leave
// out the last lines. Returns the number of lines.
int dip_panel_lines(const DipPaneFigures *figures, int pane,
                    DipPanelLine lines[DIP_PANEL_MAX_LINES]);

#endif
