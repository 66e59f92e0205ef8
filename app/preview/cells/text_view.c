// Lays out the screen of characters, draws its labels, bar and row of keys, and handles events.
#include "app/preview/cells/text_view.h"

#include <stdio.h>

enum {
    // If the settings, times or costs that the user has opened would leave the panes fewer rows
    // than this, they get at most half of the rows.
    MIN_PANE_ROWS = 8,
    // Settings that the user has not opened show only if they leave the panes at least this many
    // rows.
    ROOMY_PANE_ROWS = 14,
    LEAST_ROWS = 6 // A screen with fewer rows shows the panes and their labels only.
};

static const DipTextColours bar = {{196, 202, 210, 255}, {32, 36, 43, 255}};
static const DipTextColours bar_title = {{255, 255, 255, 255}, {32, 36, 43, 255}};
static const DipTextColours bar_accent = {{255, 190, 92, 255}, {32, 36, 43, 255}};

// --- layout ------------------------------------------------------------------------------------

// Returns the number of rows for settings, times or costs on a screen whose panes would otherwise
// have pane_rows rows.
static int body_rows(const DipTextView *view, const DipPreviewState *state, int columns,
                     int pane_rows) {
    const bool times = dip_preview_shows_times(state);
    const bool asked = view->focused || times || state->show_costs;
    const int wanted = times || state->show_costs
                           ? pane_rows / 2
                           : dip_text_settings_rows(columns, state->costs != NULL);
    const int least_pane_rows = asked ? MIN_PANE_ROWS : ROOMY_PANE_ROWS;
    if (wanted + least_pane_rows <= pane_rows) {
        return wanted;
    }
    return asked && pane_rows / 2 > 1 ? dip_min(wanted, pane_rows / 2) : 0;
}

// Lays out the screen for a picture of the given size in pixels.
static DipTextLayout layout_of(const DipTextView *view, const DipPreviewState *state, int width,
                               int height) {
    DipTextLayout layout = {.columns = width, .rows = height / 2, .bar_row = -1, .keys_row = -1};
    const int label_rows = layout.rows > 1 ? 1 : 0;
    int pane_rows = layout.rows - label_rows;
    if (layout.rows >= LEAST_ROWS) {
        pane_rows -= 2;
        layout.keys_row = layout.rows - 1;
        layout.body.columns = width;
        layout.body.rows = body_rows(view, state, width, pane_rows);
        layout.body.row = layout.keys_row - layout.body.rows;
        layout.bar_row = layout.body.row - 1;
        pane_rows -= layout.body.rows;
    }
    const int pane_columns = width > 2 ? (width - 1) / 2 : 1;
    layout.panes[DIP_PANE_CURRENT] =
        (DipTextArea){0, label_rows, pane_columns, dip_max(1, pane_rows)};
    layout.panes[DIP_PANE_REQUESTED] = layout.panes[DIP_PANE_CURRENT];
    layout.panes[DIP_PANE_REQUESTED].column = dip_max(0, width - pane_columns);
    return layout;
}

void dip_text_view_panes(const DipTextView *view, const DipPreviewState *state, int width,
                         int height, DipRect panes[DIP_PANE_COUNT]) {
    const DipTextLayout layout = layout_of(view, state, width, height);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        const DipTextArea area = layout.panes[p];
        panes[p] = (DipRect){area.column, 2 * area.row, area.columns, 2 * area.rows};
    }
}

// --- labels, bar and keys ----------------------------------------------------------------------

// Writes a pane's name, its frame time (or that its picture is copied) and its settings.
static void draw_label(DipTextView *view, const DipPreviewState *state, int pane, DipTextArea area,
                       const DipPaneFigures *figures) {
    const int end = area.column + area.columns;
    char text[256];
    int column =
        dip_text_put(&view->screen, 0, area.column + 1, end,
                     state->edited[pane] ? dip_text_accent : dip_text_white, dip_pane_titles[pane]);
    if (figures->copied) {
        snprintf(text, sizeof text, "  copied");
    } else if (figures->fps > 0 && area.columns >= 60) {
        snprintf(text, sizeof text, "  %4.1f ms  %d fps", figures->ms, figures->fps);
    } else {
        snprintf(text, sizeof text, "  %s%4.1f ms", figures->frames == 1 ? "one frame: " : "",
                 figures->ms);
    }
    column = dip_text_put(&view->screen, 0, column, end, dip_text_white, text);
    const int room = end - column - 2;
    dip_preview_describe(&state->quality[pane], false, text, sizeof text);
    if (dip_text_length(text) > room) {
        dip_preview_describe(&state->quality[pane], true, text, sizeof text);
    }
    if (room > 4) {
        dip_text_put(&view->screen, 0, column + 2, end, dip_text_soft, text);
    }
}

static void draw_labels(DipTextView *view, const DipPreviewState *state,
                        const DipTextLayout *layout, const DipPaneFigures figures[DIP_PANE_COUNT]) {
    if (layout->panes[0].row == 0) {
        return;
    }
    dip_text_screen_fill(&view->screen, (DipTextArea){0, 0, layout->columns, 1},
                         dip_text_white.paper);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        draw_label(view, state, p, layout->panes[p], &figures[p]);
    }
}

// Draws a line between the panes.
static void draw_divider(DipTextView *view, const DipTextLayout *layout) {
    const DipTextArea left = layout->panes[DIP_PANE_CURRENT];
    const DipTextArea right = layout->panes[DIP_PANE_REQUESTED];
    const int first = left.column + left.columns;
    const DipTextArea gap = {first, left.row, right.column - first, left.rows};
    dip_text_screen_fill(&view->screen, gap, dip_text_accent.paper);
    for (int row = gap.row; gap.columns > 0 && row < gap.row + gap.rows; ++row) {
        dip_text_put(&view->screen, row, right.column - 1, right.column, dip_text_accent, "│");
    }
}

static void format_place(const DipPreviewState *state, char *text, size_t size_bytes) {
    const double play_s = 1e-9 * (double)state->play_ns;
    const char *mark = state->paused ? "   paused" : "";
    if (state->manual) {
        snprintf(text, size_bytes, "Free camera ");
    } else if (state->scene_title) {
        snprintf(text, size_bytes, "%s: %s  %.1f s%s ", state->scene_title, state->scene_look,
                 play_s, mark);
    } else {
        snprintf(text, size_bytes, "Path: %s  %.1f s%s ",
                 dip_preview_path_title(state, state->track->active),
                 1e-9 * (double)dip_camtrack_time(state->track, state->play_ns), mark);
    }
}

// Writes on the left what the body and the help can show, with the keys. Writes on the right the
// path or the scene with its time, or that the camera is free.
static void draw_bar(DipTextView *view, const DipPreviewState *state, int row) {
    const int columns = view->screen.columns;
    const bool times = dip_preview_shows_times(state);
    const bool settings = !times && !state->show_costs;
    char place[128];
    int column = 1;
    dip_text_screen_fill(&view->screen, (DipTextArea){0, row, columns, 1}, bar.paper);
    format_place(state, place, sizeof place);
    const int end =
        dip_text_put_right(&view->screen, row, dip_min(columns / 3, 30), columns, bar, place) - 1;
    const struct {
        const char *text;
        DipTextColours colours;
    } names[] = {
        {"↓ Settings", settings ? bar_title : bar},
        {"   R Times", times ? bar_accent : bar},
        {"   U Costs", state->show_costs ? bar_accent : bar},
        {"   F1 Keys", state->help ? bar_accent : bar},
    };
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
        if (column + dip_text_length(names[i].text) < end) {
            column = dip_text_put(&view->screen, row, column, end, names[i].colours, names[i].text);
        }
    }
}

// Writes a list of the most useful keys or, while there is a notice, the notice.
static void draw_keys(DipTextView *view, const DipPreviewState *state, int row) {
    static const char *const keys[] = {
        "↑ ↓ setting   ← → step   Enter apply   Space pause   F1 keys   Esc quit",
        "   X AA   F AF   V adaptive   O textures   L mip detail   . step"};
    const int columns = view->screen.columns;
    dip_text_screen_fill(&view->screen, (DipTextArea){0, row, columns, 1}, dip_text_white.paper);
    if (state->notice[0]) {
        dip_text_put(&view->screen, row, 1, columns, dip_text_accent, state->notice);
        return;
    }
    const int column = dip_text_put(&view->screen, row, 1, columns, dip_text_soft, keys[0]);
    if (column + dip_text_length(keys[1]) <= columns) {
        dip_text_put(&view->screen, row, column, columns, dip_text_soft, keys[1]);
    }
}

bool dip_text_view_draw(DipTextView *view, const DipPreviewState *state, int width, int height,
                        const DipPaneFigures figures[DIP_PANE_COUNT], DipError *err) {
    const DipTextLayout layout = layout_of(view, state, width, height);
    if (!dip_text_screen_begin(&view->screen, layout.columns, layout.rows, err)) {
        return false;
    }
    view->target_count = 0;
    view->state = state;
    draw_labels(view, state, &layout, figures);
    draw_divider(view, &layout);
    if (layout.bar_row >= 0) {
        draw_bar(view, state, layout.bar_row);
        draw_keys(view, state, layout.keys_row);
    }
    if (layout.body.rows > 0) {
        dip_text_screen_fill(&view->screen, layout.body, dip_text_white.paper);
        if (state->show_costs) {
            dip_text_draw_costs(&view->screen, layout.body, state);
        } else if (dip_preview_shows_times(state)) {
            dip_text_draw_times(&view->screen, layout.body, &layout, figures);
        } else {
            dip_text_draw_settings(view, layout.body);
        }
    }
    if (state->help) {
        const int first = layout.panes[0].row;
        const int last = layout.keys_row >= 0 ? layout.keys_row : layout.rows;
        dip_text_draw_help(&view->screen, (DipTextArea){0, first, layout.columns, last - first});
    }
    return true;
}

// --- events ------------------------------------------------------------------------------------

// Gives the focused setting its next step (`by` is 1) or the step before (-1), in the order of
// dip_setting_step_at.
static void move_step(const DipTextView *view, DipPreviewState *state, int by, int64_t now_ns) {
    const int now = state->quality[dip_preview_edited_pane(state)].step[view->focus];
    const int at = dip_setting_step_at(view->focus, now) + by;
    if (at >= 0 && at < dip_setting_info(view->focus)->step_count) {
        dip_preview_set_step(state, view->focus, dip_setting_step_at(view->focus, at), now_ns);
    }
}

static void move_focus(DipTextView *view, int by) {
    if (!view->focused) {
        view->focused = true;
        return;
    }
    view->focus = (DipSetting)(((int)view->focus + by + DIP_SETTING_COUNT) % DIP_SETTING_COUNT);
}

static bool press_key(DipTextView *view, DipPreviewState *state, const DipEvent *event,
                      int64_t now_ns) {
    const bool settings_show =
        !state->help && !dip_preview_shows_times(state) && !state->show_costs;
    if (!settings_show || (event->modifiers & DIP_MODIFIER_COMMAND)) {
        return false;
    }
    switch (event->key) {
    case DIP_KEYCODE_UP:
    case DIP_KEYCODE_DOWN:
        move_focus(view, event->key == DIP_KEYCODE_UP ? -1 : 1);
        return true;
    case DIP_KEYCODE_LEFT:
    case DIP_KEYCODE_RIGHT:
        if (view->focused) {
            move_step(view, state, event->key == DIP_KEYCODE_LEFT ? -1 : 1, now_ns);
        }
        return view->focused;
    case DIP_KEYCODE_ESCAPE: {
        const bool was_focused = view->focused;
        view->focused = false;
        return was_focused;
    }
    default:
        return false;
    }
}

static bool click(const DipTextView *view, DipPreviewState *state, const DipEvent *event,
                  int64_t now_ns) {
    for (int i = 0; i < view->target_count; ++i) {
        const DipTextTarget *target = &view->targets[i];
        const int row = event->y / 2 - target->area.row;
        const int column = event->x - target->area.column;
        if (row >= 0 && row < target->area.rows && column >= 0 && column < target->area.columns) {
            dip_preview_set_step(state, target->setting, target->step, now_ns);
            return true;
        }
    }
    return false;
}

bool dip_text_view_event(DipTextView *view, DipPreviewState *state, const DipEvent *event,
                         int64_t now_ns) {
    if (event->kind == DIP_EVENT_KEY_DOWN) {
        return press_key(view, state, event, now_ns);
    }
    return event->kind == DIP_EVENT_MOUSE_DOWN && event->button == DIP_MOUSE_LEFT && !state->help &&
           click(view, state, event, now_ns);
}
