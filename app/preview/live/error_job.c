// Draws the truth (the converged picture) in steps, and judges both panes' pictures at each of its
// levels.
#include "app/preview/live/error_job.h"

#include <stdlib.h>
#include <string.h>

struct DipErrorJob {
    DipReference *reference;
    const char *scene_hash;
    const char *cache;
    DipStill still;
    DipTruthJob *truth; // NULL: there is no still.
    DipMeter meters[DIP_PANE_COUNT];
    bool has_meters;
    double meters_pixels_per_degree;
    bool judges; // A pane's picture is not judged by the newest truth yet.
    int pane;    // The pane that is judged next, or now if has_begun.
    bool has_begun;
    DipErrorJobResult result;
};

bool dip_still_has_same_truth(const DipStill *a, const DipStill *b) {
    return memcmp(&a->pose, &b->pose, sizeof a->pose) == 0 && a->time_ns == b->time_ns &&
           a->width == b->width && a->height == b->height &&
           a->pixels_per_degree == b->pixels_per_degree;
}

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "truth", "out of memory");
}

DipErrorJob *dip_error_job_create(DipReference *reference, const char *scene_hash,
                                  const char *cache, DipError *err) {
    DipErrorJob *job = calloc(1, sizeof *job);
    if (!job) {
        out_of_memory(err);
        return NULL;
    }
    job->reference = reference;
    job->scene_hash = scene_hash;
    job->cache = cache;
    return job;
}

static void free_meters(DipErrorJob *job) {
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        dip_meter_free(&job->meters[p]);
    }
    job->has_meters = false;
}

void dip_error_job_destroy(DipErrorJob **job) {
    if (!*job) {
        return;
    }
    dip_truth_job_destroy(&(*job)->truth);
    free_meters(*job);
    free(*job);
    *job = NULL;
}

static bool make_meters(DipErrorJob *job, DipError *err) {
    const DipStill *still = &job->still;
    const DipMeter *old = &job->meters[0];
    if (job->has_meters && old->width == still->width && old->height == still->height &&
        job->meters_pixels_per_degree == still->pixels_per_degree) {
        return true;
    }
    free_meters(job);
    job->has_meters = true;
    job->meters_pixels_per_degree = still->pixels_per_degree;
    for (int p = 0; job->has_meters && p < DIP_PANE_COUNT; p++) {
        job->has_meters = dip_meter_init(&job->meters[p], DIP_METER_FLIP, still->width,
                                         still->height, still->pixels_per_degree);
    }
    if (!job->has_meters) {
        free_meters(job);
        return out_of_memory(err);
    }
    return true;
}

static bool begin_truth(DipErrorJob *job, DipError *err) {
    const DipStill *still = &job->still;
    const DipTruthDef def = {
        .reference = job->reference,
        .scene_hash = job->scene_hash,
        .pose = still->pose,
        .time_ns = still->time_ns,
        .width = still->width,
        .height = still->height,
        .samples = DIP_TRUTH_SAMPLES,
        .pixels_per_degree = still->pixels_per_degree,
    };
    if (make_meters(job, err)) {
        job->truth = dip_truth_job_create(&def, job->cache, NULL, true, err);
    }
    return job->truth != NULL;
}

static void judge_again(DipErrorJob *job) {
    job->judges = true;
    job->has_begun = false;
    job->pane = 0;
}

bool dip_error_job_begin(DipErrorJob *job, const DipStill *still, DipError *err) {
    const bool same = job->truth && dip_still_has_same_truth(&job->still, still);
    job->still = *still;
    job->result = (DipErrorJobResult){0};
    judge_again(job);
    if (same) {
        return true;
    }
    dip_truth_job_destroy(&job->truth);
    return begin_truth(job, err);
}

// --- the errors --------------------------------------------------------------------------------

// Returns the pane whose picture a pane shows.
static int shown_pane(const DipErrorJob *job, int pane) {
    return job->still.rgba8[pane] ? pane : DIP_PANE_CURRENT;
}

static void publish(DipErrorJob *job, const DipTruth *truth) {
    job->judges = false;
    job->result.samples = truth->samples;
    job->result.last = truth->samples == 2 * DIP_TRUTH_SAMPLES;
    job->result.floor_rmse = dip_truth_floor_rmse(&truth->floor, 0);
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        job->result.panes[p] = (DipPaneError){.unjudged = job->still.unjudged[p]};
        if (job->still.unjudged[p]) {
            continue;
        }
        const DipMetricSums sums = dip_meter_sums(&job->meters[shown_pane(job, p)]);
        const DipMetrics metrics = dip_metrics_of(&sums, 0);
        job->result.panes[p].rmse_lin = metrics.rmse_lin;
        job->result.panes[p].psnr_db = metrics.psnr_db;
        job->result.panes[p].flip = metrics.flip;
        job->result.panes[p].at_floor = dip_truth_hides(&truth->floor, &sums);
    }
}

static void begin_pane(DipErrorJob *job, const DipTruth *truth) {
    const DipSrgbPicture test = {job->still.rgba8[job->pane], job->still.stride_bytes,
                                 job->still.width, job->still.height};
    const DipMeterStandard standard = dip_truth_standard(truth);
    dip_meter_begin(&job->meters[job->pane], &test, NULL, &standard);
    job->has_begun = true;
}

// Judges the next part of a pane's picture. After the last pane, or if no pane is judged, publishes
// the truth and the errors.
static DipStep judge(DipErrorJob *job, const DipTruth *truth, DipError *err) {
    while (job->pane < DIP_PANE_COUNT &&
           (!job->still.rgba8[job->pane] || job->still.unjudged[job->pane])) {
        job->pane++;
    }
    if (job->pane == DIP_PANE_COUNT) {
        publish(job, truth);
        return DIP_STEP_RESULT;
    }
    if (!job->has_begun) {
        begin_pane(job, truth);
    }
    const DipStep step = dip_meter_step(&job->meters[job->pane]);
    if (step == DIP_STEP_FAILED) {
        out_of_memory(err);
        return step;
    }
    if (step == DIP_STEP_DONE) {
        job->pane++;
        job->has_begun = false;
    }
    return DIP_STEP_WORKING;
}

DipStep dip_error_job_step(DipErrorJob *job, DipError *err) {
    if (!job->truth) {
        return DIP_STEP_DONE;
    }
    const DipTruth *truth = dip_truth_job_truth(job->truth);
    if (truth && job->judges) {
        return judge(job, truth, err);
    }
    const DipStep step = dip_truth_job_step(job->truth, err);
    if (step == DIP_STEP_RESULT) {
        judge_again(job);
        return DIP_STEP_WORKING;
    }
    return step;
}

const DipErrorJobResult *dip_error_job_result(const DipErrorJob *job) {
    return &job->result;
}

const float *dip_error_job_flip(const DipErrorJob *job, int pane) {
    return job->still.unjudged[pane] ? NULL : job->meters[shown_pane(job, pane)].flip_map;
}

const uint8_t *dip_error_job_truth(const DipErrorJob *job) {
    return dip_truth_job_truth(job->truth)->rgba8;
}
