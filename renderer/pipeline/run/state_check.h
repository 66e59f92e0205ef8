// Checks the parts of a pass that plain passes do not have. Release builds make these checks too.
#ifndef DIP_RENDERER_PIPELINE_RUN_STATE_CHECK_H
#define DIP_RENDERER_PIPELINE_RUN_STATE_CHECK_H

#include "renderer/pipeline/pipeline.h"

// Returns whether the state can be drawn. The error's key is the wrong field. state may be NULL.
bool dip_state_check(const DipDrawState *state, DipError *err);

// Returns whether the attachments fit to the pass's target and samples.
bool dip_attachments_check(const DipPass *pass, DipError *err);

// Returns whether a viewport or scissor is all 0 or a rectangle within the target.
bool dip_rectangle_check(const DipTargetRegion *rectangle, const DipTarget *target,
                         const char *field, DipError *err);

#endif
