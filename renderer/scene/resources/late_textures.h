// Textures that only some settings need. They are made when a renderer first asks for them.
#ifndef DIP_RENDERER_SCENE_RESOURCES_LATE_TEXTURES_H
#define DIP_RENDERER_SCENE_RESOURCES_LATE_TEXTURES_H

#include "renderer/base/pool.h"
#include "renderer/pipeline/texture.h"

// The compressed textures that opt=standard and opt=advanced show. Renderers on any threads share
// them.
typedef struct DipLateTextures DipLateTextures;

// Creates the object without textures. Returns NULL if memory runs out.
DipLateTextures *dip_late_textures_create(void);
void dip_late_textures_destroy(DipLateTextures **late);

// Compresses the textures for which `wanted` is true, unless they are compressed already. `count`
// is the length of both arrays. If another thread is compressing the textures, waits until it has
// finished. pool may be NULL. Thread-safe.
bool dip_late_textures_make(DipLateTextures *late, DipTexture *const *textures, const bool *wanted,
                            int count, DipPool *pool, DipError *err);

// Returns the compressed form of a texture. Returns NULL if the textures are not compressed yet or
// this texture was not wanted. Thread-safe.
const DipTexture *dip_late_texture(const DipLateTextures *late, int index);

#endif
