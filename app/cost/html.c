// Writing the HTML page: facts, advice, the plot of time against error, explanations. Plots are
// SVG. The page has no script.
#include "app/cost/html.h"

#include "app/cost/fit.h"
#include "app/cost/html_sweeps.h"
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
    ".verdict{padding:.4rem .8rem;border-left:.4rem solid #009e73}"
    ".amber{border-color:#e69f00}.red{border-color:#d55e00}"
    ".note{color:#555;font-size:.9rem}dl{font-size:.9rem}dt{font-weight:bold}dd{margin:0 0 .4rem}";

static void write_row_text(const DipCostReport *report, int row, FILE *out) {
    char settings[DIP_COST_TEXT];
    dip_cost_settings_text(&report->rows[row].quality, settings);
    dip_markup_text(out, settings);
}

// --- head --------------------------------------------------------------------------------------

// The verdict on the machine, and the A/A rows of all paths.
static void write_verdict(const DipCostReport *report, FILE *out) {
    fprintf(out, "<p class=\"verdict %s\"><b>The machine was %s.</b> ",
            dip_cost_verdict_names[report->verdict], dip_cost_verdict_names[report->verdict]);
    dip_markup_text(out, report->verdict_reason);
    fprintf(out,
            "%s</p>\n<p><b>A/A:</b> on each path, the baseline was timed twice, as if it were "
            "two settings. Differences between settings that are smaller than these are noise:",
            report->verdict == DIP_COST_RED
                ? " The times below are wrong, and no settings are advised."
                : "");
    for (int p = 0; p < report->path_count; p++) {
        const DipStatsEstimate same = report->rows[report->same_rows[p]].time.ratio;
        fprintf(out, "%s %s %.3f (%.3f to %.3f)", p ? "," : "", report->paths[p], same.value,
                same.low, same.high);
    }
    fprintf(out, ".</p>\n");
}

static void write_facts(const DipCostReport *report, FILE *out) {
    const DipCostOptions *o = &report->options;
    char baseline[DIP_COST_TEXT];
    dip_cost_settings_text(&report->options.baseline, baseline);
    fprintf(out, "<h1>What accuracy costs: ");
    dip_markup_text(out, report->scene);
    fprintf(out, "</h1>\n<p>%d&times;%d pixels, on ", report->width, report->height);
    dip_markup_text(out, report->processor);
    fprintf(out,
            ", %d thread%s, %s. Times were taken of %d frames along each path, in %d rounds of "
            "random order, each beside a time of the baseline. Errors were taken at %d viewpoint%s "
            "on each path, %d successive frame%s "
            "at each, against a converged picture (the truth) of 2&times;%d samples per pixel. "
            "Settings of the baseline: %s.",
            report->threads, dip_cost_plural(report->threads), report->isa,
            dip_cost_frame_count(report), report->rounds, o->places, dip_cost_plural(o->places),
            o->burst, dip_cost_plural(o->burst), o->samples, baseline);
    fprintf(out, "</p>\n");
    if (report->rounds > 0) {
        write_verdict(report, out);
    }
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
            dip_cost_row_metrics(report, next, 0).flip - flip);
}

static void write_advice(const DipCostReport *report, FILE *out) {
    if (report->advice_count == 0) {
        return;
    }
    const char *of = dip_cost_budget_of_names[report->options.budget_of];
    fprintf(
        out,
        "<h2>Best settings for a time budget</h2>\n"
        "<p>For each time budget, the table shows the settings with the least FLIP that are within "
        "the budget: the upper end of the interval of their %s time along the path is at most "
        "the budget. It chooses from %d combinations on path %s. &ldquo;Next better&rdquo; is the "
        "fastest combination whose FLIP is at "
        "least 1 %% below that of the chosen settings.</p>\n"
        "<div class=\"scroll\"><table>\n"
        "<tr><th>budget, ms</th><th class=\"l\">settings</th><th>%s, ms</th><th>95 %% "
        "interval</th><th>FLIP</th><th>RMSE, linear</th><th class=\"l\">next better</th><th>change "
        "of ms</th><th>change of FLIP</th></tr>\n",
        of, report->row_count - report->combined_first, report->paths[0], of);
    for (int i = 0; i < report->advice_count; i++) {
        const DipCostAdvice *advice = &report->advice[i];
        fprintf(out, "<tr><td>%g</td><td class=\"l\">", advice->budget_ms);
        if (advice->row < 0) {
            fprintf(
                out,
                "no measured combination is surely that fast</td><td colspan=\"7\"></td></tr>\n");
            continue;
        }
        const DipMetrics f = dip_cost_row_metrics(report, advice->row, 0);
        write_row_text(report, advice->row, out);
        fprintf(out, "</td><td>%.2f</td><td>%.2f to %.2f</td><td>%.4f</td><td>%.5f</td>",
                advice->ms, advice->ms_low, advice->ms_high, f.flip, f.rmse_lin);
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

// The axes are logarithmic, so an error of 0 is plotted as the least error that is told apart.
static void fill_points(const DipCostReport *report, const int *rows, int count, Points *points) {
    static const double least_flip = 1e-7;
    for (int i = 0; i < count; i++) {
        points->x[i] = dip_cost_ms(report, rows[i]);
        points->y[i] = fmax(dip_cost_row_metrics(report, rows[i], 0).flip, least_flip);
    }
}

static void write_pareto_table(const DipCostReport *report, const int *pareto, int count,
                               FILE *out) {
    fprintf(out,
            "<div class=\"scroll\"><table>\n<tr><th>#</th><th class=\"l\">settings</th><th>ms</th>"
            "<th>FLIP</th><th>RMSE, linear</th><th>change of ms</th>"
            "<th>change of FLIP</th></tr>\n");
    for (int i = 0; i < count; i++) {
        const DipMetrics f = dip_cost_row_metrics(report, pareto[i], 0);
        const double ms = dip_cost_ms(report, pareto[i]);
        fprintf(out, "<tr><td>%d</td><td class=\"l\">", i + 1);
        write_row_text(report, pareto[i], out);
        fprintf(out, "</td><td>%.2f</td><td>%.4f</td><td>%.5f</td>", ms, f.flip, f.rmse_lin);
        if (i > 0) {
            fprintf(out, "<td>%+.2f</td><td>%+.4f</td></tr>\n",
                    ms - dip_cost_ms(report, pareto[i - 1]),
                    f.flip - dip_cost_row_metrics(report, pareto[i - 1], 0).flip);
        } else {
            fprintf(out, "<td></td><td></td></tr>\n");
        }
    }
    fprintf(out, "</table></div>\n");
}

static void write_scatter(const DipCostReport *report, const int *rows, int count,
                          const int *pareto, int kept, Points *all, Points *best, FILE *out) {
    char subtitle[DIP_COST_TEXT];
    fill_points(report, rows, count, all);
    fill_points(report, pareto, kept, best);
    for (int i = 0; i < kept; i++) {
        snprintf(best->label_texts[i], sizeof best->label_texts[i], "%d", i + 1);
        best->labels[i] = best->label_texts[i];
    }
    snprintf(subtitle, sizeof subtitle,
             "%d combinations on path %s, %dx%d pixels; mean of %d frames", count, report->paths[0],
             report->width, report->height, dip_cost_frame_count(report));
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

// Returns false when memory runs out.
static bool write_pareto_front(const DipCostReport *report, FILE *out) {
    const size_t room = (size_t)report->row_count + 1;
    int *rows = malloc(2 * room * sizeof *rows);
    double *values = malloc(4 * room * sizeof *values);
    const char **labels = malloc(room * sizeof *labels);
    char(*label_texts)[12] = malloc(room * sizeof *label_texts);
    const int count = rows ? list_combinations(report, rows) : 0;
    const bool has_room = rows && values && labels && label_texts;
    if (has_room && count > 1) {
        int *pareto = rows + room;
        const int kept = dip_cost_pareto_front_thin(
            report, pareto, dip_cost_pareto_front(report, rows, count, pareto));
        Points all = {values, values + room, NULL, NULL};
        Points best = {values + 2 * room, values + 3 * room, labels, label_texts};
        fprintf(out, "<h2>Time against error</h2>\n"
                     "<p>Both axes are logarithmic. The Pareto front consists of the combinations "
                     "that no other combination beats in both time and error. The FLIP of each "
                     "numbered combination is at least 1 %% below that of the combination with "
                     "the number before.</p>\n");
        write_scatter(report, rows, count, pareto, kept, &all, &best, out);
        write_pareto_table(report, pareto, kept, out);
    }
    free(rows);
    free(values);
    free(labels);
    free(label_texts);
    return has_room;
}

// --- fit, noise floors, words ------------------------------------------------------------------

static void write_fit(const DipCostReport *report, FILE *out) {
    const DipCostFit fit = dip_cost_fit(report);
    if (fit.rows == 0) {
        return;
    }
    fprintf(out,
            "<p>A linear fit explains the times of the stages of %d rows by their work counters: "
            "R&sup2; is %.3f, the median error is %.1f %%. If each row is predicted from all "
            "others, the median error is %.1f %%, and %.0f %% of the rows are predicted within "
            "10 %%. Times per unit of work, in nanoseconds: ",
            fit.rows, fit.r2, 100.0 * fit.median_miss, 100.0 * fit.others.median,
            100.0 * fit.others.within_10);
    bool first = true;
    for (int i = 0; i < fit.count; i++) {
        if (fit.ns[i] > 0.0) {
            fprintf(out, "%s%s %.3g per %s", first ? "" : ", ", fit.stages[i], fit.ns[i],
                    fit.names[i]);
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
        "<h2>What the words mean</h2>\n"
        "<dl>\n"
        "<dt>ratio</dt><dd>The step's time for the whole path divided by the baseline's. Each "
        "frame was timed beside the baseline's same frame. The 95 %% interval comes from a "
        "bootstrap.</dd>\n"
        "<dt>mean, p95</dt><dd>Mean and 95th percentile of the times of the frames along the path, "
        "in milliseconds, in this run.</dd>\n"
        "<dt>truth</dt><dd>The converged picture: jittered supersampling in linear light. Every "
        "sample is shaded at its own position, and textures are read from their largest level. The "
        "truth is the mean of two independent halves. Half of their difference is its noise floor; "
        "an error below three times the floor is &ldquo;at floor&rdquo;, since it cannot be told "
        "from the truth's own noise.</dd>\n"
        "<dt>RMSE</dt><dd>Root mean square error in linear light, 0 to 1.</dd>\n"
        "<dt>PSNR</dt><dd>Peak signal-to-noise ratio on 8-bit sRGB values, in decibels.</dd>\n"
        "<dt>SSIM</dt><dd>Structural similarity of luma, at most 1, on 8-bit sRGB values.</dd>\n"
        "<dt>FLIP</dt><dd>How different two pictures look when one alternates between them, 0 to "
        "1, on 8-bit sRGB values at %g pixels per degree.</dd>\n"
        "<dt>flicker</dt><dd>The part of the error that changes from frame to frame: root mean "
        "square of its deviation over time, in linear light.</dd>\n"
        "<dt>two-frame mean</dt><dd>Root mean square error of the mean of two successive "
        "frames.</dd>\n"
        "</dl>\n",
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
    const bool has_front = write_pareto_front(report, out);
    dip_cost_write_html_sweeps(report, pictures, out);
    if (report->rounds > 0) {
        write_fit(report, out);
    }
    write_foot(report, out);
    fprintf(out, "</body></html>\n");
    bool made = !ferror(out) && has_front;
    made = fclose(out) == 0 && made && page; // glibc sets it to NULL if memory runs out here.
    const bool written = made
                             ? dip_whole_file_write(file, page, size, err)
                             : dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    free(page);
    return written;
}
