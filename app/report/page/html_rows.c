// What the HTML page says about a row of the report: a line of text, and pictures.
#include "app/report/page/html_parts.h"

#include "app/report/page/markup.h"

void dip_html_quality(const DipQuality *quality, FILE *out) {
    char settings[DIP_COST_TEXT];
    dip_cost_settings_text(quality, settings);
    for (const char *c = settings; *c; c++) {
        *c == ',' ? fputs(", ", out) : fputc(*c, out);
    }
}

void dip_html_settings(const DipCostReport *report, int row, FILE *out) {
    dip_html_quality(&report->rows[row].quality, out);
}

static void write_time(const DipCostReport *report, int row, FILE *out) {
    const DipPathEstimate *time = &report->rows[row].time;
    char interval[DIP_COST_INTERVAL];
    dip_cost_interval_text(&time->mean_ms, 2, interval);
    fprintf(out, "%.2f ms%s%s%s, 95th percentile %.2f ms", time->mean_ms.value,
            interval[0] ? " (" : "", interval, interval[0] ? ")" : "", time->p95_ms.value);
}

static void write_errors(const DipMetrics *f, FILE *out) {
    fprintf(out, "FLIP %.4f, PSNR %.2f dB, SSIM %.4f, RMSE %.5f", f->flip, f->psnr_db, f->ssim,
            f->rmse_lin);
}

void dip_html_row_title(const DipCostReport *report, int row, FILE *out) {
    const DipMetrics f = dip_cost_row_metrics(report, row, 0);
    dip_html_settings(report, row, out);
    fprintf(out, " on path %s: ", report->paths[report->rows[row].path]);
    if (dip_cost_is_timed(report, row)) {
        write_time(report, row, out);
        fprintf(out, "; ");
    }
    write_errors(&f, out);
}

// None of the texts needs to be escaped in JSON: they are names of settings and paths.
void dip_html_measurements(const DipCostReport *report, FILE *out) {
    fprintf(out, "<script type=\"application/json\" id=\"measurements\">[");
    for (int r = 0; r < report->row_count; r++) {
        int viewpoints;
        const DipMetricSums sums = dip_cost_row_sums(report, r, &viewpoints);
        const DipMetrics f = dip_metrics_of(&sums, 0);
        fprintf(out, "%s\n{\"settings\":\"", r ? "," : "");
        dip_html_settings(report, r, out);
        fprintf(out, "\",\"path\":\"%s\",\"time\":\"", report->paths[report->rows[r].path]);
        if (dip_cost_is_timed(report, r)) {
            write_time(report, r, out);
        }
        fprintf(out, "\",\"errors\":\"");
        if (viewpoints > 0) {
            write_errors(&f, out);
        }
        fprintf(out, "\"}");
    }
    fprintf(out, "]</script>\n");
}

// --- pictures ----------------------------------------------------------------------------------

static void write_image(FILE *out, const char *part, const char *what, const char *name,
                        const char *uri) {
    if (uri) {
        fprintf(out, "<img data-part=\"%s\" alt=\"%s%s\" src=\"%s\">", part, what, name, uri);
    }
}

// The pictures of a set, and how the set is named.
typedef struct Shown {
    const DipCostReport *report;
    const DipCostPictureSet *set;
    const char *name;          // Attribute data-set.
    const DipCostSweep *sweep; // Names the steps; NULL: pictures have the names of settings.
} Shown;

// Returns the caption of a picture.
static const char *caption_of(const Shown *shown, const DipCostPicture *picture,
                              char text[DIP_COST_TEXT]) {
    if (picture->row < 0) {
        return "truth";
    }
    if (shown->sweep) {
        dip_cost_step_text(shown->report, shown->sweep, picture->row, text);
    } else {
        dip_cost_settings_text(&shown->report->rows[picture->row].quality, text);
    }
    return text;
}

// Says which row the picture shows, and where.
static void write_origin(const Shown *shown, int row, FILE *out) {
    const DipCostPictureSet *set = shown->set;
    fprintf(out,
            " data-row=\"%d\" data-where=\"Path %s, viewpoint %d of %d\" "
            "data-corner=\"the crop's upper left corner is at pixel (%d, %d)\"",
            row, shown->report->paths[set->path], set->viewpoint + 1, shown->report->options.places,
            set->x, set->y);
}

static void write_figure(const Shown *shown, const DipCostPicture *picture, FILE *out) {
    char text[DIP_COST_TEXT];
    const bool is_truth = picture->row < 0;
    const char *caption = caption_of(shown, picture, text);
    fprintf(out, "<figure class=\"%s%s\" data-set=\"%s\"", is_truth ? "truth" : "",
            picture->frame ? " frame" : "", shown->name);
    if (!is_truth) {
        write_origin(shown, picture->row, out);
    }
    fprintf(out, ">");
    write_image(out, "frame", "whole frame, ", caption, picture->frame);
    write_image(out, "crop", "", caption, picture->crop);
    write_image(out, "map", "FLIP map, ", caption, picture->map);
    fprintf(out, "<figcaption>%s</figcaption></figure>\n", caption);
}

void dip_html_pictures(const DipCostReport *report, const DipCostPictureSet *set, const char *name,
                       const DipCostSweep *sweep, FILE *out) {
    const Shown shown = {report, set, name, sweep};
    if (!set->truth.crop && !set->truth.frame) {
        return;
    }
    fprintf(out, "<div class=\"pictures\">\n");
    write_figure(&shown, &set->truth, out);
    for (int i = 0; i < set->count; i++) {
        if (set->pictures[i].crop || set->pictures[i].frame) {
            write_figure(&shown, &set->pictures[i], out);
        }
    }
    fprintf(out, "</div>\n");
}
