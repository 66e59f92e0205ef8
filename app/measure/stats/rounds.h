// Computes ratios and times along a path from a log of timed frames, and chooses the frames that a
// round draws.
//
// A subject is something whose frames are timed, and its base is the subject with which it is
// compared (app/measure/timing/driver.h). A visit draws a few frames of one subject, one after
// another. A block holds visits of a few subjects and one of their base, which draw the same
// frames. What slows down one frame of a visit slows down the others, too, and the rounds of one
// start of the program are alike in the same way. Intervals are therefore made from whole starts,
// or from whole rounds if there is only one start, never from single frames.
//
// All functions are thread-safe.
#ifndef DIP_APP_MEASURE_STATS_ROUNDS_H
#define DIP_APP_MEASURE_STATS_ROUNDS_H

#include "renderer/base/api.h"
#include "app/measure/stats/estimate.h"
#include "renderer/base/error.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { DIP_TIMED_PARTS = 4, DIP_TIMED_MOST_STARTS = 64 };

// A frame whose threads waited for a core for more than this share of its time, summed over the
// threads, is disturbed.
#define DIP_TIMED_MOST_WAIT 0.2

// --- which frames a round draws ------------------------------------------------------------------

// Deals `frames` frames of a path to `rounds` rounds at random from the seed, so that a slow moment
// of the machine does not fall on one part of the path. `rounds` counts the rounds of all starts:
// the index of a round is start * rounds of a start + round. Writes round_of[copy * frames + frame]
// for copy 0 to copies - 1 (at most `rounds`). Copy 0 is the round in which every subject and its
// base draw the frame; in the rounds of the other copies, the base alone draws it once more. The
// rounds of one frame's copies are distinct. In each copy, a round has frames / rounds frames or
// one more, one in each stretch of `rounds` successive frames. dip_times_fit wants 3 copies. Fails
// with DIP_ERROR_MEMORY.
DIP_API bool dip_rounds_deal(int frames, int rounds, int copies, uint64_t seed, int *round_of,
                             DipError *err);

// --- the log -------------------------------------------------------------------------------------

// One timed frame. Visits of one block in one round of one start are compared with each other; the
// blocks of a round have different numbers. A frame that was drawn again has another block.
typedef struct DipTimed {
    int subject;
    int start;
    int round; // Index of the round within its start, 0 to rounds - 1.
    int block;
    int frame;        // Index of the frame on the path.
    int64_t begin_ns; // When its visit began, since the measurement began.
    double ms;
    double wait;     // Waiting time of all threads / ms.
    double cpu_ms;   // Processor time of all threads.
    double switches; // Involuntary context switches.
    double parts_ms[DIP_TIMED_PARTS];
} DipTimed;

typedef struct DipTimes { // Borrowed.
    const DipTimed *list;
    int count;
    int subjects;
    int starts;
    int rounds; // Of each start.
    int frames;
    const int *base_of; // [subject]; a base is its own base.
    bool complete;      // Every round draws every frame of every subject.
} DipTimes;

// --- ratios and times ----------------------------------------------------------------------------

// A fit holds what is computed once from all times: how long every frame of a base takes, how fast
// every round was, the ratios of all subjects, and how far these ratios move when a start, or a
// round if there is only one start, is left out. In a complete log, the ratio of each start is
// known, so its distance from the mean of the starts is taken instead. A fit holds no reference to
// the times.
typedef struct DipTimesFit DipTimesFit;

// Fails with DIP_ERROR_MEMORY.
DIP_API DipTimesFit *dip_times_fit(const DipTimes *times, DipError *err);

// The same, but takes as a subject's time that of its base plus what one part takes longer, as if
// the two differed in this part only.
DIP_API DipTimesFit *dip_times_fit_part(const DipTimes *times, int part, DipError *err);

DIP_API void dip_times_fit_free(DipTimesFit **fit);

// Returns the ratio of the mean time of a subject's frames to that of its base. Unknown (NAN) if
// the subject has no time beside its base. Without a second start or round it has no interval.
DIP_API DipEstimate dip_times_ratio(const DipTimesFit *fit, int subject);

// The same of two subjects that share a base; `other` may be the base.
DIP_API DipEstimate dip_times_ratio_of(const DipTimesFit *fit, int subject, int other);

// Returns how far a subject's ratio differs from visit to visit: 1.4826 times the median distance
// of the visits' log ratios from their median, after what changes along the path was taken off. For
// a subject that draws what its base draws (A/A), this tells how noisy the machine is. NAN for
// fewer than two visits.
DIP_API double dip_times_spread(const DipTimesFit *fit, int subject);

// A subject's times along the path, in milliseconds at the machine's usual speed in this log.
typedef struct DipAlong {
    DipEstimate mean_ms;
    DipEstimate p95_ms; // 95th percentile over the frames.
    DipEstimate worst_ms;
    // Standard error of the logarithm of the base's mean time, which all subjects of one base
    // share. It is part of the errors above; NAN if it is not known.
    double level_error;
    int timed; // Number of the subject's times.
    int kept;  // Number of those that were not disturbed.
} DipAlong;

DIP_API DipAlong dip_times_along(const DipTimesFit *fit, int subject);

// Returns the shares of the subject's parts in its time, [DIP_TIMED_PARTS], borrowed; all 0 if the
// log has no parts.
DIP_API const double *dip_times_shares(const DipTimesFit *fit, int subject);

// Returns the times from which dip_times_along makes its values: [frame], borrowed.
DIP_API const double *dip_times_frames(const DipTimesFit *fit, int subject);

#ifdef __cplusplus
}
#endif

#endif
