// Draws the help: the table of keys in columns.
#include "app/preview/state/keys.h"
#include "app/preview/tabs/sheet.h"
#include "app/ui/style.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

static const char help_title[] = "Keys";
static const char help_shift[] = "With Shift: backwards";
static const char help_note[] =
    "While time runs, a change of a setting also chooses the path that shows it best";

enum { MAX_HELP_ROWS = 56, MAX_HELP_COLUMNS = 3, LARGEST_LETTERS = 17, EDGE_PX = 8 };

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
    for (int size = dip_style_scaled(LARGEST_LETTERS, scale); size >= DIP_FONT_MIN_SIZE; --size) {
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
    const DipRect sheet = dip_sheet_draw(list, l.width, l.height);
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
