// The plan of a frame: which passes and which parts of their targets it needs, which effects run in
// them, and why not the rest. Made before anything is drawn, from the scene, the views, the
// settings and what is coarsely in view.
//
// Every row of DIP_EFFECT_LIST (renderer/scene/frame.h) has one function in plan.c that decides it;
// an effect that the plan skips could not change the picture.
#ifndef DIP_RENDERER_SCENE_PLAN_PLAN_H
#define DIP_RENDERER_SCENE_PLAN_PLAN_H

#include "renderer/pipeline/cull.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/draw/view.h"
#include "renderer/scene/frame.h"
#include "renderer/scene/plan/parts.h"
#include "renderer/scene/quality.h"
#include "renderer/scene/reflection.h"
#include "renderer/scene/scene.h"

#include <stdbool.h>

typedef struct DipPlanInput {
    const DipScene *scene;
    const DipView *view;
    const DipView *mirrored;   // as water shows it
    const DipCullPlanes *seen; // of the views
    const DipCullPlanes *seen_mirrored;
    const DipParts *parts; // of the mirrored picture; filled in where the plan says so
    const DipReflectionDef *reflection;
    const DipQuality *quality;
    bool plain_surfaces;
    bool force_all; // every effect that the scene has, everywhere: the same picture
} DipPlanInput;

typedef struct DipFramePlan {
    DipEffects effects;
    // Water shows the mirrored scene: the eye is above the plane. Does not depend on what is in
    // view.
    bool water_reflects;
    DipTargetRegion mirrored_region; // what the mirrored pass draws of its target, if it runs
    bool mirrored_parts;             // of the region only the input's parts
    int samples_per_group;           // of alpha-clipped surfaces
} DipFramePlan;

DipFramePlan dip_plan_frame(const DipPlanInput *input);

// After the frame is drawn: says of what was in view, but wholly covered, that it did not run.
void dip_plan_settle(const DipPlanInput *input, const DipCounters *counters, DipEffects *effects);

#endif
