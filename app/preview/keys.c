// The table of keys.
#include "app/preview/keys.h"

#include "renderer/base/assert.h"

#define SETTING_KEY(key, other, NAME, label)                                                       \
    { key, other, DIP_ACTION_SETTING, DIP_SETTING_##NAME, false, label, NULL }
#define PATH_KEY(digit)                                                                            \
    { SDLK_##digit, SDLK_KP_##digit, DIP_ACTION_PATH, digit, false, NULL, NULL }

// W, A, S, D, Q and E belong to the camera.
const DipKeyRow dip_key_rows[] = {
    SETTING_KEY(SDLK_x, SDLK_F2, AA, "X  F2"),
    SETTING_KEY(SDLK_t, SDLK_F3, TAA, "T  F3"),
    SETTING_KEY(SDLK_v, SDLK_F4, AAA, "V  F4"),
    SETTING_KEY(SDLK_b, SDLK_F5, ASD, "B  F5"),
    SETTING_KEY(SDLK_f, SDLK_F6, AF, "F  F6"),
    SETTING_KEY(SDLK_g, SDLK_F7, AAF, "G  F7"),
    SETTING_KEY(SDLK_o, SDLK_F8, OPT, "O  F8"),
    SETTING_KEY(SDLK_l, SDLK_F9, MIPLOD, "L  F9"),
    SETTING_KEY(SDLK_i, SDLK_F10, GI, "I  F10"),
    SETTING_KEY(SDLK_m, 0, MIPDEBUG, "M"),
    {SDLK_TAB, 0, DIP_ACTION_NEXT_PANE, 0, false, "Tab  Click", "Choose the pane"},
    {SDLK_RETURN, SDLK_KP_ENTER, DIP_ACTION_APPLY, 0, false, "Enter", "Apply the requested"},
    {SDLK_SPACE, 0, DIP_ACTION_PAUSE, 0, false, "Space", "Pause or play"},
    {SDLK_PERIOD, 0, DIP_ACTION_STEP, 0, true, ".  ,", "Step a frame"},
    {SDLK_COMMA, 0, DIP_ACTION_STEP_BACK, 0, true, NULL, NULL},
    {SDLK_p, SDLK_RIGHT, DIP_ACTION_NEXT_PATH, 0, false, "P", "Next path"},
    {SDLK_LEFT, 0, DIP_ACTION_PREVIOUS_PATH, 0, false, NULL, NULL},
    PATH_KEY(0),
    PATH_KEY(1),
    PATH_KEY(2),
    PATH_KEY(3),
    PATH_KEY(4),
    PATH_KEY(5),
    PATH_KEY(6),
    PATH_KEY(7),
    PATH_KEY(8),
    {SDLK_9, SDLK_KP_9, DIP_ACTION_PATH, 9, false, "0 .. 9", "Path of a setting"},
    {SDLK_c, 0, DIP_ACTION_CAMERA, 0, false, "C", "Fly the camera:"},
    {0, 0, DIP_ACTION_CAMERA, 0, false, "W A S D Q E", "move (Shift: turn)"},
    {SDLK_r, 0, DIP_ACTION_PANEL, 0, false, "R", "Times, error, work"},
    {SDLK_u, 0, DIP_ACTION_COSTS, 0, false, "U", "What settings cost"},
    {SDLK_k, 0, DIP_ACTION_ADVICE, 0, false, "K", "Advice for a time"},
    {SDLK_F1, SDLK_h, DIP_ACTION_HELP, 0, false, "F1  H", "This help"},
    {SDLK_F11, 0, DIP_ACTION_FULL_SCREEN, 0, false, "F11", "Full screen"},
    {SDLK_F12, 0, DIP_ACTION_SCREENSHOT, 0, false, "F12", "Screenshot"},
    {SDLK_ESCAPE, 0, DIP_ACTION_QUIT, 0, false, "Esc  Ctrl+Q", "Quit"},
};

const int dip_key_row_count = (int)DIP_ARRAY_COUNT(dip_key_rows);

bool dip_keys_press(DipPreviewState *state, const SDL_KeyboardEvent *event, int64_t now_ns) {
    const SDL_Keycode key = event->keysym.sym;
    const bool shift = (event->keysym.mod & KMOD_SHIFT) != 0;
    if (event->keysym.mod & (KMOD_CTRL | KMOD_ALT | KMOD_GUI)) {
        if ((event->keysym.mod & KMOD_CTRL) && key == SDLK_q) {
            dip_preview_act(state, DIP_ACTION_QUIT, 0, false, now_ns);
            return true;
        }
        return false;
    }
    // Escape leaves what covers the panes before it leaves the program.
    if (key == SDLK_ESCAPE && (state->help || state->show_costs)) {
        state->help = state->show_costs = false;
        return true;
    }
    for (int i = 0; i < dip_key_row_count; ++i) {
        const DipKeyRow *row = &dip_key_rows[i];
        if (row->key != 0 && (row->key == key || (row->other != 0 && row->other == key))) {
            if (!event->repeat || row->repeats) {
                dip_preview_act(state, row->action, row->argument, shift, now_ns);
            }
            return true;
        }
    }
    return false;
}
