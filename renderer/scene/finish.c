// Applies the filters of the settings to finished frames.
#include "renderer/scene/finish.h"

#include "renderer/base/clock.h"
#include "renderer/base/pages.h"
#include "renderer/post/post.h"

#include <stdlib.h>

// The filters in the order in which they are applied.
enum { ANTIALIASING, SHARPENING, FILTERS };

typedef struct Filter {
    int step;       // of the setting; 0: off
    DipPost *post;  // NULL if the filter is off
    uint8_t *rgba8; // its picture
} Filter;

struct DipFinish {
    DipPool *pool;
    DipIsa isa;
    int width;
    int height;
    Filter filters[FILTERS];
};

static const DipSetting settings[FILTERS] = {DIP_SETTING_POST, DIP_SETTING_SHARPEN};

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

static void free_filters(DipFinish *finish) {
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

static bool make_filter(DipFinish *finish, int index, int step, DipError *err) {
    // RCAS by stops: a quarter, a half and all of its strength.
    static const float sharpness[] = {0.0f, 0.25f, 0.5f, 1.0f};
    static const DipPostFilter antialiasing[] = {
        [DIP_POST_STEP_FXAA] = DIP_POST_FXAA,
        [DIP_POST_STEP_SMAA] = DIP_POST_SMAA,
    };
    Filter *filter = &finish->filters[index];
    const DipPostDef def = {
        .filter = index == ANTIALIASING ? antialiasing[step] : DIP_POST_SHARPEN,
        .from_width = finish->width,
        .from_height = finish->height,
        .to_width = finish->width,
        .to_height = finish->height,
        .sharpness = index == SHARPENING ? sharpness[step] : 0.0f,
        .isa = finish->isa,
        .pool = finish->pool,
    };
    free_filter(filter);
    filter->post = dip_post_create(&def, err);
    filter->rgba8 = dip_lines_alloc((size_t)finish->width * (size_t)finish->height * 4);
    filter->step = step;
    if (filter->post && !filter->rgba8) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "size", "no memory for %dx%d pixels",
                             finish->width, finish->height);
    }
    return filter->post != NULL;
}

bool dip_finish_follow(DipFinish *finish, const DipQuality *quality, int width, int height,
                       DipError *err) {
    if (width != finish->width || height != finish->height) {
        free_filters(finish);
        finish->width = width;
        finish->height = height;
    }
    for (int i = 0; i < FILTERS; i++) {
        const int step = quality->step[settings[i]];
        if (step == 0) {
            free_filter(&finish->filters[i]);
        } else if (step != finish->filters[i].step && !make_filter(finish, i, step, err)) {
            free_filters(finish);
            return false;
        }
    }
    return true;
}

void dip_finish_frame(DipFinish *finish, DipFrame *frame) {
    const int64_t begin_ns = dip_clock_ns();
    bool filtered = false;
    for (int i = 0; i < FILTERS; i++) {
        const Filter *filter = &finish->filters[i];
        if (filter->post) {
            const size_t stride_bytes = (size_t)finish->width * 4;
            const DipPostWork work = dip_post_run(filter->post, frame->rgba8, frame->stride_bytes,
                                                  filter->rgba8, stride_bytes);
            frame->rgba8 = filter->rgba8;
            frame->stride_bytes = stride_bytes;
            frame->counters.pixels_filtered += work.pixels_filtered;
            frame->counters.edges_found += work.edges_found;
            filtered = true;
        }
    }
    if (filtered) {
        frame->stages.total_ms += 1e-6 * (double)(dip_clock_ns() - begin_ns);
    }
}
