// Mip debugging: flat colours or pictures that replace mip levels according to their size in
// texels. Clients of the pipeline can show mip levels in the same colours as the scene renderer.
#ifndef DIP_RENDERER_SCENE_MIP_DEBUG_H
#define DIP_RENDERER_SCENE_MIP_DEBUG_H

#include "renderer/base/api.h"
#include "renderer/pipeline/texture.h"
#include "renderer/scene/renderer.h"

#ifdef __cplusplus
extern "C" {
#endif

// Returns the red, green, blue and alpha, in 8-bit sRGB, of the flat colour for levels of
// 1024 >> level texels. level: 0..DIP_MIP_DEBUG_LEVELS - 1. Static storage. Thread-safe.
DIP_API const uint8_t *dip_mip_debug_colour(int level);

// Creates a texture whose level i replaces levels of 1024 >> i texels. If `pictures` is NULL, all
// levels are flat colours. Otherwise it has one picture per level; a level whose picture is NULL
// has a flat colour. The pictures are copied. Fails as dip_texture_create does.
DIP_API DipTexture *dip_mip_debug_create(const DipTextureDef *pictures[DIP_MIP_DEBUG_LEVELS],
                                         DipError *err);

// For each level of a texture, finds the debug level that replaces it. (Debug levels are the levels
// of the texture that dip_mip_debug_create returns.) The replacement is the largest debug level
// that is not larger than the longer side of the texture's level. If there is none, it is the last
// debug level.
DIP_API void dip_mip_debug_levels(const DipTexture *texture, int32_t shown_level[DIP_LEVEL_TABLE]);

#ifdef __cplusplus
}
#endif

#endif
