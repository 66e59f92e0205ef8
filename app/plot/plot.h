// Line plots as self-contained SVG. They bring a white background, so they are legible on light and
// dark pages.
#ifndef DIP_APP_PLOT_PLOT_H
#define DIP_APP_PLOT_PLOT_H

#include "renderer/base/error.h"

#include <stdbool.h>
#include <stdio.h>

enum { DIP_PLOT_MAX_SERIES = 12 };

// One line with a mark at each point. Everything is borrowed. With more than four series, bars are
// left out, since they would hide each other.
typedef struct DipPlotSeries {
    const char *name; // For the legend.
    const double *x;  // Ascending.
    const double *y;
    const double *low; // Lower ends of the bars; NULL for none.
    const double *high;
    int count;
    bool marks_only;           // Draw no line between the points.
    const char *const *labels; // Below and left of each point; NULL for none.
} DipPlotSeries;

// All texts are borrowed. Values on a logarithmic axis must be above 0. A linear y axis begins at
// 0.
typedef struct DipPlot {
    const char *title;
    const char *subtitle; // What is shown, and how often it was measured.
    const char *x_title;  // With the unit.
    const char *y_title;
    bool log_x;
    bool log_y;
    const DipPlotSeries
        *series;      // The first DIP_PLOT_MAX_SERIES are drawn; the plot says if not all.
    int series_count; // At least 1. Each series has at least one point.
} DipPlot;

// Prints the <svg> element alone, to be part of a page.
void dip_plot_print(FILE *out, const DipPlot *plot);

// Writes the file whole or not at all.
bool dip_plot_write(const char *file, const DipPlot *plot, DipError *err);

#endif
