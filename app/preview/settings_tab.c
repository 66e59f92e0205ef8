// The tab of the settings: steps as a row of pills with their prices, switches, presets, the sum.
#include "app/preview/style.h"
#include "app/preview/tabs.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    NAME_SIZE = 13,
    STEP_SIZE = 12,
    PRICE_SIZE = 11,
    SUM_SIZE = 22,
    NAME_HEIGHT = 20,
    STEP_HEIGHT = 20,
    PRICE_HEIGHT = 16,
    SLIDER_HEIGHT = NAME_HEIGHT + STEP_HEIGHT + 2 * PRICE_HEIGHT,
    SWITCH_HEIGHT = 26,
    LIST_HEIGHT = 24,
    ROW_LABELS_WIDTH = 36, // Room for "ms" and "FLIP" left of the prices.
    COLUMN_GAP = 22,
    SUM_WIDTH = 330,
};

// Ids of the controls beyond those of the settings' steps.
enum { ID_SETTINGS = 1, ID_PRESETS = 200, ID_APPLY = 300, ID_UNDO, ID_COPY };

// Settings whose steps stand in the opposite order, so that the better picture is on the right.
static bool is_reversed(DipSetting setting) {
    return setting == DIP_SETTING_OPT || setting == DIP_SETTING_ASD;
}

static bool is_switch(DipSetting setting) {
    return dip_setting_info(setting)->step_count == 2;
}

// Returns the step at a position from left to right.
static int step_at(DipSetting setting, int position) {
    return is_reversed(setting) ? dip_setting_info(setting)->step_count - 1 - position : position;
}

static void step_name(DipSetting setting, int step, char *text, size_t size_bytes) {
    static const char *const miplod[] = {"high perf.", "perform.", "quality", "high qual."};
    const char *name = dip_setting_info(setting)->steps[step];
    const bool times = (setting == DIP_SETTING_AA || setting == DIP_SETTING_AF) && name[0] >= '0' &&
                       name[0] <= '9';
    if (setting == DIP_SETTING_MIPLOD) {
        name = miplod[step];
    }
    snprintf(text, size_bytes, "%s%s", name, times ? "x" : "");
}

static const char *short_title(DipSetting setting) {
    return setting == DIP_SETTING_ASD ? "Samples per adaptive group"
                                      : dip_setting_info(setting)->title;
}

// --- prices --------------------------------------------------------------------------------------

// Writes a time: "+1.2", "\u2248 0", "~+1.2" or "base".
static void format_ms(const DipPrice *price, char *text, size_t size_bytes) {
    const char *rough = price->state == DIP_PRICE_ROUGH ? "~" : "";
    if (price->state == DIP_PRICE_UNKNOWN) {
        snprintf(text, size_bytes, price->needs_company ? "\u2013" : "\u00b7\u00b7\u00b7");
    } else if (price->state == DIP_PRICE_BASE) {
        snprintf(text, size_bytes, "base");
    } else if (price->ms_is_zero) {
        snprintf(text, size_bytes, "\u2248 0");
    } else {
        snprintf(text, size_bytes, "%s%s%.1f", rough, price->ms < 0.0 ? "\u2212" : "+",
                 fabs(price->ms));
    }
}

// Writes an error: "\u2212.0095" or "+.0100"; the base shows its own error.
static void format_flip(const DipPrice *price, char *text, size_t size_bytes) {
    char digits[24];
    text[0] = '\0';
    if (!price->has_flip) {
        return;
    }
    snprintf(digits, sizeof digits, "%.4f", fabs(price->flip));
    const char *sign = price->state == DIP_PRICE_BASE ? "" : price->flip > 0.0 ? "+" : "\u2212";
    snprintf(text, size_bytes, "%s%s", sign, digits[0] == '0' ? digits + 1 : digits);
}

static DipColour flip_colour(const DipPrice *price) {
    return price->state == DIP_PRICE_BASE || price->flip == 0.0 ? dip_style_dim
           : price->flip < 0.0                                  ? dip_style_gain
                                                                : dip_style_worse;
}

// Writes what a step does and costs, for the tip.
static void format_tip(const DipWindow *window, DipSetting setting, int step, const char *why,
                       char *text, size_t size_bytes) {
    const DipSettingInfo *info = dip_setting_info(setting);
    const DipPrice price =
        dip_prices_step(window->prices, setting, step, &window->state->quality[DIP_PANE_REQUESTED]);
    char cost[160] = "";
    if (price.state == DIP_PRICE_MEASURED || price.state == DIP_PRICE_PREDICTED ||
        price.state == DIP_PRICE_ROUGH) {
        snprintf(cost, sizeof cost, "\n%+.2f ms (%.2f to %.2f) on path %s%s.", price.ms,
                 price.ms_low, price.ms_high, price.path,
                 price.state == DIP_PRICE_ROUGH       ? ", roughly measured just now"
                 : price.state == DIP_PRICE_PREDICTED ? ", predicted"
                                                      : "");
    } else if (price.state == DIP_PRICE_UNKNOWN) {
        snprintf(cost, sizeof cost,
                 price.needs_company ? "\nIts price needs %s." : "\nIts price is not measured yet.",
                 price.needs);
    }
    snprintf(text, size_bytes, "%s: %s%s%s\n%s%s", info->title, info->steps[step],
             why[0] ? "\n" : "", why, info->text, cost);
}

// Returns whether a step fits the other settings; otherwise writes why it does not.
static bool is_valid(const DipPreviewState *state, DipSetting setting, int step, char *why,
                     size_t size_bytes) {
    DipQuality quality = state->quality[DIP_PANE_REQUESTED];
    DipError err;
    why[0] = '\0';
    quality.step[setting] = (uint8_t)step;
    if (setting == DIP_SETTING_AA || dip_quality_check(&quality, &err)) {
        return true;
    }
    snprintf(why, size_bytes, "%s", err.message);
    return false;
}

// --- a setting with several steps ----------------------------------------------------------------

// Draws "none -> 4x": the current and the requested step.
static void draw_values(DipUi *ui, const DipWindow *window, DipSetting setting, DipRect line) {
    const DipPreviewState *state = window->state;
    char current[24], requested[24], text[32];
    step_name(setting, state->quality[DIP_PANE_CURRENT].step[setting], current, sizeof current);
    step_name(setting, state->quality[DIP_PANE_REQUESTED].step[setting], requested,
              sizeof requested);
    snprintf(text, sizeof text, "%s \u2192 ", current);
    const int right = line.x + line.width;
    const int width = dip_ui_text_width(ui, STEP_SIZE, requested);
    dip_ui_text(ui, STEP_SIZE, dip_style_accent, DIP_ALIGN_RIGHT, right, line.y, line.width / 2,
                requested);
    dip_ui_text(ui, STEP_SIZE, dip_style_soft, DIP_ALIGN_RIGHT, right - width, line.y,
                line.width / 2, text);
}

static void draw_price(DipUi *ui, const DipWindow *window, DipSetting setting, int step, int x,
                       int y, int width) {
    char text[32];
    const DipPrice price =
        dip_prices_step(window->prices, setting, step, &window->state->quality[DIP_PANE_REQUESTED]);
    format_ms(&price, text, sizeof text);
    dip_ui_text(ui, PRICE_SIZE,
                price.state == DIP_PRICE_BASE || price.ms_is_zero ? dip_style_dim : dip_style_white,
                DIP_ALIGN_CENTRE, x, y, width, text);
    format_flip(&price, text, sizeof text);
    dip_ui_text(ui, PRICE_SIZE, flip_colour(&price), DIP_ALIGN_CENTRE, x,
                y + dip_ui_px(ui, PRICE_HEIGHT), width, text);
}

static void draw_pill(DipUi *ui, DipRect pill, const char *name, bool current, bool requested,
                      bool valid, bool hovered) {
    const int radius = pill.height / 2;
    if (requested) {
        dip_ui_fill_round(ui, pill, radius, dip_style_accent);
    } else {
        dip_ui_fill_round(ui, pill, radius, dip_style_raised);
    }
    if (current || (hovered && valid)) {
        dip_ui_outline(ui, pill, radius, dip_ui_px(ui, current ? 2 : 1), dip_style_white);
    } else if (!valid) {
        dip_ui_outline(ui, pill, radius, 1, dip_style_line);
    }
    dip_ui_text(ui, STEP_SIZE,
                requested ? dip_style_on_accent
                : valid   ? dip_style_white
                          : dip_style_dim,
                DIP_ALIGN_CENTRE, pill.x + pill.width / 2,
                pill.y + (pill.height - dip_ui_line_height(ui, STEP_SIZE)) / 2, pill.width, name);
}

// Changes a setting by what the user did with its row.
static void change_by(DipUi *ui, DipWindow *window, DipSetting setting, const DipUiInput *input,
                      int position_under_pointer) {
    DipPreviewState *state = window->state;
    const int count = dip_setting_info(setting)->step_count;
    const int requested = state->quality[DIP_PANE_REQUESTED].step[setting];
    const int now = is_reversed(setting) ? count - 1 - requested : requested;
    int wanted = now;
    if (input->began || (input->held && input->moved)) {
        wanted = position_under_pointer;
    } else if (input->steps) {
        wanted = now + input->steps;
    } else if (input->to_first || input->to_last) {
        wanted = input->to_first ? 0 : count - 1;
    } else if (input->pressed && !input->hovered) {
        wanted = (now + 1) % count;
    }
    if (wanted != now && wanted >= 0 && wanted < count) {
        dip_preview_set_step(state, setting, step_at(setting, wanted), dip_ui_now_ns(ui));
    }
}

// Declares a setting as a row of pills on a line, with the prices beneath.
static void declare_slider(DipUi *ui, DipWindow *window, DipSetting setting, DipRect rect) {
    const DipPreviewState *state = window->state;
    const int count = dip_setting_info(setting)->step_count;
    const int indent = dip_ui_px(ui, ROW_LABELS_WIDTH);
    const int cell = (rect.width - indent) / count;
    const int y = rect.y + dip_ui_px(ui, NAME_HEIGHT);
    const int height = dip_ui_px(ui, STEP_HEIGHT) - dip_ui_px(ui, 1);
    const DipRect area = {rect.x + indent, y, cell * count,
                          rect.height - dip_ui_px(ui, NAME_HEIGHT)};
    const DipUiId id = DIP_UI_ID(DIP_UI_SETTINGS, ID_SETTINGS + setting);
    char why[320], tip[900], name[24];
    // The position under the pointer is that of the last event; the control says whether it counts.
    DipUiControl control = {.id = id, .rect = area, .takes_arrows = true, .takes_wheel = true};
    const int pointer_x = dip_ui_pointer_x(ui);
    const int under = dip_style_max(0, dip_style_min(count - 1, (pointer_x - area.x) / cell));
    is_valid(state, setting, step_at(setting, under), why, sizeof why);
    format_tip(window, setting, step_at(setting, under), why, tip, sizeof tip);
    control.tip = tip;
    const DipUiInput input = dip_ui_control(ui, &control);
    change_by(ui, window, setting, &input, under);
    if (!dip_ui_is_drawing(ui)) {
        return;
    }
    dip_ui_text(ui, NAME_SIZE, dip_style_white, DIP_ALIGN_LEFT, rect.x, rect.y, rect.width,
                short_title(setting));
    draw_values(ui, window, setting, (DipRect){rect.x, rect.y, rect.width, 0});
    dip_ui_fill(ui, (DipRect){area.x + cell / 2, y + height / 2, cell * (count - 1), 1},
                dip_style_line);
    const int price_y = y + dip_ui_px(ui, STEP_HEIGHT);
    dip_ui_text(ui, PRICE_SIZE, dip_style_dim, DIP_ALIGN_LEFT, rect.x, price_y, indent, "ms");
    dip_ui_text(ui, PRICE_SIZE, dip_style_dim, DIP_ALIGN_LEFT, rect.x,
                price_y + dip_ui_px(ui, PRICE_HEIGHT), indent, "FLIP");
    for (int i = 0; i < count; ++i) {
        const int step = step_at(setting, i);
        const int centre = area.x + cell * i + cell / 2;
        step_name(setting, step, name, sizeof name);
        const int width =
            dip_style_min(cell, dip_ui_text_width(ui, STEP_SIZE, name) + dip_ui_px(ui, 18));
        const bool valid = is_valid(state, setting, step, why, sizeof why);
        draw_pill(ui, (DipRect){centre - width / 2, y, width, height}, name,
                  state->quality[DIP_PANE_CURRENT].step[setting] == step,
                  state->quality[DIP_PANE_REQUESTED].step[setting] == step, valid,
                  input.hovered && under == i);
        draw_price(ui, window, setting, step, centre, price_y, cell);
    }
    if (input.focused) {
        const int away = dip_ui_px(ui, 2);
        dip_ui_outline(
            ui, (DipRect){area.x - away, y - 2 * away, area.width + 2 * away, height + 4 * away},
            height / 2, away, dip_style_focus);
    }
}

// --- a setting that is on or off -----------------------------------------------------------------

static void draw_switch(DipUi *ui, DipRect rect, bool current, bool requested, bool hovered) {
    const int radius = rect.height / 2, inset = dip_ui_px(ui, 3);
    const int side = rect.height - 2 * inset;
    dip_ui_fill_round(ui, rect, radius, requested ? dip_style_accent : dip_style_line);
    const int off_x = rect.x + inset, on_x = rect.x + rect.width - inset - side;
    dip_ui_fill_round(ui, (DipRect){requested ? on_x : off_x, rect.y + inset, side, side}, side / 2,
                      requested ? dip_style_on_accent : dip_style_white);
    if (current != requested) { // The ring shows where the current pane's knob is.
        dip_ui_outline(ui, (DipRect){current ? on_x : off_x, rect.y + inset, side, side}, side / 2,
                       dip_ui_px(ui, 2), current ? dip_style_white : dip_style_on_accent);
    }
    if (hovered) {
        dip_ui_outline(ui, rect, radius, 1, dip_style_white);
    }
}

static void declare_switch(DipUi *ui, DipWindow *window, DipSetting setting, DipRect rect) {
    const DipPreviewState *state = window->state;
    const bool current = state->quality[DIP_PANE_CURRENT].step[setting] != 0;
    const bool requested = state->quality[DIP_PANE_REQUESTED].step[setting] != 0;
    char tip[900], ms[32], flip[32];
    format_tip(window, setting, 1, "", tip, sizeof tip);
    const DipUiInput input =
        dip_ui_control(ui, &(DipUiControl){.id = DIP_UI_ID(DIP_UI_SETTINGS, ID_SETTINGS + setting),
                                           .rect = rect,
                                           .tip = tip,
                                           .takes_arrows = true,
                                           .takes_wheel = true});
    const bool to_on = input.steps > 0 || input.to_last, to_off = input.steps < 0 || input.to_first;
    if (input.pressed || (to_on && !requested) || (to_off && requested)) {
        dip_preview_set_step(window->state, setting, !requested, dip_ui_now_ns(ui));
    }
    const int knob_width = dip_ui_px(ui, 34), knob_height = dip_ui_px(ui, 16);
    const DipRect knob = {rect.x + rect.width - knob_width,
                          rect.y + (rect.height - knob_height) / 2, knob_width, knob_height};
    const int y = rect.y + (rect.height - dip_ui_line_height(ui, NAME_SIZE)) / 2;
    const int priced_step = setting == DIP_SETTING_GI ? 0 : 1;
    const DipPrice price =
        dip_prices_step(window->prices, setting, priced_step, &state->quality[DIP_PANE_REQUESTED]);
    dip_ui_text(ui, NAME_SIZE, dip_style_white, DIP_ALIGN_LEFT, rect.x, y, rect.width,
                short_title(setting));
    draw_switch(ui, knob, current, requested, input.hovered);
    if (setting == DIP_SETTING_MIPDEBUG) {
        snprintf(ms, sizeof ms, "a picture of its own");
        flip[0] = '\0';
    } else {
        char cost[24];
        format_ms(&price, cost, sizeof cost);
        const bool number = price.state != DIP_PRICE_UNKNOWN;
        snprintf(ms, sizeof ms, "%s%s%s", setting == DIP_SETTING_GI ? "off " : "", cost,
                 number ? " ms" : "");
        format_flip(&price, flip, sizeof flip);
    }
    const int gap = dip_ui_px(ui, 8);
    const int flip_width = flip[0] ? dip_ui_text_width(ui, PRICE_SIZE, flip) + gap : 0;
    const int price_y = rect.y + (rect.height - dip_ui_line_height(ui, PRICE_SIZE)) / 2;
    dip_ui_text(ui, PRICE_SIZE, flip_colour(&price), DIP_ALIGN_RIGHT, knob.x - gap, price_y,
                rect.width / 3, flip);
    dip_ui_text(ui, PRICE_SIZE, dip_style_soft, DIP_ALIGN_RIGHT, knob.x - gap - flip_width, price_y,
                rect.width / 2, ms);
    if (input.focused) {
        const int away = dip_ui_px(ui, 2);
        dip_ui_outline(ui,
                       (DipRect){knob.x - 2 * away, knob.y - 2 * away, knob.width + 4 * away,
                                 knob.height + 4 * away},
                       knob.height, away, dip_style_focus);
    }
}

static int setting_height(const DipUi *ui, DipSetting setting) {
    return dip_ui_px(ui, is_switch(setting) ? SWITCH_HEIGHT : SLIDER_HEIGHT);
}

static void declare_column(DipUi *ui, DipWindow *window, const DipSetting *settings, int count,
                           DipRect column) {
    int y = column.y;
    for (int i = 0; i < count; ++i) {
        const DipRect rect = {column.x, y, column.width, setting_height(ui, settings[i])};
        (is_switch(settings[i]) ? declare_switch : declare_slider)(ui, window, settings[i], rect);
        y += rect.height;
    }
}

// --- presets, the sum and its buttons ------------------------------------------------------------

static void declare_presets(DipUi *ui, DipWindow *window, DipRect rect, int columns) {
    const int gap = dip_ui_px(ui, 8);
    const int width = (rect.width - (columns - 1) * gap) / columns;
    const int height = dip_ui_px(ui, 28);
    for (int p = 0; p < DIP_PRESET_COUNT; ++p) {
        const DipRect button = {rect.x + p % columns * (width + gap),
                                rect.y + p / columns * (height + dip_ui_px(ui, 5)), width, height};
        const DipQuality quality = dip_preview_preset(window->state, (DipPreset)p);
        char tip[900];
        dip_preview_describe(&quality, false, tip, sizeof tip);
        const bool chosen =
            memcmp(&quality, &window->state->quality[DIP_PANE_REQUESTED], sizeof quality) == 0;
        if (dip_ui_button(ui, DIP_UI_ID(DIP_UI_SETTINGS, ID_PRESETS + p), button,
                          dip_preview_preset_name((DipPreset)p),
                          chosen ? DIP_UI_CHOSEN : DIP_UI_PLAIN, tip)) {
            dip_preview_act(window->state, DIP_ACTION_PRESET, p, false, dip_ui_now_ns(ui));
        }
    }
}

// Writes only the settings that differ from their defaults: "aa=4,af=16".
static void format_changes(const DipQuality *quality, char *text, size_t size_bytes) {
    size_t length = 0;
    text[0] = '\0';
    for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
        const DipSettingInfo *info = dip_setting_info((DipSetting)s);
        if (quality->step[s] != info->default_step && length < size_bytes) {
            length += (size_t)snprintf(text + length, size_bytes - length, "%s%s=%s",
                                       length ? "," : "", info->key, info->steps[quality->step[s]]);
        }
    }
    if (!length) {
        snprintf(text, size_bytes, "defaults");
    }
}

// Declares Apply, Undo and Copy text in a row.
static void declare_buttons(DipUi *ui, DipWindow *window, DipRect rect) {
    DipPreviewState *state = window->state;
    const int gap = dip_ui_px(ui, 6);
    const int width = (rect.width - 2 * gap) / 3;
    const DipRect apply = {rect.x, rect.y, rect.width - 2 * (width + gap), rect.height};
    const DipRect undo = {apply.x + apply.width + gap, rect.y, width, rect.height};
    const DipRect copy = {undo.x + width + gap, rect.y, width, rect.height};
    const bool same = memcmp(&state->quality[0], &state->quality[1], sizeof state->quality[0]) == 0;
    const int64_t now_ns = dip_ui_now_ns(ui);
    if (dip_ui_button(ui, DIP_UI_ID(DIP_UI_SETTINGS, ID_APPLY), apply, same ? "Same" : "Apply",
                      same ? DIP_UI_OFF : DIP_UI_PRIMARY,
                      same ? "Both panes have the same settings."
                           : "Gives the current pane the requested settings (Ctrl+Enter).")) {
        dip_preview_act(state, DIP_ACTION_APPLY, 0, false, now_ns);
    }
    if (dip_ui_button(ui, DIP_UI_ID(DIP_UI_SETTINGS, ID_UNDO), undo, "Undo",
                      state->undo_count ? DIP_UI_PLAIN : DIP_UI_OFF,
                      state->undo_count ? "Takes the last change back (Ctrl+Z)."
                                        : "There is no change to take back.")) {
        dip_preview_act(state, DIP_ACTION_UNDO, 0, false, now_ns);
    }
    if (dip_ui_button(ui, DIP_UI_ID(DIP_UI_SETTINGS, ID_COPY), copy, "Copy text", DIP_UI_PLAIN,
                      "Copies the requested settings as text (Ctrl+C).")) {
        state->copy_settings = true;
    }
}

static void draw_sum(DipUi *ui, const DipWindow *window, DipRect rect) {
    const DipPriceSum sum =
        dip_prices_sum(window->prices, &window->state->quality[DIP_PANE_REQUESTED]);
    const DipPriceSum now =
        dip_prices_sum(window->prices, &window->state->quality[DIP_PANE_CURRENT]);
    char text[160];
    if (sum.state == DIP_PRICE_UNKNOWN) {
        snprintf(text, sizeof text, "%.1f ms", window->figures[DIP_PANE_REQUESTED].ms);
        dip_ui_text(ui, SUM_SIZE, dip_style_accent, DIP_ALIGN_LEFT, rect.x, rect.y, rect.width,
                    text);
        dip_ui_text(ui, PRICE_SIZE, dip_style_dim, DIP_ALIGN_LEFT, rect.x,
                    rect.y + dip_ui_px(ui, 30), rect.width, "the requested pane's frame now");
        return;
    }
    snprintf(text, sizeof text, "%s%.1f ms", sum.state == DIP_PRICE_ROUGH ? "~" : "", sum.ms);
    dip_ui_text(ui, SUM_SIZE, dip_style_accent, DIP_ALIGN_LEFT, rect.x, rect.y, rect.width, text);
    const int width = dip_ui_text_width(ui, SUM_SIZE, text) + dip_ui_px(ui, 8);
    snprintf(text, sizeof text, "%.1f to %.1f", sum.ms_low, sum.ms_high);
    dip_ui_text(ui, PRICE_SIZE, dip_style_soft, DIP_ALIGN_LEFT, rect.x + width,
                rect.y + dip_ui_px(ui, 10), rect.width - width, text);
    const int y = rect.y + dip_ui_px(ui, 30);
    if (sum.has_flip && now.has_flip && now.flip > 0.0) {
        snprintf(text, sizeof text, "now %.1f ms   FLIP %.4f \u2192 %.4f   %+.0f %%", now.ms,
                 now.flip, sum.flip, 100.0 * (sum.flip / now.flip - 1.0));
    } else {
        snprintf(text, sizeof text, "now %.1f ms", now.ms);
    }
    dip_ui_text(ui, PRICE_SIZE, dip_style_soft, DIP_ALIGN_LEFT, rect.x, y, rect.width, text);
}

// Draws the parts of the sum on one scale with the budget of 16.6 ms.
static void draw_budget(DipUi *ui, const DipWindow *window, DipRect rect) {
    static const DipColour colours[4] = {
        {139, 149, 162, 255}, {255, 190, 92, 255}, {240, 140, 58, 255}, {255, 226, 143, 255}};
    const double budget_ms = 16.6;
    const DipPriceSum sum =
        dip_prices_sum(window->prices, &window->state->quality[DIP_PANE_REQUESTED]);
    dip_ui_fill(ui, rect, dip_style_well);
    const double whole_ms =
        sum.state == DIP_PRICE_UNKNOWN ? window->figures[DIP_PANE_REQUESTED].ms : sum.ms;
    const double end_ms = fmax(budget_ms * 1.2, whole_ms * 1.05);
    double from_ms = 0.0;
    const double base_ms = sum.state == DIP_PRICE_UNKNOWN ? whole_ms : sum.base_ms;
    for (int s = -1; s < DIP_SETTING_COUNT; ++s) {
        const double ms = s < 0 ? base_ms : sum.parts_ms[s];
        if (ms <= 0.0) {
            continue;
        }
        const int x0 = rect.x + (int)(from_ms / end_ms * rect.width);
        const int x1 = rect.x + (int)((from_ms + ms) / end_ms * rect.width);
        const int colour = s < 0 ? 0 : s == DIP_SETTING_AA ? 1 : s == DIP_SETTING_AF ? 3 : 2;
        dip_ui_fill(ui, (DipRect){x0, rect.y, dip_style_max(1, x1 - x0 - 1), rect.height},
                    colours[colour]);
        from_ms += ms;
    }
    const int x = rect.x + (int)(budget_ms / end_ms * rect.width);
    dip_ui_fill(ui,
                (DipRect){x, rect.y - dip_ui_px(ui, 4), dip_ui_px(ui, 2),
                          rect.height + 2 * dip_ui_px(ui, 4)},
                whole_ms > budget_ms ? dip_style_worse : dip_style_white);
    dip_ui_text(ui, PRICE_SIZE, dip_style_soft, DIP_ALIGN_RIGHT, x, rect.y - dip_ui_px(ui, 17),
                rect.width, "16.6 ms");
}

static void declare_sum(DipUi *ui, DipWindow *window, DipRect rect) {
    char text[200];
    draw_sum(ui, window, rect);
    draw_budget(ui, window,
                (DipRect){rect.x, rect.y + dip_ui_px(ui, 66), rect.width, dip_ui_px(ui, 16)});
    declare_buttons(ui, window,
                    (DipRect){rect.x, rect.y + dip_ui_px(ui, 96), rect.width, dip_ui_px(ui, 28)});
    format_changes(&window->state->quality[DIP_PANE_REQUESTED], text, sizeof text);
    dip_ui_text(ui, PRICE_SIZE, dip_style_white, DIP_ALIGN_LEFT, rect.x,
                rect.y + dip_ui_px(ui, 132), rect.width, text);
    const bool stale = dip_prices_source(window->prices, window->frames[0].width,
                                         window->frames[0].height, text, sizeof text);
    dip_ui_text(ui, PRICE_SIZE, stale ? dip_style_worse : dip_style_dim, DIP_ALIGN_LEFT, rect.x,
                rect.y + dip_ui_px(ui, 150), rect.width, text);
}

// --- the tab
// ---------------------------------------------------------------------------------------

static const DipSetting columns[3][4] = {
    {DIP_SETTING_AA, DIP_SETTING_TAA, DIP_SETTING_AAA, DIP_SETTING_ASD},
    {DIP_SETTING_AF, DIP_SETTING_AAF, DIP_SETTING_OPT},
    {DIP_SETTING_MIPLOD, DIP_SETTING_GI, DIP_SETTING_MIPDEBUG}};
static const int column_counts[3] = {4, 3, 3};

// Declares a setting as one line of a narrow list, whose click takes the next step.
static void declare_line(DipUi *ui, DipWindow *window, DipSetting setting, DipRect rect) {
    char tip[900];
    format_tip(window, setting, window->state->quality[DIP_PANE_REQUESTED].step[setting], "", tip,
               sizeof tip);
    const DipUiInput input =
        dip_ui_control(ui, &(DipUiControl){.id = DIP_UI_ID(DIP_UI_SETTINGS, ID_SETTINGS + setting),
                                           .rect = rect,
                                           .tip = tip,
                                           .takes_arrows = true,
                                           .takes_wheel = true});
    if (input.pressed) {
        dip_preview_act(window->state, DIP_ACTION_SETTING, (int)setting, false, dip_ui_now_ns(ui));
    } else {
        DipUiInput rest = input;
        rest.began = rest.moved = false;
        change_by(ui, window, setting, &rest, 0);
    }
    if (input.hovered || input.focused) {
        dip_ui_fill(ui, rect, dip_style_raised);
    }
    const int y = rect.y + (rect.height - dip_ui_line_height(ui, STEP_SIZE)) / 2;
    const int pad = dip_ui_px(ui, 6);
    dip_ui_text(ui, STEP_SIZE, dip_style_white, DIP_ALIGN_LEFT, rect.x + pad, y, rect.width / 2,
                short_title(setting));
    draw_values(ui, window, setting, (DipRect){rect.x, y, rect.width - pad, 0});
    if (input.focused) {
        dip_ui_outline(ui, rect, 0, dip_ui_px(ui, 2), dip_style_focus);
    }
}

// Declares the drawer of small windows: a list of all settings with Apply and Undo at its end.
static void declare_list(DipUi *ui, DipWindow *window, DipRect body) {
    const int buttons = dip_ui_px(ui, 30);
    const int height =
        dip_style_min(dip_ui_px(ui, LIST_HEIGHT), (body.height - buttons) / DIP_SETTING_COUNT);
    for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
        declare_line(ui, window, (DipSetting)s,
                     (DipRect){body.x, body.y + s * height, body.width, height});
    }
    const int pad = dip_ui_px(ui, 4);
    declare_buttons(ui, window,
                    (DipRect){body.x + pad, body.y + DIP_SETTING_COUNT * height + pad,
                              body.width - 2 * pad,
                              dip_style_min(dip_ui_px(ui, 26),
                                            body.height - DIP_SETTING_COUNT * height - pad)});
}

void dip_tab_settings(DipUi *ui, DipWindow *window, DipRect body) {
    const int pad = dip_ui_px(ui, 10), gap = dip_ui_px(ui, COLUMN_GAP);
    const int sum_width = dip_ui_px(ui, SUM_WIDTH);
    const int width = (body.width - 2 * pad - sum_width - 3 * gap) / 3;
    if (window->layout->side == DIP_DOCK_DRAWER || width < dip_ui_px(ui, 200)) {
        declare_list(ui, window, body);
        return;
    }
    const int top = body.y + dip_ui_px(ui, 6);
    for (int c = 0; c < 3; ++c) {
        const DipRect column = {body.x + pad + c * (width + gap), top, width, body.height};
        declare_column(ui, window, columns[c], column_counts[c], column);
    }
    const int presets_y = top + dip_ui_px(ui, SLIDER_HEIGHT + 2 * SWITCH_HEIGHT + 8);
    declare_presets(ui, window, (DipRect){body.x + pad + 2 * (width + gap), presets_y, width, 0},
                    3);
    declare_sum(ui, window,
                (DipRect){body.x + body.width - pad - sum_width, top, sum_width, body.height});
}
