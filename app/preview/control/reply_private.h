// Writes what the preview tells other programs in replies and events. docs/embedding.md lists the
// fields. If memory runs out, fields are missing.
#ifndef DIP_APP_PREVIEW_CONTROL_REPLY_PRIVATE_H
#define DIP_APP_PREVIEW_CONTROL_REPLY_PRIVATE_H

#include "app/control/request.h"
#include "app/preview/loop/loop.h"

struct cJSON;

typedef struct DipReplyPart {
    // Adds the part's fields to an object.
    void (*add)(struct cJSON *object, const DipPreviewMoment *moment);
    bool is_list; // The part is a list in a single field that has the part's name.
} DipReplyPart;

extern const DipReplyPart dip_reply_parts[DIP_CONTROL_PART_COUNT];

// Adds a pixel's position and its colours in both panes.
void dip_reply_pick(struct cJSON *object, const DipPreviewMoment *moment, int x, int y);

#endif
