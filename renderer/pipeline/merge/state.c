// Tells plain draws from ordered ones.
#include "renderer/pipeline/state.h"

#include "renderer/base/fp_mode.h"

#include <stddef.h>

bool dip_state_is_ordered(const DipDrawState *state) {
    if (!state) {
        return false; // as most draws
    }
    DIP_FP_MODE_SCOPE(); // Subnormal depth biases are not 0.
    return state->ordered || state->blend.enabled || state->kept_channels ||
           state->depth_test != DIP_DEPTH_NEARER || state->keep_depth ||
           state->depth_bias.slope != 0.0f || state->depth_bias.relative != 0.0f ||
           state->depth_bias.constant != 0.0f || state->stencil.enabled ||
           state->fill != DIP_FILL_SOLID || state->kept_samples || state->reads_front;
}
