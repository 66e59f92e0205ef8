// Lays out tables of fields, and prints them for a terminal and for a page.
#include "app/files/put.h"
#include "app/report/format/fields.h"
#include "renderer/base/assert.h"
#include "renderer/scene/quality.h"

#include <math.h>
#include <string.h>

enum { MOST_CELLS = 64 };

// A cell of a table's line or head.
typedef struct Cell {
    char text[DIP_CELL_BYTES];
    const char *unit; // Unit of a cell of the head; NULL if there is none.
    DipFieldKind kind;
    unsigned show;
    bool is_known;
    bool is_text; // True if the cell is aligned to the left, false if to the right.
} Cell;

// The head of a table, which of its columns are shown, and their widths in characters.
typedef struct Layout {
    Cell head[MOST_CELLS];
    int count;
    bool shown[MOST_CELLS];
    int width[MOST_CELLS];
} Layout;

// --- cells ---------------------------------------------------------------------------------------

static bool is_time(const DipField *field) {
    return field->unit && strcmp(field->unit, "ms") == 0;
}

// Writes a time, or a field that is computed from times. Only times, and not changes of a time, are
// compared with limits.
static void format_of_times(const DipField *field, DipLimits limits, double value,
                            char text[DIP_NUMBER_BYTES]) {
    const bool is_change = field->show & DIP_SHOW_SIGN;
    limits.count = is_time(field) && !is_change ? limits.count : 0;
    dip_limited_number(value, field->digits, is_change, limits, "-", text);
}

static void format_number(const DipField *field, DipLimits limits, double value,
                          char text[DIP_NUMBER_BYTES]) {
    value *= field->scale != 0.0 ? field->scale : 1.0;
    if (!isfinite(value)) {
        text[0] = '\0';
    } else if (field->show & DIP_SHOW_FIGURES) {
        const int before = value != 0.0 ? (int)floor(log10(fabs(value))) + 1 : 1;
        const int after = field->digits - before > 0 ? field->digits - before : 0;
        dip_number_text(value, after, field->show & DIP_SHOW_SIGN, "-", text);
        for (size_t end = strlen(text); strchr(text, '.') && strchr("0.", text[end - 1]); end--) {
            text[end - 1] = '\0';
        }
    } else if (is_time(field) || field->show & DIP_SHOW_OF_TIMES) {
        format_of_times(field, limits, value, text);
    } else {
        dip_number_text(value, field->digits, field->show & DIP_SHOW_SIGN, "-", text);
    }
}

void dip_field_interval_text(const DipField *field, DipLimits limits, const DipEstimate *estimate,
                             char text[DIP_CELL_BYTES]) {
    char low[DIP_NUMBER_BYTES], high[DIP_NUMBER_BYTES];
    text[0] = '\0';
    if (dip_field_has_interval(estimate)) {
        format_number(field, limits, estimate->low, low);
        format_number(field, limits, estimate->high, high);
        snprintf(text, DIP_CELL_BYTES, "%s to %s", low, high);
    }
}

static void format_estimate(const DipField *field, DipLimits limits, const DipEstimate *estimate,
                            char *text) {
    const bool has_interval = dip_field_has_interval(estimate);
    if (field->show & DIP_SHOW_OF_TIMES && !has_interval && estimate->value == 1.0) {
        limits.doubtful = false; // A time divided by itself is surely 1.
    }
    format_number(field, limits, estimate->value, text);
    if (*text && field->show & DIP_SHOW_SIGN) { // A blank in place of '?' keeps digits aligned.
        strcat(text, has_interval && estimate->low <= 0.0 && estimate->high >= 0.0 ? "?" : " ");
    }
}

// Formats a known value as people read it, without its unit.
static void format_value(const DipField *field, DipLimits limits, const void *value,
                         char text[DIP_CELL_BYTES]) {
    if (field->kind == DIP_FIELD_TEXT) {
        snprintf(text, DIP_CELL_BYTES, "%s", (const char *)value);
    } else if (field->kind == DIP_FIELD_NAMED) {
        snprintf(text, DIP_CELL_BYTES, "%s", field->names[*(const int *)value]);
    } else if (field->kind == DIP_FIELD_SETTINGS) {
        dip_quality_format_changes(value, text, DIP_CELL_BYTES);
    } else if (field->kind == DIP_FIELD_WHOLE) {
        snprintf(text, DIP_CELL_BYTES, "%d", *(const int *)value);
    } else if (field->kind == DIP_FIELD_FLAG) {
        snprintf(text, DIP_CELL_BYTES, "%s", *(const bool *)value ? field->title : "");
    } else if (field->kind == DIP_FIELD_ESTIMATE) {
        format_estimate(field, limits, value, text);
    } else {
        format_number(field, limits, *(const double *)value, text);
    }
}

// --- lines ---------------------------------------------------------------------------------------

// Returns the item of the line with this index. The index of the head is -1, and its item is NULL.
static DipFieldAt item_of(const DipTable *table, int line) {
    const char *items = table->items;
    return (DipFieldAt){table->context,
                        line < 0 ? NULL : items + (size_t)line * table->record->size, line, NULL};
}

static bool shows(const DipTable *table, int line) {
    const DipFieldAt at = item_of(table, line);
    return !table->shows || table->shows(&at);
}

// Fills in the cells of a column, and returns their number.
static int fill_column(const DipColumn *column, const DipFieldFound *found, DipLimits limits,
                       bool is_head, Cell *cells) {
    const DipField *field = &found->field;
    const bool is_object = field->kind == DIP_FIELD_NUMBERS;
    const bool is_estimate = field->kind == DIP_FIELD_ESTIMATE;
    const int count = is_object ? (int)(field->size / sizeof(double)) : is_estimate ? 2 : 1;
    const char *title = column->has_title ? column->title
                        : field->title    ? field->title
                                          : field->name;
    for (int i = 0; i < count; i++) {
        Cell *cell = &cells[i];
        *cell = (Cell){.unit = is_head ? field->unit : NULL,
                       .kind = field->kind,
                       .show = field->show,
                       .is_known = found->value,
                       .is_text = !is_object && !is_estimate && field->kind != DIP_FIELD_NUMBER &&
                                  field->kind != DIP_FIELD_WHOLE};
        if (is_head) {
            snprintf(cell->text, sizeof cell->text, "%s",
                     is_object               ? field->names[i]
                     : is_estimate && i == 1 ? "95 % interval"
                                             : title);
            for (char *c = cell->text; is_object && *c; c++) {
                *c = *c == '_' ? ' ' : *c; // Pages may break a title into lines at blanks.
            }
        } else if (found->value && is_estimate && i == 1) {
            dip_field_interval_text(field, limits, found->value, cell->text);
        } else if (found->value) {
            format_value(field, limits, (const double *)found->value + i, cell->text);
        }
    }
    return count;
}

// Fills in the cells of the line with this index, or of the head (-1). Returns their number, which
// is the same for all lines.
static int fill_cells(const DipTable *table, int line, Cell cells[MOST_CELLS]) {
    const DipFieldAt at = item_of(table, line);
    const char *columns = table->columns;
    int count = 0;
    for (DipColumn column; dip_column_take(&columns, &column);) {
        DipFieldFound found;
        dip_field_find(table->record, &at, column.path, &found);
        count += fill_column(&column, &found, table->limits, line < 0, &cells[count]);
        DIP_ASSERT(count <= MOST_CELLS);
    }
    return count;
}

// --- layout --------------------------------------------------------------------------------------

static int count_characters(const char *text) {
    int count = 0;
    for (; *text; text++) {
        count += ((unsigned char)*text & 0xc0) != 0x80; // The other bytes continue a character.
    }
    return count;
}

static void widen(int *width, const char *text) {
    const int count = text ? count_characters(text) : 0;
    *width = count > *width ? count : *width;
}

static void measure(const DipTable *table, Layout *layout) {
    Cell first[MOST_CELLS], cells[MOST_CELLS];
    bool differs[MOST_CELLS] = {false};
    int lines = 0;
    memset(layout, 0, sizeof *layout);
    layout->count = fill_cells(table, -1, layout->head);
    for (int i = 0; i < table->count; i++) {
        if (!shows(table, i)) {
            continue;
        }
        fill_cells(table, i, lines++ == 0 ? first : cells);
        for (int c = 0; c < layout->count; c++) {
            const char *text = lines == 1 ? first[c].text : cells[c].text;
            widen(&layout->width[c], text);
            differs[c] |= strcmp(first[c].text, text) != 0;
        }
    }
    for (int c = 0; c < layout->count; c++) {
        const Cell *head = &layout->head[c];
        const bool is_same = head->kind == DIP_FIELD_NUMBERS && lines > 1 && !differs[c];
        layout->shown[c] = layout->width[c] > 0 && !is_same;
        widen(&layout->width[c], head->text);
        widen(&layout->width[c], head->unit);
    }
}

// --- terminals -----------------------------------------------------------------------------------

// Prints a line, or one of the two lines of the head: the titles, or the units.
static void print_line(const Cell *cells, const Layout *layout, bool is_head, bool units,
                       FILE *out) {
    int room = 2; // Number of blanks before the next cell.
    for (int c = 0; c < layout->count; c++) {
        const Cell *cell = &cells[c];
        if (!layout->shown[c]) {
            continue;
        }
        const char *text = !units ? cell->text : cell->unit ? cell->unit : "";
        text = *text || is_head || cell->is_text ? text : "-";
        const int left = layout->width[c] - count_characters(text);
        room += cell->is_text ? 0 : left;
        if (*text) {
            dip_put_text(out, "%*s%s", room, "", text);
            room = 0;
        }
        room += 2 + (cell->is_text ? left : 0);
    }
    dip_put_text(out, "\n");
}

void dip_table_print_text(const DipTable *table, FILE *out) {
    Layout layout;
    Cell cells[MOST_CELLS];
    bool has_units = false;
    measure(table, &layout);
    for (int c = 0; c < layout.count; c++) {
        has_units = has_units || (layout.head[c].unit && layout.shown[c]);
    }
    print_line(layout.head, &layout, true, false, out);
    if (has_units) {
        print_line(layout.head, &layout, true, true, out);
    }
    for (int i = 0; i < table->count; i++) {
        if (shows(table, i)) {
            fill_cells(table, i, cells);
            print_line(cells, &layout, false, false, out);
        }
    }
}

// --- pages ---------------------------------------------------------------------------------------

// Writes the text of a cell. Settings get blanks, at which browsers may break the line.
static void write_text(const Cell *cell, FILE *out) {
    const bool breaks = cell->kind == DIP_FIELD_SETTINGS;
    for (const char *text = cell->text; breaks && *text; text++) {
        dip_put_html(out, *text == ',' ? "%c " : "%c", *text);
    }
    dip_put_html(out, "%s", breaks ? "" : cell->text);
}

static void write_head(const Layout *layout, FILE *out) {
    for (int c = 0; c < layout->count; c++) {
        const Cell *cell = &layout->head[c];
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

// Begins a line of the table with its first cell, which is the line's heading.
static void begin_line(const DipTable *table, int line, const Cell *first, FILE *out) {
    const int row =
        table->row ? *(const int *)((const char *)table->row + (size_t)line * table->record->size)
                   : -1;
    dip_put_html(out, "<tr");
    if (row >= 0) {
        dip_put_html(out, " data-row=\"%d\"", row);
    }
    if (first->kind == DIP_FIELD_SETTINGS && first->is_known) {
        const DipFieldAt at = item_of(table, line);
        const char *columns = table->columns;
        DipColumn column;
        DipFieldFound found;
        char settings[DIP_SETTINGS_BYTES];
        dip_column_take(&columns, &column);
        dip_field_find(table->record, &at, column.path, &found);
        dip_put_html(out, " data-settings=\"%s\"",
                     dip_field_as_text(&found.field, found.value, settings));
    }
    dip_put_html(out, "><th scope=\"row\">");
    write_text(first, out);
    dip_put_html(out, "</th>");
}

static void write_line(const DipTable *table, const Layout *layout, int line, FILE *out) {
    Cell cells[MOST_CELLS];
    fill_cells(table, line, cells);
    begin_line(table, line, &cells[0], out);
    for (int c = 1; c < layout->count; c++) {
        const Cell *cell = &cells[c];
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
    Layout layout;
    measure(table, &layout);
    dip_put_html(out,
                 "<div class=\"table\"><div class=\"scroll\" tabindex=\"0\" role=\"region\" "
                 "aria-labelledby=\"%s-caption\">\n<table id=\"%s\" data-set=\"%s\">\n"
                 "<caption id=\"%s-caption\"><span>%s</span></caption>\n<thead><tr>",
                 table->id, table->id, table->set ? table->set : "", table->id,
                 table->caption ? table->caption : "");
    write_head(&layout, out);
    dip_put_html(out, "</tr></thead>\n<tbody>\n");
    for (int i = 0; i < table->count; i++) {
        if (shows(table, i)) {
            write_line(table, &layout, i, out);
        }
    }
    dip_put_html(out, "</tbody></table>\n</div></div>\n");
}
