// Declares the settings tab. Depending on its room, the tab shows three columns of settings, one
// column at a time, or a list.
#include "app/preview/prices/price_text.h"
#include "app/preview/tabs/tabs.h"
#include "app/report/words.h"
#include "app/ui/layout.h"
#include "app/ui/style.h"

#include <stdio.h>

enum {
    MARGIN = 10,
    COLUMN_GAP = 14,
    COLUMN_WIDTH = 298,
    SUM_WIDTH = 330,
    THREE_COLUMNS_WIDTH = 1180, // Narrowest dock with all columns side by side.
    TWO_COLUMNS_WIDTH = 560,    // Narrowest dock with one column and the sum.
    GROUP_HEIGHT = 24,
    LINE_HEIGHT = 19,
    FOOT_HEIGHT = 30,
    PRESETS_HEIGHT = 61
};

// The settings of each column.
enum { GROUP_EDGES, GROUP_TEXTURES, GROUP_SCENE, GROUP_PRESETS, GROUP_COUNT, COLUMNS = 3 };
static const DipSetting groups[COLUMNS][4] = {
    {DIP_SETTING_AA, DIP_SETTING_TAA, DIP_SETTING_AAA, DIP_SETTING_ASD},
    {DIP_SETTING_AF, DIP_SETTING_AAF, DIP_SETTING_OPT, DIP_SETTING_SCALE},
    {DIP_SETTING_MIPLOD, DIP_SETTING_GI, DIP_SETTING_MIPDEBUG}};
static const int group_sizes[COLUMNS] = {4, 4, 3};

// Declares the settings of a column, one below the other. Returns the room below them.
static DipRect declare_group(DipUi *ui, DipWindow *window, int group, DipRect column) {
    for (int i = 0; i < group_sizes[group]; ++i) {
        dip_cut_top(&column, dip_setting_row_declare(ui, window, groups[group][i], column));
    }
    return column;
}

// Returns the part of the tab within its margins.
static DipRect inside_of(const DipUi *ui, DipRect body) {
    const int margin = dip_ui_px(ui, MARGIN);
    return (DipRect){body.x + margin, body.y + dip_ui_px(ui, 5), body.width - 2 * margin,
                     body.height - dip_ui_px(ui, 8)};
}

// --- all columns ---------------------------------------------------------------------------------

// Declares all columns and the sum of prices. If the tab is wider than these need, the rest shows
// the graph of frame times.
static void declare_columns(DipUi *ui, DipWindow *window, DipRect body) {
    const int gap = dip_ui_px(ui, COLUMN_GAP), widest_sum = dip_ui_px(ui, 420);
    DipRect rest = inside_of(ui, body);
    const int room = rest.width - 3 * gap - dip_ui_px(ui, SUM_WIDTH);
    const int width = dip_min(dip_ui_px(ui, COLUMN_WIDTH), room / COLUMNS);
    for (int c = 0; c < COLUMNS; ++c) {
        DipRect free = declare_group(ui, window, c, dip_cut_left(&rest, width));
        if (c == GROUP_SCENE) {
            const int height = dip_min(dip_ui_px(ui, PRESETS_HEIGHT), free.height);
            dip_cut_bottom(&free, dip_ui_px(ui, 3));
            dip_presets_declare(ui, window, dip_cut_bottom(&free, height), 3);
        }
        dip_cut_left(&rest, gap);
    }
    DipRect sum = rest;
    const bool has_graph = rest.width - widest_sum >= dip_ui_px(ui, 240);
    if (has_graph) {
        sum = dip_cut_left(&rest, widest_sum);
        dip_cut_right(&sum, gap);
    }
    dip_setting_sum_declare(ui, window, sum);
    if (has_graph) {
        dip_times_graph_draw(ui, window, rest);
    }
}

// --- one column at a time ------------------------------------------------------------------------

static void declare_group_buttons(DipUi *ui, DipWindow *window, DipRect rect) {
    static const char *const names[GROUP_COUNT] = {"Edges", "Textures", "Scene", "Presets"};
    int *chosen = &window->state->settings_group;
    for (int g = 0; g < GROUP_COUNT; ++g) {
        if (dip_ui_button(ui, DIP_UI_ID(DIP_UI_SETTINGS, DIP_ID_GROUPS + g),
                          dip_rect_cell(rect, GROUP_COUNT, rect.height, dip_ui_px(ui, 4), 0, g),
                          names[g], *chosen == g ? DIP_UI_CHOSEN : DIP_UI_PLAIN, NULL)) {
            *chosen = g;
        }
    }
}

static void declare_one_column(DipUi *ui, DipWindow *window, DipRect body) {
    const DipRect inside = inside_of(ui, body);
    const int gap = dip_ui_px(ui, COLUMN_GAP);
    const DipRect left = dip_rect_cell(inside, 2, inside.height, gap, 0, 0);
    DipRect right = dip_rect_cell(inside, 2, inside.height, gap, 0, 1);
    declare_group_buttons(ui, window, dip_cut_top(&right, dip_ui_px(ui, GROUP_HEIGHT)));
    if (window->state->settings_group == GROUP_PRESETS) {
        dip_presets_declare(ui, window, left, 2);
    } else {
        declare_group(ui, window, window->state->settings_group, left);
    }
    dip_cut_top(&right, dip_ui_px(ui, 6));
    dip_setting_sum_declare(ui, window, right);
}

// --- the drawer ----------------------------------------------------------------------------------

// Declares the foot of the drawer (tools/layout.h): the sum of prices, the button Apply, and a
// button that exchanges the list of settings for presets, Undo and Copy. more: the presets show
// now.
static void declare_foot(DipUi *ui, DipWindow *window, DipRect foot, bool more) {
    const int pad = dip_ui_px(ui, 4);
    const double budget_ms = window->state->budget_ms;
    const DipPriceSum sum = dip_pane_sum(window, DIP_PANE_REQUESTED);
    const DipPriceTrust trust = dip_price_sum_trust(&sum);
    const bool over = sum.ms > budget_ms && trust != DIP_PRICE_TRUST_DOUBTFUL;
    char text[DIP_STEP_NAME_BYTES], of[DIP_NUMBER_BYTES + 8], budget[DIP_NUMBER_BYTES];
    DipRect rest = dip_rect_inset(foot, pad, pad);
    const DipRect apply = dip_cut_right(&rest, dip_ui_px(ui, 52));
    dip_cut_right(&rest, pad);
    const DipRect other = dip_cut_right(&rest, dip_ui_px(ui, 30));
    rest.y = foot.y;
    rest.height = foot.height;
    dip_ms_text(sum.ms, trust, text);
    dip_ui_word(ui, 13, over ? dip_style_worse : dip_style_accent, &rest, pad, text);
    dip_budget_ms_text(budget_ms, budget);
    snprintf(of, sizeof of, "of %s ms", budget);
    if (dip_ui_text_width(ui, 11, of) <= rest.width - pad) {
        dip_ui_label(ui, 11, dip_style_soft, DIP_ALIGN_LEFT, rest, of);
    }
    if (dip_ui_button(ui, DIP_UI_ID(DIP_UI_SETTINGS, DIP_ID_MORE), other, "\u2026",
                      more ? DIP_UI_CHOSEN : DIP_UI_PLAIN,
                      "Presets, Undo and Copy, or back to the settings.")) {
        window->state->settings_group = more ? GROUP_EDGES : GROUP_PRESETS;
    }
    dip_apply_declare(ui, window, apply);
}

static void declare_more(DipUi *ui, DipWindow *window, DipRect room) {
    const int pad = dip_ui_px(ui, 6);
    DipRect rest = dip_rect_inset(room, pad, pad);
    const DipRect target = dip_cut_top(&rest, dip_ui_px(ui, 20));
    const DipRect buttons = dip_cut_bottom(&rest, dip_ui_px(ui, 24));
    dip_target_declare(ui, window, target);
    dip_presets_declare(ui, window, dip_rect_inset(rest, 0, pad), 2);
    dip_setting_buttons_declare(ui, window, buttons);
}

static void declare_drawer(DipUi *ui, DipWindow *window, DipRect body) {
    const bool more = window->state->settings_group == GROUP_PRESETS;
    const DipRect foot =
        dip_cut_bottom(&body, dip_min(dip_ui_px(ui, FOOT_HEIGHT), body.height / 6));
    const int fitting = body.height / DIP_SETTING_COUNT;
    const int line = dip_max(1, dip_min(dip_ui_px(ui, LINE_HEIGHT), fitting));
    if (more) {
        declare_more(ui, window, body);
    }
    for (int s = 0; s < DIP_SETTING_COUNT && !more; ++s) {
        dip_setting_line_declare(ui, window, (DipSetting)s, dip_cut_top(&body, line));
    }
    declare_foot(ui, window, foot, more);
}

void dip_tab_settings(DipUi *ui, DipWindow *window, DipRect body) {
    const bool low = body.height < dip_ui_px(ui, 200);
    if (!low && body.width >= dip_ui_px(ui, THREE_COLUMNS_WIDTH)) {
        declare_columns(ui, window, body);
    } else if (!low && body.width >= dip_ui_px(ui, TWO_COLUMNS_WIDTH)) {
        declare_one_column(ui, window, body);
    } else {
        declare_drawer(ui, window, body);
    }
}
