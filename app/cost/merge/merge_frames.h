// The frames that the parts of a merged report keep: the source of the pictures in the merged page.
#ifndef DIP_APP_COST_MERGE_MERGE_FRAMES_H
#define DIP_APP_COST_MERGE_MERGE_FRAMES_H

#include "app/report/page/picture_set.h"

#include <limits.h>

// The frames of one part.
typedef struct DipCostPartFrames {
    const char *file;       // The part's cost.json. Borrowed.
    char folder[PATH_MAX];  // Its folder.
    DipCostKeptFrames kept; // Owned.
} DipCostPartFrames;

// The frames of all parts. Zero-initialise it.
typedef struct DipCostMergeFrames {
    const DipCostReport *report; // The merged report, borrowed. The caller sets it before a source
                                 // is made.
    DipCostPartFrames *parts;    // Owned; NULL if no part keeps frames.
    int part_count;
} DipCostMergeFrames;

// Takes the list of kept frames out of a part whose report was read from `file`. Fails with
// DIP_ERROR_MEMORY or DIP_ERROR_OVERSIZED.
bool dip_cost_merge_frames_add(DipCostMergeFrames *frames, DipCostReport *part, const char *file,
                               DipError *err);

// Leaves out all frames whose file is missing or does not have its hash. For each part that has
// such frames, one line on standard error counts them. Fails with DIP_ERROR_MEMORY.
bool dip_cost_merge_frames_check(DipCostMergeFrames *frames, DipError *err);
void dip_cost_merge_frames_free(DipCostMergeFrames *frames);

// Returns a source that reads the parts' frames. Each set shows the viewpoint at which the parts
// have most of its rows, and of several such viewpoints the one nearest to the middle of the path.
// It borrows the frames.
DipCostFrameSource dip_cost_merge_frames_source(DipCostMergeFrames *frames);

#endif
