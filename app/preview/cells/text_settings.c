// Draws the settings in characters: each setting's steps, and what a cost report says about them.
#include "app/ui/style.h"
#include "app/preview/cells/text_view.h"
#include "renderer/base/assert.h"

#include <stdio.h>
#include <string.h>

enum {
    BLOCK_COLUMNS = 44,  // Width of a column of blocks; a setting is a block of several rows.
    SUM_COLUMNS = 26,    // Width that the blocks leave free at the right.
    ROW_COLUMNS = 56,    // Least width of a setting that takes one row.
    NAME_COLUMNS = 23,   // Width of a setting's name in its row.
    FIGURE_COLUMNS = 15, // Width of a step's figures behind its row.
    MAX_BLOCK_COLUMNS = 3,
    MARGIN = 1
};

static const DipTextColours name = {{196, 202, 210, 255}, {10, 11, 14, 255}};
static const DipTextColours name_focused = {{255, 255, 255, 255}, {30, 70, 110, 255}};
static const DipTextColours title = {{255, 255, 255, 255}, {10, 11, 14, 255}};
static const DipTextColours dim = {{152, 162, 174, 255}, {10, 11, 14, 255}};
static const DipTextColours wanted = {{26, 18, 6, 255}, {255, 190, 92, 255}}; // Requested step.
static const DipTextColours wanted_text = {{255, 190, 92, 255}, {10, 11, 14, 255}};
static const DipTextColours gain = {{95, 214, 189, 255}, {10, 11, 14, 255}};   // Less error.
static const DipTextColours worse = {{255, 154, 139, 255}, {10, 11, 14, 255}}; // More error.

// Columns of blocks on a wide screen, from left to right; settings that belong together share one.
static const int block_columns[MAX_BLOCK_COLUMNS][5] = {
    {DIP_SETTING_AA, DIP_SETTING_TAA, DIP_SETTING_AAA, DIP_SETTING_ASD, -1},
    {DIP_SETTING_AF, DIP_SETTING_AAF, DIP_SETTING_OPT, -1, -1},
    {DIP_SETTING_MIPLOD, DIP_SETTING_GI, DIP_SETTING_MIPDEBUG, -1, -1},
};

static bool is_switch(DipSetting setting) {
    return dip_setting_info(setting)->step_count == 2;
}

// Returns a step's name, short enough for a narrow column.
static const char *step_name(DipSetting setting, int step) {
    return dip_setting_info(setting)->narrow_labels[step];
}

// --- steps -------------------------------------------------------------------------------------

static void add_target(DipTextView *view, DipTextArea area, DipSetting setting, int step) {
    if (view->target_count < DIP_TEXT_MAX_TARGETS) {
        view->targets[view->target_count++] = (DipTextTarget){area, setting, step};
    }
}

// Draws one step: filled if it is the requested one, in brackets if it is the current one.
static void draw_step(DipTextView *view, const DipPreviewState *state, DipSetting setting, int step,
                      DipTextArea area) {
    const bool current = state->quality[DIP_PANE_CURRENT].step[setting] == step;
    const bool requested = state->quality[DIP_PANE_REQUESTED].step[setting] == step;
    const char *text = step_name(setting, step);
    const int room = area.columns - 2 - dip_text_length(text);
    const int left = room > 0 ? room / 2 : 0;
    char framed[32];
    snprintf(framed, sizeof framed, "%s%s%s", current ? "[" : " ", text, current ? "]" : " ");
    const DipTextColours colours = requested ? wanted : current ? title : name;
    const int column = area.column + left;
    dip_text_put(&view->screen, area.row, column, area.column + area.columns, colours, framed);
    add_target(view, area, setting, step);
}

// Draws all steps side by side, each `width` cells wide.
static void draw_steps(DipTextView *view, const DipPreviewState *state, DipSetting setting, int row,
                       int column, int width) {
    const int count = dip_setting_info(setting)->step_count;
    for (int i = 0; i < count; ++i) {
        draw_step(view, state, setting, dip_setting_step_at(setting, i),
                  (DipTextArea){column + i * width, row, width, 1});
    }
}

static bool is_focused(const DipTextView *view, DipSetting setting) {
    return view->focused && view->focus == setting;
}

// --- figures of a cost report ------------------------------------------------------------------

// Returns the steps of a setting in the report, none if there is no report.
static DipCostsRow costs_row(const DipCostReport *report, DipSetting setting) {
    for (int i = 0; report && i < report->sweep_count; ++i) {
        if (report->sweeps[i].setting == setting) {
            return dip_costs_row(report, &report->sweeps[i]);
        }
    }
    return (DipCostsRow){.step_count = 0};
}

// Returns a step of a report, or NULL if the report does not have it.
static const DipCostsStep *costs_step(const DipCostsRow *row, DipSetting setting, int step) {
    for (int s = 0; s < row->step_count; ++s) {
        if (row->steps[s].quality.step[setting] == step) {
            return &row->steps[s];
        }
    }
    return NULL;
}

static DipTextColours error_colours(const DipCostsStep *step) {
    return step->flip_change < 0.0 ? gain : step->flip_change > 0.0 ? worse : dim;
}

// Draws two rows beneath the steps: the relative time of each step, and its error.
static void draw_figures(DipTextView *view, const DipCostsRow *costs, DipSetting setting, int row,
                         int column, int width) {
    const int count = dip_setting_info(setting)->step_count;
    dip_text_put(&view->screen, row, column - 5, column, dim, "time");
    dip_text_put(&view->screen, row + 1, column - 5, column, dim, "FLIP");
    for (int i = 0; i < count; ++i) {
        const int first = column + i * width, end = first + width;
        const DipCostsStep *step = costs_step(costs, setting, dip_setting_step_at(setting, i));
        if (step) {
            dip_text_put_right(&view->screen, row, first, end - 1, name, step->time);
            dip_text_put_right(&view->screen, row + 1, first, end - 1, error_colours(step),
                               step->flip);
        }
    }
}

// --- blocks on a wide screen -------------------------------------------------------------------

static int block_rows(DipSetting setting, bool has_costs) {
    return is_switch(setting) ? 1 : has_costs ? 5 : 3;
}

// Draws a setting's title, and at its right the values of both panes if they differ.
static void draw_title(DipTextView *view, const DipPreviewState *state, DipSetting setting, int row,
                       int column, int end) {
    const int from = state->quality[DIP_PANE_CURRENT].step[setting];
    const int to = state->quality[DIP_PANE_REQUESTED].step[setting];
    char text[48];
    snprintf(text, sizeof text, "%s → ", step_name(setting, from));
    const int right =
        dip_text_put_right(&view->screen, row, column, end, wanted_text, step_name(setting, to));
    const int left =
        from == to ? right : dip_text_put_right(&view->screen, row, column, right, dim, text);
    dip_text_put(&view->screen, row, column, left - 1,
                 is_focused(view, setting) ? name_focused : title,
                 dip_setting_info(setting)->title);
}

static void draw_block(DipTextView *view, const DipPreviewState *state, DipSetting setting, int row,
                       int column) {
    const int end = column + BLOCK_COLUMNS - 2;
    const DipCostsRow costs = costs_row(state->costs, setting);
    const DipSettingInfo *info = dip_setting_info(setting);
    if (is_switch(setting)) {
        const DipCostsStep *step = costs_step(&costs, setting, 1);
        dip_text_put(&view->screen, row, column, end - 22,
                     is_focused(view, setting) ? name_focused : title, info->title);
        if (step) {
            dip_text_put_right(&view->screen, row, end - 22, end - 17, name, step->time);
            dip_text_put_right(&view->screen, row, end - 17, end - 10, error_colours(step),
                               step->flip);
        }
        draw_steps(view, state, setting, row, end - 10, 5);
        return;
    }
    const int width = dip_min(8, (end - column - 6) / info->step_count);
    draw_title(view, state, setting, row, column, end);
    draw_steps(view, state, setting, row + 1, column + 6, width);
    if (state->costs) {
        draw_figures(view, &costs, setting, row + 2, column + 6, width);
    }
}

static void draw_blocks(DipTextView *view, const DipPreviewState *state, DipTextArea body) {
    for (int c = 0; c < MAX_BLOCK_COLUMNS; ++c) {
        int row = body.row;
        for (int i = 0; i < 5 && block_columns[c][i] >= 0; ++i) {
            const DipSetting setting = (DipSetting)block_columns[c][i];
            const int rows = block_rows(setting, state->costs != NULL);
            if (row + rows <= body.row + body.rows + 1) { // The last row of a block is blank.
                draw_block(view, state, setting, row, body.column + MARGIN + c * BLOCK_COLUMNS);
            }
            row += rows;
        }
    }
}

// Says what the panes cost, and which key copies the requested settings.
static void draw_sum(DipTextView *view, const DipPreviewState *state, DipTextArea body) {
    const int column = body.column + MARGIN + MAX_BLOCK_COLUMNS * BLOCK_COLUMNS;
    const int end = body.column + body.columns;
    const bool same = memcmp(&state->quality[0], &state->quality[1], sizeof(DipQuality)) == 0;
    for (int row = body.row; row < body.row + body.rows; ++row) {
        dip_text_put(&view->screen, row, column - 2, column - 1, dim, "│");
    }
    dip_text_put(&view->screen, body.row, column, end, same ? dim : wanted,
                 same ? "Both panes are the same" : " Enter  Apply ");
    if (state->costs) {
        dip_text_put(&view->screen, body.row + 2, column, end, dim, "Figures: cost report");
        dip_text_put(&view->screen, body.row + 3, column, end, dim, "K  best settings");
    } else {
        dip_text_put(&view->screen, body.row + 2, column, end, dim, "[ ] current");
        dip_text_put(&view->screen, body.row + 3, column, end, wanted, " requested ");
    }
}

// --- rows on a narrow screen -------------------------------------------------------------------

static void draw_row(DipTextView *view, const DipPreviewState *state, DipSetting setting, int row,
                     int column, int columns) {
    const int end = column + columns - 1;
    dip_text_put(&view->screen, row, column, column + NAME_COLUMNS - 1,
                 is_focused(view, setting) ? name_focused : title,
                 dip_setting_info(setting)->title);
    const int count = dip_setting_info(setting)->step_count;
    const int width = dip_min(8, (ROW_COLUMNS - NAME_COLUMNS) / count);
    draw_steps(view, state, setting, row, column + NAME_COLUMNS, dip_max(width, 6));
    if (columns < ROW_COLUMNS + FIGURE_COLUMNS) {
        return;
    }
    const DipCostsRow costs = costs_row(state->costs, setting);
    const DipCostsStep *step =
        costs_step(&costs, setting, state->quality[DIP_PANE_REQUESTED].step[setting]);
    if (step) {
        dip_text_put_right(&view->screen, row, end - FIGURE_COLUMNS, end - 7, name, step->time);
        dip_text_put_right(&view->screen, row, end - 7, end, error_colours(step), step->flip);
    }
}

static bool is_wide(int columns) {
    return columns >= MARGIN + MAX_BLOCK_COLUMNS * BLOCK_COLUMNS + SUM_COLUMNS;
}

static int columns_of_rows(int columns) {
    return dip_max(1, dip_min(2, columns / (ROW_COLUMNS + 2)));
}

int dip_text_settings_rows(int columns, bool has_costs) {
    if (!is_wide(columns)) {
        const int column_count = columns_of_rows(columns);
        return (DIP_SETTING_COUNT + column_count - 1) / column_count;
    }
    int most = 0;
    for (int c = 0; c < MAX_BLOCK_COLUMNS; ++c) {
        int rows = 0;
        for (int i = 0; i < 5 && block_columns[c][i] >= 0; ++i) {
            rows += block_rows((DipSetting)block_columns[c][i], has_costs);
        }
        most = dip_max(most, rows);
    }
    return most;
}

void dip_text_draw_settings(DipTextView *view, const DipPreviewState *state, DipTextArea body) {
    if (is_wide(body.columns)) {
        draw_blocks(view, state, body);
        draw_sum(view, state, body);
        return;
    }
    const int column_count = columns_of_rows(body.columns);
    const int columns = (body.columns - MARGIN) / column_count;
    const int rows = (DIP_SETTING_COUNT + column_count - 1) / column_count;
    // If there are fewer rows than settings, the rows around the focused setting show.
    const int focus_row = view->focused ? (int)view->focus % rows : 0;
    const int first = dip_max(0, dip_min(focus_row - body.rows / 2, rows - body.rows));
    for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
        const int row = s % rows - first;
        if (row >= 0 && row < body.rows) {
            draw_row(view, state, (DipSetting)s, body.row + row,
                     body.column + MARGIN + s / rows * columns, columns);
        }
    }
}
