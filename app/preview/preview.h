// `diptych preview`: the window with both panes.
#ifndef DIP_APP_PREVIEW_PREVIEW_H
#define DIP_APP_PREVIEW_PREVIEW_H

#include "app/options.h"
#include "app/session.h"

// Shows the session until the user quits. Fails with RUNTIME when there is no display, MISSING when
// there is no font, or when drawing fails.
bool dip_preview_run(DipSession *session, const DipOptions *options, DipError *err);

#endif
