// The foot of the HTML page: noise floors, steps left out, and what the words mean.
#include "app/report/page/html_parts.h"

#include "app/files/put.h"
#include "app/report/format/cost_fields.h"

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

static void write_word(void *out, const DipField *field, const void *value) {
    (void)value;
    dip_put_html(out, "<dt>%s</dt><dd>%s</dd>\n", field->title, field->means);
}

// Explains fields of a record by their own sentences.
static void write_words(const DipRecord *record, const char *const *paths, int count, FILE *out) {
    const DipFieldAt nothing = {NULL, NULL, 0, NULL};
    for (int i = 0; i < count; i++) {
        dip_field_visit(record, &nothing, paths[i], write_word, out);
    }
}

void dip_html_words(const DipCostReport *report, FILE *out) {
    static const char *const times[] = {"ratio", "ms", "p95_ms"};
    static const char *const metrics[] = {"rmse_lin", "psnr_db", "ssim", "flip"};
    static const char *const others[] = {"over_time.flicker_rms_lin",
                                         "over_time.two_frame_mean_rms_lin", "at_floor"};
    dip_put_html(out, "<h2 id=\"words\">What the words mean</h2>\n<dl>\n");
    write_words(&dip_cost_row_record, times, 3, out);
    dip_put_html(out,
                 "<dt>truth</dt><dd>The converged picture: jittered supersampling in linear light. "
                 "Every sample is shaded at its own position, and textures are read from their "
                 "largest level.</dd>\n");
    write_words(&dip_cost_metrics_record, metrics, 4, out);
    write_words(&dip_cost_row_record, others, 3, out);
    dip_put_html(out, "</dl>\n<p>FLIP is that of %g pixels per degree.</p>\n",
                 report->options.pixels_per_degree);
}
