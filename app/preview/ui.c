// Hit testing, focus, tips, and drawing of controls.
#include "app/preview/style.h"
#include "app/preview/ui_private.h"

#include <stdio.h>
#include <stdlib.h>

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

void dip_ui_begin(DipUi *ui, const DipUiPass *pass) {
    ui->pass = *pass;
    ui->taken = false;
    ui->first = ui->last = ui->before_focus = ui->after_focus = ui->previous = 0;
    ui->focus_seen = false;
    ui->next_hovered = 0;
    ui->tip[0] = '\0';
    if (pass->event && is_mouse(pass->event)) {
        ui->pointer_x = pass->event->x;
        ui->pointer_y = pass->event->y;
        ui->pointer_inside = true;
    }
}

// --- controls ----------------------------------------------------------------------------------

// Notes the control's place in the order of the focus.
static void order_focus(DipUi *ui, const DipUiControl *control) {
    if (control->skips_focus || control->disabled) {
        return;
    }
    ui->first = ui->first ? ui->first : control->id;
    ui->last = control->id;
    if (control->id == ui->focus) {
        ui->focus_seen = true;
        ui->before_focus = ui->previous;
    } else if (ui->focus_seen && !ui->after_focus) {
        ui->after_focus = control->id;
    }
    ui->previous = control->id;
}

static void take_mouse(DipUi *ui, const DipUiControl *control, DipUiInput *input) {
    const DipEvent *event = ui->pass.event;
    const bool held = ui->held == control->id;
    switch (event->kind) {
    case DIP_EVENT_MOUSE_DOWN:
        if (input->hovered && !ui->held) {
            ui->held = control->id;
            ui->held_button = event->button;
            ui->focus = control->skips_focus ? ui->focus : control->id;
            ui->focus_shows = false;
            input->held = true;
            input->began = event->button == DIP_MOUSE_LEFT;
            input->right = event->button == DIP_MOUSE_RIGHT;
            input->clicks = event->clicks;
            ui->taken = true;
        }
        break;
    case DIP_EVENT_MOUSE_UP:
        if (held && event->button == ui->held_button) {
            input->pressed = input->hovered && event->button == DIP_MOUSE_LEFT;
            ui->taken = true;
        }
        break;
    case DIP_EVENT_MOUSE_MOVE:
        input->moved = held || input->hovered;
        ui->taken = ui->taken || held;
        break;
    case DIP_EVENT_MOUSE_WHEEL:
        if (input->hovered && control->takes_wheel && event->wheel_y != 0.0) {
            input->steps = event->wheel_y > 0.0 ? 1 : -1;
            ui->taken = true;
        }
        break;
    default:
        break;
    }
}

static void take_key(DipUi *ui, const DipUiControl *control, DipUiInput *input) {
    const DipEvent *event = ui->pass.event;
    if (event->kind != DIP_EVENT_KEY_DOWN || ui->focus != control->id || !ui->focus_shows) {
        return;
    }
    const bool plain = !(event->modifiers & ~(unsigned)DIP_MODIFIER_SHIFT);
    bool taken = plain;
    if (!plain) {
        return;
    }
    if (event->key == DIP_KEYCODE_ENTER || event->key == DIP_KEYCODE_SPACE) {
        input->pressed = true;
    } else if (control->takes_arrows && event->key == DIP_KEYCODE_LEFT) {
        input->steps = -1;
    } else if (control->takes_arrows && event->key == DIP_KEYCODE_RIGHT) {
        input->steps = 1;
    } else if (control->takes_arrows && event->key == DIP_KEYCODE_HOME) {
        input->to_first = true;
    } else if (control->takes_arrows && event->key == DIP_KEYCODE_END) {
        input->to_last = true;
    } else {
        taken = false;
    }
    ui->taken = ui->taken || taken;
}

DipUiInput dip_ui_control(DipUi *ui, const DipUiControl *control) {
    DipUiInput input = {.x = ui->pointer_x, .y = ui->pointer_y};
    const bool over =
        ui->pointer_inside && dip_rect_holds(control->rect, ui->pointer_x, ui->pointer_y);
    if (over) {
        ui->next_hovered = control->id; // Later controls lie above earlier ones.
        ui->tip_rect = control->rect;
        snprintf(ui->tip, sizeof ui->tip, "%s", control->tip ? control->tip : "");
    }
    order_focus(ui, control);
    input.hovered = over && (ui->held == 0 || ui->held == control->id);
    input.held = ui->held == control->id;
    input.focused = ui->focus == control->id && ui->focus_shows;
    if (ui->pass.event) {
        input.modifiers = ui->pass.event->modifiers;
        // An event goes to one control only, except that a movement shows everywhere.
        if (!control->disabled && is_mouse(ui->pass.event) && !ui->taken) {
            take_mouse(ui, control, &input);
        } else if (!control->disabled) {
            take_key(ui, control, &input);
        } else if (over && ui->pass.event->kind == DIP_EVENT_MOUSE_DOWN) {
            ui->taken = true;
        }
    }
    return input;
}

bool dip_ui_button(DipUi *ui, DipUiId id, DipRect rect, const char *text, DipUiLook look,
                   const char *tip) {
    const DipUiControl control = {
        .id = id, .rect = rect, .tip = tip, .disabled = look == DIP_UI_OFF};
    const DipUiInput input = dip_ui_control(ui, &control);
    const int radius = dip_ui_px(ui, 4);
    const int size = 13;
    if (look == DIP_UI_PRIMARY) {
        dip_ui_fill_round(ui, rect, radius, dip_style_accent);
    } else {
        dip_ui_fill_round(ui, rect, radius, dip_style_raised);
        dip_ui_outline(ui, rect, radius, dip_ui_px(ui, 1),
                       look == DIP_UI_CHOSEN || (input.hovered && look != DIP_UI_OFF)
                           ? dip_style_white
                           : dip_style_line);
    }
    dip_ui_text(ui, size,
                look == DIP_UI_PRIMARY ? dip_style_on_accent
                : look == DIP_UI_OFF   ? dip_style_dim
                                       : dip_style_white,
                DIP_ALIGN_CENTRE, rect.x + rect.width / 2,
                rect.y + (rect.height - dip_ui_line_height(ui, size)) / 2, rect.width, text);
    if (input.focused) {
        const int away = dip_ui_px(ui, 2);
        dip_ui_outline(ui,
                       (DipRect){rect.x - 2 * away, rect.y - 2 * away, rect.width + 4 * away,
                                 rect.height + 4 * away},
                       radius + 2 * away, away, dip_style_focus);
    }
    return input.pressed;
}
