// Turns requests of other programs into actions of the preview.
#include "app/preview/control/control_private.h"

#include "app/files/pictures.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

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
    if (request->notices & DIP_CONTROL_OFF) { // What the status line said before stays.
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
        if (strcmp(name, dip_preview_path_name(state, c)) == 0) {
            dip_preview_act(state, DIP_ACTION_PATH, c, false, moment->now_ns);
            return true;
        }
        strncat(accepted, " ", sizeof accepted - strlen(accepted) - 1);
        strncat(accepted, dip_preview_path_name(state, c), sizeof accepted - strlen(accepted) - 1);
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

// Finds a scene in the ring that dip_session_step_scene goes through.
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

// The first attempt asks for the scene. The second one, after a picture has been drawn, finds out
// whether the scene could be opened.
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

DipLayout dip_remote_layout(const DipPreviewMoment *moment, int width, int height) {
    const DipToolState *tools = &moment->state->tools;
    const double scale =
        dip_layout_scale(moment->display->scale(moment->display->context), tools, height);
    return dip_layout_make(width, height, scale, tools->open, tools->bare);
}

static bool resize(const DipPreviewMoment *moment, const DipControlRequest *request, cJSON *reply,
                   DipError *err) {
    const DipDisplay *display = moment->display;
    const DipToolState *tools = &moment->state->tools;
    const double display_scale = display->scale(display->context);
    int width, height = request->height;
    if (!display->set_size) {
        return dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, "request",
                             "the host's window decides about the size");
    }
    for (int i = 0; i < 4; ++i) { // The scale follows the height, and the height the scale.
        const double scale = dip_layout_scale(display_scale, tools, height);
        dip_layout_window_size(request->width, request->height, scale, tools->open, tools->bare,
                               &width, &height);
    }
    display->set_size(display->context, width, height);
    display->size(display->context, &width, &height);
    const DipRect pane = dip_remote_layout(moment, width, height).panes[DIP_PANE_CURRENT];
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
    const DipFrame frame = {.rgba8 = picture->rgba8,
                            .stride_bytes = picture->stride_bytes,
                            .width = picture->width,
                            .height = picture->height};
    cJSON_AddStringToObject(reply, "file", file);
    return dip_png_write(file, &frame, err);
}

// --- all requests --------------------------------------------------------------------------------

// Adds the parts that a request asks for: each in an object of its name, but lists by themselves.
static void get(const DipPreviewMoment *moment, unsigned parts, cJSON *reply) {
    static const struct {
        void (*add)(cJSON *object, const DipPreviewMoment *moment);
        bool is_list;
    } rows[DIP_CONTROL_PART_COUNT] = {
        [DIP_CONTROL_PART_STATE] = {dip_reply_state, false},
        [DIP_CONTROL_PART_SETTINGS] = {dip_reply_settings, false},
        [DIP_CONTROL_PART_TIMES] = {dip_reply_times, false},
        [DIP_CONTROL_PART_ERRORS] = {dip_reply_errors, false},
        [DIP_CONTROL_PART_PRICES] = {dip_reply_prices, false},
        [DIP_CONTROL_PART_PATHS] = {dip_reply_paths, true},
        [DIP_CONTROL_PART_SCENES] = {dip_reply_scenes, true},
        [DIP_CONTROL_PART_STEPS] = {dip_reply_steps, true},
    };
    for (int p = 0; p < DIP_CONTROL_PART_COUNT; ++p) {
        cJSON *object = !(parts >> p & 1) ? NULL
                        : rows[p].is_list
                            ? reply
                            : cJSON_AddObjectToObject(reply, dip_control_part_name(p));
        if (object) {
            rows[p].add(object, moment);
        }
    }
}

// Returns whether a request reads what has been drawn. It then waits until the pictures show the
// requests before it.
static bool needs_pictures(DipControlVerb verb) {
    return verb == DIP_CONTROL_PICK || verb == DIP_CONTROL_GET || verb == DIP_CONTROL_SCREENSHOT;
}

// At the first attempt, the pictures must show everything that has been asked for. Between two
// attempts a picture is drawn, so that later requests of other clients cannot put this one off.
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
        dip_preview_follow_dock(state);
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
    if (request->verb == DIP_CONTROL_SCENE) {
        const DipControlAnswer answer = show_scene(remote->moment, request->name, attempt, err);
        remote->waits |= answer == DIP_CONTROL_LATER;
        return answer;
    }
    return act(remote->moment, request, reply, err) ? DIP_CONTROL_DONE : DIP_CONTROL_REFUSED;
}

static bool turn(void *context, const DipPreviewMoment *moment) {
    DipRemote *remote = context;
    remote->moment = moment;
    remote->acted = remote->waits = false;
    dip_control_poll(remote->control);
    moment->state->wants_picture = remote->waits;
    dip_remote_send_events(remote);
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
        .target = {.context = remote, .carry_out = carry_out},
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
    return (DipPreviewControl){.context = remote, .turn = turn, .press = dip_remote_press};
}
