// The title of the HTML page with its contents; what was measured where, and the verdict on the
// machine.
#include "app/report/page/html_parts.h"

#include "app/files/put.h"

static void write_fact(FILE *out, const char *title, const char *text) {
    dip_put_html(out, "<div><dt>%s</dt><dd>", title);
    dip_put_html(out, "%s", text);
    dip_put_html(out, "</dd></div>\n");
}

static void write_scene_facts(const DipCostReport *report, FILE *out) {
    char text[2 * DIP_COST_TEXT];
    snprintf(text, sizeof text, "%dx%d pixels", report->width, report->height);
    write_fact(out, "Picture", text);
    write_fact(out, "Processor", report->processor);
    snprintf(text, sizeof text, "%d thread%s, %s", report->threads,
             dip_cost_plural(report->threads), report->isa);
    write_fact(out, "Renderer", text);
    if (report->date[0]) {
        write_fact(out, "Measured", report->date);
    }
    snprintf(text, sizeof text, "Diptych %s", report->version);
    write_fact(out, "Version", text);
}

static void write_method_facts(const DipCostReport *report, FILE *out) {
    const DipCostOptions *o = &report->options;
    char text[2 * DIP_COST_TEXT];
    char baseline[DIP_COST_TEXT];
    dip_cost_settings_text(&o->baseline, baseline);
    write_fact(out, "Settings of the baseline", baseline);
    if (report->rounds > 0) {
        snprintf(text, sizeof text,
                 "%d frames along each path in %d rounds of random order, each beside the baseline",
                 dip_cost_frame_count(report), report->rounds);
        write_fact(out, "Times", text);
    }
    snprintf(text, sizeof text, "%d viewpoint%s on each path, %d successive frame%s at each",
             o->places, dip_cost_plural(o->places), o->burst, dip_cost_plural(o->burst));
    write_fact(out, "Errors", text);
    snprintf(text, sizeof text, "two pictures of %d samples per pixel each", o->samples);
    write_fact(out, "Truth (converged picture)", text);
}

// The verdict on the machine, and the A/A rows of all paths.
static void write_verdict(const DipCostReport *report, FILE *out) {
    const char *verdict = dip_cost_verdict_names[report->verdict];
    char level[DIP_COST_REASON];
    dip_cost_level_text(report, level);
    dip_put_html(out, "<p class=\"verdict %s\"><b>The machine was %s.</b> ", verdict, verdict);
    dip_put_html(out, "%s", report->verdict_reason);
    dip_put_html(out, "%s ",
                 report->verdict == DIP_COST_RED
                     ? " The times are wrong, and no settings are advised."
                     : "");
    dip_put_html(out, "%s", level);
    dip_put_html(out, "</p>\n");
    dip_html_table_begin(out, "baseline-twice", NULL);
    dip_put_html(out,
                 "On each path, the baseline was timed a second time as if it were another setting "
                 "(A/A). Differences between settings that are smaller than these are noise.");
    dip_html_columns_begin(out);
    dip_html_text_column(out, "path");
    dip_html_column(out, "ratio", NULL);
    dip_html_column(out, "95 % interval", NULL);
    dip_html_columns_end(out);
    for (int p = 0; p < report->path_count; p++) {
        const DipEstimate same = report->rows[report->same_rows[p]].time.ratio;
        char interval[DIP_COST_INTERVAL];
        dip_cost_interval_text(&same, 3, interval);
        dip_html_line_begin(out, report->same_rows[p]);
        dip_put_html(out, "<th scope=\"row\">%s</th><td>%.3f</td><td>%s</td></tr>\n",
                     report->paths[p], same.value, interval);
    }
    dip_html_table_end(out);
}

// The contents. The caller writes the sections that are named here.
static void write_contents(const DipCostReport *report, FILE *out) {
    dip_put_html(out, "<nav aria-label=\"Contents\"><ul>\n");
    if (report->choice.advice_count > 0) {
        dip_put_html(out, "<li><a href=\"#advice\">Best settings for a time budget</a></li>\n");
    }
    if (report->choice.candidates.count > 0) {
        dip_put_html(out, "<li><a href=\"#front\">Time against error</a></li>\n");
    }
    dip_put_html(out, "<li><a href=\"#measured\">What was measured</a></li>\n");
    if (report->choice.candidates.count > 0) {
        dip_put_html(out, "<li><a href=\"#along\">Time and error along the path</a></li>\n");
    }
    if (report->predicted.count) {
        dip_put_html(out, "<li><a href=\"#predicted\">Predicted combinations</a></li>\n");
    }
    if (report->sweep_count) {
        dip_put_html(out, "<li><a href=\"#settings\">Each setting</a></li>\n"
                          "<li><a href=\"#parts\">Where the errors are</a></li>\n");
    }
    if (dip_html_has_tails(report)) {
        dip_put_html(out, "<li><a href=\"#tails\">Small parts with large errors</a></li>\n");
    }
    if (report->rounds > 0) {
        dip_put_html(out, "<li><a href=\"#work\">Work</a></li>\n");
    }
    dip_put_html(out, "<li><a href=\"#truth\">The truth</a></li>\n"
                      "<li><a href=\"#words\">What the words mean</a></li>\n</ul></nav>\n");
}

void dip_html_title(const DipCostReport *report, FILE *out) {
    dip_put_html(out, "<header>\n<h1>What accuracy costs: ");
    dip_put_html(out, "%s", report->scene);
    dip_put_html(out, "</h1>\n");
    write_contents(report, out);
    dip_put_html(out, "</header>\n");
}

void dip_html_measured(const DipCostReport *report, FILE *out) {
    dip_put_html(out, "<h2 id=\"measured\">What was measured</h2>\n<dl class=\"facts\">\n");
    write_scene_facts(report, out);
    write_method_facts(report, out);
    dip_put_html(out, "</dl>\n");
    if (report->rounds > 0) {
        write_verdict(report, out);
    }
}
