// The model while it is loaded, shared by the parts of the model loader. Private to assets/.
//
// A load has these steps. Each file is imported and checked (import.c). model.c walks the file's
// nodes and turns them into objects. Each object needs a mesh (mesh.c) and a material (material.c),
// and the material registers its pictures (pictures.c). Files of glTF 2 are read by gltf/scene.c
// and its neighbours instead, which add the same things to the model. Then all pictures are decoded
// and the materials get their textures.
#ifndef DIP_ASSETS_MODEL_PARTS_H
#define DIP_ASSETS_MODEL_PARTS_H

#include "assets/model.h"
#include "assets/picture.h"
#include "renderer/scene/motion.h"
#include "renderer/scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct aiColor4D;
struct aiMaterial;
struct aiMatrix4x4;
struct aiMesh;
struct aiMetadata;
struct aiMetadataEntry;
struct aiNode;
struct aiScene;

enum { DIP_NOT_FOUND = -1 };

// Kind of surface, as an object's metadata gives it.
typedef enum DipTag {
    DIP_TAG_SOLID,
    DIP_TAG_MASK,
    DIP_TAG_GLASS,
    DIP_TAG_WATER,
    DIP_TAG_SKY
} DipTag;

// A picture that one or more materials use. It is decoded once.
typedef struct DipPictureEntry {
    char *name;           // path of the file, or name of the embedded picture
    int file;             // index of the first model file that uses the picture
    const uint8_t *bytes; // an embedded picture, which the imported scene owns; NULL for a file
    size_t size_bytes;    // size of an embedded picture file
    uint32_t raw_width;   // width of embedded b, g, r, a texels; 0 for an embedded picture file
    uint32_t raw_height;  // height of these texels, or 0
    DipPicture picture;
    DipError error; // why decoding failed; code NONE after success
} DipPictureEntry;

// Which coordinates of the file become uv0 or uv1 of a mesh, and how they are moved.
typedef struct DipCoordinates {
    int set;
    double matrix[6]; // rows of a 2x3 matrix, for (u, v, 1)
} DipCoordinates;

// How a material uses a picture.
typedef struct DipTextureUse {
    int picture;    // index of a picture, or DIP_NO_TEXTURE
    int uv_channel; // set of texture coordinates in the file
    DipWrap wrap_u;
    DipWrap wrap_v;
    bool hard; // true: the file asks for texels with hard edges
} DipTextureUse;

// Describes one DipMaterialDef: the values that distinguish it from other materials, and the values
// that are needed after the pictures are decoded.
typedef struct DipMaterialPlan {
    int file;             // index of the model file
    unsigned source;      // index of the material in that file
    unsigned coordinates; // bit i is set if the mesh has texture coordinates i
    DipTag tag;
    bool light_mapped; // true: the occlusion picture is a light map
    bool plain;        // true: the file tags it for Diptych, so it has Diptych's own light and no
                       // reflection
    const DipMaterialRule *light_rule; // the rule that says so, or NULL
    bool has_uv0;      // true: the mesh needs coordinates for colour, opacity or normal map
    bool has_uv1;      // true: the mesh needs coordinates for the light map
    bool invisible;    // true: the material's own opacity is below its cutoff
    bool unlit;        // true: no light falls on the surface
    bool vertex_alpha; // true: the vertices' alpha clips or blends the surface
    DipTextureUse colour;
    DipTextureUse opacity;
    DipTextureUse light;
    DipTextureUse normal;
    // The following are those of glTF. For other formats, uv_channel of the pictures says which
    // coordinates they use, and pbr is NULL.
    DipTextureUse metal_rough;
    DipTextureUse gloss; // its mean multiplies f0 in pbr, and that of its alpha 1 - roughness
    DipTextureUse occlusion;
    DipTextureUse emission;
    DipCoordinates uv0;
    DipCoordinates uv1;
    DipPbrDef *pbr; // gets its textures after the pictures are decoded
} DipMaterialPlan;

// Describes one DipTextureDef: the values that distinguish it from other textures.
typedef struct DipTextureKey {
    int picture;
    int opacity_picture;
    int enlargement; // a texel of the picture is so many texels wide and high
    bool has_alpha;
} DipTextureKey;

// Describes one DipMeshDef: the values that distinguish it from other meshes.
typedef struct DipMeshKey {
    int file;        // index of the model file
    unsigned source; // index of the mesh in that file
    int material;    // index of the DipMaterialDef
    int object; // object of the file whose shape this is, or DIP_NOT_FOUND for the mesh at rest
} DipMeshKey;

typedef struct DipModelFile {
    const char *path;            // as the caller gave it; owned by the model
    const struct aiScene *scene; // owned; NULL before the import and after the load, and in glTF 2
    struct DipGltf *gltf; // owned; the file if it is glTF 2, otherwise NULL; NULL after the load
    const char **material_names; // of all the file's materials; "" for one without a name
    int material_count;
    bool linear_colours; // true: colours are linear, as in glTF; false: colours are sRGB
    // The key frames of an MD2 file whose animation number `clip` plays, otherwise NULL; owned.
    // NULL after the load.
    struct DipAnimatedModel *key_frames;
    int clip;
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
    DipPicture *merged; // pictures made of a colour and an opacity picture
    int merged_count;
    bool lost_picture; // memory ran out for a picture, so the load must fail
    void **blocks;     // memory blocks that dip_model_alloc has allocated
    int block_count;
    DipModelFile *files;
    int file_count;
    DipErrorList *warnings; // the caller's list, used only during the load; may be NULL
    DipModelTimes times;
    bool normal_maps; // true: normal maps are loaded
    DipUpAxis up;
    const DipMaterialRule *rules; // the caller's, used only during the load
    int rule_count;
    // Lights of the files, with the strength that the files give until dip_model_scale_lights.
    DipLightDef *lights;
    int light_count;
    int lights_left_out;   // lights beyond DIP_MAX_LIGHTS
    double ambient_lin[3]; // sum of the files' ambient lights
    bool has_light_scale;  // false: dip_model_scale_lights computes the factor
    double light_scale;
    DipLightingDef lighting;
    // The animation that shall play, and whether its clips stand still at a time.
    DipModelAnimation animation;
    const char *animation_name; // the caller's, used only during the load
    bool animation_is_held;
    double animation_held_s;
    const char **clips;            // an array that grows
    const char *const *clip_names; // the names of the files' animations, each once
    int clip_count;
    DipMotionDef motion;
    DipMotionRig *rigs;
    DipMovingObject *moving_objects;
    DipMovingMesh *moving_meshes;
    // The model of an importer has only a pack, whose scene is `def`, and the pack's bytes.
    struct DipScenePack *pack; // one of `blocks`, or NULL
    void *pack_bytes;          // mapped memory, or NULL
    size_t pack_size_bytes;
};

// importer.c: unmaps the bytes of the model's pack, if it has any.
void dip_model_unmap_pack(DipModel *model);

// A load in this process.
typedef struct DipModelLoad {
    const char *const *files;
    int file_count;
    DipModelOptions options; // The importer is not used.
    DipPool *pool;           // May be NULL.
    DipErrorList *warnings;  // May be NULL.
    int note_file;           // Pack file that gets a note of every step, or -1.
    bool picture_only;       // The only file is a picture; its levels become the only textures.
} DipModelLoad;

// model.c: loads a model in this process. Returns NULL and fills *err if the load fails.
DipModel *dip_model_load_here(const DipModelLoad *load, DipError *err);

// importer.c: loads a model in a child process. Fails like dip_model_load_with.
DipModel *dip_model_load_in_child(const DipModelLoad *load, const struct DipImporter *importer,
                                  DipError *err);

// Makes room for one more item in an array of `count` items. Returns the array, which may have
// moved. On failure returns NULL and the old array stays valid.
void *dip_array_grow(void *items, int count, size_t item_bytes);

// Allocates zeroed memory that lives as long as the model. Returns NULL when memory runs out.
void *dip_model_alloc(DipModel *model, size_t count, size_t item_bytes);
char *dip_model_copy_text(DipModel *model, const char *text);

// model.c: replaces control characters by spaces, because messages must stay on one line.
void dip_make_one_line(char *text);

// material.c: returns the least alpha that a texel needs, so that the base alpha times its alpha
// reaches the cutoff of a glTF material. 1 is the most, also where no texel reaches the cutoff.
float dip_texel_cutoff(float cutoff, float base_alpha);

// Adds a warning with the code UNSUPPORTED, unless the caller wants no warnings. key may be NULL.
void dip_model_warn(DipModel *model, const char *file, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

// Does the same for a picture that is missing. Its code is MISSING (model.h).
void dip_model_warn_of_picture(DipModel *model, const char *file, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// Fills *err with DIP_ERROR_MEMORY and returns false.
bool dip_model_out_of_memory(DipError *err, const char *file);

// Converts a colour channel of a file to linear light and clamps it to 0..1. linear: the value is
// linear already and is only clamped.
float dip_model_colour_to_linear(float value, bool linear);

// model.c: finds a key. Returns NULL if there is none. meta may be NULL.
const struct aiMetadataEntry *dip_model_metadata(const struct aiMetadata *meta, const char *key);

// model.c: adds an object to the scene. transform: rows of a 3x4 matrix. file: for messages.
bool dip_model_add_object(DipModel *model, int file, int mesh, const double transform[12],
                          const char *name, DipError *err);

// model.c: reads the tag that a file gives by its name. Leaves *tag as it is, with a warning, if
// the name is unknown. key: name of the node.
void dip_model_read_tag(DipModel *model, const char *file, const char *key, const char *name,
                        DipTag *tag);

// model.c: multiplies matrices with 3 rows of 4 numbers; of *b, the first three rows are used.
void dip_model_multiply(const double a[12], const struct aiMatrix4x4 *b, double to[12]);

// Axis-aligned bounds in world space of all objects that are not sky. Without such objects, the
// diagonal is infinite or NaN.
typedef struct DipModelBounds {
    double low[3];
    double high[3];
    double diagonal; // length
} DipModelBounds;

// bounds.c: computes the bounds over all moments of the model's motion, and the distance of the
// near plane that suits them. The bounds return false when memory runs out.
bool dip_model_bounds(const DipModel *model, DipModelBounds *to);
float dip_model_near_distance(const DipModelBounds *bounds);

// lights.c: adds the lights of an imported file to the model. world: see dip_model_up_transform.
// Lights that cannot be drawn give a warning. Fails when memory runs out.
bool dip_model_read_lights(DipModel *model, const DipModelFile *file, const double world[12],
                           DipError *err);

// lights.c: adds a light, or warns that it is left out. A light without strength does not count.
// Fails when memory runs out.
bool dip_model_add_light(DipModel *model, const char *file, const DipLightDef *light,
                         DipError *err);

// lights.c: warns of the lights that were left out since there were left_out_before of them.
void dip_model_warn_of_lights(DipModel *model, const char *file, int left_out_before);

// lights.c: returns what is wrong with a light, "its ...", or NULL if it is within the ranges of
// renderer/scene/lights.h. Fields that the light's kind does not use must be in range, too, but may
// be 0.
const char *dip_light_fault(const DipLightDef *light);

// lighting.c: checks the options that concern light.
bool dip_model_check_lights(const DipModelOptions *options, DipError *err);

// lighting.c: scales the lights of all files and describes them in the model's scene.
void dip_model_scale_lights(DipModel *model, const DipModelBounds *bounds);

// lighting.c: completes the lighting of a loaded model as the options say: adds the caller's lights
// and the ambient light. Fails when memory runs out.
bool dip_model_light(DipModel *model, const DipModelLoad *load, DipError *err);

// flat.c: gives every triangle of the lit meshes vertices of its own, with the normal of its face.
// Fails when memory runs out.
bool dip_model_flatten(DipModel *model, DipError *err);

// motion.c: adds the name of an animation to the model's list. Returns false when memory runs out.
bool dip_model_note_clip(DipModel *model, const char *name);

// motion.c: returns which of a file's animations plays, or DIP_NOT_FOUND.
int dip_model_choose_clip(const DipModel *model, const char *const *names, int count);

// motion.c: fails with UNKNOWN if no file has the animation that shall play.
bool dip_model_check_animation(const DipModel *model, DipError *err);

// motion.c: add a copy of a rig, and what moves with the rig that is added next. Objects and meshes
// are added in their order in the scene. The arrays of a mesh belong to the model. Return false
// when memory runs out.
bool dip_model_add_rig(DipModel *model, const DipMotionRig *rig);
bool dip_model_add_moving_object(DipModel *model, const DipMovingObject *object);
bool dip_model_add_moving_mesh(DipModel *model, const DipMovingMesh *mesh);

// motion.c: describes the motion in the model's scene, if anything moves. Returns false when memory
// runs out.
bool dip_model_finish_motion(DipModel *model);

// motion.c: gives the `count` corners of a mesh vertices of their own in its motion, if it has any.
// The mesh then has the normals of its triangles. Returns false when memory runs out.
bool dip_model_flatten_motion(DipModel *model, int mesh, const uint32_t *indices, uint32_t count);

// animation/md2_scene.c: reads the key frames of an MD2 file and chooses the animation that plays.
// If they cannot be read, warns, and the file stands still. Fails when memory runs out.
bool dip_model_read_key_frames(DipModel *model, DipModelFile *file, DipError *err);

// animation/md2_scene.c: adds the mesh of a file with key frames, which moves as the animation
// says, and returns its index, or DIP_NOT_FOUND on failure. index: that of the file. root: the
// transform of the whole file.
int dip_model_key_frame_mesh(DipModel *model, int index, unsigned source, int material,
                             const double root[12], DipError *err);

// mesh.c: true if a processed mesh consists of triangles.
bool dip_mesh_is_triangles(const struct aiMesh *mesh);

// How the colours of a mesh's vertices are read.
typedef struct DipColourReader {
    const struct aiColor4D *colours;
    bool linear;       // true: the colours are linear, as in glTF
    bool signed_bytes; // true: the colours are bytes that were read as signed numbers
} DipColourReader;

// colours.c: true if the mesh has vertex colours. Colours that are all black with an alpha of 0 are
// none, except in glTF.
bool dip_mesh_has_colours(const struct aiMesh *mesh, bool linear);
void dip_mesh_colours(const struct aiMesh *mesh, bool linear, DipColourReader *reader);

// colours.c: writes the linear colour of a vertex.
void dip_read_colour(const DipColourReader *reader, unsigned vertex, float to[3]);

// up_axis.c: writes the transform (rows of a 3x4 matrix) that turns an imported file so that +Y is
// up.
void dip_model_up_transform(const DipModel *model, const DipModelFile *file, double world[12]);

// precheck.c: refuses files that would make assimp run out of stack, memory or time.
bool dip_model_precheck(const char *path, DipError *err);

// import.c: refuses a file that is missing, empty or no regular file, or has another ending than
// those of models.
bool dip_model_check_file(const char *path, DipError *err);

// import.c: imports and checks a file with assimp, and sets file->scene.
bool dip_model_import(DipModel *model, DipModelFile *file, DipError *err);

// The arrays of a mesh's vertices: positions, normals, two sets of texture coordinates, colours and
// alphas.
// The array of an attribute that the mesh lacks is NULL.
enum { DIP_ATTRIBUTE_COUNT = 6 };
typedef struct DipVertexArrays {
    float *values[DIP_ATTRIBUTE_COUNT];
} DipVertexArrays;

// mesh.c: merges vertices that are equal in every bit of every attribute, and gives the arrays to
// *def. *remap maps old indices to new ones. Returns false when memory runs out.
bool dip_model_join(DipModel *model, const DipVertexArrays *arrays, uint32_t count, DipMeshDef *def,
                    uint32_t **remap);

// mesh.c: finds a mesh, or returns DIP_NOT_FOUND. Adds a mesh, or returns DIP_NOT_FOUND when memory
// runs out.
int dip_model_find_mesh(const DipModel *model, const DipMeshKey *key);
int dip_model_add_mesh(DipModel *model, const DipMeshDef *def, const DipMeshKey *key);

// mesh.c: returns the index of the mesh with this material. Adds the mesh if it is new. Returns
// DIP_NOT_FOUND on failure.
int dip_model_mesh(DipModel *model, int file, unsigned source, int material, DipError *err);

// mesh.c: normalises n. A vector that is zero or not finite becomes +Y. (The normal of a face
// without area is such a vector.)
void dip_model_unit_normal(const double n[3], float to[3]);

// normals.c: makes normals for a mesh of triangles, three floats per corner, smooth where faces
// meet at less than 60 degrees. The model owns them. Returns NULL when memory runs out.
float *dip_model_make_normals(DipModel *model, const struct aiMesh *mesh);

// material.c: returns the index of the material for this mesh in an object with this tag. Adds the
// material if it is new. Returns DIP_NOT_FOUND on failure.
int dip_model_material(DipModel *model, int file, const struct aiMesh *mesh, DipTag tag,
                       bool light_mapped, DipError *err);

// material.c: finds the material that a plan describes, or returns DIP_NOT_FOUND. Adds a material,
// or fills *err and returns DIP_NOT_FOUND when memory runs out.
int dip_model_find_material(const DipModel *model, const DipMaterialPlan *plan);
int dip_model_add_material(DipModel *model, const DipMaterialDef *def, const DipMaterialPlan *plan,
                           DipError *err);

// material.c: sets the highlight of glTF's materials. specular_lin: light that the surface mirrors
// straight back.
void dip_material_set_highlight(DipMaterialDef *def, float roughness, const float specular_lin[3]);

// pictures.c: finds a file that a model names. Returns the path of the file, or the first path
// tried if there is no such file. The caller frees the path. Returns NULL when memory runs out.
char *dip_model_find_file(const char *model_path, const char *file_path);

// pictures.c: registers a picture of a material and returns its index, or DIP_NO_TEXTURE when
// memory runs out.
int dip_model_picture(DipModel *model, int file, const char *path);

// pictures.c: the same for a picture file inside a model. The bytes stay until the load ends.
int dip_model_picture_bytes(DipModel *model, int file, const char *name, const uint8_t *bytes,
                            size_t size_bytes);

// pictures.c: the same for a picture file beside a model, as glTF names it.
int dip_model_picture_beside(DipModel *model, int file, const char *path);

// pictures.c: the same for a picture file that is not looked for in the model's folder.
int dip_model_picture_file(DipModel *model, int file, const char *path);

// material_rules.c: true if the name fits the pattern of a DipMaterialRule.
bool dip_material_name_fits(const char *pattern, const char *name);

// material_rules.c: changes the plan's tag, light_mapped and light_rule as the rules say.
void dip_model_apply_rules(const DipModel *model, const char *name, DipMaterialPlan *plan);

// material_rules.c: fails with UNKNOWN if a rule fits no material of the imported files. Warns of
// rules that fit only materials that no surface uses.
bool dip_model_check_rules(DipModel *model, DipError *err);

// material_rules.c: fails if the light map of a rule could not be decoded.
bool dip_model_check_light_maps(const DipModel *model, DipError *err);

// pictures.c: decodes all registered pictures on the pool. A picture that is
// missing or cannot be decoded gives a warning. Fails when memory runs out.
bool dip_model_decode_pictures(DipModel *model, DipPool *pool, DipError *err);

// material.c: makes the textures from the decoded pictures and decides which surfaces are opaque.
bool dip_model_finish_materials(DipModel *model, DipError *err);

#endif
