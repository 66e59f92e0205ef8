// A pass' draws: the objects of a scene with the shaders that materials and settings ask for, as
// one view sees them. Private to the renderer.
#ifndef DIP_RENDERER_SCENE_DRAW_DRAWS_H
#define DIP_RENDERER_SCENE_DRAW_DRAWS_H

#include "renderer/base/error.h"
#include "renderer/pipeline/cull.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/draw/view.h"
#include "renderer/scene/materials/material_kernels.h"
#include "renderer/scene/materials/surface.h"
#include "renderer/scene/materials/water.h"
#include "renderer/scene/quality.h"
#include "renderer/scene/resources/instancing.h"
#include "renderer/scene/scene.h"

#include <stdbool.h>

typedef DipSampler DipMaterialSamplers[DIP_SURFACE_SAMPLER_COUNT];

// What all passes of a frame have in common.
typedef struct DipDrawInput {
    const DipScene *scene;
    const DipMaterialKernels *kernels;
    const DipQuality *quality;
    const DipMaterialSamplers *samplers; // per material
    const DipSkyUniforms *sky;
    const DipUnsharedMeshes *unshared; // NULL: objects share the scene's meshes
    bool plain_surfaces;
} DipDrawInput;

// What a pass has of its own.
typedef struct DipDrawView {
    const DipView *view;
    const DipCullPlanes *seen; // only what may lie within is drawn; NULL: all objects
    int width;                 // of the target, pixels
    int height;
    bool mirrored;          // windings turn around, and water is left out
    const DipTarget *shown; // by the water: the mirrored picture; NULL: water is plain
    bool schlick;
} DipDrawView;

// One pass' draws and all that they point to; 0 in all when empty.
typedef struct DipDrawSet {
    DipDraw *draws; // one per object that may be seen
    int count;
    DipSurfaceUniforms *uniforms; // of each
    DipWaterUniforms *water;      // likewise; NULL unless made for water that reflects
    DipViewRays rays;
} DipDrawSet;

bool dip_draw_set_make(DipDrawSet *set, int object_count, bool reflects, DipError *err);
void dip_draw_set_free(DipDrawSet *set);

// Fills the set anew; allocates nothing.
void dip_draw_set_fill(DipDrawSet *set, const DipDrawInput *input, const DipDrawView *pass);

// How each material's textures are read. shown: the levels of mip debugging.
void dip_set_samplers(const DipScene *scene, const DipQuality *quality, const DipTexture *shown,
                      DipMaterialSamplers *samplers);

#endif
