// Draws the sheets over the window: the table of costs, and the list of keys.
#define _GNU_SOURCE // Declares strcasestr().

#include "app/preview/state/keys.h"
#include "app/preview/tabs/tabs.h"
#include "app/ui/layout.h"
#include "app/ui/style.h"

#include <stdio.h>
#include <string.h>

enum {
    LARGEST_LETTERS = 15,      // Largest letter size of the costs, at scale 1.
    LARGEST_HELP_LETTERS = 17, // Largest letter size of the list of keys, at scale 1.
    TOP_EDGE_PX = 2,
    EDGE_PX = 8, // Pixels of the window's width and height that the list of keys leaves free.
    MAX_HELP_ROWS = DIP_MAX_KEY_ROWS,
    MAX_HELP_GROUPS = 3, // The keys stand in up to three groups beside each other.
    MAX_COLUMNS = 1 + 3 * DIP_COST_MAX_SWEEP_ROWS
};

static const char costs_note[] =
    "1x: the baseline and its FLIP. Other steps: relative time (?: doubtful) and change of FLIP";
static const char help_note[] =
    "0 to 9: the path made to show a setting. While time runs, a change of it plays that path";

// --- a table on a sheet --------------------------------------------------------------------------

typedef struct Cell {
    const char *text; // NULL if the row ends before this column.
    DipColour colour;
    bool is_number; // The text stands at the right side of its column.
} Cell;

// Rows of texts between a title and a note. Each column is as wide as its widest text.
typedef struct Table {
    Cell cells[MAX_HELP_ROWS][MAX_COLUMNS];
    int rows;
    int columns;
    const char *note;
    int half_gaps[MAX_COLUMNS]; // Gap behind each column, in halves of `gap`.
    int gap;
    int size; // Letter size, in pixels.
    int line; // Height of a row, in pixels.
    int widths[MAX_COLUMNS];
    DipRect sheet; // Only its width and height are used.
} Table;

static int gap_behind(const Table *table, int column) {
    return table->gap * table->half_gaps[column] / 2;
}

// Computes the columns' widths and the sheet's size from the cells, table->size and table->gap.
static void measure(Table *table, DipFont *font, int spacing) {
    int width = 0;
    table->line = dip_font_line_height(font, table->size) + spacing;
    for (int c = 0; c < table->columns; ++c) {
        int widest = 0;
        for (int r = 0; r < table->rows; ++r) {
            const char *text = table->cells[r][c].text;
            widest = dip_max(widest, text ? dip_font_width(font, table->size, text) : 0);
        }
        table->widths[c] = widest;
        width += widest + gap_behind(table, c);
    }
    width = dip_max(width, dip_font_width(font, table->size, table->note));
    table->sheet.width = width + 2 * table->size;
    table->sheet.height = (table->rows + 3) * table->line + 2 * table->size;
}

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

// Draws the table's sheet with the rows and the note. Returns the rectangle in which the caller
// writes the title.
static DipRect draw_table(DipDrawList *list, const Table *table) {
    const DipRect sheet = draw_sheet(list, table->sheet.width, table->sheet.height);
    DipRect room = dip_rect_inset(sheet, table->size, table->size);
    const DipRect title = dip_cut_top(&room, table->line);
    int y = room.y + table->line / 2;
    for (int r = 0; r < table->rows; ++r, y += table->line) {
        int x = room.x;
        for (int c = 0; c < table->columns && table->cells[r][c].text; ++c) {
            const Cell *cell = &table->cells[r][c];
            dip_draw_list_text(
                list, table->size, cell->colour, cell->is_number ? DIP_ALIGN_RIGHT : DIP_ALIGN_LEFT,
                cell->is_number ? x + table->widths[c] : x, y, table->widths[c], cell->text);
            x += table->widths[c] + gap_behind(table, c);
        }
    }
    dip_draw_list_text(list, table->size, dip_style_soft, DIP_ALIGN_LEFT, room.x,
                       dip_rect_bottom(room) - table->line, room.width, table->note);
    return title;
}

// --- costs ---------------------------------------------------------------------------------------

// Writes how to make a report of this scene. Lines with a command have the accent colour.
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

// Makes a table with a row for each setting: its title, and each step's name and figures. The cells
// point to the texts of `rows`.
static Table make_costs(const DipCostReport *report, const DipQuality *quality,
                        DipCostsRow rows[DIP_COST_MAX_SWEEPS]) {
    Table table = {.rows = report->sweep_count, .columns = 1, .note = costs_note, .half_gaps = {2}};
    for (int r = 0; r < report->sweep_count; ++r) {
        const DipCostsRow *row = &rows[r];
        rows[r] = dip_costs_row(report, &report->sweeps[r]);
        table.cells[r][0] = (Cell){row->title, dip_style_white, false};
        for (int s = 0; s < row->step_count; ++s) {
            const bool at = dip_costs_is_at(row, s, quality);
            const DipColour soft = at ? dip_style_accent : dip_style_soft;
            Cell *cells = &table.cells[r][1 + 3 * s];
            cells[0] = (Cell){row->steps[s].name, at ? dip_style_accent : dip_style_white, false};
            cells[1] = (Cell){row->steps[s].time, soft, true};
            cells[2] = (Cell){row->steps[s].flip, soft, true};
            table.half_gaps[1 + 3 * s] = table.half_gaps[2 + 3 * s] = 1;
            table.half_gaps[3 + 3 * s] = 2;
            table.columns = dip_max(table.columns, 4 + 3 * s);
        }
    }
    return table;
}

void dip_sheet_draw_costs(DipDrawList *list, const DipPreviewState *state, double scale) {
    DipCostsRow rows[DIP_COST_MAX_SWEEPS];
    char heading[DIP_COSTS_HEADING];
    if (!state->costs) {
        draw_how_to(list, state, scale);
        return;
    }
    dip_costs_heading(state->costs, heading);
    Table table = make_costs(state->costs, &state->quality[DIP_PANE_REQUESTED], rows);
    table.size = dip_style_scaled(LARGEST_LETTERS, scale) + 1;
    do {
        --table.size;
        table.gap = dip_max(4, table.size * 2 / 3);
        measure(&table, dip_draw_list_font(list), 1);
    } while ((table.sheet.width > dip_draw_list_width(list) ||
              table.sheet.height > dip_draw_list_height(list)) &&
             table.size > DIP_FONT_MIN_SIZE);
    const DipRect title = draw_table(list, &table);
    dip_draw_list_text(list, table.size, dip_style_white, DIP_ALIGN_LEFT, title.x, title.y,
                       title.width, heading);
}

// --- help ----------------------------------------------------------------------------------------

// Lists the keys whose label or text contains `words`, in groups of table->rows rows. Returns the
// number of listed keys.
static int list_keys(Table *table, const char *words) {
    int count = 0;
    memset(table->cells, 0, sizeof table->cells);
    for (int i = 0; i < dip_key_row_count; ++i) {
        const DipKeyRow *key = &dip_key_rows[i];
        const char *text = key->action == DIP_ACTION_SETTING
                               ? dip_setting_info((DipSetting)key->argument)->title
                               : key->text;
        if (key->label && (strcasestr(key->label, words) || strcasestr(text, words))) {
            Cell *cells = &table->cells[count % table->rows][count / table->rows * 2];
            cells[0] = (Cell){key->label, dip_style_accent, false};
            cells[1] = (Cell){text, dip_style_white, false};
            ++count;
        }
    }
    return count;
}

// Makes a table of all keys in letters of the given size. The keys stand in `groups` groups beside
// each other.
static Table make_help(DipFont *font, int size, int groups) {
    Table table = {.rows = MAX_HELP_ROWS, .note = help_note, .gap = size, .size = size};
    const int count = list_keys(&table, "");
    table.rows = (count + groups - 1) / groups;
    table.columns = 2 * groups;
    list_keys(&table, "");
    for (int g = 0; g < groups; ++g) {
        table.half_gaps[2 * g] = 2;
        table.half_gaps[2 * g + 1] = g < groups - 1 ? 4 : 0;
    }
    measure(&table, font, dip_max(1, size / 6));
    return table;
}

// Finds the largest letters at which the whole help fits, and the fewest groups for these letters.
// If the window is too small even for the smallest letters, the columns of texts become narrower,
// and texts that are too long end in an ellipsis.
static Table fit_help(const DipDrawList *list, double scale) {
    DipFont *font = dip_draw_list_font(list);
    const int room = dip_draw_list_width(list) - EDGE_PX;
    const int height = dip_draw_list_height(list) - EDGE_PX;
    Table table;
    for (int size = dip_style_scaled(LARGEST_HELP_LETTERS, scale); size >= DIP_FONT_MIN_SIZE;
         --size) {
        for (int groups = 1; groups <= MAX_HELP_GROUPS; ++groups) {
            table = make_help(font, size, groups);
            if (table.sheet.width <= room && table.sheet.height <= height) {
                return table;
            }
        }
    }
    int groups = 1;
    do {
        table = make_help(font, DIP_FONT_MIN_SIZE, groups);
    } while (table.sheet.height > height && ++groups <= MAX_HELP_GROUPS);
    const int excess = dip_max(0, table.sheet.width - room);
    const int used = table.columns / 2;
    for (int g = 0; g < used; ++g) {
        table.widths[2 * g + 1] -= (excess + used - 1) / used;
    }
    table.sheet.width -= excess;
    return table;
}

void dip_sheet_draw_help(DipDrawList *list, double scale, const char *words) {
    Table table = fit_help(list, scale); // The sheet has room for all keys whatever the words are.
    const int count = list_keys(&table, words);
    const DipRect room = draw_table(list, &table);
    char title[64];
    snprintf(title, sizeof title, "Keys: %s", words[0] ? words : "type to search");
    const int title_width = dip_font_width(dip_draw_list_font(list), table.size, title);
    dip_draw_list_text(list, table.size, words[0] ? dip_style_accent : dip_style_white,
                       DIP_ALIGN_LEFT, room.x, room.y, room.width, title);
    dip_draw_list_text(list, table.size, dip_style_soft, DIP_ALIGN_RIGHT, dip_rect_right(room),
                       room.y, room.width - title_width - table.gap,
                       count ? "With Shift: backwards" : "No key has these words");
}
