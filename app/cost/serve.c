// Draws frames for the process that started this one (--starts).
#include "app/cost/steps.h"

#include "app/measure/timing/child.h"
#include "renderer/base/clock.h"

#include <stdio.h>

// What a request asks for. The function draw_in_child of times.c sends the requests.
typedef struct Request {
    DipQuality quality;
    int path;
    int frame;
} Request;

static bool read_request(const DipCostContext *cost, const char *text, Request *request,
                         DipError *err) {
    const DipCostReport *report = cost->report;
    char settings[DIP_SETTINGS_BYTES];
    return (sscanf(text, "draw %d %d %255s", &request->path, &request->frame, settings) == 3 &&
            request->path >= 0 && request->path < report->path_count && request->frame >= 0 &&
            request->frame < dip_cost_frame_count(report) &&
            dip_quality_parse(settings, &request->quality, NULL)) ||
           dip_error_set_runtime(err, DIP_ERROR_FORMAT, NULL, 0, "--serve",
                                 "'%.60s' is not a request; give draw PATH FRAME SETTINGS", text);
}

static bool serve_prepare(void *context, const char *text, DipError *err) {
    DipCostContext *cost = context;
    Request request;
    return read_request(cost, text, &request, err) &&
           dip_cost_prepare_timed(cost, &request.quality, request.path, request.frame, err);
}

// Draws the frame that a request names. Measures the time of the whole call that draws, as is done
// when the program draws in its own process (--starts 1).
static bool serve_draw(void *context, const char *text, DipBenchSample *sample, DipError *err) {
    DipCostContext *cost = context;
    DipFrame frame;
    Request request;
    if (!read_request(cost, text, &request, err)) {
        return false;
    }
    const int64_t begin_ns = dip_clock_ns();
    if (!dip_cost_draw_timed(cost, &request.quality, request.path, request.frame, &frame, err)) {
        return false;
    }
    const int64_t ns = dip_clock_ns() - begin_ns;
    dip_bench_sample_set(sample, &frame, false);
    sample->ms[DIP_BENCH_STAGE_total] = 1e-6 * (double)ns;
    return true;
}

bool dip_cost_serve(DipCostContext *cost, DipError *err) {
    return dip_child_serve("cost", cost->report->path_count, dip_cost_frame_count(cost->report),
                           serve_prepare, serve_draw, cost, err);
}
