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

typedef struct DipBenchSet {
    char text[80]; // The settings as text: as the user typed them, or one of the default sets.
    DipQuality quality;
} DipBenchSet;

// What to measure. Pointers to texts are borrowed from argv. A grid is a test scene of about a
// given number of triangles; without grids, the bench draws the session's scene. An empty list of
// scales stands for the scale 1. An empty list of threads, instruction sets or sizes stands for one
// value, which comes from the ini or the machine.
typedef struct DipBenchOptions {
    DipBenchSet sets[DIP_BENCH_MAX_VALUES];
    int set_count;
    int threads[DIP_BENCH_MAX_VALUES]; // 0 stands for all processors.
    int threads_count;
    DipIsa isas[DIP_BENCH_MAX_VALUES];
    int isa_count;
    DipOptionSize sizes[DIP_BENCH_MAX_VALUES];
    int size_count;
    double scales[DIP_BENCH_MAX_VALUES]; // 0.1..1.
    int scale_count;
    int grids[DIP_BENCH_MAX_VALUES]; // Numbers of triangles.
    int grid_count;
    bool grid_out_of_view;
    int frames;
    DipMeasureOptions measure; // If no seed is given, the plan (plan.h) chooses one.
    const char *csv;
    const char *svg;
    const char *vs;
    DipServeOptions serve;
} DipBenchOptions;

// The whole command line of `diptych bench`.
typedef struct DipBenchArguments {
    DipProgramOptions program;
    DipSessionOptions session;
    DipBenchOptions bench;
} DipBenchArguments;

extern const DipCommand dip_bench_command; // Defined in bench.c.
extern const DipOptionParts dip_bench_option_parts;

void dip_bench_options_default(void *arguments, int argc, char *const *argv);
bool dip_bench_options_check(const void *arguments, DipError *err);

#endif
