// The report as one page that needs no other file.
#ifndef DIP_APP_COST_HTML_H
#define DIP_APP_COST_HTML_H

#include "app/cost/gallery.h"
#include "app/cost/report.h"

// gallery NULL: without pictures.
bool dip_cost_write_html(const DipCostReport *report, const DipCostGallery *gallery,
                         const char *file, DipError *err);

#endif
