// Writes tables of fields for a page. The page's scripts find the rows of a report by the attribute
// data-row, and the settings that a table can be filtered by in data-settings.
#include "app/files/put.h"
#include "app/report/format/fields.h"
#include "renderer/scene/quality.h"

// Settings get blanks, at which browsers may break the line.
static void write_text(const DipCell *cell, FILE *out) {
    const bool breaks = cell->kind == DIP_FIELD_SETTINGS;
    for (const char *text = cell->text; breaks && *text; text++) {
        dip_put_html(out, *text == ',' ? "%c " : "%c", *text);
    }
    dip_put_html(out, "%s", breaks ? "" : cell->text);
}

static void write_head(const DipTableLayout *layout, FILE *out) {
    for (int c = 0; c < layout->count; c++) {
        const DipCell *cell = &layout->head[c];
        if (!layout->shown[c]) {
            continue;
        }
        dip_put_html(out, "<th scope=\"col\" class=\"%s\">%s", cell->is_text ? "l" : "n",
                     cell->text);
        if (cell->unit) {
            dip_put_html(out, " <span class=\"unit\">%s</span>", cell->unit);
        }
        dip_put_html(out, "</th>");
    }
}

// Begins a line, whose first cell names it.
static void begin_line(const DipTable *table, int line, const DipCell *first, FILE *out) {
    const int row =
        table->row ? *(const int *)((const char *)table->row + (size_t)line * table->record->size)
                   : -1;
    dip_put_html(out, "<tr");
    if (row >= 0) {
        dip_put_html(out, " data-row=\"%d\"", row);
    }
    if (first->kind == DIP_FIELD_SETTINGS && first->is_known) {
        const DipFieldAt at = dip_table_item(table, line);
        const char *columns = table->columns;
        DipColumn column;
        DipFieldFound found;
        char settings[DIP_CELL_BYTES];
        dip_column_take(&columns, &column);
        dip_field_find(table->record, &at, column.path, &found);
        dip_quality_format(found.value, settings, sizeof settings);
        dip_put_html(out, " data-settings=\"%s\"", settings);
    }
    dip_put_html(out, "><th scope=\"row\">");
    write_text(first, out);
    dip_put_html(out, "</th>");
}

static void write_line(const DipTable *table, const DipTableLayout *layout, int line, FILE *out) {
    DipCell cells[DIP_TABLE_MOST_CELLS];
    dip_table_cells(table, line, cells);
    begin_line(table, line, &cells[0], out);
    for (int c = 1; c < layout->count; c++) {
        const DipCell *cell = &cells[c];
        if (layout->shown[c]) {
            dip_put_html(out, "<td class=\"%s\">",
                         cell->show & DIP_SHOW_CODE                           ? "l code"
                         : cell->kind == DIP_FIELD_SETTINGS && cell->is_known ? "l name"
                         : cell->is_text                                      ? "l"
                                                                              : "n");
            write_text(cell, out);
            dip_put_html(out, "</td>");
        }
    }
    dip_put_html(out, "</tr>\n");
}

void dip_table_print_html(const DipTable *table, FILE *out) {
    DipTableLayout layout;
    dip_table_measure(table, &layout);
    dip_put_html(out,
                 "<div class=\"table\"><div class=\"scroll\" tabindex=\"0\" role=\"region\" "
                 "aria-labelledby=\"%s-caption\">\n<table id=\"%s\" data-set=\"%s\">\n"
                 "<caption id=\"%s-caption\"><span>%s</span></caption>\n<thead><tr>",
                 table->id, table->id, table->set ? table->set : "", table->id, table->caption);
    write_head(&layout, out);
    dip_put_html(out, "</tr></thead>\n<tbody>\n");
    for (int i = 0; i < table->count; i++) {
        if (dip_table_shows(table, i)) {
            write_line(table, &layout, i, out);
        }
    }
    dip_put_html(out, "</tbody></table>\n</div></div>\n");
}
