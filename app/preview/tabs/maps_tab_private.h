// Declares what the sources of the maps' tab share: maps_tab.c, maps_legend.c and maps_tables.c.
#ifndef DIP_APP_PREVIEW_TABS_MAPS_TAB_PRIVATE_H
#define DIP_APP_PREVIEW_TABS_MAPS_TAB_PRIVATE_H

#include "app/preview/tabs/tabs.h"
#include "app/preview/tools/map_colours.h"
#include "app/preview/tools/maps.h"
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

// Returns what was measured for the map of the frame that a pane shows, or NULL if it is not known.
// While pictures move it is not, because what was measured belongs to the frame that rested last.
static inline const DipMapWork *known_work(const Tab *tab, int pane) {
    const DipMapWork *work = dip_maps_work(tab->maps, pane);
    const bool measured = tab->tools->map == DIP_MAP_MIPS ? work->mips != NULL : work->draws > 0;
    return tab->window->still && measured ? work : NULL;
}

// Returns whether the values of the map are known for the frame that a pane shows.
static inline bool knows_values(const Tab *tab, int pane) {
    const DipErrorPictures *errors = tab->maps->errors;
    return tab->tools->map == DIP_MAP_FLIP ? errors && errors->flip[pane]
                                           : known_work(tab, pane) != NULL;
}

// Writes a line of text at the left side of an area. down: distance from the area's top, at scale
// 1. Returns the width of the text in pixels.
static inline int put(const Tab *tab, int size, DipColour colour, DipRect area, int down,
                      const char *text) {
    dip_ui_text(tab->ui, size, colour, DIP_ALIGN_LEFT, area.x, area.y + px(tab, down), area.width,
                text);
    return dip_ui_text_width(tab->ui, size, text);
}

// Returns a map's colour for a value. share: the value divided by the value at the scale's end.
static inline DipColour map_colour(DipMap map, float share) {
    uint8_t rgb[3];
    (map == DIP_MAP_FLIP ? dip_magma : dip_cividis)(share, rgb);
    return (DipColour){rgb[0], rgb[1], rgb[2], 255};
}

// Returns the map's value at a pixel of a pane, or -1 if it is not known.
double dip_maps_value_at(const Tab *tab, int pane, int x, int y);

// Draw the tab's blocks: the legend of the map, the table of the whole frame, and the values at the
// pixel that the tab describes.
void dip_maps_legend_block(const Tab *tab, DipRect area);
void dip_maps_frame_block(const Tab *tab, DipRect area);
void dip_maps_mouse_block(const Tab *tab, DipRect area);

#endif
