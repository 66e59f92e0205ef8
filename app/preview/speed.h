// The speed of the free camera.
#ifndef DIP_APP_PREVIEW_SPEED_H
#define DIP_APP_PREVIEW_SPEED_H

#include "app/session.h"

// Returns the speed in metres per second that suits what the session shows. If the user gave
// models, the camera crosses them in four seconds, whatever their unit of length is.
double dip_flying_speed(const DipSession *session);

#endif
