// Draws the sheet of costs: a table with the time and the error of each step (value) of each
// setting. Also draws empty sheets.
#include "app/preview/tabs/sheet.h"
#include "app/ui/style.h"

#include <stdio.h>

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

DipRect dip_sheet_draw(DipDrawList *list, int width, int height) {
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
        l->title_width =
            dip_style_max(l->title_width, dip_font_width(font, l->size, row->title) + gap);
        for (int s = 0; s < row->step_count; ++s) {
            l->name_width[s] = dip_style_max(
                l->name_width[s], dip_font_width(font, l->size, row->steps[s].name) + gap / 2);
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
            width = dip_style_max(width, l->name_width[step] + figures + gap);
        }
    }
    return width;
}

static CostsLayout measure_costs(DipFont *font, const DipCosts *costs, int size) {
    CostsLayout l = {.size = size, .line = dip_font_line_height(font, size) + 1};
    const int gap = dip_style_max(4, size * 2 / 3);
    measure_titles(&l, font, costs, gap);
    l.width = l.title_width;
    for (int s = 0; s < DIP_COST_MAX_SWEEP_ROWS; ++s) {
        l.column_width[s] = measure_column(&l, font, costs, s, gap);
        l.width += l.column_width[s];
    }
    l.width = dip_style_max(l.width, dip_font_width(font, size, costs_note)) + 2 * size;
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
    enum { LINES = 4, LINE_BYTES = 1200 };
    DipFont *font = dip_draw_list_font(list);
    const int least = dip_style_scaled(10, scale);
    const int most = dip_style_scaled(LARGEST_LETTERS, scale);
    const int size = dip_style_max(least, dip_style_min(most, dip_draw_list_width(list) / 60));
    const int line = dip_font_line_height(font, size) + 2;
    char lines[LINES][LINE_BYTES] = {"There is no cost report yet. This makes one in some minutes:",
                                     "", "Then start the preview with it:", ""};
    snprintf(lines[1], LINE_BYTES, "    diptych cost%s --out DIR", state->scene_words);
    snprintf(lines[3], LINE_BYTES, "    diptych%s --cost DIR/cost.json", state->scene_words);
    int width = 0;
    for (int i = 0; i < LINES; ++i) {
        width = dip_style_max(width, dip_font_width(font, size, lines[i]));
    }
    const DipRect sheet = dip_sheet_draw(list, width + 2 * size, LINES * line + 2 * size);
    for (int i = 0; i < LINES; ++i) {
        dip_draw_list_text(list, size, i % 2 ? dip_style_accent : dip_style_white, DIP_ALIGN_LEFT,
                           sheet.x + size, sheet.y + size + i * line, width, lines[i]);
    }
}

static void draw_table(DipDrawList *list, const DipCostReport *report, const DipQuality *quality,
                       double scale) {
    DipCosts table;
    const DipCosts *costs = &table;
    CostsLayout l;
    char heading[DIP_COSTS_HEADING];
    dip_costs_make(&table, report);
    dip_costs_heading(report, heading);
    int size = dip_style_scaled(LARGEST_LETTERS, scale);
    do {
        l = measure_costs(dip_draw_list_font(list), costs, size);
    } while ((l.width > dip_draw_list_width(list) || l.height > dip_draw_list_height(list)) &&
             size-- > DIP_FONT_MIN_SIZE);
    const DipRect sheet = dip_sheet_draw(list, l.width, l.height);
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
