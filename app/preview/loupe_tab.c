// The loupe.
#include "app/preview/tabs.h"

void dip_tab_loupe(DipUi *ui, DipWindow *window, DipRect body) {
    (void)ui, (void)window, (void)body;
}

void dip_loupe_over_panes(DipUi *ui, DipWindow *window, const DipUiInput panes[DIP_PANE_COUNT]) {
    (void)ui, (void)window, (void)panes;
}
