// Draws the settings in characters: each setting's steps, and what a cost report says about them.
#include "app/preview/cells/text_view.h"

#include <stdio.h>

enum {
    BLOCK_COLUMNS = 44,  // Width of a column of blocks; a block shows one setting.
    SUM_COLUMNS = 26,    // Least width of the notes right of the blocks.
    ROW_COLUMNS = 60,    // Least width of a row that shows one setting.
    NAME_COLUMNS = 23,   // Width of a setting's name in its row.
    BRIEF_COLUMNS = 11,  // Width of a setting's short name in a row that has many steps.
    STEP_COLUMNS = 6,    // Least width of a step in its row.
    FIGURE_COLUMNS = 15, // Width of a step's time and change of FLIP at the end of a row.
    MAX_BLOCK_COLUMNS = 3,
    COLUMN_BLOCKS = 5,  // Blocks in a column.
    MAX_LINE_STEPS = 6, // Most steps of a block on one line.
    MARGIN = 1
};

// Columns of blocks on a wide screen, from left to right. Settings that belong together share a
// column.
static const DipSetting block_columns[MAX_BLOCK_COLUMNS][COLUMN_BLOCKS] = {
    {DIP_SETTING_AA, DIP_SETTING_TAA, DIP_SETTING_AAA, DIP_SETTING_ASD, DIP_SETTING_POST},
    {DIP_SETTING_AF, DIP_SETTING_AAF, DIP_SETTING_OPT, DIP_SETTING_MIPLOD, DIP_SETTING_SHARPEN},
    {DIP_SETTING_SHADOWS, DIP_SETTING_SCALE, DIP_SETTING_UPSCALE, DIP_SETTING_GI,
     DIP_SETTING_MIPDEBUG},
};

static bool is_switch(DipSetting setting) {
    return dip_setting_info(setting)->step_count == 2;
}

// Returns a step's name, short enough for a narrow column.
static const char *step_name(DipSetting setting, int step) {
    return dip_setting_info(setting)->narrow_labels[step];
}

// --- steps -------------------------------------------------------------------------------------

// Draws one step (value) of a setting: filled if the requested pane has this step, in brackets if
// the current pane has it. Lets a click in `area` choose the step.
static void draw_step(DipTextView *view, DipSetting setting, int step, DipTextArea area) {
    const DipQuality *quality = view->state->quality;
    const bool current = quality[DIP_PANE_CURRENT].step[setting] == step;
    const bool requested = quality[DIP_PANE_REQUESTED].step[setting] == step;
    const char *text = step_name(setting, step);
    const int room = area.columns - 2 - dip_text_length(text);
    char framed[32];
    snprintf(framed, sizeof framed, "%s%s%s", current ? "[" : " ", text, current ? "]" : " ");
    dip_text_put(&view->screen, area.row, area.column + dip_max(0, room) / 2,
                 area.column + area.columns,
                 requested ? dip_text_wanted
                 : current ? dip_text_white
                           : dip_text_soft,
                 framed);
    if (view->target_count < DIP_TEXT_MAX_TARGETS) {
        view->targets[view->target_count++] = (DipTextTarget){area, setting, step};
    }
}

// Draws the steps at the positions from `first` to `end` - 1 side by side, each `width` cells wide.
static void draw_steps(DipTextView *view, DipSetting setting, int first, int end, int row,
                       int column, int width) {
    for (int i = first; i < end; ++i) {
        draw_step(view, setting, dip_setting_step_at(setting, i),
                  (DipTextArea){column + (i - first) * width, row, width, 1});
    }
}

// Writes a setting's title, which stands out if the arrow keys act on the setting. Writes the short
// title if there is no room for the whole one.
static void draw_title(DipTextView *view, DipSetting setting, int row, int column, int end) {
    const bool focused = view->focused && view->focus == setting;
    const DipSettingInfo *info = dip_setting_info(setting);
    const bool fits = dip_text_length(info->title) <= end - column;
    dip_text_put(&view->screen, row, column, end, focused ? dip_text_focused : dip_text_white,
                 fits ? info->title : info->short_title);
}

// --- figures of a cost report ------------------------------------------------------------------

// Returns the steps of a setting that the report has. Without a report, there are none.
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

// Writes a step's relative time and its change of FLIP at the right ends of the areas `time` and
// `flip`. Writes nothing if the report does not have the step.
static void draw_figures(DipTextView *view, const DipCostsRow *costs, DipSetting setting, int step,
                         DipTextArea time, DipTextArea flip) {
    const DipCostsStep *found = costs_step(costs, setting, step);
    if (found) {
        dip_text_put_right(&view->screen, time.row, time.column, time.column + time.columns,
                           dip_text_soft, found->time);
        dip_text_put_right(&view->screen, flip.row, flip.column, flip.column + flip.columns,
                           found->flip_change < 0.0   ? dip_text_gain
                           : found->flip_change > 0.0 ? dip_text_worse
                                                      : dip_text_dim,
                           found->flip);
    }
}

// --- blocks on a wide screen -------------------------------------------------------------------

// Returns the number of lines on which a block shows the steps of a setting.
static int step_lines(DipSetting setting) {
    return (dip_setting_info(setting)->step_count + MAX_LINE_STEPS - 1) / MAX_LINE_STEPS;
}

// Returns the number of rows of a block. A setting with two steps takes one row. Any other block
// has the title, each line of steps with its figures, and a blank row at the end.
static int block_rows(DipSetting setting, bool has_costs) {
    return is_switch(setting) ? 1 : 2 + step_lines(setting) * (has_costs ? 3 : 1);
}

// Draws a setting's title, and at the row's right end the requested pane's step (value). If the
// current pane has another step, the current pane's step stands before the requested one.
static void draw_head(DipTextView *view, DipSetting setting, int row, int column, int end) {
    const int from = view->state->quality[DIP_PANE_CURRENT].step[setting];
    const int to = view->state->quality[DIP_PANE_REQUESTED].step[setting];
    char text[48];
    snprintf(text, sizeof text, "%s → ", step_name(setting, from));
    int left = dip_text_put_right(&view->screen, row, column, end, dip_text_accent,
                                  step_name(setting, to));
    if (from != to) {
        left = dip_text_put_right(&view->screen, row, column, left, dip_text_dim, text);
    }
    draw_title(view, setting, row, column, left - 1);
}

// Draws the steps at the positions from `first` to `last` - 1, and below them what a cost report
// says about them.
static void draw_line(DipTextView *view, DipSetting setting, const DipCostsRow *costs, int first,
                      int last, DipTextArea area) {
    const int left = area.column + 6, width = dip_min(8, (area.columns - 6) / (last - first));
    draw_steps(view, setting, first, last, area.row, left, width);
    if (!view->state->costs) {
        return;
    }
    dip_text_put(&view->screen, area.row + 1, area.column + 1, left, dip_text_dim, "time");
    dip_text_put(&view->screen, area.row + 2, area.column + 1, left, dip_text_dim, "FLIP");
    for (int i = first; i < last; ++i) {
        const int column = left + (i - first) * width;
        draw_figures(view, costs, setting, dip_setting_step_at(setting, i),
                     (DipTextArea){column, area.row + 1, width - 1, 1},
                     (DipTextArea){column, area.row + 2, width - 1, 1});
    }
}

static void draw_block(DipTextView *view, DipSetting setting, int row, int column) {
    const int end = column + BLOCK_COLUMNS - 2, count = dip_setting_info(setting)->step_count;
    const DipCostsRow costs = costs_row(view->state->costs, setting);
    if (is_switch(setting)) {
        draw_title(view, setting, row, column, end - 22);
        draw_figures(view, &costs, setting, 1, (DipTextArea){end - 22, row, 5, 1},
                     (DipTextArea){end - 17, row, 7, 1});
        draw_steps(view, setting, 0, count, row, end - 10, 5);
        return;
    }
    draw_head(view, setting, row, column, end);
    const int per_line = (count + step_lines(setting) - 1) / step_lines(setting);
    for (int first = 0, at = row + 1; first < count; first += per_line) {
        draw_line(view, setting, &costs, first, dip_min(count, first + per_line),
                  (DipTextArea){column, at, end - column, 1});
        at += view->state->costs ? 3 : 1;
    }
}

static void draw_blocks(DipTextView *view, DipTextArea body) {
    for (int c = 0; c < MAX_BLOCK_COLUMNS; ++c) {
        int row = body.row;
        for (int i = 0; i < COLUMN_BLOCKS; ++i) {
            const DipSetting setting = block_columns[c][i];
            const int rows = block_rows(setting, view->state->costs != NULL);
            const int blank = is_switch(setting) ? 0 : 1; // The blank row need not fit.
            if (row + rows - blank <= body.row + body.rows) {
                draw_block(view, setting, row, body.column + MARGIN + c * BLOCK_COLUMNS);
            }
            row += rows;
        }
    }
}

// Writes that both panes are the same, or which key gives the current pane the requested settings.
// Below this, names the source of the figures and the key for advice or, without a cost report,
// shows what brackets and filled steps mean.
static void draw_sum(DipTextView *view, DipTextArea body) {
    const DipPreviewState *state = view->state;
    const int column = body.column + MARGIN + MAX_BLOCK_COLUMNS * BLOCK_COLUMNS;
    const int end = body.column + body.columns;
    const bool same = dip_quality_equal(&state->quality[0], &state->quality[1]);
    for (int row = body.row; row < body.row + body.rows; ++row) {
        dip_text_put(&view->screen, row, column - 2, column - 1, dip_text_dim, "│");
    }
    dip_text_put(&view->screen, body.row, column, end, same ? dip_text_dim : dip_text_wanted,
                 same ? "Both panes are the same" : " Enter  Apply ");
    dip_text_put(&view->screen, body.row + 2, column, end, dip_text_dim,
                 state->costs ? "Figures: cost report" : "[ ] current");
    dip_text_put(&view->screen, body.row + 3, column, end,
                 state->costs ? dip_text_dim : dip_text_wanted,
                 state->costs ? "K  best settings" : " requested ");
}

// --- rows on a narrow screen -------------------------------------------------------------------

static void draw_row(DipTextView *view, DipSetting setting, int row, int column, int columns) {
    const int end = column + columns - 1;
    const int count = dip_setting_info(setting)->step_count;
    const bool brief = count * STEP_COLUMNS > ROW_COLUMNS - NAME_COLUMNS;
    const int name = brief ? BRIEF_COLUMNS : NAME_COLUMNS;
    const int width = dip_min(8, (ROW_COLUMNS - name) / count);
    draw_title(view, setting, row, column, column + name - 1);
    draw_steps(view, setting, 0, count, row, column + name, width);
    if (columns >= ROW_COLUMNS + FIGURE_COLUMNS) {
        const DipCostsRow costs = costs_row(view->state->costs, setting);
        draw_figures(view, &costs, setting, view->state->quality[DIP_PANE_REQUESTED].step[setting],
                     (DipTextArea){end - FIGURE_COLUMNS, row, FIGURE_COLUMNS - 7, 1},
                     (DipTextArea){end - 7, row, 7, 1});
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
        for (int i = 0; i < COLUMN_BLOCKS; ++i) {
            rows += block_rows(block_columns[c][i], has_costs);
        }
        most = dip_max(most, rows);
    }
    return most;
}

void dip_text_draw_settings(DipTextView *view, DipTextArea body) {
    if (is_wide(body.columns)) {
        draw_blocks(view, body);
        draw_sum(view, body);
        return;
    }
    const int column_count = columns_of_rows(body.columns);
    const int columns = (body.columns - MARGIN) / column_count;
    const int rows = (DIP_SETTING_COUNT + column_count - 1) / column_count;
    // If not all rows fit, the rows around the focused setting show or, if no setting has the
    // focus, the first rows.
    const int focus_row = view->focused ? (int)view->focus % rows : 0;
    const int first = dip_max(0, dip_min(focus_row - body.rows / 2, rows - body.rows));
    for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
        const int row = s % rows - first;
        if (row >= 0 && row < body.rows) {
            draw_row(view, (DipSetting)s, body.row + row, body.column + MARGIN + s / rows * columns,
                     columns);
        }
    }
}
