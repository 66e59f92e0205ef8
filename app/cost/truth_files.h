// The truths (converged pictures) of a report as files that other programs can read.
#ifndef DIP_APP_COST_TRUTH_FILES_H
#define DIP_APP_COST_TRUTH_FILES_H

#include "app/cost/context.h"

// Writes every truth of this run's viewpoints to `folder` as PATH-VIEWPOINT-FRAME.pfm, in linear
// light (pfm.h). FRAME is the index of the frame in the viewpoint's burst, the successive frames
// that are drawn there.
bool dip_cost_save_truths(DipCostContext *cost, const char *folder, DipError *err);

#endif
