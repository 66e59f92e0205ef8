// Declares the whole window, from the back to the front.
#include "app/preview/tabs/tabs.h"
#include "app/preview/tools/loupe.h"
#include "app/preview/state/pilot.h"
#include "app/ui/style.h"

// Number of the button "Show the panel", greater than the numbers of the bar's buttons (bar.c).
enum { WAY_BACK = 100 };

// Declares one pane as a control. A click chooses the pane whose settings the keys change. A double
// click turns the full screen on or off.
static DipUiInput declare_pane(DipUi *ui, DipWindow *window, int pane) {
    DipPreviewState *state = window->state;
    const DipUiControl control = {.id = DIP_UI_ID(DIP_UI_PANES, pane),
                                  .rect = window->layout->panes[pane],
                                  .skips_focus = true,
                                  .takes_wheel = state->manual || dip_loupe_is_on(&state->tools)};
    const DipUiInput input = dip_ui_control(ui, &control);
    // A press that gives the window the focus does not choose a pane.
    if (input.began && !input.focuses) {
        if (!state->edited[pane]) {
            dip_preview_notice(state, dip_ui_now_ns(ui), "Keys and panel change the %s pane",
                               dip_pane_names[pane]);
        }
        dip_preview_edit_only(state, pane);
        dip_ui_blur(ui);
    }
    if (input.began && input.clicks == 2) {
        dip_preview_act(state, DIP_ACTION_FULL_SCREEN, 0, false, dip_ui_now_ns(ui));
    }
    return input;
}

static void declare_tab(DipUi *ui, DipWindow *window, DipRect body) {
    static void (*const tabs[DIP_TAB_COUNT])(DipUi *, DipWindow *, DipRect) = {
        [DIP_TAB_SETTINGS] = dip_tab_settings, [DIP_TAB_LOUPE] = dip_tab_loupe,
        [DIP_TAB_COMPARE] = dip_tab_compare,   [DIP_TAB_MAPS] = dip_tab_maps,
        [DIP_TAB_ADVICE] = dip_tab_advice,     [DIP_TAB_TIMES] = dip_tab_times,
        [DIP_TAB_PATH] = dip_tab_path,
    };
    dip_ui_fill(ui, body, dip_style_dock);
    dip_ui_keep_tips_off(ui, dip_rect_unite(window->layout->bar, body));
    tabs[window->state->tools.tab](ui, window, body);
}

// Declares a sheet that covers the window: the help or the costs. A click anywhere closes it.
static void declare_sheet(DipUi *ui, DipWindow *window) {
    DipPreviewState *state = window->state;
    const DipUiInput input = dip_ui_control(
        ui, &(DipUiControl){.id = DIP_UI_ID(DIP_UI_HELP, 1),
                            .rect = {0, 0, window->layout->width, window->layout->height},
                            .skips_focus = true,
                            .takes_wheel = true});
    if (dip_ui_is_drawing(ui) && state->help) {
        dip_sheet_draw_help(dip_ui_list(ui), dip_ui_scale(ui), state->help_words);
    } else if (dip_ui_is_drawing(ui)) {
        dip_sheet_draw_costs(dip_ui_list(ui), state, dip_ui_scale(ui));
    }
    if (input.pressed) {
        state->help = state->show_costs = false;
    }
}

// Declares the button that ends the mode in which only the panes show. The button shows while the
// pointer is in the lower half of the window or a notice shows. The action that begins the mode
// also shows a notice.
static void declare_way_back(DipUi *ui, DipWindow *window) {
    static const char text[] = "Show the panel  (/)";
    const DipLayout *layout = window->layout;
    const int width = dip_min(layout->width, dip_ui_text_width(ui, 13, text) + dip_ui_px(ui, 24));
    const int height = dip_min(layout->height, dip_ui_px(ui, 30));
    const DipRect rect = {(layout->width - width) / 2, layout->height - height, width, height};
    const bool near =
        dip_ui_pointer_y(ui) >= layout->height / 2 && dip_ui_pointer_y(ui) < layout->height;
    if ((near || window->state->notice[0]) &&
        dip_ui_button(ui, DIP_UI_ID(DIP_UI_BAR, WAY_BACK), rect, text, DIP_UI_PLAIN,
                      "Brings the panel and the labels back.")) {
        dip_preview_act(window->state, DIP_ACTION_BARE, 0, false, dip_ui_now_ns(ui));
    }
}

void dip_window_declare(DipUi *ui, DipWindow *window) {
    const DipLayout *layout = window->layout;
    DipPreviewState *state = window->state;
    DipUiInput panes[DIP_PANE_COUNT];
    dip_ui_fill(ui, (DipRect){0, 0, layout->width, layout->height}, dip_style_background);
    dip_compare_pictures(ui, window);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        panes[p] = declare_pane(ui, window, p);
    }
    dip_fly_over_panes(ui, window, panes);
    dip_maps_over_panes(ui, window, panes);
    dip_compare_over_panes(ui, window, panes);
    dip_loupe_over_panes(ui, window, panes);
    if (!state->tools.bare) {
        dip_labels_draw(ui, window);
        dip_bar_declare(ui, window);
        if (!dip_rect_is_empty(layout->body)) {
            declare_tab(ui, window, layout->body);
        }
        dip_labels_draw_notice(ui, window);
    } else {
        declare_way_back(ui, window);
    }
    if (state->help || state->show_costs) {
        declare_sheet(ui, window);
    }
}
