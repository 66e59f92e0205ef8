// A cost report with made-up numbers, for tests.
#ifndef DIP_TESTS_APP_COST_MADE_REPORT_H
#define DIP_TESTS_APP_COST_MADE_REPORT_H

#include "app/report/report.h"

// Makes a report with two paths, three viewpoints and one sweep of AA. Its rows on path 0 are
// aa=none, a second aa=none for the A/A test, aa=2 and aa=4; the only row of path 1 is aa=none. All
// errors differ. In each of `rounds` rounds (none, or at least 2), rows with aa=none take 1 ms,
// aa=2 takes 3 ms and aa=4 takes 4 ms. The report lists three warnings and leaves out two.
void dip_made_report(DipCostReport *report, int rounds);

// Gives a row the same time in all frames, beside a baseline of 1 ms.
void dip_made_times(DipCostReport *report, int row, double ms);

// Gives one frame of a row its time and that of the base's frame beside it. A base's own frame
// takes base_ms.
void dip_made_frame(DipCostReport *report, int row, int frame, double ms, double base_ms);

// Returns a row's frame in the log. Borrowed until the next frame is made.
DipTimed *dip_made_timed(DipCostReport *report, int row, int frame);

// Adds a combination of settings on path 0, with the same time in all frames and the same FLIP at
// all viewpoints. Returns its row. The caller estimates the report's times afterwards.
int dip_made_combination(DipCostReport *report, const DipQuality *quality, double ms, double flip);

#endif
