// Turns changes of the preview into events for other programs.
#include "app/preview/control/control_private.h"

#include "app/preview/control/control_reply.h"

#include <cjson/cJSON.h>
#include <string.h>

static const int64_t period_ns = 250000000; // Between two events of times, prices or polls.

static bool wants(const DipRemote *remote, DipControlTopic topic) {
    return (remote->topics >> topic & 1) != 0;
}

static void send_settings(DipRemote *remote, bool always) {
    const DipPreviewState *state = remote->moment->state;
    Told *told = &remote->told;
    const bool same = memcmp(told->quality, state->quality, sizeof told->quality) == 0;
    memcpy(told->quality, state->quality, sizeof told->quality);
    if (wants(remote, DIP_CONTROL_TOPIC_SETTINGS) && (always || !same)) {
        cJSON *fields = cJSON_CreateObject();
        dip_reply_settings(fields, state);
        dip_control_send(remote->control, DIP_CONTROL_TOPIC_SETTINGS, fields);
    }
}

// Notes the times of this moment. Returns whether they differ from those of the last event.
static bool note_times(Told *told, const DipPreviewMoment *moment) {
    const DipFrame *frame = &moment->panes[0];
    bool same = told->play_ns == moment->state->play_ns && told->width == frame->width &&
                told->height == frame->height;
    told->play_ns = moment->state->play_ns;
    told->width = frame->width;
    told->height = frame->height;
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        const DipPaneFigures *figures = &moment->figures[p];
        same = same && told->ms[p] == figures->ms && told->fps[p] == figures->fps;
        told->ms[p] = figures->ms;
        told->fps[p] = figures->fps;
    }
    return !same;
}

static void send_times(DipRemote *remote, bool always) {
    const DipPreviewMoment *moment = remote->moment;
    Told *told = &remote->told;
    const bool early = moment->now_ns - told->times_ns < period_ns;
    if (!wants(remote, DIP_CONTROL_TOPIC_TIMES) || !moment->panes[0].rgba8 || (early && !always)) {
        return;
    }
    if (note_times(told, moment) || always) {
        told->times_ns = moment->now_ns;
        cJSON *fields = cJSON_CreateObject();
        dip_reply_times(fields, moment);
        dip_control_send(remote->control, DIP_CONTROL_TOPIC_TIMES, fields);
    }
}

static void send_errors(DipRemote *remote, bool always) {
    const DipPaneFigures *figures = &remote->moment->figures[DIP_PANE_CURRENT];
    const DipErrorReading *reading = &figures->errors;
    Told *told = &remote->told;
    const bool same = told->error_status == reading->status &&
                      told->error_samples == reading->result.samples &&
                      told->no_errors == figures->no_errors;
    told->error_status = reading->status;
    told->error_samples = reading->result.samples;
    told->no_errors = figures->no_errors;
    if (wants(remote, DIP_CONTROL_TOPIC_ERRORS) && (always || !same)) {
        cJSON *fields = cJSON_CreateObject();
        dip_reply_errors(fields, remote->moment);
        dip_control_send(remote->control, DIP_CONTROL_TOPIC_ERRORS, fields);
    }
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

static void send_prices(DipRemote *remote, bool always) {
    Told *told = &remote->told;
    const int64_t now_ns = remote->moment->now_ns;
    const bool early = now_ns - told->prices_ns < period_ns;
    if (!wants(remote, DIP_CONTROL_TOPIC_PRICES) || (early && !always)) {
        return;
    }
    cJSON *fields = cJSON_CreateObject();
    dip_reply_prices(fields, remote->moment);
    const uint64_t hash = hash_of(fields);
    told->prices_ns = now_ns;
    if (always || hash != told->prices) {
        told->prices = hash;
        dip_control_send(remote->control, DIP_CONTROL_TOPIC_PRICES, fields);
    } else {
        cJSON_Delete(fields);
    }
}

static void send_notice(DipRemote *remote) {
    const DipPreviewState *state = remote->moment->state;
    const bool same = remote->told.notice_end_ns == state->notice_end_ns;
    remote->told.notice_end_ns = state->notice_end_ns;
    if (!same && wants(remote, DIP_CONTROL_TOPIC_NOTICES)) {
        cJSON *fields = cJSON_CreateObject();
        cJSON_AddStringToObject(fields, "text", state->notice);
        dip_control_send(remote->control, DIP_CONTROL_TOPIC_NOTICES, fields);
    }
}

// Asks the subscribers for their settings, as the seed's preview polled its settings panel. They
// answer with the request `set` if something has changed.
static void send_poll(DipRemote *remote, bool always) {
    const int64_t now_ns = remote->moment->now_ns;
    const bool early = now_ns - remote->told.polls_ns < period_ns;
    if (wants(remote, DIP_CONTROL_TOPIC_POLLS) && (always || !early)) {
        remote->told.polls_ns = now_ns;
        cJSON *fields = cJSON_CreateObject();
        dip_reply_settings(fields, remote->moment->state);
        dip_control_send(remote->control, DIP_CONTROL_TOPIC_POLLS, fields);
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
    send_settings(remote, always);
    send_times(remote, always);
    send_errors(remote, always);
    send_prices(remote, always);
    send_notice(remote);
    send_poll(remote, always);
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
