// A report with made-up figures, for tests.
#ifndef DIP_TESTS_APP_COST_MADE_REPORT_H
#define DIP_TESTS_APP_COST_MADE_REPORT_H

#include "app/cost/report.h"

// Two paths, three places, rows for aa=none, 2, 4 (twice aa=none: the A/A row); one sweep of AA;
// every number different. Times are of `rounds` rounds: row r takes r + 1 ms.
void dip_made_report(DipCostReport *report, int rounds);

#endif
