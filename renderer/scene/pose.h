// A pose: where the camera is, where it looks and how wide it sees.
//
// World space is right-handed with +Y up; its unit is the metre by convention. Camera space has +Y
// up too, and the camera looks along -Z.
#ifndef DIP_RENDERER_SCENE_POSE_H
#define DIP_RENDERER_SCENE_POSE_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct DipPose {
    double position_world[3];
    // Quaternion x, y, z, w that rotates camera space to world space. Any length but 0 is accepted;
    // drawing divides the quaternion by its length.
    double orientation[4];
    double fov_y_deg; // vertical field of view, 1..170
} DipPose;

// Checks that a picture can be drawn from a pose. Fails with RANGE if a number is not finite, the
// orientation is 0 or the field of view is out of range. Thread-safe.
DIP_API bool dip_pose_check(const DipPose *pose, DipError *err);

#ifdef __cplusplus
}
#endif

#endif
