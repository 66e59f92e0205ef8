// Models in motion: MD2 files with their key frames, and glTF files (.gltf, .glb) with node
// animation, morph targets and skins.
//
// A program loads a DipAnimatedModel once. For each copy of the model that it draws, it makes a
// DipAnimatedPose, and for each frame sets the pose to a time of one of the model's animations:
//
//     DipAnimatedModel *model = dip_animated_model_load("crab.md2", NULL, NULL, err);
//     DipAnimatedPose *pose = model ? dip_animated_pose_create(model, err) : NULL;
//     ...
//     dip_animated_pose_set(pose, 0, time_s);
//     const DipObjectPose *object = dip_animated_pose_object(pose, 0);
//
// The program then either gives the shapes of the object's mesh to a vertex shader, together with
// the weights of the pose, or lets dip_animated_pose_vertices compute the vertices.
//
// Diptych reads these files itself. assimp imports one key frame of an MD2 file per load, and drops
// the interpolation (STEP, CUBICSPLINE) of glTF animations. The readers check every offset, count
// and index, and run in the caller's process. docs/models.md (Models in motion) says what they
// read.
#ifndef DIP_ASSETS_ANIMATION_H
#define DIP_ASSETS_ANIMATION_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"
#include "renderer/pipeline/texture.h"
#include "renderer/scene/scene.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct DipImporter;

// Indexed triangles of one material with one or more shapes. All arrays are packed, and all numbers
// are finite. The winding of front faces is counter-clockwise.
//
// Each shape has a position and a normal for every vertex. The drawn position is the sum over all
// shapes s of weight[s] * position in shape s. The drawn normal is the same sum over the normals,
// normalised. DipObjectPose has the weights.
// - MD2: shape s is key frame s. At most two weights are not 0; the weights sum up to 1.
// - glTF: shape 0 is the mesh without morph targets, and its weight is 1. Shape s, s >= 1, is what
//   morph target s - 1 adds to shape 0; its weight is the target's.
typedef struct DipAnimatedMesh {
    const char *name;
    uint32_t vertex_count;
    uint32_t index_count; // a multiple of 3
    const uint32_t *indices;
    int shape_count;
    // x, y, z for all vertices of shape 0, then for those of shape 1, and so on. The normals of
    // shape 0, and of all key frames, are unit vectors.
    const float *positions;
    const float *normals;
    const float *uv0; // u, v for the colour texture; NULL if the mesh has none
    // The joints that move a vertex, and their weights: 4 per vertex. The weights of a vertex sum
    // up to 1. joints are indices of the matrices in DipObjectPose.joint_transforms. Both arrays
    // are NULL if the mesh has no skin.
    const uint16_t *joints;
    const float *joint_weights;
    int material; // index of the mesh's material
} DipAnimatedMesh;

// A mesh in the scene of the file. Several objects may use one mesh.
typedef struct DipAnimatedObject {
    const char *name;
    int mesh;
    int joint_count; // Number of joints of the object's skin; 0 without a skin.
} DipAnimatedObject;

// A sequence that repeats: after duration_s it starts again at 0 s.
// - MD2: a run of key frames whose names differ only in the digits at the end. After the last
//   frame, the first one follows, so n frames last n / 10 s.
// - glTF: an animation of the file. It lasts until its last key, and jumps back to 0 s.
typedef struct DipAnimation {
    const char *name; // MD2: the name of the frames without the digits
    double duration_s;
} DipAnimation;

// A key frame of an MD2 file. Its index is that of the shape.
typedef struct DipKeyFrame {
    const char *name; // "run3"
    int animation;    // Index of the animation that the frame belongs to.
    double time_s;    // Time of the frame in this animation; key frames are 1/10 s apart.
} DipKeyFrame;

// The content of the file. +Y is up. The pictures of `textures` are decoded; a DDS picture gives
// its largest level. The materials have no light map and no normal map.
typedef struct DipAnimatedDef {
    const DipTextureDef *textures;
    const DipMaterialDef *materials;
    const DipAnimatedMesh *meshes;
    const DipAnimatedObject *objects;
    const DipAnimation *animations;
    const DipKeyFrame *key_frames; // NULL in glTF
    int texture_count;
    int material_count;
    int mesh_count;
    int object_count;
    int animation_count; // may be 0 in glTF
    int key_frame_count;
} DipAnimatedDef;

// A loaded model. It never changes after loading, so any number of threads may read it.
typedef struct DipAnimatedModel DipAnimatedModel;

// Loads a model of the format that the file's name ends with: .md2, .gltf or .glb. The caller owns
// the model and destroys it with dip_animated_model_destroy. On failure, returns NULL and fills
// *err (may be NULL) with the file and the reason. A fault that leaves a usable model, such as a
// missing picture, is only added to *warnings (may be NULL). importer (importer.h, may be NULL):
// the program that decodes picture files in a process of its own. Pictures inside the model file
// are decoded in this process.
//
// Codes: MISSING (no such file, or no triangle), IO, TRUNCATED, FORMAT, UNSUPPORTED (a feature or a
// required extension of glTF), RANGE (an index out of range; a number that is not finite),
// OVERSIZED (a file of more than 512 MiB, or a model of more than 1 GiB), RUNTIME, MEMORY.
//
// Threads: different models may be loaded at the same time on different threads.
DIP_API DipAnimatedModel *dip_animated_model_load(const char *file,
                                                  const struct DipImporter *importer,
                                                  DipErrorList *warnings, DipError *err);

// Loads a model like dip_animated_model_load, but reads none of its pictures, which may take most
// of the time: all materials keep their base colours, and the model has no textures.
DIP_API DipAnimatedModel *dip_animated_model_load_shapes(const char *file, DipErrorList *warnings,
                                                         DipError *err);

// Destroys the model and sets the pointer to NULL. Accepts a pointer to NULL. Poses of the model
// must be destroyed before.
DIP_API void dip_animated_model_destroy(DipAnimatedModel **model);

// The description belongs to the model.
DIP_API const DipAnimatedDef *dip_animated_model_def(const DipAnimatedModel *model);

// Returns the index of the animation with this name, or -1.
DIP_API int dip_animated_model_find(const DipAnimatedModel *model, const char *animation_name);

// How an object is placed and shaped at the time of a pose.
typedef struct DipObjectPose {
    float transform[12];  // 3x4 matrix, row by row: world = transform * (x, y, z, 1)
    const float *weights; // One weight for each shape of the object's mesh.
    // MD2: the key frames before and after the time. Their weights are 1 - blend and blend, with
    // 0 <= blend < 1. In glTF all three are 0.
    int key_frame;
    int next_key_frame;
    float blend;
    // 3x4 matrices, one for each joint of the object's skin, or NULL. A vertex of the shape moves
    // to the sum of joint_weights[i] * (matrix of joint i) * (x, y, z, 1), which is its position in
    // the world: a skinned object has the identity as its transform.
    const float *joint_transforms;
} DipObjectPose;

// The state of one copy of a model at one time. Not thread-safe: each thread uses poses of its own.
typedef struct DipAnimatedPose DipAnimatedPose;

// Makes a pose at 0 s of animation 0, or of the model at rest if it has no animation. The model
// must outlive the pose. Returns NULL and fills *err with MEMORY on failure.
DIP_API DipAnimatedPose *dip_animated_pose_create(const DipAnimatedModel *model, DipError *err);

// Destroys the pose and sets the pointer to NULL. Accepts a pointer to NULL.
DIP_API void dip_animated_pose_destroy(DipAnimatedPose **pose);

// Sets the pose to a time of an animation. animation: 0..animation_count - 1; it is ignored if the
// model has no animation. The animation repeats before 0 s, too. A time that is not finite counts
// as 0. Allocates nothing. The results have the same bits on every machine.
DIP_API void dip_animated_pose_set(DipAnimatedPose *pose, int animation, double time_s);

// Returns how an object is posed. object: 0..object_count - 1. The result belongs to the pose and
// changes with the next dip_animated_pose_set.
DIP_API const DipObjectPose *dip_animated_pose_object(const DipAnimatedPose *pose, int object);

// Computes the vertices of an object: writes vertex_count positions and unit normals of three
// floats each, before the object's transform. normals may be NULL. A normal is moved by the joints'
// matrices themselves, which is right unless a matrix scales differently along its axes.
DIP_API void dip_animated_pose_vertices(const DipAnimatedPose *pose, int object, float *positions,
                                        float *normals);

#ifdef __cplusplus
}
#endif

#endif
