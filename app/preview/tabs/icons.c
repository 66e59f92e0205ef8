// Draws symbols, most of them from strokes on a grid of 16x16 units.
#include "app/preview/tabs/tabs.h"
#include "app/ui/layout.h"

#include <math.h>

enum { GRID = 16, TRIANGLE = 10, LETTERS = 13, MAX_STROKES = 9 };

// END ends a list of strokes. BOX is a filled rectangle: x, y, width, height. RING is the outline
// of a circle in a square: x, y, side. LINE goes from one point to another: x0, y0, x1, y1. All
// numbers are units of the grid.
typedef enum StrokeKind { END, BOX, RING, LINE } StrokeKind;

typedef struct Stroke {
    StrokeKind kind;
    int a, b, c, d;
} Stroke;

static const Stroke icons[DIP_ICON_PLAY][MAX_STROKES] = {
    [DIP_TAB_SETTINGS] = // Two sliders.
    {{BOX, 1, 4, 14, 2}, {BOX, 1, 10, 14, 2}, {BOX, 4, 2, 3, 6}, {BOX, 9, 8, 3, 6}},
    [DIP_TAB_LOUPE] = {{RING, 1, 1, 11, 0}, {LINE, 10, 10, 14, 14}},
    [DIP_TAB_COMPARE] = // A picture whose left half is filled.
    {{BOX, 1, 2, 14, 1},
     {BOX, 1, 13, 14, 1},
     {BOX, 1, 2, 1, 12},
     {BOX, 14, 2, 1, 12},
     {BOX, 1, 2, 7, 12}},
    [DIP_TAB_MAPS] = // Tiles.
    {{BOX, 1, 11, 4, 4},
     {BOX, 6, 11, 4, 4},
     {BOX, 11, 11, 4, 4},
     {BOX, 6, 6, 4, 4},
     {BOX, 11, 6, 4, 4},
     {BOX, 11, 1, 4, 4}},
    [DIP_TAB_ADVICE] = // A Pareto front of time and error.
    {{BOX, 1, 1, 2, 14}, {BOX, 1, 13, 14, 2}, {LINE, 4, 2, 6, 7}, {LINE, 6, 7, 13, 10}},
    [DIP_TAB_TIMES] = // A clock.
    {{RING, 1, 1, 14, 0}, {BOX, 7, 4, 2, 5}, {BOX, 7, 7, 4, 2}},
    [DIP_TAB_PATH] = // Three keys of a path.
    {{LINE, 3, 12, 6, 4},
     {LINE, 6, 4, 12, 9},
     {BOX, 1, 11, 4, 4},
     {BOX, 5, 2, 4, 4},
     {BOX, 11, 8, 4, 4}},
    [DIP_ICON_FULL_SCREEN] = // The corners of a screen.
    {{BOX, 2, 2, 4, 1},
     {BOX, 2, 2, 1, 4},
     {BOX, 10, 2, 4, 1},
     {BOX, 13, 2, 1, 4},
     {BOX, 2, 12, 4, 1},
     {BOX, 2, 9, 1, 4},
     {BOX, 10, 12, 4, 1},
     {BOX, 13, 9, 1, 4}},
    [DIP_ICON_PANES] = {{BOX, 1, 4, 6, 8}, {BOX, 9, 4, 6, 8}},
    [DIP_ICON_FOLD] = {{LINE, 3, 5, 7, 9}, {LINE, 7, 9, 11, 5}},
    [DIP_ICON_OPEN] = {{LINE, 3, 9, 7, 5}, {LINE, 7, 5, 11, 9}},
};

// Draws a stroke on the grid whose top left corner is at x, y.
static void draw_stroke(DipUi *ui, const Stroke *s, int x, int y, DipColour colour) {
    const int left = dip_ui_px(ui, s->a), top = dip_ui_px(ui, s->b), thick = dip_ui_px(ui, 2);
    if (s->kind == BOX) { // Each edge is rounded once, so that adjacent boxes meet.
        dip_ui_fill(ui,
                    (DipRect){x + left, y + top, dip_ui_px(ui, s->a + s->c) - left,
                              dip_ui_px(ui, s->b + s->d) - top},
                    colour);
    } else if (s->kind == RING) {
        const int side = dip_ui_px(ui, s->c);
        dip_ui_outline(ui, (DipRect){x + left, y + top, side, side}, side / 2, thick, colour);
    } else {
        const double unit = dip_ui_px(ui, GRID) / (double)GRID;
        const double dx = s->c - s->a, dy = s->d - s->b;
        const int steps = (int)(fmax(fabs(dx), fabs(dy)) * unit) + 1;
        for (int i = 0; i <= steps; ++i) {
            const double at = (double)i / steps;
            dip_ui_fill(ui,
                        (DipRect){x + (int)((s->a + dx * at) * unit),
                                  y + (int)((s->b + dy * at) * unit), thick, thick},
                        colour);
        }
    }
}

// Draws a triangle that points right, or left if `left` is set, column by column.
static void draw_triangle(DipUi *ui, DipRect rect, bool left, DipColour colour) {
    for (int i = 0; i < rect.width; ++i) {
        const int half = rect.height * (left ? i + 1 : rect.width - i) / (2 * rect.width);
        dip_ui_fill(ui, (DipRect){rect.x + i, rect.y + rect.height / 2 - half, 1, 2 * half},
                    colour);
    }
}

void dip_icon_draw(DipUi *ui, int icon, DipRect rect, DipColour colour) {
    const int grid = dip_ui_px(ui, GRID), side = dip_ui_px(ui, TRIANGLE);
    const DipRect origin = dip_rect_middle(rect, grid, grid);
    DipRect shape = dip_rect_middle(rect, side, side);
    switch (icon) {
    case DIP_ICON_PLAY:
        draw_triangle(ui, shape, false, colour);
        break;
    case DIP_ICON_PAUSE:
        shape = dip_rect_inset(shape, 1, 0);
        dip_ui_fill(ui, dip_cut_left(&shape, dip_ui_px(ui, 3)), colour);
        dip_ui_fill(ui, dip_cut_right(&shape, dip_ui_px(ui, 3)), colour);
        break;
    case DIP_ICON_STEP:
        dip_ui_fill(ui, dip_cut_left(&shape, dip_ui_px(ui, 2)), colour);
        dip_cut_left(&shape, dip_ui_px(ui, 1));
        draw_triangle(ui, shape, false, colour);
        break;
    case DIP_ICON_BACK:
        dip_ui_fill(ui, dip_cut_right(&shape, dip_ui_px(ui, 2)), colour);
        dip_cut_right(&shape, dip_ui_px(ui, 1));
        draw_triangle(ui, shape, true, colour);
        break;
    case DIP_ICON_HELP:
        dip_ui_label(ui, LETTERS, colour, DIP_ALIGN_CENTRE, rect, "?");
        break;
    default:
        for (const Stroke *s = icons[icon]; s->kind != END; ++s) {
            draw_stroke(ui, s, origin.x, origin.y, colour);
        }
        break;
    }
}
