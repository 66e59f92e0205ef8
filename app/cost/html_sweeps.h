// The part of the page that shows the sweeps: a section for each, then tables of all their errors
// by region and of their work.
#ifndef DIP_APP_COST_HTML_SWEEPS_H
#define DIP_APP_COST_HTML_SWEEPS_H

#include "app/cost/report.h"
#include "app/cost/report_pictures.h"

#include <stdio.h>

// `pictures` may be NULL: then there are none.
void dip_cost_write_html_sweeps(const DipCostReport *report, const DipCostPictures *pictures,
                                FILE *out);

#endif
