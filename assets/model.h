// Model files (glTF, OBJ, X, PLY, STL and what else assimp reads) and the pictures they name, as
// one scene description for the renderer.
//
// What is taken over, and how:
// - Triangles; polygons are triangulated, points and lines are left out with a warning. Missing
//   normals are made, smooth where faces meet at less than 60 degrees. A mesh that several nodes
//   use stays one mesh with several objects; a node that mirrors gets a copy of the mesh whose
//   winding is reversed, so that fronts are counter-clockwise in world space.
// - Base colours and vertex colours are linear in glTF; of all other formats they are taken to be
//   sRGB, as those formats' programs show them. A black base colour under a colour texture, which
//   many exporters write for "none", counts as white.
// - Alpha: glTF's MASK with its cutoff, its BLEND as MASK at 0.5 (with a warning); of other formats
//   opacity pictures, clipped at 0.5. A surface whose alpha never falls below the cutoff is opaque.
// - Sides: as the file says; of formats that cannot say, both are seen.
// - Node metadata (glTF: object extras) of a node or the nearest node above it: `surface` = solid,
//   mask, glass, water or sky, and `lightmapped` = 1 when the material's occlusion picture is a
//   light map stored as light / 2. Other formats' light maps are taken as they are.
// - Lit by the renderer's fixed light: what has no light map and is not sky, water or glass.
// - Roughness is glTF's; 0.6 where a file does not say. A sky's picture is data (DipSkyDef), not
//   colour, and is read as linear.
// - Texture coordinates have v = 0 at the picture's upper edge.
#ifndef DIP_ASSETS_MODEL_H
#define DIP_ASSETS_MODEL_H

#include "renderer/base/error.h"
#include "renderer/base/pool.h"
#include "renderer/scene/scene.h"

typedef struct DipModel DipModel;

enum { DIP_MAX_MODEL_FILES = 256 };

// Loads 1..DIP_MAX_MODEL_FILES files into one description. All or nothing: on failure returns NULL
// and fills *err (may be NULL) with the file and the reason. Faults one can look past, such as a
// picture that is not there (its surface is drawn in its base colour), are added to *warnings (may
// be NULL) with severity warning. Pictures are read and decoded on the pool (may be NULL:
// serially).
//
// Refused: a file that is missing, empty, truncated or of no readable format; an index out of
// range; a position or transform that is not finite; no triangle at all; a picture that is there
// but broken or larger than 8192 pixels. Different models may be loaded on different threads.
//
// Normal maps are neither looked for nor decoded: materials then have none.
DipModel *dip_model_load(const char *const *files, int file_count, DipPool *pool,
                         DipErrorList *warnings, DipError *err);

// The same with normal maps.
DipModel *dip_model_load_with_normals(const char *const *files, int file_count, DipPool *pool,
                                      DipErrorList *warnings, DipError *err);
void dip_model_destroy(DipModel **model);

// How long the parts of the load took, milliseconds.
typedef struct DipModelTimes {
    double import_ms;   // model files to meshes and materials
    double pictures_ms; // reading and decoding
} DipModelTimes;
DipModelTimes dip_model_times(const DipModel *model);

// Valid until the model is destroyed; dip_scene_create copies what it needs.
const DipSceneDef *dip_model_scene_def(const DipModel *model);

#endif
