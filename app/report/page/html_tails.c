// The distribution of FLIP over pixels in the HTML page.
#include "app/report/page/html_parts.h"

#include "app/report/front.h"
#include "app/files/put.h"

// Writes a row of the report, if its distribution is known. `what` is where the row comes from.
static void write_line(const DipCostReport *report, int row, const char *what, FILE *out) {
    const DipCostTail tail = dip_cost_row_tail(report, row);
    const DipFlipTail *flip = &tail.flip;
    if (tail.viewpoints == 0) {
        return;
    }
    dip_html_line_begin(out, row);
    dip_put_html(out, "<th scope=\"row\">");
    dip_html_settings(report, row, out);
    dip_put_html(
        out,
        "</th><td class=\"l\">%s</td><td class=\"l\">%s</td><td>%.4f</td><td>%.4f</td><td>%.4f</td>"
        "<td>%.4f</td><td>%.4f</td><td>%d</td><td>%.0f</td><td>%.0f x %.0f at (%.0f, "
        "%.0f)</td></tr>\n",
        what, report->paths[report->rows[row].path], dip_cost_row_metrics(report, row, 0).flip,
        flip->p50, flip->p95, flip->p99, flip->worst, tail.worst_viewpoint + 1,
        flip->worst_frame + 1.0, flip->worst_width, flip->worst_height, flip->worst_x,
        flip->worst_y);
}

bool dip_html_has_tails(const DipCostReport *report) {
    for (int r = 0; r < report->row_count; r++) {
        if (dip_cost_row_tail(report, r).viewpoints > 0) {
            return true;
        }
    }
    return false;
}

void dip_html_tails(const DipCostReport *report, FILE *out) {
    if (!dip_html_has_tails(report)) {
        return;
    }
    int front[DIP_COST_MAX_ROWS];
    const int count = report->rounds > 0 ? dip_cost_list_front(report, front) : 0;
    dip_put_html(
        out,
        "<h2 id=\"tails\">Small parts with large errors</h2>\n"
        "<p>A mean hides small parts of a picture that look bad. The percentiles are those of "
        "the pixels' FLIP at a viewpoint, as means over the viewpoints: 99 %% of the pixels "
        "have at most the FLIP in the column 99 %%. The worst block is the part of at most %d "
        "x %d pixels with the greatest mean FLIP at any viewpoint.</p>\n",
        DIP_FLIP_TAIL_BLOCK, DIP_FLIP_TAIL_BLOCK);
    dip_html_table_begin(out, "flip-tails", NULL);
    dip_put_html(out, "Distribution of FLIP over pixels, for each step of each setting and for the "
                      "Pareto front.");
    dip_html_columns_begin(out);
    dip_html_text_column(out, "settings");
    dip_html_text_column(out, "row of");
    dip_html_text_column(out, "path");
    dip_html_column(out, "FLIP", "mean");
    dip_html_column(out, "50 %", NULL);
    dip_html_column(out, "95 %", NULL);
    dip_html_column(out, "99 %", NULL);
    dip_html_column(out, "worst block", "mean");
    dip_html_column(out, "its viewpoint", NULL);
    dip_html_column(out, "its frame", NULL);
    dip_html_column(out, "its place", "px");
    dip_html_columns_end(out);
    for (int s = 0; s < report->sweep_count; s++) {
        char title[DIP_COST_TEXT];
        dip_cost_sweep_title(report, &report->sweeps[s], title);
        for (int i = 0; i < report->sweeps[s].row_count; i++) {
            write_line(report, report->sweeps[s].rows[i], title, out);
        }
    }
    for (int i = 0; i < count; i++) {
        write_line(report, front[i], "Pareto front", out);
    }
    dip_html_table_end(out);
}
