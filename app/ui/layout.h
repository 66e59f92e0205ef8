// Cuts rectangles into rows, columns and grid cells, and writes texts into them.
//
// Code that lays out controls keeps the rectangle that is still free, and cuts from it what each
// row or column needs:
//
//     DipRect rest = body;
//     const DipRect buttons = dip_cut_bottom(&rest, dip_ui_px(ui, 28));
//     dip_ui_line(ui, 12, dip_style_white, &rest, "%d samples", count);
#ifndef DIP_APP_UI_LAYOUT_H
#define DIP_APP_UI_LAYOUT_H

#include "app/ui/ui.h"

static inline int dip_rect_right(DipRect rect) {
    return rect.x + rect.width;
}

static inline int dip_rect_bottom(DipRect rect) {
    return rect.y + rect.height;
}

// Each of these functions cuts a piece from one side of *rest and returns the piece. If the piece
// is larger than *rest, the width or height of *rest becomes negative, which makes it empty.
DipRect dip_cut_top(DipRect *rest, int height);
DipRect dip_cut_bottom(DipRect *rest, int height);
DipRect dip_cut_left(DipRect *rest, int width);
DipRect dip_cut_right(DipRect *rest, int width);

// Returns a rectangle that is `x` pixels smaller at the left and at the right, and `y` pixels
// smaller at the top and at the bottom.
DipRect dip_rect_inset(DipRect rect, int x, int y);

// Returns a rectangle of the given size in the middle of `room`.
DipRect dip_rect_middle(DipRect room, int width, int height);

// Returns a cell of a grid that is as wide as `room` and begins at the top of `room`. The cells are
// numbered from 0, row by row. `height` is the height of a cell, and `gap_x` and `gap_y` are the
// gaps between columns and between rows.
DipRect dip_rect_cell(DipRect room, int columns, int height, int gap_x, int gap_y, int index);

// Shows a line of text in a rectangle, centred vertically. `align` puts the line at the left side,
// at the right side or in the middle. A line that is too wide is shortened as by dip_font_fit.
void dip_ui_label(DipUi *ui, int size, DipColour colour, DipAlign align, DipRect rect,
                  const char *text);

// Shows a line of text at the top of *rest, and cuts the line's height from *rest.
void dip_ui_line(DipUi *ui, int size, DipColour colour, DipRect *rest, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

// Shows a line of text at the left side of *rest as dip_ui_label does, and cuts the text's width
// and `gap` from *rest.
void dip_ui_word(DipUi *ui, int size, DipColour colour, DipRect *rest, int gap, const char *text);

// Declares a control that takes steps by the arrow keys and the wheel (DipUiInput.steps). The
// caller draws the control.
DipUiInput dip_ui_stepper(DipUi *ui, DipUiId id, DipRect rect, const char *tip);

#endif
