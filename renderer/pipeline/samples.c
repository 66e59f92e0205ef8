// Colours of samples that outlive a pass: making, freeing and reading them.
#include "renderer/pipeline/samples.h"

#include "renderer/pipeline/merge/sample_blocks.h"

#include <stdlib.h>

static bool check_description(int width, int height, int sample_count, DipFormat format,
                              DipError *err) {
    if (width < 1 || height < 1 || width > DIP_MAX_TARGET_SIZE || height > DIP_MAX_TARGET_SIZE) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "size",
                             "%dx%d pixels, accepted 1x1 to %dx%d", width, height,
                             DIP_MAX_TARGET_SIZE, DIP_MAX_TARGET_SIZE);
    }
    if (sample_count < 1 || sample_count > DIP_MAX_SAMPLES ||
        (sample_count > 1 && sample_count % 2)) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "sample_count",
                             "%d, accepted 1, 2, 4, 6 or 8", sample_count);
    }
    return ((int)format >= 0 && format < DIP_FORMAT_COUNT) ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "format", "%d, accepted 0..%d", (int)format,
                         DIP_FORMAT_COUNT - 1);
}

DipSamples *dip_samples_create(int width, int height, int sample_count, DipFormat format,
                               DipError *err) {
    if (!check_description(width, height, sample_count, format, err)) {
        return NULL;
    }
    DipSamples *samples = calloc(1, sizeof *samples);
    if (samples) {
        const int blocks_x = (width + DIP_BLOCK - 1) / DIP_BLOCK;
        const int blocks_y = (height + DIP_BLOCK - 1) / DIP_BLOCK;
        const size_t blocks = (size_t)blocks_x * (size_t)blocks_y;
        const size_t floats = (size_t)DIP_SAMPLE_CHANNELS * (size_t)sample_count * DIP_BLOCK_PIXELS;
        *samples = (DipSamples){.width = width,
                                .height = height,
                                .sample_count = sample_count,
                                .format = format,
                                .blocks_x = blocks_x,
                                .light = calloc(blocks, floats * sizeof *samples->light),
                                .split = calloc(blocks, sizeof *samples->split)};
    }
    if (!samples || !samples->light || !samples->split) {
        dip_samples_destroy(&samples);
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "samples",
                      "no memory for %dx%d pixels of %d samples", width, height, sample_count);
    }
    return samples;
}

void dip_samples_destroy(DipSamples **samples) {
    if (*samples) {
        free((*samples)->light);
        free((*samples)->split);
        free(*samples);
        *samples = NULL;
    }
}

int dip_samples_width(const DipSamples *samples) {
    return samples->width;
}

int dip_samples_height(const DipSamples *samples) {
    return samples->height;
}

int dip_samples_sample_count(const DipSamples *samples) {
    return samples->sample_count;
}

DipFormat dip_samples_format(const DipSamples *samples) {
    return samples->format;
}

void dip_samples_read_row(const DipSamples *samples, int sample, int y, float *const colour[4]) {
    for (int x = 0; x < samples->width; x++) {
        const size_t block = dip_samples_block(samples, x, y);
        const int pixel = dip_block_pixel(x % DIP_BLOCK, y % DIP_BLOCK);
        const bool split = samples->split[block] >> pixel / DIP_SUB_BLOCK_PIXELS & 1;
        for (int c = 0; c < DIP_SAMPLE_CHANNELS; c++) {
            const size_t first = dip_samples_index(samples, block, c, split ? sample : 0);
            colour[c][x] = samples->light[first + (size_t)pixel];
        }
    }
}
