// Writes each sweep (all steps of one setting) into the page: bars of time and error, a table of
// the steps, and pictures.
#include "app/report/page/html_parts.h"

#include "app/files/put.h"

#include <math.h>

// The layout of a sweep's bars, in pixels.
enum {
    BAR_WIDTH = 760,
    BAR_LEFT = 130,
    BAR_ROOM = 230, // Width of the longest bar and its number.
    BAR_SECOND = 500,
    BAR_LINE = 26,
    BAR_TOP = 34
};

// --- bars --------------------------------------------------------------------------------------

// The greatest values of a sweep, which get the longest bars.
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
        scale.most_flip = fmax(scale.most_flip, dip_cost_row_metrics(report, sweep->rows[i]).flip);
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
    char text[DIP_NUMBER_BYTES];
    const double room = BAR_ROOM - 60.0;
    const DipEstimate ratio = sweep->ratios[index];
    // The ratio of the base step, with which the other steps are compared, has no interval (NAN).
    const double end = BAR_LEFT + room * fmax(ratio.value, ratio.high) / most;
    write_bar(out, BAR_LEFT, y, room * ratio.value / most, "bar-time");
    if (!isnan(ratio.low)) {
        dip_put_html(
            out, "<line class=\"bar-interval\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\"/>",
            BAR_LEFT + room * ratio.low / most, y + 8.0, end, y + 8.0);
    }
    const bool is_base = sweep->rows[index] == sweep->base;
    dip_ratio_number(ratio.value, report->verdict == DIP_COST_RED && !is_base, text);
    dip_put_html(out, "<text x=\"%.1f\" y=\"%.1f\">%s</text>\n", end + 6.0, y + 13.0, text);
}

static void write_bars_of(const DipCostReport *report, const DipCostSweep *sweep, int index,
                          const Scale *scale, FILE *out) {
    const int row = sweep->rows[index];
    const double y = BAR_TOP + index * BAR_LINE;
    const double flip = dip_cost_row_metrics(report, row).flip;
    const double width = (BAR_ROOM - 40.0) * flip / scale->most_flip;
    char step[DIP_COST_TEXT];
    dip_cost_step_text(report, sweep, row, step);
    char title[DIP_HTML_TITLE_BYTES];
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
        report->rounds > 0 ? "time, ratio to the base" : "", BAR_SECOND);
    for (int i = 0; i < sweep->row_count; i++) {
        write_bars_of(report, sweep, i, &scale, out);
    }
    dip_put_html(out, "</svg>\n</div>\n");
}

// --- sweeps --------------------------------------------------------------------------------------

static void write_sweep(DipForm *form, const DipCostReport *report, const DipCostPictures *pictures,
                        int number) {
    const DipCostSweep *sweep = &report->sweeps[number];
    char title[DIP_COST_TEXT], set[32];
    dip_cost_sweep_title(report, sweep, title);
    snprintf(set, sizeof set, "sweep-%d", number);
    dip_put_html(form->out,
                 "<section aria-labelledby=\"%s\">\n<h3 id=\"%s\">%s <small>on path "
                 "%s</small></h3>\n",
                 set, set, title, report->paths[sweep->path]);
    write_bars(report, sweep, number, form->out);
    dip_section_sweep(form, report, number);
    if (pictures) {
        dip_html_pictures(report, &pictures->sweeps[number], set, sweep, form->out);
    }
    dip_put_html(form->out, "</section>\n");
}

void dip_html_sweeps(DipForm *form, const DipCostReport *report, const DipCostPictures *pictures) {
    const bool full = report->options.pictures == DIP_COST_PICTURES_FULL;
    if (report->sweep_count == 0) {
        return;
    }
    dip_form_heading(form, "settings", "Each setting, on the path made for it");
    dip_form_paragraph(form, NULL,
                       "Errors compare with the truth, the converged picture. Lower is better; for "
                       "PSNR and SSIM, higher is better. The lines on the bars of time are 95 %% "
                       "intervals.");
    if (pictures && report->options.pictures != DIP_COST_PICTURES_NONE) {
        dip_form_paragraph(
            form, NULL,
            "Each crop is the part of the picture in which the steps differ most. Below it is its "
            "FLIP map: black means no visible difference, yellow means the greatest possible "
            "difference.");
    }
    if (pictures && full) {
        dip_form_paragraph(form, NULL,
                           "Whole frames are JPEG files of quality %d. Differences of a few codes "
                           "between them may come from the compression. Crops are without loss.",
                           DIP_COST_FRAME_QUALITY);
    }
    for (int s = 0; s < report->sweep_count; s++) {
        write_sweep(form, report, pictures, s);
    }
}
