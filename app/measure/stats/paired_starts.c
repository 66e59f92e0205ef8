// Ratios of paired times over several starts of two programs.
#include "app/measure/stats/paired_starts.h"

#include "renderer/base/assert.h"

#include <math.h>
#include <stdlib.h>

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "timing", "out of memory");
}

static int frame_count_of_start(const DipPairedStarts *times) {
    return times->rounds * times->frames;
}

// --- the interval over the starts ----------------------------------------------------------------

// The median of the means of all pairs of values, each value paired with itself, too. `means` has
// room for count (count + 1) / 2 values.
static double hodges_lehmann(const double *values, int count, double *means) {
    int pairs = 0;
    for (int i = 0; i < count; i++) {
        for (int j = i; j < count; j++) {
            means[pairs++] = 0.5 * (values[i] + values[j]);
        }
    }
    return dip_stats_median(means, pairs);
}

// Standard error of the mean of count >= 2 values.
static double standard_error(const double *values, int count) {
    double mean = 0.0, squares = 0.0;
    for (int i = 0; i < count; i++) {
        mean += values[i] / count;
    }
    for (int i = 0; i < count; i++) {
        squares += (values[i] - mean) * (values[i] - mean);
    }
    return sqrt(squares / (count - 1) / count);
}

// Lists the log ratios of the starts that have pairs. Returns their number, or -1 when memory runs
// out.
static int list_starts(const DipPairedStarts *times, double *logs, DipError *err) {
    const int length = frame_count_of_start(times);
    int count = 0;
    for (int s = 0; s < times->starts; s++) {
        double ratio;
        const DipPairedTimes start = {times->ms + s * length, times->base_ms + s * length,
                                      times->rounds, times->frames};
        if (!dip_paired_ratio_value(&start, &ratio, err)) {
            return -1;
        }
        if (!isnan(ratio)) {
            logs[count++] = log(ratio);
        }
    }
    return count;
}

bool dip_paired_starts_ratio(const DipPairedStarts *times, DipEstimate *ratio, DipError *err) {
    DIP_ASSERT(times->starts >= 2 && times->rounds > 0 && times->frames > 0);
    const DipPairedTimes all = {times->ms, times->base_ms, times->starts * times->rounds,
                                times->frames};
    const size_t starts = (size_t)times->starts;
    double *logs = malloc((starts + starts * (starts + 1) / 2) * sizeof *logs);
    bool done = (logs || out_of_memory(err)) && dip_paired_ratio(&all, ratio, err);
    const int count = done ? list_starts(times, logs, err) : 0;
    done = done && count >= 0;
    if (done && count < 2) {
        *ratio = dip_estimate_unknown(ratio->value);
    } else if (done) {
        const double middle = hodges_lehmann(logs, count, logs + starts);
        const double half = dip_student_quantile(0.975, count - 1) * standard_error(logs, count);
        ratio->low = fmin(ratio->low, exp(middle - half));
        ratio->high = fmax(ratio->high, exp(middle + half));
    }
    free(logs);
    return done;
}

// --- differences ---------------------------------------------------------------------------------

// Returns the mean over the frames of the median difference, or NAN if no pair is left. scratch has
// room for `rounds` values.
static double difference_of_start(const DipPairedStarts *times, int start, double *scratch) {
    const int first = start * frame_count_of_start(times);
    double total = 0.0;
    int frames = 0;
    for (int f = 0; f < times->frames; f++) {
        int count = 0;
        for (int r = 0; r < times->rounds; r++) {
            const int i = first + r * times->frames + f;
            if (!isnan(times->ms[i])) {
                scratch[count++] = times->ms[i] - times->base_ms[i];
            }
        }
        if (count > 0) {
            total += dip_stats_median(scratch, count);
            frames++;
        }
    }
    return frames > 0 ? total / frames : NAN;
}

bool dip_paired_starts_difference(const DipPairedStarts *times, DipStartDifference *difference,
                                  double *per_start, DipError *err) {
    const int most = times->rounds > times->starts ? times->rounds : times->starts;
    double *scratch = malloc((size_t)most * sizeof *scratch);
    if (!scratch) {
        return out_of_memory(err);
    }
    for (int s = 0; s < times->starts; s++) {
        per_start[s] = difference_of_start(times, s, scratch);
    }
    int count = 0;
    double total = 0.0;
    for (int s = 0; s < times->starts; s++) {
        if (!isnan(per_start[s])) {
            scratch[count++] = per_start[s];
            total += per_start[s];
        }
    }
    *difference = (DipStartDifference){
        .ms = count > 0 ? total / count : 0.0,
        .error = count > 1 ? standard_error(scratch, count) : INFINITY,
    };
    free(scratch);
    return true;
}
