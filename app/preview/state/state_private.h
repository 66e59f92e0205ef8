// Declares the actions that change settings. actions.c carries out all actions and calls these
// functions, which state_settings.c defines.
#ifndef DIP_APP_PREVIEW_STATE_STATE_PRIVATE_H
#define DIP_APP_PREVIEW_STATE_STATE_PRIVATE_H

#include "app/preview/state/state.h"

static const int64_t dip_state_notice_ns = 2500000000; // How long a notice shows.

// Takes the last change of settings back or, if `reverse` is true, makes the change again that was
// taken back last.
void dip_state_undo(DipPreviewState *state, bool reverse, int64_t now_ns);
// Gives the requested pane the settings of a preset, or shows a notice that says why the preset has
// none.
void dip_state_choose_preset(DipPreviewState *state, DipPreset preset, int64_t now_ns);
// Gives a setting its next valid step (value) or, if `reverse` is true, the valid step before, in
// the panes that the keys change. Steps wrap around.
void dip_state_change_setting(DipPreviewState *state, DipSetting setting, bool reverse,
                              int64_t now_ns);
// Chooses the panes that the keys change. The order is the requested pane, the current pane, both,
// and then the requested pane again.
void dip_state_choose_pane(DipPreviewState *state, int64_t now_ns);
// Gives the current pane the requested settings.
void dip_state_apply(DipPreviewState *state, int64_t now_ns);
// Gives the requested pane the settings that are advised for the budget. If nothing is advised, a
// notice says why. With `other_budget`, first goes on to the next budget of dip_preview_budgets.
void dip_state_take_advice(DipPreviewState *state, bool other_budget, int64_t now_ns);

#endif
