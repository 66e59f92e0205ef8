// Frames that the renderers and the reference renderer draw: the source of the pictures in the page
// of a report that is measured here, and of the frames that a part keeps.
#ifndef DIP_APP_COST_DRAWN_FRAMES_H
#define DIP_APP_COST_DRAWN_FRAMES_H

#include "app/cost/context.h"
#include "app/report/page/picture_set.h"

// Returns a source that draws every frame at the middle one of the viewpoints of this run. It
// borrows the context.
DipCostFrameSource dip_cost_drawn_frames(DipCostContext *cost);

// If this run has only a part of the viewpoints (--part), draws every row at the part's viewpoint
// that is nearest to the middle of all viewpoints, writes these frames and the truths of all paths
// to FOLDER/frames, and lists them in the report. With --pictures none, nothing is kept.
bool dip_cost_keep_frames(DipCostContext *cost, const char *folder, DipError *err);

#endif
