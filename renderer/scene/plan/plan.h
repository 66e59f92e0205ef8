// The plan of a frame: the render passes of the frame, the parts of their targets that are drawn,
// and the effects (features such as the reflection) that run. For every effect the plan gives the
// reason why it runs or not. The plan is made before anything is drawn, from the scene, the views,
// the settings and the bounding boxes that are in view.
//
// Every row of DIP_EFFECT_LIST (renderer/scene/frame.h) has one function in plan.c that decides it.
// An effect that the plan skips could not change the picture.
#ifndef DIP_RENDERER_SCENE_PLAN_PLAN_H
#define DIP_RENDERER_SCENE_PLAN_PLAN_H

#include "renderer/pipeline/cull.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/frame.h"
#include "renderer/scene/plan/parts.h"
#include "renderer/scene/quality.h"
#include "renderer/scene/reflection.h"
#include "renderer/scene/scene.h"
#include "renderer/scene/view/view.h"

#include <stdbool.h>

typedef struct DipPlanInput {
    const DipScene *scene;
    const DipView *view;
    const DipView *mirrored;            // the view of the mirrored scene
    const DipCullPlanes *seen;          // the planes around what `view` sees
    const DipCullPlanes *seen_mirrored; // the planes around what `mirrored` sees
    // Receives, for each tile of the mirrored picture, the rectangle that must be drawn (parts.h).
    // Valid only if the plan sets mirrored_parts.
    const DipParts *parts;
    const DipReflectionDef *reflection;
    int backdrop_width; // pixels of the backdrop of rough glass; 0: the renderer has none
    int backdrop_height;
    const DipQuality *quality;
    bool plain_surfaces;
    bool force_all; // see DipRendererDef.force_all_effects
} DipPlanInput;

typedef struct DipFramePlan {
    DipEffects effects;
    // True if water shows the mirrored scene: the reflection is on and the eye is above the mirror
    // plane. This does not depend on what is in view.
    bool water_reflects;
    DipTargetRegion mirrored_region; // the part of the mirrored pass's target that is drawn
    bool mirrored_parts;             // true: a tile draws only its part (DipPlanInput.parts)
    DipTargetRegion backdrop_region; // the part of the backdrop of rough glass that is drawn
    int samples_per_group;           // samples per sample group of alpha-clipped surfaces
} DipFramePlan;

DipFramePlan dip_plan_frame(const DipPlanInput *input);

// Corrects the effects after the frame is drawn. An effect that was planned to run counts as
// skipped if no fragment of it was visible. copied: counters of the frame whose pixels this frame
// has copied, or NULL. Fragments of that frame count as visible, since copied ones are among them.
void dip_plan_settle(const DipPlanInput *input, const DipCounters *counters,
                     const DipCounters *copied, DipEffects *effects);

// Whether two frames shade a pixel that shows one surface alone with the same colour. This is so if
// the settings differ only in samples: all other settings may change what fragment shaders read.
// Mip colours are each renderer's own.
bool dip_plan_shades_alike(const DipQuality *a, const DipQuality *b);

#endif
