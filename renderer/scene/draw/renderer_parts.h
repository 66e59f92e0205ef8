// Inside of a renderer: what its creation (renderer.c) and the drawing of frames
// (draw/frame_setup.c) share.
#ifndef DIP_RENDERER_SCENE_DRAW_RENDERER_PARTS_H
#define DIP_RENDERER_SCENE_DRAW_RENDERER_PARTS_H

#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/draw/draws.h"
#include "renderer/scene/renderer.h"
#include "renderer/scene/resources/instancing.h"

// What the reflection needs. All 0 while the scene has no water.
typedef struct DipMirror {
    DipPipeline *pipeline;
    DipTarget target;
    DipTileRegion *tile_regions; // of the target: what the water can show
    DipDrawSet set;
} DipMirror;

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
    DipTexture *mip_colours; // levels 1024 .. 8 of mip debugging
    DipReflectionDef reflection;
    bool plain_surfaces;
    bool force_all_effects;
    DipSkyUniforms sky; // the sky of this frame, set when a shader needs it

    // What was made for the scene drawn last.
    uint64_t scene_serial;
    bool reserved; // the pipeline has room for the scene
    DipDrawSet set;
    DipMirror mirror;
    DipMaterialSamplers *samplers; // per material
    DipUnsharedMeshes *unshared;   // made for gi=off, else NULL
};

// Makes what a scene that was not drawn before needs.
bool dip_renderer_adopt_scene(DipRenderer *renderer, const DipScene *scene, DipError *err);

// Creates or frees resources that depend on the settings.
bool dip_renderer_follow_settings(DipRenderer *renderer, const DipScene *scene, DipError *err);

// What the draws of every pass are made from.
DipDrawInput dip_renderer_draw_input(const DipRenderer *renderer, const DipScene *scene);

#endif
