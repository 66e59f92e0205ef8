// Computes estimates, medians and percentiles. An estimate is a value with its error. All functions
// are thread-safe.
#ifndef DIP_APP_MEASURE_STATS_ESTIMATE_H
#define DIP_APP_MEASURE_STATS_ESTIMATE_H

#include "renderer/base/api.h"

#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

// The interval from `low` to `high` holds the true value with a probability of 95 %. If the error
// of a value is not known, all fields but `value` are NAN. An error of 0 counts as not known.
typedef struct DipEstimate {
    double value;
    double low;
    double high;
    double log_error; // Standard error of the value's logarithm, more than 0.
    double degrees;   // Degrees of freedom of log_error; INFINITY for a normal distribution.
} DipEstimate;

// Returns a value whose error is not known.
DIP_API DipEstimate dip_estimate_unknown(double value);

// Returns an estimate with low = value * exp(-t * log_error) and high = value * exp(t * log_error).
// Here t is the 97.5 % quantile of Student's t for the degrees of freedom (1 or more; INFINITY for
// a normal distribution). Returns dip_estimate_unknown(value) if the error is NAN, infinite or 0.
// If `high` overflows, `low` and `high` are NAN.
DIP_API DipEstimate dip_estimate_make(double value, double log_error, double degrees);

// Returns the estimate with a greater error: adds `log_error`, for example an error that several
// estimates share, to estimate->log_error in quadrature. The degrees of freedom do not change.
DIP_API DipEstimate dip_estimate_widen(const DipEstimate *estimate, double log_error);

// Returns the probability that the true value is at most `limit`. The logarithm of the value is
// taken to have Student's t distribution. `common_error` is added to the estimate's log_error in
// quadrature. Returns NAN if either error is NAN or if the estimate's value is not positive.
DIP_API double dip_estimate_chance_below(const DipEstimate *estimate, double limit,
                                         double common_error);

// Returns the quantile of Student's t distribution for a probability in 0.5..0.999999. `degrees` is
// the number of degrees of freedom (1 or more; INFINITY for a normal distribution).
DIP_API double dip_student_quantile(double probability, double degrees);

// Returns the value below which the given share (0 to 1) of count >= 1 values lies. Interpolates
// linearly between the sorted values. Sorts the array.
DIP_API double dip_percentile(double *values, int count, double share);

// Returns what dip_percentile returns, but leaves the values in their order. `scratch` has room for
// `count` values.
static inline double dip_percentile_of(const double *values, int count, double share,
                                       double *scratch) {
    memcpy(scratch, values, (size_t)count * sizeof *values);
    return dip_percentile(scratch, count, share);
}

// Returns the median of count >= 1 values. Reorders the values. Takes linear time on average
// (Hoare's selection).
DIP_API double dip_median(double *values, int count);

#ifdef __cplusplus
}
#endif

#endif
