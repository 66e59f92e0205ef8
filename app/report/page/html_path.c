// Writes plots of time and error along path 0 into the HTML page, for the baseline and the advised
// combinations (or the knee of the Pareto front). Times are plotted at frames, and errors at
// viewpoints.
#include "app/report/page/html_parts.h"

#include "app/files/put.h"
#include <stdlib.h>
#include <string.h>

enum {
    MOST_LINES = 6, // As many as a plot has colours.
    TITLE_ROOM = DIP_COST_TEXT + 64,
    MOST_FRAMES = 256,
    MOST_POINTS = DIP_COST_MAX_PLACES // Points are viewpoints, or at most MOST_FRAMES frames.
};

// The lines of a plot, either of times at frames or of errors at viewpoints.
typedef struct Lines {
    const DipCostReport *report;
    int rows[MOST_LINES];
    char names[MOST_LINES][DIP_COST_TEXT];
    int count;
    int points;                    // Number of points of each line.
    double positions[MOST_POINTS]; // Share of the path at each point, in percent.
    double values[MOST_LINES][MOST_POINTS];
    char texts[MOST_LINES][MOST_POINTS][TITLE_ROOM]; // Tooltips.
    const char *titles[MOST_LINES][MOST_POINTS];     // Point to `texts`.
} Lines;

static void add_line(Lines *lines, int row, const char *prefix) {
    const DipQuality *quality = &lines->report->rows[row].quality;
    char settings[DIP_COST_TEXT];
    for (int i = 0; i < lines->count; i++) {
        const DipQuality *known = &lines->report->rows[lines->rows[i]].quality;
        if (memcmp(known, quality, sizeof *quality) == 0) {
            return;
        }
    }
    if (lines->count < MOST_LINES) {
        dip_cost_settings_text(quality, settings);
        snprintf(lines->names[lines->count], DIP_COST_TEXT, "%s%.180s", prefix, settings);
        lines->rows[lines->count++] = row;
    }
}

// Lists the baseline and then the advised combinations. If no combination but the baseline is
// advised, adds the knee of the Pareto front (app/report/choice.h) instead.
static void list_lines(Lines *lines) {
    const DipCostReport *report = lines->report;
    add_line(lines, report->base_rows[0], "baseline: ");
    const DipCostChoice *choice = &report->choice;
    for (int i = 0; i < choice->advice_count; i++) {
        const DipCandidate *chosen = dip_cost_chosen(report, i);
        if (chosen) {
            add_line(lines, chosen->row, "");
        }
    }
    if (lines->count == 1 && choice->knee >= 0) {
        add_line(lines, choice->candidates.list[choice->front[choice->knee]].row,
                 "knee of the front: ");
    }
}

// Lists the times at every n-th frame, so that there are at most MOST_FRAMES. Returns n.
static int list_times(Lines *lines) {
    const int frames = dip_cost_frame_count(lines->report);
    const int step = (frames + MOST_FRAMES - 1) / MOST_FRAMES;
    lines->points = (frames + step - 1) / step;
    for (int i = 0; i < lines->count; i++) {
        const double *ms = dip_times_frames(lines->report->fit, lines->rows[i]);
        for (int f = 0; f < lines->points; f++) {
            lines->positions[f] = 100.0 * f * step / frames;
            lines->values[i][f] = ms[f * step];
        }
    }
    return step;
}

// Lists the FLIP at the viewpoints that were judged for all lines.
static void list_errors(Lines *lines) {
    const DipCostReport *report = lines->report;
    const int viewpoints = report->options.places;
    lines->points = 0;
    for (int p = 0; p < viewpoints; p++) {
        bool judged = true;
        for (int i = 0; i < lines->count; i++) {
            judged = judged && report->rows[lines->rows[i]].judged[p];
        }
        for (int i = 0; judged && i < lines->count; i++) {
            lines->values[i][lines->points] =
                dip_metrics_of(&report->rows[lines->rows[i]].viewpoints[p], 0).flip;
        }
        lines->positions[lines->points] = 100.0 * (p + 0.5) / viewpoints;
        lines->points += judged;
    }
}

static void write_plot(Lines *lines, const char *title, const char *y_title, int digits,
                       DipLimits limits, const char *unit, FILE *out) {
    DipPlotSeries series[MOST_LINES];
    char subtitle[DIP_COST_TEXT];
    for (int i = 0; i < lines->count; i++) {
        for (int p = 0; p < lines->points; p++) {
            char value[DIP_NUMBER_BYTES];
            dip_limited_number(lines->values[i][p], digits, false, limits, "-", value);
            lines->titles[i][p] = lines->texts[i][p];
            snprintf(lines->texts[i][p], TITLE_ROOM, "%s, at %.1f %% of the path: %s %s",
                     lines->names[i], lines->positions[p], value, unit);
        }
        series[i] = (DipPlotSeries){.name = lines->names[i],
                                    .x = lines->positions,
                                    .y = lines->values[i],
                                    .count = lines->points,
                                    .titles = lines->titles[i]};
    }
    snprintf(subtitle, sizeof subtitle, "path %s, %d timed frames, %d viewpoint%s",
             lines->report->paths[0], dip_cost_frame_count(lines->report),
             lines->report->options.places, dip_cost_plural(lines->report->options.places));
    const DipPlot plot = {
        .title = title,
        .subtitle = subtitle,
        .x_title = "share of the path, %",
        .y_title = y_title,
        .series = series,
        .series_count = lines->count,
    };
    dip_put_html(out,
                 "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Plot: %s\">\n",
                 title);
    dip_plot_print(out, &plot);
    dip_put_html(out, "</div>\n");
}

bool dip_html_path(DipForm *form, const DipCostReport *report) {
    if (report->rounds == 0 || report->combined_first == report->row_count) {
        return true;
    }
    Lines *lines = calloc(1, sizeof *lines);
    if (!lines) {
        return false;
    }
    lines->report = report;
    list_lines(lines);
    const int step = list_times(lines);
    char stride[64] = "every timed frame";
    if (step > 1) {
        snprintf(stride, sizeof stride, "one in %d of the timed frames", step);
    }
    dip_form_heading(form, "along", "Time and error along the path");
    dip_form_paragraph(
        form, NULL,
        "The plots show the times of %s at %s, and their mean FLIP at every viewpoint "
        "that was judged for all of them.",
        lines->count > 1 ? "the baseline and of the other settings in the legend" : "the baseline",
        stride);
    write_plot(lines, "Time along the path", "time of a frame, ms", 2, dip_cost_budgets(report),
               "ms", form->out);
    list_errors(lines);
    if (lines->points >= 2) {
        write_plot(lines, "Error along the path", "FLIP against the truth, mean of a viewpoint", 4,
                   (DipLimits){0}, "FLIP", form->out);
    }
    free(lines);
    return true;
}
