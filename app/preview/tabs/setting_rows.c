// Rows of settings: sliders of steps with prices, switches, and lines of a list.
#include "app/preview/tabs/tabs.h"

#include "app/preview/prices/price_text.h"
#include "app/ui/style.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    NAME_SIZE = 13,
    STEP_SIZE = 12,
    PRICE_SIZE = 11,
    LINE_SIZE = 11,
    NAME_HEIGHT = 18,
    STEP_HEIGHT = 18,
    PRICE_HEIGHT = 16,
    SLIDER_GAP = 5, // Below a slider.
    SWITCH_HEIGHT = 26,
    LABELS_WIDTH = 32, // Room for "ms" and "FLIP" left of the prices.
    PILL_LEAST_WIDTH = 34,
    BAR_LENGTH = 40,
    BAR_ALPHA = 150
};

static DipUiId id_of(DipSetting setting) {
    return DIP_UI_ID(DIP_UI_SETTINGS, DIP_ID_FIRST_SETTING + (int)setting);
}

// The pane whose setting the row changes: the requested pane, unless only the current pane is
// chosen.
static int edited_pane(const DipPreviewState *state) {
    return state->edited[DIP_PANE_REQUESTED] ? DIP_PANE_REQUESTED : DIP_PANE_CURRENT;
}

static int step_of(const DipPreviewState *state, int pane, DipSetting setting) {
    return state->quality[pane].step[setting];
}

static DipPrice price_of(const DipWindow *window, DipSetting setting, int step) {
    return dip_prices_step(window->prices, setting, step,
                           &window->state->quality[DIP_PANE_REQUESTED]);
}

// Returns whether a step fits the other settings; otherwise writes why it does not. A number of
// samples always fits, since the group size follows it.
static bool is_valid(const DipPreviewState *state, DipSetting setting, int step, char why[256]) {
    DipQuality quality = state->quality[edited_pane(state)];
    DipError err;
    why[0] = '\0';
    quality.step[setting] = (uint8_t)step;
    if (setting == DIP_SETTING_AA || dip_quality_check(&quality, &err)) {
        return true;
    }
    snprintf(why, 256, "%.250s", err.message);
    return false;
}

// Draws "none -> 4x" with its right end at `right`: the current and the requested step.
static void draw_values(DipUi *ui, const DipWindow *window, DipSetting setting, int size, int right,
                        int y, int room) {
    const DipPreviewState *state = window->state;
    const DipSettingInfo *info = dip_setting_info(setting);
    const char *current = info->labels[step_of(state, DIP_PANE_CURRENT, setting)];
    const char *requested = info->labels[step_of(state, DIP_PANE_REQUESTED, setting)];
    char text[32];
    snprintf(text, sizeof text, "%s \u2192 ", current);
    const int width = dip_ui_text_width(ui, size, requested);
    const bool changed = step_of(state, 0, setting) != step_of(state, 1, setting);
    dip_ui_text(ui, size, changed ? dip_style_accent : dip_style_soft, DIP_ALIGN_RIGHT, right, y,
                room, requested);
    if (changed && width + dip_ui_text_width(ui, size, text) <= room) {
        dip_ui_text(ui, size, dip_style_soft, DIP_ALIGN_RIGHT, right - width, y, room, text);
    }
}

// Changes a setting by what the user did with its row.
static void change_by(DipUi *ui, DipWindow *window, DipSetting setting, const DipUiInput *input,
                      int pointed) {
    DipPreviewState *state = window->state;
    const int count = dip_setting_info(setting)->step_count;
    const int now = dip_setting_step_at(setting, step_of(state, edited_pane(state), setting));
    int wanted = now;
    if (input->began || (input->held && input->moved)) {
        wanted = pointed;
    } else if (input->steps) {
        wanted = now + input->steps;
        char why[256]; // Steps that do not fit are passed over.
        while (wanted >= 0 && wanted < count &&
               !is_valid(state, setting, dip_setting_step_at(setting, wanted), why)) {
            wanted += input->steps > 0 ? 1 : -1;
        }
    } else if (input->to_first || input->to_last) {
        wanted = input->to_first ? 0 : count - 1;
    } else if (input->pressed && !input->hovered) {
        wanted = (now + 1) % count;
    }
    wanted = dip_max(0, dip_min(count - 1, wanted));
    if (wanted != now) {
        dip_preview_set_step(state, setting, dip_setting_step_at(setting, wanted),
                             dip_ui_now_ns(ui));
    }
}

// --- a slider ------------------------------------------------------------------------------------

typedef struct Slider {
    DipSetting setting;
    DipRect rect;
    DipRect cells; // The steps and their prices.
    int cell_width;
    int count;
    int pointed; // Position under the pointer.
    DipUiInput input;
    DipPrice prices[DIP_MAX_STEPS]; // By position.
    double most_ms;                 // The greatest price, for the bars.
    double most_flip;
    bool rough;  // Prices come from a few frames; the row says so once, before them.
    bool dimmed; // The setting has no effect now.
} Slider;

static DipColour with_alpha(DipColour colour, int alpha) {
    colour.alpha = (uint8_t)alpha;
    return colour;
}

// Draws a bar beneath a price, whose length is the price's share of the row's greatest price.
static void draw_bar(DipUi *ui, int x, int y, double value, double most, DipColour colour) {
    const int length = most > 0.0 ? (int)(dip_ui_px(ui, BAR_LENGTH) * fabs(value) / most + 0.5) : 0;
    if (length > 0) {
        dip_ui_fill(ui, (DipRect){x - dip_ui_px(ui, BAR_LENGTH) / 2, y, length, dip_ui_px(ui, 2)},
                    colour);
    }
}

static bool is_known(const DipPrice *price) {
    return price->state != DIP_PRICE_UNKNOWN && price->state != DIP_PRICE_BASE;
}

// Returns whether a price is known well enough to be compared with others at a glance.
static bool has_bar(const DipPrice *price) {
    return is_known(price) && dip_price_trust(price) == DIP_PRICE_TRUST_KNOWN;
}

static DipColour flip_colour(const DipPrice *price) {
    return !price->has_flip || price->state == DIP_PRICE_BASE || price->flip == 0.0 ? dip_style_dim
           : price->flip < 0.0                                                      ? dip_style_gain
                               : dip_style_worse;
}

static void draw_price(DipUi *ui, const Slider *slider, int position, bool requested, int x,
                       int y) {
    const DipPrice *price = &slider->prices[position];
    char text[DIP_STEP_NAME_BYTES];
    const int line = dip_ui_px(ui, PRICE_HEIGHT);
    const int bar_y = y + line - dip_ui_px(ui, 3);
    const int alpha = requested ? 255 : BAR_ALPHA;
    const bool costs = has_bar(price);
    dip_price_ms_text(price, text);
    const size_t mark = costs && strncmp(text, DIP_ROUGH_MARK, strlen(DIP_ROUGH_MARK)) == 0
                            ? strlen(DIP_ROUGH_MARK)
                            : 0;
    dip_ui_text(ui, PRICE_SIZE,
                !costs      ? dip_style_dim
                : requested ? dip_style_white
                            : dip_style_soft,
                DIP_ALIGN_CENTRE, x, y, slider->cell_width, text + mark);
    if (costs) {
        draw_bar(ui, x, bar_y, price->ms, slider->most_ms, with_alpha(dip_style_accent, alpha));
    }
    dip_price_flip_text(price, text);
    dip_ui_text(ui, PRICE_SIZE, flip_colour(price), DIP_ALIGN_CENTRE, x, y + line,
                slider->cell_width, text);
    if (is_known(price) && price->has_flip) {
        draw_bar(ui, x, bar_y + line, price->flip, slider->most_flip,
                 with_alpha(flip_colour(price), alpha));
    }
}

static void draw_pill(DipUi *ui, const DipWindow *window, const Slider *slider, int position,
                      int x) {
    const DipPreviewState *state = window->state;
    const int step = dip_setting_step_at(slider->setting, position);
    const bool current = step == step_of(state, DIP_PANE_CURRENT, slider->setting);
    const bool requested = step == step_of(state, DIP_PANE_REQUESTED, slider->setting);
    const bool hovered = slider->input.hovered && slider->pointed == position;
    const char *name = dip_setting_info(slider->setting)->labels[step];
    char why[256];
    const bool valid = is_valid(state, slider->setting, step, why);
    const int height = dip_ui_px(ui, STEP_HEIGHT);
    const int width = dip_min(slider->cell_width,
                              dip_max(dip_ui_px(ui, PILL_LEAST_WIDTH),
                                      dip_ui_text_width(ui, STEP_SIZE, name) + dip_ui_px(ui, 14)));
    const DipRect pill = {x - width / 2, slider->cells.y, width, height};
    dip_ui_fill_round(ui, pill, height / 2,
                      requested ? dip_style_accent
                      : valid   ? dip_style_raised
                                : dip_style_dock);
    if (current) {
        dip_ui_outline(ui, pill, height / 2, dip_ui_px(ui, 2), dip_style_white);
    } else if (!requested && (hovered || !valid)) {
        dip_ui_outline(ui, pill, height / 2, dip_ui_px(ui, 1),
                       valid ? dip_style_soft : dip_style_line);
    }
    dip_ui_text(ui, STEP_SIZE,
                requested                  ? dip_style_on_accent
                : valid && !slider->dimmed ? dip_style_soft
                                           : dip_style_off,
                DIP_ALIGN_CENTRE, x, pill.y + (height - dip_ui_line_height(ui, STEP_SIZE)) / 2,
                width, name);
    if (slider->input.focused && step == step_of(state, edited_pane(state), slider->setting)) {
        dip_ui_focus_ring(ui, pill, height / 2, &slider->input);
    }
}

static void draw_slider(DipUi *ui, const DipWindow *window, const Slider *slider) {
    const DipRect rect = slider->rect, cells = slider->cells;
    const int price_y = cells.y + dip_ui_px(ui, STEP_HEIGHT) + dip_ui_px(ui, 1);
    const char *title = slider->setting == DIP_SETTING_ASD
                            ? "Samples per adaptive group"
                            : dip_setting_info(slider->setting)->title;
    dip_ui_text(ui, NAME_SIZE, slider->dimmed ? dip_style_dim : dip_style_white, DIP_ALIGN_LEFT,
                rect.x, rect.y, rect.width, title);
    draw_values(ui, window, slider->setting, STEP_SIZE, rect.x + rect.width, rect.y,
                rect.width - dip_ui_text_width(ui, NAME_SIZE, title) - dip_ui_px(ui, 8));
    dip_ui_fill(ui,
                (DipRect){cells.x + slider->cell_width / 2,
                          cells.y + (dip_ui_px(ui, STEP_HEIGHT) - dip_ui_px(ui, 2)) / 2,
                          slider->cell_width * (slider->count - 1), dip_ui_px(ui, 2)},
                dip_style_line);
    dip_ui_text(ui, PRICE_SIZE, dip_style_dim, DIP_ALIGN_LEFT, rect.x, price_y, cells.x - rect.x,
                slider->rough ? DIP_ROUGH_MARK "ms" : "ms");
    dip_ui_text(ui, PRICE_SIZE, dip_style_dim, DIP_ALIGN_LEFT, rect.x,
                price_y + dip_ui_px(ui, PRICE_HEIGHT), cells.x - rect.x, "FLIP");
    for (int i = 0; i < slider->count; ++i) {
        const int x = cells.x + slider->cell_width * i + slider->cell_width / 2;
        const bool requested = dip_setting_step_at(slider->setting, i) ==
                               step_of(window->state, DIP_PANE_REQUESTED, slider->setting);
        draw_pill(ui, window, slider, i, x);
        draw_price(ui, slider, i, requested, x, price_y);
    }
}

static void find_prices(const DipWindow *window, Slider *slider) {
    for (int i = 0; i < slider->count; ++i) {
        slider->prices[i] =
            price_of(window, slider->setting, dip_setting_step_at(slider->setting, i));
        slider->rough |= slider->prices[i].state == DIP_PRICE_ROUGH;
        if (has_bar(&slider->prices[i])) {
            slider->most_ms = fmax(slider->most_ms, fabs(slider->prices[i].ms));
        }
        if (is_known(&slider->prices[i]) && slider->prices[i].has_flip) {
            slider->most_flip = fmax(slider->most_flip, fabs(slider->prices[i].flip));
        }
    }
}

static int declare_slider(DipUi *ui, DipWindow *window, DipSetting setting, DipRect rect) {
    const DipPreviewState *state = window->state;
    const int name_height = dip_ui_px(ui, NAME_HEIGHT), indent = dip_ui_px(ui, LABELS_WIDTH);
    const int height = dip_ui_px(ui, STEP_HEIGHT) + 2 * dip_ui_px(ui, PRICE_HEIGHT);
    Slider slider = {.setting = setting, .rect = rect};
    slider.count = dip_setting_info(setting)->step_count;
    slider.cell_width = dip_max(1, (rect.width - indent) / slider.count);
    slider.cells =
        (DipRect){rect.x + indent, rect.y + name_height, slider.cell_width * slider.count, height};
    slider.dimmed = dip_quality_needs(&state->quality[edited_pane(state)], setting) != NULL;
    const int under = (dip_ui_pointer_x(ui) - slider.cells.x) / slider.cell_width;
    slider.pointed = dip_max(0, dip_min(slider.count - 1, under));
    char why[256], tip[DIP_STEP_TEXT_BYTES];
    const int step = dip_setting_step_at(setting, slider.pointed);
    const DipPrice price = price_of(window, setting, step);
    is_valid(state, setting, step, why);
    dip_step_tip(setting, step, &price, why, tip);
    slider.input = dip_ui_control(ui, &(DipUiControl){.id = id_of(setting),
                                                      .rect = slider.cells,
                                                      .tip = tip,
                                                      .takes_arrows = true,
                                                      .takes_wheel = true});
    change_by(ui, window, setting, &slider.input, slider.pointed);
    if (dip_ui_is_drawing(ui)) {
        find_prices(window, &slider);
        draw_slider(ui, window, &slider);
    }
    return name_height + height + dip_ui_px(ui, SLIDER_GAP);
}

// --- a switch ------------------------------------------------------------------------------------

// Draws the knob at the requested side. A ring shows the current pane's side if it is another.
static void draw_switch(DipUi *ui, DipRect rect, bool current, bool requested, bool hovered) {
    const int radius = rect.height / 2, inset = dip_ui_px(ui, 3);
    const int side = rect.height - 2 * inset;
    const int off_x = rect.x + inset, on_x = rect.x + rect.width - inset - side;
    dip_ui_fill_round(ui, rect, radius, requested ? dip_style_accent : dip_style_switch);
    dip_ui_fill_round(ui, (DipRect){requested ? on_x : off_x, rect.y + inset, side, side}, side / 2,
                      requested ? dip_style_on_accent : dip_style_white);
    if (current != requested) {
        dip_ui_outline(ui, (DipRect){current ? on_x : off_x, rect.y + inset, side, side}, side / 2,
                       dip_ui_px(ui, 2), current ? dip_style_white : dip_style_on_accent);
    }
    if (hovered) {
        dip_ui_outline(ui, rect, radius, dip_ui_px(ui, 1), dip_style_soft);
    }
}

// Draws what the switch costs and gains, with its right end at `right`.
static void draw_switch_price(DipUi *ui, const DipWindow *window, DipSetting setting, int right,
                              int y, int room) {
    const DipPrice price = price_of(window, setting, setting == DIP_SETTING_GI ? 0 : 1);
    const char *needs = dip_quality_needs(&window->state->quality[DIP_PANE_REQUESTED], setting);
    char ms[DIP_STEP_NAME_BYTES], flip[DIP_STEP_NAME_BYTES] = "", text[160], longer[160];
    dip_price_ms_text(&price, ms);
    const bool known = is_known(&price);
    if (needs && !known) {
        snprintf(text, sizeof text, "%s", needs);
    } else if (setting == DIP_SETTING_MIPDEBUG) {
        snprintf(text, sizeof text, "a picture of its own");
    } else {
        snprintf(text, sizeof text, "%s%s%s", setting == DIP_SETTING_GI && known ? "if off " : "",
                 ms, known ? " ms" : "");
        snprintf(longer, sizeof longer, "%.80s \u00b7 gains in motion", text);
        const bool fits = dip_ui_text_width(ui, PRICE_SIZE, longer) <= room;
        if (setting == DIP_SETTING_TAA && known && fits) {
            snprintf(text, sizeof text, "%s", longer);
        }
        if (known && price.has_flip && setting != DIP_SETTING_GI && setting != DIP_SETTING_TAA) {
            dip_price_flip_text(&price, flip);
        }
    }
    dip_ui_text(ui, PRICE_SIZE, flip_colour(&price), DIP_ALIGN_RIGHT, right, y, room, flip);
    if (flip[0]) {
        const int width = dip_ui_text_width(ui, PRICE_SIZE, flip) + dip_ui_px(ui, 7);
        right -= width;
        room -= width;
    }
    dip_ui_text(ui, PRICE_SIZE, has_bar(&price) ? dip_style_soft : dip_style_dim, DIP_ALIGN_RIGHT,
                right, y, room, text);
}

static int declare_switch(DipUi *ui, DipWindow *window, DipSetting setting, DipRect rect) {
    const DipPreviewState *state = window->state;
    const bool on = step_of(state, edited_pane(state), setting) != 0;
    const bool dimmed = dip_quality_needs(&state->quality[edited_pane(state)], setting) != NULL;
    char tip[DIP_STEP_TEXT_BYTES];
    const DipPrice price = price_of(window, setting, 1);
    rect.height = dip_ui_px(ui, SWITCH_HEIGHT);
    dip_step_tip(setting, 1, &price, "", tip);
    const DipUiInput input = dip_ui_control(ui, &(DipUiControl){.id = id_of(setting),
                                                                .rect = rect,
                                                                .tip = tip,
                                                                .takes_arrows = true,
                                                                .takes_wheel = true});
    const bool to_on = input.steps > 0 || input.to_last, to_off = input.steps < 0 || input.to_first;
    if (input.pressed || (to_on && !on) || (to_off && on)) {
        dip_preview_set_step(window->state, setting, !on, dip_ui_now_ns(ui));
    }
    const int knob_width = dip_ui_px(ui, 34), knob_height = dip_ui_px(ui, 16);
    const DipRect knob = {rect.x + rect.width - knob_width,
                          rect.y + (rect.height - knob_height) / 2, knob_width, knob_height};
    const int y = rect.y + (rect.height - dip_ui_line_height(ui, NAME_SIZE)) / 2;
    const char *title = dip_setting_info(setting)->title;
    const int title_width = dip_ui_text_width(ui, NAME_SIZE, title);
    dip_ui_text(ui, NAME_SIZE, dimmed ? dip_style_dim : dip_style_white, DIP_ALIGN_LEFT, rect.x, y,
                rect.width, title);
    draw_switch(ui, knob, step_of(state, DIP_PANE_CURRENT, setting) != 0,
                step_of(state, DIP_PANE_REQUESTED, setting) != 0, input.hovered);
    const int gap = dip_ui_px(ui, 8);
    draw_switch_price(ui, window, setting, knob.x - gap,
                      rect.y + (rect.height - dip_ui_line_height(ui, PRICE_SIZE)) / 2,
                      knob.x - rect.x - title_width - 2 * gap);
    dip_ui_focus_ring(ui, knob, knob_height / 2, &input);
    return rect.height;
}

int dip_setting_row_declare(DipUi *ui, DipWindow *window, DipSetting setting, DipRect rect) {
    const bool is_switch = dip_setting_info(setting)->step_count == 2;
    return (is_switch ? declare_switch : declare_slider)(ui, window, setting, rect);
}

// --- a line of a list ----------------------------------------------------------------------------

void dip_setting_line_declare(DipUi *ui, DipWindow *window, DipSetting setting, DipRect rect) {
    const DipPreviewState *state = window->state;
    const int requested = step_of(state, DIP_PANE_REQUESTED, setting);
    const DipPrice price = price_of(window, setting, requested);
    char tip[DIP_STEP_TEXT_BYTES], ms[DIP_STEP_NAME_BYTES] = "";
    dip_step_tip(setting, requested, &price, "", tip);
    DipUiInput input = dip_ui_control(ui, &(DipUiControl){.id = id_of(setting),
                                                          .rect = rect,
                                                          .tip = tip,
                                                          .takes_arrows = true,
                                                          .takes_wheel = true});
    const int title_end = rect.x + dip_ui_px(ui, 10) +
                          dip_ui_text_width(ui, LINE_SIZE, dip_setting_info(setting)->short_title);
    if (input.pressed) { // A click on the arrow before the value takes the step before.
        const bool back = input.hovered && input.x >= title_end &&
                          input.x < (title_end + rect.x + rect.width) / 2;
        dip_preview_act(window->state, DIP_ACTION_SETTING, (int)setting, back, dip_ui_now_ns(ui));
    }
    input.began = input.moved = input.pressed = false;
    change_by(ui, window, setting, &input, 0);
    const bool marked = input.hovered || input.focused;
    const int pad = dip_ui_px(ui, 5);
    const int size = rect.height < dip_ui_line_height(ui, LINE_SIZE) ? LINE_SIZE - 2 : LINE_SIZE;
    const int price_width = dip_ui_text_width(ui, size, DIP_ROUGH_MARK "+88.8");
    const int y = rect.y + (rect.height - dip_ui_line_height(ui, size)) / 2;
    if (marked) {
        dip_ui_fill(ui, rect, dip_style_raised);
    }
    if (is_known(&price)) {
        dip_price_ms_text(&price, ms);
    }
    const char *title = dip_setting_info(setting)->short_title;
    const int title_width = dip_ui_text_width(ui, size, title);
    dip_ui_text(ui, size, dip_style_white, DIP_ALIGN_LEFT, rect.x + pad, y, rect.width, title);
    dip_ui_text(ui, size, dip_style_soft, DIP_ALIGN_RIGHT, rect.x + rect.width - pad, y,
                price_width, ms);
    const int arrow = dip_ui_text_width(ui, size, "\u203a") + pad;
    const int right = rect.x + rect.width - pad - price_width - arrow;
    draw_values(ui, window, setting, size, right, y,
                right - rect.x - title_width - 2 * pad - arrow);
    if (marked) {
        dip_ui_text(ui, size, dip_style_dim, DIP_ALIGN_LEFT, right + pad / 2, y, arrow, "\u203a");
        dip_ui_text(ui, size, dip_style_dim, DIP_ALIGN_LEFT, rect.x + 2 * pad + title_width, y,
                    arrow, "\u2039");
    }
    if (input.focused) {
        dip_ui_outline(ui, rect, 0, dip_ui_px(ui, 2), dip_style_focus);
    }
}
