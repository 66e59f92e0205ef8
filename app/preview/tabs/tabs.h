// Declares the functions that draw the window: the tabs of the dock (tools/layout.h), the labels,
// and the sheets.
//
// Each tab has a source file. The tab's function declares the tab's controls (ui.h) and draws the
// tab's contents; it is called in event passes and in drawing passes. A tab changes only the
// preview's state (state.h) and the memory of its own tool (tools.h). For most changes of the state
// for which a DipAction exists, a tab calls dip_preview_act.
#ifndef DIP_APP_PREVIEW_TABS_TABS_H
#define DIP_APP_PREVIEW_TABS_TABS_H

#include "app/preview/tools/tools.h"
#include "app/preview/tools/window.h"

// Declares and draws the whole window: the panes' pictures, labels, marks, the dock and the sheets
// that cover the window.
void dip_window_declare(DipUi *ui, DipWindow *window);

// Each function declares and draws one tab in the rectangle `body`, which is never empty. A tab
// leaves out parts for which there is no room.
void dip_tab_settings(DipUi *ui, DipWindow *window, DipRect body);
void dip_tab_loupe(DipUi *ui, DipWindow *window, DipRect body);
void dip_tab_compare(DipUi *ui, DipWindow *window, DipRect body);
void dip_tab_maps(DipUi *ui, DipWindow *window, DipRect body);
void dip_tab_advice(DipUi *ui, DipWindow *window, DipRect body);
void dip_tab_times(DipUi *ui, DipWindow *window, DipRect body);
void dip_tab_path(DipUi *ui, DipWindow *window, DipRect body);

// Draws a graph of both panes' frame times in the last 5 seconds, with a line at the time budget of
// a frame.
void dip_times_graph_draw(DipUi *ui, const DipWindow *window, DipRect rect);

// --- rows of controls ----------------------------------------------------------------------------

// Finds places for the controls of a tab. The controls fill one row after the other, from the left
// to the right.
typedef struct DipFlow {
    DipUi *ui;
    DipWindow *window;
    DipUiGroup group; // Group of the buttons' ids (ui.h).
    int note_size;    // Letter size of notes, at scale 1.
    DipRect body;
    int x;
    int y;
    int row; // Height of a row.
    int gap;
    int pad;     // How much wider a button is than its text.
    bool narrow; // See dip_flow_make.
} DipFlow;

// Returns a flow that begins at the top of a tab. note_size: letter size of notes, at scale 1. A
// narrow flow saves room: rows and buttons are smaller, notes are left out, and a group of controls
// does not begin a new row.
DipFlow dip_flow_make(DipUi *ui, DipWindow *window, DipUiGroup group, DipRect body, int note_size,
                      bool narrow);
void dip_flow_next_row(DipFlow *flow);
// Begins a new row for the next group of controls, unless the flow is narrow.
void dip_flow_next_group(DipFlow *flow);
// Returns a rectangle of the given width for the next control, in this row or, if this row has no
// room for it, in the next row. The rectangle is empty if the tab is full or narrower than `width`.
DipRect dip_flow_next(DipFlow *flow, int width);
int dip_flow_button_width(const DipFlow *flow, const char *text);
// Declares a button. Returns whether it was pressed.
bool dip_flow_button(DipFlow *flow, unsigned id, const char *text, DipUiLook look, const char *tip);
// Declares a button for one of several alternatives. Returns whether it was pressed.
bool dip_flow_choice(DipFlow *flow, unsigned id, const char *text, bool chosen, const char *tip);
// Writes a note. A note that is wider than the tab begins a new row and is broken into lines.
void dip_flow_text(DipFlow *flow, DipColour colour, const char *text);

// --- labels and the bar ---------------------------------------------------------------------

// Draws a label over each pane that shows: the pane's name, its time and its settings, or the
// truth's name and samples. The difference of the panes has a label of its own instead. A label has
// one line if its text fits into one.
void dip_labels_draw(DipUi *ui, DipWindow *window);

// Draws the notice, which says what just happened, over the lower edge of the panes.
void dip_labels_draw_notice(DipUi *ui, DipWindow *window);

// Declares the dock's bar: the buttons of the tabs, playback, the time line and help.
void dip_bar_declare(DipUi *ui, DipWindow *window);

// --- a pane's time --------------------------------------------------------------------------

enum { DIP_PANE_TIME_BYTES = 48 };

// Returns a pane's time and the parts of this time, as the labels and the panel show them. The time
// is the price of the pane's settings: from the report or, at rest, from live prices. If this price
// is not known, the sum has the state DIP_PRICE_UNKNOWN and the pane's frame time as its only part:
// the median of the last second with frames or, if the settings have changed since, the time of a
// single frame.
DipPriceSum dip_pane_sum(const DipWindow *window, int pane);

// Writes what the time of dip_pane_sum is valid for: " along the path"; " at 640x480", the size of
// the report's picture, if the panes have another one; or "" for the picture in view.
enum { DIP_PANE_SCOPE_BYTES = 40 };
void dip_pane_time_scope(const DipWindow *window, const DipPriceSum *sum,
                         char text[DIP_PANE_SCOPE_BYTES]);

// Writes the time of dip_pane_sum: "8.4 ms"; "≈ 8.4 ms" if it was measured at rest; "8? ms" if it
// is doubtful; "one frame: 44.0 ms" if it is the time of a single frame; or dots if it is not
// known.
void dip_pane_time_text(const DipWindow *window, int pane, char text[DIP_PANE_TIME_BYTES]);

// Returns whether a time of dip_pane_sum is over the target. A doubtful time never is.
bool dip_pane_is_over(const DipWindow *window, const DipPriceSum *sum);

// Writes which time is compared with the target, its value if it is not the time that
// dip_pane_time_text writes, and the result: "p95 17.9: 1.2 over", "mean: within". Writes "1.2
// over" or nothing if the time is not a price, and nothing if it is doubtful.
enum { DIP_VERDICT_BYTES = 64 };
void dip_pane_verdict(const DipWindow *window, const DipPriceSum *sum,
                      char text[DIP_VERDICT_BYTES]);

// --- the settings' tab ----------------------------------------------------------------------

// Ids of the controls in the settings tab. The id of a setting's control is DIP_ID_FIRST_SETTING
// plus the DipSetting, that of a preset's button is DIP_ID_PRESETS plus the DipPreset.
enum {
    DIP_ID_FIRST_SETTING = 1,
    DIP_ID_PRESETS = 100,
    DIP_ID_APPLY = 300,
    DIP_ID_UNDO,
    DIP_ID_COPY,
    DIP_ID_PAUSE,
    DIP_ID_MEASURE_HERE,
    DIP_ID_MORE,
    DIP_ID_EDITOR,
    DIP_ID_PATH,
    DIP_ID_FLIP,
    DIP_ID_FRAME_RATE,
    DIP_ID_BUDGET
};

// Declares a setting as an entry of a list: its name, its steps in both panes, and the price of the
// requested step. A click opens the setting in the editor; the wheel and arrow keys change its
// step.
void dip_setting_entry_declare(DipUi *ui, DipWindow *window, DipSetting setting, DipRect rect);

// Declares the editor of the open setting (DipPreviewState.open_setting): all steps with their
// prices and, if there is room, a note about one step.
void dip_setting_editor_declare(DipUi *ui, DipWindow *window, DipRect rect);

// Declares a setting as one line of a narrow list: its name, its steps (values) in both panes, and
// the price of the requested step.
void dip_setting_line_declare(DipUi *ui, DipWindow *window, DipSetting setting, DipRect rect);

// Declares all presets as buttons in a grid.
void dip_presets_declare(DipUi *ui, DipWindow *window, DipRect rect, int columns);

// Declare the buttons Apply, Undo and Copy in a row, or the button Apply alone.
void dip_setting_buttons_declare(DipUi *ui, DipWindow *window, DipRect rect);
void dip_apply_declare(DipUi *ui, DipWindow *window, DipRect rect);

// Declares two number fields for the target that advised settings must reach: frames per second,
// and the same target as milliseconds per frame (the budget). Writes dip_pane_verdict of the
// requested pane beside them if there is room.
void dip_target_declare(DipUi *ui, DipWindow *window, DipRect rect);

// Draws the price of the requested settings: the sum of prices, its parts against the budget, and
// where the prices come from. Between these, declares the fields of the target and the setting
// buttons. Leaves out what does not fit.
void dip_setting_sum_declare(DipUi *ui, DipWindow *window, DipRect rect);

// --- sheets ---------------------------------------------------------------------------------

// Darkens the window and draws a sheet that lists all keys and what they do, in the largest letters
// that fit. If `words` is not empty, the sheet lists only the keys whose label or text contains
// `words`, ignoring case. scale: as in DipUiPass.
void dip_sheet_draw_help(DipDrawList *list, double scale, const char *words);

// Darkens the window and draws a sheet with the cost report as a table, in which the requested
// pane's steps have another colour. If there is no report, the sheet says how to make one.
void dip_sheet_draw_costs(DipDrawList *list, const DipPreviewState *state, double scale);

// --- symbols of the bar ---------------------------------------------------------------------

// Numbers of the bar's symbols. The symbol of a tab has the number of its DipTab; the other symbols
// have the numbers after these.
enum {
    DIP_ICON_FULL_SCREEN = DIP_TAB_COUNT,
    DIP_ICON_PANES, // Two pictures beside each other.
    DIP_ICON_FOLD,  // A chevron that points down.
    DIP_ICON_OPEN,  // A chevron that points up.
    DIP_ICON_PLAY,
    DIP_ICON_PAUSE,
    DIP_ICON_STEP, // One frame forward: a bar, and a triangle that points right.
    DIP_ICON_BACK, // One frame back: a triangle that points left, and a bar.
    DIP_ICON_HELP  // A question mark.
};

// Draws a symbol in the middle of a rectangle. icon: a DipTab or one of the numbers above.
void dip_icon_draw(DipUi *ui, int icon, DipRect rect, DipColour colour);

#endif
