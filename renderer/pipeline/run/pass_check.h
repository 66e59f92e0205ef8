// Checks a pass before it is drawn. Release builds make this check too.
#ifndef DIP_RENDERER_PIPELINE_RUN_PASS_CHECK_H
#define DIP_RENDERER_PIPELINE_RUN_PASS_CHECK_H

#include "renderer/pipeline/pipeline.h"

// Returns whether a pass can be drawn into a target of this size. If not, the error's key is the
// wrong field, and the message says what was found and what is accepted.
bool dip_pass_check(const DipPass *pass, int width, int height, DipError *err);

// The same for the pass's draws alone. They need fragment shaders if the pass has a target.
bool dip_pass_check_draws(const DipPass *pass, DipError *err);

#endif
