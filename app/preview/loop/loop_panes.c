// Draws the panes' frames: with which settings, at which size, from which pose.
#include "app/preview/loop/loop_private.h"

#include "app/preview/tools/compare.h"

#include <string.h>

// Sets the renderers to the panes' settings. If a pane's settings change, forgets the pane's
// times.
static bool follow_settings(DipPreview *preview, DipError *err) {
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        const DipQuality *wanted = &preview->state.quality[p];
        if (memcmp(wanted, &preview->drawn_quality[p], sizeof *wanted) == 0) {
            continue;
        }
        if (!dip_painter_set_quality(preview->def.session->renderers[p], wanted, err)) {
            return false;
        }
        preview->drawn_quality[p] = *wanted;
        dip_figures_forget(&preview->figures, p);
    }
    return true;
}

static bool fail(const DipError *failure, DipError *err) {
    if (err) {
        *err = *failure;
    }
    return false;
}

static bool resize_panes(DipPreview *preview, int width, int height, DipError *err) {
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        if (!dip_painter_resize(preview->def.session->renderers[p], width, height, err)) {
            return false;
        }
    }
    return true;
}

// Goes back to the size of the last frame, after memory ran out for a new size. The view scales
// the frames to the panes. Returns false if there was no frame.
static bool keep_size(DipPreview *preview, DipError *err) {
    if (err->code != DIP_ERROR_MEMORY || preview->picture_number == 0) {
        return false;
    }
    dip_loop_report(preview, err, dip_loop_clock_ns(preview));
    return resize_panes(preview, preview->drawn.width, preview->drawn.height, err);
}

// Sets the renderers to the panes' size. A frame's size is limited; if the display is larger,
// the view scales the frame up.
static bool follow_size(DipPreview *preview, DipError *err) {
    const DipViewInput input = dip_loop_view_input(preview, dip_loop_clock_ns(preview));
    const DipLayout layout = dip_view_layout(&input);
    int width, height;
    dip_compare_frame_size(&layout, preview->state.tools.comparison, &width, &height);
    width = width < DIP_MAX_FRAME_SIZE ? width : DIP_MAX_FRAME_SIZE;
    height = height < DIP_MAX_FRAME_SIZE ? height : DIP_MAX_FRAME_SIZE;
    if (width == preview->tried_width && height == preview->tried_height) {
        return true;
    }
    DipError failure;
    if (!resize_panes(preview, width, height, &failure) && !keep_size(preview, &failure)) {
        return fail(&failure, err);
    }
    preview->tried_width = width;
    preview->tried_height = height;
    return true;
}

static void number_picture(DipPreview *preview) {
    Drawn drawn;
    memset(&drawn, 0, sizeof drawn); // memcmp compares the padding, too.
    drawn.pose = preview->pose;
    drawn.play_ns = preview->state.play_ns;
    drawn.width = preview->frame.panes[0].width;
    drawn.height = preview->frame.panes[0].height;
    drawn.look = preview->drawn_look;
    drawn.gallery = preview->def.session->gallery;
    memcpy(drawn.quality, preview->drawn_quality, sizeof drawn.quality);
    if (memcmp(&drawn, &preview->drawn, sizeof drawn) != 0) {
        preview->drawn = drawn;
        ++preview->picture_number;
    }
}

static bool draw_with_settings(DipPreview *preview, DipError *err) {
    return follow_settings(preview, err) &&
           dip_session_draw_pose(preview->def.session, &preview->pose, preview->state.play_ns,
                                 preview->frame_index, &preview->frame, err);
}

// Draws with the settings of the last frame, after memory ran out for new settings. Returns
// false if the settings were not new.
static bool take_back_settings(DipPreview *preview, DipError *err) {
    const size_t size_bytes = sizeof preview->drawn.quality;
    if (err->code != DIP_ERROR_MEMORY || preview->picture_number == 0 ||
        memcmp(preview->state.quality, preview->drawn.quality, size_bytes) == 0) {
        return false;
    }
    dip_loop_report(preview, err, dip_loop_clock_ns(preview));
    memcpy(preview->state.quality, preview->drawn.quality, size_bytes);
    return draw_with_settings(preview, err);
}

bool dip_loop_draw_panes(DipPreview *preview, DipError *err) {
    DipSession *session = preview->def.session;
    const int64_t play_ns = preview->state.play_ns;
    if (!follow_size(preview, err)) {
        return false;
    }
    preview->state.scene_title =
        session->shows_gallery ? dip_session_scene_title(session, play_ns) : NULL;
    preview->state.scene_look = session->shows_gallery
                                    ? dip_session_scene_look(session, preview->state.look, play_ns)
                                    : NULL;
    if (!preview->state.manual && !dip_camtrack_pose(&session->track, play_ns, &preview->pose)) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "path", "there is no camera path");
    }
    DipError failure;
    if (!draw_with_settings(preview, &failure) && !take_back_settings(preview, &failure)) {
        return fail(&failure, err);
    }
    number_picture(preview);
    dip_scene_words(preview->def.session->options, preview->state.scene_words);
    preview->state.pane_width = preview->frame.panes[0].width;
    preview->state.pane_height = preview->frame.panes[0].height;
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        dip_view_set_frame(preview->view, p, &preview->frame.panes[p]);
    }
    dip_figures_add(&preview->figures, &preview->frame, dip_loop_clock_ns(preview));
    preview->drawn_changes = preview->state.scene_changes;
    preview->resized = false;
    ++preview->frame_index;
    return true;
}

// Returns whether temporal antialiasing changes a pane's picture from frame to frame even if
// nothing moves.
static bool pane_alternates(const DipPreview *preview, int pane) {
    const DipQuality *quality = &preview->state.quality[pane];
    return quality->step[DIP_SETTING_TAA] != 0 && dip_quality_sample_count(quality) > 1;
}

bool dip_loop_alternates(const DipPreview *preview) {
    return pane_alternates(preview, DIP_PANE_CURRENT) ||
           pane_alternates(preview, DIP_PANE_REQUESTED);
}

void dip_loop_judge_taa(DipPreview *preview, int64_t now_ns) {
    const DipTaaSpeed speed =
        dip_taa_pace_update(&preview->taa_pace, dip_loop_alternates(preview),
                            &preview->figures.presented, preview->refresh_ns, now_ns);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        DipTaaSpeed *shown = &preview->figures.shown[p].taa_speed;
        if (!pane_alternates(preview, p)) {
            *shown = (DipTaaSpeed){.too_slow = false};
        } else if (preview->figures.updated_ns == now_ns) {
            *shown = speed;
        }
    }
}
