// Rows whose pictures are the same. Where a setting changes nothing in a scene, for example
// adaptive AA without alpha-clipped surfaces, several combinations of settings draw the same
// pictures.
#ifndef DIP_APP_REPORT_SAME_PICTURES_H
#define DIP_APP_REPORT_SAME_PICTURES_H

#include "app/report/report.h"

// True if two rows of one path are known to have the same pictures (by hash) at every viewpoint.
// False if a viewpoint of either row has not been judged.
bool dip_cost_same_pictures(const DipCostReport *report, int a, int b);

// Makes combinations with the same pictures one row: the one with the fewest settings off their
// defaults stays, and the others are listed in report->same. Call it once every viewpoint has been
// judged. If the report has times, estimate them again afterwards. Fails with DIP_ERROR_MEMORY.
bool dip_cost_join_same_pictures(DipCostReport *report, DipError *err);

#endif
