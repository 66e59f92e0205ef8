// Declares what the files of the fit share: intermediate values and memory. Private to this folder.
//
// A unit is a start of the program, or a round if there is one start. Estimates are made anew with
// each unit left out; how far they move shows how well they are known (the jackknife).
#ifndef DIP_APP_MEASURE_STATS_ROUNDS_FIT_PRIVATE_H
#define DIP_APP_MEASURE_STATS_ROUNDS_FIT_PRIVATE_H

#include "app/measure/stats/rounds.h"

#include <math.h>

// The values that are fitted: the mean, the 95th percentile and the worst of the times of a
// subject's frames, each divided by the base's mean time.
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

// The base's times of one frame in one moment.
typedef struct DipTimesCell {
    int frame;
    int moment;
    int visit;
    int unit;
    double log_ms;
    double weight; // More for more visits.
    double trust;  // 0 to 1: how well it agrees with the fit.
} DipTimesCell;

// A moment: those visits of the base in a round that draw the same frames.
typedef struct DipTimesMoment {
    int round;       // Counted over all starts.
    int first_frame; // The first frame that the visits draw.
} DipTimesMoment;

typedef struct DipTimesBase {
    double level_ms; // Mean over the frames.
    double level_error;
    double level_degrees;
    // Mean over the subjects of the variance that each contributes to a unit.
    double pooled[DIP_TIMES_VALUE_COUNT];
    double pooled_degrees;                  // For how many degrees of freedom `pooled` counts.
    double variance[DIP_TIMES_VALUE_COUNT]; // Variance that the base contributes to a unit.
} DipTimesBase;

typedef struct DipTimesSubject {
    int base;
    int timed, kept;
    double spread;                          // See dip_times_spread.
    double doubt;                           // Variance of what is not known of a single frame.
    double logs[DIP_TIMES_VALUE_COUNT];     // Logarithms of the values.
    double variance[DIP_TIMES_VALUE_COUNT]; // Variance that the subject contributes to a unit.
    double shares[DIP_TIMED_PARTS];
} DipTimesSubject;

struct DipTimesFit {
    int frames;
    int units;     // Number of starts, or of rounds if there is one start.
    double excess; // Factor by which the variance of units is too great.
    DipTimesSubject *subjects;
    DipTimesBase *bases; // [subject]; only those of bases are used.
    double *frame_ms;    // [subject * frames + frame]
    // How far a unit moves a value, as a logarithm: [(subject * units + unit) *
    // DIP_TIMES_VALUE_COUNT + v].
    double *moves;
};

// Memory and intermediate values of a fit.
typedef struct DipTimesWork {
    const DipTimes *times;
    DipTimesFit *fit;
    int part;      // The part of the times in which subjects differ; -1: they differ in all parts.
    bool is_alone; // True if a set has the pairs of one unit alone; otherwise it lacks them.
    const DipTimed **sorted; // [count]: the times by subject, round, block and frame.
    int *first_of;           // [subjects + 1]: where a subject's times begin in `sorted`.
    int *members;            // [subjects]: those of a base whose moves are known.
    DipTimesCell *cells;
    int cell_count;
    DipTimesPair *pairs;
    int pair_count, visit_count;
    int window;      // Frames of the running median of the subject's log ratios.
    bool repeats;    // True if most frames were timed several times.
    bool is_base;    // True if the subject is the base itself, which has no pairs.
    double *level;   // [(1 + units) * frames]: log ms, with all units, then with each left out.
    double *missing; // [1 + units]: how much greater the variance of the true levels is.
    double spread;   // Of the subject's visits.
    double doubt;    // Of the subject's frames.
    DipTimesMoment *moments; // [count]
    int moment_count, base_visits;
    double *speed;                           // [count]: of moments.
    double *weights;                         // [the greater of count and frames]
    int *visits, *pair_frames;               // [count]: of the pairs in use.
    double *logs, *smooth, *rest, *of_visit; // [count] each.
    double *means;                           // Scratch for Hodges and Lehmann's estimate.
    double *ratio;                           // [frames]: smoothed log ratio.
    double *time;                            // [frames]
} DipTimesWork;

// A base is expected to vary as much as the other subjects do. This expectation counts as much as
// this many units.
#define DIP_TIMES_BASE_DEGREES 1.0

// An error that repetition within one log never shows, as a logarithm.
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

static inline bool dip_times_same_visit(const DipTimed *a, const DipTimed *b) {
    return a->start == b->start && a->round == b->round && a->block == b->block;
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
