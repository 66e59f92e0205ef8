// Draws the frames that the pictures of the page are cut from.
#include "app/cost/drawn_frames.h"

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
    return (DipCostFrameSource){cost, read_drawn};
}
