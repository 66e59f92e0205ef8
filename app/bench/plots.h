// Writes the bench's results as plots.
#ifndef DIP_APP_BENCH_PLOTS_H
#define DIP_APP_BENCH_PLOTS_H

#include "app/bench/measure.h"

// Writes the plots time_pixels.svg, time_scale.svg, time_samples.svg, time_triangles.svg and
// time_threads.svg to a folder that exists. Leaves out a plot whose lines would have one point
// each, for example time_samples.svg if all sets have the same aa. Prints the names of the written
// plots to standard error.
bool dip_bench_write_plots(const char *folder, const DipBenchResult *result, DipError *err);

#endif
