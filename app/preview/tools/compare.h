// Compares both panes' pictures. Says where each picture shows in a comparison (DipComparison), and
// computes the difference of two pictures.
#ifndef DIP_APP_PREVIEW_TOOLS_COMPARE_H
#define DIP_APP_PREVIEW_TOOLS_COMPARE_H

#include "app/preview/tools/kept.h"
#include "app/preview/tools/window.h"

// --- arithmetic --------------------------------------------------------------------------------

// Returns whether a comparison shows one picture in place of both panes.
bool dip_compare_is_one_picture(DipComparison comparison);

// Returns whether the chosen comparison needs the converged picture in place of the current pane's.
bool dip_compare_wants_truth(const DipToolState *tools);

// Returns whether the converged picture shows in place of the current pane's: the comparison wants
// it, and it is known.
bool dip_compare_shows_truth(const DipWindow *window);

// Returns the picture that the comparison shows for a pane: the pane's frame or the converged
// picture. Sets *version to the version of that picture.
const DipPixels *dip_compare_picture(const DipWindow *window, int pane, uint64_t *version);

// Returns the size at which the panes' frames are drawn: the size of a pane or, if one picture
// takes the place of both panes, the size of the area in which it shows.
void dip_compare_frame_size(const DipLayout *layout, DipComparison comparison, int *width,
                            int *height);

// Returns where a picture of width x height pixels shows in an area. It lies in the middle,
// enlarged by the greatest whole factor that fits. A picture that is larger than the area is scaled
// down and keeps its aspect ratio.
DipRect dip_compare_fit(DipRect area, int width, int height);

// Returns where a pane's picture shows in the window, or would show if the comparison did not hide
// it. In a wipe, this is the whole picture, of which the divider hides a part.
DipRect dip_compare_shown(const DipWindow *window, int pane);

// Returns the part of the rectangle of dip_compare_shown that the user sees. This part is empty if
// the comparison hides the pane. The pane's label belongs in the top left corner of this part.
DipRect dip_compare_visible(const DipWindow *window, int pane);

// Finds the pane and the pixel of its picture that the window shows at window_x, window_y. Returns
// false if no pane shows there.
bool dip_compare_pixel_at(const DipWindow *window, int window_x, int window_y, int *pane, int *x,
                          int *y);

// Returns the number of columns of a picture of the given width that lie left of the divider.
int dip_compare_divider_column(double divider, int width);

// What dip_compare_difference finds, in 8-bit sRGB codes.
typedef struct DipDifference {
    int64_t pixels;    // Number of pixels of a picture.
    int64_t differing; // Number of pixels in which a channel differs.
    int greatest;      // The greatest difference of a channel, 0..255.
    int x; // Column of the first pixel with the greatest difference, in the order of rows.
    int y; // Row of that pixel.
} DipDifference;

// Computes |a - b| * gain for each channel, at most 255, with alpha 255, into `out`, whose rows are
// packed. Both pictures must have the same size.
DipDifference dip_compare_difference(const DipPixels *a, const DipPixels *b, int gain,
                                     uint8_t *out);

// --- time --------------------------------------------------------------------------------------

// Returns the pane that the comparison BLINK or ALONE shows at the time `now_ns`.
int dip_compare_pane(const DipPreviewState *state, int64_t now_ns);

// Returns when the window must be drawn again because the timer of BLINK switches the picture.
// Returns INT64_MAX if BLINK is not chosen or this timer is off.
int64_t dip_compare_wakes_ns(const DipToolState *tools, int64_t now_ns);

// --- memory ------------------------------------------------------------------------------------

// The difference that was computed last.
typedef struct DipComparer {
    DipKeptPicture difference;
    DipDifference found;
} DipComparer;

// Returns the difference of the two pictures that the comparison shows (dip_compare_picture), and
// computes it if a picture or the gain has changed. Returns NULL if memory runs out or the sizes
// differ. Sets *picture and *version to the difference as a picture, which is valid until the next
// call.
const DipDifference *dip_compare_make_difference(DipComparer *compare, const DipWindow *window,
                                                 DipPixels *picture, uint64_t *version);

#endif
