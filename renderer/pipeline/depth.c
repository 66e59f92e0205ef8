// Depths and stencil values that outlive a pass.
#include "renderer/pipeline/depth.h"

#include "renderer/pipeline/merge/depth_planes.h"
#include "renderer/pipeline/target.h"

#include <stdlib.h>
#include <string.h>

DipDepth *dip_depth_create(int width, int height, int sample_count, DipError *err) {
    if (width < 1 || height < 1 || width > DIP_MAX_TARGET_SIZE || height > DIP_MAX_TARGET_SIZE) {
        dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "size", "%dx%d pixels, accepted 1x1 to %dx%d",
                      width, height, DIP_MAX_TARGET_SIZE, DIP_MAX_TARGET_SIZE);
        return NULL;
    }
    if (sample_count < 1 || sample_count > 8 || (sample_count > 1 && sample_count % 2)) {
        dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "sample_count", "%d, accepted 1, 2, 4, 6 or 8",
                      sample_count);
        return NULL;
    }
    DipDepth *depth = calloc(1, sizeof *depth);
    if (depth) {
        const size_t count = (size_t)width * (size_t)height * (size_t)sample_count;
        *depth = (DipDepth){.width = width,
                            .height = height,
                            .sample_count = sample_count,
                            .depth = calloc(count, sizeof *depth->depth),
                            .stencil = calloc(count, sizeof *depth->stencil)};
    }
    if (!depth || !depth->depth || !depth->stencil) {
        dip_depth_destroy(&depth);
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "depth", "no memory for %dx%d pixels", width,
                      height);
    }
    return depth;
}

void dip_depth_destroy(DipDepth **depth) {
    if (*depth) {
        free((*depth)->depth);
        free((*depth)->stencil);
        free(*depth);
        *depth = NULL;
    }
}

bool dip_depth_copy(DipDepth *copy, const DipDepth *depth, DipError *err) {
    if (copy->width != depth->width || copy->height != depth->height ||
        copy->sample_count != depth->sample_count) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "copy",
                             "%dx%d pixels with %d samples, while `depth` has %dx%d with %d",
                             copy->width, copy->height, copy->sample_count, depth->width,
                             depth->height, depth->sample_count);
    }
    const size_t count = dip_depth_row_index(depth, depth->sample_count, 0);
    memmove(copy->depth, depth->depth, count * sizeof *depth->depth);
    memmove(copy->stencil, depth->stencil, count * sizeof *depth->stencil);
    return true;
}

int dip_depth_width(const DipDepth *depth) {
    return depth->width;
}

int dip_depth_height(const DipDepth *depth) {
    return depth->height;
}

int dip_depth_sample_count(const DipDepth *depth) {
    return depth->sample_count;
}

float *dip_depth_row(DipDepth *depth, int sample, int y) {
    return depth->depth + dip_depth_row_index(depth, sample, y);
}

uint8_t *dip_stencil_row(DipDepth *depth, int sample, int y) {
    return depth->stencil + dip_depth_row_index(depth, sample, y);
}
