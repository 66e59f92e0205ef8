// Updates the state for a new session.
#include "app/preview/loop/handover.h"

#include "app/cost/plan.h"

#include <string.h>

static void follow_settings(const DipSession *session, DipPreviewState *state,
                            DipQuality first_quality[DIP_PANE_COUNT]) {
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        const DipQuality begun = dip_painter_quality(session->renderers[p]);
        if (memcmp(&begun, &first_quality[p], sizeof begun) != 0) {
            state->quality[p] = begun;
        }
        first_quality[p] = begun;
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

void dip_handover(DipReload *reload, DipSession *session, DipPreviewState *state,
                  DipQuality first_quality[DIP_PANE_COUNT], bool dropped) {
    const DipCamTrack before = session->track;
    const double fps_before = session->config.target_fps;
    char scene_before[DIP_COST_TEXT];
    char scene[DIP_COST_TEXT];
    dip_cost_scene_name(session, scene_before);
    dip_reload_take(reload);
    dip_cost_scene_name(session, scene);
    if (strcmp(scene, scene_before) != 0) {
        state->costs = NULL; // The report is about the other scene.
    }
    if (session->config.target_fps != fps_before) { // The user has changed the ini.
        const double fps = session->config.target_fps;
        dip_preview_set_budget(state, fps > 0.0 ? 1000.0 / fps : 0.0);
    }
    follow_settings(session, state, first_quality);
    follow_track(session, state, &before, dropped);
    state->shows_gallery = session->shows_gallery;
    state->look = session->shows_gallery ? session->options->look : 0;
    ++state->scene_changes;
}
