// Translates keys, buttons and the fields of events.
#include "app/display/sdl/sdl_private.h"

typedef struct KeyName {
    SDL_Keycode sdl;
    int key;
} KeyName;

static const KeyName key_names[] = {
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
};

static bool in_range(SDL_Keycode sdl, SDL_Keycode first, SDL_Keycode last) {
    return sdl >= first && sdl <= last;
}

// If a key types a character, SDL's code of the key is that character's code point, as in
// DipKeycode.
static DipKeycode key_of(SDL_Keycode sdl) {
    for (size_t i = 0; i < sizeof key_names / sizeof key_names[0]; ++i) {
        if (key_names[i].sdl == sdl) {
            return (DipKeycode)key_names[i].key;
        }
    }
    if (in_range(sdl, SDLK_F1, SDLK_F12)) {
        return (DipKeycode)(DIP_KEYCODE_F1 + (int)(sdl - SDLK_F1));
    }
    if (in_range(sdl, SDLK_KP_1, SDLK_KP_9)) {
        return (DipKeycode)('1' + (int)(sdl - SDLK_KP_1));
    }
    return in_range(sdl, ' ', 0x10ffff) ? (DipKeycode)sdl : DIP_KEYCODE_NONE;
}

// Returns the code of the letter or digit at the key's place on a US keyboard. Other keys are at
// the same place in every layout, so their code is returned.
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

static DipMouseButton button_of(unsigned sdl) {
    return sdl == SDL_BUTTON_LEFT     ? DIP_MOUSE_LEFT
           : sdl == SDL_BUTTON_MIDDLE ? DIP_MOUSE_MIDDLE
           : sdl == SDL_BUTTON_RIGHT  ? DIP_MOUSE_RIGHT
                                      : DIP_MOUSE_OTHER;
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

static DipEvent button_event(const SDL_MouseButtonEvent *sdl) {
    const bool down = sdl->type == SDL_MOUSEBUTTONDOWN;
    return (DipEvent){
        .kind = down ? DIP_EVENT_MOUSE_DOWN : DIP_EVENT_MOUSE_UP,
        .modifiers = modifiers_of((unsigned)SDL_GetModState()),
        .x = sdl->x,
        .y = sdl->y,
        .button = button_of(sdl->button),
        .clicks = down ? sdl->clicks : 0,
    };
}

static DipEvent move_event(const SDL_MouseMotionEvent *sdl) {
    return (DipEvent){
        .kind = DIP_EVENT_MOUSE_MOVE,
        .modifiers = modifiers_of((unsigned)SDL_GetModState()),
        .x = sdl->x,
        .y = sdl->y,
    };
}

static DipEvent wheel_event(const SDL_MouseWheelEvent *sdl) {
    const double direction = sdl->direction == SDL_MOUSEWHEEL_FLIPPED ? -1.0 : 1.0;
    return (DipEvent){
        .kind = DIP_EVENT_MOUSE_WHEEL,
        .modifiers = modifiers_of((unsigned)SDL_GetModState()),
        .x = sdl->mouseX,
        .y = sdl->mouseY,
        .wheel_x = direction * (double)sdl->preciseX,
        .wheel_y = direction * (double)sdl->preciseY,
    };
}

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
        return move_event(&sdl->motion);
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
    default:
        return (DipEvent){.kind = DIP_EVENT_NONE};
    }
}
