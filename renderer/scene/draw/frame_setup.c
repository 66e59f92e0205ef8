// Sets frames up: turns a scene, a pose and settings into the render passes of a frame. These are
// the main pass and, before it, what the main pass reads: the shadow map, the mirrored scene if
// water reflects, and the backdrop of rough glass.
#include "renderer/scene/draw/frame_setup.h"

#include "renderer/base/clock.h"
#include "renderer/scene/draw/draws.h"
#include "renderer/scene/draw/frame_history.h"
#include "renderer/scene/materials/sky.h"
#include "renderer/scene/resources/scene_layout.h"

#include <string.h>

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

// Makes the pass that draws the shadow map. The map must hold what the frame shows and what its
// water mirrors, whether or not water is in view, so that it does not depend on the plan.
static void make_shadow_pass(DipFrameSetup *setup) {
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
static const DipShadowUniforms *see_shadow(const DipFrameSetup *setup, const DipView *view,
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
static void make_mirrored_pass(DipFrameSetup *setup) {
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
static void average_pass(DipFrameSetup *setup) {
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
        .srgb = scaled->codes,
    };
    setup->pass.tile_done = dip_box_take_tile;
    setup->pass.tile_context = &setup->box;
}

static void make_scene_pass(DipFrameSetup *setup) {
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
static void make_backdrop_pass(DipFrameSetup *setup) {
    DipRenderer *renderer = setup->renderer;
    DipPass *pass = &setup->backdrop_pass;
    *pass = begin_pass(renderer, setup->scene, &setup->plan);
    pass->target = renderer->backdrop.target;
    pass->region = setup->plan.backdrop_region;
    pass->draws = renderer->set.draws;
    pass->draw_count = renderer->set.plain_count;
}

// --- the frame -----------------------------------------------------------------------------------

// Sets the scene of a frame at the frame's time. If the scene moves, the frames that are drawn at
// once show the posed scene of the first one.
static void pose_scene(DipFrameSetup *setup, const DipScene *scene, int64_t time_ns,
                       const DipFrameSetup *first) {
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

bool dip_frame_begin(DipFrameSetup *setup, DipRenderer *renderer, const DipScene *of,
                     const DipPose *pose, int64_t time_ns, const DipFrameSetup *first,
                     const DipSampleReadback *readback, DipFrame *frame, DipError *err) {
    if (!dip_pose_check(pose, err) || !dip_renderer_follow_scale(renderer, err) ||
        !dip_renderer_adopt_scene(renderer, of, err) ||
        !dip_renderer_follow_settings(renderer, of, err)) {
        return false;
    }
    *setup = (DipFrameSetup){
        .renderer = renderer, .frame = frame, .readback = readback, .time_ns = time_ns};
    pose_scene(setup, of, time_ns, first);
    const DipScene *scene = setup->scene;
    setup->view =
        dip_view_make(pose, (double)scene->near_m, (double)renderer->width / renderer->height);
    dip_frame_shift_view(setup);
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
