// Declares the advice tab: the best settings for a time budget, what the next better settings cost,
// and a plot of all settings that can be chosen. With live prices, a text about cost reports takes
// the place of the next better settings and of the plot. Everything else comes from the preview's
// choice (prices/choice.h), which is computed from a cost report or from live prices (prices.h).
#include "app/files/put.h"
#include "app/preview/prices/price_text.h"
#include "app/preview/tabs/tabs.h"
#include "app/report/words.h"
#include "app/ui/layout.h"
#include "app/ui/style.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

// Sizes at scale 1.
enum {
    SIZE = 13,
    NOTE_SIZE = 11,
    AXIS_WIDTH = 34,
    SUM_SIZE = 22,
    MARGIN = 10,
    GAP = 20,
    LEFT_WIDTH = 272,
    RIGHT_WIDTH = 300,
    NOTE_WIDTH = 220,
    BUDGET_COLUMNS = 4,
    BUTTON_HEIGHT = 28
};
enum { ID_BUDGETS = 1, ID_TRY = 100, ID_UP, ID_DOWN, ID_TABLE };

static DipUiId id_of(int index) {
    return DIP_UI_ID(DIP_UI_ADVICE, index);
}

// Writes a line at the top of *room, and cuts the line and a gap off *room. Leaves out a line that
// does not fit.
__attribute__((format(printf, 5, 6))) static void
write_line(DipUi *ui, int size, DipColour colour, DipRect *room, const char *format, ...) {
    char text[200];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    DipRect line = dip_cut_top(room, dip_ui_line_height(ui, size));
    if (room->height >= 0) {
        dip_ui_line(ui, size, colour, &line, "%s", text);
    }
    dip_cut_top(room, dip_ui_px(ui, 3));
}

static void try_settings(DipUi *ui, DipWindow *window, const DipQuality *quality) {
    char text[DIP_SETTINGS_BYTES];
    dip_quality_format_changes(quality, text, sizeof text);
    dip_preview_set_quality(window->state, DIP_PANE_REQUESTED, quality, dip_ui_now_ns(ui));
    dip_preview_notice(window->state, dip_ui_now_ns(ui), "Requested: %.180s", text);
}

// --- the advice ----------------------------------------------------------------------------------

// Declares a button for each budget at the top of *room, and cuts the buttons off *room.
static void declare_budgets(DipUi *ui, DipWindow *window, DipRect *room) {
    DipPreviewState *state = window->state;
    double list[DIP_COST_MAX_BUDGETS];
    const int count = dip_preview_budgets(state, list);
    const int gap = dip_ui_px(ui, 6), height = dip_ui_px(ui, BUTTON_HEIGHT);
    for (int i = 0; i < count; ++i) {
        char name[DIP_NUMBER_BYTES + 4];
        dip_budget_ms_text(list[i], name);
        strcat(name, " ms");
        if (dip_ui_button(ui, id_of(ID_BUDGETS + i),
                          dip_rect_cell(*room, BUDGET_COLUMNS, height, gap, gap, i), name,
                          fabs(list[i] - state->budget_ms) < 0.05 ? DIP_UI_CHOSEN : DIP_UI_PLAIN,
                          "Shows the settings with the least error within this time per frame. "
                          "They change nothing until you try them.")) {
            dip_preview_set_budget(state, list[i]);
        }
    }
    dip_cut_top(room, (count + BUDGET_COLUMNS - 1) / BUDGET_COLUMNS * (height + gap));
}

// Writes the figures of the advised settings, the settings themselves, and a warning if the report
// was measured at another size than the panes have.
static void write_advised(DipUi *ui, const DipWindow *window, const DipCandidate *advised,
                          DipRect *room) {
    const DipPreviewChoice *choice = window->state->choice;
    const DipCostReport *report = choice->live ? NULL : window->state->costs;
    const DipPixels *frame = &window->frames[0];
    char text[200], number[DIP_NUMBER_BYTES], flip[DIP_STEP_NAME_BYTES];
    dip_ms_text(advised->time.value, DIP_PRICE_TRUST_KNOWN, choice->advice.budget_ms, number);
    write_line(ui, SUM_SIZE, dip_style_accent, room, "%s%s ms", choice->live ? DIP_ROUGH_MARK : "",
               number);
    dip_fits_text(choice->advice.fits, number);
    write_line(ui, NOTE_SIZE, dip_style_soft, room, "%s; fits with %s",
               dip_time_kind_names[choice->candidates.kind], number);
    dip_flip_text(advised->flip, false, flip);
    if (choice->base >= 0 && choice->candidates.list[choice->base].flip > 0.0) {
        const double base = choice->candidates.list[choice->base].flip;
        dip_panel_number(100.0 * (advised->flip / base - 1.0), 0, true, number);
        write_line(ui, NOTE_SIZE, dip_style_soft, room, "FLIP %s, %s %% of the baseline's", flip,
                   number);
    } else {
        write_line(ui, NOTE_SIZE, dip_style_soft, room, "FLIP %s", flip);
    }
    dip_quality_format_changes(&advised->quality, text, sizeof text);
    write_line(ui, NOTE_SIZE, dip_style_white, room, "%s", text);
    if (choice->advice.tie_count > 0) {
        write_line(ui, NOTE_SIZE, dip_style_soft, room, "%d more within 1 %% of its FLIP",
                   choice->advice.tie_count);
    }
    if (report && (report->width != frame->width || report->height != frame->height)) {
        write_line(ui, NOTE_SIZE, dip_style_worse, room, "Of %dx%d; the panes have %dx%d.",
                   report->width, report->height, frame->width, frame->height);
    }
}

static void write_why_not(DipUi *ui, const DipWindow *window, DipRect *room) {
    char text[200] = "A scene of the gallery has no errors to choose by.";
    if (!window->figures[DIP_PANE_REQUESTED].no_errors) {
        dip_preview_choice_why(window->state->choice, dip_prices_progress(window->prices), text,
                               sizeof text);
    }
    dip_ui_text_block(ui, SIZE, dip_style_soft, *room, text);
    dip_cut_top(room, 3 * dip_ui_line_height(ui, SIZE));
}

static void declare_try(DipUi *ui, DipWindow *window, const DipCandidate *advised, DipRect rect) {
    DipPreviewState *state = window->state;
    const DipPreviewChoice *choice = state->choice;
    const bool waits =
        choice->live && (choice->known != DIP_PRICES_KNOWN || choice->candidates.disturbed);
    if (waits && dip_preview_time_runs(state)) {
        if (dip_ui_button(ui, id_of(ID_TRY), rect, "Pause to measure", DIP_UI_PRIMARY,
                          "Pauses, so that the prices can be measured (Space).")) {
            dip_preview_act(state, DIP_ACTION_PAUSE, 0, false, dip_ui_now_ns(ui));
        }
        return;
    }
    const bool same =
        advised && dip_quality_equal(&advised->quality, &state->quality[DIP_PANE_REQUESTED]);
    if (dip_ui_button(ui, id_of(ID_TRY), rect, "Try it right",
                      advised && !same ? DIP_UI_PRIMARY : DIP_UI_OFF,
                      same      ? "The right pane has these settings."
                      : advised ? "Gives the requested pane these settings. Apply is separate (K)."
                                : "There is no advice.")) {
        try_settings(ui, window, &advised->quality);
    }
}

static void declare_advised(DipUi *ui, DipWindow *window, DipRect room) {
    const DipCandidate *advised = dip_preview_advised(window->state->choice);
    const int height = dip_ui_px(ui, BUTTON_HEIGHT), gap = dip_ui_px(ui, 8);
    DipRect rest = room;
    write_line(ui, SIZE, dip_style_white, &rest,
               window->state->choice->live ? "Best picture within, roughly"
                                           : "Best picture within");
    declare_budgets(ui, window, &rest);
    if (advised) {
        write_advised(ui, window, advised, &rest);
    } else {
        write_why_not(ui, window, &rest);
    }
    rest.y = dip_min(rest.y + gap / 2, dip_rect_bottom(room) - height);
    declare_try(ui, window, advised, dip_rect_cell(rest, 2, height, gap, gap, 0));
    if (dip_ui_button(ui, id_of(ID_TABLE), dip_rect_cell(rest, 2, height, gap, gap, 1), "All steps",
                      DIP_UI_PLAIN,
                      "Shows the time and error of every step of every setting (U).")) {
        dip_preview_act(window->state, DIP_ACTION_COSTS, 0, false, dip_ui_now_ns(ui));
    }
}

// --- one step up and down ------------------------------------------------------------------------

// Writes what changes from one combination of settings to another: "asd 1 → 2".
static void format_change(const DipQuality *from, const DipQuality *to, char text[160]) {
    text[0] = '\0';
    for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
        if (from->step[s] != to->step[s]) {
            const DipSettingInfo *info = dip_setting_info((DipSetting)s);
            dip_put_append(text, 160, "%s%s %s \u2192 %s", text[0] ? ", " : "", info->key,
                           info->steps[from->step[s]], info->steps[to->step[s]]);
        }
    }
}

// Returns the slowest candidate of the Pareto front (choice.h) that is faster than the advised one,
// or NULL if there is none.
static const DipCandidate *next_faster(const DipPreviewChoice *choice,
                                       const DipCandidate *advised) {
    const DipCandidate *found = NULL;
    for (int i = 0; i < choice->front_count; ++i) {
        const DipCandidate *c = &choice->candidates.list[choice->front[i]];
        found = c->time.value < advised->time.value ? c : found;
    }
    return found;
}

// Declares a button that tries other settings, at the top of *room, and cuts the button and a gap
// off *room. to: the other settings, or NULL if there are none. up: true if these settings are
// better and slower than the advised ones, false if they are worse and faster.
static void declare_step(DipUi *ui, DipWindow *window, const DipCandidate *advised,
                         const DipCandidate *to, bool up, DipRect *room) {
    const int pad = dip_ui_px(ui, 8), radius = dip_ui_px(ui, 4);
    const int line = dip_ui_line_height(ui, SIZE), note = dip_ui_line_height(ui, NOTE_SIZE);
    const DipRect box = dip_cut_top(room, line + note + pad);
    char text[160], number[DIP_NUMBER_BYTES], flip[DIP_STEP_NAME_BYTES];
    const DipUiInput input = dip_ui_control(
        ui, &(DipUiControl){.id = id_of(up ? ID_UP : ID_DOWN),
                            .rect = box,
                            .tip = up ? "The fastest settings with at least 1 % less FLIP: what "
                                        "they cost and gain. A click tries them in the right pane."
                                      : "The next faster combination of the front: what it saves "
                                        "and loses. A click tries it in the right pane.",
                            .disabled = !to});
    dip_cut_top(room, dip_ui_px(ui, 6));
    dip_ui_fill_round(ui, box, radius, dip_style_raised);
    if (input.hovered && to) {
        dip_ui_outline(ui, box, radius, dip_ui_px(ui, 1), dip_style_soft);
    }
    dip_ui_focus_ring(ui, box, radius, &input);
    DipRect inside = dip_rect_inset(box, pad, pad / 2);
    DipRect row = dip_cut_top(&inside, line);
    dip_ui_label(ui, SIZE, dip_style_white, DIP_ALIGN_LEFT, row, up ? "next better" : "faster");
    if (!to) {
        row.height = note;
        dip_ui_label(ui, NOTE_SIZE, dip_style_dim, DIP_ALIGN_RIGHT, row,
                     up ? "nothing measured" : "nothing measured is faster");
        return;
    }
    dip_flip_text(to->flip - advised->flip, true, flip);
    dip_panel_number(to->time.value - advised->time.value, 1, true, number);
    snprintf(text, sizeof text, "%s ms", number);
    dip_ui_label(ui, SIZE, up ? dip_style_gain : dip_style_worse, DIP_ALIGN_RIGHT, row, flip);
    dip_cut_right(&row, dip_ui_text_width(ui, SIZE, flip) + pad);
    dip_ui_label(ui, SIZE, dip_style_soft, DIP_ALIGN_RIGHT, row, text);
    format_change(&advised->quality, &to->quality, text);
    dip_ui_line(ui, NOTE_SIZE, dip_style_soft, &inside, "%s", text);
    if (input.pressed) {
        try_settings(ui, window, &to->quality);
    }
}

static void declare_steps(DipUi *ui, DipWindow *window, DipRect room) {
    const DipPreviewChoice *choice = window->state->choice;
    const DipCandidate *advised = dip_preview_advised(choice);
    char heading[DIP_COSTS_HEADING] = "", fits[DIP_NUMBER_BYTES];
    if (!advised) {
        return; // The reason stands on the left.
    }
    write_line(ui, SIZE, dip_style_white, &room, "One step");
    const int next = choice->advice.next;
    declare_step(ui, window, advised, next >= 0 ? &choice->candidates.list[next] : NULL, true,
                 &room);
    if (next >= 0) {
        dip_fits_text(choice->advice.next_fits, fits);
        write_line(ui, NOTE_SIZE, dip_style_soft, &room, "The next better fits with %s.", fits);
    }
    declare_step(ui, window, advised, next_faster(choice, advised), false, &room);
    if (!choice->live && window->state->costs) {
        dip_costs_heading(window->state->costs, heading);
    }
    dip_ui_text_block(ui, NOTE_SIZE, dip_style_dim, room, heading);
}

// Writes how to make a cost report, which measures combinations of settings along whole camera
// paths.
static void write_how_to(DipUi *ui, const DipWindow *window, DipRect room) {
    char text[2 * DIP_SCENE_WORDS_BYTES + 512];
    snprintf(text, sizeof text,
             "This advice is for this view: some combinations were timed here, and the others are "
             "predicted from their work.\n"
             "Advice for whole paths comes from a cost report, which measures combinations. "
             "This makes one in some minutes, and then starts the preview with it:\n"
             "diptych cost%s --out report\n"
             "diptych%s --cost report/cost.json",
             window->state->scene_words, window->state->scene_words);
    dip_ui_text_block(ui, NOTE_SIZE, dip_style_soft, room, text);
}

// --- the plot ------------------------------------------------------------------------------------

// Times have a logarithmic axis, as on the report's page: the slowest combinations take many times
// as long as those near the budget.
static const double LEAST_MS = 0.01;

typedef struct Plot {
    DipRect rect;
    double from_ms;
    double to_ms;
    double from_flip;
    double to_flip;
} Plot;

static int plot_x(const Plot *plot, double ms) {
    const double share = log(fmax(ms, LEAST_MS) / plot->from_ms) / log(plot->to_ms / plot->from_ms);
    return plot->rect.x + (int)(fmin(fmax(share, 0.0), 1.0) * (plot->rect.width - 1));
}

static int plot_y(const Plot *plot, double flip) {
    const double share = (flip - plot->from_flip) / (plot->to_flip - plot->from_flip);
    return plot->rect.y + (int)((1.0 - fmin(fmax(share, 0.0), 1.0)) * (plot->rect.height - 1));
}

static Plot plot_of(const DipCandidates *candidates, double budget_ms, DipRect rect) {
    Plot plot = {rect, INFINITY, budget_ms * 1.1, INFINITY, 0.0};
    for (int i = 0; i < candidates->count; ++i) {
        const DipCandidate *point = &candidates->list[i];
        plot.from_ms = fmin(plot.from_ms, point->time.value);
        plot.to_ms = fmax(plot.to_ms, point->time.value);
        plot.from_flip = fmin(plot.from_flip, point->flip);
        plot.to_flip = fmax(plot.to_flip, point->flip);
    }
    const double flip = fmax(plot.to_flip - plot.from_flip, 1e-5);
    plot.from_ms = fmax(plot.from_ms, LEAST_MS) * 0.9;
    plot.to_ms *= 1.1;
    plot.from_flip -= 0.08 * flip;
    plot.to_flip += 0.08 * flip;
    return plot;
}

// Draws a disc at a candidate's time and error.
static void draw_dot(DipUi *ui, const Plot *plot, const DipCandidate *point, int side,
                     DipColour colour) {
    const int size = dip_ui_px(ui, side);
    const DipRect disc = {plot_x(plot, point->time.value) - size / 2,
                          plot_y(plot, point->flip) - size / 2, size, size};
    dip_ui_fill_round(ui, disc, size / 2, colour);
}

// Draws the Pareto front as stairs. At each time, the stairs are as high as the least error of the
// settings on the front that take at most this time.
static void draw_front(DipUi *ui, const Plot *plot, const DipPreviewChoice *choice) {
    const int thick = dip_ui_px(ui, 1);
    const DipCandidate *last = NULL;
    for (int i = 0; i < choice->front_count; ++i) {
        const DipCandidate *point = &choice->candidates.list[choice->front[i]];
        if (last) {
            const int x0 = plot_x(plot, last->time.value), x1 = plot_x(plot, point->time.value);
            const int y0 = plot_y(plot, last->flip), y1 = plot_y(plot, point->flip);
            dip_ui_fill(ui, (DipRect){x0, y0, x1 - x0 + thick, thick}, dip_style_gain);
            dip_ui_fill(ui, (DipRect){x1, y0, thick, y1 - y0 + thick}, dip_style_gain);
        }
        draw_dot(ui, plot, point, 7, dip_style_gain);
        last = point;
    }
}

// Writes round times below the plot: each that has room beside the one before it.
static void draw_times(DipUi *ui, const Plot *plot) {
    static const double round_numbers[] = {1.0, 1.5, 2.0, 3.0, 5.0, 7.0};
    enum { ROUND_NUMBERS = sizeof round_numbers / sizeof *round_numbers };
    const int room = dip_ui_px(ui, 34), y = dip_rect_bottom(plot->rect) + dip_ui_px(ui, 2);
    int last = plot->rect.x - room;
    for (double decade = LEAST_MS; decade < plot->to_ms; decade *= 10.0) {
        for (int i = 0; i < ROUND_NUMBERS; ++i) {
            const double at = decade * round_numbers[i];
            const int x = plot_x(plot, at);
            if (at > plot->from_ms && at < plot->to_ms && x >= last + room) {
                char text[DIP_STEP_NAME_BYTES];
                snprintf(text, sizeof text, "%g", round(at * 1000.0) / 1000.0);
                dip_ui_text(ui, NOTE_SIZE, dip_style_dim, DIP_ALIGN_CENTRE, x, y, room, text);
                last = x;
            }
        }
    }
}

// Draws about four round errors beside the plot, and lines across the plot at them.
static void draw_errors(DipUi *ui, const Plot *plot) {
    const int line = dip_ui_line_height(ui, NOTE_SIZE), gap = dip_ui_px(ui, 4);
    const DipRect *rect = &plot->rect;
    const double span = plot->to_flip - plot->from_flip;
    double step = pow(10.0, floor(log10(span / 3.0)));
    step *= span / step > 12.0 ? 5.0 : span / step > 6.0 ? 2.0 : 1.0;
    const double begin = ceil(plot->from_flip / step) * step;
    for (int i = 0; begin + i * step < plot->to_flip; ++i) {
        const int y = plot_y(plot, begin + i * step);
        char text[DIP_STEP_NAME_BYTES];
        dip_flip_text(begin + i * step, false, text);
        dip_ui_fill(ui, (DipRect){rect->x, y, rect->width, 1}, dip_style_raised);
        dip_ui_text(ui, NOTE_SIZE, dip_style_dim, DIP_ALIGN_RIGHT, rect->x - gap, y - line / 2,
                    dip_ui_px(ui, 60), text);
    }
}

// Shades the times beyond the budget.
static void draw_budget(DipUi *ui, const Plot *plot, double budget_ms) {
    const int gap = dip_ui_px(ui, 4);
    char text[DIP_NUMBER_BYTES + 4];
    DipRect over = plot->rect;
    DipRect within = dip_cut_left(&over, plot_x(plot, budget_ms) - over.x);
    dip_ui_fill(ui, over, dip_style_over);
    over.width = dip_ui_px(ui, 2);
    dip_ui_fill(ui, over, dip_style_white);
    dip_budget_ms_text(budget_ms, text);
    strcat(text, " ms");
    const bool is_left = dip_ui_text_width(ui, NOTE_SIZE, text) + gap <= within.width;
    dip_ui_text(ui, NOTE_SIZE, dip_style_white, is_left ? DIP_ALIGN_RIGHT : DIP_ALIGN_LEFT,
                over.x + (is_left ? -gap : 2 * gap), over.y + gap, plot->rect.width, text);
}

// Marks the points of the current pane's settings and of the advice.
static void draw_marks(DipUi *ui, const DipWindow *window, const Plot *plot) {
    const DipPreviewChoice *choice = window->state->choice;
    const DipQuality *current = &window->state->quality[DIP_PANE_CURRENT];
    const int line = dip_ui_line_height(ui, NOTE_SIZE);
    for (int i = 0; i < choice->candidates.count; ++i) {
        const DipCandidate *point = &choice->candidates.list[i];
        const int x = plot_x(plot, point->time.value), y = plot_y(plot, point->flip);
        if (dip_quality_equal(&point->quality, current)) {
            draw_dot(ui, plot, point, 13, dip_style_white);
            draw_dot(ui, plot, point, 9, dip_style_well);
            draw_dot(ui, plot, point, 7, dip_style_gain);
            dip_ui_text(ui, NOTE_SIZE, dip_style_white, DIP_ALIGN_LEFT, x + line / 2, y + line / 3,
                        plot->rect.width, "current");
        }
        if (i == choice->advice.chosen) {
            draw_dot(ui, plot, point, 11, dip_style_accent);
            // Nothing lies to the lower left of the front.
            dip_ui_text(ui, NOTE_SIZE, dip_style_accent, DIP_ALIGN_RIGHT, x - line / 2,
                        y + line / 3, plot->rect.width, "advised");
        }
    }
}

// Plots the candidates of the preview's choice by time and error in `room`. The plot shows the
// Pareto front as stairs, shades the times beyond the budget, and marks the advised settings and
// those of the current pane. If the room is too small or there are fewer than two candidates, only
// the heading shows.
static void draw_plot(DipUi *ui, const DipWindow *window, DipRect room) {
    const DipPreviewChoice *choice = window->state->choice;
    const DipCandidates *candidates = &choice->candidates;
    const DipCostReport *report = choice->live ? NULL : window->state->costs;
    const int line = dip_ui_line_height(ui, NOTE_SIZE), thin = dip_ui_px(ui, 2);
    dip_ui_line(ui, NOTE_SIZE, dip_style_soft, &room, "%d combinations   %s%s", candidates->count,
                report ? "path " : "this view", report ? report->paths[0] : "");
    dip_cut_top(&room, dip_ui_px(ui, 3));
    dip_cut_left(&room, dip_ui_px(ui, AXIS_WIDTH));
    dip_cut_bottom(&room, line + thin);
    if (candidates->count < 2 || room.height < 3 * line || room.width < 6 * line) {
        return;
    }
    const double budget_ms = window->state->budget_ms;
    const Plot plot = plot_of(candidates, budget_ms, room);
    dip_ui_fill(ui, room, dip_style_well);
    draw_times(ui, &plot);
    draw_errors(ui, &plot);
    draw_budget(ui, &plot, budget_ms);
    for (int i = 0; i < candidates->count; ++i) {
        draw_dot(ui, &plot, &candidates->list[i], 3, dip_style_off);
    }
    draw_front(ui, &plot, choice);
    draw_marks(ui, window, &plot);
    DipRect foot = dip_cut_bottom(&room, line + thin);
    foot.x += dip_ui_px(ui, 5);
    dip_ui_line(ui, NOTE_SIZE, dip_style_soft, &foot, "FLIP over ms %s; lower left is better",
                dip_time_kind_names[candidates->kind]);
}

// --- the tab -------------------------------------------------------------------------------------

void dip_tab_advice(DipUi *ui, DipWindow *window, DipRect body) {
    const int margin = dip_ui_px(ui, MARGIN), gap = dip_ui_px(ui, GAP);
    const int right = dip_ui_px(ui, RIGHT_WIDTH);
    const DipPreviewChoice *choice = window->state->choice;
    DipRect rest = {body.x + margin, body.y + margin / 2, body.width - 2 * margin,
                    body.height - margin};
    if (!choice) {
        return;
    }
    const int left = dip_min(dip_ui_px(ui, LEFT_WIDTH), rest.width);
    declare_advised(ui, window, dip_cut_left(&rest, left));
    dip_cut_left(&rest, gap);
    if (choice->live) {
        if (rest.width >= dip_ui_px(ui, NOTE_WIDTH)) {
            write_how_to(ui, window, rest);
        }
        return;
    }
    if (choice->candidates.count == 0) {
        return; // There is nothing to plot and no step to try.
    }
    if (rest.width >= right + gap + dip_ui_px(ui, 200)) {
        declare_steps(ui, window, dip_cut_right(&rest, right));
        dip_cut_right(&rest, gap);
    } else if (rest.width < dip_ui_px(ui, 180)) {
        return;
    }
    if (dip_ui_is_drawing(ui)) {
        draw_plot(ui, window, rest);
    }
}
