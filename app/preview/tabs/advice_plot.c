// Plots the measured combinations by time and error, with the front and a budget.
#include "app/preview/tabs/advice_plot.h"

#include "app/preview/prices/price_text.h"
#include "app/ui/style.h"
#include "app/report/words.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { NOTE_SIZE = 11, AXIS_WIDTH = 34 };

typedef struct Plot {
    DipRect rect;
    double from_ms;
    double to_ms;
    double from_flip;
    double to_flip;
} Plot;

static int plot_x(const Plot *plot, double ms) {
    const double share = (ms - plot->from_ms) / (plot->to_ms - plot->from_ms);
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
    const double ms = fmax(plot.to_ms - plot.from_ms, 1e-3);
    const double flip = fmax(plot.to_flip - plot.from_flip, 1e-5);
    plot.from_ms -= 0.06 * ms;
    plot.to_ms += 0.03 * ms;
    plot.from_flip -= 0.08 * flip;
    plot.to_flip += 0.08 * flip;
    return plot;
}

static void draw_dot(DipUi *ui, const Plot *plot, const DipCandidate *point, int side,
                     DipColour colour) {
    const int size = dip_ui_px(ui, side);
    dip_ui_fill_round(ui,
                      (DipRect){plot_x(plot, point->time.value) - size / 2,
                                plot_y(plot, point->flip) - size / 2, size, size},
                      size / 2, colour);
}

// Draws the front as stairs: at each time, the least error that was measured within it.
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

// Draws about four round numbers along each axis, with lines across the plot for the errors.
static void draw_axes(DipUi *ui, const Plot *plot) {
    const int line = dip_ui_line_height(ui, NOTE_SIZE), gap = dip_ui_px(ui, 4);
    const double spans[2] = {plot->to_ms - plot->from_ms, plot->to_flip - plot->from_flip};
    for (int axis = 0; axis < 2; ++axis) {
        double step = pow(10.0, floor(log10(spans[axis] / 3.0)));
        step *= spans[axis] / step > 12.0 ? 5.0 : spans[axis] / step > 6.0 ? 2.0 : 1.0;
        const double from = axis ? plot->from_flip : plot->from_ms;
        for (double at = ceil(from / step) * step; at < from + spans[axis]; at += step) {
            char text[DIP_STEP_NAME_BYTES];
            if (axis) {
                const int y = plot_y(plot, at);
                dip_flip_text(at, false, text);
                dip_ui_fill(ui, (DipRect){plot->rect.x, y, plot->rect.width, 1}, dip_style_raised);
                dip_ui_text(ui, NOTE_SIZE, dip_style_dim, DIP_ALIGN_RIGHT, plot->rect.x - gap,
                            y - line / 2, dip_ui_px(ui, 60), text);
            } else {
                snprintf(text, sizeof text, "%g", round(at * 100.0) / 100.0);
                dip_ui_text(ui, NOTE_SIZE, dip_style_dim, DIP_ALIGN_CENTRE, plot_x(plot, at),
                            plot->rect.y + plot->rect.height + gap / 2, dip_ui_px(ui, 60), text);
            }
        }
    }
}

static void draw_budget(DipUi *ui, const Plot *plot, double budget_ms) {
    const int x = plot_x(plot, budget_ms), gap = dip_ui_px(ui, 4);
    char text[DIP_NUMBER_BYTES + 4];
    dip_ui_fill(ui,
                (DipRect){x, plot->rect.y, plot->rect.x + plot->rect.width - x, plot->rect.height},
                dip_style_over);
    dip_ui_fill(ui, (DipRect){x, plot->rect.y, dip_ui_px(ui, 2), plot->rect.height},
                dip_style_white);
    dip_budget_ms_text(budget_ms, text);
    strcat(text, " ms");
    dip_ui_text(ui, NOTE_SIZE, dip_style_white, DIP_ALIGN_RIGHT, x - gap, plot->rect.y + gap,
                x - plot->rect.x, text);
}

// Marks the points of both panes' settings and of the advice.
static void draw_marks(DipUi *ui, const DipWindow *window, const Plot *plot) {
    const DipPreviewChoice *choice = window->state->choice;
    const int line = dip_ui_line_height(ui, NOTE_SIZE);
    for (int i = 0; i < choice->candidates.count; ++i) {
        const DipCandidate *point = &choice->candidates.list[i];
        const bool current = memcmp(&point->quality, &window->state->quality[DIP_PANE_CURRENT],
                                    sizeof point->quality) == 0;
        if (current) {
            draw_dot(ui, plot, point, 13, dip_style_white);
            draw_dot(ui, plot, point, 9, dip_style_well);
            draw_dot(ui, plot, point, 7, dip_style_gain);
            dip_ui_text(ui, NOTE_SIZE, dip_style_white, DIP_ALIGN_LEFT,
                        plot_x(plot, point->time.value) + line / 2,
                        plot_y(plot, point->flip) + line / 3, plot->rect.width, "current");
        }
        if (i == choice->advice.chosen) {
            draw_dot(ui, plot, point, 11, dip_style_accent);
            dip_ui_text(
                ui, NOTE_SIZE, dip_style_accent, DIP_ALIGN_CENTRE, plot_x(plot, point->time.value),
                plot_y(plot, point->flip) - line - dip_ui_px(ui, 6), plot->rect.width, "advised");
        }
    }
}

void dip_advice_plot(DipUi *ui, const DipWindow *window, DipRect room) {
    const DipPreviewChoice *choice = window->state->choice;
    const DipCandidates *candidates = &choice->candidates;
    const DipCostReport *report = choice->live ? NULL : window->state->costs;
    const int line = dip_ui_line_height(ui, NOTE_SIZE), axis = dip_ui_px(ui, AXIS_WIDTH);
    char text[160];
    int y = room.y;
    snprintf(text, sizeof text, "%d combinations   %s%s", candidates->count,
             report ? "path " : "this view", report ? report->paths[0] : "");
    dip_ui_text(ui, NOTE_SIZE, dip_style_soft, DIP_ALIGN_LEFT, room.x, y, room.width, text);
    y += line + dip_ui_px(ui, 3);
    if (candidates->count < 2) {
        return;
    }
    const DipRect rect = {room.x + axis, y, room.width - axis,
                          room.y + room.height - y - line - dip_ui_px(ui, 2)};
    if (rect.height < 3 * line || rect.width < 6 * line) {
        return;
    }
    const double budget_ms = window->state->budget_ms;
    const Plot plot = plot_of(candidates, budget_ms, rect);
    dip_ui_fill(ui, rect, dip_style_well);
    draw_axes(ui, &plot);
    draw_budget(ui, &plot, budget_ms);
    for (int i = 0; i < candidates->count; ++i) {
        draw_dot(ui, &plot, &candidates->list[i], 3, dip_style_off);
    }
    draw_front(ui, &plot, choice);
    draw_marks(ui, window, &plot);
    snprintf(text, sizeof text, "FLIP over ms %s; lower left is better",
             dip_time_kind_names[candidates->kind]);
    dip_ui_text(ui, NOTE_SIZE, dip_style_soft, DIP_ALIGN_LEFT, rect.x + dip_ui_px(ui, 5),
                rect.y + rect.height - line - dip_ui_px(ui, 2), rect.width, text);
}
