// The renderer: a scene, a pose and settings become the draws of one pass.
#include "renderer/renderer.h"

#include "renderer/base/assert.h"
#include "renderer/geometry/view.h"
#include "renderer/pipeline.h"
#include "renderer/plan/plan.h"
#include "renderer/raster/kernels.h"
#include "renderer/resolve/inset.h"
#include "renderer/scene_internal.h"
#include "renderer/shading/water.h"
#include "renderer/texture/mip_debug.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PIXEL_ALIGN = 64 };

// What a pass draws of the scene.
typedef struct DrawSet {
    DipDraw *draws;               // one per object, or fewer
    DipSurfaceUniforms *uniforms; // of each
    int count;
} DrawSet;

// What the reflection takes; empty while the scene has no water.
typedef struct Mirror {
    DipPipeline *pipeline;
    DipTarget target;
    DrawSet set;
    DipWaterUniforms *water; // per object
} Mirror;

struct DipRenderer {
    DipPool *pool;
    DipIsa isa;
    int width;
    int height;
    DipQuality quality;
    DipPipeline *pipeline;
    uint8_t *rgba8;
    size_t stride_bytes;
    DipTexture *mip_colours; // levels 1024 .. 8 of mip debugging
    DipReflectionDef reflection;
    bool force_all_effects;

    // For the scene drawn last.
    uint64_t scene_serial;
    DrawSet set;
    Mirror mirror;
    DipSampler (*samplers)[DIP_SURFACE_SAMPLER_COUNT]; // per material
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
    renderer->force_all_effects = def->force_all_effects;
    renderer->mip_colours = dip_mip_debug_create(NULL, err);
    if (!renderer->mip_colours ||
        !make_target(def->pool, def->isa, def->width, def->height, &renderer->pipeline,
                     &renderer->rgba8, &renderer->stride_bytes, err)) {
        dip_renderer_destroy(&renderer);
    }
    return renderer;
}

static void free_set(DrawSet *set) {
    free(set->draws);
    free(set->uniforms);
    *set = (DrawSet){0};
}

static void free_mirror(Mirror *mirror) {
    dip_pipeline_destroy(&mirror->pipeline);
    free(mirror->target.rgba8);
    free_set(&mirror->set);
    free(mirror->water);
    *mirror = (Mirror){0};
}

// Everything made for a scene.
static void forget_scene(DipRenderer *renderer) {
    renderer->scene_serial = 0;
    free_set(&renderer->set);
    free_mirror(&renderer->mirror);
    free(renderer->samplers);
    renderer->samplers = NULL;
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

// --- a frame's draws ---------------------------------------------------------------------------

// The cofactors of the transform's 3x3 part, which turn normals as the inverse transpose does but
// for length and, where the transform mirrors, sign.
static void cofactors(const float t[12], double n[9]) {
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            const float *a = t + 4 * ((r + 1) % 3);
            const float *b = t + 4 * ((r + 2) % 3);
            n[3 * r + c] =
                (double)a[(c + 1) % 3] * b[(c + 2) % 3] - (double)a[(c + 2) % 3] * b[(c + 1) % 3];
        }
    }
}

static bool mirrors(const float t[12]) {
    double n[9];
    cofactors(t, n);
    return (t[0] * n[0] + t[1] * n[1]) + t[2] * n[2] < 0.0;
}

// Scaled to a greatest element of 1, so that the shader may normalise what it turns, however small
// the object is.
static void normal_matrix(const float t[12], float out[9]) {
    double n[9];
    cofactors(t, n);
    double greatest = 0.0;
    for (int i = 0; i < 9; i++) {
        const double size = n[i] < 0.0 ? -n[i] : n[i];
        greatest = size > greatest ? size : greatest;
    }
    const double scale = greatest > 0.0 ? (mirrors(t) ? -1.0 : 1.0) / greatest : 0.0;
    for (int i = 0; i < 9; i++) {
        out[i] = (float)(n[i] * scale);
    }
}

static DipSampler colour_sampler(const DipRenderer *renderer, const DipTexture *texture) {
    // Per step of miplod, from high performance to high quality: bias in levels, times 256.
    static const int32_t bias_lod8[] = {384, 256, 128, 0};
    const int miplod = renderer->quality.step[DIP_SETTING_MIPLOD];
    DipSampler sampler = {
        .texture = texture,
        .max_anisotropy = dip_quality_max_anisotropy(&renderer->quality),
        .advanced = renderer->quality.step[DIP_SETTING_AAF] != 0,
        .bias_lod8 = bias_lod8[miplod],
    };
    if (miplod == DIP_MIPLOD_HIGH_PERFORMANCE) {
        sampler.min_lod8 = texture->width >= 1024 || texture->height >= 1024 ? 512 : 256;
    }
    if (renderer->quality.step[DIP_SETTING_MIPDEBUG]) {
        sampler.shown = renderer->mip_colours;
        dip_mip_debug_levels(texture, sampler.shown_level);
    }
    return sampler;
}

static void set_samplers(DipRenderer *renderer, const DipScene *scene) {
    for (int i = 0; i < scene->material_count; i++) {
        const DipSceneMaterial *material = &scene->materials[i];
        if (material->colour_texture != DIP_NO_TEXTURE) {
            renderer->samplers[i][DIP_SURFACE_SAMPLER_COLOUR] =
                colour_sampler(renderer, scene->textures[material->colour_texture]);
        }
        if (material->light_map != DIP_NO_TEXTURE) {
            renderer->samplers[i][DIP_SURFACE_SAMPLER_LIGHT_MAP] =
                (DipSampler){.texture = scene->textures[material->light_map], .max_anisotropy = 1};
        }
    }
}

// Appends an object's draw to a set.
static void add_draw(const DipRenderer *renderer, const DipScene *scene, int index,
                     const DipView *view, DrawSet *set) {
    const DipKernels *kernels = dip_kernels(renderer->isa);
    const DipSceneObject *object = &scene->objects[index];
    const DipSceneMesh *mesh = &scene->meshes[object->mesh];
    const DipSceneMaterial *material = &scene->materials[mesh->material];
    DipSurfaceUniforms *uniforms = &set->uniforms[set->count];
    *uniforms = mesh->layout;
    dip_view_place(view, object->transform, uniforms->to_clip);
    normal_matrix(object->transform, uniforms->normal_to_world);
    if (renderer->quality.step[DIP_SETTING_MIPDEBUG] && uniforms->colour_slot != DIP_NO_SLOT) {
        for (int c = 0; c < 3; c++) {
            uniforms->base_colour_lin[c] = 1.0f;
        }
    }
    const bool clipped =
        material->surface == DIP_SURFACE_CLIPPED && uniforms->colour_slot != DIP_NO_SLOT;
    set->draws[set->count++] = (DipDraw){
        .mesh = mesh->mesh,
        .vertex_shader = kernels->dip_kernel_surface_vertex,
        .fragment_shader = kernels->dip_kernel_surface_fragment,
        .clip_shader = clipped ? kernels->dip_kernel_surface_clip : NULL,
        .slot_count = mesh->slot_count,
        .clip_slot_count = clipped ? uniforms->colour_slot + 2 : 0,
        .uniforms = uniforms,
        .samplers = renderer->samplers[mesh->material],
        .bounds_to_clip = uniforms->to_clip,
        .cull = material->double_sided       ? DIP_CULL_NONE
                : mirrors(object->transform) ? DIP_CULL_FRONT
                                             : DIP_CULL_BACK,
    };
}

static bool is_water(const DipScene *scene, int object) {
    return scene->materials[scene->meshes[scene->objects[object].mesh].material].surface ==
           DIP_SURFACE_WATER;
}

// How far each pixel place of the frame looks down; see DipWaterUniforms.
static void set_rays(const DipRenderer *renderer, const DipView *view, DipWaterUniforms *water) {
    const double a[2] = {-1.0 / view->scale[0], 2.0 / (renderer->width * view->scale[0])};
    const double b[2] = {1.0 / view->scale[1], -2.0 / (renderer->height * view->scale[1])};
    const double up[3] = {view->axis[0][1], view->axis[1][1], view->axis[2][1]};
    water->inverse_size[0] = 1.0f / (float)renderer->width;
    water->inverse_size[1] = 1.0f / (float)renderer->height;
    for (int i = 0; i < 2; i++) {
        water->a[i] = (float)a[i];
        water->b[i] = (float)b[i];
    }
    water->down[0] = (float)(up[2] - (a[0] * up[0] + b[0] * up[1]));
    water->down[1] = (float)(-a[1] * up[0]);
    water->down[2] = (float)(-b[1] * up[1]);
    water->mirrored = &renderer->mirror.target;
    water->schlick = renderer->reflection.schlick;
}

// Makes the draw added last one of water that reflects.
static void make_reflecting(DipRenderer *renderer, const DipView *view) {
    const int last = renderer->set.count - 1;
    DipDraw *draw = &renderer->set.draws[last];
    DipWaterUniforms *water = &renderer->mirror.water[last];
    water->surface = renderer->set.uniforms[last];
    set_rays(renderer, view, water);
    draw->uniforms = water;
    draw->fragment_shader = dip_kernels(renderer->isa)->dip_kernel_water_fragment;
}

static void set_draws(DipRenderer *renderer, const DipScene *scene, const DipView *view,
                      const DipFramePlan *plan) {
    renderer->set.count = 0;
    for (int i = 0; i < scene->object_count; i++) {
        add_draw(renderer, scene, i, view, &renderer->set);
        if (plan->water_reflects && is_water(scene, i)) {
            make_reflecting(renderer, view);
        }
    }
}

// The mirrored scene without its water, whose windings turn around.
static void set_mirrored_draws(DipRenderer *renderer, const DipScene *scene, const DipView *view) {
    static const DipCull turned[] = {DIP_CULL_NONE, DIP_CULL_FRONT, DIP_CULL_BACK};
    DrawSet *set = &renderer->mirror.set;
    set->count = 0;
    for (int i = 0; i < scene->object_count; i++) {
        if (!is_water(scene, i)) {
            add_draw(renderer, scene, i, view, set);
            set->draws[set->count - 1].cull = turned[set->draws[set->count - 1].cull];
        }
    }
}

static bool make_set(DrawSet *set, int object_count, DipError *err) {
    const size_t room = (size_t)object_count + 1;
    set->draws = calloc(room, sizeof *set->draws);
    set->uniforms = calloc(room, sizeof *set->uniforms);
    return (set->draws && set->uniforms) || dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "scene",
                                                          "no memory for %d objects", object_count);
}

// Makes the reflection's target and room for its pass.
static bool make_mirror(DipRenderer *renderer, const DipScene *scene, DipError *err) {
    Mirror *mirror = &renderer->mirror;
    DipTarget *target = &mirror->target;
    target->width = renderer->reflection.width;
    target->height = renderer->reflection.height;
    if (!make_set(&mirror->set, scene->object_count, err) ||
        !make_target(renderer->pool, renderer->isa, target->width, target->height,
                     &mirror->pipeline, &target->rgba8, &target->stride_bytes, err)) {
        return false;
    }
    memset(target->rgba8, 0, target->stride_bytes * (size_t)target->height);
    mirror->water = calloc((size_t)scene->object_count + 1, sizeof *mirror->water);
    if (!mirror->water) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "scene", "no memory for %d objects",
                             scene->object_count);
    }
    const DipPose pose = {.orientation = {0.0, 0.0, 0.0, 1.0}, .fov_y_deg = 60.0};
    const DipView view = dip_view_make(&pose, (double)scene->near_m, 1.0);
    set_mirrored_draws(renderer, scene, &view);
    const DipPass pass = {.draws = mirror->set.draws, .draw_count = mirror->set.count};
    return dip_pipeline_reserve(mirror->pipeline, &pass, err);
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
    made = made && make_set(&renderer->set, scene->object_count, err);
    if (made && scene->has_water && renderer->reflection.width) {
        made = make_mirror(renderer, scene, err);
    }
    if (!made) {
        forget_scene(renderer);
        return false;
    }
    renderer->scene_serial = scene->serial;
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

// The mirrored scene above the water. What is less than two texels of the picture below it counts
// as above, so that no background is read between a shore and its reflection.
static bool draw_mirrored(DipRenderer *renderer, const DipScene *scene, const DipView *view,
                          const DipFramePlan *plan, DipFrame *frame, DipError *err) {
    Mirror *mirror = &renderer->mirror;
    const DipView mirrored = dip_view_mirror(view, renderer->reflection.level_m);
    const double above[4] = {0.0, 1.0, 0.0, -renderer->reflection.level_m};
    const double texel = 2.0 / (view->scale[1] * mirror->target.height); // high, at a distance of 1
    double plane[4];
    dip_view_plane(&mirrored, above, plane);
    plane[3] += 2.0 * texel;
    set_mirrored_draws(renderer, scene, &mirrored);
    DipPass pass = {
        .draws = mirror->set.draws,
        .draw_count = mirror->set.count,
        .sample_count = dip_quality_sample_count(&renderer->quality),
        .clip_plane_count = 1,
        .target = mirror->target,
        .region = plan->mirrored_region,
    };
    memcpy(pass.clear_lin, scene->background_lin, sizeof pass.clear_lin);
    for (int i = 0; i < 4; i++) {
        pass.clip_planes[0][i] = (float)plane[i];
    }
    const bool drawn =
        dip_pipeline_draw(mirror->pipeline, &pass, &frame->counters, &frame->stages, err);
    frame->counters.reflection_fragments = frame->counters.fragments_shaded;
    return drawn;
}

static bool draw_scene(DipRenderer *renderer, const DipScene *scene, const DipView *view,
                       const DipFramePlan *plan, DipFrame *frame, DipError *err) {
    set_draws(renderer, scene, view, plan);
    DipPass pass = {
        .draws = renderer->set.draws,
        .draw_count = renderer->set.count,
        .sample_count = dip_quality_sample_count(&renderer->quality),
        .target = {renderer->rgba8, renderer->stride_bytes, renderer->width, renderer->height},
    };
    memcpy(pass.clear_lin, scene->background_lin, sizeof pass.clear_lin);
    return dip_pipeline_draw(renderer->pipeline, &pass, &frame->counters, &frame->stages, err);
}

static void count_mirror(const Mirror *mirror, bool drawn, DipCounters *counters) {
    const uint64_t across = (uint64_t)(mirror->target.width + DIP_TILE - 1) / DIP_TILE;
    const uint64_t down = (uint64_t)(mirror->target.height + DIP_TILE - 1) / DIP_TILE;
    counters->reflection_bytes = mirror->target.stride_bytes * (uint64_t)mirror->target.height;
    counters->tiles_spared += drawn ? 0 : across * down;
}

bool dip_renderer_draw(DipRenderer *renderer, const DipScene *scene, const DipPose *pose,
                       int64_t time_ns, DipFrame *frame, DipError *err) {
    (void)time_ns; // nothing in a scene moves by itself yet
    if (!check_pose(pose, err) || !adopt_scene(renderer, scene, err)) {
        return false;
    }
    const DipView view =
        dip_view_make(pose, (double)scene->near_m, (double)renderer->width / renderer->height);
    const DipPlanInput input = {
        .scene = scene,
        .view = &view,
        .reflection = &renderer->reflection,
        .force_all = renderer->force_all_effects,
    };
    const DipFramePlan plan = dip_plan_frame(&input);
    const bool mirrored = plan.effects.reflection.run;
    set_samplers(renderer, scene);
    *frame = (DipFrame){
        .rgba8 = renderer->rgba8,
        .stride_bytes = renderer->stride_bytes,
        .width = renderer->width,
        .height = renderer->height,
        .effects = plan.effects,
    };
    if ((mirrored && !draw_mirrored(renderer, scene, &view, &plan, frame, err)) ||
        !draw_scene(renderer, scene, &view, &plan, frame, err)) {
        return false;
    }
    count_mirror(&renderer->mirror, mirrored, &frame->counters);
    if (mirrored && renderer->reflection.show) {
        dip_inset_draw(&(DipTarget){renderer->rgba8, renderer->stride_bytes, renderer->width,
                                    renderer->height},
                       &renderer->mirror.target);
    }
    return true;
}
