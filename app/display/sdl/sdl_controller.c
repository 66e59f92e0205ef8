// Opens game controllers and translates their events.
#include "app/display/sdl/sdl_controller.h"

// Sticks go from -32768 to 32767.
static const double largest_axis = 32767.0;

static const struct {
    SDL_GameControllerButton sdl;
    DipControllerButton button;
} buttons[] = {
    {SDL_CONTROLLER_BUTTON_A, DIP_CONTROLLER_A},
    {SDL_CONTROLLER_BUTTON_B, DIP_CONTROLLER_B},
    {SDL_CONTROLLER_BUTTON_X, DIP_CONTROLLER_X},
    {SDL_CONTROLLER_BUTTON_Y, DIP_CONTROLLER_Y},
    {SDL_CONTROLLER_BUTTON_BACK, DIP_CONTROLLER_BACK},
    {SDL_CONTROLLER_BUTTON_GUIDE, DIP_CONTROLLER_GUIDE},
    {SDL_CONTROLLER_BUTTON_START, DIP_CONTROLLER_START},
    {SDL_CONTROLLER_BUTTON_LEFTSTICK, DIP_CONTROLLER_LEFT_STICK},
    {SDL_CONTROLLER_BUTTON_RIGHTSTICK, DIP_CONTROLLER_RIGHT_STICK},
    {SDL_CONTROLLER_BUTTON_LEFTSHOULDER, DIP_CONTROLLER_LEFT_SHOULDER},
    {SDL_CONTROLLER_BUTTON_RIGHTSHOULDER, DIP_CONTROLLER_RIGHT_SHOULDER},
    {SDL_CONTROLLER_BUTTON_DPAD_UP, DIP_CONTROLLER_UP},
    {SDL_CONTROLLER_BUTTON_DPAD_DOWN, DIP_CONTROLLER_DOWN},
    {SDL_CONTROLLER_BUTTON_DPAD_LEFT, DIP_CONTROLLER_LEFT},
    {SDL_CONTROLLER_BUTTON_DPAD_RIGHT, DIP_CONTROLLER_RIGHT},
};

static const struct {
    SDL_GameControllerAxis sdl;
    DipControllerAxis axis;
} axes[] = {
    {SDL_CONTROLLER_AXIS_LEFTX, DIP_CONTROLLER_LEFT_X},
    {SDL_CONTROLLER_AXIS_LEFTY, DIP_CONTROLLER_LEFT_Y},
    {SDL_CONTROLLER_AXIS_RIGHTX, DIP_CONTROLLER_RIGHT_X},
    {SDL_CONTROLLER_AXIS_RIGHTY, DIP_CONTROLLER_RIGHT_Y},
    {SDL_CONTROLLER_AXIS_TRIGGERLEFT, DIP_CONTROLLER_LEFT_TRIGGER},
    {SDL_CONTROLLER_AXIS_TRIGGERRIGHT, DIP_CONTROLLER_RIGHT_TRIGGER},
};

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

static DipEvent button_event(const SDL_ControllerButtonEvent *sdl) {
    for (size_t i = 0; i < SDL_arraysize(buttons); ++i) {
        if ((int)buttons[i].sdl == sdl->button) {
            return (DipEvent){
                .kind = sdl->type == SDL_CONTROLLERBUTTONDOWN ? DIP_EVENT_CONTROLLER_DOWN
                                                              : DIP_EVENT_CONTROLLER_UP,
                .controller = sdl->which,
                .controller_button = buttons[i].button,
            };
        }
    }
    return (DipEvent){.kind = DIP_EVENT_NONE};
}

static DipEvent axis_event(const SDL_ControllerAxisEvent *sdl) {
    for (size_t i = 0; i < SDL_arraysize(axes); ++i) {
        if ((int)axes[i].sdl == sdl->axis) {
            return (DipEvent){
                .kind = DIP_EVENT_CONTROLLER_AXIS,
                .controller = sdl->which,
                .axis = axes[i].axis,
                .axis_value = SDL_max(sdl->value / largest_axis, -1.0),
            };
        }
    }
    return (DipEvent){.kind = DIP_EVENT_NONE};
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
