// What can be chosen from reports (app/report/choice.h): their combinations with times and errors.
#ifndef DIP_APP_REPORT_CANDIDATES_H
#define DIP_APP_REPORT_CANDIDATES_H

#include "app/report/report.h"

#ifdef __cplusplus
extern "C" {
#endif

// Lists the measured combinations of a report that have both a time and an error, in the order of
// the report; `row` is the report's row. The list belongs to the caller, who frees it with
// dip_candidates_free even after a failure. Fails with DIP_ERROR_MEMORY.
bool dip_candidates_of(const DipCostReport *report, DipTimeKind kind, DipCandidates *candidates,
                       DipError *err);

// Lists report->predicted; `row` is the index there. measured: a combination that was measured
// later has its measured time and error; otherwise those that were predicted.
bool dip_candidates_of_predictions(const DipCostReport *report, DipTimeKind kind, bool measured,
                                   DipCandidates *candidates, DipError *err);

// Lists the predictions that a page shows, in order of time: all, or if there are too many those
// that were measured later and the front of what was predicted. `row` is the index of the
// prediction. The caller frees the list even after a failure. Returns false when memory runs out.
enum { DIP_CANDIDATES_LISTED = 500 };
bool dip_candidates_to_list(const DipCostReport *report, DipCandidates *listed);
void dip_candidates_free(DipCandidates *candidates);

// Returns the candidate of a measured row, with its time of a kind.
DipCandidate dip_candidate_of_row(const DipCostReport *report, int row, DipTimeKind kind);

#ifdef __cplusplus
}
#endif

#endif
