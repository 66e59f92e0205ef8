// The comparisons.
#include "app/preview/tabs.h"

void dip_tab_compare(DipUi *ui, DipWindow *window, DipRect body) {
    (void)ui, (void)window, (void)body;
}

void dip_compare_pictures(DipUi *ui, DipWindow *window) {
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        dip_ui_picture(ui, window->layout->panes[p], &window->frames[p], window->versions[p]);
    }
}

void dip_compare_over_panes(DipUi *ui, DipWindow *window, const DipUiInput panes[DIP_PANE_COUNT]) {
    (void)ui, (void)window, (void)panes;
}
