// Writing tables of the HTML page.
#include "app/report/page/html_parts.h"

void dip_html_table_begin(FILE *out, const char *id, const char *attributes) {
    fprintf(out,
            "<div class=\"table\"><div class=\"scroll\" tabindex=\"0\" role=\"region\" "
            "aria-labelledby=\"%s-caption\">\n<table id=\"%s\"%s>\n<caption "
            "id=\"%s-caption\"><span>",
            id, id, attributes, id);
}

void dip_html_columns_begin(FILE *out) {
    fprintf(out, "</span></caption>\n<thead><tr>");
}

void dip_html_column(FILE *out, const char *title, const char *unit) {
    if (unit) {
        fprintf(out, "<th scope=\"col\">%s <span class=\"unit\">%s</span></th>", title, unit);
    } else {
        fprintf(out, "<th scope=\"col\">%s</th>", title);
    }
}

void dip_html_text_column(FILE *out, const char *title) {
    fprintf(out, "<th scope=\"col\" class=\"l\">%s</th>", title);
}

void dip_html_columns_end(FILE *out) {
    fprintf(out, "</tr></thead>\n<tbody>\n");
}

void dip_html_line_begin(FILE *out, int row) {
    if (row >= 0) {
        fprintf(out, "<tr data-row=\"%d\">", row);
    } else {
        fprintf(out, "<tr>");
    }
}

void dip_html_table_end(FILE *out) {
    fprintf(out, "</tbody></table>\n</div></div>\n");
}
