// Writes the HTML page: its style, its sections and its scripts. The sections are complete without
// the scripts.
#include "app/report/page/html.h"

#include "app/report/page/html_parts.h"
#include "app/report/page/web/embedded.h"
#include "app/files/whole_file.h"
#include "app/files/put.h"

// The Content-Security-Policy of the page. It forbids the page to read any other file.
static const char policy[] = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; "
                             "script-src 'unsafe-inline'; base-uri 'none'; form-action 'none'";

static void write_begin(const DipCostReport *report, FILE *out) {
    dip_put_html(out,
                 "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                 "<meta http-equiv=\"Content-Security-Policy\" content=\"%s\">\n"
                 "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                 "<title>What accuracy costs: ",
                 policy);
    dip_put_html(out, "%s", report->scene);
    const unsigned char *const styles[] = {dip_cost_page_css, dip_cost_pictures_css,
                                           dip_cost_paper_css};
    dip_put_html(out, "</title>\n<style>\n");
    for (int i = 0; i < 3; i++) {
        dip_put_markup(out, (const char *)styles[i]);
        dip_put_html(out, "\n");
    }
    dip_put_html(out, "</style>\n</head>\n<body>\n");
}

static void write_scripts(const DipCostReport *report, FILE *out) {
    const unsigned char *const scripts[] = {dip_cost_tables_js, dip_cost_viewer_js,
                                            dip_cost_plots_js};
    dip_html_measurements(report, out);
    for (int i = 0; i < 3; i++) {
        dip_put_html(out, "<script>\n");
        dip_put_markup(out, (const char *)scripts[i]);
        dip_put_html(out, "</script>\n");
    }
}

// --- tables that only pages have -----------------------------------------------------------------

static void write_warnings(DipForm *form, const DipCostReport *report) {
    if (report->warning_count == 0) {
        return;
    }
    dip_form_heading(form, "warnings", "Warnings about the scene");
    DIP_FORM_TABLE(
        form, .id = "scene-warnings",
        .caption = "Loading the scene gave these warnings. What Diptych does not draw of "
                   "the scene is missing from the truths, too, so no error shows it.",
        .record = &dip_cost_warning_record, .columns = "file; line; key; message",
        .context = (void *)report, .items = report->warnings, .count = report->warning_count);
    if (report->warnings_left_out > 0) {
        dip_form_paragraph(form, "note", "%d more warning%s left out.", report->warnings_left_out,
                           report->warnings_left_out == 1 ? " is" : "s are");
    }
}

static bool has_tail(const DipFieldAt *at) {
    const int row = ((const DipCostLine *)at->item)->row;
    return dip_cost_row_tail(at->context, row).viewpoints > 0;
}

static bool has_tails(const DipCostReport *report) {
    for (int r = 0; r < report->row_count; r++) {
        if (dip_cost_row_tail(report, r).viewpoints > 0) {
            return true;
        }
    }
    return false;
}

static void write_regions(DipForm *form, const DipCostReport *report) {
#define SEEN_COLUMNS(NAME, name, text)                                                             \
    "; row.figures." name ".flip=" name "; row.figures." name ".share"
    static const char columns[] =
        "name; row.figures.all.flip=whole picture" DIP_SEEN_LIST(SEEN_COLUMNS);
    DipCostLine lines[DIP_COST_MAX_SWEEPS * DIP_COST_MAX_SWEEP_ROWS];
    const int count = dip_cost_all_step_lines(report, lines);
    if (count > 0) {
        dip_form_heading(form, "parts", "Where the errors are");
        DIP_FORM_TABLE(form, .id = "picture-parts",
                       .caption = "Mean FLIP over the pixels of each part of the picture.",
                       .columns = columns, DIP_COST_LINES(report, lines, count));
    }
}

static void write_tails(DipForm *form, const DipCostReport *report) {
    DipCostLine lines[DIP_COST_MAX_ROWS + DIP_COST_MAX_SWEEPS * DIP_COST_MAX_SWEEP_ROWS];
    int count = dip_cost_all_step_lines(report, lines);
    count += dip_cost_front_lines(report, lines + count);
    if (!has_tails(report)) {
        return;
    }
    dip_form_heading(form, "tails", "Small parts with large errors");
    dip_form_paragraph(form, NULL,
                       "A mean hides small parts of a picture that look bad. The percentiles are "
                       "those of the pixels' FLIP at a viewpoint, as means over the viewpoints: "
                       "99 %% of the pixels have at most the FLIP in the column 99 %%. The worst "
                       "block is the part of at most %d x %d pixels with the greatest mean FLIP at "
                       "any viewpoint.",
                       DIP_FLIP_TAIL_BLOCK, DIP_FLIP_TAIL_BLOCK);
    DIP_FORM_TABLE(
        form, .id = "flip-tails",
        .caption = "Distribution of FLIP over pixels, for each step of each setting and for the "
                   "Pareto front.",
        .shows = has_tail,
        .columns = "settings; title; path; row.figures.all.flip; row.flip_tail.p50; "
                   "row.flip_tail.p95; row.flip_tail.p99; row.flip_tail.worst; row.flip_tail.place",
        DIP_COST_LINES(report, lines, count));
}

static void write_work(DipForm *form, const DipCostReport *report) {
    DipCostLine lines[DIP_COST_MAX_SWEEPS * DIP_COST_MAX_SWEEP_ROWS];
    if (report->rounds == 0) {
        return;
    }
    dip_put_html(form->out, "<section class=\"%s\" aria-labelledby=\"work\">\n",
                 report->sweep_count > 0 ? "wide" : "narrow");
    dip_form_heading(form, "work", "Work");
    DIP_FORM_TABLE(form, .id = "work-counters",
                   .caption = "Work per frame, in thousands: means over the timed frames. The "
                              "counters are exact, the same on every machine and with any number "
                              "of threads. Those that are the same in all steps are left out.",
                   .columns = "name; row.counters=",
                   DIP_COST_LINES(report, lines, dip_cost_all_step_lines(report, lines)));
    dip_put_html(form->out, "</section>\n");
    dip_section_fit(form, report);
}

// Explains the words of the page: "truth", the mark '?', and the fields of rows. The sentences
// about fields come from the fields' lists (DipField.means).
static void write_words(const DipCostReport *report, FILE *out) {
    static const char *const paths[] = {"ratio",
                                        "ms",
                                        "p95_ms",
                                        "figures.all.rmse_lin",
                                        "figures.all.psnr_db",
                                        "figures.all.ssim",
                                        "figures.all.flip",
                                        "over_time.flicker_rms_lin",
                                        "over_time.two_frame_mean_rms_lin",
                                        "at_floor"};
    const DipFieldAt nothing = {NULL, NULL, 0, NULL};
    dip_put_html(out,
                 "<h2 id=\"words\">What the words mean</h2>\n<dl>\n"
                 "<dt>truth</dt><dd>The converged picture: jittered supersampling in linear light. "
                 "Every sample is shaded at its own position, and textures are read from their "
                 "largest level.</dd>\n"
                 "<dt>?</dt><dd>A change is marked with ? if its 95 %% interval holds 0, so that "
                 "even its sign is not sure. If the machine was too busy, all times and their "
                 "ratios have one digit and are marked with ?.</dd>\n");
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
        DipFieldFound found;
        dip_field_find(&dip_cost_row_record, &nothing, paths[i], &found);
        dip_put_html(out, "<dt>%s</dt><dd>%s</dd>\n", found.field.title, found.field.means);
    }
    dip_put_html(out, "</dl>\n<p>FLIP is that of %g pixels per degree.</p>\n",
                 report->options.pixels_per_degree);
}

// --- title and contents --------------------------------------------------------------------------

static void write_contents(const DipCostReport *report, FILE *out) {
    const bool has_candidates = report->choice.candidates.count > 0;
    const struct {
        bool is_there;
        const char *id, *title;
    } parts[] = {
        {has_candidates, "advice", "Best settings for a time budget"},
        {report->choice.candidates.count > 1, "front", "Time against error"},
        {report->predicted.count > 1, "predicted", "Predicted combinations"},
        {true, "measured", "What was measured"},
        {report->warning_count > 0, "warnings", "Warnings about the scene"},
        {has_candidates && report->rounds > 0, "along", "Time and error along the path"},
        {report->sweep_count > 0, "settings", "Each setting"},
        {report->sweep_count > 0, "parts", "Where the errors are"},
        {has_tails(report), "tails", "Small parts with large errors"},
        {report->rounds > 0, "work", "Work"},
        {true, "truth", "The truth"},
        {true, "words", "What the words mean"},
    };
    dip_put_html(out, "<header>\n<h1>What accuracy costs: %s</h1>\n", report->scene);
    dip_put_html(out, "<nav aria-label=\"Contents\"><ul>\n");
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        if (parts[i].is_there) {
            dip_put_html(out, "<li><a href=\"#%s\">%s</a></li>\n", parts[i].id, parts[i].title);
        }
    }
    dip_put_html(out, "</ul></nav>\n</header>\n");
}

// Names the rows of a set that have no whole frame. Returns the number of rows named so far.
static int name_without_frame(const DipCostReport *report, const DipCostPictureSet *set, int named,
                              FILE *out) {
    for (int i = 0; i < set->count; i++) {
        if (!set->pictures[i].frame) {
            char settings[DIP_COST_TEXT];
            dip_cost_settings_text(&report->rows[set->pictures[i].row].quality, settings);
            dip_put_html(out, "%s%s on %s", named++ ? "; " : "", settings,
                         report->paths[set->path]);
        }
    }
    return named;
}

// Says which pictures did not fit in the page.
static void write_left_out(const DipCostReport *report, const DipCostPictures *pictures,
                           FILE *out) {
    const double megabytes = 1e-6 * DIP_COST_PAGE_BYTES;
    if (pictures->frames_left_out) {
        dip_put_html(
            out,
            "<p class=\"note\">A page has at most %.0f MB, so %d whole frame%s did not fit. "
            "The page shows crops of these rows: ",
            megabytes, pictures->frames_left_out, dip_cost_plural(pictures->frames_left_out));
        int named = name_without_frame(report, &pictures->front, 0, out);
        for (int s = 0; s < report->sweep_count; s++) {
            named = name_without_frame(report, &pictures->sweeps[s], named, out);
        }
        dip_put_html(out, ".</p>\n");
    }
    if (pictures->crops_left_out) {
        dip_put_html(
            out,
            "<p class=\"note\">A page has at most %.0f MB, so the pictures of %d row%s are "
            "left out.</p>\n",
            megabytes, pictures->crops_left_out, dip_cost_plural(pictures->crops_left_out));
    }
}

// --- the page ------------------------------------------------------------------------------------

// What the page shows.
typedef struct Page {
    const DipCostReport *report;
    const DipCostPictures *pictures; // NULL if there are none.
} Page;

// Writes the page. Returns false when memory runs out.
static bool write_page(const void *page, FILE *out) {
    const DipCostReport *report = ((const Page *)page)->report;
    const DipCostPictures *pictures = ((const Page *)page)->pictures;
    DipForm form = {.out = out, .is_page = true};
    write_begin(report, out);
    write_contents(report, out);
    dip_put_html(out, "<main>\n");
    dip_section_answer(&form, report);
    const bool has_front = dip_html_front(&form, report, pictures);
    dip_section_measured(&form, report);
    write_warnings(&form, report);
    const bool has_path = dip_html_path(&form, report);
    dip_section_interactions(&form, report);
    dip_html_sweeps(&form, report, pictures);
    if (pictures) {
        write_left_out(report, pictures, out);
    }
    write_regions(&form, report);
    write_tails(&form, report);
    write_work(&form, report);
    dip_section_truth(&form, report);
    dip_form_end(&form);
    write_words(report, out);
    dip_put_html(out, "</main>\n");
    write_scripts(report, out);
    dip_put_html(out, "</body>\n</html>\n");
    return has_front && has_path;
}

bool dip_cost_write_html(const DipCostReport *report, const DipCostPictures *pictures,
                         const char *file, DipError *err) {
    return dip_whole_file_print(file, write_page, &(Page){report, pictures}, err);
}
