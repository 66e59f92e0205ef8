// The order in which blended objects are drawn: from far to near.
#ifndef DIP_RENDERER_SCENE_DRAW_BLEND_ORDER_H
#define DIP_RENDERER_SCENE_DRAW_BLEND_ORDER_H

#include "renderer/pipeline/mesh.h"
#include "renderer/scene/draw/view.h"

#include <stdint.h>

typedef struct DipBlendedObject {
    int64_t depth; // along the view axis, see dip_blend_depth
    int object;    // index of the object
} DipBlendedObject;

// Returns the depth of the centre of an object's box in the world, as a whole number of 1/65536 of
// the near plane's distance, within +-2^62.
int64_t dip_blend_depth(const DipView *view, const DipBox *bounds);

// Sorts objects from far to near. Objects of equal depth keep the order of their indices.
void dip_blend_sort(DipBlendedObject *objects, int count);

#endif
