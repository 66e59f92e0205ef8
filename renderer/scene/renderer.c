// The renderer: a scene, a pose and settings become one or two passes.
#include "renderer/scene/renderer.h"

#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/draw/draws.h"
#include "renderer/scene/draw/inset.h"
#include "renderer/scene/draw/view.h"
#include "renderer/scene/materials/material_kernels.h"
#include "renderer/scene/materials/sky.h"
#include "renderer/scene/plan/plan.h"
#include "renderer/scene/resources/instancing.h"
#include "renderer/scene/resources/mip_debug.h"
#include "renderer/scene/resources/scene_layout.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PIXEL_ALIGN = 64 };

// What the reflection takes; empty while the scene has no water.
typedef struct Mirror {
    DipPipeline *pipeline;
    DipTarget target;
    DipTilePart *tile_parts; // of the target: what the water can show
    DipDrawSet set;
} Mirror;

struct DipRenderer {
    DipPool *pool;
    DipIsa isa;
    int width;
    int height;
    DipQuality quality;
    uint64_t frame_index;
    DipPipeline *pipeline;
    uint8_t *rgba8;
    size_t stride_bytes;
    DipTexture *mip_colours; // levels 1024 .. 8 of mip debugging
    DipReflectionDef reflection;
    bool plain_surfaces;
    bool force_all_effects;
    DipSkyUniforms sky; // of the frame, where a shader needs it

    // For the scene drawn last.
    uint64_t scene_serial;
    bool reserved; // the pipeline has room for it
    DipDrawSet set;
    Mirror mirror;
    DipMaterialSamplers *samplers; // per material
    DipExpanded *expanded;         // gi=off; else NULL
};

DipRendererDef dip_renderer_default_def(void) {
    return (DipRendererDef){
        .isa = dip_isa_best(),
        .width = 640,
        .height = 480,
        .quality = dip_quality_default(),
    };
}

// Makes the pipeline and the pixels of a size into *pipeline and *rgba8, or neither.
static bool make_target(DipPool *pool, DipIsa isa, int width, int height, DipPipeline **pipeline,
                        uint8_t **rgba8, size_t *stride_bytes, DipError *err) {
    *pipeline = dip_pipeline_create(pool, isa, width, height, err);
    if (!*pipeline) {
        return false;
    }
    *stride_bytes = ((size_t)width * 4 + PIXEL_ALIGN - 1) / PIXEL_ALIGN * PIXEL_ALIGN;
    *rgba8 = aligned_alloc(PIXEL_ALIGN, *stride_bytes * (size_t)height);
    if (!*rgba8) {
        dip_pipeline_destroy(pipeline);
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "size", "no memory for %dx%d pixels",
                             width, height);
    }
    return true;
}

static bool check_reflection(const DipReflectionDef *reflection, DipError *err) {
    if (!reflection->width) {
        return true;
    }
    if (reflection->width < 1 || reflection->height < 1 || reflection->width > DIP_MAX_FRAME_SIZE ||
        reflection->height > DIP_MAX_FRAME_SIZE) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "reflection",
                             "%dx%d pixels, accepted 1x1 to %dx%d, or width 0 for none",
                             reflection->width, reflection->height, DIP_MAX_FRAME_SIZE,
                             DIP_MAX_FRAME_SIZE);
    }
    return isfinite(reflection->level_m) ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "reflection",
                         "a level of %g m, accepted finite numbers", reflection->level_m);
}

DipRenderer *dip_renderer_create(const DipRendererDef *def, DipError *err) {
    if (!dip_quality_check(&def->quality, err) || !check_reflection(&def->reflection, err)) {
        return NULL;
    }
    DipRenderer *renderer = calloc(1, sizeof *renderer);
    if (!renderer) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "renderer", "out of memory");
        return NULL;
    }
    renderer->pool = def->pool;
    renderer->isa = def->isa;
    renderer->width = def->width;
    renderer->height = def->height;
    renderer->quality = def->quality;
    renderer->reflection = def->reflection;
    renderer->plain_surfaces = def->plain_surfaces;
    renderer->force_all_effects = def->force_all_effects;
    renderer->mip_colours = dip_mip_debug_create(NULL, err);
    if (!renderer->mip_colours ||
        !make_target(def->pool, def->isa, def->width, def->height, &renderer->pipeline,
                     &renderer->rgba8, &renderer->stride_bytes, err)) {
        dip_renderer_destroy(&renderer);
    }
    return renderer;
}

static void free_mirror(Mirror *mirror) {
    dip_pipeline_destroy(&mirror->pipeline);
    free(mirror->target.rgba8);
    free(mirror->tile_parts);
    dip_draw_set_free(&mirror->set);
    *mirror = (Mirror){0};
}

// Everything made for a scene.
static void forget_scene(DipRenderer *renderer) {
    renderer->scene_serial = 0;
    dip_draw_set_free(&renderer->set);
    free_mirror(&renderer->mirror);
    free(renderer->samplers);
    renderer->samplers = NULL;
    dip_expanded_destroy(&renderer->expanded);
}

void dip_renderer_destroy(DipRenderer **renderer_pointer) {
    DipRenderer *renderer = *renderer_pointer;
    if (!renderer) {
        return;
    }
    dip_pipeline_destroy(&renderer->pipeline);
    dip_texture_destroy(&renderer->mip_colours);
    free(renderer->rgba8);
    forget_scene(renderer);
    free(renderer);
    *renderer_pointer = NULL;
}

bool dip_renderer_set_quality(DipRenderer *renderer, const DipQuality *quality, DipError *err) {
    if (!dip_quality_check(quality, err)) {
        return false;
    }
    renderer->quality = *quality;
    return true;
}

bool dip_renderer_set_reflection(DipRenderer *renderer, const DipReflectionDef *reflection,
                                 DipError *err) {
    if (!check_reflection(reflection, err)) {
        return false;
    }
    if (reflection->width != renderer->reflection.width ||
        reflection->height != renderer->reflection.height) {
        forget_scene(renderer); // its target is made anew with the next frame
    }
    renderer->reflection = *reflection;
    return true;
}

DipQuality dip_renderer_quality(const DipRenderer *renderer) {
    return renderer->quality;
}

void dip_renderer_set_frame_index(DipRenderer *renderer, uint64_t frame_index) {
    renderer->frame_index = frame_index;
}

bool dip_renderer_resize(DipRenderer *renderer, int width, int height, DipError *err) {
    if (width == renderer->width && height == renderer->height) {
        return true;
    }
    DipPipeline *pipeline;
    uint8_t *rgba8;
    size_t stride_bytes;
    if (!make_target(renderer->pool, renderer->isa, width, height, &pipeline, &rgba8, &stride_bytes,
                     err)) {
        return false;
    }
    dip_pipeline_destroy(&renderer->pipeline);
    free(renderer->rgba8);
    renderer->pipeline = pipeline;
    renderer->reserved = false;
    renderer->rgba8 = rgba8;
    renderer->stride_bytes = stride_bytes;
    renderer->width = width;
    renderer->height = height;
    return true;
}

bool dip_renderer_set_mip_pictures(DipRenderer *renderer,
                                   const DipTextureDef *pictures[DIP_MIP_DEBUG_LEVELS],
                                   DipError *err) {
    DipTexture *colours = dip_mip_debug_create(pictures, err);
    if (!colours) {
        return false;
    }
    dip_texture_destroy(&renderer->mip_colours);
    renderer->mip_colours = colours;
    return true;
}

// --- what a scene takes ------------------------------------------------------------------------

static DipDrawInput draw_input(const DipRenderer *renderer, const DipScene *scene) {
    return (DipDrawInput){
        .scene = scene,
        .kernels = dip_material_kernels(renderer->isa),
        .quality = &renderer->quality,
        .samplers = (const DipMaterialSamplers *)renderer->samplers,
        .sky = &renderer->sky,
        .expanded = renderer->expanded,
        .plain_surfaces = renderer->plain_surfaces,
    };
}

// Makes room for all that the scene has, in view or not.
static bool reserve(const DipRenderer *renderer, const DipScene *scene, bool mirrored,
                    DipPipeline *pipeline, DipDrawSet *set, DipError *err) {
    const DipPose pose = {.orientation = {0.0, 0.0, 0.0, 1.0}, .fov_y_deg = 60.0};
    const DipView view = dip_view_make(&pose, (double)scene->near_m, 1.0);
    const DipDrawInput input = draw_input(renderer, scene);
    const DipDrawView all = {.view = &view, .width = 1, .height = 1, .mirrored = mirrored};
    dip_draw_set_fill(set, &input, &all);
    const DipPass pass = {.draws = set->draws, .draw_count = set->count};
    return dip_pipeline_reserve(pipeline, &pass, err);
}

static int tiles_in(int size) {
    return (size + DIP_TILE - 1) / DIP_TILE;
}

// Makes the reflection's target and room for its pass.
static bool make_mirror(DipRenderer *renderer, const DipScene *scene, DipError *err) {
    Mirror *mirror = &renderer->mirror;
    DipTarget *target = &mirror->target;
    target->width = renderer->reflection.width;
    target->height = renderer->reflection.height;
    if (!dip_draw_set_make(&mirror->set, scene->object_count, false, err) ||
        !make_target(renderer->pool, renderer->isa, target->width, target->height,
                     &mirror->pipeline, &target->rgba8, &target->stride_bytes, err)) {
        return false;
    }
    memset(target->rgba8, 0, target->stride_bytes * (size_t)target->height);
    mirror->tile_parts =
        calloc((size_t)tiles_in(target->width) * (size_t)tiles_in(target->height) + 1,
               sizeof *mirror->tile_parts);
    if (!mirror->tile_parts) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "reflection",
                             "no memory for %dx%d pixels", target->width, target->height);
    }
    return reserve(renderer, scene, true, mirror->pipeline, &mirror->set, err);
}

// Makes the arrays for a scene not drawn before.
static bool adopt_scene(DipRenderer *renderer, const DipScene *scene, DipError *err) {
    if (renderer->scene_serial == scene->serial) {
        return true;
    }
    forget_scene(renderer);
    renderer->samplers = calloc((size_t)scene->material_count + 1, sizeof *renderer->samplers);
    bool made =
        renderer->samplers || dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "scene",
                                            "no memory for %d materials", scene->material_count);
    const bool reflects =
        scene->has_water && renderer->reflection.width && !renderer->plain_surfaces;
    made = made && dip_draw_set_make(&renderer->set, scene->object_count, reflects, err) &&
           (!reflects || make_mirror(renderer, scene, err));
    if (!made) {
        forget_scene(renderer);
        return false;
    }
    renderer->scene_serial = scene->serial;
    renderer->reserved = false;
    return true;
}

static bool reserve_once(DipRenderer *renderer, const DipScene *scene, DipError *err) {
    renderer->reserved = renderer->reserved ||
                         reserve(renderer, scene, false, renderer->pipeline, &renderer->set, err);
    return renderer->reserved;
}

// Makes what the settings need of the scene beside it, or gives it back.
static bool follow_settings(DipRenderer *renderer, const DipScene *scene, DipError *err) {
    const DipQuality *quality = &renderer->quality;
    if (dip_quality_compresses(quality) &&
        !dip_scene_compress_textures(scene, renderer->pool, err)) {
        return false;
    }
    if (quality->step[DIP_SETTING_GI]) {
        dip_expanded_destroy(&renderer->expanded);
    } else if (!renderer->expanded) {
        renderer->expanded = dip_expanded_create(scene, renderer->pool, err);
        return renderer->expanded != NULL;
    }
    return true;
}

static bool check_pose(const DipPose *pose, DipError *err) {
    bool finite = isfinite(pose->fov_y_deg);
    for (int i = 0; i < 3; i++) {
        finite = finite && isfinite(pose->position_world[i]);
    }
    for (int i = 0; i < 4; i++) {
        finite = finite && isfinite(pose->orientation[i]);
    }
    if (!finite || pose->fov_y_deg < 1.0 || pose->fov_y_deg > 170.0) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "pose",
                             "a pose with a field of view of %g degrees, accepted finite numbers "
                             "and 1..170",
                             pose->fov_y_deg);
    }
    return true;
}

// --- passes ------------------------------------------------------------------------------------

// What every pass takes of the settings and the scene, without its draws.
static DipPass begin_pass(const DipRenderer *renderer, const DipScene *scene,
                          const DipFramePlan *plan) {
    DipPass pass = {
        .sample_count = dip_quality_sample_count(&renderer->quality),
        .pattern =
            dip_pattern_kind(renderer->quality.step[DIP_SETTING_TAA] != 0, renderer->frame_index),
        .samples_per_pass = plan->samples_per_pass,
    };
    memcpy(pass.clear_lin, scene->background_lin, sizeof pass.clear_lin);
    return pass;
}

// Gives a pass the draws of what it may show.
static void set_draws(const DipRenderer *renderer, const DipScene *scene, DipDrawView view,
                      DipDrawSet *set, DipPass *pass) {
    const DipDrawInput input = draw_input(renderer, scene);
    const DipCullPlanes seen = dip_cull_pass_planes(pass, view.view);
    view.seen = &seen;
    view.width = pass->target.width;
    view.height = pass->target.height;
    dip_draw_set_fill(set, &input, &view);
    pass->draws = set->draws;
    pass->draw_count = set->count;
}

// A frame in the making. Its parts point at each other.
typedef struct Making {
    DipRenderer *renderer;
    const DipScene *scene;
    DipFrame *frame;
    DipView view;
    DipView mirrored;
    DipCullPlanes seen;
    DipCullPlanes seen_mirrored;
    DipParts parts;
    DipPlanInput input;
    DipFramePlan plan;
    DipPass mirrored_pass; // where the plan reflects
    DipPass pass;
} Making;

static DipTarget target_of(const DipRenderer *renderer) {
    return (DipTarget){renderer->rgba8, renderer->stride_bytes, renderer->width, renderer->height};
}

// The mirrored scene above the water. What is less than two texels of the picture below it counts
// as above, so that no background is read between a shore and its reflection.
static void make_mirrored_pass(Making *making) {
    const DipRenderer *renderer = making->renderer;
    const DipView *mirrored = &making->mirrored;
    Mirror *mirror = &making->renderer->mirror;
    const double above[4] = {0.0, 1.0, 0.0, -renderer->reflection.level_m};
    const double texel = 2.0 / (mirrored->scale[1] * mirror->target.height); // at a distance of 1
    double plane[4];
    dip_view_plane(mirrored, above, plane);
    plane[3] += 2.0 * texel;
    DipPass *pass = &making->mirrored_pass;
    *pass = begin_pass(renderer, making->scene, &making->plan);
    pass->target = mirror->target;
    pass->region = making->plan.mirrored_region;
    pass->tile_parts = making->plan.mirrored_parts ? mirror->tile_parts : NULL;
    pass->clip_plane_count = 1;
    for (int i = 0; i < 4; i++) {
        pass->clip_planes[0][i] = (float)plane[i];
    }
    const DipDrawView seen = {.view = mirrored, .mirrored = true};
    set_draws(renderer, making->scene, seen, &mirror->set, pass);
}

static void make_scene_pass(Making *making) {
    DipRenderer *renderer = making->renderer;
    const DipDrawView seen = {
        .view = &making->view,
        .shown = making->plan.water_reflects ? &renderer->mirror.target : NULL,
        .schlick = renderer->reflection.schlick,
    };
    making->pass = begin_pass(renderer, making->scene, &making->plan);
    making->pass.target = target_of(renderer);
    set_draws(renderer, making->scene, seen, &renderer->set, &making->pass);
}

// What the effects hold, used in this frame or not.
static void count_bytes(const DipScene *scene, DipCounters *counters) {
    counters->normal_map_bytes = scene->normal_map_bytes;
    counters->clip_map_bytes = scene->clip_map_bytes;
    counters->cloud_bytes = scene->cloud_bytes;
}

static void count_mirror(const Mirror *mirror, bool drawn, DipCounters *counters) {
    const uint64_t across = (uint64_t)tiles_in(mirror->target.width);
    const uint64_t down = (uint64_t)tiles_in(mirror->target.height);
    counters->reflection_bytes = mirror->target.stride_bytes * (uint64_t)mirror->target.height;
    counters->tiles_spared += drawn ? 0 : across * down;
}

// Decides what is drawn.
static bool begin_frame(Making *making, DipRenderer *renderer, const DipScene *scene,
                        const DipPose *pose, int64_t time_ns, DipFrame *frame, DipError *err) {
    if (!check_pose(pose, err) || !adopt_scene(renderer, scene, err) ||
        !reserve_once(renderer, scene, err) || !follow_settings(renderer, scene, err)) {
        return false;
    }
    making->renderer = renderer;
    making->scene = scene;
    making->frame = frame;
    making->view =
        dip_view_make(pose, (double)scene->near_m, (double)renderer->width / renderer->height);
    making->mirrored = dip_view_mirror(&making->view, renderer->reflection.level_m);
    making->seen = dip_cull_view_planes(&making->view);
    making->seen_mirrored = dip_cull_view_planes(&making->mirrored);
    // A bilinear read takes in the next texel; one more for what is rounded.
    const Mirror *mirror = &renderer->mirror;
    making->parts = (DipParts){mirror->tile_parts, mirror->target.width, mirror->target.height, 2};
    making->input = (DipPlanInput){
        .scene = scene,
        .view = &making->view,
        .mirrored = &making->mirrored,
        .seen = &making->seen,
        .seen_mirrored = &making->seen_mirrored,
        .parts = &making->parts,
        .reflection = &renderer->reflection,
        .quality = &renderer->quality,
        .plain_surfaces = renderer->plain_surfaces,
        .force_all = renderer->force_all_effects,
    };
    making->plan = dip_plan_frame(&making->input);
    dip_set_samplers(scene, &renderer->quality, renderer->mip_colours, renderer->samplers);
    if (making->plan.effects.sky.run) {
        renderer->sky = dip_sky_at(&scene->sky, time_ns);
    }
    *frame = (DipFrame){
        .rgba8 = renderer->rgba8,
        .stride_bytes = renderer->stride_bytes,
        .width = renderer->width,
        .height = renderer->height,
        .effects = making->plan.effects,
    };
    if (making->plan.effects.reflection.run) {
        make_mirrored_pass(making);
    }
    make_scene_pass(making);
    return true;
}

static DipPassWork work_of(DipPipeline *pipeline, const DipPass *pass, DipFrame *frame) {
    return (DipPassWork){pipeline, pass, &frame->counters, &frame->stages};
}

static bool draw_works(const DipPassWork *works, int count, bool same_geometry, DipError *err) {
    if (count == 2) {
        return dip_pipeline_draw_pair(works, same_geometry, err);
    }
    return !count ||
           dip_pipeline_draw(works->pipeline, works->pass, works->counters, works->times, err);
}

// Draws one or two frames; of two, same_geometry: they differ in samples and shading alone.
static bool draw_frames(Making *makings, int count, bool same_geometry, DipError *err) {
    DipPassWork works[2];
    int work_count = 0;
    for (int i = 0; i < count; i++) {
        if (makings[i].plan.effects.reflection.run) {
            works[work_count++] = work_of(makings[i].renderer->mirror.pipeline,
                                          &makings[i].mirrored_pass, makings[i].frame);
        }
    }
    if (!draw_works(works, work_count, same_geometry, err)) {
        return false;
    }
    for (int i = 0; i < count; i++) {
        DipCounters *counters = &makings[i].frame->counters;
        counters->fragments_mirrored = counters->fragments_shaded;
        works[i] = work_of(makings[i].renderer->pipeline, &makings[i].pass, makings[i].frame);
    }
    return draw_works(works, count, same_geometry, err);
}

static void end_frame(const Making *making) {
    const DipRenderer *renderer = making->renderer;
    DipFrame *frame = making->frame;
    const bool reflects = making->plan.effects.reflection.run;
    count_mirror(&renderer->mirror, reflects, &frame->counters);
    count_bytes(making->scene, &frame->counters);
    dip_count_geometry(making->scene, renderer->expanded, &frame->counters);
    dip_plan_settle(&making->input, &frame->counters, &frame->effects);
    if (reflects && renderer->reflection.show) {
        const DipTarget target = target_of(renderer);
        dip_inset_draw(&target, &renderer->mirror.target);
    }
}

bool dip_renderer_draw(DipRenderer *renderer, const DipScene *scene, const DipPose *pose,
                       int64_t time_ns, DipFrame *frame, DipError *err) {
    Making making;
    if (!begin_frame(&making, renderer, scene, pose, time_ns, frame, err) ||
        !draw_frames(&making, 1, false, err)) {
        return false;
    }
    end_frame(&making);
    return true;
}

// Whether two renderers' frames differ in samples and shading alone.
static bool same_geometry(const DipRenderer *a, const DipRenderer *b) {
    const DipReflectionDef *r = &a->reflection;
    const DipReflectionDef *s = &b->reflection;
    return a->isa == b->isa && a->width == b->width && a->height == b->height &&
           a->plain_surfaces == b->plain_surfaces && a->force_all_effects == b->force_all_effects &&
           a->quality.step[DIP_SETTING_GI] == b->quality.step[DIP_SETTING_GI] &&
           r->width == s->width && r->height == s->height && r->level_m == s->level_m;
}

bool dip_renderer_draw_pair(DipRenderer *const renderers[2], const DipScene *scene,
                            const DipPose *pose, int64_t time_ns, DipFrame *const frames[2],
                            DipError *err) {
    Making makings[2];
    for (int i = 0; i < 2; i++) {
        if (!begin_frame(&makings[i], renderers[i], scene, pose, time_ns, frames[i], err)) {
            return false;
        }
    }
    if (!draw_frames(makings, 2, same_geometry(renderers[0], renderers[1]), err)) {
        return false;
    }
    for (int i = 0; i < 2; i++) {
        end_frame(&makings[i]);
    }
    return true;
}
