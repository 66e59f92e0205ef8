// Draws truths and keeps them in a cache of files. A truth is the converged picture with which the
// pictures of all settings are compared, and an estimate of its own error.
//
// A truth is the mean of two pictures, its halves, which are drawn with independent samples. The
// difference of the halves is called the truth's noise floor, or floor. The truth's own error is
// about half of this difference.
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
    char key[33];        // Hash of everything that the truth depends on; part of its file's name.
} DipTruth;

struct DipTruthDef;

// A function of the caller that draws one half (0 or 1) of a truth, for scenes that the reference
// renderer cannot draw. It adds the colours to rgb_lin, 3 values per pixel in linear light, which
// are all 0 before. It runs in the caller's floating-point mode (renderer/base/fp_mode.h).
typedef bool DipTruthDraw(const struct DipTruthDef *def, int half, double *rgb_lin, DipError *err);

// Everything that a truth depends on.
typedef struct DipTruthDef {
    struct DipReference
        *reference;         // Borrowed; its time is set to time_ns. Unused if `draw` is set.
    const char *scene_hash; // Hash of the scene, which goes into the key. Borrowed.
    DipPose pose;
    int64_t time_ns;
    int width;
    int height;
    int samples;              // Samples per pixel of each half; a square number, 1..4096.
    double pixels_per_degree; // Resolution for the FLIP of the noise floor (flip.h).
    DipTruthDraw *draw;       // If NULL, the reference renderer draws.
    void *context;            // For `draw` to use.
} DipTruthDef;

// If a user waits for a truth, it is drawn in levels: first with few samples, then with more. The
// last level has DIP_TRUTH_SAMPLES samples per pixel of a half, unless the user asks for another
// number.
enum { DIP_TRUTH_SAMPLES = 64, DIP_TRUTH_LEVELS = 3 };
extern DIP_API const int dip_truth_level_samples[DIP_TRUTH_LEVELS]; // Samples per pixel of a half.

// A truth that is drawn in steps.
typedef struct DipTruthJob DipTruthJob;

// Begins a truth. The job reads the truth from a file in the folder `cache`. If there is no such
// file or if it is damaged, the job draws the truth and writes the file. If `cache` is NULL, there
// is no cache. Reference, scene hash and folder are borrowed. Processes may share a folder. Two
// jobs may run at once if each has a reference renderer of its own.
//
// A live job is one that a user waits for. It draws the coarser levels first, and one tile per
// step, which takes a few milliseconds. It does not write the truth if the folder already holds
// more than 1 GiB of truths, and it does not fail if the truth cannot be written. Other jobs draw
// the last level only, and many tiles per step on the pool; if `pool` is NULL, the calling thread
// draws alone. If the def has a function `draw`, a step draws a whole half instead of tiles.
//
// Fails with RANGE (a size outside 1..DIP_MAX_FRAME_SIZE, samples or pixels_per_degree) or MEMORY.
DIP_API DipTruthJob *dip_truth_job_create(const DipTruthDef *def, const char *cache, DipPool *pool,
                                          bool live, DipError *err);
// *job may be NULL and becomes NULL.
DIP_API void dip_truth_job_destroy(DipTruthJob **job);

// Takes a step. Returns RESULT when the truth of a level is complete, and DONE when the truth of
// the last level is complete and stored. Fails with MEMORY, with the error of the def's function
// `draw` or of dip_convergence_create, with IO if the file cannot be written, or with OVERSIZED if
// its name is too long. After a failure, the job can only be destroyed.
DIP_API DipStep dip_truth_job_step(DipTruthJob *job, DipError *err);

// Returns the truth of the last complete level. Returns NULL if there is none, or while its memory
// is being overwritten by the next one. Only the truth of the last level has a floor with all
// metrics and regions; the floors of coarser levels have only the squared differences of the whole
// picture. The truth is valid until the next step.
DIP_API const DipTruth *dip_truth_job_truth(const DipTruthJob *job);

// Returns how much of the next level is drawn, from 0 to 1. Writes to *samples the level's samples
// per pixel, both halves together, or 0 if no level follows.
DIP_API double dip_truth_job_drawn(const DipTruthJob *job, int *samples);

// A function of the caller that receives which share of the picture is drawn, 0..1. It returns
// false to stop the work.
typedef bool DipTruthProgress(void *context, double done);

// Gets a truth from the cache, or draws it, with a job that is not live. Fails as
// dip_truth_job_create and dip_truth_job_step do, and with RUNTIME if `progress` stopped the work;
// *truth is then empty. `progress` may be NULL. The caller frees the truth.
DIP_API bool dip_truth_get(DipTruth *truth, const DipTruthDef *def, const char *cache,
                           DipPool *pool, DipTruthProgress *progress, void *context, DipError *err);
DIP_API void dip_truth_free(DipTruth *truth);

// Returns the truth as the standard of a meter (meter.h), without an analysis. The truth is
// borrowed.
DIP_API DipMeterStandard dip_truth_standard(const DipTruth *truth);

// Returns the truth's own error: half of the root mean square difference of its halves, in linear
// light. For the joint error of several truths, pass the sum of their floors.
DIP_API double dip_truth_floor_rmse(const DipMetricSums *floor, int region);

// Returns whether the error of pictures is below three times the error of their truths. Such an
// error is called "at floor": it cannot be told from the truths' noise. `floor` is the sum of the
// truths' floors, and `sums` is the sum of the pictures' metric sums.
DIP_API bool dip_truth_hides(const DipMetricSums *floor, const DipMetricSums *sums);

// Writes the name of the default cache folder: $XDG_CACHE_HOME/diptych, or $HOME/.cache/diptych if
// XDG_CACHE_HOME is not set or not an absolute path. Does not create the folder. Returns false if
// neither variable gives a folder or if the name does not fit.
DIP_API bool dip_truth_default_folder(char *folder, size_t size_bytes);

#ifdef __cplusplus
}
#endif

#endif
