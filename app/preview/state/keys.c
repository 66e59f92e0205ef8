// Holds the table of keys, and carries out what a pressed key does.
#include "app/preview/state/keys.h"

#include "renderer/base/assert.h"

#include <string.h>

// A row for a key that acts without Ctrl; Shift reverses its action. A second key, `other`, does
// the same.
#define KEY(key, other, action, argument, label, text)                                             \
    { key, other, DIP_ACTION_##action, argument, false, false, false, label, text }
// A row for a key without Ctrl that repeats its action while it is held.
#define HELD(key, action, argument, reverse, label, text)                                          \
    { key, 0, DIP_ACTION_##action, argument, false, reverse, true, label, text }
// CTRL and EDIT make rows for keys that act with Ctrl. Only the keys of CTRL rows repeat their
// action while they are held.
#define CTRL(key, action, argument, reverse, label, text)                                          \
    { key, 0, DIP_ACTION_##action, argument, true, reverse, true, label, text }
#define EDIT(key, edit, label, text)                                                               \
    { key, 0, DIP_ACTION_PATH_EDIT, DIP_PATH_EDIT_##edit, true, false, false, label, text }
// A row that only the help uses. In a terminal, the help leaves out rows whose action needs a
// window.
#define HELP(action, label, text)        KEY(0, 0, action, 0, label, text)
#define SETTING(key, other, NAME, label) KEY(key, other, SETTING, DIP_SETTING_##NAME, label, NULL)
#define PATH(digit)                      KEY('0' + digit, 0, PATH, digit, NULL, NULL)

// W, A, S, D, Q and E have no rows of their own, because they fly the camera (dip_keys_camera).
const DipKeyRow dip_key_rows[] = {
    SETTING('x', DIP_KEYCODE_F2, AA, "X  F2"),
    SETTING('t', DIP_KEYCODE_F3, TAA, "T  F3"),
    SETTING('v', DIP_KEYCODE_F4, AAA, "V  F4"),
    SETTING('b', DIP_KEYCODE_F5, ASD, "B  F5"),
    SETTING('f', DIP_KEYCODE_F6, AF, "F  F6"),
    SETTING('g', DIP_KEYCODE_F7, AAF, "G  F7"),
    SETTING('o', DIP_KEYCODE_F8, OPT, "O  F8"),
    SETTING('l', DIP_KEYCODE_F9, MIPLOD, "L  F9"),
    CTRL('g', SETTING, DIP_SETTING_SCALE, false, "Ctrl+G", NULL),
    CTRL('u', SETTING, DIP_SETTING_UPSCALE, false, "Ctrl+U", NULL),
    CTRL('b', SETTING, DIP_SETTING_POST, false, "Ctrl+B", NULL),
    CTRL('k', SETTING, DIP_SETTING_SHARPEN, false, "Ctrl+K", NULL),
    CTRL('l', SETTING, DIP_SETTING_SHADOWS, false, "Ctrl+L", NULL),
    SETTING('i', DIP_KEYCODE_F10, GI, "I  F10"),
    SETTING('m', 0, MIPDEBUG, "M"),
    KEY('`', DIP_KEYCODE_INSERT, NEXT_PANE, 0, "`  Insert  Click", "Choose the pane"),
    KEY(DIP_KEYCODE_ENTER, 0, APPLY, 0, "Enter", "Copy requested to current"),
    CTRL(DIP_KEYCODE_ENTER, APPLY, 0, false, NULL, NULL),
    CTRL('z', UNDO, 0, false, NULL, NULL),
    CTRL('y', UNDO, 0, true, NULL, NULL),
    HELP(DOCK, "Ctrl+Z  Y", "Undo or redo a change of settings"),
    HELP(DOCK, "Ctrl+C  V", "Copy or paste the requested settings"),
    KEY('y', 0, DOCK, 0, "Y", "Open or fold the panel"),
    HELP(DOCK, "Tab  Arrows", "Controls of the panel"),
    HELP(DOCK, "Ctrl+=  Ctrl+-", "Size of the panel"),
    KEY(DIP_KEYCODE_SPACE, 0, PAUSE, 0, "Space", "Pause or play"),
    HELD('.', STEP, 1, false, ".  ,", "Step one frame"),
    HELD(',', STEP, -1, false, NULL, NULL),
    KEY('p', DIP_KEYCODE_RIGHT, NEXT_PATH, 0, "P", "Next path"),
    {DIP_KEYCODE_LEFT, 0, DIP_ACTION_NEXT_PATH, .reverse = true},
    PATH(0),
    PATH(1),
    PATH(2),
    PATH(3),
    PATH(4),
    PATH(5),
    PATH(6),
    PATH(7),
    PATH(8),
    KEY('9', 0, PATH, 9, "0 .. 9", "Path made for a setting"),
    CTRL('e', PATH_END, 1, false, "Ctrl+E", "Loop, play once, there and back"),
    HELD(DIP_KEYCODE_PAGE_DOWN, SEEK, 5000, false, "PageUp  PageDown", "5 s back or on"),
    HELD(DIP_KEYCODE_PAGE_UP, SEEK, 5000, true, NULL, NULL),
    CTRL(DIP_KEYCODE_PAGE_DOWN, NEXT_SCENE, 0, false, "Ctrl+PageDown", "Next scene of the gallery"),
    CTRL(DIP_KEYCODE_PAGE_UP, NEXT_SCENE, 0, true, NULL, NULL),
    KEY('\'', 0, LOOK, 0, "'", "The scene's next variant"),
    KEY('z', 0, LOUPE, 0, "Z", "Loupe"),
    HELD('=', ZOOM, 0, false, "=  -  Wheel", "Loupe: zoom"),
    HELD('-', ZOOM, 0, true, NULL, NULL),
    KEY('j', 0, COMPARISON, 0, "J", "Next comparison"),
    KEY('n', 0, MAP, 0, "N", "Next map of error or work"),
    HELD(']', ADJUST, 0, false, "[  ]  Drag", "Divider, gain, brightness"),
    HELD('[', ADJUST, 0, true, NULL, NULL),
    KEY(';', 0, BLINK, 0, ";", "Blink"),
    KEY('/', 0, BARE, 0, "/", "Panes only"),
    KEY('c', 0, CAMERA, 0, "C", "Free camera"),
    HELP(CAMERA, "W A S D Q E", "Move it (with Shift: turn)"),
    HELP(CAMERA, "Drag  Wheel", "Turn it; speed or distance"),
    KEY('\\', 0, ORBIT, 0, "\\", "Orbit, or turn on the spot"),
    KEY(DIP_KEYCODE_HOME, 0, CAMERA_BACK, 0, "Home", "The path's pose again"),
    CTRL('p', TAB, DIP_TAB_PATH, false, "Ctrl+P", "Make a path from poses"),
    EDIT('n', ADD, "Ctrl+N  R  Delete", "Add, replace, delete a key"),
    EDIT('r', REPLACE, NULL, NULL),
    EDIT(DIP_KEYCODE_DELETE, DELETE, NULL, NULL),
    EDIT(DIP_KEYCODE_LEFT, BEFORE, "Ctrl+Left  Right", "Choose a key"),
    EDIT(DIP_KEYCODE_RIGHT, NEXT, NULL, NULL),
    EDIT('f', FLY, "Ctrl+F  W  O", "Fly it, save it, edit this path"),
    EDIT('w', SAVE, NULL, NULL),
    EDIT('o', TAKE, NULL, NULL),
    EDIT(DIP_KEYCODE_UP, SLOWER, NULL, NULL),
    EDIT(DIP_KEYCODE_DOWN, FASTER, NULL, NULL),
    KEY('r', 0, PANEL, 0, "R", "Times, errors and work"),
    KEY('u', 0, COSTS, 0, "U", "What each setting costs"),
    KEY('k', 0, ADVICE, 0, "K", "Best settings in the budget (Shift: next budget)"),
    KEY(DIP_KEYCODE_F1, 'h', HELP, 0, "F1  H", "This help"),
    KEY(DIP_KEYCODE_F11, 0, FULL_SCREEN, 0, "F11  Double click", "Full screen"),
    KEY(DIP_KEYCODE_F12, 0, SCREENSHOT, 0, "F12", "Screenshot (with Shift: panes only)"),
    CTRL('s', SAVE_POSE, 0, false, "Ctrl+S", "Save the camera's pose to poses.pth"),
    HELP(CAMERA, "Controller", "Sticks fly; Y frees, A presses, X applies"),
    KEY(DIP_KEYCODE_ESCAPE, 0, QUIT, 0, "Esc", "Close a tool or full screen, then quit"),
    CTRL('q', QUIT, 0, false, "Ctrl+Q", "Quit"),
};

_Static_assert(DIP_ARRAY_COUNT(dip_key_rows) <= DIP_MAX_KEY_ROWS, "room for all keys");
const int dip_key_row_count = (int)DIP_ARRAY_COUNT(dip_key_rows);

static bool stands_for(const DipKeyRow *row, DipKeycode key) {
    return row->key != DIP_KEYCODE_NONE && (row->key == (int)key || row->other == (int)key);
}

// Carries out the action of the key's row. Ignores a repeated press if the row does not repeat.
// Returns whether the key has a row.
static bool press_row(DipPreviewState *state, const DipEvent *event, bool ctrl, int64_t now_ns) {
    for (int i = 0; i < dip_key_row_count; ++i) {
        const DipKeyRow *row = &dip_key_rows[i];
        if (row->ctrl == ctrl && stands_for(row, event->key)) {
            const bool shift = !ctrl && (event->modifiers & DIP_MODIFIER_SHIFT);
            if (!event->repeat || row->repeats) {
                dip_preview_act(state, row->action, row->argument, row->reverse || shift, now_ns);
            }
            return true;
        }
    }
    return false;
}

static bool press_with_modifier(DipPreviewState *state, const DipEvent *event, int64_t now_ns) {
    if (!(event->modifiers & DIP_MODIFIER_CTRL)) {
        return false;
    }
    switch ((int)event->key) {
    case 'c':
        state->copy_settings = true;
        return true;
    case 'v':
        state->paste_settings = true;
        return true;
    case '=':
    case '+':
        dip_preview_scale_ui(state, 0.25, now_ns);
        return true;
    case '-':
        dip_preview_scale_ui(state, -0.25, now_ns);
        return true;
    default:
        break;
    }
    return press_row(state, event, true, now_ns);
}

// Switches the loupe, the map and the comparison off, and shows everything again if only the panes
// show. Returns false if none of these was on.
static bool leave_tool(DipPreviewState *state) {
    DipToolState *tools = &state->tools;
    const bool shows = tools->bare || tools->loupe || tools->map != DIP_MAP_NONE ||
                       tools->comparison != DIP_COMPARE_SIDE_BY_SIDE;
    tools->bare = tools->loupe = false;
    tools->map = DIP_MAP_NONE;
    tools->comparison = DIP_COMPARE_SIDE_BY_SIDE;
    return shows;
}

// Lets the user type words while the help shows in a window; the help then lists only rows that
// contain the words. Escape removes the words. Returns whether the key was used for this. Without
// words, Escape is not used, and closes the help.
static bool type_words(DipPreviewState *state, const DipEvent *event) {
    const size_t length = strlen(state->help_words);
    if (!state->help || state->in_terminal) {
        return false;
    }
    if (event->key == DIP_KEYCODE_BACKSPACE || event->key == DIP_KEYCODE_ESCAPE) {
        const bool had_words = length > 0;
        state->help_words[event->key == DIP_KEYCODE_ESCAPE || !had_words ? 0 : length - 1] = '\0';
        return had_words || event->key == DIP_KEYCODE_BACKSPACE;
    }
    if (event->key < DIP_KEYCODE_SPACE || event->key > (DipKeycode)'~') {
        return false;
    }
    if (length + 1 < sizeof state->help_words) {
        state->help_words[length] = (char)event->key;
        state->help_words[length + 1] = '\0';
    }
    return true;
}

bool dip_keys_press(DipPreviewState *state, const DipEvent *event, int64_t now_ns) {
    if (event->key == DIP_KEYCODE_NONE) {
        return false;
    }
    if (event->modifiers & DIP_MODIFIER_COMMAND) {
        return press_with_modifier(state, event, now_ns);
    }
    if (type_words(state, event)) {
        return true;
    }
    // Each press of Escape does the first of these that it can: closes the help and the cost table,
    // leaves all tools, leaves full screen, ends the program.
    if (event->key == DIP_KEYCODE_ESCAPE && (state->help || state->show_costs)) {
        state->help = state->show_costs = false;
        return true;
    }
    if (event->key == DIP_KEYCODE_ESCAPE && leave_tool(state)) {
        return true;
    }
    if (event->key == DIP_KEYCODE_ESCAPE && state->full_screen) {
        state->full_screen = false;
        return true;
    }
    return press_row(state, event, false, now_ns);
}

void dip_keys_hold(DipHeldKeys *held, const DipEvent *event) {
    const int letter = (int)event->position - 'a';
    held->modifiers = event->modifiers;
    if (letter >= 0 && letter < (int)DIP_ARRAY_COUNT(held->letters)) {
        held->letters[letter] = event->kind == DIP_EVENT_KEY_DOWN;
    }
}

static double direction(const DipHeldKeys *held, char plus, char minus) {
    return (held->letters[plus - 'a'] ? 1.0 : 0.0) - (held->letters[minus - 'a'] ? 1.0 : 0.0);
}

DipCameraKeys dip_keys_camera(const DipHeldKeys *held) {
    if (held->modifiers & DIP_MODIFIER_COMMAND) {
        return (DipCameraKeys){0};
    }
    return (DipCameraKeys){
        .right = direction(held, 'd', 'a'),
        .up = direction(held, 'q', 'e'),
        .forward = direction(held, 'w', 's'),
        .turn = (held->modifiers & DIP_MODIFIER_SHIFT) != 0,
    };
}
