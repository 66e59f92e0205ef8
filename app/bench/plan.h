// Makes the plan of a bench. An axis is a property that can vary, such as the picture's size
// (options.h). The plan has the values on each axis and all combinations of these values.
#ifndef DIP_APP_BENCH_PLAN_H
#define DIP_APP_BENCH_PLAN_H

#include "app/bench/options.h"
#include "app/session/session.h"

typedef struct DipBenchPlan {
    // The options of the command line, with values for what it leaves open, so that no list is
    // empty. If there are no grids, the list of grids has the one value 0, which stands for the
    // session's scene. Numbers of threads are at least 1.
    DipBenchOptions options;
    // [combination][axis]: the index of the combination's value on the axis.
    int at[DIP_BENCH_MAX_COMBINATIONS][DIP_BENCH_AXIS_COUNT];
    int count; // Number of combinations.
    // The combination with which all others are compared, unless --vs is given. It has the first
    // value of each list, but the greatest render scale.
    int base;
} DipBenchPlan;

// Makes the plan. The session provides the number of threads, the instruction set and the size
// if the command line does not give them. The default render scale is 1.
void dip_bench_plan_make(DipBenchPlan *plan, const DipSession *session,
                         const DipBenchOptions *options);

// Returns the combination with the fewest threads and otherwise the values of `combination`.
int dip_bench_fewest_threads(const DipBenchPlan *plan, int combination);

// Returns the combination with the first instruction set and number of threads and otherwise the
// values of `combination`. The pictures of both combinations are the same to the bit.
int dip_bench_same_pictures(const DipBenchPlan *plan, int combination);

// The values of a combination.
typedef struct DipBenchValues {
    int triangles; // Number of triangles given to --grid; 0 for the session's scene.
    DipOptionSize size;
    double scale;
    DipOptionSize drawn; // The size at which the picture is drawn, before it is enlarged to `size`.
    const DipOptionSet *set;
    DipIsa isa;
    int threads;
} DipBenchValues;

// Writes the size at which a picture of width x height pixels is drawn if the render scale is
// `scale`, at most 1. This is the nearest size with exactly the same aspect ratio, so that
// enlarging does not stretch the picture. If its width is more than 2 % away from scale * width,
// the size is scale * width and scale * height, rounded.
void dip_bench_drawn_size(int width, int height, double scale, int *to_width, int *to_height);

DipBenchValues dip_bench_values(const DipBenchPlan *plan, int combination);

// Writes a combination's value on an axis: "640x480", "2 threads", "aa=4". Writes "" for the axis
// GRID if there are no grids, and for SCALE if its only value is 1.
void dip_bench_value_name(const DipBenchPlan *plan, int combination, DipBenchAxis axis, char *name,
                          size_t size_bytes);

// Writes a combination's values on all axes that vary (that have several values), except `without`
// (DIP_BENCH_AXIS_COUNT for no exception). If this leaves no value, writes the settings.
enum { DIP_BENCH_LABEL_SIZE = 192 };
void dip_bench_label(const DipBenchPlan *plan, int combination, DipBenchAxis without,
                     char label[DIP_BENCH_LABEL_SIZE]);

// Writes the values on the axes that do not vary, separated by commas.
void dip_bench_fixed_label(const DipBenchPlan *plan, char label[DIP_BENCH_LABEL_SIZE]);

#endif
