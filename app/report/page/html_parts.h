// Parts of the HTML page: its sections, and the tables and figures that they share. The scripts of
// the page (app/cost/page/) find measurements by the attribute data-row, which holds the index of a
// row of the report, and sets of pictures by the attribute data-set.
#ifndef DIP_APP_REPORT_PAGE_HTML_PARTS_H
#define DIP_APP_REPORT_PAGE_HTML_PARTS_H

#include "app/report/page/html_points.h"
#include "app/report/report.h"
#include "app/report/page/report_pictures.h"

#include <stdio.h>

// A section or a table with the class "wide" is printed on pages in landscape.

// --- tables (html_tables.c) --------------------------------------------------------------------

// Begins a table. `id` is the table's name, and the name of the file that its CSV is saved to.
// `set` is the set of pictures of its rows; NULL for none. The caller writes the caption between
// this function and dip_html_columns_begin.
void dip_html_table_begin(FILE *out, const char *id, const char *set);
void dip_html_columns_begin(FILE *out);

// Writes the header of a column. `unit` may be NULL.
void dip_html_column(FILE *out, const char *title, const char *unit);
void dip_html_text_column(FILE *out, const char *title);
void dip_html_columns_end(FILE *out);

// Begins a line of a table that shows a row of the report, or none (-1).
void dip_html_line_begin(FILE *out, int row);
void dip_html_table_end(FILE *out);

// --- rows (html_rows.c) ------------------------------------------------------------------------

// Writes settings, or those of a row.
void dip_html_quality(const DipQuality *quality, FILE *out);
void dip_html_settings(const DipCostReport *report, int row, FILE *out);

// Formats what a plot says about a row on one line: settings, path, time and errors.
void dip_html_row_title(const DipCostReport *report, int row, char text[DIP_HTML_TITLE_ROOM]);

// Formats settings with blanks, at which browsers may break the line.
void dip_html_quality_text(const DipQuality *quality, char text[DIP_HTML_TITLE_ROOM]);

// Writes the element with what the scripts know about each row, as JSON.
void dip_html_measurements(const DipCostReport *report, FILE *out);

// Writes a set of pictures, if it has any. `name` is the set's attribute data-set. `sweep` names
// the steps; if it is NULL, captions are settings.
void dip_html_pictures(const DipCostReport *report, const DipCostPictureSet *set, const char *name,
                       const DipCostSweep *sweep, FILE *out);

// --- sections ----------------------------------------------------------------------------------

void dip_html_head(const DipCostReport *report, FILE *out);
void dip_html_advice(const DipCostReport *report, FILE *out);

// Time against error: the plot, the Pareto front, all combinations and the pictures of the front,
// if `pictures` is not NULL. Returns false when memory runs out.
bool dip_html_front(const DipCostReport *report, const DipCostPictures *pictures, FILE *out);

// Time and error along the default path, of the baseline and of the advised combinations. Nothing
// is written without times or combinations. Returns false when memory runs out.
bool dip_html_path(const DipCostReport *report, FILE *out);

// Predicted combinations. Nothing is written if there are none. Both functions return false when
// memory runs out. The points are those of combinations that were only predicted; free them even
// after a failure.
bool dip_html_predictions(const DipCostReport *report, FILE *out);
bool dip_html_predicted_points(const DipCostReport *report, DipHtmlPoints *points);

// Interactions of combined settings. Nothing is written if there are none.
void dip_html_interactions(const DipCostReport *report, FILE *out);
void dip_html_sweeps(const DipCostReport *report, const DipCostPictures *pictures, FILE *out);
void dip_html_regions(const DipCostReport *report, FILE *out);

// How FLIP is distributed over pixels. Nothing is written if that is known of no row.
bool dip_html_has_tails(const DipCostReport *report);
void dip_html_tails(const DipCostReport *report, FILE *out);
void dip_html_work(const DipCostReport *report, FILE *out);
void dip_html_truth(const DipCostReport *report, FILE *out);
void dip_html_words(const DipCostReport *report, FILE *out);

#endif
