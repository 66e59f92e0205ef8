// The camera that the user flies.
#ifndef DIP_APP_PREVIEW_CAMERA_H
#define DIP_APP_PREVIEW_CAMERA_H

#include "renderer/scene/pose.h"

#include <stdbool.h>

// How far the user steers in each direction, -1..1.
typedef struct DipCameraKeys {
    double right;   // Key D is 1, A is -1.
    double up;      // Key Q is 1, E is -1.
    double forward; // Key W is 1, S is -1.
    bool turn;      // Shift: the camera turns instead of moving.
} DipCameraKeys;

// Moves the camera along its own axes by speed_m_per_s * seconds, or turns the camera if `turn` is
// set. Left and right turn the camera about the world's vertical axis. Forward and back turn the
// camera about its right axis, and up and down about its line of sight. Returns whether the pose
// changed.
bool dip_camera_move(DipPose *pose, const DipCameraKeys *keys, double speed_m_per_s,
                     double seconds);

#endif
