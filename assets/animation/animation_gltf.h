// The state of the reader of animated glTF models, shared by its parts. Private to assets/.
#ifndef DIP_ASSETS_ANIMATION_ANIMATION_GLTF_H
#define DIP_ASSETS_ANIMATION_ANIMATION_GLTF_H

#include "assets/animation/animation_parts.h"
#include "assets/animation/gltf_document.h"

// What a mesh of the file became. Each of its primitives becomes a mesh of the model.
typedef struct DipGltfMesh {
    int first;        // Index of the first mesh in the model.
    int count;        // Number of meshes in the model.
    int target_count; // Number of morph targets.
} DipGltfMesh;

typedef struct DipGltfReader {
    DipAnimatedModel *model;
    DipGltf gltf;
    DipGltfMesh *meshes; // One for each mesh of the file.
    int *material_of;    // Material of the model for each of the file; -1: not read yet.
    int *coordinates_of; // Set of texture coordinates for each material of the model.
    int *texture_of;     // Texture of the model for each of the file; TEXTURE_UNREAD.
    int *max_joints;     // Greatest joint number for each mesh of the model; -1: no joints.
    int *node_of;        // Node of the model for each of the file.
    bool *is_drawn;      // True for each node of the model that the scene shows.
} DipGltfReader;

// Shorthands for the model's memory.
void *dip_gltf_alloc(DipGltfReader *reader, size_t count, size_t item_bytes);
bool dip_gltf_no_room(const DipGltfReader *reader);

// Copies the name of an item, or makes one of its kind and number.
const char *dip_gltf_name(DipGltfReader *reader, const struct cJSON *item, const char *kind,
                          int index);

// animation_gltf_materials.c: finds the material of the model for one of the file, -1: the default.
bool dip_gltf_material(DipGltfReader *reader, int index, int *material);
bool dip_gltf_prepare_materials(DipGltfReader *reader);

// animation_gltf_meshes.c: reads all meshes.
bool dip_gltf_read_meshes(DipGltfReader *reader);

// animation_gltf_nodes.c: reads nodes and skins, and makes the objects.
bool dip_gltf_read_nodes(DipGltfReader *reader);

// animation_gltf_nodes.c: reads only the nodes' order and their transforms at rest.
bool dip_gltf_read_transforms(DipGltfReader *reader);

// animation_gltf_tracks.c: reads all animations.
bool dip_gltf_read_animations(DipGltfReader *reader);

#endif
