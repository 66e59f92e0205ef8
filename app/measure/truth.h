// The converged picture that settings are judged by, with its noise floor, kept in a cache.
#ifndef DIP_APP_MEASURE_TRUTH_H
#define DIP_APP_MEASURE_TRUTH_H

#include "app/measure/flip.h"
#include "app/measure/sums.h"
#include "renderer/base/pool.h"
#include "renderer/base/srgb.h"

#include <stdbool.h>

typedef struct DipCostTruth {
    int width;
    int height;
    float *rgb_lin;    // the mean of two halves of independent samples
    uint8_t *rgba8;    // the same, encoded and rounded
    uint8_t *classes;  // DipSeen
    DipCostSums floor; // of one half against the other
    char key[33];
} DipCostTruth;

// What a truth is of.
typedef struct DipCostTruthDef {
    DipReference *reference;
    const char *scene_hash;
    DipPose pose;
    int64_t time_ns;
    int width;
    int height;
    int samples; // of each half, per pixel
    double pixels_per_degree;
} DipCostTruthDef;

// Told how much of the picture is done, 0..1; false ends the work.
typedef bool DipCostTruthProgress(void *context, double done);

// From the cache folder if it is there (NULL: none), else made on the pool and put there. Fails
// with RUNTIME when the progress function ended it.
bool dip_cost_truth_get(DipCostTruth *truth, const DipCostTruthDef *def, const char *cache,
                        DipPool *pool, DipCostTruthProgress *progress, void *context,
                        DipError *err);
void dip_cost_truth_free(DipCostTruth *truth);

// Linear light as sRGB codes of 8 bits, clamped and rounded.
void dip_cost_truth_encode(const DipSrgbEncodeTable *table, const double *rgb_lin,
                           size_t pixel_count, uint8_t *rgba8);

// The folder that is used when none is given, made if it is missing; false (and no fault) when
// there is no home for it.
bool dip_cost_cache_folder(char *folder, size_t size_bytes);

#endif
