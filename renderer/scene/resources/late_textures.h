// Textures that some settings need beside a scene's own, made when they are first asked for.
#ifndef DIP_RENDERER_SCENE_RESOURCES_LATE_TEXTURES_H
#define DIP_RENDERER_SCENE_RESOURCES_LATE_TEXTURES_H

#include "renderer/base/pool.h"
#include "renderer/pipeline/texture.h"

// The compressed textures of opt=standard and opt=advanced. Renderers on any thread share them.
typedef struct DipLateTextures DipLateTextures;

// Nothing is made yet; NULL when memory runs out.
DipLateTextures *dip_late_textures_create(void);
void dip_late_textures_destroy(DipLateTextures **late);

// Makes them from those of count textures that are wanted, unless they are there. Waits while
// another thread is at it.
bool dip_late_textures_make(DipLateTextures *late, DipTexture *const *textures, const bool *wanted,
                            int count, DipPool *pool, DipError *err);

// One that was wanted, once they are made; NULL: not made, or not wanted.
const DipTexture *dip_late_texture(const DipLateTextures *late, int index);

#endif
