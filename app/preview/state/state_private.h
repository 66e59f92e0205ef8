// Declares the actions that state_settings.c and pilot.c carry out. actions.c has the table of all
// actions.
#ifndef DIP_APP_PREVIEW_STATE_STATE_PRIVATE_H
#define DIP_APP_PREVIEW_STATE_STATE_PRIVATE_H

#include "app/preview/state/state.h"

static const int64_t dip_state_notice_ns = 2500000000; // How long a notice shows.

// The parameters of dip_preview_act, as each action's function gets them.
typedef struct DipAct {
    DipPreviewState *state;
    int argument;
    bool reverse;
    int64_t now_ns;
} DipAct;

// --- state_settings.c ----------------------------------------------------------------------------

// Takes the last change of settings back or, reversed, makes the change again that was taken back
// last.
void dip_state_undo(const DipAct *act);
// Gives the requested pane the settings of a preset, or shows a notice that says why the preset has
// none.
void dip_state_choose_preset(const DipAct *act);
// Gives a setting its next valid step (value) or, reversed, the valid step before, in the panes
// that the keys change. Steps wrap around.
void dip_state_change_setting(const DipAct *act);
// Chooses the panes that the keys change. The order is the requested pane, the current pane, both,
// and then the requested pane again.
void dip_state_choose_pane(const DipAct *act);
// Gives the current pane the requested settings.
void dip_state_apply(const DipAct *act);
// Gives the requested pane the settings that are advised for the budget. If nothing is advised, a
// notice says why. Reversed, first goes on to the next budget of dip_preview_budgets.
void dip_state_take_advice(const DipAct *act);

// --- pilot.c -------------------------------------------------------------------------------------

// Lets the next turn of the loop give the free camera the pose of its path. If the camera follows
// its path, only shows a notice.
void dip_pilot_reset(const DipAct *act);
// Makes the camera free. If it is free already, switches between dragging that turns it about a
// point and dragging that turns it on the spot.
void dip_pilot_orbit(const DipAct *act);
// Chooses what paths do at their end: goes on by act->argument (reversed: back) in the ring of
// DipCamPathEnd.
void dip_pilot_choose_end(const DipAct *act);
// Carries out an edit in the path editor (path_editor.h). Does nothing if there is no editor.
void dip_pilot_edit_path(const DipAct *act);

#endif
