// Declares the controls of settings: the entries of the list, the editor with the price of each
// step (value) of the open setting, and the lines of the list in a narrow or low tab.
#include "app/files/put.h"
#include "app/preview/prices/price_text.h"
#include "app/preview/tabs/tabs.h"
#include "app/ui/layout.h"
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
    LABELS_WIDTH = 32, // Room for "ms" and "FLIP" left of the prices.
    PILL_LEAST_WIDTH = 34,
    BAR_LENGTH = 40,
    BAR_ALPHA = 150
};

static DipUiId id_of(DipSetting setting) {
    return DIP_UI_ID(DIP_UI_SETTINGS, DIP_ID_FIRST_SETTING + (int)setting);
}

static int step_of(const DipPreviewState *state, int pane, DipSetting setting) {
    return state->quality[pane].step[setting];
}

// Returns what a setting needs to have an effect and lacks: something in the scene, or another
// setting of the edited pane. Returns NULL if the setting has an effect.
static const char *needs_of(const DipPreviewState *state, DipSetting setting) {
    return setting == DIP_SETTING_SHADOWS && state->lacks_shadows
               ? "needs a directional light"
               : dip_quality_needs(&state->quality[dip_preview_edited_pane(state)], setting);
}

static DipPrice price_of(const DipWindow *window, DipSetting setting, int step) {
    if (setting == DIP_SETTING_SHADOWS && window->state->lacks_shadows) {
        return (DipPrice){.needs_company = true, .needs = "a directional light"};
    }
    return dip_prices_step(window->prices, setting, step,
                           &window->state->quality[DIP_PANE_REQUESTED]);
}

static bool is_known(const DipPrice *price) {
    return price->state != DIP_PRICE_UNKNOWN && price->state != DIP_PRICE_BASE;
}

// Returns whether a price is known well enough for a bar that compares it with other prices.
static bool has_bar(const DipPrice *price) {
    return is_known(price) && dip_price_trust(price) == DIP_PRICE_TRUST_KNOWN;
}

static DipColour flip_colour(const DipPrice *price) {
    return !price->has_flip || price->state == DIP_PRICE_BASE || price->flip == 0.0 ? dip_style_dim
           : price->flip < 0.0                                                      ? dip_style_gain
                               : dip_style_worse;
}

// Returns whether a step is valid together with the other settings of the edited pane. If the step
// is not valid, writes why. Every step of antialiasing is valid: if its samples cannot be divided
// into the groups of adaptive antialiasing, choosing the step also sets the group size to its
// default.
static bool is_valid(const DipPreviewState *state, DipSetting setting, int step, char why[256]) {
    DipQuality quality = state->quality[dip_preview_edited_pane(state)];
    DipError err;
    why[0] = '\0';
    quality.step[setting] = (uint8_t)step;
    if (setting == DIP_SETTING_AA || dip_quality_check(&quality, &err)) {
        return true;
    }
    snprintf(why, 256, "%.250s", err.message);
    return false;
}

// Draws "none → 4x", the current and the requested step, at the right end of a row. Draws the
// requested step alone if both steps are the same or there is no room for both.
static void draw_values(DipUi *ui, const DipPreviewState *state, DipSetting setting, int size,
                        DipRect row) {
    const char *const *labels = dip_setting_info(setting)->labels;
    const int from = step_of(state, DIP_PANE_CURRENT, setting);
    const int to = step_of(state, DIP_PANE_REQUESTED, setting);
    char text[32];
    snprintf(text, sizeof text, "%s \u2192 ", labels[from]);
    dip_ui_label(ui, size, from != to ? dip_style_accent : dip_style_soft, DIP_ALIGN_RIGHT, row,
                 labels[to]);
    dip_cut_right(&row, dip_ui_text_width(ui, size, labels[to]));
    if (from != to && dip_ui_text_width(ui, size, text) <= row.width) {
        dip_ui_label(ui, size, dip_style_soft, DIP_ALIGN_RIGHT, row, text);
    }
}

// Changes a setting by what the user did with the setting's control. pointed: position of the step
// under the pointer, in the order of dip_setting_step_at.
static void change_by(DipUi *ui, DipWindow *window, DipSetting setting, const DipUiInput *input,
                      int pointed) {
    DipPreviewState *state = window->state;
    const int count = dip_setting_info(setting)->step_count;
    const int now =
        dip_setting_step_at(setting, step_of(state, dip_preview_edited_pane(state), setting));
    int wanted = now;
    if (input->began || (input->held && input->moved)) {
        wanted = pointed;
    } else if (input->steps) {
        wanted = now + input->steps;
        char why[256]; // Steps that are not valid are skipped.
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
    DipRect cells; // Where the steps and their prices lie.
    int cell_width;
    int count;   // Number of steps.
    int pointed; // Position of the step under the pointer.
    DipUiInput input;
    DipPrice prices[DIP_MAX_STEPS]; // Prices of the steps by their position.
    double most_ms;   // The greatest absolute time of a price, which has the longest bar.
    double most_flip; // The greatest absolute change of FLIP, which has the longest bar.
    bool rough;       // Some prices are rough, so the word "ms" gets a mark.
    bool dimmed;      // The setting has no effect in this scene or with the pane's other settings.
} Slider;

// Draws a bar at the foot of a price. The bar's length is proportional to the absolute value of
// `value`; the value `most` has the longest bar.
static void draw_bar(DipUi *ui, DipRect cell, double value, double most, DipColour colour,
                     bool requested) {
    const int longest = dip_ui_px(ui, BAR_LENGTH);
    const int length = most > 0.0 ? (int)(longest * fabs(value) / most + 0.5) : 0;
    colour.alpha = requested ? 255 : BAR_ALPHA;
    dip_ui_fill(ui,
                (DipRect){cell.x + cell.width / 2 - longest / 2,
                          dip_rect_bottom(cell) - dip_ui_px(ui, 3), length, dip_ui_px(ui, 2)},
                colour);
}

// Draws a step's time and error, one above the other. cell: where the time lies.
static void draw_price(DipUi *ui, const DipPreviewState *state, const Slider *slider, int position,
                       DipRect cell) {
    const DipPrice *price = &slider->prices[position];
    const bool requested = dip_setting_step_at(slider->setting, position) ==
                           step_of(state, DIP_PANE_REQUESTED, slider->setting);
    const size_t mark_bytes = strlen(DIP_ROUGH_MARK);
    const bool costs = has_bar(price);
    char text[DIP_STEP_NAME_BYTES];
    dip_price_ms_text(price, state->budget_ms, text);
    const bool marked = costs && strncmp(text, DIP_ROUGH_MARK, mark_bytes) == 0;
    dip_ui_text(ui, PRICE_SIZE,
                !costs      ? dip_style_dim
                : requested ? dip_style_white
                            : dip_style_soft,
                DIP_ALIGN_CENTRE, cell.x + cell.width / 2, cell.y, cell.width,
                text + (marked ? mark_bytes : 0));
    if (costs) {
        draw_bar(ui, cell, price->ms, slider->most_ms, dip_style_accent, requested);
    }
    cell.y += cell.height;
    dip_price_flip_text(price, text);
    dip_ui_text(ui, PRICE_SIZE, flip_colour(price), DIP_ALIGN_CENTRE, cell.x + cell.width / 2,
                cell.y, cell.width, text);
    if (is_known(price) && price->has_flip) {
        draw_bar(ui, cell, price->flip, slider->most_flip, flip_colour(price), requested);
    }
}

// Draws a step as a pill: filled if the requested pane has this step, with a white outline if the
// current pane has it.
static void draw_pill(DipUi *ui, const DipPreviewState *state, const Slider *slider, int position,
                      DipRect cell) {
    const int step = dip_setting_step_at(slider->setting, position);
    const bool current = step == step_of(state, DIP_PANE_CURRENT, slider->setting);
    const bool requested = step == step_of(state, DIP_PANE_REQUESTED, slider->setting);
    const bool hovered = slider->input.hovered && slider->pointed == position;
    const char *name = dip_setting_info(slider->setting)->labels[step];
    char why[256];
    const bool valid = is_valid(state, slider->setting, step, why);
    const int wanted = dip_max(dip_ui_px(ui, PILL_LEAST_WIDTH),
                               dip_ui_text_width(ui, STEP_SIZE, name) + dip_ui_px(ui, 14));
    const int width = dip_min(cell.width, wanted), radius = cell.height / 2;
    const DipRect pill = {cell.x + cell.width / 2 - width / 2, cell.y, width, cell.height};
    dip_ui_fill_round(ui, pill, radius,
                      requested ? dip_style_accent
                      : valid   ? dip_style_raised
                                : dip_style_dock);
    if (current) {
        dip_ui_outline(ui, pill, radius, dip_ui_px(ui, 2), dip_style_white);
    } else if (!requested && (hovered || !valid)) {
        dip_ui_outline(ui, pill, radius, dip_ui_px(ui, 1), valid ? dip_style_soft : dip_style_line);
    }
    dip_ui_label(ui, STEP_SIZE,
                 requested                  ? dip_style_on_accent
                 : valid && !slider->dimmed ? dip_style_soft
                                            : dip_style_off,
                 DIP_ALIGN_CENTRE, pill, name);
    if (step == step_of(state, dip_preview_edited_pane(state), slider->setting)) {
        dip_ui_focus_ring(ui, pill, radius, &slider->input);
    }
}

// Draws the steps with their prices in the slider's cells, and the words "ms" and "FLIP" left of
// the cells.
static void draw_steps(DipUi *ui, const DipPreviewState *state, const Slider *slider) {
    const DipRect cells = slider->cells;
    const int pill = dip_ui_px(ui, STEP_HEIGHT), price = dip_ui_px(ui, PRICE_HEIGHT);
    const int price_y = cells.y + pill + dip_ui_px(ui, 1), thick = dip_ui_px(ui, 2);
    dip_ui_fill(ui,
                (DipRect){cells.x + slider->cell_width / 2, cells.y + (pill - thick) / 2,
                          slider->cell_width * (slider->count - 1), thick},
                dip_style_line);
    DipRect names = {slider->rect.x, price_y, cells.x - slider->rect.x, 0};
    dip_ui_text(ui, PRICE_SIZE, dip_style_dim, DIP_ALIGN_LEFT, names.x, price_y, names.width,
                slider->rough ? DIP_ROUGH_MARK "ms" : "ms");
    dip_ui_text(ui, PRICE_SIZE, dip_style_dim, DIP_ALIGN_LEFT, names.x, price_y + price,
                names.width, "FLIP");
    for (int i = 0; i < slider->count; ++i) {
        DipRect cell = dip_rect_cell(cells, slider->count, pill, 0, 0, i);
        draw_pill(ui, state, slider, i, cell);
        cell.y = price_y;
        cell.height = price;
        draw_price(ui, state, slider, i, cell);
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

// Makes the slider of a setting, whose steps lie in `rect`.
static Slider make_slider(DipUi *ui, DipWindow *window, DipSetting setting, DipRect rect) {
    const int indent = dip_ui_px(ui, LABELS_WIDTH);
    Slider slider = {.setting = setting, .rect = rect};
    slider.count = dip_setting_info(setting)->step_count;
    slider.cell_width = dip_max(1, (rect.width - indent) / slider.count);
    slider.cells =
        (DipRect){rect.x + indent, rect.y, slider.cell_width * slider.count, rect.height};
    slider.dimmed = needs_of(window->state, setting) != NULL;
    const int under = (dip_ui_pointer_x(ui) - slider.cells.x) / slider.cell_width;
    slider.pointed = dip_max(0, dip_min(slider.count - 1, under));
    return slider;
}

// --- the editor ----------------------------------------------------------------------------------

// Draws a setting's name, its key (such as "aa"), what it needs, and its steps in both panes.
static void draw_head(DipUi *ui, const DipPreviewState *state, DipSetting setting, DipRect head) {
    const DipSettingInfo *info = dip_setting_info(setting);
    const char *needs = needs_of(state, setting);
    const int gap = dip_ui_px(ui, 8);
    dip_ui_word(ui, NAME_SIZE, dip_style_white, &head, gap,
                setting == DIP_SETTING_ASD ? "Samples per adaptive group" : info->title);
    dip_ui_word(ui, PRICE_SIZE, dip_style_dim, &head, gap, info->key);
    if (needs) {
        dip_ui_word(ui, PRICE_SIZE, dip_style_accent, &head, gap, needs);
    }
    draw_values(ui, state, setting, STEP_SIZE, head);
}

// Declares a button that plays the camera path made to show the setting. The button is cut from the
// right end of *head. There is no button if there is no such path, if this path plays already, if a
// scene of the gallery shows, or if the setting has no effect.
static void declare_path(DipUi *ui, DipWindow *window, DipSetting setting, DipRect *head) {
    DipPreviewState *state = window->state;
    const int category = dip_preview_category_of(setting);
    const DipCamPath *path = category < 0 ? NULL : state->track->categories[category].path;
    if (!path || path == dip_preview_playing_path(state) || state->scene_title ||
        needs_of(state, setting)) {
        return;
    }
    const DipRect rect =
        dip_cut_right(head, dip_ui_text_width(ui, NAME_SIZE, "Its path") + dip_ui_px(ui, 10));
    dip_cut_right(head, dip_ui_px(ui, 8));
    if (dip_ui_button(ui, DIP_UI_ID(DIP_UI_SETTINGS, DIP_ID_PATH), rect, "Its path", DIP_UI_PLAIN,
                      "Plays the camera path that was made to show this setting (0 to 9).")) {
        dip_preview_act(state, DIP_ACTION_PATH, category, false, dip_ui_now_ns(ui));
    }
}

// Adds to a note how many pixels a step of the render scale draws.
static void add_drawn_size(const DipPreviewState *state, int step, char note[DIP_STEP_TEXT_BYTES]) {
    DipQuality quality = state->quality[dip_preview_edited_pane(state)];
    quality.step[DIP_SETTING_SCALE] = (uint8_t)step;
    if (state->pane_width > 0) {
        dip_put_append(note, DIP_STEP_TEXT_BYTES, "\nDraws %d x %d pixels.",
                       dip_quality_drawn_size(&quality, state->pane_width),
                       dip_quality_drawn_size(&quality, state->pane_height));
    }
}

// Writes what a step of the open setting does, what it costs, and why it cannot be chosen.
static void write_note(const DipWindow *window, DipSetting setting, int step,
                       char note[DIP_STEP_TEXT_BYTES]) {
    const DipPrice price = price_of(window, setting, step);
    char why[256];
    is_valid(window->state, setting, step, why);
    dip_step_tip(setting, step, &price, window->state->budget_ms, why, note);
    if (setting == DIP_SETTING_SCALE) {
        add_drawn_size(window->state, step, note);
    }
}

void dip_setting_editor_declare(DipUi *ui, DipWindow *window, DipRect rect) {
    const DipPreviewState *state = window->state;
    const DipSetting setting = state->open_setting;
    const int pad = dip_ui_px(ui, 10);
    const int steps_height = dip_ui_px(ui, STEP_HEIGHT) + 2 * dip_ui_px(ui, PRICE_HEIGHT);
    const bool has_note =
        rect.height >= 2 * pad + steps_height + dip_ui_px(ui, NAME_HEIGHT + 2 * PRICE_HEIGHT);
    dip_ui_fill_round(ui, rect, dip_ui_px(ui, 4), dip_style_editor);
    DipRect rest = dip_rect_inset(rect, pad, has_note ? dip_ui_px(ui, 7) : dip_ui_px(ui, 3));
    DipRect head = dip_cut_top(&rest, dip_ui_px(ui, NAME_HEIGHT));
    dip_cut_top(&rest, dip_ui_px(ui, has_note ? 6 : 2));
    Slider slider = make_slider(ui, window, setting, dip_cut_top(&rest, steps_height));
    char note[DIP_STEP_TEXT_BYTES];
    write_note(window, setting, dip_setting_step_at(setting, slider.pointed), note);
    slider.input =
        dip_ui_control(ui, &(DipUiControl){.id = DIP_UI_ID(DIP_UI_SETTINGS, DIP_ID_EDITOR),
                                           .rect = slider.cells,
                                           .tip = has_note ? NULL : note,
                                           .skips_focus = true,
                                           .takes_wheel = true});
    change_by(ui, window, setting, &slider.input, slider.pointed);
    declare_path(ui, window, setting, &head);
    if (!dip_ui_is_drawing(ui)) {
        return;
    }
    find_prices(window, &slider);
    draw_head(ui, state, setting, head);
    draw_steps(ui, state, &slider);
    if (has_note) { // The note is about the step under the pointer, or else about the requested
                    // step.
        if (!slider.input.hovered) {
            write_note(window, setting, step_of(state, DIP_PANE_REQUESTED, setting), note);
        }
        dip_cut_top(&rest, dip_ui_px(ui, 5));
        dip_ui_fill(ui, dip_cut_top(&rest, 1), dip_style_line);
        dip_cut_top(&rest, dip_ui_px(ui, 4));
        dip_ui_text_block(ui, PRICE_SIZE, dip_style_soft, rest, note);
    }
}

// --- an entry of the list ------------------------------------------------------------------------

void dip_setting_entry_declare(DipUi *ui, DipWindow *window, DipSetting setting, DipRect rect) {
    DipPreviewState *state = window->state;
    const int requested = step_of(state, DIP_PANE_REQUESTED, setting);
    const char *needs = needs_of(state, setting);
    DipUiInput input = dip_ui_stepper(ui, id_of(setting), rect, NULL);
    if (input.began || input.focused) {
        state->open_setting = setting;
    }
    input.began = input.moved = input.pressed = false;
    change_by(ui, window, setting, &input, 0);
    if (!dip_ui_is_drawing(ui)) {
        return;
    }
    const bool open = state->open_setting == setting;
    const int pad = dip_ui_px(ui, 6);
    const bool changed = step_of(state, DIP_PANE_CURRENT, setting) != requested;
    if (open || input.hovered) {
        dip_ui_fill(ui, rect, open ? dip_style_row : dip_style_raised);
    }
    if (open) {
        dip_ui_fill(ui, (DipRect){rect.x, rect.y, dip_ui_px(ui, 2), rect.height}, dip_style_white);
    }
    DipRect rest = dip_rect_inset(rect, pad, 0);
    const DipPrice price = price_of(window, setting, requested);
    if (has_bar(&price) && rect.width >= dip_ui_px(ui, 180)) {
        char ms[DIP_STEP_NAME_BYTES];
        dip_price_ms_text(&price, state->budget_ms, ms);
        dip_ui_label(ui, PRICE_SIZE, dip_style_soft, DIP_ALIGN_RIGHT,
                     dip_cut_right(&rest, dip_ui_px(ui, 42)), ms);
    }
    // Shows the whole name if it takes at most half of the row, so that the steps mostly fit beside
    // it.
    const DipSettingInfo *info = dip_setting_info(setting);
    const bool whole = dip_ui_text_width(ui, STEP_SIZE, info->title) <= rest.width / 2;
    dip_ui_word(ui, STEP_SIZE,
                needs     ? dip_style_dim
                : changed ? dip_style_white
                          : dip_style_soft,
                &rest, pad, whole ? info->title : info->short_title);
    if (needs && dip_ui_text_width(ui, PRICE_SIZE, needs) <= rest.width) {
        dip_ui_label(ui, PRICE_SIZE, dip_style_dim, DIP_ALIGN_RIGHT, rest, needs);
    } else {
        draw_values(ui, state, setting, STEP_SIZE, rest);
    }
    dip_ui_focus_ring(ui, rect, 0, &input);
}

// --- a line of a list ----------------------------------------------------------------------------

void dip_setting_line_declare(DipUi *ui, DipWindow *window, DipSetting setting, DipRect rect) {
    const int requested = step_of(window->state, DIP_PANE_REQUESTED, setting);
    const DipPrice price = price_of(window, setting, requested);
    const char *title = dip_setting_info(setting)->short_title;
    char tip[DIP_STEP_TEXT_BYTES], ms[DIP_STEP_NAME_BYTES] = "";
    dip_step_tip(setting, requested, &price, window->state->budget_ms, "", tip);
    DipUiInput input = dip_ui_stepper(ui, id_of(setting), rect, tip);
    const int title_end = rect.x + dip_ui_px(ui, 10) + dip_ui_text_width(ui, LINE_SIZE, title);
    // Between the title's end and the line's right end, a click in the left half goes one step
    // back.
    if (input.pressed) {
        const bool back = input.hovered && input.x >= title_end &&
                          input.x < (title_end + dip_rect_right(rect)) / 2;
        dip_preview_act(window->state, DIP_ACTION_SETTING, (int)setting, back, dip_ui_now_ns(ui));
    }
    input.began = input.moved = input.pressed = false;
    change_by(ui, window, setting, &input, 0);
    const bool marked = input.hovered || input.focused;
    const int pad = dip_ui_px(ui, 5);
    const int size = rect.height < dip_ui_line_height(ui, LINE_SIZE) ? LINE_SIZE - 2 : LINE_SIZE;
    const int price_width = dip_ui_text_width(ui, size, DIP_ROUGH_MARK "+88.8");
    const int arrow = dip_ui_text_width(ui, size, "\u203a") + pad;
    if (marked) {
        dip_ui_fill(ui, rect, dip_style_raised);
    }
    if (is_known(&price)) {
        dip_price_ms_text(&price, window->state->budget_ms, ms);
    }
    DipRect rest = dip_rect_inset(rect, pad, 0);
    dip_ui_label(ui, size, dip_style_soft, DIP_ALIGN_RIGHT, dip_cut_right(&rest, price_width), ms);
    DipRect after = dip_cut_right(&rest, arrow);
    dip_ui_word(ui, size, dip_style_white, &rest, pad, title);
    const DipRect before = dip_cut_left(&rest, arrow);
    draw_values(ui, window->state, setting, size, rest);
    if (marked) {
        after.x += pad / 2;
        dip_ui_label(ui, size, dip_style_dim, DIP_ALIGN_LEFT, after, "\u203a");
        dip_ui_label(ui, size, dip_style_dim, DIP_ALIGN_LEFT, before, "\u2039");
    }
    if (input.focused) {
        dip_ui_outline(ui, rect, 0, dip_ui_px(ui, 2), dip_style_focus);
    }
}
