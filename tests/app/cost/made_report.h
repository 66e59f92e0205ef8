// A cost report with made-up numbers, for tests.
#ifndef DIP_TESTS_APP_COST_MADE_REPORT_H
#define DIP_TESTS_APP_COST_MADE_REPORT_H

#include "app/cost/report.h"

// Makes a report with two paths, three viewpoints and one sweep of AA. Its rows are aa=none, a
// second aa=none for the A/A test, aa=2 and aa=4. All errors differ. In each of `rounds` rounds,
// row r takes r + 1 ms.
void dip_made_report(DipCostReport *report, int rounds);

#endif
