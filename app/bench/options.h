// Declares the options of `diptych bench`. An axis is a property that can vary: settings, threads,
// instruction set, size, render scale, grid. Each axis has a list of values. The bench measures
// every combination of the axes' values.
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
    DIP_BENCH_MAX_VALUES = 32, // Greatest number of values of one axis.
    DIP_BENCH_MAX_COMBINATIONS = 512,
    DIP_BENCH_MAX_FRAMES = 10000,
    // Bounds the time of dip_times_fit, which grows with the cube of the number of rounds.
    DIP_BENCH_MAX_ROUNDS = 1000
};

// The axes. From row to row of the printed table, the last axis changes fastest.
typedef enum DipBenchAxis {
    DIP_BENCH_AXIS_GRID,
    DIP_BENCH_AXIS_SIZE,
    DIP_BENCH_AXIS_SCALE,
    DIP_BENCH_AXIS_SET,
    DIP_BENCH_AXIS_ISA,
    DIP_BENCH_AXIS_THREADS,
    DIP_BENCH_AXIS_COUNT
} DipBenchAxis;

// What to measure. Pointers to texts are borrowed from argv. A grid is a test scene of about a
// given number of triangles; without grids, the bench draws the session's scene. An empty list of
// scales stands for the scale 1. An empty list of threads, instruction sets or sizes stands for one
// value, which comes from the ini or the machine.
typedef struct DipBenchOptions {
    int counts[DIP_BENCH_AXIS_COUNT]; // Numbers of values on the axes, in the lists that follow.
    DipOptionSet sets[DIP_BENCH_MAX_VALUES];
    int threads[DIP_BENCH_MAX_VALUES]; // 0 stands for all processors.
    DipIsa isas[DIP_BENCH_MAX_VALUES];
    DipOptionSize sizes[DIP_BENCH_MAX_VALUES];
    double scales[DIP_BENCH_MAX_VALUES]; // 0.1..1.
    int grids[DIP_BENCH_MAX_VALUES];     // Numbers of triangles.
    bool grid_out_of_view;
    int frames;
    DipMeasureOptions measure; // If no seed is given, the plan (plan.h) chooses one.
    const char *csv;
    const char *svg;
    const char *vs;
    bool serve; // True if another process has started this one to draw frames for it.
} DipBenchOptions;

// The whole command line of `diptych bench`.
typedef struct DipBenchArguments {
    DipProgramOptions program;
    DipSessionOptions session;
    DipBenchOptions bench;
} DipBenchArguments;

extern const DipCommand dip_bench_command; // Defined in bench.c.
extern const DipOptionParts dip_bench_option_parts;

void dip_bench_options_default(void *arguments);
bool dip_bench_options_check(const void *arguments, DipError *err);

#endif
