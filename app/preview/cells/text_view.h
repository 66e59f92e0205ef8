// Writes the preview's labels, bar, settings, times, costs, keys and help into character cells, for
// a display that shows characters (display.h). The panes' pictures fill the cells that hold no
// text.
//
// The screen has, from top to bottom: a row of labels, the panes, a bar with the camera path, the
// settings (or the times, or the costs), and a row of keys. A low screen has only the labels and
// the panes.
#ifndef DIP_APP_PREVIEW_CELLS_TEXT_VIEW_H
#define DIP_APP_PREVIEW_CELLS_TEXT_VIEW_H

#include "app/preview/cells/text_screen.h"
#include "app/preview/live/figures.h"
#include "app/preview/state/state.h"

enum { DIP_TEXT_MAX_TARGETS = 64 };

// A step (value) of a setting, and the area in which a mouse click chooses it.
typedef struct DipTextTarget {
    DipTextArea area;
    DipSetting setting;
    int step;
} DipTextTarget;

// Where the parts of the screen lie, in cells.
typedef struct DipTextLayout {
    int columns;
    int rows;
    DipTextArea panes[DIP_PANE_COUNT];
    int bar_row;      // -1 if there is no bar.
    DipTextArea body; // Settings, times or costs. The body has no rows if none of these shows.
    int keys_row;     // -1 if there is no row of keys.
} DipTextLayout;

// Zero-initialise.
typedef struct DipTextView {
    DipTextScreen screen;
    DipTextTarget targets[DIP_TEXT_MAX_TARGETS]; // The areas in which clicks act, as drawn last.
    int target_count;
    bool focused;                 // The arrow keys act on the settings.
    DipSetting focus;             // The setting on which the arrow keys act.
    const DipPreviewState *state; // Borrowed while the texts are written.
} DipTextView;

// Fills in the rectangles of the panes, in pixels of the picture.
void dip_text_view_panes(const DipTextView *view, const DipPreviewState *state, int width,
                         int height, DipRect panes[DIP_PANE_COUNT]);

// Writes all texts. Fails with MEMORY.
bool dip_text_view_draw(DipTextView *view, const DipPreviewState *state, int width, int height,
                        const DipPaneFigures figures[DIP_PANE_COUNT], DipError *err);

// Hands an event to the settings. The up and down arrow keys choose a setting, and the left and
// right ones change it. Escape leaves the settings. A click chooses a step. Returns whether the
// settings have taken the event. The caller must not act on an event that is taken.
bool dip_text_view_event(DipTextView *view, DipPreviewState *state, const DipEvent *event,
                         int64_t now_ns);

// --- for the parts of the view -----------------------------------------------------------------

// Each function fills the body: the first one with the settings, the second with the times, the
// third with the costs.
void dip_text_draw_settings(DipTextView *view, DipTextArea body);
void dip_text_draw_times(DipTextScreen *screen, DipTextArea body, const DipTextLayout *layout,
                         const DipPaneFigures figures[DIP_PANE_COUNT]);
void dip_text_draw_costs(DipTextScreen *screen, DipTextArea body, const DipPreviewState *state);

// Covers the area with the list of keys.
void dip_text_draw_help(DipTextScreen *screen, DipTextArea area);

// Returns the number of rows that the settings need in a body of `columns` cells. has_costs: there
// is a cost report.
int dip_text_settings_rows(int columns, bool has_costs);

#endif
