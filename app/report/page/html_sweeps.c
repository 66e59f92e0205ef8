// Writing the sweeps of the HTML page. A sweep is all steps of one setting. The bars are SVG, the
// tables are HTML, the pictures are data URIs.
#include "app/report/page/html_parts.h"

#include "app/report/order.h"
#include "app/files/put.h"

#include <math.h>

// The layout of a sweep's bars, in pixels.
enum {
    BAR_WIDTH = 760,
    BAR_LEFT = 130,
    BAR_ROOM = 230, // width of the longest bar and its number
    BAR_SECOND = 500,
    BAR_LINE = 26,
    BAR_TOP = 34
};

// --- bars --------------------------------------------------------------------------------------

// The greatest values of a sweep. They get the longest bars.
typedef struct Scale {
    double most_ratio;
    double most_flip;
} Scale;

static Scale find_scale(const DipCostReport *report, const DipCostSweep *sweep) {
    Scale scale = {1e-9, 1e-9};
    for (int i = 0; i < sweep->row_count; i++) {
        if (dip_cost_is_timed(report, sweep->rows[i])) {
            const DipEstimate *ratio = &sweep->ratios[i];
            scale.most_ratio = fmax(scale.most_ratio, fmax(ratio->value, ratio->high));
        }
        scale.most_flip =
            fmax(scale.most_flip, dip_cost_row_metrics(report, sweep->rows[i], 0).flip);
    }
    return scale;
}

static void write_bar(FILE *out, double x, double y, double width, const char *class) {
    dip_put_html(out, "<rect class=\"%s\" x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"16\"/>",
                 class, x, y, width);
}

static void write_time_bar(const DipCostReport *report, const DipCostSweep *sweep, int index,
                           double y, double most, FILE *out) {
    if (!dip_cost_is_timed(report, sweep->rows[index])) {
        return;
    }
    const double room = BAR_ROOM - 60.0;
    const DipEstimate ratio = sweep->ratios[index];
    // The step that the others are compared with has no interval.
    const double end = BAR_LEFT + room * fmax(ratio.value, ratio.high) / most;
    write_bar(out, BAR_LEFT, y, room * ratio.value / most, "bar-time");
    if (!isnan(ratio.low)) {
        dip_put_html(
            out, "<line class=\"bar-interval\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\"/>",
            BAR_LEFT + room * ratio.low / most, y + 8.0, end, y + 8.0);
    }
    dip_put_html(out, "<text x=\"%.1f\" y=\"%.1f\">%.2f</text>\n", end + 6.0, y + 13.0,
                 ratio.value);
}

static void write_bars_of(const DipCostReport *report, const DipCostSweep *sweep, int index,
                          const Scale *scale, FILE *out) {
    const int row = sweep->rows[index];
    const double y = BAR_TOP + index * BAR_LINE;
    const double flip = dip_cost_row_metrics(report, row, 0).flip;
    const double width = (BAR_ROOM - 40.0) * flip / scale->most_flip;
    char step[DIP_COST_TEXT];
    dip_cost_step_text(report, sweep, row, step);
    char title[DIP_HTML_TITLE_ROOM];
    dip_html_row_title(report, row, title);
    dip_put_html(out,
                 "<g class=\"point\" data-row=\"%d\"><title>%s</title>\n<rect class=\"bar-back\" "
                 "x=\"1\" y=\"%.1f\" width=\"%d\" height=\"24\"/>"
                 "<text x=\"%d\" y=\"%.1f\" text-anchor=\"end\">%s</text>\n",
                 row, title, y - 4.0, BAR_WIDTH - 2, BAR_LEFT - 8, y + 13.0, step);
    write_time_bar(report, sweep, index, y, scale->most_ratio, out);
    write_bar(out, BAR_SECOND, y, width, "bar-error");
    dip_put_html(out, "<text x=\"%.1f\" y=\"%.1f\">%.4f</text></g>\n", BAR_SECOND + width + 6.0,
                 y + 13.0, flip);
}

static void write_bars(const DipCostReport *report, const DipCostSweep *sweep, int number,
                       FILE *out) {
    const Scale scale = find_scale(report, sweep);
    char title[DIP_COST_TEXT];
    dip_cost_sweep_title(report, sweep, title);
    const int height = BAR_TOP + sweep->row_count * BAR_LINE + 4;
    dip_put_html(
        out,
        "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Bars of time and "
        "error: %s\">\n<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot bars\" "
        "data-set=\"sweep-%d\" viewBox=\"0 0 %d %d\" width=\"%d\" height=\"%d\" "
        "font-size=\"13\">\n"
        "<text x=\"%d\" y=\"20\" font-weight=\"bold\">%s</text>"
        "<text x=\"%d\" y=\"20\" font-weight=\"bold\">FLIP, mean</text>\n",
        title, number, BAR_WIDTH, height, BAR_WIDTH, height, BAR_LEFT,
        report->rounds > 0 ? "time, ratio to the baseline" : "", BAR_SECOND);
    for (int i = 0; i < sweep->row_count; i++) {
        write_bars_of(report, sweep, i, &scale, out);
    }
    dip_put_html(out, "</svg>\n</div>\n");
}

// --- tables ------------------------------------------------------------------------------------

static void write_step_line(const DipCostReport *report, const DipCostSweep *sweep, int index,
                            FILE *out) {
    const int row = sweep->rows[index];
    int viewpoints;
    char step[DIP_COST_TEXT];
    const DipMetricSums sums = dip_cost_row_sums(report, row, &viewpoints);
    const DipMetrics f = dip_metrics_of(&sums, 0);
    const DipFlickerMetrics flicker = dip_flicker_metrics_of(&sums);
    dip_cost_step_text(report, sweep, row, step);
    dip_html_line_begin(out, row);
    dip_put_html(out, "<th scope=\"row\">%s%s</th>", step, row == sweep->base ? " (baseline)" : "");
    if (dip_cost_is_timed(report, row)) {
        const DipEstimate ratio = sweep->ratios[index];
        char interval[DIP_COST_INTERVAL];
        dip_cost_interval_text(&ratio, 3, interval);
        dip_put_html(out, "<td>%.2f</td><td>%.2f</td><td>%.3f</td><td>%s</td>",
                     dip_cost_ms(report, row), report->rows[row].time.p95_ms.value, ratio.value,
                     interval);
    } else {
        dip_put_html(out, "<td></td><td></td><td></td><td></td>");
    }
    dip_put_html(out,
                 "<td>%.5f</td><td>%.2f</td><td>%.4f</td><td>%.4f</td><td>%.5f</td><td>%.5f</td>"
                 "<td class=\"l\">%s</td></tr>\n",
                 f.rmse_lin, f.psnr_db, f.ssim, f.flip, flicker.flicker, flicker.two_mean,
                 dip_cost_floor_mark(report, row));
}

static void write_steps(const DipCostReport *report, const DipCostSweep *sweep, int number,
                        FILE *out) {
    char id[32];
    char set[32];
    char title[DIP_COST_TEXT];
    snprintf(id, sizeof id, "steps-%d", number);
    snprintf(set, sizeof set, "sweep-%d", number);
    dip_cost_sweep_title(report, sweep, title);
    dip_html_table_begin(out, id, set);
    dip_put_html(out, "%s on path %s: times and errors of each step.", title,
                 report->paths[sweep->path]);
    dip_html_columns_begin(out);
    dip_html_text_column(out, "step");
    dip_html_column(out, "mean", "ms");
    dip_html_column(out, "p95", "ms");
    dip_html_column(out, "ratio", NULL);
    dip_html_column(out, "95 % interval", NULL);
    dip_html_column(out, "RMSE", "linear");
    dip_html_column(out, "PSNR", "dB");
    dip_html_column(out, "SSIM", NULL);
    dip_html_column(out, "FLIP", NULL);
    dip_html_column(out, "flicker", "linear");
    dip_html_column(out, "two-frame mean", "linear");
    dip_html_text_column(out, "noise floor");
    dip_html_columns_end(out);
    for (int i = 0; i < sweep->row_count; i++) {
        write_step_line(report, sweep, i, out);
    }
    dip_html_table_end(out);
}

// --- sweeps ------------------------------------------------------------------------------------

static void write_sweep(const DipCostReport *report, const DipCostPictures *pictures, int number,
                        FILE *out) {
    const DipCostSweep *sweep = &report->sweeps[number];
    char order[2 * DIP_COST_TEXT];
    char title[DIP_COST_TEXT];
    dip_cost_sweep_title(report, sweep, title);
    dip_put_html(out,
                 "<section aria-labelledby=\"sweep-%d\">\n<h3 id=\"sweep-%d\">%s <small>on path "
                 "%s</small></h3>\n",
                 number, number, title, report->paths[sweep->path]);
    write_bars(report, sweep, number, out);
    write_steps(report, sweep, number, out);
    if (dip_cost_order_text(report, sweep, order, sizeof order)) {
        dip_put_html(out, "<p class=\"note\">");
        dip_put_html(out, "%s", order);
        dip_put_html(out, "</p>\n");
    }
    if (pictures) {
        char set[32];
        snprintf(set, sizeof set, "sweep-%d", number);
        dip_html_pictures(report, &pictures->sweeps[number], set, sweep, out);
    }
    dip_put_html(out, "</section>\n");
}

void dip_html_sweeps(const DipCostReport *report, const DipCostPictures *pictures, FILE *out) {
    dip_put_html(out,
                 "<h2 id=\"settings\">Each setting, on the path made for it</h2>\n"
                 "<p>Errors compare with the truth, the converged picture. Lower is better; for "
                 "PSNR and SSIM, higher is better. The lines on the bars of time are 95 %% "
                 "intervals.</p>\n");
    if (pictures && report->options.pictures != DIP_COST_PICTURES_NONE) {
        dip_put_html(
            out, "<p>Each crop is the part of the picture in which the steps differ most. Below "
                 "it is its FLIP map: black means no visible difference, yellow means the "
                 "greatest possible difference.</p>\n");
    }
    if (pictures && report->options.pictures == DIP_COST_PICTURES_FULL) {
        dip_put_html(
            out,
            "<p>Whole frames are JPEG files of quality %d. Differences of a few codes between "
            "them may come from the compression. Crops are without loss.</p>\n",
            DIP_COST_FRAME_QUALITY);
    }
    for (int s = 0; s < report->sweep_count; s++) {
        write_sweep(report, pictures, s, out);
    }
}
