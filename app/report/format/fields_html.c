// Tables of fields for a page. Its scripts find the rows of a report by the attribute data-row, and
// the settings that a table can be filtered by in data-settings.
#include "app/files/put.h"
#include "app/report/format/fields.h"
#include "renderer/scene/quality.h"

typedef struct Writing {
    const DipTableLayout *layout;
    FILE *out;
} Writing;

static void write_head(void *context, const DipCell *cell) {
    const Writing *w = context;
    if (w->layout->shown[cell->index]) {
        dip_put_html(w->out, "<th scope=\"col\" class=\"%s\">%s", cell->is_text ? "l" : "n",
                     cell->text);
        if (cell->unit) {
            dip_put_html(w->out, " <span class=\"unit\">%s</span>", cell->unit);
        }
        dip_put_html(w->out, "</th>");
    }
}

// Settings get blanks, at which browsers may break the line.
static void write_text(const DipCell *cell, FILE *out) {
    const bool breaks = cell->field->kind == DIP_FIELD_SETTINGS;
    for (const char *text = cell->text; breaks && *text; text++) {
        dip_put_html(out, *text == ',' ? "%c " : "%c", *text);
    }
    dip_put_html(out, "%s", breaks ? "" : cell->text);
}

static void write_cell(void *context, const DipCell *cell) {
    const Writing *w = context;
    const bool has_settings = cell->field->kind == DIP_FIELD_SETTINGS && cell->value;
    if (cell->index == 0) { // Ends the tag of the line.
        char settings[DIP_CELL_BYTES];
        if (has_settings) {
            dip_quality_format(cell->value, settings, sizeof settings);
            dip_put_html(w->out, " data-settings=\"%s\"", settings);
        }
        dip_put_html(w->out, "><th scope=\"row\">");
        write_text(cell, w->out);
        dip_put_html(w->out, "</th>");
    } else if (w->layout->shown[cell->index]) {
        const char *class = cell->field->show & DIP_SHOW_CODE ? "l code"
                            : has_settings                    ? "l name"
                            : cell->is_text                   ? "l"
                                                              : "n";
        dip_put_html(w->out, "<td class=\"%s\">", class);
        write_text(cell, w->out);
        dip_put_html(w->out, "</td>");
    }
}

void dip_table_print_html(const DipTable *table, FILE *out) {
    DipTableLayout layout;
    dip_table_measure(table, &layout);
    Writing w = {&layout, out};
    dip_put_html(out,
                 "<div class=\"table\"><div class=\"scroll\" tabindex=\"0\" role=\"region\" "
                 "aria-labelledby=\"%s-caption\">\n<table id=\"%s\" data-set=\"%s\">\n"
                 "<caption id=\"%s-caption\"><span>%s</span></caption>\n<thead><tr>",
                 table->id, table->id, table->set ? table->set : "", table->id, table->caption);
    dip_table_visit(table, -1, write_head, &w);
    dip_put_html(out, "</tr></thead>\n<tbody>\n");
    for (int i = 0; i < table->count; i++) {
        const int row = dip_table_row(table, i);
        if (dip_table_shows(table, i)) {
            dip_put_html(out, "<tr");
            if (row >= 0) {
                dip_put_html(out, " data-row=\"%d\"", row);
            }
            dip_table_visit(table, i, write_cell, &w);
            dip_put_html(out, "</tr>\n");
        }
    }
    dip_put_html(out, "</tbody></table>\n</div></div>\n");
}
