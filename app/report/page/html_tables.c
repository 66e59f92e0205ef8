// Writing tables of the HTML page.
#include "app/report/page/html_parts.h"

#include "app/files/put.h"

void dip_html_table_begin(FILE *out, const char *id, const char *set) {
    dip_put_html(out,
                 "<div class=\"table\"><div class=\"scroll\" tabindex=\"0\" role=\"region\" "
                 "aria-labelledby=\"%s-caption\">\n<table id=\"%s\"",
                 id, id);
    if (set) {
        dip_put_html(out, " data-set=\"%s\"", set);
    }
    dip_put_html(out, ">\n<caption id=\"%s-caption\"><span>", id);
}

void dip_html_columns_begin(FILE *out) {
    dip_put_html(out, "</span></caption>\n<thead><tr>");
}

void dip_html_column(FILE *out, const char *title, const char *unit) {
    if (unit) {
        dip_put_html(out, "<th scope=\"col\">%s <span class=\"unit\">%s</span></th>", title, unit);
    } else {
        dip_put_html(out, "<th scope=\"col\">%s</th>", title);
    }
}

void dip_html_text_column(FILE *out, const char *title) {
    dip_put_html(out, "<th scope=\"col\" class=\"l\">%s</th>", title);
}

void dip_html_columns_end(FILE *out) {
    dip_put_html(out, "</tr></thead>\n<tbody>\n");
}

void dip_html_line_begin(FILE *out, int row) {
    if (row >= 0) {
        dip_put_html(out, "<tr data-row=\"%d\">", row);
    } else {
        dip_put_html(out, "<tr>");
    }
}

void dip_html_table_end(FILE *out) {
    dip_put_html(out, "</tbody></table>\n</div></div>\n");
}
