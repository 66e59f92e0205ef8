// The state of the reader of glTF files, shared by its parts. Private to assets/.
//
// The same reader serves three purposes. Scenes (scene.c) need all attributes of the meshes, and at
// most one animation. Animated models (animated_model.c) keep what DipAnimatedMesh can hold.
// Cameras (cameras.c) need nodes and animations only.
#ifndef DIP_ASSETS_GLTF_READER_H
#define DIP_ASSETS_GLTF_READER_H

#include "assets/animation/animation_parts.h"
#include "assets/gltf/document.h"

enum { DIP_GLTF_MAX_SETS = 8 };

// What a mesh of the file became. Each of its primitives becomes a mesh of the model, a part.
typedef struct DipGltfMesh {
    int first;        // Index of the first part in the model.
    int count;        // Number of parts.
    int target_count; // Number of morph targets.
    bool is_single;   // The file gives it one primitive.
} DipGltfMesh;

// What a primitive has beside its DipAnimatedMesh. The arrays are NULL unless a scene is read and
// the primitive has them.
typedef struct DipGltfPart {
    int number;    // Index of the primitive in its mesh.
    bool is_only;  // The mesh has no other primitive.
    int material;  // Index of the file's material, or -1.
    int max_joint; // Greatest joint number; -1: no joints.
    bool has_normals;
    bool has_alpha;                       // Some vertex colour has an alpha below 1.
    const float *sets[DIP_GLTF_MAX_SETS]; // u, v: the sets of texture coordinates
    const float *colours;                 // r, g, b, a: linear, 0..1
} DipGltfPart;

typedef struct DipGltfReader DipGltfReader;

struct DipGltfReader {
    DipAnimatedModel *model;
    DipGltf gltf;
    bool for_scene;            // True: all attributes are read; materials stay those of the file.
    bool unpacks_draco;        // True: a crash of Draco's library does no harm.
    DipGltfMesh *meshes;       // One for each mesh of the file.
    DipGltfPart *parts;        // One for each mesh of the model.
    uint64_t points_and_lines; // Number of points and lines that are left out.
    int *material_of;          // Material of the model for each of the file; -1: not read yet.
    int *coordinates_of;       // Set of texture coordinates for each material of the model.
    int *texture_of;           // Texture of the model for each of the file; TEXTURE_UNREAD.
    int *node_of;              // Node of the model for each of the file.
    int *first_object;         // First object of the model for each node of the file.
    bool *is_drawn;            // True for each node of the model that the scene shows.
};

// Shorthands for the model's memory.
void *dip_gltf_alloc(DipGltfReader *reader, size_t count, size_t item_bytes);
bool dip_gltf_no_room(const DipGltfReader *reader);

// Copies the name of an item, or makes one of its kind and number.
const char *dip_gltf_name(DipGltfReader *reader, const struct cJSON *item, const char *kind,
                          int index);

// animated_model.c: fills the model's arrays and counts, and leaves a part of them if it fails.
bool dip_animated_read_gltf(DipAnimatedModel *model, DipError *err);

// animated_model.c: finds the material of an animated model for one of the file, -1: the default.
bool dip_gltf_material(DipGltfReader *reader, int index, int *material);

// meshes.c: reads all meshes.
bool dip_gltf_read_meshes(DipGltfReader *reader);

// nodes.c: reads nodes and skins, and makes the objects.
bool dip_gltf_read_nodes(DipGltfReader *reader);

// nodes.c: reads only the nodes' order and their transforms at rest.
bool dip_gltf_read_transforms(DipGltfReader *reader);

// tracks.c: reads all animations.
bool dip_gltf_read_animations(DipGltfReader *reader);

// tracks.c: reads one animation. The others keep their place in the model's arrays, empty.
bool dip_gltf_read_animation(DipGltfReader *reader, int index);

// scene.c: reads a file into a scene while a model is loaded. root: the transform of the whole file
// (rows of a 3x4 matrix). The file's document stays open in model->files[file].gltf. *is_version_1
// becomes true, and nothing is read, if the file is glTF 1.
bool dip_gltf_read_scene(DipModel *model, int file, const double root[12], bool *is_version_1,
                         DipError *err);

#endif
