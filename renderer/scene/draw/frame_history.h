// What a history (taa=history) needs of each frame: a shift of its view, and how the frame follows
// the one before it. Private to the renderer.
#ifndef DIP_RENDERER_SCENE_DRAW_FRAME_HISTORY_H
#define DIP_RENDERER_SCENE_DRAW_FRAME_HISTORY_H

#include "renderer/scene/draw/frame_setup.h"
#include "renderer/scene/finish.h"

// Shifts the view of a frame with a history by a part of a pixel: so that the centre of each pixel
// shows what one of sixteen samples of a pixel would. These are the samples of the two patterns
// that alternate, which together have the pixel's centre as their mean. Opposite samples follow
// each other.
void dip_frame_shift_view(DipFrameSetup *setup);

// Tells how a frame follows the one before it, and notes the frame for the next one.
DipFinishMotion dip_frame_follow_past(const DipFrameSetup *setup);

#endif
