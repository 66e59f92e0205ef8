// The command `diptych cost axes`: measures the rows, prints them and writes the files.
#include "app/cost/axes/axes_drawing.h"
#include "app/cost/command.h"
#include "app/cost/cost.h"
#include "app/cli/interrupt.h"
#include "renderer/base/assert.h"

#include <limits.h>
#include <stdlib.h>
#include <time.h>

static bool measure(DipCostAxes *axes, const DipSession *session,
                    const DipCostAxesArguments *arguments, DipError *err) {
    char cache[PATH_MAX];
    DipCostAxesDrawing drawing;
    DipEnergyMeter meter;
    if (!dip_cost_find_cache(arguments->cost.cache, cache, err) ||
        !dip_cost_axes_open_drawing(&drawing, session, axes, err)) {
        return false;
    }
    dip_energy_open(&meter, arguments->values.powercap);
    const bool done = dip_cost_axes_judge(&drawing, cache[0] ? cache : NULL, err) &&
                      dip_cost_axes_time(&drawing, &meter, err);
    dip_cost_axes_close_drawing(&drawing);
    return done;
}

static void set_date(DipCostReport *report) {
    const time_t now = time(NULL);
    struct tm utc;
    if (gmtime_r(&now, &utc)) {
        strftime(report->date, sizeof report->date, "%Y-%m-%dT%H:%M:%SZ", &utc);
    }
}

static bool judge_machine(const DipCostReport *report, DipError *err) {
    return report->verdict != DIP_COST_RED || !report->options.require_quiet ||
           dip_error_set_runtime(err, DIP_ERROR_RUNTIME, NULL, 0, "--require-quiet",
                                 "the times are wrong. %s", report->verdict_reason);
}

static bool run(DipSession *session, const void *all_arguments, DipError *err) {
    const DipCostAxesArguments *arguments = all_arguments;
    const DipCostAxisValues *values = &arguments->values;
    DipCostAxes *axes = calloc(1, sizeof *axes);
    if (!axes) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost axes", "out of memory");
    }
    dip_interrupt_watch();
    bool done = dip_cost_axes_plan(axes, session, arguments, err);
    done = done && measure(axes, session, arguments, err);
    if (done) {
        set_date(&axes->report);
        dip_cost_axes_print(axes, stdout);
        done = (!values->json || dip_cost_axes_write_json(axes, values->json, err)) &&
               (!values->csv || dip_cost_axes_write_csv(axes, values->csv, err)) &&
               judge_machine(&axes->report, err);
    }
    dip_cost_axes_free(axes);
    free(axes);
    return done;
}

static void describe(const void *arguments, DipSessionDef *def) {
    def->options = &((const DipCostAxesArguments *)arguments)->session;
    def->scene = true;
    def->keep_model = true; // The reference renderer draws the converged pictures from the model.
}

static const DipExample examples[] = {
    {"diptych cost axes", "measures all four in the courtyard"},
    {"diptych cost axes --axes scale --scales 0.5,0.6,0.7,0.8,0.9 --places 8",
     "tells what each render scale saves, and how far its picture is from the converged one"},
    {"diptych cost axes --axes threads,isa --places 0 --settings aa=8,af=16",
     "tells what each thread and each instruction set buys with these settings"},
    {"diptych cost axes --model scene.glb --size 1280x720 --json axes.json --csv axes.csv",
     "measures your own model and writes everything to files"},
};

const DipCommand dip_cost_axes_command = {
    .name = "cost axes",
    .summary = "report what size, scale, threads and instruction set cost",
    .usage = "[OPTION]...",
    .text =
        "Cost axes draws one scene with one set of settings, and varies what no setting varies: "
        "the size of the picture, the render scale (the picture is drawn smaller and enlarged), "
        "the number of threads and the instruction set. Each row is timed beside the base, which "
        "has --size, --threads and --isa, so that ratios hold even if the machine's speed "
        "changes.\n\n"
        "For each row it prints the time of a frame and its ratio to the base, both with 95 % "
        "intervals, the memory that the row's renderer holds, and the energy of a frame if the "
        "machine has counters that can be read. Sizes have the time per pixel, threads the "
        "speed-up, and render scales the times of drawing and of enlarging and their errors "
        "against the converged picture, as `diptych cost` has them for settings.\n\n"
        "All threads and all instruction sets must draw the same bits; if one does not, the "
        "command names it and fails. A run takes a minute or two. docs/bench.md defines every "
        "number.",
    .examples = examples,
    .example_count = DIP_ARRAY_COUNT(examples),
    .lists_settings = true,
    .parts = &dip_cost_axes_option_parts,
    .options_size = sizeof(DipCostAxesArguments),
    .set_defaults = dip_cost_axes_options_default,
    .check = dip_cost_axes_options_check,
    .describe_session = describe,
    .run = run,
};
