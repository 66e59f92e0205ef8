// The tab of advice without a cost report: advice from the rough prices of this view, and how to
// get a report.
#include "app/preview/tabs/advice_tab_private.h"
#include "app/preview/prices/price_text.h"
#include "app/preview/prices/rough_advice.h"
#include "app/ui/style.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { BUDGETS = 4, FIRST_BUDGET = 2, GAP = 20, NOTE_WIDTH = 220 };

static const double budgets_ms[BUDGETS] = {4.0, 8.0, 16.6, 33.3};

static DipUiId id_of(int index) {
    return DIP_UI_ID(DIP_UI_ADVICE, index);
}

static int chosen_budget(const DipPreviewState *state) {
    return (state->next_advice + FIRST_BUDGET) % BUDGETS;
}

// Returns the height of the buttons.
static int declare_budgets(DipUi *ui, DipWindow *window, DipRect room) {
    const int gap = dip_ui_px(ui, 6), height = dip_ui_px(ui, DIP_ADVICE_BUTTON_HEIGHT);
    const int width = (room.width - (BUDGETS - 1) * gap) / BUDGETS;
    for (int i = 0; i < BUDGETS; ++i) {
        const DipRect button = {room.x + i * (width + gap), room.y, width, height};
        char name[32];
        snprintf(name, sizeof name, "%.4g ms", budgets_ms[i]);
        if (dip_ui_button(ui, id_of(DIP_ADVICE_ID_BUDGETS + i), button, name,
                          i == chosen_budget(window->state) ? DIP_UI_CHOSEN : DIP_UI_PLAIN,
                          "Shows the settings with the least error within this time per frame. "
                          "They change nothing until you try them.")) {
            window->state->next_advice = (i + BUDGETS - FIRST_BUDGET) % BUDGETS;
        }
    }
    return height + gap;
}

static void write_found(DipUi *ui, const DipRoughAdvice *advice, DipRect room, int *y) {
    char text[200], flip[DIP_STEP_NAME_BYTES];
    snprintf(text, sizeof text, DIP_ROUGH_MARK "%.1f ms", advice->ms);
    dip_advice_line(ui, DIP_ADVICE_SUM_SIZE, dip_style_accent, room, y, text);
    dip_flip_text(advice->flip, false, flip);
    snprintf(text, sizeof text, "FLIP " DIP_ROUGH_MARK "%s", flip);
    if (advice->base_flip > 0.0) {
        const double change = 100.0 * (advice->flip / advice->base_flip - 1.0);
        snprintf(text, sizeof text, "FLIP " DIP_ROUGH_MARK "%s, %s%.0f %% of the defaults'", flip,
                 change < 0.0 ? "\u2212" : "+", fabs(change));
    }
    dip_advice_line(ui, DIP_ADVICE_NOTE_SIZE, dip_style_soft, room, y, text);
    dip_quality_format_changes(&advice->quality, text, sizeof text);
    dip_advice_line(ui, DIP_ADVICE_NOTE_SIZE, dip_style_white, room, y, text);
}

// Writes what the advice waits for.
static void write_waiting(DipUi *ui, const DipWindow *window, const DipRoughAdvice *advice,
                          DipRect room, int y) {
    const DipPreviewState *state = window->state;
    const char *progress = dip_prices_progress(window->prices);
    char text[160];
    if (window->figures[DIP_PANE_REQUESTED].no_errors) {
        snprintf(text, sizeof text, "A scene of the gallery has no errors to choose by.");
    } else if (!state->paused && !state->manual) {
        snprintf(text, sizeof text, "The prices of this view are measured while it rests.");
    } else if (advice->state == DIP_ROUGH_ADVICE_NO_TIMES) {
        snprintf(text, sizeof text, "Times are being measured. %s", progress);
    } else {
        snprintf(text, sizeof text, "Errors are being measured. %s", progress);
    }
    dip_ui_text_block(ui, DIP_ADVICE_SIZE, dip_style_soft,
                      (DipRect){room.x, y, room.width, room.y + room.height - y}, text);
}

static void declare_button(DipUi *ui, DipWindow *window, const DipRoughAdvice *advice,
                           DipRect rect) {
    DipPreviewState *state = window->state;
    const bool found = advice->state == DIP_ROUGH_ADVICE_FOUND;
    const bool waits =
        advice->state == DIP_ROUGH_ADVICE_NO_TIMES || advice->state == DIP_ROUGH_ADVICE_NO_ERRORS;
    if (waits && !state->paused && !state->manual) {
        if (dip_ui_button(ui, id_of(DIP_ADVICE_ID_TRY), rect, "Pause to measure", DIP_UI_PRIMARY,
                          "Pauses, so that the prices can be measured (Space).")) {
            dip_preview_act(state, DIP_ACTION_PAUSE, 0, false, dip_ui_now_ns(ui));
        }
        return;
    }
    const bool same = found && memcmp(&advice->quality, &state->quality[DIP_PANE_REQUESTED],
                                      sizeof advice->quality) == 0;
    if (dip_ui_button(ui, id_of(DIP_ADVICE_ID_TRY), rect, "Try it right",
                      found && !same ? DIP_UI_PRIMARY : DIP_UI_OFF,
                      same    ? "The right pane has these settings."
                      : found ? "Gives the requested pane these settings. Apply is separate."
                              : "There is no advice yet.")) {
        dip_advice_try(ui, window, &advice->quality);
    }
}

static void declare_advice(DipUi *ui, DipWindow *window, DipRect room) {
    const double budget_ms = budgets_ms[chosen_budget(window->state)];
    const DipRoughAdvice advice =
        dip_rough_advice(window->prices, &window->state->quality[DIP_PANE_REQUESTED], budget_ms);
    const int height = dip_ui_px(ui, DIP_ADVICE_BUTTON_HEIGHT);
    int y = room.y;
    dip_advice_line(ui, DIP_ADVICE_SIZE, dip_style_white, room, &y, "Best picture within, roughly");
    y += declare_budgets(ui, window, (DipRect){room.x, y, room.width, 0});
    if (advice.state == DIP_ROUGH_ADVICE_FOUND) {
        write_found(ui, &advice, room, &y);
    } else if (advice.state == DIP_ROUGH_ADVICE_TOO_SLOW) {
        char text[80];
        snprintf(text, sizeof text, "The fastest settings take " DIP_ROUGH_MARK "%.1f ms.",
                 advice.ms);
        dip_advice_line(ui, DIP_ADVICE_SIZE, dip_style_worse, room, &y, text);
    } else {
        write_waiting(ui, window, &advice, room, y);
        y += 3 * dip_ui_line_height(ui, DIP_ADVICE_SIZE);
    }
    y = dip_style_min(y + dip_ui_px(ui, 4), room.y + room.height - height);
    declare_button(ui, window, &advice, (DipRect){room.x, y, dip_ui_px(ui, 132), height});
}

static void write_how_to(DipUi *ui, const DipWindow *window, DipRect room) {
    char text[2 * DIP_SCENE_WORDS_BYTES + 512];
    snprintf(text, sizeof text,
             "This advice adds up the prices of single steps in this view. Settings that work on "
             "the same pixels, such as antialiasing and adaptive AA, gain less together.\n"
             "Advice for whole paths comes from a cost report, which measures combinations. "
             "This makes one in some minutes, and then starts the preview with it:\n"
             "diptych cost%s --out report\n"
             "diptych%s --cost report/cost.json",
             window->state->scene_words, window->state->scene_words);
    dip_ui_text_block(ui, DIP_ADVICE_NOTE_SIZE, dip_style_soft, room, text);
}

void dip_advice_declare_rough(DipUi *ui, DipWindow *window, DipRect room) {
    const int left = dip_style_min(dip_ui_px(ui, DIP_ADVICE_LEFT_WIDTH), room.width);
    const int x = room.x + left + dip_ui_px(ui, GAP);
    const DipRect rest = {x, room.y, room.x + room.width - x, room.height};
    declare_advice(ui, window, (DipRect){room.x, room.y, left, room.height});
    if (rest.width >= dip_ui_px(ui, NOTE_WIDTH)) {
        write_how_to(ui, window, rest);
    }
}
