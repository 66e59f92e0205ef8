// The comparisons' arithmetic and memory: where each picture shows, and the difference of both.
#ifndef DIP_APP_PREVIEW_TOOLS_COMPARE_H
#define DIP_APP_PREVIEW_TOOLS_COMPARE_H

#include "app/preview/tools/layout.h"
#include "app/preview/tools/window.h"
#include "app/preview/tools/tools.h"

enum { DIP_COMPARE_MAX_GAIN = 64 };

// --- arithmetic --------------------------------------------------------------------------------

// Returns whether a comparison shows one picture in place of both panes.
bool dip_compare_is_one_picture(DipComparison comparison);

// Returns the size at which the panes' frames are drawn: the size of a pane, or of both panes
// together if one pane shows alone. In the other comparisons of one picture, frames keep the size
// of a pane, so that times and errors stay those of a pane.
void dip_compare_frame_size(const DipLayout *layout, DipComparison comparison, int *width,
                            int *height);

// Returns where the one picture shows in an area: in the middle, as many times as large as fits by
// a whole factor. A picture that is larger than the area is scaled down and keeps its shape.
DipRect dip_compare_fit(DipRect area, int width, int height);

// Returns where a pane's picture shows in the window; empty if the comparison does not show it. In
// a wipe, this is the whole picture, of which the divider hides a part.
DipRect dip_compare_shown(const DipWindow *window, int pane);

// Returns the part of dip_compare_shown that the user sees. The pane's label belongs in its top
// left corner.
DipRect dip_compare_visible(const DipWindow *window, int pane);

// Returns whether a pane's picture shows and needs its label. A difference and the converged
// picture have labels of their own.
bool dip_compare_has_label(const DipWindow *window, int pane);

// Finds the pane and the pixel that the window shows at window_x, window_y. Returns false if there
// is none.
bool dip_compare_pixel_at(const DipWindow *window, int window_x, int window_y, int *pane, int *x,
                          int *y);

// Returns the number of columns of a picture of the given width that lie left of the divider.
int dip_compare_divider_column(double divider, int width);

// Differences of two pictures in 8-bit sRGB codes.
typedef struct DipDifference {
    int64_t pixels;    // Pixels of a picture.
    int64_t differing; // Pixels in which a channel differs.
    int greatest;      // The greatest difference of a channel, 0..255.
    int x;             // The first pixel, row by row, with that difference.
    int y;
} DipDifference;

// Computes |a - b| * gain for each channel, at most 255, with alpha 255, into `out`, whose rows are
// packed. Both pictures have one size.
DipDifference dip_compare_difference(const DipPixels *a, const DipPixels *b, int gain,
                                     uint8_t *out);

// --- actions -----------------------------------------------------------------------------------

// Moves what `[` and `]` move: the divider by 1/64 of the picture, or the gain by a factor of 2.
// Returns false if the comparison has neither.
bool dip_compare_adjust(DipToolState *tools, int steps);

// Returns the pane that a comparison of one picture shows at a time, for BLINK and ALONE.
int dip_compare_pane(const DipPreviewState *state, int64_t now_ns);

// Returns when the window must be drawn again because pictures change by time, or INT64_MAX.
int64_t dip_compare_wakes_ns(const DipToolState *tools, int64_t now_ns);

const char *dip_compare_name(DipComparison comparison); // "Side by side"

// --- memory ------------------------------------------------------------------------------------

DipComparer *dip_compare_create(DipError *err);
void dip_compare_destroy(DipComparer **compare);

// Returns the difference of the panes' pictures, and computes it if a picture or the gain has
// changed. Returns NULL if memory runs out or the sizes differ. The picture and its version are
// valid until the next call.
const DipDifference *dip_compare_make_difference(DipComparer *compare, const DipWindow *window,
                                                 DipPixels *picture, uint64_t *version);

#endif
