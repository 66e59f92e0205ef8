// The work of a combination of settings that nobody counted, composed from combinations that were
// counted.
//
// Groups of settings change the work nearly independently of each other: the settings of samples
// (antialiasing, temporal AA, adaptive AA and its groups), anisotropic filtering with advanced AF,
// texture optimisation, mip detail, and instancing. The composed counters are those of the base,
// times the factor by which each group alone changes each counter.
#ifndef DIP_APP_REPORT_WORK_H
#define DIP_APP_REPORT_WORK_H

#include "app/report/report.h"

// Returns the counters [DIP_COST_COUNTER_COUNT] of a combination that was counted, or NULL. They
// are borrowed until dip_work_compose returns.
typedef const double *DipWorkFind(const void *context, const DipQuality *quality);

// Composes the counters of a combination. Takes the filtering settings together where that
// combination was counted, otherwise group by group. Returns false if the base or a group alone was
// not counted, or if the combination differs from the base in a setting of no group.
bool dip_work_compose(DipWorkFind *find, const void *context, const DipQuality *base,
                      const DipQuality *quality, double counters[DIP_COST_COUNTER_COUNT]);

// Returns the number of groups in which a combination differs from the base, or -1 if it differs in
// a setting of no group.
int dip_work_count_groups(const DipQuality *base, const DipQuality *quality);

#endif
