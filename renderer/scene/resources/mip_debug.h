// Mip debugging: the colours (or pictures) that stand for mip levels by their absolute size.
#ifndef DIP_RENDERER_SCENE_RESOURCES_MIP_DEBUG_H
#define DIP_RENDERER_SCENE_RESOURCES_MIP_DEBUG_H

#include "renderer/pipeline/texture.h"
#include "renderer/scene/renderer.h"

// A texture whose level i stands for levels of 1024 >> i texels. pictures: NULL, or one entry per
// level, of which NULL ones keep their flat colour.
DipTexture *dip_mip_debug_create(const DipTextureDef *pictures[DIP_MIP_DEBUG_LEVELS],
                                 DipError *err);

// For each level of a texture the debug level that stands for it.
void dip_mip_debug_levels(const DipTexture *texture, int32_t shown_level[DIP_LEVEL_TABLE]);

#endif
