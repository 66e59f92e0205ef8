// Requests of the form "draw PATH FRAME SETTINGS".
#include "app/cost/starts.h"

#include "renderer/base/clock.h"

#include <stdio.h>

enum { REQUEST_SIZE = 256 };

DipChild *dip_cost_start(const DipCostContext *cost, DipError *err) {
    const DipChildDef def = {
        .program = "/proc/self/exe",
        .argv = cost->start->argv,
        .argc = cost->start->argc,
        .what = "cost",
        .count = cost->report->path_count,
        .frames = dip_cost_frame_count(cost->report),
        .key = "--starts",
    };
    return dip_child_start(&def, err);
}

bool dip_cost_start_draw(DipChild *child, const DipQuality *quality, int path, int index,
                         DipCounters *counters, DipTimed *timed, DipError *err) {
    char settings[REQUEST_SIZE / 2], request[REQUEST_SIZE];
    DipBenchSample sample;
    dip_quality_format(quality, settings, sizeof settings);
    snprintf(request, sizeof request, "draw %d %d %s", path, index, settings);
    if (!dip_child_draw(child, request, &sample, timed, err)) {
        return false;
    }
    *counters = sample.counters;
    return true;
}

// The time is that of the whole drawing, as in a measurement without starts.
static bool draw(void *context, const char *request, DipBenchSample *sample, DipError *err) {
    DipCostContext *cost = context;
    char settings[REQUEST_SIZE];
    DipQuality quality;
    DipFrame frame;
    int path, index;
    if (sscanf(request, "draw %d %d %255s", &path, &index, settings) != 3 || path < 0 ||
        path >= cost->report->path_count || index < 0 ||
        index >= dip_cost_frame_count(cost->report) ||
        !dip_quality_parse(settings, &quality, NULL)) {
        return dip_error_set_runtime(err, DIP_ERROR_FORMAT, NULL, 0, "--serve",
                                     "'%.60s' is not a request; give draw PATH FRAME SETTINGS",
                                     request);
    }
    const int64_t begin_ns = dip_clock_ns();
    if (!dip_cost_draw_timed(cost, &quality, path, index, &frame, err)) {
        return false;
    }
    const int64_t ns = dip_clock_ns() - begin_ns;
    dip_bench_sample_set(sample, &frame, false);
    sample->ms[DIP_BENCH_STAGE_total] = 1e-6 * (double)ns;
    return true;
}

bool dip_cost_serve(DipCostContext *cost, DipError *err) {
    return dip_child_serve("cost", cost->report->path_count, dip_cost_frame_count(cost->report),
                           draw, cost, err);
}
