// Computes where the pictures of a comparison show, and the difference of two pictures.
#include "app/preview/tools/compare.h"

#include "app/preview/tools/loupe.h"
#include "app/ui/layout.h"

#include <stdlib.h>
#include <string.h>

static const int64_t blink_ns = 500000000; // How long the timer of BLINK shows each pane.

// --- arithmetic --------------------------------------------------------------------------------

bool dip_compare_is_one_picture(DipComparison comparison) {
    return comparison == DIP_COMPARE_WIPE || comparison == DIP_COMPARE_BLINK ||
           comparison == DIP_COMPARE_DIFFERENCE || comparison == DIP_COMPARE_ALONE;
}

bool dip_compare_wants_truth(const DipToolState *tools) {
    return tools->comparison == DIP_COMPARE_TRUTH ||
           (tools->against_truth &&
            (tools->comparison == DIP_COMPARE_WIPE || tools->comparison == DIP_COMPARE_BLINK ||
             tools->comparison == DIP_COMPARE_DIFFERENCE));
}

bool dip_compare_shows_truth(const DipWindow *window) {
    return window->truth && dip_compare_wants_truth(&window->state->tools);
}

const DipPixels *dip_compare_picture(const DipWindow *window, int pane, uint64_t *version) {
    const bool truth = pane == DIP_PANE_CURRENT && dip_compare_shows_truth(window);
    *version = truth ? window->truth_version : window->versions[pane];
    return truth ? window->truth : &window->frames[pane];
}

// Returns the area of a comparison that shows one picture in place of both panes. This is the area
// of both panes, or of the requested pane while a drawer (layout.h) covers the current one.
static DipRect area_of(const DipLayout *layout) {
    if (layout->side == DIP_DOCK_DRAWER && !dip_rect_is_empty(layout->body)) {
        return layout->panes[DIP_PANE_REQUESTED];
    }
    return dip_rect_unite(layout->panes[DIP_PANE_CURRENT], layout->panes[DIP_PANE_REQUESTED]);
}

void dip_compare_frame_size(const DipLayout *layout, DipComparison comparison, int *width,
                            int *height) {
    const DipRect area =
        dip_compare_is_one_picture(comparison) ? area_of(layout) : layout->panes[DIP_PANE_CURRENT];
    *width = area.width;
    *height = area.height;
}

DipRect dip_compare_fit(DipRect area, int width, int height) {
    int shown_width = width;
    int shown_height = height;
    if (width < 1 || height < 1 || dip_rect_is_empty(area)) {
        return (DipRect){area.x, area.y, 0, 0};
    }
    if (width <= area.width && height <= area.height) {
        const int factor = dip_min(area.width / width, area.height / height);
        shown_width *= factor;
        shown_height *= factor;
    } else if ((int64_t)width * area.height >= (int64_t)height * area.width) {
        shown_width = area.width;
        shown_height = dip_max(1, (int)((int64_t)height * area.width / width));
    } else {
        shown_height = area.height;
        shown_width = dip_max(1, (int)((int64_t)width * area.height / height));
    }
    return dip_rect_middle(area, shown_width, shown_height);
}

int dip_compare_pane(const DipPreviewState *state, int64_t now_ns) {
    if (state->tools.comparison == DIP_COMPARE_ALONE) {
        return dip_preview_edited_pane(state);
    }
    const bool swapped = state->tools.blinks && now_ns / blink_ns % 2 != 0;
    return state->tools.blinked != swapped ? DIP_PANE_REQUESTED : DIP_PANE_CURRENT;
}

int64_t dip_compare_wakes_ns(const DipToolState *tools, int64_t now_ns) {
    return tools->comparison == DIP_COMPARE_BLINK && tools->blinks
               ? (now_ns / blink_ns + 1) * blink_ns
               : INT64_MAX;
}

DipRect dip_compare_shown(const DipWindow *window, int pane) {
    const DipComparison comparison = window->state->tools.comparison;
    const DipPixels *frame = &window->frames[pane];
    if (!dip_compare_is_one_picture(comparison)) {
        return window->layout->panes[pane];
    }
    return dip_compare_fit(area_of(window->layout), frame->width, frame->height);
}

int dip_compare_divider_column(double divider, int width) {
    const double bounded = divider > 0.0 ? (divider < 1.0 ? divider : 1.0) : 0.0;
    return (int)(bounded * width + 0.5);
}

// Returns the x coordinate in the window of the first column right of the divider.
static int divider_x(const DipWindow *window, DipRect shown) {
    const int width = window->frames[DIP_PANE_CURRENT].width;
    const int column = dip_compare_divider_column(window->state->tools.divider, width);
    const DipRect left = {0, 0, column, 1};
    return column > 0 ? shown.x + dip_loupe_mark(shown, width, 1, left).width : shown.x;
}

DipRect dip_compare_visible(const DipWindow *window, int pane) {
    const DipPreviewState *state = window->state;
    DipRect shown = dip_compare_shown(window, pane);
    switch (state->tools.comparison) {
    case DIP_COMPARE_WIPE: {
        const int x = divider_x(window, shown);
        shown.width = pane == DIP_PANE_CURRENT ? x - shown.x : shown.x + shown.width - x;
        shown.x = pane == DIP_PANE_CURRENT ? shown.x : x;
        return shown;
    }
    case DIP_COMPARE_BLINK:
    case DIP_COMPARE_ALONE:
        if (pane != dip_compare_pane(state, window->now_ns)) {
            shown.width = 0;
        }
        return shown;
    default: // The other comparisons hide nothing.
        return shown;
    }
}

bool dip_compare_pixel_at(const DipWindow *window, int window_x, int window_y, int *pane, int *x,
                          int *y) {
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        if (dip_rect_holds(dip_compare_visible(window, p), window_x, window_y)) {
            *pane = p;
            return dip_loupe_pixel_at(dip_compare_shown(window, p), window->frames[p].width,
                                      window->frames[p].height, window_x, window_y, x, y);
        }
    }
    return false;
}

static void compare_row(const uint8_t *a, const uint8_t *b, int bytes, int gain, uint8_t *out) {
    for (int i = 0; i < bytes; ++i) {
        const int difference = a[i] > b[i] ? a[i] - b[i] : b[i] - a[i];
        const int scaled = difference * gain;
        out[i] = (uint8_t)(scaled < 255 ? scaled : 255);
    }
}

static void count_row(const uint8_t *a, const uint8_t *b, int width, int y,
                      DipDifference *difference) {
    for (int x = 0; x < width; ++x) {
        int greatest = 0;
        for (int c = 0; c < 3; ++c) {
            const int found = abs(a[4 * x + c] - b[4 * x + c]);
            greatest = found > greatest ? found : greatest;
        }
        difference->differing += greatest > 0;
        if (greatest > difference->greatest) {
            difference->greatest = greatest;
            difference->x = x;
            difference->y = y;
        }
    }
}

DipDifference dip_compare_difference(const DipPixels *a, const DipPixels *b, int gain,
                                     uint8_t *out) {
    DipDifference difference = {.pixels = (int64_t)a->width * a->height};
    const size_t row_bytes = 4 * (size_t)a->width;
    for (int y = 0; y < a->height; ++y) {
        const uint8_t *from = a->rgba8 + (size_t)y * a->stride_bytes;
        const uint8_t *other = b->rgba8 + (size_t)y * b->stride_bytes;
        uint8_t *to = out + (size_t)y * row_bytes;
        compare_row(from, other, (int)row_bytes, gain, to);
        for (int x = 0; x < a->width; ++x) {
            to[4 * x + 3] = 255;
        }
        if (memcmp(from, other, row_bytes) != 0) {
            count_row(from, other, a->width, y, &difference);
        }
    }
    return difference;
}

// --- memory ------------------------------------------------------------------------------------

const DipDifference *dip_compare_make_difference(DipComparer *compare, const DipWindow *window,
                                                 DipPixels *picture, uint64_t *version) {
    uint64_t of[DIP_PANE_COUNT];
    const DipPixels *a = dip_compare_picture(window, DIP_PANE_CURRENT, &of[DIP_PANE_CURRENT]);
    const DipPixels *b = dip_compare_picture(window, DIP_PANE_REQUESTED, &of[DIP_PANE_REQUESTED]);
    const int gain = dip_max(1, window->state->tools.gain);
    DipKeptPicture *difference = &compare->difference;
    DipHash hash = dip_hash_begin(0);
    dip_hash_text(&hash, "difference");
    dip_hash_bytes(&hash, of, sizeof of);
    dip_hash_integer(&hash, gain);
    if (dip_kept_begin(difference, &hash)) {
        difference->known = a->width == b->width && a->height == b->height &&
                            dip_canvas_resize(&difference->canvas, a->width, a->height, NULL);
        if (difference->known) {
            compare->found = dip_compare_difference(a, b, gain, difference->canvas.rgba8);
        }
    }
    return dip_kept_show(difference, picture, version) ? &compare->found : NULL;
}
