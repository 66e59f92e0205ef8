// Carries out what keys do. One table defines what most keys do, and what the window's help says
// about all keys.
#ifndef DIP_APP_PREVIEW_STATE_KEYS_H
#define DIP_APP_PREVIEW_STATE_KEYS_H

#include "app/display/display.h"
#include "app/preview/state/camera.h"
#include "app/preview/state/state.h"

typedef struct DipKeyRow {
    int key;   // A DipKeycode, or DIP_KEYCODE_NONE if only the help uses the row.
    int other; // A second key that does the same, or DIP_KEYCODE_NONE.
    DipAction action;
    int argument;
    bool ctrl;         // The key acts only while Ctrl is held.
    bool reverse;      // The action goes backwards, as with Shift.
    bool repeats;      // The action is repeated while the key is held.
    const char *label; // The keys' names in the help; NULL if the help leaves the row out.
    const char *text;  // The help's text. NULL without a label, and for SETTING (its title shows).
} DipKeyRow;

enum { DIP_MAX_KEY_ROWS = 96 }; // Bound of dip_key_row_count.
extern const DipKeyRow dip_key_rows[];
extern const int dip_key_row_count;

// Carries out what the key of a KEY_DOWN event does. Returns whether the preview uses this key.
bool dip_keys_press(DipPreviewState *state, const DipEvent *event, int64_t now_ns);

// The letter keys and modifiers that are held, with which the user flies the camera.
// Zero-initialise.
typedef struct DipHeldKeys {
    bool letters[26]; // letters[i]: the key is held that has the letter 'a' + i on a US keyboard.
    unsigned modifiers;
} DipHeldKeys;

// Updates the held keys from a KEY_DOWN or KEY_UP event.
void dip_keys_hold(DipHeldKeys *held, const DipEvent *event);

// Returns how the held keys fly the camera. All members are 0 while Ctrl, Alt or Super is held.
DipCameraKeys dip_keys_camera(const DipHeldKeys *held);

#endif
