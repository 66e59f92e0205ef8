// Draws the sheets over the window: the table of costs, and the list of keys.
#include "app/preview/state/keys.h"
#include "app/preview/tabs/tabs.h"
#include "app/ui/style.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

enum { LARGEST_LETTERS = 15, TOP_EDGE_PX = 2 };

static const char costs_note[] =
    "1x: the baseline and its FLIP. Other steps: relative time and change of FLIP";

typedef struct CostsLayout {
    int size;
    int line;
    int title_width;
    int name_width[DIP_COST_MAX_SWEEP_ROWS]; // Width of the longest name in each column of steps.
    int column_width[DIP_COST_MAX_SWEEP_ROWS];
    int width;
    int height;
} CostsLayout;

// Darkens the window and draws an empty sheet of the given size in the middle of the window.
// Returns the sheet's rectangle.
static DipRect draw_sheet(DipDrawList *list, int width, int height) {
    const DipRect window = {0, 0, dip_draw_list_width(list), dip_draw_list_height(list)};
    const DipRect sheet = {(window.width - width) / 2, (window.height - height) / 2, width, height};
    dip_draw_list_fill(list, window, dip_style_shade);
    dip_draw_list_fill(list, sheet, dip_style_sheet);
    dip_draw_list_fill(list, (DipRect){sheet.x, sheet.y, sheet.width, TOP_EDGE_PX},
                       dip_style_accent);
    return sheet;
}

static void measure_titles(CostsLayout *l, DipFont *font, const DipCosts *costs, int gap) {
    for (int r = 0; r < costs->row_count; ++r) {
        const DipCostsRow *row = &costs->rows[r];
        l->title_width = dip_max(l->title_width, dip_font_width(font, l->size, row->title) + gap);
        for (int s = 0; s < row->step_count; ++s) {
            l->name_width[s] = dip_max(l->name_width[s],
                                       dip_font_width(font, l->size, row->steps[s].name) + gap / 2);
        }
    }
}

// Returns the width of a column of steps. The column shows the steps' names one below the other,
// and their figures to the right of the names.
static int measure_column(const CostsLayout *l, DipFont *font, const DipCosts *costs, int step,
                          int gap) {
    int width = 0;
    for (int r = 0; r < costs->row_count; ++r) {
        const DipCostsRow *row = &costs->rows[r];
        if (step < row->step_count) {
            const int figures = dip_font_width(font, l->size, row->steps[step].figures);
            width = dip_max(width, l->name_width[step] + figures + gap);
        }
    }
    return width;
}

static CostsLayout measure_costs(DipFont *font, const DipCosts *costs, int size) {
    CostsLayout l = {.size = size, .line = dip_font_line_height(font, size) + 1};
    const int gap = dip_max(4, size * 2 / 3);
    measure_titles(&l, font, costs, gap);
    l.width = l.title_width;
    for (int s = 0; s < DIP_COST_MAX_SWEEP_ROWS; ++s) {
        l.column_width[s] = measure_column(&l, font, costs, s, gap);
        l.width += l.column_width[s];
    }
    l.width = dip_max(l.width, dip_font_width(font, size, costs_note)) + 2 * size;
    l.height = (costs->row_count + 3) * l.line + 2 * size;
    return l;
}

static void draw_row(DipDrawList *list, const CostsLayout *l, const DipCostsRow *row,
                     const DipQuality *quality, int x, int y) {
    dip_draw_list_text(list, l->size, dip_style_white, DIP_ALIGN_LEFT, x, y, l->title_width,
                       row->title);
    x += l->title_width;
    for (int s = 0; s < row->step_count; ++s) {
        const bool at = dip_costs_is_at(row, s, quality);
        dip_draw_list_text(list, l->size, at ? dip_style_accent : dip_style_white, DIP_ALIGN_LEFT,
                           x, y, l->name_width[s], row->steps[s].name);
        dip_draw_list_text(list, l->size, at ? dip_style_accent : dip_style_soft, DIP_ALIGN_LEFT,
                           x + l->name_width[s], y, l->column_width[s] - l->name_width[s],
                           row->steps[s].figures);
        x += l->column_width[s];
    }
}

// Says how to make a report of this scene. Lines with a command are marked.
static void draw_how_to(DipDrawList *list, const DipPreviewState *state, double scale) {
    DipFont *font = dip_draw_list_font(list);
    const int least = dip_style_scaled(10, scale);
    const int most = dip_style_scaled(LARGEST_LETTERS, scale);
    const int size = dip_max(least, dip_min(most, dip_draw_list_width(list) / 60));
    const int line = dip_font_line_height(font, size) + 2;
    DipHowTo lines;
    dip_preview_how_to(state, lines);
    int width = 0;
    for (int i = 0; i < DIP_HOW_TO_LINES; ++i) {
        width = dip_max(width, dip_font_width(font, size, lines[i]));
    }
    const DipRect sheet = draw_sheet(list, width + 2 * size, DIP_HOW_TO_LINES * line + 2 * size);
    for (int i = 0; i < DIP_HOW_TO_LINES; ++i) {
        dip_draw_list_text(list, size, i % 2 ? dip_style_accent : dip_style_white, DIP_ALIGN_LEFT,
                           sheet.x + size, sheet.y + size + i * line, width, lines[i]);
    }
}

static void draw_table(DipDrawList *list, const DipCostReport *report, const DipQuality *quality,
                       double scale) {
    DipCosts table;
    const DipCosts *costs = &table;
    char heading[DIP_COSTS_HEADING];
    dip_costs_make(&table, report);
    dip_costs_heading(report, heading);
    CostsLayout l;
    int size = dip_style_scaled(LARGEST_LETTERS, scale);
    do {
        l = measure_costs(dip_draw_list_font(list), costs, size);
    } while ((l.width > dip_draw_list_width(list) || l.height > dip_draw_list_height(list)) &&
             size-- > DIP_FONT_MIN_SIZE);
    const DipRect sheet = draw_sheet(list, l.width, l.height);
    const int x = sheet.x + l.size, y = sheet.y + l.size, room = sheet.width - 2 * l.size;
    dip_draw_list_text(list, l.size, dip_style_white, DIP_ALIGN_LEFT, x, y, room, heading);
    for (int r = 0; r < costs->row_count; ++r) {
        draw_row(list, &l, &costs->rows[r], quality, x, y + (r + 1) * l.line + l.line / 2);
    }
    dip_draw_list_text(list, l.size, dip_style_soft, DIP_ALIGN_LEFT, x,
                       y + (costs->row_count + 2) * l.line, room, costs_note);
}

void dip_sheet_draw_costs(DipDrawList *list, const DipPreviewState *state, double scale) {
    if (state->costs) {
        draw_table(list, state->costs, &state->quality[DIP_PANE_REQUESTED], scale);
    } else {
        draw_how_to(list, state, scale);
    }
}

static const char help_title[] = "Keys";
static const char help_shift[] = "With Shift: backwards";
static const char help_note[] =
    "While time runs, a change of a setting also chooses the path that shows it best";

// --- help ----------------------------------------------------------------------------------------

enum { MAX_HELP_ROWS = 56, MAX_HELP_COLUMNS = 3, LARGEST_HELP_LETTERS = 17, EDGE_PX = 8 };

typedef struct HelpRow {
    const char *label;
    const char *text;
} HelpRow;

static int help_rows(HelpRow rows[MAX_HELP_ROWS]) {
    int count = 0;
    for (int i = 0; i < dip_key_row_count && count < MAX_HELP_ROWS; ++i) {
        const DipKeyRow *key = &dip_key_rows[i];
        if (key->label) {
            const bool setting = key->action == DIP_ACTION_SETTING;
            rows[count++] =
                (HelpRow){key->label,
                          setting ? dip_setting_info((DipSetting)key->argument)->title : key->text};
        }
    }
    return count;
}

// Returns whether a text holds words in any case.
static bool holds(const char *text, const char *words) {
    const size_t length = strlen(words);
    for (; strlen(text) >= length; ++text) {
        size_t same = 0;
        while (same < length &&
               tolower((unsigned char)text[same]) == tolower((unsigned char)words[same])) {
            ++same;
        }
        if (same == length) {
            return true;
        }
    }
    return false;
}

// Keeps the rows that hold the words. Returns their number.
static int search(HelpRow rows[MAX_HELP_ROWS], int count, const char *words) {
    int kept = 0;
    for (int i = 0; i < count; ++i) {
        if (holds(rows[i].label, words) || holds(rows[i].text, words)) {
            rows[kept++] = rows[i];
        }
    }
    return kept;
}

typedef struct HelpLayout {
    int size;
    int columns;
    int rows_per_column;
    int line;
    int gap;
    int label_width[MAX_HELP_COLUMNS];
    int text_width[MAX_HELP_COLUMNS];
    int width;
    int height;
} HelpLayout;

static void measure_columns(HelpLayout *l, DipFont *font, const HelpRow *rows, int count) {
    for (int c = 0; c < MAX_HELP_COLUMNS; ++c) {
        const int first = c * l->rows_per_column;
        for (int i = first; i < first + l->rows_per_column && i < count; ++i) {
            l->label_width[c] =
                dip_max(l->label_width[c], dip_font_width(font, l->size, rows[i].label));
            l->text_width[c] =
                dip_max(l->text_width[c], dip_font_width(font, l->size, rows[i].text));
        }
    }
}

static HelpLayout measure_help(DipFont *font, const HelpRow *rows, int count, int size,
                               int columns) {
    HelpLayout l = {.size = size, .columns = columns, .gap = size};
    l.line = dip_font_line_height(font, size) + dip_max(1, size / 6);
    l.rows_per_column = (count + columns - 1) / columns;
    measure_columns(&l, font, rows, count);
    int rows_width = (columns - 1) * 2 * l.gap;
    for (int c = 0; c < columns && c < MAX_HELP_COLUMNS; ++c) {
        rows_width += l.label_width[c] + l.gap + l.text_width[c];
    }
    l.width = dip_max(rows_width, dip_font_width(font, size, help_note)) + 2 * size;
    l.height = (l.rows_per_column + 3) * l.line + 2 * size;
    return l;
}

// Narrows the texts until the sheet fits into the window. Texts that are too long then end in an
// ellipsis.
static HelpLayout squeeze(HelpLayout l, int room) {
    const int excess = l.width - room;
    for (int c = 0; excess > 0 && c < l.columns; ++c) {
        l.text_width[c] -= (excess + l.columns - 1) / l.columns;
    }
    l.width = dip_min(l.width, room);
    return l;
}

// Finds the largest letters at which the whole help fits, and the fewest columns for these letters.
// If the window is too small even for the smallest letters, squeezes the texts.
static HelpLayout choose_layout(const DipDrawList *list, const HelpRow *rows, int count,
                                double scale) {
    DipFont *font = dip_draw_list_font(list);
    const int room = dip_draw_list_width(list) - EDGE_PX;
    const int height = dip_draw_list_height(list) - EDGE_PX;
    HelpLayout l = {0};
    for (int size = dip_style_scaled(LARGEST_HELP_LETTERS, scale); size >= DIP_FONT_MIN_SIZE;
         --size) {
        for (int columns = 1; columns <= MAX_HELP_COLUMNS; ++columns) {
            l = measure_help(font, rows, count, size, columns);
            if (l.width <= room && l.height <= height) {
                return l;
            }
        }
    }
    for (int columns = 1; columns <= MAX_HELP_COLUMNS; ++columns) {
        l = measure_help(font, rows, count, DIP_FONT_MIN_SIZE, columns);
        if (l.height <= height) {
            break;
        }
    }
    return squeeze(l, room);
}

static void draw_rows(DipDrawList *list, const HelpLayout *l, const HelpRow *rows, int count, int x,
                      int y) {
    for (int i = 0; i < count; ++i) {
        const int column = i / l->rows_per_column;
        const int row_y = y + i % l->rows_per_column * l->line;
        dip_draw_list_text(list, l->size, dip_style_accent, DIP_ALIGN_LEFT, x, row_y,
                           l->label_width[column], rows[i].label);
        dip_draw_list_text(list, l->size, dip_style_white, DIP_ALIGN_LEFT,
                           x + l->label_width[column] + l->gap, row_y, l->text_width[column],
                           rows[i].text);
        if ((i + 1) % l->rows_per_column == 0) {
            x += l->label_width[column] + l->text_width[column] + 3 * l->gap;
        }
    }
}

void dip_sheet_draw_help(DipDrawList *list, double scale, const char *words) {
    HelpRow rows[MAX_HELP_ROWS];
    int count = help_rows(rows);
    const HelpLayout l =
        choose_layout(list, rows, count, scale); // It stands still while one types.
    const DipRect sheet = draw_sheet(list, l.width, l.height);
    const int x = sheet.x + l.size, y = sheet.y + l.size;
    const int room = sheet.width - 2 * l.size;
    char title[64];
    count = search(rows, count, words);
    snprintf(title, sizeof title, "%s: %s", help_title, words[0] ? words : "type to search");
    const int title_width = dip_font_width(dip_draw_list_font(list), l.size, title);
    dip_draw_list_text(list, l.size, words[0] ? dip_style_accent : dip_style_white, DIP_ALIGN_LEFT,
                       x, y, room, title);
    dip_draw_list_text(list, l.size, dip_style_soft, DIP_ALIGN_RIGHT, x + room, y,
                       room - title_width - l.gap, count ? help_shift : "No key has these words");
    draw_rows(list, &l, rows, count, x, y + l.line + l.line / 2);
    dip_draw_list_text(list, l.size, dip_style_soft, DIP_ALIGN_LEFT, x,
                       sheet.y + sheet.height - l.size - l.line, room, help_note);
}
