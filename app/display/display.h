// The interface between the preview and the display that shows it: pixels go out, events come in.
//
// A display is a struct of functions and a context. A back end (a folder beside this file) fills in
// the struct; the preview uses nothing else of a back end. All functions of one display must be
// called on one thread. Their first argument is the context:
//
//     display.present(display.context, &picture, rects, 1, err);
#ifndef DIP_APP_DISPLAY_DISPLAY_H
#define DIP_APP_DISPLAY_DISPLAY_H

#include "app/canvas/pixels.h"
#include "renderer/base/error.h"

#include <stdbool.h>
#include <stdint.h>

// Codes of keys. If a key types a character, its code is that character's Unicode code point, in
// lower case and without modifiers: 'a', '1', '.'. The other keys have the values below, beyond all
// code points. The keypad's digits, signs and Enter have the same codes as the main keyboard's.
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

// Modifier keys that are held, as bits.
enum {
    DIP_MODIFIER_SHIFT = 1,
    DIP_MODIFIER_CTRL = 2,
    DIP_MODIFIER_ALT = 4,
    DIP_MODIFIER_SUPER = 8
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
    DIP_CONTROLLER_LEFT_STICK, // The stick is pressed down.
    DIP_CONTROLLER_RIGHT_STICK,
    DIP_CONTROLLER_LEFT_SHOULDER,
    DIP_CONTROLLER_RIGHT_SHOULDER,
    DIP_CONTROLLER_UP, // The directional pad.
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
    DIP_EVENT_NONE, // An event of no other kind. The preview ignores it.
    DIP_EVENT_KEY_DOWN,
    DIP_EVENT_KEY_UP, // Also sent for every held key when the display loses the keyboard focus.
    DIP_EVENT_TEXT,
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

    // KEY_DOWN and KEY_UP.
    DipKeycode key;      // The key's code in the user's keyboard layout.
    DipKeycode position; // The code of the key at the same place on a US keyboard.
    bool repeat;         // KEY_DOWN: the key is held and repeats itself.

    // Mouse events: where the pointer is, in pixels of the picture.
    int x;
    int y;
    DipMouseButton button; // MOUSE_DOWN and MOUSE_UP.
    int clicks;            // MOUSE_DOWN: 2 for the second press of a double click.
    bool focuses;          // MOUSE_DOWN: the press also gave the display the keyboard focus.
    double wheel_x;        // MOUSE_WHEEL: steps to the right.
    double wheel_y;        // MOUSE_WHEEL: steps away from the user.

    char text[32];    // TEXT: UTF-8. CONTROLLER_ADDED: the controller's name, cut to fit.
    const char *file; // DROP: the file's name. Borrowed until next_event is called again.

    // CONTROLLER events.
    int controller;                        // Names the controller until it is removed.
    DipControllerButton controller_button; // CONTROLLER_DOWN and CONTROLLER_UP.
    DipControllerAxis axis;                // CONTROLLER_AXIS.
    double axis_value;                     // CONTROLLER_AXIS: see DipControllerAxis.
} DipEvent;

// A character cell of a display that shows characters, such as a terminal. A cell covers one pixel
// of the picture and the pixel below that one.
typedef struct DipTextCell {
    uint32_t code;   // Code point of a character one cell wide. 0: the cell shows the picture.
    DipColour ink;   // Colour of the character. Alpha is ignored.
    DipColour paper; // Colour behind the character. Alpha is ignored.
} DipTextCell;

typedef struct DipDisplay {
    void *context;

    // Shows a picture. Only the pixels inside the damage rectangles differ from the picture shown
    // before; after a RESIZE or EXPOSE event the damage must cover the whole picture. The picture
    // should have the display's size; if the sizes differ, only the part that fits both shows. The
    // display keeps no pointer to the picture. Fails with RUNTIME.
    bool (*present)(void *context, const DipPixels *picture, const DipRect *damage, int count,
                    DipError *err);

    // Fills in the next event. Waits at most timeout_ms milliseconds for one; 0 does not wait.
    // Returns false if there is no event.
    bool (*next_event)(void *context, int timeout_ms, DipEvent *event);

    // Gets the size of the picture to present, in pixels, at least 1x1.
    void (*size)(void *context, int *width, int *height);

    // Returns the factor by which text and controls are enlarged: 1 on a plain screen, 2 on a
    // screen with pixels half as large.
    double (*scale)(void *context);

    // Returns the number of pictures per second that the display can show.
    double (*refresh_hz)(void *context);

    // Returns the time in nanoseconds since an arbitrary moment. The clock advances while
    // next_event waits.
    int64_t (*now_ns)(void *context);

    // Returns whether nobody can see the picture, because the display is minimised or hidden. An
    // EXPOSE event comes when it shows again. NULL if the display cannot tell.
    bool (*is_hidden)(void *context);

    // Turns full-screen mode on or off. NULL if the display has no such mode.
    void (*set_full_screen)(void *context, bool on);

    // Gives the window a title. NULL if it has none.
    void (*set_title)(void *context, const char *title);

    // Gives the clipboard a text. Returns false if that failed. NULL if the display has no
    // clipboard.
    bool (*set_clipboard)(void *context, const char *text);

    // Asks for another size of the picture, in pixels. The display may take another size than the
    // one asked for. NULL if someone else decides about the size.
    void (*set_size)(void *context, int width, int height);

    // Sets the characters that the next present shows over the picture: `rows` rows of `columns`
    // cells, the top row first. The picture to present has `columns` x 2 `rows` pixels. The display
    // copies the cells. NULL if the display shows pixels only.
    void (*set_text)(void *context, const DipTextCell *cells, int columns, int rows);

    // Closes the display and frees the context.
    void (*close)(void *context);

    // Copies the text of the clipboard, cut to the buffer. Returns false if there is none. NULL if
    // the display has no clipboard.
    bool (*get_clipboard)(void *context, char *text, size_t size_bytes);
} DipDisplay;

#endif
