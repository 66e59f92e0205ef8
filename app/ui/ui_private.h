// Declares the struct that ui.c and ui_draw.c share.
#ifndef DIP_APP_UI_UI_PRIVATE_H
#define DIP_APP_UI_UI_PRIVATE_H

#include "app/ui/ui.h"

enum { DIP_UI_TIP_BYTES = 900, DIP_UI_MAX_CONTROLS = 192 };

// Where a control lay in a pass.
typedef struct DipUiPlaced {
    DipUiId id;
    DipRect rect;
    bool focusable;
} DipUiPlaced;

struct DipUi {
    DipUiPass pass;
    int pointer_x;
    int pointer_y;
    bool pointer_inside; // True once an event has said where the pointer is.
    // `placed` holds the controls of this pass, and `before` those of the pass before it. This pass
    // finds the topmost control under the pointer in `before`. Controls beyond DIP_UI_MAX_CONTROLS
    // take neither mouse nor focus.
    DipUiPlaced placed[DIP_UI_MAX_CONTROLS];
    int placed_count;
    DipUiPlaced before[DIP_UI_MAX_CONTROLS];
    int before_count;
    DipUiId under;      // The topmost control under the pointer, or 0.
    DipUiId hovered;    // The control under the pointer at the end of the last pass.
    int64_t hovered_ns; // When the pointer came over that control; earlier if tip_asked, so that
                        // the tip shows at once.
    DipUiId held;       // The control over which a held mouse button was pressed, or 0.
    DipMouseButton held_button;
    double wheel_rest; // The part of a step that the wheel has turned after its last whole step.
    DipUiId focus;
    bool focus_shows; // True if the focus is drawn and gets keys: after a key has moved it, or
                      // after a click on a control that takes digits. Any other click hides the
                      // focus.
    DipUiId typing;   // The number field into which the user types, or 0.
    char typed[8]; // What the user has typed into this field and not yet ended with Enter or Space.
    bool taken; // True if a control took the event of this pass, or if the event moved the focus or
                // hid the tip.
    bool tip_hidden;  // True if a click or Escape has hidden the tip until the pointer leaves the
                      // control.
    bool tip_seen;    // True if a tip has been drawn since `hovered` last changed.
    bool tip_asked;   // True if a disabled control was clicked, so that its tip, which says why,
                      // shows at once.
    DipRect tip_rect; // Rectangle of the control whose tip may show.
    DipRect tip_off;  // The rectangle of dip_ui_keep_tips_off.
    char tip[DIP_UI_TIP_BYTES];
};

#endif
