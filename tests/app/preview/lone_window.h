// A window without a loop, a display or a scene, for tests that draw the window and feed it events.
#ifndef DIP_TESTS_APP_PREVIEW_LONE_WINDOW_H
#define DIP_TESTS_APP_PREVIEW_LONE_WINDOW_H

#include "app/preview/loop/view.h"
#include "app/preview/tabs/tabs.h"

typedef struct DipLoneWindow {
    DipCamPath *path;
    DipCamTrack track;
    DipPreviewState state;
    DipView *view;
    DipPrices *prices;
    DipTools *tools;
    DipPaneFigures figures[DIP_PANE_COUNT];
    DipViewInput input;
} DipLoneWindow;

// The window of the present test.
extern DipLoneWindow lone;

// Make and free the window, as set-up and tear-down of cmocka. The window has 1282x720 pixels. Its
// path has the x 0, 1 and 3 at 0, 5 and 10 s. Both panes have the default settings, small black
// pictures that rest, and frame times of 4 and 5 ms.
int dip_lone_set_up(void **unused);
int dip_lone_tear_down(void **unused);

// Give the window an event. Return whether the window took it.
bool dip_lone_press(DipKeycode key);
bool dip_lone_mouse(DipEventKind kind, DipMouseButton button, int x, int y);
bool dip_lone_wheel(double steps, unsigned modifiers, int x, int y);

#endif
