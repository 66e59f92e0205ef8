// The memory of the preview's remote control, and what its files do for each other. control.c
// carries out requests; control_events.c sends events; control_reply.c says what both tell.
#ifndef DIP_APP_PREVIEW_CONTROL_CONTROL_PRIVATE_H
#define DIP_APP_PREVIEW_CONTROL_CONTROL_PRIVATE_H

#include "app/control/control.h"
#include "app/preview/control/control.h"
#include "app/preview/tools/layout.h"

struct cJSON;

struct DipRemote {
    DipControl *control;
    const DipPreviewMoment *moment; // Of the call that is running; NULL between calls.
    bool acted;                     // A request has been carried out in this turn.
    bool waits;                     // A request waits for the next picture.
    unsigned topics;
    unsigned subscriptions;
    // What the last event of each topic said, as a hash, and when; and the last notice's end.
    uint64_t told[DIP_CONTROL_TOPIC_COUNT];
    int64_t told_ns[DIP_CONTROL_TOPIC_COUNT];
    int64_t told_notice_ns;
};

// Returns where panes and dock lie in a window of the given size.
DipLayout dip_remote_layout(const DipPreviewMoment *moment, int width, int height);

// Sends what has changed. After a subscription, sends everything once.
void dip_remote_send_events(DipRemote *remote);

// Sends the colours of the pixel under the mouse, when the user has pressed a button. `context` is
// the remote.
void dip_remote_press(void *context, const DipPreviewMoment *moment, const DipEvent *event);

// --- control_reply.c -----------------------------------------------------------------------------

// Each function adds fields to an object. If memory runs out, fields are missing.

// "paused", "time_s", "category", "free_camera", "scene", "width", "height".
void dip_reply_state(struct cJSON *object, const DipPreviewMoment *moment);

// "current" and "requested": the settings as text.
void dip_reply_settings(struct cJSON *object, const DipPreviewMoment *moment);

// "time_s", "width", "height", and the times of both panes.
void dip_reply_times(struct cJSON *object, const DipPreviewMoment *moment);

// "status", "samples", "final", and the errors of both panes.
void dip_reply_errors(struct cJSON *object, const DipPreviewMoment *moment);

// "source", "progress", and the prices of both panes' settings and of every step.
void dip_reply_prices(struct cJSON *object, const DipPreviewMoment *moment);

// "paths": the categories of camera paths.
void dip_reply_paths(struct cJSON *object, const DipPreviewMoment *moment);

// "scenes": the names that the request `scene` takes.
void dip_reply_scenes(struct cJSON *object, const DipPreviewMoment *moment);

// "steps": every setting with its steps, for programs that build a panel from them.
void dip_reply_steps(struct cJSON *object, const DipPreviewMoment *moment);

// "x", "y", and the colours of a pixel in both panes.
void dip_reply_pick(struct cJSON *object, const DipPreviewMoment *moment, int x, int y);

#endif
