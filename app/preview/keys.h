// Which key does what. One table gives both the actions and the help.
#ifndef DIP_APP_PREVIEW_KEYS_H
#define DIP_APP_PREVIEW_KEYS_H

#include "app/display/display.h"
#include "app/preview/camera.h"
#include "app/preview/state.h"

typedef struct DipKeyRow {
    int key;   // A DipKeycode. DIP_KEYCODE_NONE: the row is for the help only.
    int other; // A second key that does the same, or DIP_KEYCODE_NONE.
    DipAction action;
    int argument;
    bool repeats;      // The action goes on while the key is held.
    const char *label; // The key's name in the help; NULL: the help leaves the row out.
    const char *text;  // The help's text; NULL for settings, whose title is shown.
} DipKeyRow;

extern const DipKeyRow dip_key_rows[];
extern const int dip_key_row_count;

// Does what a KEY_DOWN event stands for. Returns whether the key has a meaning.
bool dip_keys_press(DipPreviewState *state, const DipEvent *event, int64_t now_ns);

// The keys that are held, of those that fly the camera. Zero-initialise.
typedef struct DipHeldKeys {
    bool letters[26]; // By position on the keyboard, 'a' first.
    unsigned modifiers;
} DipHeldKeys;

// Follows KEY_DOWN and KEY_UP events.
void dip_keys_hold(DipHeldKeys *held, const DipEvent *event);

// Where the held keys fly the camera. Nowhere while Ctrl, Alt or Super is held.
DipCameraKeys dip_keys_camera(const DipHeldKeys *held);

#endif
