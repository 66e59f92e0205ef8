// The window with both panes.
#ifndef DIP_APP_PREVIEW_PREVIEW_H
#define DIP_APP_PREVIEW_PREVIEW_H

#include "app/preview/options.h"
#include "app/session.h"

// Shows the session until the user quits. Fails with RUNTIME when there is no display, with MISSING
// when there is no font, or with the error of drawing.
bool dip_preview_run(DipSession *session, const DipPreviewOptions *options, DipError *err);

#endif
