// Builds scenes of assimp in memory and writes them.
#include "tests/assets/made_scene.h"

#include "tests/assets/fixture.h"

#include <assimp/cexport.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

static struct aiVector3D corners[3] = {{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}};
static struct aiVector3D normals[3] = {{0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f}};
static unsigned indices[3] = {0, 1, 2};
static struct aiFace face = {.mNumIndices = 3, .mIndices = indices};

void made_string(struct aiString *to, const char *text) {
    to->length = (ai_uint32)strlen(text);
    memcpy(to->data, text, to->length + 1);
}

static void set_number(struct aiString *to, const char *word, int number) {
    char text[32];
    snprintf(text, sizeof text, "%s%d", word, number);
    made_string(to, text);
}

static void set_identity(struct aiMatrix4x4 *matrix) {
    matrix->a1 = matrix->b2 = matrix->c3 = matrix->d4 = 1.0f;
}

static void begin_triangle(MadeScene *made, int i) {
    struct aiMesh *mesh = &made->meshes[i];
    set_number(&mesh->mName, "mesh", i);
    mesh->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
    mesh->mNumVertices = 3;
    mesh->mVertices = corners;
    mesh->mNormals = normals;
    mesh->mTextureCoords[0] = corners;
    mesh->mNumUVComponents[0] = 2;
    mesh->mNumFaces = 1;
    mesh->mFaces = &face;
    mesh->mMaterialIndex = (unsigned)i;
    made->mesh_list[i] = mesh;
    struct aiNode *node = &made->nodes[i];
    set_number(&node->mName, "node", i);
    set_identity(&node->mTransformation);
    node->mParent = &made->root;
    node->mNumMeshes = 1;
    made->mesh_numbers[i] = (unsigned)i;
    node->mMeshes = &made->mesh_numbers[i];
    made->children[i] = node;
    made->materials[i].mProperties = made->property_lists[i];
    made->material_list[i] = &made->materials[i];
    char name[32];
    snprintf(name, sizeof name, "material%d", i);
    made_text(made, i, "?mat.name", 0, name);
}

MadeScene *made_scene(int triangles) {
    static MadeScene made;
    memset(&made, 0, sizeof made);
    assert_true(triangles <= MADE_MOST);
    for (int i = 0; i < triangles; ++i) {
        begin_triangle(&made, i);
    }
    made_string(&made.root.mName, "root");
    set_identity(&made.root.mTransformation);
    made.root.mNumChildren = (unsigned)triangles;
    made.root.mChildren = made.children;
    made.scene.mRootNode = &made.root;
    made.scene.mNumMeshes = made.scene.mNumMaterials = (unsigned)triangles;
    made.scene.mMeshes = made.mesh_list;
    made.scene.mMaterials = made.material_list;
    made.scene.mTextures = made.textures;
    made.scene.mLights = made.lights;
    return &made;
}

void made_metadata(MadeScene *made, int node, const char *key, enum aiMetadataType type,
                   const void *data) {
    MadeMetadata *metadata = &made->metadata[node];
    struct aiNode *owner = node == MADE_ROOT ? &made->root : &made->nodes[node];
    const unsigned i = metadata->head.mNumProperties++;
    assert_true(i < 4);
    made_string(&metadata->keys[i], key);
    metadata->values[i] = (struct aiMetadataEntry){.mType = type, .mData = (void *)data};
    metadata->head.mKeys = metadata->keys;
    metadata->head.mValues = metadata->values;
    owner->mMetaData = &metadata->head;
}

static void add_property(MadeScene *made, int material, const char *key, unsigned semantic,
                         enum aiPropertyTypeInfo type, const void *bytes, size_t size_bytes) {
    struct aiMaterial *owner = &made->materials[material];
    const unsigned i = owner->mNumProperties++;
    assert_true(i < MADE_MOST && size_bytes <= sizeof made->property_bytes[0][0]);
    struct aiMaterialProperty *property = &made->properties[material][i];
    made_string(&property->mKey, key);
    property->mSemantic = semantic;
    property->mType = type;
    property->mData = made->property_bytes[material][i];
    property->mDataLength = (unsigned)size_bytes;
    memcpy(property->mData, bytes, size_bytes);
    owner->mProperties[i] = property;
    owner->mNumAllocated = owner->mNumProperties;
}

void made_text(MadeScene *made, int material, const char *key, unsigned semantic,
               const char *text) {
    char bytes[256];
    const uint32_t length = (uint32_t)strlen(text);
    assert_true(length + 5 <= sizeof bytes);
    memcpy(bytes, &length, 4);
    memcpy(bytes + 4, text, length + 1);
    add_property(made, material, key, semantic, aiPTI_String, bytes, length + 5);
}

void made_floats(MadeScene *made, int material, const char *key, unsigned semantic,
                 const float *values, int count) {
    add_property(made, material, key, semantic, aiPTI_Float, values,
                 (size_t)count * sizeof *values);
}

void made_integer(MadeScene *made, int material, const char *key, unsigned semantic, int value) {
    add_property(made, material, key, semantic, aiPTI_Integer, &value, sizeof value);
}

void made_texture(MadeScene *made, int material, enum aiTextureType type, const char *picture) {
    made_text(made, material, "$tex.file", (unsigned)type, picture);
}

const char *made_write(const MadeScene *made) {
    const char *path = fixture_path("made.assbin");
    if (aiExportScene(&made->scene, "assbin", path, 0) != aiReturn_SUCCESS) {
        fail_msg("assimp cannot write the scene");
    }
    return path;
}
