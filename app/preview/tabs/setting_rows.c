// Declares the controls of settings. A slider shows the price of each step (value) of its setting.
// Settings with two steps are switches. In a narrow list, each setting takes one line.
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
    SLIDER_GAP = 5, // Room below a slider.
    SWITCH_HEIGHT = 26,
    LABELS_WIDTH = 32, // Room for "ms" and "FLIP" left of the prices.
    PILL_LEAST_WIDTH = 34,
    LINE_CELL_WIDTH = 44, // Width of a step of a slider in one line.
    BAR_LENGTH = 40,
    BAR_ALPHA = 150
};

static DipUiId id_of(DipSetting setting) {
    return DIP_UI_ID(DIP_UI_SETTINGS, DIP_ID_FIRST_SETTING + (int)setting);
}

// Returns the pane that the controls edit: the requested pane, unless the user edits only the
// current pane.
static int edited_pane(const DipPreviewState *state) {
    return state->edited[DIP_PANE_REQUESTED] ? DIP_PANE_REQUESTED : DIP_PANE_CURRENT;
}

static int step_of(const DipPreviewState *state, int pane, DipSetting setting) {
    return state->quality[pane].step[setting];
}

// Returns whether the setting has no effect beside the other settings of the pane that is edited.
static bool is_dimmed(const DipPreviewState *state, DipSetting setting) {
    return dip_quality_needs(&state->quality[edited_pane(state)], setting) != NULL;
}

static DipPrice price_of(const DipWindow *window, DipSetting setting, int step) {
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

// Returns whether the edited pane can have a step beside its other settings. If it cannot, writes
// why. Every step of antialiasing is valid, since the group size of adaptive antialiasing follows
// the number of samples.
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

// Draws "none -> 4x", the current and the requested step, at the right end of a row.
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

// Changes a setting by what the user did with its control. pointed: position of the step under the
// pointer, in the order of dip_setting_step_at.
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
        char why[256]; // Skips steps that are not valid.
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
    double most_ms;                 // The greatest time of a price, which has the longest bar.
    double most_flip;               // The greatest change of FLIP.
    bool rough;  // Some prices come from a few frames only. A mark before all prices says so.
    bool dimmed; // The setting has no effect beside the pane's other settings.
} Slider;

// Draws a bar at the foot of a price. The length of the bar is proportional to `value`, and the
// value `most` has the longest bar.
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
static void draw_price(DipUi *ui, const Slider *slider, int position, bool requested,
                       DipRect cell) {
    const DipPrice *price = &slider->prices[position];
    const size_t mark_bytes = strlen(DIP_ROUGH_MARK);
    const bool costs = has_bar(price);
    char text[DIP_STEP_NAME_BYTES];
    dip_price_ms_text(price, text);
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

// Returns a step's label as long as the labels of all steps fit into cells of this width; otherwise
// its narrow label.
static const char *label_of(DipUi *ui, DipSetting setting, int step, int cell_width) {
    const DipSettingInfo *info = dip_setting_info(setting);
    bool fit = true;
    for (int i = 0; i < info->step_count; ++i) {
        fit = fit && dip_ui_text_width(ui, STEP_SIZE, info->labels[i]) <= cell_width;
    }
    return fit ? info->labels[step] : info->narrow_labels[step];
}

// Draws a step as a pill: filled if the requested pane has it, with a white outline if the current
// pane has it.
static void draw_pill(DipUi *ui, const DipPreviewState *state, const Slider *slider, int position,
                      DipRect cell) {
    const int step = dip_setting_step_at(slider->setting, position);
    const bool current = step == step_of(state, DIP_PANE_CURRENT, slider->setting);
    const bool requested = step == step_of(state, DIP_PANE_REQUESTED, slider->setting);
    const bool hovered = slider->input.hovered && slider->pointed == position;
    const char *name = label_of(ui, slider->setting, step, slider->cell_width);
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
    dip_ui_text(ui, STEP_SIZE,
                requested                  ? dip_style_on_accent
                : valid && !slider->dimmed ? dip_style_soft
                                           : dip_style_off,
                DIP_ALIGN_CENTRE, cell.x + cell.width / 2,
                cell.y + (cell.height - dip_ui_line_height(ui, STEP_SIZE)) / 2, width, name);
    if (step == step_of(state, edited_pane(state), slider->setting)) {
        dip_ui_focus_ring(ui, pill, radius, &slider->input);
    }
}

static void draw_slider(DipUi *ui, const DipPreviewState *state, const Slider *slider) {
    const DipRect cells = slider->cells;
    const int pill = dip_ui_px(ui, STEP_HEIGHT), price = dip_ui_px(ui, PRICE_HEIGHT);
    const int price_y = cells.y + pill + dip_ui_px(ui, 1), thick = dip_ui_px(ui, 2);
    const char *title = dip_setting_info(slider->setting)->title;
    DipRect head = slider->rect;
    dip_ui_text(ui, NAME_SIZE, slider->dimmed ? dip_style_dim : dip_style_white, DIP_ALIGN_LEFT,
                head.x, head.y, head.width, title);
    dip_cut_left(&head, dip_ui_text_width(ui, NAME_SIZE, title) + dip_ui_px(ui, 8));
    head.height = dip_ui_line_height(ui, STEP_SIZE);
    draw_values(ui, state, slider->setting, STEP_SIZE, head);
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
        draw_price(ui, slider, i,
                   dip_setting_step_at(slider->setting, i) ==
                       step_of(state, DIP_PANE_REQUESTED, slider->setting),
                   cell);
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
    slider.dimmed = is_dimmed(state, setting);
    const int under = (dip_ui_pointer_x(ui) - slider.cells.x) / slider.cell_width;
    slider.pointed = dip_max(0, dip_min(slider.count - 1, under));
    char why[256], tip[DIP_STEP_TEXT_BYTES];
    const int step = dip_setting_step_at(setting, slider.pointed);
    const DipPrice price = price_of(window, setting, step);
    is_valid(state, setting, step, why);
    dip_step_tip(setting, step, &price, why, tip);
    slider.input = dip_ui_stepper(ui, id_of(setting), slider.cells, tip);
    change_by(ui, window, setting, &slider.input, slider.pointed);
    if (dip_ui_is_drawing(ui)) {
        find_prices(window, &slider);
        draw_slider(ui, state, &slider);
    }
    return name_height + height + dip_ui_px(ui, SLIDER_GAP);
}

// --- a switch ------------------------------------------------------------------------------------

// Draws a switch with its knob at the requested pane's side. If the current pane has the other
// side, a ring shows there.
static void draw_switch(DipUi *ui, DipRect rect, bool current, bool requested, bool hovered) {
    const int inset = dip_ui_px(ui, 3), side = rect.height - 2 * inset;
    const DipRect inside = dip_rect_inset(rect, inset, inset);
    DipRect places[2] = {inside, inside}; // Places of the knob: off, on.
    places[1].x = dip_rect_right(inside) - side;
    places[0].width = places[1].width = side;
    dip_ui_fill_round(ui, rect, rect.height / 2, requested ? dip_style_accent : dip_style_switch);
    dip_ui_fill_round(ui, places[requested], side / 2,
                      requested ? dip_style_on_accent : dip_style_white);
    if (current != requested) {
        dip_ui_outline(ui, places[current], side / 2, dip_ui_px(ui, 2),
                       current ? dip_style_white : dip_style_on_accent);
    }
    if (hovered) {
        dip_ui_outline(ui, rect, rect.height / 2, dip_ui_px(ui, 1), dip_style_soft);
    }
}

// Draws what the switch costs and gains at the right end of a row.
static void draw_switch_price(DipUi *ui, const DipWindow *window, DipSetting setting, DipRect row) {
    const DipPrice price = price_of(window, setting, setting == DIP_SETTING_GI ? 0 : 1);
    const char *needs = dip_quality_needs(&window->state->quality[DIP_PANE_REQUESTED], setting);
    const bool known = is_known(&price);
    char ms[DIP_STEP_NAME_BYTES], flip[DIP_STEP_NAME_BYTES], text[160], longer[160];
    dip_price_ms_text(&price, ms);
    snprintf(text, sizeof text, "%s%s%s", setting == DIP_SETTING_GI && known ? "if off " : "", ms,
             known ? " ms" : "");
    snprintf(longer, sizeof longer, "%.80s \u00b7 gains in motion", text);
    if (needs && !known) {
        snprintf(text, sizeof text, "%s", needs);
    } else if (setting == DIP_SETTING_MIPDEBUG) {
        snprintf(text, sizeof text, "a picture of its own");
    } else if (setting == DIP_SETTING_TAA && known &&
               dip_ui_text_width(ui, PRICE_SIZE, longer) <= row.width) {
        memcpy(text, longer, sizeof text);
    }
    if (known && price.has_flip && setting != DIP_SETTING_GI && setting != DIP_SETTING_TAA &&
        setting != DIP_SETTING_MIPDEBUG) {
        dip_price_flip_text(&price, flip);
        dip_ui_label(ui, PRICE_SIZE, flip_colour(&price), DIP_ALIGN_RIGHT, row, flip);
        dip_cut_right(&row, dip_ui_text_width(ui, PRICE_SIZE, flip) + dip_ui_px(ui, 7));
    }
    dip_ui_label(ui, PRICE_SIZE, has_bar(&price) ? dip_style_soft : dip_style_dim, DIP_ALIGN_RIGHT,
                 row, text);
}

static int declare_switch(DipUi *ui, DipWindow *window, DipSetting setting, DipRect rect) {
    const DipPreviewState *state = window->state;
    const bool on = step_of(state, edited_pane(state), setting) != 0;
    const char *title = dip_setting_info(setting)->title;
    const DipPrice price = price_of(window, setting, 1);
    char tip[DIP_STEP_TEXT_BYTES];
    rect.height = dip_ui_px(ui, SWITCH_HEIGHT);
    dip_step_tip(setting, 1, &price, "", tip);
    const DipUiInput input = dip_ui_stepper(ui, id_of(setting), rect, tip);
    const bool to_on = input.steps > 0 || input.to_last, to_off = input.steps < 0 || input.to_first;
    if (input.pressed || (to_on && !on) || (to_off && on)) {
        dip_preview_set_step(window->state, setting, !on, dip_ui_now_ns(ui));
    }
    const int width = dip_ui_px(ui, 34), height = dip_ui_px(ui, 16), gap = dip_ui_px(ui, 8);
    DipRect rest = rect;
    const DipRect knob = dip_rect_middle(dip_cut_right(&rest, width), width, height);
    dip_ui_label(ui, NAME_SIZE, is_dimmed(state, setting) ? dip_style_dim : dip_style_white,
                 DIP_ALIGN_LEFT, rect, title);
    draw_switch(ui, knob, step_of(state, DIP_PANE_CURRENT, setting) != 0,
                step_of(state, DIP_PANE_REQUESTED, setting) != 0, input.hovered);
    dip_cut_left(&rest, dip_ui_text_width(ui, NAME_SIZE, title) + gap);
    dip_cut_right(&rest, gap);
    draw_switch_price(ui, window, setting, rest);
    dip_ui_focus_ring(ui, knob, height / 2, &input);
    return rect.height;
}

// --- a slider in one line ------------------------------------------------------------------------

static const char *line_title(DipSetting setting) {
    return setting == DIP_SETTING_ASD ? "Group size" : dip_setting_info(setting)->title;
}

// Draws the price of the requested step, or what the setting needs to have an effect.
static void draw_line_price(DipUi *ui, const DipWindow *window, DipSetting setting, DipRect row) {
    const int step = step_of(window->state, DIP_PANE_REQUESTED, setting);
    const DipPrice price = price_of(window, setting, step);
    const char *needs = dip_quality_needs(&window->state->quality[DIP_PANE_REQUESTED], setting);
    char ms[DIP_STEP_NAME_BYTES], flip[DIP_STEP_NAME_BYTES], text[64];
    dip_price_ms_text(&price, ms);
    snprintf(text, sizeof text, "%.40s%s", needs ? needs : ms, is_known(&price) ? " ms" : "");
    if (is_known(&price) && price.has_flip) {
        dip_price_flip_text(&price, flip);
        const int width = dip_ui_text_width(ui, PRICE_SIZE, flip) + dip_ui_px(ui, 7);
        if (width + dip_ui_text_width(ui, PRICE_SIZE, text) <= row.width) {
            dip_ui_label(ui, PRICE_SIZE, flip_colour(&price), DIP_ALIGN_RIGHT, row, flip);
            dip_cut_right(&row, width);
        }
    }
    if (dip_ui_text_width(ui, PRICE_SIZE, text) <= row.width) {
        dip_ui_label(ui, PRICE_SIZE, has_bar(&price) ? dip_style_soft : dip_style_dim,
                     DIP_ALIGN_RIGHT, row, text);
    }
}

// Adds to a tip how many pixels a step of the render scale draws.
static void add_drawn_size(const DipPreviewState *state, int step, char tip[DIP_STEP_TEXT_BYTES]) {
    const size_t length = strlen(tip);
    DipQuality quality = state->quality[edited_pane(state)];
    quality.step[DIP_SETTING_SCALE] = (uint8_t)step;
    if (state->pane_width > 0) {
        snprintf(tip + length, DIP_STEP_TEXT_BYTES - length, "\nDraws %d x %d pixels.",
                 dip_quality_drawn_size(&quality, state->pane_width),
                 dip_quality_drawn_size(&quality, state->pane_height));
    }
}

// Declares a slider without prices of its steps beneath it: its title and its steps share a line,
// and the price of the requested step stands between them.
static int declare_line_slider(DipUi *ui, DipWindow *window, DipSetting setting, DipRect rect) {
    const DipPreviewState *state = window->state;
    const int pill = dip_ui_px(ui, STEP_HEIGHT), gap = dip_ui_px(ui, 8);
    Slider slider = {.setting = setting, .rect = rect};
    rect.height = dip_ui_px(ui, SWITCH_HEIGHT);
    slider.count = dip_setting_info(setting)->step_count;
    slider.cell_width = dip_ui_px(ui, LINE_CELL_WIDTH);
    DipRect rest = rect;
    slider.cells = dip_rect_middle(dip_cut_right(&rest, slider.cell_width * slider.count),
                                   slider.cell_width * slider.count, pill);
    slider.dimmed = is_dimmed(state, setting);
    const int under = (dip_ui_pointer_x(ui) - slider.cells.x) / slider.cell_width;
    slider.pointed = dip_max(0, dip_min(slider.count - 1, under));
    char why[256], tip[DIP_STEP_TEXT_BYTES];
    const int step = dip_setting_step_at(setting, slider.pointed);
    const DipPrice price = price_of(window, setting, step);
    is_valid(state, setting, step, why);
    dip_step_tip(setting, step, &price, why, tip);
    if (setting == DIP_SETTING_SCALE) {
        add_drawn_size(state, step, tip);
    }
    slider.input = dip_ui_stepper(ui, id_of(setting), slider.cells, tip);
    change_by(ui, window, setting, &slider.input, slider.pointed);
    if (!dip_ui_is_drawing(ui)) {
        return rect.height;
    }
    const int thick = dip_ui_px(ui, 2);
    dip_ui_fill(ui,
                (DipRect){slider.cells.x + slider.cell_width / 2,
                          slider.cells.y + (pill - thick) / 2,
                          slider.cell_width * (slider.count - 1), thick},
                dip_style_line);
    for (int i = 0; i < slider.count; ++i) {
        draw_pill(ui, state, &slider, i, dip_rect_cell(slider.cells, slider.count, pill, 0, 0, i));
    }
    const char *title = line_title(setting);
    dip_ui_label(ui, NAME_SIZE, slider.dimmed ? dip_style_dim : dip_style_white, DIP_ALIGN_LEFT,
                 rect, title);
    dip_cut_left(&rest, dip_ui_text_width(ui, NAME_SIZE, title) + gap);
    dip_cut_right(&rest, gap);
    draw_line_price(ui, window, setting, rest);
    return rect.height;
}

int dip_setting_row_declare(DipUi *ui, DipWindow *window, DipSetting setting, DipRect rect) {
    const bool is_switch = dip_setting_info(setting)->step_count == 2;
    const bool in_one_line = setting == DIP_SETTING_ASD || setting == DIP_SETTING_SCALE;
    return (is_switch     ? declare_switch
            : in_one_line ? declare_line_slider
                          : declare_slider)(ui, window, setting, rect);
}

// --- a line of a list ----------------------------------------------------------------------------

void dip_setting_line_declare(DipUi *ui, DipWindow *window, DipSetting setting, DipRect rect) {
    const int requested = step_of(window->state, DIP_PANE_REQUESTED, setting);
    const DipPrice price = price_of(window, setting, requested);
    const char *title = dip_setting_info(setting)->short_title;
    char tip[DIP_STEP_TEXT_BYTES], ms[DIP_STEP_NAME_BYTES] = "";
    dip_step_tip(setting, requested, &price, "", tip);
    DipUiInput input = dip_ui_stepper(ui, id_of(setting), rect, tip);
    const int title_end = rect.x + dip_ui_px(ui, 10) + dip_ui_text_width(ui, LINE_SIZE, title);
    if (input.pressed) { // A click in the left half behind the title goes one step back.
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
        dip_price_ms_text(&price, ms);
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
