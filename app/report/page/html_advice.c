// The best settings for time budgets in the HTML page.
#include "app/report/page/html_parts.h"
#include "app/report/tiers.h"
#include "app/files/put.h"

static void write_next_better(const DipCostReport *report, int row, double flip, FILE *out) {
    const int next = dip_cost_step_up(report, row);
    if (next < 0) {
        dip_put_html(out, "<td class=\"l\">none</td><td></td><td></td></tr>\n");
        return;
    }
    dip_put_html(out, "<td class=\"l\">");
    dip_html_settings(report, next, out);
    dip_put_html(out, "</td><td>%+.2f</td><td>%+.4f</td></tr>\n",
                 dip_cost_ms(report, next) - dip_cost_ms(report, row),
                 dip_cost_row_metrics(report, next, 0).flip - flip);
}

// How likely the chosen settings are the best, and which are otherwise.
static void write_certainty(const DipCostReport *report, const DipCostAdvice *advice, FILE *out) {
    if (!(advice->probability > 0.0)) {
        dip_put_html(out, "<td></td><td class=\"l\"></td>");
        return;
    }
    dip_put_html(out, "<td>%.0f</td><td class=\"l\">", 100.0 * advice->probability);
    if (advice->probability < 0.95 && advice->runner_up >= 0) {
        dip_html_settings(report, advice->runner_up, out);
        dip_put_html(out, " <span class=\"unbroken\">(%.0f %%)</span>",
                     100.0 * advice->runner_up_probability);
    }
    dip_put_html(out, "</td>");
}

static void write_advice_line(const DipCostReport *report, const DipCostAdvice *advice, FILE *out) {
    dip_html_line_begin(out, advice->row);
    dip_put_html(out, "<th scope=\"row\">%g</th>", advice->budget_ms);
    if (advice->row < 0) {
        dip_put_html(out,
                     "<td class=\"l\">no measured combination is surely that fast</td><td></td>"
                     "<td></td><td></td><td></td><td></td><td class=\"l\"></td>"
                     "<td class=\"l\"></td><td></td><td></td></tr>\n");
        return;
    }
    const DipMetrics f = dip_cost_row_metrics(report, advice->row, 0);
    dip_put_html(out, "<td class=\"l name\">");
    dip_html_settings(report, advice->row, out);
    dip_put_html(out, "</td><td>%.2f</td><td>%.2f to %.2f</td><td>%.4f</td><td>%.5f</td>",
                 advice->ms, advice->ms_low, advice->ms_high, f.flip, f.rmse_lin);
    write_certainty(report, advice, out);
    write_next_better(report, advice->row, f.flip, out);
}

static void write_tier(const char *name, const DipCostTier *tier, FILE *out) {
    char text[256] = "";
    if (tier->quality) {
        dip_quality_format(tier->quality, text, sizeof text);
    }
    dip_html_line_begin(out, tier->row);
    dip_put_html(out, "<th scope=\"row\">%s</th><td>%g</td><td class=\"l code\">%s%s</td></tr>\n",
                 name, tier->budget_ms,
                 tier->quality ? "REQUESTED: " : "nothing is surely that fast", text);
}

// Four budgets make the four tiers of a settings menu.
static void write_tiers(const DipCostReport *report, FILE *out) {
    DipCostTier tiers[DIP_COST_TIER_COUNT];
    if (report->advice_count != DIP_COST_TIER_COUNT) {
        return;
    }
    dip_html_table_begin(out, "tiers", NULL);
    dip_put_html(out, "The four budgets as the tiers of a settings menu, with lines for the ini.");
    dip_html_columns_begin(out);
    dip_html_text_column(out, "tier");
    dip_html_column(out, "budget", "ms");
    dip_html_text_column(out, "line of the ini");
    dip_html_columns_end(out);
    for (int i = 0; i < DIP_COST_TIER_COUNT; i++) {
        const int row = report->advice[i].row;
        tiers[i] = (DipCostTier){report->advice[i].budget_ms,
                                 row >= 0 ? &report->rows[row].quality : NULL, row};
    }
    dip_cost_tiers_sort(tiers);
    for (int i = 0; i < DIP_COST_TIER_COUNT; i++) {
        write_tier(dip_cost_tier_names[i], &tiers[i], out);
    }
    dip_html_table_end(out);
}

void dip_html_advice(const DipCostReport *report, FILE *out) {
    if (report->advice_count == 0) {
        return;
    }
    const char *of = dip_cost_budget_of_names[report->options.budget_of];
    dip_put_html(
        out,
        "<h2 id=\"advice\">Best settings for a time budget</h2>\n"
        "<p>For each time budget, the table shows the settings with the least FLIP that are within "
        "the budget: the upper end of the interval of their %s time along the path is at most the "
        "budget. The probability is that of these settings being the best, given the noise of the "
        "times. &ldquo;Next better&rdquo; is the fastest combination whose FLIP is at least 1 %% "
        "below that of the chosen settings.</p>\n",
        of);
    dip_html_table_begin(out, "advice-table", "front");
    dip_put_html(out, "The best of %d combinations on path %s for each budget.",
                 report->row_count - report->combined_first, report->paths[0]);
    dip_html_columns_begin(out);
    dip_html_column(out, "budget", "ms");
    dip_html_text_column(out, "settings");
    dip_html_column(out, of, "ms");
    dip_html_column(out, "95 % interval", "ms");
    dip_html_column(out, "FLIP", NULL);
    dip_html_column(out, "RMSE", "linear");
    dip_html_column(out, "probability", "%");
    dip_html_text_column(out, "otherwise the best");
    dip_html_text_column(out, "next better");
    dip_html_column(out, "change of time", "ms");
    dip_html_column(out, "change of FLIP", NULL);
    dip_html_columns_end(out);
    for (int i = 0; i < report->advice_count; i++) {
        write_advice_line(report, &report->advice[i], out);
    }
    dip_html_table_end(out);
    write_tiers(report, out);
}
