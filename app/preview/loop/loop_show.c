// Draws the window, presents it, and saves what it shows.
#include "app/preview/loop/loop_private.h"

#include "app/preview/tools/compare.h"
#include "app/preview/state/poses.h"
#include "app/session/picture_texts.h"
#include "app/ui/style.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool draw_view(DipPreview *preview, DipError *err) {
    const DipViewInput input = dip_loop_view_input(preview, dip_loop_clock_ns(preview));
    return dip_view_draw(preview->view, &input, err);
}

enum { MAX_SCREENSHOTS = 9999 };

static bool free_name(char *file, size_t size_bytes, DipError *err) {
    for (int i = 1; i <= MAX_SCREENSHOTS; ++i) {
        snprintf(file, size_bytes, "diptych-%04d.png", i);
        if (access(file, F_OK) != 0) {
            return true;
        }
    }
    return dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "screenshot",
                         "no name from diptych-0001.png to diptych-%04d.png is free",
                         MAX_SCREENSHOTS);
}

// Copies a pane to the column x of a picture whose rows have row_bytes bytes.
static void copy_pane(uint8_t *rgba8, size_t row_bytes, const DipFrame *pane, int x) {
    for (int y = 0; y < pane->height; ++y) {
        memcpy(rgba8 + (size_t)y * row_bytes + 4 * (size_t)x,
               pane->rgba8 + (size_t)y * pane->stride_bytes, 4 * (size_t)pane->width);
    }
}

// Joins both panes. The caller frees *rgba8. Returns false when memory runs out.
static bool join_panes(const DipFrame panes[DIP_PANE_COUNT], uint8_t **rgba8, DipFrame *joined) {
    const int right = panes[DIP_PANE_CURRENT].width + DIP_PANE_GAP_PX;
    const int width = right + panes[DIP_PANE_REQUESTED].width;
    const int height = panes[DIP_PANE_CURRENT].height;
    const size_t row_bytes = 4 * (size_t)width;
    *rgba8 = malloc(row_bytes * (size_t)height);
    if (!*rgba8) {
        return false;
    }
    for (int y = 0; y < height; ++y) {
        uint8_t *gap = *rgba8 + (size_t)y * row_bytes + 4 * (size_t)panes[DIP_PANE_CURRENT].width;
        for (int i = 0; i < DIP_PANE_GAP_PX; ++i) {
            memcpy(gap + 4 * i, &dip_style_background, 4);
        }
    }
    copy_pane(*rgba8, row_bytes, &panes[DIP_PANE_CURRENT], 0);
    copy_pane(*rgba8, row_bytes, &panes[DIP_PANE_REQUESTED], right);
    *joined =
        (DipFrame){.rgba8 = *rgba8, .stride_bytes = row_bytes, .width = width, .height = height};
    return true;
}

// Writes what the window shows (or, if the user asked for that, the panes side by side with their
// gap) to the first of diptych-0001.png, diptych-0002.png, ... that does not exist yet, with texts
// that tell how the picture was made. Fills in the file's name.
static bool save_screenshot(DipPreview *preview, char *file, size_t size_bytes, DipError *err) {
    uint8_t *rgba8 = NULL;
    const DipPixels shown = dip_view_picture(preview->view);
    DipFrame picture = {.rgba8 = shown.rgba8,
                        .stride_bytes = shown.stride_bytes,
                        .width = shown.width,
                        .height = shown.height};
    DipPictureTexts texts;
    if (!free_name(file, size_bytes, err)) {
        return false;
    }
    if (preview->state.plain_screenshot && !join_panes(preview->frame.panes, &rgba8, &picture)) {
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, "screenshot", "out of memory");
    }
    dip_picture_texts_make(&texts, preview->def.session, &preview->drawn.pose,
                           preview->drawn.play_ns, preview->state.manual);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        dip_picture_texts_add_pane(&texts, p, &preview->drawn_quality[p], &preview->frame.panes[p]);
    }
    const bool written = dip_png_write_with_texts(file, &picture, texts.items, texts.count, err);
    free(rgba8);
    return written;
}

static void save_picture(DipPreview *preview, int64_t now_ns) {
    DipPreviewState *state = &preview->state;
    char file[64];
    char text[DIP_NOTICE_SIZE];
    DipError err;
    state->screenshot = false;
    if (save_screenshot(preview, file, sizeof file, &err)) {
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

static void *run_prefetch(void *context) {
    const DipPrefetch *prefetch = context;
    // If memory runs out here, the frame that needs the textures tries again and reports the error.
    DipError err;
    (void)dip_scene_compress_textures(prefetch->scene, NULL, &err);
    return NULL;
}

// Starts the thread; a second call does nothing. The scene must outlive dip_prefetch_end.
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
        begin_prefetch(&preview->prefetch, preview->def.session->scene);
    }
    dip_figures_count_presented(&preview->figures, moving, preview->refresh_ns,
                                dip_loop_clock_ns(preview));
    update_tools(preview);
    preview->blinks_ns = dip_compare_wakes_ns(&preview->state.tools, now_ns);
    return true;
}
