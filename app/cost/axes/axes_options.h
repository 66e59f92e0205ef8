// Options of `diptych cost axes`.
#ifndef DIP_APP_COST_AXES_AXES_OPTIONS_H
#define DIP_APP_COST_AXES_AXES_OPTIONS_H

#include "app/cli/measure_options.h"
#include "app/cost/options.h"

enum { DIP_COST_AXIS_MAX_VALUES = 16 };

// What a row changes. X(name, NAME, "title")
#define DIP_COST_AXIS_LIST(X)                                                                      \
    X(size, SIZE, "size of the picture")                                                           \
    X(scale, SCALE, "render scale")                                                                \
    X(threads, THREADS, "threads")                                                                 \
    X(isa, ISA, "instruction set")

typedef enum DipCostAxis {
#define DIP_COST_AXIS_ENUM(name, NAME, title) DIP_COST_AXIS_##NAME,
    DIP_COST_AXIS_LIST(DIP_COST_AXIS_ENUM)
#undef DIP_COST_AXIS_ENUM
        DIP_COST_AXIS_COUNT,
    DIP_COST_AXIS_BASE = DIP_COST_AXIS_COUNT // Of the base and the A/A row: nothing.
} DipCostAxis;

extern const char *const dip_cost_axis_names[DIP_COST_AXIS_COUNT + 1];  // "size", ..., "base"
extern const char *const dip_cost_axis_titles[DIP_COST_AXIS_COUNT + 1]; // "size of the picture"

// The values of each axis. An empty list stands for the default values.
typedef struct DipCostAxisValues {
    unsigned axes; // Bit a: the axis a is measured.
    bool has_axes;
    DipOptionSize sizes[DIP_COST_AXIS_MAX_VALUES];
    int size_count;
    double scales[DIP_COST_AXIS_MAX_VALUES]; // 0.1..1.
    int scale_count;
    int threads[DIP_COST_AXIS_MAX_VALUES]; // 1 to the number of processors.
    int threads_count;
    DipIsa isas[DIP_COST_AXIS_MAX_VALUES];
    int isa_count;
    const char *powercap; // Folder of the energy counters.
    const char *json;     // Files to write, or NULL.
    const char *csv;
} DipCostAxisValues;

// The whole command line. Of `cost`, these fields are used: baseline (--settings), places, samples,
// pixels_per_degree, timed_frames, require_quiet and cache.
typedef struct DipCostAxesArguments {
    DipProgramOptions program;
    DipSessionOptions session;
    DipCostAxisValues values;
    DipMeasureOptions measure;
    DipCostOptions cost;
} DipCostAxesArguments;

extern const DipOptionParts dip_cost_axes_option_parts;

void dip_cost_axes_options_default(void *arguments, int argc, char *const *argv);
bool dip_cost_axes_options_check(const void *arguments, DipError *err);

#endif
