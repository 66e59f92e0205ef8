// Draws frames: all passes of the frames that are drawn at once, in their order, and ends each
// frame with its picture, counters and effects.
#include "renderer/scene/renderer.h"

#include "renderer/base/clock.h"
#include "renderer/base/fp_mode.h"
#include "renderer/scene/draw/frame_counters.h"
#include "renderer/scene/draw/frame_history.h"
#include "renderer/scene/draw/frame_setup.h"
#include "renderer/scene/draw/inset.h"

// --- drawing passes ------------------------------------------------------------------------------

static DipPassWork work_of(DipPipeline *pipeline, const DipPass *pass, DipFrameSetup *setup) {
    return (DipPassWork){pipeline, pass, &setup->counters, &setup->frame->stages, NULL};
}

// Points the frame to the renderer's records, and notes the work that was done before the main
// pass.
static void begin_tiles(const DipFrameSetup *setup) {
    const DipRenderer *renderer = setup->renderer;
    if (renderer->recording.tiles && !renderer->scaled.pipeline) {
        setup->frame->tiles = (DipFrameTiles){
            .records = renderer->recording.tiles,
            .mixed = renderer->recording.mixed,
            .across = dip_frame_tiles(renderer->width),
            .down = dip_frame_tiles(renderer->height),
            .mirrored = setup->counters,
            .mirrored_times = setup->frame->stages,
        };
    }
}

// Draws the shadow maps of all frames together.
static bool draw_shadows(DipFrameSetup *setups, int count, DipError *err) {
    DipPassWork works[DIP_MAX_FRAMES_AT_ONCE] = {{.pipeline = NULL}};
    int work_count = 0;
    for (int i = 0; i < count; i++) {
        if (setups[i].plan.effects.shadows.run) {
            works[work_count++] =
                work_of(setups[i].renderer->shadows.pipeline, &setups[i].shadow_pass, &setups[i]);
        }
    }
    if (work_count && !dip_pipeline_draw_passes(works, work_count, false, err)) {
        return false;
    }
    for (int i = 0; i < count; i++) {
        setups[i].shadow_counters = setups[i].counters;
    }
    return true;
}

// Draws the backdrops of all frames together, and makes their levels.
static bool draw_backdrops(DipFrameSetup *setups, int count, bool same_geometry, DipError *err) {
    DipPassWork works[DIP_MAX_FRAMES_AT_ONCE] = {{.pipeline = NULL}};
    int work_count = 0;
    for (int i = 0; i < count; i++) {
        setups[i].fragments_behind = setups[i].counters.fragments_shaded;
        if (setups[i].plan.effects.scattering.run) {
            works[work_count++] = work_of(dip_renderer_pipeline(setups[i].renderer),
                                          &setups[i].backdrop_pass, &setups[i]);
        }
    }
    if (work_count && !dip_pipeline_draw_passes(works, work_count, same_geometry, err)) {
        return false;
    }
    for (int i = 0; i < count; i++) {
        DipFrameSetup *setup = &setups[i];
        setup->fragments_behind = setup->counters.fragments_shaded - setup->fragments_behind;
        if (setup->plan.effects.scattering.run) {
            DipStageTimes *stages = &setup->frame->stages;
            const int64_t begin_ns = dip_clock_ns();
            setup->backdrop_texels = dip_backdrop_fill(
                &setup->renderer->backdrop, &setup->plan.backdrop_region, setup->renderer->pool);
            const double ms = 1e-6 * (double)(dip_clock_ns() - begin_ns);
            stages->resolve_ms += ms;
            stages->total_ms += ms;
        }
    }
    return true;
}

// Draws the shadow maps of all frames, then their mirrored passes together, then their backdrops,
// then their main passes together. same_geometry: the frames differ only in samples and shading.
static bool draw_frames(DipFrameSetup *setups, int count, bool same_geometry, DipError *err) {
    DipPassWork works[DIP_MAX_FRAMES_AT_ONCE] = {{.pipeline = NULL}};
    int work_count = 0;
    if (!draw_shadows(setups, count, err)) {
        return false;
    }
    for (int i = 0; i < count; i++) {
        if (setups[i].plan.effects.reflection.run) {
            setups[i].mirrored_work = &works[work_count];
            works[work_count++] =
                work_of(setups[i].renderer->mirror.pipeline, &setups[i].mirrored_pass, &setups[i]);
        }
    }
    for (int i = 0; i < count; i++) {
        if (setups[i].mirrored_work && setups[i].copies_from) {
            setups[i].mirrored_work->copies_from = setups[i].copies_from->mirrored_work;
        }
    }
    if (work_count && !dip_pipeline_draw_passes(works, work_count, same_geometry, err)) {
        return false;
    }
    for (int i = 0; i < count; i++) {
        setups[i].fragments_mirrored =
            setups[i].counters.fragments_shaded - setups[i].shadow_counters.fragments_shaded;
    }
    if (!draw_backdrops(setups, count, same_geometry, err)) {
        return false;
    }
    for (int i = 0; i < count; i++) {
        begin_tiles(&setups[i]);
        works[i] = work_of(dip_renderer_pipeline(setups[i].renderer), &setups[i].pass, &setups[i]);
        if (setups[i].copies_from) {
            works[i].copies_from = &works[setups[i].copies_from - setups];
        }
    }
    return dip_pipeline_draw_passes(works, count, same_geometry, err);
}

// --- ending a frame ------------------------------------------------------------------------------

// Ends the averaging of a larger picture. Returns the frame's picture.
static DipTarget shrink(const DipFrameSetup *setup) {
    DipStageTimes *stages = &setup->frame->stages;
    const int64_t begin_ns = dip_clock_ns();
    dip_box_filter(&setup->box, setup->renderer->pool);
    const double ms = 1e-6 * (double)(dip_clock_ns() - begin_ns);
    stages->resolve_ms += ms;
    stages->total_ms += ms;
    return setup->box.to;
}

static void end_frame(const DipFrameSetup *setup) {
    const DipRenderer *renderer = setup->renderer;
    DipFrame *frame = setup->frame;
    frame->counters = dip_frame_counters(setup);
    frame->stages.geometry_ms += setup->posing_ms;
    frame->stages.total_ms += setup->posing_ms;
    const DipTarget picture =
        renderer->scaled.codes ? shrink(setup) : dip_renderer_target(renderer);
    frame->rgba8 = picture.rgba8;
    frame->stride_bytes = picture.stride_bytes;
    if (setup->plan.effects.reflection.run && renderer->reflection.show) {
        dip_inset_draw(&picture, &renderer->mirror.target);
    }
    if (!setup->readback) {
        const DipFinishMotion motion = dip_frame_follow_past(setup);
        dip_finish_frame(renderer->finish, &motion, frame);
    }
}

// Corrects a frame's effects after all frames that are drawn at once have ended.
static void settle_effects(const DipFrameSetup *setup) {
    const bool copied = setup->frame->counters.fragments_copied > 0;
    // What casts shadows need not be in view.
    DipCounters seen = setup->frame->counters;
    seen.fragments_clip_tested -= setup->shadow_counters.fragments_clip_tested;
    seen.clip_sample_groups -= setup->shadow_counters.clip_sample_groups;
    dip_plan_settle(&setup->input, &seen, copied ? &setup->copies_from->frame->counters : NULL,
                    &setup->frame->effects);
}

// --- frames at once ------------------------------------------------------------------------------

// Whether two renderers' frames differ only in samples and shading.
static bool same_geometry(const DipRenderer *a, const DipRenderer *b) {
    const DipReflectionDef *r = &a->reflection;
    const DipReflectionDef *s = &b->reflection;
    const bool same_scale =
        a->quality.step[DIP_SETTING_SCALE] == b->quality.step[DIP_SETTING_SCALE];
    // Surfaces that are lit at their vertices have more varyings if they receive shadows.
    const bool same_varyings =
        !a->quality.step[DIP_SETTING_SHADOWS] == !b->quality.step[DIP_SETTING_SHADOWS];
    // Each frame of a history is shifted.
    const bool same_shift =
        !dip_quality_has_history(&a->quality) && !dip_quality_has_history(&b->quality);
    return (same_shift || a == b) && same_scale && same_varyings && a->isa == b->isa &&
           a->width == b->width && a->height == b->height &&
           a->plain_surfaces == b->plain_surfaces && a->force_all_effects == b->force_all_effects &&
           a->quality.step[DIP_SETTING_GI] == b->quality.step[DIP_SETTING_GI] &&
           r->width == s->width && r->height == s->height && r->level_m == s->level_m;
}

// Chooses the frame whose pixels frame `index` copies: the first one that copies none itself and
// whose settings shade alike. All frames have the same geometry.
static void choose_copying(DipFrameSetup *setups, int count, int index) {
    const DipRenderer *renderer = setups[index].renderer;
    if (!renderer->copies_shading || renderer->force_all_effects || renderer->recording.tiles) {
        return;
    }
    for (int i = 0; i < count; i++) {
        const DipRenderer *other = setups[i].renderer;
        if (!other->copies_shading && !other->recording.tiles &&
            dip_plan_shades_alike(&other->quality, &renderer->quality)) {
            setups[index].copies_from = &setups[i];
            return;
        }
    }
}

bool dip_renderer_draw_frames(DipRenderer *const *renderers, int count, const DipScene *scene,
                              const DipPose *pose, int64_t time_ns, DipFrame *const *frames,
                              DipError *err) {
    DIP_FP_MODE_SCOPE();
    DipFrameSetup setups[DIP_MAX_FRAMES_AT_ONCE];
    if (count < 1 || count > DIP_MAX_FRAMES_AT_ONCE) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "count", "%d frames, accepted 1..%d",
                             count, DIP_MAX_FRAMES_AT_ONCE);
    }
    bool same = true;
    for (int i = 0; i < count; i++) {
        if (!dip_frame_begin(&setups[i], renderers[i], scene, pose, time_ns,
                             i > 0 ? &setups[0] : NULL, NULL, frames[i], err)) {
            return false;
        }
        same = same && same_geometry(renderers[0], renderers[i]);
    }
    for (int i = 0; i < count && same; i++) {
        choose_copying(setups, count, i);
    }
    if (!draw_frames(setups, count, same, err)) {
        return false;
    }
    for (int i = 0; i < count; i++) {
        end_frame(&setups[i]);
    }
    for (int i = 0; i < count; i++) {
        settle_effects(&setups[i]);
    }
    return true;
}

bool dip_renderer_draw(DipRenderer *renderer, const DipScene *scene, const DipPose *pose,
                       int64_t time_ns, DipFrame *frame, DipError *err) {
    return dip_renderer_draw_frames(&renderer, 1, scene, pose, time_ns, &frame, err);
}

// Checked here as well as by the pipeline, because culling reads the region before.
static bool check_region(const DipRenderer *renderer, const DipTargetRegion *region,
                         DipError *err) {
    return (region->x0 >= 0 && region->x0 < region->x1 && region->x1 <= renderer->width &&
            region->y0 >= 0 && region->y0 < region->y1 && region->y1 <= renderer->height) ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "readback.region",
                         "x %d..%d, y %d..%d, accepted a rectangle within %dx%d pixels", region->x0,
                         region->x1, region->y0, region->y1, renderer->width, renderer->height);
}

// Draws the pass that reads the samples. The pipeline reads samples of plain draws only, so the
// blended surfaces of the region are drawn by another pass.
static bool draw_readback(DipFrameSetup *setup, DipError *err) {
    DipRenderer *renderer = setup->renderer;
    DipPass *pass = &setup->pass;
    pass->draw_count = renderer->set.plain_count;
    if (!draw_frames(setup, 1, true, err)) {
        return false;
    }
    if (renderer->set.plain_count == renderer->set.count) {
        return true;
    }
    pass->draw_count = renderer->set.count;
    pass->readback = NULL;
    return dip_pipeline_draw(renderer->pipeline, pass, &setup->counters, &setup->frame->stages,
                             err);
}

bool dip_renderer_read_samples(DipRenderer *renderer, const DipScene *scene, const DipPose *pose,
                               int64_t time_ns, const DipSampleReadback *readback, DipError *err) {
    DIP_FP_MODE_SCOPE();
    DipFrameSetup setup;
    DipFrame frame;
    if (dip_quality_drawn_size(&renderer->quality, renderer->width) != renderer->width ||
        dip_quality_drawn_size(&renderer->quality, renderer->height) != renderer->height) {
        return dip_error_set(
            err, DIP_ERROR_UNSUPPORTED, NULL, 0, "scale",
            "the pixels that are drawn are not those of the frame, accepted scale=1");
    }
    if (!check_region(renderer, &readback->region, err) ||
        !dip_frame_begin(&setup, renderer, scene, pose, time_ns, NULL, readback, &frame, err) ||
        !draw_readback(&setup, err)) {
        return false;
    }
    end_frame(&setup);
    settle_effects(&setup);
    return true;
}
