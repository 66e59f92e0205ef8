// The part of the page that shows the sweeps (the steps of one setting each): a section for each
// sweep, then a table of all sweeps' errors by region and a table of their work.
#ifndef DIP_APP_COST_HTML_SWEEPS_H
#define DIP_APP_COST_HTML_SWEEPS_H

#include "app/cost/report.h"
#include "app/cost/report_pictures.h"

#include <stdio.h>

// If `pictures` is NULL, the sections have no pictures.
void dip_cost_write_html_sweeps(const DipCostReport *report, const DipCostPictures *pictures,
                                FILE *out);

#endif
