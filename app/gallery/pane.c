// Panes: pictures of a gallery's scene with their own size and settings.
#include "app/gallery/gallery.h"

#include "app/gallery/scenes/scene.h"
#include "renderer/base/fp_mode.h"
#include "renderer/base/pages.h"
#include "renderer/base/trig.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct DipGalleryPane {
    DipGallery *gallery;
    DipPool *pool;
    DipIsa isa;
    DipQuality quality;
    uint64_t frame_index;
    DipPipeline *pipeline;
    DipTarget target;
};

// Creates a pipeline and a picture of one size, or neither.
static bool make_picture(DipPool *pool, DipIsa isa, int width, int height, DipPipeline **pipeline,
                         DipTarget *target, DipError *err) {
    *pipeline = dip_pipeline_create(pool, isa, width, height, err);
    if (!*pipeline) {
        return false;
    }
    *target = (DipTarget){.width = width, .height = height};
    target->stride_bytes =
        ((size_t)width * 4 + DIP_CACHE_LINE - 1) / DIP_CACHE_LINE * DIP_CACHE_LINE;
    target->rgba8 = dip_lines_alloc(target->stride_bytes * (size_t)height);
    if (!target->rgba8) {
        dip_pipeline_destroy(pipeline);
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "size", "no memory for %dx%d pixels",
                             width, height);
    }
    return true;
}

DipGalleryPane *dip_gallery_pane_create(const DipGalleryPaneDef *def, DipError *err) {
    DIP_FP_MODE_SCOPE();
    DipGalleryPlaying playing;
    if (!dip_quality_check(&def->quality, err) ||
        !dip_gallery_play(def->gallery, 0, &playing, err)) {
        return NULL;
    }
    DipGalleryPane *pane = calloc(1, sizeof *pane);
    if (!pane) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "pane", "out of memory");
        return NULL;
    }
    pane->gallery = def->gallery;
    pane->pool = playing.pool;
    pane->isa = def->isa;
    pane->quality = def->quality;
    if (!make_picture(pane->pool, def->isa, def->width, def->height, &pane->pipeline, &pane->target,
                      err)) {
        dip_gallery_pane_destroy(&pane);
    }
    return pane;
}

void dip_gallery_pane_destroy(DipGalleryPane **pane_pointer) {
    DipGalleryPane *pane = *pane_pointer;
    if (!pane) {
        return;
    }
    dip_pipeline_destroy(&pane->pipeline);
    dip_lines_free(pane->target.rgba8);
    free(pane);
    *pane_pointer = NULL;
}

bool dip_gallery_pane_set_quality(DipGalleryPane *pane, const DipQuality *quality, DipError *err) {
    if (!dip_quality_check(quality, err)) {
        return false;
    }
    pane->quality = *quality;
    return true;
}

bool dip_gallery_pane_resize(DipGalleryPane *pane, int width, int height, DipError *err) {
    DIP_FP_MODE_SCOPE();
    DipPipeline *pipeline;
    DipTarget target;
    if (width == pane->target.width && height == pane->target.height) {
        return true;
    }
    if (!make_picture(pane->pool, pane->isa, width, height, &pipeline, &target, err)) {
        return false;
    }
    dip_pipeline_destroy(&pane->pipeline);
    dip_lines_free(pane->target.rgba8);
    pane->pipeline = pipeline;
    pane->target = target;
    return true;
}

DipQuality dip_gallery_pane_quality(const DipGalleryPane *pane) {
    return pane->quality;
}

void dip_gallery_pane_set_frame_index(DipGalleryPane *pane, uint64_t frame_index) {
    pane->frame_index = frame_index;
}

// --- drawing -------------------------------------------------------------------------------------

static bool check_pose(const DipPose *pose, DipError *err) {
    const double *q = pose->orientation;
    const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    bool finite = true;
    for (int i = 0; i < 3; i++) {
        finite = finite && isfinite(pose->position_world[i]);
    }
    if (!finite || !isfinite(length) || length < 1e-150) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "pose",
                             "the pose is not finite or has no orientation");
    }
    return (pose->fov_y_deg >= 1.0 && pose->fov_y_deg <= 170.0) ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "fov_y_deg",
                         "%g is out of range, accepted 1..170", pose->fov_y_deg);
}

// Returns how the settings filter textures. The texture is the scene's to set.
static DipSampler filter_of(const DipQuality *quality) {
    static const int32_t bias_lod8[] = {
        [DIP_MIPLOD_HIGH_PERFORMANCE] = 384,
        [DIP_MIPLOD_PERFORMANCE] = 256,
        [DIP_MIPLOD_QUALITY] = 128,
        [DIP_MIPLOD_HIGH_QUALITY] = 0,
    };
    return (DipSampler){
        .max_anisotropy = dip_quality_max_anisotropy(quality),
        .exact_footprint = quality->step[DIP_SETTING_AAF] != 0,
        .bias_lod8 = bias_lod8[quality->step[DIP_SETTING_MIPLOD]],
        .cheap = quality->step[DIP_SETTING_OPT] == DIP_OPT_ADVANCED,
    };
}

// Reports the work of all passes as a frame. The scene renderer's effects never run here.
static void fill_frame(const DipGalleryPane *pane, const DipPipelineCounters *counters,
                       const DipStageTimes *times, DipFrame *frame) {
    static const DipEffect none = {.run = false, .why = "a gallery scene has its own shaders"};
    *frame = (DipFrame){
        .rgba8 = pane->target.rgba8,
        .stride_bytes = pane->target.stride_bytes,
        .width = pane->target.width,
        .height = pane->target.height,
        .stages = *times,
    };
#define COPY_COUNTER(name, text) frame->counters.name = counters->name;
    DIP_PIPELINE_COUNTER_LIST(COPY_COUNTER)
#undef COPY_COUNTER
#define SET_EFFECT(name, title) frame->effects.name = none;
    DIP_EFFECT_LIST(SET_EFFECT)
#undef SET_EFFECT
}

bool dip_gallery_pane_draw(DipGalleryPane *pane, const DipPose *pose, int64_t time_ns,
                           DipFrame *frame, DipError *err) {
    DIP_FP_MODE_SCOPE();
    DipPipelineCounters counters = {0};
    DipStageTimes times = {0};
    DipGalleryPlaying playing;
    if (!check_pose(pose, err) || !dip_gallery_play(pane->gallery, time_ns, &playing, err)) {
        return false;
    }
    const DipGalleryView view = {
        .pose = pose,
        .time_s = playing.time_s,
        .turn = 2.0 * DIP_PI * playing.time_s / DIP_GALLERY_SECONDS,
        .look = playing.look,
        .quality = &pane->quality,
        .pattern = dip_pattern_kind(pane->quality.step[DIP_SETTING_TAA] != 0, pane->frame_index),
        .target = pane->target,
        .pipeline = pane->pipeline,
        .filter = filter_of(&pane->quality),
        .mip_colours = playing.mip_colours,
        .counters = &counters,
        .times = &times,
    };
    if (!playing.scene->draw(playing.content, &view, err)) {
        return false;
    }
    fill_frame(pane, &counters, &times, frame);
    return true;
}
