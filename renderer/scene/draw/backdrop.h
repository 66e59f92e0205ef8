// The backdrop of rough glass: a picture of the surfaces that are not blended, and its levels. Each
// level has half the width and height of the one before it, rounded down; a texel is the mean of
// the area that it covers in the level before. Private to the renderer.
#ifndef DIP_RENDERER_SCENE_DRAW_BACKDROP_H
#define DIP_RENDERER_SCENE_DRAW_BACKDROP_H

#include "renderer/base/error.h"
#include "renderer/base/pool.h"
#include "renderer/pipeline/target.h"
#include "renderer/scene/materials/backdrop.h"

#include <stdbool.h>
#include <stdint.h>

// The picture, and what is read of it. All members are 0 unless the scene has rough glass.
typedef struct DipBackdropParts {
    DipTarget target;
    DipBackdrop levels;
    uint16_t *light16; // 16-bit linear light of the sRGB codes
} DipBackdropParts;

// Allocates a backdrop of a size, which is black at first. If the call fails with MEMORY, all
// members are 0.
bool dip_backdrop_make(DipBackdropParts *backdrop, int width, int height, DipError *err);
void dip_backdrop_free(DipBackdropParts *backdrop);

// Fills the levels from the pixels of a region of the target, on the pool or, if the pool is NULL,
// on the caller's thread. Returns the number of texels. Texels that also cover other pixels, or
// have some within their own size on either side, are not valid.
uint64_t dip_backdrop_fill(const DipBackdropParts *backdrop, const DipTargetRegion *region,
                           DipPool *pool);

// Returns the memory of a backdrop, in bytes.
uint64_t dip_backdrop_bytes(const DipBackdropParts *backdrop);

#endif
