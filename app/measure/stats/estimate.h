// Computes estimates, the median and percentiles. An estimate is a value and how well it is known.
// All functions are thread-safe.
#ifndef DIP_APP_MEASURE_STATS_ESTIMATE_H
#define DIP_APP_MEASURE_STATS_ESTIMATE_H

#include "renderer/base/api.h"

#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

// `low` and `high` are NAN if they are not known. No function returns an interval of length 0: a
// value about whose error nothing is known has no interval.
typedef struct DipEstimate {
    double value;
    double low;       // The interval from low to high holds the true value with a probability of
    double high;      // 95 %.
    double log_error; // Standard error of the value's logarithm, more than 0; NAN: not known.
    double degrees;   // Degrees of freedom of log_error; INFINITY for a normal distribution.
} DipEstimate;

// Returns a value whose error is not known.
DIP_API DipEstimate dip_estimate_unknown(double value);

// Returns an estimate with low = value * exp(-t * log_error) and high = value * exp(t * log_error).
// Here t is the 97.5 % quantile of Student's t for the degrees of freedom (1 or more; INFINITY for
// a normal distribution). An error that is NAN, infinite or 0 gives dip_estimate_unknown.
DIP_API DipEstimate dip_estimate_make(double value, double log_error, double degrees);

// Returns the estimate with another error of its logarithm added in quadrature, for example an
// error that several estimates share. The degrees of freedom stay.
DIP_API DipEstimate dip_estimate_widen(const DipEstimate *estimate, double log_error);

// Returns the probability that the true value is at most `limit`: Student's t of the logarithm.
// `common_error` is added to the estimate's own in quadrature. Returns NAN if the estimate's error
// is not known.
DIP_API double dip_estimate_chance_below(const DipEstimate *estimate, double limit,
                                         double common_error);

// Returns the value that a variable with Student's t distribution and this number of degrees of
// freedom (1 or more; INFINITY for a normal distribution) does not exceed with the given
// probability (.5 to .9999).
DIP_API double dip_student_quantile(double probability, double degrees);

// Returns the value below which the given share (0 to 1) of count >= 1 values lies, linear between
// order statistics. Sorts the values.
DIP_API double dip_percentile(double *values, int count, double share);

// Returns what dip_percentile returns, but leaves the values in their order. `scratch` has room for
// `count` values.
static inline double dip_percentile_of(const double *values, int count, double share,
                                       double *scratch) {
    memcpy(scratch, values, (size_t)count * sizeof *values);
    return dip_percentile(scratch, count, share);
}

// Returns the median of count >= 1 values. Reorders the values. Takes linear time (Hoare's
// selection).
DIP_API double dip_median(double *values, int count);

#ifdef __cplusplus
}
#endif

#endif
