// The order in which blended objects are drawn: from far to near. All water is horizontal, so what
// lies beyond a surface of water is drawn before it, and what lies on the eye's side of it after
// it.
#ifndef DIP_RENDERER_SCENE_DRAW_BLEND_ORDER_H
#define DIP_RENDERER_SCENE_DRAW_BLEND_ORDER_H

#include "renderer/pipeline/mesh.h"
#include "renderer/scene/view/view.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct DipBlendedObject {
    int layer;     // see dip_blend_layer
    int64_t depth; // along the view axis, see dip_blend_depth
    int object;    // index of the object
} DipBlendedObject;

// Returns how many surfaces of blended water a view ray passes before it reaches an object, twice,
// and 1 less for water itself. levels: the heights of the surfaces. eye, centre: heights of the eye
// and of the middle of the object.
int dip_blend_layer(const float *levels, int count, double eye, double centre, bool is_water);

// Returns the depth of the centre of an object's box in the world, as a whole number of 1/65536 of
// the near plane's distance, within +-2^62.
int64_t dip_blend_depth(const DipView *view, const DipBox *bounds);

// Sorts objects from the greatest layer to the least, and those of one layer from far to near.
// Objects of equal depth keep the order of their indices.
void dip_blend_sort(DipBlendedObject *objects, int count);

#endif
