// Draws the truth (the converged picture) level by level and tile by tile, and measures errors in
// bands and blocks of the picture.
#include "app/preview/live/error_job.h"

#include "app/measure/metrics/difference.h"
#include "app/measure/metrics/truth.h"
#include "app/preview/live/error_blocks.h"
#include "renderer/reference/convergence.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    HALVES = 2,              // A level of the truth is the mean of two halves.
    FINISH_PIXELS = 1 << 14, // Pixels for which one step computes the mean of the halves.
    BAND_PIXELS = 1 << 15,   // Pixels whose RMSE and PSNR one step sums up.
};

const int dip_error_job_samples[DIP_ERROR_JOB_LEVELS] = {4, 16, 64};

typedef struct PaneSums {
    DipMapSum squared_lin;
    DipMapSum squared_codes;
    DipMapSum flip;
} PaneSums;

struct DipErrorJob {
    DipReference *reference;
    DipSrgbEncodeTable encode;
    DipStill still;
    bool has_still;
    size_t pixels; // Size of the buffers below.
    double *halves[HALVES];
    float *rgb_lin;              // Mean of the halves, for the last finished level.
    uint8_t *rgba8;              // The same picture in 8-bit sRGB.
    float *flip[DIP_PANE_COUNT]; // FLIP of each pixel of a pane.
    float *map;                  // Errors: 3 values per pixel of a band, or the scratch of a block.
    DipConvergence *convergence; // NULL before the first tile.
    int level;                   // The level that is being drawn.
    int drawn;                   // Tiles of that level drawn so far, in both halves together.
    size_t finished;             // Number of that level's pixels whose mean was computed.
    double half_squares;         // Sum over these pixels of the halves' squared differences.
    double floor_rmse;           // Noise of the last finished level.
    int truth_level;             // The last finished level; -1: no level is finished.
    int measured;                // Bands and blocks measured so far; -1: all are measured.
    PaneSums sums[DIP_PANE_COUNT];
    DipErrorJobResult result;
};

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "truth", "out of memory");
}

static int larger(int a, int b) {
    return a > b ? a : b;
}

static int smaller(int a, int b) {
    return a < b ? a : b;
}

static size_t pixel_count(const DipErrorJob *job) {
    return (size_t)job->still.width * (size_t)job->still.height;
}

bool dip_still_has_same_truth(const DipStill *a, const DipStill *b) {
    return memcmp(&a->pose, &b->pose, sizeof a->pose) == 0 && a->time_ns == b->time_ns &&
           a->width == b->width && a->height == b->height;
}

DipErrorJob *dip_error_job_create(DipReference *reference, DipError *err) {
    DipErrorJob *job = calloc(1, sizeof *job);
    if (!job) {
        out_of_memory(err);
        return NULL;
    }
    job->reference = reference;
    dip_srgb_encode_table(&job->encode);
    return job;
}

static void free_pictures(DipErrorJob *job) {
    free(job->halves[0]);
    free(job->halves[1]);
    free(job->rgb_lin);
    free(job->rgba8);
    free(job->map);
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        free(job->flip[p]);
        job->flip[p] = NULL;
    }
    job->halves[0] = job->halves[1] = NULL;
    job->rgb_lin = job->map = NULL;
    job->rgba8 = NULL;
    job->pixels = 0;
}

void dip_error_job_destroy(DipErrorJob **job) {
    if (!*job) {
        return;
    }
    dip_convergence_destroy(&(*job)->convergence);
    free_pictures(*job);
    free(*job);
    *job = NULL;
}

// Returns the number of rows of a band, at least one.
static int band_rows(const DipErrorJob *job) {
    return larger(1, BAND_PIXELS / job->still.width);
}

static bool make_room(DipErrorJob *job, DipError *err) {
    const size_t pixels = pixel_count(job);
    const size_t block = dip_error_block_values();
    const size_t band = (size_t)job->still.width * (size_t)band_rows(job);
    if (job->pixels == pixels) {
        return true;
    }
    free_pictures(job);
    for (int h = 0; h < HALVES; h++) {
        job->halves[h] = malloc(pixels * 3 * sizeof(double));
    }
    job->rgb_lin = malloc(pixels * 3 * sizeof(float));
    job->rgba8 = malloc(pixels * 4);
    job->map = malloc((3 * band > block ? 3 * band : block) * sizeof(float));
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        job->flip[p] = malloc(pixels * sizeof(float));
    }
    job->pixels = pixels;
    return (job->halves[0] && job->halves[1] && job->rgb_lin && job->rgba8 && job->map &&
            job->flip[0] && job->flip[1]) ||
           out_of_memory(err);
}

bool dip_error_job_begin(DipErrorJob *job, const DipStill *still, DipError *err) {
    const bool same = job->has_still && dip_still_has_same_truth(&job->still, still);
    job->still = *still;
    job->measured = 0;
    memset(job->sums, 0, sizeof job->sums);
    job->result = (DipErrorJobResult){0};
    if (same) {
        return true;
    }
    dip_convergence_destroy(&job->convergence);
    job->level = job->drawn = 0;
    job->finished = 0;
    job->half_squares = 0.0;
    job->truth_level = -1;
    job->has_still = make_room(job, err);
    if (!job->has_still) {
        free_pictures(job);
    }
    return job->has_still;
}

// --- the truth ---------------------------------------------------------------------------------

// Draws a tile of one half. The halves have the same random seeds as in the cost report, so that
// the last level equals the cost report's truth.
static bool draw_next_tile(DipErrorJob *job, DipError *err) {
    const int tiles = dip_convergence_tile_count(job->convergence);
    const int half = job->drawn / tiles;
    if (job->drawn % tiles == 0) {
        memset(job->halves[half], 0, pixel_count(job) * 3 * sizeof(double));
    }
    const bool added = dip_convergence_add_tile(
        job->convergence, job->drawn % tiles, dip_error_job_samples[job->level], (uint32_t)half + 1,
        1.0, job->halves[half], NULL, err);
    job->drawn += added;
    return added;
}

static bool is_drawn(const DipErrorJob *job) {
    return job->convergence && job->drawn == HALVES * dip_convergence_tile_count(job->convergence);
}

// Computes the mean of the two halves for the next pixels, and adds up the halves' squared
// differences.
static void finish_pixels(DipErrorJob *job) {
    const size_t left = pixel_count(job) - job->finished;
    const size_t count = left < FINISH_PIXELS ? left : FINISH_PIXELS;
    double *a = job->halves[0] + 3 * job->finished;
    const double *b = job->halves[1] + 3 * job->finished;
    float *rgb_lin = job->rgb_lin + 3 * job->finished;
    for (size_t i = 0; i < 3 * count; i++) {
        const double difference = a[i] - b[i];
        job->half_squares += difference * difference;
        a[i] = 0.5 * (a[i] + b[i]);
        rgb_lin[i] = (float)a[i];
    }
    dip_truth_encode(&job->encode, a, count, job->rgba8 + 4 * job->finished);
    job->finished += count;
}

static void next_level(DipErrorJob *job) {
    job->floor_rmse = sqrt(job->half_squares / (3.0 * (double)pixel_count(job))) / 2.0;
    job->truth_level = job->level++;
    job->drawn = 0;
    job->finished = 0;
    job->half_squares = 0.0;
    job->measured = 0;
    memset(job->sums, 0, sizeof job->sums);
}

// --- the errors --------------------------------------------------------------------------------

static void add_sum(DipMapSum *to, DipMapSum sum) {
    to->sum += sum.sum;
    to->pixel_count += sum.pixel_count;
}

// The pane's picture and the truth.
static void both_pictures(const DipErrorJob *job, int pane, DipSrgbPicture *test,
                          DipSrgbPicture *truth) {
    const int width = job->still.width, height = job->still.height;
    *test = (DipSrgbPicture){job->still.rgba8[pane], job->still.stride_bytes, width, height};
    *truth = (DipSrgbPicture){job->rgba8, 4 * (size_t)width, width, height};
}

// Returns a picture's rows from `y` on.
static DipSrgbPicture rows_of(const DipSrgbPicture *picture, int y, int rows) {
    return (DipSrgbPicture){picture->rgba8 + (size_t)y * picture->stride_bytes,
                            picture->stride_bytes, picture->width, rows};
}

static void measure_band(DipErrorJob *job, int pane, int band) {
    const int y = band * band_rows(job);
    const int rows = smaller(band_rows(job), job->still.height - y);
    const size_t width = (size_t)job->still.width;
    const size_t pixels = width * (size_t)rows;
    DipSrgbPicture test, truth;
    both_pictures(job, pane, &test, &truth);
    test = rows_of(&test, y, rows);
    truth = rows_of(&truth, y, rows);
    PaneSums *sums = &job->sums[pane];
    dip_difference_lin(&test, job->rgb_lin + (size_t)y * width * 3, job->map);
    dip_difference_squared_map(job->map, pixels, job->map);
    add_sum(&sums->squared_lin, dip_map_sum(job->map, pixels, (DipPixelMask){0}));
    dip_difference_codes_map(&test, &truth, job->map);
    add_sum(&sums->squared_codes, dip_map_sum(job->map, pixels, (DipPixelMask){0}));
}

static bool measure_block(DipErrorJob *job, int pane, int block) {
    DipSrgbPicture test, truth;
    both_pictures(job, pane, &test, &truth);
    return dip_error_block_add(&test, &truth, block, job->map, job->flip[pane],
                               &job->sums[pane].flip);
}

// Returns the pane whose picture a pane shows.
static int shown_pane(const DipErrorJob *job, int pane) {
    return job->still.rgba8[pane] ? pane : DIP_PANE_CURRENT;
}

// Lists the panes that are measured. Returns their number.
static int list_panes(const DipErrorJob *job, int panes[DIP_PANE_COUNT]) {
    int count = 0;
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        if (job->still.rgba8[p] && !job->still.unjudged[p]) {
            panes[count++] = p;
        }
    }
    return count;
}

static void publish(DipErrorJob *job) {
    job->measured = -1;
    job->result.samples = HALVES * dip_error_job_samples[job->truth_level];
    job->result.last = job->truth_level == DIP_ERROR_JOB_LEVELS - 1;
    job->result.floor_rmse = job->floor_rmse;
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        const PaneSums *sums = &job->sums[shown_pane(job, p)];
        if (job->still.unjudged[p]) {
            job->result.panes[p] = (DipPaneError){.unjudged = true};
            continue;
        }
        const double rmse_lin = sqrt(dip_map_mean(sums->squared_lin));
        job->result.panes[p] = (DipPaneError){
            .rmse_lin = rmse_lin,
            .psnr_db = dip_psnr_db(dip_map_mean(sums->squared_codes)),
            .flip = dip_map_mean(sums->flip),
            .at_floor = rmse_lin < 3.0 * job->floor_rmse,
        };
    }
}

// Measures the next band or block. First come all bands of the first pane, then all blocks of this
// pane, then the bands and blocks of the other pane. If no pane is judged, publishes the truth.
static bool measure_next_part(DipErrorJob *job) {
    const int bands = (job->still.height + band_rows(job) - 1) / band_rows(job);
    const int blocks = dip_error_block_count(job->still.width, job->still.height);
    int panes[DIP_PANE_COUNT];
    const int pane_count = list_panes(job, panes);
    if (pane_count == 0) {
        publish(job);
        return true;
    }
    const int pane = panes[job->measured / (bands + blocks)];
    const int part = job->measured % (bands + blocks);
    if (part < bands) {
        measure_band(job, pane, part);
    } else if (!measure_block(job, pane, part - bands)) {
        return false;
    }
    if (++job->measured == pane_count * (bands + blocks)) {
        publish(job);
    }
    return true;
}

DipErrorJobStep dip_error_job_step(DipErrorJob *job, DipError *err) {
    if (!job->has_still) {
        return DIP_ERROR_JOB_DONE;
    }
    if (is_drawn(job)) {
        finish_pixels(job);
        if (job->finished == pixel_count(job)) {
            next_level(job);
        }
        return DIP_ERROR_JOB_WORKING;
    }
    if (job->truth_level >= 0 && job->measured >= 0) {
        if (!measure_next_part(job)) {
            out_of_memory(err);
            return DIP_ERROR_JOB_FAILED;
        }
        return job->measured < 0 ? DIP_ERROR_JOB_NEW_RESULT : DIP_ERROR_JOB_WORKING;
    }
    if (job->level == DIP_ERROR_JOB_LEVELS) {
        return DIP_ERROR_JOB_DONE;
    }
    if (!job->convergence) {
        dip_reference_set_time(job->reference, job->still.time_ns);
        job->convergence = dip_convergence_create(job->reference, &job->still.pose,
                                                  job->still.width, job->still.height, err);
        return job->convergence ? DIP_ERROR_JOB_WORKING : DIP_ERROR_JOB_FAILED;
    }
    return draw_next_tile(job, err) ? DIP_ERROR_JOB_WORKING : DIP_ERROR_JOB_FAILED;
}

const DipErrorJobResult *dip_error_job_result(const DipErrorJob *job) {
    return &job->result;
}

int dip_error_job_next_samples(const DipErrorJob *job) {
    const bool measures = job->truth_level >= 0 && job->measured >= 0;
    return !job->has_still || is_drawn(job) || measures || job->level == DIP_ERROR_JOB_LEVELS
               ? 0
               : HALVES * dip_error_job_samples[job->level];
}

double dip_error_job_drawn(const DipErrorJob *job) {
    return job->convergence
               ? (double)job->drawn / (HALVES * dip_convergence_tile_count(job->convergence))
               : 0.0;
}

const float *dip_error_job_flip(const DipErrorJob *job, int pane) {
    return job->still.unjudged[pane] ? NULL : job->flip[shown_pane(job, pane)];
}

const uint8_t *dip_error_job_truth(const DipErrorJob *job) {
    return job->rgba8;
}
