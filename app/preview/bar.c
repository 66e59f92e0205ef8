// The dock's bar: tabs on the left; playback, the time line, help and folding on the right.
#include "app/preview/labels.h"
#include "app/preview/style.h"

#include <stdio.h>

enum { TAB_SIZE = 13, TAB_PAD = 11, BUTTON = 30 };

typedef enum BarControl {
    BAR_TABS, // One for each tab.
    BAR_BACK = BAR_TABS + DIP_TAB_COUNT,
    BAR_PLAY,
    BAR_ON,
    BAR_TIME_LINE,
    BAR_HELP,
    BAR_FOLD
} BarControl;

static const char *const tab_names[DIP_TAB_COUNT] = {"Settings", "Loupe",  "Compare",
                                                     "Maps",     "Advice", "Times"};
static const char *const tab_initials[DIP_TAB_COUNT] = {"Set", "Lo", "Co", "Ma", "Ad", "Ti"};
static const char *const tab_tips[DIP_TAB_COUNT] = {
    "What each setting costs and gains (Y)",
    "Pixels enlarged, with their samples and values (Z)",
    "Wipe, blink, difference, one picture alone, the converged picture (J)",
    "Where error and work are: maps over the pictures (N)",
    "The best settings for a time budget (U)",
    "Times of the stages, errors and work of both panes (R)"};

static DipUiId bar_id(int control) {
    return DIP_UI_ID(DIP_UI_BAR, control + 1);
}

// Declares a control of the bar with a text in its middle. Returns whether it was pressed.
static bool declare_text(DipUi *ui, int control, DipRect rect, const char *text, const char *tip,
                         bool chosen) {
    const DipUiInput input =
        dip_ui_control(ui, &(DipUiControl){.id = bar_id(control), .rect = rect, .tip = tip});
    if (chosen) {
        dip_ui_fill(ui, rect, dip_style_dock);
        dip_ui_fill(ui,
                    (DipRect){rect.x + dip_ui_px(ui, 8), rect.y + rect.height - dip_ui_px(ui, 3),
                              rect.width - 2 * dip_ui_px(ui, 8), dip_ui_px(ui, 2)},
                    dip_style_white);
    }
    dip_ui_text(ui, TAB_SIZE, chosen || input.hovered ? dip_style_white : dip_style_soft,
                DIP_ALIGN_CENTRE, rect.x + rect.width / 2,
                rect.y + (rect.height - dip_ui_line_height(ui, TAB_SIZE)) / 2, rect.width, text);
    if (input.focused) {
        dip_ui_outline(ui, rect, dip_ui_px(ui, 3), dip_ui_px(ui, 2), dip_style_focus);
    }
    return input.pressed;
}

static int tabs_width(const DipUi *ui, const char *const *names) {
    int width = 0;
    for (int t = 0; t < DIP_TAB_COUNT; ++t) {
        width += dip_ui_text_width(ui, TAB_SIZE, names[t]) + 2 * dip_ui_px(ui, TAB_PAD);
    }
    return width;
}

// Declares the tabs and returns the x coordinate of their right end.
static int declare_tabs(DipUi *ui, DipWindow *window, const char *const *names, int pad) {
    DipPreviewState *state = window->state;
    const DipRect bar = window->layout->bar;
    int x = bar.x;
    for (int t = 0; t < DIP_TAB_COUNT; ++t) {
        const int width = dip_ui_text_width(ui, TAB_SIZE, names[t]) + 2 * pad;
        const bool chosen = state->tools.open && (int)state->tools.tab == t;
        if (declare_text(ui, BAR_TABS + t, (DipRect){x, bar.y, width, bar.height}, names[t],
                         tab_tips[t], chosen)) {
            dip_preview_act(state, DIP_ACTION_TAB, t, false, dip_ui_now_ns(ui));
        }
        x += width;
    }
    return x;
}

// Writes where the camera is: the path and its time, or the gallery's scene.
static void format_place(const DipPreviewState *state, char *text, size_t size_bytes) {
    const double seconds = 1e-9 * (double)dip_preview_path_ns(state);
    const double length = 1e-9 * (double)dip_preview_path_length_ns(state);
    if (state->manual) {
        snprintf(text, size_bytes, "Free camera");
    } else if (state->scene_title) {
        snprintf(text, size_bytes, "%s: %s  %.1f s", state->scene_title, state->scene_look,
                 1e-9 * (double)state->play_ns);
    } else {
        snprintf(text, size_bytes, "%s  %.1f of %.0f s",
                 dip_preview_category_title(state->track->active), seconds, length);
    }
}

static void draw_triangle(DipUi *ui, DipRect rect, bool left) {
    for (int i = 0; i < rect.width; ++i) {
        const int half = rect.height * (left ? i + 1 : rect.width - i) / (2 * rect.width);
        dip_ui_fill(ui, (DipRect){rect.x + i, rect.y + rect.height / 2 - half, 1, 2 * half},
                    dip_style_white);
    }
}

// Draws the symbol of a playback button: back, play or pause, on.
static void draw_symbol(DipUi *ui, DipRect button, int control, bool paused) {
    const int side = dip_ui_px(ui, 10);
    const DipRect box = {button.x + (button.width - side) / 2,
                         button.y + (button.height - side) / 2, side, side};
    const int bar = dip_ui_px(ui, 2);
    if (control == BAR_PLAY && !paused) {
        dip_ui_fill(ui, (DipRect){box.x, box.y, 2 * bar, side}, dip_style_white);
        dip_ui_fill(ui, (DipRect){box.x + side - 2 * bar, box.y, 2 * bar, side}, dip_style_white);
        return;
    }
    if (control == BAR_BACK) {
        dip_ui_fill(ui, (DipRect){box.x - bar, box.y, bar, side}, dip_style_white);
    } else if (control == BAR_ON) {
        dip_ui_fill(ui, (DipRect){box.x + side, box.y, bar, side}, dip_style_white);
    }
    draw_triangle(ui, box, control == BAR_BACK);
}

static bool declare_symbol(DipUi *ui, const DipWindow *window, int control, int x,
                           const char *tip) {
    const DipRect bar = window->layout->bar;
    const DipRect rect = {x, bar.y, dip_ui_px(ui, BUTTON), bar.height};
    const bool pressed = declare_text(ui, control, rect, "", tip, false);
    draw_symbol(ui, rect, control, window->state->paused);
    return pressed;
}

static void declare_playback(DipUi *ui, DipWindow *window, int x) {
    DipPreviewState *state = window->state;
    const int step = dip_ui_px(ui, BUTTON);
    const int64_t now_ns = dip_ui_now_ns(ui);
    if (declare_symbol(ui, window, BAR_BACK, x, "One frame back (,)")) {
        dip_preview_act(state, DIP_ACTION_STEP_BACK, 0, false, now_ns);
    }
    if (declare_symbol(ui, window, BAR_PLAY, x + step, "Pause or play (Space)")) {
        dip_preview_act(state, DIP_ACTION_PAUSE, 0, false, now_ns);
    }
    if (declare_symbol(ui, window, BAR_ON, x + 2 * step, "One frame on (.)")) {
        dip_preview_act(state, DIP_ACTION_STEP, 0, false, now_ns);
    }
}

// Declares the line of the path's time, on which a click or a drag moves the time.
static void declare_time_line(DipUi *ui, DipWindow *window, DipRect rect) {
    DipPreviewState *state = window->state;
    const int64_t length_ns = dip_preview_path_length_ns(state);
    const DipUiInput input =
        dip_ui_control(ui, &(DipUiControl){.id = bar_id(BAR_TIME_LINE),
                                           .rect = rect,
                                           .tip = "Time on the camera path. Click or drag to move.",
                                           .takes_arrows = true});
    const int64_t at_ns = dip_preview_path_ns(state);
    const int y = rect.y + rect.height / 2;
    const int thick = dip_ui_px(ui, 2);
    if (length_ns > 0 && (input.began || (input.held && input.moved)) && rect.width > 1) {
        double share = (double)(input.x - rect.x) / (rect.width - 1);
        share = share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
        dip_preview_seek_path(state, (int64_t)(share * 0.9999 * (double)length_ns));
    } else if (input.steps) {
        dip_preview_act(state, DIP_ACTION_SEEK, 1000, input.steps < 0, dip_ui_now_ns(ui));
    }
    dip_ui_fill(ui, (DipRect){rect.x, y - thick / 2, rect.width, thick}, dip_style_line);
    if (length_ns > 0) {
        const int x = rect.x + (int)((double)at_ns / (double)length_ns * (rect.width - 1));
        dip_ui_fill(ui, (DipRect){rect.x, y - thick / 2, x - rect.x, thick}, dip_style_soft);
        dip_ui_fill(ui, (DipRect){x - thick, y - dip_ui_px(ui, 7), 2 * thick, 2 * dip_ui_px(ui, 7)},
                    dip_style_white);
    }
    if (input.focused) {
        dip_ui_outline(ui, rect, dip_ui_px(ui, 3), thick, dip_style_focus);
    }
}

void dip_bar_declare(DipUi *ui, DipWindow *window) {
    DipPreviewState *state = window->state;
    const DipRect bar = window->layout->bar;
    const int button = dip_ui_px(ui, BUTTON), gap = dip_ui_px(ui, 8);
    const int right = bar.x + bar.width - 2 * button;
    const int room = right - bar.x - 3 * button - 2 * gap;
    const bool words = tabs_width(ui, tab_names) <= room;
    const bool short_words = !words && tabs_width(ui, tab_initials) <= right - bar.x;
    const int pad = words || short_words ? dip_ui_px(ui, TAB_PAD) : dip_ui_px(ui, 3);
    char place[128];
    dip_ui_fill(ui, bar, dip_style_bar);
    dip_ui_fill(ui, (DipRect){bar.x, bar.y, bar.width, 1}, dip_style_line);
    const int x = declare_tabs(ui, window, words ? tab_names : tab_initials, pad);
    if (words) {
        format_place(state, place, sizeof place);
        int left = x + gap;
        const int place_width = dip_ui_text_width(ui, TAB_SIZE, place);
        const int line_room = right - left - 3 * button - place_width - 3 * gap;
        const bool whole = line_room > dip_ui_px(ui, 60);
        if (whole && !state->manual && !state->shows_gallery) {
            left += line_room > dip_ui_px(ui, 260) ? line_room - dip_ui_px(ui, 250) : 0;
        } else {
            left = right - gap - 3 * button - (whole ? place_width + gap : 0);
        }
        declare_playback(ui, window, left);
        if (whole) {
            const int from = left + 3 * button + gap;
            const int to = right - place_width - 2 * gap;
            if (to > from && !state->manual && !state->shows_gallery) {
                declare_time_line(ui, window, (DipRect){from, bar.y, to - from, bar.height});
            }
            dip_ui_text(ui, TAB_SIZE, dip_style_soft, DIP_ALIGN_RIGHT, right - gap,
                        bar.y + (bar.height - dip_ui_line_height(ui, TAB_SIZE)) / 2, place_width,
                        place);
        }
    }
    if (declare_text(ui, BAR_HELP, (DipRect){right, bar.y, button, bar.height}, "?",
                     "All keys (F1)", state->help)) {
        dip_preview_act(state, DIP_ACTION_HELP, 0, false, dip_ui_now_ns(ui));
    }
    if (declare_text(ui, BAR_FOLD, (DipRect){right + button, bar.y, button, bar.height},
                     state->tools.open ? "\u25be" : "\u25b4", "Fold or open the panel (Y)",
                     false)) {
        dip_preview_act(state, DIP_ACTION_DOCK, 0, false, dip_ui_now_ns(ui));
    }
}
