// The tab of advice: the best settings for a time budget, and all measured combinations in a plot
// of time and error.
#include "app/preview/tabs/advice_plot.h"
#include "app/preview/tabs/advice_tab_private.h"
#include "app/preview/prices/price_text.h"
#include "app/ui/style.h"
#include "app/preview/tabs/tabs.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MARGIN = 10, GAP = 20, RIGHT_WIDTH = 300 };
enum { ID_UP = DIP_ADVICE_ID_FIRST_FREE, ID_DOWN, ID_TABLE };

static DipUiId id_of(int index) {
    return DIP_UI_ID(DIP_UI_ADVICE, index);
}

void dip_advice_line(DipUi *ui, int size, DipColour colour, DipRect room, int *y,
                     const char *text) {
    const int height = dip_ui_line_height(ui, size);
    if (*y + height <= room.y + room.height) {
        dip_ui_text(ui, size, colour, DIP_ALIGN_LEFT, room.x, *y, room.width, text);
    }
    *y += height + dip_ui_px(ui, 3);
}

// --- budgets -------------------------------------------------------------------------------------

// The piece of advice that shows: the one that the user took last, or the first one.
static int chosen_advice(const DipPreviewState *state) {
    const int count = state->costs->advice_count;
    return (state->next_advice + count - 1) % count;
}

// Declares a button for each budget. Returns the height of the buttons.
static int declare_budgets(DipUi *ui, DipWindow *window, DipRect room) {
    DipPreviewState *state = window->state;
    const DipCosts *costs = state->costs;
    const int gap = dip_ui_px(ui, 6), height = dip_ui_px(ui, DIP_ADVICE_BUTTON_HEIGHT);
    const int width =
        (room.width - (DIP_ADVICE_BUDGET_COLUMNS - 1) * gap) / DIP_ADVICE_BUDGET_COLUMNS;
    const int rows =
        (costs->advice_count + DIP_ADVICE_BUDGET_COLUMNS - 1) / DIP_ADVICE_BUDGET_COLUMNS;
    for (int i = 0; i < costs->advice_count; ++i) {
        const DipRect button = {room.x + i % DIP_ADVICE_BUDGET_COLUMNS * (width + gap),
                                room.y + i / DIP_ADVICE_BUDGET_COLUMNS * (height + gap), width,
                                height};
        char name[32];
        snprintf(name, sizeof name, "%.4g ms", costs->advice[i].budget_ms);
        if (dip_ui_button(ui, id_of(DIP_ADVICE_ID_BUDGETS + i), button, name,
                          i == chosen_advice(state) ? DIP_UI_CHOSEN : DIP_UI_PLAIN,
                          "Shows the settings with the least error within this time per frame. "
                          "They change nothing until you try them.")) {
            state->next_advice = (i + 1) % costs->advice_count;
        }
    }
    return rows * (height + gap);
}

void dip_advice_try(DipUi *ui, DipWindow *window, const DipQuality *quality) {
    char text[160];
    dip_quality_format_changes(quality, text, sizeof text);
    dip_preview_set_quality(window->state, DIP_PANE_REQUESTED, quality, dip_ui_now_ns(ui));
    dip_preview_notice(window->state, dip_ui_now_ns(ui), "Requested: %.120s", text);
}

static void write_picked(DipUi *ui, const DipWindow *window, const DipCostsAdvice *advice,
                         DipRect room, int *y) {
    const DipCosts *costs = window->state->costs;
    char text[200], flip[DIP_STEP_NAME_BYTES];
    snprintf(text, sizeof text, "%.1f ms", advice->ms);
    dip_advice_line(ui, DIP_ADVICE_SUM_SIZE, dip_style_accent, room, y, text);
    dip_flip_text(advice->flip, false, flip);
    if (costs->baseline.found && costs->baseline.flip > 0.0) {
        const double change = 100.0 * (advice->flip / costs->baseline.flip - 1.0);
        snprintf(text, sizeof text, "FLIP %s, %s%.0f %% of the baseline's", flip,
                 change < 0.0 ? "\u2212" : "+", fabs(change));
    } else {
        snprintf(text, sizeof text, "FLIP %s", flip);
    }
    dip_advice_line(ui, DIP_ADVICE_NOTE_SIZE, dip_style_soft, room, y, text);
    dip_quality_format_changes(&advice->quality, text, sizeof text);
    dip_advice_line(ui, DIP_ADVICE_NOTE_SIZE, dip_style_white, room, y, text);
    if (costs->width != window->frames[0].width || costs->height != window->frames[0].height) {
        snprintf(text, sizeof text, "The report is of %dx%d, the panes are %dx%d.", costs->width,
                 costs->height, window->frames[0].width, window->frames[0].height);
        dip_advice_line(ui, DIP_ADVICE_NOTE_SIZE, dip_style_worse, room, y, text);
    }
}

static void declare_picked(DipUi *ui, DipWindow *window, DipRect room) {
    const DipCostsAdvice *advice = &window->state->costs->advice[chosen_advice(window->state)];
    const int height = dip_ui_px(ui, DIP_ADVICE_BUTTON_HEIGHT), gap = dip_ui_px(ui, 8);
    int y = room.y;
    dip_advice_line(ui, DIP_ADVICE_SIZE, dip_style_white, room, &y, "Best picture within");
    y += declare_budgets(ui, window, (DipRect){room.x, y, room.width, 0});
    if (advice->found) {
        write_picked(ui, window, advice, room, &y);
    } else {
        const bool nothing_fits = window->state->costs->point_count == 0 ||
                                  window->state->costs->points[0].ms > advice->budget_ms;
        dip_advice_line(ui, DIP_ADVICE_SIZE, dip_style_worse, room, &y,
                        nothing_fits ? "Nothing measured is as fast."
                                     : "The report gives no advice for this time.");
    }
    const int width = (room.width - gap) / 2;
    y = dip_style_min(y + gap / 2, room.y + room.height - height);
    const bool same =
        advice->found && memcmp(&advice->quality, &window->state->quality[DIP_PANE_REQUESTED],
                                sizeof advice->quality) == 0;
    if (dip_ui_button(ui, id_of(DIP_ADVICE_ID_TRY), (DipRect){room.x, y, width, height},
                      "Try it right", advice->found && !same ? DIP_UI_PRIMARY : DIP_UI_OFF,
                      same ? "The right pane has these settings."
                           : "Gives the requested pane these settings. Apply is separate (K).")) {
        dip_advice_try(ui, window, &advice->quality);
    }
    if (dip_ui_button(ui, id_of(ID_TABLE), (DipRect){room.x + width + gap, y, width, height},
                      "All steps", DIP_UI_PLAIN,
                      "Shows the time and error of every step of every setting (U).")) {
        dip_preview_act(window->state, DIP_ACTION_COSTS, 0, false, dip_ui_now_ns(ui));
    }
}

// --- one step up and down ------------------------------------------------------------------------

// Writes what changes from one combination to another: "asd=1 -> asd=2".
static void format_change(const DipQuality *from, const DipQuality *to, char text[160]) {
    size_t length = 0;
    text[0] = '\0';
    for (int s = 0; s < DIP_SETTING_COUNT && length < 140; ++s) {
        if (from->step[s] != to->step[s]) {
            const DipSettingInfo *info = dip_setting_info((DipSetting)s);
            length += (size_t)snprintf(text + length, 160 - length, "%s%s %s \u2192 %s",
                                       length ? ", " : "", info->key, info->steps[from->step[s]],
                                       info->steps[to->step[s]]);
        }
    }
}

// Declares one step along the front as a button. Returns its height.
static int declare_step(DipUi *ui, DipWindow *window, const DipCostsAdvice *advice, int direction,
                        DipRect room) {
    const DipCosts *costs = window->state->costs;
    const int step = dip_costs_front_step(costs, advice->ms, direction);
    const int pad = dip_ui_px(ui, 8), line = dip_ui_line_height(ui, DIP_ADVICE_SIZE);
    const int note = dip_ui_line_height(ui, DIP_ADVICE_NOTE_SIZE);
    const DipRect box = {room.x, room.y, room.width, line + note + pad};
    const char *name = direction > 0 ? "up" : "down";
    char text[160], flip[DIP_STEP_NAME_BYTES];
    const DipUiInput input = dip_ui_control(
        ui, &(DipUiControl){.id = id_of(direction > 0 ? ID_UP : ID_DOWN),
                            .rect = box,
                            .tip = direction > 0
                                       ? "The next better combination of the front: what it costs "
                                         "and gains. A click tries it in the right pane."
                                       : "The next faster combination of the front: what it saves "
                                         "and loses. A click tries it in the right pane.",
                            .disabled = step < 0});
    dip_ui_fill_round(ui, box, dip_ui_px(ui, 4), dip_style_raised);
    dip_ui_text(ui, DIP_ADVICE_SIZE, dip_style_white, DIP_ALIGN_LEFT, box.x + pad, box.y + pad / 2,
                box.width, name);
    if (input.hovered && step >= 0) {
        dip_ui_outline(ui, box, dip_ui_px(ui, 4), dip_ui_px(ui, 1), dip_style_soft);
    }
    dip_ui_focus_ring(ui, box, dip_ui_px(ui, 4), &input);
    const int right = box.x + box.width - pad;
    if (step < 0) {
        dip_ui_text(ui, DIP_ADVICE_NOTE_SIZE, dip_style_dim, DIP_ALIGN_RIGHT, right,
                    box.y + pad / 2, box.width - 6 * pad,
                    direction > 0 ? "nothing measured is better" : "nothing measured is faster");
        return box.height;
    }
    const DipCostsPoint *point = &costs->points[step];
    dip_flip_text(point->flip - advice->flip, true, flip);
    snprintf(text, sizeof text, "%s%.1f ms", point->ms < advice->ms ? "\u2212" : "+",
             fabs(point->ms - advice->ms));
    const int flip_width = dip_ui_text_width(ui, DIP_ADVICE_SIZE, flip) + pad;
    dip_ui_text(ui, DIP_ADVICE_SIZE, direction > 0 ? dip_style_gain : dip_style_worse,
                DIP_ALIGN_RIGHT, right, box.y + pad / 2, flip_width, flip);
    dip_ui_text(ui, DIP_ADVICE_SIZE, dip_style_soft, DIP_ALIGN_RIGHT, right - flip_width,
                box.y + pad / 2, box.width / 2, text);
    format_change(&advice->quality, &point->quality, text);
    dip_ui_text(ui, DIP_ADVICE_NOTE_SIZE, dip_style_soft, DIP_ALIGN_LEFT, box.x + pad,
                box.y + pad / 2 + line, box.width - 2 * pad, text);
    if (input.pressed) {
        dip_advice_try(ui, window, &point->quality);
    }
    return box.height;
}

static void declare_steps(DipUi *ui, DipWindow *window, DipRect room) {
    const DipCostsAdvice *advice = &window->state->costs->advice[chosen_advice(window->state)];
    int y = room.y;
    dip_advice_line(ui, DIP_ADVICE_SIZE, dip_style_white, room, &y, "One step");
    if (!advice->found) {
        return;
    }
    for (int direction = 1; direction >= -1; direction -= 2) {
        y += declare_step(ui, window, advice, direction,
                          (DipRect){room.x, y, room.width, room.height}) +
             dip_ui_px(ui, 6);
    }
    dip_ui_text_block(ui, DIP_ADVICE_NOTE_SIZE, dip_style_dim,
                      (DipRect){room.x, y, room.width, room.y + room.height - y},
                      window->state->costs->heading);
}

// --- the tab -------------------------------------------------------------------------------------

void dip_tab_advice(DipUi *ui, DipWindow *window, DipRect body) {
    const int margin = dip_ui_px(ui, MARGIN), gap = dip_ui_px(ui, GAP);
    const DipRect room = {body.x + margin, body.y + margin / 2, body.width - 2 * margin,
                          body.height - margin};
    if (!window->state->costs) {
        dip_advice_declare_rough(ui, window, room);
        return;
    }
    const int left = dip_style_min(dip_ui_px(ui, DIP_ADVICE_LEFT_WIDTH), room.width);
    const int right = dip_ui_px(ui, RIGHT_WIDTH);
    declare_picked(ui, window, (DipRect){room.x, room.y, left, room.height});
    int middle = room.width - left - gap;
    const bool has_steps = middle >= right + gap + dip_ui_px(ui, 200);
    if (has_steps) {
        middle -= right + gap;
        declare_steps(ui, window,
                      (DipRect){room.x + room.width - right, room.y, right, room.height});
    }
    const DipRect rest = {room.x + left + gap, room.y, middle, room.height};
    if (!has_steps && middle < dip_ui_px(ui, 180)) {
        return;
    }
    if (dip_ui_is_drawing(ui)) {
        dip_advice_plot(ui, window, &window->state->costs->advice[chosen_advice(window->state)],
                        rest);
    }
}
