// The table of keys.
#include "app/preview/state/keys.h"

#include "renderer/base/assert.h"

#include <string.h>

#define SETTING_KEY(key, other, NAME, label)                                                       \
    { key, other, DIP_ACTION_SETTING, DIP_SETTING_##NAME, false, label, NULL }
#define PATH_KEY(digit)                                                                            \
    { '0' + digit, DIP_KEYCODE_NONE, DIP_ACTION_PATH, digit, false, NULL, NULL }

// W, A, S, D, Q and E fly the camera.
const DipKeyRow dip_key_rows[] = {
    SETTING_KEY('x', DIP_KEYCODE_F2, AA, "X  F2"),
    SETTING_KEY('t', DIP_KEYCODE_F3, TAA, "T  F3"),
    SETTING_KEY('v', DIP_KEYCODE_F4, AAA, "V  F4"),
    SETTING_KEY('b', DIP_KEYCODE_F5, ASD, "B  F5"),
    SETTING_KEY('f', DIP_KEYCODE_F6, AF, "F  F6"),
    SETTING_KEY('g', DIP_KEYCODE_F7, AAF, "G  F7"),
    SETTING_KEY('o', DIP_KEYCODE_F8, OPT, "O  F8"),
    SETTING_KEY('l', DIP_KEYCODE_F9, MIPLOD, "L  F9"),
    SETTING_KEY('i', DIP_KEYCODE_F10, GI, "I  F10"),
    SETTING_KEY('m', DIP_KEYCODE_NONE, MIPDEBUG, "M"),
    {'`', DIP_KEYCODE_INSERT, DIP_ACTION_NEXT_PANE, 0, false, "`  Insert  Click",
     "Choose the pane"},
    {DIP_KEYCODE_ENTER, DIP_KEYCODE_NONE, DIP_ACTION_APPLY, 0, false, "Enter",
     "Copy requested to current"},
    {'y', DIP_KEYCODE_NONE, DIP_ACTION_DOCK, 0, false, "Y", "Open or fold the panel"},
    {DIP_KEYCODE_NONE, DIP_KEYCODE_NONE, DIP_ACTION_DOCK, 0, false, "Tab  Arrows",
     "Controls of the panel"},
    {DIP_KEYCODE_SPACE, DIP_KEYCODE_NONE, DIP_ACTION_PAUSE, 0, false, "Space", "Pause or play"},
    {'.', DIP_KEYCODE_NONE, DIP_ACTION_STEP, 0, true, ".  ,", "Step one frame"},
    {',', DIP_KEYCODE_NONE, DIP_ACTION_STEP_BACK, 0, true, NULL, NULL},
    {'p', DIP_KEYCODE_RIGHT, DIP_ACTION_NEXT_PATH, 0, false, "P", "Next path"},
    {DIP_KEYCODE_LEFT, DIP_KEYCODE_NONE, DIP_ACTION_PREVIOUS_PATH, 0, false, NULL, NULL},
    PATH_KEY(0),
    PATH_KEY(1),
    PATH_KEY(2),
    PATH_KEY(3),
    PATH_KEY(4),
    PATH_KEY(5),
    PATH_KEY(6),
    PATH_KEY(7),
    PATH_KEY(8),
    {'9', DIP_KEYCODE_NONE, DIP_ACTION_PATH, 9, false, "0 .. 9", "Path made for a setting"},
    {DIP_KEYCODE_NONE, DIP_KEYCODE_NONE, DIP_ACTION_PATH_END, 1, false, "Ctrl+E",
     "Loop, play once, there and back"},
    {DIP_KEYCODE_PAGE_DOWN, DIP_KEYCODE_NONE, DIP_ACTION_SEEK, 5000, true, "PageUp  PageDown",
     "5 s back or on"},
    {DIP_KEYCODE_NONE, DIP_KEYCODE_NONE, DIP_ACTION_NEXT_SCENE, 0, false, "Ctrl+PageDown",
     "Next scene of the gallery"},
    {'\'', DIP_KEYCODE_NONE, DIP_ACTION_LOOK, 0, false, "'", "The scene's next variant"},
    {'z', DIP_KEYCODE_NONE, DIP_ACTION_LOUPE, 0, false, "Z", "Loupe"},
    {'=', DIP_KEYCODE_NONE, DIP_ACTION_ZOOM, 0, true, "=  -  Wheel", "Loupe: zoom"},
    {'j', DIP_KEYCODE_NONE, DIP_ACTION_COMPARISON, 0, false, "J", "Next comparison"},
    {'n', DIP_KEYCODE_NONE, DIP_ACTION_MAP, 0, false, "N", "Next map of error or work"},
    {']', DIP_KEYCODE_NONE, DIP_ACTION_ADJUST, 0, true, "[  ]  Drag", "Divider, gain, brightness"},
    {';', DIP_KEYCODE_NONE, DIP_ACTION_BLINK, 0, false, ";", "Blink"},
    {'/', DIP_KEYCODE_NONE, DIP_ACTION_BARE, 0, false, "/", "Panes only"},
    {'c', DIP_KEYCODE_NONE, DIP_ACTION_CAMERA, 0, false, "C", "Free camera"},
    {DIP_KEYCODE_NONE, DIP_KEYCODE_NONE, DIP_ACTION_CAMERA, 0, false, "W A S D Q E",
     "Move it (with Shift: turn)"},
    {DIP_KEYCODE_NONE, DIP_KEYCODE_NONE, DIP_ACTION_CAMERA, 0, false, "Drag  Wheel",
     "Turn it; speed or distance"},
    {'\\', DIP_KEYCODE_NONE, DIP_ACTION_ORBIT, 0, false, "\\", "Orbit, or turn on the spot"},
    {DIP_KEYCODE_HOME, DIP_KEYCODE_NONE, DIP_ACTION_CAMERA_BACK, 0, false, "Home",
     "The path's pose again"},
    {DIP_KEYCODE_NONE, DIP_KEYCODE_NONE, DIP_ACTION_TAB, DIP_TAB_PATH, false, "Ctrl+P",
     "Make a path from poses"},
    {DIP_KEYCODE_NONE, DIP_KEYCODE_NONE, DIP_ACTION_PATH_EDIT, 0, false, "Ctrl+N  R  Delete",
     "Add, replace, delete a key"},
    {DIP_KEYCODE_NONE, DIP_KEYCODE_NONE, DIP_ACTION_PATH_EDIT, 0, false, "Ctrl+Left  Right",
     "Choose a key"},
    {DIP_KEYCODE_NONE, DIP_KEYCODE_NONE, DIP_ACTION_PATH_EDIT, 0, false, "Ctrl+F  W  O",
     "Fly it, save it, edit this path"},
    {'r', DIP_KEYCODE_NONE, DIP_ACTION_PANEL, 0, false, "R", "Times, errors and work"},
    {'u', DIP_KEYCODE_NONE, DIP_ACTION_COSTS, 0, false, "U", "What each setting costs"},
    {'k', DIP_KEYCODE_NONE, DIP_ACTION_ADVICE, 0, false, "K", "Best settings for a time budget"},
    {DIP_KEYCODE_F1, 'h', DIP_ACTION_HELP, 0, false, "F1  H", "This help"},
    {DIP_KEYCODE_F11, DIP_KEYCODE_NONE, DIP_ACTION_FULL_SCREEN, 0, false, "F11  Double click",
     "Full screen"},
    {DIP_KEYCODE_F12, DIP_KEYCODE_NONE, DIP_ACTION_SCREENSHOT, 0, false, "F12",
     "Screenshot (with Shift: panes only)"},
    {DIP_KEYCODE_NONE, DIP_KEYCODE_NONE, DIP_ACTION_SAVE_POSE, 0, false, "Ctrl+S",
     "Save the camera's pose to poses.pth"},
    {DIP_KEYCODE_NONE, DIP_KEYCODE_NONE, DIP_ACTION_CAMERA, 0, false, "Controller",
     "Sticks fly; Y frees, A presses, X applies"},
    {DIP_KEYCODE_ESCAPE, DIP_KEYCODE_NONE, DIP_ACTION_QUIT, 0, false, "Esc  Ctrl+Q", "Quit"},
};

const int dip_key_row_count = (int)DIP_ARRAY_COUNT(dip_key_rows);

static const unsigned command_modifiers = DIP_MODIFIER_CTRL | DIP_MODIFIER_ALT | DIP_MODIFIER_SUPER;

static bool stands_for(const DipKeyRow *row, DipKeycode key) {
    return row->key != DIP_KEYCODE_NONE && (row->key == (int)key || row->other == (int)key);
}

// Keys that act while Ctrl is held, and keys that act backwards without Shift.
typedef struct OtherKey {
    int key;
    DipAction action;
    int argument;
    bool reverse;
} OtherKey;

static const OtherKey ctrl_keys[] = {
    {'q', DIP_ACTION_QUIT, 0, false},
    {'z', DIP_ACTION_UNDO, 0, false},
    {'y', DIP_ACTION_UNDO, 0, true},
    {DIP_KEYCODE_ENTER, DIP_ACTION_APPLY, 0, false},
    {'s', DIP_ACTION_SAVE_POSE, 0, false},
    {'e', DIP_ACTION_PATH_END, 1, false},
    {'p', DIP_ACTION_TAB, DIP_TAB_PATH, false},
    {'n', DIP_ACTION_PATH_EDIT, DIP_PATH_EDIT_ADD, false},
    {'r', DIP_ACTION_PATH_EDIT, DIP_PATH_EDIT_REPLACE, false},
    {DIP_KEYCODE_DELETE, DIP_ACTION_PATH_EDIT, DIP_PATH_EDIT_DELETE, false},
    {DIP_KEYCODE_RIGHT, DIP_ACTION_PATH_EDIT, DIP_PATH_EDIT_NEXT, false},
    {DIP_KEYCODE_LEFT, DIP_ACTION_PATH_EDIT, DIP_PATH_EDIT_BEFORE, false},
    {'f', DIP_ACTION_PATH_EDIT, DIP_PATH_EDIT_FLY, false},
    {'w', DIP_ACTION_PATH_EDIT, DIP_PATH_EDIT_SAVE, false},
    {'o', DIP_ACTION_PATH_EDIT, DIP_PATH_EDIT_TAKE, false},
    {DIP_KEYCODE_UP, DIP_ACTION_PATH_EDIT, DIP_PATH_EDIT_SLOWER, false},
    {DIP_KEYCODE_DOWN, DIP_ACTION_PATH_EDIT, DIP_PATH_EDIT_FASTER, false},
    {DIP_KEYCODE_PAGE_DOWN, DIP_ACTION_NEXT_SCENE, 0, false},
    {DIP_KEYCODE_PAGE_UP, DIP_ACTION_NEXT_SCENE, 0, true},
};

static const OtherKey backward_keys[] = {
    {DIP_KEYCODE_PAGE_UP, DIP_ACTION_SEEK, 5000, true},
    {'-', DIP_ACTION_ZOOM, 0, true},
    {'[', DIP_ACTION_ADJUST, 0, true},
};

static bool press_other(DipPreviewState *state, const OtherKey *keys, int count,
                        const DipEvent *event, int64_t now_ns) {
    for (int i = 0; i < count; ++i) {
        if (keys[i].key == (int)event->key) {
            if (event->repeat && keys[i].action == DIP_ACTION_PATH_EDIT) {
                return true; // A key that is held adds or saves once.
            }
            dip_preview_act(state, keys[i].action, keys[i].argument, keys[i].reverse, now_ns);
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
    return press_other(state, ctrl_keys, (int)DIP_ARRAY_COUNT(ctrl_keys), event, now_ns);
}

// Leaves the tool that shows, as Escape does. Returns false if none shows.
static bool leave_tool(DipPreviewState *state) {
    DipToolState *tools = &state->tools;
    const bool shows = tools->bare || tools->loupe || tools->map != DIP_MAP_NONE ||
                       tools->comparison != DIP_COMPARE_SIDE_BY_SIDE;
    tools->bare = tools->loupe = false;
    tools->map = DIP_MAP_NONE;
    tools->comparison = DIP_COMPARE_SIDE_BY_SIDE;
    return shows;
}

// While the help shows in a window, what the user types is searched there. Escape takes the words
// back before it closes the help. Returns whether the key was such a key.
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
    if (event->modifiers & command_modifiers) {
        return press_with_modifier(state, event, now_ns);
    }
    if (type_words(state, event)) {
        return true;
    }
    // Escape goes back by one level: a sheet, a tool, full screen, the program.
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
    if (press_other(state, backward_keys, (int)DIP_ARRAY_COUNT(backward_keys), event, now_ns)) {
        return true;
    }
    for (int i = 0; i < dip_key_row_count; ++i) {
        const DipKeyRow *row = &dip_key_rows[i];
        if (stands_for(row, event->key)) {
            if (!event->repeat || row->repeats) {
                const bool reverse = (event->modifiers & DIP_MODIFIER_SHIFT) != 0;
                dip_preview_act(state, row->action, row->argument, reverse, now_ns);
            }
            return true;
        }
    }
    return false;
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
    if (held->modifiers & command_modifiers) {
        return (DipCameraKeys){0};
    }
    return (DipCameraKeys){
        .right = direction(held, 'd', 'a'),
        .up = direction(held, 'q', 'e'),
        .forward = direction(held, 'w', 's'),
        .turn = (held->modifiers & DIP_MODIFIER_SHIFT) != 0,
    };
}
