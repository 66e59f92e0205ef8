// Declares the settings tab: a list of all settings, an editor for the open one, and the sum of the
// requested settings' prices (app/report/prices/prices.h). In a narrow or low tab, the list has one
// line for each setting, and the presets can take the place of the list.
#include "app/preview/prices/price_text.h"
#include "app/preview/tabs/tabs.h"
#include "app/report/words.h"
#include "app/ui/layout.h"
#include "app/ui/style.h"

#include <stdio.h>

enum {
    MARGIN = 10,
    GAP = 12,
    LIST_WIDTH = 580,
    GROUP_WIDTH = 94,
    EDITOR_WIDTH = 376,
    SUM_WIDTH = 282,
    WIDE = 1180, // Least width of a dock that shows the list, the editor and the sum of prices side
                 // by side.
    MEDIUM = 560, // Least width of a dock that shows the list and, to its right, the editor above
                  // the sum.
    ENTRY_HEIGHT = 21,
    LINE_HEIGHT = 19,
    FOOT_HEIGHT = 30,
    PRESETS_HEIGHT = 24,
    EDITOR_HEIGHT = 78 // Height of an editor that stands above the sum.
};

// The settings in the order in which a wide or medium tab shows them, and the names of their
// groups. A narrow or low tab has the order of DIP_SETTING_LIST instead. An entry whose group is ""
// belongs to the group above it. A column ends at an entry whose group is NULL, or after ENTRIES
// entries.
enum { COLUMNS = 2, ENTRIES = 8 };
static const struct {
    const char *group;
    DipSetting setting;
} entries[COLUMNS][ENTRIES] = {{{"Edges", DIP_SETTING_AA},
                                {"Transparency", DIP_SETTING_AAA},
                                {"", DIP_SETTING_ASD},
                                {"Textures", DIP_SETTING_AF},
                                {"", DIP_SETTING_AAF},
                                {"", DIP_SETTING_OPT},
                                {"", DIP_SETTING_MIPLOD}},
                               {{"Light", DIP_SETTING_SHADOWS},
                                {"Size", DIP_SETTING_SCALE},
                                {"", DIP_SETTING_UPSCALE},
                                {"After the frame", DIP_SETTING_POST},
                                {"", DIP_SETTING_SHARPEN},
                                {"Motion", DIP_SETTING_TAA},
                                {"Other", DIP_SETTING_GI},
                                {"", DIP_SETTING_MIPDEBUG}}};

// Returns the part of the tab within its margins.
static DipRect inside_of(const DipUi *ui, DipRect body) {
    const int margin = dip_ui_px(ui, MARGIN);
    return (DipRect){body.x + margin, body.y + dip_ui_px(ui, 6), body.width - 2 * margin,
                     body.height - dip_ui_px(ui, 10)};
}

// Declares the presets and below them the list of settings, in two columns. group_width: room for
// the names of the groups, in pixels; 0 leaves the names out.
static void declare_list(DipUi *ui, DipWindow *window, DipRect room, int group_width,
                         int preset_columns) {
    const int gap = dip_ui_px(ui, GAP);
    const int preset_rows = (DIP_PRESET_COUNT + preset_columns - 1) / preset_columns;
    const DipRect presets = dip_cut_top(&room, preset_rows * dip_ui_px(ui, PRESETS_HEIGHT));
    dip_presets_declare(ui, window, presets, preset_columns);
    dip_cut_top(&room, dip_ui_px(ui, 8));
    const int height = dip_max(1, dip_min(dip_ui_px(ui, ENTRY_HEIGHT), room.height / ENTRIES));
    const int width = (room.width - gap) / COLUMNS;
    for (int c = 0; c < COLUMNS; ++c) {
        DipRect column = dip_cut_left(&room, width);
        dip_cut_left(&room, gap);
        for (int i = 0; i < ENTRIES && entries[c][i].group; ++i) {
            DipRect entry = dip_cut_top(&column, height);
            const DipRect word = dip_cut_left(&entry, group_width);
            dip_ui_label(ui, 11, dip_style_dim, DIP_ALIGN_LEFT, word,
                         group_width ? entries[c][i].group : "");
            dip_setting_entry_declare(ui, window, entries[c][i].setting, entry);
        }
    }
}

// --- a wide tab ----------------------------------------------------------------------------------

// Declares the list, the editor and the sum of prices side by side. If the tab is much wider than
// these need, the rest shows the graph of frame times.
static void declare_wide(DipUi *ui, DipWindow *window, DipRect body) {
    const int gap = dip_ui_px(ui, GAP), widest_sum = dip_ui_px(ui, 420);
    DipRect rest = inside_of(ui, body);
    declare_list(ui, window, dip_cut_left(&rest, dip_ui_px(ui, LIST_WIDTH)),
                 dip_ui_px(ui, GROUP_WIDTH), DIP_PRESET_COUNT);
    dip_cut_left(&rest, gap);
    const int editor =
        dip_min(dip_ui_px(ui, EDITOR_WIDTH), rest.width - gap - dip_ui_px(ui, SUM_WIDTH - 60));
    dip_setting_editor_declare(ui, window, dip_cut_left(&rest, editor));
    dip_cut_left(&rest, gap);
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

// --- a medium tab --------------------------------------------------------------------------------

static void declare_medium(DipUi *ui, DipWindow *window, DipRect body) {
    const int gap = dip_ui_px(ui, GAP);
    DipRect rest = inside_of(ui, body);
    declare_list(ui, window, dip_cut_left(&rest, rest.width / 2), 0, 3);
    dip_cut_left(&rest, gap);
    dip_setting_editor_declare(ui, window, dip_cut_top(&rest, dip_ui_px(ui, EDITOR_HEIGHT)));
    dip_cut_top(&rest, dip_ui_px(ui, 4));
    dip_setting_sum_declare(ui, window, rest);
}

// --- a narrow or low tab -------------------------------------------------------------------------

// Declares the foot of a narrow or low tab: the time that is compared with the target, with the
// name of its kind unless it is the mean, the button Apply, and a button that exchanges the list of
// settings for presets, Undo and Copy. more: the presets, Undo and Copy show now.
static void declare_foot(DipUi *ui, DipWindow *window, DipRect foot, bool more) {
    const int pad = dip_ui_px(ui, 4);
    const double budget_ms = window->state->budget_ms;
    const DipPriceSum sum = dip_pane_sum(window, DIP_PANE_REQUESTED);
    const DipPriceTrust trust = dip_price_sum_trust(&sum);
    const bool is_mean = sum.judged_by == DIP_TIME_MEAN;
    const char *kind = dip_time_kind_names[sum.judged_by];
    char text[DIP_STEP_NAME_BYTES], of[DIP_NUMBER_BYTES + 16], budget[DIP_NUMBER_BYTES];
    DipRect rest = dip_rect_inset(foot, pad, pad);
    const DipRect apply = dip_cut_right(&rest, dip_ui_px(ui, 52));
    dip_cut_right(&rest, pad);
    const DipRect other = dip_cut_right(&rest, dip_ui_px(ui, 30));
    rest.y = foot.y;
    rest.height = foot.height;
    dip_ms_text(sum.judged_ms, trust, budget_ms, text);
    dip_ui_word(ui, 13, dip_pane_is_over(window, &sum) ? dip_style_worse : dip_style_accent, &rest,
                pad, text);
    dip_budget_ms_text(budget_ms, budget);
    snprintf(of, sizeof of, "%s%sof %s ms", is_mean ? "" : kind, is_mean ? "" : " ", budget);
    if (dip_ui_text_width(ui, 11, of) <= rest.width - pad) {
        dip_ui_label(ui, 11, dip_style_soft, DIP_ALIGN_LEFT, rest, of);
    } else if (!is_mean) {
        dip_ui_label(ui, 11, dip_style_soft, DIP_ALIGN_LEFT, rest, kind);
    }
    if (dip_ui_button(ui, DIP_UI_ID(DIP_UI_SETTINGS, DIP_ID_MORE), other, "\u2026",
                      more ? DIP_UI_CHOSEN : DIP_UI_PLAIN,
                      "Presets, Undo and Copy, or back to the settings.")) {
        window->state->shows_presets = !more;
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
    const bool more = window->state->shows_presets;
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
    const bool low = body.height < dip_ui_px(ui, 180);
    if (!low && body.width >= dip_ui_px(ui, WIDE)) {
        declare_wide(ui, window, body);
    } else if (!low && body.width >= dip_ui_px(ui, MEDIUM)) {
        declare_medium(ui, window, body);
    } else {
        declare_drawer(ui, window, body);
    }
}
