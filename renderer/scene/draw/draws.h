// Makes the draws of a render pass. A draw is one object that the view can see, with the shaders
// that its material and the settings need. Private to the renderer.
#ifndef DIP_RENDERER_SCENE_DRAW_DRAWS_H
#define DIP_RENDERER_SCENE_DRAW_DRAWS_H

#include "renderer/base/error.h"
#include "renderer/base/pool.h"
#include "renderer/pipeline/cull.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/draw/blend_order.h"
#include "renderer/scene/materials/material_kernels.h"
#include "renderer/scene/materials/surface.h"
#include "renderer/scene/materials/water.h"
#include "renderer/scene/quality.h"
#include "renderer/scene/resources/instancing.h"
#include "renderer/scene/scene.h"
#include "renderer/scene/view/view.h"

#include <stdbool.h>

typedef DipSampler DipMaterialSamplers[DIP_SURFACE_SAMPLER_COUNT];

// Input that all passes of a frame share.
typedef struct DipDrawInput {
    const DipScene *scene;
    const DipMaterialKernels *kernels;
    const DipQuality *quality;
    const DipMaterialSamplers *samplers; // one per material
    const DipSkyUniforms *sky;
    const DipUnsharedMeshes *unshared; // NULL: objects share the scene's meshes
    bool plain_surfaces;
    bool all_lights; // lights are computed even on objects that they cannot reach
    DipPool *pool;   // makes the draws; NULL: the caller's thread makes them
} DipDrawInput;

// Input that differs from pass to pass.
typedef struct DipDrawView {
    const DipView *view;
    const DipCullPlanes *seen; // objects outside these planes are left out; NULL: all are drawn
    int width;                 // width of the target, in pixels
    int height;                // height of the target, in pixels
    bool mirrored; // true: draws the mirrored scene, so windings are reversed and water is left out
    const DipTarget *shown; // the mirrored picture that water shows; NULL: water is plain
    bool schlick;           // see DipReflectionDef
    // What lies behind rough glass; NULL: such glass shows it sharp.
    const DipBackdrop *backdrop;
    // The shadows that surfaces receive, with the eye of this view; NULL: there are none. It is
    // copied.
    const DipShadowUniforms *shadow;
} DipDrawView;

// The matrices of a draw that take the mesh's own coordinates to clip space; see DipDraw.
typedef struct DipDrawMatrices {
    DipExactTransform exact_to_clip;
    float bounds_to_clip[16];
} DipDrawMatrices;

// The draws of one pass and everything they point to. All members of an empty set are 0.
typedef struct DipDrawSet {
    // One per object that may be visible, and two for a double-sided blended object. Blended
    // objects come last, from far to near.
    DipDraw *draws;
    int count;
    int plain_count;              // draws that are not blended
    int culled;                   // objects that were left out because they are out of view
    DipSurfaceUniforms *uniforms; // one per draw
    DipDrawMatrices *matrices;    // one per draw
    DipWaterUniforms *water;      // one per draw; NULL if the set has no reflecting water
    DipBlendedObject *blended;    // the blended objects in view; NULL if the scene has none
    float *levels;                // the heights of blended water; as many as blended objects
    int level_count;
    int *plain;    // the objects of the draws that are not blended
    bool *in_view; // one per object
    DipViewRays rays;
    DipLightingUniforms lighting; // only if the scene has lights or metallic-roughness surfaces
    DipShadowUniforms shadow;     // only if surfaces receive shadows
} DipDrawSet;

// Allocates a set for the objects of a scene. reflects: the set may hold reflecting water. If the
// call fails (DIP_ERROR_MEMORY), the caller must still free the set.
bool dip_draw_set_make(DipDrawSet *set, const DipScene *scene, bool reflects, DipError *err);
void dip_draw_set_free(DipDrawSet *set);

// Replaces the set's draws by the draws of a pass. Allocates nothing.
void dip_draw_set_fill(DipDrawSet *set, const DipDrawInput *input, const DipDrawView *pass);

// Sets how the textures of each material are sampled. If mip colours are on (each mip level is
// shown as a flat colour or a picture), the levels of `shown` (dip_mip_debug_create) replace the
// levels of colour textures.
void dip_set_samplers(const DipScene *scene, const DipQuality *quality, const DipTexture *shown,
                      DipMaterialSamplers *samplers);

#endif
