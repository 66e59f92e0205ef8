// Draws the times, the costs and the list of keys in characters.
#include "app/preview/cells/text_view.h"
#include "app/preview/state/keys.h"
#include "renderer/base/assert.h"

#include <stdio.h>

enum {
    LINE_COLUMNS = 37, // Width of a line of times: name and value.
    KEY_COLUMNS = 48,  // Width of a column of keys.
    LABEL_COLUMNS = 14,
    TITLE_COLUMNS = 24,
    STEP_COLUMNS = 21 // Width of a step with its figures: "16 1.56x −.0107".
};

// --- times -------------------------------------------------------------------------------------

// Writes the lines with a pane's times, errors and work below the pane, in as many columns as fit.
static void draw_pane_times(DipTextScreen *screen, DipTextArea area, const DipPanelLine *lines,
                            int count) {
    const int columns = dip_max(1, area.columns / LINE_COLUMNS);
    const int width = dip_min(LINE_COLUMNS, area.columns);
    for (int i = 0; i < count && i < columns * area.rows; ++i) {
        const int row = area.row + i % area.rows;
        const int column = area.column + 1 + i / area.rows * width;
        const int end = column + width - 2;
        const DipPanelLine *line = &lines[i];
        const int value = dip_text_put_right(
            screen, row, column, end, line->head ? dip_text_accent : dip_text_white, line->value);
        dip_text_put(screen, row, column, value - 1, line->head ? dip_text_accent : dip_text_soft,
                     line->name);
    }
}

void dip_text_draw_times(DipTextScreen *screen, DipTextArea body, const DipTextLayout *layout,
                         const DipPaneFigures figures[DIP_PANE_COUNT]) {
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        DipPanelLine lines[DIP_PANEL_MAX_LINES];
        const int count = dip_panel_lines(&figures[p], p, lines);
        const DipTextArea pane = layout->panes[p];
        draw_pane_times(screen, (DipTextArea){pane.column, body.row, pane.columns, body.rows},
                        lines, count);
    }
}

// --- costs -------------------------------------------------------------------------------------

static void draw_how_to(DipTextScreen *screen, DipTextArea body, const DipPreviewState *state) {
    DipHowTo lines;
    dip_preview_how_to(state, lines);
    for (int i = 0; i < DIP_HOW_TO_LINES && i < body.rows; ++i) {
        dip_text_put(screen, body.row + i, body.column + 1, body.column + body.columns,
                     i % 2 ? dip_text_accent : dip_text_white, lines[i]);
    }
}

void dip_text_draw_costs(DipTextScreen *screen, DipTextArea body, const DipPreviewState *state) {
    const int end = body.column + body.columns;
    char heading[DIP_COSTS_HEADING];
    if (!state->costs) {
        draw_how_to(screen, body, state);
        return;
    }
    dip_costs_heading(state->costs, heading);
    dip_text_put(screen, body.row, body.column + 1, end, dip_text_white, heading);
    for (int r = 0; r < state->costs->sweep_count && r + 1 < body.rows; ++r) {
        const DipCostsRow row = dip_costs_row(state->costs, &state->costs->sweeps[r]);
        int column = body.column + 1;
        dip_text_put(screen, body.row + 1 + r, column, column + TITLE_COLUMNS - 1, dip_text_white,
                     row.title);
        column += TITLE_COLUMNS;
        for (int s = 0; s < row.step_count && column < end; ++s) {
            const bool at = dip_costs_is_at(&row, s, &state->quality[DIP_PANE_REQUESTED]);
            char text[64];
            snprintf(text, sizeof text, "%s %s", row.steps[s].name, row.steps[s].figures);
            dip_text_put(screen, body.row + 1 + r, column, dip_min(end, column + STEP_COLUMNS - 1),
                         at ? dip_text_accent : dip_text_soft, text);
            column += STEP_COLUMNS;
        }
    }
}

// --- keys --------------------------------------------------------------------------------------

// Draws a line of the help. The lines fill columns of `rows` lines each; `index` is the line's
// number.
static void draw_key(DipTextScreen *screen, DipTextArea area, int rows, int index,
                     const char *label, const char *text) {
    const int row = area.row + 2 + index % rows;
    const int column = area.column + 2 + index / rows * KEY_COLUMNS;
    const int end = dip_min(area.column + area.columns, column + KEY_COLUMNS - 1);
    dip_text_put(screen, row, column, column + LABEL_COLUMNS - 1, dip_text_accent, label);
    dip_text_put(screen, row, column + LABEL_COLUMNS, end, dip_text_white, text);
}

void dip_text_draw_help(DipTextScreen *screen, DipTextArea area) {
    static const char *const own_keys[][2] = {
        {"Up Down", "Choose a setting"},
        {"Left Right", "Change the chosen setting"},
        {"Ctrl+Z Ctrl+C", "Suspend and end; Alt stands for Ctrl"},
    };
    const int rows = dip_max(1, area.rows - 2);
    int index = 0;
    dip_text_screen_fill(screen, area, dip_text_white.paper);
    dip_text_put(screen, area.row, area.column + 2, area.column + area.columns, dip_text_white,
                 "Keys   (a setting's key with Shift: the step before)");
    for (int i = 0; i < (int)DIP_ARRAY_COUNT(own_keys); ++i) {
        draw_key(screen, area, rows, index++, own_keys[i][0], own_keys[i][1]);
    }
    for (int i = 0; i < dip_key_row_count; ++i) {
        const DipKeyRow *key = &dip_key_rows[i];
        if (key->label && !dip_preview_needs_window(key->action)) {
            const bool setting = key->action == DIP_ACTION_SETTING;
            draw_key(screen, area, rows, index++, key->label,
                     setting ? dip_setting_info((DipSetting)key->argument)->title : key->text);
        }
    }
}
