// Shows how far the time of a frame is above the least time that the machine allows. Prints the
// cycles that the stages geometry, raster and shading take per unit of their work, and these cycles
// divided by a floor: the fewest cycles in which a core can do this work.
#ifndef DIP_APP_BENCH_GAP_H
#define DIP_APP_BENCH_GAP_H

#include "app/bench/measure.h"

#include <stdio.h>

// The floors, in cycles of one core per unit. The first two are computed. Triangle set-up writes
// 192 bytes for a triangle (a DipTriangle of 96 bytes and planes of 96 bytes), and a core can write
// 32 bytes in a cycle. Rasterising a triangle in a tile reads 96 bytes, and a core can read 64
// bytes in a cycle. The other floors were measured with loops that were written by hand for the
// same work, on an Intel Xeon with AVX-512 and with all data in the first-level cache
// (docs/performance.md, Kernels). The floor of a sub-block is 16 times the floor of a pixel with 1,
// 2, 4 or 8 samples. The floor of a fragment is the time of one trilinear texture read. Probes are
// counted only in the finer mip level of a read, so the floor of a probe is a sixteenth of the time
// of a texture read with 16 probes in each of two mip levels.
#define DIP_BENCH_FLOOR_TRIANGLE      6.0
#define DIP_BENCH_FLOOR_TILE_TRIANGLE 1.5
#define DIP_BENCH_FLOOR_SUB_BLOCK_1   (16 * 0.6)
#define DIP_BENCH_FLOOR_SUB_BLOCK_2   (16 * 1.0)
#define DIP_BENCH_FLOOR_SUB_BLOCK_4   (16 * 1.7)
#define DIP_BENCH_FLOOR_SUB_BLOCK_8   (16 * 3.8)
#define DIP_BENCH_FLOOR_FRAGMENT      8.4
#define DIP_BENCH_FLOOR_PROBE         (106.0 / 16)

// Prints for each combination the cycles per triangle, tile triangle, sub-block, fragment and
// probe, and these cycles divided by the floor. The cycles of a stage are those of all threads: the
// stage's time in a frame, multiplied by the number of threads and divided by the length of a
// cycle. The stage's time is the mean over the frames of the stage's shortest time in any round.
void dip_bench_print_gap(const DipBenchResult *result, double ns_per_cycle, FILE *out);

#endif
