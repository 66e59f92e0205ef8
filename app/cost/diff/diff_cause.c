// Fits a line through the origin for each kind of work. The bootstrap over the starts of the
// programs tells whether the best fit is more than chance.
#include "app/cost/diff/diff_cause.h"

#include "app/cost/diff/diff.h"
#include "app/measure/stats/random.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

enum { DRAWS = 200 };
static const double surely_wins = 0.9;
static const double surely_explains = 0.9;
static const double same_cosine = 0.999;

static double dot(const double *a, const double *b, int count) {
    double sum = 0.0;
    for (int i = 0; i < count; i++) {
        sum += a[i] * b[i];
    }
    return sum;
}

bool dip_cause_is_same_work(const DipCauseData *data, int a, int b) {
    const double *x = data->work + a * data->rows, *y = data->work + b * data->rows;
    const double lengths = sqrt(dot(x, x, data->rows) * dot(y, y, data->rows));
    return lengths > 0.0 && dot(x, y, data->rows) > same_cosine * lengths;
}

// Finds the kind of work that explains most of the sum of squares of the times, with a positive
// price. Counts kinds that cannot be told apart as the first of them.
static DipCause best_fit(const DipCauseData *data, const double *times) {
    DipCause best = {.kind = -1};
    const double squares = dot(times, times, data->rows);
    for (int k = 0; k < data->kinds; k++) {
        const double *work = data->work + k * data->rows;
        const double amount = dot(work, work, data->rows);
        const double common = dot(work, times, data->rows);
        const double share =
            amount > 0.0 && squares > 0.0 ? common * common / amount / squares : 0.0;
        if (common > 0.0 && share > best.share) {
            best = (DipCause){k, common / amount, share};
        }
    }
    for (int k = 0; best.kind > 0 && k < best.kind; k++) {
        if (dip_cause_is_same_work(data, k, best.kind)) {
            const double *work = data->work + k * data->rows;
            best.kind = k;
            best.price = dot(work, times, data->rows) / dot(work, work, data->rows);
        }
    }
    return best;
}

// Computes the mean of each row over the drawn starts. Returns false if a row has no time in them.
static bool mean_times(const DipCauseData *data, const int *drawn, double *times) {
    for (int r = 0; r < data->rows; r++) {
        double sum = 0.0;
        int count = 0;
        for (int s = 0; s < data->starts; s++) {
            const double time = data->per_start[r * data->starts + drawn[s]];
            sum += isnan(time) ? 0.0 : time;
            count += !isnan(time);
        }
        if (count == 0) {
            return false;
        }
        times[r] = sum / count;
    }
    return true;
}

static double share_of_wins(const DipCauseData *data, int kind, int *drawn, double *times) {
    uint64_t random = 1;
    int wins = 0;
    for (int i = 0; i < DRAWS; i++) {
        for (int s = 0; s < data->starts; s++) {
            drawn[s] = dip_random_below(&random, data->starts);
        }
        wins += mean_times(data, drawn, times) && best_fit(data, times).kind == kind;
    }
    return (double)wins / DRAWS;
}

bool dip_cause_find(const DipCauseData *data, DipCause *cause, DipError *err) {
    double *times = malloc((size_t)data->rows * sizeof *times);
    int *drawn = malloc((size_t)data->starts * sizeof *drawn);
    const bool made = (times && drawn) || dip_cost_diff_no_memory(err);
    *cause = (DipCause){.kind = -1};
    for (int s = 0; made && s < data->starts; s++) {
        drawn[s] = s;
    }
    if (made && mean_times(data, drawn, times)) {
        const DipCause best = best_fit(data, times);
        if (best.kind >= 0 && best.share >= surely_explains &&
            share_of_wins(data, best.kind, drawn, times) >= surely_wins) {
            *cause = best;
        }
    }
    free(times);
    free(drawn);
    return made;
}
