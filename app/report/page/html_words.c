// The foot of the HTML page: noise floors, steps left out, and what the words mean.
#include "app/report/page/html_parts.h"

#include "app/files/put.h"

static void write_left_out(const DipCostReport *report, FILE *out) {
    if (report->refused_count == 0) {
        return;
    }
    dip_put_html(out, "<h2>Steps left out</h2>\n<ul>\n");
    for (int i = 0; i < report->refused_count; i++) {
        dip_put_html(out, "<li>");
        dip_put_html(out, "%s", report->refused[i]);
        dip_put_html(out, "</li>\n");
    }
    dip_put_html(out, "</ul>\n");
}

void dip_html_truth(const DipCostReport *report, FILE *out) {
    dip_put_html(out, "<h2 id=\"truth\">The truth and its noise floor</h2>\n");
    dip_html_table_begin(out, "noise-floors", NULL);
    dip_put_html(out,
                 "The truth (converged picture) is the mean of two independent halves. Half of "
                 "their difference is its noise floor. Combinations whose FLIP is below the "
                 "truth's rank alike.");
    dip_html_columns_begin(out);
    dip_html_text_column(out, "path");
    dip_html_column(out, "RMSE of the truth", "linear");
    dip_html_column(out, "FLIP of the truth", NULL);
    dip_html_column(out, "PSNR between the halves", "dB");
    dip_html_column(out, "SSIM between the halves", NULL);
    dip_html_column(out, "FLIP between the halves", NULL);
    dip_html_columns_end(out);
    for (int p = 0; p < report->path_count; p++) {
        const DipMetricSums sums = dip_cost_floor(report, p);
        const DipMetrics halves = dip_metrics_of(&sums, 0);
        dip_put_html(out,
                     "<tr><th scope=\"row\">%s</th><td>%.5f</td><td>%.4f</td><td>%.2f</td>"
                     "<td>%.4f</td><td>%.4f</td></tr>\n",
                     report->paths[p], dip_cost_floor_rmse(report, p, 0),
                     dip_cost_floor_flip(report, p), halves.psnr_db, halves.ssim, halves.flip);
    }
    dip_html_table_end(out);
    write_left_out(report, out);
}

void dip_html_words(const DipCostReport *report, FILE *out) {
    dip_put_html(
        out,
        "<h2 id=\"words\">What the words mean</h2>\n"
        "<dl>\n"
        "<dt>ratio</dt><dd>The step's time for the whole path divided by the baseline's. Each "
        "frame was timed beside the baseline's same frame. The 95 %% interval comes from a "
        "bootstrap.</dd>\n"
        "<dt>mean, p95</dt><dd>Mean and 95th percentile of the times of the frames along the path, "
        "in milliseconds, in this run.</dd>\n"
        "<dt>truth</dt><dd>The converged picture: jittered supersampling in linear light. Every "
        "sample is shaded at its own position, and textures are read from their largest level. An "
        "error below three times the truth's noise floor is &ldquo;at floor&rdquo;, since it "
        "cannot be told from the truth's own noise.</dd>\n"
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
