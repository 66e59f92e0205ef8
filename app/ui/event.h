// Describes what the user does (with keys, the mouse and game controllers) and what happens to a
// window as events.
#ifndef DIP_APP_UI_EVENT_H
#define DIP_APP_UI_EVENT_H

#include <stdbool.h>

// Codes of keys. If a key types a character, its code is that character's Unicode code point, in
// lower case and without modifiers: 'a', '1', '.'. In a terminal, Shift changes this code, except
// for the letters a to z: Shift+1 has the code '!'. The other keys have the values below, beyond
// all code points. The keypad's digits, Enter, and the keys + - * / and . have the same codes as
// the main keyboard's. In a window, the keypad's other keys that type characters, such as = and the
// comma, have no code (DIP_KEYCODE_NONE).
typedef enum DipKeycode {
    DIP_KEYCODE_NONE = 0,
    DIP_KEYCODE_SPACE = ' ',
    DIP_KEYCODE_ENTER = 0x110000,
    DIP_KEYCODE_ESCAPE,
    DIP_KEYCODE_TAB,
    DIP_KEYCODE_BACKSPACE,
    DIP_KEYCODE_INSERT,
    DIP_KEYCODE_DELETE,
    DIP_KEYCODE_HOME,
    DIP_KEYCODE_END,
    DIP_KEYCODE_PAGE_UP,
    DIP_KEYCODE_PAGE_DOWN,
    DIP_KEYCODE_LEFT,
    DIP_KEYCODE_RIGHT,
    DIP_KEYCODE_UP,
    DIP_KEYCODE_DOWN,
    DIP_KEYCODE_F1, // F2 to F12 follow in order.
    DIP_KEYCODE_F2,
    DIP_KEYCODE_F3,
    DIP_KEYCODE_F4,
    DIP_KEYCODE_F5,
    DIP_KEYCODE_F6,
    DIP_KEYCODE_F7,
    DIP_KEYCODE_F8,
    DIP_KEYCODE_F9,
    DIP_KEYCODE_F10,
    DIP_KEYCODE_F11,
    DIP_KEYCODE_F12
} DipKeycode;

// Modifier keys that are held, as bits. COMMAND stands for those that turn a key into a command.
enum {
    DIP_MODIFIER_SHIFT = 1,
    DIP_MODIFIER_CTRL = 2,
    DIP_MODIFIER_ALT = 4,
    DIP_MODIFIER_SUPER = 8,
    DIP_MODIFIER_COMMAND = DIP_MODIFIER_CTRL | DIP_MODIFIER_ALT | DIP_MODIFIER_SUPER
};

typedef enum DipMouseButton {
    DIP_MOUSE_LEFT,
    DIP_MOUSE_MIDDLE,
    DIP_MOUSE_RIGHT,
    DIP_MOUSE_OTHER
} DipMouseButton;

// Buttons of a game controller, named as on an Xbox controller. On another controller, they are the
// buttons at the same places.
typedef enum DipControllerButton {
    DIP_CONTROLLER_A,
    DIP_CONTROLLER_B,
    DIP_CONTROLLER_X,
    DIP_CONTROLLER_Y,
    DIP_CONTROLLER_BACK,
    DIP_CONTROLLER_GUIDE,
    DIP_CONTROLLER_START,
    DIP_CONTROLLER_LEFT_STICK, // The left stick is pressed down.
    DIP_CONTROLLER_RIGHT_STICK,
    DIP_CONTROLLER_LEFT_SHOULDER,
    DIP_CONTROLLER_RIGHT_SHOULDER,
    DIP_CONTROLLER_UP, // Up on the directional pad.
    DIP_CONTROLLER_DOWN,
    DIP_CONTROLLER_LEFT,
    DIP_CONTROLLER_RIGHT,
    DIP_CONTROLLER_BUTTON_COUNT
} DipControllerButton;

// Axes of a game controller. A stick goes from -1 (left, up) to 1 (right, down), a trigger from 0
// to 1 (pulled). Values include the noise of a stick at rest; the display applies no dead zone.
typedef enum DipControllerAxis {
    DIP_CONTROLLER_LEFT_X,
    DIP_CONTROLLER_LEFT_Y,
    DIP_CONTROLLER_RIGHT_X,
    DIP_CONTROLLER_RIGHT_Y,
    DIP_CONTROLLER_LEFT_TRIGGER,
    DIP_CONTROLLER_RIGHT_TRIGGER,
    DIP_CONTROLLER_AXIS_COUNT
} DipControllerAxis;

typedef enum DipEventKind {
    DIP_EVENT_NONE, // An event of none of the kinds below. The preview ignores such an event.
    DIP_EVENT_KEY_DOWN,
    DIP_EVENT_KEY_UP, // Also sent for every held key when the display loses the keyboard focus.
    DIP_EVENT_MOUSE_MOVE,
    DIP_EVENT_MOUSE_DOWN,
    DIP_EVENT_MOUSE_UP,
    DIP_EVENT_MOUSE_WHEEL,
    DIP_EVENT_RESIZE, // The display's size or scale changed.
    DIP_EVENT_EXPOSE, // The display lost what it showed.
    DIP_EVENT_DROP,   // The user dropped a file.
    DIP_EVENT_QUIT,   // The user or the system closes the display.
    DIP_EVENT_CONTROLLER_ADDED,
    DIP_EVENT_CONTROLLER_REMOVED,
    DIP_EVENT_CONTROLLER_DOWN, // A button was pressed.
    DIP_EVENT_CONTROLLER_UP,
    DIP_EVENT_CONTROLLER_AXIS // A stick or trigger moved.
} DipEventKind;

// One event. Fields that do not belong to the event's kind are zero.
typedef struct DipEvent {
    DipEventKind kind;
    unsigned modifiers; // Key and mouse events: DIP_MODIFIER_... bits.

    // These fields belong to KEY_DOWN and KEY_UP.
    DipKeycode key;      // The key's code in the user's keyboard layout.
    DipKeycode position; // The letter or digit that a US keyboard has at the key's place; for other
                         // keys and in a terminal, `key`.
    bool repeat;         // KEY_DOWN: the key is held and repeats itself.

    // Mouse events: where the pointer is, in pixels of the whole picture that the display shows.
    int x;
    int y;
    DipMouseButton button; // MOUSE_DOWN and MOUSE_UP: the button.
    int clicks;            // MOUSE_DOWN: 2 for the second press of a double click.
    bool focuses;          // MOUSE_DOWN: the press also gave the display the keyboard focus.
    double wheel_x;        // MOUSE_WHEEL: steps to the right.
    double wheel_y;        // MOUSE_WHEEL: steps away from the user.

    char text[32];    // CONTROLLER_ADDED: the controller's name in UTF-8, cut to fit.
    const char *file; // DROP: the file's name. Borrowed until next_event is called again.

    // These fields belong to events of game controllers.
    int controller;                        // Identifies the controller until it is removed.
    DipControllerButton controller_button; // CONTROLLER_DOWN and CONTROLLER_UP: the button.
    DipControllerAxis axis;                // CONTROLLER_AXIS: the axis.
    double axis_value;                     // CONTROLLER_AXIS: see DipControllerAxis.
} DipEvent;

#endif
