// Draws frames for the pictures of the page, and keeps those of a part.
#include "app/cost/drawn_frames.h"

#include "app/files/folder.h"
#include "app/cli/progress.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool go_on(void *context, double done) {
    (void)context;
    (void)done;
    return true;
}

static size_t frame_bytes(const DipCostReport *report) {
    return (size_t)report->width * (size_t)report->height * 4;
}

// Writes the packed pixels of the truth.
static bool get_truth(DipCostContext *cost, int path, int viewpoint, uint8_t *rgba8,
                      DipError *err) {
    DipTruth truth;
    if (!dip_cost_context_truth(cost, path, viewpoint, 0, go_on, NULL, &truth, err)) {
        return false;
    }
    memcpy(rgba8, truth.rgba8, frame_bytes(cost->report));
    dip_truth_free(&truth);
    return true;
}

// Draws a row at a viewpoint and writes the packed pixels.
static bool draw_row(DipCostContext *cost, int row, int viewpoint, uint8_t *rgba8, DipError *err) {
    const DipCostReport *report = cost->report;
    const size_t row_bytes = (size_t)report->width * 4;
    const int64_t time_ns =
        dip_cost_viewpoint_time_ns(report, cost->session, report->rows[row].path, viewpoint, 0);
    DipFrame frame;
    if (!dip_cost_draw(cost, row, time_ns, 0, &frame, err)) {
        return false;
    }
    for (int y = 0; y < report->height; y++) {
        memcpy(rgba8 + (size_t)y * row_bytes, frame.rgba8 + (size_t)y * frame.stride_bytes,
               row_bytes);
    }
    return true;
}

// --- the source of a page ------------------------------------------------------------------------

static void choose_middle(void *context, DipCostPictureSet *set) {
    const DipCostContext *cost = context;
    const DipCostOptions *options = &cost->report->options;
    set->viewpoint = (options->first_place + options->end_place - 1) / 2;
}

static bool read_drawn(void *context, const DipCostPictureSet *set, int row, uint8_t *rgba8,
                       DipError *err) {
    DipCostContext *cost = context;
    if (dip_cost_interrupted(cost, err)) {
        return false;
    }
    return row < 0 ? get_truth(cost, set->path, set->viewpoint, rgba8, err)
                   : draw_row(cost, row, set->viewpoint, rgba8, err);
}

DipCostFrameSource dip_cost_drawn_frames(DipCostContext *cost) {
    return (DipCostFrameSource){cost, choose_middle, read_drawn};
}

// --- keeping -------------------------------------------------------------------------------------

static int clamp(int value, int least, int most) {
    return value < least ? least : value > most ? most : value;
}

typedef struct Keeper {
    DipCostContext *cost;
    const char *folder;
    uint8_t *rgba8; // Pixels of the frame that is kept next. Owned.
    DipProgress progress;
} Keeper;

// Writes the frame's file from the keeper's pixels and lists the frame.
static bool keep(Keeper *k, DipCostKeptFrame frame, DipError *err) {
    DipCostReport *report = k->cost->report;
    DipCostKeptFrames *kept = &report->kept;
    if (!dip_cost_kept_frame_write(&frame, k->folder, k->rgba8, report->width, report->height,
                                   err)) {
        return false;
    }
    kept->list[kept->count++] = frame;
    dip_progress_show(&k->progress, kept->count);
    return !dip_cost_interrupted(k->cost, err);
}

static bool keep_all(Keeper *k, DipError *err) {
    const DipCostReport *report = k->cost->report;
    const int viewpoint = report->kept.viewpoint;
    bool kept = true;
    for (int path = 0; kept && path < report->path_count; path++) {
        kept = get_truth(k->cost, path, viewpoint, k->rgba8, err) &&
               keep(k, (DipCostKeptFrame){.path = path, .is_truth = true}, err);
    }
    for (int row = 0; kept && row < report->row_count; row++) {
        const DipCostRow *drawn = &report->rows[row];
        kept = draw_row(k->cost, row, viewpoint, k->rgba8, err) &&
               keep(k, (DipCostKeptFrame){.path = drawn->path, .quality = drawn->quality}, err);
    }
    return kept;
}

bool dip_cost_keep_frames(DipCostContext *cost, const char *folder, DipError *err) {
    DipCostReport *report = cost->report;
    const DipCostOptions *options = &report->options;
    const int count = report->path_count + report->row_count;
    char frames[PATH_MAX];
    if (options->end_place - options->first_place == options->places ||
        options->pictures == DIP_COST_PICTURES_NONE) {
        return true;
    }
    if (snprintf(frames, sizeof frames, "%s/frames", folder) >= (int)sizeof frames) {
        return dip_error_set_runtime(err, DIP_ERROR_OVERSIZED, folder, 0, "--out",
                                     "the name is too long");
    }
    if (!dip_folder_make(frames, "--out", err)) {
        return false;
    }
    Keeper k = {.cost = cost, .folder = folder, .rgba8 = malloc(frame_bytes(report))};
    dip_cost_kept_frames_free(&report->kept);
    report->kept.list = calloc((size_t)count, sizeof *report->kept.list);
    report->kept.viewpoint =
        clamp((options->places - 1) / 2, options->first_place, options->end_place - 1);
    bool kept = (k.rgba8 && report->kept.list) ||
                dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
    if (kept) {
        k.progress = dip_progress_begin("frames kept for cost merge", count);
        kept = keep_all(&k, err);
        dip_progress_end(&k.progress, report->kept.count);
    }
    free(k.rgba8);
    return kept;
}
