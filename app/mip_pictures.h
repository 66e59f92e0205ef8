// The ini's MIPDEBUG* pictures, given to both renderers.
#ifndef DIP_APP_MIP_PICTURES_H
#define DIP_APP_MIP_PICTURES_H

#include "app/session.h"

// Does nothing when the ini names none. Faults are placed in the ini.
bool dip_mip_pictures_load(DipSession *session, DipErrorList *faults);

#endif
