// What the preview tells other programs in replies and events.
#ifndef DIP_APP_PREVIEW_CONTROL_REPLY_PRIVATE_H
#define DIP_APP_PREVIEW_CONTROL_REPLY_PRIVATE_H

#include "app/preview/loop/loop.h"

struct cJSON;

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
