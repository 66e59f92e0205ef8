// The camera that the user flies.
#ifndef DIP_APP_PREVIEW_CAMERA_H
#define DIP_APP_PREVIEW_CAMERA_H

#include "renderer/scene/pose.h"

#include <stdbool.h>

// Which way the held keys point, -1..1 each.
typedef struct DipCameraKeys {
    double right;   // D, A
    double up;      // Q, E
    double forward; // W, S
    bool turn;      // Shift: turn instead of move
} DipCameraKeys;

// Moves along the camera's own axes by speed * seconds, or turns: left and right about the world's
// vertical, up and down about the camera's own right, Q and E about its line of sight.
// Returns whether the pose changed.
bool dip_camera_move(DipPose *pose, const DipCameraKeys *keys, double speed_m_per_s,
                     double seconds);

#endif
