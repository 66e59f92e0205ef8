// What ui.c and ui_draw.c share.
#ifndef DIP_APP_PREVIEW_UI_PRIVATE_H
#define DIP_APP_PREVIEW_UI_PRIVATE_H

#include "app/preview/ui.h"

enum { DIP_UI_TIP_BYTES = 900 };

struct DipUi {
    DipUiPass pass;
    int pointer_x;
    int pointer_y;
    bool pointer_inside; // The pointer has been seen.
    DipUiId hovered;     // The topmost control under the pointer, of the last pass.
    int64_t hovered_ns;  // When the pointer came to rest over it.
    DipUiId held;        // The control that a button was pressed over, while it is down.
    DipMouseButton held_button;
    DipUiId focus;
    bool focus_shows; // The focus came by keyboard.
    bool taken;       // A control took the event of this pass.
    // Focus order of this pass, to move the focus at its end.
    DipUiId first;
    DipUiId last;
    DipUiId before_focus;
    DipUiId after_focus;
    DipUiId previous; // The control that was declared before the current one.
    bool focus_seen;
    DipUiId next_hovered; // What this pass finds under the pointer.
    bool has_tip;         // The control under the pointer has a tip,
    bool tip_seen;        // which has been drawn.
    DipRect tip_rect;     // The control whose tip shows.
    char tip[DIP_UI_TIP_BYTES];
};

#endif
