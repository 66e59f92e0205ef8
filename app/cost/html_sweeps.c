// Writing the sweeps of the HTML page. A sweep is all steps of one setting. The bars are SVG, the
// tables are HTML, the pictures are data URIs.
#include "app/cost/html_sweeps.h"

#include "app/cost/order.h"
#include "app/plot/markup.h"

#include <math.h>

// --- sweeps ------------------------------------------------------------------------------------

// The layout of a sweep's bars, in pixels.
enum {
    BAR_WIDTH = 760,
    BAR_LEFT = 130,
    BAR_ROOM = 230, // width of the longest bar and its number
    BAR_SECOND = 500,
    BAR_LINE = 26,
    BAR_TOP = 34
};

static void write_bar(FILE *out, double x, double y, double width, const char *colour,
                      const char *number) {
    fprintf(out,
            "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"16\" fill=\"%s\"/>"
            "<text x=\"%.1f\" y=\"%.1f\">%s</text>\n",
            x, y, width, colour, x + width + 6.0, y + 13.0, number);
}

// The greatest values of a sweep. They get the longest bars.
typedef struct Scale {
    double most_ratio;
    double most_flip;
} Scale;

static Scale find_scale(const DipCostReport *report, const DipCostSweep *sweep) {
    Scale scale = {1e-9, 1e-9};
    for (int i = 0; i < sweep->row_count; i++) {
        if (dip_cost_is_timed(report, sweep->rows[i])) {
            scale.most_ratio = fmax(scale.most_ratio, sweep->ratios[i].high);
        }
        scale.most_flip =
            fmax(scale.most_flip, dip_cost_row_metrics(report, sweep->rows[i], 0).flip);
    }
    return scale;
}

static void write_time_bar(const DipCostReport *report, const DipCostSweep *sweep, int index,
                           double y, double most, FILE *out) {
    if (!dip_cost_is_timed(report, sweep->rows[index])) {
        return;
    }
    const double room = BAR_ROOM - 60.0;
    const DipStatsEstimate ratio = sweep->ratios[index];
    char number[32];
    snprintf(number, sizeof number, "%.2f", ratio.value);
    const double end = BAR_LEFT + room * ratio.high / most;
    fprintf(out,
            "<rect x=\"%d\" y=\"%.1f\" width=\"%.1f\" height=\"16\" fill=\"#0072b2\"/>"
            "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#202020\" "
            "stroke-width=\"2\"/><text x=\"%.1f\" y=\"%.1f\">%s</text>\n",
            BAR_LEFT, y, room * ratio.value / most, BAR_LEFT + room * ratio.low / most, y + 8.0,
            end, y + 8.0, end + 6.0, y + 13.0, number);
}

static void write_bars(const DipCostReport *report, const DipCostSweep *sweep, FILE *out) {
    const Scale scale = find_scale(report, sweep);
    const int height = BAR_TOP + sweep->row_count * BAR_LINE + 4;
    fprintf(out,
            "<div class=\"scroll\">\n<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d "
            "%d\" width=\"%d\" "
            "height=\"%d\" font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\" "
            "font-size=\"13\" fill=\"#202020\">\n"
            "<text x=\"%d\" y=\"20\" font-weight=\"bold\">time, ratio to the baseline</text>"
            "<text x=\"%d\" y=\"20\" font-weight=\"bold\">FLIP, mean</text>\n",
            BAR_WIDTH, height, BAR_WIDTH, height, BAR_LEFT, BAR_SECOND);
    for (int i = 0; i < sweep->row_count; i++) {
        const int row = sweep->rows[i];
        const double y = BAR_TOP + i * BAR_LINE;
        const double flip = dip_cost_row_metrics(report, row, 0).flip;
        char step[DIP_COST_TEXT];
        char number[32];
        dip_cost_step_text(report, sweep, row, step);
        fprintf(out, "<text x=\"%d\" y=\"%.1f\" text-anchor=\"end\">%s</text>\n", BAR_LEFT - 8,
                y + 13.0, step);
        write_time_bar(report, sweep, i, y, scale.most_ratio, out);
        snprintf(number, sizeof number, "%.4f", flip);
        write_bar(out, BAR_SECOND, y, (BAR_ROOM - 40.0) * flip / scale.most_flip, "#d55e00",
                  number);
    }
    fprintf(out, "</svg>\n</div>\n");
}

static void write_step_row(const DipCostReport *report, const DipCostSweep *sweep, int index,
                           FILE *out) {
    const int row = sweep->rows[index];
    int viewpoints;
    char step[DIP_COST_TEXT];
    const DipMetricSums sums = dip_cost_row_sums(report, row, &viewpoints);
    const DipMetrics f = dip_metrics_of(&sums, 0);
    const DipFlickerMetrics flicker = dip_flicker_metrics_of(&sums);
    dip_cost_step_text(report, sweep, row, step);
    fprintf(out, "<tr><td>%s%s</td>", step, row == sweep->base ? " (baseline)" : "");
    if (dip_cost_is_timed(report, row)) {
        const DipStatsEstimate ratio = sweep->ratios[index];
        fprintf(out, "<td>%.2f</td><td>%.2f</td><td>%.3f</td><td>%.3f to %.3f</td>",
                dip_cost_ms(report, row), report->rows[row].time.p95_ms.value, ratio.value,
                ratio.low, ratio.high);
    } else {
        fprintf(out, "<td></td><td></td><td></td><td></td>");
    }
    fprintf(out,
            "<td>%.5f</td><td>%.2f</td><td>%.4f</td><td>%.4f</td><td>%.5f</td><td>%.5f</td>"
            "<td>%s</td></tr>\n",
            f.rmse_lin, f.psnr_db, f.ssim, f.flip, flicker.flicker, flicker.two_mean,
            dip_cost_floor_mark(report, row));
}

static void write_figure(FILE *out, const char *picture, const char *map, const char *caption,
                         const char *alt) {
    fprintf(out, "<figure><img alt=\"%s\" src=\"data:image/png;base64,%s\">", alt, picture);
    if (map) {
        fprintf(out, "<img alt=\"FLIP of %s\" src=\"data:image/png;base64,%s\">", alt, map);
    }
    fprintf(out, "<figcaption>%s</figcaption></figure>\n", caption);
}

static void write_crops(const DipCostReport *report, const DipCostSweep *sweep,
                        const DipCostCrops *crops, FILE *out) {
    fprintf(out, "<div class=\"pictures\">\n");
    if (crops->truth) {
        write_figure(out, crops->truth, NULL, "truth", "truth");
    }
    for (int i = 0; i < sweep->row_count; i++) {
        if (crops->steps[i] && crops->maps[i]) {
            char step[DIP_COST_TEXT];
            dip_cost_step_text(report, sweep, sweep->rows[i], step);
            write_figure(out, crops->steps[i], crops->maps[i], step, step);
        }
    }
    fprintf(out, "</div>\n");
}

static void write_all_sweeps(const DipCostReport *report, const DipCostPictures *pictures,
                             FILE *out) {
    fprintf(out, "<h2>Each setting, on the path made for it</h2>\n"
                 "<p class=\"note\">Black lines are 95 %% intervals. Errors are measured against "
                 "the converged picture. Lower is better; for PSNR and SSIM, higher is better. The "
                 "pictures show, pixel for pixel, the part in which the steps differ most. Below "
                 "each picture is its FLIP map: black means no visible difference, yellow means "
                 "the greatest possible difference.</p>\n");
    for (int s = 0; s < report->sweep_count; s++) {
        const DipCostSweep *sweep = &report->sweeps[s];
        fprintf(out, "<h3>%s <span class=\"note\">(path %s)</span></h3>\n", sweep->title,
                report->paths[sweep->path]);
        write_bars(report, sweep, out);
        fprintf(out, "<div class=\"scroll\"><table>\n<tr><th>step</th><th>mean ms</th><th>p95 "
                     "ms</th><th>ratio</th>"
                     "<th>95 %% interval</th><th>RMSE, linear</th><th>PSNR, dB</th><th>SSIM</th>"
                     "<th>FLIP</th><th>flicker</th><th>two-frame mean</th><th></th></tr>\n");
        for (int i = 0; i < sweep->row_count; i++) {
            write_step_row(report, sweep, i, out);
        }
        fprintf(out, "</table></div>\n");
        char order[2 * DIP_COST_TEXT];
        if (dip_cost_order_text(report, sweep, order, sizeof order)) {
            fprintf(out, "<p class=\"note\">");
            dip_markup_text(out, order);
            fprintf(out, "</p>\n");
        }
        if (pictures) {
            write_crops(report, sweep, &pictures->sweeps[s], out);
        }
    }
}

// --- regions, counters -------------------------------------------------------------------------

static void write_regions(const DipCostReport *report, FILE *out) {
    fprintf(out, "<h2>Where the errors are</h2>\n"
                 "<p class=\"note\">Mean FLIP over the pixels of each class. The number in "
                 "brackets is the share of all pixels that belong to the class.</p>\n"
                 "<div class=\"scroll\"><table>\n"
                 "<tr><th>setting</th><th class=\"l\">step</th>");
    for (int r = 0; r < DIP_METRIC_REGION_COUNT; r++) {
        fprintf(out, "<th>%s</th>", dip_metric_region_names[r]);
    }
    fprintf(out, "</tr>\n");
    for (int s = 0; s < report->sweep_count; s++) {
        const DipCostSweep *sweep = &report->sweeps[s];
        for (int i = 0; i < sweep->row_count; i++) {
            int viewpoints;
            char step[DIP_COST_TEXT];
            const DipMetricSums sums = dip_cost_row_sums(report, sweep->rows[i], &viewpoints);
            dip_cost_step_text(report, sweep, sweep->rows[i], step);
            fprintf(out, "<tr><td>%s</td><td class=\"l\">%s</td>", sweep->title, step);
            for (int r = 0; r < DIP_METRIC_REGION_COUNT; r++) {
                const double share = sums.regions[r].pixels / fmax(sums.regions[0].pixels, 1.0);
                if (share > 0.0) {
                    fprintf(out, "<td>%.4f (%.1f %%)</td>", dip_metrics_of(&sums, r).flip,
                            100.0 * share);
                } else {
                    fprintf(out, "<td>&ndash;</td>");
                }
            }
            fprintf(out, "</tr>\n");
        }
    }
    fprintf(out, "</table></div>\n");
}

static void write_counters(const DipCostReport *report, FILE *out) {
    fprintf(out, "<h2>Work</h2>\n"
                 "<p class=\"note\">Work counters, in thousands per frame: means over the timed "
                 "frames. The counters are exact. They are the same on every machine and with any "
                 "number of threads.</p>\n"
                 "<div class=\"scroll\"><table>\n"
                 "<tr><th>setting</th><th class=\"l\">step</th>");
    for (int c = 0; c < DIP_COST_COUNTER_COUNT; c++) {
        fprintf(out, "<th>");
        for (const char *name = dip_cost_counter_names[c]; *name; name++) {
            *name == '_' ? fputs("<br>", out) : fputc(*name, out);
        }
        fprintf(out, "</th>");
    }
    fprintf(out, "</tr>\n");
    for (int s = 0; s < report->sweep_count; s++) {
        const DipCostSweep *sweep = &report->sweeps[s];
        for (int i = 0; i < sweep->row_count; i++) {
            char step[DIP_COST_TEXT];
            dip_cost_step_text(report, sweep, sweep->rows[i], step);
            fprintf(out, "<tr><td>%s</td><td class=\"l\">%s</td>", sweep->title, step);
            for (int c = 0; c < DIP_COST_COUNTER_COUNT; c++) {
                fprintf(out, "<td>%.4g</td>", report->rows[sweep->rows[i]].counters[c] / 1000.0);
            }
            fprintf(out, "</tr>\n");
        }
    }
    fprintf(out, "</table></div>\n");
}

void dip_cost_write_html_sweeps(const DipCostReport *report, const DipCostPictures *pictures,
                                FILE *out) {
    write_all_sweeps(report, pictures, out);
    write_regions(report, out);
    if (report->rounds > 0) {
        write_counters(report, out);
    }
}
