// The truth: the converged picture that settings are judged by, with an estimate of its own error,
// kept in a cache of files.
//
// A truth is the mean of two halves, converged pictures of independent samples. The difference of
// the halves is its noise floor: the truth's own error is about half of that difference.
#ifndef DIP_APP_MEASURE_TRUTH_H
#define DIP_APP_MEASURE_TRUTH_H

#include "app/measure/metrics.h"
#include "renderer/base/error.h"
#include "renderer/base/pool.h"
#include "renderer/base/srgb.h"
#include "renderer/scene/pose.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct DipReference; // renderer/reference/reference.h

// Pictures have width * height pixels, the top row first, rows packed. Owns its arrays.
typedef struct DipTruth {
    int width;
    int height;
    float *rgb_lin;      // Mean of the halves in linear light, 3 values per pixel.
    uint8_t *rgba8;      // The same, encoded to sRGB and rounded; alpha is 255.
    uint8_t *classes;    // What each pixel shows (DipSeen).
    DipMetricSums floor; // The first half judged against the second.
    char key[33];        // Hash of everything that the truth depends on; its name in the cache.
} DipTruth;

// Everything that a truth depends on.
typedef struct DipTruthDef {
    struct DipReference *reference; // Borrowed; its time is set to time_ns.
    const char *scene_hash;         // Borrowed; stands for the scene in the key.
    DipPose pose;
    int64_t time_ns;
    int width;
    int height;
    int samples;              // Samples per pixel of each half; a square, 1..4096.
    double pixels_per_degree; // For the FLIP of the floor.
} DipTruthDef;

// Receives how much of the picture is done, 0..1. Returns false to stop the work.
typedef bool DipTruthProgress(void *context, double done);

// Reads the truth from the folder `cache`, or makes it on the pool and writes it there. `cache`
// NULL means no cache, `pool` NULL no threads. Fails with DIP_ERROR_RUNTIME when `progress` stopped
// the work, DIP_ERROR_MEMORY, or DIP_ERROR_IO if the file cannot be written; then *truth is empty.
// A file that is damaged counts as missing. Two calls may run at once with separate references;
// processes may share a cache.
bool dip_truth_get(DipTruth *truth, const DipTruthDef *def, const char *cache, DipPool *pool,
                   DipTruthProgress *progress, void *context, DipError *err);
void dip_truth_free(DipTruth *truth);

// The truth's own error: root mean square in linear light, half of the halves' difference. Pass
// the floors of several truths added together for the error of all of them. An error below
// DIP_TRUTH_FLOOR_FACTOR times this value cannot be told from the truth's noise.
double dip_truth_floor_rmse(const DipMetricSums *floor, int region);

#define DIP_TRUTH_FLOOR_FACTOR 3.0

// Encodes linear light (3 values per pixel, clamped to 0..1) to 8-bit sRGB with alpha 255.
void dip_truth_encode(const DipSrgbEncodeTable *table, const double *rgb_lin, size_t pixel_count,
                      uint8_t *rgba8);

// Writes the name of the cache folder to use when the user names none: $XDG_CACHE_HOME/diptych,
// else $HOME/.cache/diptych. It is not created. Returns false if neither variable is set or the
// name does not fit.
bool dip_truth_default_folder(char *folder, size_t size_bytes);

#ifdef __cplusplus
}
#endif

#endif
