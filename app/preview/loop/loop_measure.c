// Measures the panes' errors (error_thread.h) and rough prices (live_prices.h) while nothing moves.
#include "app/preview/loop/loop_private.h"

#include "app/preview/tools/maps.h"

#include <limits.h>

// Rough prices are measured for about this time in each turn, in milliseconds.
static const double price_budget_ms = 8.0;
// A truth (converged picture) with fewer samples per pixel is too noisy for prices.
static const int least_truth_samples = 32;

// Returns whether rough prices are measured: no report is used instead, the dock is open or another
// program has subscribed to prices, and nothing moves.
static bool wants_prices(const DipPreview *preview) {
    const DipPreviewState *state = &preview->state;
    const bool shown = (state->tools.open && !state->tools.bare) || state->wants_prices;
    return preview->def.measures_prices && dip_prices_are_rough(preview->prices) && shown &&
           dip_preview_rests(state, preview->flying);
}

// Returns whether prices or advice show that need the truth (the converged picture), against which
// the errors of settings are measured. For prices alone, the thread that draws the truth is created
// only when all times are known at least roughly, because the thread would disturb the measurement
// of times.
static bool prices_need_truth(const DipPreview *preview) {
    const DipPreviewState *state = &preview->state;
    const bool shown = state->tools.tab == DIP_TAB_SETTINGS || state->tools.tab == DIP_TAB_ADVICE;
    return (shown || state->wants_prices) && !preview->no_truth && wants_prices(preview) &&
           (preview->errors || dip_live_prices_have_times(preview->live_prices));
}

// Returns whether the window shows the panes' errors or the truth.
static bool looks_at_errors(const DipPreview *preview) {
    return dip_preview_shows_times(&preview->state) || dip_maps_need_errors(&preview->state.tools);
}

// Returns whether the user or another program asks for errors or the truth.
static bool shows_errors(const DipPreview *preview) {
    return looks_at_errors(preview) || preview->state.wants_errors;
}

// Returns the samples per pixel of the finest truth that may be drawn now. Measuring times and
// drawing truths take turns. Rough times come first. Next comes a truth of least_truth_samples,
// together with the settings' errors against it. Better times follow, and then finer truths. While
// the user looks at errors, the truth of least_truth_samples comes before the rough times. If no
// prices are measured, there is no limit (INT_MAX).
static int truth_limit(const DipPreview *preview) {
    if (!wants_prices(preview)) {
        return INT_MAX;
    }
    if (!dip_live_prices_have_times(preview->live_prices)) {
        return looks_at_errors(preview) ? least_truth_samples : 0;
    }
    const bool settled = !dip_live_prices_lack_errors(preview->live_prices) &&
                         dip_live_prices_have_final_times(preview->live_prices);
    return settled ? INT_MAX : least_truth_samples;
}

static bool wants_errors(const DipPreview *preview) {
    return !preview->def.session->shows_gallery &&
           dip_preview_rests(&preview->state, preview->flying) && !dip_loop_settles(preview) &&
           (shows_errors(preview) || prices_need_truth(preview));
}

static void close_errors(DipPreview *preview) {
    preview->state.tools.open = preview->state.wants_errors = false;
    dip_tool_state_choose_map(&preview->state.tools, DIP_MAP_NONE);
    preview->resized = true;
}

static bool create_errors(DipPreview *preview, int64_t now_ns) {
    DipSession *session = preview->def.session;
    DipError err;
    if (!preview->errors && preview->def.load_scene_def(session, &err)) {
        preview->errors = dip_error_thread_create(&session->scene_def, &session->reflection,
                                                  preview->def.cache, &err);
    }
    if (!preview->errors) {
        dip_loop_report(preview, &err, now_ns);
        if (shows_errors(preview)) {
            close_errors(preview);
        }
        preview->no_truth = true;
    }
    return preview->errors != NULL;
}

static bool shows_mips(const DipPreview *preview, int pane) {
    return preview->drawn.quality[pane].step[DIP_SETTING_MIPDEBUG] != 0;
}

static DipStill still_of(const DipPreview *preview) {
    const DipFrame *current = &preview->frame.panes[DIP_PANE_CURRENT];
    const DipFrame *requested = &preview->frame.panes[DIP_PANE_REQUESTED];
    return (DipStill){
        .pose = preview->drawn.pose,
        .time_ns = preview->drawn.play_ns,
        .width = current->width,
        .height = current->height,
        .stride_bytes = current->stride_bytes,
        .pixels_per_degree = dip_prices_viewing(preview->prices),
        .rgba8 = {current->rgba8, preview->frame.copied ? NULL : requested->rgba8},
        .unjudged = {shows_mips(preview, DIP_PANE_CURRENT),
                     shows_mips(preview, DIP_PANE_REQUESTED)},
    };
}

bool dip_loop_measure_errors(DipPreview *preview, int64_t now_ns) {
    const bool gallery = preview->def.session->shows_gallery;
    const bool measures = wants_errors(preview);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        preview->figures.shown[p].no_errors = gallery;
        preview->figures.shown[p].mip_colours = shows_mips(preview, p);
    }
    if (!preview->errors && !(measures && create_errors(preview, now_ns))) {
        return false;
    }
    if (measures) {
        const DipStill still = still_of(preview);
        dip_error_thread_limit(preview->errors, truth_limit(preview));
        dip_error_thread_measure(preview->errors, &still, preview->picture_number);
    } else {
        dip_error_thread_pause(preview->errors);
    }
    DipErrorReading reading;
    const bool news = dip_error_thread_read(preview->errors, &reading);
    dip_maps_set_errors(&preview->tools->maps, &reading,
                        dip_error_thread_pictures(preview->errors));
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        preview->figures.shown[p].errors = reading;
    }
    return news;
}

// Returns the truth of the panes' picture, against which the errors of prices are measured. The
// truth has no pixels while there is none or it is too noisy for this.
static DipLiveTruth truth_for_prices(const DipPreview *preview) {
    if (!preview->errors || !wants_errors(preview)) {
        return (DipLiveTruth){.samples = 0};
    }
    const DipErrorReading *reading = &preview->figures.shown[DIP_PANE_CURRENT].errors;
    const DipErrorPictures *pictures = dip_error_thread_pictures(preview->errors);
    DipLiveTruth truth = {
        .next_samples = reading->next_samples, .drawn = reading->drawn, .waits = reading->waits};
    if (pictures && pictures->result.samples >= least_truth_samples) {
        truth.picture = (DipSrgbPicture){pictures->truth_rgba8, 4 * (size_t)pictures->width,
                                         pictures->width, pictures->height};
        truth.samples = pictures->result.samples;
    }
    truth.comes_first = truth.samples == 0 && reading->status == DIP_ERROR_STATUS_WORKING &&
                        truth_limit(preview) >= least_truth_samples;
    return truth;
}

bool dip_loop_measure_prices(DipPreview *preview) {
    if (!preview->def.measures_prices) {
        return false;
    }
    dip_prices_prefer_rough(preview->prices, preview->state.measures_here ||
                                                 dip_prices_are_of_other_scene(preview->prices));
    if (!wants_prices(preview)) {
        dip_live_prices_pause(preview->live_prices);
        return false;
    }
    const DipLivePicture picture = {
        .pose = preview->drawn.pose,
        .time_ns = preview->drawn.play_ns,
        .width = preview->drawn.width,
        .height = preview->drawn.height,
        .look = preview->drawn.look,
        .pixels_per_degree = dip_prices_viewing(preview->prices),
    };
    const DipLiveTruth truth = truth_for_prices(preview);
    return dip_live_prices_step(preview->live_prices, &picture, preview->drawn.quality, &truth,
                                price_budget_ms);
}
