// Declares what maps_tab.c and maps_legend.c share.
#ifndef DIP_APP_PREVIEW_TABS_MAPS_TAB_PRIVATE_H
#define DIP_APP_PREVIEW_TABS_MAPS_TAB_PRIVATE_H

#include "app/preview/tools/maps.h"
#include "app/preview/tabs/tabs.h"
#include "app/ui/layout.h"
#include "app/ui/style.h"

// Letter sizes and lengths, at scale 1.
enum {
    MARGIN = 10,
    GAP = 22, // Gap between the tab's blocks.
    TEXT = 13,
    NOTE = 11,
    ROW = 21,
    NOTE_ROW = 14,
    BUTTON = 28,
    SMALL_BUTTON = 24,
    BUTTON_GAP = 6,
    CHART = 64,
    BAR = 16,
    BUTTONS_WIDTH = 282,
    LEGEND_WIDTH = 346,
    TABLE_WIDTH = 282,
};

enum { ID_MAP = 1, ID_OVER = 20, ID_BRIGHTNESS = 30 };
enum { CHART_BINS = 25 };

// Everything that functions need to draw the tab's blocks.
typedef struct Tab {
    DipUi *ui;
    DipWindow *window;
    DipMaps *maps;
    DipToolState *tools;
} Tab;

static inline int px(const Tab *tab, int length) {
    return dip_ui_px(tab->ui, length);
}

static inline bool is_work_map(DipMap map) {
    return map == DIP_MAP_TIME || map == DIP_MAP_FRAGMENTS || map == DIP_MAP_PROBES;
}

// Finds the pixel that the tab describes: the pixel under the pointer, or else the pinned pixel.
// Returns false if there is none.
static inline bool described_pixel(const Tab *tab, int *x, int *y) {
    const DipMapView *view = &tab->maps->view;
    const DipPixels *frame = &tab->window->frames[DIP_PANE_CURRENT];
    *x = view->pointed ? view->x : tab->tools->x;
    *y = view->pointed ? view->y : tab->tools->y;
    return (view->pointed || tab->tools->pinned) && *x >= 0 && *y >= 0 && *x < frame->width &&
           *y < frame->height;
}

// Draw the tab's blocks: the legend of the map, the table of the whole frame, and the values at the
// pixel that the tab describes.
void dip_maps_legend_block(const Tab *tab, DipRect area);
void dip_maps_frame_block(const Tab *tab, DipRect area);
void dip_maps_mouse_block(const Tab *tab, DipRect area);

#endif
