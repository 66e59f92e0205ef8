// The parts of the dock's tab of maps, for callers that hold the maps' memory by themselves.
#ifndef DIP_APP_PREVIEW_TABS_MAPS_TAB_H
#define DIP_APP_PREVIEW_TABS_MAPS_TAB_H

#include "app/preview/tabs/tabs.h"

// Returns a map's name: "Time per tile".
const char *dip_map_name(DipMap map);

// As dip_tab_maps and dip_maps_over_panes (tabs.h).
void dip_maps_declare_tab(DipUi *ui, DipWindow *window, DipMaps *maps, DipRect body);
void dip_maps_declare_over_panes(DipUi *ui, DipWindow *window, DipMaps *maps,
                                 const DipUiInput panes[DIP_PANE_COUNT]);

#endif
