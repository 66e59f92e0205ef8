// Translates events of SDL: keys, the mouse, the window, dropped files and game controllers.
#include "app/display/sdl/sdl_private.h"

// SDL numbers buttons and axes of controllers as Diptych does. SDL's mouse buttons have Diptych's
// order, too, but their numbers begin with 1.
_Static_assert((int)DIP_CONTROLLER_A == (int)SDL_CONTROLLER_BUTTON_A, "first button");
_Static_assert((int)DIP_CONTROLLER_START == (int)SDL_CONTROLLER_BUTTON_START, "buttons");
_Static_assert((int)DIP_CONTROLLER_RIGHT == (int)SDL_CONTROLLER_BUTTON_DPAD_RIGHT, "last button");
_Static_assert((int)DIP_CONTROLLER_LEFT_X == (int)SDL_CONTROLLER_AXIS_LEFTX, "first axis");
_Static_assert((int)DIP_CONTROLLER_RIGHT_TRIGGER == (int)SDL_CONTROLLER_AXIS_TRIGGERRIGHT, "axes");
_Static_assert((int)DIP_MOUSE_LEFT == SDL_BUTTON_LEFT - 1, "left button");
_Static_assert((int)DIP_MOUSE_MIDDLE == SDL_BUTTON_MIDDLE - 1, "middle button");
_Static_assert((int)DIP_MOUSE_RIGHT == SDL_BUTTON_RIGHT - 1, "right button");

// --- keys and the mouse --------------------------------------------------------------------------

static const struct {
    SDL_Keycode sdl;
    int key;
} key_names[] = {
    {SDLK_RETURN, DIP_KEYCODE_ENTER},
    {SDLK_KP_ENTER, DIP_KEYCODE_ENTER},
    {SDLK_ESCAPE, DIP_KEYCODE_ESCAPE},
    {SDLK_TAB, DIP_KEYCODE_TAB},
    {SDLK_BACKSPACE, DIP_KEYCODE_BACKSPACE},
    {SDLK_INSERT, DIP_KEYCODE_INSERT},
    {SDLK_DELETE, DIP_KEYCODE_DELETE},
    {SDLK_HOME, DIP_KEYCODE_HOME},
    {SDLK_END, DIP_KEYCODE_END},
    {SDLK_PAGEUP, DIP_KEYCODE_PAGE_UP},
    {SDLK_PAGEDOWN, DIP_KEYCODE_PAGE_DOWN},
    {SDLK_LEFT, DIP_KEYCODE_LEFT},
    {SDLK_RIGHT, DIP_KEYCODE_RIGHT},
    {SDLK_UP, DIP_KEYCODE_UP},
    {SDLK_DOWN, DIP_KEYCODE_DOWN},
    {SDLK_KP_0, '0'},
    {SDLK_KP_PLUS, '+'},
    {SDLK_KP_MINUS, '-'},
    {SDLK_KP_MULTIPLY, '*'},
    {SDLK_KP_DIVIDE, '/'},
    {SDLK_KP_PERIOD, '.'},
};

// If a key outside the keypad types a character, SDL's code of the key is that character's code
// point, as in DipKeycode.
static DipKeycode key_of(SDL_Keycode sdl) {
    for (size_t i = 0; i < sizeof key_names / sizeof key_names[0]; ++i) {
        if (key_names[i].sdl == sdl) {
            return (DipKeycode)key_names[i].key;
        }
    }
    if (sdl >= SDLK_F1 && sdl <= SDLK_F12) {
        return (DipKeycode)(DIP_KEYCODE_F1 + (int)(sdl - SDLK_F1));
    }
    if (sdl >= SDLK_KP_1 && sdl <= SDLK_KP_9) {
        return (DipKeycode)('1' + (int)(sdl - SDLK_KP_1));
    }
    return sdl >= ' ' && sdl <= 0x10ffff ? (DipKeycode)sdl : DIP_KEYCODE_NONE;
}

// Returns the code of the letter or digit that a US keyboard has at the key's place. If a US
// keyboard has another key there, returns `key`, the key's own code.
static DipKeycode position_of(SDL_Scancode code, DipKeycode key) {
    if (code >= SDL_SCANCODE_A && code <= SDL_SCANCODE_Z) {
        return (DipKeycode)('a' + (int)(code - SDL_SCANCODE_A));
    }
    if (code >= SDL_SCANCODE_1 && code <= SDL_SCANCODE_9) {
        return (DipKeycode)('1' + (int)(code - SDL_SCANCODE_1));
    }
    return code == SDL_SCANCODE_0 ? (DipKeycode)'0' : key;
}

static unsigned modifiers_of(unsigned sdl) {
    return (sdl & KMOD_SHIFT ? DIP_MODIFIER_SHIFT : 0u) |
           (sdl & KMOD_CTRL ? DIP_MODIFIER_CTRL : 0u) | (sdl & KMOD_ALT ? DIP_MODIFIER_ALT : 0u) |
           (sdl & KMOD_GUI ? DIP_MODIFIER_SUPER : 0u);
}

static DipEvent key_event(const SDL_KeyboardEvent *sdl) {
    const DipKeycode key = key_of(sdl->keysym.sym);
    return (DipEvent){
        .kind = sdl->type == SDL_KEYDOWN ? DIP_EVENT_KEY_DOWN : DIP_EVENT_KEY_UP,
        .modifiers = modifiers_of(sdl->keysym.mod),
        .key = key,
        .position = position_of(sdl->keysym.scancode, key),
        .repeat = sdl->repeat != 0,
    };
}

static DipEvent mouse_event(DipEventKind kind, int x, int y) {
    const unsigned modifiers = modifiers_of((unsigned)SDL_GetModState());
    return (DipEvent){.kind = kind, .modifiers = modifiers, .x = x, .y = y};
}

static DipEvent button_event(const SDL_MouseButtonEvent *sdl) {
    const bool down = sdl->type == SDL_MOUSEBUTTONDOWN;
    DipEvent event = mouse_event(down ? DIP_EVENT_MOUSE_DOWN : DIP_EVENT_MOUSE_UP, sdl->x, sdl->y);
    const unsigned index = sdl->button - 1u;
    event.button = index < DIP_MOUSE_OTHER ? (DipMouseButton)index : DIP_MOUSE_OTHER;
    event.clicks = down ? sdl->clicks : 0;
    return event;
}

static DipEvent wheel_event(const SDL_MouseWheelEvent *sdl) {
    const double direction = sdl->direction == SDL_MOUSEWHEEL_FLIPPED ? -1.0 : 1.0;
    DipEvent event = mouse_event(DIP_EVENT_MOUSE_WHEEL, sdl->mouseX, sdl->mouseY);
    event.wheel_x = direction * (double)sdl->preciseX;
    event.wheel_y = direction * (double)sdl->preciseY;
    return event;
}

// --- game controllers ----------------------------------------------------------------------------

void dip_sdl_controller_init(void) {
    // SDL's own drivers of some controllers open USB devices and send them reports to light lamps
    // and to rumble. The system's drivers are enough, since the preview only reads.
    SDL_SetHint(SDL_HINT_JOYSTICK_HIDAPI, "0");
    SDL_InitSubSystem(SDL_INIT_GAMECONTROLLER);
}

static DipEvent added_event(const SDL_ControllerDeviceEvent *sdl) {
    // Here, `which` is an index and not an id.
    SDL_GameController *controller = SDL_GameControllerOpen(sdl->which);
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

// SDL may send buttons and axes that have no name in event.h. Their events are ignored.
static DipEvent controller_button_event(const SDL_ControllerButtonEvent *sdl) {
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
        .axis_value = SDL_max(sdl->value / 32767.0, -1.0), // Sticks go from -32768 to 32767.
    };
}

// --- all events ----------------------------------------------------------------------------------

static DipEvent window_event(const SDL_WindowEvent *sdl) {
    switch (sdl->event) {
    case SDL_WINDOWEVENT_SIZE_CHANGED:
        return (DipEvent){.kind = DIP_EVENT_RESIZE};
    case SDL_WINDOWEVENT_EXPOSED:
    case SDL_WINDOWEVENT_SHOWN:
    case SDL_WINDOWEVENT_RESTORED:
    case SDL_WINDOWEVENT_MAXIMIZED:
        return (DipEvent){.kind = DIP_EVENT_EXPOSE};
    default:
        return (DipEvent){.kind = DIP_EVENT_NONE};
    }
}

DipEvent dip_sdl_event_translate(const SDL_Event *sdl) {
    switch (sdl->type) {
    case SDL_KEYDOWN:
    case SDL_KEYUP:
        return key_event(&sdl->key);
    case SDL_MOUSEMOTION:
        return mouse_event(DIP_EVENT_MOUSE_MOVE, sdl->motion.x, sdl->motion.y);
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP:
        return button_event(&sdl->button);
    case SDL_MOUSEWHEEL:
        return wheel_event(&sdl->wheel);
    case SDL_WINDOWEVENT:
        return window_event(&sdl->window);
    case SDL_DROPFILE:
        return (DipEvent){.kind = DIP_EVENT_DROP, .file = sdl->drop.file};
    case SDL_QUIT:
        return (DipEvent){.kind = DIP_EVENT_QUIT};
    case SDL_CONTROLLERDEVICEADDED:
        return added_event(&sdl->cdevice);
    case SDL_CONTROLLERDEVICEREMOVED:
        return removed_event(&sdl->cdevice);
    case SDL_CONTROLLERBUTTONDOWN:
    case SDL_CONTROLLERBUTTONUP:
        return controller_button_event(&sdl->cbutton);
    case SDL_CONTROLLERAXISMOTION:
        return axis_event(&sdl->caxis);
    default:
        return (DipEvent){.kind = DIP_EVENT_NONE};
    }
}
