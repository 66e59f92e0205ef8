// Hands the preview over from one session to the next: what of the user's state stays, and what
// follows the new session.
#ifndef DIP_APP_PREVIEW_LOOP_HANDOVER_H
#define DIP_APP_PREVIEW_LOOP_HANDOVER_H

#include "app/preview/loop/reload.h"
#include "app/preview/state/state.h"
#include "app/session/session.h"

// Puts the reload's new session in the place of *session (dip_reload_take) and updates the state.
//
// first_quality: the settings of both panes with which the session began; updated. The settings
// that the user has chosen stay, unless the new session begins with others than the old one: then
// the user has changed the ini.
//
// dropped: the user has dropped the file. Then the camera begins the new path. Otherwise it stays
// where it is, on the same path at the same time.
//
// The caller has ended every thread that reads the old scene, and draws a frame before it shows
// anything, since the pixels of the old frames are gone.
void dip_handover(DipReload *reload, DipSession *session, DipPreviewState *state,
                  DipQuality first_quality[DIP_PANE_COUNT], bool dropped);

#endif
