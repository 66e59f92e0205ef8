// Where the camera is and what it sees.
//
// World space is right-handed, +Y up, in metres by convention. The camera looks along its own -Z
// with +Y up; orientation turns camera space into world space.
#ifndef DIP_RENDERER_SCENE_POSE_H
#define DIP_RENDERER_SCENE_POSE_H

#ifdef __cplusplus
extern "C" {
#endif

typedef struct DipPose {
    double position_world[3];
    double orientation[4]; // unit quaternion x, y, z, w
    double fov_y_deg;      // vertical field of view, 1..170
} DipPose;

#ifdef __cplusplus
}
#endif

#endif
