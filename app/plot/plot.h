// Line plots as SVG: one self-contained file, legible on light and dark pages alike, as it brings
// its own white ground.
#ifndef DIP_APP_PLOT_PLOT_H
#define DIP_APP_PLOT_PLOT_H

#include "renderer/base/error.h"

#include <stdbool.h>
#include <stdio.h>

enum { DIP_PLOT_MAX_SERIES = 12 };

// One line with a mark at each point. x ascends. low and high, of a bar at each point, may be NULL;
// bars are left out where more than four series would hide each other.
typedef struct DipPlotSeries {
    const char *name; // for the legend
    const double *x;
    const double *y;
    const double *low;
    const double *high;
    int count;
    bool marks_only;           // no line between the points
    const char *const *labels; // below and left of each point; NULL: none
} DipPlotSeries;

// All texts are borrowed. On a logarithmic axis every value is above 0; a linear y begins at 0.
typedef struct DipPlot {
    const char *title;
    const char *subtitle; // what is shown and how often it was measured
    const char *x_title;  // with the unit
    const char *y_title;
    bool log_x;
    bool log_y;
    const DipPlotSeries *series; // only the first DIP_PLOT_MAX_SERIES are drawn; the file says so
    int series_count;            // at least 1, with at least one point each
} DipPlot;

// The <svg> element alone, for a page that has more.
void dip_plot_print(FILE *out, const DipPlot *plot);

// Writes the file whole or not at all.
bool dip_plot_write(const char *file, const DipPlot *plot, DipError *err);

#endif
