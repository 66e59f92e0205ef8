// Ratios of paired times, times along a path, and their bootstrap intervals.
#include "app/measure/stats/paired.h"

#include "app/measure/stats/random.h"
#include "renderer/base/assert.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { RESAMPLES = 300, SMOOTHED = 7, LEVEL_GROUPS = 7 };
// The standard deviation of normally distributed values is this many times the median of their
// distances from their median.
static const double mad_to_sd = 1.4826;

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "timing", "out of memory");
}

// --- spread ------------------------------------------------------------------------------------

// Standard deviation of count >= 2 values.
static double deviation(const double *values, int count) {
    double mean = 0.0, squares = 0.0;
    for (int i = 0; i < count; i++) {
        mean += values[i] / count;
    }
    for (int i = 0; i < count; i++) {
        squares += (values[i] - mean) * (values[i] - mean);
    }
    return sqrt(squares / (count - 1));
}

static DipStatsEstimate around(double value, double log_half_width) {
    return (DipStatsEstimate){value, value * exp(-log_half_width), value * exp(log_half_width)};
}

// --- rounds of the same frames -----------------------------------------------------------------

// Computes the ratio from the rounds listed in `drawn`. Returns NAN if no pair is left. scratch has
// room for `rounds` values.
static double ratio_of(const DipPairedTimes *times, const int *drawn, double *scratch) {
    double total = 0.0, base_total = 0.0;
    for (int f = 0; f < times->frames; f++) {
        int count = 0;
        for (int r = 0; r < times->rounds; r++) {
            const int i = drawn[r] * times->frames + f;
            if (!isnan(times->ms[i])) {
                scratch[count++] = times->ms[i] / times->base_ms[i];
            }
        }
        if (count == 0) {
            continue;
        }
        const double ratio = dip_stats_median(scratch, count);
        for (int r = 0; r < times->rounds; r++) {
            scratch[r] = times->base_ms[drawn[r] * times->frames + f];
        }
        const double weight = dip_stats_median(scratch, times->rounds);
        total += weight * ratio;
        base_total += weight;
    }
    return base_total > 0.0 ? total / base_total : NAN;
}

// Standard error of the log ratio: the bootstrap over whole rounds.
static double ratio_error(const DipPairedTimes *times, int *drawn, double *logs, double *scratch) {
    const int rounds = times->rounds;
    uint64_t random = 1;
    int count = 0;
    for (int i = 0; i < RESAMPLES; i++) {
        for (int r = 0; r < rounds; r++) {
            drawn[r] = dip_random_below(&random, rounds);
        }
        const double ratio = ratio_of(times, drawn, scratch);
        if (!isnan(ratio)) {
            logs[count++] = log(ratio);
        }
    }
    return deviation(logs, count) * sqrt((double)rounds / (rounds - 1));
}

bool dip_paired_ratio_value(const DipPairedTimes *times, double *ratio, DipError *err) {
    int *every = malloc((size_t)times->rounds * sizeof *every);
    double *scratch = malloc((size_t)times->rounds * sizeof *scratch);
    const bool done = (every && scratch) || out_of_memory(err);
    for (int r = 0; done && r < times->rounds; r++) {
        every[r] = r;
    }
    *ratio = done ? ratio_of(times, every, scratch) : NAN;
    free(every);
    free(scratch);
    return done;
}

bool dip_paired_ratio(const DipPairedTimes *times, DipStatsEstimate *ratio, DipError *err) {
    const int rounds = times->rounds;
    DIP_ASSERT(rounds > 0 && times->frames > 0);
    int *drawn = calloc((size_t)rounds, sizeof *drawn);
    double *scratch = malloc((size_t)rounds * sizeof *scratch);
    double *logs = malloc(RESAMPLES * sizeof *logs);
    bool done = (drawn && scratch && logs) || out_of_memory(err);
    double value = 0.0;
    done = done && dip_paired_ratio_value(times, &value, err);
    if (done && isnan(value)) {
        done = dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "timing",
                             "every pair of times was disturbed; time again on a quieter machine");
    }
    if (done) {
        *ratio = rounds < 2 ? (DipStatsEstimate){value, 0.0, INFINITY}
                            : around(value, dip_student_quantile(0.975, rounds - 1) *
                                                ratio_error(times, drawn, logs, scratch));
    }
    free(drawn);
    free(scratch);
    free(logs);
    return done;
}

double dip_paired_spread(const DipPairedTimes *times) {
    double *logs = malloc((size_t)times->rounds * sizeof *logs);
    int count = 0;
    for (int r = 0; logs && r < times->rounds; r++) {
        double total = 0.0, base_total = 0.0;
        for (int f = 0; f < times->frames; f++) {
            total += times->ms[r * times->frames + f];
            base_total += times->base_ms[r * times->frames + f];
        }
        if (!isnan(total)) {
            logs[count++] = log(total / base_total);
        }
    }
    double spread = logs ? -1.0 : NAN;
    if (count >= 2) {
        const double middle = dip_stats_median(logs, count);
        for (int i = 0; i < count; i++) {
            logs[i] = fabs(logs[i] - middle);
        }
        spread = mad_to_sd * dip_stats_median(logs, count);
    }
    free(logs);
    return spread;
}

// --- frames along a path -----------------------------------------------------------------------

// The working arrays of an estimate; all in one allocation.
typedef struct PathWork {
    const DipPathTimes *times;
    int used;          // Number of frames whose pair was kept.
    int *frames;       // [used]: their indices.
    double *logs;      // [used]: log ratios, or resampled ones.
    double *residuals; // [used]: log ratios less their running median.
    double *smooth;    // [used]: running median of the log ratios.
    double *smoothed;  // [used]: running median of resampled log ratios.
    double *time_ms;   // [frames]: time_f.
    double *sorted;    // [frames]: scratch.
} PathWork;

// What a resampling estimates, and its logarithm's standard error.
typedef enum PathValue { RATIO, P95, WORST, PATH_VALUE_COUNT } PathValue;

static bool open_work(PathWork *w, const DipPathTimes *times, DipError *err) {
    const size_t frames = (size_t)times->frames;
    *w = (PathWork){.times = times, .frames = malloc(frames * sizeof(int))};
    w->logs = malloc(6 * frames * sizeof(double));
    if (!w->frames || !w->logs) {
        return out_of_memory(err);
    }
    w->residuals = w->logs + frames;
    w->smooth = w->residuals + frames;
    w->smoothed = w->smooth + frames;
    w->time_ms = w->smoothed + frames;
    w->sorted = w->time_ms + frames;
    for (int f = 0; f < times->frames; f++) {
        if (!isnan(times->ms[f])) {
            w->frames[w->used] = f;
            w->logs[w->used++] = log(times->ms[f] / times->base_ms[f]);
        }
    }
    return 2 * w->used >= times->frames ||
           dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "timing",
                         "%d of %d pairs of times were disturbed; time again on a quieter machine",
                         times->frames - w->used, times->frames);
}

static void close_work(PathWork *w) {
    free(w->frames);
    free(w->logs);
}

static void running_median(const double *values, int count, double *smooth) {
    for (int i = 0; i < count; i++) {
        const int from = i < SMOOTHED / 2 ? 0 : i - SMOOTHED / 2;
        const int end = i + SMOOTHED / 2 + 1 < count ? i + SMOOTHED / 2 + 1 : count;
        double window[SMOOTHED];
        memcpy(window, values + from, (size_t)(end - from) * sizeof *window);
        smooth[i] = dip_stats_median(window, end - from);
    }
}

// Computes all frames' times from the smoothed log ratios. Between frames whose pairs were kept,
// the log ratio is linear; beyond the first and the last one it is constant.
static void frame_times(PathWork *w, const double *smooth) {
    int next = 0;
    for (int f = 0; f < w->times->frames; f++) {
        while (next < w->used - 1 && w->frames[next] < f) {
            next++;
        }
        const int last = next > 0 && w->frames[next] > f ? next - 1 : next;
        const int gap = w->frames[next] - w->frames[last];
        const double share = gap > 0 ? (double)(f - w->frames[last]) / gap : 0.0;
        const double log_ratio = smooth[last] + share * (smooth[next] - smooth[last]);
        w->time_ms[f] = w->times->level_ms[f] * exp(log_ratio);
    }
}

static void path_values(const PathWork *w, double values[PATH_VALUE_COUNT]) {
    const int frames = w->times->frames;
    double total = 0.0, level = 0.0, worst = 0.0;
    for (int f = 0; f < frames; f++) {
        total += w->time_ms[f];
        level += w->times->level_ms[f];
        worst = fmax(worst, w->time_ms[f]);
    }
    values[RATIO] = total / level;
    values[P95] = dip_stats_quantile(w->time_ms, frames, 0.95, w->sorted);
    values[WORST] = worst;
}

// Computes the standard errors of the values' logarithms. Returns false when memory runs out.
static bool path_errors(PathWork *w, double errors[PATH_VALUE_COUNT]) {
    double *logs = malloc(PATH_VALUE_COUNT * RESAMPLES * sizeof *logs);
    uint64_t random = 1;
    for (int i = 0; logs && i < RESAMPLES; i++) {
        for (int k = 0; k < w->used; k++) {
            const double residual = w->residuals[dip_random_below(&random, w->used)];
            w->logs[k] = w->smooth[k] + 1.25 * residual;
        }
        running_median(w->logs, w->used, w->smoothed);
        frame_times(w, w->smoothed);
        double values[PATH_VALUE_COUNT];
        path_values(w, values);
        for (int v = 0; v < PATH_VALUE_COUNT; v++) {
            logs[v * RESAMPLES + i] = log(values[v]);
        }
    }
    const bool many_dropped = 10 * (w->times->frames - w->used) > w->times->frames;
    for (int v = 0; logs && v < PATH_VALUE_COUNT; v++) {
        errors[v] = hypot(deviation(logs + v * RESAMPLES, RESAMPLES), many_dropped ? 0.01 : 0.0);
    }
    free(logs);
    return logs != NULL;
}

static DipStatsEstimate with_bound(double value, double error, double level_error) {
    return around(value, 1.75 * hypot(error, level_error));
}

bool dip_path_estimate(const DipPathTimes *times, DipPathEstimate *estimate, DipError *err) {
    DIP_ASSERT(times->rounds >= 2 && times->frames >= times->rounds);
    PathWork w;
    double values[PATH_VALUE_COUNT], errors[PATH_VALUE_COUNT];
    bool done = open_work(&w, times, err);
    if (done) {
        running_median(w.logs, w.used, w.smooth);
        for (int k = 0; k < w.used; k++) {
            w.residuals[k] = w.logs[k] - w.smooth[k];
        }
        frame_times(&w, w.smooth);
        path_values(&w, values);
        done = path_errors(&w, errors) || out_of_memory(err);
    }
    if (done) {
        double level = 0.0;
        for (int f = 0; f < times->frames; f++) {
            level += times->level_ms[f] / times->frames;
        }
        const double half =
            dip_student_quantile(0.975, times->rounds - 1) * hypot(errors[RATIO], 0.002);
        const double level_half =
            dip_student_quantile(0.975, LEVEL_GROUPS - 1) * times->level_error;
        *estimate = (DipPathEstimate){
            .ratio = around(values[RATIO], half),
            .mean_ms = around(values[RATIO] * level, hypot(half, level_half)),
            .p95_ms = with_bound(values[P95], errors[P95], times->level_error),
            .worst_ms = with_bound(values[WORST], errors[WORST], times->level_error),
            .used = w.used,
            .ratio_error = hypot(errors[RATIO], 0.002),
            .p95_error = errors[P95],
            .worst_error = errors[WORST],
            .level_error = times->level_error,
        };
    }
    close_work(&w);
    return done;
}

bool dip_path_frame_times(const DipPathTimes *times, double *frame_ms, DipError *err) {
    PathWork w;
    const bool done = open_work(&w, times, err);
    if (done) {
        running_median(w.logs, w.used, w.smooth);
        frame_times(&w, w.smooth);
        memcpy(frame_ms, w.time_ms, (size_t)times->frames * sizeof *frame_ms);
    }
    close_work(&w);
    return done;
}

double dip_level_error(const double *log_times, int count) {
    if (count < 2 * LEVEL_GROUPS) {
        return 0.0;
    }
    double *group = malloc((size_t)count * sizeof *group);
    if (!group) {
        return -1.0;
    }
    double medians[LEVEL_GROUPS], mean = 0.0;
    for (int g = 0; g < LEVEL_GROUPS; g++) {
        const int from = (int)((int64_t)g * count / LEVEL_GROUPS);
        const int end = (int)((int64_t)(g + 1) * count / LEVEL_GROUPS);
        memcpy(group, log_times + from, (size_t)(end - from) * sizeof *group);
        medians[g] = dip_stats_median(group, end - from);
        mean += medians[g] / LEVEL_GROUPS;
    }
    free(group);
    double products = 0.0, squares = 1e-12; // Greater than 0 if all medians are equal.
    for (int g = 0; g < LEVEL_GROUPS; g++) {
        squares += (medians[g] - mean) * (medians[g] - mean);
        products += g > 0 ? (medians[g] - mean) * (medians[g - 1] - mean) : 0.0;
    }
    double correlation = products / squares + 1.0 / LEVEL_GROUPS;
    correlation = fmin(fmax(correlation, 0.0), 0.8);
    return deviation(medians, LEVEL_GROUPS) / sqrt(LEVEL_GROUPS) *
           sqrt((1.0 + correlation) / (1.0 - correlation));
}
