// Writes the parts of the HTML page that terminals do not have. The scripts of the page
// (app/report/page/web/) find measurements by the attribute data-row, which holds the index of a
// row of the report, and sets of pictures by the attribute data-set.
#ifndef DIP_APP_REPORT_PAGE_HTML_PARTS_H
#define DIP_APP_REPORT_PAGE_HTML_PARTS_H

#include "app/report/format/sections.h"
#include "app/report/page/plot.h"
#include "app/report/page/report_pictures.h"

// --- rows (html_rows.c) ------------------------------------------------------------------------

// Formats what a plot says about a row on one line: settings, path, time and errors.
enum { DIP_HTML_TITLE_BYTES = 512 };
void dip_html_row_title(const DipCostReport *report, int row, char text[DIP_HTML_TITLE_BYTES]);

// Writes an element that holds what the scripts know about each row, as JSON.
void dip_html_measurements(const DipCostReport *report, FILE *out);

// Writes a set of pictures, if it has any. `name` is the value of its attribute data-set. Captions
// are the steps of `sweep`, or settings if `sweep` is NULL.
void dip_html_pictures(const DipCostReport *report, const DipCostPictureSet *set, const char *name,
                       const DipCostSweep *sweep, FILE *out);

// --- sections ----------------------------------------------------------------------------------

// Writes the section on time against error: the plot, the Pareto front, all combinations, the
// pictures of the front if `pictures` is not NULL, and predictions. With fewer than two candidates,
// writes only the predictions. Returns false when memory runs out.
bool dip_html_front(DipForm *form, const DipCostReport *report, const DipCostPictures *pictures);

// Writes plots of time and error along path 0, for the baseline and the advised combinations. If no
// combination but the baseline is advised, the knee of the front is plotted instead. Errors at a
// single viewpoint get no plot. Writes nothing if the report has no times or no combinations.
// Returns false when memory runs out.
bool dip_html_path(DipForm *form, const DipCostReport *report);

// Writes each sweep (all steps of one setting): bars of time and error, a table and, if `pictures`
// is not NULL, pictures.
void dip_html_sweeps(DipForm *form, const DipCostReport *report, const DipCostPictures *pictures);

#endif
