// Draws frames: turns a scene, a pose and settings into the render passes of a frame. These are the
// main pass and, before it, what the main pass reads: the shadow map, the mirrored scene if water
// reflects, and the backdrop of rough glass.
#include "renderer/scene/renderer.h"

#include "renderer/base/clock.h"
#include "renderer/base/fp_mode.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/draw/box.h"
#include "renderer/scene/draw/draws.h"
#include "renderer/scene/draw/inset.h"
#include "renderer/scene/draw/renderer_parts.h"
#include "renderer/scene/materials/sky.h"
#include "renderer/scene/plan/plan.h"
#include "renderer/scene/resources/scene_layout.h"
#include "renderer/scene/view/view.h"

#include <math.h>
#include <string.h>

static int tiles_in(int size) {
    return (size + DIP_TARGET_TILE - 1) / DIP_TARGET_TILE;
}

static bool check_pose(const DipPose *pose, DipError *err) {
    bool finite = isfinite(pose->fov_y_deg);
    for (int i = 0; i < 3; i++) {
        finite = finite && isfinite(pose->position_world[i]);
    }
    for (int i = 0; i < 4; i++) {
        finite = finite && isfinite(pose->orientation[i]);
    }
    if (!finite) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "pose",
                             "a number is not finite, accepted finite numbers");
    }
    const double *q = pose->orientation;
    if (q[0] == 0.0 && q[1] == 0.0 && q[2] == 0.0 && q[3] == 0.0) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "pose",
                             "the orientation is 0, accepted a quaternion of any other length");
    }
    if (pose->fov_y_deg < 1.0 || pose->fov_y_deg > 170.0) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "pose",
                             "a field of view of %g degrees is out of range, accepted 1..170",
                             pose->fov_y_deg);
    }
    return true;
}

// --- passes ------------------------------------------------------------------------------------

// Begins a pass: sets the values that depend only on the settings and the scene. The caller adds
// the target and the draws.
static DipPass begin_pass(const DipRenderer *renderer, const DipScene *scene,
                          const DipFramePlan *plan) {
    DipPass pass = {
        .sample_count = dip_quality_sample_count(&renderer->quality),
        .pattern =
            dip_pattern_kind(dip_quality_alternates(&renderer->quality), renderer->frame_index),
        .samples_per_group = plan->samples_per_group,
        .groups_shade_all = dip_quality_groups_shade_all(&renderer->quality),
        .alpha_to_coverage = dip_quality_covers_by_alpha(&renderer->quality),
    };
    memcpy(pass.clear_lin, scene->background_lin, sizeof pass.clear_lin);
    return pass;
}

// Fills a set with the draws of the objects that a pass may show, and stores these draws in the
// pass.
static void set_draws(const DipRenderer *renderer, const DipScene *scene, DipDrawView view,
                      DipDrawSet *set, DipPass *pass) {
    const DipDrawInput input = dip_renderer_draw_input(renderer, scene, view.mirrored);
    const DipCullPlanes seen = dip_cull_pass_planes(pass, view.view->world_to_clip);
    view.seen = &seen;
    view.width = pass->target.width;
    view.height = pass->target.height;
    dip_draw_set_fill(set, &input, &view);
    pass->draws = set->draws;
    pass->draw_count = set->count;
}

// A frame that is being set up. It must not be copied, because its members point to each other.
typedef struct FrameSetup {
    DipRenderer *renderer;
    const DipScene *scene;
    DipFrame *frame;
    DipView view;
    DipView mirrored;
    DipCullPlanes seen;
    DipCullPlanes seen_mirrored;
    DipParts parts;
    DipReflectionDef reflection; // the renderer's, in the size at which it is drawn
    DipPlanInput input;
    DipFramePlan plan;
    DipShadowFit shadow_fit; // the next two are made only if the plan runs the shadows
    DipPass shadow_pass;
    DipPass mirrored_pass; // made only if the plan runs the reflection
    DipPass backdrop_pass; // made only if the plan runs the scattering
    DipPass pass;
    DipBoxFilter box;                    // used only if a render scale draws a larger picture
    DipPipelineCounters counters;        // sums over all passes
    DipPipelineCounters shadow_counters; // of the shadow map alone
    uint64_t fragments_mirrored;
    uint64_t fragments_behind;
    uint64_t backdrop_texels;
    int64_t time_ns;
    double posing_ms;                  // how long it took to move the scene to the frame's time
    const DipSampleReadback *readback; // NULL unless samples are read
    // The frame, drawn at once, whose pixels this frame may copy; NULL if it shades them all.
    const struct FrameSetup *copies_from;
    DipPassWork *mirrored_work; // used while the mirrored passes are drawn
} FrameSetup;

// Makes the pass that draws the shadow map. The map must hold what the frame shows and what its
// water mirrors, whether or not water is in view, so that it does not depend on the plan.
static void make_shadow_pass(FrameSetup *setup) {
    DipRenderer *renderer = setup->renderer;
    const DipShadowView views[2] = {{&setup->view, &setup->seen},
                                    {&setup->mirrored, &setup->seen_mirrored}};
    setup->shadow_fit = dip_shadow_fit(setup->scene, views, setup->plan.water_reflects ? 2 : 1,
                                       dip_quality_shadow_size(&renderer->quality));
    dip_shadows_fill(&renderer->shadows, setup->scene, dip_material_kernels(renderer->isa),
                     &setup->shadow_fit, &setup->shadow_pass);
}

// Sets what surfaces read of the shadow map as the eye of a view sees them. Returns NULL if they
// receive no shadows.
static const DipShadowUniforms *see_shadow(const FrameSetup *setup, const DipView *view,
                                           DipShadowUniforms *shadow) {
    if (!setup->plan.effects.shadows.run) {
        return NULL;
    }
    dip_shadow_at(&setup->renderer->shadows, setup->scene, &setup->shadow_fit, view->eye, shadow);
    return shadow;
}

// Makes the pass that draws the mirrored scene above the water. The pass also draws a margin below
// the water, two texels of the mirrored picture high. Without the margin, a gap of background would
// show between a shore and its reflection.
static void make_mirrored_pass(FrameSetup *setup) {
    const DipRenderer *renderer = setup->renderer;
    const DipView *mirrored = &setup->mirrored;
    DipMirror *mirror = &setup->renderer->mirror;
    const double above[4] = {0.0, 1.0, 0.0, -renderer->reflection.level_m};
    // The height of a texel at a distance of 1.
    const double texel = 2.0 / (mirrored->scale[1] * mirror->target.height);
    double plane[4];
    dip_view_plane(mirrored, above, plane);
    plane[3] += 2.0 * texel;
    DipPass *pass = &setup->mirrored_pass;
    *pass = begin_pass(renderer, setup->scene, &setup->plan);
    pass->target = mirror->target;
    pass->region = setup->plan.mirrored_region;
    pass->tile_regions = setup->plan.mirrored_parts ? mirror->tile_regions : NULL;
    pass->clip_plane_count = 1;
    for (int i = 0; i < 4; i++) {
        pass->clip_planes[0][i] = (float)plane[i];
    }
    DipShadowUniforms shadow;
    const DipDrawView seen = {
        .view = mirrored, .mirrored = true, .shadow = see_shadow(setup, mirrored, &shadow)};
    set_draws(renderer, setup->scene, seen, &mirror->set, pass);
}

// Averages the larger picture of a render scale to the frame.
static void average_pass(FrameSetup *setup) {
    const DipRenderer *renderer = setup->renderer;
    const DipScaled *scaled = &renderer->scaled;
    setup->box = (DipBoxFilter){
        .from_width = scaled->target.width,
        .from_height = scaled->target.height,
        .to = {.rgba8 = renderer->rgba8,
               .stride_bytes = renderer->stride_bytes,
               .width = renderer->width,
               .height = renderer->height},
        .light16 = scaled->light16,
        .srgb_code = scaled->codes->code,
    };
    setup->pass.tile_done = dip_box_take_tile;
    setup->pass.tile_context = &setup->box;
}

static void make_scene_pass(FrameSetup *setup) {
    DipRenderer *renderer = setup->renderer;
    DipShadowUniforms shadow;
    const DipDrawView seen = {
        .view = &setup->view,
        .shadow = see_shadow(setup, &setup->view, &shadow),
        .shown = setup->plan.water_reflects ? &renderer->mirror.target : NULL,
        .schlick = renderer->reflection.schlick,
        .backdrop = setup->plan.effects.scattering.run ? &renderer->backdrop.levels : NULL,
    };
    setup->pass = begin_pass(renderer, setup->scene, &setup->plan);
    setup->pass.target = dip_renderer_target(renderer);
    setup->pass.depths = setup->readback ? NULL : dip_finish_depths(renderer->finish);
    if (setup->readback) {
        setup->pass.readback = setup->readback;
        setup->pass.region = setup->readback->region;
    }
    set_draws(renderer, setup->scene, seen, &renderer->set, &setup->pass);
    if (renderer->scaled.codes) {
        average_pass(setup);
    }
}

// Makes the pass that draws what lies behind rough glass: the draws of the main pass that are not
// blended. The main pass must have been made before.
static void make_backdrop_pass(FrameSetup *setup) {
    DipRenderer *renderer = setup->renderer;
    DipPass *pass = &setup->backdrop_pass;
    *pass = begin_pass(renderer, setup->scene, &setup->plan);
    pass->target = renderer->backdrop.target;
    pass->region = setup->plan.backdrop_region;
    pass->draws = renderer->set.draws;
    pass->draw_count = renderer->set.plain_count;
}

// --- the history ---------------------------------------------------------------------------------

// Shifts the view of a frame with a history by a part of a pixel: so that the centre of each pixel
// shows what one of sixteen samples of a pixel would. These are the samples of the two patterns
// that alternate, which together have the pixel's centre as their mean. Opposite samples follow
// each other.
static void shift_view(FrameSetup *setup) {
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
static bool continues(const FrameSetup *setup) {
    const DipRenderer *renderer = setup->renderer;
    const DipPast *past = &renderer->past;
    return past->exists && renderer->frame_index == past->frame_index + 1 &&
           setup->time_ns >= past->time_ns && renderer->scene_serial == past->scene_serial &&
           dip_quality_equal(&renderer->quality, &past->quality);
}

// Whether a frame shows the same as the one before it. Clips and clouds move with the time.
static bool rests(const FrameSetup *setup) {
    const DipView *now = &setup->view;
    const DipView *before = &setup->renderer->past.view;
    const bool moves = setup->scene->motion || setup->plan.effects.sky.run;
    return memcmp(now->eye, before->eye, sizeof now->eye) == 0 &&
           memcmp(now->axis, before->axis, sizeof now->axis) == 0 &&
           memcmp(now->scale, before->scale, sizeof now->scale) == 0 &&
           (!moves || setup->time_ns == setup->renderer->past.time_ns);
}

// Tells how a frame follows the one before it, and notes the frame for the next one.
static DipFinishMotion follow_past(const FrameSetup *setup) {
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

// Counts the memory of the textures that effects use, even of effects that this frame does not run.
static void count_bytes(const DipScene *scene, DipCounters *counters) {
    counters->normal_map_bytes = scene->normal_map_bytes;
    counters->clip_map_bytes = scene->clip_map_bytes;
    counters->cloud_bytes = scene->cloud_bytes;
}

static void count_shadows(const FrameSetup *setup, DipCounters *counters) {
    const DipShadows *shadows = &setup->renderer->shadows;
    const uint64_t width = shadows->depth ? (uint64_t)dip_depth_width(shadows->depth) : 0;
    const bool drawn = setup->plan.effects.shadows.run;
    counters->shadow_bytes = width * width * 5; // depth and stencil value
    counters->shadow_texels = drawn ? width * width : 0;
    counters->draws_culled += drawn ? (uint64_t)shadows->set.culled : 0;
    // The ordered draws of the shadow map do not blend.
    counters->fragments_blended -= setup->shadow_counters.fragments_ordered;
}

static void count_mirror(const DipMirror *mirror, bool drawn, DipCounters *counters) {
    const uint64_t across = (uint64_t)tiles_in(mirror->target.width);
    const uint64_t down = (uint64_t)tiles_in(mirror->target.height);
    counters->reflection_bytes = mirror->target.stride_bytes * (uint64_t)mirror->target.height;
    counters->tiles_spared += drawn ? 0 : across * down;
}

static void count_backdrop(const FrameSetup *setup, DipCounters *counters) {
    const DipBackdropParts *backdrop = &setup->renderer->backdrop;
    const uint64_t across = (uint64_t)tiles_in(backdrop->target.width);
    const uint64_t down = (uint64_t)tiles_in(backdrop->target.height);
    counters->fragments_behind = setup->fragments_behind;
    counters->backdrop_texels = setup->backdrop_texels;
    counters->backdrop_bytes = dip_backdrop_bytes(backdrop);
    counters->tiles_spared += setup->plan.effects.scattering.run ? 0 : across * down;
}

// Sets the scene of a frame at the frame's time. If the scene moves, the frames that are drawn at
// once show the posed scene of the first one.
static void pose_scene(FrameSetup *setup, const DipScene *scene, int64_t time_ns,
                       const FrameSetup *first) {
    setup->scene = scene;
    if (scene->motion && first) {
        setup->scene = first->scene;
        setup->posing_ms = first->posing_ms;
    } else if (scene->motion) {
        const int64_t begin_ns = dip_clock_ns();
        setup->scene = dip_posed_scene_at(setup->renderer->posed, time_ns, setup->renderer->pool);
        setup->posing_ms = 1e-6 * (double)(dip_clock_ns() - begin_ns);
    }
}

// Sets a frame up: plans it and makes its passes. first: the first of the frames that are drawn at
// once, or NULL if it is this one.
static bool begin_frame(FrameSetup *setup, DipRenderer *renderer, const DipScene *of,
                        const DipPose *pose, int64_t time_ns, const FrameSetup *first,
                        const DipSampleReadback *readback, DipFrame *frame, DipError *err) {
    if (!check_pose(pose, err) || !dip_renderer_follow_scale(renderer, err) ||
        !dip_renderer_adopt_scene(renderer, of, err) ||
        !dip_renderer_follow_settings(renderer, of, err)) {
        return false;
    }
    *setup = (FrameSetup){
        .renderer = renderer, .frame = frame, .readback = readback, .time_ns = time_ns};
    pose_scene(setup, of, time_ns, first);
    const DipScene *scene = setup->scene;
    setup->view =
        dip_view_make(pose, (double)scene->near_m, (double)renderer->width / renderer->height);
    shift_view(setup);
    setup->mirrored = dip_view_mirror(&setup->view, renderer->reflection.level_m);
    setup->seen = dip_cull_view_planes(setup->view.world_to_clip);
    setup->seen_mirrored = dip_cull_view_planes(setup->mirrored.world_to_clip);
    // The margin is 2 texels: one because a bilinear read also uses the next texel, and one for
    // rounding.
    const DipMirror *mirror = &renderer->mirror;
    setup->parts = (DipParts){mirror->tile_regions, mirror->target.width, mirror->target.height, 2};
    setup->reflection = renderer->reflection;
    if (mirror->pipeline) {
        setup->reflection.width = mirror->target.width;
        setup->reflection.height = mirror->target.height;
    }
    setup->input = (DipPlanInput){
        .scene = scene,
        .view = &setup->view,
        .mirrored = &setup->mirrored,
        .seen = &setup->seen,
        .seen_mirrored = &setup->seen_mirrored,
        .parts = &setup->parts,
        .reflection = &setup->reflection,
        .backdrop_width = renderer->backdrop.target.width,
        .backdrop_height = renderer->backdrop.target.height,
        .quality = &renderer->quality,
        .plain_surfaces = renderer->plain_surfaces,
        .force_all = renderer->force_all_effects,
    };
    setup->plan = dip_plan_frame(&setup->input);
    dip_set_samplers(scene, &renderer->quality, renderer->mip_colours, renderer->samplers);
    if (mirror->samplers) {
        const DipQuality mirrored = dip_quality_mirrored(&renderer->quality);
        dip_set_samplers(scene, &mirrored, renderer->mip_colours, mirror->samplers);
    }
    if (setup->plan.effects.sky.run) {
        renderer->sky = dip_sky_at(&scene->sky, time_ns);
    }
    *frame = (DipFrame){
        .width = renderer->width,
        .height = renderer->height,
        .effects = setup->plan.effects,
    };
    if (setup->plan.effects.shadows.run) {
        make_shadow_pass(setup);
    }
    if (setup->plan.effects.reflection.run) {
        make_mirrored_pass(setup);
    }
    make_scene_pass(setup);
    if (setup->plan.effects.scattering.run) {
        make_backdrop_pass(setup);
    }
    return true;
}

static DipPassWork work_of(DipPipeline *pipeline, const DipPass *pass, FrameSetup *setup) {
    return (DipPassWork){pipeline, pass, &setup->counters, &setup->frame->stages, NULL};
}

// Points the frame to the renderer's records, and notes the work that was done before the main
// pass.
static void begin_tiles(const FrameSetup *setup) {
    const DipRenderer *renderer = setup->renderer;
    if (renderer->recording.tiles && !renderer->scaled.pipeline) {
        setup->frame->tiles = (DipFrameTiles){
            .records = renderer->recording.tiles,
            .mixed = renderer->recording.mixed,
            .across = tiles_in(renderer->width),
            .down = tiles_in(renderer->height),
            .mirrored = setup->counters,
            .mirrored_times = setup->frame->stages,
        };
    }
}

// Draws the shadow maps of all frames together.
static bool draw_shadows(FrameSetup *setups, int count, DipError *err) {
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
static bool draw_backdrops(FrameSetup *setups, int count, bool same_geometry, DipError *err) {
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
        FrameSetup *setup = &setups[i];
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
static bool draw_frames(FrameSetup *setups, int count, bool same_geometry, DipError *err) {
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

// Converts the passes' counters to a frame's counters.
static DipCounters frame_counters(const DipPipelineCounters *passes) {
    DipCounters counters = {
        .fragments_lit = passes->shader_counts[DIP_SHADER_COUNT_LIT],
        .fragments_normal_mapped = passes->shader_counts[DIP_SHADER_COUNT_NORMAL_MAPPED],
        .fragments_pbr = passes->shader_counts[DIP_SHADER_COUNT_PBR],
        .fragments_occluded = passes->shader_counts[DIP_SHADER_COUNT_OCCLUDED],
        .fragments_emitting = passes->shader_counts[DIP_SHADER_COUNT_EMITTING],
        .fragments_coated = passes->shader_counts[DIP_SHADER_COUNT_COATED],
        .fragments_surrounded = passes->shader_counts[DIP_SHADER_COUNT_SURROUNDED],
        .fragments_sheen = passes->shader_counts[DIP_SHADER_COUNT_SHEEN],
        .fragments_transmitting = passes->shader_counts[DIP_SHADER_COUNT_TRANSMITTING],
        .fragments_scattering = passes->shader_counts[DIP_SHADER_COUNT_SCATTERING],
        .fragments_shadowed = passes->shader_counts[DIP_SHADER_COUNT_SHADOWED],
        .fragments_blended = passes->fragments_ordered, // all ordered draws of a scene blend
        .fragments_sky = passes->shader_counts[DIP_SHADER_COUNT_SKY],
        .fragments_reflecting = passes->shader_counts[DIP_SHADER_COUNT_REFLECTING],
    };
#define COPY(name, text) counters.name = passes->name;
    DIP_PIPELINE_COUNTER_LIST(COPY)
#undef COPY
    return counters;
}

// Ends the averaging of a larger picture. Returns the frame's picture.
static DipTarget shrink(const FrameSetup *setup) {
    DipStageTimes *stages = &setup->frame->stages;
    const int64_t begin_ns = dip_clock_ns();
    dip_box_filter(&setup->box, setup->renderer->pool);
    const double ms = 1e-6 * (double)(dip_clock_ns() - begin_ns);
    stages->resolve_ms += ms;
    stages->total_ms += ms;
    return setup->box.to;
}

static void end_frame(const FrameSetup *setup) {
    const DipRenderer *renderer = setup->renderer;
    DipFrame *frame = setup->frame;
    frame->counters = frame_counters(&setup->counters);
    frame->counters.fragments_mirrored = setup->fragments_mirrored;
    count_backdrop(setup, &frame->counters);
    frame->counters.vertices_posed = setup->scene->moving_vertices;
    frame->stages.geometry_ms += setup->posing_ms;
    frame->stages.total_ms += setup->posing_ms;
    const bool reflects = setup->plan.effects.reflection.run;
    const DipTarget picture =
        renderer->scaled.codes ? shrink(setup) : dip_renderer_target(renderer);
    frame->rgba8 = picture.rgba8;
    frame->stride_bytes = picture.stride_bytes;
    count_mirror(&renderer->mirror, reflects, &frame->counters);
    count_shadows(setup, &frame->counters);
    // The pipeline counts only the draws that it was given.
    frame->counters.draws_culled += (uint64_t)renderer->set.culled;
    frame->counters.draws_culled += reflects ? (uint64_t)renderer->mirror.set.culled : 0;
    count_bytes(setup->scene, &frame->counters);
    dip_count_geometry(setup->scene, renderer->unshared, &frame->counters);
    if (reflects && renderer->reflection.show) {
        dip_inset_draw(&picture, &renderer->mirror.target);
    }
    if (!setup->readback) {
        const DipFinishMotion motion = follow_past(setup);
        dip_finish_frame(renderer->finish, &motion, frame);
    }
}

// Corrects a frame's effects after all frames that are drawn at once have ended.
static void settle_effects(const FrameSetup *setup) {
    const bool copied = setup->frame->counters.fragments_copied > 0;
    // What casts shadows need not be in view.
    DipCounters seen = setup->frame->counters;
    seen.fragments_clip_tested -= setup->shadow_counters.fragments_clip_tested;
    seen.clip_sample_groups -= setup->shadow_counters.clip_sample_groups;
    dip_plan_settle(&setup->input, &seen, copied ? &setup->copies_from->frame->counters : NULL,
                    &setup->frame->effects);
}

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
static void choose_copying(FrameSetup *setups, int count, int index) {
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
    FrameSetup setups[DIP_MAX_FRAMES_AT_ONCE];
    if (count < 1 || count > DIP_MAX_FRAMES_AT_ONCE) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "count", "%d frames, accepted 1..%d",
                             count, DIP_MAX_FRAMES_AT_ONCE);
    }
    bool same = true;
    for (int i = 0; i < count; i++) {
        if (!begin_frame(&setups[i], renderers[i], scene, pose, time_ns, i > 0 ? &setups[0] : NULL,
                         NULL, frames[i], err)) {
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
static bool draw_readback(FrameSetup *setup, DipError *err) {
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
    FrameSetup setup;
    DipFrame frame;
    if (dip_quality_drawn_size(&renderer->quality, renderer->width) != renderer->width ||
        dip_quality_drawn_size(&renderer->quality, renderer->height) != renderer->height) {
        return dip_error_set(
            err, DIP_ERROR_UNSUPPORTED, NULL, 0, "scale",
            "the pixels that are drawn are not those of the frame, accepted scale=1");
    }
    if (!check_region(renderer, &readback->region, err) ||
        !begin_frame(&setup, renderer, scene, pose, time_ns, NULL, readback, &frame, err) ||
        !draw_readback(&setup, err)) {
        return false;
    }
    end_frame(&setup);
    settle_effects(&setup);
    return true;
}
