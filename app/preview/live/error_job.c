// Draws the truth (the converged picture) in steps. The truth passes through levels, each with more
// samples per pixel than the level before. At each level, the job compares the panes' pictures with
// the truth.
#include "app/preview/live/error_job.h"

#include <stdlib.h>
#include <string.h>

struct DipErrorJob {
    DipReference *reference;
    const char *scene_hash;
    const char *cache;
    DipStill still;
    DipTruthJob *truth; // NULL if there is no still.
    DipMeter meter;
    float *flip[DIP_PANE_COUNT]; // FLIP of each pixel of a pane.
    DipMetricSums sums[DIP_PANE_COUNT];
    bool judges; // True while a pane's picture must still be compared with the newest truth.
    int pane;    // The pane that is compared next, or now if has_begun is true.
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

static void forget_truth(DipErrorJob *job) {
    dip_truth_job_destroy(&job->truth);
    dip_meter_free(&job->meter);
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        free(job->flip[p]);
        job->flip[p] = NULL;
    }
}

void dip_error_job_destroy(DipErrorJob **job) {
    if (*job) {
        forget_truth(*job);
        free(*job);
        *job = NULL;
    }
}

static bool begin_truth(DipErrorJob *job, DipError *err) {
    const DipStill *still = &job->still;
    const size_t pixels = (size_t)still->width * (size_t)still->height;
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
    bool made = dip_meter_init(&job->meter, DIP_METER_FLIP, still->width, still->height,
                               still->pixels_per_degree);
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        job->flip[p] = malloc(pixels * sizeof *job->flip[p]);
        made = made && job->flip[p];
    }
    made = made || out_of_memory(err);
    job->truth = made ? dip_truth_job_create(&def, job->cache, NULL, true, err) : NULL;
    if (!job->truth) {
        forget_truth(job);
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
    forget_truth(job);
    return begin_truth(job, err);
}

// --- the errors --------------------------------------------------------------------------------

// Returns the pane that holds the picture of `pane`. If both panes show the same picture, only the
// current pane holds the picture.
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
        const DipMetricSums *sums = &job->sums[shown_pane(job, p)];
        const DipMetrics metrics = dip_metrics_of(sums, 0);
        job->result.panes[p].rmse_lin = metrics.rmse_lin;
        job->result.panes[p].psnr_db = metrics.psnr_db;
        job->result.panes[p].flip = metrics.flip;
        job->result.panes[p].at_floor = dip_truth_hides(&truth->floor, sums);
    }
}

static void begin_pane(DipErrorJob *job) {
    const DipSrgbPicture test = {job->still.rgba8[job->pane], job->still.stride_bytes,
                                 job->still.width, job->still.height};
    dip_meter_begin(&job->meter, &test, NULL);
    job->has_begun = true;
}

// Keeps the pane's errors. Swaps the FLIP maps of the pane and the meter, so that nothing is
// copied.
static void end_pane(DipErrorJob *job) {
    float *map = job->flip[job->pane];
    job->flip[job->pane] = job->meter.flip_map;
    job->meter.flip_map = map;
    job->sums[job->pane] = job->meter.sums;
    job->pane++;
    job->has_begun = false;
}

// Compares the next part of a pane's picture with the truth. When no pane is left, puts the errors
// into the job's result.
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
        begin_pane(job);
    }
    const DipStep step = dip_meter_step(&job->meter);
    if (step == DIP_STEP_FAILED) {
        out_of_memory(err);
        return step;
    }
    if (step == DIP_STEP_DONE) {
        end_pane(job);
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
        const DipMeterStandard standard = dip_truth_standard(dip_truth_job_truth(job->truth));
        dip_meter_set_standard(&job->meter, &standard);
        judge_again(job);
        return DIP_STEP_WORKING;
    }
    return step;
}

const DipErrorJobResult *dip_error_job_result(const DipErrorJob *job) {
    return &job->result;
}

double dip_error_job_drawn(const DipErrorJob *job, int *next_samples) {
    const double drawn = job->truth ? dip_truth_job_drawn(job->truth, next_samples) : 0.0;
    if (!job->truth || (job->judges && dip_truth_job_truth(job->truth))) {
        *next_samples = 0;
    }
    return drawn;
}

const float *dip_error_job_flip(const DipErrorJob *job, int pane) {
    return job->still.unjudged[pane] ? NULL : job->flip[shown_pane(job, pane)];
}

const uint8_t *dip_error_job_truth(const DipErrorJob *job) {
    return dip_truth_job_truth(job->truth)->rgba8;
}
