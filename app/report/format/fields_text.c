// Fields as people read them, and their tables for a terminal.
#include "app/files/put.h"
#include "app/report/format/fields.h"
#include "app/report/words.h"
#include "renderer/base/assert.h"
#include "renderer/scene/quality.h"

#include <math.h>
#include <string.h>

// --- cells ---------------------------------------------------------------------------------------

static void format_number(const DipField *field, double value, char text[DIP_NUMBER_BYTES]) {
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
    } else {
        dip_number_text(value, field->digits, field->show & DIP_SHOW_SIGN, "-", text);
    }
}

void dip_field_interval_text(const DipField *field, const DipEstimate *estimate,
                             char text[DIP_CELL_BYTES]) {
    char low[DIP_NUMBER_BYTES], high[DIP_NUMBER_BYTES];
    text[0] = '\0';
    if (dip_field_has_interval(estimate)) {
        format_number(field, estimate->low, low);
        format_number(field, estimate->high, high);
        snprintf(text, DIP_CELL_BYTES, "%s to %s", low, high);
    }
}

static void format_estimate(const DipField *field, const DipEstimate *estimate, char *text) {
    format_number(field, estimate->value, text);
    if (*text && field->show & DIP_SHOW_SIGN) { // A blank keeps the digits beneath each other.
        const bool doubtful =
            dip_field_has_interval(estimate) && estimate->low <= 0.0 && estimate->high >= 0.0;
        strcat(text, doubtful ? "?" : " ");
    }
}

void dip_field_text(const DipField *field, const void *value, char text[DIP_CELL_BYTES]) {
    text[0] = '\0';
    if (!value) {
        return;
    }
    switch (field->kind) {
    case DIP_FIELD_TEXT:
        snprintf(text, DIP_CELL_BYTES, "%s", (const char *)value);
        break;
    case DIP_FIELD_NAMED:
        snprintf(text, DIP_CELL_BYTES, "%s", field->names[*(const int *)value]);
        break;
    case DIP_FIELD_SETTINGS:
        dip_quality_format_changes(value, text, DIP_CELL_BYTES);
        break;
    case DIP_FIELD_WHOLE:
        snprintf(text, DIP_CELL_BYTES, "%d", *(const int *)value);
        break;
    case DIP_FIELD_FLAG:
        snprintf(text, DIP_CELL_BYTES, "%s", *(const bool *)value ? field->title : "");
        break;
    case DIP_FIELD_ESTIMATE:
        format_estimate(field, value, text);
        break;
    default:
        DIP_ASSERT(field->kind == DIP_FIELD_NUMBER);
        format_number(field, *(const double *)value, text);
    }
}

// --- lines ---------------------------------------------------------------------------------------

typedef struct Line {
    const DipColumn *column;
    DipCellVisit *visit;
    void *context;
    int count; // Cells visited.
    bool is_head;
} Line;

static void visit_cell(Line *line, const DipField *field, const void *value, const char *text) {
    const DipCell cell = {.field = field,
                          .value = value,
                          .text = text,
                          .unit = line->is_head ? field->unit : NULL,
                          .index = line->count++,
                          .is_text =
                              field->kind != DIP_FIELD_NUMBER && field->kind != DIP_FIELD_NUMBERS &&
                              field->kind != DIP_FIELD_ESTIMATE && field->kind != DIP_FIELD_WHOLE};
    DIP_ASSERT(cell.index < DIP_TABLE_MOST_CELLS);
    line->visit(line->context, &cell);
}

// An object of numbers has a cell for each.
static void visit_numbers(Line *line, const DipField *field, const double *values) {
    char text[DIP_CELL_BYTES];
    for (size_t i = 0; i < field->size / sizeof *values; i++) {
        text[0] = '\0';
        if (line->is_head) {
            snprintf(text, sizeof text, "%s", field->names[i]);
            for (char *c = text; *c; c++) { // A title may be broken into lines at blanks.
                *c = *c == '_' ? ' ' : *c;
            }
        } else if (values) {
            format_number(field, values[i], text);
        }
        visit_cell(line, field, values, text);
    }
}

static void visit_field(void *context, const DipField *field, const void *value) {
    Line *line = context;
    char text[DIP_CELL_BYTES];
    if (field->kind == DIP_FIELD_NUMBERS) {
        visit_numbers(line, field, value);
        return;
    }
    if (line->is_head) {
        const char *title = line->column->title ? line->column->title
                            : field->title      ? field->title
                                                : field->name;
        snprintf(text, sizeof text, "%s", title);
    } else {
        dip_field_text(field, value, text);
    }
    visit_cell(line, field, value, text);
    if (field->kind == DIP_FIELD_ESTIMATE) {
        text[0] = '\0';
        if (line->is_head) {
            snprintf(text, sizeof text, "95 %% interval");
        } else if (value) {
            dip_field_interval_text(field, value, text);
        }
        visit_cell(line, field, value, text);
    }
}

static DipFieldAt item_of(const DipTable *table, int line) {
    const char *item =
        (const char *)table->items + (size_t)(line < 0 ? 0 : line) * table->record->size;
    return (DipFieldAt){table->context, line < 0 ? NULL : item, line, NULL};
}

bool dip_table_shows(const DipTable *table, int line) {
    const DipFieldAt at = item_of(table, line);
    return !table->shows || table->shows(&at);
}

int dip_table_row(const DipTable *table, int line) {
    const DipFieldAt at = item_of(table, line);
    return table->row ? table->row(&at) : -1;
}

void dip_table_visit(const DipTable *table, int line, DipCellVisit *visit, void *context) {
    const DipFieldAt at = item_of(table, line);
    Line cells = {.visit = visit, .context = context, .is_head = line < 0};
    for (int c = 0; c < table->column_count; c++) {
        cells.column = &table->columns[c];
        dip_field_visit(table->record, &at, cells.column->path, visit_field, &cells);
    }
}

// --- layout --------------------------------------------------------------------------------------

static int count_characters(const char *text) {
    int count = 0;
    for (; *text; text++) {
        count += ((unsigned char)*text & 0xc0) != 0x80; // The other bytes of UTF-8 go on.
    }
    return count;
}

typedef struct Measuring {
    DipTableLayout *layout;
    // The number of the first line, and whether others differ from it.
    char first[DIP_TABLE_MOST_CELLS][DIP_NUMBER_BYTES];
    bool differs[DIP_TABLE_MOST_CELLS];
    int lines;
} Measuring;

static void measure_cell(void *context, const DipCell *cell) {
    Measuring *m = context;
    int *width = &m->layout->width[cell->index];
    const int count = count_characters(cell->text);
    char number[DIP_NUMBER_BYTES];
    *width = count > *width ? count : *width;
    snprintf(number, sizeof number, "%.23s", cell->text);
    if (m->lines == 0) {
        strcpy(m->first[cell->index], number);
    }
    m->differs[cell->index] |= strcmp(m->first[cell->index], number) != 0;
}

// A cell of the head counts if any line has something beneath it.
static void measure_head(void *context, const DipCell *cell) {
    Measuring *m = context;
    DipTableLayout *layout = m->layout;
    const int title = count_characters(cell->text);
    const int unit = cell->unit ? count_characters(cell->unit) : 0;
    const bool is_same =
        cell->field->kind == DIP_FIELD_NUMBERS && m->lines > 1 && !m->differs[cell->index];
    layout->shown[cell->index] = layout->width[cell->index] > 0 && !is_same;
    if (layout->shown[cell->index]) {
        const int most = title > unit ? title : unit;
        layout->width[cell->index] =
            most > layout->width[cell->index] ? most : layout->width[cell->index];
        layout->last = cell->index;
    }
}

void dip_table_measure(const DipTable *table, DipTableLayout *layout) {
    Measuring measuring = {.layout = layout};
    *layout = (DipTableLayout){.last = -1};
    for (int i = 0; i < table->count; i++) {
        if (dip_table_shows(table, i)) {
            dip_table_visit(table, i, measure_cell, &measuring);
            measuring.lines++;
        }
    }
    dip_table_visit(table, -1, measure_head, &measuring);
}

// --- terminals -----------------------------------------------------------------------------------

typedef struct Printing {
    const DipTableLayout *layout;
    FILE *out;
    bool units; // The head's second line.
    bool is_head;
    int room; // Blanks before the next cell.
} Printing;

static void print_cell(void *context, const DipCell *cell) {
    Printing *p = context;
    if (!p->layout->shown[cell->index]) {
        return;
    }
    const char *text = p->units ? cell->unit ? cell->unit : "" : cell->text;
    text = *text || p->is_head || cell->is_text ? text : "-";
    const int left = p->layout->width[cell->index] - count_characters(text);
    p->room += cell->is_text ? 0 : left;
    if (*text) {
        dip_put_text(p->out, "%*s%s", p->room, "", text);
        p->room = 0;
    }
    p->room += 2 + (cell->is_text ? left : 0);
}

static void has_unit(void *context, const DipCell *cell) {
    Printing *p = context;
    p->units = p->units || (cell->unit && p->layout->shown[cell->index]);
}

static void print_line(const DipTable *table, int line, Printing *p) {
    p->room = 2;
    dip_table_visit(table, line, print_cell, p);
    dip_put_text(p->out, "\n");
}

void dip_table_print_text(const DipTable *table, FILE *out) {
    DipTableLayout layout;
    dip_table_measure(table, &layout);
    Printing p = {.layout = &layout, .out = out, .is_head = true};
    print_line(table, -1, &p);
    dip_table_visit(table, -1, has_unit, &p);
    if (p.units) {
        print_line(table, -1, &p);
    }
    p.is_head = p.units = false;
    for (int i = 0; i < table->count; i++) {
        if (dip_table_shows(table, i)) {
            print_line(table, i, &p);
        }
    }
}
