// The maps.
#include "app/preview/tabs.h"

void dip_tab_maps(DipUi *ui, DipWindow *window, DipRect body) {
    (void)ui, (void)window, (void)body;
}

void dip_maps_over_panes(DipUi *ui, DipWindow *window, const DipUiInput panes[DIP_PANE_COUNT]) {
    (void)ui, (void)window, (void)panes;
}
