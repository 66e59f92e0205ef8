// Writes the section on time against error into the page: a plot of the combinations, a table and
// pictures of those on the Pareto front, a table of the measured combinations, and a table of the
// predicted combinations (dip_candidates_to_list).
#include "app/report/page/html_parts.h"

#include "app/files/put.h"
#include "app/report/report.h"

#include <math.h>
#include <stdlib.h>

// --- points --------------------------------------------------------------------------------------

// A series of the plot.
typedef struct Points {
    int count;
    int rows[DIP_COST_MAX_ROWS]; // Rows of the report, or -1 for a combination without a row.
    double ms[DIP_COST_MAX_ROWS];
    double flip[DIP_COST_MAX_ROWS];
    char titles[DIP_COST_MAX_ROWS][DIP_HTML_TITLE_BYTES];
    const char *title_list[DIP_COST_MAX_ROWS];
} Points;

// Adds a point, and returns the memory for its title (DIP_HTML_TITLE_BYTES). The axes are
// logarithmic, so a FLIP of 0 is plotted as a tiny one.
static char *add_point(Points *points, int row, const DipCandidate *candidate) {
    static const double least_flip = 1e-7;
    const int i = points->count++;
    points->rows[i] = row;
    points->ms[i] = candidate->time.value;
    points->flip[i] = fmax(candidate->flip, least_flip);
    points->title_list[i] = points->titles[i];
    return points->titles[i];
}

static DipPlotSeries series_of(const Points *points, const char *name, const char *style) {
    return (DipPlotSeries){.name = name,
                           .x = points->ms,
                           .y = points->flip,
                           .count = points->count,
                           .marks_only = true,
                           .rows = points->rows,
                           .titles = points->title_list,
                           .style = style};
}

// --- the plot ------------------------------------------------------------------------------------

// The series of the plot, and the predictions that the page lists.
typedef struct Parts {
    Points front;     // The Pareto front of the measured combinations.
    Points others;    // All other measured combinations.
    Points predicted; // Combinations that were only predicted.
    DipCandidates listed;
} Parts;

static bool is_on_front(const DipCostChoice *choice, int candidate) {
    for (int i = 0; i < choice->front_count; i++) {
        if (choice->front[i] == candidate) {
            return true;
        }
    }
    return false;
}

static void add_predicted(const DipCostReport *report, Parts *parts) {
    for (int i = 0; i < parts->listed.count; i++) {
        const DipCandidate *c = &parts->listed.list[i];
        const DipCostPrediction *p = &report->predicted.list[c->row];
        if (p->row < 0) {
            char settings[DIP_COST_TEXT], ms[DIP_NUMBER_BYTES], p95[DIP_NUMBER_BYTES];
            dip_cost_settings_text(&p->quality, settings);
            dip_limited_number(p->ms, 2, false, dip_cost_budgets(report), "-", ms);
            dip_limited_number(p->p95_ms, 2, false, dip_cost_budgets(report), "-", p95);
            snprintf(add_point(&parts->predicted, -1, c), DIP_HTML_TITLE_BYTES,
                     "%s: predicted %s ms, 95th percentile %s ms; predicted FLIP %.4f", settings,
                     ms, p95, p->flip);
        }
    }
}

static void split(const DipCostReport *report, Parts *parts) {
    const DipCostChoice *choice = &report->choice;
    const DipCandidates *all = &choice->candidates;
    for (int i = 0; i < choice->front_count; i++) {
        const DipCandidate *c = &all->list[choice->front[i]];
        dip_html_row_title(report, c->row, add_point(&parts->front, c->row, c));
    }
    for (int i = 0; i < all->count; i++) {
        const DipCandidate *c = &all->list[i];
        if (!is_on_front(choice, i)) {
            dip_html_row_title(report, c->row, add_point(&parts->others, c->row, c));
        }
    }
    add_predicted(report, parts);
}

static void write_plot(const DipCostReport *report, const Parts *parts, FILE *out) {
    char subtitle[DIP_COST_TEXT];
    snprintf(subtitle, sizeof subtitle, "%d combinations on path %s, %dx%d pixels; %s of %d frames",
             parts->front.count + parts->others.count, report->paths[0], report->width,
             report->height, dip_time_kind_names[report->choice.candidates.kind],
             dip_cost_frame_count(report));
    DipPlotSeries series[] = {
        series_of(&parts->predicted, "predicted only", "series-predicted"),
        series_of(&parts->others, "other combinations", "series-others"),
        series_of(&parts->front, "Pareto front", "series-front"),
    };
    series[2].marks_only = false;
    series[2].numbered = true;
    const int first = parts->predicted.count == 0;
    const DipPlot plot = {
        .title = "Time against error",
        .subtitle = subtitle,
        .x_title = "time of a frame, ms",
        .y_title = "FLIP against the truth, mean",
        .log_x = true,
        .log_y = true,
        .series = series + first,
        .series_count = 3 - first,
        .set = "front",
    };
    dip_put_html(out,
                 "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Plot of time "
                 "against error\">\n");
    dip_plot_print(out, &plot);
    dip_put_html(out, "</div>\n");
}

// --- tables --------------------------------------------------------------------------------------

static void write_all_table(DipForm *form, const DipCostReport *report) {
    DipCostLine lines[DIP_COST_MAX_ROWS];
    const int count = dip_cost_combination_lines(report, lines);
    char caption[256];
    snprintf(caption, sizeof caption,
             "All combinations on path %s. A filter also makes the points of all other "
             "combinations pale in the plot.",
             report->paths[0]);
    dip_put_html(form->out, "<details><summary>All %d combinations</summary>\n", count);
    DIP_FORM_TABLE(form, .id = "combinations", .caption = caption, .set = "front",
                   .columns =
                       "settings; row.ms; row.p95_ms.value; row.ratio; row.figures.all.flip; "
                       "row.over_time.flicker_rms_lin; row.figures.all.psnr_db; "
                       "row.figures.all.ssim; row.figures.all.rmse_lin; row.at_floor=noise floor",
                   DIP_COST_LINES(report, lines, count));
    dip_put_html(form->out, "</details>\n");
    if (report->same_count > 0) {
        dip_put_html(form->out,
                     "<details><summary>%d more combinations with the same pictures</summary>\n",
                     report->same_count);
        dip_section_same(form, report);
        dip_put_html(form->out, "</details>\n");
    }
}

static void write_predictions(DipForm *form, const DipCostReport *report,
                              const DipCandidates *listed) {
    DipCostLine lines[DIP_CANDIDATES_LISTED];
    char caption[300];
    const bool is_part = listed->count < dip_cost_searched(report);
    if (report->predicted.count <= 1) { // Nothing but the baseline is not a prediction.
        return;
    }
    for (int i = 0; i < listed->count; i++) {
        lines[i] = dip_cost_prediction_line(report, listed->list[i].row);
    }
    snprintf(caption, sizeof caption,
             "%d of %d predicted combinations on path %s, in order of the predicted time.%s",
             listed->count, dip_cost_searched(report), report->paths[0],
             is_part ? " The others looked no better and were not measured." : "");
    dip_section_predictions(form, report);
    dip_put_html(form->out, "<details><summary>%d predicted combinations</summary>\n",
                 listed->count);
    DIP_FORM_TABLE(
        form, .id = "predictions", .caption = caption,
        .columns =
            "settings; predicted.ms; predicted.p95_ms; predicted.flip; row.ms.value=measured mean; "
            "row.figures.all.flip=measured FLIP; time_miss; flip_miss",
        DIP_COST_LINES(report, lines, listed->count));
    dip_put_html(form->out, "</details>\n");
}

bool dip_html_front(DipForm *form, const DipCostReport *report, const DipCostPictures *pictures) {
    Parts *parts = calloc(1, sizeof *parts);
    const bool made = parts && dip_candidates_to_list(report, &parts->listed);
    if (made && report->choice.candidates.count > 1) {
        split(report, parts);
        dip_form_heading(form, "front", "Time against error");
        dip_form_paragraph(form, NULL,
                           "Both axes are logarithmic. The Pareto front consists of the "
                           "combinations that no other combination beats in both time and error.");
        write_plot(report, parts, form->out);
        dip_section_front(form, report);
        if (pictures) {
            dip_html_pictures(report, &pictures->front, "front", NULL, form->out);
        }
        write_all_table(form, report);
    }
    if (made) {
        write_predictions(form, report, &parts->listed);
    }
    if (parts) {
        dip_candidates_free(&parts->listed);
    }
    free(parts);
    return made;
}
