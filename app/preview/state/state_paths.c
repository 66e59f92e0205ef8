// Chooses camera paths and moves the time on them.
#include "app/preview/state/state_private.h"

#include <string.h>

const char *dip_preview_category_name(int category) {
    static const char *const names[] = {
#define PATH_NAME(NAME, fallback, text) #NAME,
        DIP_CONFIG_LIST(DIP_CONFIG_NONE, PATH_NAME, DIP_CONFIG_NONE)
#undef PATH_NAME
    };
    return category >= 0 && category < DIP_CATEGORY_COUNT ? names[category] : "?";
}

const char *dip_preview_category_title(int category) {
    for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
        if (category == dip_preview_category_of((DipSetting)s)) {
            return dip_setting_info((DipSetting)s)->title;
        }
    }
    return category == DIP_CATEGORY_DEFAULT ? "Default"
           : category == DIP_CATEGORY_WATER ? "Water"
                                            : dip_preview_category_name(category);
}

const char *dip_preview_path_name(const DipPreviewState *state, int category) {
    const bool is_camera = category >= DIP_CATEGORY_COUNT && category < DIP_CAMTRACK_CATEGORIES;
    const char *name = is_camera ? state->track->categories[category].name : NULL;
    return name ? name : dip_preview_category_name(category);
}

const char *dip_preview_path_title(const DipPreviewState *state, int category) {
    const bool known = category >= 0 && category < DIP_CAMTRACK_CATEGORIES;
    const char *name = known ? state->track->categories[category].name : NULL;
    return name ? name : dip_preview_category_title(category);
}

const DipCamPath *dip_preview_playing_path(const DipPreviewState *state) {
    const DipCamPath *path = state->track->categories[state->track->active].path;
    return path ? path : state->track->categories[0].path;
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

static bool has_path(const DipPreviewState *state, int category) {
    return state->track->categories[category].path != NULL;
}

void dip_state_choose_path(DipPreviewState *state, int category, int64_t now_ns) {
    if (category < 0 || category >= DIP_CAMTRACK_CATEGORIES || !has_path(state, category)) {
        dip_preview_notice(state, now_ns, "%s has no path: the ini names no CAMPATH_%s",
                           dip_preview_category_title(category),
                           dip_preview_category_name(category));
        return;
    }
    dip_camtrack_switch(state->track, category, state->play_ns);
    state->manual = false;
    dip_preview_notice(state, now_ns, "Path: %s", dip_preview_path_title(state, category));
    ++state->scene_changes;
}

void dip_state_next_path(DipPreviewState *state, int direction, int64_t now_ns) {
    if (state->shows_gallery) { // Each scene has one path, so the next scene shows.
        state->scene_step = direction;
        ++state->scene_changes;
        return;
    }
    const int from = state->track->active;
    const DipCamPath *playing = state->track->categories[from].path;
    const int count = DIP_CAMTRACK_CATEGORIES; // The cameras of the models follow the categories.
    for (int i = 1; i < count; ++i) {
        const int category = (from + direction * i + count * i) % count;
        if (has_path(state, category) && state->track->categories[category].path != playing) {
            dip_state_choose_path(state, category, now_ns);
            return;
        }
    }
    dip_preview_notice(state, now_ns, "There is only one path");
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
    // Stays in the present round of the path, on its way there.
    const int64_t past_ns = once || span_ns == 0 ? at_ns : (at_ns % span_ns + span_ns) % span_ns;
    const int64_t to_ns = state->play_ns + path_ns - past_ns;
    state->play_ns = to_ns >= 0 ? to_ns : once ? 0 : to_ns + span_ns;
    ++state->scene_changes;
}
