// Textures as BC1 would show them: every level's colours encoded and decoded, in the same layout.
//
// The kernels read them as they read any texture. Reading blocks instead would take a choice, a
// palette and a curve per texel where one load does now; a CPU has no hardware for that, so BC1
// here changes the picture as it does elsewhere, but saves neither time nor memory.
#ifndef DIP_RENDERER_PIPELINE_TEXTURE_COMPRESS_H
#define DIP_RENDERER_PIPELINE_TEXTURE_COMPRESS_H

#include "renderer/base/pool.h"
#include "renderer/pipeline/texture/texture_layout.h"

// Makes compressed[i] from textures[i] for those of count that are wanted, NULL for the others; all
// or none. Alpha is not encoded but shared with textures[i], which must outlive it. On the pool
// (may be NULL); the same texels for every number of threads.
bool dip_textures_compress(DipTexture *const *textures, const bool *wanted, int count,
                           DipPool *pool, DipTexture **compressed, DipError *err);

#endif
