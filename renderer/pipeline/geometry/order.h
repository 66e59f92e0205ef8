// The order in which the draws of a pass go through the pipeline.
#ifndef DIP_RENDERER_PIPELINE_GEOMETRY_ORDER_H
#define DIP_RENDERER_PIPELINE_GEOMETRY_ORDER_H

#include "renderer/pipeline/pipeline.h"

#include <stdbool.h>
#include <stdint.h>

// Whether a pass is drawn near to far: all its draws are plain, and so many of them are clipped
// that many of their fragments are probably hidden. The answer depends on the draws alone, not on
// samples and not on earlier frames, so the work of a pass is the same whatever was drawn before or
// beside it.
bool dip_draws_near_to_far(const DipPass *pass);

// Fills `order` with the numbers 0..draw_count - 1 of the pass's draws, the nearest draw first.
// Draws that are about equally near, and draws without bounds_to_clip, which come before all
// others, keep their order. keys: room for a number per draw.
void dip_order_draws(const DipPass *pass, uint32_t *order, uint16_t *keys);

#endif
