// What is measured: the axes' values, and every combination of them with its label.
#ifndef DIP_APP_BENCH_PLAN_H
#define DIP_APP_BENCH_PLAN_H

#include "app/session.h"

// X(NAME, name): in the order of the table, the last changes fastest.
#define DIP_BENCH_AXIS_LIST(X)                                                                     \
    X(GRID, grid)                                                                                  \
    X(SIZE, size)                                                                                  \
    X(SET, set)                                                                                    \
    X(ISA, isa)                                                                                    \
    X(THREADS, threads)

typedef enum DipBenchAxis {
#define DIP_BENCH_AXIS_ENUM(NAME, name) DIP_BENCH_AXIS_##NAME,
    DIP_BENCH_AXIS_LIST(DIP_BENCH_AXIS_ENUM)
#undef DIP_BENCH_AXIS_ENUM
        DIP_BENCH_AXIS_COUNT
} DipBenchAxis;

// A combination: for each axis the index of its value.
typedef struct DipBenchCombination {
    int at[DIP_BENCH_AXIS_COUNT];
} DipBenchCombination;

typedef struct DipBenchPlan {
    DipBenchOptions options;          // with the defaults filled in; grids may be empty
    int counts[DIP_BENCH_AXIS_COUNT]; // values per axis, at least 1
    DipBenchCombination combinations[DIP_BENCH_MAX_COMBINATIONS];
    int count;
} DipBenchPlan;

// Fills in from the session what the options leave open.
void dip_bench_plan_make(DipBenchPlan *plan, const DipSession *session,
                         const DipBenchOptions *options);

// The value of an axis as text: "640x480", "2 threads", "aa=4", ...; empty for the ini's scene.
void dip_bench_value_name(const DipBenchPlan *plan, const DipBenchCombination *combination,
                          DipBenchAxis axis, char *name, size_t size_bytes);

// The values of those axes that vary (or of the settings, if none does) but `without` (or
// DIP_BENCH_AXIS_COUNT), side by side.
enum { DIP_BENCH_LABEL_SIZE = 192 };
void dip_bench_label(const DipBenchPlan *plan, const DipBenchCombination *combination,
                     DipBenchAxis without, char label[DIP_BENCH_LABEL_SIZE]);

// The values that do not vary, with commas between.
void dip_bench_fixed_label(const DipBenchPlan *plan, char label[DIP_BENCH_LABEL_SIZE]);

#endif
