// Declares the times tab: a graph of the frame times of the last seconds, and lines with the stage
// times, errors and work of each pane, with a tip that lists the pane's effects. If the dock is a
// narrow drawer (DIP_DOCK_DRAWER), the tab has only the lines of the requested pane.
#include "app/preview/tabs/tabs.h"
#include "app/ui/layout.h"
#include "app/ui/style.h"

#include <math.h>
#include <stdio.h>

enum {
    SIZE = 12,
    NOTE_SIZE = 11,
    COLUMN_WIDTH = 190,
    GRAPH_WIDTH = 300,
    MARGIN = 10,
    GRAPH_STEPS = 100
};

static const int64_t graph_ns = 5000000000;

// --- the graph -----------------------------------------------------------------------------------

// Returns a pane's colour in the graph.
static DipColour colour_of(int pane) {
    return pane == DIP_PANE_CURRENT ? dip_style_soft : dip_style_accent;
}

// Frame times of one pane in the last seconds.
typedef struct History {
    double ms[DIP_TIMING_SAMPLES];
    int64_t age_ns[DIP_TIMING_SAMPLES];
    int count;
} History;

static History history_of(const DipPaneFigures *figures, int64_t now_ns) {
    History history = {.count = 0};
    if (figures->times) {
        history.count =
            dip_timing_recent(figures->times, now_ns, graph_ns, history.ms, history.age_ns);
    }
    return history;
}

// Returns the time at the graph's right end. This time moves in steps, so that the graph is drawn
// anew only four times a second.
static int64_t graph_now_ns(const DipUi *ui) {
    const int64_t step_ns = 250000000;
    return dip_ui_now_ns(ui) / step_ns * step_ns;
}

static void draw_history(DipUi *ui, const History *history, DipRect plot, double top_ms,
                         DipColour colour) {
    const int size = dip_ui_px(ui, 2);
    double most[GRAPH_STEPS] = {0};
    for (int i = 0; i < history->count; ++i) {
        if (history->age_ns[i] >= 0) {
            const int at = (int)(history->age_ns[i] * GRAPH_STEPS / graph_ns);
            most[at] = fmax(most[at], history->ms[i]);
        }
    }
    const int width = dip_max(size, plot.width / GRAPH_STEPS);
    for (int i = 0; i < GRAPH_STEPS; ++i) {
        if (most[i] > 0.0) {
            const int y = (int)(fmin(most[i] / top_ms, 1.0) * (plot.height - size));
            const int x = (int)((int64_t)(i + 1) * plot.width / GRAPH_STEPS);
            dip_ui_fill(
                ui,
                (DipRect){dip_rect_right(plot) - x, dip_rect_bottom(plot) - size - y, width, size},
                colour);
        }
    }
}

static void draw_legend(DipUi *ui, const DipWindow *window, History *history, int pane,
                        DipRect line) {
    char text[120];
    const int swatch = dip_ui_px(ui, 8);
    if (window->figures[pane].copied) {
        snprintf(text, sizeof text, "%s: same settings, drawn once", dip_pane_titles[pane]);
    } else if (history->count == 0) {
        snprintf(text, sizeof text, "%s: no frame%s", dip_pane_titles[pane],
                 window->still ? ", since time stands still" : " yet");
    } else {
        snprintf(text, sizeof text, "%s: median %.1f, p95 %.1f ms", dip_pane_titles[pane],
                 dip_percentile(history->ms, history->count, 0.5),
                 dip_percentile(history->ms, history->count, 0.95));
    }
    dip_ui_fill(ui, dip_rect_middle(dip_cut_left(&line, swatch), swatch, swatch), colour_of(pane));
    dip_cut_left(&line, swatch);
    dip_ui_label(ui, NOTE_SIZE, dip_style_soft, DIP_ALIGN_LEFT, line, text);
}

static void draw_budget_line(DipUi *ui, DipRect plot, const DipPreviewState *state, double top_ms) {
    const double budget_ms = state->budget_ms;
    const int y = dip_rect_bottom(plot) - (int)(budget_ms / top_ms * plot.height);
    char text[80];
    snprintf(text, sizeof text, "%.1f ms: %s", budget_ms,
             state->has_budget ? "the budget" : "one refresh of the display");
    dip_ui_fill(ui, (DipRect){plot.x, y, plot.width, dip_ui_px(ui, 1)}, dip_style_white);
    dip_ui_text(ui, NOTE_SIZE, dip_style_white, DIP_ALIGN_LEFT, plot.x + dip_ui_px(ui, 4),
                y - dip_ui_line_height(ui, NOTE_SIZE), plot.width, text);
}

void dip_times_graph_draw(DipUi *ui, const DipWindow *window, DipRect rect) {
    if (!dip_ui_is_drawing(ui)) {
        return;
    }
    const int line = dip_ui_line_height(ui, NOTE_SIZE);
    History histories[DIP_PANE_COUNT];
    double top_ms = window->state->budget_ms * 1.25;
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        histories[p] = history_of(&window->figures[p], graph_now_ns(ui));
        for (int i = 0; i < histories[p].count; ++i) {
            top_ms = fmax(top_ms, histories[p].ms[i]);
        }
    }
    dip_ui_line(ui, NOTE_SIZE, dip_style_dim, &rect, "Frame times, last 5 s");
    DipRect legend = dip_cut_bottom(&rect, 3 * line);
    if (rect.height < line) {
        return;
    }
    dip_ui_fill(ui, rect, dip_style_well);
    draw_budget_line(ui, rect, window->state, top_ms);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        if (!window->figures[p].copied) {
            draw_history(ui, &histories[p], rect, top_ms, colour_of(p));
        }
        draw_legend(ui, window, &histories[p], p, dip_cut_top(&legend, line));
    }
    const int dropped = window->figures[0].dropped;
    dip_ui_line(ui, NOTE_SIZE, dropped ? dip_style_worse : dip_style_dim, &legend,
                "%d of the display's refreshes had no new picture", dropped);
}

// --- the lines -----------------------------------------------------------------------------------

// Draws the lines of one pane, the most important first, in as many columns as they need. If fewer
// columns fit, leaves out the last lines.
static void draw_lines(DipUi *ui, const DipPanelLine *lines, int count, DipRect room) {
    const int line = dip_ui_line_height(ui, SIZE) + dip_ui_px(ui, 1);
    const int rows = dip_max(1, room.height / line);
    const int fitting = dip_max(1, room.width / dip_ui_px(ui, COLUMN_WIDTH));
    const int columns = dip_max(1, dip_min(fitting, (count + rows - 1) / rows));
    const int width = room.width / columns;
    for (int i = 0; i < count && i < rows * columns; ++i) {
        const DipPanelLine *shown = &lines[i];
        DipRect row = {room.x + i / rows * width, room.y + i % rows * line,
                       width - dip_ui_px(ui, MARGIN), dip_ui_line_height(ui, SIZE)};
        dip_ui_word(ui, SIZE, shown->head ? dip_style_white : dip_style_soft, &row, 0, shown->name);
        dip_ui_label(ui, SIZE, shown->head ? dip_style_accent : dip_style_white, DIP_ALIGN_RIGHT,
                     row, shown->value);
    }
}

// Lets a tip over a pane's lines say which effects ran, and why others did not.
static void declare_effects(DipUi *ui, const DipWindow *window, int pane, DipRect rect) {
    const DipPaneFigures *figures = &window->figures[pane];
    char text[DIP_EFFECTS_TEXT_BYTES] = "";
    if (!figures->copied) {
        dip_effects_text(&figures->effects, text);
    }
    dip_ui_control(ui, &(DipUiControl){.id = DIP_UI_ID(DIP_UI_TIMES, 1 + pane),
                                       .rect = rect,
                                       .tip = text,
                                       .skips_focus = true});
}

// Writes a pane's name, the size of its picture, and the scene or the path that shows.
static void draw_heading(DipUi *ui, const DipWindow *window, int pane, DipRect line) {
    const DipPreviewState *state = window->state;
    const DipPixels *frame = &window->frames[pane];
    dip_ui_word(ui, SIZE, dip_style_of_pane(pane), &line, dip_ui_px(ui, 10), dip_pane_titles[pane]);
    dip_ui_line(ui, SIZE, dip_style_dim, &line, "%dx%d   %s", frame->width, frame->height,
                state->scene_title ? state->scene_title
                                   : dip_preview_path_title(state, state->track->active));
}

void dip_tab_times(DipUi *ui, DipWindow *window, DipRect body) {
    const int margin = dip_ui_px(ui, MARGIN), line = dip_ui_line_height(ui, SIZE);
    const int graph_width = dip_ui_px(ui, GRAPH_WIDTH);
    const bool has_graph = body.width >= graph_width + 2 * dip_ui_px(ui, COLUMN_WIDTH);
    const int panes = window->layout->side == DIP_DOCK_DRAWER && !has_graph ? 1 : DIP_PANE_COUNT;
    DipRect rest = {body.x + margin, body.y + margin / 2, body.width - margin,
                    body.height - margin};
    if (has_graph) {
        dip_cut_right(&rest, margin);
        dip_times_graph_draw(ui, window, dip_cut_right(&rest, graph_width));
    }
    const int width = rest.width / panes;
    for (int p = 0; p < panes; ++p) {
        const int pane = panes == 1 ? DIP_PANE_REQUESTED : p;
        DipPanelLine lines[DIP_PANEL_MAX_LINES];
        const int count = dip_panel_lines(&window->figures[pane], pane, lines);
        DipRect column = dip_cut_left(&rest, width);
        dip_cut_right(&column, margin);
        declare_effects(ui, window, pane, column);
        if (!dip_ui_is_drawing(ui)) {
            continue;
        }
        draw_heading(ui, window, pane, dip_cut_top(&column, line));
        dip_cut_top(&column, dip_ui_px(ui, 3));
        draw_lines(ui, lines, count, column);
    }
}
