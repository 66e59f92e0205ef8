// A picture in a picture, for debugging.
#ifndef DIP_RENDERER_SCENE_DRAW_INSET_H
#define DIP_RENDERER_SCENE_DRAW_INSET_H

#include "renderer/pipeline/pipeline.h"

// Copies a picture to the target's top left corner; every n-th pixel of it, with the least n that
// leaves it at most half as wide and high as the target.
void dip_inset_draw(const DipTarget *target, const DipTarget *picture);

#endif
