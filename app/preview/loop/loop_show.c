// Draws the window, presents it, and saves what it shows.
#include "app/preview/loop/loop_private.h"

#include "app/preview/tools/compare.h"
#include "app/preview/state/poses.h"
#include "app/preview/loop/screenshot.h"

#include <stdio.h>
#include <string.h>

static bool draw_view(DipPreview *preview, DipError *err) {
    const DipViewInput input = dip_loop_view_input(preview, dip_loop_clock_ns(preview));
    return dip_view_draw(preview->view, &input, err);
}

static void save_picture(DipPreview *preview, int64_t now_ns) {
    DipPreviewState *state = &preview->state;
    const DipPixels picture = dip_view_picture(preview->view);
    const DipScreenshot shot = {
        .picture = state->plain_screenshot ? NULL : &picture,
        .session = preview->def.session,
        .frame = &preview->frame,
        .quality = preview->drawn_quality,
        .pose = &preview->drawn.pose,
        .time_ns = preview->drawn.play_ns,
        .free_camera = state->manual,
    };
    char file[64];
    char text[DIP_NOTICE_SIZE];
    DipError err;
    state->screenshot = false;
    if (dip_screenshot_save(&shot, file, sizeof file, &err)) {
        dip_saved_describe("Saved", file, text, sizeof text);
        dip_preview_notice(state, now_ns, "%s", text);
    } else {
        dip_loop_report(preview, &err, now_ns);
    }
}

void dip_loop_save_pose(DipPreview *preview, int64_t now_ns) {
    DipPreviewState *state = &preview->state;
    size_t count = 0;
    DipError err;
    state->save_pose = false;
    if (dip_poses_append(DIP_POSES_FILE, &preview->drawn.pose, &count, &err)) {
        char what[64];
        char text[DIP_NOTICE_SIZE];
        snprintf(what, sizeof what, "Saved pose %zu to", count);
        dip_saved_describe(what, DIP_POSES_FILE, text, sizeof text);
        dip_preview_notice(state, now_ns, "%s", text);
    } else {
        dip_loop_report(preview, &err, now_ns);
    }
    preview->redraw = true;
}

static bool present(DipPreview *preview, DipError *err) {
    const DipDisplay *display = &preview->def.display;
    if (preview->exposed) {
        dip_view_damage_all(preview->view);
        preview->exposed = false;
    }
    const DipPixels picture = dip_view_picture(preview->view);
    const DipDamage damage = dip_view_take_damage(preview->view);
    if (display->set_text) {
        const DipTextScreen *screen = &preview->text.screen;
        display->set_text(display->context, screen->cells, screen->columns, screen->rows);
    }
    return display->present(display->context, &picture, damage.rects, damage.count, err);
}

void dip_loop_paste_settings(DipPreview *preview, int64_t now_ns) {
    const DipDisplay *display = &preview->def.display;
    DipPreviewState *state = &preview->state;
    DipQuality quality;
    DipError err;
    char text[512];
    if (!state->paste_settings) {
        return;
    }
    state->paste_settings = false;
    if (!display->get_clipboard || !display->get_clipboard(display->context, text, sizeof text)) {
        dip_preview_notice(state, now_ns, "The clipboard holds no text");
        return;
    }
    text[strcspn(text, " \t\r\n")] = '\0';
    if (!dip_quality_parse(text, &quality, &err)) {
        dip_loop_report(preview, &err, now_ns);
        return;
    }
    dip_preview_set_quality(state, DIP_PANE_REQUESTED, &quality, now_ns);
    dip_preview_notice(state, now_ns, "Pasted: %.120s", text);
}

void dip_loop_copy_settings(DipPreview *preview, int64_t now_ns) {
    const DipDisplay *display = &preview->def.display;
    char text[256];
    if (!preview->state.copy_settings) {
        return;
    }
    preview->state.copy_settings = false;
    dip_quality_format(&preview->state.quality[DIP_PANE_REQUESTED], text, sizeof text);
    if (display->set_clipboard && display->set_clipboard(display->context, text)) {
        dip_preview_notice(&preview->state, now_ns, "Copied: %s", text);
    } else {
        dip_preview_notice(&preview->state, now_ns, "This display has no clipboard: %s", text);
    }
}

// Lets the tools draw what the window has asked them for.
static void update_tools(DipPreview *preview) {
    const DipFrame *frame = &preview->frame.panes[DIP_PANE_CURRENT];
    const DipToolsInput input = {
        .session = preview->def.session,
        .pose = &preview->drawn.pose,
        .play_ns = preview->drawn.play_ns,
        .frame_index = preview->frame_index - 1,
        .versions = {dip_view_version(preview->view, DIP_PANE_CURRENT),
                     dip_view_version(preview->view, DIP_PANE_REQUESTED)},
        .width = frame->width,
        .height = frame->height,
        .copied = preview->frame.copied,
        .still = dip_preview_rests(&preview->state, preview->flying),
    };
    preview->redraw |= dip_tools_update(preview->tools, &input);
}

bool dip_loop_show(DipPreview *preview, int64_t now_ns, DipError *err) {
    const bool moving = !dip_preview_rests(&preview->state, preview->flying);
    dip_figures_update(&preview->figures, moving, now_ns);
    dip_loop_judge_taa(preview, now_ns);
    if (!draw_view(preview, err)) {
        return false;
    }
    if (preview->state.screenshot) {
        save_picture(preview, now_ns);
        if (!draw_view(preview, err)) { // Adds the notice that names the file.
            return false;
        }
    }
    preview->redraw = false;
    if (!present(preview, err)) {
        return false;
    }
    dip_start_times_frame(&preview->def.session->times);
    if (preview->def.session->scene) {
        dip_prefetch_begin(&preview->prefetch, preview->def.session->scene);
    }
    dip_figures_count_presented(&preview->figures, moving, preview->refresh_ns,
                                dip_loop_clock_ns(preview));
    update_tools(preview);
    preview->blinks_ns = dip_compare_wakes_ns(&preview->state.tools, now_ns);
    return true;
}
