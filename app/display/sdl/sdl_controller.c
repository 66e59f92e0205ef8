// Opens game controllers and translates their events.
#include "app/display/sdl/sdl_private.h"

// Sticks go from -32768 to 32767.
static const double largest_axis = 32767.0;

// Buttons and axes have the same order in SDL.
_Static_assert((int)DIP_CONTROLLER_A == (int)SDL_CONTROLLER_BUTTON_A, "first button");
_Static_assert((int)DIP_CONTROLLER_START == (int)SDL_CONTROLLER_BUTTON_START, "buttons");
_Static_assert((int)DIP_CONTROLLER_RIGHT == (int)SDL_CONTROLLER_BUTTON_DPAD_RIGHT, "last button");
_Static_assert((int)DIP_CONTROLLER_LEFT_X == (int)SDL_CONTROLLER_AXIS_LEFTX, "first axis");
_Static_assert((int)DIP_CONTROLLER_RIGHT_TRIGGER == (int)SDL_CONTROLLER_AXIS_TRIGGERRIGHT, "axes");

void dip_sdl_controller_init(void) {
    // SDL's own drivers of some controllers open USB devices and send them reports to light lamps
    // and to rumble. The system's drivers are enough, since the preview only reads.
    SDL_SetHint(SDL_HINT_JOYSTICK_HIDAPI, "0");
    SDL_InitSubSystem(SDL_INIT_GAMECONTROLLER);
}

static DipEvent added_event(const SDL_ControllerDeviceEvent *sdl) {
    SDL_GameController *controller = SDL_GameControllerOpen(sdl->which); // An index, not an id.
    if (!controller) {
        return (DipEvent){.kind = DIP_EVENT_NONE};
    }
    DipEvent event = {
        .kind = DIP_EVENT_CONTROLLER_ADDED,
        .controller = SDL_JoystickInstanceID(SDL_GameControllerGetJoystick(controller)),
    };
    const char *name = SDL_GameControllerName(controller);
    SDL_utf8strlcpy(event.text, name ? name : "", sizeof event.text);
    return event;
}

static DipEvent removed_event(const SDL_ControllerDeviceEvent *sdl) {
    SDL_GameController *controller = SDL_GameControllerFromInstanceID(sdl->which);
    if (!controller) {
        return (DipEvent){.kind = DIP_EVENT_NONE};
    }
    SDL_GameControllerClose(controller);
    return (DipEvent){.kind = DIP_EVENT_CONTROLLER_REMOVED, .controller = sdl->which};
}

// SDL may know buttons and axes that no event names.
static DipEvent button_event(const SDL_ControllerButtonEvent *sdl) {
    const bool down = sdl->type == SDL_CONTROLLERBUTTONDOWN;
    return (DipEvent){
        .kind = sdl->button >= DIP_CONTROLLER_BUTTON_COUNT ? DIP_EVENT_NONE
                : down                                     ? DIP_EVENT_CONTROLLER_DOWN
                                                           : DIP_EVENT_CONTROLLER_UP,
        .controller = sdl->which,
        .controller_button = (DipControllerButton)sdl->button,
    };
}

static DipEvent axis_event(const SDL_ControllerAxisEvent *sdl) {
    return (DipEvent){
        .kind = sdl->axis < DIP_CONTROLLER_AXIS_COUNT ? DIP_EVENT_CONTROLLER_AXIS : DIP_EVENT_NONE,
        .controller = sdl->which,
        .axis = (DipControllerAxis)sdl->axis,
        .axis_value = SDL_max(sdl->value / largest_axis, -1.0),
    };
}

DipEvent dip_sdl_controller_translate(const SDL_Event *sdl) {
    switch (sdl->type) {
    case SDL_CONTROLLERDEVICEADDED:
        return added_event(&sdl->cdevice);
    case SDL_CONTROLLERDEVICEREMOVED:
        return removed_event(&sdl->cdevice);
    case SDL_CONTROLLERBUTTONDOWN:
    case SDL_CONTROLLERBUTTONUP:
        return button_event(&sdl->cbutton);
    case SDL_CONTROLLERAXISMOTION:
        return axis_event(&sdl->caxis);
    default:
        return (DipEvent){.kind = DIP_EVENT_NONE};
    }
}
