// The pictures that the ini's keys MIPDEBUGBASE1024, MIPDEBUG512, ... show as mip levels.
#ifndef DIP_APP_SESSION_MIP_PICTURES_H
#define DIP_APP_SESSION_MIP_PICTURES_H

#include "app/session/session.h"

// Reads the pictures that the ini names and gives them to the renderers of both panes. Does nothing
// if the ini names no pictures. If a picture cannot be read, the error has the line of the ini that
// names this picture.
bool dip_mip_pictures_load(DipSession *session, DipErrorList *faults);

#endif
