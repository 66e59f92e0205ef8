// Declares the presets, the buttons that act on all settings, and the number fields of the target
// (frames per second and milliseconds per frame).
#include "app/preview/prices/price_text.h"
#include "app/preview/tabs/tabs.h"
#include "app/report/words.h"
#include "app/ui/layout.h"
#include "app/ui/style.h"

#include <math.h>
#include <stdio.h>

enum { NOTE_SIZE = 11 };

static DipUiId id_of(int control) {
    return DIP_UI_ID(DIP_UI_SETTINGS, control);
}

// --- presets and buttons -------------------------------------------------------------------------

// Returns whether presets that depend on prices cannot be chosen yet, because the settings that
// prices start from (dip_prices_base) have no time or no error. Scenes of the gallery have no
// errors, so there presets wait only for the time.
static bool presets_wait(const DipWindow *window) {
    const DipQuality base = dip_prices_base(window->prices);
    const DipPriceSum sum = dip_prices_sum(window->prices, &base);
    const bool has_errors = !window->figures[DIP_PANE_REQUESTED].no_errors;
    return sum.state == DIP_PRICE_UNKNOWN || (has_errors && !sum.has_flip);
}

// Writes a preset's tip. Returns how its button looks.
static DipUiLook describe_preset(const DipWindow *window, DipPreset preset, char tip[320]) {
    const char *name = dip_preview_preset_name(preset);
    const char *progress = dip_prices_progress(window->prices);
    DipQuality quality;
    char text[DIP_SETTINGS_BYTES], price[40] = "";
    if (!dip_preview_preset(window->state, preset, &quality)) {
        dip_preview_choice_why(window->state->choice, progress, text, sizeof text);
        snprintf(tip, 320, "%s waits. %s", name, text);
        return DIP_UI_OFF;
    }
    if ((int)preset < DIP_MEASURED_PRESETS && presets_wait(window)) {
        snprintf(tip, 320, "%s waits until times and errors are known.\n%s", name,
                 progress[0] ? progress : "They are measured while the picture rests (Space).");
        return DIP_UI_OFF;
    }
    const DipPriceSum sum = dip_prices_sum(window->prices, &quality);
    if (sum.state != DIP_PRICE_UNKNOWN) {
        const DipPriceTrust trust = dip_price_sum_trust(&sum);
        const bool rough = sum.state == DIP_PRICE_ROUGH && trust == DIP_PRICE_TRUST_KNOWN;
        char digits[DIP_STEP_NAME_BYTES];
        dip_ms_text(sum.ms, trust, window->state->budget_ms, digits);
        snprintf(price, sizeof price, "\n%s%s ms", rough ? DIP_ROUGH_MARK : "", digits);
    }
    dip_quality_format_changes(&quality, text, sizeof text);
    snprintf(tip, 320, "%s: %s%s", name, text, price);
    return dip_quality_equal(&quality, &window->state->quality[DIP_PANE_REQUESTED]) ? DIP_UI_CHOSEN
                                                                                    : DIP_UI_PLAIN;
}

void dip_presets_declare(DipUi *ui, DipWindow *window, DipRect rect, int columns) {
    const int gap = dip_ui_px(ui, 8), row_gap = dip_ui_px(ui, 5);
    const int rows = (DIP_PRESET_COUNT + columns - 1) / columns;
    const int fitting = (rect.height - (rows - 1) * row_gap) / rows;
    const int height = dip_max(1, dip_min(dip_ui_px(ui, 28), fitting));
    for (int p = 0; p < DIP_PRESET_COUNT; ++p) {
        char tip[320];
        const DipUiLook look = describe_preset(window, (DipPreset)p, tip);
        if (dip_ui_button(ui, id_of(DIP_ID_PRESETS + p),
                          dip_rect_cell(rect, columns, height, gap, row_gap, p),
                          dip_preview_preset_name((DipPreset)p), look, tip)) {
            dip_preview_act(window->state, DIP_ACTION_PRESET, p, false, dip_ui_now_ns(ui));
        }
    }
}

void dip_apply_declare(DipUi *ui, DipWindow *window, DipRect rect) {
    DipPreviewState *state = window->state;
    const bool same = dip_quality_equal(&state->quality[0], &state->quality[1]);
    if (dip_ui_button(ui, id_of(DIP_ID_APPLY), rect, same ? "Same" : "Apply",
                      same ? DIP_UI_OFF : DIP_UI_PRIMARY,
                      same ? "Both panes have the same settings, so there is nothing to apply."
                           : "Gives the current pane the requested settings (Ctrl+Enter).")) {
        dip_preview_act(state, DIP_ACTION_APPLY, 0, false, dip_ui_now_ns(ui));
    }
}

void dip_setting_buttons_declare(DipUi *ui, DipWindow *window, DipRect rect) {
    DipPreviewState *state = window->state;
    const int gap = dip_ui_px(ui, 6), width = (rect.width - 2 * gap) / 3;
    const DipRect copy = dip_cut_right(&rect, width);
    dip_cut_right(&rect, gap);
    const DipRect undo = dip_cut_right(&rect, width);
    dip_cut_right(&rect, gap);
    dip_apply_declare(ui, window, rect);
    if (dip_ui_button(ui, id_of(DIP_ID_UNDO), undo, "Undo",
                      state->undo_count ? DIP_UI_PLAIN : DIP_UI_OFF,
                      state->undo_count ? "Takes the last change of settings back (Ctrl+Z)."
                                        : "There is no change of settings to take back.")) {
        dip_preview_act(state, DIP_ACTION_UNDO, 0, false, dip_ui_now_ns(ui));
    }
    const bool narrow = dip_ui_text_width(ui, 13, "Copy text") + dip_ui_px(ui, 8) > width;
    if (dip_ui_button(ui, id_of(DIP_ID_COPY), copy, narrow ? "Copy" : "Copy text", DIP_UI_PLAIN,
                      "Copies the requested settings as text for --requested and the ini "
                      "(Ctrl+C). Ctrl+V pastes settings.")) {
        state->copy_settings = true;
    }
}

// --- the target ----------------------------------------------------------------------------------

// Declares a field and writes a word behind it, at the left side of *rest, and cuts both off *rest.
// Returns what the user did with the field.
static DipUiInput declare_field(DipUi *ui, int id, DipRect *rest, int width, const char *text,
                                const char *word, double *typed) {
    static const char tip[] =
        "The target: the advised settings draw this many frames a second, each frame within "
        "this time. Type a number and press Enter, or step by the wheel or the arrow keys. A right "
        "click takes the display's refresh.";
    const DipRect field = dip_cut_left(rest, dip_ui_px(ui, width));
    const DipUiInput input = dip_ui_number_field(ui, id_of(id), field, text, tip, typed);
    dip_cut_left(rest, dip_ui_px(ui, 5));
    dip_ui_word(ui, NOTE_SIZE, dip_style_soft, rest, dip_ui_px(ui, 5), word);
    return input;
}

void dip_target_declare(DipUi *ui, DipWindow *window, DipRect rect) {
    DipPreviewState *state = window->state;
    char fps[DIP_NUMBER_BYTES], ms[DIP_NUMBER_BYTES];
    const double rate = 1000.0 / state->budget_ms;
    double typed_fps, typed_ms;
    snprintf(fps, sizeof fps, fabs(rate - round(rate)) < 0.05 ? "%.0f" : "%.1f", rate);
    dip_budget_ms_text(state->budget_ms, ms);
    const DipUiInput by_rate =
        declare_field(ui, DIP_ID_FRAME_RATE, &rect, 44, fps, "fps  =", &typed_fps);
    const DipUiInput by_time = declare_field(ui, DIP_ID_BUDGET, &rect, 52, ms, "ms", &typed_ms);
    dip_preview_step_frame_rate(state, by_rate.steps - by_time.steps);
    if (by_rate.right || by_time.right) {
        dip_preview_set_budget(state, 0.0);
    }
    if (typed_fps > 0.0) {
        dip_preview_set_budget(state, 1000.0 / typed_fps);
    } else if (typed_ms > 0.0) {
        dip_preview_set_budget(state, typed_ms);
    }
    const DipPriceSum sum = dip_pane_sum(window, DIP_PANE_REQUESTED);
    char verdict[DIP_VERDICT_BYTES];
    dip_pane_verdict(window, &sum, verdict);
    dip_cut_left(&rect, dip_ui_px(ui, 5));
    if (dip_ui_text_width(ui, NOTE_SIZE, verdict) <= rect.width) {
        dip_ui_word(ui, NOTE_SIZE,
                    dip_pane_is_over(window, &sum) ? dip_style_worse : dip_style_soft, &rect, 0,
                    verdict);
    }
}
