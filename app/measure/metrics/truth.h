// The truth: the converged picture that the pictures of all settings are compared with. It comes
// with an estimate of its own error and is kept in a cache of files.
//
// A truth is the mean of two pictures, its halves, which are drawn with independent samples. The
// difference of the halves is the truth's noise floor. The truth's own error is about half of this
// difference.
#ifndef DIP_APP_MEASURE_METRICS_TRUTH_H
#define DIP_APP_MEASURE_METRICS_TRUTH_H

#include "app/measure/metrics/metrics.h"
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
    uint8_t *rgba8;      // The same picture, encoded to sRGB and rounded; alpha is 255.
    uint8_t *classes;    // What each pixel shows (DipSeen).
    DipMetricSums floor; // Noise floor: metrics of the first half against the second.
    char key[33];        // Hash of everything that the truth depends on; names its file.
} DipTruth;

struct DipTruthDef;

// Draws one half (0 or 1) of a truth, for scenes that the reference renderer cannot draw. Adds the
// colours to rgb_lin, which is all 0: 3 values per pixel in linear light.
typedef bool DipTruthDraw(const struct DipTruthDef *def, int half, double *rgb_lin, DipError *err);

// Everything that a truth depends on.
typedef struct DipTruthDef {
    struct DipReference
        *reference;         // Borrowed; its time is set to time_ns. Unused if `draw` is set.
    const char *scene_hash; // Borrowed; stands for the scene in the key.
    DipPose pose;
    int64_t time_ns;
    int width;
    int height;
    int samples;              // Samples per pixel of each half; a square number, 1..4096.
    double pixels_per_degree; // For the FLIP of the noise floor.
    DipTruthDraw *draw;       // NULL: the reference renderer draws.
    void *context;            // For `draw`.
} DipTruthDef;

// Receives how much of the picture is done, 0..1. Returns false to stop the work.
typedef bool DipTruthProgress(void *context, double done);

// Reads the truth from the folder `cache`. If the truth is not there, draws it on the pool and
// writes it to the folder. A damaged file counts as missing. If `cache` is NULL, there is no cache;
// if `pool` is NULL, the calling thread draws alone. Fails with DIP_ERROR_RUNTIME if `progress`
// stopped the work, with DIP_ERROR_MEMORY, or with DIP_ERROR_IO if the file cannot be written;
// *truth is then empty. Two calls may run at once if their references are separate. Processes may
// share a cache.
bool dip_truth_get(DipTruth *truth, const DipTruthDef *def, const char *cache, DipPool *pool,
                   DipTruthProgress *progress, void *context, DipError *err);
void dip_truth_free(DipTruth *truth);

// Returns the truth's own error: half of the root mean square difference of its halves, in linear
// light. For the error of several truths, pass the sum of their floors. A picture's error below
// DIP_TRUTH_FLOOR_FACTOR times the returned value cannot be told from the truth's noise.
double dip_truth_floor_rmse(const DipMetricSums *floor, int region);

#define DIP_TRUTH_FLOOR_FACTOR 3.0

// Encodes linear light (3 values per pixel, clamped to 0..1) to 8-bit sRGB with alpha 255.
void dip_truth_encode(const DipSrgbEncodeTable *table, const double *rgb_lin, size_t pixel_count,
                      uint8_t *rgba8);

// Writes the name of the default cache folder: $XDG_CACHE_HOME/diptych, or $HOME/.cache/diptych if
// XDG_CACHE_HOME is not set. Does not create the folder. Returns false if neither variable is set
// or if the name does not fit.
bool dip_truth_default_folder(char *folder, size_t size_bytes);

#ifdef __cplusplus
}
#endif

#endif
