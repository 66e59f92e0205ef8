// The inside of a renderer, shared by the code that creates it (renderer.c) and the code that draws
// its frames (draw/frames.c).
#ifndef DIP_RENDERER_SCENE_DRAW_RENDERER_PARTS_H
#define DIP_RENDERER_SCENE_DRAW_RENDERER_PARTS_H

#include "renderer/base/srgb.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/draw/backdrop.h"
#include "renderer/scene/draw/draws.h"
#include "renderer/scene/draw/shadow_map.h"
#include "renderer/scene/finish.h"
#include "renderer/scene/renderer.h"
#include "renderer/scene/resources/instancing.h"
#include "renderer/scene/resources/posed.h"
#include "renderer/scene/view/view.h"

// The resources of the reflection. All members are 0 unless the scene that was drawn last has
// reflecting water.
typedef struct DipMirror {
    DipPipeline *pipeline;
    DipTarget target;            // the picture of the mirrored scene
    DipTileRegion *tile_regions; // for each tile of the target, the part that water can show
    DipDrawSet set;
    // One per material; NULL where the mirrored scene is sampled as the frame is.
    DipMaterialSamplers *samplers;
} DipMirror;

// The larger or smaller picture that a render scale draws. All members are 0 while a frame is drawn
// at its own size. A smaller picture is enlarged by the filters of the finished picture.
typedef struct DipScaled {
    DipPipeline *pipeline;
    DipTarget target;
    // What averages a larger picture (box.h); NULL for a smaller one.
    uint16_t *light16; // NULL for twice the size, too
    DipSrgbEncodeTable *codes;
} DipScaled;

// What the last frame of a renderer with a history showed.
typedef struct DipPast {
    bool exists;
    uint64_t frame_index;
    int64_t time_ns;
    uint64_t scene_serial;
    DipQuality quality;
    DipView view; // with its shift
} DipPast;

struct DipRenderer {
    DipPool *pool;
    DipIsa isa;
    int width;
    int height;
    DipQuality quality;
    uint64_t frame_index;
    DipPipeline *pipeline;
    uint8_t *rgba8;
    size_t stride_bytes;
    DipScaled scaled;
    DipTexture *mip_colours; // the levels that mip debugging shows, see dip_mip_debug_create
    DipReflectionDef reflection;
    bool plain_surfaces;
    bool force_all_effects;
    bool copies_shading;        // see dip_renderer_copy_shading
    DipTileRecording recording; // owned; its arrays are NULL unless tiles are recorded
    DipFinish *finish;          // the filters of the settings
    DipPast past;
    DipSkyUniforms sky; // the sky at the frame's time; set only if the frame shows clouds

    // Resources for the scene that was drawn last.
    uint64_t scene_serial; // DipScene.serial of that scene; 0: there is none
    bool reserved;         // the pipeline has reserved the memory for the scene
    DipDrawSet set;
    DipMirror mirror;
    DipShadows shadows;
    DipBackdropParts backdrop;     // of the size of the picture that the main pass draws
    DipMaterialSamplers *samplers; // one per material
    DipUnsharedMeshes *unshared;   // one mesh per object with gi=off; NULL with gi=on
    DipPosedScene *posed;          // the scene at the time of a frame; NULL if it has no motion
};

// Returns the picture that the renderer's main pass draws, and the pipeline that draws it: those of
// the picture of a render scale, or the frame itself.
DipTarget dip_renderer_target(const DipRenderer *renderer);
DipPipeline *dip_renderer_pipeline(const DipRenderer *renderer);

// Creates or frees the picture of a render scale. Forgets the scene if its reflection needs another
// size.
bool dip_renderer_follow_scale(DipRenderer *renderer, DipError *err);

// Creates the resources for a scene. Does nothing if the scene is the one that was drawn last.
bool dip_renderer_adopt_scene(DipRenderer *renderer, const DipScene *scene, DipError *err);

// Creates or frees resources that depend on the settings.
bool dip_renderer_follow_settings(DipRenderer *renderer, const DipScene *scene, DipError *err);

// Returns the input from which the draws of a pass are made. mirrored: the pass draws the mirrored
// scene.
DipDrawInput dip_renderer_draw_input(const DipRenderer *renderer, const DipScene *scene,
                                     bool mirrored);

#endif
