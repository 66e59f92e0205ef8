// Time and error along the default path in the HTML page: those of the baseline and of the advised
// combinations, frame by frame and viewpoint by viewpoint.
#include "app/report/page/html_parts.h"

#include "app/files/put.h"
#include <stdlib.h>
#include <string.h>

// MOST_LINES is the number of colours of a plot.
enum { MOST_LINES = 6, TITLE_ROOM = DIP_COST_TEXT + 64, MOST_FRAMES = 256 };

// The lines of both plots. Arrays are owned.
typedef struct Lines {
    const DipCostReport *report;
    int rows[MOST_LINES];
    char names[MOST_LINES][DIP_COST_TEXT];
    int count;
    int frames; // Number of timed frames; fill_times reduces it to those that are shown.
    // Positions of the frames, and then of the viewpoints, as shares of the path in percent.
    double *positions;
    double *ms;   // [line * frames + frame]
    double *flip; // [line * viewpoints + viewpoint]
    // Tooltips at [line * (frames or viewpoints) + point]; `titles` points to `texts`.
    char (*texts)[TITLE_ROOM];
    const char **titles;
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
        snprintf(lines->names[lines->count], DIP_COST_TEXT, "%s%.140s", prefix, settings);
        lines->rows[lines->count++] = row;
    }
}

// Lists the baseline and then the advised combinations. Without advice, the knee of the front
// follows instead.
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

static void free_lines(Lines *lines) {
    free(lines->positions);
    free(lines->ms);
    free(lines->flip);
    free(lines->texts);
    free(lines->titles);
}

// Returns false when memory runs out.
static bool alloc_lines(Lines *lines) {
    const size_t frames = (size_t)lines->frames;
    const size_t viewpoints = (size_t)lines->report->options.places;
    const size_t shown = frames < MOST_FRAMES ? frames : MOST_FRAMES;
    const size_t most = shown > viewpoints ? shown : viewpoints;
    lines->positions = calloc(frames + viewpoints, sizeof *lines->positions);
    lines->ms = calloc(MOST_LINES * frames, sizeof *lines->ms);
    lines->flip = calloc(MOST_LINES * viewpoints, sizeof *lines->flip);
    lines->texts = calloc(MOST_LINES * most, sizeof *lines->texts);
    lines->titles = calloc(MOST_LINES * most, sizeof *lines->titles);
    return lines->positions && lines->ms && lines->flip && lines->texts && lines->titles;
}

// Fills in the times and positions of the frames: of every n-th if there are more than MOST_FRAMES.
static void fill_times(Lines *lines) {
    const int frames = lines->frames;
    const int step = (frames + MOST_FRAMES - 1) / MOST_FRAMES;
    lines->frames = (frames + step - 1) / step;
    for (int i = 0; i < lines->count; i++) {
        const double *ms = dip_times_frames(lines->report->fit, lines->rows[i]);
        for (int f = 0; f < lines->frames; f++) {
            lines->ms[i * lines->frames + f] = ms[f * step];
            lines->positions[f] = 100.0 * f * step / frames;
        }
    }
}

// Returns a line of `count` points, and writes the points' tooltips.
static DipPlotSeries series_of(const Lines *lines, int line, const double *x, const double *y,
                               int count, int digits, const char *unit) {
    const char **titles = lines->titles + line * count;
    for (int p = 0; p < count; p++) {
        char *text = lines->texts[line * count + p];
        snprintf(text, TITLE_ROOM, "%s, at %.1f %% of the path: %.*f %s", lines->names[line], x[p],
                 digits, y[p], unit);
        titles[p] = text;
    }
    return (DipPlotSeries){
        .name = lines->names[line], .x = x, .y = y, .count = count, .titles = titles};
}

static void write_plot(const Lines *lines, const DipPlotSeries *series, const char *title,
                       const char *y_title, FILE *out) {
    char subtitle[DIP_COST_TEXT];
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

static void write_times(const Lines *lines, FILE *out) {
    DipPlotSeries series[MOST_LINES];
    for (int i = 0; i < lines->count; i++) {
        series[i] = series_of(lines, i, lines->positions, lines->ms + i * lines->frames,
                              lines->frames, 2, "ms");
    }
    write_plot(lines, series, "Time along the path", "time of a frame, ms", out);
}

// Fills in the positions and the FLIP of the viewpoints that all lines have. Returns their number.
static int list_viewpoints(const Lines *lines, double *positions) {
    const DipCostReport *report = lines->report;
    const int viewpoints = report->options.places;
    int count = 0;
    for (int p = 0; p < viewpoints; p++) {
        bool judged = true;
        for (int i = 0; i < lines->count; i++) {
            judged = judged && report->rows[lines->rows[i]].judged[p];
        }
        if (judged) {
            positions[count] = 100.0 * (p + 0.5) / viewpoints;
            for (int i = 0; i < lines->count; i++) {
                lines->flip[i * viewpoints + count] =
                    dip_metrics_of(&report->rows[lines->rows[i]].viewpoints[p], 0).flip;
            }
            count++;
        }
    }
    return count;
}

static void write_errors(const Lines *lines, FILE *out) {
    const int viewpoints = lines->report->options.places;
    double *positions = lines->positions + lines->frames;
    DipPlotSeries series[MOST_LINES];
    const int count = list_viewpoints(lines, positions);
    if (count < 2) {
        return;
    }
    for (int i = 0; i < lines->count; i++) {
        series[i] = series_of(lines, i, positions, lines->flip + i * viewpoints, count, 4, "FLIP");
    }
    write_plot(lines, series, "Error along the path", "FLIP against the truth, mean of a viewpoint",
               out);
}

bool dip_html_path(DipForm *form, const DipCostReport *report) {
    Lines lines = {.report = report, .frames = dip_cost_frame_count(report)};
    if (report->rounds == 0 || report->combined_first == report->row_count) {
        return true;
    }
    list_lines(&lines);
    const bool made = alloc_lines(&lines);
    if (made) {
        fill_times(&lines);
        dip_form_heading(form, "along", "Time and error along the path");
        dip_form_paragraph(form, NULL,
                           "The plots show the times of the baseline and of the advised settings "
                           "at every timed frame, and their mean FLIP at every viewpoint.");
        write_times(&lines, form->out);
        write_errors(&lines, form->out);
    }
    free_lines(&lines);
    return made;
}
