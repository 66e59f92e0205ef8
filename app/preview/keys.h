// Which key does what. One table gives the dispatch and the help.
#ifndef DIP_APP_PREVIEW_KEYS_H
#define DIP_APP_PREVIEW_KEYS_H

#include "app/preview/state.h"

#include <SDL2/SDL.h>

typedef struct DipKeyRow {
    SDL_Keycode key;
    SDL_Keycode other; // does the same; 0: none
    DipAction action;
    int argument;
    bool repeats;      // goes on while the key is held
    const char *label; // for the help; NULL: not shown there
    const char *text;  // NULL for settings, whose title is shown
} DipKeyRow;

extern const DipKeyRow dip_key_rows[];
extern const int dip_key_row_count;

// Does what the pressed key stands for. Returns whether it stands for something.
bool dip_keys_press(DipPreviewState *state, const SDL_KeyboardEvent *event, int64_t now_ns);

#endif
