// Builds scenes of assimp in memory and writes them in assimp's own binary format, which carries
// what other formats cannot: metadata of every type, and materials with any properties.
#ifndef DIP_TESTS_ASSETS_MADE_SCENE_H
#define DIP_TESTS_ASSETS_MADE_SCENE_H

#include <assimp/light.h>
#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/metadata.h>
#include <assimp/scene.h>
#include <assimp/texture.h>

enum { MADE_MOST = 16 };

typedef struct MadeMetadata {
    struct aiMetadata head;
    struct aiString keys[4];
    struct aiMetadataEntry values[4];
} MadeMetadata;

// Mesh number i is a triangle with the material number i, and the node number i, which is a child
// of the root, has this mesh. The tests may change what they like.
typedef struct MadeScene {
    struct aiScene scene;
    struct aiNode root;
    struct aiNode nodes[MADE_MOST];
    struct aiNode *children[MADE_MOST];
    MadeMetadata metadata[MADE_MOST + 1]; // the last one is the root's
    unsigned mesh_numbers[MADE_MOST];
    struct aiMesh meshes[MADE_MOST];
    struct aiMesh *mesh_list[MADE_MOST];
    struct aiMaterial materials[MADE_MOST];
    struct aiMaterial *material_list[MADE_MOST];
    struct aiMaterialProperty properties[MADE_MOST][MADE_MOST];
    struct aiMaterialProperty *property_lists[MADE_MOST][MADE_MOST];
    char property_bytes[MADE_MOST][MADE_MOST][256];
    struct aiTexture *textures[MADE_MOST];
    struct aiLight *lights[MADE_MOST];
} MadeScene;

// Begins a scene of so many triangles. Each has one set of texture coordinates. The names are
// mesh0, node0, material0, and so on. The scene is valid until the next call.
MadeScene *made_scene(int triangles);

// The node of the root's metadata.
enum { MADE_ROOT = MADE_MOST };

// Adds metadata to a node. The data must live until the scene is written.
void made_metadata(MadeScene *made, int node, const char *key, enum aiMetadataType type,
                   const void *data);

// Add a property to a material. semantic: kind of texture, or 0.
void made_text(MadeScene *made, int material, const char *key, unsigned semantic, const char *text);
void made_floats(MadeScene *made, int material, const char *key, unsigned semantic,
                 const float *values, int count);
void made_integer(MadeScene *made, int material, const char *key, unsigned semantic, int value);

// Names a texture of the material.
void made_texture(MadeScene *made, int material, enum aiTextureType type, const char *picture);

void made_string(struct aiString *to, const char *text);

// Writes the scene to the folder of the tests as made.assbin and returns the path.
const char *made_write(const MadeScene *made);

#endif
