// What the files of the fit share: intermediate values and memory. Private to this folder.
#ifndef DIP_APP_MEASURE_STATS_ROUNDS_FIT_H
#define DIP_APP_MEASURE_STATS_ROUNDS_FIT_H

#include "app/measure/stats/rounds.h"

#include <math.h>

// Of a subject's frames, over the base's mean time: their mean, 95th percentile and worst.
typedef enum DipTimesValue {
    DIP_TIMES_RATIO,
    DIP_TIMES_P95,
    DIP_TIMES_WORST,
    DIP_TIMES_VALUE_COUNT
} DipTimesValue;

// A timed frame of a subject beside its base.
typedef struct DipTimesPair {
    int frame;
    int visit; // Equal for the frames of one visit.
    int unit;
    double log_ratio;
} DipTimesPair;

// The base's times of one frame in a moment: in those visits of a round that draw the same frames.
typedef struct DipTimesCell {
    int frame;
    int moment;
    int visit;
    int unit;
    double log_ms;
    double weight; // More for more visits.
    double trust;  // 0 to 1: how well it agrees with the fit.
} DipTimesCell;

// A moment: its round (of all starts), and the first frame that its visits draw.
typedef struct DipTimesMoment {
    int round;
    int first_frame;
} DipTimesMoment;

typedef struct DipTimesBase {
    double level_ms; // Mean over the frames.
    double moment;   // As in DipAlong.
    double level_error;
    double level_degrees;
    double pooled[DIP_TIMES_VALUE_COUNT];   // Variance of a unit, of a subject's own luck: mean of
                                            // subjects.
    double pooled_degrees;                  // For how many degrees of freedom it counts.
    double variance[DIP_TIMES_VALUE_COUNT]; // Variance of a unit, of luck that all subjects share.
} DipTimesBase;

typedef struct DipTimesSubject {
    int base;
    int timed, kept;
    double spread;                          // See dip_times_spread.
    double doubt;                           // Variance of single frames about their neighbours.
    double logs[DIP_TIMES_VALUE_COUNT];     // Logarithms of the values.
    double variance[DIP_TIMES_VALUE_COUNT]; // Variance of a unit, of the subject's own luck.
    double shares[DIP_TIMED_PARTS];
} DipTimesSubject;

struct DipTimesFit {
    int frames;
    int units;     // Starts, or rounds if there is one start.
    double excess; // By which the variance of units is too great.
    DipTimesSubject *subjects;
    DipTimesBase *bases; // [subject], of those that are bases.
    double *frame_ms;    // [subject * frames + frame]
    // How far a unit moves a value, as a logarithm: [(subject * units + unit) *
    // DIP_TIMES_VALUE_COUNT + v].
    double *moves;
};

// Memory and intermediate values of a fit.
typedef struct DipTimesWork {
    const DipTimes *times;
    DipTimesFit *fit;
    int part;      // The part of the times in which subjects differ; -1: in all.
    bool is_alone; // A set has the pairs of one unit alone; otherwise it lacks them.
    int *order;    // [count]: indices of times, those of a subject by round, block and frame.
    int *first_of; // [subjects + 1]: where a subject's times begin in `order`.
    DipTimesCell *cells;
    int cell_count;
    DipTimesPair *pairs;
    int pair_count, visit_count;
    int window;      // Frames of the running median of the subject's log ratios.
    bool repeats;    // Most frames were timed several times.
    bool is_base;    // The subject is the base itself: it has no pairs.
    double *level;   // [(1 + units) * frames]: log ms, with all units and with each left out.
    double *missing; // [1 + units]: by how much more the variance of true levels is.
    double spread;   // Of the subject's visits.
    double doubt;    // Of the subject's frames.
    DipTimesMoment *moments; // [count]
    int moment_count, base_visits;
    double *speed;                           // [count]: of moments.
    double *weights;                         // [the greater of count and frames]
    int *visits, *pair_frames;               // [count]: of the pairs in use.
    double *logs, *smooth, *rest, *of_visit; // [count] each.
    double *means;                           // [visits (visits + 1) / 2]
    double *ratio;                           // [frames]: smoothed log ratio.
    double *time;                            // [frames]
} DipTimesWork;

// The base's own luck is expected to be that of the others, which counts as much as this many
// units.
#define DIP_TIMES_BASE_DEGREES 1.0

// What repetition within one log never shows.
#define DIP_TIMES_LEAST_ERROR 0.001

// The standard deviation of normally distributed values is this many times the median of their
// distances from their median.
#define DIP_TIMES_MAD_TO_SD 1.4826

static inline int dip_times_unit(const DipTimes *times, const DipTimed *timed) {
    return times->starts > 1 ? timed->start : timed->round;
}

// Returns the index of a frame's round among those of all starts.
static inline int dip_times_round(const DipTimes *times, const DipTimed *timed) {
    return timed->start * times->rounds + timed->round;
}

static inline double *dip_times_moves(const DipTimesFit *fit, int subject, int unit) {
    return fit->moves +
           ((size_t)subject * (size_t)fit->units + (size_t)unit) * DIP_TIMES_VALUE_COUNT;
}

// Fills values that are NAN from their neighbours: linear between them, constant beyond.
void dip_times_fill_gaps(double *values, int count);

// Fits the levels of a base's frames and the speeds of its rounds. Fills w->level, w->missing and,
// in the fit's bases[base], all about the level.
void dip_times_fit_levels(DipTimesWork *w, int base);

#endif
