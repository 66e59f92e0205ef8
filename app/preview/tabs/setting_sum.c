// The price of the requested settings, and the buttons that act on all settings.
#include "app/preview/prices/price_text.h"
#include "app/preview/tabs/tabs.h"
#include "app/ui/style.h"
#include "app/report/words.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    SUM_SIZE = 22,
    NOTE_SIZE = 11,
    SMALL_SIZE = 10,
    SUM_HEIGHT = 28,
    BUDGET_HEIGHT = 18,
    LEGEND_HEIGHT = 15,
    SWATCH = 8,
    HATCH_STEP = 6
};

// --- presets and buttons -------------------------------------------------------------------------

// Returns whether presets cannot be chosen yet, because nothing is known of what settings cost and
// gain here. Scenes of the gallery have no errors to wait for.
static bool presets_wait(const DipWindow *window) {
    const DipQuality base = dip_prices_base(window->prices);
    const DipPriceSum sum = dip_prices_sum(window->prices, &base);
    const bool has_errors = !window->figures[DIP_PANE_REQUESTED].no_errors;
    return sum.state == DIP_PRICE_UNKNOWN || (has_errors && !sum.has_flip);
}

int dip_presets_declare(DipUi *ui, DipWindow *window, DipRect rect, int columns) {
    const int gap = dip_ui_px(ui, 8), row_gap = dip_ui_px(ui, 5);
    const int rows = (DIP_PRESET_COUNT + columns - 1) / columns;
    const bool inert = presets_wait(window);
    const int width = (rect.width - (columns - 1) * gap) / columns;
    const int height =
        dip_max(1, dip_min(dip_ui_px(ui, 28), (rect.height - (rows - 1) * row_gap) / rows));
    for (int p = 0; p < DIP_PRESET_COUNT; ++p) {
        const DipRect button = {rect.x + p % columns * (width + gap),
                                rect.y + p / columns * (height + row_gap), width, height};
        DipQuality quality;
        char settings[200], tip[320];
        if (!dip_preview_preset(window->state, (DipPreset)p, &quality)) {
            dip_preview_choice_why(window->state->choice, dip_prices_progress(window->prices),
                                   settings, sizeof settings);
            snprintf(tip, sizeof tip, "%s waits. %s", dip_preview_preset_name((DipPreset)p),
                     settings);
            dip_ui_button(ui, DIP_UI_ID(DIP_UI_SETTINGS, DIP_ID_PRESETS + p), button,
                          dip_preview_preset_name((DipPreset)p), DIP_UI_OFF, tip);
            continue;
        }
        const DipPriceSum sum = dip_prices_sum(window->prices, &quality);
        dip_quality_format_changes(&quality, settings, sizeof settings);
        snprintf(tip, sizeof tip, "%s: %s", dip_preview_preset_name((DipPreset)p), settings);
        if (sum.state != DIP_PRICE_UNKNOWN) {
            snprintf(tip + strlen(tip), sizeof tip - strlen(tip), "\n%s%.1f ms",
                     sum.state == DIP_PRICE_MEASURED ? "" : "\u2248 ", sum.ms);
        }
        const bool chosen =
            memcmp(&quality, &window->state->quality[DIP_PANE_REQUESTED], sizeof quality) == 0;
        const bool waits = inert && p != DIP_PRESET_INI && p != DIP_PRESET_CURRENT;
        if (waits) {
            const char *progress = dip_prices_progress(window->prices);
            snprintf(tip, sizeof tip, "%s waits until times and errors are known.\n%s",
                     dip_preview_preset_name((DipPreset)p),
                     progress[0] ? progress : "They are measured while the picture rests (Space).");
        }
        if (dip_ui_button(ui, DIP_UI_ID(DIP_UI_SETTINGS, DIP_ID_PRESETS + p), button,
                          dip_preview_preset_name((DipPreset)p),
                          waits    ? DIP_UI_OFF
                          : chosen ? DIP_UI_CHOSEN
                                   : DIP_UI_PLAIN,
                          tip)) {
            dip_preview_act(window->state, DIP_ACTION_PRESET, p, false, dip_ui_now_ns(ui));
        }
    }
    return rows * height + (rows - 1) * row_gap;
}

void dip_apply_declare(DipUi *ui, DipWindow *window, DipRect rect) {
    DipPreviewState *state = window->state;
    const bool same = memcmp(&state->quality[0], &state->quality[1], sizeof state->quality[0]) == 0;
    if (dip_ui_button(ui, DIP_UI_ID(DIP_UI_SETTINGS, DIP_ID_APPLY), rect, same ? "Same" : "Apply",
                      same ? DIP_UI_OFF : DIP_UI_PRIMARY,
                      same ? "Both panes have the same settings, so there is nothing to apply."
                           : "Gives the current pane the requested settings (Ctrl+Enter).")) {
        dip_preview_act(state, DIP_ACTION_APPLY, 0, false, dip_ui_now_ns(ui));
    }
}

static void declare_undo(DipUi *ui, DipWindow *window, DipRect rect) {
    DipPreviewState *state = window->state;
    if (dip_ui_button(ui, DIP_UI_ID(DIP_UI_SETTINGS, DIP_ID_UNDO), rect, "Undo",
                      state->undo_count ? DIP_UI_PLAIN : DIP_UI_OFF,
                      state->undo_count ? "Takes the last change of settings back (Ctrl+Z)."
                                        : "There is no change of settings to take back.")) {
        dip_preview_act(state, DIP_ACTION_UNDO, 0, false, dip_ui_now_ns(ui));
    }
}

static void declare_copy(DipUi *ui, DipWindow *window, DipRect rect) {
    const bool narrow = dip_ui_text_width(ui, 13, "Copy text") + dip_ui_px(ui, 8) > rect.width;
    if (dip_ui_button(ui, DIP_UI_ID(DIP_UI_SETTINGS, DIP_ID_COPY), rect,
                      narrow ? "Copy" : "Copy text", DIP_UI_PLAIN,
                      "Copies the requested settings as text for --requested and the ini "
                      "(Ctrl+C). Ctrl+V pastes settings.")) {
        window->state->copy_settings = true;
    }
}

void dip_setting_buttons_declare(DipUi *ui, DipWindow *window, DipRect rect) {
    const int gap = dip_ui_px(ui, 6);
    const int width = (rect.width - 2 * gap) / 3;
    const DipRect apply = {rect.x, rect.y, rect.width - 2 * (width + gap), rect.height};
    const DipRect undo = {apply.x + apply.width + gap, rect.y, width, rect.height};
    const DipRect copy = {undo.x + width + gap, rect.y, width, rect.height};
    dip_apply_declare(ui, window, apply);
    declare_undo(ui, window, undo);
    declare_copy(ui, window, copy);
}

// --- the target ----------------------------------------------------------------------------------

// Declares a field and the word behind it at *x. Returns what the user did.
static DipUiInput declare_field(DipUi *ui, int id, int *x, DipRect room, int width,
                                const char *text, const char *word, double *typed) {
    static const char tip[] =
        "The target: settings are advised that draw this many frames a second, each of them within "
        "this time. Type a number and press Enter, or step by the wheel or the arrow keys. A right "
        "click takes the display's refresh.";
    const DipRect rect = {*x, room.y, dip_ui_px(ui, width), room.height};
    const DipUiInput input =
        dip_ui_number_field(ui, DIP_UI_ID(DIP_UI_SETTINGS, id), rect, text, tip, typed);
    *x += rect.width + dip_ui_px(ui, 5);
    dip_ui_text(ui, NOTE_SIZE, dip_style_soft, DIP_ALIGN_LEFT, *x,
                room.y + (room.height - dip_ui_line_height(ui, NOTE_SIZE)) / 2,
                room.x + room.width - *x, word);
    *x += dip_ui_text_width(ui, NOTE_SIZE, word) + dip_ui_px(ui, 5);
    return input;
}

void dip_target_declare(DipUi *ui, DipWindow *window, DipRect rect) {
    DipPreviewState *state = window->state;
    char fps[DIP_NUMBER_BYTES], ms[DIP_NUMBER_BYTES];
    const double rate = 1000.0 / state->budget_ms;
    int x = rect.x;
    double typed_fps, typed_ms;
    snprintf(fps, sizeof fps, fabs(rate - round(rate)) < 0.05 ? "%.0f" : "%.1f", rate);
    dip_budget_ms_text(state->budget_ms, ms);
    const DipUiInput by_rate =
        declare_field(ui, DIP_ID_FRAME_RATE, &x, rect, 44, fps, "fps  =", &typed_fps);
    const DipUiInput by_time = declare_field(ui, DIP_ID_BUDGET, &x, rect, 52, ms, "ms", &typed_ms);
    dip_preview_step_frame_rate(state, by_rate.steps - by_time.steps);
    if (by_rate.right || by_time.right) {
        dip_preview_set_budget(state, 0.0);
    }
    if (typed_fps > 0.0) {
        dip_preview_set_budget(state, 1000.0 / typed_fps);
    } else if (typed_ms > 0.0) {
        dip_preview_set_budget(state, typed_ms);
    }
}

// --- the sum -------------------------------------------------------------------------------------

// One part of the sum: its name in the legend, its time and its colour.
typedef struct Part {
    const char *name;
    double ms;
    DipColour colour;
} Part;

enum { PART_BASE, PART_AA, PART_ADAPTIVE, PART_AF, PART_OTHER, PART_COUNT };

// Returns whether the sum has a setting whose own price is doubtful.
static bool has_doubt(const DipPriceSum *sum) {
    bool found = false;
    for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
        found |= sum->parts_trust[s] == DIP_PRICE_TRUST_DOUBTFUL;
    }
    return found;
}

// Returns what the sum has beyond the base and the prices that are known, which is what the
// settings cost together.
static double rest_of(const DipPriceSum *sum) {
    double rest_ms = sum->together_ms;
    for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
        rest_ms += sum->parts_trust[s] == DIP_PRICE_TRUST_DOUBTFUL ? sum->parts_ms[s] : 0.0;
    }
    return rest_ms;
}

// Prices that are doubtful are no parts of their own.
static void find_parts(const DipPriceSum *sum, Part parts[PART_COUNT]) {
    static const Part names[PART_COUNT] = {{"base", 0.0, {139, 149, 162, 255}},
                                           {"AA", 0.0, {255, 190, 92, 255}},
                                           {"adaptive", 0.0, {240, 140, 58, 255}},
                                           {"AF", 0.0, {255, 226, 143, 255}},
                                           {"other", 0.0, {196, 202, 210, 255}}};
    static const int part_of[DIP_SETTING_COUNT] = {
        [DIP_SETTING_AA] = PART_AA,        [DIP_SETTING_TAA] = PART_AA,
        [DIP_SETTING_AAA] = PART_ADAPTIVE, [DIP_SETTING_ASD] = PART_ADAPTIVE,
        [DIP_SETTING_AF] = PART_AF,        [DIP_SETTING_AAF] = PART_AF,
        [DIP_SETTING_OPT] = PART_OTHER,    [DIP_SETTING_MIPLOD] = PART_OTHER,
        [DIP_SETTING_GI] = PART_OTHER,     [DIP_SETTING_MIPDEBUG] = PART_OTHER,
    };
    memcpy(parts, names, sizeof names);
    parts[PART_BASE].ms = sum->base_ms;
    for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
        const bool known = sum->parts_trust[s] != DIP_PRICE_TRUST_DOUBTFUL;
        parts[part_of[s]].ms += known ? sum->parts_ms[s] : 0.0;
    }
}

// Fills a rectangle with slanting stripes, for what the prices of single settings miss.
static void fill_hatched(DipUi *ui, DipRect rect, DipColour colour) {
    const int step = dip_ui_px(ui, HATCH_STEP);
    for (int y = 0; y < rect.height; ++y) {
        for (int x = -(y % step); x < rect.width; x += step) {
            const DipRect stripe = {rect.x + x, rect.y + rect.height - 1 - y, step / 2, 1};
            const DipRect row = {rect.x, stripe.y, rect.width, 1};
            dip_ui_fill(ui, dip_rect_intersect(stripe, row), colour);
        }
    }
}

// Returns the end of the scale of times: 1.2 budgets or, for longer frames, as often twice that. So
// the scale stands still while the time of the frames varies.
static double end_of_scale(double ms, double budget_ms) {
    double end_ms = budget_ms * 1.2;
    while (end_ms < ms * 1.02 && end_ms < 1e6) {
        end_ms *= 2.0;
    }
    return end_ms;
}

// Draws the parts of the sum on one scale with the budget.
static void draw_budget(DipUi *ui, const DipPriceSum *sum, const Part parts[PART_COUNT],
                        double budget_ms, DipRect rect) {
    const double rest_ms = rest_of(sum);
    const double end_ms = end_of_scale(sum->ms - fmin(rest_ms, 0.0), budget_ms);
    const double per_ms = rect.width / end_ms;
    const int budget_x = rect.x + (int)(budget_ms * per_ms);
    double at_ms = 0.0;
    dip_ui_fill(ui, rect, dip_style_well);
    dip_ui_fill(ui, (DipRect){budget_x, rect.y, rect.x + rect.width - budget_x, rect.height},
                dip_style_over);
    for (int i = 0; i < PART_COUNT; ++i) {
        const int from = rect.x + (int)(at_ms * per_ms);
        at_ms += fmax(parts[i].ms, 0.0);
        const int width = rect.x + (int)(at_ms * per_ms) - from - 1;
        if (width > 0) {
            dip_ui_fill(ui, (DipRect){from, rect.y, width, rect.height}, parts[i].colour);
        }
    }
    if (rest_ms > 0.0) {
        const int from = rect.x + (int)(at_ms * per_ms);
        const int width = dip_max(1, (int)(rest_ms * per_ms));
        fill_hatched(ui, (DipRect){from, rect.y, width, rect.height}, dip_style_accent);
    }
    if (rest_ms < 0.0) { // The parts take less time together: what they save is struck out.
        const int from = rect.x + (int)(sum->ms * per_ms);
        const int width = rect.x + (int)(at_ms * per_ms) - from - 1;
        fill_hatched(ui, (DipRect){from, rect.y, width, rect.height}, dip_style_well);
    }
    if (sum->ms > budget_ms) {
        fill_hatched(
            ui,
            (DipRect){budget_x, rect.y, rect.x + (int)(sum->ms * per_ms) - budget_x, rect.height},
            dip_style_worse);
    }
    dip_ui_fill(ui,
                (DipRect){budget_x, rect.y - dip_ui_px(ui, 4), dip_ui_px(ui, 2),
                          rect.height + 2 * dip_ui_px(ui, 4)},
                dip_style_white);
}

// Draws an entry of the legend at *x, *y, or at the start of the next line if it does not fit.
static void draw_entry(DipUi *ui, DipRect room, int *x, int *y, const char *text, DipColour colour,
                       bool hatched) {
    const int swatch = dip_ui_px(ui, SWATCH), gap = dip_ui_px(ui, 4);
    const int width = swatch + gap + dip_ui_text_width(ui, NOTE_SIZE, text) + dip_ui_px(ui, 9);
    if (*x + width - dip_ui_px(ui, 9) > room.x + room.width && *x > room.x) {
        *x = room.x;
        *y += dip_ui_px(ui, LEGEND_HEIGHT);
    }
    const DipRect box = {*x, *y + (dip_ui_line_height(ui, NOTE_SIZE) - swatch) / 2, swatch, swatch};
    if (hatched) {
        fill_hatched(ui, box, colour);
    } else {
        dip_ui_fill(ui, box, colour);
    }
    dip_ui_text(ui, NOTE_SIZE, dip_style_soft, DIP_ALIGN_LEFT, *x + swatch + gap, *y, width, text);
    *x += width;
}

static int draw_legend(DipUi *ui, const DipPriceSum *sum, const Part parts[PART_COUNT],
                       DipRect room) {
    int x = room.x, y = room.y;
    char text[48];
    for (int i = 0; i < PART_COUNT; ++i) {
        if (fabs(parts[i].ms) >= 0.05) {
            const bool frame = i == PART_BASE && sum->state == DIP_PRICE_UNKNOWN;
            snprintf(text, sizeof text, "%s %s%.1f", frame ? "a frame" : parts[i].name,
                     parts[i].ms < 0.0 ? "\u2212" : "", fabs(parts[i].ms));
            draw_entry(ui, room, &x, &y, text, parts[i].colour, false);
        }
    }
    const double rest_ms = rest_of(sum);
    if (fabs(rest_ms) >= 0.05) {
        snprintf(text, sizeof text, "%s %s%.1f", has_doubt(sum) ? "not told apart" : "together",
                 rest_ms < 0.0 ? "\u2212" : "+", fabs(rest_ms));
        draw_entry(ui, room, &x, &y, text, dip_style_accent, true);
    }
    return y + dip_ui_px(ui, LEGEND_HEIGHT) - room.y;
}

// Writes what the panel says beside the sum: its interval or how far it is over the budget, why it
// is doubtful, and of what path it is.
static void format_note(const DipWindow *window, const DipPriceSum *sum, char note[96]) {
    char along[48] = "";
    note[0] = '\0';
    if (sum->state != DIP_PRICE_UNKNOWN && !dip_prices_are_rough(window->prices)) {
        snprintf(along, sizeof along, " along the path");
    }
    if (dip_price_sum_trust(sum) == DIP_PRICE_TRUST_DOUBTFUL) {
        snprintf(note, 96, "doubtful: the machine was busy");
    } else if (sum->ms > window->state->budget_ms) {
        snprintf(note, 96, "%.1f over %.1f%s", sum->ms - window->state->budget_ms,
                 window->state->budget_ms, along);
    } else if (sum->ms_high > sum->ms_low) {
        snprintf(note, 96, "%.1f to %.1f%s", sum->ms_low, sum->ms_high, along);
    }
}

// Writes the sum of a pane, with the digits that it has everywhere.
static void format_sum(const DipWindow *window, int pane, const DipPriceSum *sum,
                       char text[DIP_PANE_TIME_BYTES]) {
    DipPaneTime time = dip_pane_time(window, pane);
    if (sum->state != DIP_PRICE_UNKNOWN) {
        time = (DipPaneTime){.ms = sum->ms,
                             .trust = dip_price_sum_trust(sum),
                             .measured_here = sum->state == DIP_PRICE_ROUGH};
    }
    dip_pane_time_text(&time, text);
}

// Draws the sum and a note beside it.
static void draw_sum(DipUi *ui, const DipWindow *window, const DipPriceSum *sum, DipRect rect) {
    const bool over =
        sum->ms > window->state->budget_ms && dip_price_sum_trust(sum) != DIP_PRICE_TRUST_DOUBTFUL;
    char text[DIP_PANE_TIME_BYTES], note[96];
    format_sum(window, DIP_PANE_REQUESTED, sum, text);
    format_note(window, sum, note);
    dip_ui_text(ui, SUM_SIZE, over ? dip_style_worse : dip_style_accent, DIP_ALIGN_LEFT, rect.x,
                rect.y, rect.width, text);
    const int x = rect.x + dip_ui_text_width(ui, SUM_SIZE, text) + dip_ui_px(ui, 9);
    if (x + dip_ui_text_width(ui, NOTE_SIZE, note) > rect.x + rect.width) {
        return; // The bar below shows it.
    }
    dip_ui_text(ui, NOTE_SIZE, over ? dip_style_worse : dip_style_soft, DIP_ALIGN_LEFT, x,
                rect.y + dip_ui_line_height(ui, SUM_SIZE) - dip_ui_line_height(ui, NOTE_SIZE) -
                    dip_ui_px(ui, 4),
                rect.x + rect.width - x, note);
}

// Declares a button at the right end of a line that measures prices here, where the report is of
// another size, machine or number of threads, or goes back to the report. Returns the room that is
// left beside it.
static int declare_measure_here(DipUi *ui, DipWindow *window, DipRect line) {
    DipPreviewState *state = window->state;
    const char *text = state->measures_here ? "Use the report" : "Measure here";
    char source[400];
    const int width = dip_ui_text_width(ui, 13, text) + dip_ui_px(ui, 16);
    const DipRect button = {line.x + line.width - width, line.y, width, dip_ui_px(ui, SUM_HEIGHT)};
    const bool stale = dip_prices_source(window->prices, window->frames[0].width,
                                         window->frames[0].height, source, sizeof source);
    if (!dip_prices_has_report(window->prices) || !(stale || state->measures_here) ||
        dip_prices_are_of_other_scene(window->prices) || 2 * width > line.width) {
        return line.width;
    }
    if (dip_ui_button(ui, DIP_UI_ID(DIP_UI_SETTINGS, DIP_ID_MEASURE_HERE), button, text,
                      DIP_UI_PLAIN,
                      state->measures_here
                          ? "Shows the prices of the report again."
                          : "The report's prices do not hold for these panes. Measures prices of "
                            "this view instead, while the picture rests.")) {
        state->measures_here = !state->measures_here;
        ++state->scene_changes;
    }
    return line.width - width;
}

// Declares a button that pauses at the right end of a line, where prices are measured only at rest
// and are not known yet. Returns the room that is left beside it.
static int declare_pause(DipUi *ui, DipWindow *window, const DipPriceSum *sum, DipRect line) {
    static const char text[] = "Pause to measure";
    DipPreviewState *state = window->state;
    const int width = dip_ui_text_width(ui, 13, text) + dip_ui_px(ui, 16);
    const DipRect button = {line.x + line.width - width, line.y, width, dip_ui_px(ui, SUM_HEIGHT)};
    if (sum->state != DIP_PRICE_UNKNOWN || !dip_prices_are_rough(window->prices) || state->paused ||
        state->manual || 2 * width > line.width) {
        return line.width;
    }
    if (dip_ui_button(ui, DIP_UI_ID(DIP_UI_SETTINGS, DIP_ID_PAUSE), button, text, DIP_UI_PLAIN,
                      "The tags show what each step costs and gains once the picture rests. The "
                      "space key pauses, too.")) {
        dip_preview_act(state, DIP_ACTION_PAUSE, 0, false, dip_ui_now_ns(ui));
    }
    return line.width - width;
}

static void draw_comparison(DipUi *ui, const DipWindow *window, const DipPriceSum *now,
                            const DipPriceSum *sum, DipRect rect) {
    char text[80], from[DIP_STEP_NAME_BYTES], to[DIP_STEP_NAME_BYTES], time[DIP_PANE_TIME_BYTES];
    format_sum(window, DIP_PANE_CURRENT, now, time);
    snprintf(text, sizeof text, "current %s", time);
    int x = rect.x;
    dip_ui_text(ui, NOTE_SIZE, dip_style_soft, DIP_ALIGN_LEFT, x, rect.y, rect.width, text);
    x += dip_ui_text_width(ui, NOTE_SIZE, text) + dip_ui_px(ui, 14);
    if (!sum->has_flip || !now->has_flip || now->flip <= 0.0) {
        return;
    }
    dip_flip_text(now->flip, false, from);
    dip_flip_text(sum->flip, false, to);
    snprintf(text, sizeof text, "FLIP %s \u2192 %s", from, to);
    dip_ui_text(ui, NOTE_SIZE, dip_style_white, DIP_ALIGN_LEFT, x, rect.y, rect.x + rect.width - x,
                text);
    x += dip_ui_text_width(ui, NOTE_SIZE, text) + dip_ui_px(ui, 9);
    const double change = 100.0 * (sum->flip / now->flip - 1.0);
    if (fabs(change) >= 0.5) {
        snprintf(text, sizeof text, "%s%.0f %%", change < 0.0 ? "\u2212" : "+", fabs(change));
        dip_ui_text(ui, NOTE_SIZE, change < 0.0 ? dip_style_gain : dip_style_worse, DIP_ALIGN_LEFT,
                    x, rect.y, rect.x + rect.width - x, text);
    }
}

// Draws what is being measured, the settings as text and where the prices come from, in the room
// below the buttons. A warning that the prices do not hold comes first, and is never cut: what does
// not fit beside it is left out.
static void draw_source(DipUi *ui, const DipWindow *window, DipRect room) {
    char source[400], settings[200];
    const int line = dip_ui_line_height(ui, NOTE_SIZE);
    const char *progress = dip_prices_progress(window->prices);
    const int bottom = room.y + room.height;
    const bool stale = dip_prices_source(window->prices, window->frames[0].width,
                                         window->frames[0].height, source, sizeof source);
    const bool warns = stale || dip_prices_are_doubtful(window->prices);
    if (progress[0]) {
        room.y +=
            dip_ui_text_block(ui, NOTE_SIZE, dip_style_soft,
                              (DipRect){room.x, room.y, room.width, bottom - room.y}, progress);
    }
    if (warns) {
        room.y += dip_ui_text_block(ui, SMALL_SIZE, dip_style_worse,
                                    (DipRect){room.x, room.y, room.width, bottom - room.y}, source);
    }
    if (room.y + line <= bottom) {
        dip_quality_format_changes(&window->state->quality[DIP_PANE_REQUESTED], settings,
                                   sizeof settings);
        dip_ui_text(ui, NOTE_SIZE, dip_style_white, DIP_ALIGN_LEFT, room.x, room.y, room.width,
                    settings);
        room.y += line;
    }
    if (!warns) {
        dip_ui_text_block(ui, SMALL_SIZE, dip_style_dim,
                          (DipRect){room.x, room.y, room.width, bottom - room.y}, source);
    }
}

void dip_setting_sum_declare(DipUi *ui, DipWindow *window, DipRect rect) {
    const DipPriceSum sum = dip_pane_sum(window, DIP_PANE_REQUESTED);
    const DipPriceSum now = dip_pane_sum(window, DIP_PANE_CURRENT);
    const double budget_ms = window->state->budget_ms;
    Part parts[PART_COUNT];
    const int bottom = rect.y + rect.height;
    int y = rect.y;
    const DipRect line = {rect.x, y, rect.width, 0};
    int room = declare_pause(ui, window, &sum, line);
    if (room == line.width) {
        room = declare_measure_here(ui, window, line);
    }
    if (dip_ui_is_drawing(ui)) {
        draw_sum(ui, window, &sum, (DipRect){rect.x, y, room, 0});
    }
    y += dip_ui_px(ui, SUM_HEIGHT);
    dip_ui_control(
        ui,
        &(DipUiControl){.id = DIP_UI_ID(DIP_UI_SETTINGS, DIP_ID_FLIP),
                        .rect = {rect.x, y, rect.width, dip_ui_line_height(ui, NOTE_SIZE)},
                        .tip = "Times of the current and errors of both panes. FLIP is the error "
                               "that people see when they change between a picture and the "
                               "converged one: 0 is no difference, 1 the greatest. Less is "
                               "better.",
                        .skips_focus = true});
    if (dip_ui_is_drawing(ui)) {
        draw_comparison(ui, window, &now, &sum, (DipRect){rect.x, y, rect.width, 0});
    }
    const int target_y = y + dip_ui_line_height(ui, NOTE_SIZE) + dip_ui_px(ui, 2);
    y += 2 * dip_ui_line_height(ui, NOTE_SIZE) + dip_ui_px(ui, 9);
    dip_target_declare(ui, window,
                       (DipRect){rect.x, target_y, rect.width, y - target_y - dip_ui_px(ui, 3)});
    const int legend_y = y + dip_ui_px(ui, BUDGET_HEIGHT + 6);
    if (dip_ui_is_drawing(ui)) {
        const bool doubtful = dip_price_sum_trust(&sum) == DIP_PRICE_TRUST_DOUBTFUL;
        const DipPriceSum shown = doubtful ? (DipPriceSum){.ms = 0.0} : sum;
        find_parts(&shown, parts);
        draw_budget(ui, &shown, parts, budget_ms,
                    (DipRect){rect.x, y, rect.width, dip_ui_px(ui, BUDGET_HEIGHT)});
        draw_legend(ui, &shown, parts, (DipRect){rect.x, legend_y, rect.width, 0});
    }
    y = legend_y + dip_ui_px(ui, 2 * LEGEND_HEIGHT + 3);
    const int height = dip_ui_px(ui, 28);
    y = dip_min(y, bottom - height);
    dip_setting_buttons_declare(ui, window, (DipRect){rect.x, y, rect.width, height});
    y += height + dip_ui_px(ui, 4);
    if (dip_ui_is_drawing(ui)) {
        draw_source(ui, window, (DipRect){rect.x, y, rect.width, bottom - y});
    }
}
