// Counts FLIP values in a histogram, computes percentiles from it, and searches for the worst
// block.
#include "app/measure/metrics/flip_tail.h"

#include "renderer/base/fp_mode.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum { BINS = 65536 };

bool dip_flip_tail_init(DipFlipTailMeter *meter) {
    *meter = (DipFlipTailMeter){.histogram = calloc(BINS, sizeof *meter->histogram)};
    return meter->histogram != NULL;
}

void dip_flip_tail_free(DipFlipTailMeter *meter) {
    free(meter->histogram);
    *meter = (DipFlipTailMeter){.histogram = NULL};
}

void dip_flip_tail_restart(DipFlipTailMeter *meter) {
    memset(meter->histogram, 0, BINS * sizeof *meter->histogram);
    meter->frames = 0;
    meter->worst = (DipFlipTail){.worst = 0.0};
}

// --- the worst block -----------------------------------------------------------------------------

static double mean_of_block(const float *map, int width, int x, int y, int block_width,
                            int block_height) {
    double sum = 0.0;
    for (int row = y; row < y + block_height; row++) {
        const float *values = map + (size_t)row * (size_t)width + x;
        for (int i = 0; i < block_width; i++) {
            sum += values[i];
        }
    }
    return sum / (block_width * block_height);
}

// Returns the first pixel of block `index` along an axis. `block` is the block's side, and `size`
// is the picture's.
static int start_of_block(int index, int block, int size) {
    const int start = index * block;
    return start + block <= size ? start : size - block;
}

static void find_worst(DipFlipTailMeter *meter, const float *map, int width, int height) {
    const int block_width = width < DIP_FLIP_TAIL_BLOCK ? width : DIP_FLIP_TAIL_BLOCK;
    const int block_height = height < DIP_FLIP_TAIL_BLOCK ? height : DIP_FLIP_TAIL_BLOCK;
    for (int row = 0; row * block_height < height; row++) {
        const int y = start_of_block(row, block_height, height);
        for (int column = 0; column * block_width < width; column++) {
            const int x = start_of_block(column, block_width, width);
            const double mean = mean_of_block(map, width, x, y, block_width, block_height);
            if (meter->worst.worst_width == 0.0 || mean > meter->worst.worst) {
                meter->worst = (DipFlipTail){.worst = mean,
                                             .worst_frame = meter->frames,
                                             .worst_x = x,
                                             .worst_y = y,
                                             .worst_width = block_width,
                                             .worst_height = block_height};
            }
        }
    }
}

// --- percentiles ---------------------------------------------------------------------------------

void dip_flip_tail_add(DipFlipTailMeter *meter, const float *map, int width, int height) {
    DIP_FP_MODE_SCOPE();
    const size_t count = (size_t)width * (size_t)height;
    for (size_t i = 0; i < count; i++) {
        const int bin = (int)(map[i] * (float)BINS);
        meter->histogram[bin < 0 ? 0 : bin < BINS ? bin : BINS - 1]++;
    }
    find_worst(meter, map, width, height);
    meter->frames++;
}

// Returns the middle of the first bin such that this bin and the bins below it hold at least
// `share` of the `total` values. Returns 0 for the lowest bin, since most of its values are 0.
static double percentile(const DipFlipTailMeter *meter, double total, double share) {
    double below = 0.0;
    for (int bin = 0; bin < BINS; bin++) {
        below += meter->histogram[bin];
        if (below >= share * total) {
            return bin == 0 ? 0.0 : (bin + 0.5) / BINS;
        }
    }
    return 1.0;
}

DipFlipTail dip_flip_tail_result(const DipFlipTailMeter *meter) {
    DIP_FP_MODE_SCOPE();
    double total = 0.0;
    for (int bin = 0; bin < BINS; bin++) {
        total += meter->histogram[bin];
    }
    DipFlipTail tail = meter->worst;
    tail.p50 = percentile(meter, total, 0.50);
    tail.p95 = percentile(meter, total, 0.95);
    tail.p99 = percentile(meter, total, 0.99);
    DIP_FP_PIN_STRUCT(tail);
    return tail;
}
