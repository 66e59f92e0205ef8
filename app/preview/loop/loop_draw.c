// Draws the panes' frames, draws and presents the window, and saves pictures and poses to files.
#include "app/preview/loop/loop_private.h"

#include "app/preview/state/poses.h"
#include "app/preview/tools/compare.h"
#include "app/session/picture_texts.h"
#include "app/ui/style.h"

#include <stdio.h>
#include <string.h>

// --- the panes' frames ---------------------------------------------------------------------------

// Gives the renderers the panes' settings. If a pane's settings have changed, forgets the pane's
// times.
static bool follow_settings(DipPreview *preview, DipError *err) {
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        DipPainter *painter = preview->def.session->renderers[p];
        const DipQuality before = dip_painter_quality(painter);
        const DipQuality *wanted = &preview->state.quality[p];
        if (dip_quality_equal(wanted, &before)) {
            continue;
        }
        if (!dip_painter_set_quality(painter, wanted, err)) {
            return false;
        }
        dip_figures_forget(&preview->figures, p);
    }
    return true;
}

static bool resize_panes(DipPreview *preview, int width, int height, DipError *err) {
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        if (!dip_painter_resize(preview->def.session->renderers[p], width, height, err)) {
            return false;
        }
    }
    return true;
}

// If memory has run out for a new size, goes back to the size of the last frame, which the view
// scales to the panes. Returns false after any other error, if there was no frame, or if the old
// size fails, too.
static bool keep_size(DipPreview *preview, DipError *err) {
    if (err->code != DIP_ERROR_MEMORY || preview->picture_number == 0) {
        return false;
    }
    dip_loop_report(preview, err, dip_loop_clock_ns(preview));
    return resize_panes(preview, preview->drawn.width, preview->drawn.height, err);
}

// Gives the renderers the panes' size. A frame's size is limited to DIP_MAX_FRAME_SIZE; if a pane
// is larger, the view scales the frame up.
static bool follow_size(DipPreview *preview, DipError *err) {
    const int width = dip_min(preview->pane_width, DIP_MAX_FRAME_SIZE);
    const int height = dip_min(preview->pane_height, DIP_MAX_FRAME_SIZE);
    if (width == preview->tried_width && height == preview->tried_height) {
        return true;
    }
    if (!resize_panes(preview, width, height, err) && !keep_size(preview, err)) {
        return false;
    }
    preview->tried_width = width;
    preview->tried_height = height;
    return true;
}

static void number_picture(DipPreview *preview) {
    Drawn drawn;
    memset(&drawn, 0, sizeof drawn); // Clears the padding, which memcmp compares, too.
    drawn.pose = preview->pose;
    drawn.play_ns = preview->state.play_ns;
    drawn.width = preview->frame.panes[0].width;
    drawn.height = preview->frame.panes[0].height;
    drawn.look = preview->state.look;
    drawn.gallery = preview->def.session->gallery;
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        drawn.quality[p] = dip_painter_quality(preview->def.session->renderers[p]);
    }
    if (memcmp(&drawn, &preview->drawn, sizeof drawn) != 0) {
        preview->drawn = drawn;
        ++preview->picture_number;
    }
}

// Draws both panes with their settings. The panes share shading while frames follow each other and
// the time of each pane's settings is known. They do not share it in a single frame or in the first
// frame with new settings, so these frames give the times of both panes.
static bool draw_with_settings(DipPreview *preview, DipError *err) {
    if (!follow_settings(preview, err)) {
        return false;
    }
    preview->def.session->shares_shading = !dip_preview_rests(&preview->state, preview->flying) &&
                                           dip_figures_have_times(&preview->figures);
    return dip_session_draw_pose(preview->def.session, &preview->pose, preview->state.play_ns,
                                 preview->frame_index, &preview->frame, err);
}

// If memory has run out for new settings, draws with the settings of the last frame. Returns false
// after any other error, if the settings were not new, or if drawing fails again.
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

bool dip_loop_settles(const DipPreview *preview) {
    const DipQuality *quality = preview->state.quality;
    return preview->settling > 0 && preview->def.session->scene &&
           (dip_quality_has_history(&quality[DIP_PANE_CURRENT]) ||
            dip_quality_has_history(&quality[DIP_PANE_REQUESTED]));
}

// Lets the renderers' histories (taa=history) begin anew after a jump in time or to another path.
static void cut_at_jumps(DipPreview *preview) {
    const DipCamPath *path = dip_preview_playing_path(&preview->state);
    const int64_t passed_ns = preview->state.play_ns - preview->drawn.play_ns;
    if (path != preview->drawn_path || passed_ns < 0 || passed_ns > DIP_LOOP_LONGEST_STEP_NS) {
        for (int p = 0; p < DIP_PANE_COUNT; ++p) {
            dip_painter_cut(preview->def.session->renderers[p]);
        }
    }
    preview->drawn_path = path;
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
    cut_at_jumps(preview);
    if (!draw_with_settings(preview, err) && !take_back_settings(preview, err)) {
        return false;
    }
    const bool changed = preview->state.scene_changes != preview->drawn_changes || preview->resized;
    preview->settling = changed ? DIP_FRAMES_BEFORE : preview->settling - (preview->settling > 0);
    number_picture(preview);
    dip_scene_words(session->options, preview->state.look, preview->state.scene_words);
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

// Returns whether a pane's sample patterns alternate (taa=alternate), so that its picture changes
// from frame to frame even if nothing moves.
static bool pane_alternates(const DipPreview *preview, int pane) {
    const DipQuality *quality = &preview->state.quality[pane];
    return dip_quality_alternates(quality) && dip_quality_sample_count(quality) > 1;
}

bool dip_loop_alternates(const DipPreview *preview) {
    return pane_alternates(preview, DIP_PANE_CURRENT) ||
           pane_alternates(preview, DIP_PANE_REQUESTED);
}

// Writes into the figures of each pane (taa_speed) whether frames come fast enough for alternating
// sample patterns. taa_speed changes only as often as the other figures, and is cleared for a pane
// without such patterns.
static void judge_taa(DipPreview *preview, int64_t now_ns) {
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

// --- files that the user saves -------------------------------------------------------------------

// Draws both panes' frames side by side into *joined, with the gap between them.
static bool join_panes(const DipFrame panes[DIP_PANE_COUNT], DipCanvas *joined, DipError *err) {
    const DipFrame *current = &panes[DIP_PANE_CURRENT], *requested = &panes[DIP_PANE_REQUESTED];
    const int right = current->width + DIP_PANE_GAP_PX, width = right + requested->width;
    if (!dip_canvas_resize(joined, width, current->height, err)) {
        return false;
    }
    dip_canvas_fill(joined, (DipRect){0, 0, width, current->height}, dip_style_background);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        const DipPixels pane = dip_frame_pixels(&panes[p]);
        const int x = p == DIP_PANE_CURRENT ? 0 : right;
        dip_canvas_copy(joined, (DipRect){x, 0, pane.width, pane.height}, &pane);
    }
    return true;
}

// Writes what the window shows to a PNG file. If the user asked for a plain picture, writes only
// the panes side by side, with their gap. The file's name is the first of diptych-0001.png to
// diptych-9999.png that no file has yet. Text entries in the file tell how the picture was made.
// Writes the name to `file`.
static bool save_screenshot(DipPreview *preview, char *file, size_t size_bytes, DipError *err) {
    const bool plain = preview->state.plain_screenshot;
    DipCanvas joined = {0};
    DipPictureTexts texts;
    if (!dip_saved_free_name("diptych", "png", file, size_bytes)) {
        return dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "screenshot",
                             "no name from diptych-0001.png to diptych-9999.png is free");
    }
    if (plain && !join_panes(preview->frame.panes, &joined, err)) {
        return false;
    }
    const DipPixels shown = plain ? dip_canvas_pixels(&joined) : dip_view_picture(preview->view);
    const DipFrame picture = {.rgba8 = shown.rgba8,
                              .stride_bytes = shown.stride_bytes,
                              .width = shown.width,
                              .height = shown.height};
    dip_picture_texts_make(&texts, preview->def.session, &preview->drawn.pose,
                           preview->drawn.play_ns, preview->state.manual);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        dip_picture_texts_add_pane(&texts, p, &preview->drawn.quality[p], &preview->frame.panes[p]);
    }
    const bool written = dip_png_write_with_texts(file, &picture, texts.items, texts.count, err);
    dip_canvas_free(&joined);
    return written;
}

// Shows a notice that names the saved file or describes the error.
static void tell_saved(DipPreview *preview, bool saved, const char *what, const char *file,
                       const DipError *err, int64_t now_ns) {
    char text[DIP_NOTICE_SIZE];
    if (saved) {
        dip_saved_describe(what, file, text, sizeof text);
        dip_preview_notice(&preview->state, now_ns, "%s", text);
    } else {
        dip_loop_report(preview, err, now_ns);
    }
}

static void save_picture(DipPreview *preview, int64_t now_ns) {
    char file[64];
    DipError err;
    preview->state.screenshot = false;
    const bool saved = save_screenshot(preview, file, sizeof file, &err);
    tell_saved(preview, saved, "Saved", file, &err, now_ns);
}

void dip_loop_save_pose(DipPreview *preview, int64_t now_ns) {
    char what[64];
    size_t count = 0;
    DipError err;
    preview->state.save_pose = false;
    const bool saved = dip_poses_append(DIP_POSES_FILE, &preview->drawn.pose, &count, &err);
    snprintf(what, sizeof what, "Saved pose %zu to", count);
    tell_saved(preview, saved, what, DIP_POSES_FILE, &err, now_ns);
    preview->redraw = true;
}

// --- the window ----------------------------------------------------------------------------------

static bool draw_view(DipPreview *preview, DipError *err) {
    const DipViewInput input = dip_loop_view_input(preview, dip_loop_clock_ns(preview));
    return dip_view_draw(preview->view, &input, err);
}

static bool present(DipPreview *preview, DipError *err) {
    const DipDisplay *display = &preview->def.display;
    const DipPixels picture = dip_view_picture(preview->view);
    const DipDamage damage = dip_view_take_damage(preview->view, preview->exposed);
    preview->exposed = false;
    if (display->set_text) {
        const DipTextScreen *screen = &preview->text.screen;
        display->set_text(display->context, screen->cells, screen->columns, screen->rows);
    }
    return display->present(display->context, &picture, damage.rects, damage.count, err);
}

static void *run_prefetch(void *context) {
    const DipPrefetch *prefetch = context;
    // If memory runs out here, the frame that needs the textures tries again and reports the error.
    DipError err;
    (void)dip_scene_compress_textures(prefetch->scene, NULL, &err);
    return NULL;
}

// Starts the thread that prepares textures; a second call does nothing. The scene must live until
// dip_prefetch_end.
static void begin_prefetch(DipPrefetch *prefetch, const DipScene *scene) {
    if (prefetch->scene) {
        return;
    }
    prefetch->scene = scene;
    prefetch->running = pthread_create(&prefetch->thread, NULL, run_prefetch, prefetch) == 0;
}

void dip_prefetch_end(DipPrefetch *prefetch) {
    if (prefetch->running) {
        pthread_join(prefetch->thread, NULL);
        prefetch->running = false;
    }
}

// Lets the loupe, the strip of thumbnails and the maps do the work that the window has asked for.
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
        .loupe = dip_loupe_is_on(&preview->state.tools),
    };
    preview->redraw |= dip_tools_update(preview->tools, &input);
}

bool dip_loop_show(DipPreview *preview, int64_t now_ns, DipError *err) {
    const bool moving = !dip_preview_rests(&preview->state, preview->flying);
    dip_figures_update(&preview->figures, moving, now_ns);
    judge_taa(preview, now_ns);
    if (!draw_view(preview, err)) {
        return false;
    }
    if (preview->state.screenshot) {
        save_picture(preview, now_ns);
        if (!draw_view(preview, err)) { // Shows the notice that names the file or the error.
            return false;
        }
    }
    preview->redraw = false;
    if (!present(preview, err)) {
        return false;
    }
    dip_start_times_frame(&preview->def.session->times);
    if (preview->def.session->scene) {
        begin_prefetch(&preview->prefetch, preview->def.session->scene);
    }
    dip_figures_count_presented(&preview->figures, moving, preview->refresh_ns,
                                dip_loop_clock_ns(preview));
    update_tools(preview);
    preview->blinks_ns = dip_compare_wakes_ns(&preview->state.tools, now_ns);
    return true;
}
