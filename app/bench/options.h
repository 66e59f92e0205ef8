// What `diptych bench` is asked to measure: a list per axis; every combination is measured.
#ifndef DIP_APP_BENCH_OPTIONS_H
#define DIP_APP_BENCH_OPTIONS_H

#include "renderer/base/isa.h"
#include "renderer/scene/quality.h"

#include <stdbool.h>
#include <stdint.h>

enum {
    DIP_BENCH_MAX_VALUES = 32, // of one axis
    DIP_BENCH_MAX_COMBINATIONS = 512,
    DIP_BENCH_MAX_FRAMES = 10000,
    DIP_BENCH_MAX_ROUNDS = 10000
};

typedef struct DipBenchSet {
    char text[80]; // as it was typed
    DipQuality quality;
} DipBenchSet;

typedef struct DipBenchSize {
    int width; // pixels
    int height;
} DipBenchSize;

// Texts are borrowed from argv. An empty list stands for the one value that the ini or the machine
// gives; of grids for the ini's scene.
typedef struct DipBenchOptions {
    DipBenchSet sets[DIP_BENCH_MAX_VALUES];
    int set_count;
    int threads[DIP_BENCH_MAX_VALUES]; // 0: all processors
    int threads_count;
    DipIsa isas[DIP_BENCH_MAX_VALUES];
    int isa_count;
    DipBenchSize sizes[DIP_BENCH_MAX_VALUES];
    int size_count;
    int grids[DIP_BENCH_MAX_VALUES]; // triangles
    int grid_count;
    bool grid_out_of_view;
    int frames;
    int rounds;
    bool has_seed;
    int seed;
    const char *csv;
    const char *svg;
    const char *vs;
    bool serve;
    int argc; // the whole command line, for the programs that --vs starts
    char *const *argv;
} DipBenchOptions;

#endif
