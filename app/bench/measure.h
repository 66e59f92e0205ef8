// Measures every combination of a plan (plan.h) in interleaved rounds
// (app/measure/timing/driver.h). Each round draws every frame of every combination. A round divides
// the combinations into groups of at most four (of one if there are two programs). Each group also
// draws the base with which its combinations are compared. The results are the times of every frame
// in every round, and the work of every frame.
#ifndef DIP_APP_BENCH_MEASURE_H
#define DIP_APP_BENCH_MEASURE_H

#include "app/bench/plan.h"
#include "app/measure/timing/sample.h"

// The results of one program. The bench measures one program, or two with --vs. A result owns its
// arrays and borrows the plan.
typedef struct DipBenchResult {
    const DipBenchPlan *plan;
    double *ms;            // times, [combination][stage][round][frame]
    double *scratch;       // room for the times of one combination in one stage
    DipBenchSample *first; // samples of the warm-up, [combination][frame]
    // [combination]: the ratio of the combination's mean time to that of the plan's base. If there
    // are two programs, the second program's ratios are to the mean times of the same combinations
    // in the first program, and the first program's ratios are 1.
    DipEstimate *ratios;
    // [combination]: the speed-up of the combination over the same combination with the fewest
    // threads. Filled in only if there is one program.
    DipEstimate *speed_ups;
} DipBenchResult;

bool dip_bench_result_init(DipBenchResult *result, const DipBenchPlan *plan, DipError *err);
void dip_bench_result_free(DipBenchResult *result);

// Stores the times that a combination took for the frame timed->frame in the round timed->round.
void dip_bench_result_add(DipBenchResult *result, int combination, const DipTimed *timed);

// Returns the times of a combination in a stage, in milliseconds: rounds * frames values,
// [round * frames + frame].
const double *dip_bench_result_ms(const DipBenchResult *result, int combination,
                                  DipBenchStage stage);

// Returns a quantile of the times of a combination in a stage. `share` is 0 for the least time, 0.5
// for the median and 1 for the greatest time.
double dip_bench_result_quantile(const DipBenchResult *result, int combination, DipBenchStage stage,
                                 double share);

// Returns the mean over the frames of the stage's shortest time in any round. The shortest time has
// the least noise, because noise only ever adds time.
double dip_bench_result_fastest_ms(const DipBenchResult *result, int combination,
                                   DipBenchStage stage);

// Returns the sample of a frame's first drawing, which has the hash and the counters.
DipBenchSample *dip_bench_result_first(const DipBenchResult *result, int combination, int frame);

// Writes the means of a combination's work counters over the frames.
void dip_bench_result_work(const DipBenchResult *result, int combination,
                           double means[DIP_COUNTER_COUNT]);

// A program that is measured: this process or a child process. draw() draws a frame of a
// combination and stores its times and counters in *sample. If `hash` is true, draw() also stores
// the hash of the picture.
typedef struct DipBenchSource {
    bool (*draw)(void *context, int combination, int frame, bool hash, DipBenchSample *sample,
                 DipError *err);
    void *context;
} DipBenchSource;

// Fills one result for each source. There are 1 or 2 sources. The results must be initialised
// before the call.
//
// With one source, every combination is timed beside the plan's base. With two sources, each
// combination of the second is timed beside the same combination of the first. Ratios and speed-ups
// come from these pairs (app/measure/stats/rounds.h).
//
// Before any time is taken, the warm-up draws each frame of each combination once. The samples of
// the warm-up, with hashes and counters, become the results' `first` samples. Two sources take
// turns after every frame, and a pause of one millisecond before each of their timed frames lets
// the other source's threads go to sleep. Progress goes to standard error.
//
// Fails if draw() fails, with DIP_ERROR_MEMORY, and with DIP_ERROR_RUNTIME if the user presses
// Ctrl-C or if the first source's pictures differ between instruction sets or numbers of threads.
bool dip_bench_measure(const DipBenchPlan *plan, const DipBenchSource *sources, int source_count,
                       DipBenchResult *results, DipError *err);

#endif
