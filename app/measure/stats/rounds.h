// Ratios and times along a path, from a log of visits; and which frames a round draws.
//
// A visit draws a few frames of one subject, one after another, beside a visit of the subject's
// base that draws the same frames (a block). Frames of a visit share their luck, and so do the
// rounds of one start of the program. Intervals are therefore made from whole starts, or from whole
// rounds if there is only one start, never from single frames.
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

// Deals `frames` frames of a path to `rounds` rounds (all starts' rounds together: the index is
// start * rounds of a start + round) at random from the seed, so that no part of the path belongs
// to one moment. Writes round_of[copy * frames + frame] for copy 0 to copies - 1 (at most
// `rounds`): copy 0 is the round in which every subject and its base draw the frame, and the other
// copies are rounds in which the base alone draws it once more. The rounds of one frame's copies
// are distinct. In each copy, a round has frames / rounds frames or one more, one in each stretch
// of `rounds` successive frames. dip_times_fit wants 3 copies. Fails with DIP_ERROR_MEMORY.
DIP_API bool dip_rounds_deal(int frames, int rounds, int copies, uint64_t seed, int *round_of,
                             DipError *err);

// --- the log -------------------------------------------------------------------------------------

// One timed frame. Visits of one block in one round of one start are compared with each other; the
// blocks of a round have different numbers. A frame that was drawn again has another block.
typedef struct DipTimed {
    int subject;
    int start;
    int round; // Of the start, 0 to rounds - 1.
    int block;
    int frame;        // On the path.
    int64_t begin_ns; // Of its visit, since the measurement began.
    double ms;
    double wait; // Waiting time of all threads / ms.
    double cpu_ms;
    double switches; // Involuntary ones.
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

// What is computed once from all times: the base's level of every frame, the speed of every round,
// the ratios of all subjects, and how far these move when a start, or a round if there is only one
// start, is left out. Of a complete log, each start alone tells how large a ratio is, so that its
// distance from the mean of the starts is taken instead. Holds no reference to the times.
typedef struct DipTimesFit DipTimesFit;

// Fails with DIP_ERROR_MEMORY.
DIP_API DipTimesFit *dip_times_fit(const DipTimes *times, DipError *err);

// The same, as if a subject differed from its base in one part of its time only: its time is that
// of the base and what the part takes longer.
DIP_API DipTimesFit *dip_times_fit_part(const DipTimes *times, int part, DipError *err);

DIP_API void dip_times_fit_free(DipTimesFit **fit);

// Returns the ratio of the mean time of a subject's frames to that of its base. Unknown (NAN) if
// the subject has no time beside its base. Without a second start or round it has no interval.
DIP_API DipEstimate dip_times_ratio(const DipTimesFit *fit, int subject);

// The same of two subjects that share a base; `other` may be the base.
DIP_API DipEstimate dip_times_ratio_of(const DipTimesFit *fit, int subject, int other);

// Returns how far a subject's ratio lies apart from visit to visit: 1.4826 times the median
// distance of the visits' log ratios from their median, after what changes along the path was taken
// off. For a subject that draws what its base draws (A/A), it tells how noisy the machine is. NAN
// for fewer than two visits.
DIP_API double dip_times_spread(const DipTimesFit *fit, int subject);

// A subject's times along the path, in milliseconds at the machine's usual speed in this log.
typedef struct DipAlong {
    DipEstimate mean_ms;
    DipEstimate p95_ms; // 95th percentile over the frames.
    DipEstimate worst_ms;
    // Standard error of the logarithm of the base's level, which all subjects of one base share. It
    // is part of the errors above; NAN if it is not known.
    double level_error;
    double moment; // Standard deviation of the rounds' speed, as a logarithm; NAN for one round.
    int kept;      // Number of frame times that were not disturbed, and
    int timed;     // number of all.
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
