// A frame that is being drawn: its plan, its passes, and what drawing them has counted so far.
// Private to the renderer.
#ifndef DIP_RENDERER_SCENE_DRAW_FRAME_SETUP_H
#define DIP_RENDERER_SCENE_DRAW_FRAME_SETUP_H

#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/draw/box.h"
#include "renderer/scene/draw/renderer_parts.h"
#include "renderer/scene/plan/plan.h"
#include "renderer/scene/view/view.h"

// It must not be copied, because its members point to each other.
typedef struct DipFrameSetup {
    DipRenderer *renderer;
    const DipScene *scene;
    DipFrame *frame;
    DipView view;
    DipView mirrored;
    DipCullPlanes seen;
    DipCullPlanes seen_mirrored;
    DipParts parts;
    DipReflectionDef reflection; // the renderer's, in the size at which it is drawn
    DipPlanInput input;
    DipFramePlan plan;
    DipShadowFit shadow_fit; // the next two are made only if the plan runs the shadows
    DipPass shadow_pass;
    DipPass mirrored_pass; // made only if the plan runs the reflection
    DipPass backdrop_pass; // made only if the plan runs the scattering
    DipPass pass;
    DipBoxFilter box;                    // used only if a render scale draws a larger picture
    DipPipelineCounters counters;        // sums over all passes
    DipPipelineCounters shadow_counters; // of the shadow map alone
    uint64_t fragments_mirrored;
    uint64_t fragments_behind;
    uint64_t backdrop_texels;
    int64_t time_ns;
    double posing_ms;                  // how long it took to move the scene to the frame's time
    const DipSampleReadback *readback; // NULL unless samples are read
    // The frame, drawn at once, whose pixels this frame may copy; NULL if it shades them all.
    const struct DipFrameSetup *copies_from;
    DipPassWork *mirrored_work; // used while the mirrored passes are drawn
} DipFrameSetup;

// Returns how many tiles a picture of this width or height has along it.
static inline int dip_frame_tiles(int size) {
    return (size + DIP_TARGET_TILE - 1) / DIP_TARGET_TILE;
}

// Sets a frame up: plans it and makes its passes. first: the first of the frames that are drawn at
// once, or NULL if it is this one.
bool dip_frame_begin(DipFrameSetup *setup, DipRenderer *renderer, const DipScene *of,
                     const DipPose *pose, int64_t time_ns, const DipFrameSetup *first,
                     const DipSampleReadback *readback, DipFrame *frame, DipError *err);

#endif
