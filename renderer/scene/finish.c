// Applies the filters of the settings to finished frames.
#include "renderer/scene/finish.h"

#include "renderer/base/clock.h"
#include "renderer/base/fp_mode.h"
#include "renderer/base/pages.h"
#include "renderer/post/post.h"

#include <stdlib.h>
#include <string.h>

// The history, which comes before the filters.
typedef struct Past {
    DipHistory *history; // NULL if it is off
    DipFinishSize size;
    float *depths;  // of the current frame
    uint8_t *rgba8; // its picture
} Past;

// The filters in the order in which they are applied.
enum { ANTIALIASING, UPSCALING, SHARPENING, FILTERS };

typedef struct Filter {
    DipPost *post;       // NULL if the filter is off
    DipPostDef def;      // that of `post`
    uint8_t *rgba8;      // its picture
    size_t stride_bytes; // of its picture
} Filter;

struct DipFinish {
    DipPool *pool;
    DipIsa isa;
    Past past;
    Filter filters[FILTERS];
};

DipFinish *dip_finish_create(DipPool *pool, DipIsa isa, DipError *err) {
    DipFinish *finish = calloc(1, sizeof *finish);
    if (!finish) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "filters", "out of memory");
        return NULL;
    }
    finish->pool = pool;
    finish->isa = isa;
    return finish;
}

static void free_filter(Filter *filter) {
    dip_post_destroy(&filter->post);
    dip_lines_free(filter->rgba8);
    *filter = (Filter){0};
}

static void free_past(Past *past) {
    dip_history_destroy(&past->history);
    dip_lines_free(past->depths);
    dip_lines_free(past->rgba8);
    *past = (Past){0};
}

static void free_filters(DipFinish *finish) {
    free_past(&finish->past);
    for (int i = 0; i < FILTERS; i++) {
        free_filter(&finish->filters[i]);
    }
}

void dip_finish_destroy(DipFinish **finish) {
    if (*finish) {
        free_filters(*finish);
        free(*finish);
        *finish = NULL;
    }
}

DipFinishSize dip_finish_size(const DipQuality *quality, int width, int height) {
    const bool enlarges = dip_quality_upscales(quality);
    return (DipFinishSize){
        .drawn_width = enlarges ? dip_quality_drawn_size(quality, width) : width,
        .drawn_height = enlarges ? dip_quality_drawn_size(quality, height) : height,
        .width = width,
        .height = height,
        .depths_width = dip_quality_drawn_size(quality, width),
        .depths_height = dip_quality_drawn_size(quality, height),
    };
}

// Describes a filter of the settings. Returns false if it is off.
static bool define_filter(const DipFinish *finish, int index, const DipQuality *quality,
                          const DipFinishSize *size, DipPostDef *def) {
    // RCAS by stops: a quarter, a half and all of its strength.
    static const float sharpness[] = {0.0f, 0.25f, 0.5f, 1.0f};
    static const DipPostFilter antialiasing[] = {
        [DIP_POST_STEP_FXAA] = DIP_POST_FXAA,
        [DIP_POST_STEP_SMAA] = DIP_POST_SMAA,
    };
    static const DipPostFilter upscaling[] = {
        [DIP_UPSCALE_BILINEAR] = DIP_POST_BILINEAR,
        [DIP_UPSCALE_BICUBIC] = DIP_POST_BICUBIC,
        [DIP_UPSCALE_EASU] = DIP_POST_EASU,
    };
    *def = (DipPostDef){
        .from_width = index == SHARPENING ? size->width : size->drawn_width,
        .from_height = index == SHARPENING ? size->height : size->drawn_height,
        .to_width = index == ANTIALIASING ? size->drawn_width : size->width,
        .to_height = index == ANTIALIASING ? size->drawn_height : size->height,
        .isa = finish->isa,
        .pool = finish->pool,
    };
    switch (index) {
    case ANTIALIASING:
        def->filter = antialiasing[quality->step[DIP_SETTING_POST]];
        return quality->step[DIP_SETTING_POST] != DIP_POST_STEP_OFF;
    case UPSCALING:
        def->filter = upscaling[quality->step[DIP_SETTING_UPSCALE]];
        return dip_quality_upscales(quality);
    default:
        def->filter = DIP_POST_SHARPEN;
        def->sharpness = sharpness[quality->step[DIP_SETTING_SHARPEN]];
        return quality->step[DIP_SETTING_SHARPEN] != 0;
    }
}

static bool same_filter(const DipPostDef *a, const DipPostDef *b) {
    return a->filter == b->filter && a->from_width == b->from_width &&
           a->from_height == b->from_height && a->to_width == b->to_width &&
           a->to_height == b->to_height && a->sharpness == b->sharpness;
}

static bool make_filter(Filter *filter, const DipPostDef *def, DipError *err) {
    free_filter(filter);
    filter->def = *def;
    filter->stride_bytes = (size_t)def->to_width * 4;
    filter->post = dip_post_create(def, err);
    filter->rgba8 = dip_lines_alloc(filter->stride_bytes * (size_t)def->to_height);
    if (filter->post && !filter->rgba8) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "size", "no memory for %dx%d pixels",
                             def->to_width, def->to_height);
    }
    return filter->post != NULL;
}

static size_t depths_bytes(const DipFinishSize *size) {
    return (size_t)size->depths_width * (size_t)size->depths_height * sizeof(float);
}

static size_t picture_bytes(const DipFinishSize *size) {
    return (size_t)size->drawn_width * (size_t)size->drawn_height * 4;
}

// Makes or frees the history.
static bool follow_past(DipFinish *finish, const DipQuality *quality, const DipFinishSize *size,
                        DipError *err) {
    Past *past = &finish->past;
    if (!dip_quality_has_history(quality)) {
        free_past(past);
        return true;
    }
    if (past->history && memcmp(&past->size, size, sizeof *size) == 0) {
        return true;
    }
    const DipHistoryDef def = {size->drawn_width, size->drawn_height, finish->isa, finish->pool};
    free_past(past);
    past->size = *size;
    past->history = dip_history_create(&def, err);
    if (!past->history) {
        return false;
    }
    past->depths = dip_lines_alloc(depths_bytes(size));
    past->rgba8 = dip_lines_alloc(picture_bytes(size));
    if (past->depths && past->rgba8) {
        memset(past->depths, 0, depths_bytes(size));
        memset(past->rgba8, 0, picture_bytes(size));
        return true;
    }
    free_past(past);
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "size", "no memory for %dx%d pixels",
                         size->drawn_width, size->drawn_height);
}

float *dip_finish_depths(DipFinish *finish) {
    return finish->past.depths;
}

bool dip_finish_follow(DipFinish *finish, const DipQuality *quality, const DipFinishSize *size,
                       DipError *err) {
    if (!follow_past(finish, quality, size, err)) {
        free_filters(finish);
        return false;
    }
    for (int i = 0; i < FILTERS; i++) {
        Filter *filter = &finish->filters[i];
        DipPostDef def;
        if (!define_filter(finish, i, quality, size, &def)) {
            free_filter(filter);
        } else if ((!filter->post || !same_filter(&filter->def, &def)) &&
                   !make_filter(filter, &def, err)) {
            free_filters(finish);
            return false;
        }
    }
    return true;
}

// Blends the frame with its past.
static void blend(const Past *past, const DipFinishMotion *motion, DipFrame *frame) {
    DipHistoryPicture picture = {
        .rgba8 = frame->rgba8,
        .stride_bytes = frame->stride_bytes,
        .depths = past->depths,
        .depths_width = past->size.depths_width,
        .depths_height = past->size.depths_height,
        .step = motion ? motion->step : DIP_HISTORY_BEGIN,
    };
    if (motion) {
        memcpy(picture.to_before, motion->to_before, sizeof picture.to_before);
    }
    const size_t stride_bytes = (size_t)past->size.drawn_width * 4;
    const DipHistoryWork work = dip_history_add(past->history, &picture, past->rgba8, stride_bytes);
    frame->rgba8 = past->rgba8;
    frame->stride_bytes = stride_bytes;
    frame->counters.pixels_filtered += work.pixels_filtered;
    frame->counters.pixels_reprojected += work.pixels_reprojected;
    frame->counters.history_bytes =
        dip_history_bytes(past->history) + depths_bytes(&past->size) + picture_bytes(&past->size);
}

void dip_finish_frame(DipFinish *finish, const DipFinishMotion *motion, DipFrame *frame) {
    DIP_FP_MODE_SCOPE();
    const int64_t begin_ns = dip_clock_ns();
    bool filtered = false;
    if (finish->past.history) {
        blend(&finish->past, motion, frame);
        filtered = true;
    }
    for (int i = 0; i < FILTERS; i++) {
        const Filter *filter = &finish->filters[i];
        if (filter->post) {
            const DipPostWork work = dip_post_run(filter->post, frame->rgba8, frame->stride_bytes,
                                                  filter->rgba8, filter->stride_bytes);
            frame->rgba8 = filter->rgba8;
            frame->stride_bytes = filter->stride_bytes;
            frame->counters.pixels_filtered += work.pixels_filtered;
            frame->counters.edges_found += work.edges_found;
            filtered = true;
        }
    }
    if (filtered) {
        frame->stages.total_ms += 1e-6 * (double)(dip_clock_ns() - begin_ns);
    }
}
