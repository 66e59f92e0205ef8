// Finds the control under the pointer, hands events to controls, and draws buttons and fields.
#include "app/ui/layout.h"
#include "app/ui/style.h"
#include "app/ui/ui_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

DipUi *dip_ui_create(DipError *err) {
    DipUi *ui = calloc(1, sizeof *ui);
    if (!ui) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "preview", "out of memory");
    }
    return ui;
}

void dip_ui_destroy(DipUi **ui) {
    free(*ui);
    *ui = NULL;
}

static bool is_mouse(const DipEvent *event) {
    return event->kind == DIP_EVENT_MOUSE_MOVE || event->kind == DIP_EVENT_MOUSE_DOWN ||
           event->kind == DIP_EVENT_MOUSE_UP || event->kind == DIP_EVENT_MOUSE_WHEEL;
}

// Returns the topmost control under the pointer, as the controls lay in the last pass. Later
// controls lie above earlier ones.
static DipUiId find_under(const DipUi *ui) {
    for (int i = ui->before_count - 1; ui->pointer_inside && i >= 0; --i) {
        if (dip_rect_holds(ui->before[i].rect, ui->pointer_x, ui->pointer_y)) {
            return ui->before[i].id;
        }
    }
    return 0;
}

void dip_ui_begin(DipUi *ui, const DipUiPass *pass) {
    ui->pass = *pass;
    ui->taken = false;
    memcpy(ui->before, ui->placed, (size_t)ui->placed_count * sizeof ui->placed[0]);
    ui->before_count = ui->placed_count;
    ui->placed_count = 0;
    ui->tip[0] = '\0';
    ui->tip_off = (DipRect){0};
    ui->tip_asked = false;
    ui->focus_shows &= !(pass->event && pass->event->kind == DIP_EVENT_MOUSE_DOWN);
    if (pass->event && is_mouse(pass->event)) {
        ui->pointer_x = pass->event->x;
        ui->pointer_y = pass->event->y;
        ui->pointer_inside = true;
    }
    ui->under = find_under(ui);
}

// --- controls ----------------------------------------------------------------------------------

static void press_mouse(DipUi *ui, const DipUiControl *control, DipUiInput *input) {
    const DipEvent *event = ui->pass.event;
    ui->held = control->id;
    ui->held_button = event->button;
    ui->focus = control->skips_focus ? ui->focus : control->id;
    ui->focus_shows = control->takes_digits;
    input->held = true;
    input->button = event->button;
    input->began = event->button == DIP_MOUSE_LEFT;
    input->right = event->button == DIP_MOUSE_RIGHT;
    input->clicks = event->clicks;
    input->focuses = event->focuses;
    ui->taken = true;
}

// Adds `turned` steps of a wheel to the part of a step that earlier events have left. If the wheel
// now turns the other way, that part is dropped first. Returns the whole steps, from -16 to 16, and
// keeps the part of a step that is left. Touch pads send parts of steps.
static int wheel_steps(DipUi *ui, double turned) {
    if (turned * ui->wheel_rest < 0.0) {
        ui->wheel_rest = 0.0;
    }
    ui->wheel_rest += turned;
    const double limited = fmin(fmax(ui->wheel_rest, -16.0), 16.0);
    const int steps = (int)limited;
    ui->wheel_rest = limited - steps;
    return steps;
}

static void take_mouse(DipUi *ui, const DipUiControl *control, DipUiInput *input) {
    const DipEvent *event = ui->pass.event;
    const bool held = ui->held == control->id;
    switch (event->kind) {
    case DIP_EVENT_MOUSE_DOWN:
        if (input->hovered && !ui->held) {
            press_mouse(ui, control, input);
        }
        break;
    case DIP_EVENT_MOUSE_UP:
        if (held && event->button == ui->held_button) {
            input->released = true;
            input->pressed = input->hovered && event->button == DIP_MOUSE_LEFT;
            ui->taken = true;
        }
        break;
    case DIP_EVENT_MOUSE_MOVE:
        input->moved = held || input->hovered;
        ui->taken = ui->taken || held;
        break;
    case DIP_EVENT_MOUSE_WHEEL:
        if (input->hovered && control->takes_wheel) {
            input->steps = wheel_steps(ui, event->wheel_y);
            ui->taken = true;
        }
        break;
    default:
        break;
    }
}

static bool is_plain_key(const DipEvent *event) {
    return event->kind == DIP_EVENT_KEY_DOWN && !(event->modifiers & DIP_MODIFIER_COMMAND);
}

bool dip_ui_arrow(const DipEvent *event, int *dx, int *dy) {
    const DipKeycode key = is_plain_key(event) ? event->key : DIP_KEYCODE_NONE;
    *dx = (key == DIP_KEYCODE_RIGHT) - (key == DIP_KEYCODE_LEFT);
    *dy = (key == DIP_KEYCODE_DOWN) - (key == DIP_KEYCODE_UP);
    return *dx != 0 || *dy != 0;
}

static void take_key(DipUi *ui, const DipUiControl *control, DipUiInput *input) {
    const DipEvent *event = ui->pass.event;
    if (!is_plain_key(event) || ui->focus != control->id || !ui->focus_shows) {
        return;
    }
    bool taken = true;
    if (event->key == DIP_KEYCODE_ENTER || event->key == DIP_KEYCODE_SPACE) {
        input->pressed = !event->repeat;
    } else if (control->takes_arrows && event->key == DIP_KEYCODE_LEFT) {
        input->steps = -1;
    } else if (control->takes_arrows && event->key == DIP_KEYCODE_RIGHT) {
        input->steps = 1;
    } else if (control->takes_arrows && event->key == DIP_KEYCODE_HOME) {
        input->to_first = true;
    } else if (control->takes_arrows && event->key == DIP_KEYCODE_END) {
        input->to_last = true;
    } else if (control->takes_digits &&
               ((event->key >= (DipKeycode)'0' && event->key <= (DipKeycode)'9') ||
                event->key == (DipKeycode)'.' || event->key == DIP_KEYCODE_BACKSPACE)) {
        input->typed = (int)event->key;
    } else {
        taken = false;
    }
    ui->taken = ui->taken || taken;
}

static void place(DipUi *ui, const DipUiControl *control) {
    if (ui->placed_count < DIP_UI_MAX_CONTROLS) {
        ui->placed[ui->placed_count++] =
            (DipUiPlaced){control->id, control->rect, !control->skips_focus && !control->disabled};
    }
}

DipUiInput dip_ui_control(DipUi *ui, const DipUiControl *control) {
    DipUiInput input = {.x = ui->pointer_x, .y = ui->pointer_y};
    const bool over = ui->under == control->id;
    if (over) {
        ui->tip_rect = control->rect;
        snprintf(ui->tip, sizeof ui->tip, "%s", control->tip ? control->tip : "");
    }
    place(ui, control);
    input.hovered = over && (ui->held == 0 || ui->held == control->id);
    input.held = ui->held == control->id;
    input.button = ui->held_button;
    input.focused = ui->focus == control->id && ui->focus_shows;
    if (!ui->pass.event) {
        return input;
    }
    input.modifiers = ui->pass.event->modifiers;
    if (control->disabled) {
        ui->tip_asked |= over && ui->pass.event->kind == DIP_EVENT_MOUSE_DOWN;
        ui->taken |= ui->tip_asked;
    } else if (is_mouse(ui->pass.event) && !ui->taken) {
        take_mouse(ui, control, &input);
    } else {
        take_key(ui, control, &input);
    }
    return input;
}

// Draws a filled box with an outline.
static void draw_box(DipUi *ui, DipRect rect, int radius, DipColour fill, DipColour line) {
    dip_ui_fill_round(ui, rect, radius, fill);
    dip_ui_outline(ui, rect, radius, dip_ui_px(ui, 1), line);
}

bool dip_ui_button(DipUi *ui, DipUiId id, DipRect rect, const char *text, DipUiLook look,
                   const char *tip) {
    const DipUiInput input = dip_ui_control(
        ui, &(DipUiControl){.id = id, .rect = rect, .tip = tip, .disabled = look == DIP_UI_OFF});
    const int radius = dip_ui_px(ui, 4);
    const bool bright = look == DIP_UI_CHOSEN || (input.hovered && look != DIP_UI_OFF);
    int size = 13;
    while (size > 9 && dip_ui_text_width(ui, size, text) > rect.width - dip_ui_px(ui, 6)) {
        --size;
    }
    if (look == DIP_UI_PRIMARY) {
        dip_ui_fill_round(ui, rect, radius, dip_style_accent);
    } else {
        draw_box(ui, rect, radius, dip_style_raised, bright ? dip_style_white : dip_style_line);
    }
    dip_ui_label(ui, size,
                 look == DIP_UI_PRIMARY ? dip_style_on_accent
                 : look == DIP_UI_OFF   ? dip_style_dim
                                        : dip_style_white,
                 DIP_ALIGN_CENTRE, rect, text);
    dip_ui_focus_ring(ui, rect, radius, &input);
    return input.pressed;
}

// Applies the typed key to the number that the user types into a field: appends a digit or a point,
// or removes the last character for Backspace. Returns the number when Enter or Space ends it,
// otherwise -1.
static double type_number(DipUi *ui, DipUiId id, const DipUiInput *input) {
    if (ui->typing != id) {
        ui->typing = input->typed ? id : ui->typing;
        ui->typed[0] = ui->typing == id ? '\0' : ui->typed[0];
    }
    if (ui->typing != id) {
        return -1.0;
    }
    const size_t length = strlen(ui->typed);
    if (input->typed == DIP_KEYCODE_BACKSPACE) {
        ui->typed[length > 0 ? length - 1 : 0] = '\0';
    } else if (input->typed && length + 1 < sizeof ui->typed) {
        ui->typed[length] = (char)input->typed;
        ui->typed[length + 1] = '\0';
    }
    const bool by_key = ui->pass.event && ui->pass.event->kind == DIP_EVENT_KEY_DOWN;
    if (!input->pressed || !by_key || !ui->typed[0]) { // A click does not enter the number.
        return -1.0;
    }
    ui->typing = 0;
    return strtod(ui->typed, NULL);
}

DipUiInput dip_ui_number_field(DipUi *ui, DipUiId id, DipRect rect, const char *text,
                               const char *tip, double *typed) {
    const DipUiInput input = dip_ui_control(ui, &(DipUiControl){.id = id,
                                                                .rect = rect,
                                                                .tip = tip,
                                                                .takes_arrows = true,
                                                                .takes_wheel = true,
                                                                .takes_digits = true});
    *typed = type_number(ui, id, &input);
    char shown[sizeof ui->typed + 4];
    snprintf(shown, sizeof shown, "%s\u2009|", ui->typed);
    draw_box(ui, rect, dip_ui_px(ui, 3), dip_style_well,
             input.focused   ? dip_style_focus
             : input.hovered ? dip_style_white
                             : dip_style_line);
    dip_ui_label(ui, 12, dip_style_white, DIP_ALIGN_CENTRE, rect, ui->typing == id ? shown : text);
    return input;
}
