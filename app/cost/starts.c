// Requests of the form "draw PATH FRAME STEP STEP ...", with the step of every setting.
#include "app/cost/starts.h"

#include "renderer/base/clock.h"

#include <stdio.h>
#include <stdlib.h>

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

bool dip_cost_start_draw(DipChild *child, const DipCostRow *row, int index, DipCounters *counters,
                         DipTimed *timed, DipError *err) {
    char request[REQUEST_SIZE];
    size_t used = (size_t)snprintf(request, sizeof request, "draw %d %d", row->path, index);
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        used +=
            (size_t)snprintf(request + used, sizeof request - used, " %d", row->quality.step[s]);
    }
    DipBenchSample sample;
    if (!dip_child_draw(child, request, &sample, timed, err)) {
        return false;
    }
    *counters = sample.counters;
    return true;
}

// --- in the start --------------------------------------------------------------------------------

static bool read_number(const char **at, int count, int *number) {
    char *end;
    const long value = strtol(*at, &end, 10);
    const bool good = end != *at && value >= 0 && value < count;
    *number = good ? (int)value : 0;
    *at = end;
    return good;
}

static bool read_request(const DipCostReport *report, const char *request, int *path, int *index,
                         DipQuality *quality) {
    int length = 0;
    if (sscanf(request, "draw %n", &length) < 0 || length == 0) {
        return false;
    }
    const char *at = request + length;
    bool good = read_number(&at, report->path_count, path) &&
                read_number(&at, dip_cost_frame_count(report), index);
    for (int s = 0; good && s < DIP_SETTING_COUNT; s++) {
        int step;
        good = read_number(&at, dip_setting_info((DipSetting)s)->step_count, &step);
        quality->step[s] = (uint8_t)step;
    }
    return good && *at == '\0' && dip_quality_check(quality, NULL);
}

// The time is that of the whole drawing, as in a measurement without starts.
static bool draw(void *context, const char *request, DipBenchSample *sample, DipError *err) {
    DipCostContext *cost = context;
    DipQuality quality = cost->report->options.baseline;
    DipFrame frame;
    int path, index;
    if (!read_request(cost->report, request, &path, &index, &quality)) {
        return dip_error_set_runtime(err, DIP_ERROR_FORMAT, NULL, 0, "--serve",
                                     "'%.60s' is not a request; give draw PATH FRAME STEP STEP ...",
                                     request);
    }
    const int64_t begin_ns = dip_clock_ns();
    if (!dip_cost_draw_settings(cost, &quality, path, index, &frame, err)) {
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
