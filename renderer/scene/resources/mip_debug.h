// Mip debugging: flat colours or pictures that replace mip levels according to their size in
// texels.
#ifndef DIP_RENDERER_SCENE_RESOURCES_MIP_DEBUG_H
#define DIP_RENDERER_SCENE_RESOURCES_MIP_DEBUG_H

#include "renderer/pipeline/texture.h"
#include "renderer/scene/renderer.h"

// Creates a texture whose level i replaces levels of 1024 >> i texels. If `pictures` is NULL, all
// levels are flat colours. Otherwise it has one picture per level; a level whose picture is NULL
// has a flat colour.
DipTexture *dip_mip_debug_create(const DipTextureDef *pictures[DIP_MIP_DEBUG_LEVELS],
                                 DipError *err);

// For each level of a texture, finds the debug level that replaces it. (Debug levels are the levels
// of the texture that dip_mip_debug_create returns.) The replacement is the largest debug level
// that is not larger than the longer side of the texture's level. If there is none, it is the last
// debug level.
void dip_mip_debug_levels(const DipTexture *texture, int32_t shown_level[DIP_LEVEL_TABLE]);

#endif
