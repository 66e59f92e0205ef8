// What metallic-roughness surfaces keep for a scene. Private to the renderer.
#ifndef DIP_RENDERER_SCENE_RESOURCES_PBR_H
#define DIP_RENDERER_SCENE_RESOURCES_PBR_H

#include "renderer/scene/materials/pbr.h"
#include "renderer/scene/resources/environment.h"
#include "renderer/scene/resources/lighting.h"
#include "renderer/scene/scene.h"

#include <stdbool.h>

// Exists only in scenes that have a metallic-roughness surface.
typedef struct DipScenePbr {
    DipSceneLighting *fixed; // the fixed light, in a scene without lights of its own; or NULL
    DipEnvironmentMap *environment; // NULL: the surroundings of the lighting
    DipSheen *sheens; // one per mesh; those of meshes without sheen are not used. NULL: none has it
    DipPbrUniforms surfaces[]; // one per mesh; meshes without such a surface do not use theirs
} DipScenePbr;

// Returns whether the surface of a mesh is drawn by its metallic-roughness description: it must be
// lit and have normals, and no light map. Water and sky are drawn without.
bool dip_mesh_has_pbr(const DipSceneDef *def, const DipMeshDef *mesh);

// Creates *pbr on the pool, or sets it to NULL if the scene has no such surface. Fails with
// DIP_ERROR_MEMORY.
bool dip_scene_pbr_create(const DipSceneDef *def, DipPool *pool, DipScenePbr **pbr, DipError *err);
void dip_scene_pbr_destroy(DipScenePbr **pbr);

// Describes the surface of a mesh. uv0 and uv1: index of the first varying of each set of texture
// coordinates, or DIP_ABSENT.
DipPbrUniforms dip_pbr_surface(const DipSceneDef *def, const DipMeshDef *mesh, int uv0, int uv1);

// Returns the transmission of a material: 0 unless it is blended.
static inline float dip_pbr_transmission(const DipMaterialDef *material) {
    const bool blended = material->surface == DIP_SURFACE_BLENDED;
    return blended && material->pbr ? material->pbr->transmission : 0.0f;
}

// Returns how much a material blurs what is seen through it: 0 unless it transmits, and its blur is
// more than half a thousandth of the picture's width.
static inline float dip_pbr_scattering(const DipMaterialDef *material) {
    const DipPbrDef *pbr = dip_pbr_transmission(material) > 0.0f ? material->pbr : NULL;
    const bool visible = pbr && pbr->roughness * pbr->scattering > 0.1f;
    return visible ? pbr->scattering : 0.0f;
}

// Gives a surface its sheen, if it has one, which is kept in *sheen. sheen may be NULL where no
// surface has one.
void dip_pbr_add_sheen(const DipPbrDef *def, DipSheen *sheen, DipPbrUniforms *surface);

// The textures of a metallic-roughness material that are drawn, or DIP_NO_TEXTURE.
typedef struct DipPbrMaps {
    int metal_rough;
    int occlusion;
    int emission;
} DipPbrMaps;
DipPbrMaps dip_pbr_maps(const DipMaterialDef *material);

// Returns whether the mesh has maps of its metallic-roughness surface at uv0 (set 0) or uv1 (1).
bool dip_pbr_uses_set(const DipMaterialDef *material, int set);

#endif
