// Draws the shadow map: the scene as its strongest directional light sees it, as depths alone.
// Private to the renderer.
#ifndef DIP_RENDERER_SCENE_DRAW_SHADOW_MAP_H
#define DIP_RENDERER_SCENE_DRAW_SHADOW_MAP_H

#include "renderer/base/error.h"
#include "renderer/base/isa.h"
#include "renderer/base/pool.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/draw/draws.h"
#include "renderer/scene/draw/shadow_fit.h"

#include <stdbool.h>

// The resources of a renderer's shadows. All members are 0 unless its settings ask for shadows and
// the scene that was drawn last can have them.
typedef struct DipShadows {
    DipPipeline *pipeline;
    DipDepth *depth;
    DipDrawSet set;
    DipMaterialSamplers *samplers; // one per material
} DipShadows;

// Creates the resources for a map of size x size texels, and reserves the memory for its pass. If
// the call fails, the caller must still free them.
bool dip_shadows_make(DipShadows *shadows, const DipScene *scene, DipPool *pool, DipIsa isa,
                      int size, DipError *err);
void dip_shadows_free(DipShadows *shadows);

// Makes the pass that draws the map. Allocates nothing.
void dip_shadows_fill(DipShadows *shadows, const DipScene *scene, const DipMaterialKernels *kernels,
                      const DipShadowFit *fit, DipPass *pass);

// Computes what surfaces read of the map, as an eye in world space sees them.
void dip_shadow_at(const DipShadows *shadows, const DipScene *scene, const DipShadowFit *fit,
                   const double eye[3], DipShadowUniforms *uniforms);

#endif
