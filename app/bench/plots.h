// The bench's figures as plots.
#ifndef DIP_APP_BENCH_PLOTS_H
#define DIP_APP_BENCH_PLOTS_H

#include "app/bench/result.h"

// Writes time_pixels.svg, time_samples.svg, time_triangles.svg, time_threads.svg to a folder that
// exists, as far as the axis has more than one value; says on standard error which.
bool dip_bench_write_plots(const char *folder, const DipBenchResult *result, DipError *err);

#endif
