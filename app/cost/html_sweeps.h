// The part of the HTML page that shows the sweeps. A sweep is all steps of one setting. Each sweep
// has a section. A table of the errors of all sweeps by region and a table of their work follow.
#ifndef DIP_APP_COST_HTML_SWEEPS_H
#define DIP_APP_COST_HTML_SWEEPS_H

#include "app/cost/report.h"
#include "app/cost/report_pictures.h"

#include <stdio.h>

// If `pictures` is NULL, the sections have no pictures.
void dip_cost_write_html_sweeps(const DipCostReport *report, const DipCostPictures *pictures,
                                FILE *out);

#endif
