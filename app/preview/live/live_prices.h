// Measures what the settings cost in the panes' present picture, with painters of its own, while
// nothing moves. These live prices (app/preview/prices/prices.h) are rough: they come from one
// picture and few frames.
//
// The loop calls dip_live_prices_step in each turn in which camera and scene rest. A step draws
// frames or compares pictures within its budget. First come rough times (price_job.h), then, if the
// loop has the picture's truth (the converged picture), the errors, and then better times. Nothing
// is timed while another thread draws a truth, because that would disturb the times.
#ifndef DIP_APP_PREVIEW_LIVE_LIVE_PRICES_H
#define DIP_APP_PREVIEW_LIVE_LIVE_PRICES_H

#include "app/measure/metrics/picture.h"
#include "app/preview/live/price_job.h"
#include "app/session/session.h"

typedef struct DipLivePrices DipLivePrices;

// The picture for which prices are measured. The prices hold for this picture only.
typedef struct DipLivePicture {
    DipPose pose;
    int64_t time_ns;
    int width; // Size of a pane's frame, in pixels.
    int height;
    int look;                 // The variant of a gallery scene.
    double pixels_per_degree; // Viewing distance for FLIP.
} DipLivePicture;

// Session and prices are borrowed. Painters are made when they are first needed. Fails with MEMORY.
DipLivePrices *dip_live_prices_create(DipSession *session, DipPrices *prices, DipError *err);
void dip_live_prices_destroy(DipLivePrices **live); // *live may be NULL.

// Destroys the painters and forgets all rough prices. Call it before the session's scene or gallery
// is replaced, since the painters of a gallery must not outlive it.
void dip_live_prices_leave_scene(DipLivePrices *live);

// Tells the prices which scene the session shows and which processor draws it. If the opened cost
// report is of another scene, rough prices replace the report's until the session shows the
// report's scene again. Call it after the session was opened and after its scene was replaced.
void dip_live_prices_enter_scene(DipLivePrices *live);

// The newest converged picture, and the progress of the next, finer one.
typedef struct DipLiveTruth {
    // The truth, with the live picture's size and pose. It has no pixels while there is no truth.
    DipSrgbPicture picture;
    int samples; // Samples per pixel. Errors against a finer truth replace the previous errors.
    bool comes_first; // The first truth is drawn before frames are timed.
    int next_samples; // Samples per pixel of the truth that is being drawn; 0 if there is none.
    double drawn;     // How much of the truth that is being drawn is done, from 0 to 1.
    bool waits;       // The thread that draws truths waits for a free processor.
} DipLiveTruth;

// If something is left to measure, measures for about budget_ms milliseconds, at least a frame or a
// part of a comparison. First forgets the prices if the picture or the base of the prices has
// changed. Errors against a coarser truth stay until all errors against `truth` are known, because
// only errors against one truth can be compared. Returns whether the panel must be drawn again,
// because prices or the text of their progress (dip_prices_progress) have changed; the text changes
// four times a second at most.
bool dip_live_prices_step(DipLivePrices *live, const DipLivePicture *picture,
                          const DipQuality quality[DIP_PANE_COUNT], const DipLiveTruth *truth,
                          double budget_ms);

// Drops what is being measured, because something moves. Prices are kept until the next step finds
// another picture.
void dip_live_prices_pause(DipLivePrices *live);

// Returns whether all times of the last picture are known at least roughly, or cannot be measured.
// Another thread may then draw the picture's truth without disturbing rough times.
bool dip_live_prices_have_times(const DipLivePrices *live);

// Returns whether all times of the last picture are known as well as they ever will be.
bool dip_live_prices_have_final_times(const DipLivePrices *live);

// Returns whether errors are left that can be measured against the truth of the last step.
bool dip_live_prices_lack_errors(const DipLivePrices *live);

// Returns whether the next step would measure something, so that the loop need not wait for an
// event.
bool dip_live_prices_are_working(const DipLivePrices *live);

#endif
