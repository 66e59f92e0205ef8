// Writes the report as one HTML page that needs no other file. Scripts in the page sort and filter
// its tables and show pictures beside the truth (the converged picture). The page is complete
// without its scripts.
#ifndef DIP_APP_REPORT_PAGE_HTML_H
#define DIP_APP_REPORT_PAGE_HTML_H

#include "app/report/report.h"
#include "app/report/page/report_pictures.h"

// Writes the file whole or not at all. If `pictures` is NULL, the page has no pictures.
bool dip_cost_write_html(const DipCostReport *report, const DipCostPictures *pictures,
                         const char *file, DipError *err);

#endif
