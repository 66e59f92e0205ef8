// A report with made-up figures, for tests.
#ifndef DIP_TESTS_APP_COST_MADE_REPORT_H
#define DIP_TESTS_APP_COST_MADE_REPORT_H

#include "app/cost/report.h"

// Makes a report with two paths, three viewpoints, rows for aa=none, 2 and 4 with a second aa=none
// as the A/A row, and one sweep of AA. All errors differ. In each of `rounds` rounds, row r takes
// r + 1 ms.
void dip_made_report(DipCostReport *report, int rounds);

#endif
