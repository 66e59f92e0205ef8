// Measures the errors of both panes' pictures against the converged picture from the same pose.
//
// The converged picture (the truth, app/measure/metrics/truth.h) is the mean of two halves that are
// drawn independently. It is refined in levels, each with more samples per pixel than the level
// before and with a better result. The work is cut into small steps, so that the caller can stop
// between any two steps.
#ifndef DIP_APP_PREVIEW_LIVE_ERROR_JOB_H
#define DIP_APP_PREVIEW_LIVE_ERROR_JOB_H

#include "app/measure/metrics/truth.h"
#include "app/session/session.h"
#include "renderer/reference/reference.h"

#include <stdbool.h>
#include <stdint.h>

// A still: both panes' pictures of one pose, time and size.
typedef struct DipStill {
    DipPose pose;
    int64_t time_ns;
    int width;
    int height;
    size_t stride_bytes;
    double pixels_per_degree; // Viewing distance for FLIP, a perceptual error.
    // If both panes show the same picture, the requested pane's pointer is NULL.
    const uint8_t *rgba8[DIP_PANE_COUNT];
    // True if a pane has no error, because it shows mip colours instead of the scene's colours.
    bool unjudged[DIP_PANE_COUNT];
} DipStill;

// Returns whether two stills are compared with the same truth.
bool dip_still_has_same_truth(const DipStill *a, const DipStill *b);

// One pane's errors, as docs/cost-methods.md defines them.
typedef struct DipPaneError {
    double rmse_lin;
    double psnr_db;
    double flip;
    bool at_floor; // The error is too small to be told from the truth's own noise.
    bool unjudged; // The pane has no error (DipStill), and the other members are 0.
} DipPaneError;

typedef struct DipErrorJobResult {
    int samples; // Samples per pixel of the truth's two halves together; 0 if there is no result.
    bool last;   // True if no further level will refine the truth.
    // The truth's own noise: half of the root mean square difference of its halves in linear light.
    double floor_rmse;
    DipPaneError panes[DIP_PANE_COUNT];
} DipErrorJobResult;

typedef struct DipErrorJob DipErrorJob;

// Creates a job, which borrows all arguments and sets the reference renderer's time to the time of
// each still. Through the folder `cache`, the job shares the last level of each truth with `diptych
// cost`. The cache identifies the scene by `scene_hash`, which dip_cost_scene_hash
// (app/cost/plan.h) computes. If `cache` is NULL, there is no cache.
DipErrorJob *dip_error_job_create(DipReference *reference, const char *scene_hash,
                                  const char *cache, DipError *err);
void dip_error_job_destroy(DipErrorJob **job);

// Begins to measure a still, and drops the previous still. The new still's pictures are borrowed
// until the next call of this function. If both stills have the same truth, the job keeps what it
// has drawn of the truth. After a failure the job has no still.
bool dip_error_job_begin(DipErrorJob *job, const DipStill *still, DipError *err);

// Does a few milliseconds of work. Returns RESULT when there is a new result, DONE when nothing is
// left to do, and FAILED with *err after an error.
DipStep dip_error_job_step(DipErrorJob *job, DipError *err);

const DipErrorJobResult *dip_error_job_result(const DipErrorJob *job);

// Returns how much of the truth that is being drawn is done, from 0 to 1. Sets *next_samples to the
// samples per pixel, both halves together, of the truth that the next step works on, or to 0 if the
// next step draws no truth.
double dip_error_job_drawn(const DipErrorJob *job, int *next_samples);

// The next two functions return the pictures from which the result was measured. The pictures are
// complete between the step that returned RESULT and the next step; later steps overwrite them.
// Rows are packed.

// Returns the FLIP value of each pixel of a pane, or NULL if the pane is not judged.
const float *dip_error_job_flip(const DipErrorJob *job, int pane);

// Returns the truth in 8-bit sRGB, four bytes per pixel.
const uint8_t *dip_error_job_truth(const DipErrorJob *job);

#endif
