// Moves and turns the camera that the user flies.
#ifndef DIP_APP_PREVIEW_STATE_CAMERA_H
#define DIP_APP_PREVIEW_STATE_CAMERA_H

#include "renderer/scene/pose.h"

#include <stdbool.h>

// How strongly the user steers in each direction, from -1 to 1.
typedef struct DipCameraKeys {
    double right;   // Key D is 1, A is -1.
    double up;      // Key Q is 1, E is -1.
    double forward; // Key W is 1, S is -1.
    bool turn; // The camera turns instead of moving. The keyboard sets this while Shift is held.
} DipCameraKeys;

// Moves the camera along its own axes, by `seconds` times speed_m_per_s for a direction of 1, or
// turns the camera if keys->turn is set. Left and right turn the camera about the world's vertical
// axis. Forward and back turn the camera about its right axis, and up and down about its line of
// sight. Returns whether `keys` steers in any direction.
bool dip_camera_move(DipPose *pose, const DipCameraKeys *keys, double speed_m_per_s,
                     double seconds);

// Turns the camera by angles in degrees: to the right about the world's vertical axis, and upwards
// about the camera's right axis. Stops 1 degree before the camera looks straight up or down or, if
// it is rolled, 1 degree before it looks as far up or down as this turn can make it. A camera that
// lies on its side, with its right axis more than 45 degrees above or below the horizon, does not
// stop.
void dip_camera_look(DipPose *pose, double right_deg, double up_deg);

// Turns the camera about a point by angles in degrees, so that the point keeps its place in the
// picture: to the right about the vertical axis through the point, and upwards about the axis
// through the point that is parallel to the camera's right axis. Stops as dip_camera_look does.
void dip_camera_orbit(DipPose *pose, const double centre_world[3], double right_deg, double up_deg);

// Moves the camera to `factor` times its distance from a point. The factor must be above 0. Does
// nothing if the camera would come closer than 0.1 mm.
void dip_camera_zoom(DipPose *pose, const double centre_world[3], double factor);

// Writes the point on the camera's line of sight that is nearest to a given point, but at least
// `least_m` in front of the camera.
void dip_camera_point_ahead(const DipPose *pose, const double near_world[3], double least_m,
                            double ahead_world[3]);

#endif
