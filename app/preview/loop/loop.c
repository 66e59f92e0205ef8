// Runs the turns of the preview.
#include "app/preview/loop/loop_private.h"

#include "app/cost/plan.h"
#include "app/preview/tools/compare.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// After a stall, the camera moves on by at most this time, so that it does not jump.
static const int64_t longest_step_ns = 250000000;
static const int64_t ns_per_ms = 1000000;
enum { IDLE_WAIT_MS = 30 };

int64_t dip_loop_clock_ns(const DipPreview *preview) {
    return preview->def.display.now_ns(preview->def.display.context);
}

static void follow_refresh(DipPreview *preview) {
    const double hz = preview->def.display.refresh_hz(preview->def.display.context);
    preview->refresh_ns = (int64_t)(1e9 / hz);
    dip_preview_follow_refresh(&preview->state, 1000.0 / hz);
}

static bool create_live_prices(DipPreview *preview, DipError *err) {
    if (!preview->def.measures_prices) {
        return true;
    }
    preview->live_prices = dip_live_prices_create(preview->def.session, preview->prices, err);
    if (preview->live_prices) {
        dip_live_prices_enter_scene(preview->live_prices);
    }
    return preview->live_prices != NULL;
}

DipPreview *dip_preview_create(const DipPreviewDef *def, DipError *err) {
    DipPreview *preview = calloc(1, sizeof *preview);
    if (!preview) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "preview", "out of memory");
        return NULL;
    }
    preview->def = *def;
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        preview->drawn_quality[p] = dip_painter_quality(def->session->renderers[p]);
    }
    memcpy(preview->first_quality, preview->drawn_quality, sizeof preview->first_quality);
    preview->state = dip_preview_state_make(preview->drawn_quality, &def->session->track);
    preview->state.costs = def->costs;
    preview->state.choice = &preview->choice;
    preview->state.in_terminal = def->display.set_text != NULL;
    dip_scene_words(def->session->options, preview->state.scene_words);
    preview->state.shows_gallery = def->session->shows_gallery;
    dip_pilot_enter(&preview->state.flight, def->session);
    if (def->session->shows_gallery) {
        preview->state.look = preview->drawn_look = def->session->options->look;
    }
    preview->resized = true;
    preview->figures.outdated = true;
    preview->turn_ns = dip_loop_clock_ns(preview);
    follow_refresh(preview);
    if (def->session->config.target_fps > 0.0) {
        dip_preview_set_budget(&preview->state, 1000.0 / def->session->config.target_fps);
    }
    if (def->notice) {
        dip_preview_notice(&preview->state, preview->turn_ns, "%s", def->notice);
    }
    preview->view = dip_view_create(def->display.set_text ? &preview->text : NULL, err);
    preview->prices = def->prices || !preview->view ? def->prices : dip_prices_create(err);
    preview->tools = preview->view && preview->prices ? dip_tools_create(err) : NULL;
    preview->editor = preview->tools ? dip_path_editor_create(err) : NULL;
    preview->state.editor = preview->editor;
    if (!preview->editor || !create_live_prices(preview, err)) {
        dip_preview_destroy(&preview);
        return NULL;
    }
    if (def->ui_scale > 0.0) {
        preview->state.tools.ui_scale = def->ui_scale;
        preview->state.tools.fixed_scale = true;
    }
    preview->state.tools.bare = def->hides_panel;
    // An open drawer would cover the current pane.
    preview->state.tools.open = dip_preview_layout(preview).side == DIP_DOCK_BELOW;
    return preview;
}

void dip_preview_destroy(DipPreview **preview_pointer) {
    DipPreview *preview = *preview_pointer;
    if (!preview) {
        return;
    }
    *preview_pointer = NULL;
    dip_error_thread_destroy(&preview->errors);
    dip_prefetch_end(&preview->prefetch);
    dip_path_editor_destroy(&preview->editor);
    dip_tools_destroy(&preview->tools);
    dip_live_prices_destroy(&preview->live_prices);
    if (!preview->def.prices) {
        dip_prices_destroy(&preview->prices);
    }
    dip_preview_choice_free(&preview->choice);
    dip_view_destroy(&preview->view);
    dip_text_view_free(&preview->text);
    free(preview);
}

DipViewInput dip_loop_view_input(DipPreview *preview, int64_t now_ns) {
    const DipDisplay *display = &preview->def.display;
    DipViewInput input = {
        .scale = display->scale(display->context),
        .now_ns = now_ns,
        .state = &preview->state,
        .figures = preview->figures.shown,
        .prices = preview->prices,
        .tools = preview->tools,
        .text = display->set_text ? &preview->text : NULL,
        .still = dip_preview_rests(&preview->state, preview->flying),
    };
    display->size(display->context, &input.width, &input.height);
    return input;
}

void dip_loop_report(DipPreview *preview, const DipError *err, int64_t now_ns) {
    char line[512];
    dip_error_format(err, line, sizeof line);
    dip_preview_notice(&preview->state, now_ns, "%.120s", line);
}

static void follow_full_screen(DipPreview *preview) {
    const DipDisplay *display = &preview->def.display;
    if (preview->state.full_screen == preview->full_screen) {
        return;
    }
    preview->full_screen = preview->state.full_screen;
    if (display->set_full_screen) {
        display->set_full_screen(display->context, preview->full_screen);
    }
}

// Notices whether the panes have another size, because the dock was opened or folded, or because
// settings in characters show or hide.
static void follow_layout(DipPreview *preview) {
    const DipLayout layout = dip_preview_layout(preview);
    int width, height;
    dip_compare_frame_size(&layout, preview->state.tools.comparison, &width, &height);
    preview->resized |= width != preview->pane_width || height != preview->pane_height;
    preview->pane_width = width;
    preview->pane_height = height;
}

// Follows the prices and the budget in what can be chosen. Returns whether that is new.
static bool choose(DipPreview *preview) {
    const DipPreviewState *state = &preview->state;
    return dip_preview_choose(&preview->choice, preview->prices,
                              &state->quality[DIP_PANE_REQUESTED], state->budget_ms);
}

// Names the scene in the window's title.
static void follow_title(DipPreview *preview) {
    const DipSession *session = preview->def.session;
    const DipDisplay *display = &preview->def.display;
    char scene[DIP_COST_TEXT], title[sizeof preview->title];
    if (!display->set_title || !session->options) {
        return;
    }
    if (session->shows_gallery) {
        snprintf(scene, sizeof scene, "%s",
                 dip_session_scene_title(session, preview->state.play_ns));
    } else {
        dip_cost_scene_name(session, scene);
    }
    snprintf(title, sizeof title, "Diptych: %.*s", (int)sizeof title - 16, scene);
    if (strcmp(title, preview->title) != 0) {
        memcpy(preview->title, title, sizeof title);
        display->set_title(display->context, title);
    }
}

// Finds out whether anything moves, when another path or scene plays.
static void follow_motion(DipPreview *preview) {
    const DipSession *session = preview->def.session;
    const DipCamPath *path = dip_preview_playing_path(&preview->state);
    if (path != preview->judged_path || session->scene != preview->judged_scene) {
        preview->judged_path = path;
        preview->judged_scene = session->scene;
        preview->state.stands = !session->shows_gallery && session->scene &&
                                !dip_scene_moves(session->scene) &&
                                dip_preview_path_stands(&preview->state);
    }
}

// Draws and presents the picture if something has changed. Sets *shown to whether something has
// changed.
static bool draw_turn(DipPreview *preview, int64_t now_ns, bool *shown, DipError *err) {
    DipPreviewState *state = &preview->state;
    const bool had_notice = state->notice[0] != '\0';
    const int64_t since_ns = now_ns - preview->turn_ns;
    const int64_t elapsed_ns = since_ns < longest_step_ns ? since_ns : longest_step_ns;
    preview->turn_ns = now_ns;
    follow_motion(preview);
    follow_title(preview);
    dip_loop_fly(preview, elapsed_ns);
    dip_preview_advance(state, elapsed_ns, now_ns);
    follow_full_screen(preview);
    dip_loop_copy_settings(preview, now_ns);
    dip_loop_paste_settings(preview, now_ns);
    dip_loop_follow_scene(preview, now_ns);
    dip_loop_follow_reload(preview, now_ns);
    preview->redraw |= choose(preview);
    follow_layout(preview);
    if (preview->resized) {
        follow_refresh(preview);
    }
    const bool new_frame = state->scene_changes != preview->drawn_changes || preview->resized ||
                           dip_loop_alternates(preview);
    if (new_frame && !dip_loop_draw_panes(preview, err)) {
        return false;
    }
    if (state->save_pose) {
        dip_loop_save_pose(preview, now_ns);
    }
    const bool new_errors = dip_loop_measure_errors(preview, now_ns);
    bool new_prices = dip_loop_measure_prices(preview);
    new_prices = choose(preview) || new_prices;
    *shown = new_frame || new_errors || new_prices || preview->redraw || preview->exposed ||
             state->screenshot || (had_notice && !state->notice[0]) ||
             now_ns >= dip_ui_wakes_ns(dip_view_ui(preview->view)) || now_ns >= preview->blinks_ns;
    if (*shown && !dip_loop_show(preview, now_ns, err)) {
        preview->redraw = preview->exposed = true; // The next turn shows what this one could not.
        return false;
    }
    return true;
}

// After a picture was shown, waits for the display's next refresh. Otherwise waits up to
// IDLE_WAIT_MS for an event.
static void wait_for_turn(DipPreview *preview, bool shown) {
    if (!shown) {
        const bool busy = preview->live_prices &&
                          dip_live_prices_are_working(preview->live_prices) &&
                          dip_prices_progress(preview->prices)[0] != '\0'; // Not paused.
        dip_loop_take_event(preview, busy ? 0 : IDLE_WAIT_MS);
        return;
    }
    preview->due_ns = dip_taa_pace_next_ns(preview->due_ns, preview->turn_ns, preview->refresh_ns,
                                           dip_loop_clock_ns(preview));
    int64_t left_ns = preview->due_ns - dip_loop_clock_ns(preview);
    while (left_ns >= ns_per_ms && !preview->state.quit) {
        dip_loop_take_event(preview, (int)(left_ns / ns_per_ms));
        left_ns = preview->due_ns - dip_loop_clock_ns(preview);
    }
}

// Returns whether nobody sees the window and nobody waits for its picture.
static bool is_hidden(const DipPreview *preview) {
    const DipDisplay *display = &preview->def.display;
    return display->is_hidden && display->is_hidden(display->context) &&
           !preview->state.wants_picture;
}

// A turn in which nothing is drawn or measured. Time stands still.
static void rest_hidden(DipPreview *preview) {
    if (preview->errors) {
        dip_error_thread_pause(preview->errors);
    }
    if (preview->live_prices) {
        dip_live_prices_pause(preview->live_prices);
    }
    preview->figures.presented_ns = 0; // The time until the next picture says nothing.
    preview->exposed = true;
    dip_loop_take_event(preview, IDLE_WAIT_MS);
    preview->turn_ns = dip_loop_clock_ns(preview);
}

bool dip_preview_turn(DipPreview *preview, DipError *err) {
    bool shown = false;
    while (!preview->state.quit && dip_loop_take_event(preview, 0)) {
    }
    dip_loop_take_control(preview);
    if (preview->state.quit) {
        return true; // The user has quit, so no further frame is drawn.
    }
    if (is_hidden(preview)) {
        rest_hidden(preview);
        return true;
    }
    if (!draw_turn(preview, dip_loop_clock_ns(preview), &shown, err)) {
        return false;
    }
    wait_for_turn(preview, shown);
    return true;
}

bool dip_preview_has_quit(const DipPreview *preview) {
    return preview->state.quit;
}

const DipPreviewState *dip_preview_state(const DipPreview *preview) {
    return &preview->state;
}

DipPixels dip_preview_picture(const DipPreview *preview) {
    return dip_view_picture(preview->view);
}

DipLayout dip_preview_layout(DipPreview *preview) {
    const DipViewInput input = dip_loop_view_input(preview, dip_loop_clock_ns(preview));
    return dip_view_layout(&input);
}
