// Creates, changes and destroys renderers and the resources that they keep for a scene.
#include "renderer/scene/renderer.h"

#include "renderer/base/fp_mode.h"
#include "renderer/base/pages.h"
#include "renderer/scene/draw/box.h"
#include "renderer/scene/draw/renderer_parts.h"
#include "renderer/scene/mip_debug.h"
#include "renderer/scene/resources/scene_layout.h"
#include "renderer/scene/view/view.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

DipRendererDef dip_renderer_default_def(void) {
    return (DipRendererDef){
        .isa = dip_isa_best(),
        .width = 640,
        .height = 480,
        .quality = dip_quality_default(),
    };
}

// Creates a pipeline and a picture of the same size, or neither.
static bool make_target(DipPool *pool, DipIsa isa, int width, int height, DipPipeline **pipeline,
                        uint8_t **rgba8, size_t *stride_bytes, DipError *err) {
    *pipeline = dip_pipeline_create(pool, isa, width, height, err);
    if (!*pipeline) {
        return false;
    }
    *stride_bytes = ((size_t)width * 4 + DIP_CACHE_LINE - 1) / DIP_CACHE_LINE * DIP_CACHE_LINE;
    *rgba8 = dip_lines_alloc(*stride_bytes * (size_t)height);
    if (!*rgba8) {
        dip_pipeline_destroy(pipeline);
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "size", "no memory for %dx%d pixels",
                             width, height);
    }
    return true;
}

static int tiles_in(int size) {
    return (size + DIP_TARGET_TILE - 1) / DIP_TARGET_TILE;
}

static void free_recording(DipTileRecording *recording) {
    free(recording->tiles);
    free(recording->mixed);
    *recording = (DipTileRecording){.tiles = NULL};
}

static bool make_recording(int width, int height, DipTileRecording *recording, DipError *err) {
    const size_t tiles = (size_t)tiles_in(width) * (size_t)tiles_in(height);
    recording->tiles = calloc(tiles, sizeof *recording->tiles);
    recording->mixed = calloc((size_t)width * (size_t)height, 1);
    if (recording->tiles && recording->mixed) {
        return true;
    }
    free_recording(recording);
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "tiles",
                         "no memory for the records of %dx%d pixels", width, height);
}

static bool check_reflection(const DipReflectionDef *reflection, DipError *err) {
    if (!reflection->width) {
        return true;
    }
    if (reflection->width < 1 || reflection->height < 1 || reflection->width > DIP_MAX_FRAME_SIZE ||
        reflection->height > DIP_MAX_FRAME_SIZE) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "reflection",
                             "%dx%d pixels is out of range, accepted 1x1 to %dx%d, or width 0 for "
                             "no reflection",
                             reflection->width, reflection->height, DIP_MAX_FRAME_SIZE,
                             DIP_MAX_FRAME_SIZE);
    }
    return isfinite(reflection->level_m) ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "reflection",
                         "level %g m is out of range, accepted finite numbers",
                         reflection->level_m);
}

DipRenderer *dip_renderer_create(const DipRendererDef *def, DipError *err) {
    DIP_FP_MODE_SCOPE();
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
    renderer->finish = dip_finish_create(def->pool, def->isa, err);
    if (!renderer->mip_colours || !renderer->finish ||
        !make_target(def->pool, def->isa, def->width, def->height, &renderer->pipeline,
                     &renderer->rgba8, &renderer->stride_bytes, err)) {
        dip_renderer_destroy(&renderer);
    }
    return renderer;
}

static void free_mirror(DipMirror *mirror) {
    dip_pipeline_destroy(&mirror->pipeline);
    dip_lines_free(mirror->target.rgba8);
    free(mirror->tile_regions);
    free(mirror->samplers);
    dip_draw_set_free(&mirror->set);
    *mirror = (DipMirror){0};
}

static void free_scaled(DipScaled *scaled) {
    dip_pipeline_destroy(&scaled->pipeline);
    dip_lines_free(scaled->target.rgba8);
    dip_lines_free(scaled->light16);
    free(scaled->codes);
    *scaled = (DipScaled){0};
}

// Makes what averages a larger picture.
static bool make_average(const DipRenderer *renderer, DipScaled *scaled, DipError *err) {
    const DipTarget *from = &scaled->target;
    const size_t bytes =
        dip_box_light_bytes(from->width, from->height, renderer->width, renderer->height);
    scaled->light16 = bytes ? dip_lines_alloc(bytes) : NULL;
    scaled->codes = malloc(sizeof *scaled->codes);
    if ((bytes && !scaled->light16) || !scaled->codes) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "scale", "no memory for %dx%d pixels",
                             from->width, from->height);
    }
    dip_srgb_encode_table(scaled->codes);
    return true;
}

static bool make_scaled(const DipRenderer *renderer, int width, int height, DipScaled *scaled,
                        DipError *err) {
    DipTarget *target = &scaled->target;
    if (width > DIP_MAX_FRAME_SIZE || height > DIP_MAX_FRAME_SIZE) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "scale",
                             "would draw %dx%d pixels, accepted up to %dx%d", width, height,
                             DIP_MAX_FRAME_SIZE, DIP_MAX_FRAME_SIZE);
    }
    *scaled = (DipScaled){.target = {.width = width, .height = height}};
    const bool made =
        make_target(renderer->pool, renderer->isa, width, height, &scaled->pipeline, &target->rgba8,
                    &target->stride_bytes, err) &&
        (dip_quality_upscales(&renderer->quality) || make_average(renderer, scaled, err));
    if (!made) {
        free_scaled(scaled);
    }
    return made;
}

// Frees the resources that were made for a scene.
static void forget_scene(DipRenderer *renderer) {
    renderer->scene_serial = 0;
    dip_draw_set_free(&renderer->set);
    free_mirror(&renderer->mirror);
    dip_shadows_free(&renderer->shadows);
    dip_backdrop_free(&renderer->backdrop);
    free(renderer->samplers);
    renderer->samplers = NULL;
    dip_unshared_meshes_destroy(&renderer->unshared);
    dip_posed_scene_destroy(&renderer->posed);
}

void dip_renderer_destroy(DipRenderer **renderer_pointer) {
    DipRenderer *renderer = *renderer_pointer;
    if (!renderer) {
        return;
    }
    dip_pipeline_destroy(&renderer->pipeline);
    dip_texture_destroy(&renderer->mip_colours);
    dip_finish_destroy(&renderer->finish);
    dip_lines_free(renderer->rgba8);
    free_scaled(&renderer->scaled);
    free_recording(&renderer->recording);
    forget_scene(renderer);
    free(renderer);
    *renderer_pointer = NULL;
}

bool dip_renderer_set_quality(DipRenderer *renderer, const DipQuality *quality, DipError *err) {
    DIP_FP_MODE_SCOPE();
    if (!dip_quality_check(quality, err)) {
        return false;
    }
    renderer->quality = *quality;
    return true;
}

bool dip_renderer_set_reflection(DipRenderer *renderer, const DipReflectionDef *reflection,
                                 DipError *err) {
    DIP_FP_MODE_SCOPE();
    if (!check_reflection(reflection, err)) {
        return false;
    }
    if (reflection->width != renderer->reflection.width ||
        reflection->height != renderer->reflection.height) {
        forget_scene(renderer); // the next frame creates a target of the new size
    }
    renderer->reflection = *reflection;
    renderer->past.exists = false;
    return true;
}

DipQuality dip_renderer_quality(const DipRenderer *renderer) {
    return renderer->quality;
}

void dip_renderer_copy_shading(DipRenderer *renderer, bool on) {
    renderer->copies_shading = on;
}

void dip_renderer_set_frame_index(DipRenderer *renderer, uint64_t frame_index) {
    renderer->frame_index = frame_index;
}

void dip_renderer_cut(DipRenderer *renderer) {
    renderer->past.exists = false;
}

bool dip_renderer_resize(DipRenderer *renderer, int width, int height, DipError *err) {
    DIP_FP_MODE_SCOPE();
    if (width == renderer->width && height == renderer->height) {
        return true;
    }
    DipPipeline *pipeline;
    uint8_t *rgba8;
    size_t stride_bytes;
    DipTileRecording recording = {.tiles = NULL};
    if (renderer->recording.tiles && !make_recording(width, height, &recording, err)) {
        return false;
    }
    if (!make_target(renderer->pool, renderer->isa, width, height, &pipeline, &rgba8, &stride_bytes,
                     err)) {
        free_recording(&recording);
        return false;
    }
    dip_pipeline_record_tiles(pipeline, &recording);
    free_recording(&renderer->recording);
    renderer->recording = recording;
    free_scaled(&renderer->scaled); // the next frame creates one of the new size
    dip_pipeline_destroy(&renderer->pipeline);
    dip_lines_free(renderer->rgba8);
    renderer->pipeline = pipeline;
    renderer->reserved = false;
    renderer->rgba8 = rgba8;
    renderer->stride_bytes = stride_bytes;
    renderer->width = width;
    renderer->height = height;
    renderer->past.exists = false;
    return true;
}

DipTarget dip_renderer_target(const DipRenderer *renderer) {
    const DipTarget own = {.rgba8 = renderer->rgba8,
                           .stride_bytes = renderer->stride_bytes,
                           .width = renderer->width,
                           .height = renderer->height};
    return renderer->scaled.pipeline ? renderer->scaled.target : own;
}

DipPipeline *dip_renderer_pipeline(const DipRenderer *renderer) {
    return renderer->scaled.pipeline ? renderer->scaled.pipeline : renderer->pipeline;
}

bool dip_renderer_record_tiles(DipRenderer *renderer, bool on, DipError *err) {
    DIP_FP_MODE_SCOPE();
    if (on == (renderer->recording.tiles != NULL)) {
        return true;
    }
    if (!on) {
        free_recording(&renderer->recording);
    } else if (!make_recording(renderer->width, renderer->height, &renderer->recording, err)) {
        return false;
    }
    dip_pipeline_record_tiles(renderer->pipeline, &renderer->recording);
    return true;
}

bool dip_renderer_follow_scale(DipRenderer *renderer, DipError *err) {
    const DipQuality *quality = &renderer->quality;
    const int width = dip_quality_drawn_size(quality, renderer->width);
    const int height = dip_quality_drawn_size(quality, renderer->height);
    const DipTarget drawn = dip_renderer_target(renderer);
    if (width != drawn.width || height != drawn.height) {
        DipScaled scaled = {0};
        const bool own_size = width == renderer->width && height == renderer->height;
        if (!own_size && !make_scaled(renderer, width, height, &scaled, err)) {
            return false;
        }
        free_scaled(&renderer->scaled);
        renderer->scaled = scaled;
        renderer->reserved = false;
    }
    const DipMirror *mirror = &renderer->mirror;
    const DipReflectionDef *reflection = &renderer->reflection;
    if (mirror->pipeline &&
        (mirror->target.width != dip_quality_drawn_size(quality, reflection->width) ||
         mirror->target.height != dip_quality_drawn_size(quality, reflection->height))) {
        forget_scene(renderer); // the scene's new resources have a reflection of the right size
    }
    return true;
}

bool dip_renderer_set_mip_pictures(DipRenderer *renderer,
                                   const DipTextureDef *pictures[DIP_MIP_DEBUG_LEVELS],
                                   DipError *err) {
    DIP_FP_MODE_SCOPE();
    DipTexture *colours = dip_mip_debug_create(pictures, err);
    if (!colours) {
        return false;
    }
    dip_texture_destroy(&renderer->mip_colours);
    renderer->mip_colours = colours;
    renderer->past.exists = false;
    return true;
}

// --- resources for a scene ---------------------------------------------------------------------

DipDrawInput dip_renderer_draw_input(const DipRenderer *renderer, const DipScene *scene,
                                     bool mirrored) {
    const DipMaterialSamplers *own = (const DipMaterialSamplers *)renderer->mirror.samplers;
    return (DipDrawInput){
        .scene = scene,
        .kernels = dip_material_kernels(renderer->isa),
        .quality = &renderer->quality,
        .samplers = mirrored && own ? own : (const DipMaterialSamplers *)renderer->samplers,
        .sky = &renderer->sky,
        .unshared = renderer->unshared,
        .plain_surfaces = renderer->plain_surfaces,
        .all_lights = renderer->force_all_effects,
        .pool = renderer->pool,
    };
}

// Reserves the memory that drawing the whole scene takes, so that frames allocate nothing.
static bool reserve(const DipRenderer *renderer, const DipScene *scene, bool mirrored,
                    DipPipeline *pipeline, DipDrawSet *set, DipError *err) {
    const DipPose pose = {.orientation = {0.0, 0.0, 0.0, 1.0}, .fov_y_deg = 60.0};
    const DipView view = dip_view_make(&pose, (double)scene->near_m, 1.0);
    const DipDrawInput input = dip_renderer_draw_input(renderer, scene, mirrored);
    // Surfaces that receive shadows may have more varyings.
    static const DipShadowUniforms shadow;
    const DipDrawView all = {.view = &view,
                             .width = 1,
                             .height = 1,
                             .mirrored = mirrored,
                             .shadow = renderer->shadows.depth ? &shadow : NULL};
    dip_draw_set_fill(set, &input, &all);
    const DipPass pass = {.draws = set->draws, .draw_count = set->count};
    return dip_pipeline_reserve(pipeline, &pass, err);
}

// Creates the reflection's target and reserves the memory for its pass.
static bool make_mirror(DipRenderer *renderer, const DipScene *scene, DipError *err) {
    DipMirror *mirror = &renderer->mirror;
    DipTarget *target = &mirror->target;
    target->width = dip_quality_drawn_size(&renderer->quality, renderer->reflection.width);
    target->height = dip_quality_drawn_size(&renderer->quality, renderer->reflection.height);
    if (!dip_draw_set_make(&mirror->set, scene, false, err) ||
        !make_target(renderer->pool, renderer->isa, target->width, target->height,
                     &mirror->pipeline, &target->rgba8, &target->stride_bytes, err)) {
        return false;
    }
    memset(target->rgba8, 0, target->stride_bytes * (size_t)target->height);
    mirror->tile_regions =
        calloc((size_t)tiles_in(target->width) * (size_t)tiles_in(target->height) + 1,
               sizeof *mirror->tile_regions);
    if (!mirror->tile_regions) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "reflection",
                             "no memory for %dx%d pixels", target->width, target->height);
    }
    return reserve(renderer, scene, true, mirror->pipeline, &mirror->set, err);
}

// Creates the resources for a scene other than the one that this renderer drew last.
static bool make_for_scene(DipRenderer *renderer, const DipScene *scene, DipError *err) {
    forget_scene(renderer);
    renderer->samplers = calloc((size_t)scene->material_count + 1, sizeof *renderer->samplers);
    bool made =
        renderer->samplers || dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "scene",
                                            "no memory for %d materials", scene->material_count);
    const bool reflects =
        scene->has_water && renderer->reflection.width && !renderer->plain_surfaces;
    made = made && dip_draw_set_make(&renderer->set, scene, reflects, err) &&
           (!reflects || make_mirror(renderer, scene, err));
    if (made && scene->motion) {
        renderer->posed = dip_posed_scene_create(scene, err);
        made = renderer->posed != NULL;
    }
    if (!made) {
        forget_scene(renderer);
        return false;
    }
    renderer->scene_serial = scene->serial;
    renderer->reserved = false;
    return true;
}

bool dip_renderer_adopt_scene(DipRenderer *renderer, const DipScene *scene, DipError *err) {
    if (renderer->scene_serial != scene->serial && !make_for_scene(renderer, scene, err)) {
        return false;
    }
    renderer->reserved =
        renderer->reserved ||
        reserve(renderer, scene, false, dip_renderer_pipeline(renderer), &renderer->set, err);
    return renderer->reserved;
}

// Creates or frees the samplers of the mirrored scene, which it needs where it is not sampled as
// the frame is.
static bool follow_mirrored(DipRenderer *renderer, const DipScene *scene, DipError *err) {
    DipMirror *mirror = &renderer->mirror;
    const DipQuality mirrored = dip_quality_mirrored(&renderer->quality);
    if (!mirror->pipeline || dip_quality_equal(&mirrored, &renderer->quality)) {
        free(mirror->samplers);
        mirror->samplers = NULL;
        return true;
    }
    if (!mirror->samplers) {
        mirror->samplers = calloc((size_t)scene->material_count + 1, sizeof *mirror->samplers);
    }
    return mirror->samplers || dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "reflection",
                                             "no memory for %d materials", scene->material_count);
}

// Creates or frees the shadow map.
static bool follow_shadows(DipRenderer *renderer, const DipScene *scene, DipError *err) {
    DipShadows *shadows = &renderer->shadows;
    DipMirror *mirror = &renderer->mirror;
    const bool possible = dip_scene_has_shadows(scene) && !renderer->plain_surfaces;
    const int size = possible ? dip_quality_shadow_size(&renderer->quality) : 0;
    if (size == (shadows->depth ? dip_depth_width(shadows->depth) : 0)) {
        return true;
    }
    dip_shadows_free(shadows);
    const bool made =
        !size ||
        (dip_shadows_make(shadows, scene, renderer->pool, renderer->isa, size, err) &&
         reserve(renderer, scene, false, dip_renderer_pipeline(renderer), &renderer->set, err) &&
         (!mirror->pipeline ||
          reserve(renderer, scene, true, mirror->pipeline, &mirror->set, err)));
    if (!made) {
        dip_shadows_free(shadows);
    }
    return made;
}

// Creates or frees the backdrop of rough glass, which has the size of what the main pass draws.
static bool follow_backdrop(DipRenderer *renderer, const DipScene *scene, DipError *err) {
    DipBackdropParts *backdrop = &renderer->backdrop;
    const DipTarget drawn = dip_renderer_target(renderer);
    const bool possible = scene->has_scattering && !renderer->plain_surfaces;
    const int width = possible ? drawn.width : 0;
    const int height = possible ? drawn.height : 0;
    if (width == backdrop->target.width && height == backdrop->target.height) {
        return true;
    }
    dip_backdrop_free(backdrop);
    return !possible || dip_backdrop_make(backdrop, width, height, err);
}

bool dip_renderer_follow_settings(DipRenderer *renderer, const DipScene *scene, DipError *err) {
    const DipQuality *quality = &renderer->quality;
    const DipFinishSize size = dip_finish_size(quality, renderer->width, renderer->height);
    if (dip_quality_compresses(quality) &&
        !dip_scene_compress_textures(scene, renderer->pool, err)) {
        return false;
    }
    if (!follow_mirrored(renderer, scene, err) || !follow_shadows(renderer, scene, err) ||
        !follow_backdrop(renderer, scene, err) ||
        !dip_finish_follow(renderer->finish, quality, &size, err)) {
        return false;
    }
    if (quality->step[DIP_SETTING_GI]) {
        dip_unshared_meshes_destroy(&renderer->unshared);
    } else if (!renderer->unshared) {
        renderer->unshared = dip_unshared_meshes_create(scene, renderer->pool, err);
        return renderer->unshared != NULL;
    }
    return true;
}
