// Makes the state, names camera paths, moves the time, and shows notices.
#include "app/preview/state/state_private.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

const char *const dip_pane_titles[DIP_PANE_COUNT] = {"Current", "Requested"};

static const int64_t default_step_ns = 33333333; // A thirtieth of a second.

DipPreviewState dip_preview_state_make(const DipQuality quality[DIP_PANE_COUNT],
                                       DipCamTrack *track) {
    DipPreviewState state = {.track = track, .step_ns = default_step_ns};
    state.quality[DIP_PANE_CURRENT] = quality[DIP_PANE_CURRENT];
    state.quality[DIP_PANE_REQUESTED] = quality[DIP_PANE_REQUESTED];
    state.edited[DIP_PANE_REQUESTED] = true;
    memcpy(state.begun_quality, state.quality, sizeof state.begun_quality);
    state.tools = (DipToolState){.open = true,
                                 .ui_scale = 1.0,
                                 .zoom = 16,
                                 .x = -1,
                                 .y = -1,
                                 .divider = 0.5,
                                 .gain = 8,
                                 .brightness = 1};
    state.budget_ms = state.refresh_ms = 1000.0 / 60.0;
    return state;
}

int dip_preview_edited_pane(const DipPreviewState *state) {
    return state->edited[DIP_PANE_REQUESTED] ? DIP_PANE_REQUESTED : DIP_PANE_CURRENT;
}

void dip_preview_edit_only(DipPreviewState *state, int pane) {
    state->edited[pane] = true;
    state->edited[1 - pane] = false;
}

void dip_preview_notice(DipPreviewState *state, int64_t now_ns, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(state->notice, sizeof state->notice, format, arguments);
    va_end(arguments);
    state->notice_end_ns = now_ns + dip_state_notice_ns;
}

void dip_preview_error_text(const DipError *err, char text[DIP_NOTICE_SIZE]) {
    const char *slash = strrchr(err->file, '/');
    const char *name = slash && slash[1] ? slash + 1 : err->file;
    char place[96] = "";
    if (name[0] && err->line > 0) {
        snprintf(place, sizeof place, " (%.64s:%d)", name, err->line);
    } else if (name[0]) {
        snprintf(place, sizeof place, " (%.80s)", name);
    }
    snprintf(text, DIP_NOTICE_SIZE, "%s%.40s%s%.160s%s", err->key[0] ? "[" : "", err->key,
             err->key[0] ? "] " : "", err->message, place);
}

void dip_preview_keep_notice(DipPreviewState *state, int64_t now_ns) {
    state->notice_end_ns = now_ns + 4 * dip_state_notice_ns;
}

// --- camera paths --------------------------------------------------------------------------------

const char *dip_preview_category_title(int category) {
    for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
        if (category == dip_preview_category_of((DipSetting)s)) {
            return dip_setting_info((DipSetting)s)->title;
        }
    }
    return category == DIP_CATEGORY_DEFAULT ? "Default"
           : category == DIP_CATEGORY_WATER ? "Water"
                                            : dip_session_category(category);
}

const char *dip_preview_path_title(const DipPreviewState *state, int category) {
    const bool known = category >= 0 && category < DIP_CAMTRACK_CATEGORIES;
    const char *name = known ? state->track->categories[category].name : NULL;
    return name ? name : dip_preview_category_title(category);
}

const DipCamPath *dip_preview_playing_path(const DipPreviewState *state) {
    return dip_camtrack_playing(state->track)->path;
}

bool dip_preview_path_stands(const DipPreviewState *state) {
    const DipCamPath *path = dip_preview_playing_path(state);
    const size_t count = path ? dip_campath_info(path).key_count : 0;
    bool stands = count > 0;
    for (size_t i = 1; stands && i < count; ++i) {
        const DipCamKey first = dip_campath_key(path, 0), key = dip_campath_key(path, i);
        stands = memcmp(&first, &key, sizeof key) == 0;
    }
    return stands;
}

int64_t dip_preview_path_length_ns(const DipPreviewState *state) {
    const DipCamPath *path = dip_preview_playing_path(state);
    if (!path) {
        return 0;
    }
    const bool loops = state->track->end == DIP_CAMPATH_END_loop;
    return dip_campath_span_ns(path, loops ? DIP_CAMPATH_END_loop : DIP_CAMPATH_END_once);
}

int64_t dip_preview_path_ns(const DipPreviewState *state) {
    return dip_camtrack_path_time(state->track, state->play_ns);
}

void dip_preview_seek_path(DipPreviewState *state, int64_t path_ns) {
    const DipCamPath *path = dip_preview_playing_path(state);
    const int64_t span_ns = path ? dip_campath_span_ns(path, state->track->end) : 0;
    const int64_t at_ns = dip_camtrack_time(state->track, state->play_ns);
    const bool once = state->track->end == DIP_CAMPATH_END_once;
    // Stays in the present repetition of the path. If a repetition plays the path forwards and then
    // backwards, goes to the part that plays forwards.
    const int64_t past_ns = once || span_ns == 0 ? at_ns : (at_ns % span_ns + span_ns) % span_ns;
    const int64_t to_ns = state->play_ns + path_ns - past_ns;
    state->play_ns = to_ns >= 0 ? to_ns : once ? 0 : to_ns + span_ns;
    ++state->scene_changes;
}

// --- time ---------------------------------------------------------------------------------------

void dip_preview_seek(DipPreviewState *state, int64_t play_ns) {
    state->play_ns = play_ns > 0 ? play_ns : 0;
    ++state->scene_changes;
}

bool dip_preview_time_runs(const DipPreviewState *state) {
    return !state->paused && (state->manual ? state->scene_moves : !state->stands);
}

bool dip_preview_rests(const DipPreviewState *state, bool flying) {
    return !dip_preview_time_runs(state) && !(state->manual && flying);
}

void dip_preview_advance(DipPreviewState *state, int64_t elapsed_ns, int64_t now_ns) {
    if (dip_preview_time_runs(state)) {
        state->play_ns += elapsed_ns;
        ++state->scene_changes;
    }
    if (now_ns >= state->notice_end_ns) {
        state->notice[0] = '\0';
    }
}
