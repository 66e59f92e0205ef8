// What the preview shows and what keys do to it; knows no window.
#ifndef DIP_APP_PREVIEW_STATE_H
#define DIP_APP_PREVIEW_STATE_H

#include "app/preview/costs.h"
#include "app/session.h"
#include "campaths/camtrack.h"
#include "renderer/scene/quality.h"

#include <stdbool.h>
#include <stdint.h>

// What a key can ask for. Arguments: a setting, a path's slot.
typedef enum DipAction {
    DIP_ACTION_SETTING,
    DIP_ACTION_NEXT_PANE,
    DIP_ACTION_APPLY,
    DIP_ACTION_PAUSE,
    DIP_ACTION_STEP,
    DIP_ACTION_STEP_BACK,
    DIP_ACTION_NEXT_PATH,
    DIP_ACTION_PREVIOUS_PATH,
    DIP_ACTION_PATH,
    DIP_ACTION_CAMERA,
    DIP_ACTION_HELP,
    DIP_ACTION_PANEL,
    DIP_ACTION_COSTS,
    DIP_ACTION_ADVICE,
    DIP_ACTION_SCREENSHOT,
    DIP_ACTION_FULL_SCREEN,
    DIP_ACTION_QUIT
} DipAction;

enum { DIP_NOTICE_SIZE = 160 };

typedef struct DipPreviewState {
    DipQuality quality[DIP_PANE_COUNT];
    bool edited[DIP_PANE_COUNT]; // keys act on these panes
    DipCamTrack *track;          // borrowed
    int64_t play_ns;             // never below 0
    int64_t step_ns;             // of one step
    bool paused;
    bool manual; // the user flies; the path's time stands still
    bool help;
    bool panel;            // times, errors and work of each pane
    const DipCosts *costs; // borrowed; NULL: there is no report
    bool show_costs;
    int next_advice; // of the costs'
    bool quit;
    bool full_screen;
    bool screenshot; // asked for; the window takes it and clears this
    char notice[DIP_NOTICE_SIZE];
    int64_t notice_end_ns;  // of the clock that `now_ns` comes from
    unsigned scene_changes; // counts what makes the panes' pictures change
} DipPreviewState;

// The requested pane is edited. track must outlive the state.
DipPreviewState dip_preview_state_make(const DipQuality quality[DIP_PANE_COUNT],
                                       DipCamTrack *track);

// reverse: Shift is held.
void dip_preview_act(DipPreviewState *state, DipAction action, int argument, bool reverse,
                     int64_t now_ns);

// Whether nothing moves the camera or the scene. flying: the user does.
bool dip_preview_rests(const DipPreviewState *state, bool flying);

// Lets time go by: moves the path on unless paused, and drops an old notice.
void dip_preview_advance(DipPreviewState *state, int64_t elapsed_ns, int64_t now_ns);

void dip_preview_notice(DipPreviewState *state, int64_t now_ns, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// The ini's name of a path slot: "DEFAULT", "AA", ...
const char *dip_preview_path_name(int slot);

// The path slot that shows a setting best, or -1 when none does.
int dip_preview_path_of(DipSetting setting);

// Settings in a few words, those at their default left out: "AA 4x  AF 16x". Cut at the size.
void dip_preview_describe(const DipQuality *quality, char *text, size_t size_bytes);

#endif
