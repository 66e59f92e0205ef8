// Measures the errors of both panes' pictures against the converged picture of their pose.
//
// The converged picture, the truth, is refined in levels of rising sample counts; each level gives
// a better result. The work is cut into small steps, so that the caller can drop it between any
// two.
#ifndef DIP_APP_PREVIEW_ERROR_JOB_H
#define DIP_APP_PREVIEW_ERROR_JOB_H

#include "app/session.h"
#include "renderer/reference/reference.h"

#include <stdbool.h>
#include <stdint.h>

enum { DIP_ERROR_JOB_LEVELS = 3 };

// Samples per pixel of each level. A level is made of two halves with as many samples each; their
// difference tells the truth's own noise. The last level is the default of `diptych cost`.
extern const int dip_error_job_samples[DIP_ERROR_JOB_LEVELS];

// The panes' pictures of one pose, time and size.
typedef struct DipStill {
    DipPose pose;
    int64_t time_ns;
    int width;
    int height;
    size_t stride_bytes;
    const uint8_t *rgba8[DIP_PANE_COUNT]; // Requested NULL: the same picture as current.
} DipStill;

// Returns whether two stills have the same truth.
bool dip_still_has_same_truth(const DipStill *a, const DipStill *b);

// One pane's errors, as docs/cost.md defines them.
typedef struct DipPaneError {
    double rmse_lin;
    double psnr_db;
    double flip;
    bool at_floor; // The error is too small to be told from the truth's own noise.
} DipPaneError;

typedef struct DipErrorJobResult {
    int samples; // Of the truth, per pixel, both halves together. 0: there is no result yet.
    bool last;   // No further level refines the truth.
    DipPaneError panes[DIP_PANE_COUNT];
} DipErrorJobResult;

typedef struct DipErrorJob DipErrorJob;

// The reference is borrowed. The job sets it to the time of each still.
DipErrorJob *dip_error_job_create(DipReference *reference, DipError *err);
void dip_error_job_destroy(DipErrorJob **job);

// Measures a still from now on. Its pictures are borrowed until the next still begins. The truth
// made so far is kept if the still has the same. On failure there is nothing to measure.
bool dip_error_job_begin(DipErrorJob *job, const DipStill *still, DipError *err);

typedef enum DipErrorJobStep {
    DIP_ERROR_JOB_WORKING,
    DIP_ERROR_JOB_NEW_RESULT,
    DIP_ERROR_JOB_DONE, // There is nothing left to do.
    DIP_ERROR_JOB_FAILED
} DipErrorJobStep;

// Does a few milliseconds of work.
DipErrorJobStep dip_error_job_step(DipErrorJob *job, DipError *err);

const DipErrorJobResult *dip_error_job_result(const DipErrorJob *job);

#endif
