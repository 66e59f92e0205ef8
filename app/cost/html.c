// Writing the page. Plots are SVG, pictures are data URIs; there is no script.
#include "app/cost/html.h"

#include "app/cost/fit.h"
#include "app/cost/formats.h"
#include "app/cost/order.h"
#include "app/files/whole_file.h"
#include "app/plot/markup.h"
#include "app/plot/plot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char style[] =
    "body{font:16px/1.5 Helvetica,Arial,'DejaVu Sans',sans-serif;color:#202020;background:#fff;"
    "max-width:1100px;margin:0 auto;padding:1rem}"
    "h1{font-size:1.7rem;margin:.5rem 0}h2{font-size:1.3rem;margin:2.2rem 0 .4rem}"
    "h3{font-size:1.05rem;margin:1.6rem 0 .3rem}"
    "svg{max-width:100%;min-width:600px;height:auto;display:block}"
    ".scroll{overflow-x:auto}"
    "table{border-collapse:collapse;font-size:.9rem;margin:.4rem 0}"
    "th,td{padding:.2rem .6rem;text-align:right;border-bottom:1px solid #ddd;white-space:nowrap}"
    "th:first-child,td:first-child,.l{text-align:left}"
    "th{border-bottom:2px solid #999}"
    ".pictures{display:flex;flex-wrap:wrap;gap:.8rem;margin:.6rem 0}"
    "figure{margin:0;width:200px}figure img{width:200px;display:block;image-rendering:pixelated;"
    "margin-bottom:3px}figcaption{font-size:.85rem}"
    ".note{color:#555;font-size:.9rem}dl{font-size:.9rem}dt{font-weight:bold}dd{margin:0 0 .4rem}";

static void write_row_text(const DipCostReport *report, int row, FILE *out) {
    char settings[DIP_COST_TEXT];
    dip_cost_settings_text(&report->rows[row].quality, settings);
    dip_markup_text(out, settings);
}

static DipMetrics figures_of(const DipCostReport *report, int row, int region) {
    int viewpoints;
    const DipMetricSums sums = dip_cost_row_sums(report, row, &viewpoints);
    return dip_metrics_of(&sums, region);
}

// --- head --------------------------------------------------------------------------------------

static void write_facts(const DipCostReport *report, FILE *out) {
    char baseline[DIP_COST_TEXT];
    dip_cost_settings_text(&report->options.baseline, baseline);
    fprintf(out, "<h1>What accuracy costs: ");
    dip_markup_text(out, report->scene);
    fprintf(out, "</h1>\n<p>%d&times;%d pixels, on ", report->width, report->height);
    dip_markup_text(out, report->processor);
    fprintf(out,
            ", %d thread%s, %s. Times were taken of %d frames of each path, in %d rounds of random "
            "order. Errors were taken at %d viewpoints on each path, %d successive frames at each, "
            "against a truth of 2&times;%d samples per pixel. The baseline is: %s.",
            report->threads, report->threads == 1 ? "" : "s", report->isa,
            report->options.timed_frames, report->rounds, report->options.places,
            report->options.burst, report->options.samples, baseline);
    if (dip_cost_is_timed(report, report->same_row)) {
        const DipStatsEstimate same = dip_cost_ratio(report, report->same_row, 0);
        fprintf(
            out,
            " <b>A/A:</b> the baseline was timed twice, as if it were two settings. The ratio of "
            "the two is %.3f (95 %% interval %.3f to %.3f); smaller differences are noise.",
            same.value, same.low, same.high);
    }
    fprintf(out, "</p>\n");
}

// --- advice ------------------------------------------------------------------------------------

static void write_next_better(const DipCostReport *report, int row, double flip, FILE *out) {
    const int next = dip_cost_step_up(report, row);
    if (next < 0) {
        fprintf(out, "<td class=\"l\">none</td><td colspan=\"2\"></td></tr>\n");
        return;
    }
    fprintf(out, "<td class=\"l\">");
    write_row_text(report, next, out);
    fprintf(out, "</td><td>%+.2f</td><td>%+.4f</td></tr>\n",
            dip_cost_ms(report, next) - dip_cost_ms(report, row),
            figures_of(report, next, 0).flip - flip);
}

static void write_advice(const DipCostReport *report, FILE *out) {
    if (report->advice_count == 0) {
        return;
    }
    fprintf(out,
            "<h2>Best settings for a time budget</h2>\n<p>For each budget, the one of %d "
            "combinations on path %s that has the least FLIP within it. Its time was measured "
            "again. &ldquo;Next better&rdquo; is the fastest combination whose FLIP is at least "
            "1 %% lower.</p>\n<div class=\"scroll\"><table>\n"
            "<tr><th>budget, ms</th><th class=\"l\">settings</th><th>time again, ms</th><th>95 %% "
            "interval</th>"
            "<th>FLIP</th><th>RMSE, linear</th><th class=\"l\">next better</th>"
            "<th>change of ms</th><th>change of FLIP</th></tr>\n",
            report->row_count - report->combined_first, report->paths[0]);
    for (int i = 0; i < report->advice_count; i++) {
        const DipCostAdvice *advice = &report->advice[i];
        fprintf(out, "<tr><td>%g</td><td class=\"l\">", advice->budget_ms);
        if (advice->row < 0) {
            fprintf(out, "no measured combination is that fast</td><td colspan=\"7\"></td></tr>\n");
            continue;
        }
        const DipMetrics f = figures_of(report, advice->row, 0);
        write_row_text(report, advice->row, out);
        fprintf(out, "</td><td>%.2f</td><td>%.2f to %.2f</td><td>%.4f</td><td>%.5f</td>",
                advice->checked_ms, advice->checked_low, advice->checked_high, f.flip, f.rmse_lin);
        write_next_better(report, advice->row, f.flip, out);
    }
    fprintf(out, "</table></div>\n");
}

// --- time against error ------------------------------------------------------------------------

static int list_combinations(const DipCostReport *report, int *rows) {
    int count = 0;
    for (int r = report->combined_first; r < report->row_count; r++) {
        int viewpoints;
        dip_cost_row_sums(report, r, &viewpoints);
        if (viewpoints > 0 && dip_cost_is_timed(report, r)) {
            rows[count++] = r;
        }
    }
    return count;
}

typedef struct Points {
    double *x;
    double *y;
    const char **labels;
    char (*label_texts)[12];
} Points;

static void fill_points(const DipCostReport *report, const int *rows, int count, Points *points) {
    for (int i = 0; i < count; i++) {
        points->x[i] = dip_cost_ms(report, rows[i]);
        points->y[i] = figures_of(report, rows[i], 0).flip;
    }
}

static void write_pareto_table(const DipCostReport *report, const int *front, int count,
                               FILE *out) {
    fprintf(out,
            "<div class=\"scroll\"><table>\n<tr><th>#</th><th class=\"l\">settings</th><th>ms</th>"
            "<th>FLIP</th><th>RMSE, linear</th><th>change of ms</th>"
            "<th>change of FLIP</th></tr>\n");
    for (int i = 0; i < count; i++) {
        const DipMetrics f = figures_of(report, front[i], 0);
        const double ms = dip_cost_ms(report, front[i]);
        fprintf(out, "<tr><td>%d</td><td class=\"l\">", i + 1);
        write_row_text(report, front[i], out);
        fprintf(out, "</td><td>%.2f</td><td>%.4f</td><td>%.5f</td>", ms, f.flip, f.rmse_lin);
        if (i > 0) {
            fprintf(out, "<td>%+.2f</td><td>%+.4f</td></tr>\n",
                    ms - dip_cost_ms(report, front[i - 1]),
                    f.flip - figures_of(report, front[i - 1], 0).flip);
        } else {
            fprintf(out, "<td></td><td></td></tr>\n");
        }
    }
    fprintf(out, "</table></div>\n");
}

static void write_scatter(const DipCostReport *report, const int *rows, int count, const int *front,
                          int kept, Points *all, Points *best, FILE *out) {
    char subtitle[DIP_COST_TEXT];
    fill_points(report, rows, count, all);
    fill_points(report, front, kept, best);
    for (int i = 0; i < kept; i++) {
        snprintf(best->label_texts[i], sizeof best->label_texts[i], "%d", i + 1);
        best->labels[i] = best->label_texts[i];
    }
    snprintf(subtitle, sizeof subtitle,
             "%d combinations on path %s, %dx%d pixels; medians of %d rounds", count,
             report->paths[0], report->width, report->height, report->rounds);
    const DipPlotSeries series[2] = {
        {.name = "all combinations", .x = all->x, .y = all->y, .count = count, .marks_only = true},
        {.name = "Pareto front", .x = best->x, .y = best->y, .count = kept, .labels = best->labels},
    };
    const DipPlot plot = {
        .title = "Time against error",
        .subtitle = subtitle,
        .x_title = "time of a frame, ms",
        .y_title = "FLIP against the truth, mean",
        .log_x = true,
        .log_y = true,
        .series = series,
        .series_count = 2,
    };
    fprintf(out, "<div class=\"scroll\">\n");
    dip_plot_print(out, &plot);
    fprintf(out, "</div>\n");
}

static void write_pareto_front(const DipCostReport *report, FILE *out) {
    const size_t room = (size_t)report->row_count + 1;
    int *rows = malloc(2 * room * sizeof *rows);
    double *values = malloc(4 * room * sizeof *values);
    const char **labels = malloc(room * sizeof *labels);
    char(*label_texts)[12] = malloc(room * sizeof *label_texts);
    const int count = rows ? list_combinations(report, rows) : 0;
    if (rows && values && labels && label_texts && count > 1) {
        int *front = rows + room;
        const int kept = dip_cost_pareto_front_thin(
            report, front, dip_cost_pareto_front(report, rows, count, front));
        Points all = {values, values + room, NULL, NULL};
        Points best = {values + 2 * room, values + 3 * room, labels, label_texts};
        fprintf(out, "<h2>Time against error</h2>\n<p>Both axes are logarithmic. The Pareto front "
                     "holds the combinations that no other beats in both time and error. Numbers "
                     "mark those that lower FLIP by at least 1 %% below the one before.</p>\n");
        write_scatter(report, rows, count, front, kept, &all, &best, out);
        write_pareto_table(report, front, kept, out);
    }
    free(rows);
    free(values);
    free(labels);
    free(label_texts);
}

// --- sweeps ------------------------------------------------------------------------------------

// Pixels of a sweep's bars.
enum {
    BAR_WIDTH = 760,
    BAR_LEFT = 130,
    BAR_ROOM = 230, // width of a full bar and the number behind it
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

typedef struct Scale {
    double most_ratio;
    double most_flip;
} Scale;

static Scale find_scale(const DipCostReport *report, const DipCostSweep *sweep) {
    Scale scale = {1e-9, 1e-9};
    for (int i = 0; i < sweep->row_count; i++) {
        if (dip_cost_is_timed(report, sweep->rows[i])) {
            scale.most_ratio =
                fmax(scale.most_ratio, dip_cost_ratio(report, sweep->rows[i], sweep->base).high);
        }
        scale.most_flip = fmax(scale.most_flip, figures_of(report, sweep->rows[i], 0).flip);
    }
    return scale;
}

static void write_time_bar(const DipCostReport *report, const DipCostSweep *sweep, int row,
                           double y, double most, FILE *out) {
    if (!dip_cost_is_timed(report, row)) {
        return;
    }
    const double room = BAR_ROOM - 60.0;
    const DipStatsEstimate ratio = dip_cost_ratio(report, row, sweep->base);
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
        const double flip = figures_of(report, row, 0).flip;
        char step[DIP_COST_TEXT];
        char number[32];
        dip_cost_step_text(report, sweep, row, step);
        fprintf(out, "<text x=\"%d\" y=\"%.1f\" text-anchor=\"end\">%s</text>\n", BAR_LEFT - 8,
                y + 13.0, step);
        write_time_bar(report, sweep, row, y, scale.most_ratio, out);
        snprintf(number, sizeof number, "%.4f", flip);
        write_bar(out, BAR_SECOND, y, (BAR_ROOM - 40.0) * flip / scale.most_flip, "#d55e00",
                  number);
    }
    fprintf(out, "</svg>\n</div>\n");
}

static void write_step_row(const DipCostReport *report, const DipCostSweep *sweep, int row,
                           FILE *out) {
    int viewpoints;
    char step[DIP_COST_TEXT];
    const DipMetricSums sums = dip_cost_row_sums(report, row, &viewpoints);
    const DipMetrics f = dip_metrics_of(&sums, 0);
    const DipFlickerMetrics flicker = dip_flicker_metrics_of(&sums);
    dip_cost_step_text(report, sweep, row, step);
    fprintf(out, "<tr><td>%s%s</td>", step, row == sweep->base ? " (baseline)" : "");
    if (dip_cost_is_timed(report, row)) {
        const DipStatsEstimate ratio = dip_cost_ratio(report, row, sweep->base);
        fprintf(out, "<td>%.2f</td><td>%.3f</td><td>%.3f to %.3f</td>", dip_cost_ms(report, row),
                ratio.value, ratio.low, ratio.high);
    } else {
        fprintf(out, "<td></td><td></td><td></td>");
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

static void write_sweeps(const DipCostReport *report, const DipCostPictures *pictures, FILE *out) {
    fprintf(out, "<h2>Each setting, on the path made for it</h2>\n"
                 "<p class=\"note\">Black lines are 95 %% intervals. Errors compare with the "
                 "converged picture. Lower is better; for PSNR and SSIM, higher is better. The "
                 "pictures show the part in which the steps differ most, pixel for pixel. Below "
                 "each is its FLIP map: black means no visible difference, yellow the greatest "
                 "possible.</p>\n");
    for (int s = 0; s < report->sweep_count; s++) {
        const DipCostSweep *sweep = &report->sweeps[s];
        fprintf(out, "<h3>%s <span class=\"note\">(path %s)</span></h3>\n", sweep->title,
                report->paths[sweep->path]);
        write_bars(report, sweep, out);
        fprintf(out, "<div class=\"scroll\"><table>\n<tr><th>step</th><th>ms</th><th>ratio</th>"
                     "<th>95 %% interval</th><th>RMSE, linear</th><th>PSNR, dB</th><th>SSIM</th>"
                     "<th>FLIP</th><th>flicker</th><th>two-frame mean</th><th></th></tr>\n");
        for (int i = 0; i < sweep->row_count; i++) {
            write_step_row(report, sweep, sweep->rows[i], out);
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
    fprintf(out,
            "<h2>Where the errors are</h2>\n<p class=\"note\">Mean FLIP over the pixels of each "
            "class; in brackets, the share of all pixels that belong to it.</p>\n"
            "<div class=\"scroll\"><table>\n<tr><th>setting</th><th class=\"l\">step</th>");
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
    fprintf(out,
            "<h2>Work</h2>\n<p class=\"note\">Work counters, in thousands per frame: means over "
            "the timed frames. They are exact, and the same on every machine and for any "
            "number of threads.</p>\n"
            "<div class=\"scroll\"><table>\n<tr><th>setting</th><th class=\"l\">step</th>");
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

static void write_fit(const DipCostReport *report, FILE *out) {
    const DipCostFit fit = dip_cost_fit(report);
    if (fit.rows == 0) {
        return;
    }
    fprintf(out,
            "<p>Time explained by work, a linear fit to %d rows: R&sup2; is %.3f, the median error "
            "is %.1f %%. Prices in nanoseconds: ",
            fit.rows, fit.r2, 100.0 * fit.median_miss);
    bool first = true;
    for (int i = 0; i < fit.count; i++) {
        if (fit.ns[i] > 0.0) {
            fprintf(out, "%s%.3g per %s", first ? "" : ", ", fit.ns[i], fit.names[i]);
            first = false;
        }
    }
    fprintf(out, ".</p>\n");
}

static void write_foot(const DipCostReport *report, FILE *out) {
    fprintf(out,
            "<h2>The truth and its noise floor</h2>\n<div class=\"scroll\"><table>\n<tr><th>path"
            "</th><th>RMSE of the truth, linear</th><th>FLIP between the two halves</th></tr>"
            "\n");
    for (int p = 0; p < report->path_count; p++) {
        const DipMetricSums sums = dip_cost_floor(report, p);
        fprintf(out, "<tr><td>%s</td><td>%.5f</td><td>%.4f</td></tr>\n", report->paths[p],
                dip_cost_floor_rmse(report, p, 0), dip_metrics_of(&sums, 0).flip);
    }
    fprintf(out, "</table></div>\n");
    if (report->refused_count) {
        fprintf(out, "<h2>Steps left out</h2>\n<ul>\n");
        for (int i = 0; i < report->refused_count; i++) {
            fprintf(out, "<li>");
            dip_markup_text(out, report->refused[i]);
            fprintf(out, "</li>\n");
        }
        fprintf(out, "</ul>\n");
    }
    fprintf(
        out,
        "<h2>What the words mean</h2>\n<dl>\n"
        "<dt>ratio</dt><dd>The step's time divided by the baseline's in the same round: the median "
        "over rounds and frames. The interval is a bootstrap over rounds.</dd>\n"
        "<dt>truth</dt><dd>The converged picture: jittered supersampling in linear light. Every "
        "sample is shaded at its own position, and textures are read from their largest level. "
        "The truth is the mean of two independent halves. Half of their difference is its noise "
        "floor; an error below three times the floor is &ldquo;at floor&rdquo;, since it cannot "
        "be told from the truth's own noise.</dd>\n"
        "<dt>RMSE</dt><dd>Root mean square error in linear light, 0 to 1.</dd>\n"
        "<dt>PSNR</dt><dd>Peak signal-to-noise ratio on 8-bit sRGB codes, in decibels.</dd>\n"
        "<dt>SSIM</dt><dd>Structural similarity of luma, at most 1, on 8-bit sRGB codes.</dd>\n"
        "<dt>FLIP</dt><dd>How different two pictures look when one alternates between them, 0 to "
        "1, on 8-bit sRGB codes at %g pixels per degree.</dd>\n"
        "<dt>flicker</dt><dd>The part of the error that changes from frame to frame: root mean "
        "square of its deviation over time, in linear light.</dd>\n"
        "<dt>two-frame mean</dt><dd>Root mean square error of the mean of two successive "
        "frames.</dd>\n</dl>\n",
        report->options.pixels_per_degree);
}

bool dip_cost_write_html(const DipCostReport *report, const DipCostPictures *pictures,
                         const char *file, DipError *err) {
    char *page = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&page, &size);
    if (!out) {
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    }
    fprintf(out,
            "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
            "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
            "<title>What accuracy costs</title>\n<style>%s</style></head><body>\n",
            style);
    write_facts(report, out);
    write_advice(report, out);
    write_pareto_front(report, out);
    write_sweeps(report, pictures, out);
    write_regions(report, out);
    if (report->rounds > 0) {
        write_counters(report, out);
        write_fit(report, out);
    }
    write_foot(report, out);
    fprintf(out, "</body></html>\n");
    const bool made = !ferror(out);
    const bool written = fclose(out) == 0 && made
                             ? dip_whole_file_write(file, page, size, err)
                             : dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    free(page);
    return written;
}
