// What the files of the loupe's tab share.
#ifndef DIP_APP_PREVIEW_TABS_LOUPE_TAB_PRIVATE_H
#define DIP_APP_PREVIEW_TABS_LOUPE_TAB_PRIVATE_H

#include "app/preview/tools/loupe.h"
#include "app/preview/tabs/tabs.h"

enum { DIP_LOUPE_TEXT = 12, DIP_LOUPE_SMALL = 11, DIP_LOUPE_TINY = 10 }; // Sizes of letters.

// One pane's part of the tab.
typedef struct DipLoupePart {
    DipUi *ui;
    DipWindow *window;
    DipLoupe *loupe;
    int pane;
    const DipSamplePattern *pattern;
    const DipSampleValue *samples; // NULL if the pixel's samples are not known.
    DipColour pixel;
    int x; // Where the next line of text begins.
    int y;
    int width;
} DipLoupePart;

// Returns the colour of a pixel of a picture, which must have it.
DipColour dip_loupe_pixel(const DipPixels *picture, int x, int y);

// Shows the figures beside a crop, with the pixel's box if there is room for it.
void dip_loupe_show_details(DipLoupePart *part, DipRect rect);

// Shows the figures beneath a crop in a narrow tab: three lines, and the samples' colours if there
// is room for them.
void dip_loupe_show_brief(DipLoupePart *part, DipRect rect);

// Returns the height of the brief figures of a part with this rectangle: that of the three lines,
// and of the samples' colours if the crop above stays tall enough. Both panes get the same, so that
// their crops are alike.
int dip_loupe_brief_height(const DipLoupePart *part, DipRect rect);

#endif
