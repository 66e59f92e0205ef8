// Draws the labels over the panes, and the notice. Finds the time of a pane (tabs.h), which the
// labels and the panel show.
#include "app/preview/prices/price_text.h"
#include "app/preview/tabs/tabs.h"
#include "app/preview/tools/compare.h"
#include "app/ui/layout.h"
#include "app/ui/style.h"

#include <stdio.h>

// --- a pane's time -------------------------------------------------------------------------------

static const DipPaneFigures *figures_of(const DipWindow *window, int pane) {
    return &window->figures[window->figures[pane].copied ? DIP_PANE_CURRENT : pane];
}

DipPriceSum dip_pane_sum(const DipWindow *window, int pane) {
    const double frame_ms = figures_of(window, pane)->ms;
    if (window->prices && (window->still || !dip_prices_are_rough(window->prices))) {
        const DipPriceSum sum = dip_prices_sum(window->prices, &window->state->quality[pane]);
        if (dip_price_sum_trust(&sum) != DIP_PRICE_TRUST_UNKNOWN) {
            return sum;
        }
    }
    return (DipPriceSum){.state = DIP_PRICE_UNKNOWN,
                         .ms = frame_ms,
                         .judged_by = DIP_TIME_MEAN,
                         .judged_ms = frame_ms,
                         .base_ms = frame_ms};
}

void dip_pane_time_scope(const DipWindow *window, const DipPriceSum *sum,
                         char text[DIP_PANE_SCOPE_BYTES]) {
    const DipCostReport *report = sum->state == DIP_PRICE_UNKNOWN
                                      ? NULL
                                      : dip_price_view_report(dip_prices_view(window->prices));
    const DipPixels *frame = &window->frames[DIP_PANE_CURRENT];
    text[0] = '\0';
    if (!report || dip_cost_is_view(report)) {
        return;
    }
    if (report->width == frame->width && report->height == frame->height) {
        snprintf(text, DIP_PANE_SCOPE_BYTES, " along the path");
    } else {
        snprintf(text, DIP_PANE_SCOPE_BYTES, " at %dx%d", report->width, report->height);
    }
}

void dip_pane_time_text(const DipWindow *window, int pane, char text[DIP_PANE_TIME_BYTES]) {
    const DipPriceSum sum = dip_pane_sum(window, pane);
    const int frames = figures_of(window, pane)->frames;
    const bool is_price = sum.state != DIP_PRICE_UNKNOWN;
    const DipPriceTrust trust = is_price     ? dip_price_sum_trust(&sum)
                                : frames > 0 ? DIP_PRICE_TRUST_KNOWN
                                             : DIP_PRICE_TRUST_UNKNOWN;
    char digits[DIP_STEP_NAME_BYTES];
    dip_ms_text(sum.ms, trust, window->state->budget_ms, digits);
    if (trust == DIP_PRICE_TRUST_UNKNOWN) {
        snprintf(text, DIP_PANE_TIME_BYTES, DIP_WAITING_MARK " ms");
    } else {
        const bool rough = sum.state == DIP_PRICE_ROUGH && trust != DIP_PRICE_TRUST_DOUBTFUL;
        snprintf(text, DIP_PANE_TIME_BYTES, "%s%s%.20s ms",
                 !is_price && frames == 1 ? "one frame: " : "", rough ? DIP_ROUGH_MARK : "",
                 digits);
    }
}

bool dip_pane_is_over(const DipWindow *window, const DipPriceSum *sum) {
    return sum->judged_ms > window->state->budget_ms &&
           dip_price_sum_trust(sum) != DIP_PRICE_TRUST_DOUBTFUL;
}

void dip_pane_verdict(const DipWindow *window, const DipPriceSum *sum,
                      char text[DIP_VERDICT_BYTES]) {
    const double budget_ms = window->state->budget_ms;
    const bool is_price = sum->state != DIP_PRICE_UNKNOWN, over = dip_pane_is_over(window, sum);
    char ms[DIP_STEP_NAME_BYTES] = "", excess[DIP_STEP_NAME_BYTES];
    text[0] = '\0';
    if (dip_price_sum_trust(sum) == DIP_PRICE_TRUST_DOUBTFUL || (!is_price && !over)) {
        return;
    }
    if (sum->judged_by != DIP_TIME_MEAN) {
        dip_ms_text(sum->judged_ms, DIP_PRICE_TRUST_KNOWN, budget_ms, ms);
    }
    dip_ms_text(sum->judged_ms - budget_ms, DIP_PRICE_TRUST_KNOWN, 0.0, excess);
    snprintf(text, DIP_VERDICT_BYTES, "%s%s%s%s%s%s",
             is_price ? dip_time_kind_names[sum->judged_by] : "", ms[0] ? " " : "", ms,
             is_price ? ": " : "", over ? excess : "within", over ? " over" : "");
}

// --- labels --------------------------------------------------------------------------------------

enum { LABEL_SIZE = 13, LABEL_HEIGHT = 24, LABEL_MARGIN = 8, LABEL_PAD = 8 };

// Writes the time of a pane: "4.6 ms  60 fps", "4.6 ms along the path  60 fps", "4.6 ms at
// 640x480  14 fps" or "one frame: 44.0 ms". Writes instead that the pane is a copy, or that frames
// come too slowly for temporal antialiasing.
static void format_time(const DipWindow *window, int pane, char *text, size_t size_bytes) {
    const DipPaneFigures *figures = &window->figures[pane];
    const DipPriceSum sum = dip_pane_sum(window, pane);
    char ms[DIP_PANE_TIME_BYTES], scope[DIP_PANE_SCOPE_BYTES];
    dip_pane_time_scope(window, &sum, scope);
    dip_pane_time_text(window, pane, ms);
    if (figures->taa_speed.too_slow) {
        snprintf(text, size_bytes, "too slow for temporal AA: %d of %d frames a second",
                 figures->taa_speed.shown, figures->taa_speed.wanted);
    } else if (figures->copied) {
        snprintf(text, size_bytes, "same as current");
    } else if (figures->fps > 0) {
        snprintf(text, size_bytes, "%s%s  %d fps", ms, scope, figures->fps);
    } else {
        snprintf(text, size_bytes, "%s%s", ms, scope);
    }
}

// What a label says: a title, the time or a warning, and the settings.
typedef struct Label {
    const char *title;
    char time[128];
    char settings[400];
} Label;

static Label label_of(const DipUi *ui, const DipWindow *window, int pane, int room) {
    static const char *const short_titles[DIP_PANE_COUNT] = {"Cur.", "Req."};
    Label label = {.title = dip_pane_titles[pane]};
    if (pane == DIP_PANE_CURRENT && dip_compare_shows_truth(window)) {
        label.title = "Truth";
        snprintf(label.time, sizeof label.time, "converged");
        snprintf(label.settings, sizeof label.settings, "%d samples per pixel",
                 window->figures[pane].errors.result.samples);
        return label;
    }
    if (dip_ui_text_width(ui, LABEL_SIZE, label.title) > room) {
        label.title = short_titles[pane];
    }
    format_time(window, pane, label.time, sizeof label.time);
    dip_preview_describe(&window->state->quality[pane], false, label.settings,
                         sizeof label.settings);
    return label;
}

// Returns the height that a text takes in a label, below lines that are `above` pixels tall.
// Returns 0 if the label would then be taller than a third of the pane.
static int height_below(const DipUi *ui, int room, const char *text, int above, int pane_height) {
    const int height = dip_ui_text_block_height(ui, LABEL_SIZE, room, text);
    return 3 * (above + height) > pane_height ? 0 : height;
}

// Draws a label in one line if it fits, with the settings in brief if they do not fit in full.
// Otherwise, the settings go to lines of their own. If the time still does not fit, it goes to
// lines of its own above the settings, because it may be a warning. Lines with which the label
// would be taller than a third of the pane are left out.
static void draw_label(DipUi *ui, const DipWindow *window, int pane) {
    const DipRect rect = dip_compare_visible(window, pane);
    const bool edited = window->state->edited[pane];
    const int margin = dip_ui_px(ui, LABEL_MARGIN), pad = dip_ui_px(ui, LABEL_PAD);
    const int room = rect.width - 2 * margin - 2 * pad;
    const int line = dip_ui_line_height(ui, LABEL_SIZE), row = dip_ui_px(ui, LABEL_HEIGHT);
    Label label = label_of(ui, window, pane, room);
    const int title_width = dip_ui_text_width(ui, LABEL_SIZE, label.title) + pad;
    const DipPriceSum sum = dip_pane_sum(window, pane);
    char usual_time[128], scope[DIP_PANE_SCOPE_BYTES];
    dip_pane_time_scope(window, &sum, scope);
    snprintf(usual_time, sizeof usual_time, "%s88.8 ms%s%s",
             sum.state == DIP_PRICE_ROUGH ? DIP_ROUGH_MARK : "", scope,
             window->figures[pane].fps > 0 ? "  60 fps" : "");
    const int usual = dip_ui_text_width(ui, LABEL_SIZE, usual_time);
    const int own = dip_ui_text_width(ui, LABEL_SIZE, label.time);
    // At least the usual width, so that changing digits do not move the settings.
    const int time_width = dip_max(own, usual) + pad;
    int width = title_width + time_width + dip_ui_text_width(ui, LABEL_SIZE, label.settings);
    if (width > room) {
        dip_preview_describe(&window->state->quality[pane], true, label.settings,
                             sizeof label.settings);
        width = title_width + time_width + dip_ui_text_width(ui, LABEL_SIZE, label.settings);
    }
    const bool time_fits = title_width + own <= room, settings_fit = time_fits && width <= room;
    const int time_height = time_fits ? 0 : height_below(ui, room, label.time, line, rect.height);
    const int settings_height =
        settings_fit ? 0 : height_below(ui, room, label.settings, line + time_height, rect.height);
    if (!settings_fit) {
        width = time_height + settings_height > 0 ? room : title_width + time_width - pad;
    }
    const DipRect strip = {rect.x + margin, rect.y + margin, dip_min(width, room) + 2 * pad,
                           row + time_height + settings_height};
    DipRect rest = {strip.x + pad, strip.y + (row - line) / 2, room, strip.height};
    dip_ui_fill_round(ui, strip, dip_ui_px(ui, 4), dip_style_glass);
    DipRect first = dip_cut_top(&rest, line);
    dip_ui_label(ui, LABEL_SIZE, edited ? dip_style_accent : dip_style_white, DIP_ALIGN_LEFT, first,
                 label.title);
    dip_cut_left(&first, title_width);
    if (time_fits) {
        dip_ui_label(ui, LABEL_SIZE, dip_style_white, DIP_ALIGN_LEFT, first, label.time);
    }
    dip_cut_left(&first, time_width);
    if (settings_fit) {
        dip_ui_label(ui, LABEL_SIZE, dip_style_soft, DIP_ALIGN_LEFT, first, label.settings);
    }
    dip_ui_text_block(ui, LABEL_SIZE, dip_style_white, dip_cut_top(&rest, time_height), label.time);
    dip_ui_text_block(ui, LABEL_SIZE, dip_style_soft, dip_cut_top(&rest, settings_height),
                      label.settings);
    if (edited && pane == DIP_PANE_REQUESTED &&
        !dip_compare_is_one_picture(window->state->tools.comparison)) {
        dip_ui_fill(ui, dip_layout_gap(window->layout), dip_style_accent);
    }
}

void dip_labels_draw(DipUi *ui, DipWindow *window) {
    const bool shows = window->state->tools.comparison != DIP_COMPARE_DIFFERENCE;
    for (int p = 0; shows && dip_ui_is_drawing(ui) && p < DIP_PANE_COUNT; ++p) {
        if (!dip_rect_is_empty(dip_compare_visible(window, p))) {
            draw_label(ui, window, p);
        }
    }
}

void dip_labels_draw_notice(DipUi *ui, DipWindow *window) {
    const char *notice = window->state->notice;
    if (!notice[0] || !dip_ui_is_drawing(ui)) {
        return;
    }
    const DipLayout *layout = window->layout;
    const int pad = dip_ui_px(ui, LABEL_PAD), margin = dip_ui_px(ui, LABEL_MARGIN);
    const int room = layout->width - 2 * margin - 2 * pad;
    const int width = dip_min(room, dip_ui_text_width(ui, LABEL_SIZE, notice) + 1);
    const int lines = dip_ui_text_block_height(ui, LABEL_SIZE, width, notice);
    const int height = lines + dip_ui_px(ui, LABEL_HEIGHT) - dip_ui_line_height(ui, LABEL_SIZE);
    const DipRect strip = {(layout->width - width) / 2 - pad,
                           dip_rect_bottom(layout->panes[0]) - margin - height, width + 2 * pad,
                           height};
    dip_ui_fill_round(ui, strip, dip_ui_px(ui, 4), dip_style_glass);
    dip_ui_text_block(ui, LABEL_SIZE, dip_style_accent, dip_rect_middle(strip, width, lines),
                      notice);
}
