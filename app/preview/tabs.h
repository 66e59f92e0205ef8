// The tabs of the dock, and the tools that draw over the panes.
//
// Each tab has a file that declares its controls (ui.h) and draws its contents. The same code runs
// for events and for drawing. A tab changes nothing but the state (state.h, by dip_preview_act
// where an action exists) and its own tool's memory.
#ifndef DIP_APP_PREVIEW_TABS_H
#define DIP_APP_PREVIEW_TABS_H

#include "app/preview/layout.h"
#include "app/preview/panel.h"
#include "app/preview/prices.h"
#include "app/preview/state.h"
#include "app/preview/tools.h"
#include "app/preview/ui.h"

// Everything that the window shows. All pointers are borrowed for one pass.
typedef struct DipWindow {
    DipPreviewState *state;
    const DipLayout *layout;
    DipPixels frames[DIP_PANE_COUNT];  // The panes' newest pictures.
    uint64_t versions[DIP_PANE_COUNT]; // Equal versions mean equal pixels (draw_list.h).
    bool still;                        // Camera and scene stand still.
    int64_t now_ns;                    // Time on the display's clock, as in DipUiPass.
    const DipPaneFigures *figures;     // [DIP_PANE_COUNT]
    const DipPrices *prices;
    DipTools *tools; // What the tools have computed: loupe, comparison and maps.
    // The converged picture of this pose, of the size of the frames; NULL if it is not known.
    const DipPixels *truth;
    uint64_t truth_version; // Equal versions mean equal pixels. No frame has the same number.
} DipWindow;

// Declares and draws the whole window: the panes' pictures, labels, marks, the dock and sheets.
void dip_window_declare(DipUi *ui, DipWindow *window);

// Each declares and draws one tab in the rectangle `body`, which is never empty. A tab that does
// not fit leaves out what the mock-ups of small windows leave out, and cuts nothing.
void dip_tab_settings(DipUi *ui, DipWindow *window, DipRect body);
void dip_tab_loupe(DipUi *ui, DipWindow *window, DipRect body);
void dip_tab_compare(DipUi *ui, DipWindow *window, DipRect body);
void dip_tab_maps(DipUi *ui, DipWindow *window, DipRect body);
void dip_tab_advice(DipUi *ui, DipWindow *window, DipRect body);
void dip_tab_times(DipUi *ui, DipWindow *window, DipRect body);
void dip_tab_path(DipUi *ui, DipWindow *window, DipRect body);

// Draws the frame times of both panes in the last seconds, with the line of the budget.
void dip_times_graph_draw(DipUi *ui, const DipWindow *window, DipRect rect);

// Draws the panes' pictures: side by side, or as the chosen comparison or map shows them.
void dip_compare_pictures(DipUi *ui, DipWindow *window);

// Each declares what its tool shows over the panes: marks, dividers, the value under the pointer.
// `panes`: what the user did with the panes' own control in this pass, for each pane.
void dip_loupe_over_panes(DipUi *ui, DipWindow *window, const DipUiInput panes[DIP_PANE_COUNT]);
void dip_compare_over_panes(DipUi *ui, DipWindow *window, const DipUiInput panes[DIP_PANE_COUNT]);
void dip_maps_over_panes(DipUi *ui, DipWindow *window, const DipUiInput panes[DIP_PANE_COUNT]);

// Lets a key event act on the tools: while the loupe is on, arrow keys move it by a pixel. Call it
// for keys that no control took. Returns whether the key did something.
bool dip_loupe_press(DipPreviewState *state, int width, int height, const DipEvent *event);

#endif
