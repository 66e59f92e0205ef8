// Frames that the renderers and the reference renderer draw: the source of the pictures in the page
// of a report that is measured or merged here.
#ifndef DIP_APP_COST_DRAWN_FRAMES_H
#define DIP_APP_COST_DRAWN_FRAMES_H

#include "app/cost/context.h"
#include "app/report/page/picture_set.h"

// Returns a source that draws frames in the context, which it borrows.
DipCostFrameSource dip_cost_drawn_frames(DipCostContext *cost);

#endif
