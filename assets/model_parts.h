// What the parts of the model loader share: the model under construction. Private to assets/.
//
// The course of a load: each file is imported and checked (import.c), its nodes are walked and
// turned into objects, which ask for meshes (mesh.c), which ask for materials (material.c), which
// ask for pictures. Then all pictures are decoded and materials get their textures.
#ifndef DIP_ASSETS_MODEL_PARTS_H
#define DIP_ASSETS_MODEL_PARTS_H

#include "assets/model.h"
#include "assets/picture.h"
#include "renderer/scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct aiMaterial;
struct aiMesh;
struct aiNode;
struct aiScene;

enum { DIP_NOT_FOUND = -1 };

// What an object's metadata says of its surface.
typedef enum DipTag {
    DIP_TAG_SOLID,
    DIP_TAG_MASK,
    DIP_TAG_GLASS,
    DIP_TAG_WATER,
    DIP_TAG_SKY
} DipTag;

// A picture that some material uses; decoded once however many do.
typedef struct DipPictureEntry {
    char *name;           // the file's path, or the embedded picture's name
    int file;             // index of the model file that uses it first
    const uint8_t *bytes; // embedded: borrowed from the imported scene; NULL: a file
    size_t size_bytes;    // embedded and compressed
    uint32_t raw_width;   // embedded, b g r a texels; 0 when compressed
    uint32_t raw_height;
    DipPicture picture;
    DipError error; // code NONE: decoded
} DipPictureEntry;

// A material's use of a picture.
typedef struct DipTextureUse {
    int picture; // index or DIP_NO_TEXTURE
    int uv_channel;
    DipWrap wrap_u;
    DipWrap wrap_v;
} DipTextureUse;

// Beside each DipMaterialDef: what tells it from others, and what waits for the pictures.
typedef struct DipMaterialPlan {
    int file;
    unsigned source;      // index in the file
    unsigned coordinates; // bit i: the mesh has texture coordinates i
    DipTag tag;
    bool light_mapped;
    bool has_uv0;
    bool has_uv1;
    bool invisible; // by its own opacity, below the cutoff everywhere
    DipTextureUse colour;
    DipTextureUse opacity;
    DipTextureUse light;
    DipTextureUse normal;
} DipMaterialPlan;

// Beside each DipTextureDef: what tells it from others.
typedef struct DipTextureKey {
    int picture;
    int opacity_picture;
    bool has_alpha;
} DipTextureKey;

// Beside each DipMeshDef: likewise.
typedef struct DipMeshKey {
    int file;
    unsigned source;
    int material;
} DipMeshKey;

typedef struct DipModelFile {
    const char *path; // as the caller wrote it; owned by the model
    const struct aiScene *scene;
    bool linear_colours; // glTF
} DipModelFile;

struct DipModel {
    DipSceneDef def;
    DipTextureDef *textures;
    DipTextureKey *texture_keys;
    DipMaterialDef *materials;
    DipMaterialPlan *plans;
    DipMeshDef *meshes;
    DipMeshKey *mesh_keys;
    DipObjectDef *objects;
    DipPictureEntry *pictures;
    int picture_count;
    DipPicture *merged; // colour and opacity in one
    int merged_count;
    void **blocks; // names and arrays that the definitions point to
    int block_count;
    DipModelFile *files;
    int file_count;
    DipErrorList *warnings; // may be NULL
    DipModelTimes times;
    bool normal_maps; // to be loaded
};

// Room for one more item in an array of `count`: the array, moved if need be, or NULL, and then the
// old one stays valid.
void *dip_array_grow(void *items, int count, size_t item_bytes);

// Memory that lives as long as the model. NULL when there is none.
void *dip_model_alloc(DipModel *model, size_t count, size_t item_bytes);
char *dip_model_copy_text(DipModel *model, const char *text);

void dip_model_warn(DipModel *model, const char *file, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
bool dip_model_out_of_memory(DipError *err, const char *file);

// A colour channel of a file to linear light, clamped to 0..1. linear: it is so already.
float dip_model_colour_to_linear(float value, bool linear);

// mesh.c: whether a processed mesh consists of triangles.
bool dip_mesh_is_triangles(const struct aiMesh *mesh);

// precheck.c: refuses files that would make assimp run out of stack or time.
bool dip_model_precheck(const char *path, DipError *err);

// import.c: reads and checks a file; fills file->scene.
bool dip_model_import(DipModel *model, DipModelFile *file, DipError *err);

// mesh.c: the index of a mesh for one placement; DIP_NOT_FOUND when it fails.
int dip_model_mesh(DipModel *model, int file, unsigned source, int material, DipError *err);

// mesh.c: n to length 1; one that is zero or not finite (of a face without area) points up.
void dip_model_unit_normal(const double n[3], float to[3]);

// normals.c: three floats per corner of a mesh of triangles, smooth where faces meet at less than
// 60 degrees. Lives as long as the model; NULL when memory runs out.
float *dip_model_make_normals(DipModel *model, const struct aiMesh *mesh);

// material.c: the index of a material for a mesh of a tagged object; DIP_NOT_FOUND when it fails.
int dip_model_material(DipModel *model, int file, const struct aiMesh *mesh, DipTag tag,
                       bool light_mapped, DipError *err);

// pictures.c: registers a picture of a material and returns its index, or DIP_NO_TEXTURE when
// memory runs out. Decodes all registered ones on the pool; fails when one is there but broken.
int dip_model_picture(DipModel *model, int file, const char *path);
bool dip_model_decode_pictures(DipModel *model, DipPool *pool, DipError *err);

// material.c: once pictures are decoded: makes the textures and settles what is opaque.
bool dip_model_finish_materials(DipModel *model, DipError *err);

#endif
