// A pose: where the camera is, where it looks and how wide it sees.
//
// World space is right-handed with +Y up; its unit is the metre by convention. Camera space has +Y
// up too, and the camera looks along -Z.
#ifndef DIP_RENDERER_SCENE_POSE_H
#define DIP_RENDERER_SCENE_POSE_H

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

#ifdef __cplusplus
}
#endif

#endif
