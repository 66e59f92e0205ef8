// A picture inside a picture, for debugging.
#ifndef DIP_RENDERER_SCENE_DRAW_INSET_H
#define DIP_RENDERER_SCENE_DRAW_INSET_H

#include "renderer/pipeline/pipeline.h"

// Copies every n-th pixel of every n-th row of a picture to the target's top left corner. n is the
// smallest number that makes the copy at most half as wide and half as high as the target.
void dip_inset_draw(const DipTarget *target, const DipTarget *picture);

#endif
