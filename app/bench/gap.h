// Shows how far a frame is from what the machine can do. Prints the cycles that the stages
// geometry, raster and shading take per unit of their work, and these cycles divided by a floor:
// the fewest cycles in which a core can do this work.
#ifndef DIP_APP_BENCH_GAP_H
#define DIP_APP_BENCH_GAP_H

#include "app/bench/measure.h"

#include <stdio.h>

// The floors, in cycles of one core per unit. The first two are computed. Set-up writes 192 bytes
// for a triangle (a DipTriangle of 96 bytes and planes of 96 bytes) and can write 32 bytes in a
// cycle. A tile reads 96 bytes for a triangle and can read 64 bytes in a cycle. The others were
// measured with loops that were written by hand for the same work, on an Intel Xeon with AVX-512
// and with all data in the first-level cache (docs/performance.md, Kernels). A sub-block's floor is
// 16 times that of a pixel, for 1, 2, 4 and 8 samples. A fragment's floor is a trilinear read. A
// probe's floor is the sixteenth part of a read with 16 probes in each of two levels.
#define DIP_BENCH_FLOOR_TRIANGLE      6.0
#define DIP_BENCH_FLOOR_TILE_TRIANGLE 1.5
#define DIP_BENCH_FLOOR_SUB_BLOCK_1   (16 * 0.6)
#define DIP_BENCH_FLOOR_SUB_BLOCK_2   (16 * 1.0)
#define DIP_BENCH_FLOOR_SUB_BLOCK_4   (16 * 1.7)
#define DIP_BENCH_FLOOR_SUB_BLOCK_8   (16 * 3.8)
#define DIP_BENCH_FLOOR_FRAGMENT      8.4
#define DIP_BENCH_FLOOR_PROBE         (106.0 / 16)

// Prints for each combination the cycles per triangle, tile triangle, sub-block, fragment and
// probe, and how many times the floor they are. A stage's cycles are those of all threads: its time
// in a frame, multiplied by the number of threads and divided by the length of a cycle. The time is
// the mean over the frames of the stage's shortest time in any round.
void dip_bench_print_gap(const DipBenchResult *result, double ns_per_cycle, FILE *out);

#endif
