// The camera that the user flies.
#ifndef DIP_APP_PREVIEW_CAMERA_H
#define DIP_APP_PREVIEW_CAMERA_H

#include "renderer/scene/pose.h"

#include <stdbool.h>

// Directions that the user steers in, -1..1 each.
typedef struct DipCameraKeys {
    double right;   // Keys D and A.
    double up;      // Keys Q and E.
    double forward; // Keys W and S.
    bool turn;      // Shift: the camera turns instead of moving.
} DipCameraKeys;

// Moves the camera along its own axes by speed * seconds, or turns it. Left and right turn about
// the world's vertical axis, forward and back about the camera's right axis, up and down about its
// line of sight. Returns whether the pose changed.
bool dip_camera_move(DipPose *pose, const DipCameraKeys *keys, double speed_m_per_s,
                     double seconds);

#endif
