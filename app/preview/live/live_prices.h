// Rough prices of what the panes show, measured with painters of their own while nothing moves.
//
// The loop calls dip_live_prices_step in each turn in which camera and scene rest and no event is
// waiting. A step draws one frame or more within its budget. First come the times (price_job.h),
// then, if the loop has the truth of the picture, the errors.
#ifndef DIP_APP_PREVIEW_LIVE_LIVE_PRICES_H
#define DIP_APP_PREVIEW_LIVE_LIVE_PRICES_H

#include "app/measure/metrics/picture.h"
#include "app/preview/live/price_job.h"
#include "app/session/session.h"

typedef struct DipLivePrices DipLivePrices;

// The picture whose settings have prices. Prices hold for one picture only.
typedef struct DipLivePicture {
    DipPose pose;
    int64_t time_ns;
    int width; // Size of a pane's frame.
    int height;
    int look;                 // Variant of a scene of the gallery.
    double pixels_per_degree; // For FLIP.
} DipLivePicture;

// Session and prices are borrowed. Painters are made when they are first needed. Fails with MEMORY.
DipLivePrices *dip_live_prices_create(DipSession *session, DipPrices *prices, DipError *err);
void dip_live_prices_destroy(DipLivePrices **live); // *live may be NULL.

// Destroys the painters and forgets all rough prices. Call it before the session's scene or gallery
// is replaced, since the painters of a gallery must not outlive it.
void dip_live_prices_leave_scene(DipLivePrices *live);

// Tells the prices which scene the session shows and on what it is drawn. If the report is of
// another scene, rough prices replace it until its scene is back. Call it after the session was
// opened and after its scene was replaced.
void dip_live_prices_enter_scene(DipLivePrices *live);

// Measures for about budget_ms milliseconds: the frame or block that is begun is finished. Forgets
// the prices of any other picture first. truth: the converged picture, of the same size and from
// the same pose, or NULL while there is none. truth_version: a number that changes with the truth;
// errors against another truth are measured anew. Returns whether the panel must be drawn again,
// because prices or the text of their progress (dip_prices_progress) have changed; the text changes
// four times a second at most.
bool dip_live_prices_step(DipLivePrices *live, const DipLivePicture *picture,
                          const DipQuality quality[DIP_PANE_COUNT], const DipSrgbPicture *truth,
                          uint64_t truth_version, double budget_ms);

// Drops what is being measured, because something moves. Prices are kept until the next step finds
// another picture.
void dip_live_prices_pause(DipLivePrices *live);

// Returns whether all times of the last picture are known, so that its truth may be drawn beside
// without disturbing them.
bool dip_live_prices_have_times(const DipLivePrices *live);

// Returns whether there is anything left to measure for the last picture, so that the loop need not
// wait for an event.
bool dip_live_prices_are_working(const DipLivePrices *live);

#endif
