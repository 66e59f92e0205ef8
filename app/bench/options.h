// Options of `diptych bench`. An axis is a property that can vary: settings, threads, instruction
// set, size, grid. Each axis has a list of values, and the bench measures every combination of
// them.
#ifndef DIP_APP_BENCH_OPTIONS_H
#define DIP_APP_BENCH_OPTIONS_H

#include "app/cli/command.h"
#include "app/cli/measure_options.h"
#include "app/session/session_options.h"
#include "renderer/base/isa.h"
#include "renderer/scene/quality.h"

#include <stdbool.h>
#include <stdint.h>

enum {
    DIP_BENCH_MAX_VALUES = 32, // Values of one axis.
    DIP_BENCH_MAX_COMBINATIONS = 512,
    DIP_BENCH_MAX_FRAMES = 10000
};

typedef struct DipBenchSet {
    char text[80]; // The settings as they were typed.
    DipQuality quality;
} DipBenchSet;

typedef struct DipBenchSize {
    int width; // Pixels.
    int height;
} DipBenchSize;

// What to measure. Texts are borrowed from argv. An empty list stands for one value, which comes
// from the ini or the machine. Without grids, the bench draws the scene.
typedef struct DipBenchOptions {
    DipBenchSet sets[DIP_BENCH_MAX_VALUES];
    int set_count;
    int threads[DIP_BENCH_MAX_VALUES]; // 0: all processors.
    int threads_count;
    DipIsa isas[DIP_BENCH_MAX_VALUES];
    int isa_count;
    DipBenchSize sizes[DIP_BENCH_MAX_VALUES];
    int size_count;
    int grids[DIP_BENCH_MAX_VALUES]; // Numbers of triangles.
    int grid_count;
    bool grid_out_of_view;
    int frames;
    DipMeasureOptions measure; // Its seed is filled in by the plan.
    const char *csv;
    const char *svg;
    const char *vs;
    bool serve;
    int argc; // The whole command line. With --vs, the started programs get it, too.
    char *const *argv;
} DipBenchOptions;

// The whole command line of `diptych bench`.
typedef struct DipBenchArguments {
    DipProgramOptions program;
    DipSessionOptions session;
    DipBenchOptions bench;
} DipBenchArguments;

extern const DipOptionParts dip_bench_option_parts;

void dip_bench_options_default(void *arguments, int argc, char *const *argv);
bool dip_bench_options_check(const void *arguments, DipError *err);

#endif
