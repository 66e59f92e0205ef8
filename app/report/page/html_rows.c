// Writes the texts and pictures of the report's rows into the HTML page: a line of text for plots,
// data for the scripts, and sets of pictures.
#include "app/report/page/html_parts.h"

#include "app/files/put.h"

// Formats the times of a row, or "" if the row was not timed.
static void format_time(const DipCostReport *report, int row, char text[DIP_COST_TEXT]) {
    const DipPathEstimate *time = &report->rows[row].time;
    text[0] = '\0';
    if (dip_cost_is_timed(report, row)) {
        const DipField digits = {.unit = "ms", .digits = 2};
        const DipLimits budgets = dip_cost_budgets(report);
        char interval[DIP_CELL_BYTES], mean[DIP_NUMBER_BYTES], p95[DIP_NUMBER_BYTES];
        dip_field_interval_text(&digits, budgets, &time->mean_ms, interval);
        dip_limited_number(time->mean_ms.value, 2, false, budgets, "-", mean);
        dip_limited_number(time->p95_ms.value, 2, false, budgets, "-", p95);
        snprintf(text, DIP_COST_TEXT, "%s ms%s%.64s%s, 95th percentile %s ms", mean,
                 *interval ? " (" : "", interval, *interval ? ")" : "", p95);
    }
}

static void format_errors(const DipMetrics *f, char text[DIP_COST_TEXT]) {
    snprintf(text, DIP_COST_TEXT, "FLIP %.4f, PSNR %.2f dB, SSIM %.4f, RMSE %.5f", f->flip,
             f->psnr_db, f->ssim, f->rmse_lin);
}

void dip_html_row_title(const DipCostReport *report, int row, char text[DIP_HTML_TITLE_BYTES]) {
    const DipMetrics f = dip_cost_row_metrics(report, row);
    char settings[DIP_COST_TEXT], time[DIP_COST_TEXT], errors[DIP_COST_TEXT];
    dip_cost_settings_text(&report->rows[row].quality, settings);
    format_time(report, row, time);
    format_errors(&f, errors);
    snprintf(text, DIP_HTML_TITLE_BYTES, "%.180s on path %s: %.150s%s%.120s", settings,
             report->paths[report->rows[row].path], time, *time ? "; " : "", errors);
}

void dip_html_measurements(const DipCostReport *report, FILE *out) {
    dip_put_html(out, "<script type=\"application/json\" id=\"measurements\">[");
    for (int r = 0; r < report->row_count; r++) {
        int viewpoints;
        const DipMetricSums sums = dip_cost_row_sums(report, r, &viewpoints);
        const DipMetrics f = dip_metrics_of(&sums, 0);
        char settings[DIP_COST_TEXT], time[DIP_COST_TEXT], errors[DIP_COST_TEXT] = "";
        dip_cost_settings_text(&report->rows[r].quality, settings);
        format_time(report, r, time);
        if (viewpoints > 0) {
            format_errors(&f, errors);
        }
        const char *const members[][2] = {{"settings", settings},
                                          {"path", report->paths[report->rows[r].path]},
                                          {"time", time},
                                          {"errors", errors}};
        for (int m = 0; m < 4; m++) {
            dip_put_markup(out, m ? "," : r ? ",\n{" : "\n{");
            dip_put_script_string(out, members[m][0]);
            dip_put_markup(out, ":");
            dip_put_script_string(out, members[m][1]);
        }
        dip_put_markup(out, "}");
    }
    dip_put_markup(out, "]</script>\n");
}

// --- pictures ----------------------------------------------------------------------------------

static void write_image(FILE *out, const char *part, const char *what, const char *name,
                        const char *uri) {
    if (uri) {
        dip_put_html(out, "<img data-part=\"%s\" alt=\"%s%s\" src=\"%s\">", part, what, name, uri);
    }
}

// A set of pictures, and what its captions are made from.
typedef struct Shown {
    const DipCostReport *report;
    const DipCostPictureSet *set;
    const char *name;          // Value of the attribute data-set.
    const DipCostSweep *sweep; // Captions are the names of the sweep's steps, or settings if
                               // `sweep` is NULL.
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

// Writes which row a picture shows, and where its crop lies.
static void write_origin(const Shown *shown, int row, FILE *out) {
    const DipCostPictureSet *set = shown->set;
    dip_put_html(out,
                 " data-row=\"%d\" data-where=\"Path %s, viewpoint %d of %d\" "
                 "data-corner=\"the crop's upper left corner is at pixel (%d, %d)\"",
                 row, shown->report->paths[set->path], set->viewpoint + 1,
                 shown->report->options.places, set->x, set->y);
}

static void write_figure(const Shown *shown, const DipCostPicture *picture, FILE *out) {
    char text[DIP_COST_TEXT];
    const bool is_truth = picture->row < 0;
    const char *caption = caption_of(shown, picture, text);
    dip_put_html(out, "<figure class=\"%s%s\" data-set=\"%s\"", is_truth ? "truth" : "",
                 picture->frame ? " frame" : "", shown->name);
    if (!is_truth) {
        write_origin(shown, picture->row, out);
    }
    dip_put_html(out, ">");
    write_image(out, "frame", "whole frame, ", caption, picture->frame);
    write_image(out, "crop", "", caption, picture->crop);
    write_image(out, "map", "FLIP map, ", caption, picture->map);
    dip_put_html(out, "<figcaption>%s</figcaption></figure>\n", caption);
}

void dip_html_pictures(const DipCostReport *report, const DipCostPictureSet *set, const char *name,
                       const DipCostSweep *sweep, FILE *out) {
    const Shown shown = {report, set, name, sweep};
    if (!set->truth.crop && !set->truth.frame) {
        return;
    }
    dip_put_html(out, "<div class=\"pictures\">\n");
    write_figure(&shown, &set->truth, out);
    for (int i = 0; i < set->count; i++) {
        if (set->pictures[i].crop || set->pictures[i].frame) {
            write_figure(&shown, &set->pictures[i], out);
        }
    }
    dip_put_html(out, "</div>\n");
}
