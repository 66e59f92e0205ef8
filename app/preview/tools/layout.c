// Computes where the panes and the dock lie in a window.
#include "app/preview/tools/layout.h"

#include "app/ui/style.h"

enum { PLAIN_HEIGHT = 1080 }; // Height of a window, in pixels, that suits scale 1.
enum { BAR_HEIGHT = 32, BODY_HEIGHT = 208, LEAST_PANE_HEIGHT = 130, LEAST_DOCK_WIDTH = 640 };

int dip_layout_dock_height(void) {
    return BAR_HEIGHT + BODY_HEIGHT;
}

double dip_layout_scale(double display_scale, const DipToolState *tools, int height) {
    const int quarters = 4 * height / PLAIN_HEIGHT; // Height / 1080 in quarters, rounded down.
    const double grown = tools->fixed_scale || quarters < 4 ? 1.0 : 0.25 * quarters;
    return (grown > display_scale ? grown : display_scale) * tools->ui_scale;
}

// Places both panes side by side above y = height.
static void place_panes(DipLayout *layout, int height) {
    const int width =
        layout->width > DIP_PANE_GAP_PX + 2 ? (layout->width - DIP_PANE_GAP_PX) / 2 : 1;
    layout->panes[DIP_PANE_CURRENT] = (DipRect){0, 0, width, dip_max(1, height)};
    layout->panes[DIP_PANE_REQUESTED] =
        (DipRect){layout->width - width, 0, width, dip_max(1, height)};
}

DipLayout dip_layout_make(int width, int height, double display_scale, const DipToolState *tools) {
    const double scale = dip_layout_scale(display_scale, tools, height);
    DipLayout layout = {.width = width, .height = height, .scale = scale};
    if (tools->bare) {
        place_panes(&layout, height);
        return layout;
    }
    const int bar = dip_min(dip_style_scaled(BAR_HEIGHT, scale), height / 4);
    const int body = dip_style_scaled(BODY_HEIGHT, scale);
    const int least = dip_style_scaled(LEAST_PANE_HEIGHT, scale);
    const bool fits =
        height - bar - body >= least && width >= dip_style_scaled(LEAST_DOCK_WIDTH, scale);
    layout.side = fits ? DIP_DOCK_BELOW : DIP_DOCK_DRAWER;
    if (fits && tools->open) {
        place_panes(&layout, height - bar - body);
        layout.bar = (DipRect){0, height - bar - body, width, bar};
        layout.body = (DipRect){0, height - body, width, body};
        return layout;
    }
    place_panes(&layout, height - bar);
    layout.bar = (DipRect){0, height - bar, width, bar};
    if (tools->open) {
        layout.body = layout.panes[DIP_PANE_CURRENT];
    }
    return layout;
}

DipRect dip_layout_gap(const DipLayout *layout) {
    const DipRect *left = &layout->panes[DIP_PANE_CURRENT];
    const int x = left->x + left->width;
    return (DipRect){x, left->y, layout->panes[DIP_PANE_REQUESTED].x - x, left->height};
}

void dip_layout_window_size(int pane_width, int pane_height, double display_scale,
                            const DipToolState *tools, int *width, int *height) {
    *width = 2 * pane_width + DIP_PANE_GAP_PX;
    *height = pane_height;
    // The dock's height depends on the window's height: a low window has a low bar, and no dock
    // below the panes, and a high one has a greater scale.
    while (dip_layout_make(*width, *height, display_scale, tools).panes[0].height < pane_height) {
        ++*height;
    }
}
