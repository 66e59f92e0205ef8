// The window with both panes, or the same in a terminal.
#ifndef DIP_APP_PREVIEW_PREVIEW_H
#define DIP_APP_PREVIEW_PREVIEW_H

#include "app/preview/options.h"
#include "app/session/session.h"

// Shows the session until the user quits. Fails with RUNTIME if there is no display, with MISSING
// if there is no font, or if drawing fails.
bool dip_preview_run(DipSession *session, const DipPreviewOptions *options, DipError *err);

#endif
