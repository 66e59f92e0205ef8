// Matrices of the peer, from docs/picture.md and not from the renderer's code.
#ifndef DIP_TESTS_PEER_MATRICES_H
#define DIP_TESTS_PEER_MATRICES_H

#include "renderer/scene/pose.h"

#include <stdbool.h>

// World to clip space, row-major: clip z is near_m everywhere, clip w the distance along the view.
void dip_peer_world_to_clip(const DipPose *pose, double aspect, double near_m, double m[16]);

// m * transform, where transform is a 3x4 matrix with the last row (0, 0, 0, 1).
void dip_peer_place(const double m[16], const float transform[12], float product[16]);

// The inverse transpose of a transform's 3x3 part, to a positive factor. Returns whether the
// transform mirrors.
bool dip_peer_normal_matrix(const float transform[12], float normal_to_world[9]);

// False when the box lies outside one of the planes of what is seen and may be left out.
bool dip_peer_box_visible(const float to_clip[16], const float min[3], const float max[3]);

#endif
