// The plan of a bench. An axis is a property that can vary, such as the picture's size (options.h).
// The plan has the values on each axis, and every combination of these values with its label.
#ifndef DIP_APP_BENCH_PLAN_H
#define DIP_APP_BENCH_PLAN_H

#include "app/bench/options.h"
#include "app/session/session.h"

// From row to row of the printed table, the last axis changes fastest.
typedef enum DipBenchAxis {
    DIP_BENCH_AXIS_GRID,
    DIP_BENCH_AXIS_SIZE,
    DIP_BENCH_AXIS_SCALE,
    DIP_BENCH_AXIS_SET,
    DIP_BENCH_AXIS_ISA,
    DIP_BENCH_AXIS_THREADS,
    DIP_BENCH_AXIS_COUNT
} DipBenchAxis;

// A combination: the index of a value on each axis.
typedef struct DipBenchCombination {
    int at[DIP_BENCH_AXIS_COUNT];
} DipBenchCombination;

typedef struct DipBenchPlan {
    DipBenchOptions options;          // With defaults filled in; the list of grids may be empty.
    int counts[DIP_BENCH_AXIS_COUNT]; // Values per axis, at least 1.
    DipBenchCombination combinations[DIP_BENCH_MAX_COMBINATIONS];
    int count;
    // The combination with which all others are compared: the first value of each list, but the
    // greatest render scale.
    int base;
} DipBenchPlan;

// Makes the plan. For an axis without an option on the command line, the session provides the
// value.
void dip_bench_plan_make(DipBenchPlan *plan, const DipSession *session,
                         const DipBenchOptions *options);

// Returns the combination that differs from this one in the number of threads only and has the
// fewest of all.
int dip_bench_fewest_threads(const DipBenchPlan *plan, int combination);

// Returns the combination with the first instruction set and number of threads and otherwise the
// same values. Its pictures have the same bits.
int dip_bench_same_pictures(const DipBenchPlan *plan, int combination);

// Writes the size at which a combination is drawn, before its render scale enlarges it.
void dip_bench_drawn_size(const DipBenchPlan *plan, const DipBenchCombination *combination,
                          int *width, int *height);

// Writes a combination's value on an axis: "640x480", "2 threads", "aa=4". Writes "" for the axis
// GRID if there are no grids, and for SCALE if its only value is 1.
void dip_bench_value_name(const DipBenchPlan *plan, const DipBenchCombination *combination,
                          DipBenchAxis axis, char *name, size_t size_bytes);

// Writes a combination's values on all axes that vary, except `without` (DIP_BENCH_AXIS_COUNT for
// no exception). If no axis varies, writes the settings.
enum { DIP_BENCH_LABEL_SIZE = 192 };
void dip_bench_label(const DipBenchPlan *plan, const DipBenchCombination *combination,
                     DipBenchAxis without, char label[DIP_BENCH_LABEL_SIZE]);

// Writes the values that do not vary, separated by commas.
void dip_bench_fixed_label(const DipBenchPlan *plan, char label[DIP_BENCH_LABEL_SIZE]);

#endif
