// Turns the buttons of game controllers into keys and actions, and moves the camera by sticks and
// triggers.
#include "app/preview/state/controller.h"

#include "app/preview/state/camera.h"

#include <math.h>
#include <string.h>

// Dead zones as fractions of an axis, with the values that Microsoft recommends for the Xbox
// controller.
static const double left_dead_zone = 7849.0 / 32767.0;
static const double right_dead_zone = 8689.0 / 32767.0;
static const double trigger_dead_zone = 30.0 / 255.0;

// --- buttons -----------------------------------------------------------------------------------

// What a button does: it stands for a key, or it carries out an action. Buttons that move through
// the controls of the panel stand for keys, because the control with the focus may take a key.
// Actions are carried out whichever control has the focus.
typedef struct ButtonRow {
    int key; // A DipKeycode, or DIP_KEYCODE_NONE.
    unsigned modifiers;
    DipAction action; // Used if there is no key.
} ButtonRow;

static const ButtonRow button_rows[DIP_CONTROLLER_BUTTON_COUNT] = {
    [DIP_CONTROLLER_A] = {.key = DIP_KEYCODE_ENTER},
    [DIP_CONTROLLER_B] = {.action = DIP_ACTION_UNDO},
    [DIP_CONTROLLER_X] = {.action = DIP_ACTION_APPLY},
    [DIP_CONTROLLER_Y] = {.action = DIP_ACTION_CAMERA},
    [DIP_CONTROLLER_BACK] = {.key = DIP_KEYCODE_ESCAPE},
    [DIP_CONTROLLER_GUIDE] = {.action = DIP_ACTION_HELP},
    [DIP_CONTROLLER_START] = {.action = DIP_ACTION_PAUSE},
    [DIP_CONTROLLER_LEFT_STICK] = {.action = DIP_ACTION_DOCK},
    [DIP_CONTROLLER_RIGHT_STICK] = {.action = DIP_ACTION_NEXT_PANE},
    [DIP_CONTROLLER_LEFT_SHOULDER] = {.key = DIP_KEYCODE_TAB, .modifiers = DIP_MODIFIER_SHIFT},
    [DIP_CONTROLLER_RIGHT_SHOULDER] = {.key = DIP_KEYCODE_TAB},
    [DIP_CONTROLLER_UP] = {.key = DIP_KEYCODE_UP},
    [DIP_CONTROLLER_DOWN] = {.key = DIP_KEYCODE_DOWN},
    [DIP_CONTROLLER_LEFT] = {.key = DIP_KEYCODE_LEFT},
    [DIP_CONTROLLER_RIGHT] = {.key = DIP_KEYCODE_RIGHT},
};

// If the button stands for a key, fills in the key's event and returns true. Otherwise carries out
// the button's action when the button goes down, and returns false.
static bool press_button(DipPreviewState *state, const DipEvent *event, int64_t now_ns,
                         DipEvent *key) {
    const ButtonRow *row = &button_rows[event->controller_button];
    const bool down = event->kind == DIP_EVENT_CONTROLLER_DOWN;
    if (row->key == DIP_KEYCODE_NONE) {
        if (down) {
            dip_preview_act(state, row->action, 0, false, now_ns);
        }
        return false;
    }
    *key = (DipEvent){.kind = down ? DIP_EVENT_KEY_DOWN : DIP_EVENT_KEY_UP,
                      .key = (DipKeycode)row->key,
                      .position = (DipKeycode)row->key,
                      .modifiers = down ? row->modifiers : 0};
    return true;
}

// --- coming and going --------------------------------------------------------------------------

static int slot_of(const DipControllers *controllers, int controller) {
    for (int i = 0; i < DIP_MAX_CONTROLLERS; ++i) {
        if (controllers->slots[i].used && controllers->slots[i].controller == controller) {
            return i;
        }
    }
    return -1;
}

static void add(DipControllers *controllers, int controller) {
    for (int i = 0; i < DIP_MAX_CONTROLLERS; ++i) {
        if (!controllers->slots[i].used) {
            memset(&controllers->slots[i], 0, sizeof controllers->slots[i]);
            controllers->slots[i].used = true;
            controllers->slots[i].controller = controller;
            return;
        }
    }
}

bool dip_controllers_concern(const DipEvent *event) {
    return event->kind >= DIP_EVENT_CONTROLLER_ADDED && event->kind <= DIP_EVENT_CONTROLLER_AXIS;
}

bool dip_controllers_handle(DipControllers *controllers, DipPreviewState *state,
                            const DipEvent *event, int64_t now_ns, DipEvent *key) {
    const int slot = slot_of(controllers, event->controller);
    switch (event->kind) {
    case DIP_EVENT_CONTROLLER_ADDED:
        if (slot < 0) {
            add(controllers, event->controller);
        }
        dip_preview_notice(state, now_ns, "Controller connected: %s",
                           event->text[0] ? event->text : "without a name");
        return false;
    case DIP_EVENT_CONTROLLER_REMOVED:
        if (slot >= 0) {
            controllers->slots[slot].used = false;
        }
        dip_preview_notice(state, now_ns, "Controller disconnected");
        return false;
    case DIP_EVENT_CONTROLLER_AXIS:
        if (slot >= 0) {
            controllers->slots[slot].axes[event->axis] = event->axis_value;
        }
        return false;
    case DIP_EVENT_CONTROLLER_DOWN:
    case DIP_EVENT_CONTROLLER_UP:
        return press_button(state, event, now_ns, key);
    default:
        return false;
    }
}

// --- flying ------------------------------------------------------------------------------------

// Scales a tilt so that it is 0 at the edge of the dead zone and 1 at full tilt.
static double beyond(double amount, double dead_zone) {
    if (amount <= dead_zone) {
        return 0.0;
    }
    return amount >= 1.0 ? 1.0 : (amount - dead_zone) / (1.0 - dead_zone);
}

// Adds a stick's tilt to *right and *forward. The dead zone is a circle, so that a movement along
// one axis does not jump when the stick leaves the centre of the other axis.
static void add_stick(double x, double y, double dead_zone, double *right, double *forward) {
    const double tilt = sqrt(x * x + y * y);
    const double amount = beyond(tilt, dead_zone);
    if (amount > 0.0) {
        *right += x / tilt * amount;
        *forward -= y / tilt * amount;
    }
}

static double clamp(double value) {
    return value < -1.0 ? -1.0 : value > 1.0 ? 1.0 : value;
}

static bool steer(DipPose *pose, DipCameraKeys keys, double speed_m_per_s, double seconds) {
    keys.right = clamp(keys.right);
    keys.up = clamp(keys.up);
    keys.forward = clamp(keys.forward);
    return dip_camera_move(pose, &keys, speed_m_per_s, seconds);
}

bool dip_controllers_fly(const DipControllers *controllers, DipPose *pose, double speed_m_per_s,
                         double seconds) {
    DipCameraKeys move = {0};
    DipCameraKeys turn = {.turn = true};
    for (int i = 0; i < DIP_MAX_CONTROLLERS; ++i) {
        if (!controllers->slots[i].used) {
            continue;
        }
        const double *axes = controllers->slots[i].axes;
        add_stick(axes[DIP_CONTROLLER_LEFT_X], axes[DIP_CONTROLLER_LEFT_Y], left_dead_zone,
                  &move.right, &move.forward);
        add_stick(axes[DIP_CONTROLLER_RIGHT_X], axes[DIP_CONTROLLER_RIGHT_Y], right_dead_zone,
                  &turn.right, &turn.forward);
        move.up += beyond(axes[DIP_CONTROLLER_RIGHT_TRIGGER], trigger_dead_zone) -
                   beyond(axes[DIP_CONTROLLER_LEFT_TRIGGER], trigger_dead_zone);
    }
    const bool moved = steer(pose, move, speed_m_per_s, seconds);
    return steer(pose, turn, speed_m_per_s, seconds) || moved;
}
