// Writes the preview's state, times, errors and prices as JSON.
#include "app/preview/control/reply_private.h"

#include "app/files/put.h"
#include "config/config.h"

#include <cjson/cJSON.h>
#include <math.h>

// Adds a time in milliseconds or seconds, rounded to 1e-6.
static void add_time(cJSON *object, const char *name, double time) {
    cJSON_AddNumberToObject(object, name, floor(1e6 * time + 0.5) / 1e6);
}

// Appends an item to an array, or deletes it if memory runs out.
static void append(cJSON *array, cJSON *item) {
    if (!cJSON_AddItemToArray(array, item)) {
        cJSON_Delete(item);
    }
}

// --- state and settings --------------------------------------------------------------------------

// Returns the time on the camera path, from 0 to the path's duration. Without a path, returns the
// time since track->start_ns, which may be longer.
static double path_time_s(const DipPreviewState *state) {
    const int64_t time_ns = dip_preview_playing_path(state)
                                ? dip_preview_path_ns(state)
                                : dip_camtrack_time(state->track, state->play_ns);
    return 1e-9 * (double)time_ns;
}

// Returns the name of the scene that the session shows. The request `scene` takes all these names
// except "tour".
static const char *scene_name(const DipSession *session) {
    return session->shows_gallery ? dip_session_scene_file(session) : "models";
}

// Returns the name that the request `animation` has for the animation that plays, or "none".
static const char *animation_name(const DipSession *session) {
    const DipSessionAnimations *animations = &session->animations;
    const bool plays = animations->playing >= 0 && animations->playing < animations->count;
    return plays ? animations->names[animations->playing] : "none";
}

static void add_size(cJSON *object, const DipPreviewMoment *moment) {
    cJSON_AddNumberToObject(object, "width", moment->panes[0].width);
    cJSON_AddNumberToObject(object, "height", moment->panes[0].height);
}

static void add_state(cJSON *object, const DipPreviewMoment *moment) {
    const DipPreviewState *state = moment->state;
    cJSON_AddBoolToObject(object, "paused", state->paused);
    add_time(object, "time_s", path_time_s(state));
    cJSON_AddStringToObject(object, "category",
                            dip_session_path_name(state->track, state->track->active));
    cJSON_AddBoolToObject(object, "free_camera", state->manual);
    cJSON_AddStringToObject(object, "scene", scene_name(moment->session));
    cJSON_AddStringToObject(object, "animation", animation_name(moment->session));
    add_size(object, moment);
}

static void add_settings(cJSON *object, const DipPreviewMoment *moment) {
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        char text[DIP_SETTINGS_BYTES];
        dip_quality_format(&moment->state->quality[p], text, sizeof text);
        cJSON_AddStringToObject(object, dip_pane_names[p], text);
    }
}

// --- times and errors ----------------------------------------------------------------------------

static void add_pane_times(cJSON *object, const char *name, const DipPaneFigures *figures) {
    cJSON *pane = cJSON_AddObjectToObject(object, name);
    add_time(pane, "ms", figures->ms);
    cJSON_AddNumberToObject(pane, "frames", figures->frames);
    cJSON_AddNumberToObject(pane, "fps", figures->fps);
    cJSON_AddBoolToObject(pane, "copied", figures->copied);
    cJSON *times = cJSON_AddObjectToObject(pane, "stages_ms");
    for (int s = 0; s < DIP_TIMED_PARTS; ++s) {
        add_time(times, dip_bench_stage_names[s], figures->stage_ms[s]);
    }
}

static void add_times(cJSON *object, const DipPreviewMoment *moment) {
    add_time(object, "time_s", path_time_s(moment->state));
    add_size(object, moment);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        add_pane_times(object, dip_pane_names[p], &moment->figures[p]);
    }
}

static const char *status_name(const DipPaneFigures *figures) {
    static const char *const names[] = {
        [DIP_ERROR_STATUS_PAUSED] = "paused",
        [DIP_ERROR_STATUS_WORKING] = "working",
        [DIP_ERROR_STATUS_DONE] = "done",
        [DIP_ERROR_STATUS_FAILED] = "failed",
    };
    return figures->no_errors ? "unavailable" : names[figures->errors.status];
}

static void add_errors(cJSON *object, const DipPreviewMoment *moment) {
    const DipPaneFigures *figures = &moment->figures[DIP_PANE_CURRENT];
    const DipErrorJobResult *result = &figures->errors.result;
    cJSON_AddStringToObject(object, "status", status_name(figures));
    cJSON_AddNumberToObject(object, "samples", result->samples);
    cJSON_AddBoolToObject(object, "final", result->last);
    for (int p = 0; p < DIP_PANE_COUNT && result->samples > 0; ++p) {
        if (result->panes[p].unjudged) {
            continue; // The pane shows mip colours: a client must not take 0 for its error.
        }
        cJSON *pane = cJSON_AddObjectToObject(object, dip_pane_names[p]);
        cJSON_AddNumberToObject(pane, "rmse_lin", result->panes[p].rmse_lin);
        cJSON_AddNumberToObject(pane, "psnr_db", result->panes[p].psnr_db);
        cJSON_AddNumberToObject(pane, "flip", result->panes[p].flip);
        cJSON_AddBoolToObject(pane, "at_floor", result->panes[p].at_floor);
    }
}

// --- lists ---------------------------------------------------------------------------------------

static void add_paths(cJSON *object, const DipPreviewMoment *moment) {
    const DipPreviewState *state = moment->state;
    cJSON *paths = cJSON_AddArrayToObject(object, "paths");
    for (int c = 0; c < DIP_CAMTRACK_CATEGORIES; ++c) {
        if (c >= DIP_CATEGORY_COUNT && !state->track->categories[c].path) {
            break; // No further camera of the models has a path.
        }
        cJSON *path = cJSON_CreateObject();
        cJSON_AddStringToObject(path, "category", dip_session_path_name(state->track, c));
        cJSON_AddStringToObject(path, "title", dip_preview_path_title(state, c));
        cJSON_AddBoolToObject(path, "available", state->track->categories[c].path != NULL);
        append(paths, path);
    }
}

static void add_name(cJSON *array, const char *name) {
    append(array, cJSON_CreateStringReference(name));
}

static void add_scenes(cJSON *object, const DipPreviewMoment *moment) {
    cJSON *scenes = cJSON_AddArrayToObject(object, "scenes");
    for (int s = 0; s < dip_gallery_scene_count(); ++s) {
        add_name(scenes, dip_gallery_info(s)->name);
    }
    if (moment->session->scene) {
        add_name(scenes, "models");
    }
}

static void add_animations(cJSON *object, const DipPreviewMoment *moment) {
    const DipSessionAnimations *animations = &moment->session->animations;
    cJSON *names = cJSON_AddArrayToObject(object, "animations");
    for (int i = 0; i < animations->count; ++i) {
        add_name(names, animations->names[i]);
    }
}

static cJSON *describe_setting(DipSetting setting) {
    const DipSettingInfo *info = dip_setting_info(setting);
    const int category = dip_preview_category_of(setting);
    cJSON *object = cJSON_CreateObject();
    cJSON_AddStringToObject(object, "key", info->key);
    cJSON_AddStringToObject(object, "title", info->title);
    cJSON_AddStringToObject(object, "text", info->text);
    cJSON *steps = cJSON_AddArrayToObject(object, "steps");
    for (int i = 0; i < info->step_count; ++i) {
        add_name(steps, info->steps[i]);
    }
    cJSON_AddStringToObject(object, "default", info->steps[info->default_step]);
    if (category >= 0) {
        cJSON_AddStringToObject(object, "category", dip_session_category(category));
    }
    return object;
}

static void add_steps(cJSON *object, const DipPreviewMoment *moment) {
    (void)moment;
    cJSON *settings = cJSON_AddArrayToObject(object, "steps");
    for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
        append(settings, describe_setting((DipSetting)s));
    }
}

// Adds a text, or null if it is empty. Control characters and malformed UTF-8 become '?'.
static void add_text(cJSON *object, const char *name, char *text) {
    dip_put_clean(text);
    if (text[0]) {
        cJSON_AddStringToObject(object, name, text);
    } else {
        cJSON_AddNullToObject(object, name);
    }
}

static cJSON *describe_warning(DipError warning) {
    cJSON *object = cJSON_CreateObject();
    add_text(object, "file", warning.file);
    if (warning.line > 0) {
        cJSON_AddNumberToObject(object, "line", warning.line);
    } else {
        cJSON_AddNullToObject(object, "line");
    }
    add_text(object, "key", warning.key);
    add_text(object, "message", warning.message);
    return object;
}

static void add_warnings(cJSON *object, const DipPreviewMoment *moment) {
    const DipErrorList *warnings = &moment->session->warnings;
    cJSON *array = cJSON_AddArrayToObject(object, "warnings");
    for (size_t i = 0; i < warnings->count; ++i) {
        append(array, describe_warning(warnings->items[i]));
    }
    cJSON_AddNumberToObject(object, "warnings_left_out", moment->session->warnings_left_out);
}

void dip_reply_pick(cJSON *object, const DipPreviewMoment *moment, int x, int y) {
    cJSON_AddNumberToObject(object, "x", x);
    cJSON_AddNumberToObject(object, "y", y);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        const DipFrame *frame = &moment->panes[p];
        const uint8_t *pixel = frame->rgba8 + (size_t)y * frame->stride_bytes + 4 * (size_t)x;
        const int colour[] = {pixel[0], pixel[1], pixel[2]};
        cJSON *array = cJSON_CreateIntArray(colour, 3);
        if (!cJSON_AddItemToObject(object, dip_pane_names[p], array)) {
            cJSON_Delete(array);
        }
    }
}

// --- prices --------------------------------------------------------------------------------------

static const char *const state_names[] = {
    [DIP_PRICE_UNKNOWN] = "unknown",   [DIP_PRICE_BASE] = "base",
    [DIP_PRICE_MEASURED] = "measured", [DIP_PRICE_PREDICTED] = "predicted",
    [DIP_PRICE_ROUGH] = "rough",
};

static const char *const trust_names[] = {
    [DIP_PRICE_TRUST_UNKNOWN] = "unknown",
    [DIP_PRICE_TRUST_DOUBTFUL] = "doubtful",
    [DIP_PRICE_TRUST_ZERO] = "zero",
    [DIP_PRICE_TRUST_KNOWN] = "known",
};

static void add_price(cJSON *object, DipPriceState state, DipPriceTrust trust, double ms,
                      double low, double high) {
    cJSON_AddStringToObject(object, "state", state_names[state]);
    cJSON_AddStringToObject(object, "trust", trust_names[trust]);
    if (state != DIP_PRICE_UNKNOWN) {
        cJSON_AddNumberToObject(object, "ms", ms);
        cJSON_AddNumberToObject(object, "ms_low", low);
        cJSON_AddNumberToObject(object, "ms_high", high);
    }
}

static void add_pane(cJSON *object, const char *name, const DipPriceSum *sum) {
    cJSON *pane = cJSON_AddObjectToObject(object, name);
    add_price(pane, sum->state, dip_price_sum_trust(sum), sum->ms, sum->ms_low, sum->ms_high);
    if (sum->has_flip) {
        cJSON_AddNumberToObject(pane, "flip", sum->flip);
    }
}

static void add_step(cJSON *steps, const char *name, const DipPrice *price) {
    cJSON *step = cJSON_CreateObject();
    cJSON_AddStringToObject(step, "step", name);
    add_price(step, price->state, dip_price_trust(price), price->ms, price->ms_low, price->ms_high);
    if (price->has_flip) {
        cJSON_AddNumberToObject(step, "flip", price->flip);
    }
    if (price->beside[0]) {
        cJSON_AddStringToObject(step, "beside", price->beside);
    }
    append(steps, step);
}

static const char *source_name(const DipPrices *prices, const DipPriceSum *requested) {
    return !dip_prices_are_rough(prices)           ? "report"
           : requested->state == DIP_PRICE_UNKNOWN ? "none"
                                                   : "rough";
}

static void add_prices(cJSON *object, const DipPreviewMoment *moment) {
    const DipQuality *quality = moment->state->quality;
    const DipPriceSum requested = dip_prices_sum(moment->prices, &quality[DIP_PANE_REQUESTED]);
    const DipPriceSum current = dip_prices_sum(moment->prices, &quality[DIP_PANE_CURRENT]);
    cJSON_AddStringToObject(object, "source", source_name(moment->prices, &requested));
    cJSON_AddStringToObject(object, "progress", dip_prices_progress(moment->prices));
    add_pane(object, dip_pane_names[DIP_PANE_CURRENT], &current);
    add_pane(object, dip_pane_names[DIP_PANE_REQUESTED], &requested);
    cJSON *settings = cJSON_AddObjectToObject(object, "settings");
    for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
        const DipSettingInfo *info = dip_setting_info((DipSetting)s);
        cJSON *steps = cJSON_AddArrayToObject(settings, info->key);
        for (int i = 0; i < info->step_count; ++i) {
            const DipPrice price =
                dip_prices_step(moment->prices, (DipSetting)s, i, &quality[DIP_PANE_REQUESTED]);
            add_step(steps, info->steps[i], &price);
        }
    }
}

// --- all parts -----------------------------------------------------------------------------------

const DipReplyPart dip_reply_parts[DIP_CONTROL_PART_COUNT] = {
    [DIP_CONTROL_PART_STATE] = {add_state, false},
    [DIP_CONTROL_PART_SETTINGS] = {add_settings, false},
    [DIP_CONTROL_PART_TIMES] = {add_times, false},
    [DIP_CONTROL_PART_ERRORS] = {add_errors, false},
    [DIP_CONTROL_PART_PRICES] = {add_prices, false},
    [DIP_CONTROL_PART_PATHS] = {add_paths, true},
    [DIP_CONTROL_PART_ANIMATIONS] = {add_animations, true},
    [DIP_CONTROL_PART_SCENES] = {add_scenes, true},
    [DIP_CONTROL_PART_STEPS] = {add_steps, true},
    [DIP_CONTROL_PART_WARNINGS] = {add_warnings, true},
};
