// The matrices of the peer (llvmpipe). They follow docs/picture.md and share no code with our
// renderer.
#ifndef DIP_TESTS_PEER_MATRICES_H
#define DIP_TESTS_PEER_MATRICES_H

#include "renderer/scene/pose.h"

#include <stdbool.h>

// Computes the matrix from world to clip space, row-major. Clip z is near_m everywhere; clip w is
// the distance along the view axis.
void dip_peer_world_to_clip(const DipPose *pose, double aspect, double near_m, double m[16]);

// Computes m * transform, where transform is a 3x4 matrix whose last row is (0, 0, 0, 1).
void dip_peer_place(const double m[16], const float transform[12], float product[16]);

// Computes the inverse transpose of a transform's 3x3 part, up to a positive factor. Returns true
// if the transform mirrors.
bool dip_peer_normal_matrix(const float transform[12], float normal_to_world[9]);

// Returns false if the whole box lies outside one of the view volume's planes, so that the box is
// invisible.
bool dip_peer_box_visible(const float to_clip[16], const float min[3], const float max[3]);

#endif
