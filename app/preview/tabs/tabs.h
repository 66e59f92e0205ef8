// The tabs of the dock, and the tools that draw over the panes.
//
// Each tab has a file that declares its controls (ui.h) and draws its contents. The same code runs
// for events and for drawing. A tab changes nothing but the state (state.h, by dip_preview_act
// where an action exists) and its own tool's memory.
#ifndef DIP_APP_PREVIEW_TABS_TABS_H
#define DIP_APP_PREVIEW_TABS_TABS_H

#include "app/preview/tools/tools.h"
#include "app/preview/tools/window.h"

// Declares and draws the whole window: the panes' pictures, labels, marks, the dock and sheets.
void dip_window_declare(DipUi *ui, DipWindow *window);

// Each function declares and draws one tab in the rectangle `body`, which is never empty. Where the
// room is too small, a tab leaves out whole parts and cuts none.
void dip_tab_settings(DipUi *ui, DipWindow *window, DipRect body);
void dip_tab_loupe(DipUi *ui, DipWindow *window, DipRect body);
void dip_tab_compare(DipUi *ui, DipWindow *window, DipRect body);
void dip_tab_maps(DipUi *ui, DipWindow *window, DipRect body);
void dip_tab_advice(DipUi *ui, DipWindow *window, DipRect body);
void dip_tab_times(DipUi *ui, DipWindow *window, DipRect body);
void dip_tab_path(DipUi *ui, DipWindow *window, DipRect body);

// Draws the frame times of both panes in the last seconds, with the line of the budget.
void dip_times_graph_draw(DipUi *ui, const DipWindow *window, DipRect rect);

// --- rows of controls ----------------------------------------------------------------------------

// Where the next control of a tab lies: rows are filled from the left, and begin anew below.
typedef struct DipFlow {
    DipUi *ui;
    DipWindow *window;
    DipUiGroup group; // Of the buttons' ids.
    int note_size;
    DipRect body;
    int x;
    int y;
    int row; // Height of a row.
    int gap;
    int pad; // By which a button is wider than its text.
    bool narrow;
} DipFlow;

// Begins at the top of a tab. note_size: of the letters of notes.
DipFlow dip_flow_make(DipUi *ui, DipWindow *window, DipUiGroup group, DipRect body, int note_size);
// Makes rows and buttons small, and leaves out notes and the beginnings of groups.
void dip_flow_make_narrow(DipFlow *flow);
void dip_flow_next_row(DipFlow *flow);
// Begins a new row for other matters.
void dip_flow_next_group(DipFlow *flow);
// Returns a rectangle of the given width in this row or the next one; empty if the tab is full.
DipRect dip_flow_next(DipFlow *flow, int width);
int dip_flow_button_width(const DipFlow *flow, const char *text);
// Declares a button. Returns whether it was pressed.
bool dip_flow_button(DipFlow *flow, unsigned id, const char *text, DipUiLook look, const char *tip);
// Declares a button for one of several alternatives.
bool dip_flow_choice(DipFlow *flow, unsigned id, const char *text, bool chosen, const char *tip);
// Writes a note. One that is wider than the tab gets lines of its own.
void dip_flow_text(DipFlow *flow, DipColour colour, const char *text);

// --- labels and the bar ---------------------------------------------------------------------

// Draws a label of one line over each pane: the pane's name, its frame time and its settings.
void dip_labels_draw(DipUi *ui, DipWindow *window);

// Draws the notice, which says what just happened, over the lower edge of the panes.
void dip_labels_draw_notice(DipUi *ui, DipWindow *window);

// Declares the dock's bar: tabs, playback and the time line.
void dip_bar_declare(DipUi *ui, DipWindow *window);

// --- a pane's time --------------------------------------------------------------------------

enum { DIP_PANE_TIME_BYTES = 48 };

typedef struct DipPaneTime {
    double ms;
    DipPriceTrust trust;
    bool measured_here; // Timed at rest, a few frames beside the other settings' frames.
    bool single;        // The time of a single frame.
} DipPaneTime;

// Returns a pane's time. While pictures move, it is the median of the last second. At rest it is
// the time of the settings that was measured for their prices or, before there is one, the last
// median. If the settings have changed since, it is the time of the single frame that was drawn.
DipPaneTime dip_pane_time(const DipWindow *window, int pane);

// Writes "8.4 ms", "≈ 8.4 ms" if it was measured at rest, "8? ms" if it is doubtful, or "one frame:
// 44.0 ms".
void dip_pane_time_text(const DipPaneTime *time, char text[DIP_PANE_TIME_BYTES]);

// Returns the sum of prices that the panel shows for a pane: that of the report or, without a
// report, one that ends at the pane's time. While no price is known, it has the base alone.
DipPriceSum dip_pane_sum(const DipWindow *window, int pane);

// --- the settings' tab ----------------------------------------------------------------------

// Ids of the settings tab beyond those of the settings, which are 1 + the DipSetting.
enum {
    DIP_ID_FIRST_SETTING = 1,
    DIP_ID_PRESETS = 100,
    DIP_ID_GROUPS = 200,
    DIP_ID_APPLY = 300,
    DIP_ID_UNDO,
    DIP_ID_COPY,
    DIP_ID_PAUSE,
    DIP_ID_MEASURE_HERE,
    DIP_ID_MORE,
    DIP_ID_FLIP,
    DIP_ID_FRAME_RATE,
    DIP_ID_BUDGET
};

// Declares a setting as a slider or a switch at the top of `rect`. Returns the height that it
// takes.
int dip_setting_row_declare(DipUi *ui, DipWindow *window, DipSetting setting, DipRect rect);

// Declares a setting as one line of a narrow list: its name, its step and its price.
void dip_setting_line_declare(DipUi *ui, DipWindow *window, DipSetting setting, DipRect rect);

// Declares all presets as buttons in a grid.
void dip_presets_declare(DipUi *ui, DipWindow *window, DipRect rect, int columns);

// Declares Apply, Undo and Copy in a row.
void dip_setting_buttons_declare(DipUi *ui, DipWindow *window, DipRect rect);
void dip_apply_declare(DipUi *ui, DipWindow *window, DipRect rect);

// Declares the target, by which settings are advised: frames a second, and the budget of a frame,
// which says the same.
void dip_target_declare(DipUi *ui, DipWindow *window, DipRect rect);

// Draws the price of the requested settings: the sum, its parts against the budget, and where the
// prices come from. The buttons stand between. Leaves out what does not fit.
void dip_setting_sum_declare(DipUi *ui, DipWindow *window, DipRect rect);

// --- sheets ---------------------------------------------------------------------------------

// Draws all keys and what they do, in the largest letters that fit, or those whose text holds
// `words` in any case. scale: the display's scale (display.h).
void dip_sheet_draw_help(DipDrawList *list, double scale, const char *words);

// Draws the cost report as a table, in which the steps of the requested pane are highlighted. If
// there is no report, the sheet says how to make one.
void dip_sheet_draw_costs(DipDrawList *list, const DipPreviewState *state, double scale);

// --- symbols of the bar ---------------------------------------------------------------------

// Symbols beyond those of the tabs, whose numbers are those of DipTab.
enum {
    DIP_ICON_FULL_SCREEN = DIP_TAB_COUNT,
    DIP_ICON_PANES, // Two pictures beside each other.
    DIP_ICON_FOLD,  // A chevron that points down.
    DIP_ICON_OPEN,  // A chevron that points up.
    DIP_ICON_PLAY,
    DIP_ICON_PAUSE,
    DIP_ICON_STEP, // A bar and a triangle that points away from it: one frame on.
    DIP_ICON_BACK, // One frame back.
    DIP_ICON_HELP  // A question mark.
};

// Draws a symbol in the middle of a rectangle.
void dip_icon_draw(DipUi *ui, int icon, DipRect rect, DipColour colour);

#endif
