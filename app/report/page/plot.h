// Writes line plots as self-contained SVG. Their background is white, so they are legible on light
// and dark pages. A page may restyle them by their classes: plot, plot-paper, plot-grid, plot-axis,
// plot-note, series-0 and so on, point.
#ifndef DIP_APP_REPORT_PAGE_PLOT_H
#define DIP_APP_REPORT_PAGE_PLOT_H

#include "renderer/base/error.h"

#include <stdbool.h>
#include <stdio.h>

enum { DIP_PLOT_MAX_SERIES = 12 };

// A line of the plot. Each point has a mark and a vertical bar from low to high. Everything is
// borrowed. A plot of more than four series has no bars, because the bars would hide each other.
typedef struct DipPlotSeries {
    const char *name; // Name of the line in the legend.
    const double *x;  // Values, in ascending order unless marks_only is true.
    const double *y;
    const double *low; // Lower ends of the bars; NULL for none.
    const double *high;
    int count;
    bool marks_only;           // True if no line connects the points.
    bool numbered;             // True to write 1, 2, ... below and left of the points.
    const int *rows;           // Values of the points' attribute data-row, by which a page's script
                               // finds rows; -1 for a point without a row. NULL for none.
    const char *const *titles; // Texts that browsers show beside the pointer; NULL for none.
    const char *style;         // CSS class of the line; NULL means series-0, series-1, ...
} DipPlotSeries;

// All texts are borrowed. Values on a logarithmic axis must be above 0. A linear y axis begins at
// 0.
typedef struct DipPlot {
    const char *title;
    const char *subtitle; // Says what is shown and how often it was measured.
    const char *x_title;  // Title of the x axis, with its unit.
    const char *y_title;
    bool log_x;
    bool log_y;
    // Only the first DIP_PLOT_MAX_SERIES are drawn; the legend says how many are left out.
    const DipPlotSeries *series;
    int series_count; // At least 1. At least one series has a point.
    const char *set;  // Attribute data-set of the <svg> element; NULL means that it is empty.
} DipPlot;

// Prints only the <svg> element, for use in an HTML page.
void dip_plot_print(FILE *out, const DipPlot *plot);

// Writes the file whole or not at all.
bool dip_plot_write(const char *file, const DipPlot *plot, DipError *err);

#endif
