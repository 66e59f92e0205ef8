// Turns requests of other programs into actions of the preview, and changes of the preview into
// events for these programs.
#include "app/preview/control/control.h"

#include "app/control/control.h"
#include "app/files/pictures.h"
#include "app/files/put.h"
#include "app/preview/control/reply_private.h"
#include "app/preview/tools/compare.h"
#include "renderer/base/hash.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct DipRemote {
    DipControl *control;
    const DipPreviewMoment *moment; // Valid during a call of turn(); otherwise NULL.
    bool acted; // A request that may change the pictures was handled in this turn.
    bool waits; // A request of this turn waits for the next picture.
    unsigned topics;
    unsigned subscriptions;
    uint64_t told[DIP_CONTROL_TOPIC_COUNT];   // Hash of each topic's last event.
    int64_t told_ns[DIP_CONTROL_TOPIC_COUNT]; // When that event was sent.
    int64_t told_notice_ns;                   // notice_end_ns of the notice that was seen last.
};

// --- settings, paths and time --------------------------------------------------------------------

// Finds the new settings of both panes before it changes either, so that a mistake changes nothing.
static bool set(const DipPreviewMoment *moment, const DipControlRequest *request, DipError *err) {
    DipPreviewState *state = moment->state;
    DipQuality quality[DIP_PANE_COUNT];
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        quality[p] = state->quality[p];
        const bool wanted = (request->panes >> p & 1) != 0;
        const bool done =
            request->settings[0]
                ? dip_quality_parse(request->settings, &quality[p], err)
                : !wanted || dip_control_change_settings(&state->quality[p], request->change,
                                                         &quality[p], err);
        if (!done) {
            return false;
        }
    }
    char notice[DIP_NOTICE_SIZE];
    const int64_t notice_end_ns = state->notice_end_ns;
    memcpy(notice, state->notice, sizeof notice);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        if (request->panes >> p & 1) {
            dip_preview_set_quality(state, p, &quality[p], moment->now_ns);
        }
    }
    if (request->notices & DIP_CONTROL_OFF) { // Keeps the notice that showed before.
        memcpy(state->notice, notice, sizeof notice);
        state->notice_end_ns = notice_end_ns;
    }
    return true;
}

static bool choose_path(const DipPreviewMoment *moment, const char *name, DipError *err) {
    DipPreviewState *state = moment->state;
    char accepted[160] = "";
    for (int c = 0; c < DIP_CAMTRACK_CATEGORIES; ++c) {
        if (!state->track->categories[c].path) {
            continue;
        }
        if (strcmp(name, dip_session_path_name(state->track, c)) == 0) {
            dip_preview_act(state, DIP_ACTION_PATH, c, false, moment->now_ns);
            return true;
        }
        dip_put_append(accepted, sizeof accepted, " %s", dip_session_path_name(state->track, c));
    }
    return dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, "category",
                         "'%s' is no category with a camera path, accepted%s", name,
                         accepted[0] ? accepted : " none, because the scene has one path");
}

static void set_paused(const DipPreviewMoment *moment, bool paused) {
    if (moment->state->paused != paused) {
        dip_preview_act(moment->state, DIP_ACTION_PAUSE, 0, false, moment->now_ns);
    }
}

// --- scene and size ------------------------------------------------------------------------------

// Finds the index of a scene in the ring of scenes through which dip_session_step_scene goes.
static bool find_scene(const DipSession *session, const char *name, int *scene, DipError *err) {
    if (strcmp(name, "models") == 0) {
        *scene = dip_gallery_scene_count();
        return session->scene || dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "name",
                                               "the preview was started without models");
    }
    DipError failure;
    if (!dip_gallery_find(name, scene, &failure)) {
        return dip_error_set(err, failure.code, NULL, 0, "name", "%s", failure.message);
    }
    return *scene != DIP_GALLERY_TOUR ||
           dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, "name",
                         "the tour can only be chosen by the option --scene tour");
}

// The first attempt asks for the scene. The second attempt, after a turn has drawn a picture, finds
// out whether the scene could be opened.
static DipControlAnswer show_scene(const DipPreviewMoment *moment, const char *name, int attempt,
                                   DipError *err) {
    const DipSession *session = moment->session;
    DipPreviewState *state = moment->state;
    int scene;
    if (!find_scene(session, name, &scene, err)) {
        return DIP_CONTROL_REFUSED;
    }
    const int now = session->shows_gallery ? session->gallery_scene : dip_gallery_scene_count();
    if (scene == now) {
        return DIP_CONTROL_DONE;
    }
    if (attempt > 0) {
        dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "name", "the scene does not open: %s",
                      state->notice);
        return DIP_CONTROL_REFUSED;
    }
    state->scene_step = now == DIP_GALLERY_TOUR ? scene + 1 : scene - now;
    ++state->scene_changes;
    return DIP_CONTROL_LATER;
}

// Finds the index of an animation, or -1 for "none".
static bool find_animation(const DipSessionAnimations *animations, const char *name, int *index,
                           DipError *err) {
    DipNameList accepted = {.text = "none"};
    *index = -1;
    if (strcmp(name, "none") == 0) {
        return true;
    }
    for (int i = 0; i < animations->count; ++i) {
        if (strcmp(name, animations->names[i]) == 0) {
            *index = i;
            return true;
        }
        dip_name_list_add(&accepted, animations->names[i]);
    }
    return dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, "name",
                         "'%s' is no animation of the models, accepted %s", name,
                         dip_name_list_end(&accepted));
}

// The first attempt asks for the animation. Later attempts wait until the models have been opened
// with this animation.
static DipControlAnswer play_animation(const DipPreviewMoment *moment, const char *name,
                                       int attempt, DipError *err) {
    const DipSessionAnimations *animations = &moment->session->animations;
    DipPreviewState *state = moment->state;
    int index;
    if (!find_animation(animations, name, &index, err)) {
        return DIP_CONTROL_REFUSED;
    }
    const bool plays = animations->count == 0 || index == animations->playing;
    if (attempt == 0 && (!plays || state->opens_animation)) {
        dip_preview_act(state, DIP_ACTION_ANIMATION, index, false, moment->now_ns);
    }
    if (state->wants_animation || state->opens_animation) {
        return DIP_CONTROL_LATER;
    }
    if (plays) {
        return DIP_CONTROL_DONE;
    }
    dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "name", "the animation does not play: %s",
                  state->notice);
    return DIP_CONTROL_REFUSED;
}

static bool resize(const DipPreviewMoment *moment, const DipControlRequest *request, cJSON *reply,
                   DipError *err) {
    const DipDisplay *display = moment->display;
    const DipToolState *tools = &moment->state->tools;
    const double display_scale = display->scale(display->context);
    int width, height;
    if (!display->set_size) {
        return dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, "request",
                             "the host's window decides about the size");
    }
    dip_layout_window_size(request->width, request->height, display_scale, tools, &width, &height);
    display->set_size(display->context, width, height);
    display->size(display->context, &width, &height);
    // The next turn lays the window out anew, so moment->layout has the old size.
    const DipRect pane =
        dip_layout_make(width, height, display_scale, tools).panes[DIP_PANE_CURRENT];
    cJSON_AddNumberToObject(reply, "width", pane.width);
    cJSON_AddNumberToObject(reply, "height", pane.height);
    return true;
}

// --- pictures ------------------------------------------------------------------------------------

static bool pick(const DipPreviewMoment *moment, const DipControlRequest *request, cJSON *reply,
                 DipError *err) {
    const DipFrame *frame = &moment->panes[0];
    const bool wide = request->x >= frame->width;
    if (wide || request->y >= frame->height) {
        const int size = wide ? frame->width : frame->height;
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, wide ? "x" : "y",
                             "%d is out of range, accepted 0..%d", wide ? request->x : request->y,
                             size - 1);
    }
    dip_reply_pick(reply, moment, request->x, request->y);
    return true;
}

static bool save(const DipPreviewMoment *moment, const char *file, cJSON *reply, DipError *err) {
    const DipPixels *picture = &moment->picture;
    cJSON_AddStringToObject(reply, "file", file);
    return dip_png_write_rgba8(file, picture->rgba8, picture->stride_bytes, picture->width,
                               picture->height, err);
}

// --- all requests --------------------------------------------------------------------------------

// Adds the parts that a request asks for. A list becomes a field of the reply itself; any other
// part becomes an object with the part's name.
static void get(const DipPreviewMoment *moment, unsigned parts, cJSON *reply) {
    for (int p = 0; p < DIP_CONTROL_PART_COUNT; ++p) {
        cJSON *object = !(parts >> p & 1) ? NULL
                        : dip_reply_parts[p].is_list
                            ? reply
                            : cJSON_AddObjectToObject(reply, dip_control_part_names[p]);
        if (object) {
            dip_reply_parts[p].add(object, moment);
        }
    }
}

// Returns whether a request reads what has been drawn. Such a request waits until the pictures show
// the effects of earlier requests.
static bool needs_pictures(DipControlVerb verb) {
    return verb == DIP_CONTROL_PICK || verb == DIP_CONTROL_GET || verb == DIP_CONTROL_SCREENSHOT;
}

// Returns whether a request can read the pictures. At its first attempt, they must show everything
// that has been asked for. At later attempts, any pictures will do, so that the requests of other
// clients cannot delay this one for ever.
static bool pictures_are_ready(const DipRemote *remote, int attempt) {
    const DipPreviewMoment *moment = remote->moment;
    const bool exist = moment->panes[0].rgba8 && moment->picture.rgba8;
    return exist && (attempt > 0 || (moment->drawn && !remote->acted));
}

static bool act(const DipPreviewMoment *moment, const DipControlRequest *request, cJSON *reply,
                DipError *err) {
    DipPreviewState *state = moment->state;
    switch (request->verb) {
    case DIP_CONTROL_SET:
        return set(moment, request, err);
    case DIP_CONTROL_APPLY:
        dip_preview_act(state, DIP_ACTION_APPLY, 0, false, moment->now_ns);
        return true;
    case DIP_CONTROL_PATH:
        return choose_path(moment, request->category, err);
    case DIP_CONTROL_PAUSE:
    case DIP_CONTROL_PLAY:
        set_paused(moment, request->verb == DIP_CONTROL_PAUSE);
        return true;
    case DIP_CONTROL_SEEK:
        dip_preview_seek(state,
                         state->track->start_ns + (int64_t)floor(1e9 * request->time_s + 0.5));
        return true;
    case DIP_CONTROL_SIZE:
        return resize(moment, request, reply, err);
    case DIP_CONTROL_PANEL:
        state->tools.bare = (request->show & DIP_CONTROL_OFF) != 0;
        return true;
    case DIP_CONTROL_PICK:
        return pick(moment, request, reply, err);
    case DIP_CONTROL_GET:
        get(moment, request->parts, reply);
        return true;
    case DIP_CONTROL_SCREENSHOT:
        return save(moment, request->file, reply, err);
    case DIP_CONTROL_QUIT:
        dip_preview_act(state, DIP_ACTION_QUIT, 0, false, moment->now_ns);
        return true;
    default:
        return dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, "request", "is not supported");
    }
}

static DipControlAnswer carry_out(void *context, const DipControlRequest *request, int attempt,
                                  cJSON *reply, DipError *err) {
    DipRemote *remote = context;
    if (!needs_pictures(request->verb)) {
        remote->acted = true;
    } else if (!pictures_are_ready(remote, attempt)) {
        remote->waits = true;
        return DIP_CONTROL_LATER;
    }
    if (request->verb == DIP_CONTROL_SCENE || request->verb == DIP_CONTROL_ANIMATION) {
        const DipControlAnswer answer =
            request->verb == DIP_CONTROL_SCENE
                ? show_scene(remote->moment, request->name, attempt, err)
                : play_animation(remote->moment, request->name, attempt, err);
        remote->waits |= answer == DIP_CONTROL_LATER;
        return answer;
    }
    return act(remote->moment, request, reply, err) ? DIP_CONTROL_DONE : DIP_CONTROL_REFUSED;
}

// --- events --------------------------------------------------------------------------------------

// Shortest time between two events of one topic, for the topics times, prices and polls. The first
// event after a subscription comes at once.
enum { PERIOD_NS = 250000000 };

static bool wants(const DipRemote *remote, DipControlTopic topic) {
    return (remote->topics >> topic & 1) != 0;
}

// Returns a hash of an object's text.
static uint64_t hash_of(const cJSON *object) {
    char *text = cJSON_PrintUnformatted(object);
    DipHash hash = dip_hash_begin(0);
    dip_hash_text(&hash, text);
    cJSON_free(text);
    return hash.lanes[0];
}

// Says how the events of a topic are sent. An event has the fields of a part (DipControlPart). An
// event is sent if its fields have changed, at most once in a period. A poll is sent even if
// nothing has changed: it asks the subscribers for their settings, and a subscriber whose settings
// have changed answers with the request `set`.
typedef struct Topic {
    bool is_part; // False if other functions send the topic's events.
    DipControlPart part;
    int64_t period_ns;
    bool repeats;       // The event is also sent if its fields have not changed.
    bool needs_picture; // Nothing is sent before the first picture.
} Topic;

static const Topic events[DIP_CONTROL_TOPIC_COUNT] = {
    [DIP_CONTROL_TOPIC_SETTINGS] = {true, DIP_CONTROL_PART_SETTINGS, 0, false, false},
    [DIP_CONTROL_TOPIC_TIMES] = {true, DIP_CONTROL_PART_TIMES, PERIOD_NS, false, true},
    [DIP_CONTROL_TOPIC_ERRORS] = {true, DIP_CONTROL_PART_ERRORS, 0, false, false},
    [DIP_CONTROL_TOPIC_PRICES] = {true, DIP_CONTROL_PART_PRICES, PERIOD_NS, false, false},
    [DIP_CONTROL_TOPIC_POLLS] = {true, DIP_CONTROL_PART_SETTINGS, PERIOD_NS, true, false},
};

static void send_event(DipRemote *remote, DipControlTopic topic, bool always) {
    const DipPreviewMoment *moment = remote->moment;
    const Topic *event = &events[topic];
    const bool early = moment->now_ns - remote->told_ns[topic] < event->period_ns;
    if (!event->is_part || !wants(remote, topic) || (early && !always) ||
        (event->needs_picture && !moment->panes[0].rgba8)) {
        return;
    }
    cJSON *fields = cJSON_CreateObject();
    dip_reply_parts[event->part].add(fields, moment);
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

// Sends what has changed. After a subscription, also sends once what has not changed, except
// notices and picks.
static void send_events(DipRemote *remote) {
    const unsigned topics = dip_control_topics(remote->control);
    const unsigned subscriptions = dip_control_subscriptions(remote->control);
    const bool always = subscriptions != remote->subscriptions;
    if (topics != remote->topics) { // wants_errors is not set in every turn, because it is cleared
                                    // when errors cannot be measured.
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

// If a program has subscribed to picks, sends it the colours of the pixel on which the user has
// pressed a mouse button, and the pane whose picture the window shows there.
static void press(void *context, const DipPreviewMoment *moment, const DipEvent *event) {
    static const char *const buttons[] = {
        [DIP_MOUSE_LEFT] = "left",
        [DIP_MOUSE_MIDDLE] = "middle",
        [DIP_MOUSE_RIGHT] = "right",
        [DIP_MOUSE_OTHER] = "other",
    };
    DipRemote *remote = context;
    if (!wants(remote, DIP_CONTROL_TOPIC_PICKS) || !moment->panes[0].rgba8) {
        return;
    }
    DipWindow window = {
        .state = moment->state, .layout = &moment->layout, .now_ns = moment->now_ns};
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        window.frames[p] = dip_frame_pixels(&moment->panes[p]);
    }
    int pane, x, y;
    if (dip_compare_pixel_at(&window, event->x, event->y, &pane, &x, &y)) {
        cJSON *fields = cJSON_CreateObject();
        cJSON_AddStringToObject(fields, "pane", dip_pane_names[pane]);
        cJSON_AddStringToObject(fields, "button", buttons[event->button]);
        dip_reply_pick(fields, moment, x, y);
        dip_control_send(remote->control, DIP_CONTROL_TOPIC_PICKS, fields);
    }
}

static bool turn(void *context, const DipPreviewMoment *moment) {
    DipRemote *remote = context;
    remote->moment = moment;
    remote->acted = remote->waits = false;
    dip_control_poll(remote->control);
    moment->state->wants_picture = remote->waits;
    send_events(remote);
    remote->moment = NULL;
    return remote->acted;
}

// --- opening and closing -------------------------------------------------------------------------

DipRemote *dip_remote_open(const char *where, DipError *err) {
    DipRemote *remote = calloc(1, sizeof *remote);
    if (!remote) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "--control", "out of memory");
        return NULL;
    }
    const DipControlDef def = {
        .where = where,
        .version = DIP_VERSION,
        .context = remote,
        .carry_out = carry_out,
    };
    remote->control = dip_control_open(&def, err);
    if (!remote->control) {
        free(remote);
        return NULL;
    }
    return remote;
}

void dip_remote_close(DipRemote **remote) {
    if (*remote) {
        dip_control_close(&(*remote)->control);
        free(*remote);
        *remote = NULL;
    }
}

DipPreviewControl dip_remote_control(DipRemote *remote) {
    return (DipPreviewControl){.context = remote, .turn = turn, .press = press};
}
