// The tab of times: frame times of the last seconds, stages, errors and work of each pane.
#include "app/preview/tabs/tabs.h"
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
static const DipColour pane_colours[DIP_PANE_COUNT] = {{196, 202, 210, 255}, {255, 190, 92, 255}};

// --- the graph -----------------------------------------------------------------------------------

// Times of one pane in the last seconds.
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

// The time of the graph moves in steps, so that the graph changes four times a second only.
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
            const int x = plot.width - (int)((int64_t)(i + 1) * plot.width / GRAPH_STEPS);
            dip_ui_fill(ui, (DipRect){plot.x + x, plot.y + plot.height - size - y, width, size},
                        colour);
        }
    }
}

static void draw_legend(DipUi *ui, const DipWindow *window, History *history, int pane,
                        DipRect line) {
    static const char *const names[DIP_PANE_COUNT] = {"Current", "Requested"};
    char text[120];
    const int swatch = dip_ui_px(ui, 8);
    if (window->figures[pane].copied) {
        snprintf(text, sizeof text, "%s: same settings, drawn once", names[pane]);
    } else if (history->count == 0) {
        snprintf(text, sizeof text, "%s: no frame, since time stands still", names[pane]);
    } else {
        const double median = dip_percentile(history->ms, history->count, 0.5);
        const double p95 = dip_percentile(history->ms, history->count, 0.95);
        snprintf(text, sizeof text, "%s: median %.1f, p95 %.1f ms", names[pane], median, p95);
    }
    dip_ui_fill(ui,
                (DipRect){line.x, line.y + (dip_ui_line_height(ui, NOTE_SIZE) - swatch) / 2, swatch,
                          swatch},
                pane_colours[pane]);
    dip_ui_text(ui, NOTE_SIZE, dip_style_soft, DIP_ALIGN_LEFT, line.x + 2 * swatch, line.y,
                line.width - 2 * swatch, text);
}

static void draw_budget_line(DipUi *ui, DipRect plot, const DipPreviewState *state, double top_ms) {
    const double budget_ms = state->budget_ms;
    const int y = plot.y + plot.height - (int)(budget_ms / top_ms * plot.height);
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
    const DipRect plot = {rect.x, rect.y + line, rect.width, rect.height - 4 * line};
    History histories[DIP_PANE_COUNT];
    const double budget_ms = window->state->budget_ms;
    double top_ms = budget_ms * 1.25;
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        histories[p] = history_of(&window->figures[p], graph_now_ns(ui));
        for (int i = 0; i < histories[p].count; ++i) {
            top_ms = fmax(top_ms, histories[p].ms[i]);
        }
    }
    dip_ui_text(ui, NOTE_SIZE, dip_style_dim, DIP_ALIGN_LEFT, rect.x, rect.y, rect.width,
                "Frame times, last 5 s");
    if (plot.height < line) {
        return;
    }
    dip_ui_fill(ui, plot, dip_style_well);
    draw_budget_line(ui, plot, window->state, top_ms);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        if (!window->figures[p].copied) {
            draw_history(ui, &histories[p], plot, top_ms, pane_colours[p]);
        }
        draw_legend(ui, window, &histories[p], p,
                    (DipRect){rect.x, plot.y + plot.height + p * line, rect.width, line});
    }
    char text[80];
    snprintf(text, sizeof text, "%d of the display's refreshes had no new picture",
             window->figures[0].dropped);
    dip_ui_text(ui, NOTE_SIZE, window->figures[0].dropped ? dip_style_worse : dip_style_dim,
                DIP_ALIGN_LEFT, rect.x, plot.y + plot.height + 2 * line, rect.width, text);
}

// --- the lines -----------------------------------------------------------------------------------

// Draws the lines of one pane in as many columns as fit, from the most important line on.
static void draw_lines(DipUi *ui, const DipPanelLine *lines, int count, DipRect room) {
    const int line = dip_ui_line_height(ui, SIZE) + dip_ui_px(ui, 1);
    const int pad = dip_ui_px(ui, MARGIN);
    const int rows = dip_max(1, room.height / line);
    const int fitting = dip_max(1, room.width / dip_ui_px(ui, COLUMN_WIDTH));
    const int needed = (count + rows - 1) / rows;
    const int columns = dip_min(fitting, needed);
    const int width = room.width / dip_max(1, columns);
    for (int i = 0; i < count && i < rows * columns; ++i) {
        const DipPanelLine *shown = &lines[i];
        const int x = room.x + i / rows * width;
        const int y = room.y + i % rows * line;
        const int value_x = x + width - pad;
        dip_ui_text(ui, SIZE, shown->head ? dip_style_white : dip_style_soft, DIP_ALIGN_LEFT, x, y,
                    width - pad, shown->name);
        dip_ui_text(ui, SIZE, shown->head ? dip_style_accent : dip_style_white, DIP_ALIGN_RIGHT,
                    value_x, y, width - pad - dip_ui_text_width(ui, SIZE, shown->name),
                    shown->value);
    }
}

// Writes what the panes show and at which size.
static void draw_heading(DipUi *ui, const DipWindow *window, int pane, DipRect line) {
    static const char *const names[DIP_PANE_COUNT] = {"Current", "Requested"};
    const DipPreviewState *state = window->state;
    char text[160];
    snprintf(text, sizeof text, "%dx%d   %s", window->frames[pane].width,
             window->frames[pane].height,
             state->scene_title ? state->scene_title
                                : dip_preview_path_title(state, state->track->active));
    const int width = dip_ui_text_width(ui, SIZE, names[pane]) + dip_ui_px(ui, 10);
    dip_ui_text(ui, SIZE, pane == DIP_PANE_CURRENT ? dip_style_white : dip_style_accent,
                DIP_ALIGN_LEFT, line.x, line.y, line.width, names[pane]);
    dip_ui_text(ui, SIZE, dip_style_dim, DIP_ALIGN_LEFT, line.x + width, line.y, line.width - width,
                text);
}

void dip_tab_times(DipUi *ui, DipWindow *window, DipRect body) {
    const int margin = dip_ui_px(ui, MARGIN), line = dip_ui_line_height(ui, SIZE);
    const int graph_width = dip_ui_px(ui, GRAPH_WIDTH);
    const bool has_graph = body.width >= graph_width + 2 * dip_ui_px(ui, COLUMN_WIDTH);
    const int panes = window->layout->side == DIP_DOCK_DRAWER && !has_graph ? 1 : DIP_PANE_COUNT;
    if (!dip_ui_is_drawing(ui)) {
        return;
    }
    DipRect room = {body.x + margin, body.y + margin / 2, body.width - margin,
                    body.height - margin};
    if (has_graph) {
        room.width -= graph_width + margin;
        dip_times_graph_draw(
            ui, window, (DipRect){room.x + room.width, room.y, graph_width, body.height - margin});
    }
    const int width = room.width / panes;
    for (int p = 0; p < panes; ++p) {
        const int pane = panes == 1 ? DIP_PANE_REQUESTED : p;
        DipPanelLine lines[DIP_PANEL_MAX_LINES];
        const int count = dip_panel_lines(&window->figures[pane], pane, lines);
        const DipRect column = {room.x + p * width, room.y, width - margin, room.height};
        draw_heading(ui, window, pane, column);
        draw_lines(ui, lines, count,
                   (DipRect){column.x, column.y + line + dip_ui_px(ui, 3), column.width,
                             column.height - line - dip_ui_px(ui, 3)});
    }
}
