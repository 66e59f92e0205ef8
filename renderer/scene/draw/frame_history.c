// Decides by how much the view of a frame is shifted, and whether the frame continues the history.
#include "renderer/scene/draw/frame_history.h"

#include "renderer/scene/resources/scene_layout.h"

#include <string.h>

void dip_frame_shift_view(DipFrameSetup *setup) {
    const DipRenderer *renderer = setup->renderer;
    const DipTarget target = dip_renderer_target(renderer);
    const uint64_t turn = renderer->frame_index / DIP_MAX_SAMPLES;
    const DipSamplePattern *pattern =
        dip_sample_pattern_of(DIP_MAX_SAMPLES, dip_pattern_kind(true, turn));
    const int sample = pattern->order[renderer->frame_index % DIP_MAX_SAMPLES];
    const double shift[2] = {(128 - pattern->x[sample]) / (128.0 * target.width),
                             (pattern->y[sample] - 128) / (128.0 * target.height)};
    if (dip_quality_has_history(&renderer->quality)) {
        dip_view_shift(&setup->view, shift);
    }
}

// Whether a frame continues the history.
static bool continues(const DipFrameSetup *setup) {
    const DipRenderer *renderer = setup->renderer;
    const DipPast *past = &renderer->past;
    return past->exists && renderer->frame_index == past->frame_index + 1 &&
           setup->time_ns >= past->time_ns && renderer->scene_serial == past->scene_serial &&
           dip_quality_equal(&renderer->quality, &past->quality);
}

// Whether a frame shows the same as the one before it. Clips and clouds move with the time.
static bool rests(const DipFrameSetup *setup) {
    const DipView *now = &setup->view;
    const DipView *before = &setup->renderer->past.view;
    const bool moves = setup->scene->motion || setup->plan.effects.sky.run;
    return memcmp(now->eye, before->eye, sizeof now->eye) == 0 &&
           memcmp(now->axis, before->axis, sizeof now->axis) == 0 &&
           memcmp(now->scale, before->scale, sizeof now->scale) == 0 &&
           (!moves || setup->time_ns == setup->renderer->past.time_ns);
}

DipFinishMotion dip_frame_follow_past(const DipFrameSetup *setup) {
    DipRenderer *renderer = setup->renderer;
    DipFinishMotion motion = {.step = DIP_HISTORY_BEGIN};
    if (!dip_quality_has_history(&renderer->quality)) {
        renderer->past.exists = false;
        return motion;
    }
    if (continues(setup)) {
        motion.step = rests(setup) ? DIP_HISTORY_REST : DIP_HISTORY_MOVE;
        dip_view_motion(&setup->view, &renderer->past.view, motion.to_before);
    }
    renderer->past = (DipPast){.exists = true,
                               .frame_index = renderer->frame_index,
                               .time_ns = setup->time_ns,
                               .scene_serial = renderer->scene_serial,
                               .quality = renderer->quality,
                               .view = setup->view};
    return motion;
}
