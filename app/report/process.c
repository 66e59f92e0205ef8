// Computes means and variances of a Gaussian process by the Cholesky factor of its covariance.
#include "app/report/process.h"

#include "app/report/report.h"
#include "renderer/base/assert.h"

#include <math.h>
#include <stdlib.h>

_Static_assert(DIP_SETTING_COUNT *DIP_MAX_STEPS *DIP_PROCESS_STEP *DIP_PROCESS_MOST_WEIGHT <=
                   DIP_PROCESS_MOST_DISTANCE,
               "room for distances");

// Where a step lies: in the order of 1 / samples or 1 / probes, over the same length as if all
// steps were equally far apart.
static int place_of(const DipQuality *quality, int setting) {
    static const int samples[] = {0, 18, 27, 30, 32}, probes[] = {0, 17, 26, 30, 32};
    const int step = quality->step[setting];
    return setting == DIP_SETTING_AA   ? samples[step]
           : setting == DIP_SETTING_AF ? probes[step]
                                       : step * DIP_PROCESS_STEP;
}

int dip_cost_distance(const DipQuality *a, const DipQuality *b, unsigned settings,
                      const double weights[DIP_SETTING_COUNT]) {
    int distance = 0;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        const int apart = settings >> s & 1 ? abs(place_of(a, s) - place_of(b, s)) : 0;
        distance += weights ? (int)(weights[s] * apart + 0.5) : apart;
    }
    return distance;
}

bool dip_cost_process_begin(DipCostProcess *process, double common, double alike, double own,
                            int room) {
    const size_t size = (size_t)room * ((size_t)room + 1) / 2;
    *process = (DipCostProcess){.own = own, .room = room};
    for (int d = 0; d < DIP_PROCESS_MOST_DISTANCE; d++) {
        process->covariance[d] = common + pow(alike, (double)d / DIP_PROCESS_STEP);
    }
    process->factor = malloc((size + 1) * sizeof *process->factor);
    return process->factor != NULL;
}

void dip_cost_process_free(DipCostProcess *process) {
    free(process->factor);
    *process = (DipCostProcess){0};
}

static const double *row_of(const DipCostProcess *process, int i) {
    return process->factor + (size_t)i * ((size_t)i + 1) / 2;
}

// Solves L x = covariances for x, where L is the factor, and returns the sum of the squares of x.
static double solve_lower(const DipCostProcess *process, const int *distances, double *x) {
    double squares = 0.0;
    for (int i = 0; i < process->count; i++) {
        const double *row = row_of(process, i);
        double left = process->covariance[distances[i]];
        for (int k = 0; k < i; k++) {
            left -= row[k] * x[k];
        }
        x[i] = left / row[i];
        squares += x[i] * x[i];
    }
    return squares;
}

void dip_cost_process_add(DipCostProcess *process, const int *distances) {
    const int count = process->count;
    double *row = process->factor + (size_t)count * ((size_t)count + 1) / 2;
    DIP_ASSERT(count < process->room);
    const double squares = solve_lower(process, distances, row);
    row[count] = sqrt(fmax(process->covariance[0] + process->own - squares, process->own));
    process->count++;
}

void dip_cost_process_solve(const DipCostProcess *process, const double *values, double *shares) {
    const int count = process->count;
    for (int i = 0; i < count; i++) {
        const double *row = row_of(process, i);
        shares[i] = values[i];
        for (int k = 0; k < i; k++) {
            shares[i] -= row[k] * shares[k];
        }
        shares[i] /= row[i];
    }
    for (int i = count - 1; i >= 0; i--) {
        for (int k = i + 1; k < count; k++) {
            shares[i] -= row_of(process, k)[i] * shares[k];
        }
        shares[i] /= row_of(process, i)[i];
    }
}

double dip_cost_process_likelihood(const DipCostProcess *process, const double *values,
                                   const double *shares) {
    double squares = 0.0, logs = 0.0;
    for (int i = 0; i < process->count; i++) {
        squares += values[i] * shares[i];
        logs += log(row_of(process, i)[i]);
    }
    return -0.5 * process->count * log(squares / process->count) - logs;
}

double dip_cost_process_variance(const DipCostProcess *process, const int *distances) {
    double x[DIP_COST_MAX_ROWS];
    return fmax(process->covariance[0] - solve_lower(process, distances, x), 0.0);
}

// Rasmussen and Williams 2006, eq. 5.12: the share over the diagonal element of the inverse.
void dip_cost_process_left_out(const DipCostProcess *process, const double *shares,
                               double *misses) {
    double x[DIP_COST_MAX_ROWS];
    for (int at = 0; at < process->count; at++) {
        double inverse = 0.0;
        for (int i = at; i < process->count; i++) {
            const double *row = row_of(process, i);
            double left = i == at;
            for (int k = at; k < i; k++) {
                left -= row[k] * x[k];
            }
            x[i] = left / row[i];
            inverse += x[i] * x[i];
        }
        misses[at] = shares[at] / inverse;
    }
}
