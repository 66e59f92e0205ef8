// A window with two drawn panes and the tools' tabs, for tests of the loupe and the comparisons.
#ifndef DIP_TESTS_APP_PREVIEW_TOOL_WINDOW_H
#define DIP_TESTS_APP_PREVIEW_TOOL_WINDOW_H

#include "app/preview/tabs/tabs.h"
#include "renderer/catalogue/scenes.h"

typedef struct DipToolWindow {
    DipTestScene scene;
    DipSession session;
    DipCamPath *path;
    DipPreviewState state;
    DipLayout layout;
    DipFont *font;
    DipDrawList *list;
    DipCanvas canvas;
    DipUi *ui;
    DipTools *tools;
    DipSessionFrame frame;
    DipPaneFigures figures[DIP_PANE_COUNT];
    DipWindow window;
    DipPose pose;
    uint64_t frame_index;
    uint64_t version; // Version of the picture that was drawn last.
    int64_t now_ns;
} DipToolWindow;

// Opens a window whose panes have the given size, with a dock beneath them, and draws both panes.
// The window points into itself, so it must not be moved.
void dip_tool_window_open(DipToolWindow *tw, DipTestSceneKind kind, int pane_width, int pane_height,
                          int dock_height);
void dip_tool_window_close(DipToolWindow *tw);

// Draws frames with new settings ("aa=4,af=16"). Their size is that of a pane divided by `divisor`.
void dip_tool_window_draw_frames(DipToolWindow *tw, const char *current, const char *requested,
                                 int divisor);

// Runs a drawing pass, in which the tools may ask for samples and thumbnails.
void dip_tool_window_draw(DipToolWindow *tw);

// Runs an event pass. Returns whether a control or the focus took the event.
bool dip_tool_window_event(DipToolWindow *tw, const DipEvent *event);
void dip_tool_window_mouse(DipToolWindow *tw, DipEventKind kind, DipMouseButton button, int x,
                           int y);

// Lets the tools draw what they asked for.
bool dip_tool_window_update(DipToolWindow *tw);

// Returns a pixel of the window's picture, and one of a pane's frame, as bytes red, green, blue.
const uint8_t *dip_tool_window_pixel(const DipToolWindow *tw, int x, int y);
const uint8_t *dip_tool_window_frame_pixel(const DipToolWindow *tw, int pane, int x, int y);

#endif
