// The tab of the settings, laid out by the room that it has: three columns of settings, one column
// at a time, or a list.
#include "app/preview/prices/price_text.h"
#include "app/preview/tabs/tabs.h"
#include "app/ui/style.h"
#include "app/report/words.h"

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
    {DIP_SETTING_AF, DIP_SETTING_AAF, DIP_SETTING_OPT},
    {DIP_SETTING_MIPLOD, DIP_SETTING_GI, DIP_SETTING_MIPDEBUG}};
static const int group_sizes[COLUMNS] = {4, 3, 3};

// Declares the settings of a column, one below the other. Returns their height.
static int declare_group(DipUi *ui, DipWindow *window, int group, DipRect column) {
    int y = column.y;
    for (int i = 0; i < group_sizes[group]; ++i) {
        y += dip_setting_row_declare(ui, window, groups[group][i],
                                     (DipRect){column.x, y, column.width, 0});
    }
    return y - column.y;
}

// --- all columns ---------------------------------------------------------------------------------

// Declares all columns and the sum. What is wider than they need goes to the graph of frame times.
static void declare_columns(DipUi *ui, DipWindow *window, DipRect body) {
    const int margin = dip_ui_px(ui, MARGIN), gap = dip_ui_px(ui, COLUMN_GAP);
    const int least_sum = dip_ui_px(ui, SUM_WIDTH);
    const int room = body.width - 2 * margin - 3 * gap - least_sum;
    const int width = dip_min(dip_ui_px(ui, COLUMN_WIDTH), room / COLUMNS);
    const DipRect top = {body.x + margin, body.y + dip_ui_px(ui, 5), width,
                         body.height - dip_ui_px(ui, 8)};
    for (int c = 0; c < COLUMNS; ++c) {
        DipRect column = top;
        column.x += c * (width + gap);
        const int used = declare_group(ui, window, c, column);
        if (c == GROUP_SCENE) {
            const int height = dip_min(dip_ui_px(ui, PRESETS_HEIGHT), top.height - used);
            dip_presets_declare(ui, window,
                                (DipRect){column.x,
                                          column.y + top.height - height - dip_ui_px(ui, 3), width,
                                          height},
                                3);
        }
    }
    const int sum_x = top.x + COLUMNS * (width + gap);
    const int left = body.x + body.width - margin - sum_x;
    const int graph = left - dip_ui_px(ui, 420);
    const bool has_graph = graph >= dip_ui_px(ui, 240);
    const int sum_width = has_graph ? dip_ui_px(ui, 420) - gap : left;
    dip_setting_sum_declare(ui, window, (DipRect){sum_x, top.y, sum_width, top.height});
    if (has_graph) {
        dip_times_graph_draw(ui, window,
                             (DipRect){sum_x + sum_width + gap, top.y, graph, top.height});
    }
}

// --- one column at a time ------------------------------------------------------------------------

static void declare_group_buttons(DipUi *ui, DipWindow *window, DipRect rect) {
    static const char *const names[GROUP_COUNT] = {"Edges", "Textures", "Scene", "Presets"};
    const int gap = dip_ui_px(ui, 4);
    const int width = (rect.width - (GROUP_COUNT - 1) * gap) / GROUP_COUNT;
    for (int g = 0; g < GROUP_COUNT; ++g) {
        const DipRect button = {rect.x + g * (width + gap), rect.y, width, rect.height};
        if (dip_ui_button(ui, DIP_UI_ID(DIP_UI_SETTINGS, DIP_ID_GROUPS + g), button, names[g],
                          window->state->settings_group == g ? DIP_UI_CHOSEN : DIP_UI_PLAIN,
                          NULL)) {
            window->state->settings_group = g;
        }
    }
}

static void declare_one_column(DipUi *ui, DipWindow *window, DipRect body) {
    const int margin = dip_ui_px(ui, MARGIN), gap = dip_ui_px(ui, COLUMN_GAP);
    const int width = (body.width - 2 * margin - gap) / 2;
    const int y = body.y + dip_ui_px(ui, 5), height = body.height - dip_ui_px(ui, 8);
    const DipRect left = {body.x + margin, y, width, height};
    const DipRect right = {left.x + width + gap, y, width, height};
    const int buttons = dip_ui_px(ui, GROUP_HEIGHT);
    declare_group_buttons(ui, window, (DipRect){right.x, y, width, buttons});
    if (window->state->settings_group == GROUP_PRESETS) {
        dip_presets_declare(ui, window, (DipRect){left.x, y, width, height}, 2);
    } else {
        declare_group(ui, window, window->state->settings_group, left);
    }
    const int used = buttons + dip_ui_px(ui, 6);
    dip_setting_sum_declare(ui, window, (DipRect){right.x, y + used, width, height - used});
}

// --- the drawer ----------------------------------------------------------------------------------

// Declares the foot of the drawer: the sum, Apply, and the way to presets and Undo.
static void declare_foot(DipUi *ui, DipWindow *window, DipRect foot, bool more) {
    const int pad = dip_ui_px(ui, 4), height = foot.height - 2 * pad;
    const int apply_width = dip_ui_px(ui, 52), more_width = dip_ui_px(ui, 30);
    const int apply_x = foot.x + foot.width - pad - apply_width;
    const int more_x = apply_x - pad - more_width;
    const int pane = DIP_PANE_REQUESTED;
    const DipPriceSum sum = dip_pane_sum(window, pane);
    const DipPriceTrust trust = dip_price_sum_trust(&sum);
    const bool over = sum.ms > window->state->budget_ms && trust != DIP_PRICE_TRUST_DOUBTFUL;
    char text[DIP_STEP_NAME_BYTES];
    dip_ms_text(sum.ms, trust, text);
    dip_ui_text(ui, 13, over ? dip_style_worse : dip_style_accent, DIP_ALIGN_LEFT, foot.x + pad,
                foot.y + (foot.height - dip_ui_line_height(ui, 13)) / 2, more_x - foot.x, text);
    const int x = foot.x + 2 * pad + dip_ui_text_width(ui, 13, text);
    char of[DIP_NUMBER_BYTES + 8], budget[DIP_NUMBER_BYTES];
    dip_budget_ms_text(window->state->budget_ms, budget);
    snprintf(of, sizeof of, "of %s ms", budget);
    if (dip_ui_text_width(ui, 11, of) <= more_x - pad - x) {
        dip_ui_text(ui, 11, dip_style_soft, DIP_ALIGN_LEFT, x,
                    foot.y + (foot.height - dip_ui_line_height(ui, 11)) / 2, more_x - x, of);
    }
    if (dip_ui_button(ui, DIP_UI_ID(DIP_UI_SETTINGS, DIP_ID_MORE),
                      (DipRect){more_x, foot.y + pad, more_width, height}, "\u2026",
                      more ? DIP_UI_CHOSEN : DIP_UI_PLAIN,
                      "Presets, Undo and Copy, or back to the settings.")) {
        window->state->settings_group = more ? GROUP_EDGES : GROUP_PRESETS;
    }
    dip_apply_declare(ui, window, (DipRect){apply_x, foot.y + pad, apply_width, height});
}

static void declare_more(DipUi *ui, DipWindow *window, DipRect room) {
    const int pad = dip_ui_px(ui, 6), height = dip_ui_px(ui, 24);
    const int target = dip_ui_px(ui, 20);
    const DipRect presets = {room.x + pad, room.y + target + 2 * pad, room.width - 2 * pad,
                             room.height - height - target - 4 * pad};
    dip_target_declare(ui, window, (DipRect){presets.x, room.y + pad, presets.width, target});
    dip_presets_declare(ui, window, presets, 2);
    dip_setting_buttons_declare(
        ui, window,
        (DipRect){presets.x, room.y + room.height - height - pad, presets.width, height});
}

static void declare_drawer(DipUi *ui, DipWindow *window, DipRect body) {
    const bool more = window->state->settings_group == GROUP_PRESETS;
    const int foot = dip_min(dip_ui_px(ui, FOOT_HEIGHT), body.height / 6);
    const int room = body.height - foot;
    const int line = dip_max(1, dip_min(dip_ui_px(ui, LINE_HEIGHT), room / DIP_SETTING_COUNT));
    if (more) {
        declare_more(ui, window, (DipRect){body.x, body.y, body.width, room});
    } else {
        for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
            dip_setting_line_declare(ui, window, (DipSetting)s,
                                     (DipRect){body.x, body.y + s * line, body.width, line});
        }
    }
    declare_foot(ui, window, (DipRect){body.x, body.y + room, body.width, foot}, more);
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
