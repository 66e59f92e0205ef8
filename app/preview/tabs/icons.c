// Draws symbols on a grid of 16x16 units.
#include "app/preview/tabs/tabs.h"

#include <math.h>

enum { GRID = 16, TRIANGLE = 10 };

typedef struct Icon {
    DipUi *ui;
    int x; // Top left corner of the grid.
    int y;
    DipColour colour;
} Icon;

static Icon icon_in(DipUi *ui, DipRect rect, DipColour colour) {
    const int side = dip_ui_px(ui, GRID);
    return (Icon){ui, rect.x + (rect.width - side) / 2, rect.y + (rect.height - side) / 2, colour};
}

// Fills a rectangle of the grid. Its edges are rounded once each, so that neighbours meet.
static void box(const Icon *icon, int x, int y, int width, int height) {
    const int left = dip_ui_px(icon->ui, x), top = dip_ui_px(icon->ui, y);
    dip_ui_fill(icon->ui,
                (DipRect){icon->x + left, icon->y + top, dip_ui_px(icon->ui, x + width) - left,
                          dip_ui_px(icon->ui, y + height) - top},
                icon->colour);
}

static void ring(const Icon *icon, int x, int y, int side) {
    const int pixels = dip_ui_px(icon->ui, side);
    dip_ui_outline(icon->ui,
                   (DipRect){icon->x + dip_ui_px(icon->ui, x), icon->y + dip_ui_px(icon->ui, y),
                             pixels, pixels},
                   pixels / 2, dip_ui_px(icon->ui, 2), icon->colour);
}

// Draws a line of unit squares from one point of the grid to another.
static void line(const Icon *icon, double x0, double y0, double x1, double y1) {
    const double unit = dip_ui_px(icon->ui, GRID) / (double)GRID;
    const int thick = dip_ui_px(icon->ui, 2);
    const int steps = (int)(fmax(fabs(x1 - x0), fabs(y1 - y0)) * unit) + 1;
    for (int i = 0; i <= steps; ++i) {
        const double at = (double)i / steps;
        dip_ui_fill(icon->ui,
                    (DipRect){icon->x + (int)((x0 + (x1 - x0) * at) * unit),
                              icon->y + (int)((y0 + (y1 - y0) * at) * unit), thick, thick},
                    icon->colour);
    }
}

// Fills the rectangle's outline of the grid.
static void frame(const Icon *icon, int x, int y, int width, int height) {
    box(icon, x, y, width, 1);
    box(icon, x, y + height - 1, width, 1);
    box(icon, x, y, 1, height);
    box(icon, x + width - 1, y, 1, height);
}

void dip_icon_tab(DipUi *ui, DipTab tab, DipRect rect, DipColour colour) {
    const Icon icon = icon_in(ui, rect, colour);
    switch (tab) {
    case DIP_TAB_SETTINGS: // Two sliders.
        box(&icon, 1, 4, 14, 2);
        box(&icon, 1, 10, 14, 2);
        box(&icon, 4, 2, 3, 6);
        box(&icon, 9, 8, 3, 6);
        break;
    case DIP_TAB_LOUPE:
        ring(&icon, 1, 1, 11);
        line(&icon, 10, 10, 14, 14);
        break;
    case DIP_TAB_COMPARE: // A picture whose left half is filled.
        frame(&icon, 1, 2, 14, 12);
        box(&icon, 1, 2, 7, 12);
        break;
    case DIP_TAB_MAPS: // Tiles.
        box(&icon, 1, 11, 4, 4);
        box(&icon, 6, 11, 4, 4);
        box(&icon, 11, 11, 4, 4);
        box(&icon, 6, 6, 4, 4);
        box(&icon, 11, 6, 4, 4);
        box(&icon, 11, 1, 4, 4);
        break;
    case DIP_TAB_ADVICE: // A front of time and error.
        box(&icon, 1, 1, 2, 14);
        box(&icon, 1, 13, 14, 2);
        line(&icon, 4, 2, 6, 7);
        line(&icon, 6, 7, 13, 10);
        break;
    case DIP_TAB_TIMES: // A clock.
        ring(&icon, 1, 1, 14);
        box(&icon, 7, 4, 2, 5);
        box(&icon, 7, 7, 4, 2);
        break;
    case DIP_TAB_PATH: // Three keys of a path.
        line(&icon, 3, 12, 6, 4);
        line(&icon, 6, 4, 12, 9);
        box(&icon, 1, 11, 4, 4);
        box(&icon, 5, 2, 4, 4);
        box(&icon, 11, 8, 4, 4);
        break;
    default:
        break;
    }
}

// Draws a triangle that points right, or left if `left` is set, column by column.
static void triangle(DipUi *ui, DipRect rect, bool left, DipColour colour) {
    for (int i = 0; i < rect.width; ++i) {
        const int half = rect.height * (left ? i + 1 : rect.width - i) / (2 * rect.width);
        dip_ui_fill(ui, (DipRect){rect.x + i, rect.y + rect.height / 2 - half, 1, 2 * half},
                    colour);
    }
}

static DipRect middle_of(const DipUi *ui, DipRect rect) {
    const int side = dip_ui_px(ui, TRIANGLE);
    return (DipRect){rect.x + (rect.width - side) / 2, rect.y + (rect.height - side) / 2, side,
                     side};
}

void dip_icon_play(DipUi *ui, DipRect rect, bool paused, DipColour colour) {
    const DipRect at = middle_of(ui, rect);
    const int bar = dip_ui_px(ui, 3);
    if (paused) {
        triangle(ui, at, false, colour);
    } else {
        dip_ui_fill(ui, (DipRect){at.x + 1, at.y, bar, at.height}, colour);
        dip_ui_fill(ui, (DipRect){at.x + at.width - 1 - bar, at.y, bar, at.height}, colour);
    }
}

void dip_icon_step(DipUi *ui, DipRect rect, bool back, DipColour colour) {
    DipRect at = middle_of(ui, rect);
    const int bar = dip_ui_px(ui, 2);
    const int gap = dip_ui_px(ui, 1);
    dip_ui_fill(ui, (DipRect){back ? at.x + at.width - bar : at.x, at.y, bar, at.height}, colour);
    at.width -= bar + gap;
    at.x += back ? 0 : bar + gap;
    triangle(ui, at, back, colour);
}

void dip_icon_fold(DipUi *ui, DipRect rect, bool up, DipColour colour) {
    const Icon icon = icon_in(ui, rect, colour);
    line(&icon, 3, up ? 9 : 5, 7, up ? 5 : 9);
    line(&icon, 7, up ? 5 : 9, 11, up ? 9 : 5);
}

void dip_icon_full_screen(DipUi *ui, DipRect rect, DipColour colour) {
    const Icon icon = icon_in(ui, rect, colour);
    for (int i = 0; i < 4; ++i) {
        const int x = i % 2 ? 14 : 2, y = i / 2 ? 12 : 3;
        box(&icon, i % 2 ? x - 4 : x, i / 2 ? y : y - 1, 4, 1);
        box(&icon, i % 2 ? x - 1 : x, i / 2 ? y - 3 : y - 1, 1, 4);
    }
}

void dip_icon_panes(DipUi *ui, DipRect rect, DipColour colour) {
    const Icon icon = icon_in(ui, rect, colour);
    box(&icon, 1, 4, 6, 8);
    box(&icon, 9, 4, 6, 8);
}
