// The motion of a scene: clips that move objects and change the shapes of meshes. A clip belongs to
// a rig, and all rigs play at once.
//
// The vertices at a time are computed with + - * / and sqrt alone, in an order that depends on
// nothing but the description, so they have the same bits on every machine, whatever was drawn
// before.
#ifndef DIP_RENDERER_SCENE_MOTION_H
#define DIP_RENDERER_SCENE_MOTION_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"
#include "renderer/scene/rig.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct DipSceneDef;

// The nodes of a model file and the clip that moves them. A clip repeats: after duration_s it
// starts again at 0 s.
typedef struct DipMotionRig {
    const char *clip; // the clip's name
    double duration_s;
    bool is_held;    // true: the clip stands still at held_s
    double held_s;   // a time of the clip; it repeats as time does
    double root[12]; // the transform of the whole file: rows of a 3x4 matrix
    DipRig rig;
    const DipRigSkin *skins;
    int skin_count;
    const DipTrack *tracks;
    int track_count;
} DipMotionRig;

// An object of the scene that a node carries: its transform is root * (the node's world transform)
// * offset.
typedef struct DipMovingObject {
    int object;
    int rig;
    int node;
    double offset[12]; // rows of a 3x4 matrix
} DipMovingObject;

// A mesh of the scene that changes its shape. Its vertices are a weighted sum over several shapes,
// and then move with their joints, if it has any.
//
// The weight of shape 0 is 1, and that of shape s is the weight of morph target s - 1 of the node.
typedef struct DipMovingMesh {
    int mesh;
    int rig;
    int node;
    int skin; // DIP_NO_SKIN: the mesh has no joints
    uint32_t vertex_count;
    int shape_count;
    const float *positions; // x, y, z for all vertices of shape 0, then for those of shape 1, ...
    // The same for normals. NULL: the mesh has the normals of its triangles, and its indices are 0,
    // 1, 2, ..., so that triangles share no vertices.
    const float *normals;
    const uint16_t *joints; // 4 for each vertex, which are joints of the skin; NULL without one
    const float *joint_weights;
    // Least x, y and z, and then greatest x, y and z of the vertices over the clip
    // (dip_motion_bound_meshes). NULL: not known; dip_scene_create then computes them.
    const float *box;
} DipMovingMesh;

typedef struct DipMotionDef {
    const DipMotionRig *rigs;
    const DipMovingObject *objects; // ascending by the scene's objects, each of which occurs once
    const DipMovingMesh *meshes;    // ascending by the scene's meshes, each of which occurs once
    int rig_count;
    int object_count;
    int mesh_count;
} DipMotionDef;

// Number of moments, at equal distances over every clip, at which bounds of a motion are taken. A
// mesh without joints whose weights move straight between keys is bounded at these keys instead,
// which holds it at all times.
enum { DIP_MOTION_MOMENTS = 16 };

// Checks the motion of a scene whose other parts are valid. Fails with RANGE.
DIP_API bool dip_motion_check(const struct DipSceneDef *scene, DipError *err);

// Copies a motion with all its arrays, or returns NULL if memory runs out. scene: the scene that
// the motion belongs to.
DIP_API DipMotionDef *dip_motion_copy(const struct DipSceneDef *scene);
// *motion may be NULL and becomes NULL.
DIP_API void dip_motion_free(DipMotionDef **motion);

// Returns whether the motion changes with time: not if all clips are held or last 0 s.
DIP_API bool dip_motion_plays(const DipMotionDef *motion);

// The motion at one time. Not thread-safe, but several threads may compute vertices of one pose.
typedef struct DipMotionPose DipMotionPose;

// Makes a pose at time 0. The motion is borrowed; it may be freed before the pose is destroyed.
// Returns NULL if memory runs out.
DIP_API DipMotionPose *dip_motion_pose_create(const DipMotionDef *motion);
// *pose may be NULL and becomes NULL.
DIP_API void dip_motion_pose_destroy(DipMotionPose **pose);

// Moves the pose to a time in nanoseconds, or to a share of every clip's duration, 0 up to 1.
// Allocates nothing.
DIP_API void dip_motion_pose_set(DipMotionPose *pose, int64_t time_ns);
DIP_API void dip_motion_pose_set_share(DipMotionPose *pose, double share);

// Computes the transform of a moving object. moving: index of a DipMovingObject. A transform that
// is not finite becomes 0, so that the object is not seen.
DIP_API void dip_motion_pose_transform(const DipMotionPose *pose, int moving, float transform[12]);

// Computes `count` vertices of a moving mesh from vertex `first` on: three floats each, from
// positions[0] and normals[0] on, `stride` floats apart. Numbers that are not finite become 0.
// moving: index of a DipMovingMesh. `first` and `count` are multiples of 3 if the mesh has the
// normals of its triangles; count may also reach the last vertex. normals may be NULL.
DIP_API void dip_motion_pose_vertices(const DipMotionPose *pose, int moving, uint32_t first,
                                      uint32_t count, size_t stride, float *positions,
                                      float *normals);

// Computes the box of each moving mesh (DipMovingMesh.box). This computes all vertices for each of
// the moments, on one thread. Returns false if memory runs out.
DIP_API bool dip_motion_bound_meshes(const DipMotionDef *motion, float (*boxes)[6]);

// A scene's description at one time of its motion, for code that reads descriptions.
typedef struct DipPosedDef DipPosedDef;

// Makes the description at time 0. The scene is borrowed. Fails with MEMORY.
DIP_API DipPosedDef *dip_posed_def_create(const struct DipSceneDef *scene, DipError *err);
// *posed may be NULL and becomes NULL.
DIP_API void dip_posed_def_destroy(DipPosedDef **posed);

// Returns the description, whose address stays the same. It has no motion.
DIP_API const struct DipSceneDef *dip_posed_def(const DipPosedDef *posed);

// Move the description to a time, or to a share of every clip's duration, 0 up to 1. They change
// the positions and normals of meshes and the transforms of objects.
DIP_API void dip_posed_def_set(DipPosedDef *posed, int64_t time_ns);
DIP_API void dip_posed_def_set_share(DipPosedDef *posed, double share);

#ifdef __cplusplus
}
#endif

#endif
