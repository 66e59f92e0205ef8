// What the files of the advice tab share.
#ifndef DIP_APP_PREVIEW_TABS_ADVICE_TAB_PRIVATE_H
#define DIP_APP_PREVIEW_TABS_ADVICE_TAB_PRIVATE_H

#include "app/preview/tabs/tabs.h"

// Sizes of text and controls at scale 1.
enum {
    DIP_ADVICE_SIZE = 13,
    DIP_ADVICE_NOTE_SIZE = 11,
    DIP_ADVICE_SUM_SIZE = 22,
    DIP_ADVICE_LEFT_WIDTH = 272,
    DIP_ADVICE_BUDGET_COLUMNS = 4,
    DIP_ADVICE_BUTTON_HEIGHT = 28
};

// Indices of controls in DIP_UI_ADVICE.
enum { DIP_ADVICE_ID_BUDGETS = 1, DIP_ADVICE_ID_TRY = 100, DIP_ADVICE_ID_FIRST_FREE };

// Draws a line of text at *y and moves *y behind it.
void dip_advice_line(DipUi *ui, int size, DipColour colour, DipRect room, int *y, const char *text);

// Gives the requested pane settings and says so.
void dip_advice_try(DipUi *ui, DipWindow *window, const DipQuality *quality);

// Declares the tab for a preview without a cost report.
void dip_advice_declare_rough(DipUi *ui, DipWindow *window, DipRect room);

#endif
