// Computes ratios and times along a path from a log of timed frames, and chooses the frames that a
// round draws.
//
// A subject is something whose frames are timed, for example the renderer with one set of quality
// settings. Its base is the subject with which it is compared. A measurement starts the program
// once or several times (a start); each start has the same number of rounds, and a round draws some
// or all frames of the path with every subject (app/measure/timing/driver.h). A visit draws a few
// frames of one subject, one after another. A block consists of one visit of each of a few subjects
// and one visit of their base. All of them draw the same frames; the base may draw others besides.
//
// What slows down one frame of a visit slows down the visit's other frames, too, and what slows
// down one round slows down the other rounds of the same start. Confidence intervals are therefore
// computed from whole starts, or from whole rounds if there is only one start, never from single
// frames.
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

// A frame is disturbed if its threads together waited for a core for more than this share of the
// frame's time.
#define DIP_TIMED_MOST_WAIT 0.2

// --- which frames a round draws ------------------------------------------------------------------

// Deals `frames` frames of a path to `rounds` rounds at random from the seed, so that a slow moment
// of the machine does not fall on one part of the path. `rounds` is the number of rounds of all
// starts together; round r of start s has the index s * (rounds per start) + r. Writes the index of
// a round to round_of[copy * frames + frame] for each copy from 0 to copies - 1 (copies <= rounds).
// In the round of copy 0, every subject and its base draw the frame. In the rounds of the other
// copies, only the base draws the frame, once more. The copies of a frame are in different rounds.
// In each copy, a round has frames / rounds frames, rounded down or up: one of each stretch of
// `rounds` successive frames. Diptych uses 3 copies, or fewer if there are fewer rounds. Fails with
// DIP_ERROR_MEMORY.
DIP_API bool dip_rounds_deal(int frames, int rounds, int copies, uint64_t seed, int *round_of,
                             DipError *err);

// --- the log -------------------------------------------------------------------------------------

// One timed frame. A subject's time of a frame is compared with its base's time of the same frame
// in the same start, round and block. The blocks of a round have different numbers. A frame that
// was drawn again has another block.
typedef struct DipTimed {
    int subject;
    int start;
    int round; // Index of the round within its start, 0 to rounds - 1.
    int block;
    int frame;        // Index of the frame on the path.
    int64_t begin_ns; // When the frame's visit began, from the beginning of the measurement on.
    double ms;        // Time that the frame took.
    double wait;      // Time that all threads together waited for a core, divided by `ms`.
    double cpu_ms;    // Processor time of all threads.
    double switches;  // Number of involuntary context switches.
    double parts_ms[DIP_TIMED_PARTS]; // Times of the parts of the work, for example of stages.
} DipTimed;

// All timed frames of a measurement. Both arrays are borrowed.
typedef struct DipTimes {
    const DipTimed *list;
    int count; // Length of the list.
    int subjects;
    int starts;
    int rounds;         // Rounds of each start.
    int frames;         // Frames of the path.
    const int *base_of; // [subject]: index of the subject's base. A base is its own base.
    bool complete;      // True if every round draws every frame of every subject.
} DipTimes;

// --- ratios and times ----------------------------------------------------------------------------

// Holds what is computed once from all times: how long every frame of a base takes, the ratios of
// the times of all subjects to those of their bases, and how well these ratios are known. The error
// of a ratio follows from how far the ratio moves when a start is left out, or a round if there is
// only one start. If every round draws all frames and there are several starts, each start has a
// ratio of its own, and the error follows from the differences between these. A fit holds no
// reference to the times.
typedef struct DipTimesFit DipTimesFit;

// Makes a fit, which the caller frees with dip_times_fit_free. Fails with DIP_ERROR_MEMORY.
DIP_API DipTimesFit *dip_times_fit(const DipTimes *times, DipError *err);

// Makes a fit as if a subject and its base differed in one part of their work only. The subject's
// time is taken to be the base's time plus the difference of this part's times. `part` is an index
// of DipTimed.parts_ms. Fails with DIP_ERROR_MEMORY.
DIP_API DipTimesFit *dip_times_fit_part(const DipTimes *times, int part, DipError *err);

DIP_API void dip_times_fit_free(DipTimesFit **fit);

// Returns the mean time of a subject's frames divided by the mean time of its base's frames. The
// ratio is NAN if no block has times of both. It has an interval only if at least two starts have
// times of both, or two rounds if there is only one start. The ratio of a base is 1, without an
// interval.
DIP_API DipEstimate dip_times_ratio(const DipTimesFit *fit, int subject);

// Returns the mean time of a subject's frames divided by that of another subject with the same
// base. `other` may also be the base itself.
DIP_API DipEstimate dip_times_ratio_of(const DipTimesFit *fit, int subject, int other);

// Returns how much a subject's ratio differs from visit to visit: 1.4826 times the median distance
// of the visits' log ratios from their median. Changes of the ratio along the path are subtracted
// before. For a subject that draws the same as its base (A/A), the value tells how noisy the
// machine is. Returns NAN for a base, or if there are fewer than two visits.
DIP_API double dip_times_spread(const DipTimesFit *fit, int subject);

// A subject's times along the path, in milliseconds at the machine's usual speed in this log.
typedef struct DipAlong {
    DipEstimate mean_ms;
    DipEstimate p95_ms;   // 95th percentile over the frames.
    DipEstimate worst_ms; // The slowest frame.
    // Standard error of the logarithm of the base's mean time, which all subjects of one base
    // share. The errors of the estimates above include it. NAN if it is not known.
    double level_error;
    int timed; // Number of the subject's times beside a time of its base; 0 for a base.
    int kept;  // Number of these times that were not disturbed.
} DipAlong;

DIP_API DipAlong dip_times_along(const DipTimesFit *fit, int subject);

// Returns which share of the subject's time each part of its work takes: DIP_TIMED_PARTS values,
// borrowed. All are 0 if the log has no times of parts.
DIP_API const double *dip_times_shares(const DipTimesFit *fit, int subject);

// Returns the time of each frame, in milliseconds, from which dip_times_along computes its values;
// NAN if it is not known. The array is borrowed.
DIP_API const double *dip_times_frames(const DipTimesFit *fit, int subject);

#ifdef __cplusplus
}
#endif

#endif
