// The bench's results as plots.
#ifndef DIP_APP_BENCH_PLOTS_H
#define DIP_APP_BENCH_PLOTS_H

#include "app/bench/result.h"

// Writes time_pixels.svg, time_samples.svg, time_triangles.svg and time_threads.svg to a folder
// that exists, each only if its axis has more than one value. Names every file on standard error.
bool dip_bench_write_plots(const char *folder, const DipBenchResult *result, DipError *err);

#endif
