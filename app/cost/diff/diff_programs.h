// Timing two programs, or one program's settings beside its baseline, for `cost diff`.
#ifndef DIP_APP_COST_DIFF_DIFF_PROGRAMS_H
#define DIP_APP_COST_DIFF_DIFF_PROGRAMS_H

#include "app/cost/diff/diff.h"
#include "app/cost/diff/diff_options.h"

#ifdef __cplusplus
extern "C" {
#endif

// Draws the settings of `arguments` with both programs in turn, at every frame, and fills in the
// comparison. Fails if a program does not answer, if the user presses Ctrl-C or if memory runs out.
// On success the caller frees the comparison.
bool dip_cost_diff_programs(const DipCostDiffArguments *arguments, const char *const programs[2],
                            DipCostDiff *diff, DipError *err);

// Measures the rows of a report again with another program, as a report that has only these rows:
// the rows of the report's first path whose settings `arguments` lists. Each row's ratio is that to
// the report's baseline. The new report has no errors. Fails with DIP_ERROR_MISSING if the report
// has none of the rows or no times. On success the caller frees the new report.
bool dip_cost_diff_measure_report(const DipCostDiffArguments *arguments, const char *program,
                                  const DipCostReport *report, DipCostReport *measured,
                                  DipError *err);

#ifdef __cplusplus
}
#endif

#endif
