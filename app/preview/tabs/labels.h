// The labels over the panes, the bar of the dock, and notices.
#ifndef DIP_APP_PREVIEW_TABS_LABELS_H
#define DIP_APP_PREVIEW_TABS_LABELS_H

#include "app/preview/tabs/tabs.h"

// Draws a label of one line over each pane: the pane's name, its frame time and its settings.
void dip_labels_draw(DipUi *ui, DipWindow *window);

// Draws the notice, which says what just happened, over the lower edge of the panes.
void dip_labels_draw_notice(DipUi *ui, DipWindow *window);

// Declares the dock's bar: tabs, playback and the time line.
void dip_bar_declare(DipUi *ui, DipWindow *window);

#endif
