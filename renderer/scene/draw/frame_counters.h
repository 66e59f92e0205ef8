// The counters of a frame. Private to the renderer.
#ifndef DIP_RENDERER_SCENE_DRAW_FRAME_COUNTERS_H
#define DIP_RENDERER_SCENE_DRAW_FRAME_COUNTERS_H

#include "renderer/scene/draw/frame_setup.h"
#include "renderer/scene/frame.h"

// Returns the counters of a frame whose passes have been drawn.
DipCounters dip_frame_counters(const DipFrameSetup *setup);

#endif
