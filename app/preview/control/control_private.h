// The memory of the preview's remote control, and what its files do for each other. control.c
// carries out requests; control_events.c sends events.
#ifndef DIP_APP_PREVIEW_CONTROL_CONTROL_PRIVATE_H
#define DIP_APP_PREVIEW_CONTROL_CONTROL_PRIVATE_H

#include "app/control/control.h"
#include "app/preview/control/control.h"
#include "app/preview/tools/layout.h"

// What the last events said.
typedef struct Told {
    int64_t times_ns; // When times were last sent.
    int64_t polls_ns;
    int64_t prices_ns;
    uint64_t prices; // Hash of the prices.
    double ms[DIP_PANE_COUNT];
    int fps[DIP_PANE_COUNT];
    int64_t play_ns;
    int width;
    int height;
    DipQuality quality[DIP_PANE_COUNT];
    DipErrorStatus error_status;
    int error_samples;
    bool no_errors;
    int64_t notice_end_ns;
} Told;

struct DipRemote {
    DipControl *control;
    const DipPreviewMoment *moment; // Of the call that is running; NULL between calls.
    bool acted;                     // A request has been carried out in this turn.
    bool waits;                     // A request waits for the next picture.
    unsigned topics;
    unsigned subscriptions;
    Told told;
};

// Returns where panes and dock lie in a window of the given size.
DipLayout dip_remote_layout(const DipPreviewMoment *moment, int width, int height);

// Sends what has changed. After a subscription, sends everything once.
void dip_remote_send_events(DipRemote *remote);

// Sends the colours of the pixel under the mouse, when the user has pressed a button. `context` is
// the remote.
void dip_remote_press(void *context, const DipPreviewMoment *moment, const DipEvent *event);

#endif
