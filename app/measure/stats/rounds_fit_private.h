// Declares a fit (rounds.h) with its intermediate values, for the files that compute it. Private to
// this folder.
//
// A unit is a start of the program, or a round if there is one start. Each estimate is computed
// again with each unit left out; how far the results differ shows how well the estimate is known
// (the jackknife). If every round draws all frames and there are several starts, a subject's
// values are computed from each unit alone instead. The level of a base's frame is the logarithm of
// the time, in ms, that the frame takes at the machine's usual speed.
#ifndef DIP_APP_MEASURE_STATS_ROUNDS_FIT_PRIVATE_H
#define DIP_APP_MEASURE_STATS_ROUNDS_FIT_PRIVATE_H

#include "app/measure/stats/rounds.h"

#include <math.h>

// Names the values that are fitted: the mean, the 95th percentile and the greatest of the times of
// a subject's frames, each divided by the base's mean time.
typedef enum DipTimesValue {
    DIP_TIMES_RATIO,
    DIP_TIMES_P95,
    DIP_TIMES_WORST,
    DIP_TIMES_VALUE_COUNT
} DipTimesValue;

// A frame that a subject and its base drew in the same block.
typedef struct DipTimesPair {
    int frame;
    int visit; // Equal for the frames of one visit.
    int unit;
    double log_ratio; // Logarithm of the subject's time / the base's time.
} DipTimesPair;

// A time of a base's frame.
typedef struct DipTimesCell {
    int frame;
    int visit; // Equal for the frames of one visit.
    int unit;
    double log_ms;
    double trust; // Weight in the fit, 0 to 1, by how well the time agrees with the fit.
} DipTimesCell;

// What the fit finds for a base. The logarithm of each DipTimesValue varies from unit to unit. The
// part of this variance that moves all subjects of the base alike is `variance` here; the rest
// belongs to the single subjects (DipTimesSubject.variance), and `pooled` is its mean.
typedef struct DipTimesBase {
    double level_ms;      // Mean time of the base's frames.
    double level_error;   // Standard error of the logarithm of level_ms; NAN if it is not known.
    double level_degrees; // Degrees of freedom of level_error.
    // Mean of DipTimesSubject.variance over the other subjects of the base whose moves are known.
    double pooled[DIP_TIMES_VALUE_COUNT];
    double pooled_degrees;                  // Weight of `pooled` in own_variance (rounds.c).
    double variance[DIP_TIMES_VALUE_COUNT]; // The base's part of the variance.
} DipTimesBase;

typedef struct DipTimesSubject {
    int base;
    int timed, kept;                        // See DipAlong.
    double spread;                          // See dip_times_spread.
    double doubt;                           // Variance of the error of one frame's log time.
    double logs[DIP_TIMES_VALUE_COUNT];     // Logarithms of the values.
    double variance[DIP_TIMES_VALUE_COUNT]; // The subject's part of the variance (DipTimesBase).
    double shares[DIP_TIMED_PARTS];         // See dip_times_shares.
} DipTimesSubject;

struct DipTimesFit {
    int frames;
    int units;     // Number of starts, or of rounds if there is one start.
    double excess; // Factor by which the jackknife overestimates the variance between units.
    DipTimesSubject *subjects;
    DipTimesBase *bases; // [subject]; only the elements of bases are used.
    double *frame_ms;    // [subject * frames + frame]
    // How far each unit moves the logarithm of each value, at the index
    // (subject * units + unit) * DIP_TIMES_VALUE_COUNT + value.
    double *moves;
};

// Memory and intermediate values of a fit.
typedef struct DipTimesWork {
    const DipTimes *times;
    DipTimesFit *fit;
    int part;                // See dip_times_fit_part; -1 if subjects differ in all parts.
    bool is_alone;           // True to compute a unit's values from its pairs alone, false to
                             // compute them from the pairs of all other units.
    const DipTimed **sorted; // [count]: the times by subject, start, round, block and frame.
    int *first_of;           // [subjects + 1]: where a subject's times begin in `sorted`.
    int *members;            // [subjects]: the subjects of one base whose moves are known.
    DipTimesCell *cells;
    int cell_count;
    DipTimesPair *pairs;
    int pair_count, visit_count;
    int window;    // Number of log ratios in the subject's running median; 0 if `repeats` is true.
    bool repeats;  // True if each frame has a median of its own (choose_smoothing).
    bool is_base;  // True if the subject is the base itself, which has no pairs.
    double *level; // [(1 + units) * frames]: levels from all units, then with each left out.
    double *missing; // [1 + units]: variance of the true levels along the path, minus the variance
                     // of the fitted levels, which smoothing makes smaller.
    double spread;   // As in DipTimesSubject.
    double doubt;    // As in DipTimesSubject.
    int base_visits; // Number of visits of the base.
    double *speed;   // [count]: speed of each visit (rounds_levels.c).
    double *weights; // [the greater of count and frames]: scratch.
    int *visits, *pair_frames;               // [count]: visits and frames of the pairs in use.
    double *logs, *smooth, *rest, *of_visit; // [the greater of count and frames]: scratch.
    double *means;                           // Scratch for Hodges and Lehmann's estimate.
    double *ratio;                           // [frames]: smoothed log ratio.
    double *time;                            // [frames]: ms, or scratch.
} DipTimesWork;

// The estimated variance of a base is averaged with the mean variance of its subjects. The weights
// are degrees of freedom: the number of units - 1 for the estimate, and this number for the mean.
#define DIP_TIMES_BASE_DEGREES 1.0

// Standard error of a logarithm that is added to every estimate. It stands for errors that are the
// same in all units of a measurement, so that no difference between units shows them.
#define DIP_TIMES_LEAST_ERROR 0.001

// The standard deviation of normally distributed values is this many times the median of their
// distances from their median.
#define DIP_TIMES_MAD_TO_SD 1.4826

static inline int dip_times_unit(const DipTimes *times, const DipTimed *timed) {
    return times->starts > 1 ? timed->start : timed->round;
}

// Returns the index of a frame's round among the rounds of all starts.
static inline int dip_times_round(const DipTimes *times, const DipTimed *timed) {
    return timed->start * times->rounds + timed->round;
}

static inline bool dip_times_same_visit(const DipTimed *a, const DipTimed *b) {
    return a->start == b->start && a->round == b->round && a->block == b->block;
}

static inline double *dip_times_moves(const DipTimesFit *fit, int subject, int unit) {
    return fit->moves +
           ((size_t)subject * (size_t)fit->units + (size_t)unit) * DIP_TIMES_VALUE_COUNT;
}

// Returns the variance of the noise in the levels of single frames, without the noise that all
// frames have in common. Computes it from how far levels move when a unit is left out (the
// jackknife), and halves the result: for a median, the jackknife's variance is twice too large
// (Efron 1982, The Jackknife, the Bootstrap and Other Resampling Plans, chapter 3), and a robust
// fit to few cells is like a median. levels: `frames` levels of all units, then those without each
// unit in turn; NAN: not known.
double dip_times_noise_of_levels(const double *levels, int frames, int units);

// Replaces values that are NAN: interpolates linearly between the nearest known values, and repeats
// the first and last known values at the ends.
void dip_times_fill_gaps(double *values, int count);

// Fits the levels of a base's frames. Fills w->level, w->missing, and the level_... fields of
// w->fit->bases[base].
void dip_times_fit_levels(DipTimesWork *w, int base);

#endif
