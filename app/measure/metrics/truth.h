// Draws truths. A truth is the converged picture with which the pictures of all settings are
// compared. It comes with an estimate of its own error and is kept in a cache of files.
//
// A truth is the mean of two pictures, its halves, which are drawn with independent samples. The
// difference of the halves is the truth's noise floor. The truth's own error is about half of this
// difference.
#ifndef DIP_APP_MEASURE_METRICS_TRUTH_H
#define DIP_APP_MEASURE_METRICS_TRUTH_H

#include "renderer/base/api.h"
#include "app/measure/metrics/meter.h"
#include "renderer/base/error.h"
#include "renderer/base/pool.h"
#include "renderer/scene/pose.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct DipReference; // renderer/reference/reference.h

// Pictures have width * height pixels, the top row first, rows packed. A truth owns its arrays,
// which lie in one block of memory.
typedef struct DipTruth {
    int width;
    int height;
    int samples;         // Samples per pixel of both halves together.
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

// A truth that a user waits for is refined in levels: coarser truths come before it. The last level
// has DIP_TRUTH_SAMPLES samples per pixel of a half, unless the user asks for another number.
enum { DIP_TRUTH_SAMPLES = 64, DIP_TRUTH_LEVELS = 3 };
extern DIP_API const int dip_truth_level_samples[DIP_TRUTH_LEVELS]; // Samples per pixel of a half.

// A truth that is drawn in steps.
typedef struct DipTruthJob DipTruthJob;

// Begins a truth. It is read from the folder `cache` if it is there (a damaged file counts as
// missing), and otherwise drawn and written to the folder. If `cache` is NULL, there is no cache.
// Reference, scene hash and folder are borrowed. Processes may share a folder. Two jobs may run at
// once if their references are separate.
//
// A live job is one that a user waits for: it draws coarser truths first, a tile per step, which
// takes a few milliseconds. It goes on if the truth cannot be written, and does not write it if the
// folder is full (holds truths of more than 1 GiB). Other jobs draw many tiles per step on the
// pool; if `pool` is NULL, the calling thread draws alone.
DIP_API DipTruthJob *dip_truth_job_create(const DipTruthDef *def, const char *cache, DipPool *pool,
                                          bool live, DipError *err);
DIP_API void dip_truth_job_destroy(DipTruthJob **job);

// Returns RESULT when a truth is complete, and DONE after the last one, which is then in the cache.
// Fails with MEMORY, with what the def's function fails with, or with IO if the file cannot be
// written.
DIP_API DipStep dip_truth_job_step(DipTruthJob *job, DipError *err);

// Returns the finest complete truth. Returns NULL if there is none, or if the last step has begun
// to put the next one together. Only the truth of the last level has a floor of all metrics and
// regions; the floors of the others have only the squared differences of the whole picture. The
// truth is valid until the next step.
DIP_API const DipTruth *dip_truth_job_truth(const DipTruthJob *job);

// Returns how much of the next truth is drawn, from 0 to 1. *samples: its samples per pixel, both
// halves together; 0 if no other follows.
DIP_API double dip_truth_job_drawn(const DipTruthJob *job, int *samples);

// Receives how much of the picture is done, 0..1. Returns false to stop the work.
typedef bool DipTruthProgress(void *context, double done);

// Runs a job that is not live to its end. Fails as its steps do, and with RUNTIME if `progress`
// stopped the work; *truth is then empty. progress may be NULL.
DIP_API bool dip_truth_get(DipTruth *truth, const DipTruthDef *def, const char *cache,
                           DipPool *pool, DipTruthProgress *progress, void *context, DipError *err);
DIP_API void dip_truth_free(DipTruth *truth);

// Returns the truth as a standard for a meter, without an analysis.
DIP_API DipMeterStandard dip_truth_standard(const DipTruth *truth);

// Returns the truth's own error: half of the root mean square difference of its halves, in linear
// light. For the error of several truths, pass the sum of their floors.
DIP_API double dip_truth_floor_rmse(const DipMetricSums *floor, int region);

// Returns whether the error of pictures is below three times the error of their truths. Such an
// error is "at floor": it cannot be told from the truths' noise. floor: the sum of the truths'
// floors. sums: those of the pictures.
DIP_API bool dip_truth_hides(const DipMetricSums *floor, const DipMetricSums *sums);

// Writes the name of the default cache folder: $XDG_CACHE_HOME/diptych, or $HOME/.cache/diptych if
// XDG_CACHE_HOME is not set. Does not create the folder. Returns false if neither variable is set
// or if the name does not fit.
DIP_API bool dip_truth_default_folder(char *folder, size_t size_bytes);

#ifdef __cplusplus
}
#endif

#endif
