// The tab of times: stages, errors and work of each pane, in columns under the pane.
#include "app/preview/style.h"
#include "app/preview/tabs.h"

enum { SIZE = 12, COLUMN_WIDTH = 200 };

// Draws the lines of one pane in as many columns as fit, from the most important line on.
static void draw_lines(DipUi *ui, const DipPanelLine *lines, int count, DipRect room) {
    const int line = dip_ui_line_height(ui, SIZE) + dip_ui_px(ui, 1);
    const int pad = dip_ui_px(ui, 10);
    const int rows = dip_style_max(1, (room.height - pad) / line);
    const int fitting = dip_style_max(1, room.width / dip_ui_px(ui, COLUMN_WIDTH));
    const int needed = (count + rows - 1) / rows;
    const int columns = dip_style_min(fitting, needed);
    const int width = room.width / columns;
    for (int i = 0; i < count && i < rows * columns; ++i) {
        const DipPanelLine *shown = &lines[i];
        const int x = room.x + i / rows * width + pad;
        const int y = room.y + pad / 2 + i % rows * line;
        const DipColour colour = shown->head ? dip_style_accent : dip_style_soft;
        dip_ui_text(ui, SIZE, colour, DIP_ALIGN_LEFT, x, y, width - 2 * pad, shown->name);
        dip_ui_text(ui, SIZE, shown->head ? dip_style_accent : dip_style_white, DIP_ALIGN_RIGHT,
                    x + width - 2 * pad, y,
                    width - 3 * pad - dip_ui_text_width(ui, SIZE, shown->name), shown->value);
    }
}

void dip_tab_times(DipUi *ui, DipWindow *window, DipRect body) {
    const int count = window->layout->side == DIP_DOCK_DRAWER ? 1 : DIP_PANE_COUNT;
    if (!dip_ui_is_drawing(ui)) {
        return;
    }
    for (int p = 0; p < count; ++p) {
        DipPanelLine lines[DIP_PANEL_MAX_LINES];
        const int lines_count = dip_panel_lines(&window->figures[p], p, lines);
        const DipRect pane = window->layout->panes[p];
        draw_lines(ui, lines, lines_count, (DipRect){pane.x, body.y, pane.width, body.height});
    }
}
