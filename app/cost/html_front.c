// Time against error in the HTML page: the plot of all combinations, and their tables.
#include "app/cost/html_parts.h"

#include "app/cost/front.h"
#include "app/plot/plot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LABEL_ROOM = 12 };

// What one series of the plot has for each of its points. All arrays are owned.
typedef struct Points {
    int *rows;
    int count;
    double *x;
    double *y;
    const char **labels;
    char (*label_texts)[LABEL_ROOM];
    char **titles;
} Points;

static void free_points(Points *points) {
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

static bool alloc_points(Points *points, int room) {
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

// Returns dip_html_row_title as a text. The caller frees it. Returns NULL when memory runs out.
static char *make_title(const DipCostReport *report, int row) {
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out) {
        return NULL;
    }
    dip_html_row_title(report, row, out);
    const bool made = !ferror(out);
    if (fclose(out) != 0 || !made) {
        free(text);
        return NULL;
    }
    return text;
}

// Fills in what belongs to the rows. The axes are logarithmic, so an error of 0 is plotted as the
// least error that is told apart.
static bool fill_points(const DipCostReport *report, Points *points) {
    static const double least_flip = 1e-7;
    bool made = true;
    for (int i = 0; i < points->count; i++) {
        const int row = points->rows[i];
        points->x[i] = dip_cost_ms(report, row);
        points->y[i] = fmax(dip_cost_row_metrics(report, row, 0).flip, least_flip);
        snprintf(points->label_texts[i], LABEL_ROOM, "%d", i + 1);
        points->labels[i] = points->label_texts[i];
        points->titles[i] = make_title(report, row);
        made = made && points->titles[i];
    }
    return made;
}

static bool contains(const Points *points, int row) {
    for (int i = 0; i < points->count; i++) {
        if (points->rows[i] == row) {
            return true;
        }
    }
    return false;
}

// Splits the combinations into the thinned Pareto front and all others.
static bool split(const DipCostReport *report, Points *front, Points *others) {
    int all[DIP_COST_MAX_ROWS];
    const int count = dip_cost_list_plotted(report, all);
    int kept[DIP_COST_MAX_ROWS];
    const int kept_count = dip_cost_list_front(report, kept);
    if (!alloc_points(front, kept_count) || !alloc_points(others, count)) {
        return false;
    }
    memcpy(front->rows, kept, (size_t)kept_count * sizeof *kept);
    front->count = kept_count;
    for (int i = 0; i < count; i++) {
        if (!contains(front, all[i])) {
            others->rows[others->count++] = all[i];
        }
    }
    return fill_points(report, front) && fill_points(report, others);
}

static DipPlotSeries series_of(const char *name, const Points *points) {
    return (DipPlotSeries){.name = name,
                           .x = points->x,
                           .y = points->y,
                           .count = points->count,
                           .rows = points->rows,
                           .titles = (const char *const *)points->titles};
}

static void write_plot(const DipCostReport *report, const Points *front, const Points *others,
                       FILE *out) {
    char subtitle[DIP_COST_TEXT];
    snprintf(subtitle, sizeof subtitle,
             "%d combinations on path %s, %dx%d pixels; mean of %d frames",
             front->count + others->count, report->paths[0], report->width, report->height,
             dip_cost_frame_count(report));
    DipPlotSeries series[2] = {series_of("other combinations", others),
                               series_of("Pareto front", front)};
    series[0].marks_only = true;
    series[1].labels = front->labels;
    // Every combination may be in the front; a series has at least one point.
    const int first = others->count == 0;
    const DipPlot plot = {
        .title = "Time against error",
        .subtitle = subtitle,
        .x_title = "time of a frame, ms",
        .y_title = "FLIP against the truth, mean",
        .log_x = true,
        .log_y = true,
        .series = series + first,
        .series_count = 2 - first,
        .set = "front",
    };
    fprintf(out, "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Plot of time "
                 "against error\">\n");
    dip_plot_print(out, &plot);
    fprintf(out, "</div>\n");
}

// --- tables ------------------------------------------------------------------------------------

static void write_front_table(const DipCostReport *report, const Points *front, FILE *out) {
    dip_html_table_begin(out, "pareto-front", " data-set=\"front\"");
    fprintf(out, "The Pareto front. The changes are those from the line before, in order of time.");
    dip_html_columns_begin(out);
    dip_html_text_column(out, "settings");
    dip_html_column(out, "number", "in the plot");
    dip_html_column(out, "mean", "ms");
    dip_html_column(out, "FLIP", NULL);
    dip_html_column(out, "RMSE", "linear");
    dip_html_column(out, "change of time", "ms");
    dip_html_column(out, "change of FLIP", NULL);
    dip_html_columns_end(out);
    for (int i = 0; i < front->count; i++) {
        const int row = front->rows[i];
        const DipMetrics f = dip_cost_row_metrics(report, row, 0);
        dip_html_line_begin(out, row);
        fprintf(out, "<th scope=\"row\">");
        dip_html_settings(report, row, out);
        fprintf(out, "</th><td>%d</td><td>%.2f</td><td>%.4f</td><td>%.5f</td>", i + 1, front->x[i],
                f.flip, f.rmse_lin);
        if (i > 0) {
            const double before = dip_cost_row_metrics(report, front->rows[i - 1], 0).flip;
            fprintf(out, "<td>%+.2f</td><td>%+.4f</td></tr>\n", front->x[i] - front->x[i - 1],
                    f.flip - before);
        } else {
            fprintf(out, "<td></td><td></td></tr>\n");
        }
    }
    dip_html_table_end(out);
}

static void write_combination(const DipCostReport *report, int row, FILE *out) {
    char all[256];
    const DipPathEstimate *time = &report->rows[row].time;
    const DipMetrics f = dip_cost_row_metrics(report, row, 0);
    dip_quality_format(&report->rows[row].quality, all, sizeof all);
    fprintf(out, "<tr data-row=\"%d\" data-settings=\"%s\"><th scope=\"row\">", row, all);
    dip_html_settings(report, row, out);
    fprintf(out,
            "</th><td>%.2f</td><td>%.2f to %.2f</td><td>%.2f</td><td>%.3f</td><td>%.3f to "
            "%.3f</td><td>%.4f</td><td>%.2f</td><td>%.4f</td><td>%.5f</td><td "
            "class=\"l\">%s</td></tr>\n",
            time->mean_ms.value, time->mean_ms.low, time->mean_ms.high, time->p95_ms.value,
            time->ratio.value, time->ratio.low, time->ratio.high, f.flip, f.psnr_db, f.ssim,
            f.rmse_lin, dip_cost_floor_mark(report, row));
}

static void write_all_table(const DipCostReport *report, FILE *out) {
    int rows[DIP_COST_MAX_ROWS];
    const int count = dip_cost_list_plotted(report, rows);
    fprintf(out, "<details><summary>All %d combinations</summary>\n", count);
    dip_html_table_begin(out, "combinations", " data-set=\"front\" data-plot=\"front\"");
    fprintf(out,
            "All combinations on path %s. A filter also makes the points of all other "
            "combinations pale in the plot.",
            report->paths[0]);
    dip_html_columns_begin(out);
    dip_html_text_column(out, "settings");
    dip_html_column(out, "mean", "ms");
    dip_html_column(out, "95 % interval of the mean", "ms");
    dip_html_column(out, "p95", "ms");
    dip_html_column(out, "ratio", NULL);
    dip_html_column(out, "95 % interval of the ratio", NULL);
    dip_html_column(out, "FLIP", NULL);
    dip_html_column(out, "PSNR", "dB");
    dip_html_column(out, "SSIM", NULL);
    dip_html_column(out, "RMSE", "linear");
    dip_html_text_column(out, "noise floor");
    dip_html_columns_end(out);
    for (int i = 0; i < count; i++) {
        write_combination(report, rows[i], out);
    }
    dip_html_table_end(out);
    fprintf(out, "</details>\n");
}

bool dip_html_front(const DipCostReport *report, const DipCostPictures *pictures, FILE *out) {
    Points front = {0};
    Points others = {0};
    const bool made = split(report, &front, &others);
    if (made && front.count + others.count > 1) {
        fprintf(out,
                "<h2 id=\"front\">Time against error</h2>\n"
                "<p>Both axes are logarithmic. The Pareto front consists of the combinations that "
                "no other combination beats in both time and error. The FLIP of each numbered "
                "combination is at least 1 %% below that of the combination with the number "
                "before.</p>\n");
        write_plot(report, &front, &others, out);
        write_front_table(report, &front, out);
        if (pictures) {
            dip_html_pictures(report, &pictures->front, "front", NULL, out);
        }
        write_all_table(report, out);
    }
    free_points(&front);
    free_points(&others);
    return made;
}
