// A rig: nodes that move one another, tracks that say how a clip moves the nodes, and skins whose
// joints are nodes. glTF files describe their animations so, and the formulas are those of the glTF
// 2.0 specification, appendix C.
//
// Everything is computed in double precision with operations that have the same bits on every
// machine. A matrix is the rows of a 3x4 matrix, whose fourth row is 0, 0, 0, 1.
#ifndef DIP_RENDERER_SCENE_RIG_H
#define DIP_RENDERER_SCENE_RIG_H

#include "renderer/base/api.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { DIP_NO_NODE = -1, DIP_NO_SKIN = -1 };

// Which property of a node a track moves.
typedef enum DipTrackTarget {
    DIP_TRACK_TRANSLATION,
    DIP_TRACK_ROTATION,
    DIP_TRACK_SCALE,
    DIP_TRACK_WEIGHTS // the weights of the node's morph targets
} DipTrackTarget;

typedef enum DipInterpolation {
    DIP_INTERPOLATION_STEP,
    DIP_INTERPOLATION_LINEAR,
    DIP_INTERPOLATION_CUBICSPLINE
} DipInterpolation;

// The values of one property over time. Before the first key and after the last one, the value of
// this key holds. Rotations are interpolated along the shorter way.
typedef struct DipTrack {
    DipTrackTarget target;
    DipInterpolation interpolation;
    int node;
    int width;           // Numbers of a value: 3, 4 (rotation) or the number of morph targets.
    uint32_t key_count;  // At least 1.
    const float *times;  // In seconds, ascending.
    const float *values; // One per key; CUBICSPLINE: in-tangent, value and out-tangent per key.
} DipTrack;

// A node at rest. A node with a matrix has no tracks except for weights.
typedef struct DipRigNode {
    int parent; // Index of a node that comes before this one, or DIP_NO_NODE.
    bool has_matrix;
    double matrix[12];
    double translation[3];
    double rotation[4]; // quaternion x, y, z, w of any length
    double scale[3];
    int first_weight; // Index of the node's first morph weight among those of all nodes.
    int weight_count;
} DipRigNode;

typedef struct DipRigSkin {
    int joint_count;
    const int *nodes;            // The node of each joint.
    const double *inverse_binds; // A matrix for each joint.
} DipRigSkin;

typedef struct DipRig {
    const DipRigNode *nodes;
    int node_count;
    const float *rest_weights; // The morph weights of all nodes at rest.
    int weight_count;
} DipRig;

// Returns the number of floats in the values of a track.
DIP_API size_t dip_track_value_count(const DipTrack *track);

// to = a * b. `to` is neither a nor b.
DIP_API void dip_rig_multiply(const double a[12], const double b[12], double to[12]);

// Computes the transform of a node at rest relative to its parent.
DIP_API void dip_rig_local(const DipRigNode *node, double local[12]);

// Computes the world transform of a node at a time of the tracks, which may be only those that move
// the node or the nodes above it.
DIP_API void dip_rig_place_node(const DipRig *rig, const DipTrack *tracks, int track_count,
                                int node, double time_s, double world[12]);

// Returns the time within a clip that repeats: 0 up to duration_s. A time that is not finite counts
// as 0.
DIP_API double dip_rig_wrap_time(double time_s, double duration_s);

// All nodes of a rig at one time. Not thread-safe: each thread uses poses of its own.
typedef struct DipRigPose DipRigPose;

// Makes a pose of the rig at rest. The rig's arrays are borrowed until the pose is destroyed.
// Returns NULL if memory runs out.
DIP_API DipRigPose *dip_rig_pose_create(const DipRig *rig);
// *pose may be NULL and becomes NULL.
DIP_API void dip_rig_pose_destroy(DipRigPose **pose);

// Moves the rig to a time of the tracks, or to rest if there are none. Allocates nothing.
DIP_API void dip_rig_pose_set(DipRigPose *pose, const DipTrack *tracks, int track_count,
                              double time_s);

// Return the world transform of a node, and the weights of its morph targets. The results belong to
// the pose and change with the next dip_rig_pose_set.
DIP_API const double *dip_rig_pose_world(const DipRigPose *pose, int node);
DIP_API const double *dip_rig_pose_weights(const DipRigPose *pose, int node);

// Writes the matrices of a skin's joints, each of which takes a vertex of the shape to the world.
DIP_API void dip_rig_pose_joints(const DipRigPose *pose, const DipRigSkin *skin, float *to);

#ifdef __cplusplus
}
#endif

#endif
