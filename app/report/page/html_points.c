// Collecting the points of a series.
#include "app/report/page/html_points.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool dip_html_points_alloc(DipHtmlPoints *points, int room) {
    const size_t count = (size_t)room + 1;
    points->rows = calloc(count, sizeof *points->rows);
    points->x = calloc(count, sizeof *points->x);
    points->y = calloc(count, sizeof *points->y);
    points->labels = calloc(count, sizeof *points->labels);
    points->label_texts = calloc(count, sizeof *points->label_texts);
    points->titles = calloc(count, sizeof *points->titles);
    return points->rows && points->x && points->y && points->labels && points->label_texts &&
           points->titles;
}

void dip_html_points_free(DipHtmlPoints *points) {
    for (int i = 0; points->titles && i < points->count; i++) {
        free(points->titles[i]);
    }
    free(points->rows);
    free(points->x);
    free(points->y);
    free(points->labels);
    free(points->label_texts);
    free(points->titles);
}

bool dip_html_points_add(DipHtmlPoints *points, int row, double ms, double flip,
                         const char *title) {
    static const double least_flip = 1e-7;
    const int i = points->count;
    points->titles[i] = strdup(title);
    if (!points->titles[i]) {
        return false;
    }
    points->count++;
    points->rows[i] = row;
    points->x[i] = ms;
    points->y[i] = fmax(flip, least_flip);
    snprintf(points->label_texts[i], DIP_HTML_LABEL_ROOM, "%d", i + 1);
    points->labels[i] = points->label_texts[i];
    return true;
}

DipPlotSeries dip_html_points_series(const DipHtmlPoints *points, const char *name,
                                     const char *style) {
    return (DipPlotSeries){.name = name,
                           .x = points->x,
                           .y = points->y,
                           .count = points->count,
                           .marks_only = true,
                           .rows = points->rows,
                           .titles = (const char *const *)points->titles,
                           .style = style};
}
