// Advice per segment of the default path. The path is divided into segments, and each segment may
// have settings of its own, so that time is spent where it lowers the error most.
#ifndef DIP_APP_REPORT_SEGMENTS_H
#define DIP_APP_REPORT_SEGMENTS_H

#include "app/report/report.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { DIP_COST_MAX_SEGMENTS = 16 };

// A part of the path between two viewpoints' parts: a path has as many equal parts as viewpoints.
typedef struct DipCostSegment {
    double from; // Share of the path's duration, 0..1.
    double end;
    int first_frame; // Timed frames.
    int end_frame;
    int first_viewpoint;
    int end_viewpoint;
} DipCostSegment;

// Time and error of one combination in one segment.
typedef struct DipCostSegmentValue {
    double ms;    // Time of the segment's frames, of the kind that budgets are meant for.
    double bound; // Upper bound of ms: the row's bound over its value, times ms.
    double flip;  // Mean FLIP over the segment's viewpoints, at least the floor of the truths.
} DipCostSegmentValue;

typedef struct DipCostSegments {
    DipCostSegment list[DIP_COST_MAX_SEGMENTS];
    int count;
    int *rows; // Combinations whose error is known at every viewpoint. Owned.
    int row_count;
    DipCostSegmentValue *values; // [segment * row_count + index in rows]. Owned.
} DipCostSegments;

// The settings for one budget, in one segment after the other.
typedef struct DipCostSegmentAdvice {
    double budget_ms;
    int chosen[DIP_COST_MAX_SEGMENTS]; // Index in DipCostSegments.rows; -1 if nothing is advised.
    int fixed;                         // Best single combination for the whole path, or -1.
    double flip;                       // Mean FLIP along the path with the chosen ones.
    double fixed_flip;                 // The same with the single one.
    // Time with the chosen ones: the mean along the path for budgets of the mean, otherwise the
    // greatest time of a segment.
    double ms;
    double bound; // Upper bound of ms.
    double slope; // Budgets of the mean: how much 1 ms more would lower the mean FLIP.
} DipCostSegmentAdvice;

// Returns the number of segments if the user does not name one: as many as viewpoints and as timed
// frames, but at most 8. Returns 1 if no combination has errors at every viewpoint.
int dip_cost_default_segments(const DipCostReport *report);

// Divides the path into `count` segments and computes the combinations' times and errors there.
// Fails if a segment has no viewpoint or no timed frame (DIP_ERROR_RANGE), if no combination has
// errors at every viewpoint, or if memory runs out. Free *segments even after a failure.
bool dip_cost_segments_make(const DipCostReport *report, int count, DipCostSegments *segments,
                            DipError *err);
void dip_cost_segments_free(DipCostSegments *segments);

// Chooses settings for each segment. Budgets of the mean: the settings have equal slopes of error
// against time (app/measure/stats/spend.h), and the upper bound of the mean time along the path is
// at most the budget. Budgets of p95 and worst: each segment has the least error whose bound is at
// most the budget, so the whole path is within it, too. If the mean FLIP is not at least 1 % below
// that of the best single combination within the budget, or if a segment has no combination within
// the budget, every segment has the single one. Fails with DIP_ERROR_MEMORY.
bool dip_cost_segments_advise(const DipCostReport *report, const DipCostSegments *segments,
                              double budget_ms, DipCostSegmentAdvice *advice, DipError *err);

#ifdef __cplusplus
}
#endif

#endif
