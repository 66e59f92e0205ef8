// Cuts rectangles into rows, columns and cells, and writes lines of text into them.
#include "app/ui/layout.h"

#include <stdarg.h>
#include <stdio.h>

DipRect dip_cut_top(DipRect *rest, int height) {
    const DipRect piece = {rest->x, rest->y, rest->width, height};
    rest->y += height;
    rest->height -= height;
    return piece;
}

DipRect dip_cut_bottom(DipRect *rest, int height) {
    rest->height -= height;
    return (DipRect){rest->x, dip_rect_bottom(*rest), rest->width, height};
}

DipRect dip_cut_left(DipRect *rest, int width) {
    const DipRect piece = {rest->x, rest->y, width, rest->height};
    rest->x += width;
    rest->width -= width;
    return piece;
}

DipRect dip_cut_right(DipRect *rest, int width) {
    rest->width -= width;
    return (DipRect){dip_rect_right(*rest), rest->y, width, rest->height};
}

DipRect dip_rect_inset(DipRect rect, int x, int y) {
    return (DipRect){rect.x + x, rect.y + y, rect.width - 2 * x, rect.height - 2 * y};
}

DipRect dip_rect_middle(DipRect room, int width, int height) {
    return (DipRect){room.x + (room.width - width) / 2, room.y + (room.height - height) / 2, width,
                     height};
}

DipRect dip_rect_cell(DipRect room, int columns, int height, int gap_x, int gap_y, int index) {
    const int width = (room.width - (columns - 1) * gap_x) / columns;
    return (DipRect){room.x + index % columns * (width + gap_x),
                     room.y + index / columns * (height + gap_y), width, height};
}

void dip_ui_label(DipUi *ui, int size, DipColour colour, DipAlign align, DipRect rect,
                  const char *text) {
    const int x = align == DIP_ALIGN_LEFT     ? rect.x
                  : align == DIP_ALIGN_CENTRE ? rect.x + rect.width / 2
                                              : dip_rect_right(rect);
    dip_ui_text(ui, size, colour, align, x,
                rect.y + (rect.height - dip_ui_line_height(ui, size)) / 2, rect.width, text);
}

void dip_ui_line(DipUi *ui, int size, DipColour colour, DipRect *rest, const char *format, ...) {
    char text[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    dip_ui_label(ui, size, colour, DIP_ALIGN_LEFT, dip_cut_top(rest, dip_ui_line_height(ui, size)),
                 text);
}

void dip_ui_word(DipUi *ui, int size, DipColour colour, DipRect *rest, int gap, const char *text) {
    dip_ui_label(ui, size, colour, DIP_ALIGN_LEFT, *rest, text);
    dip_cut_left(rest, dip_ui_text_width(ui, size, text) + gap);
}

DipUiInput dip_ui_stepper(DipUi *ui, DipUiId id, DipRect rect, const char *tip) {
    return dip_ui_control(
        ui, &(DipUiControl){
                .id = id, .rect = rect, .tip = tip, .takes_arrows = true, .takes_wheel = true});
}
