// What suits the free camera in a scene: its speed, and the point that it orbits.
#ifndef DIP_APP_PREVIEW_STATE_SPEED_H
#define DIP_APP_PREVIEW_STATE_SPEED_H

#include "app/session/session.h"

// Returns the speed in metres per second that suits what the session shows. If the user gave
// models, the camera crosses them in four seconds, whatever their unit of length is.
double dip_flying_speed(const DipSession *session);

// Returns whether dragging should orbit the scene: the user gave models to look at from all sides.
bool dip_flight_should_orbit(const DipSession *session);

// Writes the point that the camera orbits. It is the middle of the models that the user gave. In
// other scenes it is the point of the line of sight that is nearest to the middle of the scene, so
// that it lies in the middle of the picture.
void dip_orbit_centre(const DipSession *session, const DipPose *pose, double centre_world[3]);

#endif
