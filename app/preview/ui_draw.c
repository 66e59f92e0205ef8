// Drawing of the user interface: what a drawing pass records, and the tip.
#include "app/preview/style.h"
#include "app/preview/ui_private.h"

#include <stdio.h>
#include <string.h>

enum { TIP_SIZE = 12, TIP_PAD = 8, TIP_WIDTH = 340, TIP_MAX_LINES = 10 };
static const int64_t tip_delay_ns = 400000000;
static const DipColour tip_ground = {32, 36, 43, 246};
static const DipColour tip_line = {98, 108, 122, 255};

bool dip_ui_is_drawing(const DipUi *ui) {
    return ui->pass.list != NULL;
}

DipDrawList *dip_ui_list(const DipUi *ui) {
    return ui->pass.list;
}

DipFont *dip_ui_font(const DipUi *ui) {
    return ui->pass.font;
}

double dip_ui_scale(const DipUi *ui) {
    return ui->pass.scale;
}

int64_t dip_ui_now_ns(const DipUi *ui) {
    return ui->pass.now_ns;
}

int dip_ui_pointer_x(const DipUi *ui) {
    return ui->pointer_x;
}

int dip_ui_pointer_y(const DipUi *ui) {
    return ui->pointer_y;
}

int dip_ui_px(const DipUi *ui, int length) {
    const int pixels = dip_style_scaled(length, ui->pass.scale);
    return pixels > 0 || length <= 0 ? pixels : 1;
}

void dip_ui_fill(DipUi *ui, DipRect rect, DipColour colour) {
    if (ui->pass.list) {
        dip_draw_list_fill(ui->pass.list, rect, colour);
    }
}

void dip_ui_fill_round(DipUi *ui, DipRect rect, int radius, DipColour colour) {
    if (ui->pass.list) {
        dip_draw_list_round(ui->pass.list, rect, radius, 0, colour);
    }
}

void dip_ui_outline(DipUi *ui, DipRect rect, int radius, int width, DipColour colour) {
    if (ui->pass.list) {
        dip_draw_list_round(ui->pass.list, rect, radius, dip_style_max(1, width), colour);
    }
}

void dip_ui_text(DipUi *ui, int size, DipColour colour, DipAlign align, int x, int y, int max_width,
                 const char *line) {
    if (ui->pass.list) {
        dip_draw_list_text(ui->pass.list, dip_ui_px(ui, size), colour, align, x, y, max_width,
                           line);
    }
}

int dip_ui_text_width(const DipUi *ui, int size, const char *line) {
    return dip_font_width(ui->pass.font, dip_ui_px(ui, size), line);
}

int dip_ui_line_height(const DipUi *ui, int size) {
    return dip_font_line_height(ui->pass.font, dip_ui_px(ui, size));
}

void dip_ui_picture(DipUi *ui, DipRect rect, const DipPixels *picture, uint64_t version) {
    if (ui->pass.list) {
        dip_draw_list_picture(ui->pass.list, rect, picture, version);
    }
}

// --- the tip -------------------------------------------------------------------------------------

// Breaks a text into lines that are at most `width` pixels wide. '\n' breaks a line, too. Returns
// the number of lines; what does not fit in TIP_MAX_LINES lines is left out.
static int break_lines(const DipUi *ui, const char *text, int width,
                       char lines[TIP_MAX_LINES][DIP_UI_TIP_BYTES]) {
    int count = 0;
    while (*text && count < TIP_MAX_LINES) {
        char *line = lines[count];
        size_t length = 0;
        size_t fitting = 0; // Length up to the last blank at which the line still fits.
        while (text[length] && text[length] != '\n') {
            length++;
            if (text[length] == ' ' || text[length] == '\0' || text[length] == '\n') {
                snprintf(line, DIP_UI_TIP_BYTES, "%.*s", (int)length, text);
                if (fitting && dip_ui_text_width(ui, TIP_SIZE, line) > width) {
                    break;
                }
                fitting = length;
            }
        }
        snprintf(line, DIP_UI_TIP_BYTES, "%.*s", (int)fitting, text);
        text += fitting;
        text += *text == ' ' || *text == '\n';
        count++;
    }
    return count;
}

static bool shows_tip(const DipUi *ui) {
    return ui->tip[0] && !ui->held && ui->next_hovered == ui->hovered &&
           ui->pass.now_ns >= ui->hovered_ns + tip_delay_ns;
}

// Draws the tip beneath its control, or above it where the window ends.
static void draw_tip(DipUi *ui) {
    char lines[TIP_MAX_LINES][DIP_UI_TIP_BYTES];
    const int count = break_lines(ui, ui->tip, dip_ui_px(ui, TIP_WIDTH), lines);
    const int pad = dip_ui_px(ui, TIP_PAD);
    const int line_height = dip_ui_line_height(ui, TIP_SIZE);
    const int window_width = dip_draw_list_width(ui->pass.list);
    const int window_height = dip_draw_list_height(ui->pass.list);
    int width = 0;
    for (int i = 0; i < count; i++) {
        width = dip_style_max(width, dip_ui_text_width(ui, TIP_SIZE, lines[i]));
    }
    DipRect box = {ui->tip_rect.x, ui->tip_rect.y + ui->tip_rect.height + pad / 2, width + 2 * pad,
                   count * line_height + 2 * pad};
    if (box.y + box.height > window_height) {
        box.y = ui->tip_rect.y - pad / 2 - box.height;
    }
    box.x = dip_style_max(0, dip_style_min(box.x, window_width - box.width));
    box.y = dip_style_max(0, box.y);
    dip_ui_fill_round(ui, box, dip_ui_px(ui, 4), tip_ground);
    dip_ui_outline(ui, box, dip_ui_px(ui, 4), 1, tip_line);
    for (int i = 0; i < count; i++) {
        dip_ui_text(ui, TIP_SIZE, dip_style_white, DIP_ALIGN_LEFT, box.x + pad,
                    box.y + pad + i * line_height, width + pad, lines[i]);
    }
}

// --- the end of a pass ---------------------------------------------------------------------------

static void move_focus(DipUi *ui, bool backwards) {
    if (!ui->focus_seen) {
        ui->focus = backwards ? ui->last : ui->first;
    } else if (backwards) {
        ui->focus = ui->before_focus ? ui->before_focus : ui->last;
    } else {
        ui->focus = ui->after_focus ? ui->after_focus : ui->first;
    }
    ui->focus_shows = ui->focus != 0;
}

bool dip_ui_end(DipUi *ui) {
    const DipEvent *event = ui->pass.event;
    if (ui->next_hovered != ui->hovered) {
        ui->hovered = ui->next_hovered;
        ui->hovered_ns = ui->pass.now_ns;
        ui->tip_seen = false;
    }
    if (event && event->kind == DIP_EVENT_MOUSE_UP && event->button == ui->held_button) {
        ui->held = 0;
    }
    if (event && event->kind == DIP_EVENT_KEY_DOWN && !ui->taken && event->key == DIP_KEYCODE_TAB &&
        !(event->modifiers & ~(unsigned)DIP_MODIFIER_SHIFT)) {
        move_focus(ui, event->modifiers & DIP_MODIFIER_SHIFT);
        ui->taken = true;
    }
    if (event && event->kind == DIP_EVENT_MOUSE_DOWN) {
        ui->hovered_ns =
            INT64_MAX - tip_delay_ns; // A click hides the tip until the pointer leaves.
    }
    if (ui->pass.list && shows_tip(ui)) {
        draw_tip(ui);
        ui->tip_seen = true;
    }
    ui->has_tip = ui->tip[0] != '\0';
    return event && ui->taken;
}

int64_t dip_ui_wakes_ns(const DipUi *ui) {
    return ui->has_tip && !ui->tip_seen && !ui->held ? ui->hovered_ns + tip_delay_ns : INT64_MAX;
}

void dip_ui_blur(DipUi *ui) {
    ui->focus = 0;
    ui->focus_shows = false;
}

DipUiId dip_ui_focus(const DipUi *ui) {
    return ui->focus_shows ? ui->focus : 0;
}
