// Computes Student's t distribution, estimates with intervals, percentiles and medians.
#include "app/measure/stats/estimate.h"

#include "renderer/base/assert.h"
#include "renderer/base/fp_mode.h"
#include "renderer/base/trig.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

// --- Student's t ---------------------------------------------------------------------------------

// Returns the probability that a variable with Student's t distribution lies between -t and t, for
// a whole number of degrees of freedom (Abramowitz and Stegun 26.7.3 and 26.7.4).
static double within_whole(double t, int degrees) {
    const double angle = atan(t / sqrt(degrees));
    const double cosine = cos(angle);
    const bool odd = degrees % 2 == 1;
    double term = odd ? cosine : 1.0;
    double sum = 0.0;
    for (int k = odd ? 3 : 2; k <= degrees; k += 2) {
        sum += term;
        term *= cosine * cosine * (k - 1) / k;
    }
    return odd ? 2.0 / DIP_PI * (angle + sin(angle) * sum) : sin(angle) * sum;
}

// Returns the probability that a variable with Student's t distribution is at most `t`. Between
// whole degrees of freedom, the probability is linear in their reciprocal.
static double student_below(double t, double degrees) {
    if (degrees > 1000.0) {
        return 0.5 * erfc(-t / sqrt(2.0));
    }
    const int below = (int)degrees;
    double within = within_whole(fabs(t), below);
    if (degrees > below) {
        const double share = (1.0 - below / degrees) * (below + 1.0);
        within += share * (within_whole(fabs(t), below + 1) - within);
    }
    return t > 0.0 ? 0.5 + 0.5 * within : 0.5 - 0.5 * within;
}

double dip_student_quantile(double probability, double degrees) {
    DIP_FP_MODE_SCOPE();
    DIP_FP_PIN(probability);
    DIP_FP_PIN(degrees);
    DIP_ASSERT(probability >= 0.5 && probability <= 0.999999 && degrees >= 1.0);
    double low = 0.0, high = 1e6;
    while (high - low > 1e-12 * (1.0 + low)) {
        const double middle = 0.5 * (low + high);
        *(student_below(middle, degrees) < probability ? &low : &high) = middle;
    }
    double quantile = 0.5 * (low + high);
    DIP_FP_PIN(quantile);
    return quantile;
}

// --- estimates -----------------------------------------------------------------------------------

DipEstimate dip_estimate_unknown(double value) {
    return (DipEstimate){value, NAN, NAN, NAN, NAN};
}

DipEstimate dip_estimate_make(double value, double log_error, double degrees) {
    DIP_FP_MODE_SCOPE();
    DIP_FP_PIN(value);
    DIP_FP_PIN(log_error);
    DIP_FP_PIN(degrees);
    if (!(log_error > 0.0) || isinf(log_error) || !(degrees >= 1.0)) {
        return dip_estimate_unknown(value);
    }
    const double half = dip_student_quantile(0.975, degrees) * log_error;
    DipEstimate estimate = {value, value * exp(-half), value * exp(half), log_error, degrees};
    if (isinf(estimate.high)) { // An interval without an upper end says nothing.
        estimate.low = NAN;
        estimate.high = NAN;
    }
    DIP_FP_PIN_STRUCT(estimate);
    return estimate;
}

DipEstimate dip_estimate_widen(const DipEstimate *estimate, double log_error) {
    DIP_FP_MODE_SCOPE();
    DIP_FP_PIN(log_error);
    double error = hypot(estimate->log_error, log_error);
    DIP_FP_PIN(error);
    return dip_estimate_make(estimate->value, error, estimate->degrees);
}

double dip_estimate_chance_below(const DipEstimate *estimate, double limit, double common_error) {
    DIP_FP_MODE_SCOPE();
    DIP_FP_PIN(limit);
    DIP_FP_PIN(common_error);
    const double error = hypot(estimate->log_error, common_error);
    if (!(error > 0.0) || !(estimate->value > 0.0)) {
        return NAN;
    }
    double chance =
        limit > 0.0 ? student_below(log(limit / estimate->value) / error, estimate->degrees) : 0.0;
    DIP_FP_PIN(chance);
    return chance;
}

// --- order statistics ----------------------------------------------------------------------------

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

double dip_percentile(double *values, int count, double share) {
    DIP_FP_MODE_SCOPE();
    DIP_FP_PIN(share);
    DIP_ASSERT(count > 0 && share >= 0.0 && share <= 1.0);
    qsort(values, (size_t)count, sizeof *values, compare);
    const double position = share * (count - 1);
    const int below = (int)position;
    const int above = below + 1 < count ? below + 1 : below;
    double percentile = values[below] + (position - below) * (values[above] - values[below]);
    DIP_FP_PIN(percentile);
    return percentile;
}

// Returns the value that sorting would put at values[index]. Uses Hoare's selection, which reorders
// the values.
static double select_value(double *values, int count, int index) {
    int low = 0, high = count - 1;
    while (low < high) {
        const double pivot = values[(low + high) / 2];
        int i = low, j = high;
        while (i <= j) {
            while (values[i] < pivot) {
                i++;
            }
            while (values[j] > pivot) {
                j--;
            }
            if (i <= j) {
                const double swap = values[i];
                values[i++] = values[j];
                values[j--] = swap;
            }
        }
        if (index <= j) {
            high = j;
        } else if (index >= i) {
            low = i;
        } else {
            break;
        }
    }
    return values[index];
}

double dip_median(double *values, int count) {
    DIP_FP_MODE_SCOPE();
    const double below = select_value(values, count, (count - 1) / 2);
    double median = count % 2 ? below : 0.5 * (below + select_value(values, count, count / 2));
    DIP_FP_PIN(median);
    return median;
}
