// Loads model files (glTF, OBJ, X, PLY, STL and other formats that assimp reads) and the pictures
// that they name into one scene description for the renderer. Diptych reads glTF 2 itself.
//
// docs/models.md explains for authors what the loader reads. In short:
// - Polygons are triangulated. Points and lines are left out with a warning.
// - A mesh without normals gets normals: in glTF those of its triangles; in other formats they are
//   smooth where faces meet at less than 60 degrees.
// - Files of glTF 2 and MD2 may play an animation (DipModelOptions.animation). Without one, skins
//   and morph targets have their shape at rest, and an MD2 model that of its first frame.
//   Animations of other formats are not played.
// - A mesh that several nodes use stays one mesh with several objects. A node that mirrors uses the
//   same mesh; the renderer turns the winding back (docs/picture.md, Coverage).
// - Base colours and vertex colours are linear in glTF. In all other formats they are taken as
//   sRGB, because the programs that write these formats show them so.
// - Outside glTF, a black base colour with a colour texture counts as white, because many exporters
//   write black for "none".
// - In glTF, MASK keeps its cutoff, and BLEND and transmission become blended surfaces. In other
//   formats a surface with an opacity picture is clipped where the opacity is below 0.5. A
//   surface whose texture is opaque throughout is an opaque surface.
// - A surface is double-sided if the file says so. In formats that cannot say so, every surface is
//   double-sided.
// - Two keys of a node's metadata (glTF: extras) are read. A node that lacks a key takes its value
//   from the nearest node above that has the key. `surface` is solid, mask, glass, water or sky.
//   `lightmapped` is 1 if the material's occlusion picture is a light map that stores light / 2.
//   Light maps of other formats store the light itself.
// - Rules (DipMaterialRule) mark materials by their names instead.
// - Solid and mask surfaces without a light map are lit by the lights of the files and of the
//   options. Without any light, the renderer's fixed light lights them.
// - Roughness comes from glTF, or is 0.6 in other formats. Lit surfaces of glTF have a DipPbrDef.
// - A sky's texture is data (DipSkyDef), not colour, and is read as linear.
// - Texture coordinates have v = 0 at the picture's upper edge.
#ifndef DIP_ASSETS_MODEL_H
#define DIP_ASSETS_MODEL_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"
#include "renderer/base/pool.h"
#include "renderer/scene/scene.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// A loaded model. It owns the arrays, texts and texels that its scene description points to. It
// never changes after loading, so any number of threads may read it.
typedef struct DipModel DipModel;

enum { DIP_MAX_MODEL_FILES = 256, DIP_MAX_MATERIAL_RULES = 256, DIP_MAX_LIGHT_SCALE = 1000000 };

// Loads 1..DIP_MAX_MODEL_FILES files into one description. The caller owns the model and destroys
// it with dip_model_destroy. If any file fails, returns NULL and fills *err (may be NULL) with the
// file and the reason. Some faults leave a usable model and are only added to *warnings (may be
// NULL). For example, a surface whose picture is missing is drawn in its base colour. The pool (may
// be NULL) reads and decodes pictures in parallel; no other thread may use the pool meanwhile.
//
// Codes: MISSING (no such file, or no triangle), IO, TRUNCATED, FORMAT (not a supported format, or
// malformed), UNSUPPORTED (a required glTF extension, or a packed model whose library this build
// lacks), RANGE (an index out of range; a position or transform that is not finite; a picture of
// more than 8192 pixels in a direction), OVERSIZED (a picture file), RUNTIME, MEMORY. A broken
// picture only adds a warning. The code of a warning is MISSING if a picture is missing, otherwise
// UNSUPPORTED.
//
// Threads: different models may be loaded at the same time on different threads.
//
// The files are read in this process. importer.h explains how to read untrusted files safely.
//
// This function loads no normal maps, so the materials have none.
DIP_API DipModel *dip_model_load(const char *const *files, int file_count, DipPool *pool,
                                 DipErrorList *warnings, DipError *err);

// Like dip_model_load, but also loads normal maps.
DIP_API DipModel *dip_model_load_with_normals(const char *const *files, int file_count,
                                              DipPool *pool, DipErrorList *warnings, DipError *err);

// Which axis of a model file points up, as X(name, "what it means", for the help). Diptych's own +Y
// is up. docs/models.md lists the rules of `auto`.
#define DIP_UP_AXIS_LIST(X)                                                                        \
    X(auto, "follows the file or the custom of its format")                                        \
    X(y, "leaves the model as it is read")                                                         \
    X(z, "turns the model so that its z axis points up")

typedef enum DipUpAxis {
#define DIP_UP_ENUM(name, text) DIP_UP_##name,
    DIP_UP_AXIS_LIST(DIP_UP_ENUM)
#undef DIP_UP_ENUM
        DIP_UP_COUNT
} DipUpAxis;

// The axes by name: "auto", "y", "z".
extern DIP_API const char *const dip_up_axis_names[DIP_UP_COUNT];

// What a rule says about the materials whose names fit its pattern. All but LIGHT_MAP say what kind
// of surface they are, like `surface` in the metadata of a node.
typedef enum DipMaterialMark {
    DIP_MARK_SOLID,
    DIP_MARK_CLIP, // `mask` in the metadata.
    DIP_MARK_GLASS,
    DIP_MARK_WATER,
    DIP_MARK_SKY,
    DIP_MARK_LIGHT_MAP, // A light map that stores light / 2, like `lightmapped` in the metadata.
    DIP_MARK_COUNT
} DipMaterialMark;

// A rule that marks materials by name, for formats whose files cannot carry tags. A rule outranks
// the metadata of the nodes, and a later rule outranks an earlier one.
typedef struct DipMaterialRule {
    DipMaterialMark mark;
    // Name of the materials in the model files. `*` stands for any text, also an empty one, and `?`
    // for one character.
    const char *pattern;
    // LIGHT_MAP: file of the light map, or NULL for the light map that the model names. The mesh's
    // second set of texture coordinates places the file's picture, or the first if it has only one.
    const char *light_map;
    // Where the user gave the rule, for messages. file and key may be NULL.
    const char *file;
    int line;
    const char *key;
} DipMaterialRule;

// Where the light of lit surfaces is computed, as X(name, "what it means", for the help).
#define DIP_MODEL_SHADING_LIST(X)                                                                  \
    X(auto, "is phong in a scene with lights; without lights, the fixed light stays as it is")     \
    X(flat, "computes the light at the vertices, with the normal of each triangle")                \
    X(gouraud, "computes the light at the vertices")                                               \
    X(phong, "computes the light at every fragment")

typedef enum DipModelShading {
#define DIP_MODEL_SHADING_ENUM(name, text) DIP_MODEL_SHADING_##name,
    DIP_MODEL_SHADING_LIST(DIP_MODEL_SHADING_ENUM)
#undef DIP_MODEL_SHADING_ENUM
        DIP_MODEL_SHADING_COUNT
} DipModelShading;

// The kinds of shading by name: "auto", "flat", ...
extern DIP_API const char *const dip_model_shading_names[DIP_MODEL_SHADING_COUNT];

// Ambient light of a scene with lights, in each channel, unless the options give another. It is the
// sRGB code 89, about a tenth of white.
#define DIP_MODEL_AMBIENT_LIN 0.0998987f

// Which animation of each file plays.
typedef enum DipModelAnimation {
    DIP_MODEL_ANIMATION_NONE,
    DIP_MODEL_ANIMATION_FIRST,
    DIP_MODEL_ANIMATION_NAMED, // files without one of this name stand still
} DipModelAnimation;

// The key of the error that a load fails with because no file has the named animation.
#define DIP_MODEL_ANIMATION_KEY "animation"

// How dip_model_load_with loads a model. A zeroed struct, or NULL in its place, gives what
// dip_model_load does.
typedef struct DipModelOptions {
    bool normal_maps; // True: normal maps are loaded, too.
    DipUpAxis up;     // Holds for every file.
    // Rules that mark materials: 0..DIP_MAX_MATERIAL_RULES. Used only during the load.
    const DipMaterialRule *rules;
    int rule_count;
    // All but `auto` need lights. If there are none, the lights are those of dip_lighting_fixed.
    DipModelShading shading;
    // Lights beside those of the files: 0..DIP_MAX_LIGHTS, which the load copies. If there are more
    // than DIP_MAX_LIGHTS together, a warning says how many lights of the files are left out.
    const DipLightDef *lights;
    int light_count;
    // Ambient light of a scene with lights, three numbers 0 or more; NULL: DIP_MODEL_AMBIENT_LIN.
    // The ambient lights of the files are added to it.
    const float *ambient_lin;
    // Multiplies the lights of the files, 0..DIP_MAX_LIGHT_SCALE; 0 ignores them. If
    // has_light_scale is false, the factor makes their light 1 at the models' centre
    // (docs/models.md, Lights).
    bool has_light_scale;
    double light_scale;
    DipModelAnimation animation;
    const char *animation_name; // NAMED: its name. Used only during the load.
    bool animation_is_held;     // true: the animation stands still at animation_held_s
    double animation_held_s;    // finite
    // The program that imports the files in a process of its own. NULL: the files are imported in
    // this process, where a bad file can crash the libraries that read it. Use NULL for trusted
    // files only.
    const struct DipImporter *importer;
} DipModelOptions;

// Like dip_model_load, but with options. If options->importer is not NULL, the pool only says how
// many threads the importer uses. Further codes: RUNTIME (the importer crashed or cannot be
// started), OVERSIZED (the importer needed more memory or time than its limits), UNKNOWN (a rule
// fits no material; file, line and key are the rule's; or no file has the named animation: the key
// is DIP_MODEL_ANIMATION_KEY), and all codes of a light map that a rule
// names and that cannot be read.
DIP_API DipModel *dip_model_load_with(const char *const *files, int file_count,
                                      const DipModelOptions *options, DipPool *pool,
                                      DipErrorList *warnings, DipError *err);

// Destroys the model and sets the pointer to NULL. Accepts a pointer to NULL.
DIP_API void dip_model_destroy(DipModel **model);

// Durations of the parts of a load, in milliseconds.
typedef struct DipModelTimes {
    double import_ms;   // from model files to meshes and materials
    double pictures_ms; // reading and decoding pictures
} DipModelTimes;
DIP_API DipModelTimes dip_model_times(const DipModel *model);

// The names of parts of a model, for a message: `none, "Run", "Walk" and 3 more`. Begin it with a
// text or with zeros.
typedef struct DipNameList {
    char text[200];
    int left_out; // Number of names that did not fit.
} DipNameList;

// Adds the first 70 bytes of a name on one line, unless the list has it. A name that does not fit
// is counted.
DIP_API void dip_name_list_add(DipNameList *list, const char *name);

// Ends the text with the number of names that did not fit, and returns the text.
DIP_API const char *dip_name_list_end(DipNameList *list);

// Returns the names of the animations of all files, each once, in the order of the files. They
// belong to the model.
DIP_API const char *const *dip_model_animations(const DipModel *model, int *count);

// The description belongs to the model and is valid until the model is destroyed. dip_scene_create
// copies what it needs.
DIP_API const DipSceneDef *dip_model_scene_def(const DipModel *model);

#ifdef __cplusplus
}
#endif

#endif
