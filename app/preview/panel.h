// A pane's figures and the lines that tell them; knows no window.
#ifndef DIP_APP_PREVIEW_PANEL_H
#define DIP_APP_PREVIEW_PANEL_H

#include "app/preview/live.h"
#include "renderer/scene/frame.h"

#include <stdbool.h>

enum {
#define DIP_STAGE_INDEX(name, text) DIP_STAGE_##name,
    DIP_STAGE_LIST(DIP_STAGE_INDEX)
#undef DIP_STAGE_INDEX
        DIP_STAGE_COUNT
};

// A pane's figures, as they are shown.
typedef struct DipPaneFigures {
    double ms; // median frame time
    double stage_ms[DIP_STAGE_COUNT];
    int fps; // frames shown in the last second; 0: not shown
    DipEffects effects;
    DipCounters counters;
    bool copied; // from the pane before, with the same settings
    DipLiveReading live;
} DipPaneFigures;

typedef struct DipPanelLine {
    bool head; // begins a part
    char name[32];
    char value[40];
} DipPanelLine;

enum { DIP_PANEL_MAX_LINES = 20 };

// The most important first, so that the last ones can be left out. Returns how many.
int dip_panel_lines(const DipPaneFigures *figures, int pane,
                    DipPanelLine lines[DIP_PANEL_MAX_LINES]);

#endif
