// Predicted combinations in the HTML page (--predict): their points in the plot, and a table that
// compares predictions with measurements.
#include "app/report/page/html_parts.h"

#include "app/files/put.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_LISTED = 500 }; // A page lists at most this many combinations.

static int compare_times(const void *a, const void *b) {
    const DipCostPrediction *const *x = a;
    const DipCostPrediction *const *y = b;
    return ((*x)->ms > (*y)->ms) - ((*x)->ms < (*y)->ms);
}

// Lists predictions in order of time: all, or if there are too many those that were measured later
// and those that no other prediction beats in both time and FLIP. Returns their number. The caller
// frees *list, which is NULL when memory runs out.
static int list_predictions(const DipCostReport *report, const DipCostPrediction ***list) {
    const DipCostPredictions *p = &report->predicted;
    const DipCostPrediction **all = malloc(((size_t)p->count + 1) * sizeof *all);
    int kept = 0;
    double least = INFINITY;
    *list = all;
    for (int i = 0; all && i < p->count; i++) {
        all[i] = &p->list[i];
    }
    if (all) {
        qsort(all, (size_t)p->count, sizeof *all, compare_times);
    }
    for (int i = 0; all && i < p->count; i++) {
        const bool is_best = all[i]->flip < 0.99 * least;
        least = is_best ? all[i]->flip : least;
        if ((p->count <= MOST_LISTED || is_best || all[i]->row >= 0) && kept < MOST_LISTED) {
            all[kept++] = all[i];
        }
    }
    return kept;
}

static bool add_point(DipHtmlPoints *points, const DipCostPrediction *p) {
    char settings[DIP_HTML_TITLE_ROOM];
    char title[DIP_HTML_TITLE_ROOM];
    dip_html_quality_text(&p->quality, settings);
    snprintf(title, sizeof title,
             "%.300s: predicted %.2f ms, 95th percentile %.2f ms; predicted FLIP %.4f", settings,
             p->ms, p->p95_ms, p->flip);
    return dip_html_points_add(points, -1, p->ms, p->flip, title);
}

bool dip_html_predicted_points(const DipCostReport *report, DipHtmlPoints *points) {
    const DipCostPrediction **list;
    const int count = list_predictions(report, &list);
    bool made = list && dip_html_points_alloc(points, count);
    for (int i = 0; made && i < count; i++) {
        if (list[i]->row < 0) {
            made = add_point(points, list[i]);
        }
    }
    free(list);
    return made;
}

// --- the table ---------------------------------------------------------------------------------

static void write_misses(const char *what, const DipCostMisses *times, const DipCostMisses *errors,
                         FILE *out) {
    if (times->rows > 0) {
        dip_put_html(
            out,
            "<p>%s the median miss is %.1f %% of the time and %.1f %% of FLIP; 90 %% of the "
            "combinations are missed by at most %.1f %% of the time and %.1f %% of FLIP.</p>\n",
            what, 100.0 * times->median, 100.0 * errors->median, 100.0 * times->p90,
            100.0 * errors->p90);
    }
}

static void write_prediction(const DipCostReport *report, const DipCostPrediction *prediction,
                             FILE *out) {
    dip_html_line_begin(out, prediction->row);
    dip_put_html(out, "<th scope=\"row\">");
    dip_html_quality(&prediction->quality, out);
    dip_put_html(out, "</th><td>%.2f</td><td>%.2f</td><td>%.4f</td>", prediction->ms,
                 prediction->p95_ms, prediction->flip);
    if (prediction->row >= 0 && dip_cost_is_timed(report, prediction->row)) {
        const double ms = dip_cost_ms(report, prediction->row);
        const double flip = dip_cost_row_metrics(report, prediction->row, 0).flip;
        dip_put_html(out, "<td>%.2f</td><td>%.4f</td><td>%+.1f</td><td>%+.1f</td></tr>\n", ms, flip,
                     100.0 * (prediction->ms / ms - 1.0),
                     flip > 0.0 ? 100.0 * (prediction->flip / flip - 1.0) : 0.0);
    } else {
        dip_put_html(out, "<td></td><td></td><td></td><td></td></tr>\n");
    }
}

static void write_table(const DipCostReport *report, const DipCostPrediction *const *list,
                        int count, FILE *out) {
    dip_put_html(out, "<details><summary>%d predicted combinations</summary>\n", count);
    dip_html_table_begin(out, "predictions", NULL);
    dip_put_html(
        out, "%d of %d predicted combinations on path %s, in order of the predicted time.%s", count,
        report->predicted.count, report->paths[0],
        count < report->predicted.count
            ? " The others are beaten in both predicted time and predicted FLIP, and were not "
              "measured."
            : "");
    dip_html_columns_begin(out);
    dip_html_text_column(out, "settings");
    dip_html_column(out, "predicted mean", "ms");
    dip_html_column(out, "predicted p95", "ms");
    dip_html_column(out, "predicted FLIP", NULL);
    dip_html_column(out, "measured mean", "ms");
    dip_html_column(out, "measured FLIP", NULL);
    dip_html_column(out, "miss of the time", "%");
    dip_html_column(out, "miss of FLIP", "%");
    dip_html_columns_end(out);
    for (int i = 0; i < count; i++) {
        write_prediction(report, list[i], out);
    }
    dip_html_table_end(out);
    dip_put_html(out, "</details>\n");
}

bool dip_html_predictions(const DipCostReport *report, FILE *out) {
    const DipCostPredictions *p = &report->predicted;
    const DipCostPrediction **list;
    if (p->count == 0) {
        return true;
    }
    const int count = list_predictions(report, &list);
    if (list) {
        dip_put_html(
            out,
            "<h2 id=\"predicted\">Predicted combinations</h2>\n"
            "<p>The times and errors of %d combinations were predicted from %d measured ones. "
            "The %d combinations that the prediction found best were then measured.</p>\n",
            p->count, p->trained, p->times.rows);
        write_misses("Of combinations that were measured after they had been predicted,", &p->times,
                     &p->errors, out);
        write_misses(
            "Of the combinations that were measured first, each predicted from the others,",
            &p->times_left_out, &p->errors_left_out, out);
        write_table(report, list, count, out);
    }
    free(list);
    return list != NULL;
}
