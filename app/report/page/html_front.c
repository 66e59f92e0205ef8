// Time against error in the HTML page: the plot of all combinations, and their tables.
#include "app/report/page/html_parts.h"

#include "app/report/page/html_points.h"
#include "app/files/put.h"
#include "app/report/words.h"

#include <math.h>

static bool add_candidate(const DipCostReport *report, DipHtmlPoints *points,
                          const DipCandidate *candidate) {
    char title[DIP_HTML_TITLE_ROOM];
    dip_html_row_title(report, candidate->row, title);
    return dip_html_points_add(points, candidate->row, candidate->time.value, candidate->flip,
                               title);
}

static bool contains(const DipHtmlPoints *points, int row) {
    for (int i = 0; i < points->count; i++) {
        if (points->rows[i] == row) {
            return true;
        }
    }
    return false;
}

// The series of the plot.
typedef struct Parts {
    DipHtmlPoints front;     // The thinned Pareto front of the measured combinations.
    DipHtmlPoints others;    // All other measured combinations.
    DipHtmlPoints predicted; // Combinations that were only predicted.
} Parts;

static void free_parts(Parts *parts) {
    dip_html_points_free(&parts->front);
    dip_html_points_free(&parts->others);
    dip_html_points_free(&parts->predicted);
}

// Returns false when memory runs out.
static bool split(const DipCostReport *report, Parts *parts) {
    const DipCostChoice *choice = &report->choice;
    const DipCandidates *all = &choice->candidates;
    bool made = dip_html_points_alloc(&parts->front, choice->front_count) &&
                dip_html_points_alloc(&parts->others, all->count) &&
                dip_html_predicted_points(report, &parts->predicted);
    for (int i = 0; made && i < choice->front_count; i++) {
        made = add_candidate(report, &parts->front, &all->list[choice->front[i]]);
    }
    for (int i = 0; made && i < all->count; i++) {
        made = contains(&parts->front, all->list[i].row) ||
               add_candidate(report, &parts->others, &all->list[i]);
    }
    return made;
}

static void write_plot(const DipCostReport *report, const Parts *parts, FILE *out) {
    char subtitle[DIP_COST_TEXT];
    snprintf(subtitle, sizeof subtitle, "%d combinations on path %s, %dx%d pixels; %s of %d frames",
             parts->front.count + parts->others.count, report->paths[0], report->width,
             report->height, dip_time_kind_names[report->choice.candidates.kind],
             dip_cost_frame_count(report));
    DipPlotSeries series[] = {
        dip_html_points_series(&parts->predicted, "predicted only", "series-predicted"),
        dip_html_points_series(&parts->others, "other combinations", "series-others"),
        dip_html_points_series(&parts->front, "Pareto front", "series-front"),
    };
    series[2].marks_only = false;
    series[2].labels = parts->front.labels;
    const int first = parts->predicted.count == 0;
    const DipPlot plot = {
        .title = "Time against error",
        .subtitle = subtitle,
        .x_title = "time of a frame, ms",
        .y_title = "FLIP against the truth, mean",
        .log_x = true,
        .log_y = true,
        .series = series + first,
        .series_count = 3 - first,
        .set = "front",
    };
    dip_put_html(out,
                 "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Plot of time "
                 "against error\">\n");
    dip_plot_print(out, &plot);
    dip_put_html(out, "</div>\n");
}

// --- tables ------------------------------------------------------------------------------------

static double flicker_of(const DipCostReport *report, int row) {
    int viewpoints;
    const DipMetricSums sums = dip_cost_row_sums(report, row, &viewpoints);
    return dip_flicker_metrics_of(&sums).flicker;
}

// Writes the changes from the candidate before, and what each 1 % of FLIP cost.
static void write_changes(const DipCostReport *report, const DipCandidate *candidate,
                          const DipCandidate *before, FILE *out) {
    char ms[DIP_NUMBER_BYTES], flip[DIP_NUMBER_BYTES];
    const double more_ms = candidate->time.value - before->time.value;
    dip_number_text(more_ms, 2, true, "-", ms);
    dip_number_text(candidate->flip - before->flip, 4, true, "-", flip);
    dip_put_html(out, "<td>%s</td><td>%s</td>", ms, flip);
    // Viewpoints differ more than settings do, so the interval is that of the viewpoints' changes.
    const DipEstimate change = dip_cost_flip_change(report, candidate->row, before->row);
    if (isfinite(change.low) && isfinite(change.high)) {
        dip_put_html(out, "<td>%+.4f to %+.4f</td>", change.low, change.high);
    } else {
        dip_put_html(out, "<td></td>");
    }
    if (candidate->loss > 0.0) {
        dip_put_html(out, "<td>%.3f</td>", more_ms / (100.0 * log(before->loss / candidate->loss)));
    } else {
        dip_put_html(out, "<td></td>");
    }
}

static void write_front_row(const DipCostReport *report, int index, FILE *out) {
    const DipCostChoice *choice = &report->choice;
    const DipCandidate *list = choice->candidates.list;
    const DipCandidate *candidate = &list[choice->front[index]];
    const int row = candidate->row;
    dip_html_line_begin(out, row);
    dip_put_html(out, "<th scope=\"row\">");
    dip_html_settings(report, row, out);
    dip_put_html(out, "</th><td>%d%s</td><td>%.2f</td>", index + 1,
                 index == choice->knee ? ", knee" : "", candidate->time.value);
    const DipMetrics metrics = dip_cost_row_metrics(report, row, 0);
    dip_put_html(out, "<td>%.4f</td><td>%.5f</td><td>%.5f</td>", metrics.flip,
                 flicker_of(report, row), metrics.rmse_lin);
    if (index > 0) {
        write_changes(report, candidate, &list[choice->front[index - 1]], out);
    } else {
        dip_put_html(out, "<td></td><td></td><td></td><td></td>");
    }
    dip_put_html(out, "</tr>\n");
}

static void write_front_table(const DipCostReport *report, FILE *out) {
    const DipCostChoice *choice = &report->choice;
    dip_html_table_begin(out, "pareto-front", "front");
    dip_put_html(
        out, "The Pareto front. The changes are those from the line before, in order of time.%s",
        choice->knee >= 0 ? " Beyond the knee, more time buys least." : "");
    dip_html_columns_begin(out);
    dip_html_text_column(out, "settings");
    dip_html_column(out, "number", "in the plot");
    dip_html_column(out, dip_time_kind_names[choice->candidates.kind], "ms");
    dip_html_column(out, "FLIP", NULL);
    dip_html_column(out, "flicker", "linear");
    dip_html_column(out, "RMSE", "linear");
    dip_html_column(out, "change of time", "ms");
    dip_html_column(out, "change of FLIP", NULL);
    dip_html_column(out, "95 % interval", "of the change");
    dip_html_column(out, "price of 1 % less FLIP", "ms");
    dip_html_columns_end(out);
    for (int i = 0; i < choice->front_count; i++) {
        write_front_row(report, i, out);
    }
    dip_html_table_end(out);
}

static void write_combination(const DipCostReport *report, int row, FILE *out) {
    char all[256], of_mean[DIP_COST_INTERVAL], of_ratio[DIP_COST_INTERVAL];
    const DipPathEstimate *time = &report->rows[row].time;
    const DipMetrics f = dip_cost_row_metrics(report, row, 0);
    dip_quality_format(&report->rows[row].quality, all, sizeof all);
    dip_cost_interval_text(&time->mean_ms, 2, of_mean);
    dip_cost_interval_text(&time->ratio, 3, of_ratio);
    dip_put_html(out, "<tr data-row=\"%d\" data-settings=\"%s\"><th scope=\"row\">", row, all);
    dip_html_settings(report, row, out);
    dip_put_html(out,
                 "</th><td>%.2f</td><td>%s</td><td>%.2f</td><td>%.3f</td><td>%s</td><td>%.4f</"
                 "td><td>%.5f</td><td>%.2f</td><td>%.4f</td><td>%.5f</td><td "
                 "class=\"l\">%s</td></tr>\n",
                 time->mean_ms.value, of_mean, time->p95_ms.value, time->ratio.value, of_ratio,
                 f.flip, flicker_of(report, row), f.psnr_db, f.ssim, f.rmse_lin,
                 dip_cost_floor_mark(report, row));
}

static void write_all_table(const DipCostReport *report, FILE *out) {
    const DipCandidates *all = &report->choice.candidates;
    const int count = all->count;
    dip_put_html(out, "<details><summary>All %d combinations</summary>\n", count);
    dip_html_table_begin(out, "combinations", "front");
    dip_put_html(out,
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
    dip_html_column(out, "flicker", "linear");
    dip_html_column(out, "PSNR", "dB");
    dip_html_column(out, "SSIM", NULL);
    dip_html_column(out, "RMSE", "linear");
    dip_html_text_column(out, "noise floor");
    dip_html_columns_end(out);
    for (int i = 0; i < count; i++) {
        write_combination(report, all->list[i].row, out);
    }
    dip_html_table_end(out);
    dip_put_html(out, "</details>\n");
}

// Says which combinations are missing because another one draws the same pictures.
static void write_same(const DipCostReport *report, FILE *out) {
    if (report->same_count == 0) {
        return;
    }
    dip_put_html(
        out,
        "<details><summary>%d more combinations with the same pictures</summary>\n"
        "<p>Each of these combinations draws the same pictures as one with fewer settings off "
        "their defaults, which stands for it.</p>\n",
        report->same_count);
    dip_html_table_begin(out, "same-pictures", NULL);
    dip_put_html(out, "Combinations with the same pictures, by hash, at all viewpoints.");
    dip_html_columns_begin(out);
    dip_html_text_column(out, "settings");
    dip_html_text_column(out, "draws the same as");
    dip_html_columns_end(out);
    for (int i = 0; i < report->same_count; i++) {
        dip_html_line_begin(out, report->same[i].row);
        dip_put_html(out, "<th scope=\"row\">");
        dip_html_quality(&report->same[i].quality, out);
        dip_put_html(out, "</th><td class=\"l name\">");
        dip_html_settings(report, report->same[i].row, out);
        dip_put_html(out, "</td></tr>\n");
    }
    dip_html_table_end(out);
    dip_put_html(out, "</details>\n");
}

bool dip_html_front(const DipCostReport *report, const DipCostPictures *pictures, FILE *out) {
    Parts parts = {0};
    const bool made = split(report, &parts);
    if (made && parts.front.count + parts.others.count > 1) {
        dip_put_html(
            out, "<h2 id=\"front\">Time against error</h2>\n"
                 "<p>Both axes are logarithmic. The Pareto front consists of the combinations that "
                 "no other combination beats in both time and error. The FLIP of each numbered "
                 "combination is at least 1 %% below that of the combination with the number "
                 "before.</p>\n");
        write_plot(report, &parts, out);
        write_front_table(report, out);
        if (pictures) {
            dip_html_pictures(report, &pictures->front, "front", NULL, out);
        }
        write_all_table(report, out);
        write_same(report, out);
    }
    free_parts(&parts);
    return made;
}
