// The settings tab's rows: each shows one setting with its prices and changes it.
#ifndef DIP_APP_PREVIEW_TABS_SETTING_ROWS_H
#define DIP_APP_PREVIEW_TABS_SETTING_ROWS_H

#include "app/preview/tabs/tabs.h"

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

// Declares all presets as buttons in a grid. Returns the grid's height.
int dip_presets_declare(DipUi *ui, DipWindow *window, DipRect rect, int columns);

// Declares Apply, Undo and Copy in a row.
void dip_setting_buttons_declare(DipUi *ui, DipWindow *window, DipRect rect);
void dip_apply_declare(DipUi *ui, DipWindow *window, DipRect rect);

// Declares the target, by which settings are advised: frames a second, and the budget of a frame,
// which says the same.
void dip_target_declare(DipUi *ui, DipWindow *window, DipRect rect);

// Draws the price of the requested settings: the sum, its parts against the budget, and where the
// prices come from. The buttons stand between. Leaves out what does not fit.
void dip_setting_sum_declare(DipUi *ui, DipWindow *window, DipRect rect);

#endif
