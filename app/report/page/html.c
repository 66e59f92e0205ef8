// Writing the HTML page: its style, its sections and its scripts. The sections are complete without
// the scripts.
#include "app/report/page/html.h"

#include "app/report/page/html_parts.h"
#include "app/report/page/web/embedded.h"
#include "app/files/whole_file.h"
#include "app/files/put.h"

#include <stdlib.h>

// The policy forbids the page to read any other file.
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

// Names the rows of a set that have no whole frame. Returns the number of rows named so far.
static int name_without_frame(const DipCostReport *report, const DipCostPictureSet *set, int named,
                              FILE *out) {
    for (int i = 0; i < set->count; i++) {
        if (!set->pictures[i].frame) {
            dip_put_html(out, "%s", named++ ? "; " : "");
            dip_html_settings(report, set->pictures[i].row, out);
            dip_put_html(out, " on %s", report->paths[set->path]);
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

// Returns false when memory runs out.
static bool write_page(const DipCostReport *report, const DipCostPictures *pictures, FILE *out) {
    write_begin(report, out);
    dip_html_head(report, out);
    dip_put_html(out, "<main>\n");
    dip_html_advice(report, out);
    const bool has_front = dip_html_front(report, pictures, out) && dip_html_path(report, out) &&
                           dip_html_predictions(report, out);
    dip_html_interactions(report, out);
    if (report->sweep_count) {
        dip_html_sweeps(report, pictures, out);
    }
    if (pictures) {
        write_left_out(report, pictures, out);
    }
    if (report->sweep_count) {
        dip_html_regions(report, out);
    }
    dip_html_tails(report, out);
    if (report->rounds > 0) {
        dip_html_work(report, out);
    }
    dip_html_truth(report, out);
    dip_html_words(report, out);
    dip_put_html(out, "</main>\n");
    write_scripts(report, out);
    dip_put_html(out, "</body>\n</html>\n");
    return has_front;
}

bool dip_cost_write_html(const DipCostReport *report, const DipCostPictures *pictures,
                         const char *file, DipError *err) {
    char *page = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&page, &size);
    if (!out) {
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    }
    bool made = write_page(report, pictures, out) && !ferror(out);
    made = fclose(out) == 0 && made && page; // glibc sets it to NULL if memory runs out here.
    const bool written = made
                             ? dip_whole_file_write(file, page, size, err)
                             : dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    free(page);
    return written;
}
