// The state of the reader that turns a glTF file into a scene, shared by its parts. Private to
// assets/.
#ifndef DIP_ASSETS_GLTF_SCENE_H
#define DIP_ASSETS_GLTF_SCENE_H

#include "assets/gltf/materials.h"
#include "assets/gltf/reader.h"

// What a node passes on to the nodes below it.
typedef struct DipGltfNodeState {
    double world[12]; // rows of a 3x4 matrix
    DipTag tag;
    bool light_mapped;
    bool plain; // the node or one above has one of Diptych's own keys
} DipGltfNodeState;

typedef struct DipGltfScene {
    DipGltfReader reader;  // Its model has the meshes, nodes and skins of the file.
    DipModel *model;       // The scene that is loaded.
    int file;              // Index of the file in the model.
    DipAnimatedPose *pose; // The model at rest.
    const double *root;    // The transform of the whole file.
    DipGltfItems lights;   // Those of KHR_lights_punctual.
    int clip;              // Index of the animation that plays, or DIP_NOT_FOUND.
    bool *is_moved;        // True for each node of the reader's model that the clip moves.
    bool *changes_weights; // True for each one whose morph weights the clip changes.
    bool moves;            // The clip moves some object or mesh.
    unsigned warned;       // One bit for each DipGltfLoss that a warning has named.
} DipGltfScene;

// Features of which there is one warning for each file.
typedef enum DipGltfLoss {
    DIP_GLTF_LOSS_COORDINATES,
    DIP_GLTF_LOSS_GLOSS,
    DIP_GLTF_LOSS_LIGHT_MAPPED,
    DIP_GLTF_LOSS_MOVED_LIGHT,
    DIP_GLTF_LOSS_NORMAL_SCALE,
    DIP_GLTF_LOSS_SKINNED_COPIES,
} DipGltfLoss;

// True if the file has not been warned of this loss; it counts as warned from now on.
bool dip_gltf_warns_of(DipGltfScene *scene, DipGltfLoss loss);

// scene_materials.c: returns the material of the scene for a part of the file in an object with
// this tag. Fails with DIP_NOT_FOUND.
int dip_gltf_scene_material(DipGltfScene *scene, int part, const DipGltfNodeState *state);

// scene_meshes.c: returns the mesh of the scene for a part with this material. object: the object
// of the reader's model whose shape the mesh shall have, or DIP_NOT_FOUND for the part itself.
// Fails with DIP_NOT_FOUND. If the clip changes the object's shape, the mesh moves.
int dip_gltf_scene_mesh(DipGltfScene *scene, int part, int object, int material);

// scene_lights.c: adds the light of a node, if it has one.
bool dip_gltf_scene_light(DipGltfScene *scene, const struct cJSON *node, int index,
                          const double world[12]);

// scene_motion.c: notes the names of the file's animations, and reads the one that plays.
bool dip_gltf_scene_choose_clip(DipGltfScene *scene);

// scene_motion.c: keeps the clip in the model, if it moves anything.
bool dip_gltf_scene_keep_clip(DipGltfScene *scene);

// scene_motion.c: true if the clip changes the shape of an object's mesh.
bool dip_gltf_scene_deforms(const DipGltfScene *scene, int object);

// scene_motion.c: lets the clip move the object that was added to the model last. offset: its
// transform relative to its node.
bool dip_gltf_scene_move_object(DipGltfScene *scene, int object, const double offset[12]);

// scene_motion.c: lets the clip move a mesh that was made of an object's part. vertices: the part's
// vertex of each of the mesh's `count` vertices, whose normals are those of the triangles; NULL:
// the mesh has the part's vertices.
bool dip_gltf_scene_move_mesh(DipGltfScene *scene, int object, int mesh, uint32_t count,
                              const uint32_t *vertices);

#endif
