// Draws the shapes, texts and tips of controls. At the end of a pass (ui.h), lets the keys move the
// focus.
#include "app/ui/layout.h"
#include "app/ui/style.h"
#include "app/ui/ui_private.h"

#include <stdio.h>
#include <stdlib.h>

enum { TIP_SIZE = 12, TIP_PAD = 8, TIP_WIDTH = 340, TIP_MAX_LINES = 10 };
static const int64_t tip_delay_ns = 400000000;
static const DipColour tip_line = {98, 108, 122, 255};

bool dip_ui_is_drawing(const DipUi *ui) {
    return ui->pass.list != NULL;
}

DipDrawList *dip_ui_list(const DipUi *ui) {
    return ui->pass.list;
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
    dip_draw_list_fill(ui->pass.list, rect, colour);
}

void dip_ui_fill_round(DipUi *ui, DipRect rect, int radius, DipColour colour) {
    dip_draw_list_round(ui->pass.list, rect, radius, 0, colour);
}

void dip_ui_outline(DipUi *ui, DipRect rect, int radius, int width, DipColour colour) {
    dip_draw_list_round(ui->pass.list, rect, radius, dip_max(1, width), colour);
}

void dip_ui_mark(DipUi *ui, DipRect rect, DipColour colour) {
    const int thin = dip_ui_px(ui, 1);
    dip_ui_outline(ui, dip_rect_inset(rect, -3 * thin, -3 * thin), 0, thin, dip_style_dark);
    dip_ui_outline(ui, dip_rect_inset(rect, -2 * thin, -2 * thin), 0, 2 * thin, colour);
}

void dip_ui_focus_ring(DipUi *ui, DipRect rect, int radius, const DipUiInput *input) {
    const int width = dip_ui_px(ui, 2);
    if (input->focused) {
        dip_ui_outline(ui, dip_rect_inset(rect, -2 * width, -2 * width), radius + 2 * width, width,
                       dip_style_focus);
    }
}

void dip_ui_text(DipUi *ui, int size, DipColour colour, DipAlign align, int x, int y, int max_width,
                 const char *line) {
    dip_draw_list_text(ui->pass.list, dip_ui_px(ui, size), colour, align, x, y, max_width, line);
}

int dip_ui_text_width(const DipUi *ui, int size, const char *line) {
    return dip_font_width(ui->pass.font, dip_ui_px(ui, size), line);
}

int dip_ui_line_height(const DipUi *ui, int size) {
    return dip_font_line_height(ui->pass.font, dip_ui_px(ui, size));
}

void dip_ui_picture(DipUi *ui, DipRect rect, const DipPixels *picture, uint64_t version) {
    dip_draw_list_picture(ui->pass.list, rect, picture, version);
}

// --- the tip -------------------------------------------------------------------------------------

// Breaks a text into lines that are at most `width` pixels wide. A wider word gets a line of its
// own. '\n' breaks a line, too. Returns the number of lines; the text after TIP_MAX_LINES lines is
// left out.
static int break_lines(const DipUi *ui, int size, const char *text, int width,
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
                if (fitting && dip_ui_text_width(ui, size, line) > width) {
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

int dip_ui_text_block(DipUi *ui, int size, DipColour colour, DipRect room, const char *text) {
    char lines[TIP_MAX_LINES][DIP_UI_TIP_BYTES];
    const int line_height = dip_ui_line_height(ui, size);
    const int count =
        dip_min(break_lines(ui, size, text, room.width, lines), room.height / line_height);
    for (int i = 0; i < count; ++i) {
        dip_ui_text(ui, size, colour, DIP_ALIGN_LEFT, room.x, room.y + i * line_height, room.width,
                    lines[i]);
    }
    return count * line_height;
}

int dip_ui_text_block_height(const DipUi *ui, int size, int width, const char *text) {
    char lines[TIP_MAX_LINES][DIP_UI_TIP_BYTES];
    return break_lines(ui, size, text, width, lines) * dip_ui_line_height(ui, size);
}

void dip_ui_keep_tips_off(DipUi *ui, DipRect rect) {
    ui->tip_off = rect;
}

static bool shows_tip(const DipUi *ui) {
    return ui->tip[0] && !ui->held && !ui->tip_hidden &&
           ui->pass.now_ns >= ui->hovered_ns + tip_delay_ns;
}

// Returns a box's position along one axis, changed so that the box lies in the window.
static int moved_inside(int at, int size, int room) {
    return dip_max(0, dip_min(at, room - size));
}

// Finds a place for a box outside of `off`: above it, right or left of it, or below it. Returns
// false if the window has no such place.
static bool place_beside(const DipUi *ui, DipRect off, DipRect *box) {
    const int gap = dip_ui_px(ui, TIP_PAD) / 2;
    const DipRect window = {0, 0, dip_draw_list_width(ui->pass.list),
                            dip_draw_list_height(ui->pass.list)};
    const int x = moved_inside(ui->tip_rect.x, box->width, window.width);
    // Beside a control that is higher than the box, the box follows the pointer.
    const DipRect control = ui->tip_rect;
    const int lowest = dip_max(control.y, control.y + control.height - box->height);
    const int at = dip_max(control.y, dip_min(ui->pointer_y - box->height / 2, lowest));
    const int y = moved_inside(at, box->height, window.height);
    const DipRect places[] = {
        {x, off.y - gap - box->height, box->width, box->height},
        {off.x + off.width + gap, y, box->width, box->height},
        {off.x - gap - box->width, y, box->width, box->height},
        {x, off.y + off.height + gap, box->width, box->height},
    };
    for (size_t i = 0; i < sizeof places / sizeof *places; ++i) {
        if (dip_rect_equals(dip_rect_intersect(places[i], window), places[i])) {
            *box = places[i];
            return true;
        }
    }
    return false;
}

// Draws the tip. If the pointer is in the rectangle of dip_ui_keep_tips_off and the window has room
// beside this rectangle, the tip stands there. Otherwise it stands beside its control, or at the
// top of the window if there is no room beside the control either.
static void draw_tip(DipUi *ui) {
    char lines[TIP_MAX_LINES][DIP_UI_TIP_BYTES];
    const int count = break_lines(
        ui, TIP_SIZE, ui->tip,
        dip_min(dip_ui_px(ui, TIP_WIDTH), dip_draw_list_width(ui->pass.list) - 2 * TIP_PAD), lines);
    const int pad = dip_ui_px(ui, TIP_PAD);
    const int height = count * dip_ui_line_height(ui, TIP_SIZE);
    int width = 0;
    for (int i = 0; i < count; i++) {
        width = dip_max(width, dip_ui_text_width(ui, TIP_SIZE, lines[i]));
    }
    DipRect box = {0, 0, width + 2 * pad, height + 2 * pad};
    const bool in_rows = dip_rect_holds(ui->tip_off, ui->pointer_x, ui->pointer_y);
    if (!(in_rows && place_beside(ui, ui->tip_off, &box)) &&
        !place_beside(ui, ui->tip_rect, &box)) {
        box.x = moved_inside(ui->tip_rect.x, box.width, dip_draw_list_width(ui->pass.list));
    }
    dip_ui_fill_round(ui, box, dip_ui_px(ui, 4), dip_style_raised);
    dip_ui_outline(ui, box, dip_ui_px(ui, 4), 1, tip_line);
    dip_ui_text_block(ui, TIP_SIZE, dip_style_white,
                      (DipRect){box.x + pad, box.y + pad, width, height}, ui->tip);
}

// --- the end of a pass -------------------------------------------------------------------------

// Moves the focus to the next control in the order of declaration that can have the focus, or
// backwards to the previous one. The first control follows the last one.
static void move_focus(DipUi *ui, bool backwards) {
    int at = -1;
    for (int i = 0; i < ui->placed_count; ++i) {
        at = ui->placed[i].id == ui->focus ? i : at;
    }
    const int count = ui->placed_count;
    for (int i = 1; i <= count; ++i) {
        const int first = at < 0 && backwards ? 0 : at;
        const int next = (first + (backwards ? -i : i) + 2 * count) % count;
        if (ui->placed[next].focusable) {
            ui->focus = ui->placed[next].id;
            ui->focus_shows = true;
            return;
        }
    }
}

// Returns how far `to` lies from `from` in a direction, or -1 if `to` does not lie there. One of dx
// and dy is 1 or -1, the other 0. A step aside counts twice as much as a step ahead, so that
// controls straight ahead are nearer than others.
static int64_t distance_towards(DipRect from, DipRect to, int dx, int dy) {
    const int64_t x = 2 * (int64_t)(to.x - from.x) + to.width - from.width;
    const int64_t y = 2 * (int64_t)(to.y - from.y) + to.height - from.height;
    const int64_t ahead = x * dx + y * dy;
    const int64_t aside = llabs(x * dy + y * dx);
    const int reach = dx ? from.width : from.height;
    return ahead >= reach ? ahead + 2 * aside : -1;
}

static void move_focus_towards(DipUi *ui, int dx, int dy) {
    const DipUiPlaced *from = NULL;
    const DipUiPlaced *best = NULL;
    int64_t least = INT64_MAX;
    for (int i = 0; i < ui->placed_count; ++i) {
        from = ui->placed[i].id == ui->focus ? &ui->placed[i] : from;
    }
    for (int i = 0; from && i < ui->placed_count; ++i) {
        const int64_t distance = distance_towards(from->rect, ui->placed[i].rect, dx, dy);
        if (ui->placed[i].focusable && distance >= 0 && distance < least) {
            least = distance;
            best = &ui->placed[i];
        }
    }
    ui->focus = best ? best->id : ui->focus;
}

// Moves the focus by an event that no control took. Returns true if the event is a
// press of Tab, or of an arrow key while the focus shows, with no modifier but Shift.
static bool move_focus_by_key(DipUi *ui, const DipEvent *event) {
    if (event->kind != DIP_EVENT_KEY_DOWN || (event->modifiers & DIP_MODIFIER_COMMAND)) {
        return false;
    }
    if (event->key == DIP_KEYCODE_TAB) {
        move_focus(ui, event->modifiers & DIP_MODIFIER_SHIFT);
        return true;
    }
    int dx, dy;
    if (!ui->focus_shows || !dip_ui_arrow(event, &dx, &dy)) {
        return false;
    }
    move_focus_towards(ui, dx, dy);
    return true;
}

// Hides a focus whose control is gone or can no longer have the focus, so that keys do not go to a
// control that nobody sees.
static void drop_lost_focus(DipUi *ui) {
    bool found = false;
    for (int i = 0; i < ui->placed_count; ++i) {
        found |= ui->placed[i].id == ui->focus && ui->placed[i].focusable;
    }
    ui->focus_shows = ui->focus_shows && found;
}

bool dip_ui_end(DipUi *ui) {
    const DipEvent *event = ui->pass.event;
    if (ui->under != ui->hovered) {
        ui->hovered = ui->under;
        ui->hovered_ns = ui->pass.now_ns;
        ui->tip_seen = ui->tip_hidden = false;
    }
    drop_lost_focus(ui);
    ui->typing = ui->focus_shows && ui->typing == ui->focus ? ui->typing : 0;
    if (event && event->kind == DIP_EVENT_MOUSE_UP && event->button == ui->held_button) {
        ui->held = 0;
    }
    if (event && !ui->taken && move_focus_by_key(ui, event)) {
        ui->taken = true;
    }
    if (event && event->kind == DIP_EVENT_KEY_DOWN && event->key == DIP_KEYCODE_ESCAPE &&
        shows_tip(ui)) {
        ui->tip_hidden = ui->taken = true;
    }
    if (event && event->kind == DIP_EVENT_MOUSE_DOWN) {
        ui->tip_hidden = !ui->tip_asked;
        ui->hovered_ns = ui->tip_asked ? ui->pass.now_ns - tip_delay_ns : ui->hovered_ns;
    }
    if (ui->pass.list && shows_tip(ui)) {
        draw_tip(ui);
        ui->tip_seen = true;
    }
    return event && ui->taken;
}

int64_t dip_ui_wakes_ns(const DipUi *ui) {
    return ui->tip[0] && !ui->tip_seen && !ui->tip_hidden && !ui->held
               ? ui->hovered_ns + tip_delay_ns
               : INT64_MAX;
}

void dip_ui_blur(DipUi *ui) {
    ui->focus = 0;
    ui->focus_shows = false;
}

DipUiId dip_ui_focus(const DipUi *ui) {
    return ui->focus_shows ? ui->focus : 0;
}
