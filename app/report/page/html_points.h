// The points of a series of the plot in the HTML page.
#ifndef DIP_APP_REPORT_PAGE_HTML_POINTS_H
#define DIP_APP_REPORT_PAGE_HTML_POINTS_H

#include "app/report/report.h"
#include "app/report/page/plot.h"

enum { DIP_HTML_LABEL_ROOM = 12, DIP_HTML_TITLE_ROOM = 512 };

// All arrays are owned.
typedef struct DipHtmlPoints {
    int *rows; // Rows of the report, or -1 for a combination without a row.
    int count;
    double *x;           // Mean time of a frame, ms.
    double *y;           // FLIP.
    const char **labels; // The numbers 1, 2, ...
    char (*label_texts)[DIP_HTML_LABEL_ROOM];
    char **titles;
} DipHtmlPoints;

// Allocates room for points. Free the points even if this function returns false because memory ran
// out.
bool dip_html_points_alloc(DipHtmlPoints *points, int room);
void dip_html_points_free(DipHtmlPoints *points);

// Adds a point. The axes are logarithmic, so a FLIP
// of 0 is plotted as the least that is told apart. Returns false when memory runs out.
bool dip_html_points_add(DipHtmlPoints *points, int row, double ms, double flip, const char *title);

// Returns a series that borrows the points and both texts.
DipPlotSeries dip_html_points_series(const DipHtmlPoints *points, const char *name,
                                     const char *style);

#endif
