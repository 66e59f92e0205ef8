// The panes' pictures held against the truth of their pose, which gets better by levels of rising
// sample counts. The work is done in small steps, so that it can be dropped between any two.
#ifndef DIP_APP_PREVIEW_JUDGE_H
#define DIP_APP_PREVIEW_JUDGE_H

#include "app/session.h"
#include "renderer/reference/reference.h"

#include <stdbool.h>
#include <stdint.h>

enum { DIP_JUDGE_LEVELS = 3 };

// Samples per pixel of each of a level's two halves; the last is `diptych cost`'s default.
extern const int dip_judge_samples[DIP_JUDGE_LEVELS];

// What is judged: pictures of one pose, time and size.
typedef struct DipJudgeShot {
    DipPose pose;
    int64_t time_ns;
    int width;
    int height;
    size_t stride_bytes;
    const uint8_t *rgba8[DIP_PANE_COUNT]; // requested NULL: the same as current
} DipJudgeShot;

// Whether two shots have the same truth.
bool dip_judge_same_truth(const DipJudgeShot *a, const DipJudgeShot *b);

typedef struct DipPaneError {
    double rmse_lin; // figures as docs/cost.md defines them
    double psnr_db;
    double flip;
    bool at_floor;
} DipPaneError;

typedef struct DipJudgeResult {
    int samples; // per pixel, of both halves; 0: nothing is known yet
    bool last;   // the truth gets no better
    DipPaneError panes[DIP_PANE_COUNT];
} DipJudgeResult;

typedef struct DipJudge DipJudge;

// The reference is borrowed, and set to the time of each shot.
DipJudge *dip_judge_create(DipReference *reference, DipError *err);
void dip_judge_destroy(DipJudge **judge);

// Judges a shot from now on; its pictures are borrowed until the next one begins. A truth of the
// same pose is kept. On failure nothing is judged.
bool dip_judge_begin(DipJudge *judge, const DipJudgeShot *shot, DipError *err);

typedef enum DipJudgeStep {
    DIP_JUDGE_WORKING,
    DIP_JUDGE_NEWS, // the result is a new one
    DIP_JUDGE_IDLE, // there is nothing left to do
    DIP_JUDGE_FAILED
} DipJudgeStep;

// A few milliseconds of work.
DipJudgeStep dip_judge_step(DipJudge *judge, DipError *err);

const DipJudgeResult *dip_judge_result(const DipJudge *judge);

#endif
