// Turns changes of the preview into events for other programs.
#include "app/preview/control/control_private.h"

#include <cjson/cJSON.h>

enum { PERIOD_NS = 250000000 }; // Between two events of times, prices or polls.

static bool wants(const DipRemote *remote, DipControlTopic topic) {
    return (remote->topics >> topic & 1) != 0;
}

// Returns a hash of an object's text (FNV-1a), or 0 if memory runs out.
static uint64_t hash_of(const cJSON *object) {
    char *text = cJSON_PrintUnformatted(object);
    uint64_t hash = text ? UINT64_C(14695981039346656037) : 0;
    for (const char *c = text; c && *c; ++c) {
        hash = (hash ^ (unsigned char)*c) * UINT64_C(1099511628211);
    }
    cJSON_free(text);
    return hash;
}

// A topic whose events say what a function adds. An event is sent if it says something new, at most
// once in a period. Polls ask the subscribers for their settings, as the seed's preview polled its
// settings panel, and are sent even if nothing is new; a subscriber answers with the request `set`
// if something has changed.
typedef struct Topic {
    void (*add)(cJSON *object, const DipPreviewMoment *moment);
    int64_t period_ns;
    bool repeats;       // Also without news.
    bool needs_picture; // Nothing is sent before the first one.
} Topic;

static const Topic events[DIP_CONTROL_TOPIC_COUNT] = {
    [DIP_CONTROL_TOPIC_SETTINGS] = {dip_reply_settings, 0, false, false},
    [DIP_CONTROL_TOPIC_TIMES] = {dip_reply_times, PERIOD_NS, false, true},
    [DIP_CONTROL_TOPIC_ERRORS] = {dip_reply_errors, 0, false, false},
    [DIP_CONTROL_TOPIC_PRICES] = {dip_reply_prices, PERIOD_NS, false, false},
    [DIP_CONTROL_TOPIC_POLLS] = {dip_reply_settings, PERIOD_NS, true, false},
};

static void send_event(DipRemote *remote, DipControlTopic topic, bool always) {
    const DipPreviewMoment *moment = remote->moment;
    const Topic *event = &events[topic];
    const bool early = moment->now_ns - remote->told_ns[topic] < event->period_ns;
    if (!event->add || !wants(remote, topic) || (early && !always) ||
        (event->needs_picture && !moment->panes[0].rgba8)) {
        return;
    }
    cJSON *fields = cJSON_CreateObject();
    event->add(fields, moment);
    const uint64_t hash = hash_of(fields);
    if (always || event->repeats || hash != remote->told[topic]) {
        remote->told_ns[topic] = moment->now_ns;
        remote->told[topic] = hash;
        dip_control_send(remote->control, topic, fields);
    } else {
        cJSON_Delete(fields);
    }
}

static void send_notice(DipRemote *remote) {
    const DipPreviewState *state = remote->moment->state;
    const bool same = remote->told_notice_ns == state->notice_end_ns;
    remote->told_notice_ns = state->notice_end_ns;
    if (!same && wants(remote, DIP_CONTROL_TOPIC_NOTICES)) {
        cJSON *fields = cJSON_CreateObject();
        cJSON_AddStringToObject(fields, "text", state->notice);
        dip_control_send(remote->control, DIP_CONTROL_TOPIC_NOTICES, fields);
    }
}

void dip_remote_send_events(DipRemote *remote) {
    const unsigned topics = dip_control_topics(remote->control);
    const unsigned subscriptions = dip_control_subscriptions(remote->control);
    const bool always = subscriptions != remote->subscriptions;
    if (topics != remote->topics) { // After a failure to measure, only a new subscription retries.
        remote->moment->state->wants_errors = (topics >> DIP_CONTROL_TOPIC_ERRORS & 1) != 0;
    }
    remote->moment->state->wants_prices = (topics >> DIP_CONTROL_TOPIC_PRICES & 1) != 0;
    remote->topics = topics;
    remote->subscriptions = subscriptions;
    for (int t = 0; t < DIP_CONTROL_TOPIC_COUNT; ++t) {
        if (t == DIP_CONTROL_TOPIC_NOTICES) {
            send_notice(remote);
        } else {
            send_event(remote, (DipControlTopic)t, always);
        }
    }
}

void dip_remote_press(void *context, const DipPreviewMoment *moment, const DipEvent *event) {
    static const char *const buttons[] = {
        [DIP_MOUSE_LEFT] = "left",
        [DIP_MOUSE_MIDDLE] = "middle",
        [DIP_MOUSE_RIGHT] = "right",
        [DIP_MOUSE_OTHER] = "other",
    };
    DipRemote *remote = context;
    const DipFrame *frame = &moment->panes[0];
    if (!wants(remote, DIP_CONTROL_TOPIC_PICKS) || !frame->rgba8) {
        return;
    }
    const DipLayout layout =
        dip_remote_layout(moment, moment->picture.width, moment->picture.height);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        const DipRect *pane = &layout.panes[p];
        if (!dip_rect_holds(*pane, event->x, event->y)) {
            continue;
        }
        cJSON *fields = cJSON_CreateObject();
        cJSON_AddStringToObject(fields, "pane", dip_pane_names[p]);
        cJSON_AddStringToObject(fields, "button", buttons[event->button]);
        // If memory ran out for frames of the panes' size, the window shows smaller frames
        // enlarged.
        dip_reply_pick(fields, moment,
                       (int)((int64_t)(event->x - pane->x) * frame->width / pane->width),
                       (int)((int64_t)(event->y - pane->y) * frame->height / pane->height));
        dip_control_send(remote->control, DIP_CONTROL_TOPIC_PICKS, fields);
        return;
    }
}
