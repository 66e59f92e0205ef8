// The plan of a frame: which passes it needs, which parts of their targets, and which effects run
// in them. For every effect the plan gives the reason why it runs or not. It is made before
// anything is drawn, from the scene, the views, the settings and the bounding boxes that are in
// view.
//
// Every row of DIP_EFFECT_LIST (renderer/scene/frame.h) has one function in plan.c that decides it.
// An effect that the plan skips could not change the picture.
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
    const DipView *mirrored;            // the view of the mirrored scene
    const DipCullPlanes *seen;          // the planes around what `view` sees
    const DipCullPlanes *seen_mirrored; // the planes around what `mirrored` sees
    const DipParts *parts; // parts of the mirrored picture; written if the plan has mirrored_parts
    const DipReflectionDef *reflection;
    const DipQuality *quality;
    bool plain_surfaces;
    bool force_all; // run every effect that the scene has, everywhere; the picture is the same
} DipPlanInput;

typedef struct DipFramePlan {
    DipEffects effects;
    // The eye is above the mirror plane, so that water shows the mirrored scene. This does not
    // depend on what is in view.
    bool water_reflects;
    DipTargetRegion mirrored_region; // the region of its target that the mirrored pass draws
    bool mirrored_parts;             // within the region, only the input's parts are drawn
    int samples_per_group;           // for alpha-clipped surfaces
} DipFramePlan;

DipFramePlan dip_plan_frame(const DipPlanInput *input);

// Corrects the effects after the frame is drawn: an effect that was planned to run, but of which no
// fragment was visible, did not run.
void dip_plan_settle(const DipPlanInput *input, const DipCounters *counters, DipEffects *effects);

#endif
