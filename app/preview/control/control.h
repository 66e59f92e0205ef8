// Lets other programs control the preview through the control channel (app/control): carries out
// their requests as actions of the preview, and sends the events that they subscribe to.
#ifndef DIP_APP_PREVIEW_CONTROL_CONTROL_H
#define DIP_APP_PREVIEW_CONTROL_CONTROL_H

#include "app/preview/loop/loop.h"

typedef struct DipRemote DipRemote;

// Opens the channel. `where` is "-" for standard input and output, or the path of a socket. Fails
// as dip_control_open does.
DipRemote *dip_remote_open(const char *where, DipError *err);

// Closes the channel. *remote may be NULL and becomes NULL.
void dip_remote_close(DipRemote **remote);

// Returns the functions that the preview calls (loop.h). The remote must outlive the preview.
DipPreviewControl dip_remote_control(DipRemote *remote);

#endif
