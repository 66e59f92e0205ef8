// Shows the price of the requested settings: the sum of prices, the parts of this sum against the
// time budget, and where the prices come from. Declares the buttons that act on all settings, and
// the number fields of the target (frames per second and milliseconds per frame).
#include "app/preview/prices/price_text.h"
#include "app/preview/tabs/tabs.h"
#include "app/report/words.h"
#include "app/ui/layout.h"
#include "app/ui/style.h"

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
    return memcmp(&quality, &window->state->quality[DIP_PANE_REQUESTED], sizeof quality) == 0
               ? DIP_UI_CHOSEN
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
    const bool same = memcmp(&state->quality[0], &state->quality[1], sizeof state->quality[0]) == 0;
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

// --- the parts of the sum ------------------------------------------------------------------------

enum { PART_BASE, PART_AA, PART_ADAPTIVE, PART_AF, PART_OTHER, PART_COUNT };

static const char *const part_names[PART_COUNT] = {"base", "AA", "adaptive", "AF", "other"};
static const DipColour part_colours[PART_COUNT] = {{139, 149, 162, 255},
                                                   {255, 190, 92, 255},
                                                   {240, 140, 58, 255},
                                                   {255, 226, 143, 255},
                                                   {196, 202, 210, 255}};

// A sum of prices, divided into the parts that the bar and the legend show.
typedef struct Parts {
    double ms[PART_COUNT]; // Time of each part. Doubtful prices are left out.
    double rest_ms;        // The rest of the sum: doubtful prices, and DipPriceSum.together_ms.
    bool doubt;            // rest_ms includes a doubtful price.
} Parts;

static Parts parts_of(const DipPriceSum *sum) {
    static const int part_of[DIP_SETTING_COUNT] = {
        [DIP_SETTING_AA] = PART_AA,          [DIP_SETTING_TAA] = PART_AA,
        [DIP_SETTING_AAA] = PART_ADAPTIVE,   [DIP_SETTING_ASD] = PART_ADAPTIVE,
        [DIP_SETTING_AF] = PART_AF,          [DIP_SETTING_AAF] = PART_AF,
        [DIP_SETTING_OPT] = PART_OTHER,      [DIP_SETTING_MIPLOD] = PART_OTHER,
        [DIP_SETTING_SCALE] = PART_OTHER,    [DIP_SETTING_UPSCALE] = PART_OTHER,
        [DIP_SETTING_POST] = PART_OTHER,     [DIP_SETTING_SHARPEN] = PART_OTHER,
        [DIP_SETTING_SHADOWS] = PART_OTHER,  [DIP_SETTING_GI] = PART_OTHER,
        [DIP_SETTING_MIPDEBUG] = PART_OTHER,
    };
    Parts parts = {.ms = {[PART_BASE] = sum->base_ms}, .rest_ms = sum->together_ms};
    for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
        const bool doubtful = sum->parts_trust[s] == DIP_PRICE_TRUST_DOUBTFUL;
        if (doubtful) {
            parts.rest_ms += sum->parts_ms[s];
            parts.doubt = true;
        } else {
            parts.ms[part_of[s]] += sum->parts_ms[s];
        }
    }
    return parts;
}

// Fills a rectangle with slanting stripes.
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

// Returns the time at the end of the bar's scale: 1.2 budgets, doubled until `ms` fits. Since the
// end only doubles, the scale seldom changes while frame times vary.
static double end_of_scale(double ms, double budget_ms) {
    double end_ms = budget_ms * 1.2;
    while (end_ms < ms * 1.02 && end_ms < 1e6) {
        end_ms *= 2.0;
    }
    return end_ms;
}

// Draws the parts of the sum as a bar, with a mark at the budget.
static void draw_budget(DipUi *ui, const Parts *parts, double sum_ms, double budget_ms,
                        DipRect rect) {
    const double rest_ms = parts->rest_ms;
    const double per_ms = rect.width / end_of_scale(sum_ms - fmin(rest_ms, 0.0), budget_ms);
    const int over_budget = (int)(budget_ms * per_ms), end = (int)(sum_ms * per_ms);
    const int overhang = dip_ui_px(ui, 4);
    DipRect over = rect, bar = rect;
    double at_ms = 0.0;
    dip_ui_fill(ui, rect, dip_style_well);
    dip_cut_left(&over, over_budget);
    dip_ui_fill(ui, over, dip_style_over);
    for (int i = 0; i < PART_COUNT; ++i) {
        bar.x = rect.x + (int)(at_ms * per_ms);
        at_ms += fmax(parts->ms[i], 0.0);
        bar.width = rect.x + (int)(at_ms * per_ms) - bar.x - 1;
        dip_ui_fill(ui, bar, part_colours[i]);
    }
    const int parts_end = (int)(at_ms * per_ms);
    if (rest_ms > 0.0) {
        const int width = dip_max(1, (int)(rest_ms * per_ms));
        fill_hatched(ui, (DipRect){rect.x + parts_end, rect.y, width, rect.height},
                     dip_style_accent);
    }
    if (rest_ms < 0.0) { // The sum is less than its parts together. Stripes cover the difference.
        fill_hatched(ui, (DipRect){rect.x + end, rect.y, parts_end - end - 1, rect.height},
                     dip_style_well);
    }
    if (sum_ms > budget_ms) {
        over.width = end - over_budget;
        fill_hatched(ui, over, dip_style_worse);
    }
    over.width = dip_ui_px(ui, 2);
    dip_ui_fill(ui, dip_rect_inset(over, 0, -overhang), dip_style_white);
}

// Draws an entry of the legend at the left side of *rest, or in the row below if it does not fit.
// Draws nothing if the time rounds to 0.0. room: the legend's first row.
static void draw_entry(DipUi *ui, DipRect room, DipRect *rest, const char *name, double ms,
                       DipPriceTrust trust, DipColour colour, bool rest_of_sum) {
    const int swatch = dip_ui_px(ui, SWATCH), gap = dip_ui_px(ui, 4);
    char text[64], digits[DIP_STEP_NAME_BYTES];
    if (fabs(ms) < 0.05) {
        return;
    }
    if (rest_of_sum) {
        dip_panel_number(ms, 1, true, digits);
    } else {
        dip_ms_text(ms, trust, INFINITY, digits);
    }
    snprintf(text, sizeof text, "%s %s", name, digits);
    const int width = swatch + gap + dip_ui_text_width(ui, NOTE_SIZE, text);
    if (width > rest->width && rest->x > room.x) {
        const int y = rest->y + dip_ui_px(ui, LEGEND_HEIGHT);
        *rest = room;
        rest->y = y;
    }
    const DipRect box = dip_rect_middle(dip_cut_left(rest, swatch), swatch, swatch);
    (rest_of_sum ? fill_hatched : dip_ui_fill)(ui, box, colour);
    dip_cut_left(rest, gap);
    dip_ui_word(ui, NOTE_SIZE, dip_style_soft, rest, dip_ui_px(ui, 9), text);
}

static void draw_legend(DipUi *ui, const DipPriceSum *sum, const Parts *parts, DipRect row) {
    DipRect rest = row;
    for (int i = 0; i < PART_COUNT; ++i) {
        const bool frame = i == PART_BASE && sum->state == DIP_PRICE_UNKNOWN;
        draw_entry(ui, row, &rest, frame ? "a frame" : part_names[i], parts->ms[i],
                   i == PART_BASE ? sum->base_trust : DIP_PRICE_TRUST_KNOWN, part_colours[i],
                   false);
    }
    draw_entry(ui, row, &rest, parts->doubt ? "doubtful parts" : "together", parts->rest_ms,
               DIP_PRICE_TRUST_KNOWN, dip_style_accent, true);
}

// --- the sum -------------------------------------------------------------------------------------

// Writes the note beside the sum. The note says that the sum is doubtful, or what its 95 % interval
// is; the note is empty if neither applies. A note of the interval ends with " along the path" if
// the sum is the price of a path and not of the picture in view, or with the size of the report's
// picture (dip_pane_time_scope).
static void format_note(const DipWindow *window, const DipPriceSum *sum, char note[96]) {
    const double budget_ms = window->state->budget_ms;
    char from[DIP_STEP_NAME_BYTES], to[DIP_STEP_NAME_BYTES], scope[DIP_PANE_SCOPE_BYTES];
    dip_pane_time_scope(window, sum, scope);
    note[0] = '\0';
    if (dip_price_sum_trust(sum) == DIP_PRICE_TRUST_DOUBTFUL) {
        if (sum->doubtful) {
            snprintf(note, 96, "doubtful: the machine was busy");
        } else {
            snprintf(note, 96, "doubtful: its times differ too much");
        }
    } else if (sum->ms_high > sum->ms_low) {
        dip_ms_text(sum->ms_low, DIP_PRICE_TRUST_KNOWN, budget_ms, from);
        dip_ms_text(sum->ms_high, DIP_PRICE_TRUST_KNOWN, budget_ms, to);
        snprintf(note, 96, "%s to %s%s", from, to, scope);
    }
}

// Draws the sum and a note beside it. If room is short, the letters of the sum shrink until the sum
// fits, but not below the size of the note's letters. A note that does not fit whole is left out.
static void draw_sum(DipUi *ui, const DipWindow *window, const DipPriceSum *sum, DipRect rect) {
    const DipColour colour = dip_pane_is_over(window, sum) ? dip_style_worse : dip_style_accent;
    char text[DIP_PANE_TIME_BYTES], note[96];
    int size = SUM_SIZE;
    dip_pane_time_text(window, DIP_PANE_REQUESTED, text);
    format_note(window, sum, note);
    while (size > NOTE_SIZE && dip_ui_text_width(ui, size, text) > rect.width) {
        --size;
    }
    rect.height = dip_ui_line_height(ui, SUM_SIZE);
    dip_ui_word(ui, size, colour, &rect, dip_ui_px(ui, 9), text);
    dip_cut_bottom(&rect, dip_ui_px(ui, 4));
    if (dip_ui_text_width(ui, NOTE_SIZE, note) <= rect.width) { // The whole note fits.
        dip_ui_line(ui, NOTE_SIZE, dip_style_soft,
                    &(DipRect){rect.x, dip_rect_bottom(rect) - dip_ui_line_height(ui, NOTE_SIZE),
                               rect.width, 0},
                    "%s", note);
    }
}

// Where the prices come from, and whether that is a warning: the prices are stale or doubtful.
typedef struct Source {
    char text[400];
    bool stale;
    bool warns;
} Source;

static Source source_of(const DipWindow *window) {
    Source source;
    source.stale = dip_prices_source(window->prices, window->frames[0].width,
                                     window->frames[0].height, source.text, sizeof source.text);
    source.warns = source.stale || dip_prices_are_doubtful(window->prices);
    return source;
}

// Declares a button at the right end of *line, and cuts the button off *line. Leaves out a button
// that would take more than half of the line. Returns whether the button was pressed.
static bool end_button(DipUi *ui, int id, DipRect *line, const char *text, const char *tip) {
    const int width = dip_ui_text_width(ui, 13, text) + dip_ui_px(ui, 16);
    return 2 * width <= line->width &&
           dip_ui_button(ui, id_of(id), dip_cut_right(line, width), text, DIP_UI_PLAIN, tip);
}

// Declares a button by which the user gets prices for this view, if such a button is needed. While
// live prices (prices.h) are not known and time runs, the button stops time, since live prices are
// measured at rest. If the report's prices do not hold for the panes, the button changes between
// the report and live prices. A report of another scene needs no button, since live prices take its
// place by themselves.
static void declare_measure(DipUi *ui, DipWindow *window, const DipPriceSum *sum,
                            const Source *source, DipRect *line) {
    DipPreviewState *state = window->state;
    const DipPrices *prices = window->prices;
    if (sum->state == DIP_PRICE_UNKNOWN && dip_prices_are_rough(prices) &&
        dip_preview_time_runs(state)) {
        const int room = line->width;
        if (end_button(ui, DIP_ID_PAUSE, line, "Pause to measure",
                       "Each step shows its price in time and error once the picture rests. The "
                       "space key pauses, too.")) {
            dip_preview_act(state, DIP_ACTION_PAUSE, 0, false, dip_ui_now_ns(ui));
        }
        if (line->width < room) {
            return;
        }
    }
    if (dip_prices_has_report(prices) && (source->stale || state->measures_here) &&
        !dip_prices_are_of_other_scene(prices) &&
        end_button(ui, DIP_ID_MEASURE_HERE, line,
                   state->measures_here ? "Use the report" : "Measure here",
                   state->measures_here
                       ? "Shows the prices of the report again."
                       : "The report's prices do not hold for these panes. Measures prices of "
                         "this view instead, while the picture rests.")) {
        state->measures_here = !state->measures_here;
        ++state->scene_changes;
    }
}

// Draws the current pane's time. If the FLIP of both panes is known and the current pane's is above
// 0, also draws both values, and by how much they differ in per cent.
static void draw_comparison(DipUi *ui, const DipWindow *window, const DipPriceSum *sum,
                            DipRect line) {
    const DipPriceSum now = dip_pane_sum(window, DIP_PANE_CURRENT);
    char text[80], from[DIP_STEP_NAME_BYTES], to[DIP_STEP_NAME_BYTES], time[DIP_PANE_TIME_BYTES];
    dip_pane_time_text(window, DIP_PANE_CURRENT, time);
    snprintf(text, sizeof text, "current %s", time);
    dip_ui_word(ui, NOTE_SIZE, dip_style_soft, &line, dip_ui_px(ui, 14), text);
    if (!sum->has_flip || !now.has_flip || now.flip <= 0.0) {
        return;
    }
    dip_flip_text(now.flip, false, from);
    dip_flip_text(sum->flip, false, to);
    snprintf(text, sizeof text, "FLIP %s \u2192 %s", from, to);
    dip_ui_word(ui, NOTE_SIZE, dip_style_white, &line, dip_ui_px(ui, 9), text);
    const double change = 100.0 * (sum->flip / now.flip - 1.0);
    if (fabs(change) >= 0.5) {
        dip_panel_number(change, 0, true, from);
        snprintf(text, sizeof text, "%s %%", from);
        dip_ui_word(ui, NOTE_SIZE, change < 0.0 ? dip_style_gain : dip_style_worse, &line, 0, text);
    }
}

// Writes what is being measured, the settings, and where the prices come from. If the prices are
// doubtful or do not hold for the panes, their source is a warning and comes before the settings,
// so that a lack of room cuts the settings first.
static void draw_source(DipUi *ui, const DipWindow *window, const Source *source, DipRect room) {
    char settings[DIP_SETTINGS_BYTES];
    const char *progress = dip_prices_progress(window->prices);
    if (progress[0]) {
        dip_cut_top(&room, dip_ui_text_block(ui, NOTE_SIZE, dip_style_soft, room, progress));
    }
    if (source->warns) {
        dip_cut_top(&room, dip_ui_text_block(ui, SMALL_SIZE, dip_style_worse, room, source->text));
    }
    if (dip_ui_line_height(ui, NOTE_SIZE) <= room.height) {
        dip_quality_format_changes(&window->state->quality[DIP_PANE_REQUESTED], settings,
                                   sizeof settings);
        dip_ui_line(ui, NOTE_SIZE, dip_style_white, &room, "%s", settings);
    }
    if (!source->warns && dip_ui_text_block_height(ui, SMALL_SIZE, room.width, source->text) <=
                              room.height) { // The whole text fits.
        dip_ui_text_block(ui, SMALL_SIZE, dip_style_dim, room, source->text);
    }
}

// Returns the height of the texts that draw_source must not cut: the progress, and the source if it
// is a warning.
static int source_height(const DipUi *ui, const DipWindow *window, const Source *source,
                         int width) {
    const char *progress = dip_prices_progress(window->prices);
    return (progress[0] ? dip_ui_text_block_height(ui, NOTE_SIZE, width, progress) : 0) +
           (source->warns ? dip_ui_text_block_height(ui, SMALL_SIZE, width, source->text) : 0);
}

void dip_setting_sum_declare(DipUi *ui, DipWindow *window, DipRect rect) {
    const DipPriceSum sum = dip_pane_sum(window, DIP_PANE_REQUESTED);
    const bool doubtful = dip_price_sum_trust(&sum) == DIP_PRICE_TRUST_DOUBTFUL;
    const DipPriceSum none = {.ms = 0.0};
    const DipPriceSum shown = doubtful ? none : sum;
    const Parts parts = parts_of(&shown);
    const Source source = source_of(window);
    const int note = dip_ui_line_height(ui, NOTE_SIZE), thin = dip_ui_px(ui, 3);
    DipRect rest = rect;
    DipRect line = dip_cut_top(&rest, dip_ui_px(ui, SUM_HEIGHT));
    declare_measure(ui, window, &sum, &source, &line);
    draw_sum(ui, window, &sum, line);
    line = dip_cut_top(&rest, note);
    dip_ui_control(
        ui,
        &(DipUiControl){.id = id_of(DIP_ID_FLIP),
                        .rect = line,
                        .tip = "The current pane's time, and both panes' errors. FLIP is the error "
                               "that people see when they change between a picture and the "
                               "converged one: 0 is no difference, 1 the greatest. Less is "
                               "better.",
                        .skips_focus = true});
    draw_comparison(ui, window, &sum, line);
    line = dip_cut_top(&rest, note + dip_ui_px(ui, 9));
    dip_cut_top(&line, dip_ui_px(ui, 2));
    dip_cut_bottom(&line, thin);
    dip_target_declare(ui, window, line);
    line = dip_cut_top(&rest, dip_ui_px(ui, BUDGET_HEIGHT + 6));
    line.height = dip_ui_px(ui, BUDGET_HEIGHT);
    draw_budget(ui, &parts, shown.ms, window->state->budget_ms, line);
    const int buttons = dip_ui_px(ui, 28), gap = dip_ui_px(ui, 4);
    // The legend gets only the room that progress and warnings (source_height) leave.
    const int spare = rest.height - buttons - gap - source_height(ui, window, &source, rest.width);
    line = dip_cut_top(&rest, dip_max(0, dip_min(dip_ui_px(ui, 2 * LEGEND_HEIGHT + 3), spare)));
    if (line.height >= note) {
        line.height = note;
        draw_legend(ui, &shown, &parts, line);
    }
    // If the legend has more rows than room, the buttons cover the last rows.
    line = dip_cut_top(&rest, buttons);
    line.y = dip_min(line.y, dip_rect_bottom(rect) - line.height);
    dip_setting_buttons_declare(ui, window, line);
    rest.y = dip_rect_bottom(line) + gap;
    rest.height = dip_rect_bottom(rect) - rest.y;
    draw_source(ui, window, &source, rest);
}
