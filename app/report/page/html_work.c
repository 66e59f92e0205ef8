// Tables of all steps in the HTML page: errors of the parts of the picture, and work counters.
#include "app/report/page/html_parts.h"

#include "app/report/format/analysis.h"
#include "app/files/put.h"

#include <math.h>
#include <string.h>

// Begins the line of a sweep's step with its name.
static void begin_step(const DipCostReport *report, const DipCostSweep *sweep, int index,
                       FILE *out) {
    char title[DIP_COST_TEXT];
    char step[DIP_COST_TEXT];
    dip_cost_sweep_title(report, sweep, title);
    dip_cost_step_text(report, sweep, sweep->rows[index], step);
    dip_html_line_begin(out, sweep->rows[index]);
    dip_put_html(out, "<th scope=\"row\">%s: %s</th>", title, step);
}

// --- parts of the picture ----------------------------------------------------------------------

static void write_regions_of(const DipCostReport *report, const DipCostSweep *sweep, int index,
                             FILE *out) {
    int viewpoints;
    const DipMetricSums sums = dip_cost_row_sums(report, sweep->rows[index], &viewpoints);
    begin_step(report, sweep, index, out);
    for (int r = 0; r < DIP_METRIC_REGION_COUNT; r++) {
        const double share = sums.regions[r].pixels / fmax(sums.regions[0].pixels, 1.0);
        if (share > 0.0) {
            dip_put_html(out, "<td>%.4f (%.1f %%)</td>", dip_metrics_of(&sums, r).flip,
                         100.0 * share);
        } else {
            dip_put_html(out, "<td></td>");
        }
    }
    dip_put_html(out, "</tr>\n");
}

void dip_html_regions(const DipCostReport *report, FILE *out) {
    dip_put_html(out, "<h2 id=\"parts\">Where the errors are</h2>\n");
    dip_html_table_begin(out, "picture-parts", NULL);
    dip_put_html(out,
                 "Mean FLIP over the pixels of each part of the picture. The number in brackets is "
                 "the part's share of all pixels.");
    dip_html_columns_begin(out);
    dip_html_text_column(out, "step");
    for (int r = 0; r < DIP_METRIC_REGION_COUNT; r++) {
        dip_html_column(out, dip_metric_region_names[r], NULL);
    }
    dip_html_columns_end(out);
    for (int s = 0; s < report->sweep_count; s++) {
        for (int i = 0; i < report->sweeps[s].row_count; i++) {
            write_regions_of(report, &report->sweeps[s], i, out);
        }
    }
    dip_html_table_end(out);
}

// --- work --------------------------------------------------------------------------------------

// True if a counter has the same value in every step of every sweep.
static bool is_constant(const DipCostReport *report, int counter) {
    bool same = true;
    for (int s = 0; s < report->sweep_count; s++) {
        const DipCostSweep *sweep = &report->sweeps[s];
        for (int i = 0; i < sweep->row_count; i++) {
            same = same && report->rows[sweep->rows[i]].counters[counter] ==
                               report->rows[report->sweeps[0].rows[0]].counters[counter];
        }
    }
    return same;
}

// Writes the name of a counter with blanks, so that it may be broken into lines.
static void write_counter_name(int counter, FILE *out) {
    for (const char *name = dip_cost_counter_names[counter]; *name; name++) {
        dip_put_html(out, "%c", *name == '_' ? ' ' : *name);
    }
}

static void write_constant_counters(const DipCostReport *report, FILE *out) {
    bool first = true;
    for (int c = 0; report->sweep_count && c < DIP_COST_COUNTER_COUNT; c++) {
        if (is_constant(report, c)) {
            dip_put_markup(out, first ? "<p class=\"note\">These counters are the same in all "
                                        "rows, in thousands: "
                                      : ", ");
            write_counter_name(c, out);
            dip_put_html(out, " %.4g",
                         report->rows[report->sweeps[0].rows[0]].counters[c] / 1000.0);
            first = false;
        }
    }
    dip_put_markup(out, first ? "" : ".</p>\n");
}

static void write_counters(const DipCostReport *report, FILE *out) {
    dip_html_table_begin(out, "work-counters", NULL);
    dip_put_html(out,
                 "Work counters, in thousands per frame: means over the timed frames. The counters "
                 "are exact. They are the same on every machine and with any number of threads.");
    dip_html_columns_begin(out);
    dip_html_text_column(out, "step");
    for (int c = 0; c < DIP_COST_COUNTER_COUNT; c++) {
        if (!is_constant(report, c)) {
            dip_put_html(out, "<th scope=\"col\">");
            write_counter_name(c, out);
            dip_put_html(out, "</th>");
        }
    }
    dip_html_columns_end(out);
    for (int s = 0; s < report->sweep_count; s++) {
        const DipCostSweep *sweep = &report->sweeps[s];
        for (int i = 0; i < sweep->row_count; i++) {
            begin_step(report, sweep, i, out);
            for (int c = 0; c < DIP_COST_COUNTER_COUNT; c++) {
                if (!is_constant(report, c)) {
                    dip_put_html(out, "<td>%.4g</td>",
                                 report->rows[sweep->rows[i]].counters[c] / 1000.0);
                }
            }
            dip_put_html(out, "</tr>\n");
        }
    }
    dip_html_table_end(out);
}

static void write_fit(const DipCostReport *report, FILE *out) {
    const DipCostFit *fit = report->analysis ? &report->analysis->fit : NULL;
    if (!fit || fit->rows == 0) {
        return;
    }
    char smaller[64] = "";
    if (report->smaller_count > 0) {
        snprintf(smaller, sizeof smaller, " and of %d combinations at %d×%d", report->smaller_count,
                 report->smaller_width, report->smaller_height);
    }
    dip_html_table_begin(out, "prices-of-work", NULL);
    dip_put_html(
        out,
        "A linear fit explains the times of the stages of %d rows%s by their work counters: "
        "R&sup2; is %.3f, the median error is %.1f %%. If each row is predicted from all "
        "others, the median error is %.1f %%, and %.0f %% of the rows are predicted within "
        "10 %%.",
        fit->rows, smaller, fit->r2, 100.0 * fit->median_miss, 100.0 * fit->others.median,
        100.0 * fit->others.within_10);
    dip_html_columns_begin(out);
    dip_html_text_column(out, "unit of work");
    dip_html_text_column(out, "stage");
    dip_html_column(out, "time", "ns");
    dip_html_columns_end(out);
    for (int i = 0; i < fit->count; i++) {
        if (fit->ns[i] > 0.0) {
            dip_put_html(out, "<tr><th scope=\"row\">");
            dip_put_html(out, "%s", fit->names[i]);
            dip_put_html(out, "</th><td class=\"l\">%s</td><td>%.3g</td></tr>\n", fit->stages[i],
                         fit->ns[i]);
        }
    }
    dip_html_table_end(out);
}

void dip_html_work(const DipCostReport *report, FILE *out) {
    dip_put_html(out,
                 "<section class=\"%s\" aria-labelledby=\"work\">\n<h2 id=\"work\">Work</h2>\n",
                 report->sweep_count ? "wide" : "");
    if (report->sweep_count) {
        write_counters(report, out);
        write_constant_counters(report, out);
    }
    dip_put_html(out, "</section>\n");
    write_fit(report, out);
}
