// Replaces the scene of the preview by another scene of the session, or by the scene of a new
// session. A new session begins after files were dropped or have changed, or after the user has
// chosen another animation.
#include "app/preview/loop/loop_private.h"

#include "app/cost/plan.h"
#include "app/preview/loop/reload.h"

#include <string.h>

void dip_loop_enter_scene(DipPreview *preview) {
    if (preview->def.measures_prices) {
        dip_live_prices_enter_scene(preview->live_prices);
    }
}

void dip_loop_follow_scene(DipPreview *preview, int64_t now_ns) {
    DipSession *session = preview->def.session;
    DipPreviewState *state = &preview->state;
    const int step = state->scene_step;
    DipError failure;
    state->scene_step = 0;
    if (session->gallery) {
        dip_gallery_set_look(session->gallery, state->look);
    }
    if (step == 0) {
        return;
    }
    dip_live_prices_leave_scene(preview->live_prices);
    if (!dip_session_step_scene(session, step, &failure)) {
        dip_loop_report(preview, &failure, now_ns);
        return;
    }
    dip_loop_enter_scene(preview);
    state->shows_gallery = session->shows_gallery;
    preview->judged_path = NULL;
    preview->tried_width = 0; // The new renderers do not have the panes' size yet.
    state->look = 0;
    state->play_ns = 0;
    state->manual = false;
    dip_pilot_enter(&state->flight, session);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        dip_figures_forget(&preview->figures, p);
    }
    dip_preview_notice(state, now_ns, "Scene: %s", dip_session_scene_title(session, 0));
    ++state->scene_changes;
}

static void follow_settings_of(const DipSession *session, DipPreviewState *state) {
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        const DipQuality begun = dip_painter_quality(session->renderers[p]);
        if (!dip_quality_equal(&begun, &state->begun_quality[p])) {
            state->quality[p] = begun;
        }
        state->begun_quality[p] = begun;
    }
}

static void follow_track(DipSession *session, DipPreviewState *state, const DipCamTrack *before,
                         bool dropped) {
    DipCamTrack *track = &session->track;
    if (dropped) {
        state->manual = false;
        dip_camtrack_restart(track, state->play_ns);
        return;
    }
    if (track->categories[before->active].path) {
        track->active = before->active;
    }
    dip_camtrack_restart(track, before->start_ns);
}

// Puts the reload's new session in the place of the old one and updates the state.
//
// The settings that the user has chosen stay, unless the new session begins with other settings
// than the old one did. This happens only if the ini file has changed or is another one. If a file
// was dropped, the camera begins the new path. Otherwise the camera stays at the same time on the
// same path, if this path still exists.
static void hand_over(DipPreview *preview, bool dropped) {
    DipSession *session = preview->def.session;
    DipPreviewState *state = &preview->state;
    const DipCamTrack before = session->track;
    const double fps_before = session->config.target_fps;
    char scene_before[DIP_COST_TEXT];
    char scene[DIP_COST_TEXT];
    dip_cost_scene_name(session, scene_before);
    dip_reload_take(preview->def.reload);
    dip_cost_scene_name(session, scene);
    if (strcmp(scene, scene_before) != 0) {
        state->costs = NULL; // The report is about the previous scene.
    }
    if (session->config.target_fps != fps_before) { // The ini is another one or has changed.
        const double fps = session->config.target_fps;
        dip_preview_set_budget(state, fps > 0.0 ? 1000.0 / fps : 0.0);
    }
    follow_settings_of(session, state);
    follow_track(session, state, &before, dropped);
    state->shows_gallery = session->shows_gallery;
    state->look = session->shows_gallery ? session->options->look : 0;
    ++state->scene_changes;
}

// Replaces the session by the new one. The threads that read the old scene end first.
static void use_new_session(DipPreview *preview, bool dropped) {
    const DipErrorReading nothing = {.status = DIP_ERROR_STATUS_PAUSED};
    DipSession *session = preview->def.session;
    preview->judged_path = NULL; // The new path may have the address of the old one.
    dip_error_thread_destroy(&preview->errors);
    preview->no_truth = false;
    dip_maps_set_errors(&preview->tools->maps, &nothing, NULL); // The thread owned the pictures.
    dip_prefetch_end(&preview->prefetch);
    preview->prefetch = (DipPrefetch){.running = false};
    dip_live_prices_leave_scene(preview->live_prices);
    hand_over(preview, dropped);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        dip_figures_forget(&preview->figures, p);
    }
    dip_loop_enter_scene(preview);
    dip_pilot_enter(&preview->state.flight, session);
    preview->tried_width = 0; // The new renderers do not have the panes' size yet.
    ++preview->picture_number;
}

// Hands the animation that the user has asked for to the reload.
static void follow_animation(DipPreview *preview, int64_t now_ns) {
    DipPreviewState *state = &preview->state;
    const int wanted = state->wanted_animation;
    if (!state->wants_animation) {
        return;
    }
    state->wants_animation = false;
    state->opens_animation =
        preview->def.reload && wanted < state->animations->count &&
        dip_reload_animate(preview->def.reload,
                           wanted < 0 ? "none" : state->animations->names[wanted]);
    if (!state->opens_animation) {
        dip_preview_notice(state, now_ns, "The animation cannot be opened");
    }
}

void dip_loop_follow_reload(DipPreview *preview, int64_t now_ns) {
    DipReloadNews news;
    follow_animation(preview, now_ns);
    if (!preview->def.reload ||
        !dip_reload_poll(preview->def.reload, preview->prices, now_ns, &news)) {
        return;
    }
    if (news.animated) {
        preview->state.opens_animation = news.kind == DIP_RELOAD_BEGUN;
    }
    if (news.kind == DIP_RELOAD_SESSION) {
        use_new_session(preview, news.dropped);
    } else if (news.kind == DIP_RELOAD_COSTS) {
        preview->state.costs = news.costs;
    }
    dip_preview_notice(&preview->state, now_ns, "%s", news.notice);
    if (news.kind == DIP_RELOAD_FAULT || news.warns) {
        dip_preview_keep_notice(&preview->state, now_ns);
    }
    preview->redraw = true;
}
