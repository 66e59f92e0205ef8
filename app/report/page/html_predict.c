// Predicted combinations in the HTML page (--predict): their points in the plot, and a table that
// compares predictions with measurements.
#include "app/report/candidates.h"
#include "app/report/page/html_parts.h"

#include "app/files/put.h"
#include <stdlib.h>

enum { MOST_LISTED = 500 }; // A page lists at most this many combinations.

static int compare_times(const void *a, const void *b) {
    const DipCandidate *x = a;
    const DipCandidate *y = b;
    return (x->time.value > y->time.value) - (x->time.value < y->time.value);
}

// Lists predictions in order of time: all, or if there are too many those that were measured later
// and the front of what was predicted. The caller frees the list even after a failure. Returns
// false when memory runs out.
static bool list_predictions(const DipCostReport *report, DipCandidates *all) {
    const DipCostPrediction *list = report->predicted.list;
    int front[DIP_COST_MAX_ROWS];
    bool is_best[DIP_COST_MAX_ROWS] = {false};
    if (!dip_candidates_of_predictions(report, report->options.budget_of, false, all, NULL)) {
        return false;
    }
    const int best = dip_front(all, DIP_CLEARLY_BETTER, front);
    for (int i = 0; i < best; i++) {
        is_best[front[i]] = true;
    }
    const int count = all->count;
    all->count = 0;
    for (int i = 0; i < count; i++) {
        if ((count <= MOST_LISTED || is_best[i] || list[i].row >= 0) && all->count < MOST_LISTED) {
            all->list[all->count++] = all->list[i];
        }
    }
    qsort(all->list, (size_t)all->count, sizeof *all->list, compare_times);
    return true;
}

static bool add_point(DipHtmlPoints *points, const DipCandidate *c, const DipCostPrediction *p) {
    char settings[DIP_HTML_TITLE_ROOM];
    char title[DIP_HTML_TITLE_ROOM];
    dip_html_quality_text(&p->quality, settings);
    snprintf(title, sizeof title,
             "%.300s: predicted %.2f ms, 95th percentile %.2f ms; predicted FLIP %.4f", settings,
             p->ms, p->p95_ms, p->flip);
    return dip_html_points_add(points, -1, c->time.value, c->flip, title);
}

bool dip_html_predicted_points(const DipCostReport *report, DipHtmlPoints *points) {
    DipCandidates all;
    bool made = list_predictions(report, &all) && dip_html_points_alloc(points, all.count);
    for (int i = 0; made && i < all.count; i++) {
        const DipCandidate *c = &all.list[i];
        const DipCostPrediction *prediction = &report->predicted.list[c->row];
        if (prediction->row < 0) {
            made = add_point(points, c, prediction);
        }
    }
    dip_candidates_free(&all);
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

static void write_table(const DipCostReport *report, const DipCandidates *all, FILE *out) {
    const int count = all->count;
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
        write_prediction(report, &report->predicted.list[all->list[i].row], out);
    }
    dip_html_table_end(out);
    dip_put_html(out, "</details>\n");
}

bool dip_html_predictions(const DipCostReport *report, FILE *out) {
    const DipCostPredictions *p = &report->predicted;
    DipCandidates all;
    if (p->count == 0) {
        return true;
    }
    const bool listed = list_predictions(report, &all);
    if (listed) {
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
        write_table(report, &all, out);
    }
    dip_candidates_free(&all);
    return listed;
}
