// Draws controls and hands them the events of mouse and keyboard, in immediate mode.
//
// The caller declares every control anew in each pass, in the order in which the Tab key visits
// them. There are two main kinds of passes over the same code:
//
// - An event pass hands one event to the controls. Nothing is drawn. The function of the control
//   that the event concerns returns what the user did, and the caller changes its state at once.
// - A drawing pass records the controls into a draw list. No control reports a press, a step or a
//   typed key.
//
// A pass finds the topmost control under the pointer by the rectangles of the pass before it. The
// caller therefore runs a pass without event and draw list first if the controls may have moved.
//
// Since the caller passes the value that a control shows in each pass, no control keeps a copy of
// this value. The code that declares a control decides in one place how the control looks and what
// it does:
//
//     if (dip_ui_button(ui, ID_APPLY, rect, "Apply", DIP_UI_PRIMARY, NULL)) { ... }
//
// All coordinates are pixels of the window's picture. Lengths that are given for scale 1 become
// pixels by dip_ui_px. One DipUi must not be used by two threads at the same time.
#ifndef DIP_APP_UI_UI_H
#define DIP_APP_UI_UI_H

#include "app/ui/draw_list.h"
#include "app/ui/event.h"

// Names a control from one pass to the next. Ids are unique within a pass and are not 0. DIP_UI_ID
// makes an id from a DipUiGroup and an index below 65536. The groups keep the ids of different
// parts of the program apart.
typedef unsigned DipUiId;
#define DIP_UI_ID(group, index) (((unsigned)(group) + 1) << 16 | (unsigned)(index))
typedef enum DipUiGroup {
    DIP_UI_PANES,    // The two pictures.
    DIP_UI_BAR,      // The dock's bar, and the button that brings the dock back.
    DIP_UI_SETTINGS, // Settings, presets, Apply.
    DIP_UI_LOUPE,
    DIP_UI_COMPARE,
    DIP_UI_MAPS,
    DIP_UI_ADVICE,
    DIP_UI_TIMES,
    DIP_UI_HELP,
    DIP_UI_PATH
} DipUiGroup;

typedef struct DipUi DipUi;

// What a pass gets from its caller.
typedef struct DipUiPass {
    DipFont *font;         // Borrowed for the pass.
    double scale;          // Factor from lengths at scale 1 to pixels.
    int64_t now_ns;        // Time on the display's clock.
    DipDrawList *list;     // Where controls are recorded; NULL in an event pass. Borrowed.
    const DipEvent *event; // The event of an event pass; NULL in a drawing pass. Borrowed.
} DipUiPass;

DipUi *dip_ui_create(DipError *err);
void dip_ui_destroy(DipUi **ui);

void dip_ui_begin(DipUi *ui, const DipUiPass *pass);

// Ends the pass. In an event pass, uses an event that no control has taken: Tab and Shift+Tab move
// the focus, and so do arrow keys while the focus shows. Escape hides a tip. Returns whether a
// control or this function has used the event; if so, the caller must not act on it. In a drawing
// pass, draws the tip of the control under the pointer above everything else, once the tip is due,
// and returns false.
bool dip_ui_end(DipUi *ui);

// Returns the time at which a tip is due to appear. The caller must draw the window again at that
// time, even without an event. Returns INT64_MAX if no tip is due.
int64_t dip_ui_wakes_ns(const DipUi *ui);

// Takes the focus from all controls, so that keys act on the preview again.
void dip_ui_blur(DipUi *ui);

// Returns the id of the control whose focus shows, or 0. The focus shows after Tab, and after a
// click on a control that takes digits.
DipUiId dip_ui_focus(const DipUi *ui);

// Returns whether the event is a press of an arrow key without Ctrl, Alt and Super. Sets *dx and
// *dy to the key's direction: 1 is right or down, -1 left or up, 0 neither.
bool dip_ui_arrow(const DipEvent *event, int *dx, int *dy);

// --- controls ----------------------------------------------------------------------------------

typedef struct DipUiControl {
    DipUiId id;
    DipRect rect;     // Where the control takes the mouse.
    const char *tip;  // Text that explains the control while the pointer rests on it; may be NULL.
                      // Copied. Several lines are separated by '\n'.
    bool disabled;    // The control takes no input. It still shows its tip, which says why; a click
                      // shows the tip at once.
    bool skips_focus; // The control never gets the focus.
    bool takes_arrows; // Left, Right, Home and End change the control while it has the focus.
    bool takes_wheel;
    bool takes_digits; // Digits, '.' and Backspace go to the control while it has the focus.
                       // A click gives such a control a focus that shows.
} DipUiControl;

// What the user did with a control in this event pass, and how to draw the control in a drawing
// pass.
typedef struct DipUiInput {
    bool hovered;  // The pointer is over the control, and no mouse button is held that was pressed
                   // over another control.
    bool focused;  // The control has the focus, and the focus shows. The caller then draws a ring.
    bool held;     // A mouse button that was pressed over the control is down, or is released now.
    bool pressed;  // The left button went down and up over the control, or Enter or Space was
                   // pressed.
    bool began;    // The left button was pressed over the control.
    bool moved;    // The pointer moved over the control, or is dragged from it.
    bool right;    // The right button was pressed over the control.
    bool released; // The mouse button that was held is up again, wherever the pointer is.
    DipMouseButton button; // With `held` and `released`: the button.
    int clicks;            // With `began`: 2 for the second press of a double click.
    bool focuses;          // With `began`: the press also brought the window the keyboard focus.
    int steps;     // Steps by wheel (away from the user is +1) or by arrow keys (right is +1).
    bool to_first; // Home was pressed.
    bool to_last;  // End was pressed.
    int typed;     // With takes_digits: a digit, '.', DIP_KEYCODE_BACKSPACE, or 0 for no key.
    int x;         // Where the pointer is.
    int y;
    unsigned modifiers; // DIP_MODIFIER_... bits of the event.
} DipUiInput;

// Declares a control that the caller draws by itself.
DipUiInput dip_ui_control(DipUi *ui, const DipUiControl *control);

typedef enum DipUiLook {
    DIP_UI_PLAIN,
    DIP_UI_PRIMARY, // The main button, such as Apply. It is filled with the accent colour.
    DIP_UI_CHOSEN,  // The chosen one of several alternatives.
    DIP_UI_OFF      // Disabled. The tip says why.
} DipUiLook;

// Declares and draws a button with a text in its middle. Returns whether it was pressed.
bool dip_ui_button(DipUi *ui, DipUiId id, DipRect rect, const char *text, DipUiLook look,
                   const char *tip);

// Declares and draws a field that shows a number as a text. The user types another number and
// presses Enter or Space, or steps by the wheel or the arrow keys. Returns what the user did. Sets
// *typed to the number that Enter or Space ended, or to -1.
DipUiInput dip_ui_number_field(DipUi *ui, DipUiId id, DipRect rect, const char *text,
                               const char *tip, double *typed);

// Lets the tips of all controls in a rectangle appear outside the rectangle if the window has room
// there, so that the tips cover none of these controls. Holds until the end of the pass.
void dip_ui_keep_tips_off(DipUi *ui, DipRect rect);

// --- drawing -----------------------------------------------------------------------------------
// In an event pass, the functions that draw do nothing.

bool dip_ui_is_drawing(const DipUi *ui);
DipDrawList *dip_ui_list(const DipUi *ui); // NULL in an event pass.
double dip_ui_scale(const DipUi *ui);
int64_t dip_ui_now_ns(const DipUi *ui);

// These functions return where the pointer was last seen, in pixels of the window.
int dip_ui_pointer_x(const DipUi *ui);
int dip_ui_pointer_y(const DipUi *ui);

// Converts a length at scale 1 to pixels. A length above 0 becomes at least one pixel.
int dip_ui_px(const DipUi *ui, int length);

void dip_ui_fill(DipUi *ui, DipRect rect, DipColour colour);

// Fills a rectangle with rounded corners. `radius` is in pixels and is limited to half of the
// shorter side.
void dip_ui_fill_round(DipUi *ui, DipRect rect, int radius, DipColour colour);

// Draws the outline of a rectangle with rounded corners, `width` pixels wide, inside the rectangle.
void dip_ui_outline(DipUi *ui, DipRect rect, int radius, int width, DipColour colour);

// Outlines a rectangle from outside with a line of a colour and a dark line around it, so that the
// outline shows over any picture.
void dip_ui_mark(DipUi *ui, DipRect rect, DipColour colour);

// Draws the ring that shows the keyboard's focus around a rectangle, if the control has the focus.
void dip_ui_focus_ring(DipUi *ui, DipRect rect, int radius, const DipUiInput *input);

// Shows a line of text as dip_draw_list_text does, but `size` is the size of letters at scale 1.
void dip_ui_text(DipUi *ui, int size, DipColour colour, DipAlign align, int x, int y, int max_width,
                 const char *line);

// Shows a text in lines that are at most as wide as `room`; '\n' breaks a line, too. Lines that do
// not fit are left out, and so are lines after the tenth. Returns the height of the lines in
// pixels.
int dip_ui_text_block(DipUi *ui, int size, DipColour colour, DipRect room, const char *text);

// Returns the height that dip_ui_text_block needs to show a text at this width. The result is the
// same in event passes and drawing passes.
int dip_ui_text_block_height(const DipUi *ui, int size, int width, const char *text);

// These functions return the width and the height of a line of text in pixels. The results are the
// same in event passes and drawing passes.
int dip_ui_text_width(const DipUi *ui, int size, const char *line);
int dip_ui_line_height(const DipUi *ui, int size);

void dip_ui_picture(DipUi *ui, DipRect rect, const DipPixels *picture, uint64_t version);

#endif
