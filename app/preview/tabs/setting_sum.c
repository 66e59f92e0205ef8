// Shows the price of the requested settings: the sum of prices, the parts of this sum against the
// time budget, and where the prices come from.
#include "app/preview/prices/price_text.h"
#include "app/preview/tabs/sum_parts.h"
#include "app/preview/tabs/tabs.h"
#include "app/ui/layout.h"
#include "app/ui/style.h"

#include <math.h>
#include <stdio.h>

enum { SUM_SIZE = 22, NOTE_SIZE = 11, SMALL_SIZE = 10, SUM_HEIGHT = 28, BUDGET_HEIGHT = 18 };

static DipUiId id_of(int control) {
    return DIP_UI_ID(DIP_UI_SETTINGS, control);
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
    dip_sum_bar_draw(ui, &shown, window->state->budget_ms, line);
    const int buttons = dip_ui_px(ui, 28), gap = dip_ui_px(ui, 4);
    // The legend gets only the room that progress and warnings (source_height) leave.
    const int spare = rest.height - buttons - gap - source_height(ui, window, &source, rest.width);
    line = dip_cut_top(&rest,
                       dip_max(0, dip_min(dip_ui_px(ui, 2 * DIP_SUM_LEGEND_HEIGHT + 3), spare)));
    if (line.height >= note) {
        line.height = note;
        dip_sum_legend_draw(ui, &shown, line);
    }
    // If the legend has more rows than room, the buttons cover the last rows.
    line = dip_cut_top(&rest, buttons);
    line.y = dip_min(line.y, dip_rect_bottom(rect) - line.height);
    dip_setting_buttons_declare(ui, window, line);
    rest.y = dip_rect_bottom(line) + gap;
    rest.height = dip_rect_bottom(rect) - rest.y;
    draw_source(ui, window, &source, rest);
}
