// Measures rough prices of what the panes show, with painters of its own, while nothing moves.
//
// The loop calls dip_live_prices_step in each turn in which camera and scene rest and no event is
// waiting. A step draws one frame or more within its budget. First come the times (price_job.h),
// then, if the loop has the truth of the picture, the errors. Nothing is timed while another thread
// draws a truth, which would disturb the times.
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
    int width; // Size of a pane's frame, in pixels.
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

// What is known of the converged picture, and how far the next, better one is.
typedef struct DipLiveTruth {
    // Has the live picture's size and pose. It has no pixels while there is no truth.
    DipSrgbPicture picture;
    int samples; // Samples per pixel. Errors against a finer truth replace the previous errors.
    bool comes_first; // No frames are timed until there is a truth.
    int next_samples; // Samples of the truth that is being drawn; 0: none is.
    double drawn;     // How much of that truth is drawn, from 0 to 1.
    bool waits;       // The thread that draws it waits for a free processor.
} DipLiveTruth;

// Measures for about budget_ms milliseconds; what has been begun is finished. First forgets the
// prices of any other picture. Errors against a truth of fewer samples stay until all
// errors against the new one are known, because only errors against one truth can be compared.
// Returns whether the panel must be drawn again, because prices or the text of their progress
// (dip_prices_progress) have changed; the text changes four times a second at most.
bool dip_live_prices_step(DipLivePrices *live, const DipLivePicture *picture,
                          const DipQuality quality[DIP_PANE_COUNT], const DipLiveTruth *truth,
                          double budget_ms);

// Drops what is being measured, because something moves. Prices are kept until the next step finds
// another picture.
void dip_live_prices_pause(DipLivePrices *live);

// Returns whether all times of the last picture are known at least roughly. Its truth may then be
// drawn by another thread without disturbing them.
bool dip_live_prices_have_times(const DipLivePrices *live);

// Returns whether all times of the last picture are known as well as they ever will be.
bool dip_live_prices_have_final_times(const DipLivePrices *live);

// Returns whether errors are left that can be measured against the truth of the last step.
bool dip_live_prices_lack_errors(const DipLivePrices *live);

// Returns whether the next step would measure something, so that the loop need not wait for an
// event.
bool dip_live_prices_are_working(const DipLivePrices *live);

#endif
