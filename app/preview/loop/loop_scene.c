// Replaces the scene: the gallery's next one, or a session of files that were dropped or have
// changed.
#include "app/preview/loop/loop_private.h"

#include "app/preview/loop/handover.h"
#include "app/preview/state/speed.h"

void dip_loop_follow_scene(DipPreview *preview, int64_t now_ns) {
    DipSession *session = preview->def.session;
    DipPreviewState *state = &preview->state;
    const int step = state->scene_step;
    DipError failure;
    state->scene_step = 0;
    if (step == 0) {
        if (session->gallery && state->look != preview->drawn_look) {
            dip_gallery_set_look(session->gallery, state->look);
            preview->drawn_look = state->look;
        }
        return;
    }
    if (preview->live_prices) {
        dip_live_prices_leave_scene(preview->live_prices);
    }
    if (!dip_session_step_scene(session, step, &failure)) {
        dip_loop_report(preview, &failure, now_ns);
        return;
    }
    if (preview->live_prices) {
        dip_live_prices_enter_scene(preview->live_prices);
    }
    state->shows_gallery = session->shows_gallery;
    preview->judged_path = NULL;
    preview->tried_width = 0; // the new renderers do not have the panes' size yet
    state->look = preview->drawn_look = 0;
    state->play_ns = 0;
    state->manual = false;
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        dip_figures_forget(&preview->figures, p);
    }
    dip_preview_notice(state, now_ns, "Scene: %s", dip_session_scene_title(session, 0));
    ++state->scene_changes;
}

// Replaces the session by the new one. The threads that read the old scene end first.
static void use_new_session(DipPreview *preview, bool dropped) {
    const DipErrorReading nothing = {.status = DIP_ERROR_STATUS_PAUSED};
    DipSession *session = preview->def.session;
    preview->judged_path = NULL; // The new path may lie where the old one lay.
    dip_error_thread_destroy(&preview->errors);
    preview->no_truth = false;
    dip_loop_show_errors(preview, &nothing); // The pictures of the errors were the thread's.
    dip_prefetch_end(&preview->prefetch);
    preview->prefetch = (DipPrefetch){.running = false};
    if (preview->live_prices) {
        dip_live_prices_leave_scene(preview->live_prices);
    }
    dip_handover(preview->def.reload, session, &preview->state, preview->first_quality, dropped);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        preview->drawn_quality[p] = dip_painter_quality(session->renderers[p]);
        dip_figures_forget(&preview->figures, p);
    }
    if (preview->live_prices) {
        dip_live_prices_enter_scene(preview->live_prices);
    }
    preview->drawn_look = preview->state.look;
    preview->def.flying_speed_m_per_s = dip_flying_speed(session);
    dip_pilot_enter(&preview->state.flight, session);
    preview->tried_width = 0; // The new renderers do not have the panes' size yet.
    ++preview->picture_number;
}

void dip_loop_follow_reload(DipPreview *preview, int64_t now_ns) {
    DipReloadNews news;
    if (!preview->def.reload || !dip_reload_poll(preview->def.reload, now_ns, &news)) {
        return;
    }
    if (news.kind == DIP_RELOAD_SESSION) {
        use_new_session(preview, news.dropped);
    } else if (news.kind == DIP_RELOAD_COSTS) {
        preview->state.costs = dip_reload_costs(preview->def.reload);
        preview->state.next_advice = 0;
    }
    dip_preview_notice(&preview->state, now_ns, "%s", news.notice);
    preview->redraw = true;
}
